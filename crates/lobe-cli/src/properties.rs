//! The part of `lobe verify` that looks for what any BRDF must have: in our models, in a user's, in ports with planted faults; and
//! the certificates.

use crate::error::Failure;
use crate::output;
use crate::progress::Progress;
use crate::report::checks::{LEVELS, Variant, variants};
use lobe_models::Lobe;
use lobe_verify::certify::{self, Outcome as Proof, Recheck};
use lobe_verify::properties::mutants::survey;
use lobe_verify::properties::{Case, Claims, Effort, Outcome, Report, Verdict, verify_table, verify_with};
use lobe_verify::subject::{InDouble, Program, SubjectError, Table};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// What was found of one of our lobes.
struct Found {
    lobe: Lobe,
    report: Report,
}

/// Everything: our models, the certificates, the planted faults.
pub(crate) fn everything(model: Option<&str>, fast: bool, quiet: bool, json: bool) -> Result<(), Failure> {
    let mut broken = Vec::new();
    let mut facts = serde_json::Map::new();
    let chosen: Vec<Variant> =
        variants().into_iter().filter(|variant| model.is_none_or(|name| variant.model().name == name)).collect();
    let models = models(&chosen, fast, quiet, json)?;
    broken.extend(models.failures);
    facts.insert("models".to_owned(), models.facts);
    // Of one model alone nobody asks for those of others.
    if model.is_none() {
        let proofs = certificates(fast, quiet, json)?;
        broken.extend(proofs.failures);
        facts.insert("certificates".to_owned(), proofs.facts);
        let faults = mutants(fast, json)?;
        broken.extend(faults.failures);
        facts.insert("planted_faults".to_owned(), faults.facts);
    }
    if json {
        output::print(format!("{:#}\n", Value::Object(facts)).as_bytes())?;
    }
    check(&broken)
}

fn check(broken: &[String]) -> Result<(), Failure> {
    match broken {
        [] => Ok(()),
        _ => Err(Failure::Check(format!("a claim does not hold: {}", broken.join("; ")))),
    }
}

/// One part: what does not hold, and all as JSON.
struct Part {
    failures: Vec<String>,
    facts: Value,
}

/// What a variant of a model claims.
fn claims(variant: &Variant) -> Claims {
    let model = variant.model();
    Claims {
        // A visibility ends at 2¹⁰⁰ (`lobe::masking::MAX_VISIBILITY`), that of Shifted Gamma at 2⁹⁰: between smaller cosines, whose
        // product is below 3e-28, the form with the cosine goes on and the one without does not.
        grazing: 1e-13,
        reciprocal: model.reciprocal.then_some(0.0),
        finite: model.finite,
        energy: variant.conserves(),
        // Tables and the limits of others have edges: told, not claimed.
        continuous: false,
        ..Claims::LOBE
    }
}

