//! The elementary functions on any bit patterns, against the ones in double precision. Those of one argument are also
//! tried on all of them, by `lobe sweep`; here are the pairs.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe::Real;
use lobe_fuzz::Bits;
use lobe_verify::ulp::ulps_between;

fuzz_target!(|input: &[u8]| {
    let mut bits = Bits(input);
    let (x, y) = (bits.float(), bits.float());
    let (wx, wy) = (f64::from(x), f64::from(y));
    let tiny = f64::from(f32::MIN_POSITIVE);

    // Subnormal results are 0.
    let near = |value: f32, exact: f64, ulps: f64| {
        value == 0.0 && exact.abs() < tiny * (1.0 + 1e-6) || ulps_between(value, exact) <= ulps
    };
    let exp2 = Real::exp2(x);
    assert!(near(exp2, wx.exp2(), 1.0), "exp2 {x:e} {exp2:e}");
    let log2 = Real::log2(x);
    assert!(ulps_between(log2, wx.log2()) <= 1.0, "log2 {x:e} {log2:e}");
    let log2_1p = Real::log2_1p(x);
    assert!(ulps_between(log2_1p, wx.ln_1p() / std::f64::consts::LN_2) <= 1.0, "log2_1p {x:e} {log2_1p:e}");
    assert!(ulps_between(Real::sqrt(x), wx.sqrt()) <= 0.5, "sqrt {x:e}");
    let (sin, cos) = Real::sin_cos(x);
    if x.abs() <= 512.0 {
        assert!(ulps_between(sin, wx.sin()) <= 1.0 && ulps_between(cos, wx.cos()) <= 1.0, "sin_cos {x:e}");
    } else {
        assert!(sin.is_nan() && cos.is_nan(), "sin_cos {x:e}");
    }

    let pow = Real::pow(x, y);
    if wx < 0.0 || x.is_nan() || y.is_nan() {
        assert!(pow.is_nan(), "pow {x:e} {y:e} {pow:e}");
    } else {
        let exact = wx.abs().powf(wy);
        if (exact / tiny - 1.0).abs() < 0.05 {
            // Around the smallest normal number the first part of the exponent alone decides whether it is one.
            assert!((0.0..=1.06 * tiny).contains(&f64::from(pow)), "pow {x:e} {y:e} {pow:e} {exact:e}");
        } else {
            assert!(near(pow, exact, 2.0), "pow {x:e} {y:e} {pow:e} {exact:e}");
        }
    }

    // log₂(1 + a/b): any bits, and inside the domain.
    let _ = x.log2_1p_div(y);
    let (a, b) = (x.abs(), y.abs());
    let (wa, wb) = (f64::from(a), f64::from(b));
    // The sum up to 2¹²⁶: beyond, the denominator that is formed, up to 5/2 of it, may leave the range.
    if wb >= tiny && wa + wb <= 2.0_f64.powi(126) {
        let exact = (wa / wb).ln_1p() / std::f64::consts::LN_2;
        let value = f64::from(a.log2_1p_div(b));
        // A quotient in the subnormal range has an absolute error only.
        assert!(
            (value - exact).abs() <= 5.0 / 16_777_216.0 * exact + tiny,
            "log2_1p_div {a:e} {b:e}: {value:e} {exact:e}"
        );
    }
});
