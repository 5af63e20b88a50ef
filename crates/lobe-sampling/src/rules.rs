//! What all samplers have in common: the horizon, a NaN that must show, the light of a facet.

use lobe::fresnel::Incidence;
use lobe::{Real, Vec3};

/// 0, or NaN where a component of the viewer or a number of the square is NaN or infinite.
#[inline(always)]
pub(crate) fn nan_of<R: Real>(v: Vec3<R>, [x, y, z]: [R; 3]) -> R {
    ((v.x + v.y + v.z) + (x + y + z)).times(0.0)
}

/// `value` where both directions are above the horizon, 0 elsewhere, NaN where a direction holds one.
#[inline(always)]
pub(crate) fn above<R: Real>(l: Vec3<R>, v: Vec3<R>, value: R) -> R {
    let (zero, sum) = (value.lift(0.0), l + v);
    R::select(l.z.min(v.z).gt(zero), value, zero) + (sum.x + sum.y + sum.z).times(0.0)
}

/// The direction or its image in the surface, whichever is above the horizon.
#[inline(always)]
pub(crate) fn upwards<R: Real>(v: Vec3<R>) -> Vec3<R> {
    Vec3::new(v.x, v.y, v.z.abs())
}

/// The angle of incidence of a viewer on the surface, for what is asked of it below the horizon too.
#[inline(always)]
pub(crate) fn incidence_of<R: Real>(v: Vec3<R>) -> Incidence<R> {
    Incidence::of(Vec3::new(v.x, v.y, v.z.abs().min(v.z.lift(1.0))))
}

/// The direction of light for a facet of the unit normal `h`: `2 (v·h) h − v`. Above the horizon only for `v·h > 0`, if
/// `h` is.
#[inline(always)]
pub(crate) fn by_facet<R: Real>(h: Vec3<R>, v: Vec3<R>) -> Vec3<R> {
    h * h.dot(v).times(2.0) - v
}
