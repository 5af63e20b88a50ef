//! `Wide`: SIMD lanes of `f32`, the same bits in each lane as the scalar.

use super::precision::{Estimate, Rough};
use super::{Binary32, Mask, Real, elementary};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use fearless_simd::{Bytes as _, ExtractToken as _, Select as _, Simd, SimdBase, SimdFloat as _, SimdFrom as _};

/// As many numbers of `f32` as a register of the SIMD level `S` holds: 4 with SSE or NEON, 8 with AVX2, 16 with
/// AVX-512.
///
/// Every lane gets the operations of the scalar `f32` in the same order, none of them fused and none of them an
/// estimate: the same bits, at every level.
///
/// Users meet it by way of [`batch`](crate::batch), which knows how to read and write it. The vector instructions of a
/// level may only be used inside a function that is compiled for it: [`Simd::vectorize`] makes one, and what it calls is
/// to be marked `#[inline(always)]`, as all of this crate is.
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

impl<S: Lanes> Real for Wide<S> {
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
    fn exact_product(self, other: Self) -> (Self, Self) {
        S::exact_product(self, other)
    }
    #[inline(always)]
    fn max(self, bound: Self) -> Self {
        S::max(self, bound)
    }
    #[inline(always)]
    fn min(self, bound: Self) -> Self {
        S::min(self, bound)
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
    elementary::forward!();
}

impl<S: Lanes> Binary32 for Wide<S> {
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

/// A SIMD level, with the estimates that it has.
///
/// For every level of `fearless_simd`; which instructions there are is known for each of them only.
pub trait Lanes: Simd {
    /// As [`Real::exact_product`].
    #[inline(always)]
    fn exact_product(a: Wide<Self>, b: Wide<Self>) -> (Wide<Self>, Wide<Self>) {
        super::exact_product(a, b)
    }
    /// As [`Real::max`]: `bound` where `bound > x`, else `x`.
    #[inline(always)]
    fn max(x: Wide<Self>, bound: Wide<Self>) -> Wide<Self> {
        Real::select(x.lt(bound), bound, x)
    }
    /// As [`Real::min`]: `bound` where `bound < x`, else `x`.
    #[inline(always)]
    fn min(x: Wide<Self>, bound: Wide<Self>) -> Wide<Self> {
        Real::select(bound.lt(x), bound, x)
    }
    /// As [`Estimate::fused`].
    #[inline(always)]
    fn fused(a: Wide<Self>, b: Wide<Self>, c: Wide<Self>) -> Wide<Self> {
        a * b + c
    }
    /// As [`Estimate::recip_estimate`].
    #[inline(always)]
    fn recip(x: Wide<Self>) -> Wide<Self> {
        Real::recip(x)
    }
    /// As [`Estimate::divide`].
    #[inline(always)]
    fn divide(a: Wide<Self>, b: Wide<Self>) -> Wide<Self> {
        a / b
    }
    /// As [`Estimate::sqrt_estimate`].
    #[inline(always)]
    fn sqrt(x: Wide<Self>) -> Wide<Self> {
        Real::sqrt(x)
    }
    /// As [`Estimate::sqrt_of_normal_estimate`].
    #[inline(always)]
    fn sqrt_of_normal(x: Wide<Self>) -> Wide<Self> {
        Real::sqrt(x)
    }
    /// As [`Estimate::rsqrt_estimate`].
    #[inline(always)]
    fn rsqrt<P: Rough>(x: Wide<Self>) -> Wide<Self> {
        super::approximate::refine_rsqrt::<_, P>(x, x.rsqrt_guess(super::approximate::RSQRT_START))
    }
}

impl<S: Lanes> Estimate for Wide<S> {
    #[inline(always)]
    fn fused(self, a: Self, b: Self) -> Self {
        S::fused(self, a, b)
    }
    #[inline(always)]
    fn recip_estimate(self) -> Self {
        S::recip(self)
    }
    #[inline(always)]
    fn divide(a: Self, b: Self) -> Self {
        S::divide(a, b)
    }
    #[inline(always)]
    fn sqrt_estimate(self) -> Self {
        S::sqrt(self)
    }
    #[inline(always)]
    fn sqrt_of_normal_estimate(self) -> Self {
        S::sqrt_of_normal(self)
    }
    #[inline(always)]
    fn rsqrt_guess(self, start: u32) -> Self {
        let bits: S::u32s = self.0.bitcast();
        let start = S::u32s::splat(self.0.token(), start);
        Self((start - (bits >> 1)).bitcast())
    }
    #[inline(always)]
    fn rsqrt_estimate<P: Rough>(self) -> Self {
        S::rsqrt::<P>(self)
    }
}

#[cfg(not(any(
    target_arch = "x86",
    target_arch = "x86_64",
    all(target_arch = "aarch64", target_feature = "neon"),
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
impl Lanes for fearless_simd::Fallback {}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
impl Lanes for fearless_simd::WasmSimd128 {}

/// `a b`, and what its rounding lost: one instruction each where products fuse with sums. The bits are those of Dekker's
/// way, which is exact too.
#[cfg(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64"))]
#[inline(always)]
fn fused_product<S: Lanes>(a: Wide<S>, b: Wide<S>) -> (Wide<S>, Wide<S>) {
    let p = a * b;
    (p, S::fused(a, b, -p))
}

/// The estimates of NEON, 2⁻⁸, with a step of Newton's: 2⁻¹⁶.
#[cfg(target_arch = "aarch64")]
impl Lanes for fearless_simd::Neon {
    #[inline(always)]
    fn exact_product(a: Wide<Self>, b: Wide<Self>) -> (Wide<Self>, Wide<Self>) {
        fused_product(a, b)
    }
    #[inline(always)]
    fn fused(a: Wide<Self>, b: Wide<Self>, c: Wide<Self>) -> Wide<Self> {
        Wide(a.0.mul_add(b.0, c.0))
    }
    #[inline(always)]
    fn recip(x: Wide<Self>) -> Wide<Self> {
        fearless_simd::kernel!(
            #[inline(always)]
            fn estimate(simd: Neon, x: float32x4_t) -> float32x4_t {
                let y = vrecpeq_f32(x);
                vmulq_f32(y, vrecpsq_f32(x, y))
            }
        );
        let simd = x.0.token();
        Wide(estimate(simd, x.0.into()).simd_into(simd))
    }
    #[inline(always)]
    fn divide(a: Wide<Self>, b: Wide<Self>) -> Wide<Self> {
        a * Self::recip(b)
    }
    #[inline(always)]
    fn rsqrt<P: Rough>(x: Wide<Self>) -> Wide<Self> {
        fearless_simd::kernel!(
            #[inline(always)]
            fn estimate(simd: Neon, x: float32x4_t) -> float32x4_t {
                let y = vrsqrteq_f32(x);
                vmulq_f32(y, vrsqrtsq_f32(vmulq_f32(x, y), y))
            }
        );
        let simd = x.0.token();
        Wide(estimate(simd, x.0.into()).simd_into(simd))
    }
}
#[cfg(target_arch = "aarch64")]
use core::arch::aarch64::*;
#[cfg(target_arch = "aarch64")]
use fearless_simd::SimdInto as _;

/// The estimates of x86, as they come: 2⁻¹⁴ with AVX-512, 1.5·2⁻¹² before.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
macro_rules! x86_lanes {
    ($($level:ident, $register:ident, $rcp:ident, $rsqrt:ident, $max:ident, $min:ident, $product:path;)+) => {$(
        impl Lanes for fearless_simd::$level {
            #[inline(always)]
            fn exact_product(a: Wide<Self>, b: Wide<Self>) -> (Wide<Self>, Wide<Self>) {
                $product(a, b)
            }
            // The instructions return their second operand unless the first is beyond it, NaN or not.
            #[inline(always)]
            fn max(x: Wide<Self>, bound: Wide<Self>) -> Wide<Self> {
                fearless_simd::kernel!(
                    #[inline(always)]
                    fn larger(simd: $level, bound: $register, x: $register) -> $register {
                        $max(bound, x)
                    }
                );
                let simd = x.0.token();
                Wide(larger(simd, bound.0.into(), x.0.into()).simd_into(simd))
            }
            #[inline(always)]
            fn min(x: Wide<Self>, bound: Wide<Self>) -> Wide<Self> {
                fearless_simd::kernel!(
                    #[inline(always)]
                    fn smaller(simd: $level, bound: $register, x: $register) -> $register {
                        $min(bound, x)
                    }
                );
                let simd = x.0.token();
                Wide(smaller(simd, bound.0.into(), x.0.into()).simd_into(simd))
            }
            #[inline(always)]
            fn fused(a: Wide<Self>, b: Wide<Self>, c: Wide<Self>) -> Wide<Self> {
                // In one rounding from AVX2 on, in two before.
                Wide(a.0.mul_add(b.0, c.0))
            }
            #[inline(always)]
            fn recip(x: Wide<Self>) -> Wide<Self> {
                fearless_simd::kernel!(
                    #[inline(always)]
                    fn estimate(simd: $level, x: $register) -> $register {
                        $rcp(x)
                    }
                );
                let simd = x.0.token();
                Wide(estimate(simd, x.0.into()).simd_into(simd))
            }
            #[inline(always)]
            fn divide(a: Wide<Self>, b: Wide<Self>) -> Wide<Self> {
                a * Self::recip(b)
            }
            #[inline(always)]
            fn sqrt(x: Wide<Self>) -> Wide<Self> {
                // The estimate at 0 is infinite, and 0 · ∞ would be NaN.
                x * Self::rsqrt::<super::Fast>(x.max(x.lift(f32::MIN_POSITIVE as f64)))
            }
            #[inline(always)]
            fn sqrt_of_normal(x: Wide<Self>) -> Wide<Self> {
                x * Self::rsqrt::<super::Fast>(x)
            }
            #[inline(always)]
            fn rsqrt<P: Rough>(x: Wide<Self>) -> Wide<Self> {
                fearless_simd::kernel!(
                    #[inline(always)]
                    fn estimate(simd: $level, x: $register) -> $register {
                        $rsqrt(x)
                    }
                );
                let simd = x.0.token();
                Wide(estimate(simd, x.0.into()).simd_into(simd))
            }
        }
    )+};
}
#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::SimdInto as _;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
x86_lanes! {
    Sse2, __m128, _mm_rcp_ps, _mm_rsqrt_ps, _mm_max_ps, _mm_min_ps, super::exact_product;
    Sse4_2, __m128, _mm_rcp_ps, _mm_rsqrt_ps, _mm_max_ps, _mm_min_ps, super::exact_product;
    Avx2, __m256, _mm256_rcp_ps, _mm256_rsqrt_ps, _mm256_max_ps, _mm256_min_ps, fused_product;
    Avx512, __m512, _mm512_rcp14_ps, _mm512_rsqrt14_ps, _mm512_max_ps, _mm512_min_ps, fused_product;
}
