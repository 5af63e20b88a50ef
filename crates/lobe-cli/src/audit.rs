//! `lobe audit`: the formulas of engines, put through furnaces.

use crate::args::AuditArgs;
use crate::error::Failure;
use crate::output;
use crate::plot::albedo_curves;
use crate::plot::svg::{SERIES, label};
use crate::progress::Progress;
use crate::trade::file_name;
use lobe_scene::check_writable;
use lobe_verify::audit::{Audit, ENGINES, Effort, Place, audit_all};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Runs the verb.
pub(crate) fn run(args: &AuditArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    let effort = if args.fast { Effort::QUICK } else { Effort::FULL };
    if let Some(file) = &args.markdown {
        check_writable(file)?;
    }
    if let Some(folder) = &args.svg {
        let names: Vec<_> = ENGINES.iter().map(|engine| folder.join(file_name(engine.name))).collect();
        output::make_folder(folder, &names.iter().map(AsRef::as_ref).collect::<Vec<_>>())?;
    }
    let bar = Progress::new("engines", ENGINES.len() as u64, quiet);
    let found = audit_all(effort, &|| bar.advance(1));
    drop(bar);
    if let Some(folder) = &args.svg {
        for audit in &found {
            output::write_file(&folder.join(file_name(audit.engine.name)), plot(audit).as_bytes())?;
        }
    }
    if let Some(path) = &args.markdown {
        output::write_file(path, markdown(&found, args.svg.is_some()).as_bytes())?;
    }
    if json {
        let list: Vec<_> = found.iter().map(to_json).collect();
        return output::print(format!("{:#}\n", Value::from(list)).as_bytes());
    }
    output::print(table(&found).as_bytes())
}

/// The white furnace, for some of the roughnesses: as many as there are lines, evenly, and the last one.
fn plot(audit: &Audit) -> String {
    let step = audit.curves.len().div_ceil(SERIES).max(1);
    let mut shown: Vec<_> = audit.curves.iter().rev().step_by(step).collect();
    shown.reverse();
    let curves: Vec<_> = shown
        .into_iter()
        .map(|(roughness, curve)| {
            let points = curve.iter().rev().map(|&(n_dot_v, albedo)| (n_dot_v.min(1.0).acos().to_degrees(), albedo));
            (format!("roughness {}", label(*roughness)), points.collect())
        })
        .collect();
    albedo_curves(&format!("White metal in a white world: {}", audit.engine.name), &curves).file()
}

fn table(found: &[Audit]) -> String {
    let mut text = String::from(
        "albedo of what should reflect everything: least to most\n\
         engine                     white metal     white dielectric, seen   the same, lit   f(l,v)/f(v,l)   gold against exact GGX\n\
         \x20                                                                                   at most         median     worst\n",
    );
    for audit in found {
        let range = |range: lobe_verify::audit::Range| format!("{:.3} to {:.3}", range.least.albedo, range.most.albedo);
        let _ = writeln!(
            text,
            "{:<26} {:<15} {:<24} {:<15} {:<15.3} {:<10.1e} {:.1e}",
            audit.engine.name,
            range(audit.white_metal),
            range(audit.white_dielectric),
            range(audit.white_dielectric_lit),
            audit.defect,
            audit.median_error,
            audit.worst_error,
        );
    }
    text
}

fn markdown(found: &[Audit], with_plots: bool) -> String {
    let mut text = String::from(
        "# What engines do with light\n\n\
         Made by `lobe audit --markdown`. The formulas for direct light that engines publish, written anew in `f64` and put through the\n\
         same tests: what is found is the formula's doing, not that of a number format or of a texture.\n\n\
         They are made for speed, and their authors say what they leave out; the last table says it with them. Image-based light, where\n\
         several of them do more, is not looked at.\n\n\
         - *white metal*, *white dielectric*: the albedo of a surface that should reflect everything, `E(v)`, least and most over a roughness\n\
         \x20 from 0.1 to 1 and `n·v` from 0.05 to 1. Less than 1 is dark, more is light out of nothing.\n\
         - *lit*: the same from the light's side: what one beam becomes.\n\
         - *exchange*: the largest ratio of `f(l, v)` and `f(v, l)`; 1 is reciprocal.\n\
         - *gold*: the relative difference to GGX with Smith's correlated masking and Schlick's term, once reflected; a compensation counts as\n\
         \x20 a difference.\n\n\
         | engine | white metal | white dielectric | lit | exchange | gold: median | worst |\n|---|---|---|---|--:|--:|--:|\n",
    );
    for audit in found {
        let range = |range: lobe_verify::audit::Range| format!("{:.3} to {:.3}", range.least.albedo, range.most.albedo);
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.3} | {:.1e} | {:.1e} |",
            audit.engine.name,
            range(audit.white_metal),
            range(audit.white_dielectric),
            range(audit.white_dielectric_lit),
            audit.defect,
            audit.median_error,
            audit.worst_error,
        );
    }
    text += "\nWhere the white metal is darkest and brightest:\n\n| engine | darkest | brightest |\n|---|---|---|\n";
    for audit in found {
        let place = |place: Place| format!("roughness {:.2}, `n·v` {:.2}", place.roughness, place.n_dot_v);
        let (least, most) = (place(audit.white_metal.least), place(audit.white_metal.most));
        let _ = writeln!(text, "| {} | {least} | {most} |", audit.engine.name);
    }
    if with_plots {
        text += "\nThe albedo of the white metal over the angle of the view, a line for each roughness:\n\n";
        for audit in found {
            let _ = writeln!(text, "![{0}](audit/{1})", audit.engine.name, file_name(audit.engine.name).display());
        }
    }
    text += "\n## Sources\n\n| engine | terms | published in | its authors say | smallest roughness |\n|---|---|---|---|--:|\n";
    for audit in found {
        let engine = audit.engine;
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} |",
            engine.name, engine.terms, engine.source, engine.said, engine.least_roughness
        );
    }
    text
}

fn place(place: Place) -> Value {
    json!({"albedo": place.albedo, "roughness": place.roughness, "n_dot_v": place.n_dot_v})
}

fn to_json(audit: &Audit) -> Value {
    let range = |range: lobe_verify::audit::Range| json!({"least": place(range.least), "most": place(range.most)});
    json!({
        "engine": audit.engine.name,
        "terms": audit.engine.terms,
        "source": audit.engine.source,
        "said": audit.engine.said,
        "least_roughness": audit.engine.least_roughness,
        "white_metal": range(audit.white_metal),
        "white_dielectric": range(audit.white_dielectric),
        "white_dielectric_lit": range(audit.white_dielectric_lit),
        "exchange": audit.defect,
        "median_error": audit.median_error,
        "worst_error": audit.worst_error,
    })
}
