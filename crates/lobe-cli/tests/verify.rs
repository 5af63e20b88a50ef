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
    let run = lobe(&["verify", "--extremes", "phong", "--fast", "--json"]);
    let list: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    let found = &list[0];
    assert_eq!(found["model"], "phong");
    assert_eq!(found["holds"], true);
    // The worst input is given such that `lobe eval` repeats it.
    let worst = &found["worst_without_search"];
    let brdf = serde_json::json!({"lobes": [worst["lobe"]]}).to_string();
    assert!(worst["lobe"]["q"].is_number(), "{brdf}");
    assert_eq!(lobe(&["verify", "--extremes", "phong", "--fast", "--json"]).stdout, run.stdout);
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

/// A BRDF in another language: a good one holds, a bad one is told with the input that shows it.
#[test]
fn a_program_is_checked_as_it_is() {
    let awk = |formula: &str| {
        let program = format!("BEGIN{{FS=\",\"}} {{f = ($3 > 0 && $6 > 0) ? {formula} : 0; print f \",\" f \",\" f}}");
        lobe(&["verify", "--fast", "--program", "awk", "-v", "CONVFMT=%.9g", "-v", "OFMT=%.9g", &program])
    };
    let good = awk("0.25");
    let text = String::from_utf8_lossy(&good.stdout).into_owned();
    assert!(good.status.success(), "{text} {}", String::from_utf8_lossy(&good.stderr));
    assert!(text.contains("energy") && text.contains("holds"), "{text}");
    // The cosine of the light in f_r: not the same both ways.
    let bad = awk("0.25 * $3");
    assert_eq!(bad.status.code(), Some(1));
    let text = String::from_utf8_lossy(&bad.stdout).into_owned();
    let line = text.lines().find(|line| line.starts_with("reciprocal")).unwrap_or_default();
    assert!(line.contains("FAILS") && text.contains("simplest"), "{text}");
}

#[test]
fn a_program_that_gives_no_values_is_named() {
    for (program, word) in [("exit 3", "3"), ("read x; echo 1,2", "line 1"), ("echo 0.1,nan,0.1", "line")] {
        let run = lobe(&["verify", "--fast", "--program", "sh", "-c", program]);
        let error = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(!run.status.success() && error.contains("sh") && error.contains(word), "{program}: {error}");
    }
    let run = lobe(&["verify", "--program", "no-such-program"]);
    let error = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.code() == Some(3) && error.contains("no-such-program"), "{error}");
}

#[test]
fn a_table_is_read_or_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("samples.csv");
    let verify = |text: &str| {
        std::fs::write(&file, text).expect("a table");
        lobe(&["verify", "--table", &file.display().to_string()])
    };
    let good = verify("lx,ly,lz,vx,vy,vz,r,g,b\n0.6,0,0.8,0,0,1,0.1,0.1,0.1\n0,0,1,0.6,0,0.8,0.1,0.1,0.1\n");
    assert!(good.status.success(), "{good:?}");
    // Its exchanged sample has another value.
    let bad = verify("0.6,0,0.8,0,0,1,0.1,0.1,0.1\n0,0,1,0.6,0,0.8,0.1,0.3,0.1\n");
    assert_eq!(bad.status.code(), Some(1), "{bad:?}");
    let torn = verify("0.6,0,0.8,0,0,1,0.1,0.1,0.1\n0.6,0,0.8,0,0,x,0.1,0.1,0.1\n");
    let error = String::from_utf8_lossy(&torn.stderr).into_owned();
    assert!(torn.status.code() == Some(3) && error.contains("samples.csv") && error.contains('2'), "{error}");
}

#[test]
fn one_of_our_models_has_what_a_brdf_must_have() {
    let run = lobe(&["verify", "ward", "--fast", "--json"]);
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let facts: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    let verdicts = facts["models"][0]["verdicts"].as_array().expect("verdicts");
    assert!(verdicts.len() == 9 && verdicts.iter().all(|verdict| verdict["outcome"] != "fails"), "{facts}");
    // A preset by --brdf; one that gains fails, with the input.
    let run = lobe(&[
        "verify",
        "--fast",
        "--brdf",
        r#"{"lobes": [{"model": "blinn-phong", "ks": 1, "q": 8, "normalization": "common"}]}"#,
    ]);
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(run.status.code() == Some(1) && text.contains("E towards v"), "{text}");
}
