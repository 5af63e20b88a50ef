//! Beckmann by visible normals: the slopes that a viewer sees, by a fixed number of steps to the inverse of their
//! distribution.

use super::Facets;
use crate::special::erf_inv;
use core::f64::consts::FRAC_2_SQRT_PI;
use lobe::distribution::{Beckmann, SmithLambda};
use lobe::{Facet, Real, Vec3};

/// Beckmann by visible normals: density of the light `D G₁(v)/(4 n·v)`, which is `D/(4 (1 + Λ(v)) cos θ_v)`.
///
/// Heitz and d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals", EGSR 2014,
/// section 4.2: with widths of 1 the slope across is normally distributed, and the slope `x` along the view has the
/// density `(cos θ − x sin θ) exp(−x²)/√π` up to `cot θ`. Its distribution has no inverse in closed form. It is solved
/// for `erf x` from a first guess, both after Jakob, "An Improved Visible Normal Sampling Routine for the Beckmann
/// Distribution", 2014: five steps of Newton's method, each halved where it would leave the bracket.
///
/// What is drawn has the distribution to 8e-7 of it in `f32`, in `f64` for `u` up to `1 − 1e-13` (test
/// `the_slopes_have_their_distribution`), and ends at a slope of 3.8 widths, beyond which
/// there are 6e-8 of the facets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VisibleSlopes;

/// The last number of `f32` before 1, and what `erf` may be at most: of 1 the inverse is infinite.
const LAST: f64 = 1.0 - 1.0 / 16_777_216.0;
const STEPS: usize = 5;

/// The slope along the view, in widths, for a viewer at `cos`, `sin`.
#[inline(always)]
fn slope<R: Real>(cos: R, sin: R, u: R) -> R {
    let (one, last) = (cos.lift(1.0), cos.lift(LAST));
    let root = FRAC_2_SQRT_PI * 0.5;
    // Along the normal the end of the slopes is at infinity; at 10 there are 1e-45 beyond.
    let end = (cos / sin).min(cos.lift(10.0));
    let erf_end = one - end.erfc();
    let bell = |x: R| sin.times(root) * (-x.squared()).exp();
    let target = u * (cos * erf_end.plus(1.0) + bell(end));

    let theta = sin.atan2(cos);
    let exponent = theta * (theta * theta.times(-0.0594).plus(0.4265)).plus(-0.876);
    let guess = erf_end - erf_end.plus(1.0) * (one - u).pow(exponent.plus(1.0));
    let (mut low, mut high) = (-last, erf_end.min(last));
    let mut b = guess.max(low).min(high);
    for _ in 0..STEPS {
        let x = erf_inv(b);
        let excess = cos * b.plus(1.0) + bell(x) - target;
        let above = excess.gt(cos.lift(0.0));
        high = R::select(above, b, high);
        low = R::select(above, low, b);
        let next = b - excess / (cos - x * sin);
        // At the end of the slopes the density is 0 and the quotient no number, which is in no bracket.
        b = R::select(next.ge(low) & next.le(high), next, (low + high).times(0.5));
    }
    erf_inv(b)
}

impl<R: Real> Facets<R, Beckmann<R>> for VisibleSlopes {
    #[inline(always)]
    fn normal(&self, distribution: &Beckmann<R>, v: Vec3<R>, [x, y]: [R; 2]) -> Vec3<R> {
        let (alpha_x, alpha_y) = distribution.alpha();
        let w = Vec3::new(v.x * alpha_x.0, v.y * alpha_y.0, v.z).normalize();
        let (zero, one, last) = (x.lift(0.0), x.lift(1.0), x.lift(LAST));
        let across = w.x.squared() + w.y.squared();
        // Seen along the normal every azimuth is as good as any other; 0/0 would be NaN.
        let upright = across.le(across.lift(R::MIN_POSITIVE));
        let sin = R::select(upright, zero, across.sqrt());
        let scale = R::select(upright, one, across).rsqrt();
        let (cos_phi, sin_phi) = (R::select(upright, one, w.x * scale), R::select(upright, zero, w.y * scale));
        let along = slope(w.z, sin, x);
        let beside = erf_inv(y.times(2.0).plus(-1.0).max(-last).min(last));
        let slope_x = cos_phi * along - sin_phi * beside;
        let slope_y = sin_phi * along + cos_phi * beside;
        Vec3::new(-slope_x * alpha_x.0, -slope_y * alpha_y.0, one).normalize()
    }

    #[inline(always)]
    fn area(&self, distribution: &Beckmann<R>, v: Vec3<R>, _: &Facet<R>) -> R {
        distribution.facing(v).times(4.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The distribution of the slope along the view, in `f64` by `libm`.
    fn cumulated(cos: f64, sin: f64, x: f64) -> f64 {
        let at = |x: f64| cos * libm::erfc(-x) + sin * (-x * x).exp() / core::f64::consts::PI.sqrt();
        if sin == 0.0 { libm::erfc(-x) / 2.0 } else { at(x.min(cos / sin)) / at(cos / sin) }
    }

    #[test]
    fn the_slopes_have_their_distribution() {
        let mut worst = (0.0_f64, 0.0_f64);
        for cos in [1.0, 0.999_999, 0.99, 0.9, 0.7, 0.5, 0.3, 0.1, 0.01, 1e-3, 1e-6, 0.0] {
            let sin = f64::sqrt((1.0 - cos) * (1.0 + cos));
            for i in 0..20_000 {
                // Evenly, and dense at both ends.
                let x = (f64::from(i) + 0.5) / 20_000.0;
                for u in [x, x.powi(4), 1.0 - x.powi(4)] {
                    // Nearer to 1 the density has nearly ended, and five halvings are too few.
                    let u = u.min(1.0 - 1e-13);
                    let error = cumulated(cos, sin, slope(cos, sin, u)) - u;
                    worst.0 = worst.0.max(error.abs());
                    let (c, s, u) = (cos as f32, sin as f32, (u as f32).min(1.0 - f32::EPSILON / 2.0));
                    let x = slope(c, s, u);
                    let error = cumulated(c.into(), s.into(), x.into()) - f64::from(u);
                    worst.1 = worst.1.max(error.abs());
                }
            }
        }
        std::println!("distribution of the slopes: f64 {:e}, f32 {:e}", worst.0, worst.1);
        assert!(worst.0 < 8e-7 && worst.1 < 8e-7, "{worst:?}");
    }
}
