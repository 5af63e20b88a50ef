//! `Slopes`: an interval and the intervals of its derivatives. Over a box it bounds how a formula changes, which bounds
//! its values far better than the plain interval does: to the second order in the size of the box.
//!
//! For a formula `f` with derivatives in `∂ᵢf` over a box, the mean value theorem gives
//! `f(x) ∈ f(c) + Σ ∂ᵢf (xᵢ − cᵢ)` for any two points of it (Moore 1966, section 6.3). Where `f` has kinks but no steps
//! (`max`, `min`, `|x|`), it holds with the hull of the derivatives on both sides (Lebourg, "Valeur moyenne pour
//! gradient généralisé", 1975). Where a select cannot be decided there may be a step: the derivatives are unknown, and
//! so are they at poles, at the cut of the arc tangent and at `√0`.

use crate::interval::{Interval, Undecided};
use lobe::Real;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Bounds over a box: of the value, and of its derivatives by each of `N` variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes<const N: usize> {
    /// The bound of the value.
    pub value: Interval,
    /// The bounds of the derivatives; [`Interval::UNKNOWN`] where the formula may have a step.
    pub slope: [Interval; N],
}

impl<const N: usize> Slopes<N> {
    /// A constant.
    pub fn constant(value: Interval) -> Self {
        Self { value, slope: [Interval::ZERO; N] }
    }

    /// The variable with this index.
    pub fn variable(value: Interval, index: usize) -> Self {
        Self { value, slope: std::array::from_fn(|i| if i == index { Interval::ONE } else { Interval::ZERO }) }
    }

    /// `value`, with the slopes times `factor`: the chain rule.
    fn chain(self, value: Interval, factor: Interval) -> Self {
        Self { value, slope: self.slope.map(|s| times(factor, s)) }
    }

    /// `value`, with the slopes `f ∂a + g ∂b`.
    fn chain_two(value: Interval, (f, a): (Interval, &Self), (g, b): (Interval, &Self)) -> Self {
        Self { value, slope: std::array::from_fn(|i| plus(times(f, a.slope[i]), times(g, b.slope[i]))) }
    }

    /// `value`, of which nothing is known but itself: there may be a step.
    fn step(value: Interval) -> Self {
        Self { value, slope: [Interval::UNKNOWN; N] }
    }

    /// `value`, with a kink between `a` and `b`.
    fn kink(value: Interval, a: &Self, b: &Self) -> Self {
        Self { value, slope: std::array::from_fn(|i| a.slope[i].hull(b.slope[i])) }
    }

    /// The sine and cosine of `πu`.
    pub(crate) fn half_turns(self) -> (Self, Self) {
        let (sin, cos) = self.value.half_turns();
        (self.chain(sin, Interval::PI * cos), self.chain(cos, -(Interval::PI * sin)))
    }
}

/// The product with a slope: a slope of 0 is that of a constant, and stays 0 whatever the factor.
#[inline]
fn times(factor: Interval, slope: Interval) -> Interval {
    if slope.is_zero() { slope } else { factor * slope }
}

/// The sum of two slopes, of which most are 0.
#[inline]
fn plus(a: Interval, b: Interval) -> Interval {
    if a.is_zero() {
        b
    } else if b.is_zero() {
        a
    } else {
        a + b
    }
}

impl<const N: usize> Add for Slopes<N> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { value: self.value + o.value, slope: std::array::from_fn(|i| plus(self.slope[i], o.slope[i])) }
    }
}

impl<const N: usize> Sub for Slopes<N> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { value: self.value - o.value, slope: std::array::from_fn(|i| plus(self.slope[i], -o.slope[i])) }
    }
}

impl<const N: usize> Neg for Slopes<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: self.slope.map(|s| -s) }
    }
}

impl<const N: usize> Mul for Slopes<N> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::chain_two(self.value * o.value, (o.value, &self), (self.value, &o))
    }
}

impl<const N: usize> Div for Slopes<N> {
    type Output = Self;
    /// `∂(a/b) = (∂a − (a/b) ∂b)/b`.
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        if o.value.contains(0.0) || o.value.nan {
            return Self::step(value);
        }
        let inverse = Interval::ONE / o.value;
        Self::chain_two(value, (inverse, &self), (-(value * inverse), &o))
    }
}

impl<const N: usize> Real for Slopes<N> {
    type Mask = Undecided;

