//! Three-component vectors and the two constructions that shading is made of: [`reflect`] and [`halfway`].
//!
//! Directions point away from the surface unless the name says otherwise: `l` to the light, `v` to the viewer, `n` the
//! normal, `h` halfway between `l` and `v`.

use crate::carry::carry;
use crate::number::Real;
use core::ops::{Add, Mul, Neg, Sub};

/// A vector of three numbers: a point, a direction or a normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<R = f32> {
    /// Along the tangent, in a local frame.
    pub x: R,
    /// Along the bitangent, in a local frame.
    pub y: R,
    /// Along the normal, in a local frame: the cosine, if the vector is a direction.
    pub z: R,
}

carry!([] Vec3<f32> => Vec3<S> { x, y, z });

impl<R> Vec3<R> {
    /// The vector `(x, y, z)`.
    #[inline(always)]
    pub const fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// The same vector in another number type: `f` of each component.
    #[inline(always)]
    pub fn map<S>(self, f: impl Fn(R) -> S) -> Vec3<S> {
        Vec3 { x: f(self.x), y: f(self.y), z: f(self.z) }
    }
}

impl<R: Real> Vec3<R> {
    /// `self · other`.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        self.z.mul_add(other.z, self.y.mul_add(other.y, self.x * other.x))
    }

    /// `self × other`.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// `|self|²`. Overflows beyond 1e19 and underflows below 1e-19 in `f32`; [`length`](Self::length) does not.
    #[inline(always)]
    pub fn length_squared(self) -> R {
        self.dot(self)
    }

    /// `|self|`, from the smallest normal number to the largest, without overflow or underflow on the way.
    #[inline(always)]
    pub fn length(self) -> R {
        let (scaled, scale) = self.scaled_to_unit_range();
        scaled.length_squared().sqrt() / scale
    }

    /// `self / |self|`, for any finite vector that is not zero.
    ///
    /// Each component is within 3 ulp of the exact direction, from `|self|` = 1e-37 to 1e38. A vector whose largest
    /// component is subnormal has fewer digits to begin with. Zero gives NaN: it has no direction, and hiding that
    /// would show a plausible colour. Use [`normalize_or`](Self::normalize_or) to say what it should be.
    #[inline(always)]
    pub fn normalize(self) -> Self {
        let (scaled, _) = self.scaled_to_unit_range();
        scaled * scaled.length_squared().sqrt().recip()
    }

    /// [`normalize`](Self::normalize), or `fallback` for the zero vector.
    #[inline(always)]
    pub fn normalize_or(self, fallback: Self) -> Self {
        let size = self.size();
        Self::select(size.eq(size.lift(0.0)), fallback, self.normalize())
    }

    /// `a` where the mask is true, `b` elsewhere.
    #[inline(always)]
    pub fn select(mask: R::Mask, a: Self, b: Self) -> Self {
        Self { x: R::select(mask, a.x, b.x), y: R::select(mask, a.y, b.y), z: R::select(mask, a.z, b.z) }
    }

    /// `|x| + |y| + |z|`: NaN if any component is, 0 for the zero vector alone, and never underflows.
    #[inline(always)]
    fn size(self) -> R {
        self.x.abs() + self.y.abs() + self.z.abs()
    }

    /// `(self · s, s)` with a power of two `s` that keeps the squares of the components in range.
    ///
    /// Without it `|(1e-30, 0, 0)|²` is 0 and `|(1e30, 0, 0)|²` infinite in `f32`. A power of two, because it changes
    /// no digit: a vector of ordinary length gives the same bits as without. Subnormal components are scaled up like
    /// the others, so that no digit that they have is lost.
    #[inline(always)]
    fn scaled_to_unit_range(self) -> (Self, R) {
        // Of the components alone, not of their sum, which may overflow. A NaN may get lost here, not in the product.
        let largest = self.x.abs().max(self.y.abs()).max(self.z.abs());
        let one = largest.lift(1.0);
        // Brings [2^-149, 2^-32] into [2^-59, 2^58] and [2^32, 2^128] into [2^-34, 2^62]: squares of either are in range.
        let up = R::select(largest.lt(largest.lift(TWO_POW_MINUS_32)), largest.lift(TWO_POW_90), one);
        let scale = R::select(largest.gt(largest.lift(TWO_POW_32)), largest.lift(TWO_POW_MINUS_66), up);
        (self * scale, scale)
    }
}

const TWO_POW_32: f64 = 4294967296.0;
const TWO_POW_MINUS_32: f64 = 1.0 / TWO_POW_32;
const TWO_POW_90: f64 = TWO_POW_32 * TWO_POW_32 * 67_108_864.0;
const TWO_POW_MINUS_66: f64 = TWO_POW_MINUS_32 * TWO_POW_MINUS_32 * 0.25;

