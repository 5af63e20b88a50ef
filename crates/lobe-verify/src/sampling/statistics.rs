//! Distribution functions of the tests, and the correction for many of them.

use std::f64::consts::SQRT_2;

/// The regularised gamma function `Q(a, x) = Γ(a, x)/Γ(a)`, for `a > 0`, `x > 0`: by the series of `P` (DLMF 8.7.1)
/// where that has positive terms that fall at once, by the continued fraction of `Q` (DLMF 8.9.2) elsewhere. Its digits
/// are those of `ln Γ(a)`: 1e-12 for `a` of some hundreds.
fn gamma_tail(a: f64, x: f64) -> f64 {
    let front = libm::exp(a * x.ln() - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (a.recip(), a.recip(), a);
        while term > sum * 1e-17 {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return 1.0 - front * sum;
    }
    front * continued(x + 1.0 - a, |n| (n * (a - n), x + 1.0 - a + 2.0 * n))
}

/// The regularised beta function `Iₓ(a, b)`, by its continued fraction (DLMF 8.17.22) on the side of the mean where it
/// converges quickly.
fn beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - beta(b, a, 1.0 - x);
    }
    let log = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b) + a * x.ln() + b * libm::log1p(-x);
    let term = |n: f64| {
        let m = (0.5 * n).floor();
        let (even, odd) = (m * (b - m) * x, -(a + m) * (a + b + m) * x);
        if n % 2.0 == 0.0 { even / ((a + n - 1.0) * (a + n)) } else { odd / ((a + n - 1.0) * (a + n)) }
    };
    libm::exp(log) / a * continued(1.0, |n| (term(n), 1.0))
}

/// `1/(b₀ + a₁/(b₁ + a₂/(b₂ + …)))`, from the top (the modified algorithm of Lentz; Thompson and Barnett, "Coulomb and
/// Bessel Functions of Complex Arguments and Order", J. Comput. Phys. 64, 1986). `terms` gives `aₙ` and `bₙ`.
fn continued(first: f64, terms: impl Fn(f64) -> (f64, f64)) -> f64 {
    // A denominator of 0 would end it; the next step takes this out again.
    let not_zero = |x: f64| if x.abs() < 1e-300 { 1e-300 } else { x };
    let mut value = not_zero(first);
    let (mut c, mut d) = (value, 0.0);
    for n in 1..1_000_000 {
        let (a, b) = terms(f64::from(n));
        d = not_zero(b + a * d).recip();
        c = not_zero(b + a / c);
        value *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    value.recip()
}

/// `P(χ²ₖ ≥ x)` for `k` degrees of freedom: the regularised gamma function `Q(k/2, x/2)`.
pub(crate) fn chi_squared_tail(degrees: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    // Beyond this the tail is 0 in `f64`, and the continued fraction is spared.
    if x > 40.0 * degrees + 4000.0 {
        return 0.0;
    }
    gamma_tail(0.5 * degrees, 0.5 * x).clamp(0.0, 1.0)
}

/// The same of the noncentral distribution with the parameter `lambda`: a mixture of central ones, with the weights of
/// a Poisson distribution (Johnson, Kotz and Balakrishnan, "Continuous Univariate Distributions", volume 2, 1995,
/// equation 29.2).
pub(crate) fn noncentral_tail(degrees: f64, lambda: f64, x: f64) -> f64 {
    let mean = 0.5 * lambda;
    if mean <= 0.0 {
        return chi_squared_tail(degrees, x);
    }
    // Ten standard deviations to both sides of the mean hold all but 1e-20 of the weight.
    let wide = 10.0 * mean.sqrt() + 20.0;
    let (first, last) = ((mean - wide).max(0.0) as u64, (mean + wide) as u64);
    let log_weight = |j: f64| j * mean.ln() - mean - libm::lgamma(j + 1.0);
    let sum: f64 = (first..=last)
        .map(|j| j as f64)
        .map(|j| libm::exp(log_weight(j)) * chi_squared_tail(degrees + 2.0 * j, x))
        .sum();
    sum.min(1.0)
}

/// The `x` with `P(χ²ₖ ≥ x) = p`, by bisection.
pub(crate) fn chi_squared_critical(degrees: f64, p: f64) -> f64 {
    let mut high = degrees + 10.0;
    while chi_squared_tail(degrees, high) > p {
        high *= 2.0;
    }
    bisect(0.0, high, |x| chi_squared_tail(degrees, x) < p)
}

/// The noncentrality at which the test of size `p` finds a fault with the probability `power`.
pub(crate) fn noncentrality_found(degrees: f64, p: f64, power: f64) -> f64 {
    let critical = chi_squared_critical(degrees, p);
    let mut high = critical + 100.0;
    while noncentral_tail(degrees, high, critical) < power {
        high *= 2.0;
    }
    bisect(0.0, high, |lambda| noncentral_tail(degrees, lambda, critical) > power)
}

/// Where a condition that holds from some number on begins to hold.
fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if holds(middle) { high = middle } else { low = middle }
    }
    high
}

