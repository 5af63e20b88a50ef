//! Schlick: `F = f0 + (1 − f0)(1 − cos θ)⁵`.

use super::{Fresnel, Incidence, at_most_one, fifth_power};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;

/// Schlick's approximation: `F = f0 + (1 − f0)(1 − cos θ)⁵`.
///
/// Schlick, "An Inexpensive BRDF Model for Physically-Based Rendering", 1994, equation 15. For another reflectance at
/// grazing incidence than 1 there is [`SchlickF90`].
///
/// Domain: `f0` in `[0, 1]`. Error against `f64` of the same inputs: 1e-6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schlick<R = f32> {
    f0: Rgb<R>,
    /// `1 − f0`.
    rest: Rgb<R>,
}

carry!([] Schlick<f32> => Schlick<S> { f0, rest });

impl<R: Real> Schlick<R> {
    /// The form with this reflectance at normal incidence.
    #[inline(always)]
    pub fn new(f0: Rgb<R>) -> Self {
        Self {
            f0,
            rest: f0.map(
                #[inline(always)]
                |f0| f0.lift(1.0) - f0,
            ),
        }
    }

    /// The form with a reflectance at grazing incidence of its own.
    #[inline(always)]
    pub fn with_f90(f0: Rgb<R>, f90: Rgb<R>) -> SchlickF90<R> {
        SchlickF90 { f0, f90 }
    }

    /// The same form in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Schlick<S> {
        Schlick::new(self.f0.map(f))
    }
}

impl<R: Real> Fresnel<R> for Schlick<R> {
    /// At most 1 without a bound: with `d = 1 − f0` rounded and `x ≤ 1`, `f0 + d x⁵` is at most `f0 + d`, which is 1
    /// but for a quarter of its last place, and rounds to it (test `inside_the_unit_interval`).
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        let x5 = fifth_power(incidence.one_minus_cos);
        super::zip(
            self.f0,
            self.rest,
            #[inline(always)]
            |f0, rest| rest.mul_add(x5, f0),
        )
    }

    /// `(1 − f0)(1 − x⁵)`, with `1 − x⁵ = cos θ (1 + x + x² + x³ + x⁴)`: nothing cancels towards grazing incidence.
    #[inline(always)]
    fn transmitted(&self, incidence: Incidence<R>) -> Rgb<R> {
        self.rest * one_minus_fifth_power(incidence)
    }
}

/// Schlick's approximation with a reflectance at grazing incidence: `F = f0 + (f90 − f0)(1 − cos θ)⁵`.
///
/// Computed as `f0 · (1 − x⁵) + f90 · x⁵`, `x = 1 − cos θ`, with `1 − x⁵ = cos θ (1 + x + x² + x³ + x⁴)`: the difference
/// `f90 − f0` would leave `f90 < f0` without digits near grazing.
///
/// Domain: `f0`, `f90` in `[0, 1]`. Error against `f64` of the same inputs: 1e-6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchlickF90<R = f32> {
    f0: Rgb<R>,
    f90: Rgb<R>,
}

carry!([] SchlickF90<f32> => SchlickF90<S> { f0, f90 });

impl<R: Real> SchlickF90<R> {
    /// The same form in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> SchlickF90<S> {
        Schlick::with_f90(self.f0.map(&f), self.f90.map(&f))
    }
}

impl<R: Real> Fresnel<R> for SchlickF90<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        let x5 = fifth_power(incidence.one_minus_cos);
        let normal = self.f0 * one_minus_fifth_power(incidence);
        super::zip(
            self.f90,
            normal,
            #[inline(always)]
            |f90, normal| at_most_one(f90.mul_add(x5, normal)),
        )
    }

    /// `(1 − f0)(1 − x⁵) + (1 − f90) x⁵`: nothing cancels towards grazing incidence.
    #[inline(always)]
    fn transmitted(&self, incidence: Incidence<R>) -> Rgb<R> {
        let one = Rgb::splat(incidence.cos.lift(1.0));
        (one - self.f0) * one_minus_fifth_power(incidence) + (one - self.f90) * fifth_power(incidence.one_minus_cos)
    }
}

/// `1 − x⁵`, `x = 1 − cos θ`, to the last digits at every angle.
#[inline(always)]
pub(crate) fn one_minus_fifth_power<R: Real>(incidence: Incidence<R>) -> R {
    let (x, one) = (incidence.one_minus_cos, incidence.cos.lift(1.0));
    incidence.cos * x.mul_add(x.mul_add(x.mul_add(x + one, one), one), one)
}
