//! Schlick: `F = f0 + (f90 − f0)(1 − cos θ)⁵`.

use crate::carry::carry;
use super::{Fresnel, Incidence, at_most_one, fifth_power};
use crate::color::Rgb;
use crate::number::Real;

/// Schlick's approximation: `F = f0 + (f90 − f0)(1 − cos θ)⁵`.
///
/// Schlick, "An Inexpensive BRDF Model for Physically-Based Rendering", 1994, equation 15, where `f90` is 1.
///
/// Computed as `f0 · (1 − x⁵) + f90 · x⁵`, `x = 1 − cos θ`, with `1 − x⁵ = cos θ (1 + x + x² + x³ + x⁴)`: the difference
/// `f90 − f0` would leave `f90 < f0` without digits near grazing.
///
/// Domain: `f0`, `f90` in `[0, 1]`. Error against `f64` of the same inputs: 1e-6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schlick<R = f32> {
    f0: Rgb<R>,
    f90: Rgb<R>,
}

carry!([] Schlick<f32> => Schlick<S> { f0, f90 });

impl<R: Real> Schlick<R> {
    /// The form with `f90 = 1`.
    #[inline(always)]
    pub fn new(f0: Rgb<R>) -> Self {
        Self::with_f90(f0, Rgb::splat(f0.r.lift(1.0)))
    }

    /// The form with a reflectance at grazing incidence of its own.
    #[inline(always)]
    pub fn with_f90(f0: Rgb<R>, f90: Rgb<R>) -> Self {
        Self { f0, f90 }
    }

    /// The same form in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Schlick<S> {
        Schlick::with_f90(self.f0.map(&f), self.f90.map(&f))
    }
}

impl<R: Real> Fresnel<R> for Schlick<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        let x = incidence.one_minus_cos();
        let x2 = x.squared();
        let x4 = x2.squared();
        let normal = incidence.cos * ((x.plus(1.0) + x2 * x.plus(1.0)) + x4);
        (self.f0 * normal + self.f90 * (x4 * x)).map(at_most_one)
    }

    /// `(1 − f0)(1 − x⁵) + (1 − f90) x⁵`, with `1 − x⁵ = cos θ (1 + x + x² + x³ + x⁴)`: nothing cancels towards grazing
    /// incidence.
    #[inline(always)]
    fn transmitted(&self, incidence: Incidence<R>) -> Rgb<R> {
        let (x, one) = (incidence.one_minus_cos(), incidence.cos.lift(1.0));
        let x5 = fifth_power(x);
        let one_minus_x5 = incidence.cos * (one + x * (one + x * (one + x * (one + x))));
        (Rgb::splat(one) - self.f0) * one_minus_x5 + (Rgb::splat(one) - self.f90) * x5
    }
}
