//! Pictures against what they should be: the closed form, the shadow, the same bits for any number of threads.

use glam::Vec3;
use lobe::{Brdf, Lambert, Rgb, Shininess};
use lobe_scene::image::Display;
use lobe_scene::mtl::{Illumination, MtlMaterial};
use lobe_scene::procedural::{sphere, sphere_field};
use lobe_scene::{
    Background, Camera, Error, Light, Material, Mesh, Renderer, Scene, Settings, ShadingModel, Surface, View,
};
use std::f32::consts::PI;
use std::sync::atomic::{AtomicU64, Ordering};

#[path = "../examples/make_assets.rs"]
#[allow(dead_code, reason = "the test needs the files, not the program around them")]
mod make_assets;

fn quad(y: f32, half: f32, material: u32) -> Result<Mesh, Error> {
    let points = [[-half, half], [half, half], [half, -half], [-half, -half]].map(|[x, z]| Vec3::new(x, y, z));
    Mesh::flat(points.to_vec(), &[[0, 1, 2], [0, 2, 3]], material)
}

fn diffuse(albedo: f32) -> Material {
    Material::new("diffuse", Surface::Diffuse(Lambert::new(Rgb::splat(albedo))))
}

/// Straight down from a height.
fn down(height: f32) -> Camera {
    Camera { eye: Vec3::Y * height, target: Vec3::ZERO, up: -Vec3::Z, fov_y_degrees: 40.0, height: None }
}

fn point(position: [f32; 3], intensity: f32) -> Light {
    Light::Point { position: position.into(), intensity: Rgb::splat(intensity), radius: 0.0 }
}

fn view(camera: Camera, lights: Vec<Light>) -> View {
    let background = Background::Solid(Rgb::splat(0.0));
    View { camera: Some(camera), lights: Some(lights), background, ..View::default() }
}

fn small() -> Settings {
    Settings { width: 64, height: 48, ..Settings::default() }
}

/// The middle of a picture whose middle is not on an edge of a pixel.
fn middle(scene: &Scene, view: &View, depth: u32) -> Result<f32, Error> {
    let image = Renderer::new(scene)?.render(
        view,
        &Settings { width: 33, height: 33, samples: 1, depth, ..Settings::default() },
        None,
    )?;
    Ok(image.pixel(16, 16).map_or(f32::NAN, |pixel| pixel[0]))
}

/// The builder of the tree takes quadratic time for equal boxes: half a minute for these.
#[test]
fn coincident_triangles_take_no_time() -> Result<(), Error> {
    let start = std::time::Instant::now();
    let points = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    let faces = vec![[0, 1, 2]; 20_000];
    let scene =
        Scene { meshes: vec![Mesh::flat(points, &faces, 0)?], materials: vec![diffuse(0.5)], ..Scene::default() };
    assert_eq!(scene.triangle_count(), 20_000);
    Renderer::new(&scene)?.render(&View::default(), &small(), None)?;
    assert!(start.elapsed().as_secs() < 5);
    Ok(())
}

