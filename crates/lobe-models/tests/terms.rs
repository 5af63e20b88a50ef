//! The distributions and maskings by name: each word is its type, with its own parameters.

use lobe::distribution::{Beckmann, Distribution, Gaussian, Ggx, Gtr, PhongPower, SmithTable, StudentT};
use lobe::fresnel::Schlick;
use lobe::masking::{
    Hammon, Implicit, Kelemen, Masking, Neumann, RationalBeckmann, SchlickGgx, SmithCorrelated, SmithSeparable, VCavity,
};
use lobe::{Alpha, Brdf, Microfacet, Rgb, Vec3};
use lobe_models::{Kind, Lobe, Value, model};

const L: Vec3<f64> = Vec3 { x: 0.96, y: 0.0, z: 0.28 };
const V: Vec3<f64> = Vec3 { x: -0.48, y: 0.36, z: 0.8 };
const F0: [f64; 3] = [0.9, 0.5, 0.2];

fn named(distribution: &'static str, masking: &'static str, given: &[(&str, Value)]) -> Rgb<f64> {
    let mut all = vec![
        ("distribution", Value::Choice(distribution)),
        ("masking", Value::Choice(masking)),
        ("alpha", Value::Widths([0.5, 0.3])),
        ("f0", Value::Colour(F0)),
    ];
    all.extend(given);
    Lobe::new(model("microfacet").expect("there is one"), &all).expect("inside the domain").build::<f64>().eval(L, V)
}

fn direct<D: Distribution<f64>, G: Masking<f64, D>>(d: D, g: G) -> Rgb<f64> {
    // The catalogue has a reflectance at grazing incidence too, of 1.
    Microfacet::new(d, g, Schlick::with_f90(Rgb::from(F0), Rgb::splat(1.0))).eval(L, V)
}

#[test]
fn each_word_is_its_term() {
    let (x, y) = (Alpha(0.5_f64), Alpha(0.3_f64));
    let mean = Alpha((x.0 * y.0).sqrt());
    let ggx = Ggx::anisotropic(x, y);
    let gtr = Gtr::anisotropic(x, y, 1.3);
    let student = StudentT::anisotropic(x, y, 4.5);
    assert_eq!(named("ggx", "smith-correlated", &[]), direct(ggx, SmithCorrelated));
    assert_eq!(named("beckmann", "smith-separable", &[]), direct(Beckmann::anisotropic(x, y), SmithSeparable));
    assert_eq!(named("blinn", "v-cavity", &[]), direct(PhongPower::anisotropic(x, y), VCavity));
    assert_eq!(named("gaussian", "kelemen", &[]), direct(Gaussian::anisotropic(x, y), Kelemen));
    assert_eq!(named("gtr", "neumann", &[("gamma", Value::Number(1.3))]), direct(gtr, Neumann));
    let four = ("student-gamma", Value::Number(4.5));
    assert_eq!(named("student-t", "implicit", &[four]), direct(student, Implicit));
    let table: SmithTable<_, f64> = SmithTable::anisotropic(student, x, y, &StudentT::new(mean, 4.5));
    assert_eq!(named("student-t", "smith-correlated", &[four]), direct(table, SmithCorrelated));
    assert_eq!(named("ggx", "hammon", &[]), direct(ggx, Hammon::new(mean)));
    assert_eq!(named("ggx", "schlick-ggx", &[]), direct(ggx, SchlickGgx::half(mean)));
    assert_eq!(named("ggx", "schlick-ggx-remapped", &[]), direct(ggx, SchlickGgx::remapped(mean)));
    assert_eq!(named("ggx", "schlick-beckmann", &[]), direct(ggx, SchlickGgx::schlick(mean)));
    assert_eq!(named("ggx", "rational-beckmann", &[]), direct(ggx, RationalBeckmann::anisotropic(x, y)));
}

/// No two words of a choice mean the same: a word that falls through to the default would.
#[test]
fn no_two_words_mean_the_same() {
    let words = |name: &str| match model("microfacet").expect("there is one").parameters.iter().find(|p| p.name == name)
    {
        Some(parameter) => match parameter.kind {
            Kind::Choice(words) => words,
            _ => &[],
        },
        None => &[],
    };
    let (distributions, maskings) = (words("distribution"), words("masking"));
    assert!(distributions.len() >= 6 && maskings.len() >= 11);
    let all = |values: Vec<f64>| {
        for (i, a) in values.iter().enumerate() {
            assert!(values.iter().skip(i + 1).all(|b| (a / b - 1.0).abs() > 1e-4), "{values:?}");
        }
    };
    // The default γ of gtr is GGX itself.
    let gamma = [("gamma", Value::Number(1.5))];
    all(distributions.iter().map(|d| named(d, "smith-correlated", &gamma).g).collect());
    all(maskings.iter().map(|m| named("ggx", m, &[]).g).collect());
}
