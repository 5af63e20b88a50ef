//! The two power lobes, `(r·v)^q` around the mirror direction and `(n·h)^q` around the half vector, in the forms that
//! keep their digits at every exponent.
//!
//! Near its peak a cosine is 1 less a small number, and a rounded cosine has lost that number: for `q = 10⁶` the lobe
//! is 1e-3 wide, where `1 − cos` is 5e-7, eight units in the last place of `f32`. So the lobes are computed from the
//! *distance* from the peak, which small differences of the inputs give exactly:
//!
//! - `(n·h)^q = 2^(−q/2 · log₂(1 + |n × h|²/(n·h)²))`: no cancellation anywhere;
//! - `(r·v)^q = 2^(q · log₂(1 − |r − v|²/2))`: none near the peak; towards `r·v = 0` the dot product itself cancels,
//!   as any dot product does.
//!
//! `docs/numerics.md` derives the bounds.

use super::{both_above, keep_nan};
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;

/// The exponent `q` of a cosine lobe. Domain: `[0, 10⁶]`.
///
/// A type of its own, because a roughness given for it (or the reverse) is plausible and wrong.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Shininess<R = f32>(pub R);

carry!([] Shininess<f32> => Shininess<S> { 0 });

impl<R> Shininess<R> {
    /// The same exponent in another number type.
    #[inline(always)]
    pub fn map<S>(self, f: impl Fn(R) -> S) -> Shininess<S> {
        Shininess(f(self.0))
    }
}

/// `(n·h)^q` from `|n × s|²` and `(n·s)²`, where `s = l + v` of any scale; 0 where the mask is false. A NaN is lost.
#[inline(always)]
pub(crate) fn half_vector_power<R: Real>(sin2: R, cos2: R, q: R, mask: R::Mask) -> R {
    (q.times(-0.5) * sin2.log2_1p_div(cos2)).exp2_where(mask)
}

/// `(r·v)^q` from `|r − v|²/2 = 1 − r·v`; 0 where that is not below 1 or the mask is false. A NaN is lost.
#[inline(always)]
pub(crate) fn mirror_power<R: Real>(one_minus_cos: R, q: R, mask: R::Mask) -> R {
    let one = q.lift(1.0);
    (q * (-one_minus_cos).log2_1p_div(one)).exp2_where(mask & one_minus_cos.lt(one))
}

/// `(n·h)^q` in the local frame where both directions are above the horizon, else 0 or NaN.
#[inline(always)]
pub(crate) fn half_vector_lobe<R: Real>(l: Vec3<R>, v: Vec3<R>, q: R) -> R {
    // Grazing cosines down to 1e-20 have squares below the range of f32. Without the scale `(n·h)^q` is wrong in the first
    // digit there (test `grazing_needs_the_scale`).
    let s = (l + v) * q.lift(R::COSINE_SCALE);
    // Squares and no products: an interval knows that they are not negative.
    let (sin2, cos2) = (s.x.squared() + s.y.squared(), s.z.squared().off_zero());
    keep_nan(l, v, half_vector_power(sin2, cos2, q, both_above(l, v)))
}

/// `max(0, r·v)^q` in the local frame, where the mirror direction of `l` is `(−l.x, −l.y, l.z)`, and where both
/// directions are above the horizon; else 0 or NaN. It is 0 wherever `r·v ≤ 0`, for `q = 0` too.
#[inline(always)]
pub(crate) fn mirror_lobe<R: Real>(l: Vec3<R>, v: Vec3<R>, q: R) -> R {
    let distance2 = (l.x + v.x).squared() + (l.y + v.y).squared() + (l.z - v.z).squared();
    keep_nan(l, v, mirror_power(distance2.times(0.5), q, both_above(l, v)))
}
