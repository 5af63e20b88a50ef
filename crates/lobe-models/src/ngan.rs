//! 86 measured materials, each fitted with seven models: Ngan, Durand and Matusik 2005.
//!
//! "Experimental Analysis of BRDF Models", Eurographics Symposium on Rendering 2005, supplemental material: a Lambertian
//! lobe `kd` and one specular lobe `ks` with the parameters of the model, for each of the isotropic materials of the
//! MERL-MIT database that they chose. The figures stand in `assets/ngan2005.csv`; which lobe each name means, and how
//! that was settled, in `docs/materials.md`.
//!
//! ```
//! use lobe_models::ngan;
//!
//! let paint = ngan::fit("dark-blue-paint", "cook-torrance")?.material()?;
//! assert_eq!(paint.name, "ngan:dark-blue-paint/cook-torrance");
//! let slip = ngan::fit("dark-blue-pain", "ward").unwrap_err();
//! assert!(slip.to_string().contains("dark-blue-paint"));
//! # Ok::<(), lobe_models::Error>(())
//! ```

use crate::catalogue::{Lobe, model};
use crate::material::Material;
use crate::names::nearest;
use crate::parameter::{Error, Value};
use std::sync::OnceLock;

const TABLE: &str = include_str!("../../../assets/ngan2005.csv");

/// What stands before the name of a fit where all presets are named: `ngan:pvc/ward`.
pub const PREFIX: &str = "ngan:";

/// The model of a fit that names none.
pub const DEFAULT_MODEL: &str = "cook-torrance";

/// How a model of the table is one of the catalogue: `ks` and the parameters of the table to the values of the lobe and
/// its weight.
struct Mapping {
    /// Its name in the table.
    column: &'static str,
    /// Its name here, which is that of the model in the catalogue.
    model: &'static str,
    values: fn(&Fit) -> Vec<(&'static str, Value)>,
    weight: fn(&Fit) -> [f64; 3],
}

/// The parameters as they stand, and `ks` as the model's own.
const MAPPINGS: &[Mapping] = &[
    Mapping {
        column: "Ashikhmin-Shirley",
        model: "ashikhmin-shirley",
        values: |fit| vec![("f0", fit.grey("f0")), ("q", fit.number("q"))],
        weight: |fit| fit.ks,
    },
    Mapping {
        column: "Blinn-Phong",
        model: "blinn-phong",
        // The table's factor is (q+2)/(2π), that of a mirror lobe, on a half-vector lobe: see docs/materials.md.
        values: |fit| {
            let q = fit.parameter("q").unwrap_or_default();
            let factor = 4.0 * (q + 2.0) / (q + 8.0);
            let ks = Value::Colour(fit.ks.map(|ks| ks * factor));
            vec![("ks", ks), ("q", fit.number("q")), ("normalization", Value::Choice("common"))]
        },
        weight: |_| [1.0; 3],
    },
    Mapping {
        column: "Cook-Torrance",
        model: "cook-torrance",
        values: |fit| vec![("ks", Value::Colour(fit.ks)), ("m", fit.number("m")), ("f0", fit.grey("f0"))],
        weight: |_| [1.0; 3],
    },
    Mapping {
        column: "He",
        model: "he",
        values: |fit| {
            let parameters = ["tau", "sigma", "ior"].map(|name| (name, fit.number(name)));
            [("ks", Value::Colour(fit.ks))].into_iter().chain(parameters).collect()
        },
        weight: |_| [1.0; 3],
    },
    Mapping {
        column: "Lafortune",
        model: "lafortune",
        values: |fit| {
            let parameters = ["cxy", "cz", "q"].map(|name| (name, fit.number(name)));
            [("ks", Value::Colour(fit.ks))].into_iter().chain(parameters).collect()
        },
        weight: |_| [1.0; 3],
    },
    Mapping { column: "Ward", model: "ward", values: ward, weight: |_| [1.0; 3] },
    Mapping { column: "Ward-Duer", model: "ward-duer", values: ward, weight: |_| [1.0; 3] },
];

fn ward(fit: &Fit) -> Vec<(&'static str, Value)> {
    let alpha = fit.parameter("alpha").unwrap_or_default();
    vec![("ks", Value::Colour(fit.ks)), ("alpha", Value::Widths([alpha; 2]))]
}

/// One material fitted with one model.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The name of the material.
    pub material: &'static str,
    /// The name of the model, as in the catalogue.
    pub model: &'static str,
    /// The albedo of the Lambertian lobe.
    pub kd: [f64; 3],
    /// The coefficient of the specular lobe, as the table has it.
    pub ks: [f64; 3],
    /// The parameters of the model, as the table has them.
    pub parameters: Vec<(&'static str, f64)>,
}

impl Fit {
    /// A parameter of the table.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<f64> {
        self.parameters.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
    }

