//! Lambert, Phong, Blinn-Phong, and the lecture's highlights.

use super::{U, constructor, constructors, model};
use crate::{Bound, Model, Parameter, Reader};
use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::{BlinnPhong, CommonNormalization, Lambert, NormalIncidence, Phong, Vec3};

const KS: Parameter = Parameter::reflectance("ks", "the reflectance of the lobe");

/// `docs/numerics.md`, "The half-vector lobe".
const HALF_VECTOR: Bound = Bound::Derived { formula: "u (14 + 14 L)", at: half_vector };
/// `docs/numerics.md`, "The mirror lobe".
const MIRROR: Bound = Bound::Derived { formula: "u (7 + 6.5 L + 5 q (1/(r·v) - 1))", at: mirror };

pub(super) static MODELS: &[Model] = &[
    model! {
        name: "lambert",
        summary: "ρ/π, perfectly diffuse (Lambert 1760)",
        parameters: &[Parameter::reflectance("albedo", "the albedo ρ")],
        reciprocal: true,
        finite: true,
        build: |p| Lambert::new(p.rgb("albedo")),
    },
    model! {
        name: "phong",
        summary: "a lobe around the mirror direction, normalised (Phong 1975, Lewis 1993)",
        parameters: &[KS, Parameter::shininess()],
        reciprocal: true,
        finite: true,
        bound: MIRROR,
        build: |p| Phong::new(p.rgb("ks"), p.shininess()),
    },
    Model {
        name: "blinn-phong",
        summary: "a lobe of the half vector (Blinn 1977), by one of two published factors",
        parameters: &[
            KS,
            Parameter::shininess(),
            Parameter::choice("normalization", &["normal-incidence", "common"], "the factor N(q)"),
        ],
        reciprocal: true,
        finite: true,
        bound: HALF_VECTOR,
        build: constructors!(blinn_phong),
    },
    model! {
        name: "lecture-phong",
        summary: "the lecture's mirror highlight k_s (v·r)^q, which is no BRDF",
        parameters: &[KS, Parameter::shininess()],
        reciprocal: false,
        finite: false,
        bound: MIRROR,
        build: |p| PhongHighlight::new(p.rgb("ks"), p.shininess()),
    },
    model! {
        name: "lecture-blinn-torrance",
        summary: "the lecture's half-vector highlight k_s (n·h)^q, which is no BRDF",
        parameters: &[KS, Parameter::shininess()],
        reciprocal: false,
        finite: false,
        bound: HALF_VECTOR,
        build: |p| BlinnTorranceHighlight::new(p.rgb("ks"), p.shininess()),
    },
];

constructor! { blinn_phong |p, finish| {
    let (ks, q) = (p.rgb("ks"), p.shininess());
    match p.choice("normalization") {
        "common" => finish(BlinnPhong::<R, CommonNormalization>::with_normalization(ks, q)),
        _ => finish(BlinnPhong::<R, NormalIncidence>::with_normalization(ks, q)),
    }
} }

/// `−ln 2⁻¹²⁶`: so far below the peak, and further, a lobe is 0.
const END: f64 = 126.0 * std::f64::consts::LN_2;

fn half_vector(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let s = l + v;
    let tan2 = (s.x * s.x + s.y * s.y) / (s.z * s.z);
    let depth = 0.5 * p.number("q") * tan2.ln_1p();
    if depth < END { U * (14.0 + 14.0 * depth) } else { f64::INFINITY }
}

fn mirror(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let q = p.number("q");
    let d = Vec3::new(l.x + v.x, l.y + v.y, l.z - v.z);
    let c = 1.0 - 0.5 * d.dot(d);
    let depth = -q * c.ln();
    // Below 2⁻¹² the relative error of r·v itself is no longer small, and the first order ends.
    if c > 1.0 / 4096.0 && depth < END { U * (7.0 + 6.5 * depth + 5.0 * q * (1.0 / c - 1.0)) } else { f64::INFINITY }
}
