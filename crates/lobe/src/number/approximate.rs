//! `Approximate`: a number that trades digits for speed.

use super::elementary::{ERFC_MAX, Eighths, HALF_PI_1, SHIFT, TWO_POW_64, eighths, log2_special_cases, quarter_turns};
use super::{Estimate, Precision, Real, Rough};
use core::marker::PhantomData;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number `F` whose functions are good to the precision `P`, [`Fast`](super::Fast) or [`Coarse`](super::Coarse): for
/// one value `Approximate<f32, Fast>`, for lanes `Approximate<Wide<S>, Fast>`.
///
/// Sums and products are those of `F`, and [`mul_add`](Real::mul_add) is one instruction where the machine has one.
/// What is traded is the rest: divisions and roots by the machine's estimates, if it has any, and short polynomials.
///
/// | function | `Fast` | `Coarse` |
/// |---|---|---|
/// | `1/x`, `1/√x`, `√x` with SSE and AVX2 | 3.7e-4 | 3.7e-4 |
/// | `1/x`, `1/√x`, `√x` with AVX-512 | 6.2e-5 | 6.2e-5 |
/// | `1/√x` of scalars, and of lanes of `wasm` | 1.7e-5 | 6.6e-4 |
/// | `exp2` | 1.5e-4 | 1.8e-3 |
/// | `log2`, `log2_1p` | 1.6e-4 | 9.3e-4 |
/// | `sin`, `cos` | 1.3e-5 | 4.2e-4 |
/// | `atan2` | 3.9e-4 | 1.1e-3 |
/// | `erfc` | 8e-4 | 2.6e-3 |
///
/// These are relative errors, of `sin` and `cos` relative to 1e-3 where they are smaller; the measured ones are in
/// `docs/numerics.md`. `1/x` and `√x` of scalars are exact. The bits may differ from one machine to the next, as its
/// estimates do.
///
/// A finite argument within the domain never gives NaN, and no infinity where `f32` gives none, except that `1/x` and
/// `1/√x` may be infinite below the smallest normal number, 2⁻¹²⁶. Results below that number may become 0, as in
/// [`Real::exp2`], and `1/x` from 2¹²⁵ on. Where `f32` gives an infinity, the result may be a large number instead, as
/// that of `exp2` from 127.5 on is; a root of a number below 2⁻¹²⁶ may be smaller than it should be, `log2` takes
/// 2⁻¹²⁶ in its place, and roots of negative numbers and of infinities may be anything.
///
/// ```
/// use lobe::{Real, number::{Approximate, Fast}};
/// let x: Approximate<f32, Fast> = Approximate::new(2.0);
/// assert!((x.rsqrt().value() - 0.5_f32.sqrt()).abs() < 1e-4);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Approximate<F, P> {
    value: F,
    precision: PhantomData<P>,
}

impl<F, P> Approximate<F, P> {
    /// The number `value`.
    #[inline(always)]
    pub const fn new(value: F) -> Self {
        Self { value, precision: PhantomData }
    }
}

impl<F: Copy, P> Approximate<F, P> {
    /// The number itself.
    #[inline(always)]
    pub fn value(self) -> F {
        self.value
    }
}

macro_rules! operators {
    ($($Trait:ident $method:ident $op:tt)+) => {$(
        impl<F: Real, P> $Trait for Approximate<F, P> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self::new(self.value $op other.value)
            }
        }
    )+};
}
operators!(Add add + Sub sub - Mul mul *);

impl<F: Estimate, P: Rough> Div for Approximate<F, P> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self::new(F::divide(self.value, other.value))
    }
}

impl<F: Real, P> Neg for Approximate<F, P> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.value)
    }
}

/// `2^x` for `x` from −126 to 127.5, and the bits of some float elsewhere.
#[inline(always)]
fn exp2_in_range<F: Estimate, P: Rough>(x: F) -> F {
    let shifter = x.plus(SHIFT);
    let r = x - shifter.plus(-SHIFT);
    P::exp2(r).add_exponent(shifter)
}

/// Where `exp2` ends, a number that is as large as may be and yet no infinity.
const EXP2_MAX: f64 = 127.5;

