//! The properties that a few values show: finite, not negative, black below the horizon, reciprocal, isotropic, the
//! form with the cosine, NaN.

use super::check::{Check, Finding};
use super::claims::Claims;
use super::place::{Place, exchanged, length_of_sum};
use super::report::{Property, Unit};
use crate::subject::{Pair, Precision, Subject, SubjectError, Value, times_cos};

/// One property of one subject.
pub(crate) struct Pointwise<'a> {
    pub(crate) subject: &'a dyn Subject,
    pub(crate) claims: Claims,
    pub(crate) property: Property,
}

/// The turns that show whether a lobe is isotropic. By 90 degrees the components only change places, so that nothing is
/// rounded; the other shows what has a fourfold symmetry.
const TURNS: [f64; 3] = [90.0, 180.0, 53.0];
/// The directions of isotropy's pairs are moved by so many ulps of 1, to see what rounding alone does.
const MOVED: f64 = 2.0;
/// Which components are moved: those along the tangent and the bitangent, which a turn changes, both ways.
const MOVES: [(usize, f64); 8] =
    [(0, MOVED), (0, -MOVED), (1, MOVED), (1, -MOVED), (3, MOVED), (3, -MOVED), (4, MOVED), (4, -MOVED)];

impl Pointwise<'_> {
    /// Whether each pair is asked for twice, the second time with the cosine.
    fn asks_both_forms(&self) -> bool {
        use Property::{BelowHorizon, Cosine, Finite, Nan, NonNegative};
        let apart = matches!(self.property, Finite | NonNegative | BelowHorizon | Nan) && self.subject.has_own_cosine();
        apart || self.property == Cosine
    }

    fn ulps(&self, a: Value, b: Value) -> f64 {
        let precision = self.subject.precision();
        std::iter::zip(a, b).map(|(a, b)| precision.ulps_between(a, b)).fold(0.0, f64::max)
    }

    fn isotropy(&self, pairs: &[Pair], values: &[Value]) -> Option<Finding> {
        let precision = self.subject.precision();
        let (first, rest) = values.split_first()?;
        let (turned, moved) = rest.split_at_checked(TURNS.len())?;
        // Of nearly opposite directions the halfway direction is made of rounding: a lobe of width 1e-4 sees it move by
        // a tenth of its width where |l + v| is 6e-3 in `f32`.
        let unsure = 1e5 * precision.ulp(1.0);
        if pairs.first().is_none_or(|pair| length_of_sum(pair) < unsure) {
            return None;
        }
        let mut found = Finding { size: 0.0, fails: false, shown_by: (0, 0) };
        for (index, value) in turned.iter().enumerate() {
            for (channel, (&a, &b)) in std::iter::zip(first, value).enumerate() {
                if !(a.is_finite() && b.is_finite()) {
                    continue;
                }
                let by = |other: &Value| other.get(channel).map_or(0.0, |x| (x - a).abs());
                let explained = 16.0 * moved.iter().map(by).fold(0.0, f64::max);
                let size = ((a - b).abs() - explained).max(0.0) / precision.ulp(a.abs().max(b.abs()));
                // The smallest numbers have no ulp that scales with them.
                if size > found.size && a.abs().max(b.abs()) > DARK {
                    let fails = size > self.claims.isotropic.unwrap_or(Claims::ISOTROPIC);
                    found = Finding { size, fails, shown_by: (0, index + 1) };
                }
            }
        }
        Some(found)
    }
}

/// Values below this, in sr⁻¹, are as black as can be, and may have lost their digits in `f32`.
const DARK: f64 = 1e-30;

