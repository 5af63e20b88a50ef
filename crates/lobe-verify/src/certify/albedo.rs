//! The directional albedo `E(v) = ∫ f_r(l, v) cos θ_l dω_l`: an upper bound for every view and parameter of a box.
//!
//! The integral is taken over the angles of the light, `l = (sin πx cos πy, sin πx sin πy, cos πx)`, so that
//! `E = π² ∬ f_r cos θ_l sin πx dx dy`. The domain is cut into cells. On a cell with the centre `c` and for parameters
//! `p` around `p₀` the integrand is `g(c, p₀) + Σ ∂g/∂xᵢ (xᵢ − cᵢ) + Σ ∂g/∂pⱼ (pⱼ − p₀ⱼ)` with derivatives somewhere in
//! their [`Slopes`](super::Slopes). Integrated over the cell,
//!
//! - the first is its area times a thin interval;
//! - of the second, the middle of the slope drops out by symmetry, and its radius `ρ` leaves at most `ρ hᵢ/4` times the
//!   area, `hᵢ` being the width: second order in the size of the cell;
//! - of the third, the slopes of all cells are summed *before* they are multiplied with `pⱼ − p₀ⱼ`. What one cell gains
//!   when a lobe moves and another loses cancels; what is left bounds `∂E/∂pⱼ`.
//!
//! Where a slope is not known (a horizon, `√0`), the interval of the integrand itself is taken. The cell that leaves most
//! uncertainty is halved, until the bound is within the limit or it is seen that it will not be; then the box is halved.
//!
//! Nothing is assumed of the lobe but its [`Symmetry`]: no sampling density, no closed form, no identity of the model.

use super::number::{Number, in_plane};
use super::range::{variables, worst_axis};
use super::search::{Statement, Verdict, recheck, search, within};
use super::{Axis, Certificate, Effort, Family, Outcome, Recheck, Symmetry};
use crate::interval::Interval;
use lobe::{Brdf, Real, Vec3};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Proves that `E(v) ≤ limit` for every view of the axis and all parameters of the family.
///
/// `view` is the angle from the normal, in half turns: 0 is the normal, 0.5 the horizon. At the horizon itself most
/// lobes have no integral with a finite bound: end before it.
pub fn prove<F: Family>(family: &F, view: Axis, limit: f64, effort: &Effort) -> Outcome {
    let (name, axes, limits) = (name(family), axes(family, view), (f64::NEG_INFINITY, limit));
    search(&Statement { name: &name, axes: &axes, limits }, effort, |region| {
        judge(family, &axes, region, limits, effort)
    })
}

/// Computes the integral over every box of the proof again, by the cells that are written there, in one go.
pub fn check<F: Family>(family: &F, certificate: &Certificate) -> Recheck {
    let same = certificate.axes.first().is_some_and(|view| axes(family, view.clone()) == certificate.axes);
    if !same {
        return Recheck::Malformed(0);
    }
    let statement = Statement { name: &certificate.name, axes: &certificate.axes, limits: certificate.limits };
    recheck(&statement, &certificate.proof, |region, rest| again(family, region, rest))
}

/// What is bounded.
fn name<F: Family>(family: &F) -> String {
    format!("directional albedo of {}", family.name())
}

/// The axes of the view, and the parameters.
fn axes<F: Family>(family: &F, view: Axis) -> Vec<Axis> {
    let mut axes = vec![view];
    if family.symmetry() == Symmetry::None {
        axes.push(Axis::linear("azimuth", 0.0, 2.0));
    }
    axes.extend(family.parameters());
    axes
}

/// The width in half turns of the ring at the horizon that is bounded by itself. There the mask of the horizon cannot be
/// decided, and with it no slope of any cell that touches it.
const RING: f64 = 1.0 / (1u64 << 32) as f64;

/// Cells are not cut below this width: their middles must be exact in `f64`, or the middle of a slope does not drop out.
const LEAST_WIDTH: f64 = 1.0 / (1u64 << 18) as f64;

/// `f_r cos θ_l sin θ_l`, for light at the angle `πx₀` from the normal with the azimuth `πx₁`; then the view and the
/// parameters.
fn integrand<F: Family, R: Number>(family: &F, x: &[R]) -> R {
    let ((sin, cos), (sin_phi, cos_phi)) = (x[0].half_turns(), x[1].half_turns());
    let l = Vec3::new(sin * cos_phi, sin * sin_phi, cos);
    let (v, rest) = match family.symmetry() {
        Symmetry::Isotropic => (in_plane(x[2]), 3),
        Symmetry::None => {
            let (view, (sin_phi, cos_phi)) = (in_plane(x[2]), x[3].half_turns());
            (Vec3::new(view.x * cos_phi, view.x * sin_phi, view.z), 4)
        }
    };
    let lobe = family.lobe(sin.lift(1.0), &x[rest..]);
    family.channel(lobe.eval_cos(l, v)) * sin
}