/// `log₂(2ᵏ (1 + t))` for `1 + t` in [2/3, 3/2].
#[inline(always)]
fn log2_of<F: Estimate, P: Rough>(t: F, k: F) -> F {
    P::log2(t).fused(t, k)
}

/// `log₂ x` for any `x > 0`; a subnormal `x` as the smallest normal number.
#[inline(always)]
fn log2_of_positive<F: Estimate, P: Rough>(x: F) -> F {
    let x = x.max(x.lift(f32::MIN_POSITIVE as f64));
    let shifter = x.exponent_over(x.lift(1.0));
    let k = shifter.plus(-SHIFT);
    log2_of::<F, P>(x.add_exponent((-k).plus(SHIFT)).plus(-1.0), k)
}

impl<F: Estimate, P: Rough> Real for Approximate<F, P> {
    type Mask = F::Mask;
    const ROOT_SCALE: f64 = F::ROOT_SCALE;
    /// Half of that of `f32`: the squares of scaled sums reach 2¹²⁶ there, whose reciprocal some machines estimate as 0.
    const SCALE: f64 = F::SCALE * 0.5;
    const COSINE_SCALE: f64 = 1.0;
    const MIN_POSITIVE: f64 = F::MIN_POSITIVE;

    #[inline(always)]
    fn lift(self, c: f64) -> Self {
        Self::new(self.value.lift(c))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> F::Mask {
        self.value.lt(other.value)
    }
    #[inline(always)]
    fn le(self, other: Self) -> F::Mask {
        self.value.le(other.value)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> F::Mask {
        self.value.eq(other.value)
    }
    #[inline(always)]
    fn select(mask: F::Mask, a: Self, b: Self) -> Self {
        Self::new(F::select(mask, a.value, b.value))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::new(self.value.abs())
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self::new(self.value.copysign(sign.value))
    }
    /// The estimates of 0 are infinite, and `0 · ∞` would be NaN.
    #[inline(always)]
    fn off_zero(self) -> Self {
        self.max(self.lift(Self::MIN_POSITIVE))
    }
    #[inline(always)]
    fn max(self, bound: Self) -> Self {
        Self::new(self.value.max(bound.value))
    }
    #[inline(always)]
    fn min(self, bound: Self) -> Self {
        Self::new(self.value.min(bound.value))
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self::new(self.value.fused(a.value, b.value))
    }
    /// The difference as it stands: its rounding is below what the estimates leave of any cosine.
    #[inline(always)]
    fn one_minus(self, _exact: impl FnOnce() -> Self) -> Self {
        Self::new(self.value.lift(1.0) - self.value)
    }
    #[inline(always)]
    fn sum_of_products((a, b): (Self, Self), (c, d): (Self, Self)) -> Self {
        a.mul_add(b, c * d)
    }
    #[inline(always)]
    fn quotients((a, b): (Self, Self), (c, d): (Self, Self)) -> (Self, Self) {
        (a / b, c / d)
    }
    #[inline(always)]
    fn recip(self) -> Self {
        Self::new(self.value.recip_estimate())
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::new(self.value.sqrt_estimate())
    }
    #[inline(always)]
    fn sqrt_of_normal(self) -> Self {
        Self::new(self.value.sqrt_of_normal_estimate())
    }
    #[inline(always)]
    fn rsqrt(self) -> Self {
        Self::new(self.value.rsqrt_estimate::<P>())
    }

    #[inline(always)]
    fn exp2(self) -> Self {
        let x = self.value.min(self.value.lift(EXP2_MAX));
        // Below −126 the value is subnormal, and of a NaN the exponent may have made a number. |0 · x| is 0 or NaN; at
        // −127, not at −∞.
        let x = x.max(x.lift(-127.0));
        Self::new(F::select(x.ge(x.lift(-126.0)), exp2_in_range::<F, P>(x), x.times(0.0).abs()))
    }
    #[inline(always)]
    fn exp2_where(self, mask: F::Mask) -> Self {
        let x = self.value.min(self.value.lift(EXP2_MAX));
        Self::new(F::select(mask & x.ge(x.lift(-126.0)), exp2_in_range::<F, P>(x), x.lift(0.0)))
    }
    #[inline(always)]
    fn log2(self) -> Self {
        Self::new(log2_special_cases(self.value, log2_of_positive::<F, P>(self.value)))
    }
    #[inline(always)]
    fn log2_1p(self) -> Self {
        let x = self.value;
        let one = x.lift(1.0);
        // Beyond 2^64 the 1 is no longer felt; there 2^k could not be formed.
        let x_scaled = x.min(x.lift(TWO_POW_64));
        let u = x_scaled + one;
        let shifter = u.max(one.lift(f32::MIN_POSITIVE as f64)).exponent_over(one);
        let k = shifter.plus(-SHIFT);
        let down = one.add_exponent((-k).plus(SHIFT));
        // (1 + x) 2⁻ᵏ − 1 without the rounding of 1 + x, which for small x is all there is.
        let t = x_scaled.fused(down, down.plus(-1.0));
        let near = log2_of::<F, P>(t, k);
        let value = F::select(x.gt(x_scaled), log2_of_positive::<F, P>(x), near);
        Self::new(log2_special_cases(one + x, value))
    }
    #[inline(always)]
    fn log2_1p_div(self, denominator: Self) -> Self {
        let (a, b) = (self.value, denominator.value);
        let u = a + b;
        let shifter = u.exponent_over(b);
        let b_scaled = b.add_exponent(shifter);
        let s = F::divide((b - b_scaled) + a, u + b_scaled);
        Self::new(log2_ratio(s * s).fused(s, shifter.plus(-SHIFT)))
    }
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        let (x, y) = (self.value, exponent.value);
        let (zero, one) = (x.lift(0.0), x.lift(1.0));
        let power = y * log2_of_positive::<F, P>(x);
        let value = Self::new(power).exp2().value;
        // 0 and ∞ are no powers of 2 that a number could hold.
        let vanishes = (x.eq(zero) & y.gt(zero)) | (x.eq(x.lift(f64::INFINITY)) & y.lt(zero));
        let at_limit = F::select(vanishes, zero, x.lift(f64::INFINITY));
        let value = F::select(x.gt(zero) & x.lt(x.lift(f64::INFINITY)), value, at_limit);
        let value = F::select(y.eq(zero), one, value);
        Self::new(F::select(x.ge(zero) & y.eq(y), value, x.lift(f64::NAN)))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let x = self.value;
        // k has 9 bits, the first part of π/2 has 15: the product is exact.
        let k = x.times(core::f64::consts::FRAC_2_PI).plus(SHIFT).plus(-SHIFT);
        let r = (x - k.times(HALF_PI_1)) - k.times(core::f64::consts::FRAC_PI_2 - HALF_PI_1);
        let z = r * r;
        let (s, c) = quarter_turns(x, k, P::sin(z) * r, cosine(z));
        (Self::new(s), Self::new(c))
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let (y, x) = (self.value, x.value);
        let zero = x.lift(0.0);
        let (rise, run) = (y.abs(), x.abs());
        // The quotient of two subnormal numbers is one of estimates that have none.
        let small = rise.max(run).lt(x.lift(TWO_POW_MINUS_90));
        let scale = F::select(small, x.lift(1.0 / TWO_POW_MINUS_90), x.lift(1.0));
        let (rise, run) = (rise * scale, run * scale);
        let Eighths { low, high, numerator, denominator } = eighths(rise, run);
        let t = F::divide(numerator, denominator);
        let start = F::select(low, zero, F::select(high, x.lift(HALF_PI), x.lift(0.5 * HALF_PI)));
        let angle = P::atan(t * t).fused(t, start);
        let angle = F::select(x.lt(zero), x.lift(core::f64::consts::PI) - angle, angle);
        Self::new(angle.copysign(y))
    }
    #[inline(always)]
    fn erfc(self) -> Self {
        let x = self.value;
        let (zero, end) = (x.lift(0.0), x.lift(ERFC_MAX));
        let a = x.abs().min(end);
        let exp = exp2_in_range::<F, P>((a * a).times(-core::f64::consts::LOG2_E));
        let recip = a.plus(3.0).recip_estimate();
        let p = P::erfc(a.plus(-3.0) * recip);
        let value = F::select(a.ge(end), zero, exp * (p * recip));
        Self::new(F::select(x.lt(zero), x.lift(2.0) - value, value))
    }
}

const TWO_POW_MINUS_90: f64 = 1.0 / (1_237_940_039_285_380_274_899_124_224_u128 as f64);
const HALF_PI: f64 = core::f64::consts::FRAC_PI_2;

// Minimax, by `tools/minimax.py`, with the relative errors that it prints.

/// `Σ cᵢ xⁱ`, the lowest coefficient first, as functions: a loop over a slice would stay a loop where a compiler is asked
/// for small code.
macro_rules! polynomials {
    ($($(#[$doc:meta])* $vis:vis fn $name:ident($lowest:literal $(, $c:literal)*);)+) => {$(
        $(#[$doc])*
        #[inline(always)]
        $vis fn $name<F: Estimate>(x: F) -> F {
            polynomials!(@ x; $lowest $(, $c)*)
        }
    )+};
    (@ $x:ident; $last:literal) => { $x.lift($last) };
    (@ $x:ident; $c:literal, $($rest:literal),+) => { polynomials!(@ $x; $($rest),+).fused($x, $x.lift($c)) };
}

polynomials! {
    /// `2/ln 2 atanh(s)/s` in `s²`, |s| ≤ 1/5: 4.2e-5.
    fn log2_ratio(2.88527035713, 0.985519647598);
    /// `cos r` in `r²`, |r| ≤ π/4: 1.2e-5.
    fn cosine(0.99998819828, -0.499685496092, 0.040362291038);
}

/// The bits from which those of `x` take half, for a number near `0.9/√x`: of all starts, the one whose guesses differ
/// least, so that the polynomial has the least to mend (`tools/minimax.py`).
pub(super) const RSQRT_START: u32 = 0x5f20_0000;

/// `y P(x y²)`, for a first guess `y` of `1/√x`.
#[inline(always)]
pub(super) fn refine_rsqrt<F: Estimate, P: Rough>(x: F, guess: F) -> F {
    P::rsqrt(x * guess * guess) * guess
}

macro_rules! precisions {
    ($($(#[$doc:meta])* $Precision:ident $name:literal;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct $Precision;

        impl Precision for $Precision {
            type Of<F: Estimate> = Approximate<F, Self>;
            const NAME: &'static str = $name;
            #[inline(always)]
            fn number<F: Estimate>(value: F) -> Approximate<F, Self> {
                Approximate::new(value)
            }
            #[inline(always)]
            fn value<F: Estimate>(number: Approximate<F, Self>) -> F {
                number.value
            }
        }
    )+};
}
precisions! {
    /// Good to about 13 binary digits: what the machine's estimates give, fused, with polynomials to match.
    Fast "fast";
    /// Good to about 10 binary digits, which is enough for a picture of eight bits.
    Coarse "coarse";
}

impl Rough for Fast {
    polynomials! {
        /// 7.5e-5.
        fn exp2(0.999928057194, 0.693260967731, 0.242611125112, 0.0551716610789);
        /// 1.1e-4.
        fn log2(1.44257605076, -0.720041871071, 0.488808512688, -0.399336069822, 0.243388086557);
        /// 1.5e-6.
        fn sin(0.999998509884, -0.166623815894, 0.00815005600452);
        /// 1.8e-5.
        fn atan(0.999981999397, -0.331390678883, 0.168229267001);
        /// 2.5e-5.
        fn erfc(1.07401132584, -0.883166968822, 0.589925229549, -0.313214629889, 0.12068425864, -0.0190720353276);
        /// 1.6e-5.
        fn rsqrt(2.10235500336, -1.76092863083, 0.663153171539);
    }
}

impl Rough for Coarse {
    polynomials! {
        /// 1.7e-3.
        fn exp2(1.00044310093, 0.703448057175, 0.238428905606);
        /// 6.5e-4.
        fn log2(1.4419605732, -0.726704597473, 0.520462632179, -0.31647926569);
        /// 4.1e-4.
        fn sin(0.999591588974, -0.161535084248);
        /// 6.4e-4.
        fn atan(0.99936401844, -0.302539139986);
        /// 2.1e-4.
        fn erfc(1.07418084145, -0.882398784161, 0.584629356861, -0.319864779711, 0.13828741014);
        /// 6.5e-4.
        fn rsqrt(1.6819139719, -0.703952074051);
    }
}
