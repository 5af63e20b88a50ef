//! Runs the program as a user would: what it prints, what it leaves on the disk, and with which exit code it ends.

use lobe::{BlinnPhong, Brdf, Lambert, Rgb, Shininess, Vec3};
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What a run left behind.
struct Run {
    code: Option<i32>,
    out: String,
    err: String,
}

/// Runs `lobe` in a folder with a text on its standard input.
fn lobe_in(folder: &Path, arguments: &[&str], input: &[u8]) -> Run {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lobe"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    let input = input.to_vec();
    // Beside the reading of its output, or both would wait. A program that stops reading is no error here.
    let writer = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().expect("the program ends");
    writer.join().expect("the writer ends");
    Run {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).expect("text"),
        err: String::from_utf8(output.stderr).expect("text"),
    }
}

fn lobe(arguments: &[&str], input: &str) -> Run {
    lobe_in(Path::new("."), arguments, input.as_bytes())
}

/// It fails with this exit code and exactly this one line.
#[track_caller]
fn fails(run: &Run, code: i32, message: &str) {
    assert_eq!(run.err, format!("error: {message}\n"));
    assert_eq!(run.code, Some(code));
}

#[test]
fn eval_prints_the_bits_of_the_library() {
    let plastic = Lambert::new(Rgb::new(0.5_f32, 0.05, 0.05)) + BlinnPhong::new(Rgb::splat(0.04), Shininess(80.0));
    let exact = Lambert::new(Rgb::new(0.5_f64, 0.05, 0.05)) + BlinnPhong::new(Rgb::splat(0.04), Shininess(80.0));
    let pairs = [
        [0.6_f32, 0.0, 0.8, -0.6, 0.0, 0.8],
        [0.0, 0.0, 1.0, 0.0, 0.6, 0.8],
        [0.1, 0.2, 0.97467943, 0.48, -0.64, 0.6],
        [0.99999, 0.0, 0.0044721, 0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0, 0.0, 0.0, 1.0],
    ];
    let csv: String = pairs.iter().map(|p| p.map(|x| format!("{x:?}")).join(",") + "\n").collect();
    let single = lobe(&["eval", "--brdf", "red-plastic"], &csv);
    assert_eq!((single.err.as_str(), single.code), ("", Some(0)));
    let double = lobe(&["eval", "--brdf", "red-plastic", "--number", "f64"], &csv);
    assert_eq!(single.out.lines().count(), pairs.len());
    for ([lx, ly, lz, vx, vy, vz], (line, line64)) in pairs.into_iter().zip(single.out.lines().zip(double.out.lines()))
    {
        let (l, v) = (Vec3::new(lx, ly, lz), Vec3::new(vx, vy, vz));
        let read: Vec<f32> = line.split(',').map(|x| x.parse().expect("a number")).collect();
        assert_eq!(read, <[f32; 3]>::from(plastic.eval(l, v)));
        // The decimal text, read as f64, is not the f32: as the program does, so do we.
        let wide = |x: f32| format!("{x:?}").parse::<f64>().expect("a number");
        let read: Vec<f64> = line64.split(',').map(|x| x.parse().expect("a number")).collect();
        assert_eq!(read, <[f64; 3]>::from(exact.eval(l.map(wide), v.map(wide))));
    }
    // Of a direction near the horizon binary16 keeps what the lobe needs.
    let half = lobe(&["eval", "--brdf", "red-plastic", "--number", "half"], &csv);
    assert_eq!((half.err.as_str(), half.out.lines().count()), ("", pairs.len()));
    let first = |out: &str| out.split(',').next().and_then(|x| x.parse::<f32>().ok()).expect("a number");
    assert!((first(&half.out) / first(&single.out) - 1.0).abs() < 0.005, "{}", half.out);
    // So have the numbers that trade digits, as many as they promise.
    for (number, bound) in [("fast", 2e-3), ("coarse", 2e-2)] {
        let rough = lobe(&["eval", "--brdf", "red-plastic", "--number", number], &csv);
        assert_eq!((rough.err.as_str(), rough.out.lines().count()), ("", pairs.len()));
        assert!((first(&rough.out) / first(&single.out) - 1.0).abs() < bound, "{number}: {}", rough.out);
        assert!(rough.out != single.out, "{number} trades nothing");
    }
}

