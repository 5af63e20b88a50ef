//! What `Brdf` promises, for every model of the catalogue.

#[path = "common/lobes.rs"]
mod lobes;

use lobe::Vec3;
use lobe_models::{Lobe, models};
use lobe_verify::strategies::{direction, pair_above};
use lobes::lobe;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// Runs a property for each model, `cases` times.
fn for_each_model<S: Strategy>(
    cases: u32,
    inputs: impl Fn() -> S,
    property: impl Fn(&Lobe, &S::Value) -> Result<(), String>,
) {
    let mut failures = Vec::new();
    for model in models() {
        let mut runner =
            TestRunner::new(ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() });
        let outcome =
            runner.run(&(lobe(model), inputs()), |(lobe, input)| property(&lobe, &input).map_err(TestCaseError::fail));
        if let Err(error) = outcome {
            failures.push(format!("{}: {error}", model.name));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn wide(v: Vec3) -> Vec3<f64> {
    v.map(f64::from)
}

fn all(c: lobe::Rgb, test: impl Fn(f32) -> bool) -> bool {
    <[f32; 3]>::from(c).into_iter().all(test)
}

#[test]
fn finite_and_not_negative() {
    for_each_model(2000, pair_above, |lobe, &(l, v)| {
        let brdf = lobe.build::<f32>();
        let (f, cos) = (brdf.eval(l, v), brdf.eval_cos(l, v));
        let good = |c: f32| c.is_finite() && c >= 0.0;
        if lobe.model().finite && !all(f, good) {
            return Err(format!("eval {f:?}"));
        }
        if all(cos, good) { Ok(()) } else { Err(format!("eval_cos {cos:?}")) }
    });
}

#[test]
fn finite_to_the_last_float() {
    let cosines = || (0x0080_0000_u32..0x3f80_0000, 0x0080_0000_u32..0x3f80_0000, any::<bool>());
    for_each_model(2000, cosines, |lobe, &(a, b, same)| {
        let l = Vec3::new(1.0, 0.0, f32::from_bits(a));
        let v = Vec3::new(if same { 1.0 } else { -1.0 }, 0.0, f32::from_bits(b));
        let f = lobe.build::<f32>().eval_cos(l, v);
        if all(f, |c| c.is_finite() && c >= 0.0) { Ok(()) } else { Err(format!("{f:?} at {l:?} {v:?}")) }
    });
}

#[test]
fn reciprocal_to_the_last_bit() {
    for_each_model(2000, pair_above, |lobe, &(l, v)| {
        let brdf = lobe.build::<f32>();
        let (a, b) = (brdf.eval(l, v), brdf.eval(v, l));
        let same = <[f32; 3]>::from(a).map(f32::to_bits) == <[f32; 3]>::from(b).map(f32::to_bits);
        if same || !lobe.model().reciprocal { Ok(()) } else { Err(format!("{a:?} {b:?}")) }
    });
}

/// A model that is said not to be reciprocal is not: otherwise it would be worth more than is said.
#[test]
fn what_is_said_not_to_be_reciprocal_is_not() {
    let mut runner = TestRunner::deterministic();
    for model in models().filter(|m| !m.reciprocal) {
        let differs = (0..500).any(|_| {
            let (lobe, (l, v)) = (lobe(model), pair_above()).new_tree(&mut runner).expect("a case").current();
            let brdf = lobe.build::<f32>();
            brdf.eval(l, v) != brdf.eval(v, l)
        });
        assert!(differs, "{} is reciprocal", model.name);
    }
}

#[test]
fn zero_below_the_horizon() {
    for_each_model(
        500,
        || (direction(), direction(), any::<bool>()),
        |lobe, &(below, other, light)| {
            let below = Vec3::new(below.x, below.y, -below.z.abs());
            let (l, v) = if light { (below, other) } else { (other, below) };
            let brdf = lobe.build::<f32>();
            let (f, cos) = (brdf.eval(l, v), brdf.eval_cos(l, v));
            if all(f, |c| c == 0.0) && all(cos, |c| c == 0.0) { Ok(()) } else { Err(format!("{f:?} {cos:?}")) }
        },
    );
}

#[test]
fn nan_in_nan_out() {
    let poison = || prop_oneof![Just(f32::NAN), Just(f32::INFINITY), Just(f32::NEG_INFINITY)];
    for_each_model(
        500,
        || (direction(), direction(), 0..6_usize, poison()),
        |lobe, &(l, v, which, poison)| {
            let mut all_six = [l.x, l.y, l.z, v.x, v.y, v.z];
            all_six[which] = poison;
            let [a, b, c, d, e, f] = all_six;
            let (l, v) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
            let brdf = lobe.build::<f32>();
            for f in [brdf.eval(l, v), brdf.eval_cos(l, v)] {
                if !all(f, f32::is_nan) {
                    return Err(format!("{f:?} at {l:?} {v:?}"));
                }
            }
            let f = lobe.build::<f64>().eval(wide(l), wide(v));
            if f.r.is_nan() && f.g.is_nan() && f.b.is_nan() { Ok(()) } else { Err(format!("f64: {f:?}")) }
        },
    );
}

#[test]
fn equal_to_f64() {
    for_each_model(4000, pair_above, |lobe, &(l, v)| {
        let tolerance = lobe.tolerance(wide(l), wide(v));
        let (brdf, exact) = (lobe.build::<f32>(), lobe.build::<f64>());
        for (what, a, b) in [
            ("eval", brdf.eval(l, v), exact.eval(wide(l), wide(v))),
            ("eval_cos", brdf.eval_cos(l, v), exact.eval_cos(wide(l), wide(v))),
        ] {
            for (a, b) in <[f32; 3]>::from(a).into_iter().zip(<[f64; 3]>::from(b)) {
                // Above the range of f32 there is no value. Towards its other end the fifth power in Schlick's form, or
                // another factor, is subnormal while the product is not yet.
                let range = 1e-30..f64::from(f32::MAX);
                if range.contains(&b) && (f64::from(a) - b).abs() > tolerance * b {
                    return Err(format!(
                        "{what}: {a:e}, not {b:e}: off by {:e}, at {l:?} {v:?}",
                        f64::from(a) / b - 1.0
                    ));
                }
            }
        }
        Ok(())
    });
}
