//! The hemisphere cut into cells whose masses are known: adaptive quadrature of a density, and the bins of a test of
//! fit.
//!
//! Coordinates are `(a, s)` of the unit square: `cos θ = 1 − a²`, so that areas near the pole shrink like those of a
//! disc, and `s` the azimuth from the viewer in turns, so that the mirror direction has `s = 1/2` and a lobe around it
//! lies along the axes, at grazing views too. Then `dω = 4π a da ds`. A cell is halved where the quadrature is not yet
//! sure, or where samples crowd: a lobe of width 1e-4 is found by some twenty halvings, wherever it is.

use super::sampler::Sampler;
use crate::subject::Precision;
use std::collections::BinaryHeap;
use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

/// The map between the square and the hemisphere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chart {
    /// The azimuth of the viewer, in turns.
    turn: f64,
}

impl Chart {
    pub(crate) fn new([x, y, _]: [f64; 3]) -> Self {
        Self { turn: libm::atan2(y, x) / TAU }
    }

    /// `sin θ` and `cos θ`.
    fn height(a: f64) -> (f64, f64) {
        let z = (1.0 - a) * (1.0 + a);
        (a * libm::sqrt(1.0 + z), z)
    }

    /// `cos φ` and `sin φ`.
    fn side(&self, s: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(TAU * (s + self.turn));
        [cos, sin]
    }

    pub(crate) fn direction(&self, [a, s]: [f64; 2]) -> [f64; 3] {
        let ((r, z), [cos, sin]) = (Self::height(a), self.side(s));
        [r * cos, r * sin, z]
    }

    /// `None` below the horizon, and of what is no direction.
    pub(crate) fn locate(&self, [x, y, z]: [f64; 3]) -> Option<[f64; 2]> {
        let r2 = x * x + y * y;
        // From what has digits left: the cosine near the horizon, the sine near the pole.
        let a2 = if z > 0.5 { r2 / (1.0 + z) } else { 1.0 - z };
        let turn = libm::atan2(y, x) / TAU - self.turn;
        let s = turn - turn.floor();
        // Also false for NaN.
        let inside = z >= 0.0 && a2 >= 0.0 && s >= 0.0;
        inside.then(|| [libm::sqrt(a2).min(1.0), s.min(1.0)])
    }
}

/// What is integrated over a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sums {
    /// `∫ pdf dω`.
    pub(crate) pdf: f64,
    /// `∫ f_r cos dω` per channel.
    pub(crate) value: [f64; 3],
    /// The second moment of the weight, `∫ f²/pdf dω`, of the mean of the channels.
    pub(crate) second: f64,
    /// The third, `∫ f³/pdf² dω`.
    pub(crate) third: f64,
    /// `∫ f dω` where the density is 0: no sample ever brings it.
    pub(crate) uncovered: f64,
}

impl Sums {
    fn add(&mut self, other: &Self, weight: f64) {
        self.pdf += weight * other.pdf;
        for (sum, x) in self.value.iter_mut().zip(other.value) {
            *sum += weight * x;
        }
        self.second += weight * other.second;
        self.third += weight * other.third;
        self.uncovered += weight * other.uncovered;
    }

    /// The mean of the channels.
    pub(crate) fn mean_value(&self) -> f64 {
        mean(self.value)
    }
}

pub(crate) fn mean([r, g, b]: [f64; 3]) -> f64 {
    (r + g + b) / 3.0
}

