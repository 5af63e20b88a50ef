//! The number type of a subject.

/// The number type that a subject computes in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// binary32, `f32`.
    Single,
    /// binary64, `f64`.
    #[default]
    Double,
}

impl Precision {
    /// The number of this type next to `x`.
    #[must_use]
    pub fn round(self, x: f64) -> f64 {
        match self {
            Self::Single => f64::from(x as f32),
            Self::Double => x,
        }
    }

    /// The distance between neighbouring numbers of this type around `x`; that of the subnormal ones near 0.
    #[must_use]
    pub fn ulp(self, x: f64) -> f64 {
        let (least, most, digits) = match self {
            Self::Single => (f64::from(f32::MIN_POSITIVE), f64::from(f32::MAX), 23),
            Self::Double => (f64::MIN_POSITIVE, f64::MAX, 52),
        };
        // `min` before `max` would let a NaN through as the largest number; a NaN counts as the smallest here.
        let magnitude = x.abs().max(least).min(most);
        let exponent = (magnitude.to_bits() >> 52) as i32 - 1023;
        libm::ldexp(1.0, exponent - digits)
    }

    /// `|a − b|` in ulps of the larger. Two NaNs and equal infinities are 0 apart; either on one side only is
    /// infinitely far.
    #[must_use]
    pub fn ulps_between(self, a: f64, b: f64) -> f64 {
        if a == b || (a.is_nan() && b.is_nan()) {
            return 0.0;
        }
        if !(a.is_finite() && b.is_finite()) {
            return f64::INFINITY;
        }
        (a - b).abs() / self.ulp(a.abs().max(b.abs()))
    }

    /// The shortest decimal that reads back the same number of this type.
    #[must_use]
    pub fn print(self, x: f64) -> String {
        match self {
            // A number that is not of this type is printed in full, so that it is never changed on the way.
            Self::Single if f64::from(x as f32) == x => format!("{:?}", x as f32),
            _ => format!("{x:?}"),
        }
    }

    /// The six numbers of a pair, as a line of `lobe eval` without its end.
    #[must_use]
    pub fn line(self, pair: &super::Pair) -> String {
        pair.map(|x| self.print(x)).join(",")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_ulp_apart() {
        for x in [1.0_f32, 1.5, 1e-30, 1e30, 1e-40, 3.0e38] {
            assert_eq!(Precision::Single.ulps_between(x.next_up().into(), x.into()), 1.0, "{x}");
        }
        for x in [1.0_f64, 1.5, 1e-300, 1e300, 1e-310] {
            assert_eq!(Precision::Double.ulps_between(x.next_up(), x), 1.0, "{x}");
        }
        assert_eq!(Precision::Double.ulps_between(f64::NAN, 1.0), f64::INFINITY);
        assert_eq!(Precision::Single.ulps_between(f64::NAN, f64::NAN), 0.0);
    }

    #[test]
    fn what_is_printed_reads_back() {
        let x = Precision::Single.round(0.1);
        assert_eq!(Precision::Single.print(x), "0.1");
        assert_eq!(Precision::Double.print(x), "0.10000000149011612");
        assert_eq!(Precision::Single.print(0.1), "0.1");
        assert_eq!(Precision::Double.print(1e-20), "1e-20");
    }
}
