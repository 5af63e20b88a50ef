//! The command `lobe`: report, render, diff, plot, eval, sample, models, sweep, trade, verify and audit.
//!
//! The program is this library and a `main` of one line, so that tests and fuzz targets can call the parsers:
//! [`spec::parse`] for BRDFs in JSON, [`eval::parse_line`] for pairs of directions in CSV.

mod args;
mod audit;
mod contact;
mod diff;
pub mod error;
pub mod eval;
mod letters;
mod models;
mod output;
mod plot;
mod progress;
mod properties;
mod render;
mod report;
mod sample;
mod sampling;
pub mod spec;
mod sweep;
mod trade;
mod verify;

use args::{Args, Command};
use clap::{CommandFactory as _, Parser as _};
use error::Failure;
use std::io::Write as _;
use std::process::ExitCode;

/// Reads the command line, does what it says, and answers with an exit code that means something.
#[must_use]
pub fn main() -> ExitCode {
    // Clap itself prints help (exit code 0) and errors of usage (2).
    let args = Args::parse();
    match run(&args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // If even standard error is closed, there is nobody left to tell.
            let _ = writeln!(std::io::stderr(), "error: {failure}");
            failure.exit_code()
        }
    }
}

fn run(args: &Args) -> Result<(), Failure> {
    match &args.command {
        Some(Command::Audit(audit)) => audit::run(audit, args.quiet, args.json),
        Some(Command::Diff(diff)) => diff::run(diff, args.quiet, args.json),
        Some(Command::Eval(eval)) => eval::run(eval, args.quiet, args.json),
        Some(Command::Models(models)) => models::run(models, args.json),
        Some(Command::Plot(plot)) => plot::run(plot, args.quiet, args.json),
        Some(Command::Sample(sample)) => sample::run(sample, args.quiet, args.json),
        Some(Command::Sweep(sweep)) => sweep::run(sweep, args.quiet, args.json),
        Some(Command::Trade(trade)) => trade::run(trade, args.quiet, args.json),
        Some(Command::Verify(verify)) => verify::run(verify, args.quiet, args.json),
        Some(Command::Completions { shell }) => completions(*shell),
        Some(Command::Render(render)) => render::run(render, args.quiet, args.json),
        Some(Command::Report(report)) => report::run(report, args.quiet, args.json),
        None => report::run(&args::ReportArgs::default(), args.quiet, args.json),
    }
}

/// Prints the completion script of a shell.
fn completions(shell: clap_complete::Shell) -> Result<(), Failure> {
    // Into memory first: the generator panics when its writer fails, and a closed pipe is no reason to.
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Args::command(), "lobe", &mut script);
    output::print(&script)
}
