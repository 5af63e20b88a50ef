//! Elementary functions for 32-bit floats, made only of operations that IEEE 754 rounds exactly, without fusing.
//!
//! Users call them as methods of [`Real`]; they are public for whoever implements `Real` for lanes of their own.
//!
//! They are generic over [`Binary32`], so that lanes run the same operations in the same order as the scalar and give
//! the same bits. No table, no branch, no integer beyond the three bit operations of that trait. The polynomials come
//! from `tools/minimax.py`, which prints them with their bounds; `lobe sweep` tries all 2³² arguments.

use super::Real;

/// A 32-bit binary float, or a bundle of them: what the elementary functions need beyond [`Real`].
///
/// The three methods work on the bits. They are stated in floating-point terms, so that integers never show.
pub trait Binary32: Real {
    /// `self · 2ⁿ`, for `shifter = 1.5·2²³ + n` with integer `n`, where `self` and the result are normal numbers. Adds
    /// the low bits of `shifter`, which hold `n`, to the exponent field.
    fn add_exponent(self, shifter: Self) -> Self;
    /// `1.5·2²³ + k`, with the integer `k` for which `self / (other · 2ᵏ)` is in [2/3, 3/2], for two positive normal
    /// numbers.
    ///
    /// In this form, because `k` then stands in the low bits and no conversion from an integer is needed: on x86 that
    /// instruction waits for the register's last user, and chained the evaluations of a loop to each other.
    fn exponent_over(self, other: Self) -> Self;
    /// `self` with the lowest twelve bits of the significand cleared: two such numbers multiply exactly.
    fn high_part(self) -> Self;
}

/// The elementary functions of [`Real`] for a [`Binary32`]: those of this module.
macro_rules! forward {
    ($($name:ident($($argument:ident: $Type:ty)?) -> $Result:ty;)+) => {$(
        #[inline(always)]
        fn $name(self $(, $argument: $Type)?) -> $Result {
            $crate::number::elementary::$name(self $(, $argument)?)
        }
    )+};
    () => {
        $crate::number::elementary::forward! {
            exp2() -> Self;
            exp2_where(mask: Self::Mask) -> Self;
            log2() -> Self;
            log2_1p() -> Self;
            log2_1p_div(denominator: Self) -> Self;
            pow(exponent: Self) -> Self;
            sin_cos() -> (Self, Self);
            atan2(x: Self) -> Self;
            erfc() -> Self;
        }
    };
}
pub(super) use forward;

/// 1.5·2²³: adding it rounds to an integer, which then stands in the low bits of the sum.
pub(super) const SHIFT: f64 = 12_582_912.0;
/// Results of `exp2` below 2^−126, the smallest normal number, become 0: subnormals are two to five times slower on
/// most machines, and whoever reads a shading value of 1e-38 wants 0.
const EXP2_MIN: f64 = -126.0;
/// 2^128 is the first power beyond the range.
const EXP2_MAX: f64 = 128.0;

/// `1.5·2²³ + round(x)`, for `|x| < 2²²`; ties to even.
#[inline(always)]
fn round_shifter<F: Binary32>(x: F) -> F {
    x.plus(SHIFT)
}

/// `2^x`, within 1 ulp on [−126, 128); 0 below, infinite above.
#[inline(always)]
pub fn exp2<F: Binary32>(x: F) -> F {
    // At 128 the exponent field reaches that of infinity, and the significand is exactly 1.
    exp2_of_sum(x.min(x.lift(EXP2_MAX)), None)
}

/// `2^x` where the mask is true, else 0; 0 below −126 and where `x` is NaN, infinite from 128 on.
///
/// What [`exp2`] gives, except for NaN, with a third fewer selects.
#[inline(always)]
pub fn exp2_where<F: Binary32>(x: F, mask: F::Mask) -> F {
    let x = x.min(x.lift(EXP2_MAX));
    F::select(mask & x.ge(x.lift(EXP2_MIN)), exp2_in_range(x, None), x.lift(0.0))
}

/// `2^(hi + lo)` for `hi + lo ≤ 128` and `|lo|` far below `|hi|`; 0 below −126.
#[inline(always)]
fn exp2_of_sum<F: Binary32>(hi: F, lo: Option<F>) -> F {
    // At −127 the product with 0 below is 0; at −∞ it would be NaN.
    let hi = hi.max(hi.lift(EXP2_MIN - 1.0));
    // Below −126 the value is subnormal, and of a NaN the exponent may have made a number. |0 · x| is 0 or NaN.
    let zero_or_nan = hi.times(0.0).abs();
    F::select(hi.ge(hi.lift(EXP2_MIN)), exp2_in_range(hi, lo), zero_or_nan)
}

