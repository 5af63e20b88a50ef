//! Errors in units in the last place.

/// `|value − exact|` in ulps of `exact` as a 32-bit float: the distance between the two floats around `exact`.
///
/// Equal infinities and two NaNs are 0 apart; a NaN or an infinity on one side only is infinitely far. An `exact`
/// beyond the largest float counts as infinity from half an ulp on, as IEEE 754 rounds it.
pub fn ulps_between(value: f32, exact: f64) -> f64 {
    if value.is_nan() || exact.is_nan() {
        return if value.is_nan() && exact.is_nan() { 0.0 } else { f64::INFINITY };
    }
    if value.is_infinite() || exact.is_infinite() {
        let same = f64::from(value) == exact || f64::from(value) == f64::from(exact as f32);
        return if same { 0.0 } else { f64::INFINITY };
    }
    (f64::from(value) - exact).abs() / ulp(exact)
}

/// The distance between neighbouring 32-bit floats around `x`; that of the subnormal numbers near zero.
pub fn ulp(x: f64) -> f64 {
    let magnitude = x.abs().max(f64::from(f32::MIN_POSITIVE)).min(f64::from(f32::MAX));
    let exponent = (magnitude.to_bits() >> 52) as i32 - 1023;
    libm::ldexp(1.0, exponent - 23)
}

/// Median, 99th percentile and worst of a list of errors, which is sorted on the way. All 0 for an empty list.
pub fn summary(errors: &mut [f64]) -> Summary {
    errors.sort_by(f64::total_cmp);
    let at = |part: f64| {
        let last = errors.len().saturating_sub(1);
        errors.get((last as f64 * part).round() as usize).copied().unwrap_or(0.0)
    };
    Summary { median: at(0.5), percentile_99: at(0.99), worst: at(1.0) }
}

/// What a list of errors comes down to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Half of the errors are at most this.
    pub median: f64,
    /// Of a hundred errors, 99 are at most this.
    pub percentile_99: f64,
    /// None is larger.
    pub worst: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_step_is_one_ulp_everywhere() {
        for x in [1.0_f32, 1.5, 1e-30, 1e30, 1e-40, f32::MIN_POSITIVE, 3.0e38] {
            let next = f32::from_bits(x.to_bits() + 1);
            assert_eq!(ulps_between(next, f64::from(x)), 1.0, "{x}");
        }
    }

    #[test]
    fn infinities_and_nans_are_compared_as_such() {
        assert_eq!(ulps_between(f32::INFINITY, 1e300), 0.0);
        assert_eq!(ulps_between(f32::INFINITY, 3.0e38), f64::INFINITY);
        assert_eq!(ulps_between(f32::NAN, f64::NAN), 0.0);
        assert_eq!(ulps_between(f32::NAN, 1.0), f64::INFINITY);
        assert_eq!(ulps_between(1.0, f64::NAN), f64::INFINITY);
    }

    #[test]
    fn a_summary_picks_by_rank() {
        let mut errors: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        assert_eq!(summary(&mut errors), Summary { median: 50.0, percentile_99: 99.0, worst: 100.0 });
        assert_eq!(summary(&mut []).worst, 0.0);
    }
}
