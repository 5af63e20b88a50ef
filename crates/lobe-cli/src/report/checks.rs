//! What the mathematics promises, computed anew for the report.

use super::random::Random;
use crate::spec::{LobeSpec, NormalizationSpec, Spec};
use crate::sweep::Outcome;
use lobe::{Brdf, Rgb, Vec3};
use lobe_energy::directional_albedo;
use lobe_verify::sweep::{FUNCTIONS, sweep, sweep_boundaries};
use lobe_verify::ulp::summary;
use rayon::prelude::*;
use serde::Serialize;

/// One promise and what was found.
#[derive(Debug, Serialize)]
pub(crate) struct Check {
    pub(crate) name: &'static str,
    /// The promise, in a sentence.
    pub(crate) promise: &'static str,
    pub(crate) holds: bool,
    /// What was found, in a sentence.
    pub(crate) found: String,
    pub(crate) columns: &'static [&'static str],
    pub(crate) rows: Vec<Vec<String>>,
}

/// Pairs of directions for each lobe.
const PAIRS: usize = 20_000;
/// So many of them at least have a value other than 0, or a check proves nothing.
const LEAST_PAIRS: usize = PAIRS / 10;
/// The rounding unit of `f32`.
const U: f64 = 1.0 / (1_u64 << 24) as f64;

/// All checks.
pub(crate) fn all(done: &(dyn Fn() + Sync)) -> Vec<Check> {
    let checks: [fn() -> Check; 5] = [reciprocity, precision, energy, functions, strange_numbers];
    checks
        .into_par_iter()
        .map(|check| {
            let found = check();
            done();
            found
        })
        .collect()
}

/// How many there are.
pub(crate) const COUNT: u64 = 5;

/// Every model at one exponent, with coefficients of 1.
fn lobes(q: f64) -> Vec<LobeSpec> {
    let ks = [1.0; 3];
    vec![
        LobeSpec::Lambert { albedo: ks },
        LobeSpec::Phong { ks, q },
        LobeSpec::BlinnPhong { ks, q, normalization: NormalizationSpec::NormalIncidence },
        LobeSpec::BlinnPhong { ks, q, normalization: NormalizationSpec::Common },
        LobeSpec::LecturePhong { ks, q },
        LobeSpec::LectureBlinnTorrance { ks, q },
    ]
}

fn name(lobe: &LobeSpec) -> String {
    match lobe {
        LobeSpec::BlinnPhong { normalization: NormalizationSpec::Common, .. } => "blinn-phong (common)".to_owned(),
        _ => lobe.model().to_owned(),
    }
}

fn alone(lobe: &LobeSpec) -> Spec {
    Spec { name: name(lobe), lobes: vec![*lobe] }
}

/// Exponents for the checks: from none to the sharpest.
const EXPONENTS: [f64; 7] = [0.0, 1.0, 8.0, 50.0, 400.0, 1e4, 1e6];

fn reciprocity() -> Check {
    let mut rows = Vec::new();
    let (mut holds, mut pairs) = (true, 0);
    for index in 0..lobes(0.0).len() {
        let (mut differing, mut not_zero) = (0, 0);
        let mut worst = 1.0_f64;
        let mut random = Random::new();
        for q in EXPONENTS {
            let Some(lobe) = lobes(q).get(index).copied() else { continue };
            let brdf = alone(&lobe).build(0.0_f32);
            for _ in 0..PAIRS / EXPONENTS.len() {
                let (l, v) = random.pair();
                let (one, other) = (brdf.eval(l, v).g, brdf.eval(v, l).g);
                pairs += 1;
                not_zero += usize::from(one != 0.0 || other != 0.0);
                if one.to_bits() != other.to_bits() || !one.is_finite() {
                    differing += 1;
                    let ratio = f64::from(one) / f64::from(other);
                    worst = if ratio.is_finite() { worst.max(ratio).max(1.0 / ratio) } else { worst };
                }
            }
        }
        let Some(lobe) = lobes(0.0).get(index).copied() else { continue };
        let verdict = match (lobe.is_reciprocal(), differing) {
            (true, 0) if not_zero < LEAST_PAIRS => format!("too few pairs with a value: {not_zero}"),
            (true, 0) => "equal to the last bit".to_owned(),
            (true, _) => format!("{differing} pairs differ"),
            (false, _) => format!("not reciprocal, as documented: differs by a factor of up to {worst:.1e}"),
        };
        holds &= !lobe.is_reciprocal() || (differing == 0 && not_zero >= LEAST_PAIRS);
        rows.push(vec![name(&lobe), lobe_kind(&lobe).to_owned(), not_zero.to_string(), verdict]);
    }
    Check {
        name: "Reciprocity",
        promise: "Light and viewer can be exchanged: f(l, v) and f(v, l) have the same bits in f32.",
        holds,
        found: format!("{pairs} random pairs, exponents from 0 to a million."),
        columns: &["lobe", "kind", "pairs with a value", "f(l, v) against f(v, l)"],
        rows,
    }
}

fn lobe_kind(lobe: &LobeSpec) -> &'static str {
    if lobe.is_reciprocal() { "BRDF" } else { "the lecture's highlight, no BRDF" }
}