/// A cell, and what is known of the integral over it.
#[derive(Clone, Debug)]
struct Cell {
    x: [Interval; 2],
    /// The part that does not depend on the parameters, as far as slopes say how it does.
    value: Interval,
    /// The slopes by view and parameters; 0 where `value` has their whole range.
    slopes: Vec<Interval>,
    /// The value at the centre, times the area, as `f64` computes it. It steers the search, and proves nothing.
    estimate: f64,
    /// How far the upper bound is above the estimate, and how much of that belongs to each axis of the region, where it is
    /// not in the slopes.
    error: f64,
    weights: Vec<f64>,
    /// The axis to halve it along.
    axis: usize,
}

/// The area of a cell, exactly: a side is a power of two.
fn area(x: [Interval; 2]) -> Interval {
    Interval::point((x[0].hi - x[0].lo) * (x[1].hi - x[1].lo))
}

impl Cell {
    fn new<F: Family, const N: usize>(family: &F, x: [Interval; 2], region: &[Interval]) -> Self {
        let all: Vec<_> = x.iter().chain(region).copied().collect();
        let area = area(x);
        let over = integrand(family, &variables::<N>(&all));
        let plain = over.value * area;
        let widest = usize::from(x[1].width() > 2.0 * x[0].width());
        let none = vec![Interval::ZERO; region.len()];
        if !plain.is_finite() {
            let weights = vec![0.0; region.len()];
            let (error, estimate) = (f64::INFINITY, 0.0);
            return Self { x, value: Interval::UNKNOWN, slopes: none, estimate, error, weights, axis: widest };
        }
        let middles: Vec<_> = all.iter().map(|x| x.middle()).collect();
        let estimate = integrand(family, &middles) * area.lo;
        let known: Vec<_> = (0..all.len()).map(|i| i < N && over.slope[i].is_finite()).collect();
        let centre: Vec<_> =
            all.iter().zip(&known).map(|(&x, &known)| if known { Interval::point(x.middle()) } else { x }).collect();
        let mut value = integrand(family, &centre) * area;
        let unknown = value.hi - estimate;
        // What halving an axis may gain: of a known slope its share, of an unknown one all there is.
        let mut gain = [unknown; 2];
        for i in 0..2 {
            if known[i] {
                let radius = 0.5 * over.slope[i].width();
                let added = (Interval::point(radius) * Interval::point(0.25 * x[i].width()) * area).hi;
                value = value + Interval::new(-added, added);
                gain[i] = added;
            }
        }
        let mut slopes = none.clone();
        let mut weights = vec![0.0; region.len()];
        let mut error = value.hi - estimate;
        for (j, part) in region.iter().enumerate() {
            let i = j + 2;
            if known[i] {
                slopes[j] = over.slope[i] * area;
                // The middle of the slope may cancel with that of other cells.
                error += 0.25 * slopes[j].width() * part.width();
            }
        }
        // At the centre of the cell only the axes of the region are left, whose slopes are not known.
        if known[2..].contains(&false) {
            let mut thin = centre.clone();
            thin[..2].copy_from_slice(&[Interval::point(middles[0]), Interval::point(middles[1])]);
            let left = f64::max((integrand(family, &thin) * area).hi - estimate, 0.0);
            weights.iter_mut().zip(&known[2..]).for_each(|(weight, known)| *weight = if *known { 0.0 } else { left });
        }
        let axis = match gain[0].total_cmp(&gain[1]) {
            Ordering::Greater => 0,
            Ordering::Less => 1,
            Ordering::Equal => widest,
        };
        if plain.hi - estimate < error {
            // What is left at the centre of the cell belongs to the region; of each axis by its slope.
            let mut thin = all.clone();
            thin[..2].copy_from_slice(&[Interval::point(middles[0]), Interval::point(middles[1])]);
            let left = f64::max((integrand(family, &thin) * area).hi - estimate, 0.0);
            for (j, weight) in weights.iter_mut().enumerate() {
                if known[j + 2] {
                    *weight = 0.5 * slopes[j].magnitude() * region[j].width();
                }
            }
            let sum: f64 = weights.iter().sum();
            let share = if sum > left { left / sum } else { 1.0 };
            weights.iter_mut().for_each(|weight| *weight *= share);
            let error = plain.hi - estimate;
            return Self { x, value: plain, slopes: none, estimate, error, weights, axis };
        }
        Self { x, value, slopes, estimate, error, weights, axis }
    }

