//! `lobe render --contact-sheet`: a sphere of every measured material, with its name.

use crate::args::RenderArgs;
use crate::error::Failure;
use crate::letters;
use crate::output;
use crate::progress::Progress;
use lobe_models::ngan;
use lobe_scene::image::{Depth, Display};
use lobe_scene::{Image, Material, Renderer, Settings, procedural};
use rayon::prelude::*;
use serde_json::json;
use std::time::Instant;

/// Spheres in a row.
const COLUMNS: u32 = 10;
/// The widest name has 25 letters.
const LEAST_WIDTH: u32 = COLUMNS * 64;
/// Around the names.
const GAP: u32 = 4;

/// Runs the verb.
pub(crate) fn run(args: &RenderArgs, png: bool, quiet: bool, as_json: bool) -> Result<(), Failure> {
    if !png || args.width < LEAST_WIDTH {
        let path = args.output.display();
        return Err(Failure::Usage(format!(
            "{path}: a contact sheet is a .png of at least {LEAST_WIDTH} pixels in a row; the width is {}",
            args.width
        )));
    }
    let start = Instant::now();
    let model = args.model.as_deref().unwrap_or(ngan::DEFAULT_MODEL);
    let materials = ngan::materials()
        .map(|name| ngan::fit(name, model).and_then(ngan::Fit::material))
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| Failure::Usage(format!("--model {model}: {error}")))?;

    let side = args.width / COLUMNS;
    let line = letters::HEIGHT + GAP;
    let (cell, rows) = (side + 2 * line + GAP, (materials.len() as u32).div_ceil(COLUMNS));
    let bar = Progress::new("materials", materials.len() as u64, quiet);
    let settings = Settings { width: side, height: side, samples: args.samples, ..Settings::default() };
    let balls: Vec<Image> = materials
        .par_iter()
        .map(|material| {
            let scene = procedural::swatch(Material::from_lobes(material.name.as_str(), material))?;
            let image = Renderer::new(&scene)?.render(&scene.views[0], &settings, None)?;
            bar.advance(1);
            Ok(image)
        })
        .collect::<Result<_, lobe_scene::Error>>()?;
    drop(bar);

    let mut sheet = Image::new(side * COLUMNS, cell * rows)?;
    let width = sheet.width() as usize;
    let paper = balls.first().and_then(|ball| ball.pixel(0, 0)).unwrap_or_default();
    sheet.pixels_mut().fill(paper);
    for (index, (ball, name)) in balls.iter().zip(ngan::materials()).enumerate() {
        let (left, top) = (index as u32 % COLUMNS * side, index as u32 / COLUMNS * cell);
        let mut set = |x: u32, y: u32, colour: [f32; 3]| {
            if let Some(pixel) = sheet.pixels_mut().get_mut((top + y) as usize * width + (left + x) as usize) {
                *pixel = colour;
            }
        };
        for (at, colour) in ball.pixels().iter().enumerate() {
            set(at as u32 % side, at as u32 / side, *colour);
        }
        // The exposure of the picture is not that of the letters.
        let ink = [0.6 * (-args.exposure).exp2(); 3];
        for (row, text) in fit(name, (side / letters::ADVANCE) as usize).into_iter().enumerate() {
            let start = side.saturating_sub(text.len() as u32 * letters::ADVANCE) / 2;
            for (x, y) in letters::dots(&text).filter(|(x, _)| start + x < side) {
                set(start + x, side + y + row as u32 * line, ink);
            }
        }
    }
    sheet.save(&args.output, &Display { exposure: args.exposure, depth: Depth::Eight, tone: args.tone })?;

    let (path, seconds) = (args.output.display(), start.elapsed().as_secs_f64());
    if as_json {
        let names: Vec<_> = materials.iter().map(|material| material.name.as_str()).collect();
        let (width, height) = (sheet.width(), sheet.height());
        let facts = json!({
            "written": path.to_string(), "model": model, "width": width, "height": height, "seconds": seconds,
            "columns": COLUMNS, "materials": names,
        });
        return output::print(format!("{facts:#}\n").as_bytes());
    }
    if quiet {
        return Ok(());
    }
    let line = format!("{path}: {} materials as fitted with {model}, {seconds:.2} s\n", materials.len());
    output::print(line.as_bytes())
}

/// A name in at most two lines of so many letters, broken after a hyphen where there is one.
fn fit(name: &str, letters: usize) -> Vec<String> {
    if name.len() <= letters {
        return vec![name.to_owned()];
    }
    let first = name.get(..letters).unwrap_or(name);
    let end = first.rfind('-').map_or(first.len(), |at| at + 1);
    let (first, rest) = name.split_at(end);
    vec![first.to_owned(), rest.chars().take(letters).collect()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fit_whole() {
        for name in ngan::materials() {
            let lines = fit(name, 21);
            assert!(lines.concat() == name && lines.iter().all(|line| line.len() <= 21), "{lines:?}");
        }
        assert_eq!(fit("specular-blue-phenolic", 12), ["specular-", "blue-phenoli"]);
    }
}
