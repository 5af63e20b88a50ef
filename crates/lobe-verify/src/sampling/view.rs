//! All checks of one sampler at one view.

use super::Effort;
use super::claims::Claims;
use super::draws::{Even, Plan, Tally, even, pilot};
use super::partition::{Bin, Bins, Density, Partition, Sums};
use super::pointwise::{self, At};
use super::random::seed;
use super::report::{Case, Fit, Outcome, Property, Verdict, View};
use super::sampler::Sampler;
use super::statistics::{bernstein, binomial, kolmogorov_tail, noncentral_tail, two_sided_normal};
use crate::subject::{Precision, catch};
use lobe::{Brdf, Rgb, Vec3};
use lobe_energy::{Albedo, directional_albedo_to};
use std::f64::consts::PI;

/// Cells that expect fewer samples are put together: the distribution of their counts is not yet that of χ².
const LEAST_EXPECTED: f64 = 5.0;
/// The density has to integrate to what it should to this.
const NORMALISED: f64 = 1e-4;
/// The mean weight over the sequence has to be the albedo to this.
const ALBEDO: f64 = 1e-3;
/// Standard errors, of sixteen means, that are allowed beside: once in a million.
const ERRORS: f64 = 8.0;
/// To what two quadratures of an albedo have to agree that the cells doubt.
const FINE: f64 = 1e-4;
/// A third moment, over the root of the number of samples, up to which a mean is normal to five standard errors.
const SKEWED: f64 = 0.02;
/// The mean of fewer samples than that, among all, says nothing.
const LEAST_SHARING: f64 = 100.0;
/// One more sample for so many shows where the density is, and none of those may fall where the quadrature sees nothing.
/// What it misses then has hardly more than one of them, and few of the others; with a sixteenth as many the tail of a
/// ridge is missed that eighty samples are in (test `no_tail_is_missed_that_samples_are_in`).
const SAMPLES_PER_PILOT: usize = 4;
/// Quantiles at which distribution functions are compared.
const EDGES: usize = 256;

/// A panic becomes a verdict.
pub(crate) fn check(name: &str, sampler: &dyn Sampler, claims: &Claims, v: [f64; 3], effort: &Effort) -> View {
    let v = v.map(|x| sampler.precision().round(x));
    catch(|| look(name, sampler, claims, v, effort)).unwrap_or_else(|said| View {
        v,
        verdicts: vec![Verdict::new(Property::Finite, Outcome::Broken(said))],
        integral: f64::NAN,
        integral_error: f64::NAN,
        rejected: f64::NAN,
        delta: f64::NAN,
        albedo: None,
        variance: f64::NAN,
        samples_for_one_percent: None,
        fit: None,
    })
}

/// What is known of a sampler at a view, from which the verdicts are made.
struct Known<'a> {
    sampler: &'a dyn Sampler,
    v: [f64; 3],
    sums: Sums,
    pdf_error: f64,
    value_error: f64,
    tally: Tally,
    even: Even,
}

fn look(name: &str, sampler: &dyn Sampler, claims: &Claims, v: [f64; 3], effort: &Effort) -> View {
    let seed = seed(&format!("{name} {v:?}"));
    let mut verdicts = pointwise::verdicts(At { sampler, claims, v }, seed, effort.single);

    let density = Density { sampler, v };
    let mut places = pilot(sampler, v, super::partition::Chart::new(v), seed, effort.samples / SAMPLES_PER_PILOT);
    let edges = quantiles(places.get(..1024).unwrap_or(&places));
    places.extend(around_mirror(v));
    let mut partition = Partition::new(&density, &mut places, effort.tolerance, effort.cells);
    let bins = partition.bins(&density, effort.bins);
    let (sums, pdf_error, value_error) = partition.total();
    let plan = Plan { sampler, v, partition: &partition, bins: &bins, edges: &edges, seed };
    let tally = plan.draw(effort.samples);
    let even = even(sampler, v, seed, effort.even);
    let known = Known { sampler, v, sums, pdf_error, value_error, tally, even };

    verdicts.push(known.normalised(partition.bad));
    verdicts.push(known.rejection());
    let (fit, of_fit) = known.fit(&partition, &bins);
    verdicts.push(of_fit);
    verdicts.push(known.marginal(Property::Polar, 0, &partition, &edges));
    verdicts.push(known.marginal(Property::Azimuth, 1, &partition, &edges));
    let reference = known.reference(effort);
    verdicts.push(known.mean_weight(reference));
    verdicts.push(known.albedo(reference));

    let n = known.tally.count as f64;
    let (mean, second) = (known.tally.all / n, known.tally.squares / n);
    // Without deltas the quadrature knows it better than the samples; a sampler without a value has only those.
    let (mean, second) = match reference {
        Some(_) if known.tally.delta == 0 && sums.second > 0.0 => (sums.mean_value(), sums.second),
        _ => (mean, second),
    };
    let variance = (second - mean * mean).max(0.0);
    View {
        v,
        verdicts,
        integral: sums.pdf,
        integral_error: pdf_error,
        rejected: known.tally.rejected as f64 / n,
        delta: known.tally.delta as f64 / n,
        albedo: reference.map(|of| super::partition::mean(of.value)),
        variance,
        samples_for_one_percent: (mean > 0.0).then(|| (variance / (1e-4 * mean * mean)).max(1.0)),
        fit,
    }
}