/// `2^(hi + lo)` for sums from −126 to 128; the bits of any float elsewhere.
#[inline(always)]
fn exp2_in_range<F: Binary32>(hi: F, lo: Option<F>) -> F {
    // Split off the integer: exact.
    let shifter = round_shifter(hi);
    let r = hi - shifter.plus(-SHIFT);
    let r = lo.map_or(r, |lo| r + lo);
    // 2^r = 1 + r ln 2 + r² Q(r) on [−1/2, 1/2]. Even and odd terms side by side: the chain is half as long.
    let r2 = r * r;
    let q01 = r.times(EXP2_Q1).plus(EXP2_Q0);
    let q23 = r.times(EXP2_Q3).plus(EXP2_Q2);
    let q = q01 + r2 * (q23 + r2.times(EXP2_Q4));
    // What 1 + r ln 2 rounds off is added last. Without it the error is 1.04 ulp. (A range from log₂ 3/4 to log₂ 3/2
    // would do without, if only the integer could be split off exactly there: from −0.4151 it leaves 0.5849, a bit
    // longer.)
    let linear = r.times(EXP2_LINEAR);
    let head = linear.plus(1.0);
    let tail = (linear - head.plus(-1.0)) + r2 * q;
    (head + tail).add_exponent(shifter)
}

// ln 2 and Q(r), minimax on |r| ≤ 1/2.
const EXP2_LINEAR: f64 = 0.693147242069;
const EXP2_Q0: f64 = 0.24022655189;
const EXP2_Q1: f64 = 0.0555027239025;
const EXP2_Q2: f64 = 0.00961706321687;
const EXP2_Q3: f64 = 0.00134182034526;
const EXP2_Q4: f64 = 0.000158203649335;

/// `log₂(m + c) + k`, as a sum of two, for `m + c` in [3/4, 3/2] with `c` below the last place of `m`.
///
/// With `s = (m − 1)/(m + 1)`, `log₂ m = 2/(3 ln 2) · s (3 + s² + s⁴ R(s²))`. Everything that matters is carried in
/// two parts, the high ones with twelve bits so that their products are exact (the method of Cody and Waite, as in the
/// single-precision `pow` of Sun's fdlibm). The sum is good to about 2⁻³⁴ of its value.
#[inline(always)]
fn log2_parts<F: Binary32>(m: F, c: F, k: F) -> (F, F) {
    let n = m.plus(-1.0);
    let d = m.plus(1.0);
    let recip = d.recip();
    // s = s_hi + s_lo.
    let d_hi = d.high_part();
    let d_lo = (m - d_hi.plus(-1.0)) + c;
    let s = (n + c) * recip;
    let s_hi = s.high_part();
    let s_lo = (((n - s_hi * d_hi) - s_hi * d_lo) + c) * recip;
    // 3 + s² + s⁴ R = t_hi + t_lo.
    let z = s * s;
    let r = z.lift(LOG2_R3);
    let r = (r * z).plus(LOG2_R2);
    let r = (r * z).plus(LOG2_R1);
    let r = (r * z).plus(LOG2_R0);
    let r = r * (z * z) + s_lo * (s_hi + s);
    let z_hi = s_hi * s_hi;
    let t_hi = ((z_hi + r).plus(3.0)).high_part();
    let t_lo = r - (t_hi.plus(-3.0) - z_hi);
    // s (3 + s² + s⁴ R) = p_hi + p_lo.
    let u = s_hi * t_hi;
    let w = s_lo * t_hi + t_lo * s;
    let p_hi = (u + w).high_part();
    let p_lo = w - (p_hi - u);
    // Times 2/(3 ln 2), whose high part has eleven bits.
    let y_hi = p_hi.times(LOG2_SCALE_HI);
    let y_lo = p_hi.times(LOG2_SCALE_LO) + p_lo.times(LOG2_SCALE);
    let hi = (y_hi + y_lo + k).high_part();
    (hi, y_lo - ((hi - k) - y_hi))
}

// R(s²), minimax on |s| ≤ 1/5.
const LOG2_R0: f64 = 0.599999904633;
const LOG2_R1: f64 = 0.428588569164;
const LOG2_R2: f64 = 0.332280606031;
const LOG2_R3: f64 = 0.299376577139;
const LOG2_SCALE: f64 = 2.0 / (3.0 * core::f64::consts::LN_2);
const LOG2_SCALE_HI: f64 = 0.961669921875;
const LOG2_SCALE_LO: f64 = LOG2_SCALE - LOG2_SCALE_HI;