#[test]
fn a_sphere_has_the_analytic_radiance() -> Result<(), Error> {
    let mtl = MtlMaterial {
        ka: Some([0.5; 3]),
        kd: [0.6, 0.3, 0.1],
        ks: [0.4; 3],
        ns: 30.0,
        illumination: Illumination::Highlight,
        ..MtlMaterial::default()
    };
    let eye = Vec3::new(0.0, 0.0, 5.0);
    let lamp = Vec3::new(2.0, 3.0, 4.0);
    let camera = Camera { eye, target: Vec3::ZERO, up: Vec3::Y, fov_y_degrees: 30.0, height: None };
    let settings = Settings { width: 101, height: 101, ..Settings::default() };
    let (points, faces) = sphere(Vec3::ZERO, 1.0, 256);
    for model in [ShadingModel::BlinnTorrance, ShadingModel::Phong] {
        let scene = Scene {
            meshes: vec![Mesh::smooth(points.clone(), &faces, 0, 30.0)?],
            materials: vec![Material::from_mtl(&mtl, model)],
            ..Scene::default()
        };
        let lights = vec![point(lamp.to_array(), 60.0), Light::Ambient(Rgb::splat(0.2))];
        let image = Renderer::new(&scene)?.render(&view(camera, lights), &settings, None)?;
        let mut seen = 0;
        for (at, pixel) in image.pixels().iter().enumerate() {
            // The ray through the middle of the pixel, and where it meets the sphere.
            let edge = 15.0_f32.to_radians().tan();
            let [x, y] = [at % 101, at / 101].map(|at| (2.0 * (at as f32 + 0.5) / 101.0 - 1.0) * edge);
            let direction = Vec3::new(x, -y, -1.0).normalize();
            let b = eye.dot(direction);
            let root = b * b - (eye.length_squared() - 1.0);
            let n = eye + direction * (-b - root.max(0.0).sqrt());
            let l = (lamp - n).normalize();
            // Away from the outline and from the terminator, where the polygons show.
            if root < 0.2 || n.dot(l) < 0.05 {
                continue;
            }
            seen += 1;
            let v = -direction;
            let cosine = match model {
                ShadingModel::BlinnTorrance => n.dot((l + v).normalize()),
                _ => v.dot(2.0 * n.dot(l) * n - l).max(0.0),
            };
            // The lecture's equation, with L_i = I/π.
            let incoming = 60.0 / PI / (lamp - n).length_squared();
            for (channel, kd) in mtl.kd.into_iter().enumerate() {
                let expected = 0.5 * 0.2 + (kd * n.dot(l) + 0.4 * cosine.powi(30)) * incoming;
                assert!(
                    (pixel[channel] - expected).abs() < 3e-3 * expected,
                    "{model} {at}: {} {expected}",
                    pixel[channel]
                );
            }
        }
        assert!(seen > 2000, "{seen}");
    }
    Ok(())
}

#[test]
fn a_plate_throws_a_shadow_with_its_own_outline() -> Result<(), Error> {
    // A plate of half-width 0.25 half way to a lamp: the shadow on the floor has half-width 0.5.
    let scene = Scene {
        meshes: vec![quad(0.0, 5.0, 0)?, quad(2.0, 0.25, 0)?],
        materials: vec![diffuse(1.0)],
        ..Scene::default()
    };
    let camera =
        Camera { eye: Vec3::new(0.0, 1.0, 3.0), target: Vec3::ZERO, up: Vec3::Y, fov_y_degrees: 50.0, height: None };
    let renderer = Renderer::new(&scene)?;
    let lamp = Vec3::new(0.0, 4.0, 0.0);
    let image = renderer.render(&view(camera, vec![point(lamp.to_array(), PI)]), &small(), None)?;
    let mut counts = [0, 0];
    for (at, pixel) in image.pixels().iter().enumerate() {
        let (x, y) = ((at % 64) as f32 + 0.5, (at / 64) as f32 + 0.5);
        let forward = (camera.target - camera.eye).normalize();
        let up = Vec3::X.cross(forward);
        let half = 25.0_f32.to_radians().tan();
        let direction = forward + Vec3::X * (x / 32.0 - 1.0) * half * 64.0 / 48.0 + up * (1.0 - y / 24.0) * half;
        let ground = camera.eye - direction * (camera.eye.y / direction.y);
        let reach = ground.x.abs().max(ground.z.abs());
        if direction.y >= 0.0 || reach > 4.9 || (reach - 0.5).abs() < 0.01 {
            continue;
        }
        let way = lamp - ground;
        let expected = if reach < 0.5 { 0.0 } else { way.y / way.length().powi(3) };
        assert!((pixel[0] - expected).abs() <= 1e-5, "{ground}: {} {expected}", pixel[0]);
        counts[usize::from(reach < 0.5)] += 1;
    }
    assert!(counts[0] > 500 && counts[1] > 30, "{counts:?}");
    Ok(())
}

