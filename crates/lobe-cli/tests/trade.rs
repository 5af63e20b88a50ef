//! `lobe trade`, as a user types it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn lobe_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lobe")).args(arguments).current_dir(folder).output().expect("the command runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn the_table_has_every_number_and_every_approximation() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = lobe_in(
        folder.path(),
        &[
            "trade",
            "--only",
            "microfacet ggx conductor",
            "--quick",
            "--csv",
            "t.csv",
            "--markdown",
            "t.md",
            "--svg",
            "plots",
        ],
    );
    let table = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    for name in ["    f64 ", "    f32 ", "    fast ", "    coarse ", "Schlick for Fresnel", "Blinn-Phong for GGX"] {
        assert!(table.contains(name), "{name}: {table}");
    }
    let numbers = 4 + 3 * lobe::batch::levels(lobe::batch::Level::new()).count();
    let csv = fs::read_to_string(folder.path().join("t.csv")).expect("a file");
    let forms = csv.lines().filter(|line| line.contains(",f64,")).count();
    assert_eq!((forms, csv.lines().count()), (7, 1 + 7 * numbers));
    let page = fs::read_to_string(folder.path().join("t.md")).expect("a file");
    assert_eq!(page.lines().filter(|line| line.starts_with("| exact |")).count(), numbers);
    let plot = fs::read_to_string(folder.path().join("plots/microfacet-ggx-conductor.svg")).expect("a file");
    assert_eq!(plot.matches("<circle").count(), 7 * numbers + 6);
}

const SCENE: &str = r#"{"obj": "box.obj",
    "materials": {"paint": {"lobes": [{"model": "lambert", "albedo": 0.5},
        {"model": "microfacet", "alpha": 0.3, "fresnel": "dielectric"}]}}}"#;

/// A scene of one triangle.
fn scene() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("box.obj"), "mtllib box.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        .expect("a file");
    fs::write(folder.path().join("box.mtl"), "newmtl paint\nKd 0.5 0.5 0.5\n").expect("a file");
    fs::write(folder.path().join("scene.json"), SCENE).expect("a file");
    folder
}

#[test]
fn a_budget_names_the_cheapest_within_it() {
    let folder = scene();
    let run = lobe_in(folder.path(), &["trade", "scene.json", "--budget", "1/255", "--quick", "--json"]);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let facts: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    let paint = &facts["subjects"][0];
    assert_eq!(paint["subject"], "paint");
    let (choice, rows) = (&paint["choice"], paint["rows"].as_array().expect("rows"));
    assert!(choice["steps_of_8_bits"].as_u64().expect("a number") <= 1, "{choice}");
    let time = |row: &serde_json::Value| row["ns"]["median"].as_f64().expect("a number");
    let within = rows.iter().filter(|row| row["steps_of_8_bits"].as_u64() <= Some(1));
    assert!(within.into_iter().all(|row| time(row) >= time(choice)), "{choice}");
    assert!(rows.iter().any(|row| row["form"] == "Schlick for Fresnel (lobe 2)"));
    let line = text(&lobe_in(folder.path(), &["trade", "scene.json", "--budget", "0.004", "--quick"]).stdout);
    assert!(line.lines().any(|line| line.starts_with("paint: ") && line.contains("% of the scalar f32")), "{line}");
}

/// Where the program has no names that tell, nothing stands there, and why.
#[test]
fn bytes_of_code_are_in_every_output() {
    let folder = scene();
    let run = |more: &[&str]| {
        let arguments = [&["trade", "scene.json", "--quick", "--csv", "t.csv", "--markdown", "t.md"], more].concat();
        let run = lobe_in(folder.path(), &arguments);
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        text(&run.stdout)
    };
    let facts: serde_json::Value = serde_json::from_str(&run(&["--json"])).expect("JSON");
    let rows = facts["subjects"][0]["rows"].as_array().expect("rows");
    let known = facts["no_code"].is_null();
    // The flags of the workspace ask for names that tell; others may take their place.
    assert!(known || !cfg!(target_os = "linux") || std::env::var_os("RUSTFLAGS").is_some(), "{facts}");
    let sizes: Vec<_> = rows.iter().map(|row| row["code_bytes"].as_u64()).collect();
    assert!(sizes.iter().all(|bytes| bytes.is_some() == known), "{sizes:?}");
    let cells = |blank: &str| -> Vec<String> {
        sizes.iter().map(|bytes| bytes.map_or_else(|| blank.to_owned(), |bytes| bytes.to_string())).collect()
    };

    let csv = fs::read_to_string(folder.path().join("t.csv")).expect("a file");
    assert!(csv.lines().next().is_some_and(|head| head.ends_with(",code_bytes")), "{csv}");
    let last = |line: &str| line.rsplit_once(',').map(|(_, cell)| cell.to_owned());
    assert_eq!(csv.lines().skip(1).filter_map(last).collect::<Vec<_>>(), cells(""));

    let page = fs::read_to_string(folder.path().join("t.md")).expect("a file");
    let last = |line: &str| line.strip_suffix(" |")?.rsplit_once("| ").map(|(_, cell)| cell.to_owned());
    let lines = page.lines().skip_while(|line| !line.starts_with("|---")).skip(1);
    assert_eq!(lines.filter_map(last).collect::<Vec<_>>(), cells("-"));
    assert_eq!(page.contains("\nBytes: "), !known);

    let table = run(&[]);
    let column = |line: &str| line.split_whitespace().rev().nth(7).map(str::to_owned);
    let lines = table.lines().filter(|line| line.starts_with("    "));
    assert_eq!(lines.filter_map(column).collect::<Vec<_>>(), cells("-"));
    assert_eq!(table.contains("\nbytes: "), !known);
}

