//! Every model of the catalogue over slices: the bits of the scalar where that is promised, and what is left of it where
//! digits are traded.

#[path = "common/lobes.rs"]
mod lobes;

use lobe::batch::{self, LengthError, Level};
use lobe::number::{Approximate, Fast};
use lobe::{Rgb, Vec3};
use lobe_models::{AnyBatch, AnyPrecision, Kind, Lobe, Material, Value, model, models};
use lobe_verify::strategies::pair_above;
use proptest::strategy::{Strategy as _, ValueTree as _};
use proptest::test_runner::TestRunner;

/// The scalar, and every level that the machine has.
fn levels() -> impl Iterator<Item = Level> {
    std::iter::once(Level::baseline()).chain(batch::levels(Level::new()).map(|(_, level)| level))
}

/// Pairs of directions as slices.
struct Pairs {
    pairs: Vec<(Vec3, Vec3)>,
    l: [Vec<f32>; 3],
    v: [Vec<f32>; 3],
}

impl Pairs {
    fn new(pairs: Vec<(Vec3, Vec3)>) -> Self {
        let columns = |of: fn(&(Vec3, Vec3)) -> Vec3| {
            [|w: Vec3| w.x, |w: Vec3| w.y, |w: Vec3| w.z].map(|c| pairs.iter().map(|p| c(of(p))).collect())
        };
        let (l, v) = (columns(|p| p.0), columns(|p| p.1));
        Self { pairs, l, v }
    }

    /// They lean on the extremes.
    fn extreme(count: usize) -> Self {
        let mut runner = TestRunner::deterministic();
        Self::new((0..count).map(|_| pair_above().new_tree(&mut runner).expect("a pair").current()).collect())
    }

    /// The first of them.
    fn slices(&self, length: usize) -> (Vec3<&[f32]>, Vec3<&[f32]>) {
        (vector(&self.l, length), vector(&self.v, length))
    }

    /// `eval_cos` of the first of them.
    fn eval_cos(&self, batch: &AnyBatch, level: Level, precision: AnyPrecision, length: usize) -> Vec<[f32; 3]> {
        let (l, v) = self.slices(length);
        let [mut r, mut g, mut b] = [vec![7.0; length], vec![7.0; length], vec![7.0; length]];
        batch.eval_cos(level, precision, l, v, Rgb { r: &mut r, g: &mut g, b: &mut b }).expect("one length");
        (0..length).map(|i| [r[i], g[i], b[i]]).collect()
    }
}

fn vector([x, y, z]: &[Vec<f32>; 3], length: usize) -> Vec3<&[f32]> {
    Vec3::new(&x[..length], &y[..length], &z[..length])
}

fn same(a: [f32; 3], b: [f32; 3]) -> bool {
    // Two NaN are alike, whatever their bits.
    a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan())
}

