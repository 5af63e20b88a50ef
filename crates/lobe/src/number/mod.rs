//! The number types: one small trait, [`Real`], that every formula of this crate is written over.
//!
//! A model may use only what `Real` offers: arithmetic, comparisons that give a *mask*, [`select`](Real::select) and a
//! few elementary functions. It never branches on a value, never converts one to a plain float, never allocates and
//! never indexes. So the same source serves a scalar, a bundle of SIMD lanes, an interval or a recorded expression.
//!
//! # Implementing `Real`
//!
//! Mark every method `#[inline(always)]`, and override nothing that is provided unless the result stays the same:
//! one method that is left out of line costs more than the formula it stands in.

mod approximate;
mod double;
pub mod elementary;
#[cfg(feature = "half")]
mod half;
mod precision;
mod quotient;
mod single;
#[cfg(feature = "simd")]
#[allow(clippy::incompatible_msrv, reason = "the feature needs Rust 1.89, as its document says")]
mod wide;

pub use approximate::{Approximate, Coarse, Fast};
pub use elementary::Binary32;
#[cfg(feature = "half")]
pub use half::Half;
pub use precision::{Estimate, Precise, Precision, Rough};
pub use quotient::Quotient;
#[cfg(feature = "simd")]
pub use wide::{Lanes, Wide, WideMask};

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// The answer to a comparison: `bool` for a scalar, a lane mask for SIMD, a node for a recorded expression.
///
/// A mask can be combined and handed to [`Real::select`]; it cannot be branched on.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {}

impl Mask for bool {}

