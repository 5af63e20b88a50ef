//! BRDFs from the command line: JSON, `@file` or a name. What the JSON may hold stands in [`lobe_models`].

use crate::error::{Failure, reason};
use lobe_models::{Material, PRESETS, ngan};
use std::io::Read as _;
use std::path::Path;

/// What `--brdf` was given: JSON, `@file`, or the name of a preset.
pub(crate) fn from_argument(argument: &str) -> Result<Material, Failure> {
    if let Some(file) = argument.strip_prefix('@') {
        let text = read_some(file).map_err(|error| {
            Failure::Input(format!(
                "{file}: cannot read this file: {}; after @ stands a file with a BRDF in JSON",
                reason(&error)
            ))
        })?;
        let mut spec = parse(&text, file)?;
        // A name of its own is better than what it is made of, and so is that of the file.
        if spec.name == spec.description() {
            spec.name = Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        }
        return Ok(spec);
    }
    if argument.trim_start().starts_with(['{', '[', '"']) {
        return parse(argument, "--brdf");
    }
    if argument.starts_with(ngan::PREFIX) {
        return lobe_models::preset(argument).map_err(|error| Failure::Usage(format!("--brdf {argument}: {error}")));
    }
    if PRESETS.iter().all(|(name, _)| *name != argument) {
        let known: Vec<_> = PRESETS.iter().map(|(name, _)| *name).collect();
        return Err(Failure::Usage(format!(
            "unknown preset `{argument}` for --brdf; the presets are {}, ngan:MATERIAL/MODEL; or give JSON or @FILE",
            known.join(", ")
        )));
    }
    lobe_models::preset(argument).map_err(|error| Failure::Usage(error.to_string()))
}

/// What `--material` and `--model` were given: a measured material, or anything that `--brdf` takes.
pub(crate) fn material_argument(name: &str, model: Option<&str>) -> Result<Material, Failure> {
    let plain = name.strip_prefix(ngan::PREFIX).unwrap_or(name);
    let measured = ngan::materials().any(|known| known == plain);
    if !measured && model.is_none() && (name.starts_with(['{', '@']) || lobe_models::preset(name).is_ok()) {
        return from_argument(name);
    }
    let (material, written) = plain.split_once('/').map_or((plain, None), |(material, model)| (material, Some(model)));
    let fit = ngan::fit(material, model.or(written).unwrap_or(ngan::DEFAULT_MODEL));
    let fit = fit.map_err(|error| {
        Failure::Usage(format!("--material {name}: {error}; `lobe models --materials` lists them all"))
    })?;
    fit.material().map_err(|error| Failure::Usage(error.to_string()))
}

/// A text of at most a mebibyte; a pipe will do, and `/dev/zero` has an end.
fn read_some(file: &str) -> std::io::Result<String> {
    const LIMIT: u64 = 1 << 20;
    let mut text = String::new();
    std::fs::File::open(file)?.take(LIMIT + 1).read_to_string(&mut text)?;
    if text.len() as u64 > LIMIT {
        return Err(std::io::Error::other("it has more than 1 MiB"));
    }
    Ok(text)
}

/// Reads a BRDF from JSON; `source` is named in errors, as in `source:line:column: what; what would be right`.
///
/// # Errors
/// [`Failure::Input`] for text that is no JSON, an unknown model or parameter, or a parameter outside its domain.
pub fn parse(text: &str, source: &str) -> Result<Material, Failure> {
    Material::from_json(text).map_err(|error| Failure::Input(format!("{source}:{error}")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe::illumination::PhongHighlight;
    use lobe::{BlinnPhong, Brdf, CommonNormalization, Lambert, Rgb, Shininess, Vec3};

    #[test]
    fn a_material_is_the_sum_of_its_lobes_to_the_last_bit() {
        let text = r#"{"lobes": [{"model": "lambert", "albedo": [0.5, 0.25, 0.125]},
                                  {"model": "blinn-phong", "ks": 0.1, "q": 50},
                                  {"model": "blinn-phong", "ks": 0.1, "q": 8, "normalization": "common"},
                                  {"model": "lecture-phong", "ks": 0.2, "q": 3}]}"#;
        let material = parse(text, "").unwrap_or_else(|failure| panic!("{failure}")).build::<f32>();
        let by_hand = Lambert::new(Rgb::new(0.5_f32, 0.25, 0.125))
            + BlinnPhong::new(Rgb::splat(0.1), Shininess(50.0))
            + BlinnPhong::<f32, CommonNormalization>::with_normalization(Rgb::splat(0.1), Shininess(8.0))
            + PhongHighlight::new(Rgb::splat(0.2), Shininess(3.0));
        let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.48, 0.36, 0.8));
        assert_eq!(material.eval(l, v), by_hand.eval(l, v));
        assert_eq!(material.eval_cos(l, v), by_hand.eval_cos(l, v));
    }

    #[test]
    fn no_lobes_are_black_and_above_one_is_a_warning() {
        let spec = parse(r#"{"lobes": []}"#, "").unwrap_or_else(|failure| panic!("{failure}"));
        let up = Vec3::new(0.0, 0.0, 1.0);
        assert_eq!(spec.build::<f64>().eval(up, up), Rgb::splat(0.0));
        let bright = parse(r#"{"lobes": [{"model": "lambert", "albedo": 1.5}]}"#, "");
        assert_eq!(bright.map(|spec| spec.warnings().len()), Ok(1));
    }

    #[test]
    fn a_file_names_what_has_no_name() -> std::io::Result<()> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("paint.json");
        for (text, name) in [(r#"{"lobes": []}"#, "paint"), (r#"{"name": "x", "lobes": []}"#, "x")] {
            std::fs::write(&path, text)?;
            let spec = from_argument(&format!("@{}", path.display()));
            assert_eq!(spec.map(|spec| spec.name).as_deref(), Ok(name));
        }
        Ok(())
    }
}
