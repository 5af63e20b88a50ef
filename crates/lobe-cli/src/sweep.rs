//! `lobe sweep`: every argument of every elementary function, and whether the bounds hold.

use crate::args::{SweepArgs, SweptPrecision};
use crate::error::Failure;
use crate::output;
use crate::progress::Progress;
use lobe::number::{Coarse, Fast, Precision as _};
use lobe_verify::rough;
use lobe_verify::sweep::{FUNCTIONS, Function, Worst, sweep};
use serde_json::json;

/// What was found for one function.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub(crate) function: &'static Function,
    pub(crate) worst: Worst,
}

impl Outcome {
    /// Whether the promise was kept.
    pub(crate) fn holds(&self) -> bool {
        self.worst.ulps <= self.function.allowed_ulps
    }

    /// As a value for `--json` and for the report.
    pub(crate) fn to_json(self) -> serde_json::Value {
        json!({
            "function": self.function.name,
            "tried": self.worst.tried,
            "worst_ulps": number(self.worst.ulps),
            "allowed_ulps": self.function.allowed_ulps,
            "argument": number(f64::from(self.worst.argument)),
            "argument_bits": format!("0x{:08x}", self.worst.argument.to_bits()),
            "value": number(f64::from(self.worst.value)),
            "exact": number(self.worst.exact),
            "holds": self.holds(),
        })
    }
}

/// JSON has no infinities: those become text.
fn number(x: f64) -> serde_json::Value {
    if x.is_finite() { json!(x) } else { json!(x.to_string()) }
}

/// What was found for one function at a precision below `f32`'s own, in one way.
struct RoughOutcome {
    function: &'static rough::Function,
    way: rough::Way,
    allowed: f64,
    worst: rough::Worst,
}

impl RoughOutcome {
    fn holds(&self) -> bool {
        self.worst.error <= self.allowed
    }

    fn to_json(&self) -> serde_json::Value {
        json!({
            "function": self.function.name,
            "precision": self.way.precision,
            "level": self.way.name,
            "tried": self.worst.tried,
            "worst_relative": number(self.worst.error),
            "allowed_relative": self.allowed,
            "argument": number(f64::from(self.worst.argument)),
            "argument_bits": format!("0x{:08x}", self.worst.argument.to_bits()),
            "value": number(f64::from(self.worst.value)),
            "exact": number(self.worst.exact),
            "holds": self.holds(),
        })
    }
}

/// Runs the verb.
pub(crate) fn run(args: &SweepArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    let asked = |name: &str| args.function.as_deref().is_none_or(|asked| asked == name);
    let precise = matches!(args.precision, SweptPrecision::Precise | SweptPrecision::All);
    let precisions: &[&str] = match args.precision {
        SweptPrecision::Precise => &[],
        SweptPrecision::Fast => &[Fast::NAME],
        SweptPrecision::Coarse => &[Coarse::NAME],
        SweptPrecision::All => &rough::PRECISIONS,
    };
    let functions: Vec<_> = FUNCTIONS.iter().filter(|f| precise && asked(f.name)).collect();
    let rough_functions: Vec<_> = rough::FUNCTIONS.iter().filter(|f| !precisions.is_empty() && asked(f.name)).collect();
    if functions.is_empty() && rough_functions.is_empty() {
        let known: Vec<_> = match args.precision {
            SweptPrecision::Precise => FUNCTIONS.iter().map(|function| function.name).collect(),
            _ => rough::FUNCTIONS.iter().map(|function| function.name).collect(),
        };
        let asked = args.function.as_deref().unwrap_or_default();
        return Err(Failure::Usage(format!("unknown function `{asked}`; the functions are {}", known.join(", "))));
    }
    let print = |text: &str| if json { Ok(()) } else { output::print(text.as_bytes()) };

    let (mut list, mut broken) = (Vec::new(), Vec::new());
    if !functions.is_empty() {
        print(if args.markdown { MARKDOWN_HEAD } else { HEAD })?;
    }
    for function in functions {
        let bar = Progress::new(function.name, (1_u64 << 32) / u64::from(args.stride), quiet);
        let outcome = Outcome { function, worst: sweep(function, args.stride, &|steps| bar.advance(steps)) };
        drop(bar);
        print(&if args.markdown { markdown_row(&outcome) } else { row(&outcome) })?;
        list.push(outcome.to_json());
        if !outcome.holds() {
            broken.push(function.name.to_owned());
        }
    }

    let ways = rough::ways(precisions);
    if !rough_functions.is_empty() {
        let separator = if list.is_empty() { "" } else { "\n" };
        let head = if args.markdown { rough_markdown_head(&ways) } else { ROUGH_HEAD.to_owned() };
        print(&format!("{separator}{head}"))?;
    }
    for function in rough_functions {
        let bar = Progress::new(function.name, (1_u64 << 32) / u64::from(args.stride), quiet);
        let found = rough::sweep(function, &ways, args.stride, &|steps| bar.advance(steps));
        drop(bar);
        let outcomes: Vec<_> = ways
            .iter()
            .zip(found)
            .filter_map(|(&way, worst)| {
                let allowed = function.promise(way.precision)?.allowed;
                Some(RoughOutcome { function, way, allowed, worst })
            })
            .collect();
        for precision in precisions.iter().filter(|_| args.markdown) {
            let of_precision = outcomes.iter().filter(|outcome| outcome.way.precision == *precision);
            print(&rough_markdown_row(&of_precision.collect::<Vec<_>>()))?;
        }
        for outcome in outcomes {
            if !args.markdown {
                print(&rough_row(&outcome))?;
            }
            list.push(outcome.to_json());
            if !outcome.holds() {
                broken.push(format!("{} ({}, {})", function.name, outcome.way.precision, outcome.way.name));
            }
        }
    }
    if json {
        output::print(format!("{:#}\n", serde_json::Value::from(list)).as_bytes())?;
    }

    if broken.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!("the bound is broken for {}; the table has the argument", broken.join(", "))))
    }
}

