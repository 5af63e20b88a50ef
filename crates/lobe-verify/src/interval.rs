//! `Interval`: all numbers from `lo` to `hi`. A formula of intervals is a bound over a whole box of directions and
//! parameters.
//!
//! Moore, *Interval Analysis*, 1966: if every operation encloses the results of all members of its operands, so does the
//! whole formula. The price is that an operand which occurs twice is taken as two independent ones (`x − x` of
//! `[0, 1]` is `[−1, 1]`), so a bound may be far from the range. It comes closer as boxes become smaller.
//!
//! # What is enclosed
//!
//! The formula in **real numbers**, with the constants of its source as the `f64` that they are. Energy conservation is
//! a property of that formula. How far its rounded value in `f32` is from it is another matter, which the tests against
//! `f64` and at the extremes measure.
//!
//! - `+ − × ÷ √` are correctly rounded in `f64`: an end that is not exact moves outward by one unit in the last place.
//! - Elementary functions are those of `libm`, which come from FreeBSD's msun. Their sources state errors below 1 ulp
//!   (0.503 for `exp2`, 0.70 for `pow`) or results that are nearly rounded. The largest error on record for the same
//!   algorithms is 5 ulp, of `erfc` (glibc manual, "Known Maximum Errors in Math Functions"). Ends move by [`ULPS`] = 8.
//! - Infinities are members, as they are values in floating point: `1/[0, 1]` is `[1, ∞]`. Zero has no sign; a quotient
//!   by an interval that ends at 0 is the limit from within, and one by an interval with 0 inside, or by 0 alone, the
//!   whole line.
//! - What is undefined (`0/0`, `0·∞`, `∞ − ∞`, `√` and `log` of a negative number) leaves a mark, [`nan`](Interval::nan):
//!   for some member the result *may* be NaN; `lo` and `hi` enclose it for all others. So a bound which
//!   [`is_finite`](Interval::is_finite) proves that no member has a NaN, an infinity or a pole. A select drops the mark
//!   with the operand that it drops, as it drops a NaN.
//! - [`Real::exp2_where`] drops it too: in `f32` it makes 0 of a NaN.

use lobe::{Mask, Real};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// How far the ends of an elementary function move outward, in units in the last place.
pub const ULPS: u32 = 8;

/// All numbers from `lo` to `hi`, infinities included; and whether there may be a NaN among them.
///
/// ```
/// use lobe::{Brdf, Lambert, Rgb, Vec3};
/// use lobe_verify::interval::Interval;
/// // All albedos of [0.2, 0.3], all cosines of [0.5, 0.6].
/// let lobe = Lambert::new(Rgb::splat(Interval::new(0.2, 0.3)));
/// let l = Vec3::new(Interval::new(0.8, 0.9), Interval::point(0.0), Interval::new(0.5, 0.6));
/// let value = lobe.eval_cos(l, l).g;
/// assert!(value.is_finite() && value.lo > 0.0318 && value.hi < 0.0573);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower end; a member, or a bound that none reaches.
    pub lo: f64,
    /// The upper end.
    pub hi: f64,
    /// Whether the result may be undefined for some member.
    pub nan: bool,
}

/// The answer to a comparison of intervals: whether it can be true, and whether it can be false, for some members.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Undecided {
    /// True for some members, as far as the ends can tell.
    pub can_be_true: bool,
    /// False for some members, as far as the ends can tell.
    pub can_be_false: bool,
}

impl BitAnd for Undecided {
    type Output = Self;
    #[inline]
    fn bitand(self, o: Self) -> Self {
        Self { can_be_true: self.can_be_true && o.can_be_true, can_be_false: self.can_be_false || o.can_be_false }
    }
}

impl BitOr for Undecided {
    type Output = Self;
    #[inline]
    fn bitor(self, o: Self) -> Self {
        Self { can_be_true: self.can_be_true || o.can_be_true, can_be_false: self.can_be_false && o.can_be_false }
    }
}

impl Not for Undecided {
    type Output = Self;
    #[inline]
    fn not(self) -> Self {
        Self { can_be_true: self.can_be_false, can_be_false: self.can_be_true }
    }
}

