//! Linear RGB.

use crate::Carry;
use crate::carry::carry;
use crate::number::Real;
use core::ops::{Add, Div, Mul, Sub};

/// Three linear channels: a reflectance, a radiance or an intensity. No transfer curve, no clamping.
///
/// The primaries are the user's: nothing here depends on them, except [`luminance`](Rgb::luminance).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb<R = f32> {
    /// Red.
    pub r: R,
    /// Green.
    pub g: R,
    /// Blue.
    pub b: R,
}

carry!([T: Carry] Rgb<T> => Rgb<T::In<S>> { r, g, b });

impl<R> Rgb<R> {
    /// The colour `(r, g, b)`.
    #[inline(always)]
    pub const fn new(r: R, g: R, b: R) -> Self {
        Self { r, g, b }
    }

    /// The same colour in another number type: `f` of each channel.
    #[inline(always)]
    pub fn map<S>(self, f: impl Fn(R) -> S) -> Rgb<S> {
        Rgb { r: f(self.r), g: f(self.g), b: f(self.b) }
    }
}

impl<R: Copy> Rgb<R> {
    /// The grey `(value, value, value)`.
    #[inline(always)]
    pub const fn splat(value: R) -> Self {
        Self { r: value, g: value, b: value }
    }
}

impl<R: Real> Rgb<R> {
    /// `a` where the mask is true, `b` elsewhere.
    #[inline(always)]
    pub fn select(mask: R::Mask, a: Self, b: Self) -> Self {
        Self { r: R::select(mask, a.r, b.r), g: R::select(mask, a.g, b.g), b: R::select(mask, a.b, b.b) }
    }

    /// `0.2126 r + 0.7152 g + 0.0722 b`: relative luminance for the primaries of Rec. 709 and sRGB
    /// (ITU-R BT.709-6, item 3.2).
    #[inline(always)]
    pub fn luminance(self) -> R {
        self.r.times(0.2126) + self.g.times(0.7152) + self.b.times(0.0722)
    }
}

impl<R: Real> Add for Rgb<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { r: self.r + other.r, g: self.g + other.g, b: self.b + other.b }
    }
}

impl<R: Real> Sub for Rgb<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { r: self.r - other.r, g: self.g - other.g, b: self.b - other.b }
    }
}

/// Channel by channel.
impl<R: Real> Mul for Rgb<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { r: self.r * other.r, g: self.g * other.g, b: self.b * other.b }
    }
}

impl<R: Real> Mul<R> for Rgb<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self { r: self.r * factor, g: self.g * factor, b: self.b * factor }
    }
}

impl<R: Real> Div<R> for Rgb<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, divisor: R) -> Self {
        Self { r: self.r / divisor, g: self.g / divisor, b: self.b / divisor }
    }
}

impl<R> From<[R; 3]> for Rgb<R> {
    #[inline(always)]
    fn from([r, g, b]: [R; 3]) -> Self {
        Self { r, g, b }
    }
}

impl<R> From<Rgb<R>> for [R; 3] {
    #[inline(always)]
    fn from(color: Rgb<R>) -> Self {
        [color.r, color.g, color.b]
    }
}
