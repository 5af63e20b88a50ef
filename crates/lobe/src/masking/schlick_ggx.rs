//! Schlick: `G₁ = cos θ/(cos θ (1 − k) + k)`.

use super::Masking;
use crate::Alpha;
use crate::carry::carry;
use crate::number::{Quotient, Real};
use crate::vector::Vec3;

/// Schlick's masking, light and viewer apart: `G₁ = cos θ/(cos θ (1 − k) + k)`, with one of three published `k`.
///
/// Schlick, "An Inexpensive BRDF Model for Physically-Based Rendering", 1994, equation 19.
///
/// Error of `V` against [`SmithSeparable`](super::SmithSeparable) with GGX: at cosines from 0.1 on it is too small by
/// at most
///
/// | `α` | [`half`](Self::half) | [`remapped`](Self::remapped) | [`schlick`](Self::schlick), against Beckmann's |
/// |---|---|---|---|
/// | 0.01 | 8 % | 82 % | 13 % |
/// | 0.1 | 31 % | 83 % | 64 % |
/// | 0.3 | 25 % | 69 % | 79 % |
/// | 0.6 | 14 % | 40 % | 82 % |
/// | 1 | 0 | 0 | 83 % |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchlickGgx<R = f32> {
    k: R,
}

carry!([] SchlickGgx<f32> => SchlickGgx<S> { k });

impl<R: Real> SchlickGgx<R> {
    /// `k = α/2`: the fit to GGX. Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013 course, for image-based light.
    #[inline(always)]
    pub fn half(alpha: Alpha<R>) -> Self {
        Self { k: alpha.0.times(0.5) }
    }

    /// `k = (r + 1)²/8` with the perceptual roughness `r = √α`: Karis 2013, for lights, "to reduce hotness".
    #[inline(always)]
    pub fn remapped(alpha: Alpha<R>) -> Self {
        Self { k: alpha.0.sqrt().plus(1.0).squared().times(0.125) }
    }

    /// `k = √(2α²/π)`: Schlick 1994, fitted to Smith's function of Beckmann.
    #[inline(always)]
    pub fn schlick(alpha: Alpha<R>) -> Self {
        Self { k: alpha.0.times(0.797_884_560_802_865_4) }
    }

    /// `k`.
    #[inline(always)]
    pub fn k(&self) -> R {
        self.k
    }

    /// The same masking in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> SchlickGgx<S> {
        SchlickGgx { k: f(self.k) }
    }
}

impl<R: Real, D> Masking<R, D> for SchlickGgx<R> {
    #[inline(always)]
    fn quotient(&self, _distribution: &D, l: Vec3<R>, v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> Quotient<R> {
        let factor = |cos: R| cos.mul_add(cos.lift(1.0) - self.k, self.k);
        Quotient::new(weight.times(0.25), factor(l.z) * factor(v.z))
    }
}