/// `log₂ x` as a sum of two, for `x > 0`, subnormal or not.
#[inline(always)]
fn log2_of_positive<F: Binary32>(x: F) -> (F, F) {
    // The exponent field of a subnormal says nothing: scale it up.
    let subnormal = x.lt(x.lift(f32::MIN_POSITIVE as f64));
    let scaled = F::select(subnormal, x.times(TWO_POW_24), x);
    let correction = F::select(subnormal, x.lift(24.0), x.lift(0.0));
    let one = x.lift(1.0);
    let k = scaled.exponent_over(one).plus(-SHIFT);
    let m = scaled.add_exponent((-k).plus(SHIFT));
    log2_parts(m, x.lift(0.0), k - correction)
}

const TWO_POW_24: f64 = 16_777_216.0;

/// `value` for `0 < x < ∞`; −∞ at 0, NaN below, `x` itself at infinity and NaN.
#[inline(always)]
pub(super) fn log2_special_cases<F: Real>(x: F, value: F) -> F {
    let zero = x.lift(0.0);
    let negative_or_x = F::select(x.lt(zero), x.lift(f64::NAN), x);
    let special = F::select(x.eq(zero), x.lift(f64::NEG_INFINITY), negative_or_x);
    F::select(x.gt(zero) & x.lt(x.lift(f64::INFINITY)), value, special)
}

/// `log₂ x`, within 1 ulp.
#[inline(always)]
pub fn log2<F: Binary32>(x: F) -> F {
    let (hi, lo) = log2_of_positive(x);
    log2_special_cases(x, hi + lo)
}

/// `log₂(1 + x)`, within 1 ulp.
#[inline(always)]
pub fn log2_1p<F: Binary32>(x: F) -> F {
    let (zero, one) = (x.lift(0.0), x.lift(1.0));
    // Beyond 2^64 the 1 is no longer felt, and the argument is brought down to where 2^k can be formed.
    let large = x.gt(x.lift(TWO_POW_64));
    let x_scaled = F::select(large, x.times(1.0 / TWO_POW_64), x);
    let correction = F::select(large, x.lift(64.0), zero);
    let (u, c) = two_sum(x_scaled, F::select(large, zero, one));
    let k = u.exponent_over(one).plus(-SHIFT);
    let down = (-k).plus(SHIFT);
    let (hi, lo) = log2_parts(u.add_exponent(down), c * one.add_exponent(down), k + correction);
    // Near zero the argument is all there is: in log2_parts m = 1 and c = x, and the two parts lose nothing but the
    // last bit of a subnormal. Below, a result that is a multiple of x rounds once.
    let value = F::select(x.abs().lt(x.lift(TWO_POW_MINUS_30)), x.times(core::f64::consts::LOG2_E), hi + lo);
    log2_special_cases(one + x, value)
}

pub(super) const TWO_POW_64: f64 = 18_446_744_073_709_551_616.0;
const TWO_POW_MINUS_30: f64 = 1.0 / 1_073_741_824.0;

/// `log₂(1 + a/b)` with one division and a relative error of at most 5·2⁻²⁴, for `a ≥ 0`, or of 5.5·2⁻²⁴ for any
/// `a > −b` if `b` is a power of two; `b` and `a + b` from the smallest normal number to 2¹²⁷.
///
/// With `2ᵏ` so that `(a + b)/(b 2ᵏ)` is near 1, `s = (a + b − b 2ᵏ)/(a + b + b 2ᵏ)` and
/// `log₂(1 + a/b) = k + 2/ln 2 · s + s³ Q(s²)`. In the numerator `b − b 2ᵏ` is 0 for `k = 0`, so that small quotients
/// lose nothing; for larger ones its rounding is small against `k`; for a power of two it is exact.
#[inline(always)]
pub fn log2_1p_div<F: Binary32>(a: F, b: F) -> F {
    let u = a + b;
    let shifter = u.exponent_over(b);
    let b_scaled = b.add_exponent(shifter);
    let s = ((b - b_scaled) + a) / (u + b_scaled);
    let z = s * s;
    let q = (z.times(LOG2_Q0).plus(2.0 * core::f64::consts::LOG2_E)) + (z * z) * z.times(LOG2_Q2).plus(LOG2_Q1);
    q * s + shifter.plus(-SHIFT)
}

