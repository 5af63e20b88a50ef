//! GGX: `D = 1/(π αx αy (h.x²/αx² + h.y²/αy² + h.z²)²)`.

use crate::carry::carry;
use super::{Distribution, SmithLambda, Widths};
use crate::Alpha;
use crate::number::Real;
use crate::vector::Vec3;

/// GGX, the distribution of an ellipsoid's normals: `D = 1/(π αx αy (h.x²/αx² + h.y²/αy² + h.z²)²)`.
///
/// Trowbridge and Reitz, "Average Irregularity Representation of a Rough Surface for Ray Reflection", 1975; Walter,
/// Marschner, Li and Torrance, "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, equation 33;
/// anisotropic: Burley, "Physically Based Shading at Disney", 2012, appendix B; `Λ`: Heitz 2014, equations 72 and 86.
///
/// ```
/// use lobe::{Alpha, Vec3};
/// use lobe::distribution::{Distribution, Ggx};
/// // At the peak 1/(π α²).
/// let d = Ggx::new(Alpha(0.5_f32)).d(Vec3::new(0.0, 0.0, 1.0));
/// assert!((d - 4.0 / core::f32::consts::PI).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx<R = f32> {
    widths: Widths<R>,
}

carry!([] Ggx<f32> => Ggx<S> { widths });

impl<R: Real> Ggx<R> {
    /// The isotropic distribution.
    #[inline(always)]
    pub fn new(alpha: Alpha<R>) -> Self {
        Self::anisotropic(alpha, alpha)
    }

    /// The distribution with one width along the tangent and one along the bitangent.
    #[inline(always)]
    pub fn anisotropic(x: Alpha<R>, y: Alpha<R>) -> Self {
        Self { widths: Widths::new(x, y) }
    }

    /// `αx` and `αy`.
    #[inline(always)]
    pub fn alpha(&self) -> (Alpha<R>, Alpha<R>) {
        (self.widths.x, self.widths.y)
    }

    /// The same distribution in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Ggx<S> {
        Ggx::anisotropic(self.widths.x.map(&f), self.widths.y.map(&f))
    }
}

impl<R: Real> Distribution<R> for Ggx<R> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        self.widths.peak / (self.widths.stretched(h) + h.z.squared()).squared()
    }
}

impl<R: Real> SmithLambda<R> for Ggx<R> {
    /// `Λ cos θ = (√(cos²θ + (αx w.x)² + (αy w.y)²) − cos θ)/2`, in the form without the difference.
    #[inline(always)]
    fn lambda_cos(&self, w: Vec3<R>) -> R {
        let shrunk = self.widths.shrunk(w);
        shrunk.times(0.5) / ((shrunk + w.z.squared()).sqrt() + w.z)
    }
}
