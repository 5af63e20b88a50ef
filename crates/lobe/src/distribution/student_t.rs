//! Student-t: `D = (1 + t/(γ − 1))^−γ/(π αx αy h.z⁴)`, `t = (h.x²/αx² + h.y²/αy²)/h.z²`.

use super::{Distribution, Widths};
use crate::Alpha;
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;

/// Student's t, from GGX to Beckmann and beyond: `D = (1 + t/(γ − 1))^−γ/(π αx αy h.z⁴)`,
/// `t = (h.x²/αx² + h.y²/αy²)/h.z²`.
///
/// Ribardière, Bringier, Meneveaux and Simonot, "STD: Student's t-Distribution of Slopes for Microfacet Based BSDFs",
/// Computer Graphics Forum 36(2), 2017. `γ = 2` is GGX, `γ → ∞` Beckmann. It is normalised for every
/// `γ > 1`; the mean slope, and so Smith's `Λ`, is finite for `γ > 3/2`. For `γ < 2` it grows without bound towards the
/// horizon.
///
/// The slopes keep their shape when `α` stretches them, so that `Λ` depends on `γ` and on one number:
/// [`SmithTable`](super::SmithTable) holds it for anisotropic widths too.
///
/// Domain: `α ∈ [1e-4, 1]`, `γ ∈ [1.6, 40]`. Error against `f64`: within `u (20 + 10 γ)`, `u = 2⁻²⁴`; below 2⁻²⁵² of the
/// peak it is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudentT<R = f32> {
    widths: Widths<R>,
    gamma: R,
    /// `1/(γ − 1)`.
    inverse: R,
}

carry!([] StudentT<f32> => StudentT<S> { widths, gamma, inverse });

impl<R: Real> StudentT<R> {
    /// The isotropic distribution.
    #[inline(always)]
    pub fn new(alpha: Alpha<R>, gamma: R) -> Self {
        Self::anisotropic(alpha, alpha, gamma)
    }

    /// The distribution with one width along the tangent and one along the bitangent.
    #[inline(always)]
    pub fn anisotropic(x: Alpha<R>, y: Alpha<R>, gamma: R) -> Self {
        Self { widths: Widths::new(x, y), gamma, inverse: gamma.plus(-1.0).recip() }
    }

    /// `αx` and `αy`.
    #[inline(always)]
    pub fn alpha(&self) -> (Alpha<R>, Alpha<R>) {
        (self.widths.x, self.widths.y)
    }

    /// The exponent `γ`.
    #[inline(always)]
    pub fn gamma(&self) -> R {
        self.gamma
    }

    /// The same distribution in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> StudentT<S> {
        StudentT::anisotropic(self.widths.x.map(&f), self.widths.y.map(&f), f(self.gamma))
    }
}

impl<R: Real> Distribution<R> for StudentT<R> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        // With c = h.z² + stretched/(γ − 1), D = peak · (b^(γ − 2)/c)² and b = h.z/√c: no power of the cosine alone,
        // which for γ < 2 would leave the range before the quotient brings it back.
        let c = h.z.squared() + self.widths.stretched(h) * self.inverse;
        let root = (h.z / c.sqrt()).pow(self.gamma.plus(-2.0)) / c;
        self.widths.peak * root.squared()
    }
}