// Q(s²), minimax on |s| ≤ 1/5.
const LOG2_Q0: f64 = 0.96180075407;
const LOG2_Q1: f64 = 0.576468169689;
const LOG2_Q2: f64 = 0.438044935465;

/// `x^y`, within 2 ulp, for `x ≥ 0`.
#[inline(always)]
pub fn pow<F: Binary32>(x: F, y: F) -> F {
    let (zero, one) = (x.lift(0.0), x.lift(1.0));
    let infinity = x.lift(f64::INFINITY);
    // Beyond 2^40 any base but 1 has left the range, and the split below would overflow.
    let limit = y.lift(TWO_POW_40);
    let y_in_range = y.min(limit).max(-limit);
    let (log_hi, log_lo) = log2_of_positive(x);
    let y_hi = y_in_range.high_part();
    let lo = (y_in_range - y_hi) * log_hi + y_in_range * log_lo;
    let hi = y_hi * log_hi;
    let max = hi.lift(EXP2_MAX);
    let beyond = (hi + lo).ge(max);
    let value = exp2_of_sum(F::select(beyond, max, hi), Some(F::select(beyond, zero, lo)));
    // 0 and ∞ have no logarithm to multiply.
    let vanishes = (x.eq(zero) & y.gt(zero)) | (x.eq(infinity) & y.lt(zero));
    let at_limit = F::select(vanishes, zero, infinity);
    let value = F::select(x.gt(zero) & x.lt(infinity), value, at_limit);
    let value = F::select(y.eq(zero), one, value);
    // NaN for a negative base and for NaN in either.
    F::select(x.ge(zero) & y.eq(y), value, x.lift(f64::NAN))
}

const TWO_POW_40: f64 = 1_099_511_627_776.0;

/// `(sin x, cos x)`, each within 1 ulp for `|x| ≤ 512`; NaN beyond.
#[inline(always)]
pub fn sin_cos<F: Binary32>(x: F) -> (F, F) {
    // x = k π/2 + r + r_lo. The first three parts of π/2 have 15 bits, k has 9: their products are exact (Cody and
    // Waite). What the subtractions round off is kept in r_lo, since near a multiple of π/2 it is all there is.
    let k = round_shifter(x.times(core::f64::consts::FRAC_2_PI)).plus(-SHIFT);
    let r0 = x - k.times(HALF_PI_1);
    let (r1, e1) = two_sum(r0, k.times(-HALF_PI_2));
    let (r2, e2) = two_sum(r1, k.times(-HALF_PI_3));
    let (r, e3) = two_sum(r2, k.times(-HALF_PI_4));
    let r_lo = e1 + e2 + e3;

    let z = r * r;
    let half_z = z.times(0.5);
    let one = x.lift(1.0);
    let w = one - half_z;
    // sin(r + r_lo) = r + (r³ S(r²) + r_lo cos r), where 1 − r²/2 will do for the cosine; without it the error is
    // 1.02 ulp at 335.3692.
    let p = z.lift(2.83251006294e-6);
    let p = (p * z).plus(-0.000198530644411);
    let p = (p * z).plus(0.00833337940276);
    let p = (p * z).plus(-0.166666671634);
    // The sign is that of r; said again for −0, which the additions turn into 0.
    let sin = (r + (p * z * r + r_lo * w)).copysign(r);
    // cos(r + r_lo) = 1 − r²/2 + (r⁴ C(r²) − r r_lo), and what 1 − r²/2 rounds off.
    let p = z.lift(2.44323273364e-5);
    let p = (p * z).plus(-0.00138873094693);
    let p = (p * z).plus(0.0416666455567);
    let cos = w + (((one - w) - half_z) + (p * (z * z) - r * r_lo));

    quarter_turns(x, k, sin, cos)
}

/// `(sin x, cos x)` for `x = k π/2 + r`, of the sine and the cosine of `r`; NaN beyond the domain.
#[inline(always)]
pub(super) fn quarter_turns<F: Real>(x: F, k: F, sin: F, cos: F) -> (F, F) {
    let one = x.lift(1.0);
    // The quadrant, k modulo 4, as one of −2, −1, 0, 1, 2.
    let quadrant = k - k.times(0.25).plus(SHIFT).plus(-SHIFT).times(4.0);
    let odd = quadrant.abs().eq(one);
    let (s, c) = (F::select(odd, cos, sin), F::select(odd, sin, cos));
    let half_turn = quadrant.abs().eq(x.lift(2.0));
    let s = F::select(half_turn | quadrant.eq(-one), -s, s);
    let c = F::select(half_turn | quadrant.eq(one), -c, c);
    // Beyond the domain nothing is known. Selected, not added: sin(−0) is −0.
    let known = x.abs().le(x.lift(SIN_COS_MAX));
    let nan = x.lift(f64::NAN);
    (F::select(known, s, nan), F::select(known, c, nan))
}

