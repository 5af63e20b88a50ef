//! What samples in a table can show: there is no value in between to ask for.

use super::claims::Claims;
use super::place::exchanged;
use super::report::{Case, Observed, Outcome, Property, Report, Unit, Verdict};
use crate::subject::{Pair, Row, Table, Value};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Directions that are equal to five decimals are the same: tables are printed with six.
type Key = [i32; 3];

fn key(direction: [f64; 3]) -> Key {
    direction.map(|x| libm::round(x * 1e5) as i32)
}

fn keys(&[lx, ly, lz, vx, vy, vz]: &Pair) -> (Key, Key) {
    (key([lx, ly, lz]), key([vx, vy, vz]))
}

/// Looks for the properties that the samples of a table can show; each case names its line.
///
/// Finite, not negative and 0 below the horizon are seen of each sample. Reciprocity takes pairs of samples that are
/// there both ways round; energy a view with a grid of light directions, rings of one cosine each with azimuths all
/// around. What cannot be seen is told as not checked, with the reason.
///
/// ```
/// use lobe_verify::properties::{Claims, Property, verify_table};
/// use lobe_verify::subject::Table;
/// let text = "lx,ly,lz,vx,vy,vz,r,g,b\n0,0,1,0.6,0,0.8,0.1,0.1,0.1\n0.6,0,0.8,0,0,1,0.1,0.2,0.1\n";
/// let report = verify_table(&Table::parse("paint.csv", text)?, &Claims::OTHERS);
/// let broken: Vec<_> = report.failures().map(|verdict| verdict.property).collect();
/// assert_eq!(broken, [Property::Reciprocal]);
/// # Ok::<(), lobe_verify::subject::SubjectError>(())
/// ```
pub fn verify_table(table: &Table, claims: &Claims) -> Report {
    let above = |row: &Row| row.pair.iter().skip(2).step_by(3).all(|cos| *cos > 0.0);
    let of_each = |property, unit, claimed, rows: &mut dyn Iterator<Item = &Row>, size: &dyn Fn(f64) -> f64| {
        let largest = |row: &Row| row.value.iter().map(|x| size(*x)).fold(0.0, f64::max);
        let cases = rows.map(|row| case(table, largest(row), &[row]));
        worst(property, unit, claimed, 0.0, cases)
    };
    let all = || table.rows().iter();
    Report {
        verdicts: vec![
            of_each(Property::Finite, Unit::Channels, claims.finite, &mut all(), &|x| f64::from(!x.is_finite())),
            of_each(Property::NonNegative, Unit::Absolute, claims.non_negative, &mut all(), &|x| -x),
            of_each(
                Property::BelowHorizon,
                Unit::Absolute,
                claims.below_horizon,
                &mut all().filter(|row| !above(row)),
                &|x| if x.is_nan() { f64::INFINITY } else { x.abs() },
            ),
            reciprocity(table, claims),
            not_checked(Property::Isotropic, "a table has no value for a turned pair"),
            not_checked(Property::Cosine, "a table has no form with the cosine"),
            not_checked(Property::Continuous, "a table has no value between its samples"),
            energy(table, claims),
            not_checked(Property::Nan, "a table cannot be asked"),
        ],
    }
}

fn not_checked(property: Property, reason: &str) -> Verdict {
    Verdict::new(property, Unit::Absolute, Outcome::NotChecked(reason.to_owned()))
}

fn case(table: &Table, size: f64, rows: &[&Row]) -> Case {
    let what = |row: &Row| format!("line {}", row.line);
    let observed = rows.iter().map(|row| Observed { what: what(row), pair: row.pair, value: row.value }).collect();
    let (pair, line) = rows.first().map_or(([f64::NAN; 6], None), |row| (row.pair, Some(row.line)));
    Case { pair, precision: table.precision(), size, observed, line }
}

/// The verdict of a list of cases. There is nothing to shrink: the first that fails is as simple as any.
fn worst(property: Property, unit: Unit, claimed: bool, allowed: f64, cases: impl Iterator<Item = Case>) -> Verdict {
    let mut verdict = Verdict::new(property, unit, if claimed { Outcome::Holds } else { Outcome::Measured });
    for case in cases {
        verdict.tried += 1;
        if case.size > allowed && verdict.simplest.is_none() {
            verdict.simplest = Some(case.clone());
            if claimed {
                verdict.outcome = Outcome::Fails;
            }
        }
        if verdict.worst.as_ref().is_none_or(|worst| case.size > worst.size) {
            verdict.size = case.size.max(0.0);
            verdict.worst = Some(case);
        }
    }
    if verdict.tried == 0 {
        verdict.outcome = Outcome::NotChecked("the table has no sample for it".to_owned());
    }
    verdict
}