/// `P(|Z| ≥ z)` of a standard normal variable.
pub(crate) fn two_sided_normal(z: f64) -> f64 {
    libm::erfc(z.abs() / SQRT_2)
}

/// Bernstein's bound of `P(|mean − μ| ≥ distance)` for `count` independent numbers that are within `most` of their mean
/// `μ`: `2 exp(−n d²/(2 (σ² + most·d/3)))`. For numbers of any distribution, where the normal one is not yet near.
pub(crate) fn bernstein(count: f64, variance: f64, most: f64, distance: f64) -> f64 {
    if distance <= 0.0 {
        return 1.0;
    }
    let exponent = count * distance * distance / (2.0 * (variance + most * distance / 3.0));
    (2.0 * libm::exp(-exponent)).min(1.0)
}

/// The probability of a distance of at least `distance` between the distribution function of `count` samples and the
/// true one, after Kolmogorov and Smirnov, with the correction for few samples of Stephens, "Use of the
/// Kolmogorov-Smirnov, Cramér-von Mises and Related Statistics Without Extensive Tables", J. R. Stat. Soc. B 32, 1970.
pub(crate) fn kolmogorov_tail(count: f64, distance: f64) -> f64 {
    let root = count.sqrt();
    let x = (root + 0.12 + 0.11 / root) * distance;
    // The series converges slowly where the probability is 1.
    if x < 0.3 {
        return 1.0;
    }
    let term = |j: i32| {
        let j = f64::from(j);
        let sign = if j % 2.0 == 1.0 { 2.0 } else { -2.0 };
        sign * libm::exp(-2.0 * j * j * x * x)
    };
    (1..=40).map(term).sum::<f64>().clamp(0.0, 1.0)
}

/// How unlikely `hits` of `count` are, two-sided, if the probability of one is somewhere in `[low, high]`: of the
/// number in there that explains them best.
pub(crate) fn binomial(count: u64, hits: u64, low: f64, high: f64) -> f64 {
    let (n, k) = (count as f64, hits as f64);
    let (low, high) = (low.clamp(0.0, 1.0), high.clamp(0.0, 1.0));
    let share = k / n;
    if (low..=high).contains(&share) {
        return 1.0;
    }
    let one_sided = if share > high {
        // P(X ≥ k) = I_p(k, n − k + 1), and 0 of nothing.
        if high == 0.0 { 0.0 } else { beta(k, n - k + 1.0, high) }
    } else if low == 1.0 {
        0.0
    } else {
        // P(X ≤ k) = I_{1−p}(n − k, k + 1).
        beta(n - k, k + 1.0, 1.0 - low)
    };
    (2.0 * one_sided).min(1.0)
}