impl Mask for Undecided {}

impl Interval {
    /// The whole line, infinities included, and everything that is undefined: nothing is known.
    pub const UNKNOWN: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY, nan: true };
    /// 0 alone.
    pub const ZERO: Self = Self { lo: 0.0, hi: 0.0, nan: false };
    /// 1 alone.
    pub const ONE: Self = Self { lo: 1.0, hi: 1.0, nan: false };
    /// `π`, which is between two neighbours in `f64`.
    pub const PI: Self = Self { lo: std::f64::consts::PI, hi: std::f64::consts::PI.next_up(), nan: false };

    /// The numbers from `lo` to `hi`; [`UNKNOWN`](Self::UNKNOWN) if one of them is NaN or they are the wrong way round.
    #[inline]
    pub fn new(lo: f64, hi: f64) -> Self {
        if lo <= hi { Self { lo, hi, nan: false } } else { Self::UNKNOWN }
    }

    /// `x` alone.
    #[inline]
    pub fn point(x: f64) -> Self {
        Self::new(x, x)
    }

    /// Whether `x` is a member.
    #[inline]
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// Whether every member is a finite number: nothing undefined, no infinity.
    #[inline]
    pub fn is_finite(self) -> bool {
        !self.nan && self.lo.is_finite() && self.hi.is_finite()
    }

    /// `hi − lo`, rounded up.
    #[inline]
    pub fn width(self) -> f64 {
        sum_up(self.hi, -self.lo)
    }

    /// A number near the middle, between the ends.
    #[inline]
    pub fn middle(self) -> f64 {
        (0.5 * self.lo + 0.5 * self.hi).clamp(self.lo, self.hi)
    }

    /// The largest of `|x|`.
    #[inline]
    pub fn magnitude(self) -> f64 {
        f64::max(self.lo.abs(), self.hi.abs())
    }

    /// The smallest interval with the members of both.
    #[inline]
    pub fn hull(self, o: Self) -> Self {
        Self { lo: f64::min(self.lo, o.lo), hi: f64::max(self.hi, o.hi), nan: self.nan || o.nan }
    }

    /// The same, marked if `nan`.
    #[inline]
    fn marked(self, nan: bool) -> Self {
        Self { nan: self.nan || nan, ..self }
    }

    /// Whether it is 0 and nothing else.
    #[inline]
    pub(crate) fn is_zero(self) -> bool {
        self.lo == 0.0 && self.hi == 0.0 && !self.nan
    }

    #[inline]
    fn has_infinity(self) -> bool {
        self.lo == f64::NEG_INFINITY || self.hi == f64::INFINITY
    }

    /// The values of a function that increases from `self.lo` to `self.hi`, which `libm` computes; `within` its range.
    #[inline]
    fn increasing(self, f: impl Fn(f64) -> f64, within: (f64, f64)) -> Self {
        Self::around(f(self.lo), f(self.hi), within).marked(self.nan)
    }

    /// From a value of `libm` to another, widened, but not beyond the range of the function.
    #[inline]
    fn around(lo: f64, hi: f64, (least, most): (f64, f64)) -> Self {
        Self::new(widen_down(lo).clamp(least, most), widen_up(hi).clamp(least, most))
    }

    /// The values of a sine with its maxima where `x/2π + phase` is whole: `phase` −1/4 for the sine, 0 for the cosine.
    fn wave(self, phase: f64, f: impl Fn(f64) -> f64) -> Self {
        // Far from 0 the ends in turns are uncertain. 2²⁰ is further than any angle of a formula.
        const FAR: f64 = (1 << 20) as f64;
        // The rounding of an end in turns is below FAR · 2⁻⁵⁰ = 1e-9. To count an extremum which is that little outside
        // costs 2e-17 in the bound; to miss one which is inside would make it false.
        const SLACK: f64 = 1e-9;
        if !(self.lo.abs() <= FAR && self.hi.abs() <= FAR) {
            return Self { lo: -1.0, hi: 1.0, nan: self.nan || self.has_infinity() };
        }
        let turns = |x: f64| x * (1.0 / std::f64::consts::TAU) + phase;
        let (from, to) = (turns(self.lo) - SLACK, turns(self.hi) + SLACK);
        let (of_lo, of_hi) = (f(self.lo), f(self.hi));
        let lo = if (to - 0.5).floor() >= (from - 0.5).ceil() { -1.0 } else { f64::min(of_lo, of_hi) };
        let hi = if to.floor() >= from.ceil() { 1.0 } else { f64::max(of_lo, of_hi) };
        Self::around(lo, hi, (-1.0, 1.0)).marked(self.nan)
    }

    /// `sin self`.
    fn sine(self) -> Self {
        self.wave(-0.25, libm::sin)
    }

    /// `(sin πu, cos πu)`. The cosine of a quarter turn is 0 and no more than 0, which that of a rounded `π/2` is not.
    pub fn half_turns(self) -> (Self, Self) {
        let rest = Self::point(0.5) - self;
        let (sin, cos) = ((Self::PI * self).sine(), (Self::PI * rest).sine());
        // Of angles up to π the sine is not below 0, which the end of a rounded π would be.
        let upper = self.lo >= 0.0 && self.hi <= 1.0;
        (if upper { Self { lo: f64::max(sin.lo, 0.0), hi: f64::max(sin.hi, 0.0), ..sin } } else { sin }, cos)
    }
}

