//! `Wide`: SIMD lanes of `f32`, the same bits in each lane as the scalar.

use super::{Binary32, Mask, Real, elementary};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use fearless_simd::{Bytes as _, ExtractToken as _, Select as _, Simd, SimdBase, SimdFloat as _, SimdFrom as _};

/// As many numbers of `f32` as a register of the SIMD level `S` holds: 4 with SSE or NEON, 8 with AVX2, 16 with
/// AVX-512.
///
/// Every lane gets the operations of the scalar `f32` in the same order, none of them fused and none of them an
/// estimate: the same bits, at every level.
///
/// The vector instructions of a level may only be used inside a function that is compiled for it. Call from the
/// [`dispatch!`](fearless_simd::dispatch) of `fearless_simd`, and mark what is between with `#[inline(always)]`: all of
/// this crate is.
///
/// ```
/// use fearless_simd::{Level, SimdBase as _, dispatch};
/// use lobe::{Alpha, Brdf, Rgb, Vec3, Ward, number::Wide};
///
/// let metal = Ward::new(Rgb::splat(0.9_f32), Alpha(0.2), Alpha(0.2));
/// let (l, v) = (Vec3::new(0.6_f32, 0.0, 0.8), Vec3::new(0.0, 0.6, 0.8));
/// let green = dispatch!(Level::new(), simd => {
///     let wide = |x: f32| Wide::splat(simd, x);
///     let f = metal.map(wide).eval(l.map(wide), v.map(wide));
///     f.g.0.as_slice()[0]
/// });
/// assert_eq!(green.to_bits(), metal.eval(l, v).g.to_bits());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Wide<S: Simd>(pub S::f32s);

/// One answer per lane of a [`Wide`].
#[derive(Clone, Copy)]
pub struct WideMask<S: Simd>(pub S::mask32s);

impl<S: Simd> core::fmt::Debug for WideMask<S> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("WideMask").field(&fearless_simd::SimdMask::to_bitmask(self.0)).finish()
    }
}

impl<S: Simd> Wide<S> {
    /// How many lanes there are.
    pub const LANES: usize = <S::f32s as SimdBase<S>>::LEN;

    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(simd: S, x: f32) -> Self {
        Self(S::f32s::simd_from(simd, x))
    }
}

macro_rules! operators {
    ($($Trait:ident $method:ident $op:tt)+) => {$(
        impl<S: Simd> $Trait for Wide<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $op other.0)
            }
        }
    )+};
}
operators!(Add add + Sub sub - Mul mul * Div div /);

impl<S: Simd> Neg for Wide<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Simd> BitAnd for WideMask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<S: Simd> BitOr for WideMask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<S: Simd> Not for WideMask<S> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

impl<S: Simd> Mask for WideMask<S> {}

impl<S: Simd> Real for Wide<S> {
    type Mask = WideMask<S>;

    #[inline(always)]
    fn lift(self, c: f64) -> Self {
        Self::splat(self.0.token(), c as f32)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> WideMask<S> {
        WideMask(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn le(self, other: Self) -> WideMask<S> {
        WideMask(self.0.simd_le(other.0))
    }
    #[inline(always)]
    fn eq(self, other: Self) -> WideMask<S> {
        WideMask(self.0.simd_eq(other.0))
    }
    #[inline(always)]
    fn select(mask: WideMask<S>, a: Self, b: Self) -> Self {
        Self(mask.0.select(a.0, b.0))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        elementary::exp2(self)
    }
    #[inline(always)]
    fn exp2_where(self, mask: WideMask<S>) -> Self {
        elementary::exp2_where(self, mask)
    }
    #[inline(always)]
    fn log2(self) -> Self {
        elementary::log2(self)
    }
    #[inline(always)]
    fn log2_1p(self) -> Self {
        elementary::log2_1p(self)
    }
    #[inline(always)]
    fn log2_1p_div(self, denominator: Self) -> Self {
        elementary::log2_1p_div(self, denominator)
    }
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        elementary::pow(self, exponent)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        elementary::atan2(self, x)
    }
    #[inline(always)]
    fn erfc(self) -> Self {
        elementary::erfc(self)
    }
}

impl<S: Simd> Binary32 for Wide<S> {
    #[inline(always)]
    fn add_exponent(self, shifter: Self) -> Self {
        let (bits, shift): (S::u32s, S::u32s) = (self.0.bitcast(), shifter.0.bitcast());
        Self((bits + (shift << 23)).bitcast())
    }
    #[inline(always)]
    fn exponent_over(self, other: Self) -> Self {
        // As the scalar has it, where the reasons are given. An arithmetic shift: signed integers.
        let (bits, others): (S::i32s, S::i32s) = (self.0.bitcast(), other.0.bitcast());
        let k = (bits - others + (1 << 22)) >> 23;
        Self((k + 0x4b40_0000).bitcast())
    }
    #[inline(always)]
    fn high_part(self) -> Self {
        let bits: S::u32s = self.0.bitcast();
        Self((bits & 0xffff_f000).bitcast())
    }
}
