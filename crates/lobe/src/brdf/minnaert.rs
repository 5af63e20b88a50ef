//! Minnaert: `f_r = ρ (k + 1)/(2π) ((n·l)(n·v))^(k−1)`.

use super::{Brdf, above_horizon};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;

/// Minnaert's law of reflection: `f_r = ρ (k + 1)/(2π) ((n·l)(n·v))^(k−1)` sr⁻¹; Lambert's for `k = 1`.
///
/// Minnaert, "The Reciprocity Principle in Lunar Photometry", Astrophysical Journal 93, 1941. The factor makes the albedo
/// at normal incidence `ρ`; at an angle `θ` it is `ρ cos^(k−1) θ`, so that for `k < 1` (limb brightening) energy is gained
/// without bound towards the horizon.
///
/// Reciprocal to the last bit. Domain: `ρ ∈ [0, 1]`, `k ∈ [0, 2]`. For `k < 1` `f_r` leaves the range of `f32` near the
/// horizon; [`eval_cos`](Brdf::eval_cos) does not. Error against `f64` of the same inputs: 1e-5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Minnaert<R = f32> {
    albedo: Rgb<R>,
    k: R,
    /// `2³¹ ρ (k + 1)/(2π)`.
    scale: Rgb<R>,
}

carry!([] Minnaert<f32> => Minnaert<S> { albedo, k, scale });

impl<R: Real> Minnaert<R> {
    /// The law of albedo `ρ` and exponent `k`.
    #[inline(always)]
    pub fn new(albedo: Rgb<R>, k: R) -> Self {
        Self { albedo, k, scale: albedo * k.plus(1.0).times(0.5 * R::ROOT_SCALE * core::f64::consts::FRAC_1_PI) }
    }

    /// The albedo `ρ` at normal incidence.
    #[inline(always)]
    pub fn albedo(&self) -> Rgb<R> {
        self.albedo
    }

    /// The exponent `k`.
    #[inline(always)]
    pub fn k(&self) -> R {
        self.k
    }

    /// The same law in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Minnaert<S> {
        Minnaert::new(self.albedo.map(&f), f(self.k))
    }

    #[inline(always)]
    fn powers(&self, l: Vec3<R>, v: Vec3<R>, exponent: R) -> Rgb<R> {
        // Powers of each, because the product of the cosines leaves the range; and by 2³¹ less, because for k near 0 that of
        // the powers leaves it at the horizon where the value, with a small ρ, does not. Of the two powers the viewer's
        // is the one that is not below 1 for k ≤ 1: the other may be so small that 2³¹ less is subnormal.
        self.scale * above_horizon(l, v, l.z.pow(exponent) * v.z.pow(self.k.plus(-1.0)).times(1.0 / R::ROOT_SCALE))
    }
}

impl<R: Real> Brdf<R> for Minnaert<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.powers(l, v, self.k.plus(-1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.powers(l, v, self.k)
    }
}
