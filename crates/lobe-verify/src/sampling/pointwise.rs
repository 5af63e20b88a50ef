//! What each sample has to be, whatever its distribution.

use super::claims::Claims;
use super::draws::SINGLE;
use super::random::Random;
use super::report::{Case, Outcome, Property, Verdict};
use super::sampler::Sampler;
use crate::subject::Precision;
use lobe_sampling::Outcome as Drawn;

/// A sampler at a view.
#[derive(Clone, Copy)]
pub(crate) struct At<'a> {
    pub(crate) sampler: &'a dyn Sampler,
    pub(crate) claims: &'a Claims,
    pub(crate) v: [f64; 3],
}

/// Defects, as they are found: inputs come with the simplest first.
struct Search {
    property: Property,
    tried: usize,
    worst: Option<Case>,
    failing: Vec<Case>,
}

impl Search {
    fn new(property: Property) -> Self {
        Self { property, tried: 0, worst: None, failing: Vec::new() }
    }

    fn see(&mut self, fails: bool, case: Case) {
        self.tried += 1;
        if self.worst.as_ref().is_none_or(|worst| case.size > worst.size) {
            self.worst = Some(case.clone());
        }
        if fails {
            self.failing.push(case);
        }
    }

    fn verdict(self) -> Verdict {
        let Self { property, tried, worst, failing } = self;
        if tried == 0 {
            return Verdict::not_checked(property, "no sample says anything about it");
        }
        let mut verdict = Verdict::new(property, if failing.is_empty() { Outcome::Holds } else { Outcome::Fails });
        // A defect that the rounding of an input explains may be larger than one that fails.
        let largest = failing.iter().max_by(|a, b| a.size.total_cmp(&b.size)).cloned();
        verdict.worst = largest.or(worst);
        verdict.size = verdict.worst.as_ref().map_or(0.0, |case| case.size);
        verdict.simplest = failing.into_iter().find(|case| case.size >= 0.1 * verdict.size);
        verdict.tried = tried;
        verdict
    }
}

/// The last number before 1.
fn last(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 1.0 - f64::from(f32::EPSILON) / 2.0,
        Precision::Double => 1.0 - f64::EPSILON / 2.0,
    }
}

/// Numbers for `u`: plain ones, the ends, subnormal ones, the smallest normal one.
fn ends(precision: Precision) -> [f64; 8] {
    let (subnormal, normal, last) = match precision {
        Precision::Single => (f64::from(f32::from_bits(1)), f64::from(f32::MIN_POSITIVE), last(precision)),
        Precision::Double => (f64::from_bits(1), f64::MIN_POSITIVE, last(precision)),
    };
    [0.5, 0.25, 0.75, 0.0, last, subnormal, normal, 1e-7]
}

/// All combinations of these, and random ones.
fn inputs(precision: Precision, seed: u64, random: usize) -> Vec<[f64; 3]> {
    let ends = ends(precision).map(|x| precision.round(x));
    let crossed = (0..512_usize).map(|i| [i / 64, i / 8, i].map(|digit| ends[digit % 8]));
    let mut generator = Random::new(seed, SINGLE);
    crossed.chain((0..random).map(|_| generator.point(precision))).collect()
}

/// The verdicts of the properties that single samples show.
pub(crate) fn verdicts(at: At<'_>, seed: u64, random: usize) -> Vec<Verdict> {
    let inputs = inputs(at.sampler.precision(), seed, random);
    vec![at.finite(&inputs), at.below_horizon(), at.nan(), at.density(&inputs), at.weight(&inputs)]
}

impl<'a> At<'a> {
    fn case(&self, size: f64) -> Case {
        Case::new(self.v, self.sampler.precision(), size)
    }

    fn view(self, v: [f64; 3]) -> Self {
        Self { v: v.map(|x| self.sampler.precision().round(x)), ..self }
    }

    /// The view itself, and one with the smallest cosine that is claimed.
    fn finite(&self, inputs: &[[f64; 3]]) -> Verdict {
        let mut search = Search::new(Property::Finite);
        let [x, y, z] = self.v;
        let r = libm::sqrt(x * x + y * y);
        let (x, y) = if r > 0.0 { (x / r, y / r) } else { (1.0, 0.0) };
        let cos = self.claims.grazing.min(z);
        let sin = libm::sqrt((1.0 - cos) * (1.0 + cos));
        for at in [*self, self.view([x * sin, y * sin, cos])] {
            for u in inputs {
                at.finite_at(&mut search, *u);
            }
        }
        search.verdict()
    }

