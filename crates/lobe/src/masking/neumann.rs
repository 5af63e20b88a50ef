//! Neumann: `G = (n·l)(n·v)/max(n·l, n·v)`.

use super::Masking;
use crate::number::{Quotient, Real};
use crate::vector::Vec3;

/// The masking of Neumann's metals: `G = (n·l)(n·v)/max(n·l, n·v)`, the smaller of the cosines.
///
/// Neumann, Neumann and Szirmay-Kalos, "Compact Metallic Reflectance Models", Computer Graphics Forum 18(3), 1999.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Neumann;

impl<R: Real, D> Masking<R, D> for Neumann {
    #[inline(always)]
    fn quotient(&self, _distribution: &D, l: Vec3<R>, v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> Quotient<R> {
        Quotient::new(weight.times(0.25 * R::SCALE), l.z.max(v.z).times(R::SCALE))
    }
}
