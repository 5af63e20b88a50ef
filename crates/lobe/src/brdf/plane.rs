//! Products of two directions in the tangent plane, to the last digits.
//!
//! Rough diffuse models divide `l.x v.x + l.y v.y` by the larger cosine. Between grazing directions that is a division by
//! next to nothing, and a sum that cancels, of directions whose planes are at a right angle, would be all noise. So both
//! products are taken exactly, as sums of two (Dekker 1971), and summed with what the sum rounds off (Knuth).

use crate::number::Real;
use crate::vector::Vec3;

/// `l.x v.x + l.y v.y = sin θ_l sin θ_v cos Δφ`.
#[inline(always)]
pub(crate) fn dot<R: Real>(l: Vec3<R>, v: Vec3<R>) -> R {
    sum_of_products(l.x, v.x, l.y, v.y)
}

/// `l.x v.y − l.y v.x = sin θ_l sin θ_v sin Δφ`.
#[inline(always)]
pub(crate) fn cross<R: Real>(l: Vec3<R>, v: Vec3<R>) -> R {
    sum_of_products(l.x, v.y, -l.y, v.x)
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

/// `a b + c d`, with an error of a unit in the last place and `2u²` of the products.
#[inline(always)]
fn sum_of_products<R: Real>(a: R, b: R, c: R, d: R) -> R {
    let (p, p_rest) = product(a, b);
    let (q, q_rest) = product(c, d);
    let sum = p + q;
    let q_part = sum - p;
    let rest = (p - (sum - q_part)) + (q - q_part);
    sum + (rest + (p_rest + q_rest))
}

/// `a b`, and what its rounding lost, for numbers of at most 2.
#[inline(always)]
fn product<R: Real>(a: R, b: R) -> (R, R) {
    let p = a * b;
    let ((a_hi, a_lo), (b_hi, b_lo)) = (halves(a), halves(b));
    (p, ((a_hi * b_hi - p) + (a_hi * b_lo + a_lo * b_hi)) + a_lo * b_lo)
}

/// The upper twelve bits and the lower of an `f32` (Veltkamp). Of an `f64` the parts sum to it too, and it needs no more.
#[inline(always)]
fn halves<R: Real>(a: R) -> (R, R) {
    let c = a.times(4097.0);
    let high = c - (c - a);
    (high, a - high)
}
