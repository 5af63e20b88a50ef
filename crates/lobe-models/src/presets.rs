//! The materials that have a name.

use crate::material::Material;
use crate::names::nearest;
use crate::ngan;
use crate::parameter::Error;

/// The materials of ours that have a name, as the JSON that they stand for.
pub const PRESETS: &[(&str, &str)] = &[
    ("paper", r#"{"lobes": [{"model": "lambert", "albedo": 0.8}]}"#),
    (
        "red-plastic",
        r#"{"lobes": [{"model": "lambert", "albedo": [0.5, 0.05, 0.05]}, {"model": "blinn-phong", "ks": 0.04, "q": 80}]}"#,
    ),
    ("glossy", r#"{"lobes": [{"model": "lambert", "albedo": 0.2}, {"model": "phong", "ks": 0.3, "q": 30}]}"#),
    ("gold", r#"{"lobes": [{"model": "blinn-phong", "ks": [1.0, 0.77, 0.34], "q": 200}]}"#),
    ("mirror-lobe", r#"{"lobes": [{"model": "phong", "ks": 1, "q": 50}]}"#),
    ("half-vector-lobe", r#"{"lobes": [{"model": "blinn-phong", "ks": 1, "q": 50}]}"#),
    (
        "lecture-phong",
        r#"{"lobes": [{"model": "lambert", "albedo": 0.6}, {"model": "lecture-phong", "ks": 0.4, "q": 20}]}"#,
    ),
    (
        "lecture-blinn-torrance",
        r#"{"lobes": [{"model": "lambert", "albedo": 0.6}, {"model": "lecture-blinn-torrance", "ks": 0.4, "q": 20}]}"#,
    ),
    (
        "ggx-plastic",
        r#"{"lobes": [{"model": "lambert", "albedo": [0.05, 0.2, 0.5]}, {"model": "microfacet", "distribution": "ggx", "alpha": 0.2, "f0": 0.04}]}"#,
    ),
    (
        "ggx-gold",
        r#"{"lobes": [{"model": "microfacet", "distribution": "ggx", "alpha": 0.15, "f0": [1.0, 0.77, 0.34]}]}"#,
    ),
];

/// The material of that name; `ngan:MATERIAL/MODEL` is one of the [fits](crate::ngan) to measured ones.
///
/// # Errors
/// That there is none, with the nearest names.
pub fn preset(name: &str) -> Result<Material, Error> {
    if name.starts_with(ngan::PREFIX) {
        return ngan::preset(name);
    }
    let Some((name, text)) = PRESETS.iter().find(|(known, _)| *known == name) else {
        let near = nearest(name, PRESETS.iter().map(|(name, _)| *name), 3);
        return Err(Error(format!("unknown preset `{name}`; the nearest are {}", near.join(", "))));
    };
    let material = Material::from_json(text).map_err(|error| Error(format!("preset `{name}`: {error}")))?;
    Ok(Material { name: (*name).to_owned(), ..material })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_right() {
        for (name, _) in PRESETS {
            let material = preset(name).unwrap_or_else(|error| panic!("{error}"));
            assert!(material.name == *name && material.warnings().is_empty(), "{name}");
        }
    }
}
