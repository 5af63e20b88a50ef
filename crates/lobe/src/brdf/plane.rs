//! Products of two directions in the tangent plane, to the last digits.
//!
//! Rough diffuse models divide `l.x v.x + l.y v.y` by the larger cosine. Between grazing directions that is a division by
//! next to nothing, and a sum that cancels, of directions whose planes are at a right angle, would be all noise. So both
//! products are taken exactly: [`Real::sum_of_products`].

use crate::number::Real;
use crate::vector::Vec3;

/// `l.x v.x + l.y v.y = sin θ_l sin θ_v cos Δφ`.
#[inline(always)]
pub(crate) fn dot<R: Real>(l: Vec3<R>, v: Vec3<R>) -> R {
    R::sum_of_products((l.x, v.x), (l.y, v.y))
}

/// `l.x v.y − l.y v.x = sin θ_l sin θ_v sin Δφ`.
#[inline(always)]
pub(crate) fn cross<R: Real>(l: Vec3<R>, v: Vec3<R>) -> R {
    R::sum_of_products((l.x, v.y), (-l.y, v.x))
}

/// `sin θ`.
#[inline(always)]
pub(crate) fn sin<R: Real>(w: Vec3<R>) -> R {
    (w.x.squared() + w.y.squared()).sqrt()
}

/// `1 + sin θ_l sin θ_v cos Δφ`, for unit vectors, without the difference where the product is near −1.
#[inline(always)]
pub(crate) fn one_plus_dot<R: Real>(l: Vec3<R>, v: Vec3<R>) -> R {
    let (x, y) = (l.x + v.x, l.y + v.y);
    ((x.squared() + y.squared()) + (l.z.squared() + v.z.squared())).times(0.5)
}
