//! Newtypes for parameters that are known to be mixed up, and the published ways from one to the other.

use crate::brdf::Shininess;
use crate::carry::carry;
use crate::number::Real;

/// The width `α` of a microfacet distribution: the root mean square slope times √2 for Beckmann, the `α_g` of Walter et
/// al. 2007 for GGX. Domain: `[1e-4, 1]`.
///
/// A type of its own, because the *perceptual* roughness `r`, of which `α` is the square, is plausible in its place.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Alpha<R = f32>(pub R);

carry!([] Alpha<f32> => Alpha<S> { 0 });

impl<R> Alpha<R> {
    /// The same width in another number type.
    #[inline(always)]
    pub fn map<S>(self, f: impl Fn(R) -> S) -> Alpha<S> {
        Alpha(f(self.0))
    }
}

impl<R: Real> Alpha<R> {
    /// `1/α`.
    #[inline(always)]
    pub(crate) fn recip(self) -> R {
        self.0.recip()
    }
}

/// A relative index of refraction `η`: of the far side over that of the side of the light. Domain: `[0.25, 4]`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Ior<R = f32>(pub R);

carry!([] Ior<f32> => Ior<S> { 0 });

impl<R> Ior<R> {
    /// The same index in another number type.
    #[inline(always)]
    pub fn map<S>(self, f: impl Fn(R) -> S) -> Ior<S> {
        Ior(f(self.0))
    }
}

impl<R: Real> Ior<R> {
    /// `η = (1 + √F0)/(1 − √F0)`, the index of at least 1 with this reflectance at normal incidence; infinite for 1.
    ///
    /// Cook and Torrance 1981, section 4.
    #[inline(always)]
    pub fn from_f0(f0: F0<R>) -> Self {
        let above = f0.0.sqrt().plus(1.0);
        // 1 − √F0 = (1 − F0)/(1 + √F0), which keeps its digits near 1.
        Self(above.squared() / (f0.0.lift(1.0) - f0.0))
    }
}

/// The reflectance at normal incidence. Domain: `[0, 1]`.
///
/// A type of its own, because an index of refraction, or the glTF or Disney *specular* parameter, is plausible in its
/// place.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct F0<R = f32>(pub R);

carry!([] F0<f32> => F0<S> { 0 });

impl<R> F0<R> {
    /// The same reflectance in another number type.
    #[inline(always)]
    pub fn map<S>(self, f: impl Fn(R) -> S) -> F0<S> {
        F0(f(self.0))
    }
}

impl<R: Real> F0<R> {
    /// `F0 = ((η − 1)/(η + 1))²`: Fresnel 1823. The same for `1/η`.
    #[inline(always)]
    pub fn from_ior(eta: Ior<R>) -> Self {
        Self((eta.0.plus(-1.0) / eta.0.plus(1.0)).squared())
    }
}

/// The roughness `r` that artists turn, in `[0, 1]`: of its square the lobe's width `α` is made, so that equal steps look
/// equal.
///
/// A type of its own, because `α` and `r` are given for each other in real engines to this day.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct PerceptualRoughness<R = f32>(pub R);

carry!([] PerceptualRoughness<f32> => PerceptualRoughness<S> { 0 });

impl<R> PerceptualRoughness<R> {
    /// The same roughness in another number type.
    #[inline(always)]
    pub fn map<S>(self, f: impl Fn(R) -> S) -> PerceptualRoughness<S> {
        PerceptualRoughness(f(self.0))
    }
}

impl<R: Real> PerceptualRoughness<R> {
    /// `α = r²`: Burley, "Physically Based Shading at Disney", 2012, section 5.4; glTF 2.0, appendix B.
    ///
    /// Below `r = 0.01` the width is below the domain of [`Alpha`].
    #[inline(always)]
    pub fn alpha(self) -> Alpha<R> {
        Alpha(self.0.squared())
    }

    /// `r = √α`, the way back.
    #[inline(always)]
    pub fn from_alpha(alpha: Alpha<R>) -> Self {
        Self(alpha.0.sqrt())
    }