/// The scalars `f32` and `f64` have the time of a sample, the others none.
#[test]
fn the_time_of_a_sample_is_in_every_output() {
    let folder = scene();
    let run = |more: &[&str]| {
        let arguments = [&["trade", "scene.json", "--quick", "--csv", "t.csv", "--markdown", "t.md"], more].concat();
        let run = lobe_in(folder.path(), &arguments);
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        text(&run.stdout)
    };
    let sampled = |number: &str| matches!(number, "f32" | "f64");
    let facts: serde_json::Value = serde_json::from_str(&run(&["--json"])).expect("JSON");
    let rows = facts["subjects"][0]["rows"].as_array().expect("rows");
    for row in rows {
        let ns = &row["ns_sample"];
        assert_eq!(ns["median"].as_f64() > Some(0.0), sampled(row["number"].as_str().expect("a name")), "{row}");
        assert!(ns.is_null() || ns["low"].as_f64() <= ns["high"].as_f64(), "{row}");
    }

    // A cell holds a time above 0, or what stands for none.
    let check = |number: &str, cell: &str, none: &str, line: &str| {
        assert_eq!(cell.parse::<f64>().ok() > Some(0.0), sampled(number), "{line}");
        assert!(sampled(number) || cell == none, "{line}");
    };
    let csv = fs::read_to_string(folder.path().join("t.csv")).expect("a file");
    assert_eq!(csv.lines().count(), 1 + rows.len());
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().expect("a head");
    let column = |name: &str| head.iter().position(|cell| *cell == name).expect("a column");
    for line in lines {
        assert_eq!(line.len(), head.len());
        for name in ["ns_sample", "ns_sample_low", "ns_sample_high"] {
            check(line[column("number")], line[column(name)], "", &line.join(","));
        }
    }

    let page = fs::read_to_string(folder.path().join("t.md")).expect("a file");
    assert!(page.contains("| form | number | ns | sample |") && page.contains("\n- *sample*: "), "{page}");
    let lines = page.lines().skip_while(|line| !line.starts_with("|---")).skip(1);
    for line in lines {
        let cells: Vec<_> = line.split('|').map(str::trim).collect();
        check(cells[2], cells[4], "-", line);
    }

    let table = run(&[]);
    assert!(table.contains(" sample "), "{table}");
    let lines: Vec<_> = table.lines().filter(|line| line.starts_with("    ")).collect();
    assert_eq!(lines.len(), rows.len());
    for (line, row) in lines.iter().zip(rows) {
        let cell = line.split_whitespace().rev().nth(10).expect("a cell");
        check(row["number"].as_str().expect("a name"), cell, "-", line);
    }
}

#[test]
fn what_is_wrong_is_said() {
    let folder = scene();
    let fails = |arguments: &[&str], code: i32, message: &str| {
        let run = lobe_in(folder.path(), arguments);
        assert_eq!(run.status.code(), Some(code), "{arguments:?}");
        assert!(text(&run.stderr).contains(message), "{arguments:?}: {}", text(&run.stderr));
    };
    fails(&["trade", "none.json"], 3, "none.json: cannot read this file");
    for budget in ["2", "1/0", "-0.1", "some"] {
        fails(&["trade", "scene.json", "--budget", budget], 2, "a part of white from 0 to 1, such as 1/255 or 0.01");
    }
    fails(&["trade", "--budget", "1/255"], 2, "required");
    fails(&["trade", "--only", "wrad"], 2, "unknown subject `wrad` for --only; the nearest are ward");
    fails(&["trade", "--only", "ward", "--quick", "--csv", "no/such/folder.csv"], 4, "cannot write this");
}

