//! Blinn: `D = √((qx + 2)(qy + 2))/(2π) · h.z^((qx h.x² + qy h.y²)/(h.x² + h.y²))`.

use super::{Distribution, Widths};
use crate::Alpha;
use crate::Shininess;
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;

/// Blinn's power of a cosine: `D = (q + 2)/(2π) h.z^q`; with two exponents
/// `D = √((qx + 2)(qy + 2))/(2π) · h.z^((qx h.x² + qy h.y²)/(h.x² + h.y²))`.
///
/// Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977, the distribution `D₁`, here
/// normalised (Walter et al. 2007, equation 30); with two exponents Ashikhmin and Shirley, "An Anisotropic Phong BRDF
/// Model", 2000, as a density of facets. The width is `α = √(2/(q + 2))` (Walter et al. 2007, section 5.2):
/// the slopes near the peak are those of Beckmann's `α`, and the value there is the same `1/(π αx αy)`.
///
/// There is no closed form of Smith's `Λ`. Use [`SmithTable`](super::SmithTable); or Beckmann's by
/// [`RationalBeckmann`](crate::masking::RationalBeckmann), as Walter et al. advise.
///
/// Domain: `α ∈ [1e-4, 1]`, `q ∈ [0, 2·10⁸]`. Error against `f64`, `u = 2⁻²⁴`, `L = |ln(D/D_max)|`:
/// `|δD/D| ≤ u (8 + 20 L)`; below 2⁻¹²⁶ of the peak it is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhongPower<R = f32> {
    widths: Widths<R>,
    /// `qx/2`, `qy/2`.
    half_q: (R, R),
}

carry!([] PhongPower<f32> => PhongPower<S> { widths, half_q });

impl<R: Real> PhongPower<R> {
    /// The isotropic distribution of width `α`: `q = 2/α² − 2`.
    #[inline(always)]
    pub fn new(alpha: Alpha<R>) -> Self {
        Self::anisotropic(alpha, alpha)
    }

    /// The distribution with one width along the tangent and one along the bitangent.
    #[inline(always)]
    pub fn anisotropic(x: Alpha<R>, y: Alpha<R>) -> Self {
        // (1 − α²)/α², in a form that is exact for α near 1.
        let half_q = |a: R| (a.lift(1.0) - a) * a.plus(1.0) / a.squared();
        Self { widths: Widths::new(x, y), half_q: (half_q(x.0), half_q(y.0)) }
    }

    /// The isotropic distribution of exponent `q`.
    #[inline(always)]
    pub fn from_shininess(q: Shininess<R>) -> Self {
        let alpha = Alpha(q.0.times(0.5).plus(1.0).recip().sqrt());
        Self { half_q: (q.0.times(0.5), q.0.times(0.5)), widths: Widths::new(alpha, alpha) }
    }

    /// `αx` and `αy`.
    #[inline(always)]
    pub fn alpha(&self) -> (Alpha<R>, Alpha<R>) {
        (self.widths.x, self.widths.y)
    }

    /// The same distribution in another number type, from its widths.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> PhongPower<S> {
        PhongPower::anisotropic(self.widths.x.map(&f), self.widths.y.map(&f))
    }
}

impl<R: Real> Distribution<R> for PhongPower<R> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        // The square of a cosine of 1e-20 is below the range of f32, and its logarithm −∞: scaled, then held above 0,
        // where the logarithm of a quotient by 0 would be NaN (test `distributions_reach_the_horizon`).
        let s = h * h.x.lift(R::SCALE);
        let tiny = h.x.lift(R::MIN_POSITIVE);
        let (x2, y2) = (s.x.squared(), s.y.squared());
        let r2 = x2 + y2;
        // At the normal the azimuth is unknown, 0/0, and the logarithm is 0 anyway.
        let one_over_r2 = r2.max(tiny).recip();
        let half_q = (x2 * one_over_r2) * self.half_q.0 + (y2 * one_over_r2) * self.half_q.1;
        let exponent = -half_q * r2.log2_1p_div(s.z.squared().max(tiny));
        self.widths.peak * exponent.exp2()
    }
}
