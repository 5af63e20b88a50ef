//! `f64`: the reference that errors are measured against. Elementary functions come from `libm`, on every machine.

use super::Real;

impl Real for f64 {
    type Mask = bool;

    #[inline(always)]
    fn lift(self, c: f64) -> Self {
        c
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn eq(self, other: Self) -> bool {
        self == other
    }
    #[inline(always)]
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        #[cfg(feature = "std")]
        return f64::sqrt(self);
        #[cfg(not(feature = "std"))]
        libm::sqrt(self)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f64::copysign(self, sign)
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        libm::exp2(self)
    }
    #[inline(always)]
    fn log2(self) -> Self {
        libm::log2(self)
    }
    #[inline(always)]
    fn log2_1p(self) -> Self {
        libm::log1p(self) * core::f64::consts::LOG2_E
    }
    #[inline(always)]
    fn log2_1p_div(self, denominator: Self) -> Self {
        Real::log2_1p(self / denominator)
    }
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        // C's `pow` has values for negative bases, for `1^NaN` and for `NaN^0`; ours are NaN in every number type.
        if self < 0.0 || self.is_nan() || exponent.is_nan() {
            return f64::NAN;
        }
        libm::pow(self.abs(), exponent)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        // The zero vector has the angle 0 in every number type, whatever the sign of its zeros.
        libm::atan2(self, x + 0.0)
    }
    #[inline(always)]
    fn erfc(self) -> Self {
        libm::erfc(self)
    }
}