/// Places a hundred-thousandth around the mirror direction: a peak there that no sample meets has to be seen too.
pub(super) fn around_mirror([x, y, z]: [f64; 3]) -> impl Iterator<Item = [f64; 2]> {
    let mirror = super::partition::Chart::new([x, y, z]).locate([-x, -y, z]);
    let near = |x: f64, step: i32| (x + 1e-5 * f64::from(step)).clamp(0.0, 1.0);
    let grid = (0..25).map(|i| (i / 5 - 2, i % 5 - 2));
    mirror.into_iter().flat_map(move |[a, s]| grid.clone().map(move |(i, j)| [near(a, i), near(s, j)]))
}

/// Places of the pilot, sorted along either axis, at most [`EDGES`].
fn quantiles(places: &[[f64; 2]]) -> [Vec<f64>; 2] {
    std::array::from_fn(|axis| {
        let mut sorted: Vec<f64> = places.iter().filter_map(|place| place.get(axis).copied()).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.dedup();
        let step = sorted.len().div_ceil(EDGES).max(1);
        sorted.into_iter().step_by(step).collect()
    })
}

/// A directional albedo per channel and its error.
#[derive(Clone, Copy, Debug)]
struct Reference {
    value: [f64; 3],
    error: f64,
    /// Whether it is that of the quadrature around the mirror direction.
    around_mirror: bool,
}

/// A sampler's lobe.
struct Lobe<'a>(&'a dyn Sampler);

impl Brdf<f64> for Lobe<'_> {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.eval_cos(l, v) * l.z.recip()
    }
    fn eval_cos(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.0.eval_cos_pdf(l.into(), v.into()).map_or(Rgb::splat(0.0), |(value, _)| value.into())
    }
}