/// The largest angle of [`sin_cos`], in radians.
const SIN_COS_MAX: f64 = 512.0;
/// 15 bits of π/2.
pub(super) const HALF_PI_1: f64 = 1.57073974609375;
const HALF_PI_2: f64 = 0.000056579709053039550781;
const HALF_PI_3: f64 = 9.9208818937768228352e-10;
const HALF_PI_4: f64 = 5.3903025299577647655e-15;

/// The angle of the vector `(x, y)` from −π to π, within 2 ulp; the sign is that of `y`. For components up to 2¹²⁶.
#[inline(always)]
pub fn atan2<F: Binary32>(y: F, x: F) -> F {
    let (zero, one) = (x.lift(0.0), x.lift(1.0));
    let (rise, run) = (y.abs(), x.abs());
    // Below the smallest normal number a product with tan π/8 has few digits, and the tangent would leave the domain of
    // the polynomial: 1.249045 for atan2(6, 2) · 2⁻¹⁴⁹, which is 6 ulp off. A power of two changes no angle.
    let scale = F::select(rise.max(run).lt(x.lift(TWO_POW_MINUS_100)), x.lift(TWO_POW_100), one);
    let (rise, run) = (rise * scale, run * scale);
    let Eighths { low, high, numerator, denominator } = eighths(rise, run);
    let t = numerator / denominator;
    let z = t * t;
    let p = z.lift(ATAN_A4);
    let p = (p * z).plus(ATAN_A3);
    let p = (p * z).plus(ATAN_A2);
    let p = (p * z).plus(ATAN_A1);
    let p = (p * z).plus(ATAN_A0);
    // Counted from an eighth, a quarter or half of a turn, whose last places are added first.
    let start = F::select(low, zero, F::select(high, x.lift(HALF_PI), x.lift(0.5 * HALF_PI)));
    let start_lo = F::select(low, zero, F::select(high, x.lift(HALF_PI_LO), x.lift(0.5 * HALF_PI_LO)));
    let behind = x.lt(zero);
    let sign = F::select(behind, -one, one);
    let start = F::select(behind, x.lift(2.0 * HALF_PI) - start, start);
    let start_lo = F::select(behind, x.lift(2.0 * HALF_PI_LO) - start_lo, start_lo);
    // For a zero `start` the sum is t + t³ A(t²) as it stands.
    let angle = start + (sign * t + (sign * (p * z * t) + start_lo));
    angle.copysign(y)
}

/// The angle of `(run, rise)` in the first quadrant, by a tangent of at most tan π/8.
pub(super) struct Eighths<F: Real> {
    /// It is counted from the first axis,
    pub low: F::Mask,
    /// or from the other one, else from the diagonal.
    pub high: F::Mask,
    pub numerator: F,
    /// Not 0: then the numerator is.
    pub denominator: F,
}

/// The angle is that of `(run, rise)` below π/8; 3π/8 and more is counted from the other axis, and between them from the
/// diagonal: one division, and a tangent of at most tan π/8.
#[inline(always)]
pub(super) fn eighths<F: Real>(rise: F, run: F) -> Eighths<F> {
    let low = rise.le(run.times(TAN_EIGHTH));
    let high = run.lt(rise.times(TAN_EIGHTH));
    let numerator = F::select(low, rise, F::select(high, -run, rise - run));
    let denominator = F::select(low, run, F::select(high, rise, rise + run));
    let denominator = F::select(denominator.eq(run.lift(0.0)), run.lift(1.0), denominator);
    Eighths { low, high, numerator, denominator }
}

const TWO_POW_100: f64 = 1_267_650_600_228_229_401_496_703_205_376.0;
const TWO_POW_MINUS_100: f64 = 1.0 / TWO_POW_100;
/// tan π/8.
const TAN_EIGHTH: f64 = 0.414_213_562_373_095_03;
/// π/2 in `f32`, and what is left.
const HALF_PI: f64 = 1.57079637050628662109375;
const HALF_PI_LO: f64 = core::f64::consts::FRAC_PI_2 - HALF_PI;
// A(t²), minimax on |t| ≤ tan π/8.
const ATAN_A0: f64 = -0.333333164454;
const ATAN_A1: f64 = 0.199985280633;
const ATAN_A2: f64 = -0.142443910241;
const ATAN_A3: f64 = 0.10599167645;
const ATAN_A4: f64 = -0.0609004683793;