#[test]
fn eval_takes_comments_headers_and_json() {
    let input = "# pairs\nlx,ly,lz,vx,vy,vz\n\n 0, 0, 1, 0, 0, 1 \r\n0,0,1,0,0,1";
    let run = lobe(&["eval", "--brdf", r#"{"lobes": [{"model": "lambert", "albedo": 1}]}"#], input);
    assert_eq!(run.out, "0.31830987,0.31830987,0.31830987\n".repeat(2));
    let json = lobe(&["eval", "--brdf", "paper", "--json", "--normalize"], "0,0,7,0,0,0.1\n");
    assert_eq!(json.out, "[0.2546479,0.2546479,0.2546479]\n");
    assert_eq!((run.code, json.code), (Some(0), Some(0)));
}

#[test]
fn eval_names_the_line_and_keeps_what_was_right() {
    let good = "0,0,1,0,0,1\n";
    for (line, message) in [
        ("0,0,1,0,0", "5 numbers; a line has six numbers, lx,ly,lz,vx,vy,vz"),
        ("0,0,1,0,0,one", "`one` is not a number; a line has six numbers, lx,ly,lz,vx,vy,vz"),
        ("0,0,1,0,nan,1", "`nan` is not a finite number; a line has six numbers, lx,ly,lz,vx,vy,vz"),
        ("0,0,0,0,0,1", "direction l has length 0; a direction has unit length"),
        ("0,0,1.0009765625,0,0,1", "direction l has length 1.0009765625; give it unit length, or use --normalize"),
        ("0,0,1,0,0,1.5", "direction v has length 1.5; give it unit length, or use --normalize"),
    ] {
        let run = lobe(&["eval", "--brdf", "paper"], &format!("{good}# a comment\n{line}\n{good}"));
        fails(&run, 3, &format!("<stdin>:3: {message}"));
        assert_eq!(run.out, "0.2546479,0.2546479,0.2546479\n");
    }
    let run = lobe_in(Path::new("."), &["eval"], &[0xff, 0xfe, b'\n']);
    fails(&run, 3, "<stdin>:1: this is not text; a line has six numbers, lx,ly,lz,vx,vy,vz");
    let run = lobe_in(Path::new("."), &["eval"], &vec![b' '; 100_000]);
    fails(&run, 3, "<stdin>:1: this line is longer than 8192 bytes; a line has six numbers, lx,ly,lz,vx,vy,vz");
}

#[test]
fn wrong_brdfs_say_what_would_be_right() {
    let known: Vec<_> = lobe_models::models().map(|model| model.name).collect();
    let known = format!("the models are {}", known.join(", "));
    let run = lobe(&["eval", "--brdf", r#"{"lobes": [{"model": "cook"}]}"#], "");
    fails(&run, 3, &format!("--brdf:1:27: lobes[0]: unknown model `cook`; {known}"));
    let run = lobe(&["eval", "--brdf", r#"{"lobes": [{"model": "phong", "ks": 1, "q": 2000000}]}"#], "");
    fails(&run, 3, "--brdf:1:51: lobes[0]: `q` is 2000000.0; a number from 0 to 1000000");
    let run = lobe(&["eval", "--brdf", "[]"], "");
    let right = "a BRDF is an object such as {\"lobes\": [{\"model\": \"lambert\", \"albedo\": 0.8}]}";
    fails(&run, 3, &format!("--brdf:1:1: expected an object; {right}"));
    let run = lobe(&["eval", "--brdf", "@no/such.json"], "");
    let right = "after @ stands a file with a BRDF in JSON";
    fails(&run, 3, &format!("no/such.json: cannot read this file: no such file or directory; {right}"));
    #[cfg(target_os = "linux")]
    {
        let run = lobe(&["eval", "--brdf", "@/dev/zero"], "");
        fails(&run, 3, &format!("/dev/zero: cannot read this file: it has more than 1 MiB; {right}"));
    }
    let run = lobe(&["render", "-o", "a.exr", "--deep"], "");
    fails(&run, 2, "--deep and --exposure are for .png; a.exr is linear and whole already: leave them out");
    let run = lobe(&["plot", "--brdf", "gold-plated"], "");
    assert_eq!(run.code, Some(2));
    assert!(run.err.starts_with("error: unknown preset `gold-plated` for --brdf; the presets are paper, red-plastic"));
    let run = lobe(&["eval", "--number", "wide"], "");
    assert_eq!(run.code, Some(2));
    assert!(run.err.contains("lanes have the bits of f32; use f32, f64, fast, coarse or half"));
    let run = lobe(&["eval", "--brdf", r#"{"lobes": [{"model": "lambert", "albedo": 2}]}"#], "");
    assert_eq!(run.code, Some(0), "above 1 is only a warning");
    assert!(run.err.starts_with("warning: "));
}

#[test]
fn a_million_pairs_in_time() {
    let mut csv = String::new();
    for i in 0..1_000_000_u32 {
        let (a, b) = (f64::from(i % 1000) / 1000.0, f64::from(i / 1000) / 1000.0);
        csv += &format!("{:.6},0,{:.6},0,{:.6},{:.6}\n", a.sin(), a.cos(), b.sin(), b.cos());
    }
    let start = Instant::now();
    let run = lobe(&["eval", "--brdf", "glossy"], &csv);
    // Three seconds is the promise of an optimised build on an idle machine; here neither is sure.
    assert!(start.elapsed() < Duration::from_secs(30));
    assert_eq!((run.out.lines().count(), run.code), (1_000_000, Some(0)));
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_lobe"))
        .args(["eval", "--brdf", "paper"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let mut stdin = child.stdin.take().expect("a pipe");
    let writer = std::thread::spawn(move || drop(stdin.write_all("0,0,1,0,0,1\n".repeat(100_000).as_bytes())));
    let output = child.wait_with_output().expect("the program ends");
    writer.join().expect("the writer ends");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(output.stderr, b"");
}

#[test]
fn plots_are_written_whole_and_old_ones_survive_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    for kind in ["polar", "compare", "surface", "curve", "slices", "terms", "distribution"] {
        let name = format!("{kind}.svg");
        let run = lobe_in(folder.path(), &["plot", "--kind", kind, "--incidence", "60", "-o", &name], b"");
        assert_eq!((run.err.as_str(), run.code), ("", Some(0)));
        let svg = fs::read_to_string(folder.path().join(&name)).expect("a file");
        assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN") && svg.len() > 5000, "{kind}");
        assert!(svg.contains("prefers-color-scheme:dark"));
    }
    let old = fs::read(folder.path().join("polar.svg")).expect("a file");
    let run = lobe_in(folder.path(), &["plot", "--brdf", "{", "-o", "polar.svg"], b"");
    assert_eq!(run.code, Some(3));
    assert_eq!(fs::read(folder.path().join("polar.svg")).expect("a file"), old);
    let run = lobe_in(folder.path(), &["plot", "-o", "no/folder/a.svg"], b"");
    let right = "name a file in a folder that exists and can be written to";
    fails(&run, 4, &format!("no/folder/a.svg: cannot write this: no such file or directory; {right}"));
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 7, "no temporary file is left");
}

#[test]
fn a_plot_is_svg_and_numbers_below_the_range_are_said_to_be() {
    for name in ["a.png", "a.txt", "a"] {
        let right = "plots end in .svg, or - is standard output";
        fails(&lobe(&["plot", "-o", name], ""), 2, &format!("{name}: unknown kind of file; {right}"));
    }
    for arguments in [
        ["plot", "--incidence", "-5"],
        ["plot", "--q", "-1"],
        ["render", "--samples", "-1"],
        ["report", "--width", "-1"],
        ["sweep", "--stride", "-1"],
    ] {
        let run = lobe(&arguments, "");
        assert_eq!(run.code, Some(2));
        assert!(run.err.starts_with("error: invalid value '-"), "{}", run.err);
    }
}

#[test]
fn extreme_lobes_can_be_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let brdfs = [
        r#"{"lobes": []}"#,
        r#"{"lobes": [{"model": "phong", "ks": 3e38, "q": 1e6}]}"#,
        r#"{"lobes": [{"model": "lecture-phong", "ks": 0, "q": 0}]}"#,
        r#"{"name": "</svg><script>\u0000*_{", "lobes": [{"model": "lambert", "albedo": 1e-300}]}"#,
    ];
    for brdf in brdfs {
        for kind in [&["polar"][..], &["polar", "--log"], &["surface"], &["curve"], &["slices"], &["slices", "--log"]] {
            for incidence in ["0", "89.9"] {
                let arguments = ["--brdf", brdf, "--incidence", incidence, "-o", "a.svg", "-q"];
                let arguments = [&["plot", "--kind"], kind, &arguments].concat();
                let run = lobe_in(folder.path(), &arguments, b"");
                assert_eq!((run.err.as_str(), run.code), ("", Some(0)), "{kind:?} {brdf}");
                let svg = fs::read_to_string(folder.path().join("a.svg")).expect("a file");
                assert!(!svg.contains("NaN") && !svg.contains("inf") && !svg.contains("<script"), "{kind:?} {brdf}");
            }
        }
    }
}

#[test]
fn the_terms_of_microfacet_lobes_are_drawn_and_others_have_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let sharp =
        r#"{"lobes": [{"model": "microfacet", "distribution": "beckmann", "alpha": [1e-4, 1], "masking": "kelemen"}]}"#;
    let student =
        r#"{"lobes": [{"model": "microfacet", "distribution": "student-t", "alpha": 1, "fresnel": "lazanyi"}]}"#;
    for brdf in [sharp, student, "ggx-gold", "ngan:nickel/cook-torrance"] {
        for kind in [&["terms"][..], &["distribution"], &["distribution", "--log"]] {
            let arguments = [&["plot", "--kind"], kind, &[brdf, "-o", "a.svg", "-q"]].concat();
            let run = lobe_in(folder.path(), &arguments, b"");
            assert_eq!((run.err.as_str(), run.code), ("", Some(0)), "{kind:?} {brdf}");
            let svg = fs::read_to_string(folder.path().join("a.svg")).expect("a file");
            assert!(!svg.contains("NaN") && !svg.contains("inf") && svg.len() > 5000, "{kind:?} {brdf}");
            // One curve for each width, and three channels where they differ.
            let curves = |class: &str| svg.matches(&format!("<path class=\"{class}\"")).count();
            assert_eq!(curves("c1") > 0, brdf == sharp || kind == ["terms"], "{kind:?} {brdf}");
            assert_eq!(curves("green") > 0, brdf == "ggx-gold" && kind == ["terms"], "{kind:?} {brdf}");
        }
    }
    let models = "microfacet, torrance-sparrow, ashikhmin-premoze-shirley, tabulated-facets, cook-torrance, \
                  blinn-1977";
    for kind in ["terms", "distribution"] {
        let run = lobe(&["plot", "--kind", kind, "glossy", "-o", "a.svg"], "");
        fails(&run, 2, &format!("`glossy` has no lobe that is made of D, G and F; the models that are: {models}"));
    }
    let run = lobe(&["plot", "--kind", "slices", "paper", "glossy"], "");
    fails(&run, 2, "2 BRDFs; --kind slices draws at most 1");
    let run = lobe(&["plot", "--kind", "terms", "--log"], "");
    fails(&run, 2, "--log is not for --kind terms; leave it out, or take --kind polar, slices, image or distribution");
}

#[test]
fn sweep_says_whether_the_bounds_hold() {
    let run = lobe(&["sweep", "recip", "--stride", "1000003", "--json"], "");
    assert_eq!(run.code, Some(0));
    let found: serde_json::Value = serde_json::from_str(&run.out).expect("JSON");
    assert_eq!(found[0]["function"], "recip");
    assert_eq!(found[0]["holds"], true);
    let run = lobe(&["sweep", "rsqrt", "--precision", "coarse", "--stride", "1000003", "--json"], "");
    assert_eq!(run.code, Some(0));
    let found: serde_json::Value = serde_json::from_str(&run.out).expect("JSON");
    assert_eq!((&found[0]["precision"], &found[0]["level"]), (&"coarse".into(), &"scalar".into()));
    assert_eq!(found[0]["allowed_relative"], 6.6e-4);
    let run = lobe(&["sweep", "tan"], "");
    let names: Vec<_> = lobe_verify::sweep::FUNCTIONS.iter().map(|function| function.name).collect();
    fails(&run, 2, &format!("unknown function `tan`; the functions are {}", names.join(", ")));
}

#[test]
fn help_and_completions_are_there() {
    let help = lobe(&["--help"], "");
    assert!(help.out.contains("Exit codes:") && help.code == Some(0));
    for shell in ["bash", "zsh", "fish"] {
        let run = lobe(&["completions", shell], "");
        assert!(run.out.contains("lobe") && run.code == Some(0), "{shell}");
    }
    let run = lobe(&["eval", "--list-presets", "--json"], "");
    let presets: serde_json::Value = serde_json::from_str(&run.out).expect("JSON");
    assert_eq!(presets["paper"]["lobes"][0]["model"], "lambert");
    assert_eq!(lobe(&["shine"], "").code, Some(2));
}

#[test]
fn models_are_those_of_the_catalogue() {
    let run = lobe(&["models", "--json"], "");
    let list: serde_json::Value = serde_json::from_str(&run.out).expect("JSON");
    let names: Vec<_> = list.as_array().expect("a list").iter().filter_map(|model| model["name"].as_str()).collect();
    assert_eq!(names, lobe_models::models().map(|model| model.name).collect::<Vec<_>>());
    let (table, help) = (lobe(&["models"], "").out, lobe(&["eval", "--help"], "").out);
    for name in names {
        assert!(table.lines().any(|line| line.starts_with(&format!("{name}  "))), "{name}");
        assert!(help.contains(name), "{name}");
    }
    let run = lobe(&["models", "microfact"], "");
    assert_eq!(run.code, Some(2));
    assert!(run.err.starts_with("error: unknown model `microfact`; the nearest are microfacet, "), "{}", run.err);
    assert!(lobe(&["models", "phong"], "").out.contains("a number from 0 to 1000000"));
}

#[test]
fn eval_takes_every_model() {
    for model in lobe_models::models() {
        let mut lobe_json = serde_json::json!({"model": model.name});
        for parameter in model.parameters.iter().filter(|parameter| parameter.default.is_none()) {
            lobe_json[parameter.name] = match parameter.kind {
                lobe_models::Kind::Number { min, max } => serde_json::json!(min + (max - min) * 0.125),
                lobe_models::Kind::Colour { max } => serde_json::json!(0.5 * max),
                lobe_models::Kind::Widths => serde_json::json!([0.25, 0.5]),
                lobe_models::Kind::Table => serde_json::json!(vec![1.0; lobe_models::TABLE]),
                lobe_models::Kind::Choice(words) => serde_json::json!(words[0]),
            };
        }
        let brdf = serde_json::json!({"lobes": [lobe_json]}).to_string();
        let run = lobe(&["eval", "--brdf", &brdf], "0,0,1,0,0.6,0.8\n");
        assert_eq!((run.err.as_str(), run.code, run.out.lines().count()), ("", Some(0), 1), "{brdf}");
    }
}

#[test]
fn measured_materials_are_evaluated_drawn_and_rendered() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = lobe(&["eval", "--brdf", "ngan:pvc/ward", "--number", "f64"], "0,0,1,0,0,1\n");
    // kd/π + ks/(4π α²) of the table.
    let fit = lobe_models::ngan::fit("pvc", "ward").expect("a fit");
    let alpha = fit.parameter("alpha").expect("a width");
    let expected = (fit.kd[1] + fit.ks[1] / (4.0 * alpha * alpha)) / std::f64::consts::PI;
    let green: f64 = run.out.split(',').nth(1).expect("three numbers").parse().expect("a number");
    assert!((green / expected - 1.0).abs() < 1e-12 && run.err.is_empty(), "{green} {expected}");

    let run = lobe_in(folder.path(), &["plot", "--brdf", "ngan:pvc/cook-torrance", "-o", "a.svg", "-q"], b"");
    assert_eq!((run.err.as_str(), run.code), ("", Some(0)));
    let size = ["--width", "32", "--height", "18", "--samples", "1", "-q"];
    let with = |first: &[&'static str]| -> Vec<&'static str> { first.iter().copied().chain(size).collect() };
    let paint = with(&["render", "--material", "dark-blue-paint", "--model", "ward", "-o", "a.png"]);
    let run = lobe_in(folder.path(), &paint, b"");
    assert_eq!((run.err.as_str(), run.code), ("", Some(0)));
    write_scene(folder.path());
    for (name, material) in [("b.pfm", "ngan:pvc/ward"), ("c.pfm", "ggx-gold")] {
        let run = lobe_in(folder.path(), &with(&["render", "s.obj", "--material", material, "-o", name]), b"");
        assert_eq!((run.err.as_str(), run.code), ("", Some(0)));
    }
    let read = |name: &str| fs::read(folder.path().join(name)).expect("a file");
    assert!(read("b.pfm") != read("c.pfm"), "the material is that of the whole scene");

    let run = lobe(&["render", "--material", "dark-blu-paint", "-o", "a.png"], "");
    let right = "the nearest are dark-blue-paint, light-brown-fabric";
    assert!(run.err.starts_with("error: --material dark-blu-paint: unknown material `dark-blu-paint`"), "{}", run.err);
    assert!(run.err.contains(&right[..30]) && run.code == Some(2), "{}", run.err);
    let run = lobe(&["plot", "--brdf", "ngan:pvc/phong"], "");
    assert!(run.err.contains("the materials are not fitted with `phong`, but with "), "{}", run.err);
    let run = lobe(&["render", "--model", "ward", "-o", "a.png"], "");
    fails(&run, 2, "--model is for --material or --contact-sheet; name a material too");
    let list = lobe(&["models", "--materials"], "");
    assert!(list.out.lines().any(|line| line.starts_with("dark-blue-paint  ")) && list.out.lines().count() == 89);
}

#[test]
fn a_contact_sheet_shows_all_materials() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = ["render", "--contact-sheet", "--width", "640", "--samples", "1", "--json", "-o", "s.png"];
    let run = lobe_in(folder.path(), &arguments, b"");
    assert_eq!(run.code, Some(0), "{}", run.err);
    let facts: serde_json::Value = serde_json::from_str(&run.out).expect("JSON");
    assert_eq!(facts["materials"].as_array().map(Vec::len), Some(86));
    assert!(fs::read(folder.path().join("s.png")).expect("a file").starts_with(b"\x89PNG"));
    let run = lobe_in(folder.path(), &["render", "--contact-sheet", "--width", "64", "-o", "s.png"], b"");
    fails(&run, 2, "s.png: a contact sheet is a .png of at least 640 pixels in a row; the width is 64");
    let run = lobe_in(folder.path(), &["render", "--contact-sheet", "--model", "phong", "-o", "s.png"], b"");
    assert!(run.err.starts_with("error: --model phong: the materials are not fitted with `phong`"), "{}", run.err);
}

/// A floor and a material with a highlight that gains energy.
fn write_scene(folder: &Path) {
    let obj = "mtllib s.mtl\nusemtl glow\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 4 3 2 1\n";
    let mtl = "newmtl glow\nKd 0.9 0.2 0.1\nKs 0.8 0.8 0.8\nNs 2\nillum 2\n";
    fs::write(folder.join("s.obj"), obj).expect("written");
    fs::write(folder.join("s.mtl"), mtl).expect("written");
}

#[test]
fn render_writes_a_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    write_scene(folder.path());
    for (name, start) in [("a.png", &b"\x89PNG"[..]), ("a.exr", b"\x76\x2f\x31\x01"), ("a.pfm", b"PF\n")] {
        let arguments = ["render", "s.obj", "--width", "32", "--height", "18", "-o", name];
        let run = lobe_in(folder.path(), &arguments, b"");
        assert_eq!(run.code, Some(0), "{}", run.err);
        assert!(run.out.starts_with(&format!("{name}: view `default`, 32x18, 4 samples, 2 triangles")), "{}", run.out);
        assert!(fs::read(folder.path().join(name)).expect("a file").starts_with(start));
    }
    let run = lobe_in(folder.path(), &["render", "s.obj", "-o", "a.jpg"], b"");
    fails(&run, 2, "a.jpg: unknown kind of file; pictures end in .png, .exr or .pfm");
    let run = lobe_in(folder.path(), &["render", "s.obj", "--view", "top", "-o", "a.png"], b"");
    fails(&run, 2, "the name of the view is `top`; the only view of this scene is `default`");
    let run = lobe_in(folder.path(), &["render", ".", "-o", "a.png"], b"");
    assert!(run.err.starts_with("error: .: cannot read this file: it is a folder"), "{}", run.err);
}

#[test]
fn wrong_scenes_name_file_and_line_and_leave_old_pictures_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    write_scene(folder.path());
    fs::write(folder.path().join("old.png"), "an old picture").expect("written");
    let run = |scene: &str| lobe_in(folder.path(), &["render", scene, "-o", "old.png"], b"");

    let missing = run("none.obj");
    fails(
        &missing,
        3,
        "none.obj: cannot read this file: no such file or directory; give a file that is there and can be read",
    );
    fs::write(folder.path().join("face.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n").expect("written");
    let face = run("face.obj");
    assert!(face.err.starts_with("error: face.obj:4: ") && face.err.contains("; "), "{}", face.err);
    for wrong in ["Ns -5", "Kd nan 0 0"] {
        fs::write(folder.path().join("s.mtl"), format!("newmtl glow\n{wrong}\n")).expect("written");
        let mtl = run("s.obj");
        assert!(mtl.err.starts_with("error: s.mtl:2: ") && mtl.err.contains("; "), "{}", mtl.err);
        assert_eq!(mtl.code, Some(3));
    }
    fs::write(folder.path().join("a.json"), "{\"obj\": \"s.obj\",\n \"lamps\": []}").expect("written");
    let json = run("a.json");
    assert!(json.err.starts_with("error: a.json:2:8: unknown field `lamps`"), "{}", json.err);
    for run in [missing, face, json] {
        assert_eq!((run.code, run.err.lines().count()), (Some(3), 1), "{}", run.err);
    }
    assert_eq!(fs::read(folder.path().join("old.png")).expect("a file"), b"an old picture");
}

#[test]
fn a_report_is_one_page_that_needs_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    write_scene(folder.path());
    let arguments = ["report", "s.obj", "-o", "out", "--width", "64", "--samples", "1"];
    let run = lobe_in(folder.path(), &arguments, b"");
    assert_eq!((run.err.as_str(), run.code), ("", Some(0)));
    assert_eq!(run.out.lines().count(), 10, "{}", run.out);

    let page = fs::read_to_string(folder.path().join("out/index.html")).expect("a page");
    let images: Vec<&str> = page.split("<img").skip(1).collect();
    // The view, again by rays and by paths, and a sphere of its one material, lit and in a white world.
    assert_eq!(images.len(), 5);
    assert!(
        images
            .iter()
            .all(|image| image.split('>').next().is_some_and(|tag| tag.contains("src=\"data:image/png;base64,")))
    );
    for resource in ["src=\"http", "href=\"http", "url(", "@import", "<script ", "<link"] {
        assert!(!page.contains(resource), "{resource}");
    }
    assert!(!page.contains("NaN<") && page.ends_with("</html>\n"));
    // A tag that is opened is closed.
    for tag in ["section", "div", "table", "figure", "details", "svg", "tr", "td", "p", "ul", "g"] {
        let opened = page.matches(&format!("<{tag} ")).count() + page.matches(&format!("<{tag}>")).count();
        assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    assert!(page.contains("gains energy"));
    for id in ["between", "samples"] {
        assert!(
            page.contains(&format!("<section id=\"{id}\">")) && page.contains(&format!("<a href=\"#{id}\">")),
            "{id}"
        );
    }

    let facts = fs::read_to_string(folder.path().join("out/report.json")).expect("a file");
    let facts: serde_json::Value = serde_json::from_str(&facts).expect("JSON");
    assert_eq!(facts["materials"].as_array().map(Vec::len), Some(1));
    assert_eq!(facts["materials"][0]["gains_energy"], true);
    assert_eq!(facts["materials"][0]["albedo"].as_array().map(Vec::len), Some(3));
    assert_eq!((&facts["between"]["traced"]["samples"], &facts["between"]["nan_samples"]), (&16.into(), &0.into()));
    assert!(facts["materials"][0]["sampling"]["relative_variance"].as_f64().is_some_and(|x| x < 1.0), "{facts:#}");
    let checks = facts["checks"].as_array().expect("a list");
    assert!(checks.len() == 5 && checks.iter().all(|check| check["holds"] == true), "{checks:#?}");
    assert_eq!(facts["command"], "lobe report s.obj -o out --samples 1 --width 64");

    // A run that fails leaves it as it is.
    let old = fs::read(folder.path().join("out/index.html")).expect("a page");
    fs::write(folder.path().join("s.mtl"), "newmtl glow\nNs -1\n").expect("written");
    assert_eq!(lobe_in(folder.path(), &arguments, b"").code, Some(3));
    assert_eq!(fs::read(folder.path().join("out/index.html")).expect("a page"), old);
    assert_eq!(fs::read_dir(folder.path().join("out")).expect("a folder").count(), 2);
}

#[test]
fn a_report_lists_and_draws_what_a_view_puts_in_the_place_of_a_material() {
    let folder = tempfile::tempdir().expect("a folder");
    write_scene(folder.path());
    let scene = r#"{"obj": "s.obj", "views": [{"name": "a"}, {"name": "b", "materials": {"*": "ggx-gold"}},
                    {"name": "c", "materials": {"glow": "ggx-gold"}}]}"#;
    fs::write(folder.path().join("s.json"), scene).expect("written");
    let arguments = ["report", "s.json", "-o", "out", "--width", "64", "--samples", "1", "-q"];
    assert_eq!(lobe_in(folder.path(), &arguments, b"").code, Some(0));
    let facts = fs::read_to_string(folder.path().join("out/report.json")).expect("a file");
    let facts: serde_json::Value = serde_json::from_str(&facts).expect("JSON");
    let materials = facts["materials"].as_array().expect("a list");
    let names: Vec<_> = materials.iter().map(|material| (&material["name"], &material["views"])).collect();
    let views = serde_json::json!(["b", "c"]);
    assert_eq!(names, [(&"glow".into(), &serde_json::Value::Null), (&"ggx-gold".into(), &views)]);
    let page = fs::read_to_string(folder.path().join("out/index.html")).expect("a page");
    for title in ["Models side by side", "Slices of ggx-gold", "The distributions of", "The terms of ggx-gold"] {
        assert!(page.contains(title), "{title}");
    }
}

#[test]
fn a_report_that_cannot_be_written_says_so_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    write_scene(folder.path());
    fs::write(folder.path().join("file"), "not a folder").expect("written");
    let right = "name a folder that can be made and written to with -o";
    let run = lobe_in(folder.path(), &["report", "s.obj", "-o", "file"], b"");
    fails(&run, 4, &format!("file: cannot write this: it is a file, not a folder; {right}"));
    let run = lobe_in(folder.path(), &["report", "s.obj", "-o", "file/below"], b"");
    fails(&run, 4, &format!("file/below: cannot write this: not a directory; {right}"));

    // Nothing of the two files is written when one of them cannot be.
    fs::create_dir_all(folder.path().join("out/report.json")).expect("a folder");
    let start = Instant::now();
    let run = lobe_in(folder.path(), &["report", "s.obj", "-o", "out", "--samples", "4096"], b"");
    let right = "name a file in a folder that exists and can be written to";
    fails(&run, 4, &format!("out/report.json: cannot write this: it is a folder; {right}"));
    assert!(start.elapsed() < Duration::from_secs(10));
    assert_eq!(fs::read_dir(folder.path().join("out")).expect("a folder").count(), 1);
}

#[test]
fn a_picture_that_cannot_be_written_says_so_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    write_scene(folder.path());
    fs::create_dir(folder.path().join("folder.png")).expect("a folder");
    let right = "name a file in a folder that exists and can be written to";
    for (target, why) in [("folder.png", "it is a folder"), ("no/a.png", "no such file or directory")] {
        let start = Instant::now();
        let run = lobe_in(folder.path(), &["render", "s.obj", "--samples", "4096", "-o", target], b"");
        fails(&run, 4, &format!("{target}: cannot write this: {why}; {right}"));
        assert!(start.elapsed() < Duration::from_secs(10));
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 3, "no temporary file is left");
}

