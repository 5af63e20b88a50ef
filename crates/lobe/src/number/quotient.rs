//! `Quotient`: a division that is not done yet.

use super::Real;

/// A quotient whose division is left to whoever takes its value, so that two may share one.
///
/// A division costs ten times what a product does. Two of them are one of the product of both denominators.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quotient<R> {
    /// What is divided.
    pub numerator: R,
    /// What it is divided by.
    pub denominator: R,
}

impl<R: Real> Quotient<R> {
    /// `numerator/denominator`.
    #[inline(always)]
    pub const fn new(numerator: R, denominator: R) -> Self {
        Self { numerator, denominator }
    }

    /// A number that needs no division.
    #[inline(always)]
    pub fn whole(value: R) -> Self {
        Self { numerator: value, denominator: value.lift(1.0) }
    }

    /// The value.
    #[inline(always)]
    pub fn value(self) -> R {
        self.numerator / self.denominator
    }

    /// The values of two, by [`Real::quotients`].
    #[inline(always)]
    pub fn with(self, other: Self) -> (R, R) {
        R::quotients((self.numerator, self.denominator), (other.numerator, other.denominator))
    }
}
