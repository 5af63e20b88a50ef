//! Lazányi: `F = f0 + (1 − f0)(1 − cos θ)⁵ − a cos θ (1 − cos θ)^α`.

use super::{Fresnel, Incidence, at_least_zero, at_most_one, fifth_power, zip};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;

/// Schlick's form less the term that metals need: `F = f0 + (1 − f0)(1 − cos θ)⁵ − a cos θ (1 − cos θ)^α`.
///
/// Lazányi and Szirmay-Kalos, "Fresnel Term Approximations for Metals", WSCG 2005, where
/// `f0 = ((η − 1)² + k²)/((η + 1)² + k²)`, and `a`, `α` are fitted to the exact reflectance of each metal.
///
/// Domain: `f0 ∈ [0, 1]`, `a ∈ [0, 4]`, `α ∈ [1, 10]`. Where the difference is negative, `F = 0`. Error against `f64` of
/// the same inputs: 1e-6 of Schlick's part and of `a cos θ (1 − cos θ)^α`, the two that are subtracted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lazanyi<R = f32> {
    f0: Rgb<R>,
    a: Rgb<R>,
    alpha: R,
}

carry!([] Lazanyi<f32> => Lazanyi<S> { f0, a, alpha });

impl<R: Real> Lazanyi<R> {
    /// The form with reflectance `f0` at normal incidence, and the factor and exponent of the error term.
    #[inline(always)]
    pub fn new(f0: Rgb<R>, a: Rgb<R>, alpha: R) -> Self {
        Self { f0, a, alpha }
    }

    /// The same form in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Lazanyi<S> {
        Lazanyi::new(self.f0.map(&f), self.a.map(&f), f(self.alpha))
    }
}

impl<R: Real> Fresnel<R> for Lazanyi<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        let x = incidence.one_minus_cos;
        let x5 = fifth_power(x);
        let bump = incidence.cos * x.pow(self.alpha);
        zip(
            self.f0,
            self.a,
            #[inline(always)]
            |f0, a| {
                let schlick = f0 + (f0.lift(1.0) - f0) * x5;
                at_least_zero(at_most_one(schlick - a * bump))
            },
        )
    }
}
