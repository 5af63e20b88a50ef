//! Kelemen: `V = 1/(4 (v·h)²)`.

use super::{MAX_VISIBILITY, Masking};
use crate::number::{Quotient, Real};
use crate::vector::Vec3;

/// The masking of Kelemen and Szirmay-Kalos: `G = (n·l)(n·v)/(v·h)²`, so that `V = 1/(4 (v·h)²)`.
///
/// Kelemen and Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling",
/// Eurographics 2001: their `|l + v|²` is `4 (v·h)²`. For any distribution.
///
/// Between opposite directions at the horizon `V` has no limit. It ends at 2¹⁰⁰, that is where `v·h` is below 4e-16: see
/// [`MAX_VISIBILITY`](super::MAX_VISIBILITY).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Kelemen;

impl<R: Real, D> Masking<R, D> for Kelemen {
    #[inline(always)]
    fn quotient(&self, _distribution: &D, _l: Vec3<R>, _v: Vec3<R>, _h: Vec3<R>, cos_d: R, weight: R) -> Quotient<R> {
        // One division after the other: the square of a cosine of 1e-20 is below the range of f32.
        Quotient::whole(weight * (cos_d.lift(0.25) / cos_d / cos_d).min(cos_d.lift(MAX_VISIBILITY)))
    }
}