/// `erfc x`, within 6 ulp, 3.5e-7 relative; 0 from 9.1875 on.
///
/// From 0.625 on it is `exp(−x²) P(t)/(x + 3)` with `t = (x − 3)/(x + 3)`: of the scaled function only a slow part is
/// left, and all of `x` is in [−1, 0.51]. Nearer to 0 the five roundings of that form would be five steps of a float
/// just below 1, and `1 − x E(x²)` has one. Below 0 it is `2 − erfc(−x)`.
#[inline(always)]
pub fn erfc<F: Binary32>(x: F) -> F {
    let zero = x.lift(0.0);
    let end = x.lift(ERFC_MAX);
    let a = x.abs().min(end);
    // −x² log₂ e as a sum of two: the exponential multiplies the relative error of its argument by 84.
    let a_hi = a.high_part();
    let square_hi = (a_hi * a_hi).high_part();
    let square_lo = (a_hi * a_hi - square_hi) + (a - a_hi) * (a + a_hi);
    let hi = square_hi.times(-LOG2_E_HI);
    let lo = square_hi.times(-LOG2_E_LO) + square_lo.times(-core::f64::consts::LOG2_E);
    let sum = hi + lo;
    let exp = exp2_of_sum(sum, Some(lo - (sum - hi)));
    let recip = a.plus(3.0).recip();
    let t = a.plus(-3.0) * recip;
    let p = t.lift(ERFC_P9);
    let p = (p * t).plus(ERFC_P8);
    let p = (p * t).plus(ERFC_P7);
    let p = (p * t).plus(ERFC_P6);
    let p = (p * t).plus(ERFC_P5);
    let p = (p * t).plus(ERFC_P4);
    let p = (p * t).plus(ERFC_P3);
    let p = (p * t).plus(ERFC_P2);
    let p = (p * t).plus(ERFC_P1);
    let p = (p * t).plus(ERFC_P0);
    let far = F::select(a.ge(end), zero, exp * (p * recip));
    let z = a * a;
    let e = z.lift(ERFC_E4);
    let e = (e * z).plus(ERFC_E3);
    let e = (e * z).plus(ERFC_E2);
    let e = (e * z).plus(ERFC_E1);
    let e = (e * z).plus(ERFC_E0);
    let value = F::select(a.lt(x.lift(ERFC_NEAR)), x.lift(1.0) - e * a, far);
    F::select(x.lt(zero), x.lift(2.0) - value, value)
}

/// A number of every type, just before `erfc` falls below the smallest normal number, at 9.1945.
pub(super) const ERFC_MAX: f64 = 9.1875;
/// Twelve bits of log₂ e, and the rest.
const LOG2_E_HI: f64 = 1.4423828125;
const LOG2_E_LO: f64 = core::f64::consts::LOG2_E - LOG2_E_HI;
/// Up to here 1 − x E(x²).
const ERFC_NEAR: f64 = 0.625;
// E(x²), minimax on 0 ≤ x ≤ 0.625.
const ERFC_E0: f64 = 1.12837910652;
const ERFC_E1: f64 = -0.376122713089;
const ERFC_E2: f64 = 0.11278347671;
const ERFC_E3: f64 = -0.0265436898917;
const ERFC_E4: f64 = 0.00437997048721;
// P(t), minimax on −1 ≤ t ≤ 0.51.
const ERFC_P0: f64 = 1.07400691509;
const ERFC_P1: f64 = -0.883394479752;
const ERFC_P2: f64 = 0.590228319168;
const ERFC_P3: f64 = -0.310466349125;
const ERFC_P4: f64 = 0.119528211653;
const ERFC_P5: f64 = -0.0268374942243;
const ERFC_P6: f64 = -0.00122082454618;
const ERFC_P7: f64 = 0.00307738780975;
const ERFC_P8: f64 = -0.000495043001138;
const ERFC_P9: f64 = -0.000331469957018;

/// `a + b`, and exactly what its rounding lost (Knuth).
#[inline(always)]
fn two_sum<F: Real>(a: F, b: F) -> (F, F) {
    let sum = a + b;
    let a_part = sum - b;
    let b_part = sum - a_part;
    (sum, (a - a_part) + (b - b_part))
}
