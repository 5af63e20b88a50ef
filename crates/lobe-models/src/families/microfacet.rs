//! The microfacet model of any terms.

use super::fresnel::{self, any_fresnel};
use super::{U, constructors};
#[cfg(feature = "batch")]
use crate::batch::{AnyBatch, batched, pointwise_any};
#[cfg(feature = "batch")]
use crate::forms::AnyFresnel;
use crate::forms::{AnyMasking, AnySmith};
use crate::{Bound, Model, Number, Parameter, Reader, Terms, Value};
use lobe::distribution::{Beckmann, Distribution, Gaussian, Ggx, Gtr, PhongPower, SmithLambda, SmithTable, StudentT};
use lobe::masking::{
    Hammon, Implicit, Kelemen, Neumann, RationalBeckmann, SchlickGgx, SmithCorrelated, SmithSeparable, VCavity,
};
use lobe::{Alpha, Microfacet, Vec3};
use lobe_sampling::facets::SampleNormals;

/// The distribution by name.
const DISTRIBUTION: Parameter = Parameter::choice(
    "distribution",
    &["ggx", "beckmann", "blinn", "gtr", "gaussian", "student-t"],
    "the distribution D",
);

/// The masking by name. Those that know one width only take `√(αx αy)`.
const MASKING: Parameter = Parameter::choice(
    "masking",
    &[
        "smith-correlated",
        "smith-separable",
        "v-cavity",
        "implicit",
        "neumann",
        "kelemen",
        "hammon",
        "schlick-ggx",
        "schlick-ggx-remapped",
        "schlick-beckmann",
        "rational-beckmann",
    ],
    "the masking G",
);

const GAMMA: Parameter =
    Parameter::number("gamma", 0.5, 5.0, "the exponent γ of gtr, 2 for GGX").or(Value::Number(2.0));

const STUDENT_GAMMA: Parameter =
    Parameter::number("student-gamma", 1.6, 40.0, "the γ of student-t, 2 for GGX").or(Value::Number(3.0));

pub(super) static MODELS: &[Model] = &[Model {
    name: "microfacet",
    summary: "D F G/(4 (n·l)(n·v)) of any terms (Torrance and Sparrow 1967, Walter et al. 2007)",
    parameters: &[
        DISTRIBUTION,
        Parameter::alpha(),
        GAMMA,
        STUDENT_GAMMA,
        MASKING,
        fresnel::FORM,
        fresnel::F0,
        fresnel::F90,
        fresnel::TINT,
        fresnel::A,
        fresnel::EXPONENT,
        fresnel::IOR,
        fresnel::METAL,
        fresnel::ETA,
        fresnel::K,
        fresnel::REFLECTIVITY,
        fresnel::EDGE_TINT,
    ],
    reciprocal: true,
    finite: true,
    bound: Bound::Derived { formula: FORMULA, at: |p, l, v| Bound::WORST + fresnel::excess(p, l, v) + excess(p, l, v) },
    build: constructors!(facets: any),
}];

/// The model in a number type, a [`constructor!`](super::constructor) written out: the batch has types of its own.
mod any {
    use super::*;

    pub(super) fn terms<R: Number>(p: &Reader<'_, R>) -> Box<dyn Terms<R>> {
        let (x, y) = p.widths("alpha");
        let mean = Alpha((x.0 * y.0).sqrt());
        match p.choice(DISTRIBUTION.name) {
            "beckmann" => closed(p, Beckmann::anisotropic(x, y)),
            "blinn" => tabulated(p, PhongPower::anisotropic(x, y), || PhongPower::new(mean)),
            "gtr" => {
                let gamma = p.number(GAMMA.name);
                tabulated(p, Gtr::anisotropic(x, y, gamma), || Gtr::new(mean, gamma))
            }
            "gaussian" => tabulated(p, Gaussian::anisotropic(x, y), || Gaussian::new(mean)),
            "student-t" => {
                let gamma = p.number(STUDENT_GAMMA.name);
                tabulated(p, StudentT::anisotropic(x, y, gamma), || StudentT::new(mean, gamma))
            }
            _ => closed(p, Ggx::anisotropic(x, y)),
        }
    }

    #[cfg(feature = "batch")]
    pub(super) fn batch(p: &Reader<'_, f32>) -> AnyBatch {
        let (x, y) = p.widths("alpha");
        // A lobe whose kernels are compiled for its masking and its Fresnel term, if it is one of the common ones.
        macro_rules! common {
            ($d:expr, $($word:literal $g:ident)+) => {
                match (p.choice(MASKING.name), any_fresnel(p)) {
                    $(
                        ($word, AnyFresnel::Schlick(f)) => batched(Microfacet::new($d, $g, f)),
                        ($word, AnyFresnel::Conductor(f)) => batched(Microfacet::new($d, $g, f)),
                        ($word, AnyFresnel::Dielectric(f)) => batched(Microfacet::new($d, $g, f)),
                    )+
                    (_, f) => batched(Microfacet::new($d, any_smith(p), f)),
                }
            };
        }
        match p.choice(DISTRIBUTION.name) {
            "beckmann" => common!(Beckmann::anisotropic(x, y), "smith-correlated" SmithCorrelated),
            "blinn" | "gtr" | "gaussian" | "student-t" => pointwise_any(crate::terms::built(terms(p))),
            _ => common!(
                Ggx::anisotropic(x, y),
                "smith-correlated" SmithCorrelated
                "smith-separable" SmithSeparable
            ),
        }
    }
}

