//! Beckmann: `D = exp(−t)/(π αx αy h.z⁴)`, `t = (h.x²/αx² + h.y²/αy²)/h.z²`.

use super::{Distribution, SmithLambda, Widths};
use crate::Alpha;
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;

/// Beckmann, slopes that are normally distributed: `D = exp(−t)/(π αx αy h.z⁴)`, `t = (h.x²/αx² + h.y²/αy²)/h.z²`.
///
/// Beckmann and Spizzichino, *The Scattering of Electromagnetic Waves from Rough Surfaces*, 1963; Cook and Torrance,
/// "A Reflectance Model for Computer Graphics", SIGGRAPH 1981, without their factor 1/π; Walter et al. 2007,
/// equation 25.
///
/// Domain: `α ∈ [1e-4, 1]`. Error against `f64`, `u = 2⁻²⁴`: `|δD/D| ≤ u (15 + 10 t)`, where the exponential multiplies
/// the error of its argument; with `L = |ln(D/D_max)|` this is at most `u (41 + 20 L)`, since `t − 2 ln(1 + t)` is above
/// `t/2 − 1.3`. `D` is 0 where `exp(−t)` is below 2⁻¹²⁶. `G₁` is within 1e-6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beckmann<R = f32> {
    widths: Widths<R>,
}

carry!([] Beckmann<f32> => Beckmann<S> { widths });

impl<R: Real> Beckmann<R> {
    /// The isotropic distribution; `α` is the `m` of Cook and Torrance.
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
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Beckmann<S> {
        Beckmann::anisotropic(self.widths.x.map(&f), self.widths.y.map(&f))
    }
}

impl<R: Real> Distribution<R> for Beckmann<R> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        let z2 = h.z.squared();
        let t = self.widths.stretched(h) / z2;
        // For α ≤ 1 such a t leaves z² above 1/101, and beyond it exp(−t) is 0 in f32. Without the select the quotient
        // is 0/0 towards the horizon, where z⁴ underflows.
        let visible = t.lt(t.lift(100.0));
        let value = self.widths.peak * t.times(-core::f64::consts::LOG2_E).exp2_where(visible) / z2.squared();
        R::select(visible, value, t.lift(0.0))
    }

    /// By slopes, with one division: `exp(−t) (|s|²/s.z²)²/(π αx αy)`, `t = (s.x/(αx s.z))² + (s.y/(αy s.z))²`.
    #[inline(always)]
    fn d_along(&self, s: Vec3<R>, length2: R) -> R {
        let r = s.z.recip();
        let (x, y) = (s.x * r, s.y * r);
        let t = self.widths.stretched(Vec3::new(x, y, r));
        let visible = t.lt(t.lift(100.0));
        let value = self.widths.peak * t.times(-core::f64::consts::LOG2_E).exp2_where(visible);
        R::select(visible, value * (length2 * r * r).squared(), t.lift(0.0))
    }
}

impl<R: Real> SmithLambda<R> for Beckmann<R> {
    /// `Λ cos θ = s/2 · (exp(−a²)/√π − a erfc a)` with `s = √((αx w.x)² + (αy w.y)²)` and `a = cos θ/s`.
    ///
    /// This is `Λ = (erf a − 1 + exp(−a²)/(a √π))/2` (Smith 1967; in this form Walter et al. 2007 and Heitz 2014) times
    /// the cosine, without the pole of `1/a` at the horizon. What cancels for large `a` is below an ulp of the cosine
    /// that it is added to.
    #[inline(always)]
    fn lambda_cos(&self, w: Vec3<R>) -> R {
        let s = self.widths.shrunk(w).sqrt();
        // At normal incidence s is 0 and a infinite, and ∞ · erfc ∞ would be NaN. At 10 both terms are below 1e-44.
        let a = (w.z / s).min(s.lift(10.0));
        let difference = (-a.squared()).exp().times(core::f64::consts::FRAC_2_SQRT_PI * 0.5) - a * a.erfc();
        // Rounded, the difference may be an ulp below 0, and G₁ above 1.
        s.times(0.5) * difference.max(a.lift(0.0))
    }
}
