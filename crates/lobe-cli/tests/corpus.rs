//! Hostile inputs, kept: each is read and, if it can be, evaluated, without a panic, and every error is one line.
//!
//! The files in `tests/corpus` were chosen by hand or found by the targets in `fuzz/`, of which they are the seeds.

use lobe::Vec3;
use lobe_cli::{eval, spec};
use std::path::Path;

/// All files of one kind, with their names.
fn files(kind: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(kind);
    let mut files: Vec<_> = std::fs::read_dir(&folder)
        .expect("the folder is there")
        .map(|entry| {
            let path = entry.expect("the folder can be read").path();
            (path.display().to_string(), std::fs::read(&path).expect("the file can be read"))
        })
        .collect();
    files.sort();
    assert!(files.len() >= 8, "{}: only {} files", folder.display(), files.len());
    files
}

#[test]
fn brdfs() {
    let mut built = 0;
    for (path, content) in files("brdf") {
        let text = String::from_utf8_lossy(&content);
        match spec::parse(&text, "x") {
            Ok(spec) => {
                let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.48, 0.36, 0.8));
                let f = spec.build::<f64>().eval_cos(l, v);
                assert!(f.r >= 0.0 && f.g >= 0.0 && f.b >= 0.0, "{path}: {f:?}");
                let _ = spec.build::<f32>().eval(l.map(|c| c as f32), v.map(|c| c as f32));
                let _ = (spec.description(), spec.warnings());
                built += 1;
            }
            Err(failure) => {
                let message = failure.to_string();
                assert!(message.starts_with("x:") && message.lines().count() == 1, "{path}: {message:?}");
            }
        }
    }
    assert!(built >= 3, "only {built} could be built");
}

#[test]
fn lines() {
    for (path, content) in files("csv") {
        for normalize in [false, true] {
            check::<f32>(&path, &content, normalize);
            check::<f64>(&path, &content, normalize);
            check::<lobe::Half>(&path, &content, normalize);
        }
    }
}

fn check<R: eval::Scalar>(path: &str, line: &[u8], normalize: bool) {
    match eval::parse_line::<R>(line, normalize) {
        Ok(eval::Line::Pair(l, v)) => {
            for direction in [l, v] {
                let length = direction.map(R::wide).length();
                assert!((length - 1.0).abs() <= R::LENGTH_TOLERANCE, "{path}: {direction:?}");
            }
        }
        Ok(eval::Line::Skip) => {}
        Err(problem) => assert_eq!(problem.lines().count(), 1, "{path}: {problem:?}"),
    }
}
