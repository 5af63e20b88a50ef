//! Samples and paths, as a user asks for them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn lobe_in(folder: &Path, threads: &str, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lobe"))
        .args(arguments)
        .current_dir(folder)
        .env("RAYON_NUM_THREADS", threads)
        .output()
        .expect("the command runs")
}

fn lobe(arguments: &[&str]) -> Output {
    lobe_in(Path::new("."), "2", arguments)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// It fails with this exit code, and the one line says this.
#[track_caller]
fn fails(run: &Output, code: i32, message: &str) {
    let said = text(&run.stderr);
    assert_eq!(run.status.code(), Some(code), "{said}");
    assert!(said.starts_with("error: ") && said.contains(message) && said.lines().count() == 1, "{said}");
}

/// The numbers of a line of samples, which has one kind and seven of them.
fn numbers(line: &str) -> (&str, [f64; 7]) {
    let (kind, rest) = line.split_once(',').expect("a kind");
    let numbers: Vec<f64> = rest.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
    (kind, numbers.try_into().expect("seven numbers"))
}

#[test]
fn samples_are_lines_of_directions_weights_and_densities() {
    let arguments = ["sample", "--brdf", "ggx-gold", "--view", "60:30", "-n", "500", "--number", "f64"];
    let run = lobe(&arguments);
    let (table, said) = (text(&run.stdout), text(&run.stderr));
    assert_eq!(run.status.code(), Some(0), "{said}");
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("kind,lx,ly,lz,r,g,b,pdf"));
    let (mut sum, mut count, mut rejected) = (0.0, 0, 0);
    for line in lines {
        count += 1;
        let (kind, [x, y, z, r, g, b, pdf]) = numbers(line);
        if kind == "rejected" {
            assert_eq!(line, "rejected,,,,0,0,0,");
            rejected += 1;
            continue;
        }
        assert_eq!(kind, "scattered");
        assert!((x * x + y * y + z * z - 1.0).abs() < 1e-12 && z > 0.0 && pdf > 0.0, "{line}");
        assert!(r >= g && g >= b && b > 0.0, "{line}");
        sum += r;
    }
    assert_eq!(count, 500);
    // What is said of them is of these lines.
    let mean = format!("500 samples; mean weight {:.5} ±", sum / 500.0);
    assert!(
        said.starts_with(&mean) && said.contains(&format!("rejected {:.3} %", f64::from(rejected) / 5.0)),
        "{said}"
    );

    assert_eq!(lobe(&arguments).stdout, run.stdout);
    let other = lobe(&[&arguments[..], &["--seed", "1"]].concat());
    let even = lobe(&[&arguments[..], &["--sequence", "sobol"]].concat());
    assert!(other.stdout != run.stdout && even.stdout != run.stdout && even.stdout != other.stdout);
}

#[test]
fn samples_as_json_have_their_kind() {
    let mirror = r#"{"lobes": [{"model": "lambert", "albedo": 0.5}]}"#;
    let run = lobe(&["sample", "--brdf", mirror, "-n", "20", "--json", "-q"]);
    assert_eq!((run.status.code(), text(&run.stderr)), (Some(0), String::new()));
    let lines: Vec<serde_json::Value> =
        text(&run.stdout).lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.len(), 20);
    for line in lines {
        assert_eq!(line["kind"], "scattered");
        // By the cosine, each weight is the albedo.
        assert_eq!(line["weight"], serde_json::json!([0.5, 0.5, 0.5]));
        let (z, pdf) = (line["l"][2].as_f64().expect("a number"), line["pdf"].as_f64().expect("a number"));
        assert!((pdf * std::f64::consts::PI - z).abs() < 1e-6, "{line}");
    }
}

#[test]
fn what_cannot_be_sampled_says_what_can() {
    for view in ["90", "-0.6,0,-0.8", "north", "1,1,1"] {
        let run = lobe(&["sample", "--view", view]);
        fails_in_usage(&run, "degrees from the normal below 90");
    }
    fails(&lobe(&["sample", "--number", "fast"]), 2, "give --number f32 or f64");
    fails(&lobe(&["sample", "--brdf", "ggx-glod"]), 2, "unknown preset `ggx-glod` for --brdf; the presets are");
    fails(&lobe(&["verify", "--sampling", "lambret"]), 2, "unknown model `lambret`; the nearest");
}