    /// The halves across an axis.
    fn halves(x: [Interval; 2], axis: usize) -> [[Interval; 2]; 2] {
        let middle = x[axis].middle();
        let (mut lower, mut upper) = (x, x);
        lower[axis] = Interval::new(x[axis].lo, middle);
        upper[axis] = Interval::new(middle, x[axis].hi);
        [lower, upper]
    }

    /// The axis to halve it along, unless the cell is too small.
    fn cut(&self) -> Option<usize> {
        [self.axis, 1 - self.axis].into_iter().find(|&axis| self.x[axis].width() > LEAST_WIDTH)
    }
}

/// Of equal errors the older cell comes first, so that the order is the same everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Worst {
    error: f64,
    id: usize,
}

impl Eq for Worst {}
impl PartialOrd for Worst {
    fn partial_cmp(&self, o: &Self) -> Option<Ordering> {
        Some(self.cmp(o))
    }
}
impl Ord for Worst {
    fn cmp(&self, o: &Self) -> Ordering {
        self.error.total_cmp(&o.error).then(o.id.cmp(&self.id))
    }
}

/// The sums over the cells.
#[derive(Clone, Debug)]
struct Total {
    value: Interval,
    slopes: Vec<Interval>,
    estimate: f64,
}

impl Total {
    fn new(region: &[Interval]) -> Self {
        Self { value: Interval::ZERO, slopes: vec![Interval::ZERO; region.len()], estimate: 0.0 }
    }

    fn add(&mut self, cell: &Cell) {
        self.value = self.value + cell.value;
        self.estimate += cell.estimate;
        for (sum, &slope) in self.slopes.iter_mut().zip(&cell.slopes) {
            *sum = *sum + slope;
        }
    }

    /// What the slopes add, axis by axis.
    fn moved(&self, region: &[Interval]) -> Vec<Interval> {
        let distance = |x: &Interval| *x - Interval::point(x.middle());
        self.slopes.iter().zip(region).map(|(&slope, x)| slope * distance(x)).collect()
    }

    /// `E`, with the ring at the horizon, over the region.
    fn albedo<F: Family>(&self, family: &F, ring: Interval, region: &[Interval]) -> Interval {
        let sum = self.moved(region).into_iter().fold(self.value + ring, |sum, moved| sum + moved);
        sum * measure(family)
    }
}

/// `π²`, twice if one half of the azimuths stands for both.
fn measure<F: Family>(family: &F) -> Interval {
    let halves = match family.symmetry() {
        Symmetry::Isotropic => 2.0,
        Symmetry::None => 1.0,
    };
    Interval::PI.squared() * Interval::point(halves)
}

/// All angles of the light but the ring, and the ring.
fn domain<F: Family>(family: &F) -> ([Interval; 2], [Interval; 2]) {
    let azimuth = match family.symmetry() {
        Symmetry::Isotropic => Interval::new(0.0, 1.0),
        Symmetry::None => Interval::new(0.0, 2.0),
    };
    let end = 0.5 - RING;
    ([Interval::new(0.0, end), azimuth], [Interval::new(end, 0.5), azimuth])
}

/// The ring's part.
fn ring<F: Family>(family: &F, [theta, phi]: [Interval; 2], region: &[Interval]) -> Interval {
    let step = phi.hi / ARCS as f64;
    let mut all: Vec<_> = [theta, phi].iter().chain(region).copied().collect();
    (0..ARCS).fold(Interval::ZERO, |sum, i| {
        all[1] = Interval::new(i as f64 * step, (i + 1) as f64 * step);
        sum + integrand(family, &all) * area([theta, all[1]])
    })
}

/// A node of the subdivision of the light's angles.
enum Node {
    Cell(Cell),
    Halved(usize, usize),
}

fn judge<F: Family>(family: &F, axes: &[Axis], region: &[Interval], limits: (f64, f64), effort: &Effort) -> Verdict {
    if region.len() <= 2 {
        integrate::<F, 4>(family, axes, region, limits, effort)
    } else {
        integrate::<F, 8>(family, axes, region, limits, effort)
    }
}

/// How many cells there are before the progress is looked at for the first time.
const FIRST: usize = 256;
/// How many there are when one without a bound is blamed on the region.
const BOUNDLESS: usize = 256;
/// How many parts of the ring are bounded apart.
const ARCS: usize = 64;

