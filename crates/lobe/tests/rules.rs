//! The rules of the number types: what `max`, `min`, `select` and the comparisons do with NaN and zeros, decided once
//! and the same for every type; and what the elementary functions do at the ends of their domains.

use lobe::Real;

macro_rules! rules {
    ($name:ident, $number:ty) => {
        mod $name {
            use super::*;
            const NAN: $number = <$number>::NAN;
            const INF: $number = <$number>::INFINITY;

            #[test]
            fn max_and_min_keep_a_nan_in_the_receiver_and_ignore_one_in_the_bound() {
                assert!(Real::max(NAN, 1.0).is_nan() && Real::min(NAN, 1.0).is_nan());
                let one: $number = 1.0;
                assert_eq!(Real::max(one, NAN), 1.0);
                assert_eq!(Real::min(one, NAN), 1.0);
                assert_eq!((Real::max(one, 2.0), Real::min(one, 2.0)), (2.0, 1.0));
                assert_eq!((Real::max(one, -2.0), Real::min(one, -2.0)), (1.0, -2.0));
                // Of two zeros the receiver.
                assert!(Real::max(-0.0 as $number, 0.0).is_sign_negative());
                assert!(Real::min(0.0 as $number, -0.0).is_sign_positive());
            }

            #[test]
            fn comparisons_with_nan_are_false() {
                for x in [0.0, 1.0, INF, NAN] {
                    assert!(!Real::lt(x, NAN) && !Real::le(x, NAN) && !Real::eq(x, NAN));
                    assert!(!Real::gt(x, NAN) && !Real::ge(x, NAN) && Real::ne(x, NAN));
                    assert!(!Real::lt(NAN, x) && !Real::le(NAN, x));
                }
                assert!(Real::eq(0.0 as $number, -0.0));
            }

            #[test]
            fn select_returns_the_operand_bit_for_bit() {
                let odd = <$number>::from_bits(NAN.to_bits() | 5);
                assert_eq!(<$number as Real>::select(true, odd, 1.0).to_bits(), odd.to_bits());
                assert_eq!(<$number as Real>::select(false, 1.0, -0.0).to_bits(), (-0.0 as $number).to_bits());
            }

            #[test]
            fn functions_hand_nan_on() {
                assert!(Real::exp2(NAN).is_nan() && Real::log2(NAN).is_nan() && NAN.log2_1p().is_nan());
                assert!(NAN.log2_1p_div(1.0).is_nan() && Real::sqrt(NAN).is_nan() && Real::abs(NAN).is_nan());
                assert!(Real::pow(NAN, 0.0).is_nan() && Real::pow(1.0, NAN).is_nan() && Real::pow(NAN, NAN).is_nan());
                assert!(Real::sin_cos(NAN).0.is_nan() && Real::sin_cos(NAN).1.is_nan());
                assert!(Real::atan2(NAN, 1.0).is_nan() && Real::atan2(1.0, NAN).is_nan() && Real::erfc(NAN).is_nan());
                // Payloads must not leak into the exponent arithmetic.
                for payload in [1, 3, 0x1ff, 0x7fff] {
                    let odd = <$number>::from_bits(NAN.to_bits() | payload);
                    assert!(Real::exp2(odd).is_nan() && Real::log2(odd).is_nan() && odd.log2_1p().is_nan());
                    assert!(Real::pow(odd, 2.0).is_nan() && Real::pow(2.0, odd).is_nan());
                }
            }

            #[test]
            fn the_ends_of_the_domains() {
                let zero: $number = 0.0;
                let two: $number = 2.0;
                assert_eq!(Real::log2(zero), -INF);
                assert_eq!((-1.0 as $number).log2_1p(), -INF);
                assert!(Real::log2(-1.0 as $number).is_nan() && (-1.5 as $number).log2_1p().is_nan());
                assert_eq!((Real::log2(INF), INF.log2_1p()), (INF, INF));
                assert_eq!((Real::exp2(INF), Real::exp2(-INF)), (INF, 0.0));
                assert_eq!((Real::pow(zero, 0.0), Real::pow(two, 0.0), Real::pow(INF, 0.0)), (1.0, 1.0, 1.0));
                assert_eq!((Real::pow(zero, 2.0), Real::pow(zero, -2.0)), (0.0, INF));
                assert_eq!((Real::pow(INF, 2.0), Real::pow(INF, -2.0)), (INF, 0.0));
                assert_eq!((Real::pow(two, INF), Real::pow(two, -INF)), (INF, 0.0));
                assert_eq!((Real::pow(zero + 0.5, INF), Real::pow(zero + 1.0, 1e30)), (0.0, 1.0));
                assert!(Real::pow(-two, 2.0).is_nan());
                assert_eq!(zero.log2_1p_div(3.0), 0.0);
                assert_eq!(Real::sin_cos(zero), (0.0, 1.0));
                assert!(Real::sin_cos(-zero).0.is_sign_negative());
                assert_eq!((Real::atan2(zero, 0.0), Real::atan2(zero, 2.0)), (0.0, 0.0));
                assert!(Real::atan2(-zero, 2.0).is_sign_negative());
                assert_eq!((Real::atan2(zero, -0.0), Real::atan2(-zero, -0.0)), (0.0, 0.0));
                let half_turn = core::f64::consts::PI as $number;
                assert_eq!((Real::atan2(zero, -2.0), Real::atan2(two, 0.0)), (half_turn, 0.5 * half_turn));
                assert_eq!(Real::atan2(INF, 1.0), 0.5 * half_turn);
                assert_eq!((Real::erfc(INF), Real::erfc(-INF)), (0.0, 2.0));
            }

            #[test]
            fn constants_and_provided_methods() {
                let three: $number = 3.0;
                assert_eq!(three.lift(0.1), 0.1);
                assert_eq!((three.plus(0.5), three.times(0.5)), (3.5, 1.5));
                assert_eq!((Real::recip(three + 1.0), three.squared()), (0.25, 9.0));
                assert_eq!(Real::copysign(three, -0.0), -3.0);
            }
        }
    };
}

rules!(single, f32);
rules!(double, f64);

/// Where `f32` becomes 0 on purpose, and where `sin_cos` ends.
#[test]
fn f32_flushes_below_the_smallest_normal_number() {
    assert_eq!(Real::exp2(-126.0_f32), f32::MIN_POSITIVE);
    assert_eq!(Real::exp2((-126.0_f32).next_down()), 0.0);
    assert!((Real::exp2(128.0_f32.next_down()) / 3.402_805_7e38 - 1.0).abs() < 1e-7);
    assert_eq!(Real::exp2(128.0_f32), f32::INFINITY);
    // The form that selects is the same function; it alone may lose a NaN.
    for x in (-1500..1500).map(|i| i as f32 * 0.1).chain([-126.0, (-126.0_f32).next_down(), 128.0, 1e30, -1e30]) {
        assert_eq!((x.exp2_where(true), x.exp2_where(false)), (Real::exp2(x), 0.0), "{x}");
    }
    for odd in [f32::NAN, f32::from_bits(0x7fc0_00ff), f32::from_bits(0xffff_ffff), -f32::INFINITY] {
        assert_eq!((odd.exp2_where(true), odd.exp2_where(false)), (0.0, 0.0));
    }
    assert_eq!(Real::pow(1e-20_f32, 2.0), 0.0);
    assert!(Real::sin_cos(512.0_f32).0.is_finite() && Real::sin_cos(512.1_f32).0.is_nan());
}
