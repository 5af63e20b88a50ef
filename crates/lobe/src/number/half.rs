//! `Half`: every operation rounded to binary16, to see what a formula gives in a shader's `mediump`.

use super::Real;
use core::ops::{Add, Div, Mul, Neg, Sub};
use half::f16;

/// A number of IEEE 754 binary16: 11 binary digits, at most 65504, the smallest normal number 6.1e-5.
///
/// Each operation is rounded once, to nearest, ties to even: sums, products, quotients and roots are formed in `f32`,
/// whose 24 digits are the `2·11 + 2` from which a second rounding changes nothing (Figueroa, "When is Double Rounding
/// Innocuous?", 1995). Elementary functions are those of `f32`, rounded: within 0.501 ulp, which no GPU promises.
/// Subnormal numbers are kept, where many GPUs flush them to 0. So this is the best that `mediump` can be: a formula that
/// fails here fails there.
///
/// An emulation for finding out, not for speed: its operations are calls. Inlined, the conversions of one model alone would be
/// a hundred thousand instructions.
///
/// ```
/// use lobe::{Brdf, Half, Lambert, Real, Rgb, Vec3};
/// let half = |c: f32| Half::from(c);
/// let up = Vec3::new(0.0, 0.0, 1.0).map(half);
/// let f = Lambert::new(Rgb::splat(half(0.5))).eval(up, up);
/// assert_eq!(f32::from(f.g), 0.15917969); // 0.15915494 in f32
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Half(pub f16);

impl Half {
    /// `f32`'s result, rounded.
    #[inline(always)]
    fn rounded(self, f: impl FnOnce(f32) -> f32) -> Self {
        Self::from(f(self.into()))
    }
}

impl From<f32> for Half {
    /// Rounded to nearest; infinite from 65520 on.
    #[inline(never)]
    fn from(value: f32) -> Self {
        Self(f16::from_f32(value))
    }
}

impl From<f64> for Half {
    /// Rounded once, to nearest; infinite from 65520 on.
    #[inline(never)]
    fn from(value: f64) -> Self {
        // To odd in `f32`, which has digits to spare: then the second rounding knows on which side of a tie the value is.
        // (`f16::from_f64` drops the lower half of the significand, and takes what is just above a tie for one.)
        let near = value as f32;
        let beyond = f64::from(near).abs() > value.abs();
        let shorter = if beyond { f32::from_bits(near.to_bits().wrapping_sub(1)) } else { near };
        let exact = f64::from(shorter) == value;
        Self::from(if exact { shorter } else { f32::from_bits(shorter.to_bits() | 1) })
    }
}

impl From<Half> for f32 {
    #[inline(never)]
    fn from(value: Half) -> Self {
        value.0.to_f32()
    }
}

impl From<Half> for f64 {
    #[inline(never)]
    fn from(value: Half) -> Self {
        value.0.to_f64()
    }
}

macro_rules! operators {
    ($($Trait:ident $method:ident $op:tt)+) => {$(
        impl $Trait for Half {
            type Output = Self;
            #[inline(never)]
            fn $method(self, other: Self) -> Self {
                Self::from(f32::from(self) $op f32::from(other))
            }
        }
    )+};
}
operators!(Add add + Sub sub - Mul mul * Div div /);

impl Neg for Half {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Half {
    type Mask = bool;

    // (2 · 2⁶)² = 2¹⁴, and 2⁻¹⁴ · 2⁶ squared is 2⁻¹⁶: the range is too narrow to keep both ends.
    const ROOT_SCALE: f64 = 8.0;
    const MIN_POSITIVE: f64 = 1.0 / 16_384.0;
    const NARROW: bool = true;

    #[inline(always)]
    fn lift(self, c: f64) -> Self {
        Self::from(c)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self.0 <= other.0
    }
    #[inline(always)]
    fn eq(self, other: Self) -> bool {
        self.0 == other.0
    }
    #[inline(always)]
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(f16::from_bits(self.0.to_bits() & 0x7fff))
    }
    #[inline(never)]
    fn sqrt(self) -> Self {
        self.rounded(Real::sqrt)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }
    #[inline(never)]
    fn exp2(self) -> Self {
        self.rounded(Real::exp2)
    }
    #[inline(never)]
    fn log2(self) -> Self {
        self.rounded(Real::log2)
    }
    #[inline(never)]
    fn log2_1p(self) -> Self {
        self.rounded(Real::log2_1p)
    }
    #[inline(never)]
    fn log2_1p_div(self, denominator: Self) -> Self {
        self.rounded(|x| x.log2_1p_div(denominator.into()))
    }
    #[inline(never)]
    fn pow(self, exponent: Self) -> Self {
        self.rounded(|x| Real::pow(x, exponent.into()))
    }
    #[inline(never)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Real::sin_cos(f32::from(self));
        (sin.into(), cos.into())
    }
    #[inline(never)]
    fn atan2(self, x: Self) -> Self {
        self.rounded(|y| Real::atan2(y, x.into()))
    }
    #[inline(never)]
    fn erfc(self) -> Self {
        self.rounded(Real::erfc)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> impl Iterator<Item = Half> {
        (0..=u16::MAX).map(|bits| Half(f16::from_bits(bits)))
    }

    fn same(a: Half, b: Half) -> bool {
        a.0.to_bits() == b.0.to_bits() || (a.0.is_nan() && b.0.is_nan())
    }

    /// Sums and products of two are exact in `f64`; a quotient and a root have digits enough there.
    #[test]
    fn every_operation_is_rounded_once() {
        let mut bits = 1_u32;
        for x in all() {
            let wide = f64::from(x);
            assert!(same(x.sqrt(), Half::from(Real::sqrt(wide))), "√{x:?}");
            for _ in 0..64 {
                bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let y = Half(f16::from_bits((bits >> 16) as u16));
                let other = f64::from(y);
                assert!(same(x + y, Half::from(wide + other)), "{x:?} + {y:?}");
                assert!(same(x - y, Half::from(wide - other)), "{x:?} − {y:?}");
                assert!(same(x * y, Half::from(wide * other)), "{x:?} · {y:?}");
                assert!(same(x / y, Half::from(wide / other)), "{x:?} / {y:?}");
            }
        }
    }

    #[test]
    fn the_range_is_that_of_binary16() {
        let one = Half::from(1.0_f32);
        assert_eq!(f32::from(one.lift(65519.0)), 65504.0);
        assert_eq!(f32::from(one.lift(65520.0)), f32::INFINITY);
        assert_eq!(f64::from(one.lift(Half::MIN_POSITIVE)), 6.103515625e-5);
        assert_eq!(f32::from(one.plus(1.0 / 2048.0)), 1.0, "a tie, to even");
        // What `SCALE` is for: twice it squares to a number that is still there.
        assert!(f32::from(one.times(2.0 * Half::SCALE).squared()).is_finite());
    }
}