/// Fails with what was said of each lobe, the first of each model.
fn for_lobes(count: usize, check: impl Fn(&Lobe) -> Result<(), String>) {
    let mut runner = TestRunner::deterministic();
    let mut failures = Vec::new();
    for model in models() {
        let strategy = lobes::lobe(model);
        let lobes = (0..count).map(|_| strategy.new_tree(&mut runner).expect("a lobe").current());
        failures.extend(
            std::iter::once(model.typical())
                .chain(lobes)
                .find_map(|lobe| check(&lobe).err().map(|error| format!("{lobe}: {error}"))),
        );
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Every masking and Fresnel term with every distribution.
fn microfacets() -> Vec<Lobe> {
    let model = model("microfacet").expect("there is one");
    let words = |name: &str| match model.parameter(name).expect("there is one").kind {
        Kind::Choice(words) => words,
        _ => panic!("{name} is a choice"),
    };
    let mut all = Vec::new();
    for distribution in words("distribution") {
        for masking in words("masking") {
            for fresnel in words("fresnel") {
                let given = [
                    ("distribution", Value::Choice(distribution)),
                    ("masking", Value::Choice(masking)),
                    ("fresnel", Value::Choice(fresnel)),
                    ("alpha", Value::Widths([0.3, 0.1])),
                ];
                all.push(Lobe::new(model, &given).expect("inside the domain"));
            }
        }
    }
    all
}

/// Whether the batch has the bits of the scalar.
fn precise(lobe: &Lobe, pairs: &Pairs) -> Result<(), String> {
    let (scalar, batch) = (lobe.build::<f32>(), lobe.batch());
    let expected: Vec<[f32; 3]> = pairs.pairs.iter().map(|&(l, v)| scalar.eval_cos(l, v).into()).collect();
    for level in levels() {
        for length in [1, 15, 16, 33] {
            let found = pairs.eval_cos(&batch, level, AnyPrecision::Precise, length);
            if let Some(i) = (0..length).find(|&i| !same(found[i], expected[i])) {
                let at = pairs.pairs[i];
                return Err(format!("{level:?}, {length}: {:?} for {:?} at {at:?}", found[i], expected[i]));
            }
        }
    }
    Ok(())
}

#[test]
fn precise_batches_have_the_bits_of_the_scalar() {
    let mut pairs = Pairs::extreme(33).pairs;
    pairs[3].0 = -pairs[3].0;
    pairs[20].1.x = f32::NAN;
    let pairs = Pairs::new(pairs);
    for_lobes(12, |lobe| precise(lobe, &pairs));
    for lobe in microfacets() {
        precise(&lobe, &pairs).unwrap_or_else(|error| panic!("{lobe}: {error}"));
    }
}

/// The precisions that trade digits.
const ROUGH: [AnyPrecision; 2] = [AnyPrecision::Fast, AnyPrecision::Coarse];

fn stable(lobe: &Lobe, pairs: &Pairs) -> Result<(), String> {
    let batch = lobe.batch();
    for (level, precision) in levels().flat_map(|level| ROUGH.map(|precision| (level, precision))) {
        let found = pairs.eval_cos(&batch, level, precision, pairs.pairs.len());
        if let Some(i) = found.iter().position(|f| f.iter().any(|c| !(c.is_finite() && *c >= 0.0))) {
            return Err(format!("{level:?}, {precision}: {:?} at {:?}", found[i], pairs.pairs[i]));
        }
    }
    Ok(())
}

#[test]
fn rough_batches_are_finite_and_not_negative() {
    let pairs = Pairs::extreme(500);
    for_lobes(30, |lobe| stable(lobe, &pairs));
    for lobe in microfacets() {
        stable(&lobe, &pairs).unwrap_or_else(|error| panic!("{lobe}: {error}"));
    }
}

#[test]
fn rough_batches_are_zero_below_the_horizon_and_keep_a_nan() {
    let pairs = Pairs::extreme(200).pairs;
    let below = pairs.iter().enumerate().map(|(i, &(l, v))| if i % 2 == 0 { (-l, v) } else { (l, -v) });
    let below = Pairs::new(below.collect());
    let poisoned = Pairs::new(
        pairs
            .iter()
            .enumerate()
            .map(|(i, &(l, v))| {
                let mut six = [l.x, l.y, l.z, v.x, v.y, v.z];
                six[i % 6] = f32::NAN;
                (Vec3::new(six[0], six[1], six[2]), Vec3::new(six[3], six[4], six[5]))
            })
            .collect(),
    );
    for_lobes(10, |lobe| {
        let batch = lobe.batch();
        for (level, precision) in levels().flat_map(|level| ROUGH.map(|precision| (level, precision))) {
            for (pairs, good) in [(&below, (|c| c == 0.0) as fn(f32) -> bool), (&poisoned, f32::is_nan)] {
                let found = pairs.eval_cos(&batch, level, precision, pairs.pairs.len());
                if let Some(i) = found.iter().position(|f| !f.iter().all(|&c| good(c))) {
                    return Err(format!("{level:?}, {precision}: {:?} at {:?}", found[i], pairs.pairs[i]));
                }
            }
        }
        Ok(())
    });
}

/// Directions at least 6° above the horizon.
fn ordinary() -> Pairs {
    let mut pairs = Vec::new();
    for i in 0..7 {
        for j in 0..7 {
            for k in 0..9 {
                let unit = |theta: f64, phi: f64| {
                    Vec3::new((theta.sin() * phi.cos()) as f32, (theta.sin() * phi.sin()) as f32, theta.cos() as f32)
                };
                let (l, v) = (0.05 + 0.23 * f64::from(i), 0.03 + 0.235 * f64::from(j));
                pairs.push((unit(l, 0.4), unit(v, 0.5 + 0.7 * f64::from(k))));
            }
        }
    }
    Pairs::new(pairs)
}

/// The largest error, as a part of the value; or of a thousandth of the largest value, which is the end of what is seen.
fn error(lobe: &Lobe, level: Level, precision: AnyPrecision, pairs: &Pairs) -> f64 {
    let exact = lobe.build::<f64>();
    let found = pairs.eval_cos(&lobe.batch(), level, precision, pairs.pairs.len());
    let exact: Vec<[f64; 3]> =
        pairs.pairs.iter().map(|(l, v)| exact.eval_cos(l.map(f64::from), v.map(f64::from)).into()).collect();
    let floor = 1e-3 * exact.iter().flatten().fold(0.0, |max: f64, &c| max.max(c));
    let errors = found.iter().flatten().zip(exact.iter().flatten());
    errors.map(|(&found, &exact)| (f64::from(found) - exact).abs() / exact.max(floor)).fold(0.0, f64::max)
}

#[test]
fn rough_batches_are_near() {
    let pairs = ordinary();
    let mut failures = Vec::new();
    for lobe in models().map(|model| model.typical()).chain(microfacets()) {
        for level in levels() {
            for (precision, bound) in ROUGH.into_iter().zip([FAST, COARSE]) {
                let error = error(&lobe, level, precision, &pairs);
                if error > bound || error.is_nan() {
                    failures.push(format!("{lobe}: {level:?}, {precision}: {error:e}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Bounds with room: an estimate is off by 3.7e-4 and may enter a value ten times over; `Coarse` has polynomials of 2e-3.
const FAST: f64 = 1e-2;
const COARSE: f64 = 3e-2;

#[test]
fn the_scalar_of_a_precision_is_near_its_lanes() {
    let pairs = ordinary();
    for lobe in models().map(|model| model.typical()) {
        let scalar = lobe.build::<Approximate<f32, Fast>>();
        let found = pairs.eval_cos(&lobe.batch(), Level::baseline(), AnyPrecision::Fast, pairs.pairs.len());
        for (&(l, v), lanes) in pairs.pairs.iter().zip(found) {
            let one: [f32; 3] =
                scalar.eval_cos(l.map(Approximate::new), v.map(Approximate::new)).map(Approximate::value).into();
            for (one, lane) in one.into_iter().zip(lanes) {
                assert!((one - lane).abs() <= 2e-3 * one.abs(), "{lobe}: {one} {lane} at {l:?} {v:?}");
            }
        }
    }
}

#[test]
fn a_material_has_the_bits_of_its_sum() {
    let pairs = Pairs::extreme(300);
    let text = r#"{"lobes": [{"model": "lambert", "albedo": [0.5, 0.1, 0.2], "weight": 0.7}, {"model": "phong", "ks": 0.3, "q": 20},
        {"model": "ward", "ks": 0.3, "alpha": 0.2, "weight": [0.9, 0.1, 0]}]}"#;
    let weighted = Material::from_json(text).expect("a material");
    let alone = Material { lobes: weighted.lobes[..1].to_vec(), ..weighted.clone() };
    for material in [weighted.clone(), alone, Material { name: String::new(), lobes: Vec::new() }] {
        let (scalar, batch) = (material.build::<f32>(), material.batch());
        for level in levels() {
            let found = pairs.eval_cos(&batch, level, AnyPrecision::Precise, 300);
            for (&(l, v), found) in pairs.pairs.iter().zip(found) {
                let one = scalar.eval_cos(l, v).into();
                assert!(same(found, one), "{}: {found:?} for {one:?} at {l:?} {v:?}", material.name);
            }
        }
        let rough = material.build::<Approximate<f32, Fast>>();
        let (l, v) = (Vec3::new(0.6_f32, 0.0, 0.8), Vec3::new(-0.48_f32, 0.36, 0.8));
        let near = rough.eval_cos(l.map(Approximate::new), v.map(Approximate::new)).g.value();
        assert!((near / scalar.eval_cos(l, v).g - 1.0).abs() < 1e-2 || material.lobes.is_empty() && near == 0.0);
    }
}

#[test]
fn light_is_added_to_what_is_there() {
    let pairs = Pairs::extreme(33);
    let lobe = model("ward").expect("there is one").typical();
    let (scalar, batch) = (lobe.build::<f32>(), lobe.batch());
    let light: Vec<f32> = (0..33).map(|i| 0.5 * i as f32).collect();
    let (l, v) = pairs.slices(33);
    let mut out = [vec![0.25; 33], vec![0.5; 33], vec![1.0; 33]];
    let [r, g, b] = &mut out;
    let irradiance = Rgb { r: &light[..], g: &light, b: &light };
    batch.shade(Level::new(), AnyPrecision::Precise, l, v, irradiance, Rgb { r, g, b }).expect("one length");
    for (i, &(l, v)) in pairs.pairs.iter().enumerate() {
        let one = scalar.eval_cos(l, v) * Rgb::splat(light[i]) + Rgb::new(0.25, 0.5, 1.0);
        assert!(same([out[0][i], out[1][i], out[2][i]], one.into()));
    }
}

#[test]
fn other_lengths_are_an_error_and_nothing_is_written() {
    let material =
        Material::from_json(r#"{"lobes": [{"model": "lambert", "albedo": 1}, {"model": "phong", "ks": 1, "q": 2}]}"#)
            .expect("a material");
    let (long, short) = (vec![0.6_f32; 300], vec![0.6_f32; 299]);
    let full = Vec3::new(&long[..], &long, &long);
    for batch in [material.batch(), material.lobes[0].batch()] {
        let mut out = [vec![7.0_f32; 300], vec![7.0; 300], vec![7.0; 300]];
        let [r, g, b] = &mut out;
        let v = Vec3::new(&long[..], &long, &short);
        let error = batch
            .eval_cos(Level::new(), AnyPrecision::Fast, full, v, Rgb { r: &mut r[..], g: &mut g[..], b: &mut b[..] })
            .unwrap_err();
        assert_eq!(error, LengthError { index: 5, length: 299, expected: 300 });
        let irradiance = Rgb { r: &long[..], g: &short, b: &long };
        let error = batch.shade(Level::new(), AnyPrecision::Fast, full, full, irradiance, Rgb { r, g, b }).unwrap_err();
        assert_eq!(error, LengthError { index: 7, length: 299, expected: 300 });
        assert!(out.iter().flatten().all(|&x| x == 7.0));
    }
}
