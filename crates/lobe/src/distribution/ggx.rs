//! GGX: `D = α²/(π (h.x² + h.y² + α² h.z²)²)`, and with two widths `1/(π αx αy (h.x²/αx² + h.y²/αy² + h.z²)²)`.

use super::{Distribution, SmithLambda, Widths, sum_of_squares};
use crate::Alpha;
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::{FRAC_1_PI, FRAC_2_SQRT_PI};

/// GGX, the distribution of an ellipsoid's normals: `D = α²/(π (h.x² + h.y² + α² h.z²)²)`.
///
/// Trowbridge and Reitz, "Average Irregularity Representation of a Rough Surface for Ray Reflection", 1975; Walter,
/// Marschner, Li and Torrance, "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, equation 33;
/// `Λ`: Heitz 2014, equation 72. With two widths it is [`GgxAnisotropic`].
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
    alpha: Alpha<R>,
    /// `α²`, and `α/√π`.
    alpha2: R,
    root: R,
}

carry!([] Ggx<f32> => Ggx<S> { alpha, alpha2, root });

impl<R: Real> Ggx<R> {
    /// The distribution of the width `α`.
    #[inline(always)]
    pub fn new(alpha: Alpha<R>) -> Self {
        Self { alpha, alpha2: alpha.0.squared(), root: alpha.0.times(0.5 * FRAC_2_SQRT_PI) }
    }

    /// The distribution with one width along the tangent and one along the bitangent.
    #[inline(always)]
    pub fn anisotropic(x: Alpha<R>, y: Alpha<R>) -> GgxAnisotropic<R> {
        GgxAnisotropic::new(x, y)
    }

    /// `α`.
    #[inline(always)]
    pub fn alpha(&self) -> Alpha<R> {
        self.alpha
    }

    /// The same distribution in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Ggx<S> {
        Ggx::new(self.alpha.map(f))
    }
}

impl<R: Real> Distribution<R> for Ggx<R> {
    /// `1/(π α² ((h.x/α)² + (h.y/α)² + h.z²)²)`.
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        let inverse = self.alpha.recip();
        // 1/π before the second quotient: without it binary16 ends at α = 4e-3, not at 2.2e-3.
        let peak = inverse.times(FRAC_1_PI) * inverse;
        peak / (sum_of_squares(h.x * inverse, h.y * inverse) + h.z.squared()).squared()
    }

    /// `(α/√π · |s|²/(s.x² + s.y² + (α s.z)²))²`.
    #[inline(always)]
    fn d_along(&self, s: Vec3<R>, length2: R) -> R {
        if R::NARROW {
            return self.d(s * length2.rsqrt());
        }
        let z = s.z * self.alpha.0;
        (self.root * (length2 / at_least_tiny(z.mul_add(z, sum_of_squares(s.x, s.y))))).squared()
    }
}

impl<R: Real> SmithLambda<R> for Ggx<R> {
    /// `Λ cos θ = (√(cos²θ + α² sin²θ) − cos θ)/2`, in the form without the difference.
    #[inline(always)]
    fn lambda_cos(&self, w: Vec3<R>) -> R {
        let shrunk = self.alpha2 * sum_of_squares(w.x, w.y);
        shrunk.times(0.5) / (w.z.mul_add(w.z, shrunk).sqrt() + w.z)
    }

    /// `(cos θ + √(cos²θ + α² sin²θ))/2`.
    #[inline(always)]
    fn facing(&self, w: Vec3<R>) -> R {
        (w.z + self.facing_either_way(w)).times(0.5)
    }

    /// `√(cos²θ + α² sin²θ)`, with `sin²θ = 1 − cos²θ`: what that loses near the normal is lost beside a 1. Never less
    /// than `cos θ`, so that no masking exceeds 1.
    #[inline(always)]
    fn facing_either_way(&self, w: Vec3<R>) -> R {
        let cos2 = w.z.squared();
        self.alpha2.mul_add(cos2.lift(1.0) - cos2, cos2).sqrt_of_normal()
    }
}

/// At least the smallest normal number: `(α s.z)²` of opposite directions that are both within 1e-32 of the horizon is 0,
/// and `D` would be infinite there (test `finite_to_the_last_float` of the catalogue). It keeps no digits.
#[inline(always)]
fn at_least_tiny<R: Real>(x: R) -> R {
    x.max(x.lift(R::MIN_POSITIVE))
}

/// GGX with two widths: `D = 1/(π αx αy (h.x²/αx² + h.y²/αy² + h.z²)²)`.
///
/// Burley, "Physically Based Shading at Disney", 2012, appendix B; `Λ`: Heitz 2014, equation 86.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GgxAnisotropic<R = f32> {
    widths: Widths<R>,
    /// The smaller width `m`, and `m/αx`, `m/αy`.
    smaller: R,
    share: (R, R),
    /// `m²/√(π αx αy)`.
    root: R,
}

carry!([] GgxAnisotropic<f32> => GgxAnisotropic<S> { widths, smaller, share, root });

impl<R: Real> GgxAnisotropic<R> {
    /// The distribution with one width along the tangent and one along the bitangent.
    #[inline(always)]
    pub fn new(x: Alpha<R>, y: Alpha<R>) -> Self {
        let widths = Widths::new(x, y);
        let smaller = x.0.min(y.0);
        let share = (smaller * widths.inverse.0, smaller * widths.inverse.1);
        let root = (share.0 * share.1).sqrt() * smaller.times(0.5 * FRAC_2_SQRT_PI);
        Self { widths, smaller, share, root }
    }

    /// `αx` and `αy`.
    #[inline(always)]
    pub fn alpha(&self) -> (Alpha<R>, Alpha<R>) {
        (self.widths.x, self.widths.y)
    }

    /// The same distribution in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> GgxAnisotropic<S> {
        GgxAnisotropic::new(self.widths.x.map(&f), self.widths.y.map(&f))
    }
}

impl<R: Real> Distribution<R> for GgxAnisotropic<R> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        self.widths.peak / (self.widths.stretched(h) + h.z.squared()).squared()
    }

    /// `(m²/√(π αx αy) · |s|²/((s.x m/αx)² + (s.y m/αy)² + (s.z m)²))²`, in which no square exceeds that of `s`.
    #[inline(always)]
    fn d_along(&self, s: Vec3<R>, length2: R) -> R {
        if R::NARROW {
            return self.d(s * length2.rsqrt());
        }
        let stretched = sum_of_squares(s.x * self.share.0, s.y * self.share.1);
        let z = s.z * self.smaller;
        (self.root * (length2 / at_least_tiny(z.mul_add(z, stretched)))).squared()
    }
}

impl<R: Real> SmithLambda<R> for GgxAnisotropic<R> {
    /// `Λ cos θ = (√(cos²θ + (αx w.x)² + (αy w.y)²) − cos θ)/2`, in the form without the difference.
    #[inline(always)]
    fn lambda_cos(&self, w: Vec3<R>) -> R {
        let shrunk = self.widths.shrunk(w);
        shrunk.times(0.5) / (w.z.mul_add(w.z, shrunk).sqrt() + w.z)
    }

    /// `(cos θ + √(cos²θ + (αx w.x)² + (αy w.y)²))/2`.
    #[inline(always)]
    fn facing(&self, w: Vec3<R>) -> R {
        (w.z + self.facing_either_way(w)).times(0.5)
    }

    /// `√(cos²θ + (αx w.x)² + (αy w.y)²)`.
    #[inline(always)]
    fn facing_either_way(&self, w: Vec3<R>) -> R {
        w.z.mul_add(w.z, self.widths.shrunk(w)).sqrt_of_normal()
    }
}