/// The nodes of the rule of Gauss and Kronrod with three and seven points (Piessens et al., "QUADPACK", 1983), with the
/// weights of the seven and of the three.
const RULE: [(f64, f64, f64); 7] = [
    (-0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
    (-0.774_596_669_241_483_4, 0.268_488_089_868_333_44, 5.0 / 9.0),
    (-0.434_243_749_346_802_55, 0.401_397_414_775_962_22, 0.0),
    (0.0, 0.450_916_538_658_474_14, 8.0 / 9.0),
    (0.434_243_749_346_802_55, 0.401_397_414_775_962_22, 0.0),
    (0.774_596_669_241_483_4, 0.268_488_089_868_333_44, 5.0 / 9.0),
    (0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
];
/// Legendre coefficients that are kept of a cell's density along either axis.
const TERMS: usize = 6;

/// The quadrature of one cell.
#[derive(Clone, Copy, Debug)]
struct Rule {
    sums: Sums,
    /// The estimated error of the density, and of the mean value, along the axes.
    pdf_error: [f64; 2],
    value_error: [f64; 2],
    /// The density of the mass along either axis, in Legendre polynomials on `[−1, 1]`.
    along: [[f64; TERMS]; 2],
}

impl Rule {
    fn error(&self) -> f64 {
        (self.pdf_error.iter().sum::<f64>()).max(self.value_error.iter().sum())
    }

    /// The axis to halve.
    fn axis(&self, depth: usize) -> usize {
        let [a, s] = std::array::from_fn(|i| {
            let at = |errors: &[f64; 2]| errors.get(i).copied().unwrap_or_default();
            at(&self.pdf_error).max(at(&self.value_error))
        });
        if a == s { depth % 2 } else { usize::from(s > a) }
    }

    /// The axis along which the mass is least even.
    fn uneven_axis(&self, depth: usize) -> usize {
        let [a, s] = self.along.map(|terms| terms.iter().skip(1).map(|c| c.abs()).sum::<f64>());
        let even = 0.1 * self.sums.pdf;
        if a < even && s < even { depth % 2 } else { usize::from(s > a) }
    }
}

#[derive(Clone, Copy, Debug)]
struct Cell {
    low: [f64; 2],
    high: [f64; 2],
    depth: usize,
    /// How many halvings before this one did not make the error smaller.
    stubborn: usize,
    split: Option<Split>,
    rule: Option<Rule>,
}

impl Cell {
    /// Whether its error is noise: no smaller after three halvings.
    fn noisy(&self) -> bool {
        self.stubborn >= 3
    }
}

/// Errors of cells, added: those of a smooth function as they are, noise as what is independent, twice its standard
/// deviation.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    smooth: f64,
    squares: f64,
}

impl Errors {
    fn add(&mut self, errors: [f64; 2], cell: &Cell) {
        let error: f64 = errors.iter().sum();
        if cell.noisy() { self.squares += error * error } else { self.smooth += error }
    }

    fn sum(self) -> f64 {
        self.smooth + 2.0 * self.squares.sqrt()
    }
}

/// The two halves stand one after the other.
#[derive(Clone, Copy, Debug)]
struct Split {
    axis: usize,
    at: f64,
    first: usize,
}

/// Those whose place is below a split, and the others.
fn divided<T>(all: &mut [T], split: Split, place: impl Fn(&T) -> [f64; 2]) -> (&mut [T], &mut [T]) {
    let below = |one: &T| *low_of(&place(one), split.axis) < split.at;
    all.sort_unstable_by_key(|one| !below(one));
    let count = all.iter().take_while(|one| below(one)).count();
    all.split_at_mut(count)
}

/// A place with its density.
#[derive(Clone, Copy, Debug)]
struct Witness {
    place: [f64; 2],
    pdf: f64,
}

impl Witness {
    fn new(density: &Density<'_>, chart: &Chart, place: [f64; 2]) -> Self {
        Self { place, pdf: density.sampler.pdf(chart.direction(place), density.v) }
    }
}

/// How often both reasons to halve a cell take turns.
const ROUNDS: usize = 4;
/// Cells are not halved beyond this: a sampler that gives but one direction would have no end.
const DEEPEST: usize = 90;
/// So many of the samples that show the way may fall into one cell before it is halved, or a 256th of them.
const CROWD: usize = 16;

/// A cut of the hemisphere.
#[derive(Clone, Debug)]
pub(crate) struct Partition {
    pub(crate) chart: Chart,
    cells: Vec<Cell>,
    /// Where the density or the value is no finite number or negative, and what it is there.
    pub(crate) bad: Option<([f64; 3], f64)>,
}

/// A density to be integrated.
pub(crate) struct Density<'a> {
    pub(crate) sampler: &'a dyn Sampler,
    pub(crate) v: [f64; 3],
}

impl Partition {
    /// Halves cells until the errors of all sum up to `tolerance`, or there are `most` cells. `pilot` are places of
    /// samples: they show the way, and where they are nothing must be missed.
    pub(crate) fn new(density: &Density<'_>, pilot: &mut [[f64; 2]], tolerance: f64, most: usize) -> Self {
        let root = Cell { low: [0.0; 2], high: [1.0; 2], depth: 0, stubborn: 0, split: None, rule: None };
        let mut this = Self { chart: Chart::new(density.v), cells: vec![root], bad: None };
        this.follow(0, pilot, CROWD.max(pilot.len() / 256));
        for index in 0..this.cells.len() {
            this.measure(density, index);
        }
        // A cell that is left as it is holds less than a tenth of one of them.
        let least = 0.1 / pilot.len().max(1) as f64;
        let mut witnesses: Vec<_> = pilot.iter().map(|place| Witness::new(density, &this.chart, *place)).collect();
        // What is halved for one reason may need it for the other.
        for _ in 0..ROUNDS {
            this.refine(density, tolerance, most);
            let before = this.cells.len();
            this.attend(density, 0, &mut witnesses, least, 2 * most);
            if this.cells.len() == before {
                break;
            }
        }
        this
    }

