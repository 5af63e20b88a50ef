//! Diffuse models other than Lambert's, and sheen.

use super::{U, model};
use crate::{Bound, Model, Parameter, Reader};
use lobe::{Alpha, BurleyDiffuse, Charlie, Eon, Minnaert, OrenNayar, OrenNayarQualitative, PerceptualRoughness, Vec3};

const ALBEDO: Parameter = Parameter::reflectance("albedo", "the albedo ρ");

/// The exponential has its argument's error: `t = (1/2α) ln(1 + cot²θ_h)` has at most twelve roundings.
fn charlie(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    of_sheen(p.number("alpha"), l, v)
}

/// The bound of Charlie's sheen of a width `α`.
pub(super) fn of_sheen(alpha: f64, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let s = l + v;
    let t = (s.z * s.z / (s.x * s.x + s.y * s.y)).ln_1p() / (2.0 * alpha);
    // Beyond, `D` is below 2⁻¹²⁶ of its peak.
    if t < 80.0 { Bound::WORST + 12.0 * t * U } else { f64::INFINITY }
}

pub(super) static MODELS: &[Model] = &[
    model! {
        name: "oren-nayar",
        summary: "rough Lambertian V-cavities with interreflections (Oren and Nayar 1994, full)",
        parameters: &[ALBEDO, Parameter::number("sigma", 0.0, 0.6, "the roughness σ in radians")],
        reciprocal: true,
        finite: true,
        build: |p| OrenNayar::new(p.rgb("albedo"), p.number("sigma")),
    },
    model! {
        name: "oren-nayar-qualitative",
        summary: "its short form (Oren and Nayar 1994)",
        parameters: &[
            ALBEDO,
            Parameter::number("sigma", 0.0, core::f64::consts::FRAC_PI_2, "the roughness σ in radians"),
        ],
        reciprocal: true,
        finite: true,
        build: |p| OrenNayarQualitative::new(p.rgb("albedo"), p.number("sigma")),
    },
    model! {
        name: "eon",
        summary: "Oren-Nayar that preserves energy (Portsmouth, Kutz and Hill 2024)",
        parameters: &[ALBEDO, Parameter::number("roughness", 0.0, 1.0, "the roughness r")],
        reciprocal: true,
        finite: true,
        build: |p| Eon::new(p.rgb("albedo"), p.number("roughness")),
    },
    model! {
        name: "burley-diffuse",
        summary: "Disney's diffuse lobe (Burley 2012)",
        parameters: &[ALBEDO, Parameter::number("roughness", 0.0, 1.0, "the perceptual roughness r")],
        reciprocal: true,
        finite: true,
        build: |p| BurleyDiffuse::new(p.rgb("albedo"), PerceptualRoughness(p.number("roughness"))),
    },
    model! {
        name: "minnaert",
        summary: "(cos θ_l cos θ_v)^(k−1), for the moon (Minnaert 1941)",
        parameters: &[ALBEDO, Parameter::number("k", 0.0, 2.0, "the exponent k, 1 for Lambert's")],
        reciprocal: true,
        finite: false,
        build: |p| Minnaert::new(p.rgb("albedo"), p.number("k")),
    },
    model! {
        name: "charlie",
        summary: "sheen of standing fibres (Estevez and Kulla 2017)",
        parameters: &[
            Parameter::reflectance("color", "the colour of the sheen"),
            Parameter::number("alpha", 0.01, 1.0, "the width α, the square of glTF's roughness"),
        ],
        reciprocal: true,
        finite: true,
        bound: Bound::Derived { formula: "2e-5 + 12 u t, t = ln(1 + cot² θ_h)/(2α)", at: charlie },
        build: |p| Charlie::new(p.rgb("color"), Alpha(p.number("alpha"))),
    },
];