/// The neighbour below, or −∞.
#[inline]
fn down(x: f64) -> f64 {
    x.next_down()
}

/// At least [`ULPS`] below `x`. An exact 0 stays: `log2 1`, `log1p 0`, `sin 0`, `atan2(0, x)` are exact, and underflow of
/// a positive function is cut by its range.
#[inline]
fn widen_down(x: f64) -> f64 {
    // A unit in the last place is at most ε|x|, or the smallest subnormal number.
    const SMALLEST: f64 = 5e-324;
    if x == 0.0 { x } else { down(x - (x.abs() * (ULPS as f64 * f64::EPSILON) + ULPS as f64 * SMALLEST)) }
}

#[inline]
fn widen_up(x: f64) -> f64 {
    -widen_down(-x)
}

/// `a + b`, rounded down. `∞ − ∞` is −∞: nothing is known.
#[inline]
fn sum_down(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if !sum.is_finite() {
        return if sum.is_nan() {
            f64::NEG_INFINITY
        } else if a.is_finite() && b.is_finite() {
            down(sum)
        } else {
            sum
        };
    }
    // What the rounding lost, exactly (Knuth's TwoSum). A NaN of an overflow on the way counts as a loss.
    let b_part = sum - a;
    let lost = (a - (sum - b_part)) + (b - b_part);
    if lost >= 0.0 { sum } else { down(sum) }
}

#[inline]
fn sum_up(a: f64, b: f64) -> f64 {
    -sum_down(-a, -b)
}

/// Whether `x` is a power of two: a factor that changes no digit.
#[inline]
fn is_power_of_two(x: f64) -> bool {
    x.to_bits() << 12 == 0
}

/// `x` rounded down, for a product or quotient that is neither near underflow nor near overflow; otherwise nothing.
///
/// `0.54 ε |x|` is between 0.54 and 1.08 units in the last place of `x`, so the difference rounds to a neighbour below.
#[inline]
fn round_down_in_range(x: f64, exact: bool) -> Option<f64> {
    let size = x.abs();
    if !(size > 1e-290 && size < 1e300) {
        None
    } else if exact {
        Some(x)
    } else {
        Some(x - size * (0.54 * f64::EPSILON))
    }
}

/// A product or quotient of two numbers that are not 0, rounded down: `exact` if a factor is a power of two.
#[inline]
fn round_down(value: f64, positive: bool, exact: bool) -> f64 {
    if value == 0.0 {
        // Underflow: the true value is not 0, but has a sign.
        if positive { 0.0 } else { down(0.0) }
    } else if value.is_infinite() || !(exact && value.is_normal()) {
        down(value)
    } else {
        value
    }
}