fn reciprocity(table: &Table, claims: &Claims) -> Verdict {
    let rows: BTreeMap<(Key, Key), &Row> = table.rows().iter().map(|row| (keys(&row.pair), row)).collect();
    let precision = table.precision();
    let both_ways = table.rows().iter().filter_map(|row| {
        let other = rows.get(&keys(&exchanged(&row.pair)))?;
        let ulps = std::iter::zip(row.value, other.value).map(|(a, b)| precision.ulps_between(a, b));
        // Once for each two.
        (row.line < other.line).then(|| case(table, ulps.fold(0.0, f64::max), &[row, other]))
    });
    let allowed = claims.reciprocal.unwrap_or(0.0);
    let verdict = worst(Property::Reciprocal, Unit::Ulps, claims.reciprocal.is_some(), allowed, both_ways);
    match verdict.outcome {
        Outcome::NotChecked(_) => not_checked(Property::Reciprocal, "no sample is there both ways round"),
        _ => verdict,
    }
}

/// A ring needs so many azimuths, and a view so many rings: of fewer the sum is no integral.
const LEAST: usize = 8;
/// Two sums, of all samples and of every other ring, that differ by more say nothing.
const USELESS: f64 = 0.1;

/// An albedo of the samples of a view, and how much that of every other ring differs.
struct Sum {
    value: Value,
    error: f64,
}

fn energy(table: &Table, claims: &Claims) -> Verdict {
    let mut views: BTreeMap<Key, Vec<&Row>> = BTreeMap::new();
    for row in table.rows() {
        let [.., vz] = row.pair;
        if vz > 0.0 {
            views.entry(keys(&row.pair).1).or_default().push(row);
        }
    }
    let sums = views.values().filter_map(|rows| Some((rows, albedo(rows)?)));
    let sums: Vec<(&Vec<&Row>, Sum)> = sums.filter(|(_, sum)| sum.error < USELESS).collect();
    let gain = |sum: &Sum| sum.value.into_iter().fold(f64::NEG_INFINITY, f64::max) - 1.0;
    let cases = sums.iter().filter_map(|(rows, sum)| {
        let row = rows.first()?;
        let what = format!("E towards v (±{:.0e})", sum.error);
        let [_, _, _, x, y, z] = row.pair;
        let pair = [f64::NAN, f64::NAN, f64::NAN, x, y, z];
        let observed = vec![Observed { what, pair, value: sum.value }];
        // Only what is beyond the error is a gain.
        let size = gain(sum) - sum.error;
        Some(Case { pair, precision: table.precision(), size, observed, line: Some(row.line) })
    });
    let verdict = worst(Property::Energy, Unit::Albedo, claims.energy, 0.0, cases);
    match verdict.outcome {
        Outcome::NotChecked(_) => not_checked(
            Property::Energy,
            "it takes a view with 8 rings of light directions, each of one cosine with 8 azimuths all around",
        ),
        _ => verdict,
    }
}

