//! What is measured: materials, and what may stand for them.

use lobe::fresnel::{Conductor, Dielectric, Fresnel as _, Incidence, metals};
use lobe::{Ior, Rgb};
use lobe_models::{Lobe, Material, Model, Value, model, models};

/// A material, and the forms in which it is run.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Its name in the table.
    pub name: String,
    /// The first is the material as it is.
    pub forms: Vec<Form>,
}

/// A material as it is, or with an approximation in place of one of its parts.
#[derive(Clone, Debug)]
pub struct Form {
    /// `exact`, or what is approximated.
    pub name: String,
    /// The material.
    pub material: Material,
}

/// The name of the form that approximates nothing.
const EXACT: &str = "exact";

impl Subject {
    /// A material with the approximations that its lobes have.
    ///
    /// Of a sum each lobe is replaced alone.
    #[must_use]
    pub fn of_material(material: &Material) -> Self {
        let mut forms = vec![Form { name: EXACT.to_owned(), material: material.clone() }];
        for (index, lobe) in material.lobes.iter().enumerate() {
            for (name, other) in approximations(lobe) {
                let mut lobes = material.lobes.clone();
                lobes[index] = other;
                let name = if lobes.len() == 1 { name.to_owned() } else { format!("{name} (lobe {})", index + 1) };
                forms.push(Form { name, material: Material { name: material.name.clone(), lobes } });
            }
        }
        Self { name: material.name.clone(), forms }
    }
}

fn of_lobe(name: &str, lobe: Lobe) -> Subject {
    Subject::of_material(&Material { name: name.to_owned(), lobes: vec![lobe] })
}

/// Every model of the catalogue with typical parameters, and the microfacet lobes that have approximations of their own.
#[must_use]
pub fn catalogue() -> Vec<Subject> {
    let mut all: Vec<_> = models().map(|model| of_lobe(model.name, model.typical())).collect();
    // One colour for all, so that they are compared by their terms alone.
    const MICROFACETS: [(&str, &str, &str, &str); 4] = [
        ("microfacet ggx conductor", "ggx", "smith-correlated", "conductor"),
        ("microfacet ggx dielectric", "ggx", "smith-correlated", "dielectric"),
        ("microfacet ggx separable", "ggx", "smith-separable", "schlick"),
        ("microfacet beckmann", "beckmann", "smith-separable", "schlick"),
    ];
    for (name, distribution, masking, fresnel) in MICROFACETS {
        let Some(lobe) = model("microfacet").map(Model::typical) else { continue };
        let changes = [
            ("distribution", Value::Choice(distribution)),
            ("masking", Value::Choice(masking)),
            ("fresnel", Value::Choice(fresnel)),
            ("metal", Value::Choice("gold")),
        ];
        all.extend(with(&lobe, &changes).map(|lobe| of_lobe(name, lobe)));
    }
    all
}

/// The lobe with other values of some parameters.
fn with(lobe: &Lobe, changes: &[(&str, Value)]) -> Option<Lobe> {
    let changed = |name: &str| changes.iter().find(|(other, _)| *other == name).map(|(_, value)| *value);
    let values: Vec<_> =
        lobe.values().map(|(parameter, value)| (parameter.name, changed(parameter.name).unwrap_or(value))).collect();
    Lobe::weighted(lobe.model(), &values).and_then(|new| new.with_weight(lobe.weight())).ok()
}