fn models(chosen: &[Variant], fast: bool, quiet: bool, json: bool) -> Result<Part, Failure> {
    let levels = if fast { LEVELS.get(2..3) } else { LEVELS.get(..) }.unwrap_or_default();
    let bar = Progress::new("models", chosen.len() as u64, quiet);
    let found: Vec<Vec<Found>> = chosen
        .par_iter()
        .map(|variant| {
            let lobes = levels.iter().filter_map(|level| variant.at(*level));
            let found = lobes.map(|lobe| {
                let brdf = lobe.build::<f64>();
                let report = verify_with(&InDouble(&&*brdf), &claims(variant), Effort::QUICK);
                Found { lobe, report }
            });
            let found = found.collect();
            bar.advance(1);
            found
        })
        .collect();
    drop(bar);
    let mut text = String::from(
        "properties of our models, in f64; a number in brackets is of what is not claimed\n\
         model                                   lobes  failures  both ways (ulps)  most reflected\n",
    );
    let mut failures = Vec::new();
    let mut details = String::new();
    for (variant, found) in chosen.iter().zip(&found) {
        let of = |property| found.iter().filter_map(move |found| found.report.verdict(property)).map(|v| v.size);
        let exchange = of(lobe_verify::properties::Property::Reciprocal).fold(0.0, f64::max);
        let energy = of(lobe_verify::properties::Property::Energy).fold(0.0, f64::max);
        let bracket = |claimed: bool, text: String| if claimed { text } else { format!("[{text}]") };
        let failed: usize = found.iter().map(|found| found.report.failures().count()).sum();
        let _ = writeln!(
            text,
            "{:<40} {:>4}  {failed:>8}  {:>16}  {:>14}",
            variant.name(),
            found.len(),
            bracket(
                variant.model().reciprocal,
                if exchange < 1e6 { format!("{exchange:.0}") } else { format!("{exchange:.0e}") }
            ),
            bracket(variant.conserves(), format!("{:.4}", 1.0 + energy)),
        );
        for Found { lobe, report } in found {
            for verdict in report.failures() {
                failures.push(format!("{}: {}", variant.name(), verdict.property));
                let _ = writeln!(details, "{lobe}: {verdict}");
            }
        }
    }
    if !json {
        output::print((text + &details).as_bytes())?;
    }
    failures.dedup();
    let facts = chosen.iter().zip(&found).flat_map(|(variant, found)| {
        found.iter().map(|Found { lobe, report }| {
            let lobe = serde_json::from_str::<Value>(&lobe.to_string()).ok();
            json!({"model": variant.name(), "lobe": lobe, "verdicts": verdicts(report)})
        })
    });
    Ok(Part { failures, facts: facts.collect() })
}

/// The certificates, each checked again from its text.
pub(crate) fn certificates_alone(fast: bool, quiet: bool, json: bool) -> Result<(), Failure> {
    alone(certificates(fast, quiet, json)?, json)
}

/// The planted faults.
pub(crate) fn mutants_alone(fast: bool, json: bool) -> Result<(), Failure> {
    alone(mutants(fast, json)?, json)
}

fn alone(part: Part, json: bool) -> Result<(), Failure> {
    if json {
        output::print(format!("{:#}\n", part.facts).as_bytes())?;
    }
    check(&part.failures)
}

fn certificates(fast: bool, quiet: bool, json: bool) -> Result<Part, Failure> {
    let effort = if fast { certify::Effort::QUICK } else { certify::Effort::FULL };
    let claims = certify::claims(&effort);
    let bar = Progress::new("certificates", claims.len() as u64, quiet);
    let mut part = Part { failures: Vec::new(), facts: Value::Null };
    let mut facts = Vec::new();
    let mut text = String::from("\ncertificates: for every view and parameter of the box, in real numbers\n");
    for claim in &claims {
        let proof = claim.prove(&effort);
        let holds = match &proof {
            Proof::Certified(certificate) => claim.check(certificate),
            _ => Recheck::Malformed(0),
        };
        let again = if holds.holds() { "checked again" } else { "NOT PROVED" };
        let _ = writeln!(text, "{proof}; {again}");
        if !holds.holds() {
            part.failures.push(format!("no certificate that {}", claim.name()));
        }
        let certificate = match &proof {
            Proof::Certified(c) => {
                json!({"bound": [c.bound.0, c.bound.1], "boxes": c.boxes, "cells": c.cells, "proof": c.proof})
            }
            _ => Value::Null,
        };
        facts.push(json!({"claim": proof.to_string(), "holds": holds.holds(), "certificate": certificate}));
        bar.advance(1);
    }
    drop(bar);
    if !json {
        output::print(text.as_bytes())?;
    }
    part.facts = facts.into();
    Ok(part)
}