/// The albedo towards the view of these samples, if they are a grid of `l`.
fn albedo(rows: &[&Row]) -> Option<Sum> {
    let mut rings: BTreeMap<i32, Vec<(f64, f64, Value)>> = BTreeMap::new();
    for row in rows {
        let [x, y, z, ..] = row.pair;
        if z > 0.0 {
            rings.entry(libm::round(z * 1e5) as i32).or_default().push((libm::atan2(y, x), z, row.value));
        }
    }
    let means: Option<Vec<(f64, Value)>> = rings.into_values().map(mean_of_ring).collect();
    let means = means.filter(|means| means.len() >= LEAST)?;
    let coarse: Vec<(f64, Value)> = means.iter().rev().step_by(2).rev().copied().collect();
    let (value, other) = (over_cosines(&means), over_cosines(&coarse));
    let error = std::iter::zip(value, other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    (value.iter().all(|x| x.is_finite())).then_some(Sum { value, error })
}

/// The mean over the azimuth; at the pole one sample is a ring.
fn mean_of_ring(mut samples: Vec<(f64, f64, Value)>) -> Option<(f64, Value)> {
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (&(first, cos, value), &(last, ..)) = (samples.first()?, samples.last()?);
    if cos > 1.0 - 1e-5 {
        return Some((cos, value));
    }
    let next = samples.iter().skip(1).chain(samples.first());
    let mut mean = [0.0; 3];
    for (index, (a, b)) in samples.iter().zip(next).enumerate() {
        let gap = if index + 1 == samples.len() { first + TAU - last } else { b.0 - a.0 };
        // A quarter of the circle without a sample is not all around.
        if gap > TAU / 4.0 {
            return None;
        }
        for (sum, (x, y)) in mean.iter_mut().zip(std::iter::zip(a.2, b.2)) {
            *sum += 0.5 * (x + y) * gap / TAU;
        }
    }
    (samples.len() >= LEAST).then_some((cos, mean))
}

/// `2π ∫ f cos θ d(cos θ)`, `f` linear between the rings and constant beyond the first and the last.
fn over_cosines(means: &[(f64, Value)]) -> Value {
    let ends = |(first, last): (&(f64, Value), &(f64, Value))| [(0.0, first.1), (1.0, last.1)];
    let Some([start, end]) = means.first().zip(means.last()).map(ends) else { return [f64::NAN; 3] };
    let points: Vec<(f64, Value)> = std::iter::once(start).chain(means.iter().copied()).chain([end]).collect();
    let mut sum = [0.0; 3];
    for (a, b) in points.iter().zip(points.iter().skip(1)) {
        let step = b.0 - a.0;
        for (sum, (f, g)) in sum.iter_mut().zip(std::iter::zip(a.1, b.1)) {
            // Exact for linear f: ∫ (f + (g − f) t)(a + s t) s dt.
            *sum += TAU * step * (a.0 * (f + g) / 2.0 + step * (f / 6.0 + g / 3.0));
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write as _;

    /// Rings of light directions for a view along the normal and one at 37 degrees.
    fn grid(f: impl Fn([f64; 3], [f64; 3]) -> f64) -> Table {
        let mut text = String::new();
        for v in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]] {
            for ring in 0..40 {
                let z = (f64::from(ring) + 0.5) / 40.0;
                let r = (1.0 - z * z).sqrt();
                for side in 0..32 {
                    let (s, c) = (f64::from(side) * TAU / 32.0).sin_cos();
                    let l = [r * c, r * s, z];
                    let f = f(l, v);
                    writeln!(
                        text,
                        "{:?},{:?},{:?},{:?},{:?},{:?},{f:?},{f:?},{f:?}",
                        l[0], l[1], l[2], v[0], v[1], v[2]
                    )
                    .unwrap();
                }
            }
        }
        Table::parse("grid.csv", &text).unwrap()
    }

    #[test]
    fn the_albedo_of_a_dense_table_is_found() {
        let report = verify_table(&grid(|_, _| 0.8 / std::f64::consts::PI), &Claims::OTHERS);
        assert!(report.holds(), "{report}");
        let energy = report.verdict(Property::Energy).unwrap();
        assert_eq!((energy.tried, &energy.outcome), (2, &Outcome::Holds));
        assert!((energy.worst.as_ref().unwrap().observed[0].value[0] - 0.8).abs() < 1e-9);
    }

    #[test]
    fn a_gain_is_found_and_scattered_samples_are_not_integrated() {
        let report = verify_table(&grid(|_, _| 0.5), &Claims::OTHERS);
        let energy = report.verdict(Property::Energy).unwrap();
        assert_eq!(energy.outcome, Outcome::Fails);
        let few = Table::parse("few.csv", "0,0,1,0,0,1,1,1,1").unwrap();
        let report = verify_table(&few, &Claims::OTHERS);
        assert!(
            matches!(&report.verdict(Property::Energy).unwrap().outcome, Outcome::NotChecked(why) if why.contains("rings"))
        );
        assert!(matches!(report.verdict(Property::Reciprocal).unwrap().outcome, Outcome::NotChecked(_)));
    }

    #[test]
    fn wrong_samples_are_named_by_their_lines() {
        let text = "0,0,1,0,0,1,1,1,1\n0,0,1,0.6,0,0.8,-2,1,1\n0,0,-1,0,0,1,0,0,3\n0.6,0,0.8,0,0,1,nan,1,1\n";
        let report = verify_table(&Table::parse("t.csv", text).unwrap(), &Claims::OTHERS);
        let line = |property| report.verdict(property).unwrap().worst.as_ref().unwrap().line;
        assert_eq!(line(Property::Finite), Some(4));
        assert_eq!(line(Property::NonNegative), Some(2));
        assert_eq!(line(Property::BelowHorizon), Some(3));
        assert_eq!(line(Property::Reciprocal), Some(2));
    }
}
