//! Times the stages on a procedural scene: `cargo run --release --example measure [triangles]`.

use lobe_scene::procedural::sphere_field;
use lobe_scene::{Renderer, Settings, obj};
use std::fmt::Write as _;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let triangles = std::env::args().nth(1).map_or(Ok(100_000), |count| count.parse())?;
    let scene = sphere_field(triangles)?;
    println!("{} triangles, {} threads", scene.triangle_count(), rayon::current_num_threads());
    for _ in 0..3 {
        let start = Instant::now();
        let renderer = Renderer::new(&scene)?;
        let built = start.elapsed();
        renderer.render(&scene.views[0], &Settings::default(), None)?;
        println!("tree {built:.2?}, tree and picture of 1280x720 {:.2?}", start.elapsed());
    }

    let mut text = String::new();
    let mut first = 1;
    for mesh in &scene.meshes {
        for point in &mesh.positions {
            writeln!(text, "v {} {} {}", point.x, point.y, point.z)?;
        }
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.positions.map(|corner| first + corner as usize);
            writeln!(text, "f {a} {b} {c}")?;
        }
        first += mesh.positions.len();
    }
    let start = Instant::now();
    let model = obj::parse(&text, "measure", &mut |_| Ok(Vec::new()), &obj::Options::default())?;
    println!("{} triangles read from {} MB in {:.2?}", model.mesh.triangles.len(), text.len() >> 20, start.elapsed());
    Ok(())
}