/// The model with a distribution whose `Λ` has a closed form.
fn closed<R, D>(p: &Reader<'_, R>, d: D) -> Box<dyn Terms<R>>
where
    R: Number,
    D: SmithLambda<R> + SampleNormals<R> + Send + Sync + 'static,
{
    Box::new(Microfacet::new(d, any_smith(p), any_fresnel(p)))
}

/// The model with a distribution whose `Λ` is put into a table, if the masking needs it.
fn tabulated<R, D, I>(p: &Reader<'_, R>, d: D, isotropic: impl Fn() -> I) -> Box<dyn Terms<R>>
where
    R: Number,
    D: SampleNormals<R> + Send + Sync + 'static,
    I: Distribution<R>,
{
    match any_smith(p) {
        AnySmith::Other(masking) => Box::new(Microfacet::new(d, masking, any_fresnel(p))),
        _ => {
            let (x, y) = p.widths("alpha");
            let table: SmithTable<D, R> = SmithTable::anisotropic(d, x, y, &isotropic());
            closed(p, table)
        }
    }
}

/// The masking that the parameters name.
fn any_smith<R: Number>(p: &Reader<'_, R>) -> AnySmith<R> {
    let (x, y) = p.widths("alpha");
    let mean = Alpha((x.0 * y.0).sqrt());
    AnySmith::Other(match p.choice(MASKING.name) {
        "smith-correlated" => return AnySmith::Correlated(SmithCorrelated),
        "smith-separable" => return AnySmith::Separable(SmithSeparable),
        "v-cavity" => AnyMasking::VCavity(VCavity),
        "neumann" => AnyMasking::Neumann(Neumann),
        "kelemen" => AnyMasking::Kelemen(Kelemen),
        "hammon" => AnyMasking::Hammon(Hammon::new(mean)),
        "schlick-ggx" => AnyMasking::SchlickGgx(SchlickGgx::half(mean)),
        "schlick-ggx-remapped" => AnyMasking::SchlickGgx(SchlickGgx::remapped(mean)),
        "schlick-beckmann" => AnyMasking::SchlickGgx(SchlickGgx::schlick(mean)),
        "rational-beckmann" => AnyMasking::RationalBeckmann(RationalBeckmann::anisotropic(x, y)),
        _ => AnyMasking::Implicit(Implicit),
    })
}

/// What the two excesses are, in a line.
const FORMULA: &str = "2e-5; beckmann: and 26u t, t = tan²θ_h/α²; blinn, gaussian: and 52u L of D; student-t: and 26u γ; \
                       f82-tint, lazanyi: and (20 + 10e)u S/F of Schlick's part S, e = 6 or the exponent; conductor with η, k < 1: and \
                       12u (1 + k²)((cos θ + |w|)/(|w| |1 − (η + ik)²|) + 1/|w|²), w² = (η + ik)² − sin²θ";

/// By how much the relative error of `D(h)` may exceed a constant.
///
/// With `u = 2⁻²⁴` each component of `h` is off by at most `4u`. Of the squares of two and their quotient that makes
/// `16u`, which the exponential of Beckmann multiplies with its argument `t`, beside the `10u` of its own; for Blinn and
/// the Gaussian the azimuth adds as much again; Student's t multiplies it with its exponent.
fn excess(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let (x, y) = p.widths("alpha");
    let s = l + v;
    let h = s * s.length_squared().sqrt().recip();
    let up = Vec3::new(0.0, 0.0, 1.0);
    // Below 2⁻¹²⁶ of its peak an exponential or a power is 0, and below 2⁻¹²⁶ `D` itself is subnormal, which a large
    // visibility then shows.
    let down = |d: &dyn Distribution<f64>, constant: f64, per_depth: f64| {
        let (value, depth) = (d.d(h), (d.d(up) / d.d(h)).ln());
        let known = depth < 87.0 && value > f64::from(f32::MIN_POSITIVE);
        if known { U * (constant + per_depth * depth) } else { f64::INFINITY }
    };
    let gamma = p.number(STUDENT_GAMMA.name);
    match p.choice(DISTRIBUTION.name) {
        "beckmann" => {
            let t = ((h.x / x.0).powi(2) + (h.y / y.0).powi(2)) / (h.z * h.z);
            down(&Beckmann::anisotropic(x, y), 26.0 * t, 0.0)
        }
        "blinn" => down(&PhongPower::anisotropic(x, y), 0.0, 52.0),
        "gaussian" => down(&Gaussian::anisotropic(x, y), 0.0, 52.0),
        "gtr" => down(&Gtr::anisotropic(x, y, p.number(GAMMA.name)), 0.0, 0.0),
        "student-t" => {
            // Within 1e-34 of the horizon the base of the power, h.z/√c, is subnormal.
            let c = h.z * h.z + ((h.x / x.0).powi(2) + (h.y / y.0).powi(2)) / (gamma - 1.0);
            let known = h.z / c.sqrt() > f64::from(f32::MIN_POSITIVE);
            if known { down(&StudentT::anisotropic(x, y, gamma), 26.0 * gamma, 0.0) } else { f64::INFINITY }
        }
        _ => 0.0,
    }
}