    /// Halves a cell until none of these places has a density far above that of the nodes around it: a ridge between
    /// them, or the strip between a step and the border of the cell, of which the difference of two rules says nothing
    /// (tests `a_ridge_between_the_nodes_is_found`, `a_step_beside_the_border_of_a_cell_is_found`). What is left out of
    /// a cell is less than `least` of the mass.
    fn attend(&mut self, density: &Density<'_>, index: usize, witnesses: &mut [Witness], least: f64, most: usize) {
        let Some(&Cell { low, high, depth, split, rule, .. }) = self.cells.get(index) else { return };
        let split = match (split, rule) {
            _ if witnesses.is_empty() => return,
            (Some(split), _) => split,
            (None, Some(rule)) => {
                let full = depth >= DEEPEST || self.cells.len() >= most;
                if full || !self.misses(density, [low, high], rule.sums.pdf, witnesses, least) {
                    return;
                }
                let split = self.halve(index, depth % 2);
                for half in [split.first, split.first + 1] {
                    self.measure(density, half);
                }
                split
            }
            (None, None) => return,
        };
        let (first, second) = divided(witnesses, split, |witness| witness.place);
        self.attend(density, split.first, first, least, most);
        self.attend(density, split.first + 1, second, least, most);
    }

    /// Whether the nodes around one of these places have a density far below the one there, and the cell is worth it.
    fn misses(
        &self,
        density: &Density<'_>,
        [[a0, s0], [a1, s1]]: [[f64; 2]; 2],
        mass: f64,
        witnesses: &[Witness],
        least: f64,
    ) -> bool {
        let area = TAU * (a1 - a0) * (a1 + a0) * (s1 - s0);
        // No more than the mean is no ridge, and next to nothing is not worth it.
        let suspects = witnesses.iter().filter(|witness| witness.pdf * area > mass.max(least));
        if suspects.clone().next().is_none() {
            return false;
        }
        let at = |place| density.sampler.pdf(self.chart.direction(place), density.v);
        let node = |from: f64, to: f64, i: usize| {
            0.5 * (from + to) + 0.5 * (to - from) * RULE.get(i).map_or(0.0, |(x, ..)| *x)
        };
        let nodes: [[f64; 7]; 7] =
            std::array::from_fn(|i| std::array::from_fn(|j| at([node(a0, a1, i), node(s0, s1, j)])));
        // The node before a coordinate and the one after it, at the ends the same twice.
        let around = |from: f64, to: f64, x: f64| {
            let after = (0..7).filter(|i| node(from, to, *i) <= x).count();
            after.saturating_sub(1)..=after.min(6)
        };
        suspects.into_iter().any(|Witness { place: [a, s], pdf }| {
            let columns = nodes.get(around(a0, a1, *a)).into_iter().flatten();
            let near = columns.flat_map(|column| column.get(around(s0, s1, *s)).into_iter().flatten());
            *pdf > 4.0 * near.fold(0.0, |most: f64, x| most.max(*x))
        })
    }

    /// Halves a cell until no more than a few samples are in each.
    fn follow(&mut self, index: usize, points: &mut [[f64; 2]], crowd: usize) {
        let Some(&Cell { low, high, depth, .. }) = self.cells.get(index) else { return };
        if points.len() <= crowd || depth >= DEEPEST {
            return;
        }
        // Along which axis they crowd most.
        let spread: [f64; 2] = std::array::from_fn(|i| {
            let at = |p: &[f64; 2]| p.get(i).copied().unwrap_or_default();
            let least = points.iter().map(at).fold(f64::INFINITY, f64::min);
            let most = points.iter().map(at).fold(0.0, f64::max);
            (most - least) / (at(&high) - at(&low))
        });
        let [a, s] = spread;
        let axis = if a.min(s) > 0.5 || a == s { depth % 2 } else { usize::from(s < a) };
        let split = self.halve(index, axis);
        let (first, second) = divided(points, split, |place| *place);
        self.follow(split.first, first, crowd);
        self.follow(split.first + 1, second, crowd);
    }