/// What stands for a lobe, at less work and with less truth.
fn approximations(lobe: &Lobe) -> Vec<(&'static str, Lobe)> {
    let choice = |name: &str| match lobe.value(name) {
        Some(Value::Choice(word)) => word,
        _ => "",
    };
    if lobe.model().name != "microfacet" {
        return Vec::new();
    }
    let mut all = Vec::new();
    let mut add = |name: &'static str, other: Option<Lobe>| all.extend(other.map(|other| (name, other)));
    let (distribution, masking, fresnel) = (choice("distribution"), choice("masking"), choice("fresnel"));
    let masked = |word: &'static str| with(lobe, &[("masking", Value::Choice(word))]);

    let f0 = normal_reflectance(lobe, fresnel);
    if let (Some(f0), "conductor" | "dielectric") = (f0, fresnel) {
        let schlick =
            [("fresnel", Value::Choice("schlick")), ("f0", Value::Colour(f0)), ("f90", Value::Colour([1.0; 3]))];
        add("Schlick for Fresnel", with(lobe, &schlick));
    }
    match (distribution, masking) {
        ("ggx", "smith-correlated") => {
            add("Hammon for Smith", masked("hammon"));
            add("separable for correlated Smith", masked("smith-separable"));
            add("Schlick-GGX for Smith", masked("schlick-ggx"));
            add("Kelemen for Smith", masked("kelemen"));
        }
        ("ggx", "smith-separable") => {
            add("Schlick-GGX for Smith", masked("schlick-ggx"));
            add("Kelemen for Smith", masked("kelemen"));
        }
        ("beckmann", "smith-correlated" | "smith-separable") => {
            add("rational G1 for Smith", masked("rational-beckmann"));
            add("Schlick for Smith", masked("schlick-beckmann"));
            add("Kelemen for Smith", masked("kelemen"));
        }
        _ => {}
    }
    if let ("ggx", Some(f0), Some(Value::Widths([x, y]))) = (distribution, f0, lobe.value("alpha"))
        && x == y
        && x < 1.0
    {
        add("Blinn-Phong for GGX", blinn_phong(f0, x).and_then(|new| new.with_weight(lobe.weight()).ok()));
    }
    all
}

/// The reflectance at normal incidence.
fn normal_reflectance(lobe: &Lobe, fresnel: &str) -> Option<[f64; 3]> {
    let colour = |name: &str| match lobe.value(name) {
        Some(Value::Colour([r, g, b])) => Some(Rgb::new(r, g, b)),
        _ => None,
    };
    let normal = Incidence::from_cos(1.0);
    let f = match fresnel {
        "schlick" => colour("f0")?,
        "dielectric" => match lobe.value("ior")? {
            Value::Number(ior) => Dielectric::new(Ior(ior)).fresnel(normal),
            _ => return None,
        },
        "conductor" => match lobe.value("metal")? {
            Value::Choice(name) => match metals::METALS.iter().find(|metal| metal.name == name) {
                Some(metal) => metal.conductor(1.0).fresnel(normal),
                None => Conductor::new(colour("eta")?, colour("k")?).fresnel(normal),
            },
            _ => return None,
        },
        _ => return None,
    };
    Some(f.into())
}

/// Blinn-Phong whose highlight is as wide at half its height as that of a GGX of the width `α`.
///
/// GGX is at half its peak where `sin²θ (1 − α²) = α² (√2 − 1)`; the lobe where `cos^q θ = 1/2`. Nothing where GGX is
/// never so low.
fn blinn_phong(f0: [f64; 3], alpha: f64) -> Option<Lobe> {
    let sin2 = alpha * alpha * (std::f64::consts::SQRT_2 - 1.0) / (1.0 - alpha * alpha);
    if sin2 >= 1.0 {
        return None;
    }
    let q = 2.0 * 0.5_f64.ln() / (-sin2).ln_1p();
    Lobe::new(model("blinn-phong")?, &[("ks", Value::Colour(f0)), ("q", Value::Number(q.min(1e6)))]).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe::distribution::{Distribution as _, Ggx};
    use lobe::{Alpha, Vec3};

    #[test]
    fn half_widths_are_matched() {
        for alpha in [0.05, 0.3, 0.6] {
            let lobe = blinn_phong([1.0; 3], alpha).expect("there is one");
            let Some(Value::Number(q)) = lobe.value("q") else { panic!("a number") };
            let cos = 0.5_f64.powf(1.0 / q);
            let h = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
            let ggx = Ggx::new(Alpha(alpha));
            assert!((ggx.d(h) / ggx.d(Vec3::new(0.0, 0.0, 1.0)) - 0.5).abs() < 1e-9, "{alpha}");
        }
    }

    #[test]
    fn every_model_is_there_and_has_what_stands_for_it() {
        let all = catalogue();
        assert!(models().all(|model| all.iter().any(|subject| subject.name == model.name)));
        let gold = all.iter().find(|subject| subject.name == "microfacet ggx conductor").expect("there is one");
        let forms: Vec<_> = gold.forms.iter().map(|form| form.name.as_str()).collect();
        assert_eq!(forms[..3], ["exact", "Schlick for Fresnel", "Hammon for Smith"]);
        assert_eq!(forms.last(), Some(&"Blinn-Phong for GGX"));
        let beckmann = all.iter().find(|subject| subject.name == "microfacet beckmann").expect("there is one");
        assert_eq!(beckmann.forms[1].name, "rational G1 for Smith");
    }
}
