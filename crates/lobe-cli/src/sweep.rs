//! `lobe sweep`: every argument of every elementary function, and whether the bounds hold.

use crate::args::SweepArgs;
use crate::error::Failure;
use crate::output;
use crate::progress::Progress;
use lobe_verify::sweep::{FUNCTIONS, Function, Worst, sweep};
use serde_json::json;
use std::fmt::Write as _;

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

/// Runs the verb.
pub(crate) fn run(args: &SweepArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    let functions: Vec<&'static Function> = match &args.function {
        None => FUNCTIONS.iter().collect(),
        Some(name) => FUNCTIONS.iter().filter(|function| function.name == name).collect(),
    };
    if functions.is_empty() {
        let known: Vec<_> = FUNCTIONS.iter().map(|function| function.name).collect();
        let asked = args.function.as_deref().unwrap_or_default();
        return Err(Failure::Usage(format!("unknown function `{asked}`; the functions are {}", known.join(", "))));
    }

    let mut outcomes = Vec::new();
    if !json {
        output::print(b"function        tried   worst (ulp)  allowed  verdict  at\n")?;
    }
    for function in functions {
        let bar = Progress::new(function.name, (1_u64 << 32) / u64::from(args.stride), quiet);
        let outcome = Outcome { function, worst: sweep(function, args.stride, &|steps| bar.advance(steps)) };
        drop(bar);
        if !json {
            output::print(row(&outcome).as_bytes())?;
        }
        outcomes.push(outcome);
    }
    if json {
        let list: Vec<_> = outcomes.iter().map(|outcome| outcome.to_json()).collect();
        output::print(format!("{:#}\n", serde_json::Value::from(list)).as_bytes())?;
    }

    let broken: Vec<_> = outcomes.iter().filter(|outcome| !outcome.holds()).map(|o| o.function.name).collect();
    if broken.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!("the bound is broken for {}; the table has the argument", broken.join(", "))))
    }
}

fn row(outcome: &Outcome) -> String {
    let (function, worst) = (outcome.function, outcome.worst);
    let mut row = String::new();
    let verdict = if outcome.holds() { "holds" } else { "BROKEN" };
    let _ = writeln!(
        row,
        "{:<9} {:>11}  {:>12.6}  {:>7}  {:<7}  {:?} (0x{:08x})",
        function.name,
        worst.tried,
        worst.ulps,
        function.allowed_ulps,
        verdict,
        worst.argument,
        worst.argument.to_bits()
    );
    row
}
