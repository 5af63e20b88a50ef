//! `f32` against `f64` at the extremes: a crossed grid, random inputs, and a search that climbs towards the worst case.
//!
//! [`extremes`] looks at any BRDF that exists in both number types, [`model_extremes`] at a model of the catalogue with
//! all of its parameters. Both use the same numbers every time, so that a worst case can be met again.
//!
//! ```
//! use lobe::{Lambert, Rgb};
//! use lobe_verify::extremes::{Effort, Promises, extremes};
//!
//! let albedo = Rgb::splat(0.25_f32);
//! let (single, double) = (Lambert::new(albedo), Lambert::new(albedo.map(f64::from)));
//! let found = extremes(&single, &double, Promises::default(), &|_, _| 2e-7, Effort::QUICK);
//! assert!(found.faults.is_empty() && found.worst_part() <= 1.0);
//! ```

mod histogram;
mod inputs;

use histogram::Histogram;
use inputs::GRAZING;
pub(crate) use inputs::{Random, across, grid_values, is_logarithmic, lobe, random_lobe, random_value, tilted, unit};
use lobe::{Brdf, Rgb, Vec3};
use lobe_models::{Bound, Lobe, Model};
use rayon::prelude::*;
use std::fmt;

/// Values below this are not compared relatively: a factor of theirs may be subnormal in `f32`, and has lost its digits.
/// Nor are those that only a cosine near 0 in the denominator lifts above it: the larger cosine times `f_r` is below it.
pub const DARK: f64 = 1e-30;

/// Where all components of `l + v` are below this, `D` of a half vector that is not normalised may have no digits left.
const OPPOSITE: f32 = 2e-32;

/// The target for the 99th percentile of a model whose bound is constant.
pub const TARGET_99: f64 = 4e-6;

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Lobes of the grid of a model's parameters, at most.
    pub lobes: usize,
    /// Pairs of directions on the grid for each of these lobes, at most.
    pub pairs: usize,
    /// Random inputs, for each lobe.
    pub random: usize,
    /// How many searches for the worst case are started.
    pub climbs: usize,
    /// The steps of each.
    pub steps: usize,
}

impl Effort {
    /// A fraction of a second for a model: for tests.
    pub const QUICK: Self = Self { lobes: 60, pairs: 600, random: 200, climbs: 16, steps: 300 };
    /// A few seconds for a model.
    pub const FULL: Self = Self { lobes: 1500, pairs: 1500, random: 500, climbs: 200, steps: 3000 };

    /// The steps of progress that a model takes.
    #[must_use]
    pub fn total(self) -> u64 {
        (self.lobes + self.climbs) as u64
    }
}

/// What a BRDF promises beside its accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Promises {
    /// `f(l, v) = f(v, l)`, to the last bit.
    pub reciprocal: bool,
    /// `eval` is finite for cosines down to 1e-20; `eval_cos` is in any case, down to the smallest normal number.
    pub finite: bool,
}

impl Default for Promises {
    /// All that `Brdf` promises.
    fn default() -> Self {
        Self { reciprocal: true, finite: true }
    }
}

/// Which function was looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// `eval`.
    Eval,
    /// `eval_cos`.
    EvalCos,
}

/// A value and where it was found.
#[derive(Clone, Debug)]
pub struct Case {
    /// The lobe, if a model of the catalogue was looked at.
    pub lobe: Option<Lobe>,
    /// To the light.
    pub l: Vec3,
    /// To the viewer.
    pub v: Vec3,
    /// Which function.
    pub quantity: Quantity,
    /// What it gave in `f32`, in the worst channel.
    pub value: f32,
    /// What it gave in `f64`; for [`FaultKind::NotReciprocal`] what `f32` gave the other way round.
    pub exact: f64,
    /// The relative error.
    pub error: f64,
    /// The error as a part of what is allowed there.
    pub part: f64,
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(lobe) = &self.lobe {
            write!(f, "{lobe} ")?;
        }
        let name = match self.quantity {
            Quantity::Eval => "eval",
            Quantity::EvalCos => "eval_cos",
        };
        let ([lx, ly, lz], [vx, vy, vz]) = (<[f32; 3]>::from(self.l), <[f32; 3]>::from(self.v));
        write!(f, "at {lx:?},{ly:?},{lz:?},{vx:?},{vy:?},{vz:?}: {name} {:?}, exactly {:?}", self.value, self.exact)
    }
}