#[test]
fn pictures_are_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_lobe")).args(arguments).current_dir(folder.path()).output();
        let output = output.expect("it runs");
        let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    for (name, extra) in
        [("a.exr", vec![]), ("b.exr", vec!["--precision", "coarse"]), ("c.png", vec!["--size", "32x18"])]
    {
        let mut arguments = vec!["render", "-q", "--samples", "1", "-o", name];
        arguments.extend(if extra.contains(&"--size") { vec![] } else { vec!["--width", "64", "--height", "36"] });
        arguments.extend(extra);
        let (code, _, errors) = run(&arguments);
        assert_eq!((code, errors.as_str()), (Some(0), ""), "{name}");
    }
    let (code, text, _) = run(&["diff", "a.exr", "a.exr", "--max", "0"]);
    assert!(code == Some(0) && text.contains("0 of 2304 pixels differ"), "{text}");
    let (code, text, errors) = run(&["diff", "a.exr", "b.exr", "--max", "1", "-o", "d.png", "--json"]);
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    let facts: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert!(
        facts["delta_e_2000"]["worst"].as_f64() > Some(0.0) && facts["steps_of_8_bits"].as_u64() <= Some(2),
        "{text}"
    );
    assert!(folder.path().join("d.png").exists());
    let (code, _, errors) = run(&["diff", "a.exr", "b.exr", "--max", "0"]);
    assert!(code == Some(1) && errors.contains("at most 0 is allowed"), "{errors}");
    let (code, _, errors) = run(&["diff", "a.exr", "c.png"]);
    assert!(code == Some(3) && errors.contains("give two pictures of one size"), "{errors}");
    let (code, _, errors) = run(&["diff", "a.exr", "none.png"]);
    assert!(code == Some(3) && errors.contains("none.png: cannot read this file"), "{errors}");
    for (argument, value, expected) in [
        ("--camera", "1,2:3", "EYE:TARGET"),
        ("--light", "moon:1,2,3:4", "point:X,Y,Z:I"),
        ("--environment", "-1", "a radiance such as"),
        ("--tone", "filmic", "pbr-neutral"),
        ("--size", "0x5", "such as 640x360"),
    ] {
        let (code, _, errors) = run(&["render", "-o", "x.png", argument, value]);
        assert!(code == Some(2) && errors.contains(expected), "{argument}: {errors}");
    }
}

/// A signal in the middle of a picture and of a report: what was there stays, and nothing new is left.
///
/// It is not that of Ctrl-C, which the program takes in the same way: a shell has the tests ignore that when it runs them in the
/// background, and what they start inherits it.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_no_half_file() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("old.png"), "old").expect("a file");
    for arguments in [
        &["render", "--samples", "4096", "-o", "old.png"][..],
        &["render", "--samples", "4096", "-o", "new.png"],
        &["report", "--samples", "256", "-o", "."],
    ] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_lobe"))
            .args(arguments)
            .current_dir(folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        std::thread::sleep(Duration::from_millis(700));
        let sent = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().expect("a signal");
        let status = child.wait().expect("the program ends");
        assert!(sent.success() && status.code().is_none(), "{arguments:?} ended before: {status}");
        let names: Vec<_> =
            fs::read_dir(folder.path()).expect("the folder").map(|e| e.expect("an entry").file_name()).collect();
        assert_eq!(names, ["old.png"], "{arguments:?}");
        assert_eq!(fs::read_to_string(folder.path().join("old.png")).expect("a file"), "old");
    }
}
