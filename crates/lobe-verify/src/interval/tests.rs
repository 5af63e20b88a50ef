//! Every operation encloses what `f64` gives for members of its operands.

use super::*;
use lobe::{BlinnPhong, Brdf, Eon, Lambert, Microfacet, Phong, Rgb, Shininess, Vec3};
use lobe::{distribution::Beckmann, distribution::Ggx, fresnel::Conductor, fresnel::Schlick, masking::SmithCorrelated};
use proptest::prelude::*;

/// Numbers that lean on 0, 1 and many orders of magnitude.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -4.0..4.0_f64,
        (-300.0..300.0_f64, any::<bool>()).prop_map(|(e, minus)| (if minus { -1.0 } else { 1.0 }) * 10_f64.powf(e)),
        Just(0.0),
        Just(1.0),
        Just(-1.0),
        Just(f64::MIN_POSITIVE / 8.0),
    ]
}

/// An interval and a member.
fn member() -> impl Strategy<Value = (Interval, f64)> {
    (number(), number(), 0.0..=1.0_f64).prop_map(|(a, b, t)| {
        let (lo, hi) = (a.min(b), a.max(b));
        (Interval::new(lo, hi), (lo + t * (hi - lo)).clamp(lo, hi))
    })
}

/// `result` has `value`, and is marked if that is undefined.
fn encloses(result: Interval, value: f64) -> bool {
    if value.is_nan() { result.nan } else { result.contains(value) }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn arithmetic_encloses((x, a) in member(), (y, b) in member()) {
        prop_assert!(encloses(x + y, a + b));
        prop_assert!(encloses(x - y, a - b));
        prop_assert!(encloses(x * y, a * b));
        prop_assert!(encloses(-x, -a));
        prop_assert!(encloses(x.squared(), a * a));
        prop_assert!(encloses(x.max(y), Real::max(a, b)) && encloses(x.min(y), Real::min(a, b)));
        prop_assert!(encloses(Real::abs(x), a.abs()));
        prop_assert!(encloses(x.copysign(y), a.copysign(b)));
        prop_assert!(encloses(Interval::sum_of_products((x, y), (y, x)), a * b + b * a));
        // A quotient by 0 has the sign of its limit, which a rounded zero may not have.
        if b != 0.0 {
            prop_assert!(encloses(x / y, a / b), "{:?} / {:?} = {:?}, not {}", x, y, x / y, a / b);
        }
    }

    #[test]
    fn elementary_functions_enclose((x, a) in member(), (y, b) in member()) {
        prop_assert!(encloses(Real::sqrt(x), a.sqrt()));
        prop_assert!(encloses(Real::exp2(x), Real::exp2(a)));
        prop_assert!(encloses(Real::log2(x), Real::log2(a)));
        prop_assert!(encloses(x.log2_1p(), a.log2_1p()));
        prop_assert!(encloses(x.pow(y), a.pow(b)), "{:?} ^ {:?} = {:?}, not {}", x, y, x.pow(y), a.pow(b));
        prop_assert!(encloses(Real::atan2(x, y), Real::atan2(a, b)));
        prop_assert!(encloses(x.erfc(), Real::erfc(a)));
        let (sin, cos) = Real::sin_cos(x);
        if a.abs() < 1e6 {
            prop_assert!(encloses(sin, a.sin()) && encloses(cos, a.cos()), "{:?}: {:?} {:?}", x, sin, cos);
        }
    }

    /// One member in, a few neighbours out.
    #[test]
    fn a_point_stays_thin(a in 1e-3..50.0_f64, b in 1e-3..50.0_f64) {
        let thin = |x: Interval| x.is_finite() && x.width() <= 40.0 * f64::EPSILON * x.magnitude();
        let (x, y) = (Interval::point(a), Interval::point(b));
        prop_assert!([x + y, x * y, x / y, Real::sqrt(x), x.squared(), x.recip()].into_iter().all(thin));
        prop_assert!([Real::exp2(x), x.log2_1p(), x.pow(y), Real::atan2(x, y)].into_iter().all(thin));
        prop_assert!(a > 25.0 || thin(x.erfc()));
        prop_assert!((x + y).lo <= a + b && (x + y).hi - (x + y).lo <= 2.0 * f64::EPSILON * (a + b));
    }

    /// A comparison that is decided is right for all members.
    #[test]
    fn masks_know_what_can_be((x, a) in member(), (y, b) in member()) {
        for (mask, value) in [
            (x.lt(y), a < b), (x.le(y), a <= b), (Real::eq(x, y), a == b),
            (x.gt(y), a > b), (x.ge(y), a >= b), (Real::ne(x, y), a != b),
            (x.lt(y) & x.ge(y), false), (x.lt(y) | x.le(y), a <= b), (!x.lt(y), a >= b),
        ] {
            let known = if value { mask.can_be_true } else { mask.can_be_false };
            prop_assert!(known);
        }
        let chosen = Interval::select(x.lt(y), x, y);
        let right = if a < b { a } else { b };
        prop_assert!(chosen.contains(right));
    }
}

const WHOLE: Interval = Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY, nan: false };