/// Holm's step-down correction ("A Simple Sequentially Rejective Multiple Test Procedure", Scand. J. Stat. 6, 1979): of
/// each `p` the smallest significance of the *whole* family at which its test is rejected. The chance of any false
/// alarm is that significance at most, however the tests depend on each other.
pub(crate) fn holm(ps: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..ps.len()).collect();
    let at = |index: usize| ps.get(index).copied().unwrap_or(1.0);
    order.sort_by(|a, b| at(*a).total_cmp(&at(*b)));
    let mut adjusted = vec![1.0; ps.len()];
    let mut least = 0.0_f64;
    for (rank, index) in order.into_iter().enumerate() {
        let left = (ps.len() - rank) as f64;
        least = least.max(left * at(index)).min(1.0);
        if let Some(slot) = adjusted.get_mut(index) {
            *slot = least;
        }
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, relative: f64) {
        assert!((a - b).abs() <= relative * b.abs(), "{a:e} for {b:e}");
    }

    /// For an even number of degrees the tail is a finite sum, that of a Poisson distribution.
    #[test]
    fn the_tail_of_chi_squared_is_its_closed_form() {
        for half in [1_u32, 2, 10, 64, 300] {
            for times in [0.1, 0.5, 1.0, 1.5, 2.0, 3.0] {
                let x = times * f64::from(half);
                let sum: f64 =
                    (0..half).map(|j| libm::exp(f64::from(j) * x.ln() - x - libm::lgamma(f64::from(j) + 1.0))).sum();
                let degrees = f64::from(2 * half);
                // Next to 1 the digits are those of 1.
                assert!((chi_squared_tail(degrees, 2.0 * x) - sum).abs() <= 1e-9 * sum + 1e-12, "{half} {x}: {sum:e}");
            }
        }
    }

    #[test]
    fn the_noncentral_tail_has_its_mean_and_the_central_one_as_its_limit() {
        close(noncentral_tail(9.0, 0.0, 12.0), chi_squared_tail(9.0, 12.0), 1e-12);
        // The mean is the integral of the tail: k + λ.
        for (k, lambda) in [(5.0, 3.0), (100.0, 40.0), (3.0, 400.0)] {
            let step = 0.1;
            let integral: f64 =
                (0..20_000).map(|i| noncentral_tail(k, lambda, step * (f64::from(i) + 0.5)) * step).take(15_000).sum();
            close(integral, k + lambda, 1e-3);
        }
        let lambda = noncentrality_found(255.0, 1e-6, 0.9);
        close(noncentral_tail(255.0, lambda, chi_squared_critical(255.0, 1e-6)), 0.9, 1e-6);
    }

    #[test]
    fn kolmogorov_s_tail_is_that_of_the_tables() {
        // The asymptotic critical values for 0.05 and 0.01.
        close(kolmogorov_tail(1e12, 1.358_099e-6), 0.05, 1e-4);
        close(kolmogorov_tail(1e12, 1.627_624e-6), 0.01, 1e-4);
        assert_eq!(kolmogorov_tail(100.0, 0.0), 1.0);
    }

    #[test]
    fn the_binomial_tail_is_the_sum_of_its_terms() {
        // P(X ≥ 3 of 10 with 0.1) = 0.0701908264, P(X ≤ 1 of 10 with 0.5) = 11/1024.
        close(binomial(10, 3, 0.1, 0.1), 2.0 * 0.070_190_826_4, 1e-8);
        close(binomial(10, 1, 0.5, 0.5), 22.0 / 1024.0, 1e-10);
        assert_eq!(binomial(10, 1, 0.05, 0.2), 1.0);
        assert_eq!((binomial(10, 1, 0.0, 0.0), binomial(10, 9, 1.0, 1.0)), (0.0, 0.0));
        assert_eq!((binomial(10, 0, 0.0, 0.0), binomial(10, 10, 1.0, 1.0)), (1.0, 1.0));
    }

    #[test]
    fn holm_is_that_of_a_small_example() {
        let adjusted = holm(&[0.01, 0.04, 0.03, 0.005]);
        for (a, b) in adjusted.iter().zip([0.03, 0.06, 0.06, 0.02]) {
            close(*a, b, 1e-12);
        }
        assert!(holm(&[]).is_empty());
    }
}