    fn halve(&mut self, index: usize, axis: usize) -> Split {
        let first = self.cells.len();
        let mut split = Split { axis, at: 0.5, first };
        if let Some(cell) = self.cells.get_mut(index) {
            let [mut lower, mut upper] = [*cell; 2];
            for half in [&mut lower, &mut upper] {
                half.depth += 1;
                half.rule = None;
            }
            if let (Some(high), Some(low)) = (lower.high.get_mut(axis), upper.low.get_mut(axis)) {
                split.at = 0.5 * (*high + *low_of(&cell.low, axis));
                *high = split.at;
                *low = split.at;
            }
            cell.split = Some(split);
            self.cells.extend([lower, upper]);
        }
        split
    }

    /// The quadrature of a cell, if it is a leaf; its error.
    fn measure(&mut self, density: &Density<'_>, index: usize) -> f64 {
        let Some(cell) = self.cells.get(index).filter(|cell| cell.split.is_none()) else { return 0.0 };
        let rule = integrate(density, &self.chart, cell.low, cell.high, &mut self.bad);
        if let Some(cell) = self.cells.get_mut(index) {
            cell.rule = Some(rule);
        }
        rule.error()
    }

    fn refine(&mut self, density: &Density<'_>, tolerance: f64, most: usize) {
        // The directions of `f32` are so coarse that a sharp lobe is rough from one to the next, and finer cells are no
        // smoother.
        let rounded = density.sampler.precision() == Precision::Single;
        // Errors are not negative, so that their bits have their order.
        let mut queue: BinaryHeap<(u64, usize)> = BinaryHeap::new();
        let mut total = 0.0;
        for (index, rule, _) in self.leaves() {
            total += rule.error();
            queue.push((rule.error().to_bits(), index));
        }
        while total > tolerance && self.cells.len() < most {
            let Some((error, index)) = queue.pop() else { break };
            total -= f64::from_bits(error);
            let Some((rule, depth)) = self.rule(index).filter(|(_, depth)| *depth < DEEPEST) else { continue };
            let split = self.halve(index, rule.axis(depth));
            let halves = [split.first, split.first + 1];
            let errors = halves.map(|half| self.measure(density, half));
            let stubborn = rounded && errors.iter().sum::<f64>() > 0.7 * f64::from_bits(error);
            for (half, error) in halves.into_iter().zip(errors) {
                let cell = self.cells.get_mut(half);
                let noisy = cell.is_some_and(|cell| {
                    cell.stubborn = if stubborn { cell.stubborn + 1 } else { 0 };
                    cell.noisy()
                });
                if !noisy {
                    total += error;
                    queue.push((error.to_bits(), half));
                }
            }
        }
    }

    /// Halves cells until none holds more than `limit` of the density.
    fn thin(&mut self, density: &Density<'_>, limit: f64) {
        let mut todo: Vec<usize> = self.leaves().into_iter().map(|(index, ..)| index).collect();
        while let Some(index) = todo.pop() {
            let Some((rule, depth)) = self.rule(index) else { continue };
            if rule.sums.pdf <= limit || depth >= DEEPEST {
                continue;
            }
            let split = self.halve(index, rule.uneven_axis(depth));
            for half in [split.first, split.first + 1] {
                self.measure(density, half);
                todo.push(half);
            }
        }
    }

    fn rule(&self, index: usize) -> Option<(Rule, usize)> {
        let cell = self.cells.get(index)?;
        Some((cell.rule?, cell.depth))
    }