/// `a b`, rounded down, with `0 · ∞ = 0`: whoever multiplies marks it.
#[inline]
fn product_down(a: f64, b: f64) -> f64 {
    let product = a * b;
    if let Some(rounded) = round_down_in_range(product, is_power_of_two(a) || is_power_of_two(b)) {
        return rounded;
    }
    if a == 0.0 || b == 0.0 {
        return 0.0;
    }
    if a.is_infinite() || b.is_infinite() {
        return product;
    }
    round_down(product, (a > 0.0) == (b > 0.0), is_power_of_two(a) || is_power_of_two(b))
}

#[inline]
fn product_up(a: f64, b: f64) -> f64 {
    -product_down(-a, b)
}

/// `a/b` of `b ≠ 0`, rounded down, with `∞/∞ = 0`: whoever divides marks it.
#[inline]
fn quotient_down(a: f64, b: f64) -> f64 {
    let quotient = a / b;
    if let Some(rounded) = round_down_in_range(quotient, is_power_of_two(b)) {
        return rounded;
    }
    if a == 0.0 {
        return 0.0;
    }
    if b.is_infinite() {
        // The limit of large divisors, unless both are infinite.
        return 0.0;
    }
    if a.is_infinite() {
        return quotient;
    }
    round_down(quotient, (a > 0.0) == (b > 0.0), is_power_of_two(b))
}

#[inline]
fn quotient_up(a: f64, b: f64) -> f64 {
    -quotient_down(-a, b)
}

impl Add for Interval {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        let opposite = (self.hi == f64::INFINITY && o.lo == f64::NEG_INFINITY)
            || (self.lo == f64::NEG_INFINITY && o.hi == f64::INFINITY);
        Self { lo: sum_down(self.lo, o.lo), hi: sum_up(self.hi, o.hi), nan: self.nan || o.nan || opposite }
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo, nan: self.nan }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let (a, b) = (self, o);
        let nan = a.nan || b.nan || (b.has_infinity() && a.contains(0.0)) || (a.has_infinity() && b.contains(0.0));
        // The corners that hold the extrema, by signs.
        let (lo, hi) = if a.lo >= 0.0 {
            let lo = product_down(if b.lo >= 0.0 { a.lo } else { a.hi }, b.lo);
            (lo, product_up(if b.hi >= 0.0 { a.hi } else { a.lo }, b.hi))
        } else if a.hi <= 0.0 {
            let lo = product_down(if b.hi >= 0.0 { a.lo } else { a.hi }, b.hi);
            (lo, product_up(if b.lo >= 0.0 { a.hi } else { a.lo }, b.lo))
        } else if b.lo >= 0.0 {
            (product_down(a.lo, b.hi), product_up(a.hi, b.hi))
        } else if b.hi <= 0.0 {
            (product_down(a.hi, b.lo), product_up(a.lo, b.lo))
        } else {
            let lo = f64::min(product_down(a.lo, b.hi), product_down(a.hi, b.lo));
            (lo, f64::max(product_up(a.lo, b.lo), product_up(a.hi, b.hi)))
        };
        Self { lo, hi, nan }
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let (a, b) = (self, o);
        let nan = a.nan || b.nan || (a.contains(0.0) && b.contains(0.0)) || (a.has_infinity() && b.has_infinity());
        if b.hi <= 0.0 && b.lo < 0.0 {
            return -a / -b;
        }
        if b.lo < 0.0 || b.hi <= 0.0 {
            return Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY, nan };
        }
        // b is positive, but for an end of 0.
        let lo = if a.lo >= 0.0 {
            quotient_down(a.lo, b.hi)
        } else if b.lo == 0.0 {
            f64::NEG_INFINITY
        } else {
            quotient_down(a.lo, b.lo)
        };
        let hi = if a.hi <= 0.0 {
            quotient_up(a.hi, b.hi)
        } else if b.lo == 0.0 {
            f64::INFINITY
        } else {
            quotient_up(a.hi, b.lo)
        };
        Self { lo, hi, nan }
    }
}

impl Real for Interval {
    type Mask = Undecided;

    // The range of an interval's ends is that of `f64`, but scale and floor are kept as in `f32`: both are parts of the
    // formula, and the certificate is about that of the default.

