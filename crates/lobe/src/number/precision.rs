//! How many digits a number is asked for, as a type.

use super::approximate::{RSQRT_START, refine_rsqrt};
use super::{Binary32, Real};

/// How many digits a number is asked for: [`Precise`], [`Fast`](super::Fast) or [`Coarse`](super::Coarse).
///
/// A formula does not know which it is given; the number type [`Of`](Self::Of) decides.
pub trait Precision: Copy + core::fmt::Debug + Default + Send + Sync + 'static {
    /// The number of this precision that stands on `F`, an `f32` or lanes of it.
    type Of<F: Estimate>: Real<Mask = F::Mask>;
    /// Its name, in lower case.
    const NAME: &'static str;
    /// The number `value`.
    fn number<F: Estimate>(value: F) -> Self::Of<F>;
    /// The value of a number.
    fn value<F: Estimate>(number: Self::Of<F>) -> F;
}

/// Every digit that `f32` has, and the same bits on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Precise;

impl Precision for Precise {
    type Of<F: Estimate> = F;
    const NAME: &'static str = "precise";
    #[inline(always)]
    fn number<F: Estimate>(value: F) -> F {
        value
    }
    #[inline(always)]
    fn value<F: Estimate>(number: F) -> F {
        number
    }
}

/// The polynomials of a precision below [`Precise`]: minimax, by `tools/minimax.py`.
pub trait Rough: Precision {
    /// `2^x` for `|x| ≤ 1/2`.
    fn exp2<F: Estimate>(x: F) -> F;
    /// `log₂(1 + x)/x` for `1 + x` from 2/3 to 3/2.
    fn log2<F: Estimate>(x: F) -> F;
    /// `sin r/r` in `x = r²`, for `|r| ≤ π/4`.
    fn sin<F: Estimate>(x: F) -> F;
    /// `atan t/t` in `x = t²`, for `|t| ≤ tan π/8`.
    fn atan<F: Estimate>(x: F) -> F;
    /// `(a + 3) exp(a²) erfc a` in `x = (a − 3)/(a + 3)`, for `0 ≤ a ≤ 9.2`.
    fn erfc<F: Estimate>(x: F) -> F;
    /// `1/√x` where `x = a y²`, for a first guess `y` of `1/√a` from its bits.
    fn rsqrt<F: Estimate>(x: F) -> F;
}

/// What an [`Approximate`](super::Approximate) number needs of the one that it stands on: what the machine estimates,
/// and what it fuses.
///
/// As they stand, divisions and roots are exact, which is right for scalars: a machine that divides in hardware does it
/// in less time than a polynomial takes.
pub trait Estimate: Binary32 {
    /// `self · a + b`, in one rounding if that is one instruction.
    #[inline(always)]
    fn fused(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    /// `1/self`.
    #[inline(always)]
    fn recip_estimate(self) -> Self {
        self.recip()
    }
    /// `a/b`.
    #[inline(always)]
    fn divide(a: Self, b: Self) -> Self {
        a / b
    }
    /// `√self`; 0 at 0.
    #[inline(always)]
    fn sqrt_estimate(self) -> Self {
        self.sqrt()
    }
    /// `√self` of a positive normal number.
    #[inline(always)]
    fn sqrt_of_normal_estimate(self) -> Self {
        self.sqrt()
    }
    /// `0.892/√self` within 3 %, for positive normal numbers if `start` is right: half of the bits of `self` taken from
    /// `start`.
    fn rsqrt_guess(self, start: u32) -> Self;
    /// `1/√self` for positive normal numbers.
    #[inline(always)]
    fn rsqrt_estimate<P: Rough>(self) -> Self {
        refine_rsqrt::<Self, P>(self, self.rsqrt_guess(RSQRT_START))
    }
}

impl Estimate for f32 {
    #[inline(always)]
    fn rsqrt_guess(self, start: u32) -> Self {
        f32::from_bits(start.wrapping_sub(self.to_bits() >> 1))
    }
}
