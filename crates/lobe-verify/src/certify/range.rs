//! Bounds of a quantity over a box: it is defined everywhere, finite, and within limits.

use super::number::Number;
use super::search::{Statement, Verdict, recheck, search, within};
use super::{Axis, Certificate, Effort, Family, Outcome, Quantity, Recheck, Slopes, Symmetry};
use crate::interval::Interval;
use lobe::{Brdf, Vec3};

/// Proves that the quantity is defined, finite and between the limits for all numbers of its axes.
///
/// Of each box the bound is the best of three. That of the intervals as they are; the mean value form with [`Slopes`];
/// and along an axis where the slope has one sign the quantity is monotonic, so that its extrema are at the ends.
pub fn prove<Q: Quantity>(quantity: &Q, limits: (f64, f64), effort: &Effort) -> Outcome {
    let (name, axes) = (quantity.name(), quantity.axes());
    search(&Statement { name: &name, axes: &axes, limits }, effort, |region| judge(quantity, &axes, region, limits))
}

/// Computes every box of the proof again.
pub fn check<Q: Quantity>(quantity: &Q, certificate: &Certificate) -> Recheck {
    let (name, axes) = (quantity.name(), quantity.axes());
    if axes != certificate.axes {
        return Recheck::Malformed(0);
    }
    let statement = Statement { name: &name, axes: &axes, limits: certificate.limits };
    recheck(&statement, &certificate.proof, |region, rest| match rest.first() {
        Some(b'.') => Ok((1, bound(quantity, region).0)),
        _ => Err(0),
    })
}

/// Proves that `f_r(l, v) cos θ_l` is defined, finite and not negative for all parameters of the family and all pairs of
/// directions with cosines from `least` to 1.
pub fn prove_lobe<F: Family>(family: &F, least: f64, effort: &Effort) -> Outcome {
    prove(&EvalCos { family, least }, (0.0, f64::MAX), effort)
}

/// Computes every box of the proof of [`prove_lobe`] again.
pub fn check_lobe<F: Family>(family: &F, least: f64, certificate: &Certificate) -> Recheck {
    check(&EvalCos { family, least }, certificate)
}

/// `f_r cos θ` of a family, by the cosines of light and viewer and the azimuth in half turns.
struct EvalCos<'a, F> {
    family: &'a F,
    least: f64,
}

impl<F: Family> Quantity for EvalCos<'_, F> {
    fn name(&self) -> String {
        format!("eval_cos of {}", self.family.name())
    }

    fn axes(&self) -> Vec<Axis> {
        let mut axes =
            vec![Axis::logarithmic("n_dot_l", self.least, 1.0), Axis::logarithmic("n_dot_v", self.least, 1.0)];
        match self.family.symmetry() {
            Symmetry::Isotropic => axes.push(Axis::linear("azimuth", 0.0, 1.0)),
            Symmetry::None => {
                axes.push(Axis::linear("azimuth of l", 0.0, 2.0));
                axes.push(Axis::linear("azimuth of v", 0.0, 2.0));
            }
        }
        axes.extend(self.family.parameters());
        axes
    }

    fn value<R: Number>(&self, x: &[R]) -> R {
        let one = x[0].lift(1.0);
        let (l, v, rest) = match self.family.symmetry() {
            Symmetry::Isotropic => (by_cosine(x[0], x[2]), by_cosine(x[1], x[1].lift(0.0)), 3),
            Symmetry::None => (by_cosine(x[0], x[2]), by_cosine(x[1], x[3]), 4),
        };
        self.family.channel(self.family.lobe(one, &x[rest..]).eval_cos(l, v))
    }
}

/// The direction of a cosine and an azimuth in half turns.
fn by_cosine<R: Number>(cos: R, phi: R) -> Vec3<R> {
    let sin = ((cos.lift(1.0) - cos) * cos.plus(1.0)).sqrt();
    let (sin_phi, cos_phi) = phi.half_turns();
    Vec3::new(sin * cos_phi, sin * sin_phi, cos)
}

