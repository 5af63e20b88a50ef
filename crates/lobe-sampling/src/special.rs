//! Functions that inversions need.

use core::f64::consts::LN_2;
use lobe::Real;

/// `ln(1 − x)`, not above 0.
#[inline(always)]
pub(crate) fn ln_complement<R: Real>(x: R) -> R {
    (-x).log2_1p().times(LN_2)
}

/// `(e^x − 1)/x`, 1 at 0: by Taylor's series between −1/2 and 1/2, within `4u`.
#[inline(always)]
pub(crate) fn exp_m1_by<R: Real>(x: R) -> R {
    let one = x.lift(1.0);
    let mut series = one;
    // Thirteen terms leave 1e-15 at 1/2.
    for n in (2..=13).rev() {
        series = series * x.times(1.0 / f64::from(n)) + one;
    }
    let small = x.abs().lt(x.lift(0.5));
    R::select(small, series, x.exp().plus(-1.0) / R::select(small, one, x))
}

/// `ln(1 + x)/x` for `x > −1`, 1 at 0.
#[inline(always)]
pub(crate) fn ln_1p_by<R: Real>(x: R) -> R {
    let (one, flat) = (x.lift(1.0), x.eq(x.lift(0.0)));
    let safe = R::select(flat, one, x);
    R::select(flat, one, safe.log2_1p().times(LN_2) / safe)
}

/// `eˣ − 1`, to some units in the last place for small `x` too.
#[inline(always)]
pub(crate) fn exp_m1<R: Real>(x: R) -> R {
    x * exp_m1_by(x)
}

/// The inverse of the error function, for arguments whose magnitude is below 1; in `f32` and `f64` within 5e-7 of it.
///
/// Giles, "Approximating the erfinv Function", GPU Computing Gems, 2011, the polynomials in single precision. Both are
/// computed and one is selected.
#[inline(always)]
pub(crate) fn erf_inv<R: Real>(x: R) -> R {
    let one = x.lift(1.0);
    let w = -((one - x) * (one + x)).ln();
    let horner = |at: R, terms: &[f64; 9]| terms.iter().fold(at.lift(0.0), |sum, c| (sum * at).plus(*c));
    let near = horner(w.plus(-2.5), &NEAR);
    let far = horner(w.max(w.lift(0.0)).sqrt().plus(-3.0), &FAR);
    x * R::select(w.lt(w.lift(5.0)), near, far)
}

const NEAR: [f64; 9] = [
    2.810_226_36e-08,
    3.432_739_39e-07,
    -3.523_387_7e-06,
    -4.391_506_54e-06,
    0.000_218_580_87,
    -0.001_253_725_03,
    -0.004_177_681_64,
    0.246_640_727,
    1.501_409_41,
];
const FAR: [f64; 9] = [
    -0.000_200_214_257,
    0.000_100_950_558,
    0.001_349_343_22,
    -0.003_673_428_44,
    0.005_739_507_73,
    -0.007_622_461_3,
    0.009_438_870_47,
    1.001_674_06,
    2.832_976_82,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quotients_are_smooth_through_zero() {
        for x in [-30.0_f64, -0.6, -0.5, -0.49, -1e-9, 0.0, 1e-300, 0.3, 0.499, 0.5, 3.0] {
            let exact = if x == 0.0 { 1.0 } else { x.exp_m1() / x };
            assert!((exp_m1_by(x) / exact - 1.0).abs() < 2e-15, "{x}");
            let single = f64::from(exp_m1_by(x as f32));
            assert!((single / exact - 1.0).abs() < 4e-7, "{x}: {single}");
        }
        for x in [-0.999_f64, -0.5, -1e-9, 0.0, 1e-300, 0.3, 1e7] {
            let exact = if x == 0.0 { 1.0 } else { x.ln_1p() / x };
            assert!((ln_1p_by(x) / exact - 1.0).abs() < 2e-15, "{x}");
        }
    }

    #[test]
    fn exp_m1_keeps_its_digits() {
        for k in 1..4000 {
            for sign in [-1.0, 1.0] {
                let x = sign * 1e-9 * (f64::from(k) * 0.0057).exp();
                let exact = libm::expm1(x);
                assert!((exp_m1(x) / exact - 1.0).abs() < 1e-14, "{x}");
                let x = x as f32;
                let exact = libm::expm1(f64::from(x));
                assert!((f64::from(exp_m1(x)) / exact - 1.0).abs() < 2e-6, "{x} {} {exact}", exp_m1(x));
            }
        }
        assert_eq!((exp_m1(0.0_f32), exp_m1(1e-40_f32)), (0.0, 1e-40));
    }

    #[test]
    fn erf_inv_is_the_inverse() {
        for k in 1..20_000 {
            let x = 1.0 - 2.0 * f64::from(k) / 20_000.0;
            // To the ends of the 24 bits that are asked for.
            for x in [x, x.signum() * (1.0 - (1.0 - x.abs()).powi(3)).min(1.0 - 6e-8)] {
                let error = libm::erf(erf_inv(x)) - x;
                // As an error of the argument: dx/dy = 2/√π exp(−y²).
                let scale = core::f64::consts::FRAC_2_SQRT_PI * (-erf_inv(x) * erf_inv(x)).exp();
                assert!(error.abs() < 5e-7 * scale * erf_inv(x).abs() + 1e-12, "{x} {error:e}");
            }
        }
    }
}