impl Check for Pointwise<'_> {
    fn property(&self) -> Property {
        self.property
    }

    fn unit(&self) -> Unit {
        match self.property {
            Property::Reciprocal | Property::Isotropic | Property::Cosine => Unit::Ulps,
            Property::Nan | Property::Finite => Unit::Channels,
            _ => Unit::Absolute,
        }
    }

    fn precision(&self) -> Precision {
        self.subject.precision()
    }

    fn claimed(&self) -> bool {
        let claims = &self.claims;
        match self.property {
            Property::Finite => claims.finite,
            Property::NonNegative => claims.non_negative,
            Property::BelowHorizon => claims.below_horizon,
            Property::Reciprocal => claims.reciprocal.is_some(),
            Property::Isotropic => claims.isotropic.is_some(),
            Property::Cosine => claims.cosine.is_some(),
            _ => claims.nan,
        }
    }

    fn count(&self) -> usize {
        let kinds = match self.property {
            Property::Reciprocal => 2,
            Property::Isotropic => 1 + TURNS.len() + MOVES.len(),
            Property::Nan => 6,
            _ => 1,
        };
        if self.asks_both_forms() { 2 * kinds } else { kinds }
    }

    fn pairs(&self, place: Place, ask: &mut Vec<Pair>) {
        let precision = self.subject.precision();
        let pair = place.pair(precision);
        let start = ask.len();
        match self.property {
            Property::Reciprocal => ask.extend([pair, exchanged(&pair)]),
            Property::Isotropic => {
                ask.push(pair);
                ask.extend(TURNS.map(|degrees| place.turned(degrees).pair(precision)));
                let ulp = precision.ulp(1.0);
                ask.extend(MOVES.map(|(index, ulps)| {
                    let mut moved = pair;
                    if let Some(x) = moved.get_mut(index) {
                        *x = precision.round(*x + ulps * ulp);
                    }
                    moved
                }));
            }
            Property::Nan => {
                for index in 0..6 {
                    let mut spoilt = pair;
                    if let Some(x) = spoilt.get_mut(index) {
                        *x = f64::NAN;
                    }
                    ask.push(spoilt);
                }
            }
            _ => ask.push(pair),
        }
        if self.asks_both_forms() {
            ask.extend_from_within(start..);
        }
    }

    fn answers(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        let mut values = self.subject.eval(pairs)?;
        if self.asks_both_forms() {
            let with_cos = self.subject.eval_cos(pairs)?;
            // The second half of each place's pairs.
            let (count, half) = (self.count(), self.count() / 2);
            for (index, (value, with_cos)) in values.iter_mut().zip(with_cos).enumerate() {
                if index % count >= half {
                    *value = with_cos;
                }
            }
        }
        Ok(values)
    }

    fn judge(&self, pairs: &[Pair], values: &[Value]) -> Option<Finding> {
        let of_each = |size: &dyn Fn(&Value) -> f64, allowed: f64| {
            let sizes = values.iter().map(size).enumerate();
            let (index, size) = sizes.fold((0, 0.0), |worst, new| if new.1 > worst.1 { new } else { worst });
            Some(Finding { size, fails: size > allowed, shown_by: (index, index) })
        };
        match (self.property, values) {
            (Property::Finite, _) => of_each(&|value| count(value, |x| !x.is_finite()), 0.0),
            (Property::Nan, _) => of_each(&|value| count(value, |x| !x.is_nan()), 0.0),
            // A NaN is for "finite" to tell.
            (Property::NonNegative, _) => of_each(&|value| value.iter().fold(0.0, |worst, x| f64::max(worst, -x)), 0.0),
            // Both above it: a simpler case is not looked for there.
            (Property::BelowHorizon, _) if pairs.first().is_none_or(|[.., lz, _, _, vz]| *lz > 0.0 && *vz > 0.0) => {
                None
            }
            (Property::BelowHorizon, _) => {
                let size = |x: &f64| if x.is_nan() { f64::INFINITY } else { x.abs() };
                of_each(&|value| value.iter().map(size).fold(0.0, f64::max), 0.0)
            }
            (Property::Isotropic, _) => self.isotropy(pairs, values),
            (Property::Reciprocal, [a, b]) => {
                let size = self.ulps(*a, *b);
                Some(Finding { size, fails: size > self.claims.reciprocal.unwrap_or(0.0), shown_by: (0, 1) })
            }
            (Property::Cosine, [f, with_cos]) => {
                let expected = times_cos(*f, pairs.first()?);
                // Where the plain form has left its range, or the product its digits, the form with the cosine is there
                // to be better.
                if expected.iter().any(|x| !x.is_finite() || (*x != 0.0 && x.abs() < DARK)) {
                    return None;
                }
                let size = self.ulps(expected, *with_cos);
                Some(Finding { size, fails: size > self.claims.cosine.unwrap_or(0.0), shown_by: (0, 1) })
            }
            _ => None,
        }
    }

    fn label(&self, index: usize) -> String {
        let text = match (self.property, index) {
            (Property::Reciprocal, 1) => "f(v, l)",
            (Property::Isotropic, 1..) => "turned",
            (_, index) if self.asks_both_forms() && index >= self.count() / 2 => "f cos",
            _ => "f(l, v)",
        };
        text.to_owned()
    }

    fn line(&self, index: usize) -> Option<usize> {
        self.subject.line(index * self.count())
    }

    fn keep(&self) -> f64 {
        match self.property {
            Property::Reciprocal | Property::Isotropic | Property::Cosine => 0.1,
            // Any value that may not be there is as wrong as a large one.
            _ => 0.0,
        }
    }
}

fn count(value: &Value, is: impl Fn(f64) -> bool) -> f64 {
    value.iter().filter(|x| is(**x)).count() as f64
}