#[test]
fn surfaces_do_not_shadow_themselves_at_any_size() -> Result<(), Error> {
    for (size, place) in
        [(1.0, Vec3::ZERO), (1e-4, Vec3::ZERO), (1e6, Vec3::ZERO), (1.0, Vec3::new(1000.0, -700.0, 300.0))]
    {
        let (points, faces) = sphere(place, size, 32);
        let scene = Scene {
            meshes: vec![Mesh::smooth(points, &faces, 0, 60.0)?],
            materials: vec![diffuse(1.0)],
            ..Scene::default()
        };
        let eye = place + Vec3::new(0.0, 1.0, 5.0) * size;
        let camera = Camera { eye, target: place, up: Vec3::Y, fov_y_degrees: 30.0, height: None };
        // The lamp stands beside the eye: everything that is seen is lit.
        let lamp = eye + Vec3::Y * 0.01 * size;
        let image =
            Renderer::new(&scene)?.render(&view(camera, vec![point(lamp.to_array(), size * size)]), &small(), None)?;
        let hit = image.pixels().iter().filter(|pixel| pixel[0] > 0.0).count();
        let camera_sees = {
            let mut glowing = scene.clone();
            glowing.materials[0] = Material { emission: Rgb::splat(1.0), ..Material::new("glow", Surface::Black) };
            let image = Renderer::new(&glowing)?.render(&view(camera, Vec::new()), &small(), None)?;
            image.pixels().iter().filter(|pixel| pixel[0] > 0.0).count()
        };
        assert!(camera_sees > 500);
        // At the very outline the light is as good as tangent.
        assert!(hit + 12 >= camera_sees, "{size} {place}: {hit} of {camera_sees} are lit");
    }
    Ok(())
}

#[test]
fn mirrors_are_followed_to_the_stated_depth() -> Result<(), Error> {
    let mut mirror = Material::new("mirror", Surface::Black);
    mirror.mirror = lobe::Mirror::new(Rgb::splat(0.5));
    let scene = Scene { meshes: vec![quad(0.0, 1.0, 0)?], materials: vec![mirror], ..Scene::default() };
    let mut seen = view(down(3.0), Vec::new());
    seen.background = Background::Gradient { bottom: Rgb::splat(0.0), top: Rgb::splat(0.8) };
    assert!((middle(&scene, &seen, 1)? - 0.4).abs() < 1e-4);
    assert_eq!(middle(&scene, &seen, 0)?, 0.0);
    Ok(())
}

#[test]
fn dissolve_blends_and_thins_the_shadow() -> Result<(), Error> {
    let mut veil = diffuse(0.0);
    veil.dissolve = 0.25;
    let scene = Scene {
        meshes: vec![quad(0.0, 1.0, 0)?, quad(1.0, 1.0, 1)?],
        materials: vec![diffuse(1.0), veil],
        ..Scene::default()
    };
    let seen = view(down(3.0), vec![point([0.0, 4.0, 0.0], 16.0 * PI)]);
    // The light passes the veil on its way down, and the view on its way up.
    assert!((middle(&scene, &seen, 8)? - 0.75 * 0.75).abs() < 1e-3);
    assert_eq!(middle(&scene, &seen, 0)?, 0.0, "beyond the depth it is solid");
    Ok(())
}

#[test]
fn both_sides_are_lit_alike() -> Result<(), Error> {
    let mut scene = Scene { meshes: vec![quad(0.0, 1.0, 0)?], materials: vec![diffuse(1.0)], ..Scene::default() };
    let seen = view(down(3.0), vec![point([0.0, 4.0, 0.0], 16.0 * PI)]);
    let front = middle(&scene, &seen, 0)?;
    assert!((front - 1.0).abs() < 1e-3, "{front}");
    for triangle in &mut scene.meshes[0].triangles {
        triangle.positions.swap(1, 2);
    }
    assert_eq!(middle(&scene, &seen, 0)?, front);
    // From below the lamp is on the other side.
    let below = Camera { eye: -Vec3::Y * 3.0, ..down(3.0) };
    assert_eq!(middle(&scene, &view(below, vec![point([0.0, 4.0, 0.0], 1.0)]), 0)?, 0.0);
    Ok(())
}

