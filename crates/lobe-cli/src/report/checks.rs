//! What the mathematics promises, computed anew for the report.

use super::random::Random;
use crate::sweep::Outcome;
use lobe::{Rgb, Vec3};
use lobe_energy::directional_albedo;
use lobe_models::{Kind, Lobe, Model, Value, models};
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

/// A row of the tables: a model, and a word of it that is not the default one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Variant {
    model: &'static Model,
    word: Option<(&'static str, &'static str)>,
}

/// Every model, once with its default words and once with each other word.
pub(crate) fn variants() -> Vec<Variant> {
    models()
        .flat_map(|model| {
            let other_words = model.parameters.iter().flat_map(|parameter| {
                let words = match parameter.kind {
                    Kind::Choice(words) => words,
                    _ => &[],
                };
                let other = words.iter().filter(|word| parameter.default != Some(Value::Choice(word)));
                other.map(|word| Some((parameter.name, *word)))
            });
            std::iter::once(None).chain(other_words).map(move |word| Variant { model, word })
        })
        .collect()
}

/// How sharp a lobe is in the checks: the exponent where the model has one, the width where it has that.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level {
    q: f64,
    alpha: f64,
    /// Where in its range any other number is, and how large a colour that is no weight.
    part: f64,
}

/// From the widest to the sharpest. The numbers are those of f32, so that both number types are given the same lobe.
pub(crate) const LEVELS: [Level; 7] = [
    Level { q: 0.0, alpha: 1.0, part: 0.0 },
    Level { q: 1.0, alpha: 0.5, part: 1.0 },
    Level { q: 8.0, alpha: 0.25, part: 0.5 },
    Level { q: 50.0, alpha: 0.125, part: 0.25 },
    Level { q: 400.0, alpha: 0.03125, part: 0.75 },
    Level { q: 1e4, alpha: 0.00390625, part: 0.125 },
    Level { q: 1e6, alpha: 0.0001220703125, part: 1.0 },
];

impl Variant {
    pub(crate) fn model(&self) -> &'static Model {
        self.model
    }

    pub(crate) fn name(&self) -> String {
        match self.word {
            Some((_, word)) => format!("{} ({word})", self.model.name),
            None => self.model.name.to_owned(),
        }
    }

    /// With weights of 1. `None` if the model refuses: then it is left out at this level.
    pub(crate) fn at(&self, level: Level) -> Option<Lobe> {
        let in_f32 = |x: f64| f64::from(x as f32);
        let values: Vec<(&str, Value)> = self
            .model
            .parameters
            .iter()
            .map(|parameter| {
                let value = match parameter.kind {
                    Kind::Colour { max } if parameter.is_weight() => Value::Colour([max.min(1.0); 3]),
                    // Half of the range at least: at 0 there is nothing to be seen.
                    Kind::Colour { max } => Value::Colour([in_f32(max * (0.5 + 0.5 * level.part)); 3]),
                    Kind::Number { .. } if parameter.name == "q" => Value::Number(level.q),
                    // Widths that have the names of their papers.
                    Kind::Number { min, max } if matches!(parameter.name, "m" | "c") => {
                        Value::Number(level.alpha.clamp(min, max))
                    }
                    Kind::Number { min, max } => {
                        let inside = if min > 0.0 && max / min > 100.0 {
                            min * (max / min).powf(level.part)
                        } else {
                            min + (max - min) * level.part
                        };
                        let near = in_f32(inside);
                        Value::Number(if (min..=max).contains(&near) { near } else { inside })
                    }
                    Kind::Widths => Value::Widths([level.alpha; 2]),
                    Kind::Table => {
                        // A bell of this width.
                        let bell = |i: usize| (-(5.0 * i as f64).to_radians().powi(2) / level.alpha.powi(2)).exp();
                        Value::Table(std::array::from_fn(|i| in_f32(bell(i).max(1e-6))))
                    }
                    Kind::Choice(words) => {
                        let chosen = self.word.filter(|(name, _)| *name == parameter.name).map(|(_, word)| word);
                        let default = match parameter.default {
                            Some(Value::Choice(word)) => Some(word),
                            _ => words.first().copied(),
                        };
                        Value::Choice(chosen.or(default).unwrap_or_default())
                    }
                };
                (parameter.name, value)
            })
            .collect();
        Lobe::new(self.model, &values).ok()
    }

    fn kind(&self) -> &'static str {
        if self.model.name.starts_with("lecture-") { "the lecture's highlight, no BRDF" } else { "BRDF" }
    }

    fn has_power_lobe(&self) -> bool {
        matches!(self.model.name, "phong" | "blinn-phong" | "lecture-phong" | "lecture-blinn-torrance")
    }

    /// Whether it is said to reflect at most what arrives.
    pub(crate) fn conserves(&self) -> bool {
        match self.model.name {
            "lambert" | "phong" => true,
            // With Smith's masking, which follows from the distribution, or that of V-cavities. The approximations of
            // other maskings promise nothing.
            "microfacet" => {
                self.word.is_none_or(|(name, word)| name != "masking" || matches!(word, "smith-separable" | "v-cavity"))
            }
            "blinn-phong" => self.word.is_none(),
            _ => false,
        }
    }
}

