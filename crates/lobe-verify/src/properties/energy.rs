//! Energy: does it reflect more than arrives, and how much is lost?
//!
//! `E(v) = ∫ f(l, v) (n·l) dω_l`, what reaches `v` of a white world, and the same with `l` and `v` exchanged, what
//! becomes of a beam; for a lobe that is not reciprocal these are two things.

use super::claims::Claims;
use super::inputs::Effort;
use super::place::{Tilt, Toward, exchanged};
use super::report::{Case, Observed, Outcome, Property, Unit, Verdict};
use crate::subject::{Pair, Precision, Subject, SubjectError, Value, catch};
use lobe::{Brdf, Rgb, Vec3};
use lobe_energy::{Albedo, Exchanged, directional_albedo_to};
use rayon::prelude::*;
use std::cell::RefCell;

/// The views, in degrees from the normal. The first few are those of a quick effort.
const VIEWS: [f64; 12] = [0.0, 60.0, 85.0, 30.0, 15.0, 45.0, 70.0, 75.0, 80.0, 88.0, 89.0, 89.9];
/// A gain is one from here on: a lobe that reflects all light may be off by the rounding of its values, 1e-5 in `f32`.
fn rounding(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 2e-5,
        Precision::Double => 1e-6,
    }
}
/// An error of the quadrature above which an albedo says nothing.
const USELESS: f64 = 0.1;

/// The albedo of one view in one sense.
struct Found {
    view: Toward,
    exchanged: bool,
    albedo: Albedo,
}

impl Found {
    fn most(&self) -> f64 {
        let Rgb { r, g, b } = self.albedo.value;
        r.max(g).max(b)
    }

    fn least(&self) -> f64 {
        let Rgb { r, g, b } = self.albedo.value;
        r.min(g).min(b)
    }

    fn known(&self) -> bool {
        let Rgb { r, g, b } = self.albedo.value;
        (r + g + b).is_finite() && self.albedo.error < USELESS
    }

    /// What of the gain is beyond doubt.
    fn sure_gain(&self, precision: Precision) -> f64 {
        self.most() - 1.0 - self.albedo.error - rounding(precision)
    }

    fn case(&self, precision: Precision) -> Case {
        let [x, y, z] = self.view.unit();
        let nan = f64::NAN;
        // The other direction is integrated over.
        let pair = if self.exchanged { [x, y, z, nan, nan, nan] } else { [nan, nan, nan, x, y, z] };
        let what = if self.exchanged { "E of the beam from l" } else { "E towards v" };
        let what = format!("{what} (±{:.0e})", self.albedo.error);
        let observed = vec![Observed { what, pair, value: self.albedo.value.into() }];
        Case { pair, precision, size: self.most() - 1.0, observed, line: None }
    }
}

/// Whether it gains energy; the remark tells what is lost.
pub(crate) fn energy(subject: &dyn Subject, claims: &Claims, effort: Effort) -> Verdict {
    let outcome = if claims.energy { Outcome::Holds } else { Outcome::Measured };
    let mut verdict = Verdict::new(Property::Energy, Unit::Albedo, outcome);
    let precision = subject.precision();
    // An isotropic lobe is the same from every side.
    let sides: &[f64] = if claims.isotropic.is_some() { &[0.0] } else { &[0.0, 90.0, 37.0] };
    let tasks: Vec<(f64, f64, bool)> = VIEWS
        .iter()
        .take(effort.views)
        .flat_map(|degrees| sides.iter().map(move |side| (*degrees, *side)))
        .filter(|(degrees, side)| *degrees > 0.0 || *side == 0.0)
        .flat_map(|(degrees, side)| [(degrees, side, false), (degrees, side, true)])
        .collect();
    let found: Result<Vec<Found>, SubjectError> = tasks
        .into_par_iter()
        .map(|(degrees, side, exchanged)| {
            let view = Toward::new(Tilt::Cos(libm::cos(degrees.to_radians())), side);
            let albedo = albedo(subject, view.unit(), exchanged, effort.agreement)?;
            Ok(Found { view, exchanged, albedo })
        })
        .collect();
    let found = match found {
        Ok(found) => found,
        Err(error) => {
            verdict.outcome = Outcome::Broken(error);
            return verdict;
        }
    };
    let known: Vec<&Found> = found.iter().filter(|found| found.known()).collect();
    verdict.tried = known.len();
    // Of equal albedos the first, whose view is the simplest; the others differ by rounding alone.
    let by = |key: &dyn Fn(&Found) -> f64| {
        let key = |found: &Found| libm::round(key(found) * 1e6);
        known.iter().rev().copied().max_by(|a, b| key(a).total_cmp(&key(b)))
    };
    let (Some(most), Some(least)) = (by(&Found::most), by(&|found| -found.least())) else {
        let reason = "no albedo is a number that two quadratures agree on to 0.1";
        verdict.outcome = Outcome::NotChecked(reason.to_owned());
        return verdict;
    };
    verdict.size = (most.most() - 1.0).max(0.0);
    verdict.worst = Some(most.case(precision));
    verdict.remark = remark(least, found.len() - known.len());
    // The views are simple, and the simplest come first; a gain that is beyond doubt.
    if let Some(gains) = known.iter().find(|found| found.sure_gain(precision) > 0.0) {
        verdict.simplest = Some(gains.case(precision));
        if claims.energy {
            verdict.outcome = Outcome::Fails;
        }
    } else if verdict.size <= rounding(precision) + most.albedo.error {
        // Within the error of the quadrature, it is no gain at all.
        verdict.size = 0.0;
    }
    verdict
}

