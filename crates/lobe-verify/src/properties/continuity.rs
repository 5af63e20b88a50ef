//! Continuity: is there a jump on the way to the horizon, across the pole or around the azimuth?
//!
//! Along a path of directions `f cos θ` is taken at some points. Of the steps with the largest differences each is cut
//! into sixteen, and of these the largest are cut again, until the number type has no direction in between. A lobe may
//! be as sharp as it likes: the difference across a small enough step vanishes, even where the slope is infinite. That
//! across a jump stays.

use super::claims::Claims;
use super::inputs::Effort;
use super::place::{Place, Tilt, Toward};
use super::report::{Case, Observed, Outcome, Property, Unit, Verdict};
use crate::subject::{Pair, Precision, Subject, SubjectError, Value};

/// Into how many pieces a step is cut.
const PIECES: usize = 16;
/// How many steps of a path are followed: a jump that is smaller than the steps of a sharp lobe shows after one cut or
/// two, when those have become smaller.
const FOLLOWED: usize = 16;
/// A path is cut until its pieces are this part of it. Pieces below the grain of the number type would not become
/// smaller, and look like jumps.
fn smallest_piece(precision: Precision) -> f64 {
    match precision {
        Precision::Single => libm::ldexp(1.0, -24),
        Precision::Double => libm::ldexp(1.0, -48),
    }
}
/// So many cuts before, a step is looked at to see whether what is left of it has become smaller: 1/65536 of its length
/// in `f32`, 2⁻³² in `f64`.
fn cuts_before(precision: Precision) -> usize {
    match precision {
        Precision::Single => 4,
        Precision::Double => HISTORY,
    }
}
/// How many cuts are remembered.
const HISTORY: usize = 8;
/// The part of the values' range on that longer step that a difference has to be to be a jump. Of a slope it would be
/// 1/65536, of a root, as that of `cos^q` with `q` = ½ at its end, 1/256; of a jump all, if nothing else is as steep
/// there.
const LEFT: f64 = 0.25;
/// Differences are taken relative to the larger value, or to this in sr⁻¹ where both are darker.
///
/// A cosine next to 0 comes in steps of 6e-8 in `f32` and of 1e-16 in `f64`; its root, as in `cos^q` with `q` = ½, in
/// steps of 1e-4 and 1e-8. With this a jump from black is one from 5e-4 on, and from 1e-7.
const DARK: f64 = 1e-2;

/// From which relative difference between neighbouring directions on it is a jump.
///
/// In `f32` neighbours are 1.2e-7 apart and `h` moves by five times as much between directions of cosine 0.1; a GGX
/// lobe of `α` = 1e-4, whose logarithm has a slope of up to `2/α`, changes by 1.2 % between them.
fn smallest_jump(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 0.05,
        Precision::Double => 1e-5,
    }
}

/// The way a direction goes while the other rests.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    /// From a cosine of 0.9 to the smallest, whose logarithm is given.
    ToGrazing { azimuth: f64, least: f64 },
    /// Through the normal and down on the other side.
    AcrossPole { azimuth: f64 },
    /// Around the normal.
    Around { tilt: Tilt },
}

impl Way {
    /// The direction for `t` in `[0, 1]`.
    fn at(self, t: f64) -> Toward {
        match self {
            Self::ToGrazing { azimuth, least } => {
                Toward::new(Tilt::Cos(0.9 * libm::pow(10.0, (least - libm::log10(0.9)) * t)), azimuth)
            }
            Self::AcrossPole { azimuth } => {
                // From −0.9 to 0.9; the direction at the pole itself has the azimuth of one side.
                let sin = 1.8 * (t - 0.5);
                Toward::new(Tilt::Sin(sin.abs()), if sin < 0.0 { azimuth + 180.0 } else { azimuth })
            }
            // A little more than once, so that 0 and 360 are inside.
            Self::Around { tilt } => Toward::new(tilt, 400.0 * t - 20.0),
        }
    }

