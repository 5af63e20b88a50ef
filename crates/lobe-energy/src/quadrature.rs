//! Rules of Gauss and Legendre in panels, for functions that are smooth on some scale or other.

use lobe::{Real, Rgb};

/// `∫ f` over the last `length` before `end`, where `f` may behave like a root of the distance: `cos^q` with `q` below
/// 1 does. With the distance `y⁴` it is smooth.
pub(crate) fn up_to(end: f64, length: f64, refinement: u32, f: impl Fn(f64) -> Rgb<f64>) -> Rgb<f64> {
    let root = libm::sqrt(libm::sqrt(Real::max(length, 0.0)));
    panels(0.0, root, refinement, |y| f(end - y * y * y * y) * (4.0 * y * y * y))
}

/// `∫ f` from `from` to `to`, in panels of equal ratio.
pub(crate) fn logarithmic(from: f64, to: f64, refinement: u32, f: impl Fn(f64) -> Rgb<f64>) -> Rgb<f64> {
    if to <= from {
        return Rgb::splat(0.0);
    }
    let (first, last) = (libm::log(from), libm::log(to));
    let count = (libm::ceil((last - first) / 3.0) as u32).max(1) * refinement;
    panels(first, last, count, |t| {
        let x = libm::exp(t);
        f(x) * x
    })
}

/// `∫ f` from `from` to `to`, with `count` panels of sixteen Gauss-Legendre points.
pub(crate) fn panels(from: f64, to: f64, count: u32, f: impl Fn(f64) -> Rgb<f64>) -> Rgb<f64> {
    let half = (to - from) / (2.0 * f64::from(count));
    let mut sum = Rgb::splat(0.0);
    for panel in 0..count {
        let centre = from + half * (2.0 * f64::from(panel) + 1.0);
        for (node, weight) in GAUSS_LEGENDRE_16 {
            sum = sum + (f(centre - half * node) + f(centre + half * node)) * weight;
        }
    }
    sum * half
}

/// The positive nodes of the sixteen-point rule on [−1, 1] and their weights.
const GAUSS_LEGENDRE_16: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_50),
    (0.281_603_550_779_258_91, 0.182_603_415_044_923_59),
    (0.458_016_777_657_227_39, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_75, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003_03, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_74, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_58, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_93, 0.027_152_459_411_754_09),
];