    fn finite_at(&self, search: &mut Search, u: [f64; 3]) {
        let (l, weight, pdf) = match self.sampler.sample(self.v, u) {
            Drawn::Rejected => return search.see(false, self.case(0.0).of(u, None)),
            Drawn::Delta { l, weight } => (l, weight, 0.0),
            Drawn::Scattered { l, weight, pdf } => (l, weight, pdf),
        };
        let (l, weight): ([f64; 3], [f64; 3]) = (l.into(), weight.into());
        let [_, _, z] = l;
        let length2: f64 = l.iter().map(|x| x * x).sum();
        let unit = match self.sampler.precision() {
            Precision::Single => 1e-5,
            Precision::Double => 1e-12,
        };
        let good = |x: f64| x.is_finite() && x >= 0.0;
        let (first, second, third) = ((length2 - 1.0).abs() <= unit, good(z), good(pdf));
        let bad =
            [first, second, third].iter().filter(|good| !**good).count() + weight.iter().filter(|x| !good(**x)).count();
        if bad == 0 {
            return search.see(false, self.case(0.0).of(u, None));
        }
        let [r, g, b] = weight;
        let case = self.case(bad as f64).of(u, Some(l)).with("|l|²", length2).with("pdf", pdf);
        search.see(true, case.with("weight", r).with("g", g).with("b", b));
    }