    /// Where a jump is to be expected, if there is one: at the pole, and where an azimuth begins again.
    fn suspicious(self) -> &'static [f64] {
        match self {
            Self::ToGrazing { .. } => &[],
            Self::AcrossPole { .. } => &[0.5],
            Self::Around { .. } => &[0.05, 0.5, 0.95],
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Path {
    moving: Way,
    rest: Toward,
    /// Whether it is `l` that moves.
    light: bool,
}

impl Path {
    fn pair(&self, t: f64, precision: Precision) -> Pair {
        let d = self.moving.at(t);
        let place = if self.light { Place { l: d, v: self.rest } } else { Place { l: self.rest, v: d } };
        place.pair(precision)
    }
}

/// The paths, the simplest first.
fn paths(precision: Precision, claims: &Claims, all: bool) -> Vec<Path> {
    // The resting direction keeps |l + v| so large that the halfway direction is not made of rounding.
    let rests: &[f64] = match precision {
        Precision::Single => &[0.5, 1.0, 0.9, 0.1],
        Precision::Double => &[0.5, 1.0, 0.9, 0.1, 1e-3],
    };
    let (rests, azimuths): (&[f64], &[f64]) = if all {
        (rests, &[0.0, 180.0, 90.0, 37.0, 143.0, 179.0])
    } else {
        (rests.get(..3).unwrap_or(rests), &[0.0, 180.0, 37.0])
    };
    let tilts = [Tilt::Cos(0.5), Tilt::Cos(0.9), Tilt::Cos(0.1), Tilt::Sin(1e-4)];
    let least = claims.grazing.max(f64::MIN_POSITIVE).log10();
    let mut paths = Vec::new();
    for &cos in rests {
        // Along the tangent; and next to where azimuths begin again, 0 and 180 degrees: a lobe that falls off with the
        // difference of azimuths shows a jump only near itself.
        for rest in [0.0, 20.0, 160.0].map(|azimuth| Toward::new(Tilt::Cos(cos), azimuth)) {
            let to_grazing = azimuths.iter().map(|&a| Way::ToGrazing { azimuth: rest.azimuth + a, least });
            let across = azimuths.iter().map(|&a| Way::AcrossPole { azimuth: rest.azimuth + a });
            let around = tilts.iter().map(|&tilt| Way::Around { tilt });
            for moving in to_grazing.chain(across).chain(around) {
                paths.extend([true, false].map(|light| Path { moving, rest, light }));
            }
        }
    }
    paths
}

/// A piece of a path and the values at its ends.
#[derive(Clone, Copy, Debug)]
struct Step {
    from: (f64, Value),
    to: (f64, Value),
    /// The ranges of the values on the steps that it is a piece of, from the last cut to the first that is remembered.
    before: [f64; HISTORY],
}

impl Step {
    /// The relative difference; 0 where there is a value that is none, which is for "finite" to tell.
    fn size(&self) -> f64 {
        self.largest(|a, b| (a - b).abs() / a.abs().max(b.abs()).max(DARK))
    }

    /// The difference.
    fn difference(&self) -> f64 {
        self.largest(|a, b| (a - b).abs())
    }

    fn largest(&self, of: impl Fn(f64, f64) -> f64) -> f64 {
        let sizes = std::iter::zip(self.from.1, self.to.1).map(|(a, b)| of(a, b));
        sizes.filter(|size| size.is_finite()).fold(0.0, f64::max)
    }

    /// Whether the difference has stayed while the step became smaller.
    fn stays(&self, cuts: usize) -> bool {
        self.before.get(cuts - 1).is_some_and(|before| self.difference() > LEFT * before)
    }

    fn middle_points(&self) -> [f64; PIECES - 1] {
        let (a, b) = (self.from.0, self.to.0);
        std::array::from_fn(|i| a + (b - a) * ((i + 1) as f64 / PIECES as f64))
    }

    /// The pieces, from the values at the middle points.
    fn cut(&self, middle: impl Iterator<Item = Value>) -> Vec<Self> {
        let inner = self.middle_points().into_iter().zip(middle);
        let known: Vec<(f64, Value)> = std::iter::once(self.from).chain(inner).chain([self.to]).collect();
        let mut before = self.before;
        before.rotate_right(1);
        if let Some(last) = before.first_mut() {
            *last = range(&known);
        }
        neighbours(&known, before).collect()
    }
}

/// The largest difference between any two of these values.
fn range(known: &[(f64, Value)]) -> f64 {
    let of_channel = |channel: usize| {
        let values = known.iter().filter_map(|(_, value)| value.get(channel).copied()).filter(|x| x.is_finite());
        let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        (most - least).max(0.0)
    };
    (0..3).map(of_channel).fold(0.0, f64::max)
}

/// The largest jump on each path, if there is one.
fn largest_jumps(subject: &dyn Subject, paths: &[Path], steps: usize) -> Result<Vec<Option<Step>>, SubjectError> {
    let precision = subject.precision();
    let even: Vec<f64> = (0..=steps).map(|i| i as f64 / steps as f64).collect();
    let mut piece = 1.0 / steps as f64;
    let starts: Vec<Vec<f64>> = paths
        .iter()
        .map(|path| {
            // A step of its own, so that a jump there is followed however small it is.
            let beside = path.moving.suspicious().iter().flat_map(|t| [t - 0.25 * piece, t + 0.25 * piece]);
            let mut points: Vec<f64> = even.iter().copied().filter(|t| !path.moving.suspicious().contains(t)).collect();
            points.extend(beside);
            points.sort_by(f64::total_cmp);
            points
        })
        .collect();
    let mut values = ask(subject, paths, &starts, precision)?.into_iter();
    let mut followed: Vec<Vec<Step>> = Vec::with_capacity(paths.len());
    for (path, points) in paths.iter().zip(&starts) {
        let known: Vec<(f64, Value)> = points.iter().copied().zip(values.by_ref()).collect();
        let all = neighbours(&known, [f64::INFINITY; HISTORY]);
        let around = |step: &Step| path.moving.suspicious().iter().any(|t| step.from.0 < *t && *t < step.to.0);
        let (suspicious, others): (Vec<Step>, Vec<Step>) = all.partition(around);
        followed.push(suspicious.into_iter().chain(the_largest(others)).collect());
    }
    while piece > smallest_piece(precision) {
        piece /= PIECES as f64;
        let points: Vec<Vec<f64>> =
            followed.iter().map(|steps| steps.iter().flat_map(Step::middle_points).collect()).collect();
        let mut values = ask(subject, paths, &points, precision)?.into_iter();
        for steps in &mut followed {
            let mut pieces: Vec<Step> = Vec::new();
            for step in steps.iter() {
                pieces.extend(step.cut(values.by_ref().take(PIECES - 1)));
            }
            *steps = the_largest(pieces);
        }
    }
    let cuts = cuts_before(precision);
    Ok(followed.into_iter().map(|steps| steps.into_iter().find(|step| step.stays(cuts))).collect())
}

fn ask(
    subject: &dyn Subject,
    paths: &[Path],
    points: &[Vec<f64>],
    precision: Precision,
) -> Result<Vec<Value>, SubjectError> {
    let of_path =
        |(path, points): (&Path, &Vec<f64>)| points.iter().map(|t| path.pair(*t, precision)).collect::<Vec<_>>();
    let pairs: Vec<Pair> = paths.iter().zip(points).flat_map(of_path).collect();
    subject.eval_cos(&pairs)
}

fn neighbours(known: &[(f64, Value)], before: [f64; HISTORY]) -> impl Iterator<Item = Step> {
    known.iter().zip(known.iter().skip(1)).map(move |(from, to)| Step { from: *from, to: *to, before })
}

fn the_largest(mut steps: Vec<Step>) -> Vec<Step> {
    steps.sort_by(|a, b| b.size().total_cmp(&a.size()));
    steps.truncate(FOLLOWED);
    steps
}

/// Whether `f cos θ` jumps anywhere above the horizon.
pub(crate) fn continuity(subject: &dyn Subject, claims: &Claims, effort: Effort) -> Verdict {
    let outcome = if claims.continuous { Outcome::Holds } else { Outcome::Measured };
    let mut verdict = Verdict::new(Property::Continuous, Unit::Relative, outcome);
    let precision = subject.precision();
    let paths = paths(precision, claims, effort.steps > Effort::QUICK.steps);
    let found = match largest_jumps(subject, &paths, effort.steps) {
        Ok(found) => found,
        Err(error) => {
            verdict.outcome = Outcome::Broken(error);
            return verdict;
        }
    };
    verdict.tried = paths.len();
    verdict.remark = format!("between neighbouring directions on {} paths", paths.len());
    let case = |path: &Path, step: &Step| {
        let observed = [step.from, step.to].map(|(t, value)| Observed {
            what: "f cos".to_owned(),
            pair: path.pair(t, precision),
            value,
        });
        let pair = path.pair(step.from.0, precision);
        Case { pair, precision, size: step.size(), observed: observed.to_vec(), line: None }
    };
    for (path, step) in paths.iter().zip(&found) {
        let Some(step) = step else { continue };
        if verdict.worst.as_ref().is_none_or(|worst| step.size() > worst.size) {
            verdict.worst = Some(case(path, step));
            verdict.size = step.size();
        }
        // The paths are simple, and the simplest come first.
        if step.size() > smallest_jump(precision) && verdict.simplest.is_none() {
            verdict.simplest = Some(case(path, step));
            if claims.continuous {
                verdict.outcome = Outcome::Fails;
            }
        }
    }
    verdict
}
