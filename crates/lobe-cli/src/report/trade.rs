//! A small `lobe trade` of the scene's materials, so that the page says what their digits cost.

use crate::plot::front;
use crate::progress::Progress;
use crate::trade::{dots, facts, of_scene};
use lobe::batch::{Level, levels};
use lobe_models::AnyPrecision;
use lobe_scene::Scene;
use lobe_trade::{Bench, Effort, Number, Row, is_noisy};
use serde::Serialize;
use serde_json::json;
use std::time::Duration;

/// What was measured of the materials.
#[derive(Debug, Serialize)]
pub(crate) struct Trade {
    /// The number types, in words.
    pub(crate) numbers: String,
    /// How many materials are not here, because they are too many for a page.
    pub(crate) left_out: usize,
    /// The part of white that the choices are within.
    budget: f64,
    /// What `lobe trade --json` says, without the times that were not taken.
    #[serde(flatten)]
    facts: serde_json::Value,
    /// Whether the times are not to be trusted; among the facts too.
    #[serde(skip)]
    pub(crate) noisy: bool,
    /// The rows of each material.
    #[serde(skip)]
    pub(crate) rows: Vec<Vec<Row>>,
}

/// One step of eight bits: nobody sees it.
pub(crate) const BUDGET: f64 = 1.0 / 255.0;

/// Some tenths of a second for a material: as many rounds as `lobe trade`, so that noise is told from times, but shorter
/// ones, and from the cache alone.
pub(crate) const EFFORT: Effort = Effort {
    rounds: 15,
    block: Duration::from_micros(50),
    stream: 0,
    stream_rounds: 0,
    parallel: Duration::ZERO,
    pairs: 1024,
    sphere: 48,
};

/// A page with hundreds of plots is no page, and nobody waits for it.
const MOST_MATERIALS: usize = 32;

/// Measures the materials of a scene; nothing if none of them has lobes. Nothing else may run meanwhile.
pub(crate) fn measure(scene: &Scene, quiet: bool) -> Option<Trade> {
    let mut subjects = of_scene(scene);
    let left_out = subjects.len().saturating_sub(MOST_MATERIALS);
    subjects.truncate(MOST_MATERIALS);
    if subjects.is_empty() {
        return None;
    }
    let (numbers, words) = numbers();
    let mut bench = Bench::new(EFFORT);
    let bar = Progress::new("times", subjects.len() as u64, quiet);
    let mut rows = Vec::new();
    for subject in &subjects {
        rows.push(bench.measure(subject, &numbers));
        bar.advance(1);
    }
    drop(bar);
    let mut facts = facts(&rows, Some(BUDGET), bench.no_code());
    for (subject, rows) in facts["subjects"].as_array_mut().into_iter().flatten().zip(&rows) {
        let front = front(&dots(rows));
        for (index, row) in subject["rows"].as_array_mut().into_iter().flatten().enumerate() {
            without_what_was_not_measured(row);
            row["on_front"] = json!(front.contains(&index));
        }
        without_what_was_not_measured(&mut subject["choice"]);
    }
    let noisy = is_noisy(&rows.iter().flatten().cloned().collect::<Vec<_>>());
    Some(Trade { numbers: words, left_out, budget: BUDGET, facts, noisy, rows })
}

fn without_what_was_not_measured(row: &mut serde_json::Value) {
    if let Some(row) = row.as_object_mut() {
        row.retain(|key, _| key != "ns_streaming" && key != "per_second_all_cores");
    }
}

/// The number types that are measured, and which they are: the scalar `f32`, and the best that the machine has.
fn numbers() -> (Vec<Number>, String) {
    match levels(Level::new()).last() {
        Some((name, level)) => {
            let lanes = AnyPrecision::ALL.map(|precision| Number::Lanes { level, name, precision });
            let words = format!("the scalar f32, and the lanes of the best level, {name}: precise, fast and coarse");
            (std::iter::once(Number::F32).chain(lanes).collect(), words)
        }
        None => {
            let words = "the scalars f32, fast and coarse, for this machine has no lanes";
            (vec![Number::F32, Number::Fast, Number::Coarse], words.to_owned())
        }
    }
}
