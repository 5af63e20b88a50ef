//! The Gaussian of Torrance and Sparrow: `D = k exp(−(δ/α)²)`, `δ` the angle of the facet.

use super::{Distribution, Widths, quadrature};
use crate::Alpha;
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;

/// The Gaussian of Torrance and Sparrow: `D = k exp(−(δ/α)²)`, where `δ` is the angle between `h` and the normal.
///
/// Torrance and Sparrow, "Theory for Off-Specular Reflection from Roughened Surfaces", JOSA 57(9), 1967,
/// `P = b exp(−c²α²)`; Blinn 1977, the distribution `D₂`. `α` here is `1/c`. Neither paper has a factor that conserves
/// area; the constructor integrates it, `1/k = π ∫ exp(−(δ/α)²) sin 2δ dδ`, to 1e-7. With two widths,
/// `1/α² = cos²φ/αx² + sin²φ/αy²`.
///
/// There is no closed form of Smith's `Λ`. Use [`SmithTable`](super::SmithTable), or what Torrance and Sparrow used,
/// [`VCavity`](crate::masking::VCavity).
///
/// Domain: `α ∈ [1e-4, 1]`. Error against `f64`, `u = 2⁻²⁴`, `L = |ln(D/D_max)|`: `|δD/D| ≤ u (24 + 20 L)`; below
/// 2⁻¹²⁶ of the peak it is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaussian<R = f32> {
    widths: Widths<R>,
    /// `k`.
    peak: R,
}

carry!([] Gaussian<f32> => Gaussian<S> { widths, peak });

impl<R: Real> Gaussian<R> {
    /// The isotropic distribution.
    #[inline]
    pub fn new(alpha: Alpha<R>) -> Self {
        let widths = Widths::new(alpha, alpha);
        Self { widths, peak: widths.peak / area(alpha.0) }
    }

    /// The distribution with one width along the tangent and one along the bitangent.
    #[inline]
    pub fn anisotropic(x: Alpha<R>, y: Alpha<R>) -> Self {
        let widths = Widths::new(x, y);
        Self {
            widths,
            peak: widths.peak
                / quadrature::mean_over_azimuth(
                    &widths,
                    #[inline(always)]
                    |a2| area(a2.sqrt()),
                ),
        }
    }

    /// `αx` and `αy`.
    #[inline(always)]
    pub fn alpha(&self) -> (Alpha<R>, Alpha<R>) {
        (self.widths.x, self.widths.y)
    }

    /// `k`, the value at the normal.
    #[inline(always)]
    pub fn peak(&self) -> R {
        self.peak
    }

    /// The same distribution in another number type, its factor computed anew there.
    #[inline]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Gaussian<S> {
        Gaussian::anisotropic(self.widths.x.map(&f), self.widths.y.map(&f))
    }
}

/// `1/(π α² k) = ∫ exp(−x²) sin(2αx)/α dx` for angles `αx` up to a right one; beyond `x = 6` there is 1e-16 of it.
#[inline]
fn area<R: Real>(alpha: R) -> R {
    let end = (alpha.lift(core::f64::consts::FRAC_PI_2) / alpha).min(alpha.lift(6.0));
    quadrature::from_zero(
        end,
        #[inline(always)]
        |x| (-x.squared()).exp() * (x * alpha).times(2.0).sin_cos().0,
    ) / alpha
}

impl<R: Real> Distribution<R> for Gaussian<R> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        let r2 = h.x.squared() + h.y.squared();
        let angle = r2.sqrt().atan2(h.z);
        // δ² (cos²φ/αx² + sin²φ/αy²). At the normal the azimuth is unknown, 0/0, and the angle is 0 anyway.
        let ratio = self.widths.stretched(h) / r2.max(r2.lift(R::MIN_POSITIVE));
        let t = angle.squared() * ratio;
        self.peak * t.times(-core::f64::consts::LOG2_E).exp2()
    }
}