#[test]
fn zero_and_infinity() {
    let unit = Interval::new(0.0, 1.0);
    assert_eq!(Interval::ONE / unit, Interval::new(1.0, f64::INFINITY));
    assert_eq!(Interval::ONE / -unit, Interval::new(f64::NEG_INFINITY, -1.0));
    assert_eq!(Interval::ONE / Interval::new(-1.0, 1.0), WHOLE);
    assert!((unit / unit).nan && !(Interval::ONE / unit).nan && (Interval::ZERO / Interval::ZERO).nan);
    let infinite = Interval::ONE / unit;
    assert!((infinite * unit).nan && (infinite - infinite).nan && !(infinite + infinite).nan);
    // Neither zeros nor small numbers leak to the other side.
    assert_eq!(Interval::ZERO * Interval::new(-3.0, 5.0), Interval::ZERO);
    let tiny = Interval::new(1e-200, 1e-190);
    assert!((tiny * tiny).lo == 0.0 && (tiny * tiny).hi > 0.0);
    assert!(Real::exp2(Interval::point(-5000.0)).hi > 0.0);
}

#[test]
fn what_is_undefined_leaves_a_mark() {
    let across = Interval::new(-1.0, 4.0);
    assert_eq!(Real::sqrt(across), Interval { lo: 0.0, hi: 2.0, nan: true });
    assert!(Real::log2(across).nan && across.pow(Interval::ONE).nan && (-Interval::ONE).log2().nan);
    // A clamp does not hide it, a select that drops the operand does.
    let marked = Real::sqrt(across);
    assert!(marked.max(Interval::ZERO).min(Interval::ONE).nan && !marked.is_finite());
    assert!(!Interval::ONE.min(marked).nan, "the receiver stays if the bound is NaN");
    assert_eq!(Interval::ONE.min(marked).hi, 1.0);
    assert!(!Interval::select(Interval::ZERO.lt(Interval::ONE), Interval::ONE, marked).nan);
    assert!(marked.lt(Interval::point(9.0)).can_be_false);
    assert!(Interval::new(f64::NAN, 1.0).nan && Interval::new(2.0, 1.0).nan);
}

#[test]
fn turns_hit_the_axes() {
    let (sin, cos) = Interval::point(0.5).half_turns();
    assert!(cos == Interval::ZERO && sin.contains(1.0) && sin.hi == 1.0);
    let (sin, cos) = Interval::new(0.0, 1.0).half_turns();
    assert!(sin.lo == 0.0 && sin.hi == 1.0 && cos.lo == -1.0 && cos.hi == 1.0);
    let (sin, _) = Real::sin_cos(Interval::new(0.0, 4.0));
    assert!(sin.hi == 1.0 && sin.lo < -0.75 && sin.lo > -0.76);
    // The cut, and the origin.
    let around = Interval::new(-1.0, 1.0);
    assert_eq!(Real::atan2(around, Interval::new(-2.0, -1.0)).hi, Interval::PI.hi);
    let quarter = Real::atan2(Interval::new(0.0, 1.0), Interval::new(0.0, 1.0));
    assert!(quarter.lo == 0.0 && quarter.hi > 1.57 && quarter.hi < 1.58);
}

/// A unit vector above the horizon, and how far a box reaches around it.
fn direction() -> impl Strategy<Value = Vec3<f64>> {
    (0.01..1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(z, phi)| {
        let sin = (1.0 - z * z).sqrt();
        Vec3::new(sin * phi.cos(), sin * phi.sin(), z)
    })
}

/// A lobe in both number types, on a box and at a point in it.
fn boxed(
    lobe: &impl Brdf<Interval>,
    plain: &impl Brdf<f64>,
    (l, v): (Vec3<f64>, Vec3<f64>),
    width: f64,
) -> Result<(), TestCaseError> {
    let around = |w: Vec3<f64>| w.map(|c| Interval::new(c - width, c + width));
    let (bound, value) = (lobe.eval_cos(around(l), around(v)).g, plain.eval_cos(l, v).g);
    // The value is rounded, the bound is not.
    let slack = 1e-12 * value.abs();
    prop_assert!(value.is_finite() && bound.lo - slack <= value && value <= bound.hi + slack, "{value} in {bound:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    /// Each lobe on a box encloses its values in it.
    #[test]
    fn lobes_enclose(l in direction(), v in direction(), width in 0.0..0.1_f64, x in 0.05..1.0_f64) {
        let (p, w) = (Interval::new(x - 0.5 * width * x, x), (l, v));
        let (one, of) = (Rgb::splat(1.0_f64), Rgb::splat(Interval::ONE));
        boxed(&Lambert::new(Rgb::splat(p)), &Lambert::new(Rgb::splat(x)), w, width)?;
        boxed(&Phong::new(of, Shininess(p.times(40.0))), &Phong::new(one, Shininess(40.0 * x)), w, width)?;
        boxed(&BlinnPhong::new(of, Shininess(p.times(40.0))), &BlinnPhong::new(one, Shininess(40.0 * x)), w, width)?;
        boxed(&Eon::new(of, p), &Eon::new(one, x), w, width)?;
        let (metal, plain) = (Conductor::new(of, Rgb::splat(Interval::point(3.0))), Conductor::new(one, Rgb::splat(3.0)));
        boxed(
            &Microfacet::new(Ggx::new(lobe::Alpha(p)), SmithCorrelated, metal),
            &Microfacet::new(Ggx::new(lobe::Alpha(x)), SmithCorrelated, plain), w, width,
        )?;
        boxed(
            &Microfacet::new(Beckmann::new(lobe::Alpha(p)), SmithCorrelated, Schlick::new(Rgb::splat(p))),
            &Microfacet::new(Beckmann::new(lobe::Alpha(x)), SmithCorrelated, Schlick::new(Rgb::splat(x))), w, width,
        )?;
    }
}