    fn number(&self, name: &str) -> Value {
        Value::Number(self.parameter(name).unwrap_or_default())
    }

    fn grey(&self, name: &str) -> Value {
        Value::Colour([self.parameter(name).unwrap_or_default(); 3])
    }

    /// Its name among the presets: `ngan:pvc/ward`.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{PREFIX}{}/{}", self.material, self.model)
    }

    /// The specular lobe alone.
    ///
    /// # Errors
    /// If the catalogue has no such model.
    pub fn specular(&self) -> Result<Lobe, Error> {
        let mapping = MAPPINGS.iter().find(|mapping| mapping.model == self.model);
        let lacking = || Error(format!("{}: the catalogue has no model `{}`", self.name(), self.model));
        let (mapping, model) = mapping.zip(model(self.model)).ok_or_else(lacking)?;
        Lobe::weighted(model, &(mapping.values)(self))?.with_weight((mapping.weight)(self))
    }

    /// The material: the Lambertian lobe and the specular one.
    ///
    /// # Errors
    /// If the catalogue has no such model.
    pub fn material(&self) -> Result<Material, Error> {
        let lambert = model("lambert").ok_or_else(|| Error("the catalogue has no model `lambert`".to_owned()))?;
        let diffuse = Lobe::new(lambert, &[("albedo", Value::Colour(self.kd))])?;
        Ok(Material { name: self.name(), lobes: vec![diffuse, self.specular()?] })
    }
}

/// All 602 fits, in the order of the table.
pub fn fits() -> &'static [Fit] {
    static FITS: OnceLock<Vec<Fit>> = OnceLock::new();
    // A line that cannot be read would be left out; a test counts them.
    FITS.get_or_init(|| TABLE.lines().skip(1).filter_map(line).collect())
}

fn line(line: &'static str) -> Option<Fit> {
    let [material, column, kd_r, kd_g, kd_b, ks_r, ks_g, ks_b, parameters] =
        <[&'static str; 9]>::try_from(line.split(',').collect::<Vec<_>>()).ok()?;
    let colour = |rgb: [&str; 3]| -> Option<[f64; 3]> {
        let [r, g, b] = rgb.map(|text| text.parse::<f64>().ok());
        Some([r?, g?, b?])
    };
    let parameter = |text: &'static str| text.split_once('=').and_then(|(name, x)| Some((name, x.parse().ok()?)));
    Some(Fit {
        material,
        model: MAPPINGS.iter().find(|mapping| mapping.column == column)?.model,
        kd: colour([kd_r, kd_g, kd_b])?,
        ks: colour([ks_r, ks_g, ks_b])?,
        parameters: parameters.split(';').map(parameter).collect::<Option<_>>()?,
    })
}

/// The names of the 86 materials.
pub fn materials() -> impl Iterator<Item = &'static str> {
    fits().iter().filter(|fit| fit.model == DEFAULT_MODEL).map(|fit| fit.material)
}

/// The names of the seven models; of one that the catalogue lacks, there are figures and no lobe.
pub fn models() -> impl Iterator<Item = &'static str> {
    MAPPINGS.iter().map(|mapping| mapping.model)
}

