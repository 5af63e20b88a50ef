//! Integrals that a constructor needs, in the number type of the result.

use super::Widths;
use crate::number::Real;

/// Nodes and weights of Gauss and Legendre with 16 points on [−1, 1], the positive half.
const LEGENDRE: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_5),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_7),
    (0.755_404_408_355_003, 0.124_628_971_255_533_9),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_8),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_9),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_1),
];

/// `∫ f` from 0 to `end`, by two panels of 16 points.
#[inline]
pub(super) fn from_zero<R: Real>(end: R, f: impl Fn(R) -> R) -> R {
    let quarter = end.times(0.25);
    let mut sum = end.lift(0.0);
    for (node, weight) in LEGENDRE {
        for centre in [1.0, 3.0] {
            for x in [quarter.times(centre - node), quarter.times(centre + node)] {
                sum = sum + f(x).times(weight);
            }
        }
    }
    sum * quarter
}

/// The mean of `f(α²)` over the angles `ψ` of `α² = αx² cos²ψ + αy² sin²ψ`.
///
/// With `tan φ = αy/αx · tan ψ` this is `∫ f(α(φ)²)/α(φ)² dφ · αx αy/2π`, `1/α(φ)² = cos²φ/αx² + sin²φ/αy²`: over `ψ`
/// the integrand of a normalisation hardly varies. The rule of midpoints converges like `((a − 1)/(a + 1))^128` for the
/// aspect ratio `a`, to 1e-7 for 16.
#[inline]
pub(super) fn mean_over_azimuth<R: Real>(widths: &Widths<R>, f: impl Fn(R) -> R) -> R {
    const POINTS: u32 = 64;
    let (x2, y2) = (widths.x.0.squared(), widths.y.0.squared());
    let mut sum = x2.lift(0.0);
    for i in 0..POINTS {
        let angle = (f64::from(i) + 0.5) / f64::from(POINTS) * core::f64::consts::FRAC_PI_2;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        sum = sum + f(x2.times(cos * cos) + y2.times(sin * sin));
    }
    sum.times(1.0 / f64::from(POINTS))
}
