//! The promise of the ray caster: 100,000 triangles at 1280×720 with one shadowed light, the tree included, in under
//! 3 s on two cores.
//!
//! ```text
//! cargo bench -p lobe-benches --bench scene
//! ```

use criterion::{Criterion, criterion_group, criterion_main};
use lobe_scene::{Renderer, Settings, procedural};
use std::hint::black_box;

fn hundred_thousand_triangles(c: &mut Criterion) {
    let scene = procedural::sphere_field(100_000).expect("the scene is valid");
    assert!(scene.triangle_count() >= 100_000);
    let view = scene.views.first().expect("the scene has a view").clone();
    let settings = Settings { width: 1280, height: 720, samples: 1, ..Settings::default() };
    let mut group = c.benchmark_group("scene");
    group.sample_size(10);
    group.bench_function("build", |b| b.iter(|| Renderer::new(black_box(&scene)).expect("valid")));
    group.bench_function("build and render 1280x720", |b| {
        b.iter(|| {
            let renderer = Renderer::new(black_box(&scene)).expect("valid");
            renderer.render(&view, &settings, None).expect("rendered")
        });
    });
    group.finish();
}

criterion_group!(benches, hundred_thousand_triangles);
criterion_main!(benches);
