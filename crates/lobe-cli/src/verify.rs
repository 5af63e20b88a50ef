//! `lobe verify`: every model against `f64`, at the extremes of its domain.

use crate::args::VerifyArgs;
use crate::error::Failure;
use crate::output;
use crate::progress::Progress;
use lobe_models::{Bound, Model, models};
use lobe_verify::extremes::{Case, Effort, Outcome, TARGET_99};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Runs the verb.
pub(crate) fn run(args: &VerifyArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    if args.compare {
        return compare(json);
    }
    let chosen: Vec<&'static Model> =
        models().filter(|model| args.model.as_deref().is_none_or(|name| name == model.name)).collect();
    if chosen.is_empty() {
        let known: Vec<_> = models().map(|model| model.name).collect();
        let asked = args.model.as_deref().unwrap_or_default();
        return Err(Failure::Usage(format!("unknown model `{asked}`; the models are {}", known.join(", "))));
    }
    let effort = if args.fast { Effort::QUICK } else { Effort::FULL };
    extremes(&chosen, effort, quiet, json)
}

fn extremes(chosen: &[&'static Model], effort: Effort, quiet: bool, json: bool) -> Result<(), Failure> {
    let bar = Progress::new("models", effort.total() * chosen.len() as u64, quiet);
    let mut outcomes = Vec::new();
    if !json {
        output::print(HEAD.as_bytes())?;
    }
    for model in chosen {
        let outcome = Outcome::of(model, effort, &|steps| bar.advance(steps));
        if !json {
            bar.suspend(|| output::print(row(&outcome).as_bytes()))?;
        }
        outcomes.push(outcome);
    }
    drop(bar);
    if json {
        let list: Vec<_> = outcomes.iter().map(to_json).collect();
        output::print(format!("{:#}\n", Value::from(list)).as_bytes())?;
    } else {
        output::print(details(&outcomes).as_bytes())?;
    }
    let broken: Vec<_> = outcomes.iter().filter(|outcome| !outcome.holds()).map(|o| o.model.name).collect();
    if broken.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!("a promise is broken for {}; the table has the input", broken.join(", "))))
    }
}

/// The table of `--compare`, in Markdown: it stands in the documentation as it is printed.
fn compare(json: bool) -> Result<(), Failure> {
    let rows = lobe_verify::comparison::compare();
    if json {
        let list: Vec<_> = rows
            .iter()
            .map(|row| {
                let errors: Vec<_> = std::iter::zip(lobe_verify::comparison::WIDTHS, row.errors)
                    .map(|(alpha, e)| json!({"alpha": alpha, "median": number(e.median), "worst": number(e.worst)}))
                    .collect();
                json!({"form": row.name, "equation": row.equation, "errors": errors})
            })
            .collect();
        return output::print(format!("{:#}\n", Value::from(list)).as_bytes());
    }
    let mut text = String::from("| `D` of GGX, median / worst |");
    for alpha in lobe_verify::comparison::WIDTHS {
        let _ = write!(text, " α = {alpha:?} |");
    }
    text += "\n|---|---|---|---|---|\n";
    for row in rows {
        let _ = write!(text, "| {}: `{}` |", row.name, row.equation);
        for e in row.errors {
            let _ = write!(text, " {:.1e} / {:.1e} |", e.median, e.worst);
        }
        text.push('\n');
    }
    output::print(text.as_bytes())
}

const HEAD: &str = "\
relative error of f32 against f64 of the same inputs
model                        values    median      99 %   largest  of bound  verdict  both ways
";

fn row(outcome: &Outcome) -> String {
    let found = &outcome.findings;
    let both_ways = if outcome.model.reciprocal {
        "same bits".to_owned()
    } else {
        format!("differ by {:.1e}, at most {:.1e}", found.median_defect(), found.worst_defect)
    };
    format!(
        "{:<24} {:>10}  {:>8.1e}  {:>8.1e}  {:>8.1e}  {:>8.3}  {:<7}  {both_ways}\n",
        outcome.model.name,
        found.compared(),
        found.median(),
        found.percentile_99(),
        found.largest(),
        found.worst_part(),
        if outcome.holds() { "holds" } else { "BROKEN" },
    )
}

/// Where the worst was met, the bounds, and what is broken.
fn details(outcomes: &[Outcome]) -> String {
    let mut text = String::from("\nthe worst inputs (l and v as for `lobe eval`)\n");
    for Outcome { model, findings } in outcomes {
        if let Some(case) = &findings.worst {
            let _ = writeln!(text, "{}: {case}", model.name);
        }
    }
    let _ = writeln!(
        text,
        "\nthe bounds: {:e} at worst and {TARGET_99:e} at the 99th percentile, except for",
        Bound::WORST
    );
    for model in outcomes.iter().map(|o| o.model) {
        if let Bound::Derived { formula, .. } = model.bound {
            let _ = writeln!(text, "{:<24} {formula}", model.name);
        }
    }
    let faults = || outcomes.iter().flat_map(|o| o.findings.faults.iter().map(move |fault| (o.model.name, fault)));
    if faults().next().is_some() {
        text += "\nbroken promises\n";
    }
    for (name, fault) in faults() {
        let _ = writeln!(text, "{name}: {}, {} times, first {}", fault.kind, fault.count, fault.first);
    }
    text
}

/// JSON has no infinities and no NaN: those become text.
fn number(x: f64) -> Value {
    if x.is_finite() { json!(x) } else { json!(x.to_string()) }
}

fn case(case: &Case) -> Value {
    let lobe = case.lobe.as_ref().and_then(|lobe| serde_json::from_str::<Value>(&lobe.to_string()).ok());
    json!({
        "lobe": lobe,
        "l": <[f32; 3]>::from(case.l),
        "v": <[f32; 3]>::from(case.v),
        "quantity": format!("{:?}", case.quantity),
        "value": number(f64::from(case.value)),
        "exact": number(case.exact),
        "error": number(case.error),
        "part_of_bound": number(case.part),
    })
}

fn to_json(outcome: &Outcome) -> Value {
    let found = &outcome.findings;
    let bound = match outcome.model.bound {
        Bound::Constant => json!(Bound::WORST),
        Bound::Derived { formula, .. } => json!(formula),
    };
    let faults: Vec<_> = found
        .faults
        .iter()
        .map(|fault| json!({"kind": fault.kind.to_string(), "count": fault.count, "first": case(&fault.first)}))
        .collect();
    json!({
        "model": outcome.model.name,
        "compared": found.compared(),
        "skipped": found.skipped,
        "median": found.median(),
        "percentile_99": found.percentile_99(),
        "largest": number(found.largest()),
        "bound": bound,
        "worst_part_of_bound": number(found.worst_part()),
        "worst": found.worst.as_ref().map(case),
        "worst_without_search": found.worst_on_grid.as_ref().map(case),
        "reciprocal": outcome.model.reciprocal,
        "median_defect": (!outcome.model.reciprocal).then(|| found.median_defect()),
        "worst_defect": (!outcome.model.reciprocal).then_some(found.worst_defect),
        "faults": faults,
        "holds": outcome.holds(),
    })
}