fn remark(least: &Found, unknown: usize) -> String {
    let degrees = libm::acos(least.view.cos().clamp(-1.0, 1.0)).to_degrees();
    let sense = if least.exchanged { "of the light from" } else { "of a white world, seen from" };
    let mut text = format!("loses at most {:.4} {sense} {degrees:.1}°", (1.0 - least.least()).max(0.0));
    if unknown > 0 {
        text += &format!("; {unknown} albedos left out, whose quadratures do not agree to {USELESS}");
    }
    text
}

/// The albedo towards `view`, or of the beam from there.
fn albedo(subject: &dyn Subject, view: [f64; 3], exchanged: bool, agreement: f64) -> Result<Albedo, SubjectError> {
    let v = Vec3::from(view);
    let Some(brdf) = subject.pointwise() else { return in_one_batch(subject, v, exchanged) };
    let found = catch(|| {
        if exchanged {
            directional_albedo_to(agreement, &Exchanged(&*brdf), v)
        } else {
            directional_albedo_to(agreement, &*brdf, v)
        }
    });
    let [x, y, z] = view;
    let nan = f64::NAN;
    found.map_err(|message| SubjectError::Panicked { pair: [nan, nan, nan, x, y, z], message })
}

/// The albedo of a subject that is asked for all points at once.
///
/// The points of the quadrature do not depend on the values as long as any agreement will do. So it is run twice: to
/// write down what it asks for, and to give it the answers. It then compares two resolutions and goes no further.
fn in_one_batch(subject: &dyn Subject, v: Vec3<f64>, in_exchange: bool) -> Result<Albedo, SubjectError> {
    let asked = Asked(RefCell::new(Vec::new()));
    directional_albedo_to(f64::INFINITY, &asked, v);
    let pairs = asked.0.into_inner();
    let turned = |pair: &Pair| if in_exchange { exchanged(pair) } else { *pair };
    let values = subject.eval(&pairs.iter().map(turned).collect::<Vec<_>>())?;
    let answers = Answers(RefCell::new(pairs.into_iter().zip(values).collect::<Vec<_>>().into_iter()));
    Ok(directional_albedo_to(f64::INFINITY, &answers, v))
}

fn pair_of(l: Vec3<f64>, v: Vec3<f64>) -> Pair {
    [l.x, l.y, l.z, v.x, v.y, v.z]
}

/// Writes down what it is asked for.
struct Asked(RefCell<Vec<Pair>>);

impl Brdf<f64> for Asked {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.0.borrow_mut().push(pair_of(l, v));
        Rgb::splat(0.0)
    }
}

/// Gives the answers in the order in which they were asked for.
struct Answers(RefCell<std::vec::IntoIter<(Pair, Value)>>);

impl Brdf<f64> for Answers {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        match self.0.borrow_mut().next() {
            Some((pair, value)) if pair == pair_of(l, v) => value.into(),
            // Another question than the first time: an albedo of it would be a plausible number that is wrong.
            _ => Rgb::splat(f64::NAN),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subject::{InDouble, OfFn};
    use lobe::{BlinnPhong, Shininess};

    #[test]
    fn a_batch_gives_the_same_albedo_as_point_by_point() {
        let lobe = BlinnPhong::new(Rgb::splat(0.7), Shininess(300.0));
        let closure = OfFn::new(|l: [f64; 3], v: [f64; 3]| lobe.eval(l.into(), v.into()).into());
        for cos in [1.0, 0.5, 0.02] {
            for exchanged in [false, true] {
                let view = Toward::new(Tilt::Cos(cos), 12.0).unit();
                let a = albedo(&InDouble(&lobe), view, exchanged, 1e-6).unwrap();
                let b = albedo(&closure, view, exchanged, 1e-6).unwrap();
                assert!((a.value.g - b.value.g).abs() <= a.error + b.error, "{cos}: {a:?} {b:?}");
                assert!(b.error < 1e-3, "{cos}: {b:?}");
            }
        }
    }
}
