//! V-cavities: `G = min(1, 2 (n·h)(n·v)/(l·h), 2 (n·h)(n·l)/(l·h))`.

use super::{MAX_VISIBILITY, Masking};
use crate::number::{Quotient, Real};
use crate::vector::Vec3;

/// V-cavities, long grooves with equal and opposite sides: `G = min(1, 2 (n·h)(n·v)/(l·h), 2 (n·h)(n·l)/(l·h))`.
///
/// Torrance and Sparrow, "Theory for Off-Specular Reflection from Roughened Surfaces", 1967; in this form Blinn 1977
/// and Cook and Torrance 1981. It does not depend on the distribution, and has an edge where one term passes into
/// another.
///
/// Between opposite directions at the horizon `G` stays 1, and `V = 1/(4 (n·l)(n·v))` has no limit. It ends at 2¹⁰⁰,
/// that is where the cosines multiply to less than 2e-31: see [`MAX_VISIBILITY`](super::MAX_VISIBILITY).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VCavity;

impl<R: Real, D> Masking<R, D> for VCavity {
    #[inline(always)]
    fn quotient(&self, _distribution: &D, l: Vec3<R>, v: Vec3<R>, h: Vec3<R>, cos_d: R, weight: R) -> Quotient<R> {
        let (n_dot_l, n_dot_v) = (l.z.times(R::SCALE), v.z.times(R::SCALE));
        // G/(4 (n·l)(n·v)) of each term; the one with the larger cosine below is the smaller of the two.
        let open = weight.lift(0.25 * R::SCALE * R::SCALE) / (n_dot_l * n_dot_v);
        let masked = h.z.times(0.5 * R::SCALE) / (cos_d * n_dot_l.max(n_dot_v));
        Quotient::whole(weight * open.min(masked).min(weight.lift(MAX_VISIBILITY)))
    }
}