    fn below_horizon(&self) -> Verdict {
        if !self.claims.below_horizon {
            return Verdict::not_checked(Property::BelowHorizon, "not claimed");
        }
        let mut search = Search::new(Property::BelowHorizon);
        let [x, y, z] = self.v;
        let r = libm::sqrt(x * x + y * y);
        let level = if r > 0.0 { [x / r, y / r, 0.0] } else { [1.0, 0.0, 0.0] };
        for v in [level, [x, y, -z], [0.0, 0.0, -1.0]] {
            let at = self.view(v);
            for u in [[0.5; 3], [0.25, 0.75, 0.25], [0.0; 3], [last(self.sampler.precision()); 3]] {
                let rejected = self.sampler.sample(at.v, u) == Drawn::Rejected;
                search.see(!rejected, at.case(f64::from(u8::from(!rejected))).of(u, None));
            }
        }
        for l in [[0.6, 0.0, -0.8], [-x, -y, -z], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]] {
            let l = l.map(|x| self.sampler.precision().round(x));
            let pdf = self.sampler.pdf(l, self.v);
            let mut case = self.case(f64::from(u8::from(pdf != 0.0))).with("pdf(l, v)", pdf);
            case.l = Some(l);
            search.see(pdf != 0.0, case);
        }
        search.verdict()
    }

    fn nan(&self) -> Verdict {
        if !self.claims.nan {
            return Verdict::not_checked(Property::Nan, "not claimed");
        }
        let mut search = Search::new(Property::Nan);
        let plain = [0.375, 0.625, 0.3125];
        let put = |d: [f64; 3], index: usize, x: f64| {
            let mut put = d;
            if let Some(slot) = put.get_mut(index) {
                *slot = x;
            }
            put
        };
        for index in 0..3 {
            let at = Self { v: put(self.v, index, f64::NAN), ..*self };
            at.nan_at(&mut search, plain);
            // A component that decides nothing may be anything.
            let before = self.sampler.sample(self.v, plain);
            let matters =
                [0.0, 0.125, 0.9375].iter().any(|x| self.sampler.sample(self.v, put(plain, index, *x)) != before);
            if matters {
                self.nan_at(&mut search, put(plain, index, f64::NAN));
            }
        }
        search.verdict()
    }

    fn nan_at(&self, search: &mut Search, u: [f64; 3]) {
        let weight = match self.sampler.sample(self.v, u) {
            // A rejected sample is a weight of 0.
            Drawn::Rejected => [0.0; 3],
            Drawn::Scattered { weight, .. } | Drawn::Delta { weight, .. } => weight.into(),
        };
        let hidden = weight.iter().filter(|x| !x.is_nan()).count();
        let [r, ..] = weight;
        search.see(hidden > 0, self.case(hidden as f64).of(u, None).with("weight", r));
    }

    /// How much a function of `l` changes, relatively, when `l` moves by all roundings: the most over six neighbours.
    /// Not one ulp times their number, which the function itself may round away. At an edge, where a neighbour is 0, it
    /// is all of it.
    fn conditioned(&self, l: [f64; 3], f: &dyn Fn([f64; 3]) -> f64) -> f64 {
        let moved = ROUNDINGS * self.sampler.precision().ulp(1.0);
        let value = f(l);
        let change = |axis: usize, step: f64| {
            let mut near = l;
            if let Some(x) = near.get_mut(axis) {
                // A component next to 0 is rounded by much less.
                *x += step * x.abs().max(1e-2);
            }
            difference(f(near), value)
        };
        let changes = (0..3).flat_map(|axis| [change(axis, moved), change(axis, -moved)]);
        changes.filter(|x| x.is_finite()).fold(0.0, f64::max)
    }

    /// The density of the sample against that of the function, and of the pair of value and density.
    fn density(&self, inputs: &[[f64; 3]]) -> Verdict {
        let mut search = Search::new(Property::Density);
        let allowed = self.claims.pdf_error(self.sampler.precision());
        for u in inputs {
            let Drawn::Scattered { l, pdf: sampled, .. } = self.sampler.sample(self.v, *u) else { continue };
            let l = l.into();
            let pdf = self.sampler.pdf(l, self.v);
            let paired = self.sampler.eval_cos_pdf(l, self.v).map_or(pdf, |(_, pdf)| pdf);
            let size = difference(sampled, pdf).max(difference(paired, pdf));
            let fails = size.is_nan()
                || size > allowed && size > allowed + self.conditioned(l, &|l| self.sampler.pdf(l, self.v));
            let case = self.case(nan_is_all(size)).of(*u, Some(l)).with("pdf of the sample", sampled);
            search.see(fails, case.with("pdf(l, v)", pdf).with("pdf beside the value", paired));
        }
        search.verdict()
    }

    /// The weight of the sample against the quotient of value and density, the worst channel.
    fn weight(&self, inputs: &[[f64; 3]]) -> Verdict {
        let mut search = Search::new(Property::Weight);
        let allowed = self.claims.weight_error(self.sampler.precision());
        for u in inputs {
            let Drawn::Scattered { l, weight, .. } = self.sampler.sample(self.v, *u) else { continue };
            let l = l.into();
            let Some((value, pdf)) = self.sampler.eval_cos_pdf(l, self.v) else {
                return Verdict::not_checked(Property::Weight, "the sampler gives no value of the lobe");
            };
            // On the horizon itself both are 0, and there is no quotient.
            if pdf == 0.0 && value == [0.0; 3] {
                continue;
            }
            let weight: [f64; 3] = weight.into();
            for (channel, (weight, value)) in weight.into_iter().zip(value).enumerate() {
                let quotient = value / pdf;
                let size = difference(weight, quotient);
                let of = |l: [f64; 3]| {
                    let (value, pdf) = self.sampler.eval_cos_pdf(l, self.v).unwrap_or(([0.0; 3], 1.0));
                    value.get(channel).copied().unwrap_or_default() / pdf
                };
                let fails = size.is_nan() || size > allowed && size > allowed + self.conditioned(l, &of);
                let case = self.case(nan_is_all(size)).of(*u, Some(l)).with("weight", weight);
                search.see(fails, case.with("f cos/pdf", quotient));
            }
        }
        search.verdict()
    }
}

/// Ulps of 1. A sample's own vectors, before they become `l`, are rounded a few times, and so is what a value and a
/// density are computed from: at a right angle to the axis of a Lafortune lobe the cosine of a value is off by 11 half
/// ulps (its bound in the catalogue), that of a density, from the distance to an axis of unit length, by about as many,
/// and an ulp of the component that changes it most may change it by no more than half of one.
const ROUNDINGS: f64 = 24.0;

/// The difference relative to the larger; of numbers that `f32` can hardly tell from 0 there is none.
fn difference(a: f64, b: f64) -> f64 {
    let most = a.abs().max(b.abs());
    if a.is_nan() || b.is_nan() {
        return f64::NAN;
    }
    if a == b || most < 1e-30 { 0.0 } else { (a - b).abs() / most }
}

/// A NaN is as far off as can be.
fn nan_is_all(size: f64) -> f64 {
    if size.is_nan() { f64::INFINITY } else { size }
}
