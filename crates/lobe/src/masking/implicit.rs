//! Implicit: `G = (n·l)(n·v)`.

use super::Masking;
use crate::number::{Quotient, Real};
use crate::vector::Vec3;

/// The masking that cancels the denominator: `G = (n·l)(n·v)`, so that `V = 1/4`.
///
/// Named so by Hoffman, "Background: Physics and Math of Shading", SIGGRAPH 2013 course notes: whoever writes `D F/4`
/// has chosen it. It masks far too much.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Implicit;

impl<R: Real, D> Masking<R, D> for Implicit {
    #[inline(always)]
    fn quotient(&self, _distribution: &D, _l: Vec3<R>, _v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> Quotient<R> {
        Quotient::whole(weight.times(0.25))
    }
}
