//! `lobe audit`, as its user meets it.

use std::process::{Command, Output};

fn lobe(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lobe")).args(arguments).output().expect("the command starts")
}

#[test]
fn the_audit_says_what_engines_do_with_light() {
    let folder = tempfile::tempdir().expect("a folder");
    let (page, plots) = (folder.path().join("audit.md"), folder.path().join("audit"));
    let path = |path: &std::path::Path| path.display().to_string();
    let output = lobe(&["audit", "--fast", "--quiet", "--json", "--markdown", &path(&page), "--svg", &path(&plots)]);
    assert!(output.status.success(), "{output:?}");
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let engine = |name: &str| {
        let list = found.as_array().expect("a list");
        let engine = list.iter().find(|e| e["engine"].as_str().is_some_and(|e| e.starts_with(name)));
        engine.unwrap_or_else(|| panic!("no {name} in {found}")).clone()
    };
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let metal = |name: &str| {
        let range = engine(name)["white_metal"].clone();
        (number(&range["least"]["albedo"]), number(&range["most"]["albedo"]))
    };
    // With a table the compensation is right; with the fit it goes to both sides; without it rough metals are dark.
    let (least, most) = metal("Filament 1.x");
    assert!(least > 0.99 && most < 1.01, "{least} {most}");
    let (least, most) = metal("bevy");
    assert!(least < 0.95 && most > 1.3, "{least} {most}");
    for name in ["glTF", "Godot", "three.js", "Unreal"] {
        let (least, most) = metal(name);
        assert!(least < 0.6 && most < 1.01, "{name}: {least} {most}");
    }
    // What is the same both ways, and what goes by the viewer.
    assert!((number(&engine("glTF")["exchange"]) - 1.0).abs() < 1e-9);
    assert!(number(&engine("Filament 1.x")["exchange"]) > 1.2);
    // A plain sum of both lobes gains.
    assert!(number(&engine("Unreal")["white_dielectric"]["most"]["albedo"]) > 1.05);

    let text = std::fs::read_to_string(&page).expect("the page");
    let names: Vec<_> = found.as_array().into_iter().flatten().filter_map(|e| e["engine"].as_str()).collect();
    assert!(names.iter().all(|name| text.contains(name)), "{text}");
    // Each plot that the page shows is there.
    let shown: Vec<_> = text.lines().filter_map(|line| line.split_once("](audit/")?.1.strip_suffix(')')).collect();
    assert_eq!(shown.len(), names.len());
    for plot in shown {
        let svg = std::fs::read_to_string(plots.join(plot)).expect(plot);
        assert!(svg.starts_with("<svg") || svg.starts_with("<?xml"), "{plot}");
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_named_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("taken");
    std::fs::write(&file, "a file").expect("a file");
    let output = lobe(&["audit", "--svg", &file.display().to_string()]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && error.contains("taken"), "{error}");
}