impl Known<'_> {
    fn case(&self, size: f64) -> Case {
        Case::new(self.v, self.sampler.precision(), size)
    }

    fn samples(&self) -> f64 {
        self.tally.count as f64
    }

    /// A verdict of a test, which the suite will judge.
    fn tested(&self, property: Property, size: f64, p: f64) -> Verdict {
        let mut verdict = Verdict::new(property, Outcome::Holds);
        verdict.tried = self.tally.count as usize;
        verdict.size = size;
        // What is no number has no excuse.
        verdict.p = Some(if p.is_nan() { 0.0 } else { p });
        verdict
    }

    fn normalised(&self, bad: Option<([f64; 3], f64)>) -> Verdict {
        let (missing, standard) = self.even.missing;
        let size = (self.sums.pdf + missing - 1.0).abs();
        // Where no sample of n is rejected, a few in n still may be.
        let standard = standard.max(0.5 / self.even.count as f64);
        let fails = size.is_nan()
            || size > NORMALISED + self.pdf_error + ERRORS * standard
            || self.sums.pdf > 1.0 + NORMALISED + self.pdf_error
            || bad.is_some();
        let outcome = if fails {
            Outcome::Fails
        } else if self.pdf_error > NORMALISED {
            Outcome::NotChecked(format!("the quadrature is not sure beyond {:.0e}", self.pdf_error))
        } else {
            Outcome::Holds
        };
        let mut verdict = Verdict::new(Property::Normalised, outcome);
        verdict.tried = self.even.count;
        verdict.size = size;
        let case = self.case(size).with("∫ pdf", self.sums.pdf).with("error", self.pdf_error);
        let mut case = case.with("missing samples", missing).with("their standard error", standard);
        if let Some((l, x)) = bad {
            case.l = Some(l);
            case = case.with("no density or value", x);
        }
        verdict.worst = Some(case.clone());
        verdict.simplest = fails.then_some(case);
        verdict
    }

    fn rejection(&self) -> Verdict {
        let hits = self.tally.rejected + self.tally.delta;
        let left = 1.0 - self.sums.pdf;
        // A density of `f32` may integrate to a little more than 1, and then one rejected sample is impossible without
        // (test `a_density_that_rounding_lifts_is_no_fault`).
        let error = self.pdf_error + rounding(self.sampler.precision());
        let p = binomial(self.tally.count, hits, left - error, left + error);
        let share = hits as f64 / self.samples();
        let mut verdict = self.tested(Property::Rejection, (share - left).abs(), p);
        verdict.worst = Some(
            self.case(verdict.size)
                .with("rejected", self.tally.rejected as f64)
                .with("deltas", self.tally.delta as f64)
                .with("expected of both", left * self.samples()),
        );
        verdict
    }

    fn fit(&self, partition: &Partition, bins: &Bins) -> (Option<Fit>, Verdict) {
        let n = self.samples();
        let found: u64 = self.tally.bins.iter().sum();
        let rest = Bin { mass: (1.0 - self.sums.pdf).max(0.0), error: self.pdf_error, low: [0.0; 2], high: [0.0; 2] };
        let counted = bins.bins.iter().zip(&self.tally.bins).map(|(bin, count)| Group {
            expected: n * bin.mass,
            error: n * bin.error,
            count: *count as f64,
            place: Some(*bin),
        });
        let missing = Group {
            expected: n * rest.mass,
            error: n * rest.error,
            count: (self.tally.count - found) as f64,
            place: None,
        };
        let groups = pooled(counted.chain([missing]).collect());
        if groups.len() < 2 {
            return (None, Verdict::not_checked(Property::Fit, "all samples are expected in one cell"));
        }
        let statistic: f64 = groups.iter().map(Group::part).sum();
        let degrees = (groups.len() - 1) as f64;
        let from_quadrature: f64 = groups.iter().map(|group| group.error * group.error / group.expected).sum();
        let p = if statistic.is_finite() { noncentral_tail(degrees, from_quadrature.min(1e5), statistic) } else { 0.0 };
        let mut verdict = self.tested(Property::Fit, (statistic - degrees).max(0.0), p);
        verdict.remark = format!("χ² = {statistic:.1} with {degrees} degrees of freedom");
        if from_quadrature > 1.0 {
            verdict.remark += &format!(", of which the quadrature may account for {from_quadrature:.1}");
        }
        verdict.worst = groups.iter().max_by(|a, b| a.part().total_cmp(&b.part())).map(|group| {
            let case = self.case(group.part()).with("samples", group.count).with("expected", group.expected);
            let Some(Bin { low, high, .. }) = group.place else {
                return case.with("in the cell of what is rejected", 1.0);
            };
            let ([a0, s0], [a1, s1]) = (low, high);
            let mut case = case
                .with("cos θ from", (1.0 - a1) * (1.0 + a1))
                .with("to", (1.0 - a0) * (1.0 + a0))
                .with("azimuth from that of v, degrees", 360.0 * s0)
                .with("to", 360.0 * s1);
            case.l = Some(partition.chart.direction([0.5 * (a0 + a1), 0.5 * (s0 + s1)]));
            case
        });
        (Some(Fit { statistic, degrees, from_quadrature, samples: n }), verdict)
    }

    fn marginal(&self, property: Property, axis: usize, partition: &Partition, edges: &[Vec<f64>; 2]) -> Verdict {
        let counts = self.tally.between.get(axis).map_or(&[][..], Vec::as_slice);
        let edges = edges.get(axis).map_or(&[][..], Vec::as_slice);
        let found: u64 = counts.iter().sum();
        if found < 100 || edges.len() < 10 || self.sums.pdf <= 0.0 {
            return Verdict::not_checked(property, "too few samples have a density");
        }
        let n = found as f64;
        let mut below = 0;
        let (mut size, mut worst) = (0.0, None);
        for ((edge, mass), count) in edges.iter().zip(partition.below(axis, edges)).zip(counts) {
            below += count;
            let (sampled, expected) = (below as f64 / n, mass / self.sums.pdf);
            let distance = (sampled - expected).abs();
            if distance > size {
                size = distance;
                worst = Some((*edge, sampled, expected));
            }
        }
        let sure = (size - self.pdf_error / self.sums.pdf).max(0.0);
        let mut verdict = self.tested(property, size, kolmogorov_tail(n, sure));
        verdict.worst = worst.map(|(edge, sampled, expected)| {
            let case = self.case(size).with("part of the samples", sampled).with("of the density", expected);
            match property {
                Property::Polar => case.with("above cos θ", (1.0 - edge) * (1.0 + edge)),
                _ => case.with("within degrees from the azimuth of v", 360.0 * edge),
            }
        });
        verdict
    }

    /// The albedo by the quadrature around the mirror direction, or by that of the cells where it is surer.
    fn reference(&self, effort: &Effort) -> Option<Reference> {
        self.sampler.eval_cos_pdf(self.v, self.v)?;
        let [x, y, z] = self.v;
        let lobe = Lobe(self.sampler);
        let around = |agreement| directional_albedo_to(agreement, &lobe, Vec3::new(x, y, z));
        let rounding = rounding(self.sampler.precision());
        let cells = self.sums.mean_value();
        let mean_of = |albedo: &Albedo| super::partition::mean(albedo.value.into());
        let agrees = |albedo: &Albedo| (mean_of(albedo) - cells).abs() <= albedo.error + self.value_error + rounding;
        let coarse = around(effort.agreement);
        // Of a brushed lobe two coarse rules may agree by chance on what is wrong by a few hundredths.
        let near = if agrees(&coarse) { coarse } else { around(effort.agreement.min(FINE)) };
        // What still differs more than either admits has missed a peak: the smaller.
        let around_mirror =
            if agrees(&near) { near.error <= self.value_error.max(1e-5) } else { mean_of(&near) > cells };
        let (value, around) = (near.value.into(), near);
        Some(if around_mirror {
            Reference { value, error: around.error + rounding, around_mirror }
        } else {
            Reference { value: self.sums.value, error: self.value_error + rounding, around_mirror }
        })
    }

    fn mean_weight(&self, reference: Option<Reference>) -> Verdict {
        let Some(reference) = reference else {
            return Verdict::not_checked(Property::MeanWeight, "the sampler gives no value of the lobe");
        };
        let (n, sums) = (self.samples(), &self.sums);
        let (mean, expected) = (self.tally.scattered / n, super::partition::mean(reference.value));
        let size = (mean - expected).abs();
        let distance = (size - reference.error).max(0.0);
        let e = sums.mean_value();
        let variance = (sums.second - e * e).max(0.0);
        let third = sums.third - 3.0 * e * sums.second + 2.0 * e * e * e;
        let skewed = third.abs() > SKEWED * n.sqrt() * variance * variance.sqrt();
        let p = if distance == 0.0 {
            1.0
        } else if skewed {
            bernstein(n, variance, self.tally.largest, distance)
        } else {
            two_sided_normal(distance / (variance / n).sqrt())
        };
        let mut verdict = self.tested(Property::MeanWeight, size, p);
        let standard = (variance / n).sqrt();
        verdict.remark = format!(
            "standard error {standard:.1e}{}{}",
            if skewed { ", by Bernstein's bound" } else { "" },
            if reference.around_mirror { "" } else { ", albedo from the cells" }
        );
        let case = self.case(size).with("mean weight", mean).with("albedo", expected);
        verdict.worst = Some(case.with("standard error", standard).with("value without density", sums.uncovered));
        verdict
    }

    fn albedo(&self, reference: Option<Reference>) -> Verdict {
        let Some(reference) = reference else {
            return Verdict::not_checked(Property::Albedo, "the sampler gives no value of the lobe");
        };
        let channels = self.even.weight.iter().zip(reference.value);
        let of =
            |((mean, standard), expected): (&(f64, f64), f64)| ((mean - expected).abs(), *standard, *mean, expected);
        // A NaN counts as the worst.
        let worst = channels.map(of).max_by(|a, b| a.0.total_cmp(&b.0));
        let (size, standard, mean, expected) = worst.unwrap_or((f64::NAN, f64::NAN, f64::NAN, f64::NAN));
        // So many samples share what is reflected: of too few the shifts cannot tell how they differ.
        let e = self.sums.mean_value();
        let sharing = self.even.count as f64 * e * e / self.sums.second.max(f64::MIN_POSITIVE);
        let rare = e > 0.0 && sharing < LEAST_SHARING;
        let noise = if rare { f64::INFINITY } else { ERRORS * standard + reference.error };
        let fails = size.is_nan() || noise.is_nan() || size > ALBEDO + noise;
        let outcome = if fails {
            Outcome::Fails
        } else if rare {
            Outcome::NotChecked(format!(
                "{sharing:.0} of {} samples bring the albedo: 1e-3 cannot be told",
                self.even.count
            ))
        } else if noise > ALBEDO {
            Outcome::NotChecked(format!(
                "{} samples of the sequence leave a standard error of {standard:.0e}: 1e-3 cannot be told",
                self.even.count
            ))
        } else {
            Outcome::Holds
        };
        let mut verdict = Verdict::new(Property::Albedo, outcome);
        verdict.tried = self.even.count;
        verdict.size = size;
        verdict.remark = format!("standard error {standard:.1e}");
        let case = self.case(size).with("mean weight", mean).with("albedo", expected).with("standard error", standard);
        verdict.worst = Some(case.clone());
        verdict.simplest = fails.then_some(case);
        verdict
    }
}

