//! `f32`: the value itself, with bits that are the same on every machine.

use super::{Binary32, Real, elementary};

impl Real for f32 {
    type Mask = bool;

    #[inline(always)]
    fn lift(self, c: f64) -> Self {
        c as f32
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
        f32::abs(self)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        #[cfg(feature = "std")]
        return f32::sqrt(self);
        #[cfg(not(feature = "std"))]
        libm::sqrtf(self)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f32::copysign(self, sign)
    }
    elementary::forward!();
}

impl Binary32 for f32 {
    #[inline(always)]
    fn add_exponent(self, shifter: Self) -> Self {
        f32::from_bits(self.to_bits().wrapping_add(shifter.to_bits() << 23))
    }
    #[inline(always)]
    fn exponent_over(self, other: Self) -> Self {
        // The difference of the bits is that of the base-2 logarithms, to within 0.09; half an exponent rounds it.
        let half = 1 << 22;
        let k = (self.to_bits().wrapping_sub(other.to_bits()).wrapping_add(half) as i32) >> 23;
        // The bits of 1.5·2²³; an integer added to them is added to the number.
        f32::from_bits(k.wrapping_add(0x4b40_0000) as u32)
    }
    #[inline(always)]
    fn high_part(self) -> Self {
        f32::from_bits(self.to_bits() & 0xffff_f000)
    }
}
