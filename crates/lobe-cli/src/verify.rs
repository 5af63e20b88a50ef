//! `lobe verify`: what any BRDF must have, see [`crate::properties`]; every model against `f64`, at the extremes of its domain.

use crate::args::VerifyArgs;
use crate::error::Failure;
use crate::output;
use crate::progress::Progress;
use crate::properties;
use crate::sampling;
use lobe_models::{Bound, Model, models};
use lobe_verify::comparison::{WIDTHS_IN_HALF, compare_in_half};
use lobe_verify::extremes::{Case, Effort, Outcome, TARGET_99};
use lobe_verify::mediump::{BANDS, Band, Row, survey};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Runs the verb.
pub(crate) fn run(args: &VerifyArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    if args.compare {
        return compare(json);
    }
    if args.terms {
        return terms(args.fast, json);
    }
    if args.sampling {
        return sampling::run(args, quiet, json);
    }
    if let Some(spec) = &args.brdf {
        return properties::brdf(spec, args.fast, json);
    }
    if let Some(file) = &args.table {
        return properties::table(file, json);
    }
    if !args.program.is_empty() {
        return properties::program(&args.program, args.fast, json);
    }
    if args.certificates {
        return properties::certificates_alone(args.fast, quiet, json);
    }
    if args.mutants {
        return properties::mutants_alone(args.fast, json);
    }
    let chosen: Vec<&'static Model> =
        models().filter(|model| args.model.as_deref().is_none_or(|name| name == model.name)).collect();
    if chosen.is_empty() {
        let known: Vec<_> = models().map(|model| model.name).collect();
        let asked = args.model.as_deref().unwrap_or_default();
        return Err(Failure::Usage(format!("unknown model `{asked}`; the models are {}", known.join(", "))));
    }
    if args.half {
        return mediump(&chosen, args.model.is_none(), quiet, json);
    }
    if !args.extremes {
        return properties::everything(args.model.as_deref(), args.fast, quiet, json);
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

/// The table of `--terms`.
fn terms(fast: bool, json: bool) -> Result<(), Failure> {
    let terms = lobe_verify::terms::terms(if fast { 20_000 } else { 400_000 });
    if json {
        let list: Vec<_> = terms
            .iter()
            .map(|term| {
                json!({
                    "term": term.name, "compared": term.compared, "bound": term.bound,
                    "median": number(term.errors.median), "percentile_99": number(term.errors.percentile_99),
                    "largest": number(term.errors.worst), "worst_part_of_bound": number(term.part),
                    "worst": term.worst, "outside": term.outside, "holds": term.holds(),
                })
            })
            .collect();
        output::print(format!("{:#}\n", Value::from(list)).as_bytes())?;
    } else {
        let mut text = String::from(
            "relative error of f32 against f64 of the same inputs\n\
             term                            values    median      99 %   largest  of bound  verdict  bound\n",
        );
        for term in &terms {
            let verdict = if term.holds() { "holds" } else { "BROKEN" };
            let e = term.errors;
            let _ = writeln!(
                text,
                "{:<28} {:>9}  {:>8.1e}  {:>8.1e}  {:>8.1e}  {:>8.3}  {verdict:<7}  {}",
                term.name, term.compared, e.median, e.percentile_99, e.worst, term.part, term.bound
            );
        }
        text += "\nthe worst inputs: parameters, and the direction in the local frame\n";
        for term in &terms {
            let _ = writeln!(text, "{}: {}", term.name, term.worst);
        }
        output::print(text.as_bytes())?;
    }
    let broken: Vec<_> = terms.iter().filter(|term| !term.holds()).map(|term| term.name).collect();
    if broken.is_empty() { Ok(()) } else { Err(Failure::Check(format!("a bound is broken for {}", broken.join(", ")))) }
}

/// The tables of `--half`, in Markdown; the forms of GGX only where all models are asked for.
fn mediump(chosen: &[&'static Model], forms: bool, quiet: bool, json: bool) -> Result<(), Failure> {
    let bar = Progress::new("models", chosen.len() as u64, quiet);
    let rows: Vec<_> = chosen
        .iter()
        .map(|model| {
            let rows = survey(model);
            bar.advance(1);
            (model, rows)
        })
        .collect();
    drop(bar);
    let forms = if forms { compare_in_half() } else { Vec::new() };
    if json {
        let models: Vec<_> = rows
            .iter()
            .flat_map(|(_, rows)| rows)
            .map(|Row { model, band, tally }| {
                json!({
                    "model": model.name,
                    "alpha": band.map(|band| [band.from, band.to]),
                    "values": tally.values, "in_range": tally.in_range, "finite": tally.finite,
                    "within_1_percent": tally.within_1, "within_10_percent": tally.within_10,
                    "infinite": tally.infinite, "nan": tally.nan, "lost": tally.lost,
                })
            })
            .collect();
        let forms: Vec<_> = forms
            .iter()
            .map(|row| {
                let within: Vec<_> = std::iter::zip(WIDTHS_IN_HALF, row.within)
                    .map(|(alpha, (one, ten))| json!({"alpha": alpha, "within_1_percent": one, "within_10_percent": ten}))
                    .collect();
                json!({"form": row.form.name, "equation": row.form.equation, "errors": within})
            })
            .collect();
        return output::print(format!("{:#}\n", json!({"models": models, "ggx": forms})).as_bytes());
    }
    let mut text = String::from("| finite / within 10 % / within 1 % |");
    for Band { from, to } in BANDS {
        let _ = write!(text, " α {to:?} to {from:?} |");
    }
    text += "\n|---|---|---|---|---|\n";
    for (model, rows) in &rows {
        let _ = write!(text, "| {} |", model.name);
        let cell = |band: Option<Band>| {
            let row = rows.iter().find(|row| row.band == band)?;
            let percent = |count| format!("{:.0}", 100.0 * row.tally.part(count));
            let parts = [row.tally.finite, row.tally.within_10, row.tally.within_1].map(percent);
            // Three times the same number is one.
            Some(if parts.iter().all(|part| *part == parts[0]) { parts[0].clone() } else { parts.join(" / ") })
        };
        for (index, band) in BANDS.into_iter().enumerate() {
            // A model without a width has one row for all of its domain.
            let whole = if index == 0 { cell(None) } else { None };
            let _ = write!(text, " {} |", whole.or_else(|| cell(Some(band))).unwrap_or_default());
        }
        text.push('\n');
    }
    if !forms.is_empty() {
        text += "\n| `D` of GGX, within 10 % / 1 % |";
        for alpha in WIDTHS_IN_HALF {
            let _ = write!(text, " α = {alpha:?} |");
        }
        text += "\n|---|---|---|---|---|---|\n";
    }
    for row in forms {
        let _ = write!(text, "| {}: `{}` |", row.form.name, row.form.equation);
        for (one, ten) in row.within {
            let _ = write!(text, " {:.1} / {:.1} % |", 100.0 * ten, 100.0 * one);
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
        if let Bound::Excess { formula, .. } | Bound::Derived { formula, .. } = model.bound {
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
        Bound::Excess { formula, .. } | Bound::Derived { formula, .. } => json!(formula),
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