fn reciprocity() -> Check {
    let mut rows = Vec::new();
    let (mut holds, mut pairs) = (true, 0);
    for variant in variants() {
        let (mut differing, mut not_zero) = (0, 0);
        let mut worst = 1.0_f64;
        let mut random = Random::new();
        for level in LEVELS {
            let Some(lobe) = variant.at(level) else { continue };
            let brdf = lobe.build::<f32>();
            for _ in 0..PAIRS / LEVELS.len() {
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
        let verdict = match (variant.model.reciprocal, differing) {
            (true, 0) if not_zero < LEAST_PAIRS => format!("too few pairs with a value: {not_zero}"),
            (true, 0) => "equal to the last bit".to_owned(),
            (true, _) => format!("{differing} pairs differ"),
            (false, _) => format!("not reciprocal, as documented: differs by a factor of up to {worst:.1e}"),
        };
        holds &= !variant.model.reciprocal || (differing == 0 && not_zero >= LEAST_PAIRS);
        rows.push(vec![variant.name(), variant.kind().to_owned(), not_zero.to_string(), verdict]);
    }
    Check {
        name: "Reciprocity",
        promise: "Light and viewer can be exchanged: f(l, v) and f(v, l) have the same bits in f32.",
        holds,
        found: format!("{pairs} random pairs, exponents from 0 to a million, widths from 1 to 1e-4."),
        columns: &["lobe", "kind", "pairs with a value", "f(l, v) against f(v, l)"],
        rows,
    }
}

fn precision() -> Check {
    let mut rows = Vec::new();
    let (mut holds, mut pairs) = (true, 0);
    for variant in variants() {
        let mut random = Random::new();
        let mut errors = Vec::new();
        let mut worst = (0.0, String::new());
        let mut over_bound = 0.0_f64;
        for level in LEVELS {
            let Some(lobe) = variant.at(level) else { continue };
            let (single, double) = (lobe.build::<f32>(), lobe.build::<f64>());
            let peak = double.eval(up(), up()).g;
            for _ in 0..PAIRS / LEVELS.len() {
                let (l, v) = random.pair();
                let (l64, v64) = (l.map(f64::from), v.map(f64::from));
                let (value, exact) = if lobe.model().reciprocal {
                    (single.eval(l, v).g, double.eval(l64, v64).g)
                } else {
                    (single.eval_cos(l, v).g, double.eval_cos(l64, v64).g)
                };
                // Towards the ends of f32 a factor leaves its range while the product is still inside; where the value
                // itself has left it, there is none.
                if exact <= peak * f64::from(f32::MIN_POSITIVE) * 1.001
                    || !(1e-30..f64::from(f32::MAX)).contains(&exact)
                {
                    continue;
                }
                let error = (f64::from(value) - exact).abs() / exact;
                errors.push(error);
                let part = error / lobe.tolerance(l64, v64);
                // `max` would pass over a NaN.
                over_bound = if part.is_nan() { f64::INFINITY } else { over_bound.max(part) };
                if error > worst.0 || error.is_nan() {
                    worst = (error, format!("{}, l = {}, v = {}", lobe.description(), vector(l), vector(v)));
                }
            }
        }
        pairs += errors.len();
        let found = summary(&mut errors);
        holds &= over_bound <= 1.0 && errors.len() >= LEAST_PAIRS;
        let row = [found.median, found.percentile_99, found.worst].map(|error| format!("{error:.2e}"));
        let part = format!("{:.0} %", over_bound * 100.0);
        rows.push([vec![variant.name()], row.to_vec(), vec![part, worst.1]].concat());
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

fn up() -> Vec3<f64> {
    Vec3::new(0.0, 0.0, 1.0)
}

fn vector(d: Vec3<f32>) -> String {
    format!("({:?}, {:?}, {:?})", d.x, d.y, d.z)
}

/// An albedo that its quadrature knows less well than this is not known. Sharp lobes at 89° are known to three digits.
const LARGEST_ERROR: f64 = 1e-2;
/// The angles from the normal at which energy is checked.
const ANGLES: [f64; 6] = [0.0, 55.0, 75.0, 85.0, 30.0, 89.0];

fn energy() -> Check {
    let cases: Vec<(Variant, Lobe)> = variants()
        .into_iter()
        // What promises to conserve energy, and beside it the lobes that are known not to. Every Fresnel term is at most
        // 1, which its own tests show: one of them is enough here.
        .filter(|variant| variant.conserves() || variant.has_power_lobe())
        .filter(|variant| variant.word.is_none_or(|(name, _)| !matches!(name, "fresnel" | "metal")))
        .flat_map(|variant| {
            // The quadrature follows a power lobe to any sharpness; of the others, the sharpest take it minutes.
            let levels = if variant.has_power_lobe() { &LEVELS[..] } else { &LEVELS[1..4] };
            levels.iter().filter_map(move |&level| Some((variant, variant.at(level)?)))
        })
        .collect();
    let highest: Vec<(String, String, (f64, f64))> = cases
        .into_par_iter()
        .map(|(variant, lobe)| {
            let brdf = lobe.build::<f64>();
            let of = |angle: f64| {
                let (sin, cos) = angle.to_radians().sin_cos();
                let albedo = directional_albedo(&*brdf, Vec3::new(sin, 0.0, cos));
                // A value that is not known, or not a number, is above everything.
                let known = albedo.error <= LARGEST_ERROR && albedo.value.g.is_finite();
                if known { (albedo.value.g, albedo.error) } else { (f64::INFINITY, 0.0) }
            };
            let angles = if variant.has_power_lobe() { &ANGLES[..] } else { &ANGLES[1..3] };
            let (angle, albedo) = angles
                .iter()
                .map(|&angle| (angle, of(angle)))
                .fold((0.0, (0.0, 0.0)), |best, next| if next.1.0 > best.1.0 { next } else { best });
            (variant.name(), format!("{}, {angle}°", shape(&lobe)), albedo)
        })
        .collect();

    let mut rows = Vec::new();
    let mut holds = true;
    for variant in variants() {
        if highest.iter().all(|(name, ..)| *name != variant.name()) {
            continue;
        }
        let same = highest.iter().filter(|(name, ..)| *name == variant.name());
        let (at, (albedo, error)) =
            same.fold(
                ("", (0.0, 0.0)),
                |best, (_, at, albedo)| {
                    if albedo.0 > best.1.0 { (at.as_str(), *albedo) } else { best }
                },
            );
        let conserves = variant.conserves();
        let fits = albedo <= 1.0 + 1e-6 + error;
        holds &= fits || !conserves;
        let verdict = match (fits, conserves) {
            (true, _) => "at most 1",
            (false, true) => "GAINS ENERGY",
            (false, false) if albedo == f64::INFINITY => "not known: its integral does not converge",
            (false, false) => "gains energy; no promise is made",
        };
        let at = at.trim_start_matches(", ").to_owned();
        rows.push(vec![variant.name(), digits(albedo, error), at, verdict.to_owned()]);
    }
    Check {
        name: "Energy",
        promise: "With a coefficient of 1, a lobe that conserves energy reflects at most what arrives.",
        holds,
        found:
            "Quadrature at 55° and 75°, widths from 1/2 to 1/8; of the power lobes from 0° to 89°, exponents up to a million. \
             Of the Fresnel terms one, since all are at most 1."
                .to_owned(),
        columns: &["lobe", "highest albedo", "at", "verdict"],
        rows,
    }
}

/// As many digits as are known.
fn digits(value: f64, error: f64) -> String {
    let known = (-error.max(1e-6).log10()).floor().clamp(1.0, 5.0) as usize;
    if value.is_finite() { format!("{value:.known$}") } else { "–".to_owned() }
}

/// The exponent or the width, for a table.
fn shape(lobe: &Lobe) -> String {
    let shapes = ["q", "alpha", "m", "c"].into_iter();
    let mut known = shapes.filter_map(|name| Some(format!("{name} = {}", lobe.value(name)?.bare())));
    known.next().unwrap_or_default()
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
    for variant in variants() {
        let mut counts = [0_usize; 3];
        let mut wrong = [0_usize; 3];
        let mut random = Random::new();
        for level in LEVELS {
            let Some(lobe) = variant.at(level) else { continue };
            let brdf = lobe.build::<f32>();
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
                let good: fn(f32) -> bool = |x| x.is_finite() && x >= 0.0;
                try_all(2, l, v, good);
                let grazing = Vec3 { z: 1e-20, ..v };
                // Some models leave the range of f32 there, as they say; `eval_cos` does not.
                try_all(2, l, grazing, if lobe.model().finite { good } else { |x| x >= 0.0 });
                counts[2] += 1;
                let Rgb { r, g, b } = brdf.eval_cos(l, grazing);
                wrong[2] += usize::from(![r, g, b].into_iter().all(good));
            }
        }
        holds &= wrong == [0; 3];
        let cells = counts.iter().zip(wrong).map(|(count, wrong)| match wrong {
            0 => format!("all {count}"),
            _ => format!("{wrong} of {count} WRONG"),
        });
        rows.push(std::iter::once(variant.name()).chain(cells).collect());
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
