//! The course of a check: ask at all places, judge the answers, keep the worst, shrink it.

use super::place::Place;
use super::report::{Case, Observed, Outcome, Property, Unit, Verdict};
use super::shrink::shrink;
use crate::subject::{Pair, Precision, SubjectError, Value};

/// What the values at a place say.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Finding {
    /// The size of the defect.
    pub(crate) size: f64,
    /// Whether it is more than the claim allows.
    pub(crate) fails: bool,
    /// Which of the pairs show it; often the same one twice.
    pub(crate) shown_by: (usize, usize),
}

/// A property that can be judged at one place, from the values of a few pairs.
pub(crate) trait Check: Sync {
    fn property(&self) -> Property;
    fn unit(&self) -> Unit;
    fn precision(&self) -> Precision;
    /// Whether it is claimed: only then a failure counts.
    fn claimed(&self) -> bool;
    /// The pairs that have to be asked for, the same number at each place.
    fn pairs(&self, place: Place, ask: &mut Vec<Pair>);
    /// How many these are.
    fn count(&self) -> usize;
    /// The values of pairs, of one place after the other.
    fn answers(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError>;
    /// What those of one place say; `None` where there is nothing to be said.
    fn judge(&self, pairs: &[Pair], values: &[Value]) -> Option<Finding>;
    /// What the value of the pair with this index is called.
    fn label(&self, index: usize) -> String;
    /// The line on which a program has read the pair with this index of a batch.
    fn line(&self, _index: usize) -> Option<usize> {
        None
    }
    /// A simpler input has to keep this part of the worst defect. Without it a plain fault would be shrunk to one of
    /// rounding.
    fn keep(&self) -> f64 {
        0.1
    }
}

/// So many places are asked for at once: a program is started for each batch, and its answers fit in the memory.
const BATCH: usize = 8192;

/// The verdict of a check over these places.
pub(crate) fn run(check: &dyn Check, places: &[Place]) -> Verdict {
    let outcome = if check.claimed() { Outcome::Holds } else { Outcome::Measured };
    let mut verdict = Verdict::new(check.property(), check.unit(), outcome);
    let mut worst: Option<(Finding, Place)> = None;
    for batch in places.chunks(BATCH) {
        let (pairs, values) = match ask(check, batch) {
            Ok(answered) => answered,
            Err(error) => {
                verdict.outcome = Outcome::Broken(simplest_panic(check, batch, error));
                return verdict;
            }
        };
        for (index, place) in batch.iter().enumerate() {
            let Some((finding, pairs, values)) = judge(check, index, &pairs, &values) else { continue };
            verdict.tried += 1;
            let rank = |finding: &Finding| (finding.fails, finding.size);
            if worst.as_ref().is_none_or(|(known, _)| rank(known) < rank(&finding)) {
                verdict.worst = Some(case(check, &finding, pairs, values, check.line(index)));
                worst = Some((finding, *place));
            }
        }
    }
    if let Some((finding, place)) = worst {
        verdict.size = finding.size;
        if finding.fails {
            verdict.simplest = simplest(check, finding, place);
            if check.claimed() {
                verdict.outcome = Outcome::Fails;
            }
        }
    }
    if verdict.tried == 0 {
        verdict.outcome = Outcome::NotChecked("none of the inputs says anything about it".to_owned());
    }
    verdict
}

fn ask(check: &dyn Check, places: &[Place]) -> Result<(Vec<Pair>, Vec<Value>), SubjectError> {
    let mut pairs = Vec::with_capacity(places.len() * check.count());
    for place in places {
        check.pairs(*place, &mut pairs);
    }
    let values = check.answers(&pairs)?;
    Ok((pairs, values))
}

type Judged<'a> = (Finding, &'a [Pair], &'a [Value]);

/// What is said of the place with this index of a batch.
fn judge<'a>(check: &dyn Check, index: usize, pairs: &'a [Pair], values: &'a [Value]) -> Option<Judged<'a>> {
    let range = index * check.count()..(index + 1) * check.count();
    let (pairs, values) = (pairs.get(range.clone())?, values.get(range)?);
    Some((check.judge(pairs, values)?, pairs, values))
}

fn case(check: &dyn Check, finding: &Finding, pairs: &[Pair], values: &[Value], line: Option<usize>) -> Case {
    let (first, second) = finding.shown_by;
    let seen = |index: usize| {
        let (pair, value) = (pairs.get(index)?, values.get(index)?);
        Some(Observed { what: check.label(index), pair: *pair, value: *value })
    };
    let mut observed: Vec<Observed> = seen(first).into_iter().collect();
    if second != first {
        observed.extend(seen(second));
    }
    let pair = observed.first().map_or([f64::NAN; 6], |seen| seen.pair);
    Case { pair, precision: check.precision(), size: finding.size, observed, line }
}

fn simplest(check: &dyn Check, worst: Finding, place: Place) -> Option<Case> {
    let still = |finding: &Finding| finding.fails && finding.size >= worst.size * check.keep();
    let fails = |places: &[Place]| match ask(check, places) {
        Ok((pairs, values)) => (0..places.len())
            .map(|index| judge(check, index, &pairs, &values).is_some_and(|(finding, ..)| still(&finding)))
            .collect(),
        // A simpler place may be the one at which the subject breaks; that is for another verdict.
        Err(_) => vec![false; places.len()],
    };
    let place = shrink(place, &fails);
    let (pairs, values) = ask(check, &[place]).ok()?;
    let (finding, pairs, values) = judge(check, 0, &pairs, &values)?;
    Some(case(check, &finding, pairs, values, None))
}

/// A panic at the simplest place that has one; other errors as they are.
fn simplest_panic(check: &dyn Check, places: &[Place], error: SubjectError) -> SubjectError {
    let panic_at = |place: Place| ask(check, &[place]).err().filter(|e| matches!(e, SubjectError::Panicked { .. }));
    let SubjectError::Panicked { pair, .. } = &error else { return error };
    let mut pairs = Vec::new();
    let asks_for_it = |place: &&Place| {
        pairs.clear();
        check.pairs(**place, &mut pairs);
        pairs.iter().any(|asked| asked.map(f64::to_bits) == pair.map(f64::to_bits))
    };
    let Some(place) = places.iter().find(asks_for_it) else { return error };
    let place = shrink(*place, &|places| places.iter().map(|place| panic_at(*place).is_some()).collect());
    panic_at(place).unwrap_or(error)
}
