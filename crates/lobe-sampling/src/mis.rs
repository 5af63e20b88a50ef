//! Weights for several samplers of one integral (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte
//! Carlo Rendering", SIGGRAPH 1995).

use lobe::Real;

/// The balance heuristic, for one sample of either: `a/(a + b)`, `a` the density of the sampler that the sample is
/// from, `b` that of the other. 0 for `a = 0`. Equation 10 of Veach and Guibas.
///
/// Written as a quotient of densities, so that neither a sum nor a square leaves the range: a sampler of a sharp lobe
/// has densities beyond 1e30.
#[inline(always)]
pub fn balance<R: Real>(a: R, b: R) -> R {
    share(a, b, |ratio| ratio)
}

/// The power heuristic with the exponent 2: `a²/(a² + b²)`, as [`balance`]. Section 4.2 of Veach and Guibas.
#[inline(always)]
pub fn power<R: Real>(a: R, b: R) -> R {
    share(a, b, R::squared)
}

/// `1/(1 + curve(b/a))`, and from the smaller quotient of both.
#[inline(always)]
fn share<R: Real>(a: R, b: R, curve: impl Fn(R) -> R) -> R {
    let (zero, smaller) = (a.lift(0.0), a.lt(b));
    // By selection, not by `min` and `max`: a NaN in either is then in the quotient.
    let (small, large) = (R::select(smaller, a, b), R::select(smaller, b, a));
    // Both 0: neither sampler has the sample, and 0/0 would be NaN.
    let ratio = curve(small / R::select(large.eq(zero), large.lift(1.0), large));
    let of_larger = ratio.plus(1.0).recip();
    let value = R::select(smaller, ratio * of_larger, of_larger);
    R::select(a.eq(zero) & b.eq(b), zero, value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_sum_to_one_from_the_smallest_to_the_largest() {
        for a in [0.0_f32, 1e-38, 1e-20, 0.3, 1.0, 7.0, 1e20, 3e38] {
            for b in [1e-38_f32, 1e-20, 0.3, 1.0, 7.0, 1e20, 3e38] {
                for heuristic in [balance, power] {
                    let (one, other) = (heuristic(a, b), heuristic(b, a));
                    assert!((one + other - 1.0).abs() <= 1e-6, "{a} {b}: {one} + {other}");
                }
            }
        }
        assert_eq!(balance(3.0_f32, 1.0), 0.75);
        assert_eq!(power(3.0_f32, 1.0), 0.9);
        assert_eq!((balance(0.0_f32, 0.0), power(0.0_f32, 2.0)), (0.0, 0.0));
        assert!(balance(f32::NAN, 1.0).is_nan() && balance(1.0, f32::NAN).is_nan());
    }
}