/// The fit of a material with a model.
///
/// # Errors
/// A name that is not there, with the nearest that are.
pub fn fit(material: &str, model: &str) -> Result<&'static Fit, Error> {
    if !models().any(|known| known == model) {
        let known: Vec<_> = models().collect();
        return Err(Error(format!("the materials are not fitted with `{model}`, but with {}", known.join(", "))));
    }
    fits().iter().find(|fit| fit.material == material && fit.model == model).ok_or_else(|| {
        let near = nearest(material, materials(), 3).join(", ");
        Error(format!("unknown material `{material}`; the nearest are {near}"))
    })
}

/// The material that `ngan:MATERIAL/MODEL` names; without a model, as fitted with [`DEFAULT_MODEL`].
pub(crate) fn preset(name: &str) -> Result<Material, Error> {
    let name = name.strip_prefix(PREFIX).unwrap_or(name);
    let (material, model) = name.split_once('/').unwrap_or((name, DEFAULT_MODEL));
    fit(material, model)?.material()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe::Vec3;

    #[test]
    fn every_line_is_read_and_every_fit_is_a_lobe() {
        assert_eq!((TABLE.lines().count(), fits().len(), materials().count()), (603, 602, 86));
        for fit in fits().iter().filter(|fit| model(fit.model).is_some()) {
            let material = fit.material().unwrap_or_else(|error| panic!("{error}"));
            let up = Vec3::new(0.0, 0.0, 1.0);
            let f = material.build::<f32>().eval(up, up);
            assert!(f.r.is_finite() && f.r >= 0.0, "{}: {f:?}", fit.name());
        }
        for name in models() {
            assert_eq!(fits().iter().filter(|fit| fit.model == name).count(), 86, "{name}");
        }
    }

    /// The closed forms at normal incidence, from the figures of the table by hand.
    #[test]
    fn the_values_are_those_of_the_paper_at_normal_incidence() {
        use std::f64::consts::PI;
        let up = Vec3::new(0.0, 0.0, 1.0);
        let value = |model: &str| {
            let fit = fit("dark-blue-paint", model).unwrap_or_else(|error| panic!("{error}"));
            let lobe = fit.specular().unwrap_or_else(|error| panic!("{error}"));
            let p = |name: &str| fit.parameter(name).unwrap_or_else(|| panic!("no {name}"));
            (lobe.build::<f64>().eval(up, up).b, fit.ks[2], [p])
        };
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        let (f, ks, [p]) = value("ward");
        close(f, ks / (4.0 * PI * p("alpha").powi(2)));
        let (f, ks, [p]) = value("ward-duer");
        close(f, ks / (4.0 * PI * p("alpha").powi(2)));
        let (f, ks, [p]) = value("blinn-phong");
        close(f, ks * (p("q") + 2.0) / (2.0 * PI));
        let (f, ks, [p]) = value("cook-torrance");
        close(f, ks * p("f0") / (PI * PI * p("m").powi(2)));
        let (f, ks, [p]) = value("ashikhmin-shirley");
        close(f, ks * p("f0") * (p("q") + 1.0) / (8.0 * PI));
        let (f, ks, [p]) = value("lafortune");
        let (cxy, cz, q) = (p("cxy"), p("cz"), p("q"));
        close(f, ks * (q + 2.0) / (2.0 * PI) * (cz / cz.abs().max(cxy.abs())).powf(q));
    }

    #[test]
    fn slips_name_what_is_near() {
        let error = preset("ngan:dark-blu-paint").map_or_else(|error| error.to_string(), |m| panic!("{m:?}"));
        assert!(error.starts_with("unknown material `dark-blu-paint`; the nearest are dark-blue-paint"), "{error}");
        let error = preset("ngan:pvc/phong").map_or_else(|error| error.to_string(), |m| panic!("{m:?}"));
        assert!(error.starts_with("the materials are not fitted with `phong`, but with "), "{error}");
        assert_eq!(preset("ngan:pvc").map(|m| m.name), Ok("ngan:pvc/cook-torrance".to_owned()));
    }
}
