//! The forms of `F`, for every model that has one.

use super::U;
use crate::forms::AnyFresnel;
use crate::{Number, Parameter, Reader, Value};
use lobe::fresnel::{
    Conductor, CookFresnel, Dielectric, F82Tint, Fresnel, Gulbrandsen, Incidence, Lazanyi, Schlick, metals,
};
use lobe::{Ior, Rgb, Vec3};

/// The word that names the form.
pub(super) const FORM: Parameter = Parameter::choice(
    "fresnel",
    &["schlick", "dielectric", "conductor", "cook", "f82-tint", "gulbrandsen", "lazanyi"],
    "the Fresnel term F",
);
const COLOUR: Parameter = Parameter::reflectance("", "");
/// Of `schlick`, `cook`, `f82-tint` and `lazanyi`.
pub(super) const F0: Parameter =
    Parameter::reflectance("f0", "the reflectance at normal incidence").or(Value::Colour([0.04; 3]));
/// Of `schlick`.
pub(super) const F90: Parameter =
    Parameter::reflectance("f90", "schlick: the reflectance at grazing incidence").or(Value::Colour([1.0; 3]));
/// Of `f82-tint`.
pub(super) const TINT: Parameter =
    Parameter::reflectance("tint", "f82-tint: what remains at 82°").or(Value::Colour([1.0; 3]));
/// Of `lazanyi`.
pub(super) const A: Parameter = Parameter {
    name: "lazanyi-a",
    kind: crate::Kind::Colour { max: 4.0 },
    doc: "lazanyi: the factor of the error term",
    ..COLOUR
}
.or(Value::Colour([0.0; 3]));
/// Of `lazanyi`.
pub(super) const EXPONENT: Parameter =
    Parameter::number("lazanyi-exponent", 1.0, 10.0, "lazanyi: the exponent of the error term").or(Value::Number(6.0));
/// Of `dielectric`.
pub(super) const IOR: Parameter =
    Parameter::number("ior", 1.0, 4.0, "dielectric: the index of refraction").or(Value::Number(1.5));
/// Of `conductor`.
pub(super) const METAL: Parameter = Parameter::choice("metal", METALS, "conductor: a metal, or its own eta and k");
/// Of `conductor`.
pub(super) const ETA: Parameter = Parameter {
    name: "eta",
    kind: crate::Kind::Colour { max: 4.0 },
    doc: "conductor: the index of refraction",
    ..COLOUR
}
.or(Value::Colour([1.5; 3]));
/// Of `conductor`.
pub(super) const K: Parameter = Parameter {
    name: "k",
    kind: crate::Kind::Colour { max: 10.0 },
    doc: "conductor: the extinction coefficient",
    ..COLOUR
}
.or(Value::Colour([3.0; 3]));
/// Of `gulbrandsen`.
pub(super) const REFLECTIVITY: Parameter =
    Parameter::reflectance("reflectivity", "gulbrandsen: the reflectance at normal incidence, r")
        .or(Value::Colour([0.9; 3]));
/// Of `gulbrandsen`.
pub(super) const EDGE_TINT: Parameter =
    Parameter::reflectance("edge-tint", "gulbrandsen: the tint of the edge, g").or(Value::Colour([0.5; 3]));

const CUSTOM: &str = "custom";
const METALS: &[&str] = &[
    CUSTOM,
    "gold",
    "silver",
    "copper",
    "aluminium",
    "iron",
    "titanium",
    "chromium",
    "nickel",
    "platinum",
    "tungsten",
];

/// The form that the parameters name.
pub(super) fn any_fresnel<R: Number>(p: &Reader<'_, R>) -> AnyFresnel<R> {
    match p.choice(FORM.name) {
        "dielectric" => AnyFresnel::Dielectric(Dielectric::new(Ior(p.number(IOR.name)))),
        "conductor" => AnyFresnel::Conductor(conductor(p)),
        "cook" => AnyFresnel::Cook(CookFresnel::new(p.rgb(F0.name))),
        "f82-tint" => AnyFresnel::F82Tint(F82Tint::new(p.rgb(F0.name), p.rgb(TINT.name))),
        "gulbrandsen" => AnyFresnel::Gulbrandsen(Gulbrandsen::new(p.rgb(REFLECTIVITY.name), p.rgb(EDGE_TINT.name))),
        "lazanyi" => AnyFresnel::Lazanyi(Lazanyi::new(p.rgb(F0.name), p.rgb(A.name), p.number(EXPONENT.name))),
        _ => AnyFresnel::Schlick(Schlick::with_f90(p.rgb(F0.name), p.rgb(F90.name))),
    }
}