/// A promise that a value may break.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// NaN or infinite.
    NotFinite,
    /// Below 0.
    Negative,
    /// Not the same both ways.
    NotReciprocal,
    /// Too large for what is black in `f64`, or not infinite for what `f32` cannot hold.
    OutOfRange,
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "not finite",
            Self::Negative => "negative",
            Self::NotReciprocal => "not reciprocal",
            Self::OutOfRange => "not near the exact value, which is outside the range of comparison",
        })
    }
}

/// How often a promise is broken, and the first time.
#[derive(Clone, Debug)]
pub struct Fault {
    /// Which promise.
    pub kind: FaultKind,
    /// How often.
    pub count: u64,
    /// The first time.
    pub first: Case,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Findings {
    errors: Histogram,
    /// `|f(l, v) − f(v, l)|/max` in `f64`, where reciprocity is not promised.
    defects: Histogram,
    /// Values that were not compared: below [`DARK`], beyond the largest `f32`, or where the bound says nothing.
    pub skipped: u64,
    /// The input with the largest error as a part of what is allowed, of the grid and of the search.
    pub worst: Option<Case>,
    /// The same of the grid and the random inputs alone.
    pub worst_on_grid: Option<Case>,
    /// The largest defect of reciprocity.
    pub worst_defect: f64,
    /// The promises that are broken.
    pub faults: Vec<Fault>,
    /// Where the search starts: the worst case of each lobe.
    leaders: Vec<Case>,
}

impl Findings {
    fn new() -> Self {
        Self {
            errors: Histogram::new(),
            defects: Histogram::new(),
            skipped: 0,
            worst: None,
            worst_on_grid: None,
            worst_defect: 0.0,
            faults: Vec::new(),
            leaders: Vec::new(),
        }
    }

    /// How many values were compared on the grid and at random.
    #[must_use]
    pub fn compared(&self) -> u64 {
        self.errors.count()
    }

    /// The median of the relative errors, of the grid and the random inputs: a search for the worst case would not be
    /// a fair sample.
    #[must_use]
    pub fn median(&self) -> f64 {
        self.errors.quantile(0.5)
    }

    /// Their 99th percentile.
    #[must_use]
    pub fn percentile_99(&self) -> f64 {
        self.errors.quantile(0.99)
    }

    /// The largest relative error, of the grid, the random inputs and the search; where the bound is not constant, it
    /// need not be the worst.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.errors.quantile(1.0).max(self.worst.as_ref().map_or(0.0, |case| case.error))
    }

    /// The median of the defects of reciprocity.
    #[must_use]
    pub fn median_defect(&self) -> f64 {
        self.defects.quantile(0.5)
    }

    /// The largest error as a part of what is allowed there.
    #[must_use]
    pub fn worst_part(&self) -> f64 {
        self.worst.as_ref().map_or(0.0, |case| case.part)
    }

    fn fault(&mut self, kind: FaultKind, case: impl FnOnce() -> Case) {
        match self.faults.iter_mut().find(|fault| fault.kind == kind) {
            Some(fault) => fault.count += 1,
            None => self.faults.push(Fault { kind, count: 1, first: case() }),
        }
    }

    /// `other` was found after `self`.
    fn merge(&mut self, other: Self) {
        self.errors.merge(&other.errors);
        self.defects.merge(&other.defects);
        self.skipped += other.skipped;
        self.worst_on_grid = worse(self.worst_on_grid.take(), other.worst_on_grid);
        self.worst = worse(self.worst.take(), other.worst);
        self.worst_defect = self.worst_defect.max(other.worst_defect);
        for fault in other.faults {
            match self.faults.iter_mut().find(|own| own.kind == fault.kind) {
                Some(own) => own.count += fault.count,
                None => self.faults.push(fault),
            }
        }
        self.leaders.extend(other.leaders);
    }
}

/// The case with the larger part; the first of two equals.
fn worse(a: Option<Case>, b: Option<Case>) -> Option<Case> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.part > a.part { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// A BRDF in both number types, and what it promises.
struct Subject<'a> {
    lobe: Option<&'a Lobe>,
    single: &'a dyn Brdf<f32>,
    double: &'a dyn Brdf<f64>,
    promises: Promises,
    bound: &'a dyn Fn(Vec3<f64>, Vec3<f64>) -> f64,
}

/// `value` against `exact`: what becomes of it.
enum Verdict {
    /// The relative error.
    Error(f64),
    Skipped,
    Fault(FaultKind),
}

