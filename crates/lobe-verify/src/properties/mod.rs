//! The properties that a BRDF must have, looked for in any: a lobe of [`lobe`], a closure, a program.
//!
//! ```
//! use lobe_verify::properties::{Property, verify};
//!
//! // A diffuse surface whose author forgot the 1/π.
//! let report = verify(&|l: [f64; 3], v: [f64; 3]| if l[2] > 0.0 && v[2] > 0.0 { [0.8; 3] } else { [0.0; 3] });
//! let failures: Vec<_> = report.failures().map(|verdict| verdict.property).collect();
//! assert_eq!(failures, [Property::Energy]);
//! ```
//!
//! | property | how it is looked for | a defect is told in |
//! |---|---|---|
//! | finite, not negative | at pairs that lean on the extremes | channels, sr⁻¹ |
//! | 0 below the horizon | one or both directions on it or below | sr⁻¹ |
//! | reciprocal | `f(l, v)` against `f(v, l)` | ulps |
//! | isotropic | both directions turned by 90, 180 and 53 degrees | ulps, beyond what rounding explains |
//! | cosine | `eval_cos` against `eval` times the cosine | ulps |
//! | continuous | along paths, a step of which is cut down to neighbouring directions | relative difference |
//! | energy | the albedo by quadrature, towards the viewer and of a beam | albedo |
//! | NaN stays NaN | a NaN in each component in turn | channels that hide it |
//! | monotone | a family, by growing albedo: [`verify_family`] | ulps |
//! | agreement | another subject, a reference: [`agrees_with`] | relative difference |
//!
//! The inputs are the same every time. Each answer has the worst case found, and the simplest that still fails, as a
//! line for `lobe eval`.

mod check;
mod claims;
mod compared;
mod continuity;
mod energy;
mod inputs;
pub mod mutants;
mod place;
mod pointwise;
mod report;
mod shrink;
mod suite;
mod table;

pub use claims::Claims;
pub use inputs::Effort;
pub use report::{Case, Observed, Outcome, Property, Report, Unit, Verdict};
pub use table::verify_table;

use crate::subject::{AsSubject, Subject, SubjectError};
use compared::{Agreement, Monotone};
use pointwise::Pointwise;

/// Looks for all properties of one subject, with the claims that subjects of its kind have and a quick effort.
///
/// It takes a `Brdf<f64>`, a `Brdf<f32>`, a closure `Fn([f64; 3], [f64; 3]) -> [f64; 3]` of `l` and `v`, or any
/// [`Subject`]. What goes wrong with the subject itself, a panic or a program that dies, is part of the report.
pub fn verify<K>(subject: &impl AsSubject<K>) -> Report {
    let subject = subject.as_subject();
    report(&*subject, &subject.claims(), Effort::QUICK)
}

/// [`verify`], with claims and an effort of one's own.
pub fn verify_with<K>(subject: &impl AsSubject<K>, claims: &Claims, effort: Effort) -> Report {
    report(&*subject.as_subject(), claims, effort)
}

fn report(subject: &dyn Subject, claims: &Claims, effort: Effort) -> Report {
    let mut verdicts: Vec<Verdict> = Vec::new();
    for property in Property::OF_ONE {
        let broken = verdicts.iter().find(|verdict| is_lost(&verdict.outcome)).map(|verdict| verdict.property);
        verdicts.push(match broken {
            // A program that hangs would hang nine times.
            Some(before) => not_checked(property, &format!("the subject gave no answer to \"{before}\"")),
            None => check(subject, property, claims, effort),
        });
    }
    Report { verdicts }
}

/// Whether there is no use in asking for more. After a panic there is: other inputs may go well.
fn is_lost(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::Broken(error) if !matches!(error, SubjectError::Panicked { .. }))
}

fn not_checked(property: Property, reason: &str) -> Verdict {
    Verdict::new(property, Unit::Absolute, Outcome::NotChecked(reason.to_owned()))
}

/// One property of one subject. The two that need something to compare with are not checked: see [`verify_family`] and
/// [`agrees_with`].
pub fn check(subject: &dyn Subject, property: Property, claims: &Claims, effort: Effort) -> Verdict {
    match property {
        Property::Continuous => continuity::continuity(subject, claims, effort),
        Property::Energy => energy::energy(subject, claims, effort),
        Property::Nan if !subject.takes_nan() => not_checked(property, "a NaN cannot be asked for"),
        Property::Cosine if !subject.has_own_cosine() => not_checked(property, "there is no form with the cosine"),
        Property::Monotone => not_checked(property, "it takes a family with an albedo"),
        Property::Agreement => not_checked(property, "it takes a reference"),
        _ => {
            let places = match property {
                Property::BelowHorizon => inputs::below(effort, claims.grazing),
                _ => inputs::places(effort, claims.grazing),
            };
            check::run(&Pointwise { subject, claims: *claims, property }, &places)
        }
    }
}

/// The albedos that the members of a family are made with.
const ALBEDOS: [f64; 8] = [0.0, 0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0];

/// Whether a larger albedo gives no smaller value anywhere, for a family of subjects with an albedo from 0 to 1.
///
/// ```
/// use lobe::{Eon, Rgb};
/// use lobe_verify::properties::{Effort, verify_family};
/// let verdict = verify_family(|albedo| Eon::new(Rgb::splat(albedo), 0.7), Effort::QUICK);
/// assert!(verdict.holds(), "{verdict}");
/// ```
pub fn verify_family<K, S: AsSubject<K>>(family: impl Fn(f64) -> S, effort: Effort) -> Verdict {
    let members = ALBEDOS.map(|albedo| (albedo, family(albedo)));
    let members: Vec<(f64, Box<dyn Subject + '_>)> =
        members.iter().map(|(albedo, member)| (*albedo, member.as_subject())).collect();
    let grazing = members.iter().map(|(_, member)| member.claims().grazing).fold(Claims::LOBE.grazing, f64::max);
    check::run(&Monotone { members: &members }, &inputs::places(effort, grazing))
}

/// Whether a subject gives the values of a reference, to a relative difference: a port of a model against the original,
/// `f32` against `f64`.
///
/// Both are asked for the same directions, rounded to `f32` if either computes in it. Values below 1e-30 count as
/// equal.
///
/// ```
/// use lobe::{Lambert, Rgb};
/// use lobe_verify::properties::{Effort, agrees_with};
/// let (single, double) = (Lambert::new(Rgb::splat(0.25_f32)), Lambert::new(Rgb::splat(0.25_f64)));
/// assert!(agrees_with(&single, &double, 2e-7, Effort::QUICK).holds());
/// ```
pub fn agrees_with<K, L>(
    subject: &impl AsSubject<K>,
    reference: &impl AsSubject<L>,
    tolerance: f64,
    effort: Effort,
) -> Verdict {
    let (subject, reference) = (subject.as_subject(), reference.as_subject());
    let grazing = subject.claims().grazing.max(reference.claims().grazing);
    let check = Agreement { subject: &*subject, reference: &*reference, tolerance };
    check::run(&check, &inputs::places(effort, grazing))
}
