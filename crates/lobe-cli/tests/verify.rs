//! `lobe verify`, as a user types it.

use std::process::{Command, Output};

fn lobe(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lobe")).args(arguments).output().expect("the command runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn the_table_has_every_model_and_the_verdict() {
    let run = lobe(&["verify", "--extremes", "--fast"]);
    let table = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{table}{}", text(&run.stderr));
    for model in lobe_models::models() {
        let row = table.lines().find(|line| line.starts_with(&format!("{} ", model.name)));
        assert!(row.is_some_and(|row| row.contains(" holds ")), "{}: {row:?}", model.name);
    }
}

#[test]
fn json_can_be_repeated() {
    let run = lobe(&["verify", "phong", "--fast", "--json"]);
    let list: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    let found = &list[0];
    assert_eq!(found["model"], "phong");
    assert_eq!(found["holds"], true);
    // The worst input is given such that `lobe eval` repeats it.
    let worst = &found["worst_without_search"];
    let brdf = serde_json::json!({"lobes": [worst["lobe"]]}).to_string();
    assert!(worst["lobe"]["q"].is_number(), "{brdf}");
    assert_eq!(lobe(&["verify", "phong", "--fast", "--json"]).stdout, run.stdout);
}

#[test]
fn an_unknown_model_is_an_error_of_usage() {
    let run = lobe(&["verify", "phnog"]);
    assert_eq!(run.status.code(), Some(2));
    assert!(text(&run.stderr).contains("the models are lambert, phong"), "{}", text(&run.stderr));
}

#[test]
fn the_terms_have_a_table_of_their_own() {
    let run = lobe(&["verify", "--terms", "--fast"]);
    let table = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{table}{}", text(&run.stderr));
    for term in ["D ggx", "D beckmann", "G1 ggx", "F dielectric", "F conductor"] {
        let row = table.lines().find(|line| line.starts_with(term));
        assert!(row.is_some_and(|row| row.contains(" holds ")), "{term}: {row:?}");
    }
}

#[test]
fn mediump_is_surveyed() {
    let run = lobe(&["verify", "--half", "lambert", "--json"]);
    let list: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    let row = &list["models"][0];
    assert_eq!(row["model"], "lambert");
    assert_eq!(row["within_1_percent"], row["in_range"]);
    assert!(row["in_range"].as_u64() > Some(1000), "{row}");
}