/// `lifted` is what `f_r` may have gained from a small cosine in its denominator.
fn judge(value: f32, exact: f64, bound: f64, finite: bool, lifted: f64) -> Verdict {
    const MOST: f64 = f32::MAX as f64;
    if finite && !value.is_finite() {
        return Verdict::Fault(FaultKind::NotFinite);
    }
    if value < 0.0 {
        return Verdict::Fault(FaultKind::Negative);
    }
    // A relative bound of 1 says nothing of any digit: the exact value may be 0 for all it knows.
    if bound >= 1.0 {
        return Verdict::Skipped;
    }
    let value = f64::from(value);
    if exact < DARK * lifted {
        // A value that is not compared is still as dark.
        return if value <= DARK * lifted * (1.0 + bound) {
            Verdict::Skipped
        } else {
            Verdict::Fault(FaultKind::OutOfRange)
        };
    }
    if exact > MOST {
        return if value >= MOST * (1.0 - bound) { Verdict::Skipped } else { Verdict::Fault(FaultKind::OutOfRange) };
    }
    // The last step below the largest float may round to infinity.
    let value = value.min(MOST * (1.0 + f64::from(f32::EPSILON)));
    let error = (value - exact).abs() / exact;
    if error.is_nan() { Verdict::Fault(FaultKind::NotFinite) } else { Verdict::Error(error) }
}

/// One over the larger cosine for `f_r`, and for `f_r (n·l)` what is left of it.
fn lifted((l, v): (Vec3, Vec3), quantity: Quantity) -> f64 {
    let lifted = 1.0 / f64::from(l.z.max(v.z));
    match quantity {
        Quantity::Eval => lifted,
        Quantity::EvalCos => (lifted * f64::from(l.z)).max(1.0),
    }
}

impl Subject<'_> {
    fn case(
        &self,
        (l, v): (Vec3, Vec3),
        quantity: Quantity,
        (value, exact): (f32, f64),
        error: f64,
        part: f64,
    ) -> Case {
        Case { lobe: self.lobe.cloned(), l, v, quantity, value, exact, error, part }
    }

    /// Hands the values in both number types of every channel to `see`.
    fn values(&self, (l, v): (Vec3, Vec3), mut see: impl FnMut(Quantity, f32, f64)) {
        let (wide_l, wide_v) = (l.map(f64::from), v.map(f64::from));
        let mut both = |quantity, a: Rgb<f32>, b: Rgb<f64>| {
            for (a, b) in <[f32; 3]>::from(a).into_iter().zip(<[f64; 3]>::from(b)) {
                see(quantity, a, b);
            }
        };
        if l.z.min(v.z) >= GRAZING {
            both(Quantity::Eval, self.single.eval(l, v), self.double.eval(wide_l, wide_v));
        }
        both(Quantity::EvalCos, self.single.eval_cos(l, v), self.double.eval_cos(wide_l, wide_v));
    }

    /// The bound of the model there; none where the directions are so nearly opposite, at the horizon, that their sum has
    /// squares below the smallest normal number. They are looked at for what is not finite or negative.
    fn bound_at(&self, (l, v): (Vec3, Vec3)) -> f64 {
        let s = (l + v).map(f32::abs);
        let opposite = s.x.max(s.y).max(s.z) < OPPOSITE;
        if opposite { f64::INFINITY } else { (self.bound)(l.map(f64::from), v.map(f64::from)) }
    }

    /// Looks at one pair.
    fn look(&self, pair: (Vec3, Vec3), found: &mut Findings) {
        let bound = self.bound_at(pair);
        self.values(pair, |quantity, value, exact| {
            let finite = self.promises.finite || quantity == Quantity::EvalCos;
            match judge(value, exact, bound, finite, lifted(pair, quantity)) {
                Verdict::Skipped => found.skipped += 1,
                Verdict::Fault(kind) => {
                    found.fault(kind, || self.case(pair, quantity, (value, exact), f64::NAN, f64::INFINITY));
                }
                Verdict::Error(error) => {
                    found.errors.add(error);
                    let part = error / bound;
                    if found.worst_on_grid.as_ref().is_none_or(|worst| part > worst.part) {
                        found.worst_on_grid = Some(self.case(pair, quantity, (value, exact), error, part));
                    }
                }
            }
        });
        self.look_both_ways(pair, found);
    }

    fn look_both_ways(&self, (l, v): (Vec3, Vec3), found: &mut Findings) {
        if l.z.min(v.z) < GRAZING {
            return;
        }
        if self.promises.reciprocal {
            let there = <[f32; 3]>::from(self.single.eval(l, v));
            let back = <[f32; 3]>::from(self.single.eval(v, l));
            for (a, b) in there.into_iter().zip(back) {
                if a.to_bits() != b.to_bits() {
                    let both = (a, f64::from(b));
                    found.fault(FaultKind::NotReciprocal, || {
                        self.case((l, v), Quantity::Eval, both, f64::from(a) / f64::from(b) - 1.0, f64::INFINITY)
                    });
                }
            }
        } else {
            let (l, v) = (l.map(f64::from), v.map(f64::from));
            let there = <[f64; 3]>::from(self.double.eval(l, v));
            let back = <[f64; 3]>::from(self.double.eval(v, l));
            for (a, b) in there.into_iter().zip(back) {
                let largest = a.max(b);
                if largest > DARK && largest.is_finite() {
                    let defect = (a - b).abs() / largest;
                    found.defects.add(defect);
                    found.worst_defect = found.worst_defect.max(defect);
                }
            }
        }
    }

    /// The worst value of a pair, if there is one that can be compared.
    fn worst_at(&self, pair: (Vec3, Vec3)) -> Option<Case> {
        let bound = self.bound_at(pair);
        let mut worst: Option<(Quantity, f32, f64, f64)> = None;
        self.values(pair, |quantity, value, exact| {
            // A fault that only the search has found is as bad as can be.
            let finite = self.promises.finite || quantity == Quantity::EvalCos;
            let error = match judge(value, exact, bound, finite, lifted(pair, quantity)) {
                Verdict::Error(error) => error,
                Verdict::Skipped => return,
                Verdict::Fault(_) => f64::INFINITY,
            };
            if worst.is_none_or(|(.., most)| error > most) {
                worst = Some((quantity, value, exact, error));
            }
        });
        worst.map(|(quantity, value, exact, error)| self.case(pair, quantity, (value, exact), error, error / bound))
    }
}

