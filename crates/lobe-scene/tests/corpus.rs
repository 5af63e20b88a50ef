//! Hostile files, kept: each is read and, if it can be, drawn with every shading model, without a panic and quickly.
//!
//! The files in `tests/corpus` were chosen by hand or found by the targets in `fuzz/`, of which they are the seeds.
//! One holds several files: the first, then each after a line `@name`.

use lobe_scene::image::Display;
use lobe_scene::{Error, LoadOptions, Renderer, Scene, Settings, ShadingModel, gltf, mtl, obj, parse_description};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Far more than any needs, and far less than a reader that has lost its way.
const QUICK: Duration = Duration::from_secs(10);

/// All files of one kind.
fn files(kind: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(kind);
    let entries = std::fs::read_dir(&folder).expect("the folder is there");
    let mut files: Vec<_> = entries
        .map(|entry| {
            let path = entry.expect("the folder can be read").path();
            let content = std::fs::read(&path).expect("the file can be read");
            (path, content)
        })
        .collect();
    files.sort();
    assert!(files.len() >= 8, "{}: only {} files", folder.display(), files.len());
    files
}

/// The first file of an input, and the others by name; any other name gets the second file, as in `fuzz/src/lib.rs`.
fn sections(input: &[u8]) -> (&[u8], impl FnMut(&str) -> io::Result<Vec<u8>>) {
    let starts = (0..input.len()).filter(|&at| input[at] == b'@' && (at == 0 || input[at - 1] == b'\n'));
    let mut cuts: Vec<usize> = starts.collect();
    let first = &input[..cuts.first().copied().unwrap_or(input.len())];
    cuts.push(input.len());
    let others: Vec<(&[u8], &[u8])> = cuts
        .windows(2)
        .map(|cut| {
            let section = &input[cut[0] + 1..cut[1]];
            let end = section.iter().position(|&byte| byte == b'\n').unwrap_or(section.len());
            (&section[..end], section.get(end + 1..).unwrap_or_default())
        })
        .collect();
    let read = move |name: &str| {
        let found = others.iter().find(|(given, _)| *given == name.as_bytes()).or(others.first());
        found.map(|(_, content)| content.to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into())
    };
    (first, read)
}

/// Takes a small picture of every view.
fn draw(scene: &Scene) -> Result<(), Error> {
    let renderer = Renderer::new(scene)?;
    let settings = Settings { width: 8, height: 8, samples: 2, depth: 4, ..Settings::default() };
    for view in &scene.views {
        let image = renderer.render(view, &settings, None)?;
        image.to_png(&Display { exposure: view.exposure, ..Display::default() })?;
    }
    Ok(())
}

/// An error has a text of one line that begins with the name of the file.
fn check_error(path: &Path, error: &Error) {
    let message = error.to_string();
    assert_eq!(message.lines().count(), 1, "{}: {message:?}", path.display());
}

#[test]
fn objects() {
    let mut drawn = 0;
    for (path, content) in files("obj") {
        let start = Instant::now();
        let (first, mut read) = sections(&content);
        match obj::parse(first, "a.obj", &mut read, &obj::Options::default()) {
            Ok(model) => {
                for shading in ShadingModel::ALL {
                    let result = draw(&Scene::from_model(model.clone(), shading));
                    assert!(result.is_ok(), "{}: {result:?}", path.display());
                }
                drawn += 1;
            }
            Err(error) => check_error(&path, &error),
        }
        assert!(start.elapsed() < QUICK, "{}: {:?}", path.display(), start.elapsed());
    }
    // Files that all fail would test the first line of the reader only.
    assert!(drawn >= 10, "only {drawn} could be drawn");
}

#[test]
fn material_libraries() {
    for (path, content) in files("mtl") {
        match mtl::parse(&content, "a.mtl") {
            Ok((materials, _)) => {
                assert!(materials.iter().all(|m| (0.0..=mtl::MAX_EXPONENT).contains(&m.ns)), "{}", path.display());
            }
            Err(error) => check_error(&path, &error),
        }
    }
}

#[test]
fn descriptions() {
    let mut drawn = 0;
    for (path, content) in files("json") {
        let start = Instant::now();
        let (first, mut read) = sections(&content);
        let Ok(text) = std::str::from_utf8(first) else { continue };
        match parse_description(text, "a.json", &mut read, &LoadOptions::default()) {
            Ok(scene) => {
                // A light too far out is found when it is used.
                match draw(&scene) {
                    Ok(_) => drawn += 1,
                    Err(error) => check_error(&path, &error),
                }
            }
            Err(error) => check_error(&path, &error),
        }
        assert!(start.elapsed() < QUICK, "{}: {:?}", path.display(), start.elapsed());
    }
    assert!(drawn >= 5, "only {drawn} could be drawn");
}

#[test]
fn gltf_files() {
    let mut drawn = 0;
    for (path, content) in files("gltf") {
        let start = Instant::now();
        let (first, mut read) = sections(&content);
        match gltf::parse(first, "a.gltf", &mut read) {
            Ok(scene) => {
                let result = draw(&scene);
                assert!(result.is_ok(), "{}: {result:?}", path.display());
                drawn += 1;
            }
            Err(error) => check_error(&path, &error),
        }
        assert!(start.elapsed() < QUICK, "{}: {:?}", path.display(), start.elapsed());
    }
    assert!(drawn >= 10, "only {drawn} could be drawn");
}
