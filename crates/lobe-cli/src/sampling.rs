//! `lobe verify --sampling`: whether directions are drawn with the density that is told.

use crate::args::VerifyArgs;
use crate::error::Failure;
use crate::output;
use crate::progress::{Progress, Waiting};
use crate::spec;
use lobe_verify::sampling::mutants::survey;
use lobe_verify::sampling::{Catalogue, Effort, InDouble, InSingle, Sampler, Suite, verify_all, views};
use serde_json::json;

/// Runs it.
pub(crate) fn run(args: &VerifyArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    let effort = if args.fast { Effort::QUICK } else { Effort::FULL };
    if args.mutants {
        return mutants(effort, quiet, json);
    }
    let suite = match &args.brdf {
        Some(argument) => of_brdf(argument, effort, quiet)?,
        None => {
            let model = args.model.as_deref().map(crate::models::find).transpose()?;
            let catalogue = model.map_or_else(|| Catalogue::new(effort), |model| Catalogue::of(model, effort));
            let bar = Progress::new("samplers", catalogue.len() as u64, quiet);
            catalogue.verify(&|| bar.advance(1))
        }
    };
    let text = if json { format!("{:#}\n", json!(suite)) } else { suite.to_string() };
    output::print(text.as_bytes())?;
    let broken: Vec<_> = suite.reports.iter().filter(|report| !report.holds()).map(|report| &*report.name).collect();
    if broken.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!("a sampler does not do what it claims: {}", broken.join(", "))))
    }
}

/// A BRDF of the command line, in both number types.
fn of_brdf(argument: &str, effort: Effort, quiet: bool) -> Result<Suite, Failure> {
    let material = spec::from_argument(argument)?;
    let (double, single) = (material.sampler::<f64>(), material.sampler::<f32>());
    let (double, single) = (InDouble(&*double), InSingle(&*single));
    let names = [format!("{}, f64", material.name), format!("{}, f32", material.name)];
    let _waiting = Waiting::new("samples", quiet);
    let samplers: [(&str, &dyn Sampler); 2] = [(&names[0], &double), (&names[1], &single)];
    Ok(verify_all(&samplers, &views(), effort))
}

fn mutants(effort: Effort, quiet: bool, json: bool) -> Result<(), Failure> {
    let rows = {
        let _waiting = Waiting::new("planted faults", quiet);
        survey(effort)
    };
    let text = if json {
        format!("{:#}\n", json!(rows))
    } else {
        let head = "| fault | caught by | p | least part that is found |\n|---|---|---|---|\n".to_owned();
        rows.iter().fold(head, |text, row| text + &format!("{row}\n"))
    };
    output::print(text.as_bytes())?;
    let missed =
        rows.iter().filter(|row| row.caught_by.is_empty()).map(|row| format!("{} is not caught", row.fault.name()));
    let false_alarms = rows.iter().filter(|row| !row.false_alarms.is_empty());
    let broken: Vec<_> =
        missed.chain(false_alarms.map(|row| format!("a false alarm without \"{}\"", row.fault.name()))).collect();
    if broken.is_empty() { Ok(()) } else { Err(Failure::Check(broken.join("; "))) }
}