fn mutants(fast: bool, json: bool) -> Result<Part, Failure> {
    let rows = survey(if fast { Effort::QUICK } else { Effort::FULL });
    let mut text = String::from("\nplanted faults\n| fault | caught by | simplest case |\n|---|---|---|\n");
    let mut failures = Vec::new();
    let mut facts = Vec::new();
    for row in &rows {
        let _ = writeln!(text, "{row}");
        if row.caught_by.is_empty() {
            failures.push(format!("a planted fault is not caught: {}", row.fault.name()));
        }
        for alarm in &row.false_alarms {
            failures.push(format!("a false alarm without \"{}\": {}", row.fault.name(), alarm.property));
        }
        let by: Vec<_> = row.caught_by.iter().map(|verdict| verdict.property.name()).collect();
        let case = row.caught_by.first().and_then(|verdict| verdict.simplest.as_ref()).map(ToString::to_string);
        facts.push(json!({"fault": row.fault.name(), "caught_by": by, "case": case}));
    }
    if !json {
        output::print(text.as_bytes())?;
    }
    Ok(Part { failures, facts: facts.into() })
}

/// A BRDF of the command line.
pub(crate) fn brdf(argument: &str, fast: bool, json: bool) -> Result<(), Failure> {
    let material = crate::spec::from_argument(argument)?;
    let brdf = material.build::<f64>();
    let claims = Claims { reciprocal: material.is_reciprocal().then_some(64.0), ..Claims::LOBE };
    tell(&verify_with(&InDouble(&&*brdf), &claims, effort(fast)), json)
}

/// A user's table.
pub(crate) fn table(file: &Path, json: bool) -> Result<(), Failure> {
    let table = Table::read(file).map_err(|error| Failure::Input(error.to_string()))?;
    tell(&verify_table(&table, &Claims::OTHERS), json)
}

/// A user's program.
pub(crate) fn program(words: &[String], fast: bool, json: bool) -> Result<(), Failure> {
    let Some((command, arguments)) = words.split_first() else {
        return Err(Failure::Usage("--program needs a command, such as --program python3 brdf.py".to_owned()));
    };
    let program = Program::new(command, arguments);
    tell(&verify_with(&program, &Claims::OTHERS, effort(fast)), json)
}

fn effort(fast: bool) -> Effort {
    if fast { Effort::QUICK } else { Effort::FULL }
}

/// Prints a report; what gave no values is an error of the input, what fails one of the check.
fn tell(report: &Report, json: bool) -> Result<(), Failure> {
    let text = if json { format!("{:#}\n", verdicts(report)) } else { report.to_string() };
    output::print(text.as_bytes())?;
    let broken: Option<&SubjectError> = report.verdicts.iter().find_map(|verdict| match &verdict.outcome {
        Outcome::Broken(error) => Some(error),
        _ => None,
    });
    if let Some(error) = broken {
        return Err(Failure::Input(error.to_string()));
    }
    check(&report.failures().map(|verdict| verdict.property.to_string()).collect::<Vec<_>>())
}

fn verdicts(report: &Report) -> Value {
    report.verdicts.iter().map(to_json).collect()
}

fn to_json(verdict: &Verdict) -> Value {
    let (outcome, why) = match &verdict.outcome {
        Outcome::Holds => ("holds", None),
        Outcome::Fails => ("fails", None),
        Outcome::Measured => ("measured", None),
        Outcome::NotChecked(reason) => ("not checked", Some(reason.clone())),
        Outcome::Broken(error) => ("broken", Some(error.to_string())),
    };
    json!({
        "property": verdict.property.name(),
        "outcome": outcome,
        "why": why,
        "tried": verdict.tried,
        "size": number(verdict.size),
        "unit": verdict.unit.to_string(),
        "worst": verdict.worst.as_ref().map(case),
        "simplest": verdict.simplest.as_ref().map(case),
        "remark": verdict.remark,
    })
}

fn case(case: &Case) -> Value {
    let observed: Vec<_> =
        case.observed.iter().map(|seen| json!({"what": seen.what, "value": seen.value.map(number)})).collect();
    json!({"input": case.input(), "line": case.line, "observed": observed})
}

/// JSON has no infinities and no NaN: those become text.
fn number(x: f64) -> Value {
    if x.is_finite() { json!(x) } else { json!(x.to_string()) }
}
