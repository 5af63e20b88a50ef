//! The properties that take more than one subject: agreement with a reference, and growth with the albedo of a family.

use super::check::{Check, Finding};
use super::place::Place;
use super::report::{Property, Unit};
use crate::subject::{Pair, Precision, Subject, SubjectError, Value};

/// Values below this, in sr⁻¹, are not compared relatively: a factor of theirs may have lost its digits in `f32`.
const DARK: f64 = 1e-30;

/// One subject against another.
pub(crate) struct Agreement<'a> {
    pub(crate) subject: &'a dyn Subject,
    pub(crate) reference: &'a dyn Subject,
    /// The relative difference that is allowed.
    pub(crate) tolerance: f64,
}

impl Check for Agreement<'_> {
    fn property(&self) -> Property {
        Property::Agreement
    }

    fn unit(&self) -> Unit {
        Unit::Relative
    }

    /// Both are asked for the same directions, so these have to be numbers of the narrower type.
    fn precision(&self) -> Precision {
        match (self.subject.precision(), self.reference.precision()) {
            (Precision::Double, Precision::Double) => Precision::Double,
            _ => Precision::Single,
        }
    }

    fn claimed(&self) -> bool {
        true
    }

    fn pairs(&self, place: Place, ask: &mut Vec<Pair>) {
        let pair = place.pair(self.precision());
        ask.extend([pair, pair]);
    }

    fn count(&self) -> usize {
        2
    }

    fn answers(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        let once: Vec<Pair> = pairs.iter().step_by(2).copied().collect();
        let (ours, theirs) = (self.subject.eval(&once)?, self.reference.eval(&once)?);
        Ok(std::iter::zip(ours, theirs).flat_map(|(a, b)| [a, b]).collect())
    }

    fn judge(&self, _: &[Pair], values: &[Value]) -> Option<Finding> {
        let [ours, theirs] = values else { return None };
        let size = std::iter::zip(ours, theirs).map(|(a, b)| relative(*a, *b)).fold(0.0, f64::max);
        Some(Finding { size, fails: size > self.tolerance, shown_by: (0, 1) })
    }

    fn label(&self, index: usize) -> String {
        if index == 0 { "f" } else { "reference" }.to_owned()
    }

    fn line(&self, index: usize) -> Option<usize> {
        self.subject.line(index)
    }
}

/// `|a − b|` as a part of the larger; infinite where only one of them is a number.
fn relative(a: f64, b: f64) -> f64 {
    let larger = a.abs().max(b.abs());
    if a == b || (a.is_nan() && b.is_nan()) || larger < DARK {
        0.0
    } else if a.is_finite() && b.is_finite() {
        (a - b).abs() / larger
    } else {
        f64::INFINITY
    }
}

/// The members of a family, by growing albedo.
pub(crate) struct Monotone<'a> {
    pub(crate) members: &'a [(f64, Box<dyn Subject + 'a>)],
}

/// A smaller value for a larger albedo is a failure from so many ulps on: the factors of two members round apart.
const ROUNDING: f64 = 16.0;

impl Check for Monotone<'_> {
    fn property(&self) -> Property {
        Property::Monotone
    }

    fn unit(&self) -> Unit {
        Unit::Ulps
    }

    fn precision(&self) -> Precision {
        let single = self.members.iter().any(|(_, member)| member.precision() == Precision::Single);
        if single { Precision::Single } else { Precision::Double }
    }

    fn claimed(&self) -> bool {
        true
    }

    fn pairs(&self, place: Place, ask: &mut Vec<Pair>) {
        let pair = place.pair(self.precision());
        ask.extend(self.members.iter().map(|_| pair));
    }

    fn count(&self) -> usize {
        self.members.len()
    }

    fn answers(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        let count = self.count();
        let once: Vec<Pair> = pairs.iter().step_by(count.max(1)).copied().collect();
        let mut values = vec![[f64::NAN; 3]; pairs.len()];
        for (index, (_, member)) in self.members.iter().enumerate() {
            let own = member.eval(&once)?;
            for (slot, value) in values.iter_mut().skip(index).step_by(count.max(1)).zip(own) {
                *slot = value;
            }
        }
        Ok(values)
    }

    fn judge(&self, _: &[Pair], values: &[Value]) -> Option<Finding> {
        let precision = self.precision();
        let mut found = Finding { size: 0.0, fails: false, shown_by: (0, 0) };
        for (i, (less, more)) in values.iter().zip(values.iter().skip(1)).enumerate() {
            for (&a, &b) in std::iter::zip(less, more) {
                // A NaN is for "finite" to tell.
                let size = if a > b { precision.ulps_between(a, b) } else { 0.0 };
                if size > found.size {
                    found = Finding { size, fails: size > ROUNDING, shown_by: (i, i + 1) };
                }
            }
        }
        Some(found)
    }

    fn label(&self, index: usize) -> String {
        self.members.get(index).map_or_else(String::new, |(albedo, _)| format!("f with albedo {albedo}"))
    }
}
