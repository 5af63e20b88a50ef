//! F82-tint: `F = S(μ) − μ (1 − μ)⁶ S(1/7) (1 − tint)/((1/7)(6/7)⁶)`, `S` Schlick's form, `μ = cos θ`.

use super::{Fresnel, Incidence, at_least_zero, at_most_one, fifth_power, zip};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;

/// Schlick's form, multiplied by a tint at `cos θ = 1/7` (81.8°), where metals differ most from it:
/// `F = S(μ) − μ (1 − μ)⁶ S(μ₈₂)(1 − tint)/(μ₈₂ (1 − μ₈₂)⁶)` with `S(μ) = f0 + (1 − f0)(1 − μ)⁵`, `μ₈₂ = 1/7`.
///
/// Hoffman, "Fresnel Equations Considered Harmful", 2019; Kutz, Hašan and Edmondson, "Novel Aspects of the Adobe
/// Standard Material", 2021, section 2; OpenPBR Surface 1.1, "Metal". With `tint = 1` it is Schlick's.
///
/// Domain: `f0`, `tint` in `[0, 1]`. For a dark `f0` with a dark tint (below 0.136 with black) the polynomial is
/// negative between; there `F = 0`. Error against `f64` of the same inputs: 1e-6 of Schlick's part, from which the rest is
/// subtracted; relative to `F` that is 1e-6 S/F.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F82Tint<R = f32> {
    f0: Rgb<R>,
    tint: Rgb<R>,
    /// What stands before `μ (1 − μ)⁶`.
    b: Rgb<R>,
}

carry!([] F82Tint<f32> => F82Tint<S> { f0, tint, b });

impl<R: Real> F82Tint<R> {
    /// The form with reflectance `f0` at normal incidence and the tint near grazing.
    #[inline(always)]
    pub fn new(f0: Rgb<R>, tint: Rgb<R>) -> Self {
        let b = zip(
            f0,
            tint,
            #[inline(always)]
            |f0, tint| {
                let one = f0.lift(1.0);
                (f0 + (one - f0).times(REMAINING_5)) * (one - tint).times(1.0 / (MU * REMAINING_5 * (1.0 - MU)))
            },
        );
        Self { f0, tint, b }
    }

    /// The same form in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> F82Tint<S> {
        F82Tint::new(self.f0.map(&f), self.tint.map(&f))
    }
}

impl<R: Real> Fresnel<R> for F82Tint<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        let x = incidence.one_minus_cos;
        let x5 = fifth_power(x);
        let bump = incidence.cos * (x5 * x);
        zip(
            self.f0,
            self.b,
            #[inline(always)]
            |f0, b| {
                let schlick = f0 + (f0.lift(1.0) - f0) * x5;
                at_least_zero(at_most_one(schlick - b * bump))
            },
        )
    }
}

/// `cos θ` of the tint.
const MU: f64 = 1.0 / 7.0;
/// `(1 − μ)⁵`.
const REMAINING_5: f64 = 7776.0 / 16807.0;
