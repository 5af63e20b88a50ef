//! The elementary functions keep their promises: a dense sample and all boundaries here, all 2³² with `lobe sweep`.

use lobe::Real;
use lobe_verify::sweep::{FUNCTIONS, sweep, sweep_boundaries};
use lobe_verify::ulp::ulps_between;
use proptest::prelude::*;

#[test]
fn one_argument_functions_are_within_their_bounds() {
    for function in FUNCTIONS {
        // A prime, so that no pattern of the low bits is left out.
        for worst in [sweep(function, 1009, &|_| ()), sweep_boundaries(function)] {
            assert!(worst.tried > 100_000, "{}: only {} tried", function.name, worst.tried);
            assert!(worst.ulps <= function.allowed_ulps, "{}: {worst:?}", function.name);
        }
    }
}

#[test]
fn a_sweep_finds_a_wrong_function() {
    let mut wrong = FUNCTIONS[0];
    wrong.f32 = |x| if x == 0.25 { 1.0 } else { Real::exp2(x) };
    assert!(sweep_boundaries(&wrong).ulps > 1000.0);
    assert_eq!(sweep_boundaries(&wrong).argument, 0.25);
}

/// Any bit pattern, with a lean towards ordinary numbers.
fn float() -> impl Strategy<Value = f32> {
    prop_oneof![any::<u32>().prop_map(f32::from_bits), -200.0_f32..200.0, 0.0_f32..2.0]
}

/// A component of a vector: of any size up to 2¹²⁶, of size 1, or 0.
fn component() -> impl Strategy<Value = f32> {
    let any_size = (-148.0..126.0_f32, any::<bool>());
    prop_oneof![
        4 => any_size.prop_map(|(e, negative)| if negative { -e.exp2() } else { e.exp2() }),
        4 => -1.0_f32..1.0,
        1 => prop_oneof![Just(0.0_f32), Just(-0.0_f32), Just(1.0_f32), Just(-1.0_f32)],
    ]
}

fn exact_pow(x: f32, y: f32) -> f64 {
    let exact = Real::pow(f64::from(x), f64::from(y));
    // Below the smallest normal number, 0 is promised; at the edge either is right.
    if exact < f64::from(f32::MIN_POSITIVE) { 0.0 } else { exact }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200_000))]

    #[test]
    fn pow_is_within_two_ulps(x in float(), y in float()) {
        let (value, exact) = (Real::pow(x, y), exact_pow(x, y));
        let at_the_edge = exact <= 1.0001 * f64::from(f32::MIN_POSITIVE) && value <= 1.0001 * f32::MIN_POSITIVE;
        prop_assert!(at_the_edge || ulps_between(value, exact) <= 2.0, "{x}^{y} = {value}, not {exact}");
    }

    /// Where the exponent is large and the base next to 1: here a rounded logarithm would lose every digit.
    #[test]
    fn pow_is_within_two_ulps_near_one(d in -4e6_f32..4e6, y in -1e6_f32..1e6) {
        let x = 1.0 + d * f32::EPSILON;
        let (value, exact) = (Real::pow(x, y), exact_pow(x, y));
        let at_the_edge = exact <= 1.0001 * f64::from(f32::MIN_POSITIVE) && value <= 1.0001 * f32::MIN_POSITIVE;
        prop_assert!(at_the_edge || ulps_between(value, exact) <= 2.0, "{x}^{y} = {value}, not {exact}");
    }

    #[test]
    fn atan2_is_within_two_ulps(y in component(), x in component()) {
        let (value, exact) = (Real::atan2(y, x), Real::atan2(f64::from(y), f64::from(x)));
        prop_assert!(ulps_between(value, exact) <= 2.0, "atan2({y}, {x}) = {value}, not {exact}");
    }

    #[test]
    fn atan2_is_within_two_ulps_below_the_normal_numbers(y in 0..0x0100_0000_u32, x in 0..0x0100_0000_u32, shift in 0..24_u32) {
        let (y, x) = (f32::from_bits(y >> shift), f32::from_bits(x >> shift));
        let (value, exact) = (Real::atan2(y, x), Real::atan2(f64::from(y), f64::from(x)));
        prop_assert!(ulps_between(value, exact) <= 2.0, "atan2({y}, {x}) = {value}, not {exact}");
    }

    #[test]
    fn log2_1p_div_keeps_its_bound(log2_a in -60.0_f32..126.0, b in 1e-16_f32..1e16) {
        let a = log2_a.exp2();
        prop_assume!(a / b >= f32::MIN_POSITIVE);
        prop_assert!(relative_error_of_log2_1p_div(a, b) <= 5.0, "log2(1 + {a}/{b})");
    }

    #[test]
    fn log2_1p_div_keeps_its_bound_below_zero(a in 0.0_f32..1.0, exponent in -60..60_i32) {
        let b = (exponent as f32).exp2();
        // 5.297 at −0.25129586, the worst of all floats around: just below 3/4 the integer −1 cancels most of the rest.
        prop_assert!(relative_error_of_log2_1p_div(-a * b, b) <= 5.5, "log2(1 − {a})");
    }
}

/// In units of 2⁻²⁴.
fn relative_error_of_log2_1p_div(a: f32, b: f32) -> f64 {
    let exact = libm::log1p(f64::from(a) / f64::from(b)) * std::f64::consts::LOG2_E;
    let error = (f64::from(a.log2_1p_div(b)) - exact).abs();
    if error == 0.0 { 0.0 } else { error / exact.abs() * 16_777_216.0 }
}