/// Calls `with` on the lobe in both number types.
fn with_subject<T>(lobe: &Lobe, with: impl FnOnce(&Subject<'_>) -> T) -> T {
    let (single, double) = (lobe.build::<f32>(), lobe.build::<f64>());
    with(&Subject {
        lobe: Some(lobe),
        single: &*single,
        double: &*double,
        promises: Promises { reciprocal: lobe.model().reciprocal, finite: lobe.model().finite },
        bound: &|l, v| lobe.tolerance(l, v),
    })
}

/// Every part of the grid that belongs to the `index`-th lobe, and random pairs.
fn look_around(subject: &Subject<'_>, index: usize, grid: &[(Vec3, Vec3)], effort: Effort, seed: u64) -> Findings {
    let mut found = Findings::new();
    // Another part of the grid for each lobe, evenly strewn.
    let stride = grid.len().div_ceil(effort.pairs.max(1)).max(1);
    for pair in grid.iter().skip(index % stride).step_by(stride) {
        subject.look(*pair, &mut found);
    }
    let mut random = Random::new(seed ^ (index as u64).wrapping_mul(0xd134_2543_de82_ef95));
    for _ in 0..effort.random {
        subject.look(inputs::pair(&mut random), &mut found);
    }
    found.leaders.extend(found.worst_on_grid.clone());
    found
}

/// Looks at a BRDF in both number types, the same formula with the same parameters, at every extreme of its
/// directions. `bound` is the relative error that is allowed for a pair of directions.
#[must_use]
pub fn extremes(
    single: &dyn Brdf<f32>,
    double: &dyn Brdf<f64>,
    promises: Promises,
    bound: &dyn Fn(Vec3<f64>, Vec3<f64>) -> f64,
    effort: Effort,
) -> Findings {
    let subject = Subject { lobe: None, single, double, promises, bound };
    // One lobe has the whole grid.
    let whole = Effort { pairs: usize::MAX, random: effort.random * effort.lobes, ..effort };
    let mut found = look_around(&subject, 0, &inputs::grid(), whole, 0);
    let starts = found.leaders.clone();
    found.worst.clone_from(&found.worst_on_grid);
    for index in 0..effort.climbs {
        let mut random = Random::new(!(index as u64));
        let start = match starts.first() {
            Some(case) if index % 4 == 0 => (case.l, case.v),
            _ => inputs::pair(&mut random),
        };
        let mut best = subject.worst_at(start);
        for _ in 0..effort.steps {
            let from = best.as_ref().map_or(start, |case| (case.l, case.v));
            let next = inputs::nudged_pair(from, &mut random).and_then(|pair| subject.worst_at(pair));
            best = climbed(best, next);
        }
        found.worst = worse(found.worst.take(), best);
    }
    found
}

/// A step is taken if it leads up, or along: a plateau has to be crossed.
fn climbed(from: Option<Case>, to: Option<Case>) -> Option<Case> {
    match (from, to) {
        (Some(from), Some(to)) => Some(if to.part >= from.part { to } else { from }),
        (from, to) => to.or(from),
    }
}

/// Looks at a model of the catalogue, with its parameters at every extreme as well. `progress` is told of
/// [`Effort::total`] steps, one or a few at a time.
#[must_use]
pub fn model_extremes(model: &'static Model, effort: Effort, progress: &(dyn Fn(u64) + Sync)) -> Findings {
    let seed = model
        .name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
    let grid = inputs::grid();
    let lobes = inputs::grid_lobes(model, effort.lobes);
    // What a small grid leaves of the effort goes into random parameters.
    let mut random = Random::new(seed);
    let more = (lobes.len()..effort.lobes).filter_map(|_| random_lobe(model, &mut random));
    let lobes: Vec<_> = lobes.iter().cloned().chain(more).collect();
    // In chunks that are merged in order: the outcome does not depend on the number of threads.
    let parts: Vec<Findings> = lobes
        .par_chunks(8)
        .enumerate()
        .map(|(chunk, lobes)| {
            let mut found = Findings::new();
            for (i, lobe) in lobes.iter().enumerate() {
                let index = 8 * chunk + i;
                found.merge(with_subject(lobe, |subject| look_around(subject, index, &grid, effort, seed)));
            }
            progress(lobes.len() as u64);
            found
        })
        .collect();
    let mut found = Findings::new();
    for part in parts {
        found.merge(part);
    }
    found.worst.clone_from(&found.worst_on_grid);

    // From the worst cases of as many lobes, and from anywhere.
    found.leaders.sort_by(|a, b| b.part.total_cmp(&a.part));
    let leaders = std::mem::take(&mut found.leaders);
    let climbs: Vec<Option<Case>> = (0..effort.climbs)
        .into_par_iter()
        .map(|index| {
            let random = Random::new(!seed ^ (index as u64).wrapping_mul(0xa076_1d64_78bd_642f));
            // Half of them from the top of the list; not too many from the same hill.
            let start =
                if index % 2 == 0 { leaders.get(index / 2 * leaders.len().min(400) / effort.climbs) } else { None };
            let best = climb(model, start, effort.steps, random);
            progress(1);
            best
        })
        .collect();
    for best in climbs {
        found.worst = worse(found.worst.take(), best);
    }
    found
}

fn climb(model: &'static Model, start: Option<&Case>, steps: usize, mut random: Random) -> Option<Case> {
    let mut lobe = match start {
        Some(case) => case.lobe.clone()?,
        None => random_lobe(model, &mut random)?,
    };
    let pair = start.map_or_else(|| inputs::pair(&mut random), |case| (case.l, case.v));
    let mut best = with_subject(&lobe, |subject| subject.worst_at(pair));
    let mut step = 0;
    while step < steps {
        // Some steps with the same parameters, then one with others.
        best = with_subject(&lobe, |subject| {
            let mut best = best.take();
            for _ in 0..8 {
                let from = best.as_ref().map_or(pair, |case| (case.l, case.v));
                let next = inputs::nudged_pair(from, &mut random).and_then(|pair| subject.worst_at(pair));
                best = climbed(best, next);
            }
            best
        });
        let from = best.as_ref().map_or(pair, |case| (case.l, case.v));
        if let Some(other) = inputs::nudged_lobe(&lobe, &mut random) {
            let next = with_subject(&other, |subject| subject.worst_at(from));
            let up = match (&best, &next) {
                (Some(a), Some(b)) => b.part >= a.part,
                (None, _) => true,
                _ => false,
            };
            if up {
                (lobe, best) = (other, next);
            }
        }
        step += 9;
    }
    best
}

/// Whether a model keeps what it promises.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The model.
    pub model: &'static Model,
    /// What was found.
    pub findings: Findings,
}

impl Outcome {
    /// Looks at a model.
    #[must_use]
    pub fn of(model: &'static Model, effort: Effort, progress: &(dyn Fn(u64) + Sync)) -> Self {
        Self { model, findings: model_extremes(model, effort, progress) }
    }

    /// Whether all is as promised: no fault, the worst error within the bound, and the 99th percentile within
    /// [`TARGET_99`] but for a bound that is derived throughout.
    #[must_use]
    pub fn holds(&self) -> bool {
        let percentile_is_good = match self.model.bound {
            Bound::Constant | Bound::Excess { .. } => self.findings.percentile_99() <= TARGET_99,
            Bound::Derived { .. } => true,
        };
        self.findings.faults.is_empty() && self.findings.worst_part() <= 1.0 && percentile_is_good
    }
}