fn integrate<F: Family, const N: usize>(
    family: &F,
    axes: &[Axis],
    region: &[Interval],
    limits: (f64, f64),
    effort: &Effort,
) -> Verdict {
    let (whole, outer) = domain(family);
    let ring = ring(family, outer, region);
    let mut nodes = vec![Node::Cell(Cell::new::<F, N>(family, whole, region))];
    let mut queue = BinaryHeap::from([Worst { error: f64::INFINITY, id: 0 }]);
    let (mut count, mut target) = (1, FIRST);
    loop {
        while count < target {
            let Some(Worst { id, .. }) = queue.pop() else { break };
            let Node::Cell(cell) = &nodes[id] else { continue };
            let Some(axis) = cell.cut() else { continue };
            let halves = Cell::halves(cell.x, axis);
            nodes[id] = Node::Halved(axis, nodes.len());
            for x in halves {
                let cell = Cell::new::<F, N>(family, x, region);
                queue.push(Worst { error: cell.error, id: nodes.len() });
                nodes.push(Node::Cell(cell));
            }
            count += 1;
        }
        let (total, own, weights) = sum(&nodes, region);
        let albedo = total.albedo(family, ring, region);
        if within(albedo, (f64::NEG_INFINITY, limits.1)) {
            return Verdict::Proved { bound: albedo, cells: text(&nodes), count };
        }
        // What the region itself leaves, which more cells do not take away. If it is more than half of the room between the
        // albedo and the limit, cells become expensive, and two smaller regions are cheaper. Beyond the limit only a
        // counterexample is to be had, for which the region does not matter.
        let scale = measure(family).hi;
        let room = limits.1 - total.estimate * scale;
        let left: f64 = weights.iter().sum::<f64>() * scale;
        // What more cells do take away.
        let cut = (total.value.hi - total.estimate - own) * scale;
        // Some cells may have no bound at all, because the region is too large.
        let boundless = !albedo.is_finite() && count >= BOUNDLESS;
        let hopeless = boundless || (room > 0.0 && left > 0.5 * room && left > cut);
        if hopeless || 2 * count > effort.cells || queue.is_empty() {
            // In the middle of the region no slope by a parameter counts.
            let middle = (total.value + ring) * measure(family);
            if !middle.nan && middle.lo > limits.1 {
                let point: Vec<_> = region.iter().map(|x| x.middle()).collect();
                return Verdict::Refuted(point, middle);
            }
            return Verdict::Unknown(albedo, worst_axis(axes, region, &weights, |_| f64::INFINITY), count);
        }
        target = 2 * count;
    }
}

/// The sums in the order of the text; what the region adds to them; and that with the slopes, axis by axis.
fn sum(nodes: &[Node], region: &[Interval]) -> (Total, f64, Vec<f64>) {
    let mut total = Total::new(region);
    let mut weights = vec![0.0; region.len()];
    let mut stack = vec![0];
    while let Some(id) = stack.pop() {
        match &nodes[id] {
            Node::Halved(_, first) => stack.extend([first + 1, *first]),
            Node::Cell(cell) => {
                total.add(cell);
                for (sum, weight) in weights.iter_mut().zip(&cell.weights) {
                    *sum += weight;
                }
            }
        }
    }
    let own = weights.iter().sum();
    for (weight, moved) in weights.iter_mut().zip(total.moved(region)) {
        *weight += moved.magnitude();
    }
    (total, own, weights)
}

/// How the cells are cut.
fn text(nodes: &[Node]) -> String {
    let mut text = String::from("(");
    let mut stack = vec![0];
    while let Some(id) = stack.pop() {
        match &nodes[id] {
            Node::Halved(axis, first) => {
                text.push(if *axis == 0 { 'a' } else { 'b' });
                stack.extend([first + 1, *first]);
            }
            Node::Cell(_) => text.push('.'),
        }
    }
    text.push(')');
    text
}

/// The albedo over a region by the cells of a text, and the length of that text; or where it is wrong.
fn again<F: Family>(family: &F, region: &[Interval], rest: &[u8]) -> Result<(usize, Interval), usize> {
    if rest.first() != Some(&b'(') {
        return Err(0);
    }
    let (whole, outer) = domain(family);
    let mut total = Total::new(region);
    let mut position = 1;
    let mut stack = vec![whole];
    while let Some(x) = stack.pop() {
        let axis = match rest.get(position) {
            Some(b'.') => {
                let cell = match region.len() {
                    0..=2 => Cell::new::<F, 4>(family, x, region),
                    _ => Cell::new::<F, 8>(family, x, region),
                };
                total.add(&cell);
                position += 1;
                continue;
            }
            Some(b'a') => 0,
            Some(b'b') => 1,
            _ => return Err(position),
        };
        // The middle of a cell that is too small is not exact.
        if x[axis].width() <= LEAST_WIDTH {
            return Err(position);
        }
        let [lower, upper] = Cell::halves(x, axis);
        stack.extend([upper, lower]);
        position += 1;
    }
    if rest.get(position) != Some(&b')') {
        return Err(position);
    }
    Ok((position + 1, total.albedo(family, ring(family, outer, region), region)))
}