/// A lobe from outside this crate, and a mesh that was never a file.
#[test]
fn a_lobe_of_your_own_can_be_drawn() -> Result<(), Error> {
    #[derive(Debug)]
    struct Half;
    impl Brdf<f32> for Half {
        fn eval(&self, _: lobe::Vec3, _: lobe::Vec3) -> Rgb {
            Rgb::splat(0.5)
        }
    }
    let material = Material::new("half", Surface::other(Half));
    let scene = Scene { meshes: vec![quad(0.0, 1.0, 0)?], materials: vec![material], ..Scene::default() };
    let lights = vec![Light::Directional { to_light: Vec3::Y * 7.0, irradiance: Rgb::splat(0.25) }];
    assert_eq!(middle(&scene, &view(down(3.0), lights), 0)?, 0.125);
    Ok(())
}

#[test]
fn the_picture_does_not_depend_on_the_number_of_threads() -> Result<(), Box<dyn std::error::Error>> {
    let scene = sphere_field(30_000)?;
    let mut seen = scene.views[0].clone();
    // A ball of light, so that the choice of its points is tested too.
    for light in seen.lights.iter_mut().flatten() {
        if let Light::Point { radius, .. } = light {
            *radius = 0.5;
        }
    }
    let settings = Settings { width: 160, height: 90, samples: 3, depth: 4, ..Settings::default() };
    let mut pictures = Vec::new();
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let calls = AtomicU64::new(0);
        let progress = |done: u64, total: u64| {
            assert!((1..=total).contains(&done) && total == 90);
            calls.fetch_add(1, Ordering::Relaxed);
        };
        pictures.push(pool.install(|| Renderer::new(&scene)?.render(&seen, &settings, Some(&progress)))?);
        assert_eq!(calls.into_inner(), 90);
    }
    assert_eq!(pictures[0], pictures[1]);
    assert_eq!(pictures[0], pictures[2]);
    Ok(())
}

#[test]
fn values_outside_their_domain_are_errors() -> Result<(), Error> {
    let good = Scene { meshes: vec![quad(0.0, 1.0, 0)?], materials: vec![diffuse(0.5)], ..Scene::default() };
    let renderer = Renderer::new(&good)?;
    let default = View::default();
    for settings in [
        Settings { width: 0, ..small() },
        Settings { height: u32::MAX, ..small() },
        Settings { samples: 0, ..small() },
        Settings { samples: u32::MAX, ..small() },
        Settings { depth: 33, ..small() },
    ] {
        assert!(renderer.render(&default, &settings, None).is_err(), "{settings:?}");
    }
    for light in [
        point([f32::NAN, 0.0, 0.0], 1.0),
        point([0.0; 3], -1.0),
        point([0.0; 3], f32::INFINITY),
        Light::Point { position: Vec3::ZERO, intensity: Rgb::splat(1.0), radius: -1.0 },
        Light::Directional { to_light: Vec3::ZERO, irradiance: Rgb::splat(1.0) },
        Light::Ambient(Rgb::splat(f32::NAN)),
    ] {
        assert!(renderer.render(&view(down(3.0), vec![light]), &small(), None).is_err(), "{light:?}");
    }
    let mut bad = vec![Scene::default(), Scene { materials: Vec::new(), ..good.clone() }];
    for change in 0..5 {
        let mut scene = good.clone();
        match change {
            0 => scene.meshes[0].positions[1].y = f32::NAN,
            1 => scene.meshes[0].triangles[0].positions[2] = 4,
            2 => scene.meshes[0].triangles[0].normals[2] = 400,
            3 => scene.meshes[0].normals[0] = Vec3::ZERO,
            _ => scene.materials[0].dissolve = 1.5,
        }
        bad.push(scene);
    }
    for scene in &bad {
        assert!(Renderer::new(scene).is_err());
    }
    assert!(Mesh::flat(vec![Vec3::ZERO], &[[0, 1, 2]], 0).is_err());
    assert!(Mesh::flat(vec![Vec3::NAN; 3], &[[0, 1, 2]], 0).is_err());
    Ok(())
}