fn precision() -> Check {
    let mut rows = Vec::new();
    let (mut holds, mut pairs) = (true, 0);
    for index in 0..lobes(0.0).len() {
        let mut random = Random::new();
        let mut errors = Vec::new();
        let mut worst = (0.0, String::new());
        let mut over_bound = 0.0_f64;
        let mut model = String::new();
        for q in EXPONENTS {
            let Some(lobe) = lobes(q).get(index).copied() else { continue };
            model = name(&lobe);
            let (single, double) = (alone(&lobe).build(0.0_f32), alone(&lobe).build(0.0_f64));
            let peak = double.eval(up(), up()).g;
            for _ in 0..PAIRS / EXPONENTS.len() {
                let (l, v) = random.pair();
                let (l64, v64) = (l.map(f64::from), v.map(f64::from));
                let (value, exact) = if lobe.is_reciprocal() {
                    (single.eval(l, v).g, double.eval(l64, v64).g)
                } else {
                    (single.eval_cos(l, v).g, double.eval_cos(l64, v64).g)
                };
                // Below 2^-126 of the peak a lobe is 0 in f32, as documented.
                if exact <= peak * f64::from(f32::MIN_POSITIVE) * 1.001 {
                    continue;
                }
                let error = (f64::from(value) - exact).abs() / exact;
                errors.push(error);
                let part = error / bound(&lobe, l64, v64, exact / peak);
                // `max` would pass over a NaN.
                over_bound = if part.is_nan() { f64::INFINITY } else { over_bound.max(part) };
                if error > worst.0 || error.is_nan() {
                    worst = (error, format!("q = {q}, l = {}, v = {}", vector(l), vector(v)));
                }
            }
        }
        pairs += errors.len();
        let found = summary(&mut errors);
        holds &= over_bound <= 1.0 && errors.len() >= LEAST_PAIRS;
        let row = [found.median, found.percentile_99, found.worst].map(|error| format!("{error:.2e}"));
        let part = format!("{:.0} %", over_bound * 100.0);
        rows.push([vec![model], row.to_vec(), vec![part, worst.1]].concat());
    }
    Check {
        name: "f32 against f64",
        promise: "The relative error of f32 stays within the bound that each lobe states.",
        holds,
        found: format!(
            "{pairs} pairs with a value, every other one near the mirror direction; of the lecture's highlights, f_r · cos."
        ),
        columns: &["lobe", "median", "99 %", "worst", "of its bound", "worst at"],
        rows,
    }
}

/// The bound on the relative error that the lobe's documentation states; for the lecture's highlights, which have the
/// same power and another factor, two roundings more. Where it makes no promise, infinity.
fn bound(lobe: &LobeSpec, l: Vec3<f64>, v: Vec3<f64>, part_of_peak: f64) -> f64 {
    let depth = part_of_peak.ln().abs();
    let more = if lobe.is_reciprocal() { 0.0 } else { 2.0 };
    match *lobe {
        LobeSpec::Lambert { .. } => 2.0 * U,
        LobeSpec::Phong { q, .. } | LobeSpec::LecturePhong { q, .. } => {
            let c = v.z * l.z - v.x * l.x - v.y * l.y;
            if c < 1.0 / 4096.0 {
                f64::INFINITY
            } else {
                U * (7.0 + 6.0 * depth + 5.0 * q * (1.0 / c - 1.0).abs() + more)
            }
        }
        _ => U * (14.0 + 14.0 * depth + more),
    }
}

fn up() -> Vec3<f64> {
    Vec3::new(0.0, 0.0, 1.0)
}

fn vector(d: Vec3<f32>) -> String {
    format!("({:?}, {:?}, {:?})", d.x, d.y, d.z)
}

/// An albedo that its quadrature knows less well than this is not known.
const LARGEST_ERROR: f64 = 1e-6;
/// The angles from the normal at which energy is checked.
const ANGLES: [f64; 6] = [0.0, 30.0, 55.0, 75.0, 85.0, 89.0];