const HEAD: &str = "function        tried   worst (ulp)  allowed  verdict  at\n";
const ROUGH_HEAD: &str = "function      precision  level         tried  worst (relative)  allowed  verdict  at\n";
const MARKDOWN_HEAD: &str = "\
| function | worst error (ulp) | at | promised |
|---|---|---|---|
";

fn verdict(holds: bool) -> &'static str {
    if holds { "holds" } else { "BROKEN" }
}

fn row(outcome: &Outcome) -> String {
    let (function, worst) = (outcome.function, outcome.worst);
    format!(
        "{:<9} {:>11}  {:>12.6}  {:>7}  {:<7}  {:?} (0x{:08x})\n",
        function.name,
        worst.tried,
        worst.ulps,
        function.allowed_ulps,
        verdict(outcome.holds()),
        worst.argument,
        worst.argument.to_bits()
    )
}

fn markdown_row(outcome: &Outcome) -> String {
    let (function, worst) = (outcome.function, outcome.worst);
    format!("| `{}` | {:.3} | {:?} | {} |\n", function.name, worst.ulps, worst.argument, function.allowed_ulps)
}

fn rough_row(outcome: &RoughOutcome) -> String {
    let worst = outcome.worst;
    format!(
        "{:<12}  {:<9}  {:<7} {:>11}  {:>16.3e}  {:>7.1e}  {:<7}  {:?} (0x{:08x})\n",
        outcome.function.name,
        outcome.way.precision,
        outcome.way.name,
        worst.tried,
        worst.error,
        outcome.allowed,
        verdict(outcome.holds()),
        worst.argument,
        worst.argument.to_bits()
    )
}

fn rough_markdown_head(ways: &[rough::Way]) -> String {
    let mut levels: Vec<_> = ways.iter().map(|way| way.name).collect();
    let mut seen = Vec::new();
    levels.retain(|level| {
        let new = !seen.contains(level);
        seen.push(*level);
        new
    });
    let rules = "---|".repeat(levels.len());
    format!("| function | precision | {} | allowed | where |\n|---|---|{rules}---|---|\n", levels.join(" | "))
}

/// One function at one precision, a cell for each level.
fn rough_markdown_row(outcomes: &[&RoughOutcome]) -> String {
    let Some(first) = outcomes.first() else { return String::new() };
    let cells: Vec<_> = outcomes.iter().map(|outcome| format!("{:.2e}", outcome.worst.error)).collect();
    let function = first.function;
    format!(
        "| `{}` | {} | {} | {:.1e} | {} |\n",
        function.name,
        first.way.precision,
        cells.join(" | "),
        first.allowed,
        function.domain_in_words
    )
}