    fn lift(self, c: f64) -> Self {
        Self::constant(Interval::point(c))
    }
    fn lt(self, o: Self) -> Undecided {
        self.value.lt(o.value)
    }
    fn le(self, o: Self) -> Undecided {
        self.value.le(o.value)
    }
    fn eq(self, o: Self) -> Undecided {
        Real::eq(self.value, o.value)
    }
    fn select(mask: Undecided, a: Self, b: Self) -> Self {
        match (mask.can_be_true, mask.can_be_false) {
            (true, false) => a,
            (false, true) => b,
            _ => Self::step(a.value.hull(b.value)),
        }
    }
    fn abs(self) -> Self {
        if self.value.lo >= 0.0 {
            self
        } else if self.value.hi <= 0.0 {
            -self
        } else {
            Self::kink(self.value.abs(), &self, &-self)
        }
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        if self.value.lo > 0.0 {
            self.chain(root, Interval::point(0.5) / root)
        } else {
            step_unless_constant(self, root)
        }
    }
    fn copysign(self, sign: Self) -> Self {
        let magnitude = self.abs();
        if sign.value.lo > 0.0 && !sign.value.nan {
            magnitude
        } else if sign.value.hi < 0.0 && !sign.value.nan {
            -magnitude
        } else {
            Self::step(self.value.copysign(sign.value))
        }
    }
    fn exp2(self) -> Self {
        let power = self.value.exp2();
        self.chain(power, power * ln_2())
    }
    fn log2(self) -> Self {
        let value = self.value.log2();
        if self.value.lo > 0.0 {
            self.chain(value, Interval::ONE / (self.value * ln_2()))
        } else {
            step_unless_constant(self, value)
        }
    }
    fn log2_1p(self) -> Self {
        let value = self.value.log2_1p();
        if self.value.lo > -1.0 {
            self.chain(value, Interval::ONE / ((Interval::ONE + self.value) * ln_2()))
        } else {
            step_unless_constant(self, value)
        }
    }
    fn log2_1p_div(self, denominator: Self) -> Self {
        (self / denominator).log2_1p()
    }
    fn exp2_where(self, mask: Undecided) -> Self {
        let value = self.value.exp2_where(mask);
        match (mask.can_be_true, mask.can_be_false || self.value.nan) {
            (true, false) => self.exp2(),
            (false, _) => Self::constant(value),
            _ => Self::step(value),
        }
    }
    /// `∂(x^y) = y x^(y−1) ∂x + x^y ln x ∂y`.
    fn pow(self, exponent: Self) -> Self {
        let (x, y) = (self.value, exponent.value);
        let value = x.pow(y);
        if x.lo <= 0.0 || x.lo.is_nan() {
            return Self::step(value);
        }
        let by_exponent = value * x.log2() * ln_2();
        Self::chain_two(value, (y * x.pow(y - Interval::ONE), &self), (by_exponent, &exponent))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    /// `∂ atan2(y, x) = (x ∂y − y ∂x)/(x² + y²)`.
    fn atan2(self, x: Self) -> Self {
        let (y, value) = (self.value, self.value.atan2(x.value));
        let x_value = x.value;
        let length2 = x_value.squared() + y.squared();
        if length2.lo <= 0.0 || (y.contains(0.0) && x_value.lo < 0.0) {
            return Self::step(value);
        }
        Self::chain_two(value, (x_value / length2, &self), (-(y / length2), &x))
    }
    /// `∂ erfc x = −2/√π exp(−x²) ∂x`.
    fn erfc(self) -> Self {
        // Both constants are rounded, and so this is wider by two places.
        let log2_e = Interval::new(std::f64::consts::LOG2_E.next_down(), std::f64::consts::LOG2_E.next_up());
        let factor = std::f64::consts::FRAC_2_SQRT_PI;
        let factor = Interval::new(factor.next_down(), factor.next_up());
        let bell = (-(self.value.squared() * log2_e)).exp2();
        self.chain(self.value.erfc(), -(factor * bell))
    }

    fn max(self, bound: Self) -> Self {
        if self.value.lo >= bound.value.hi && !bound.value.nan {
            self
        } else if self.value.hi < bound.value.lo && !self.value.nan && !bound.value.nan {
            bound
        } else if bound.value.nan {
            Self::step(self.value.max(bound.value))
        } else {
            Self::kink(self.value.max(bound.value), &self, &bound)
        }
    }
    fn min(self, bound: Self) -> Self {
        if self.value.hi <= bound.value.lo && !bound.value.nan {
            self
        } else if self.value.lo > bound.value.hi && !self.value.nan && !bound.value.nan {
            bound
        } else if bound.value.nan {
            Self::step(self.value.min(bound.value))
        } else {
            Self::kink(self.value.min(bound.value), &self, &bound)
        }
    }
    fn exact_product(self, other: Self) -> (Self, Self) {
        (self * other, Self::constant(Interval::ZERO))
    }
    fn sum_of_products((a, b): (Self, Self), (c, d): (Self, Self)) -> Self {
        a * b + c * d
    }
    fn quotients((a, b): (Self, Self), (c, d): (Self, Self)) -> (Self, Self) {
        (a / b, c / d)
    }
    fn one_minus(self, _exact: impl FnOnce() -> Self) -> Self {
        Self { value: Interval::ONE - self.value, slope: self.slope.map(|s| -s) }
    }
    fn squared(self) -> Self {
        self.chain(self.value.squared(), self.value * Interval::point(2.0))
    }
}

/// `ln 2`, which is between two neighbours of its rounded value.
fn ln_2() -> Interval {
    Interval::new(std::f64::consts::LN_2.next_down(), std::f64::consts::LN_2.next_up())
}

/// The root or logarithm of what reaches 0: there the slope is infinite, by every variable that it depends on.
fn step_unless_constant<const N: usize>(x: Slopes<N>, value: Interval) -> Slopes<N> {
    Slopes { value, slope: x.slope.map(|s| if s.is_zero() { s } else { Interval::UNKNOWN }) }
}