/// The direction in which a ray that arrives along `incident` leaves a mirror: `incident − 2 (incident·n) n`.
///
/// The convention of GLSL, `glam` and the lecture: `incident` points *towards* the surface. `n` is of unit length;
/// `incident` may have any, and keeps it. See [`mirror`] for directions that point away.
///
/// Applying it twice gives the input back, up to rounding: `|reflect(reflect(d, n), n) − d| ≤ 16u |d|`,
/// with `u = 2⁻²⁴` in `f32`, plus `4|d|·||n|² − 1|` for a normal that is not quite of unit length.
///
/// ```
/// use lobe::{Vec3, reflect};
/// let up = Vec3::new(0.0, 0.0, 1.0);
/// assert_eq!(reflect(Vec3::new(0.6, 0.0, -0.8), up), Vec3::new(0.6, 0.0, 0.8));
/// ```
#[inline(always)]
pub fn reflect<R: Real>(incident: Vec3<R>, n: Vec3<R>) -> Vec3<R> {
    incident - n * incident.dot(n).times(2.0)
}

/// The mirror direction of `l`, both pointing away from the surface: `2 (n·l) n − l`.
///
/// ```
/// use lobe::{Vec3, mirror};
/// let up = Vec3::new(0.0, 0.0, 1.0);
/// assert_eq!(mirror(Vec3::new(0.6, 0.0, 0.8), up), Vec3::new(-0.6, 0.0, 0.8));
/// ```
#[inline(always)]
pub fn mirror<R: Real>(l: Vec3<R>, n: Vec3<R>) -> Vec3<R> {
    n * n.dot(l).times(2.0) - l
}

/// The direction halfway between `l` and `v`: `(l + v) / |l + v|` for unit vectors.
///
/// Symmetric to the last bit: `halfway(l, v)` and `halfway(v, l)` are equal.
///
/// **Not quite unit length.** Where `l ≈ −v`, `l + v` is as small as the rounding of the lengths, and its direction is
/// noise. The true bisector is orthogonal to `d = l − v`; what the lengths have added to the sum `s = l + v` is
/// `d (s·d)/4` to first order, and it is taken out. With `|l|` and `|v|` within `ε` of 1 the result is within
/// `ε + 8u` of the exact bisector wherever that exists, `u = 2⁻²⁴` in `f32`.
///
/// **`l = −v`.** Every direction orthogonal to `l` is halfway. The result is one of them, horizontal (`z = 0`), the
/// same for either order of the arguments; `(1, 0, 0)` if `l` is along `z`. It is also the result where the
/// directions are opposite to within their rounding.
///
/// ```
/// use lobe::{Vec3, halfway};
/// let h = halfway(Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// assert_eq!(h, Vec3::new(0.0, 0.0, 1.0));
/// ```
#[inline(always)]
pub fn halfway<R: Real>(l: Vec3<R>, v: Vec3<R>) -> Vec3<R> {
    let sum = l + v;
    let difference = l - v;
    let bisector = sum - difference * sum.dot(difference).times(0.25);
    // Twice: where nearly all of the sum lay along the difference, the rounding of the first step is what is left.
    let bisector = bisector - difference * bisector.dot(difference).times(0.25);
    // What is left of a sum that lay along the difference is rounding. Without this, (1 + u) d and −d would have
    // their "bisector" along d.
    let opposite = bisector.size().le(sum.size().times(1.0 / 1_048_576.0));
    Vec3::select(opposite, perpendicular(difference), bisector.normalize())
}

/// A horizontal unit vector orthogonal to `d`, the same for `d` and `−d`; `(1, 0, 0)` if `d` is along `z`.
#[inline(always)]
fn perpendicular<R: Real>(d: Vec3<R>) -> Vec3<R> {
    let (zero, one) = (d.x.lift(0.0), d.x.lift(1.0));
    // Of the two opposite answers, the one with x > 0, or y < 0 where x = 0.
    let flip = R::select(d.y.gt(zero) | (d.y.eq(zero) & d.x.gt(zero)), -one, one);
    // Adding zero turns −0 into 0, so that either order gives the same bits.
    let horizontal = Vec3::new(-d.y * flip + zero, d.x * flip + zero, zero);
    horizontal.normalize_or(Vec3::new(one, zero, zero))
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

impl<R> From<[R; 3]> for Vec3<R> {
    #[inline(always)]
    fn from([x, y, z]: [R; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<R> From<Vec3<R>> for [R; 3] {
    #[inline(always)]
    fn from(vector: Vec3<R>) -> Self {
        [vector.x, vector.y, vector.z]
    }
}

/// `From` and `Into` for one of `glam`'s vectors.
#[cfg(feature = "glam")]
macro_rules! glam_at_the_door {
    ($scalar:ty: $($vector:ty),+) => {$(
        impl From<$vector> for Vec3<$scalar> {
            #[inline(always)]
            fn from(v: $vector) -> Self {
                Self { x: v.x, y: v.y, z: v.z }
            }
        }
        impl From<Vec3<$scalar>> for $vector {
            #[inline(always)]
            fn from(v: Vec3<$scalar>) -> Self {
                Self::new(v.x, v.y, v.z)
            }
        }
    )+};
}
#[cfg(feature = "glam")]
glam_at_the_door!(f32: glam::Vec3, glam::Vec3A);
#[cfg(feature = "glam")]
glam_at_the_door!(f64: glam::DVec3);