    #[inline]
    fn lift(self, c: f64) -> Self {
        Self::point(c)
    }
    #[inline]
    fn lt(self, o: Self) -> Undecided {
        Undecided { can_be_true: self.lo < o.hi, can_be_false: self.hi >= o.lo || self.nan || o.nan }
    }
    #[inline]
    fn le(self, o: Self) -> Undecided {
        Undecided { can_be_true: self.lo <= o.hi, can_be_false: self.hi > o.lo || self.nan || o.nan }
    }
    #[inline]
    fn eq(self, o: Self) -> Undecided {
        self.le(o) & o.le(self)
    }
    #[inline]
    fn select(mask: Undecided, a: Self, b: Self) -> Self {
        match (mask.can_be_true, mask.can_be_false) {
            (true, false) => a,
            (false, true) => b,
            _ => a.hull(b),
        }
    }
    #[inline]
    fn abs(self) -> Self {
        let near = if self.contains(0.0) { 0.0 } else { f64::min(self.lo.abs(), self.hi.abs()) };
        Self { lo: near, hi: self.magnitude(), nan: self.nan }
    }
    /// The bound of the roots that exist, marked if some do not.
    fn sqrt(self) -> Self {
        if self.hi < 0.0 || self.hi.is_nan() {
            return Self::UNKNOWN;
        }
        let root = |x: f64| (f64::max(x, 0.0).sqrt(), f64::max(x, 0.0));
        let ((lo, of_lo), (hi, of_hi)) = (root(self.lo), root(self.hi));
        // A root of at most 26 digits has an exact square; if that is the number, the root is exact: 1, 1/4, 9/4, ...
        let exact =
            |r: f64, x: f64| x == 0.0 || !x.is_finite() || (x.is_normal() && r * r == x && r.to_bits() << 37 == 0);
        Self {
            lo: if exact(lo, of_lo) { lo } else { f64::max(down(lo), 0.0) },
            hi: if exact(hi, of_hi) { hi } else { hi.next_up() },
            nan: self.nan || self.lo < 0.0,
        }
    }
    /// Both signs, unless that of every member is known. A 0 has either.
    #[inline]
    fn copysign(self, sign: Self) -> Self {
        let magnitude = self.abs();
        if sign.lo > 0.0 && !sign.nan {
            magnitude
        } else if sign.hi < 0.0 && !sign.nan {
            -magnitude
        } else {
            magnitude.hull(-magnitude)
        }
    }
    fn exp2(self) -> Self {
        let power = self.increasing(libm::exp2, (0.0, f64::INFINITY));
        // Where it underflows it is not 0.
        Self { hi: f64::max(power.hi, f64::MIN_POSITIVE), ..power }
    }
    fn log2(self) -> Self {
        if self.hi < 0.0 || self.hi.is_nan() {
            return Self::UNKNOWN;
        }
        let defined = Self { lo: f64::max(self.lo, 0.0), ..self };
        defined.increasing(libm::log2, (f64::NEG_INFINITY, f64::INFINITY)).marked(self.lo < 0.0)
    }
    fn log2_1p(self) -> Self {
        if self.hi < -1.0 || self.hi.is_nan() {
            return Self::UNKNOWN;
        }
        let defined = Self { lo: f64::max(self.lo, -1.0), ..self };
        let whole = (f64::NEG_INFINITY, f64::INFINITY);
        // 1 ulp of log1p, which may be 2 of the product, 1/2 of the constant's rounding and 1/2 of the product's: below 8.
        defined.increasing(|x| libm::log1p(x) * std::f64::consts::LOG2_E, whole).marked(self.lo < -1.0)
    }
    fn log2_1p_div(self, denominator: Self) -> Self {
        (self / denominator).log2_1p()
    }
    /// The mark is dropped: in `f32` a NaN gives 0 here, and the formula adds it again.
    fn exp2_where(self, mask: Undecided) -> Self {
        let value = Self { nan: false, ..self.exp2() };
        let zero = mask.can_be_false || self.nan;
        match (mask.can_be_true, zero) {
            (true, false) => value,
            (true, true) => value.hull(Self::ZERO),
            _ => Self::ZERO,
        }
    }
    /// `x^y = 2^(y log₂ x)` has its extrema at corners, because `y log₂ x` has them there.
    fn pow(self, exponent: Self) -> Self {
        if self.hi < 0.0 || self.hi.is_nan() {
            return Self::UNKNOWN;
        }
        let base = Self { lo: f64::max(self.lo, 0.0), ..self };
        let power = libm::pow;
        let all = [
            power(base.lo, exponent.lo),
            power(base.lo, exponent.hi),
            power(base.hi, exponent.lo),
            power(base.hi, exponent.hi),
        ];
        let (lo, hi) = all.iter().fold((f64::INFINITY, 0.0), |(lo, hi): (f64, f64), &x| (lo.min(x), hi.max(x)));
        // Where it underflows it is not 0; that of 0 is.
        let hi = if base.hi > 0.0 { f64::max(hi, f64::MIN_POSITIVE) } else { hi };
        // Between a negative and a positive exponent there is x^0 = 1, at infinity and at 0 too.
        let zeroth = if exponent.contains(0.0) { Self::ONE } else { Self::around(lo, hi, (0.0, f64::INFINITY)) };
        Self::around(lo, hi, (0.0, f64::INFINITY)).hull(zeroth).marked(self.lo < 0.0 || self.nan || exponent.nan)
    }
    fn sin_cos(self) -> (Self, Self) {
        (self.sine(), self.wave(0.0, libm::cos))
    }
    /// Seen from outside of a box, the extreme angles are at its corners. With the cut inside, or the origin behind it,
    /// the whole turn.
    fn atan2(self, x: Self) -> Self {
        let (y, pi) = (self, Self::PI.hi);
        let nan = y.nan || x.nan || (y.has_infinity() && x.has_infinity());
        if y.contains(0.0) && x.lo < 0.0 {
            return Self { lo: -pi, hi: pi, nan };
        }
        let angle = |y: f64, x: f64| libm::atan2(y, x + 0.0);
        let corners = [angle(y.lo, x.lo), angle(y.lo, x.hi), angle(y.hi, x.lo), angle(y.hi, x.hi)];
        let (lo, hi) =
            corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi): (f64, f64), &a| (lo.min(a), hi.max(a)));
        Self::around(lo, hi, (-pi, pi)).marked(nan)
    }
    fn erfc(self) -> Self {
        // Decreasing; 0 where it underflows, and 2.
        let ends = Self::around(libm::erfc(self.hi), libm::erfc(self.lo), (0.0, 2.0));
        Self { hi: f64::max(ends.hi, f64::MIN_POSITIVE), nan: self.nan, ..ends }
    }

    #[inline]
    fn max(self, bound: Self) -> Self {
        // A NaN bound is ignored: the result may be self.
        let lo = if bound.nan { self.lo } else { f64::max(self.lo, bound.lo) };
        Self { lo, hi: f64::max(self.hi, bound.hi), nan: self.nan }
    }
    #[inline]
    fn min(self, bound: Self) -> Self {
        let hi = if bound.nan { self.hi } else { f64::min(self.hi, bound.hi) };
        Self { lo: f64::min(self.lo, bound.lo), hi, nan: self.nan }
    }
    /// Nothing is lost: the product, and 0.
    #[inline]
    fn exact_product(self, other: Self) -> (Self, Self) {
        (self * other, Self::ZERO)
    }
    #[inline]
    fn sum_of_products((a, b): (Self, Self), (c, d): (Self, Self)) -> Self {
        a * b + c * d
    }
    /// Two divisions, whose operands occur once.
    #[inline]
    fn quotients((a, b): (Self, Self), (c, d): (Self, Self)) -> (Self, Self) {
        (a / b, c / d)
    }
    /// The difference: an exact form would take the cosine and its sine as two independent numbers.
    #[inline]
    fn one_minus(self, _exact: impl FnOnce() -> Self) -> Self {
        Self::ONE - self
    }
    /// Not below 0, which the product of two independent factors may be.
    #[inline]
    fn squared(self) -> Self {
        let size = self.abs();
        Self { lo: product_down(size.lo, size.lo), hi: product_up(size.hi, size.hi), nan: size.nan }
    }
}

#[cfg(test)]
mod tests;