/// A real number, as far as shading needs one.
///
/// # Constants
///
/// A constant needs a witness: [`x.lift(c)`](Real::lift) is "the constant `c` in the shape of `x`". A static
/// conversion cannot be written for types that carry a token (SIMD levels, expression arenas), and constants are
/// `f64` so that the reference loses nothing. [`plus`](Real::plus) and [`times`](Real::times) take a constant
/// directly, so that `(q + 2) / 2π` is written `q.plus(2.0).times(1.0 / TAU)`.
///
/// # NaN
///
/// Decided once, for every number type:
///
/// - arithmetic and elementary functions hand NaN on;
/// - every comparison with NaN is false (only [`ne`](Real::ne) is true);
/// - [`max`](Real::max) and [`min`](Real::min) return the *receiver* unless the argument is strictly beyond it, so
///   `x.max(bound)` keeps a NaN in `x` and ignores one in `bound`;
/// - [`select`](Real::select) returns exactly the operand that the mask names.
///
/// So a value that must not hide NaN is written `select(z <= 0, 0, f)`, never `select(z > 0, f, 0)`.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// What a comparison gives.
    type Mask: Mask;

    /// 2³¹ in `f32`: a power of two whose fourth power is within four binary digits of the end of the range.
    ///
    /// Every type that is not `f32` or wider says its own, with [`MIN_POSITIVE`](Self::MIN_POSITIVE).
    const ROOT_SCALE: f64 = (1u64 << 31) as f64;
    /// 2⁶² in `f32`, the square of [`ROOT_SCALE`](Self::ROOT_SCALE): what formulas multiply cosines and the sums of two unit
    /// vectors with before they square them. The largest square is 2¹²⁶, and that of the smallest normal number
    /// is a normal number again. A power of two changes no digit.
    const SCALE: f64 = Self::ROOT_SCALE * Self::ROOT_SCALE;
    /// What microfacets multiply cosines and the sums of two unit vectors with: [`SCALE`](Self::SCALE). [`Approximate`] numbers
    /// save these products, a tenth of all, and have 1: they have no digits of a lobe between opposite directions that are both
    /// within 1e-18 of the horizon, where squares underflow, and stay finite there by [`off_zero`](Self::off_zero).
    const COSINE_SCALE: f64 = Self::SCALE;
    /// 2⁻¹²⁶ in `f32`, the smallest normal number: a floor for denominators that are 0 at one direction only.
    const MIN_POSITIVE: f64 = f32::MIN_POSITIVE as f64;
    /// Whether the type has so few exponents that a formula had better normalise a vector than square its squares. A
    /// choice by type, which costs nothing where it is not taken.
    const NARROW: bool = false;

    /// The constant `c`, rounded to this type and in the shape of `self` (whose value does not matter).
    fn lift(self, c: f64) -> Self;

    /// `self < other`; false if either is NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`; false if either is NaN.
    fn le(self, other: Self) -> Self::Mask;
    /// `self == other`; false if either is NaN. `-0 == +0`.
    fn eq(self, other: Self) -> Self::Mask;
    /// `a` where the mask is true, `b` elsewhere, bit for bit.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// `|self|`.
    fn abs(self) -> Self;
    /// `√self`, correctly rounded; NaN below zero.
    fn sqrt(self) -> Self;
    /// `√self` of a positive normal number: what [`Approximate`] numbers know without a look at 0.
    #[inline(always)]
    fn sqrt_of_normal(self) -> Self {
        self.sqrt()
    }
    /// `self`, the square or the product of what was multiplied with [`COSINE_SCALE`](Self::COSINE_SCALE); where that is 1, at
    /// least [`MIN_POSITIVE`](Self::MIN_POSITIVE).
    #[inline(always)]
    fn off_zero(self) -> Self {
        self
    }
    /// The magnitude of `self` with the sign bit of `sign`.
    fn copysign(self, sign: Self) -> Self;

    /// `2^self`.
    ///
    /// In `f32`: within 1 ulp. Results below the smallest normal number become 0 (see `docs/numerics.md`).
    fn exp2(self) -> Self;
    /// `log₂ self`; `-∞` at zero, NaN below.
    ///
    /// In `f32`: within 1 ulp.
    fn log2(self) -> Self;
    /// `log₂(1 + self)`, accurate for small arguments too; `-∞` at −1, NaN below.
    ///
    /// In `f32`: within 1 ulp.
    fn log2_1p(self) -> Self;
    /// `log₂(1 + self/denominator)`, for `self ≥ 0` and `denominator > 0`; for `self > −denominator` too, if the
    /// denominator is a power of two.
    ///
    /// With one division, and without forming the quotient, which may leave the range of the type: this is
    /// `log₂(1 + tan²θ)` down to the horizon. In `f32`: a relative error of at most 5·2⁻²⁴ (below 0 5.5·2⁻²⁴), for
    /// `denominator` and `self + denominator` from the smallest normal number to 2¹²⁷.
    fn log2_1p_div(self, denominator: Self) -> Self;
    /// `2^self` where the mask is true, 0 elsewhere. In `f32` a NaN in `self` gives 0 too: whoever must keep it adds
    /// it again.
    ///
    /// The last step of most lobes, where a zero is selected anyway: one select, not two.
    #[inline(always)]
    fn exp2_where(self, mask: Self::Mask) -> Self {
        Self::select(mask, self.exp2(), self.lift(0.0))
    }
    /// `self^exponent` for `self ≥ 0`; `x^0 = 1` for every `x` that is not NaN, `0^y = 0` for `y > 0`.
    ///
    /// A negative base gives NaN, whatever the exponent: shading has no use for its sign, and a NaN is seen where a
    /// plausible colour is not. In `f32`: within 2 ulp, and results below the smallest normal number become 0.
    fn pow(self, exponent: Self) -> Self;
    /// `(sin self, cos self)`, the angle in radians.
    ///
    /// In `f32`: each within 1 ulp for `|self| ≤ 512`, which is 81 turns; NaN beyond. `f64` has no such limit.
    fn sin_cos(self) -> (Self, Self);
    /// The angle in radians of the vector with the sine-like component `self` and the cosine-like component `x`, from
    /// `−π` to `π`, with the sign of `self`; 0 for the zero vector.
    ///
    /// In `f32`: within 2 ulp for components up to 2¹²⁶; NaN for two infinities.
    fn atan2(self, x: Self) -> Self;
    /// The complementary error function, `2/√π ∫ exp(−t²) dt` from `self` to infinity.
    ///
    /// In `f32`: within 6 ulp, and 0 from 9.1875 on, where the smallest normal number is reached.
    fn erfc(self) -> Self;

    /// `eˣ`, as `2^(x log₂ e)`: the relative error is that of [`exp2`](Self::exp2) and `2u |x|`.
    #[inline(always)]
    fn exp(self) -> Self {
        self.times(core::f64::consts::LOG2_E).exp2()
    }
    /// `ln self`, as `ln 2 log₂ x`, within `3u`.
    #[inline(always)]
    fn ln(self) -> Self {
        self.log2().times(core::f64::consts::LN_2)
    }
    /// `self > other`; false if either is NaN.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }
    /// `self >= other`; false if either is NaN.
    #[inline(always)]
    fn ge(self, other: Self) -> Self::Mask {
        other.le(self)
    }
    /// `self != other`; true if either is NaN.
    #[inline(always)]
    fn ne(self, other: Self) -> Self::Mask {
        !self.eq(other)
    }
    /// The larger of the two: `bound` if `bound > self`, else `self`. A NaN in `self` stays.
    #[inline(always)]
    fn max(self, bound: Self) -> Self {
        Self::select(self.lt(bound), bound, self)
    }
    /// The smaller of the two: `bound` if `bound < self`, else `self`. A NaN in `self` stays.
    #[inline(always)]
    fn min(self, bound: Self) -> Self {
        Self::select(bound.lt(self), bound, self)
    }
    /// `self + c`.
    #[inline(always)]
    fn plus(self, c: f64) -> Self {
        self + self.lift(c)
    }
    /// `self · c`.
    #[inline(always)]
    fn times(self, c: f64) -> Self {
        self * self.lift(c)
    }
    /// `self · a + b`.
    ///
    /// In two roundings, so that the bits are the same on every machine; in [`Approximate`] numbers in one, where the
    /// machine has an instruction for it.
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    /// `1 / self`.
    #[inline(always)]
    fn recip(self) -> Self {
        self.lift(1.0) / self
    }
    /// `self · other` and what its rounding lost, for numbers of at most 2⁶³ whose product is 0 or at least 2⁻¹⁰² in `f32`.
    ///
    /// Dekker 1971, with the halves of Veltkamp; machines that fuse get the same bits in two instructions. Of an `f64` the
    /// halves sum to it too, and it needs no more.
    #[inline(always)]
    fn exact_product(self, other: Self) -> (Self, Self) {
        exact_product(self, other)
    }
    /// `a b + c d`, with an error of a unit in the last place and `2u²` of the products.
    #[inline(always)]
    fn sum_of_products((a, b): (Self, Self), (c, d): (Self, Self)) -> Self {
        let (p, p_rest) = a.exact_product(b);
        let (q, q_rest) = c.exact_product(d);
        let sum = p + q;
        let q_part = sum - p;
        let rest = (p - (sum - q_part)) + (q - q_part);
        sum + (rest + (p_rest + q_rest))
    }
    /// `(a/b, c/d)` by one division: `1/(b d)` times `a d` and `c b`. In `f32` each within 4 roundings.
    ///
    /// `b d` must stay within the range of the type. Numbers whose division is an estimate take two.
    #[inline(always)]
    fn quotients((a, b): (Self, Self), (c, d): (Self, Self)) -> (Self, Self) {
        let inverse = (b * d).recip();
        (a * d * inverse, c * b * inverse)
    }
    /// `1/√self`.
    #[inline(always)]
    fn rsqrt(self) -> Self {
        self.sqrt().recip()
    }
    /// `1 − self`, which `exact` computes without the difference.
    ///
    /// For a cosine near 1, of which the difference keeps few digits. Numbers that have not more digits than that
    /// ([`Approximate`]) take the difference.
    #[inline(always)]
    fn one_minus(self, exact: impl FnOnce() -> Self) -> Self {
        exact()
    }
    /// `self · self`.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
}

/// `a b`, and what its rounding lost (Dekker).
#[inline(always)]
fn exact_product<R: Real>(a: R, b: R) -> (R, R) {
    let p = a * b;
    let ((a_hi, a_lo), (b_hi, b_lo)) = (halves(a), halves(b));
    (p, ((a_hi * b_hi - p) + (a_hi * b_lo + a_lo * b_hi)) + a_lo * b_lo)
}

/// The upper twelve bits of an `f32`, and the lower (Veltkamp).
#[inline(always)]
fn halves<R: Real>(a: R) -> (R, R) {
    let c = a.times(4097.0);
    let high = c - (c - a);
    (high, a - high)
}