    /// The two widths of an anisotropic lobe, `αx = max(0.001, r²/a)`, `αy = max(0.001, r² a)` with the aspect
    /// `a = √(1 − 0.9 anisotropy)`, for an anisotropy from 0 to 1.
    ///
    /// Burley 2012, section 5.4, and Disney's published code, which has the least width 0.001. It preserves the product
    /// of the widths, where neither is cut off. `αx` exceeds 1, and with it the domain of [`Alpha`], for `r² > a`.
    #[inline(always)]
    pub fn disney(self, anisotropy: R) -> (Alpha<R>, Alpha<R>) {
        let aspect = (anisotropy.lift(1.0) - anisotropy.times(0.9)).sqrt();
        let (alpha, least) = (self.0.squared(), self.0.lift(0.001));
        (Alpha((alpha / aspect).max(least)), Alpha((alpha * aspect).max(least)))
    }
}

/// The exponents `q` of the Blinn-Phong distribution `D = (q + 2)/(2π) (n·h)^q` that resemble a width `α`.
impl<R: Real> Shininess<R> {
    /// `q = 2/α² − 2`. Preserves the peak, `D(n) = 1/(π α²)`, of Beckmann and of GGX; for small `α` the whole Beckmann
    /// distribution.
    ///
    /// Walter et al. 2007, section 5.2, for Beckmann. 0 at `α = 1`; beyond the domain of `q`, 10⁶, for `α < 0.0014`.
    #[inline(always)]
    pub fn with_peak_of(alpha: Alpha<R>) -> Self {
        Self((alpha.recip().squared().plus(-1.0)).times(2.0))
    }

    /// `q = 2/α²`. Preserves the variance of the slopes, `∫ D tan²θ cosθ dω = α²`, of Beckmann; that of GGX is infinite.
    ///
    /// Blinn-Phong's is `2/q`, by integration.
    #[inline(always)]
    pub fn with_slope_variance_of(alpha: Alpha<R>) -> Self {
        Self(alpha.recip().squared().times(2.0))
    }

    /// `q = −2/log₂ cos²θ`, `sin²θ = (√2 − 1) α²/(1 − α²)`. Preserves the angle `θ` at which GGX has half of its peak.
    ///
    /// By solving `(α² cos²θ + sin²θ)² = 2 α⁴`. GGX has such an angle for `α < 2^(−1/4) = 0.84`; beyond, NaN.
    #[inline(always)]
    pub fn with_half_width_of_ggx(alpha: Alpha<R>) -> Self {
        let one = alpha.0.lift(1.0);
        let sin2 = alpha.0.squared().times(core::f64::consts::SQRT_2 - 1.0) / ((one - alpha.0) * (one + alpha.0));
        Self(alpha.0.lift(-2.0) / (-sin2).log2_1p())
    }
}

/// The widths that resemble a Blinn-Phong distribution: the inverses of the maps to [`Shininess`].
impl<R: Real> Alpha<R> {
    /// `α = √(2/(q + 2))`. Preserves the peak: see [`Shininess::with_peak_of`].
    #[inline(always)]
    pub fn with_peak_of(q: Shininess<R>) -> Self {
        Self((q.0.lift(2.0) / q.0.plus(2.0)).sqrt())
    }

    /// `α = √(2/q)`, for `q ≥ 2`. Preserves the variance of the slopes: see [`Shininess::with_slope_variance_of`].
    #[inline(always)]
    pub fn with_slope_variance_of(q: Shininess<R>) -> Self {
        Self((q.0.lift(2.0) / q.0).sqrt())
    }

    /// `α² = sin²θ/(sin²θ + √2 − 1)`, `cos²θ = 2^(−2/q)`, for GGX. Preserves the angle at which half of the peak is left:
    /// see [`Shininess::with_half_width_of_ggx`]. In `f32` an absolute error of `u` in `sin²θ ≈ 1.4/q` is one of `q u/2.8`
    /// in `α`: 2 % at `q = 10⁶`.
    #[inline(always)]
    pub fn ggx_with_half_width_of(q: Shininess<R>) -> Self {
        let cos2 = (q.0.lift(-2.0) / q.0).exp2();
        let sin2 = cos2.lift(1.0) - cos2;
        Self((sin2 / sin2.plus(core::f64::consts::SQRT_2 - 1.0)).sqrt())
    }
}
