//! Samples, counted as they come.

use super::partition::{Bins, Partition, mean};
use super::random::{Random, Sobol};
use super::sampler::Sampler;
use lobe_sampling::Outcome;
use rayon::prelude::*;

/// So many samples are drawn from one stream. The streams do not depend on how many threads there are.
const CHUNK: usize = 1 << 12;
/// The first stream of each purpose: what shows the way, the shifts of the sequence, single inputs; from 16 on the
/// test.
const PILOT: u64 = 0;
const SHIFTS: u64 = 1;
pub(crate) const SINGLE: u64 = 2;
const TEST: u64 = 16;

/// Places of `count` samples that are not those of the test.
pub(crate) fn pilot(
    sampler: &dyn Sampler,
    v: [f64; 3],
    chart: super::partition::Chart,
    seed: u64,
    count: usize,
) -> Vec<[f64; 2]> {
    let mut random = Random::new(seed, PILOT);
    let place = |_| match sampler.sample(v, random.point(sampler.precision())) {
        Outcome::Scattered { l, .. } => chart.locate(l.into()),
        _ => None,
    };
    (0..count).filter_map(place).collect()
}

/// What samples are counted by.
pub(crate) struct Plan<'a> {
    pub(crate) sampler: &'a dyn Sampler,
    pub(crate) v: [f64; 3],
    pub(crate) partition: &'a Partition,
    pub(crate) bins: &'a Bins,
    /// Ascending coordinates along either axis.
    pub(crate) edges: &'a [Vec<f64>; 2],
    pub(crate) seed: u64,
}

/// The counts.
#[derive(Clone, Debug)]
pub(crate) struct Tally {
    pub(crate) count: u64,
    pub(crate) bins: Vec<u64>,
    pub(crate) rejected: u64,
    pub(crate) delta: u64,
    /// Samples that are no direction above the horizon, or whose weight is no finite number.
    pub(crate) lost: u64,
    /// How many are at or beyond each edge but not the next; the first entry is of those before all.
    pub(crate) between: [Vec<u64>; 2],
    /// The sum of the weights that have a density, and of all and their squares; mean of the channels.
    pub(crate) scattered: f64,
    pub(crate) all: f64,
    pub(crate) squares: f64,
    /// The largest weight.
    pub(crate) largest: f64,
}

impl Plan<'_> {
    /// Draws `count` samples, rounded up to whole chunks.
    pub(crate) fn draw(&self, count: usize) -> Tally {
        let chunks: Vec<Tally> =
            (0..count.div_ceil(CHUNK)).into_par_iter().map(|chunk| self.chunk(chunk as u64)).collect();
        let mut sum = self.empty();
        for chunk in &chunks {
            sum.add(chunk);
        }
        sum
    }

    fn empty(&self) -> Tally {
        Tally {
            count: 0,
            bins: vec![0; self.bins.bins.len()],
            rejected: 0,
            delta: 0,
            lost: 0,
            between: std::array::from_fn(|axis| vec![0; self.edges.get(axis).map_or(0, Vec::len) + 1]),
            scattered: 0.0,
            all: 0.0,
            squares: 0.0,
            largest: 0.0,
        }
    }

    fn chunk(&self, chunk: u64) -> Tally {
        let mut random = Random::new(self.seed, TEST + chunk);
        let mut tally = self.empty();
        tally.count = CHUNK as u64;
        for _ in 0..CHUNK {
            self.count(&mut tally, random.point(self.sampler.precision()));
        }
        tally
    }

    fn count(&self, tally: &mut Tally, u: [f64; 3]) {
        let (weight, scattered) = match self.sampler.sample(self.v, u) {
            Outcome::Rejected => {
                tally.rejected += 1;
                return;
            }
            Outcome::Delta { weight, .. } => {
                tally.delta += 1;
                (mean(weight.into()), 0.0)
            }
            Outcome::Scattered { l, weight, .. } => {
                let weight = mean(weight.into());
                let Some(place) = self.partition.chart.locate(l.into()).filter(|_| weight.is_finite()) else {
                    tally.lost += 1;
                    return;
                };
                if let Some(count) = self.bins.find(place).and_then(|bin| tally.bins.get_mut(bin)) {
                    *count += 1;
                }
                for ((edges, counts), x) in self.edges.iter().zip(&mut tally.between).zip(place) {
                    if let Some(count) = counts.get_mut(edges.partition_point(|edge| *edge <= x)) {
                        *count += 1;
                    }
                }
                (weight, weight)
            }
        };
        tally.scattered += scattered;
        tally.all += weight;
        tally.squares += weight * weight;
        tally.largest = tally.largest.max(weight);
    }
}

impl Tally {
    fn add(&mut self, other: &Self) {
        let counts = |a: &mut Vec<u64>, b: &Vec<u64>| a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
        self.count += other.count;
        counts(&mut self.bins, &other.bins);
        self.rejected += other.rejected;
        self.delta += other.delta;
        self.lost += other.lost;
        for (a, b) in self.between.iter_mut().zip(&other.between) {
            counts(a, b);
        }
        self.scattered += other.scattered;
        self.all += other.all;
        self.squares += other.squares;
        self.largest = self.largest.max(other.largest);
    }
}

/// Means over a low-discrepancy sequence, with a standard error from how those with different shifts differ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Even {
    /// The weight of samples with a density, per channel.
    pub(crate) weight: [(f64, f64); 3],
    /// The part of the samples that is rejected, goes into deltas or is lost.
    pub(crate) missing: (f64, f64),
    pub(crate) count: usize,
}

const SHIFTED: usize = 16;

/// [`SHIFTED`] times `each` samples.
pub(crate) fn even(sampler: &dyn Sampler, v: [f64; 3], seed: u64, each: usize) -> Even {
    let mut random = Random::new(seed, SHIFTS);
    let sequences: Vec<Sobol> = (0..SHIFTED).map(|_| Sobol::new(&mut random)).collect();
    let means: Vec<[f64; 4]> = sequences
        .par_iter()
        .map(|sequence| {
            let mut sums = [0.0; 4];
            for u in sequence.points(sampler.precision()).take(each) {
                let [r, g, b, missing] = &mut sums;
                match sampler.sample(v, u) {
                    Outcome::Scattered { weight, .. } => {
                        *r += weight.r;
                        *g += weight.g;
                        *b += weight.b;
                    }
                    _ => *missing += 1.0,
                }
            }
            sums.map(|sum| sum / each as f64)
        })
        .collect();
    let of = |axis: usize| {
        let values = means.iter().map(|mean| mean.get(axis).copied().unwrap_or_default());
        let n = SHIFTED as f64;
        let mean = values.clone().sum::<f64>() / n;
        let variance = values.map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
        (mean, (variance / n).sqrt())
    };
    Even { weight: [of(0), of(1), of(2)], missing: of(3), count: SHIFTED * each }
}
