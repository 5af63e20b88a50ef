//! The Fresnel terms by name: each word is its form, with its own parameters.

use lobe::distribution::Ggx;
use lobe::fresnel::{
    Conductor, CookFresnel, Dielectric, F82Tint, Fresnel, Gulbrandsen, Lazanyi, Schlick, metals::COPPER,
};
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Ior, Microfacet, Rgb, Vec3};
use lobe_models::{Lobe, Value, model};

const L: Vec3<f64> = Vec3 { x: 0.96, y: 0.0, z: 0.28 };
const V: Vec3<f64> = Vec3 { x: -0.6, y: 0.0, z: 0.8 };

fn named(form: &'static str, given: &[(&str, Value)]) -> Rgb<f64> {
    let mut all = vec![("alpha", Value::Widths([0.4; 2])), ("fresnel", Value::Choice(form))];
    all.extend(given);
    Lobe::new(model("microfacet").expect("there is one"), &all).expect("inside the domain").build::<f64>().eval(L, V)
}

fn direct(form: impl Fresnel<f64>) -> Rgb<f64> {
    Microfacet::new(Ggx::new(Alpha(0.4)), SmithCorrelated, form).eval(L, V)
}

#[test]
fn each_word_is_its_form() {
    let (a, b) = ([0.9, 0.5, 0.2], [0.3, 0.6, 0.8]);
    let (rgb_a, rgb_b) = (Rgb::from(a), Rgb::from(b));
    let (a, b) = (Value::Colour(a), Value::Colour(b));
    let seven = Value::Number(7.0);
    assert_eq!(named("schlick", &[("f0", a), ("f90", b)]), direct(Schlick::with_f90(rgb_a, rgb_b)));
    assert_eq!(named("cook", &[("f0", a)]), direct(CookFresnel::new(rgb_a)));
    assert_eq!(named("dielectric", &[("ior", Value::Number(2.4))]), direct(Dielectric::new(Ior(2.4))));
    assert_eq!(named("conductor", &[("eta", a), ("k", b)]), direct(Conductor::new(rgb_a, rgb_b)));
    assert_eq!(named("conductor", &[("metal", Value::Choice("copper"))]), direct(COPPER.conductor(1.0)));
    assert_eq!(named("f82-tint", &[("f0", a), ("tint", b)]), direct(F82Tint::new(rgb_a, rgb_b)));
    assert_eq!(named("gulbrandsen", &[("reflectivity", a), ("edge-tint", b)]), direct(Gulbrandsen::new(rgb_a, rgb_b)));
    let lazanyi = [("f0", a), ("lazanyi-a", b), ("lazanyi-exponent", seven)];
    assert_eq!(named("lazanyi", &lazanyi), direct(Lazanyi::new(rgb_a, rgb_b, 7.0)));
}