    /// The leaves in the order of the tree, in which neighbours mostly are near each other.
    fn leaves(&self) -> Vec<(usize, Rule, Cell)> {
        let mut leaves = Vec::new();
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let Some(cell) = self.cells.get(index) else { continue };
            match (cell.split, cell.rule) {
                (Some(split), _) => stack.extend([split.first + 1, split.first]),
                (None, Some(rule)) => leaves.push((index, rule, *cell)),
                (None, None) => {}
            }
        }
        leaves
    }

    /// The integrals over the hemisphere, and the estimated error of the density and of the mean value.
    pub(crate) fn total(&self) -> (Sums, f64, f64) {
        let (mut sums, mut of_pdf, mut of_value) = (Sums::default(), Errors::default(), Errors::default());
        for (_, rule, cell) in self.leaves() {
            sums.add(&rule.sums, 1.0);
            of_pdf.add(rule.pdf_error, &cell);
            of_value.add(rule.value_error, &cell);
        }
        (sums, of_pdf.sum(), of_value.sum())
    }

    /// About `count` bins of equal mass: runs of small leaves.
    pub(crate) fn bins(&mut self, density: &Density<'_>, count: usize) -> Bins {
        let (total, ..) = self.total();
        let target = total.pdf / count as f64;
        if target > 0.0 {
            self.thin(density, 0.25 * target);
        }
        let mut bins = Vec::new();
        let mut of_cell = vec![0; self.cells.len()];
        let (mut open, mut errors): (Option<Bin>, _) = (None, Errors::default());
        for (index, rule, cell) in self.leaves() {
            let bin = open.get_or_insert(Bin { mass: 0.0, error: 0.0, low: [1.0; 2], high: [0.0; 2] });
            bin.mass += rule.sums.pdf;
            errors.add(rule.pdf_error, &cell);
            bin.error = errors.sum();
            for (side, x) in bin.low.iter_mut().zip(cell.low) {
                *side = side.min(x);
            }
            for (side, x) in bin.high.iter_mut().zip(cell.high) {
                *side = side.max(x);
            }
            if let Some(slot) = of_cell.get_mut(index) {
                *slot = bins.len();
            }
            // The last leaves go with the bin before them if they are few.
            if bin.mass >= target {
                bins.extend(open.take());
                errors = Errors::default();
            }
        }
        bins.extend(open);
        Bins { bins, tree: self.pruned(of_cell) }
    }

    /// The splits that tell bins apart, from the bin of each leaf: of the whole tree, some tens of megabytes, most places
    /// are not in the cache, and four million samples spend most of their time there.
    fn pruned(&self, mut of_cell: Vec<usize>) -> Vec<Step> {
        let split_of = |index: usize| self.cells.get(index).and_then(|cell| cell.split);
        let mut apart = vec![false; self.cells.len()];
        // Halves stand behind what they are halves of.
        for index in (0..self.cells.len()).rev() {
            let Some(Split { first, .. }) = split_of(index) else { continue };
            let known = |half: usize| (apart.get(half).copied(), of_cell.get(half).copied());
            let (low, high) = (known(first), known(first + 1));
            let differ = low.0 == Some(true) || low != high;
            if let (Some(apart), Some(slot), Some(bin)) = (apart.get_mut(index), of_cell.get_mut(index), low.1) {
                (*apart, *slot) = (differ, bin);
            }
        }
        let step = |index: usize| match split_of(index).filter(|_| apart.get(index) == Some(&true)) {
            Some(split) => Step::Split(split),
            None => Step::Bin(of_cell.get(index).copied().unwrap_or_default()),
        };
        let mut tree = vec![step(0)];
        let mut at = 0;
        while let Some(&next) = tree.get(at) {
            if let Step::Split(split) = next {
                let first = tree.len();
                tree.extend([step(split.first), step(split.first + 1)]);
                if let Some(slot) = tree.get_mut(at) {
                    *slot = Step::Split(Split { first, ..split });
                }
            }
            at += 1;
        }
        tree
    }

    /// The mass below each of some ascending coordinates along an axis.
    pub(crate) fn below(&self, axis: usize, edges: &[f64]) -> Vec<f64> {
        let mut masses = vec![0.0; edges.len()];
        let mut whole = vec![0.0; edges.len() + 1];
        for (_, rule, cell) in self.leaves() {
            let (low, high) = (*low_of(&cell.low, axis), *low_of(&cell.high, axis));
            let (first, last) = (edges.partition_point(|e| *e <= low), edges.partition_point(|e| *e < high));
            let cut = edges.iter().zip(&mut masses).take(last).skip(first);
            for (edge, mass) in cut {
                let x = 2.0 * (edge - low) / (high - low) - 1.0;
                *mass += rule.along.get(axis).map_or(0.0, |terms| cumulative(terms, x));
            }
            if let Some(mass) = whole.get_mut(last) {
                *mass += rule.sums.pdf;
            }
        }
        let mut sum = 0.0;
        for (mass, whole) in masses.iter_mut().zip(whole) {
            sum += whole;
            *mass += sum;
        }
        masses
    }
}

fn low_of(side: &[f64; 2], axis: usize) -> &f64 {
    let [a, s] = side;
    if axis == 0 { a } else { s }
}

/// `Pₖ(x)` for `k` up to [`TERMS`], by their recurrence.
fn legendre(x: f64) -> [f64; TERMS + 1] {
    let (mut before, mut now) = (0.0, 1.0);
    std::array::from_fn(|k| {
        let value = now;
        let k = k as f64;
        now = ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0);
        before = value;
        value
    })
}

