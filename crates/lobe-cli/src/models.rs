//! `lobe models`: every model of the catalogue with its parameters and their domains.

use crate::args::ModelsArgs;
use crate::error::Failure;
use crate::output;
use lobe_models::{Kind, Model, Parameter, model, models, nearest, ngan};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Runs the verb.
pub(crate) fn run(args: &ModelsArgs, as_json: bool) -> Result<(), Failure> {
    if args.materials {
        return materials(as_json);
    }
    let chosen: Vec<&Model> = match &args.model {
        None => models().collect(),
        Some(name) => vec![find(name)?],
    };
    if as_json {
        let list: Vec<Value> = chosen.into_iter().map(to_json).collect();
        return output::print(format!("{:#}\n", Value::from(list)).as_bytes());
    }
    let mut text = String::new();
    for (index, model) in chosen.into_iter().enumerate() {
        let gap = if index > 0 { "\n" } else { "" };
        let _ = writeln!(text, "{gap}{}  {}{}", model.name, model.summary, notes(model));
        for parameter in model.parameters {
            let _ = writeln!(text, "  {:<16} {:<42} {}", parameter.name, domain(parameter), parameter.doc);
        }
    }
    output::print(text.as_bytes())
}

/// The model of that name.
pub(crate) fn find(name: &str) -> Result<&'static Model, Failure> {
    model(name).ok_or_else(|| {
        let near = nearest(name, models().map(|model| model.name), 3);
        Failure::Usage(format!("unknown model `{name}`; the nearest are {}", near.join(", ")))
    })
}

/// The measured materials with their colours, and the models that each is fitted with.
fn materials(as_json: bool) -> Result<(), Failure> {
    let fitted: Vec<&str> = ngan::models().filter(|name| model(name).is_some()).collect();
    if as_json {
        let fits = ngan::fits().iter().filter(|fit| fitted.contains(&fit.model));
        let list: Vec<Value> = fits
            .map(|fit| {
                let parameters: serde_json::Map<_, _> =
                    fit.parameters.iter().map(|(name, value)| ((*name).to_owned(), json!(value))).collect();
                json!({
                    "name": fit.name(), "material": fit.material, "model": fit.model, "kd": fit.kd, "ks": fit.ks,
                    "parameters": parameters,
                })
            })
            .collect();
        return output::print(format!("{:#}\n", Value::from(list)).as_bytes());
    }
    let mut text = format!("{:<30} {:<26} cook-torrance: {:<28} parameters\n", "material", "kd", "ks");
    for fit in ngan::fits().iter().filter(|fit| fit.model == ngan::DEFAULT_MODEL) {
        let rgb = |[r, g, b]: [f64; 3]| format!("{r} {g} {b}");
        let parameters: Vec<_> = fit.parameters.iter().map(|(name, value)| format!("{name}={value}")).collect();
        let (kd, ks) = (rgb(fit.kd), rgb(fit.ks));
        let _ = writeln!(text, "{:<30} {kd:<26} {ks:<43} {}", fit.material, parameters.join(" "));
    }
    let _ = writeln!(text, "\nfitted with {}; name one as ngan:MATERIAL/MODEL", fitted.join(", "));
    output::print(text.as_bytes())
}

/// What a model does not do that others do.
fn notes(model: &Model) -> &'static str {
    match (model.reciprocal, model.finite) {
        (true, true) => "",
        (false, true) => " [not reciprocal]",
        (true, false) => " [f_r has no limit at the horizon; f_r·cos has]",
        (false, false) => " [not reciprocal; f_r has no limit at the horizon, f_r·cos has]",
    }
}

fn domain(parameter: &Parameter) -> String {
    match parameter.default {
        Some(default) => format!("{}; {} by default", parameter.domain(), default.bare()),
        None => parameter.domain(),
    }
}

fn to_json(model: &Model) -> Value {
    let parameters: Vec<Value> = model
        .parameters
        .iter()
        .map(|parameter| {
            let domain = match parameter.kind {
                Kind::Colour { max } => json!({"kind": "colour", "min": 0.0, "max": max}),
                Kind::Number { min, max } => json!({"kind": "number", "min": min, "max": max}),
                Kind::Table => json!({"kind": "table", "numbers": lobe_models::TABLE, "min": 0.0, "max": 1e6}),
                Kind::Widths => json!({"kind": "widths", "min": 1e-4, "max": 1.0}),
                Kind::Choice(words) => json!({"kind": "choice", "words": words}),
            };
            json!({
                "name": parameter.name, "domain": domain, "default": parameter.default, "doc": parameter.doc,
                "weight": parameter.is_weight(),
            })
        })
        .collect();
    json!({
        "name": model.name, "summary": model.summary, "reciprocal": model.reciprocal, "finite": model.finite,
        "parameters": parameters,
    })
}
