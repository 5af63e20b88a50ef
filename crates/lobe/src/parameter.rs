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