fn conductor<R: Number>(p: &Reader<'_, R>) -> Conductor<R> {
    let name = p.choice(METAL.name);
    match metals::METALS.iter().find(|metal| metal.name == name) {
        Some(metal) => metal.conductor(R::from_f64(1.0)),
        None => Conductor::new(p.rgb(ETA.name), p.rgb(K.name)),
    }
}

/// By how much the relative error of the form may exceed a constant, for the worst of its channels.
///
/// Where a form subtracts, the error is that of what it subtracts from. For a conductor with `η < 1` and little
/// extinction, `p = η² − sin²θ − k²` has an absolute error of at most `6u (1 + k²)`, so that `|δw| ≤ 3u (1 + k²)/|w|`;
/// from `Rs = |c − w|²/|c + w|²` follows `|δRs/Rs| ≤ 2 |δw| (1/|c − w| + 1/|c + w|) ≤ 4 |δw| (c + |w|)/|c² − w²|` with
/// `c² − w² = 1 − (η + ik)²`, and `Rp/Rs`, which is at most 1, has an absolute error of at most `4 |δw|/|w|`.
pub(super) fn excess(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let sum = l + v;
    let at = Incidence::from_cos((sum.length_squared().sqrt() / 2.0).min(1.0));
    let f = any_fresnel(p).fresnel(at);
    // A fifth power of 1 − cos θ is all that a channel with f0 = 0 has near the normal; a sharp peak of D lifts it from
    // where its factors are subnormal.
    if [f.r, f.g, f.b].iter().any(|f| (f64::MIN_POSITIVE..1e-30).contains(f)) {
        return f64::INFINITY;
    }
    // F82-tint and Lazányi are a difference. Its second part is a product of the cosine and of a power of what is left to
    // 1, `sin²/(1 + cos)`: that has 10u, five of the square of `l − v`, one of the denominator, four of a division that is
    // shared; and the power so many times as much. The cosine has 4u, the factor 7u, the first part 8u, and the difference
    // is rounded.
    let of_schlick = |a: Rgb<f64>, exponent: f64| {
        let schlick = Schlick::new(p.rgb(F0.name)).fresnel(at);
        let error = (20.0 + 10.0 * exponent) * U;
        largest(
            [(schlick.r.max(a.r), f.r), (schlick.g.max(a.g), f.g), (schlick.b.max(a.b), f.b)]
                .map(|(s, f)| error * s / f),
        )
    };
    match p.choice(FORM.name) {
        "f82-tint" => of_schlick(Rgb::splat(0.0), 6.0),
        "lazanyi" => {
            let exponent = p.number(EXPONENT.name);
            of_schlick(p.rgb(A.name) * (at.cos * at.one_minus_cos.powf(exponent)), exponent)
        }
        "conductor" => {
            let conductor = conductor(p);
            let (eta, k) = (<[f64; 3]>::from(conductor.eta()), <[f64; 3]>::from(conductor.k()));
            let channel = |(eta, k): (f64, f64)| {
                if eta >= 1.0 || k >= 1.0 {
                    return 0.0;
                }
                let index2 = (eta * eta - k * k, 2.0 * eta * k);
                let w2 = (index2.0 - at.sin2).hypot(index2.1);
                let error = 12.0 * U * (1.0 + k * k);
                // There the first order says nothing.
                if w2 < 2.0 * error {
                    return f64::INFINITY;
                }
                error * ((at.cos + w2.sqrt()) / (w2.sqrt() * (1.0 - index2.0).hypot(index2.1)) + 1.0 / w2)
            };
            largest([(eta[0], k[0]), (eta[1], k[1]), (eta[2], k[2])].map(channel))
        }
        _ => 0.0,
    }
}

/// The largest; infinite if one is not a number.
fn largest(of: [f64; 3]) -> f64 {
    of.into_iter().fold(0.0, |a, b| {
        if b <= a {
            a
        } else if b.is_nan() {
            f64::INFINITY
        } else {
            b
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_are_the_metals() {
        let names: Vec<_> = metals::METALS.iter().map(|metal| metal.name).collect();
        assert_eq!(METALS.split_first(), Some((&CUSTOM, names.as_slice())));
    }
}