/// What rounding may lift a whole integral by: of `f32` some tens of ulps of each value, of `f64` the sum of a million.
fn rounding(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 4e-6,
        Precision::Double => 1e-9,
    }
}

/// Bins that are counted together.
#[derive(Clone, Copy, Debug)]
struct Group {
    expected: f64,
    error: f64,
    count: f64,
    place: Option<Bin>,
}

impl Group {
    fn part(&self) -> f64 {
        let difference = self.count - self.expected;
        if difference == 0.0 { 0.0 } else { difference * difference / self.expected }
    }
}

/// Groups that expect enough: those that do not are put together, the smallest first, and what is left goes with the
/// next.
fn pooled(mut groups: Vec<Group>) -> Vec<Group> {
    groups.sort_by(|a, b| a.expected.total_cmp(&b.expected));
    let mut pooled: Vec<Group> = Vec::with_capacity(groups.len());
    for group in groups {
        match pooled.last_mut().filter(|last| last.expected < LEAST_EXPECTED) {
            Some(last) => {
                last.expected += group.expected;
                last.error += group.error;
                last.count += group.count;
                last.place = group.place;
            }
            None => pooled.push(group),
        }
    }
    // Only where everything together expects too few.
    if pooled.last().is_some_and(|last| last.expected < LEAST_EXPECTED) && pooled.len() > 1 {
        pooled.pop();
    }
    pooled
}

/// The view with this cosine at this azimuth, in degrees.
#[must_use]
pub fn view(cos: f64, azimuth: f64) -> [f64; 3] {
    let sin = libm::sqrt((1.0 - cos) * (1.0 + cos));
    let (y, x) = libm::sincos(azimuth * PI / 180.0);
    [sin * x, sin * y, cos]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_cells_are_put_together() {
        let group = |expected: f64| Group { expected, error: 0.0, count: 2.0 * expected, place: None };
        let pooled = pooled(vec![group(100.0), group(1.0), group(3.0), group(0.5), group(2.0), group(7.0)]);
        let expected: Vec<f64> = pooled.iter().map(|group| group.expected).collect();
        // 0.5 + 1 + 2 + 3, then the others.
        assert_eq!(expected, [6.5, 7.0, 100.0]);
        assert!(pooled.iter().all(|group| group.count == 2.0 * group.expected));
    }
}