fn energy() -> Check {
    let cases: Vec<(LobeSpec, f64)> =
        EXPONENTS.iter().flat_map(|&q| lobes(q).into_iter().map(move |lobe| (lobe, q))).collect();
    let highest: Vec<(LobeSpec, f64, f64, f64)> = cases
        .into_par_iter()
        .map(|(lobe, q)| {
            let brdf = alone(&lobe).build(0.0_f64);
            let of = |angle: f64| {
                let (sin, cos) = angle.to_radians().sin_cos();
                let albedo = directional_albedo(&brdf, Vec3::new(sin, 0.0, cos));
                // A value that is not known, or not a number, is above everything.
                if albedo.error <= LARGEST_ERROR && albedo.value.g.is_finite() { albedo.value.g } else { f64::INFINITY }
            };
            let (angle, albedo) = ANGLES
                .map(|angle| (angle, of(angle)))
                .into_iter()
                .fold((0.0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
            (lobe, q, angle, albedo)
        })
        .collect();

    let mut rows = Vec::new();
    let mut holds = true;
    for lobe in lobes(0.0) {
        let model = name(&lobe);
        let same = highest.iter().filter(|(other, ..)| name(other) == model);
        let (q, angle, albedo) = same.fold(
            (0.0, 0.0, 0.0),
            |best, &(_, q, angle, albedo)| if albedo > best.2 { (q, angle, albedo) } else { best },
        );
        let conserves = matches!(
            lobe,
            LobeSpec::Lambert { .. }
                | LobeSpec::Phong { .. }
                | LobeSpec::BlinnPhong { normalization: NormalizationSpec::NormalIncidence, .. }
        );
        let fits = albedo <= 1.0 + 1e-6;
        holds &= fits || (!conserves && albedo.is_finite());
        let verdict = match (fits, conserves) {
            _ if albedo == f64::INFINITY => "NOT KNOWN",
            (true, _) => "at most 1",
            (false, true) => "GAINS ENERGY",
            (false, false) => "gains energy, as documented",
        };
        let at = if lobe.exponent().is_none() { format!("{angle}°") } else { format!("q = {q}, {angle}°") };
        rows.push(vec![model, format!("{albedo:.5}"), at, verdict.to_owned()]);
    }
    Check {
        name: "Energy",
        promise: "With a coefficient of 1, a lobe that conserves energy reflects at most what arrives.",
        holds,
        found: format!("Quadrature at {} angles and {} exponents.", ANGLES.len(), EXPONENTS.len()),
        columns: &["lobe", "highest albedo", "at", "verdict"],
        rows,
    }
}

fn functions() -> Check {
    // A prime, so that no pattern of the low bits is left out.
    const STRIDE: u32 = 20_011;
    let mut rows = Vec::new();
    let (mut holds, mut tried) = (true, 0);
    for function in FUNCTIONS {
        let (sample, boundaries) = (sweep(function, STRIDE, &|_| ()), sweep_boundaries(function));
        tried += sample.tried + boundaries.tried;
        let worst = if boundaries.ulps > sample.ulps { boundaries } else { sample };
        let outcome = Outcome { function, worst };
        holds &= outcome.holds();
        let verdict = if outcome.holds() { "holds" } else { "BROKEN" };
        rows.push(vec![
            function.name.to_owned(),
            format!("{:.4}", worst.ulps),
            format!("{}", function.allowed_ulps),
            format!("{:?}", worst.argument),
            verdict.to_owned(),
        ]);
    }
    Check {
        name: "Elementary functions",
        promise: "Each function of f32 is within its bound of the exact value, in units in the last place.",
        holds,
        found: format!("{tried} arguments tried; `lobe sweep` tries all of them."),
        columns: &["function", "worst (ulp)", "allowed", "at", "verdict"],
        rows,
    }
}

fn strange_numbers() -> Check {
    let mut rows = Vec::new();
    let mut holds = true;
    for index in 0..lobes(0.0).len() {
        let mut counts = [0_usize; 3];
        let mut wrong = [0_usize; 3];
        let mut random = Random::new();
        let mut model = String::new();
        for q in EXPONENTS {
            let Some(lobe) = lobes(q).get(index).copied() else { continue };
            model = name(&lobe);
            let brdf = alone(&lobe).build(0.0_f32);
            for _ in 0..200 {
                let (l, v) = random.pair();
                // Both values, the plain one and the one with the cosine.
                let mut try_all = |kind: usize, l: Vec3<f32>, v: Vec3<f32>, right: fn(f32) -> bool| {
                    for Rgb { r, g, b } in [brdf.eval(l, v), brdf.eval_cos(l, v)] {
                        counts[kind] += 1;
                        wrong[kind] += usize::from(![r, g, b].into_iter().all(right));
                    }
                };
                for strange in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                    for bad in [Vec3 { x: strange, ..l }, Vec3 { y: strange, ..l }, Vec3 { z: strange, ..l }] {
                        try_all(0, bad, v, f32::is_nan);
                        try_all(0, v, bad, f32::is_nan);
                    }
                }
                try_all(1, Vec3 { z: -l.z, ..l }, v, |x| x == 0.0);
                try_all(1, l, Vec3 { z: -v.z, ..v }, |x| x == 0.0);
                try_all(2, l, v, |x| x.is_finite() && x >= 0.0);
                let grazing = Vec3 { z: 1e-20, ..v };
                try_all(2, l, grazing, |x| x.is_finite() && x >= 0.0);
            }
        }
        holds &= wrong == [0; 3];
        let cells = counts.iter().zip(wrong).map(|(count, wrong)| match wrong {
            0 => format!("all {count}"),
            _ => format!("{wrong} of {count} WRONG"),
        });
        rows.push(std::iter::once(model).chain(cells).collect());
    }
    Check {
        name: "Strange numbers",
        promise: "NaN or infinity in gives NaN out; below the horizon the value is 0; elsewhere finite and not negative.",
        holds,
        found: "Each component of each direction in turn; cosines down to 1e-20.".to_owned(),
        columns: &["lobe", "NaN in, NaN out", "0 below the horizon", "finite and not negative"],
        rows,
    }
}
