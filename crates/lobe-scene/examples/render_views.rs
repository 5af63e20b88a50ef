//! Renders all views of a scene into a folder: `cargo run --release --example render_views -- folder`.
//! Further arguments: samples for each pixel (16), a scene file (the built-in scene).

use lobe_scene::image::Display;
use lobe_scene::{LoadOptions, Renderer, Settings, default_scene, load};
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("which folder?")?;
    let samples = arguments.next().map_or(Ok(16), |samples| samples.parse())?;
    let options = LoadOptions::default();
    let scene = arguments.next().map_or_else(|| default_scene(&options), |file| load(Path::new(&file), &options))?;
    for warning in &scene.warnings {
        eprintln!("{warning}");
    }
    let start = Instant::now();
    let renderer = Renderer::new(&scene)?;
    println!("{} triangles, tree built in {:.2?}", scene.triangle_count(), start.elapsed());
    for view in &scene.views {
        let start = Instant::now();
        let image = renderer.render(view, &Settings { samples, ..Settings::default() }, None)?;
        println!("{}: {:.2?}", view.name, start.elapsed());
        let display = Display { exposure: view.exposure, ..Display::default() };
        image.save(&Path::new(&folder).join(format!("{}.png", view.name)), &display)?;
    }
    Ok(())
}
