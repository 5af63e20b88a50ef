//! Lambert, Phong, Blinn-Phong, and the lecture's highlights.

use super::model;
use crate::{AnyBrdf, Model, Number, Parameter, Reader};
use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::{BlinnPhong, CommonNormalization, Lambert, NormalIncidence, Phong};

const KS: Parameter = Parameter::reflectance("ks", "the reflectance of the lobe");

pub(super) const MODELS: &[Model] = &[
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
        f32: blinn_phong,
        f64: blinn_phong,
    },
    model! {
        name: "lecture-phong",
        summary: "the lecture's mirror highlight k_s (v·r)^q, which is no BRDF",
        parameters: &[KS, Parameter::shininess()],
        reciprocal: false,
        finite: false,
        build: |p| PhongHighlight::new(p.rgb("ks"), p.shininess()),
    },
    model! {
        name: "lecture-blinn-torrance",
        summary: "the lecture's half-vector highlight k_s (n·h)^q, which is no BRDF",
        parameters: &[KS, Parameter::shininess()],
        reciprocal: false,
        finite: false,
        build: |p| BlinnTorranceHighlight::new(p.rgb("ks"), p.shininess()),
    },
];

fn blinn_phong<R: Number>(p: &Reader<'_, R>) -> AnyBrdf<R> {
    let (ks, q) = (p.rgb("ks"), p.shininess());
    match p.choice("normalization") {
        "common" => Box::new(BlinnPhong::<R, CommonNormalization>::with_normalization(ks, q)),
        _ => Box::new(BlinnPhong::<R, NormalIncidence>::with_normalization(ks, q)),
    }
}