/// The polynomials at the nodes of the rule.
static LEGENDRE: LazyLock<[[f64; TERMS + 1]; 7]> = LazyLock::new(|| RULE.map(|(x, ..)| legendre(x)));

/// `∫ Σ cₖ Pₖ` from −1 to `x`.
fn cumulative(terms: &[f64; TERMS], x: f64) -> f64 {
    let p = legendre(x);
    let at = |k: usize| p.get(k).copied().unwrap_or_default();
    let integral = |k: usize| if k == 0 { x + 1.0 } else { (at(k + 1) - at(k - 1)) / (2 * k + 1) as f64 };
    terms.iter().enumerate().map(|(k, c)| c * integral(k)).sum()
}

/// The estimate of QUADPACK: the difference of both rules to the power 1.5, in units of how much the function varies.
fn estimate(difference: f64, variation: f64) -> f64 {
    if variation > 0.0 && difference > 0.0 {
        let ratio = (200.0 * difference / variation).min(1.0);
        variation * ratio * ratio.sqrt()
    } else {
        difference
    }
}

fn integrate(
    density: &Density<'_>,
    chart: &Chart,
    low: [f64; 2],
    high: [f64; 2],
    bad: &mut Option<([f64; 3], f64)>,
) -> Rule {
    let ([a0, s0], [a1, s1]) = (low, high);
    let (half_a, half_s) = (0.5 * (a1 - a0), 0.5 * (s1 - s0));
    let (mid_a, mid_s) = (0.5 * (a0 + a1), 0.5 * (s0 + s1));
    let mut sums = Sums::default();
    // Of the density and of the mean value: the integral with the coarser rule along either axis, and the values.
    let mut coarse = [[0.0; 2]; 2];
    let mut values = [[0.0; 49]; 2];
    // The mass along either axis, at the nodes.
    let mut masses = [[0.0; 7]; 2];
    let columns = RULE.map(|(y, ..)| chart.side(mid_s + half_s * y));
    for (i, (x, wx, gx)) in RULE.into_iter().enumerate() {
        let a = mid_a + half_a * x;
        let (r, z) = Chart::height(a);
        let scale = 4.0 * PI * a * half_a * half_s;
        for (j, ((_, wy, gy), [cos, sin])) in RULE.into_iter().zip(columns).enumerate() {
            let at = point(density, [r * cos, r * sin, z], bad);
            sums.add(&at, wx * wy * scale);
            let both = [at.pdf, at.mean_value()].map(|value| value * scale);
            for ((coarse, values), value) in coarse.iter_mut().zip(&mut values).zip(both) {
                let [along_a, along_s] = coarse;
                *along_a += gx * wy * value;
                *along_s += wx * gy * value;
                values[7 * i + j] = value;
            }
            let mass = wx * wy * at.pdf * scale;
            masses[0][i] += mass;
            masses[1][j] += mass;
        }
    }
    let mut along = [[0.0; TERMS]; 2];
    for (terms, masses) in along.iter_mut().zip(masses) {
        for (mass, at_node) in masses.iter().zip(*LEGENDRE) {
            for (k, (term, p)) in terms.iter_mut().zip(at_node).enumerate() {
                *term += mass * p * (k as f64 + 0.5);
            }
        }
    }
    let fine = [sums.pdf, sums.mean_value()];
    // Of roughness the difference is the size, and how much the function varies has nothing to do with it.
    let rounded = density.sampler.precision() == Precision::Single;
    let mut errors = [[0.0; 2]; 2];
    for (((error, coarse), values), fine) in errors.iter_mut().zip(coarse).zip(&values).zip(fine) {
        let weights = RULE.iter().flat_map(|(_, wx, _)| RULE.iter().map(move |(_, wy, _)| wx * wy));
        let variation: f64 = weights.zip(values).map(|(w, value)| w * (value - 0.25 * fine).abs()).sum();
        *error = coarse.map(|coarse| {
            let difference = (coarse - fine).abs();
            if rounded { difference } else { estimate(difference, variation) }
        });
    }
    let [pdf_error, value_error] = errors;
    Rule { sums, pdf_error, value_error, along }
}

