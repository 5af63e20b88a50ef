//! The microfacet models of 1967 to 1981, as their papers have them.

use super::model;
use crate::{Bound, Model, Parameter, Reader};
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::{Alpha, Blinn1977, CookTorrance, Vec3};

const KS: Parameter = Parameter::reflectance("ks", "the coefficient of the lobe");
const F0: Parameter = Parameter::reflectance("f0", "the reflectance at normal incidence, in Schlick's form");

/// `D` is `exp(−t)` times what is exact to a few ulps, and `t` has at most sixteen roundings: four in each component of
/// `h/α`, doubled by the square, those of `(n·h)²`, a sum and a quotient. Two more are those of `t log₂ e`. `t` exceeds
/// `|ln(D/D_max)|` by at most `2 ln(1 + t)`, so it is the depth down the lobe that counts.
const BECKMANN: Bound = Bound::Derived { formula: "u (60 + 18 t), t = (tan θ_h/m)²", at: beckmann };

fn beckmann(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let (s, m) = (l + v, p.number("m"));
    let t = (s.x * s.x + s.y * s.y) / (s.z * s.z * m * m);
    // Beyond, the exponential is below 2⁻¹²⁶.
    if t > 87.0 { f64::INFINITY } else { (60.0 + 18.0 * t) / 16_777_216.0 }
}

pub(super) const MODELS: &[Model] = &[
    model! {
        name: "cook-torrance",
        summary: "Beckmann, V-cavities and the factor 1/π (Cook and Torrance 1981)",
        parameters: &[KS, Parameter::number("m", 1e-4, 1.0, "the root mean square slope"), F0],
        reciprocal: true,
        finite: true,
        bound: BECKMANN,
        build: |p| CookTorrance::new(p.rgb("ks"), Alpha(p.number("m")), Schlick::new(p.rgb("f0"))),
    },
    model! {
        name: "blinn-1977",
        summary: "Trowbridge-Reitz with a peak of 1, and V-cavities (Blinn 1977): gains energy",
        parameters: &[KS, Parameter::number("c", 1e-4, 1.0, "the width c₃ of the distribution"), F0],
        reciprocal: true,
        finite: true,
        bound: Bound::Constant,
        build: |p| {
            Blinn1977::new(p.rgb("ks"), Ggx::new(Alpha(p.number("c"))), Schlick::new(p.rgb("f0")))
        },
    },
];