/// A model alone is framed and lit: white in the middle has about the radiance 1, and the corners are background.
#[test]
fn a_model_without_a_view_is_framed_and_lit() -> Result<(), Error> {
    for size in [1e-3, 1.0, 1e5] {
        let (points, faces) = sphere(Vec3::new(3.0, 2.0, 1.0) * size, size, 32);
        let scene = Scene {
            meshes: vec![Mesh::smooth(points, &faces, 0, 60.0)?],
            materials: vec![diffuse(1.0)],
            ..Scene::default()
        };
        let image = Renderer::new(&scene)?.render(&View::default(), &small(), None)?;
        let middle = image.pixel(32, 24).map_or(0.0, |pixel| pixel[0]);
        assert!((0.5..1.5).contains(&middle), "{size}: {middle}");
        assert_eq!(image.pixel(0, 0), Some([0.05; 3]));
    }
    Ok(())
}

/// Nothing that a scene may hold makes the renderer stop.
#[test]
fn odd_scenes_are_drawn() -> Result<(), Error> {
    let settings = Settings { width: 16, height: 9, ..Settings::default() };
    // Many triangles in one place, a needle, a lamp on the surface, exponents at both ends.
    let mut points = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    points.extend([Vec3::new(-1e9, 0.0, 0.0), Vec3::new(1e9, 1e-3, 0.0), Vec3::new(0.0, 1e-3, 0.0)]);
    let mut faces = vec![[0, 1, 2]; 1000];
    faces.push([3, 4, 5]);
    for q in [0.0, 1e6] {
        for model in ShadingModel::ALL {
            let surface = Surface::new(model, Rgb::splat(0.5), Rgb::splat(0.5), Shininess(q));
            let scene = Scene {
                meshes: vec![Mesh::flat(points.clone(), &faces, 0)?],
                materials: vec![Material::new("m", surface)],
                ..Scene::default()
            };
            let renderer = Renderer::new(&scene)?;
            let camera = Camera {
                eye: Vec3::new(0.2, 0.2, 3.0),
                target: Vec3::new(0.2, 0.2, 0.0),
                up: Vec3::Y,
                fov_y_degrees: 40.0,
                height: None,
            };
            let image = renderer.render(
                &view(camera, vec![point([0.25, 0.25, 0.0], 1.0), point([0.0, 0.0, 2.0], 1.0)]),
                &settings,
                None,
            )?;
            assert!(image.pixels().iter().flatten().all(|value| value.is_finite()));
            renderer.render(&View::default(), &settings, None)?;
        }
    }
    Ok(())
}

#[test]
fn the_built_in_scene_is_what_the_generator_makes() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets");
    for (name, text) in make_assets::files() {
        let found = std::fs::read_to_string(folder.join(name))?.replace("\r\n", "\n");
        assert!(found == text, "{name} differs: run the example make_assets");
    }
    let scene = lobe_scene::default_scene(&lobe_scene::LoadOptions::default())?;
    assert_eq!(scene.warnings, []);
    let names: Vec<_> = scene.views.iter().map(|view| view.name.as_str()).collect();
    assert_eq!(names, ["overview", "exponent", "light", "materials", "smooth-flat", "models"]);
    for name in ["knot smooth", "knot flat"] {
        let part = scene.parts.iter().find(|part| part.name == name).ok_or(name)?;
        assert_eq!(part.triangles.len(), 20_160);
    }
    // Every view shows something, and nothing that is not a number.
    let renderer = Renderer::new(&scene)?;
    for view in &scene.views {
        let image = renderer.render(view, &Settings { width: 64, height: 36, ..Settings::default() }, None)?;
        assert!(image.pixels().iter().flatten().all(|value| value.is_finite()), "{}", view.name);
        assert!(!image.to_png(&Display::default())?.is_empty());
    }
    Ok(())
}