/// What is integrated, at a direction.
fn point(density: &Density<'_>, l: [f64; 3], bad: &mut Option<([f64; 3], f64)>) -> Sums {
    let mut known = |x: f64| {
        if x.is_finite() && x >= 0.0 {
            return x;
        }
        bad.get_or_insert((l, x));
        0.0
    };
    let pdf = known(density.sampler.pdf(l, density.v));
    let value = density.sampler.eval_cos_pdf(l, density.v).map_or([0.0; 3], |(value, _)| value.map(known));
    let f = mean(value);
    if pdf > 0.0 {
        let weight = f / pdf;
        Sums { pdf, value, second: weight * f, third: weight * weight * f, uncovered: 0.0 }
    } else {
        Sums { pdf, value, second: 0.0, third: 0.0, uncovered: f }
    }
}

/// Bins of a test of fit.
#[derive(Clone, Debug)]
pub(crate) struct Bins {
    pub(crate) bins: Vec<Bin>,
    tree: Vec<Step>,
}

/// Where a place is looked for next, or what it is in.
#[derive(Clone, Copy, Debug)]
enum Step {
    Split(Split),
    Bin(usize),
}

impl Bins {
    /// The bin that a place is in.
    pub(crate) fn find(&self, place: [f64; 2]) -> Option<usize> {
        let mut index = 0;
        loop {
            match self.tree.get(index)? {
                Step::Split(split) => {
                    let x = low_of(&place, split.axis);
                    index = split.first + usize::from(*x >= split.at);
                }
                Step::Bin(bin) => return Some(*bin),
            }
        }
    }
}

/// A bin: its mass, the error of that, and a box of `(a, s)` around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bin {
    pub(crate) mass: f64,
    pub(crate) error: f64,
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
}

#[cfg(test)]
mod tests {
    use super::super::sampler::OfFn;
    use super::*;
    use lobe_sampling::Outcome;
    use std::f64::consts::FRAC_1_PI;

    fn of(pdf: impl Fn([f64; 3], [f64; 3]) -> f64 + Sync) -> impl Sampler {
        OfFn::new(|_, _| Outcome::Rejected, pdf)
    }

    #[test]
    fn the_rule_is_exact_for_polynomials() {
        for degree in 0..=11 {
            let exact = if degree % 2 == 0 { 2.0 / f64::from(degree + 1) } else { 0.0 };
            let sum: f64 = RULE.iter().map(|(x, w, _)| w * x.powi(degree)).sum();
            assert!((sum - exact).abs() < 1e-14, "{degree}: {sum}");
            let sum: f64 = RULE.iter().map(|(x, _, g)| g * x.powi(degree)).sum();
            assert!(degree > 5 || (sum - exact).abs() < 1e-14, "{degree}: {sum}");
        }
    }

    #[test]
    fn places_come_back() {
        let chart = Chart::new([-0.3, 0.4, 0.7]);
        for place in [[1e-9, 0.1], [0.3, 0.5], [0.7, 0.99], [1.0 - 1e-9, 0.25], [1.0, 0.75]] {
            let [a, s] = chart.locate(chart.direction(place)).unwrap();
            assert!((a - place[0]).abs() < 1e-12 * place[0].max(1e-3) && (s - place[1]).abs() < 1e-9, "{place:?}");
        }
        assert_eq!(chart.locate([0.6, 0.0, -0.8]), None);
        assert_eq!(chart.locate([f64::NAN, 0.0, 0.8]), None);
        // The mirror direction.
        let [_, s] = chart.locate([0.3, -0.4, 0.7]).unwrap();
        assert!((s - 0.5).abs() < 1e-15);
    }

    #[test]
    fn masses_are_those_of_closed_forms() {
        let v = [0.6, 0.0, 0.8];
        let cosine = of(|l, _| l[2] * FRAC_1_PI);
        let density = Density { sampler: &cosine, v };
        let mut partition = Partition::new(&density, &mut [], 1e-7, 4000);
        assert!((partition.total().0.pdf - 1.0).abs() < 1e-9);
        // Below cos θ the cosine has 1 − cos².
        let edges = [0.1, 0.3, 0.5, 0.77, 1.0];
        for (mass, a) in partition.below(0, &edges).iter().zip(edges) {
            let cos = 1.0 - a * a;
            assert!((mass - (1.0 - cos * cos)).abs() < 1e-9, "{a}: {mass}");
        }
        for (mass, s) in partition.below(1, &edges).iter().zip(edges) {
            assert!((mass - s).abs() < 1e-9, "{s}: {mass}");
        }
        let bins = partition.bins(&density, 100);
        assert!((80..=100).contains(&bins.bins.len()), "{}", bins.bins.len());
        assert!((bins.bins.iter().map(|bin| bin.mass).sum::<f64>() - 1.0).abs() < 1e-9);
        let widest = bins.bins.iter().map(|bin| bin.mass).fold(0.0, f64::max);
        assert!(widest < 0.0126, "{widest}");
    }

