//! Paths in a second, on one thread and on two: `cargo run --release --example paths [samples] [file …]`.
//!
//! Without files it is the built-in scene and `assets/materials.glb`. Rounds of both take turns, so that a machine that gets slower
//! slows both down; the medians are compared. Nothing else may run meanwhile.

use lobe_scene::path::{self, Options};
use lobe_scene::{LoadOptions, Renderer, Scene, View, default_scene, load};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Rounds of each number of threads.
const ROUNDS: usize = 9;
const THREADS: [usize; 2] = [1, 2];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let samples = arguments.next().map_or(Ok(8), |samples| samples.parse())?;
    let mut files: Vec<PathBuf> = arguments.map(PathBuf::from).collect();
    let options = LoadOptions::default();
    if files.is_empty() {
        measure("built-in", &default_scene(&options)?, samples)?;
        files.push(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/materials.glb"));
    }
    for file in files {
        let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
        measure(&name, &load(&file, &options)?, samples)?;
    }
    Ok(())
}

/// Prints the medians for the first view of a scene.
fn measure(name: &str, scene: &Scene, samples: u32) -> Result<(), Box<dyn std::error::Error>> {
    let view = scene.views.first().cloned().unwrap_or_else(View::default);
    let options = Options { width: 320, height: 180, samples, ..Options::default() };
    let paths = f64::from(options.width) * f64::from(options.height) * f64::from(samples);
    let renderer = Renderer::new(scene)?;
    let pools = THREADS.map(|count| rayon::ThreadPoolBuilder::new().num_threads(count).build());
    let mut rates = THREADS.map(|_| Vec::new());
    // The first round warms up.
    for round in 0..=ROUNDS {
        for (pool, rates) in pools.iter().zip(&mut rates) {
            let pool = pool.as_ref().map_err(ToString::to_string)?;
            let start = Instant::now();
            pool.install(|| path::render_with(&renderer, &view, &options, None))?;
            if round > 0 {
                rates.push(paths / start.elapsed().as_secs_f64());
            }
        }
    }
    let [one, two] = rates.map(|mut rates| {
        rates.sort_by(f64::total_cmp);
        (rates[ROUNDS / 2], rates[0], rates[ROUNDS - 1])
    });
    let size = format!("{}x{}, {samples} paths a pixel", options.width, options.height);
    println!("{name}: {} triangles, view `{}`, {size}, {ROUNDS} rounds", scene.triangle_count(), view.name);
    for (threads, (median, least, most)) in THREADS.into_iter().zip([one, two]) {
        println!("  {threads} threads: {median:>10.0} paths/s (from {least:.0} to {most:.0})");
    }
    println!("  two against one: {:.2} times", two.0 / one.0);
    Ok(())
}