#[test]
fn the_report_shows_what_the_digits_of_each_material_cost() {
    let folder = scene();
    let two = SCENE.replacen(
        r#"{"obj""#,
        r#"{"views": [{"name": "a"}, {"name": "b", "materials": {"paint": "paper"}}], "obj""#,
        1,
    );
    fs::write(folder.path().join("two.json"), two).expect("a file");
    let run = lobe_in(folder.path(), &["report", "two.json", "-o", "out", "--width", "64", "--samples", "1", "-q"]);
    assert_eq!((text(&run.stderr).as_str(), run.status.code()), ("", Some(0)));

    let facts = fs::read(folder.path().join("out/report.json")).expect("a file");
    let facts: serde_json::Value = serde_json::from_slice(&facts).expect("JSON");
    let subjects = facts["trade"]["subjects"].as_array().expect("a list");
    let names: Vec<_> = subjects.iter().map(|subject| subject["subject"].as_str().expect("a name")).collect();
    assert_eq!(names, ["paint", "paint, view b"]);
    // The scalar f32 and three precisions of the best level; without lanes, all three scalars.
    let numbers = if lobe::batch::levels(lobe::batch::Level::new()).count() == 0 { 3 } else { 4 };
    let rows: Vec<_> = subjects.iter().map(|subject| subject["rows"].as_array().expect("rows")).collect();
    let forms = |rows: &[serde_json::Value]| rows.iter().filter(|row| row["number"] == "f32").count();
    assert!(forms(rows[0]) > 5 && forms(rows[1]) == 1, "{rows:#?}");
    for (subject, rows) in subjects.iter().zip(&rows) {
        assert_eq!(rows.len(), numbers * forms(rows));
        assert!(rows.iter().all(|row| row["ns"]["median"].as_f64() > Some(0.0) && row["ns_streaming"].is_null()));
        // The fastest of all is in front.
        let fastest = rows
            .iter()
            .min_by(|a, b| a["ns"]["median"].as_f64().partial_cmp(&b["ns"]["median"].as_f64()).expect("numbers"));
        assert_eq!(fastest.map(|row| &row["on_front"]), Some(&true.into()));
        assert!(subject["choice"]["steps_of_8_bits"].as_u64() <= Some(1), "{subject:#}");
    }
    assert!(facts["seconds"]["trade"].as_f64() > Some(0.0) && facts["trade"]["noisy"].is_boolean());

    let page = fs::read_to_string(folder.path().join("out/index.html")).expect("a page");
    assert_eq!(page.matches(": time against error</title>").count(), subjects.len());
    assert_eq!(page.matches("<figure class=\"plot trade\">").count(), subjects.len());
    assert_eq!(page.matches("</details>").count(), subjects.len());
    let section = page.split("<section id=\"trade\">").nth(1).and_then(|rest| rest.split("</section>").next());
    let section = section.expect("a section");
    let shown =
        |on_front: bool| rows.iter().flat_map(|rows| rows.iter()).filter(|row| row["on_front"] == on_front).count();
    // The rows in front twice, the others once.
    assert_eq!(section.matches("<th scope=\"row\">").count(), 2 * shown(true) + shown(false));
    assert!(section.contains("The cheapest within 1/255: <b>") && !section.contains("NaN") && !section.contains("inf"));
}

#[test]
fn what_is_black_costs_nothing() {
    let folder = scene();
    let black = "newmtl paint\nKd 0.5 0.5 0.5\nillum 0\n";
    fs::write(folder.path().join("box.mtl"), black).expect("a file");
    let none = r#"{"obj": "box.obj", "materials": {"paint": {"lobes": []}}}"#;
    fs::write(folder.path().join("none.json"), none).expect("a file");
    for scene in ["box.obj", "none.json"] {
        let run = lobe_in(folder.path(), &["report", scene, "-o", "out", "--width", "64", "--samples", "1", "-q"]);
        assert_eq!((text(&run.stderr).as_str(), run.status.code()), ("", Some(0)), "{scene}");
        let page = fs::read_to_string(folder.path().join("out/index.html")).expect("a page");
        assert!(page.ends_with("</html>\n") && !page.contains("What digits cost"), "{scene}");
        let facts = fs::read(folder.path().join("out/report.json")).expect("a file");
        let facts: serde_json::Value = serde_json::from_slice(&facts).expect("JSON");
        assert!(facts.get("trade").is_none(), "{scene}");
        let run = lobe_in(folder.path(), &["trade", scene]);
        assert_eq!(run.status.code(), Some(3), "{scene}");
        assert!(text(&run.stderr).contains("no material of this scene has lobes"), "{scene}");
    }
}