    /// A Gaussian of width 1e-4, at a place that no rule would meet by chance.
    #[test]
    fn a_sharp_peak_is_found_where_samples_are() {
        let peak = {
            let chart = Chart::new([0.6, 0.0, 0.8]);
            chart.direction([0.612_345, 0.312_345])
        };
        let width = 1e-4;
        let sharp = of(move |l, _| {
            let d2: f64 = std::iter::zip(l, peak).map(|(a, b)| (a - b) * (a - b)).sum();
            libm::exp(-d2 / (width * width)) / (PI * width * width)
        });
        let density = Density { sampler: &sharp, v: [0.6, 0.0, 0.8] };
        let mut pilot = vec![[0.612_345, 0.312_345]; CROWD + 1];
        let partition = Partition::new(&density, &mut pilot, 1e-6, 4000);
        let (sums, error, _) = partition.total();
        assert!((sums.pdf - 1.0).abs() < 1e-6 && error < 1e-5, "{sums:?} ± {error:e}");
    }

    /// Places by the density: on the hemisphere evenly, taken where a number is below it.
    fn drawn(density: &Density<'_>, count: usize, most: f64) -> Vec<[f64; 2]> {
        let (mut random, chart) = (super::super::random::Random::new(7, 0), Chart::new(density.v));
        let draws = std::iter::repeat_with(|| {
            let [x, a, s] = random.point(Precision::Double);
            let place = [libm::sqrt(a), s];
            (x * most < density.sampler.pdf(chart.direction(place), density.v)).then_some(place)
        });
        draws.flatten().take(count).collect()
    }

    /// A lobe of slopes fifty times as wide one way as the other, of which a cell's nodes see no more than the middle.
    #[test]
    fn a_ridge_between_the_nodes_is_found() {
        let (x, y) = (0.5, 0.01);
        let ridge = of(move |l, _| {
            let (z2, t) = (l[2] * l[2], ((l[0] / x).powi(2) + (l[1] / y).powi(2)) / (l[2] * l[2]));
            if l[2] > 0.0 { libm::exp(-t) / (PI * x * y * z2 * l[2]) } else { 0.0 }
        });
        let density = Density { sampler: &ridge, v: [0.0, 0.0, 1.0] };
        let places = drawn(&density, 1 << 13, 1.0 / (PI * x * y));
        let missing = |count| {
            let mut pilot: Vec<_> = places.iter().take(count).copied().collect();
            let (sums, error, _) = Partition::new(&density, &mut pilot, 1e-5, 6000).total();
            assert!(error < 2e-5, "{error:e}");
            1.0 - sums.pdf
        };
        // Less than a few of the places, whatever they show by chance.
        let (with, without) = (missing(places.len()), missing(0));
        assert!(with.abs() < 5e-4 && without > 1e-2, "{with:e} {without:e}");
    }

    #[test]
    fn a_step_beside_the_border_of_a_cell_is_found() {
        // The hemisphere around a direction next to the horizon: its edge is next to s = 1/4 and 3/4.
        let v = [0.999_95_f64.sqrt(), 0.0, 0.01];
        let half = of(move |l, v| if v[2] * l[2] > v[0] * l[0] { 1.0 / TAU } else { 0.0 });
        let density = Density { sampler: &half, v };
        let exact = 0.5 + libm::asin(v[2] / v[0].hypot(v[2])) / PI;
        let places = drawn(&density, 1 << 13, 1.0 / TAU);
        let off = |count| {
            let mut pilot: Vec<_> = places.iter().take(count).copied().collect();
            let (sums, error, _) = Partition::new(&density, &mut pilot, 1e-5, 6000).total();
            ((sums.pdf - exact).abs(), error)
        };
        // The edge takes more cells than there are, and that is told; without witnesses it is not.
        let ((with, known), (without, unknown)) = (off(places.len()), off(0));
        assert!(with < known && with < 1e-3 && without > 1e-3 && unknown < 1e-4, "{with} {known} {without} {unknown}");
    }

    #[test]
    fn what_is_no_density_is_told() {
        let broken = of(|l, _| if l[2] > 0.5 { f64::NAN } else { 1.0 });
        let density = Density { sampler: &broken, v: [0.0, 0.0, 1.0] };
        let bad = Partition::new(&density, &mut [], 1e-3, 100).bad.unwrap();
        assert!(bad.0[2] > 0.5 && bad.1.is_nan());
    }
}
