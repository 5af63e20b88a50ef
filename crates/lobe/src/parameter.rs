//! Newtypes for parameters that are known to be mixed up, and the published ways from one to the other.

use crate::number::Real;

/// The width `α` of a microfacet distribution: the root mean square slope times √2 for Beckmann, the `α_g` of Walter et
/// al. 2007 for GGX. Domain: `[1e-4, 1]`.
///
/// A type of its own, because the *perceptual* roughness `r`, of which `α` is the square, is plausible in its place.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Alpha<R = f32>(pub R);

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