fn judge<Q: Quantity>(quantity: &Q, axes: &[Axis], region: &[Interval], limits: (f64, f64)) -> Verdict {
    let (bound, weights, ends) = bound(quantity, region);
    if within(bound, limits) {
        return Verdict::Proved { bound, cells: ".".to_owned(), count: 0 };
    }
    for point in ends {
        let thin: Vec<_> = point.iter().map(|&x| Interval::point(x)).collect();
        let value = quantity.value(&thin);
        if !value.nan && (value.hi < limits.0 || value.lo > limits.1) {
            return Verdict::Refuted(point, value);
        }
    }
    Verdict::Unknown(bound, worst_axis(axes, region, &weights, |region| quantity.value(region).width()), 0)
}

/// The axis that the bound is lost along: the largest weight. If some are not known, the one whose halves have the
/// smallest `width`; where that is infinite too, the widest.
pub(super) fn worst_axis(
    axes: &[Axis],
    region: &[Interval],
    weights: &[f64],
    width: impl Fn(&[Interval]) -> f64,
) -> usize {
    let known = weights.iter().all(|w| w.is_finite());
    let rank = |i: usize| {
        if known {
            return weights[i];
        }
        let (lower, upper) = axes[i].halves(region[i]);
        let of = |half: Interval| {
            let mut part = region.to_vec();
            part[i] = half;
            let width = width(&part);
            if width.is_nan() { f64::INFINITY } else { width }
        };
        -f64::max(of(lower), of(upper))
    };
    // Where all are the same, the widest; of equals the first.
    let keys: Vec<_> = (0..axes.len()).map(|i| (rank(i), axes[i].share(region[i]))).collect();
    let larger = |&a: &usize, &b: &usize| keys[a].0.total_cmp(&keys[b].0).then(keys[a].1.total_cmp(&keys[b].1));
    (0..axes.len()).rev().max_by(larger).unwrap_or(0)
}

/// The bound of a quantity over a box, what each axis adds to it, and the points at which the extrema may be.
fn bound<Q: Quantity>(quantity: &Q, region: &[Interval]) -> (Interval, Vec<f64>, [Vec<f64>; 2]) {
    if region.len() <= 4 { bound_by::<Q, 4>(quantity, region) } else { bound_by::<Q, 8>(quantity, region) }
}

/// The box as variables of a formula with slopes. Beyond the `N`th a variable has none.
pub(super) fn variables<const N: usize>(region: &[Interval]) -> Vec<Slopes<N>> {
    region.iter().enumerate().map(|(i, &x)| Slopes::variable(x, i)).collect()
}

fn bound_by<Q: Quantity, const N: usize>(quantity: &Q, region: &[Interval]) -> (Interval, Vec<f64>, [Vec<f64>; 2]) {
    let over = quantity.value(&variables::<N>(region));
    let centre: Vec<_> = region.iter().map(|x| x.middle()).collect();
    if over.value.nan {
        return (over.value, vec![f64::INFINITY; region.len()], [centre.clone(), centre]);
    }
    let mut weights = vec![0.0; region.len()];
    let (mut lowest, mut highest) = (region.to_vec(), region.to_vec());
    let mut rest = Interval::ZERO;
    for (i, &x) in region.iter().enumerate() {
        let slope = if i < N { over.slope[i] } else { Interval::UNKNOWN };
        let (at_lo, at_hi) = (Interval::point(x.lo), Interval::point(x.hi));
        if !slope.nan && slope.lo >= 0.0 {
            (lowest[i], highest[i]) = (at_lo, at_hi);
        } else if !slope.nan && slope.hi <= 0.0 {
            (lowest[i], highest[i]) = (at_hi, at_lo);
        } else if slope.is_finite() {
            let middle = Interval::point(centre[i]);
            let added = slope * (x - middle);
            rest = rest + added;
            weights[i] = added.width();
            (lowest[i], highest[i]) = (middle, middle);
            continue;
        } else {
            weights[i] = f64::INFINITY;
            continue;
        }
        // Monotonic: the extrema are known, but the slopes along the others are less certain for it.
        weights[i] = if slope.is_finite() { slope.width() * x.width() } else { f64::INFINITY };
    }
    let (low, high) = (quantity.value(&lowest) + rest, quantity.value(&highest) + rest);
    let mut value = over.value;
    if !low.nan && low.lo > value.lo {
        value.lo = low.lo;
    }
    if !high.nan && high.hi < value.hi {
        value.hi = high.hi;
    }
    let middles = |region: &[Interval]| region.iter().map(|x| x.middle()).collect();
    (value, weights, [middles(&lowest), middles(&highest)])
}