/// An error that `clap` words, in more than one line.
#[track_caller]
fn fails_in_usage(run: &Output, message: &str) {
    let said = text(&run.stderr);
    assert_eq!(run.status.code(), Some(2), "{said}");
    assert!(said.starts_with("error: ") && said.contains(message), "{said}");
}

#[test]
fn a_sampler_is_verified() {
    let run = lobe(&["verify", "--sampling", "--fast", "--brdf", "ggx-gold"]);
    let table = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{table}{}", text(&run.stderr));
    for name in ["ggx-gold, f64", "ggx-gold, f32"] {
        let rows = table.lines().filter(|line| line.starts_with(&format!("| {name} |")));
        assert_eq!(rows.filter(|row| row.ends_with("| holds |")).count(), 3, "{table}");
    }
    let run = lobe(&["verify", "--sampling", "--fast", "lambert", "--json"]);
    let suite: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    assert_eq!(suite["significance"], 1e-3);
    let names: Vec<_> = suite["reports"].as_array().expect("a list").iter().map(|report| &report["name"]).collect();
    assert!(names.iter().all(|name| name.as_str().is_some_and(|name| name.starts_with("lambert"))), "{names:?}");
}

#[test]
fn samples_are_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |arguments: &[&str]| {
        let run = lobe_in(folder.path(), "2", &[&["plot", "ggx-gold", "-o", "a.svg", "-q"], arguments].concat());
        assert_eq!((run.status.code(), text(&run.stderr)), (Some(0), String::new()));
        fs::read_to_string(folder.path().join("a.svg")).expect("a file")
    };
    let (long, short) = (run(&["--kind", "samples"]), run(&["--samples"]));
    assert_eq!(long, short);
    assert!(long.ends_with("</svg>\n") && long.matches("h0").count() > 100, "dots");
    let both = lobe_in(folder.path(), "2", &["plot", "ggx-gold", "--samples", "--kind", "polar"]);
    fails_in_usage(&both, "cannot be used with");
}

#[test]
fn paths_make_the_same_picture_on_any_number_of_threads() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).expect("written");
    write("s.obj", b"mtllib s.mtl\nusemtl paint\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 4 3 2 1\n");
    write("s.mtl", b"newmtl paint\nKd 0.6 0.2 0.1\nKs 0.2 0.2 0.2\nNs 50\nillum 2\n");
    // Light from above only: two rows of a portable float map, the lower one first.
    let row = |x: f32| [x; 12].into_iter().flat_map(f32::to_le_bytes);
    write("sky.pfm", &b"PF\n4 2\n-1.0\n".iter().copied().chain(row(0.0)).chain(row(1.0)).collect::<Vec<_>>());
    let common = ["render", "s.obj", "--path", "--width", "16", "--height", "9", "--samples", "8", "-q", "-o", "a.pfm"];
    let picture = |threads: &str, more: &[&str]| {
        let run = lobe_in(folder.path(), threads, &[&common[..], more].concat());
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        fs::read(folder.path().join("a.pfm")).expect("a file")
    };
    let sky = ["--environment-map", "sky.pfm"];
    let one = picture("1", &sky);
    assert_eq!(one, picture("3", &sky));
    assert_ne!(one, picture("1", &["--seed", "7", sky[0], sky[1]]));
    assert_ne!(one, picture("1", &["--environment", "0.2:0.8"]));

    let run = lobe_in(folder.path(), "1", &[&common[..], &["--environment-map", "none.exr"]].concat());
    fails(&run, 3, "none.exr: cannot read this file");
    assert_eq!(fs::read(folder.path().join("a.pfm")).expect("a file"), picture("1", &["--environment", "0.2:0.8"]));
    fails_in_usage(&lobe_in(folder.path(), "1", &["render", "s.obj", "--seed", "1"]), "--path");
}
