//! Neumann: `G = (n·l)(n·v)/max(n·l, n·v)`.

use super::Masking;
use crate::number::Real;
use crate::vector::Vec3;

/// The masking of Neumann's metals: `G = (n·l)(n·v)/max(n·l, n·v)`, the smaller of the cosines.
///
/// Neumann, Neumann and Szirmay-Kalos, "Compact Metallic Reflectance Models", Computer Graphics Forum 18(3), 1999.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Neumann;

impl<R: Real, D> Masking<R, D> for Neumann {
    #[inline(always)]
    fn visibility(&self, _distribution: &D, l: Vec3<R>, v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> R {
        weight.times(0.25) / l.z.max(v.z)
    }
}
