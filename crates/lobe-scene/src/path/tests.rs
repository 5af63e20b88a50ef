//! Pictures whose values are known in another way.

use super::*;
use crate::gltf_material::{Factors, GltfMaterial};
use crate::material::Surface;
use crate::mtl::MtlMaterial;
use crate::procedural::sphere;
use crate::{Background, Camera, Light, LoadOptions, Material, Mesh, Settings, ShadingModel};
use glam::Vec3;
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Lambert, MetallicRoughness, Microfacet, Mirror};
use lobe_energy::KullaConty;
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI, TAU};
use std::sync::Arc;

const WHITE: Background = Background::Solid(Rgb { r: 1.0, g: 1.0, b: 1.0 });
const BLACK: Background = Background::Solid(Rgb { r: 0.0, g: 0.0, b: 0.0 });

fn lambert(albedo: f32) -> Material {
    Material::new("lambert", Surface::Diffuse(Lambert::new(Rgb::splat(albedo))))
}

fn shining(radiance: f32) -> Material {
    Material { emission: Rgb::splat(radiance), ..Material::new("light", Surface::Black) }
}

fn gltf(factors: Factors) -> Material {
    Material::from_gltf("gltf", GltfMaterial { factors, ..GltfMaterial::default() })
}

/// A rectangle around a point, facing along `±normal`, an axis.
fn rectangle(center: Vec3, [a, b]: [Vec3; 2], material: u32) -> Mesh {
    let corners = vec![center - a - b, center + a - b, center + a + b, center - a + b];
    Mesh::flat(corners, &[[0, 1, 2], [0, 2, 3]], material).expect("a rectangle")
}

/// The floor `y = 0`, its front upwards.
fn floor(half: f32, material: u32) -> Mesh {
    rectangle(Vec3::ZERO, [Vec3::Z * half, Vec3::X * half], material)
}

fn ball(center: Vec3, radius: f32, around: u32, material: u32) -> Mesh {
    let (points, faces) = sphere(center, radius, around);
    Mesh::smooth(points, &faces, material, 180.0).expect("a ball")
}

fn view(camera: Camera, background: Background, lights: Vec<Light>) -> View {
    View { camera: Some(camera), background, lights: Some(lights), ..View::default() }
}

/// Looks at the origin of the floor alone.
fn down_at_origin(from: Vec3) -> Camera {
    Camera { eye: from, target: Vec3::ZERO, up: Vec3::new(0.3, 0.1, -1.0), height: Some(1e-3), ..Camera::default() }
}

fn small(samples: u32) -> Options {
    Options { width: 16, height: 16, samples, ..Options::default() }
}

fn picture(scene: &Scene, view: &View, options: &Options) -> Vec<[f32; 3]> {
    let rendered = render(scene, view, options, None).expect("a picture");
    assert_eq!(rendered.nan_samples, 0);
    rendered.image.pixels().to_vec()
}

/// The mean of the green channel over the picture, and its standard error, from pictures of several seeds.
fn mean(scene: &Scene, view: &View, options: &Options) -> (f64, f64) {
    const SEEDS: u64 = 6;
    let means: Vec<f64> = (0..SEEDS)
        .map(|seed| {
            let pixels = picture(scene, view, &Options { seed: 100 + seed, ..options.clone() });
            pixels.iter().map(|pixel| f64::from(pixel[1])).sum::<f64>() / pixels.len() as f64
        })
        .collect();
    let mean = means.iter().sum::<f64>() / SEEDS as f64;
    let square = means.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    (mean, (square / (SEEDS * (SEEDS - 1)) as f64).sqrt())
}

/// Within five standard errors, of few degrees of freedom, and rounding; and the errors are small enough to say something.
fn assert_near((mean, error): (f64, f64), expected: f64, most: f64, what: &str) {
    assert!(error <= most * expected, "{what}: the noise {error} is too large to tell");
    let off = (mean - expected).abs();
    assert!(off <= 5.0 * error + 2e-5 * expected, "{what}: {mean} ± {error}, expected {expected}");
}

fn strategies() -> [Strategy; 3] {
    [Strategy::Both, Strategy::Lobes, Strategy::Lights]
}

#[test]
fn a_white_ball_vanishes_in_a_white_world() {
    for around in [8, 64] {
        let scene =
            Scene { meshes: vec![ball(Vec3::ZERO, 1.0, around, 0)], materials: vec![lambert(1.0)], ..Scene::default() };
        let view = view(Camera { eye: Vec3::Z * 4.0, ..Camera::default() }, WHITE, vec![]);
        // By the cosine each sample of a convex body is white itself.
        let exact = Options { strategy: Strategy::Lobes, ..small(8) };
        for pixel in picture(&scene, &view, &exact) {
            assert!(pixel.iter().all(|channel| (channel - 1.0).abs() < 1e-5), "{pixel:?}");
        }
        for strategy in [Strategy::Both, Strategy::Lights] {
            let measured = mean(&scene, &view, &Options { strategy, ..small(64) });
            assert_near(measured, 1.0, 3e-3, &format!("{strategy:?} {around}"));
        }
    }
}

/// A metal that loses nothing is white in a white world, its sharp lobe as its wide one, and from the middle of the ball to its rim.
#[test]
fn a_compensated_metal_vanishes_in_a_white_world() {
    for alpha in [0.1, 0.5, 1.0] {
        let metal: KullaConty<Schlick> = KullaConty::new(Alpha(alpha), Schlick::new(Rgb::splat(1.0)));
        let material = Material::new("metal", Surface::Other(Arc::new(metal)));
        let scene = Scene { meshes: vec![ball(Vec3::ZERO, 1.0, 48, 0)], materials: vec![material], ..Scene::default() };
        let camera = Camera { eye: Vec3::Z * 4.0, height: Some(2.2), ..Camera::default() };
        for strategy in [Strategy::Both, Strategy::Lobes] {
            let (mean, error) = mean(&scene, &view(camera, WHITE, vec![]), &Options { strategy, ..small(64) });
            // Within what the fit of the compensation is known to be off, and the noise.
            let name = format!("{alpha} {strategy:?}: {mean} ± {error}");
            assert!(error < 1e-3 && (mean - 1.0).abs() < 1.5e-3 + 5.0 * error, "{name}");
        }
    }
}

/// The variance of a pixel's green channel over the pixels that all see the same, and their mean.
fn spread(scene: &Scene, view: &View, options: &Options) -> (f64, f64) {
    let pixels: Vec<f64> = picture(scene, view, options).iter().map(|pixel| f64::from(pixel[1])).collect();
    let mean = pixels.iter().sum::<f64>() / pixels.len() as f64;
    (pixels.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (pixels.len() - 1) as f64, mean)
}

/// A small bright sun in a dim sky, and a nearly smooth metal: the sun straight in the mirror direction, where directions of the lobe
/// have to find it, and beside it, where the lights hardly ever find the sky that is seen.
#[test]
fn a_smooth_metal_under_a_sun_has_little_noise() {
    let metal = Microfacet::new(Ggx::new(Alpha(0.05)), SmithCorrelated, Schlick::new(Rgb::splat(0.9)));
    let reference = Microfacet::new(Ggx::new(Alpha(0.05_f64)), SmithCorrelated, Schlick::new(Rgb::splat(0.9)));
    let (width, height) = (128_u32, 64_u32);
    let eye = Vec3::new(3.0, 2.0, 0.0);
    let v = eye.as_dvec3().normalize();
    for (strategy, beside) in [(Strategy::Lobes, 0.0_f64), (Strategy::Both, 1.0)] {
        // The mirror direction has the polar angle of the camera, and goes to −x.
        let (theta, phi) = (1.5_f64.atan(), beside - FRAC_PI_2);
        let texel = |part: f64, of: u32| (part * f64::from(of)) as u32;
        let (x, y) = (texel(phi / TAU + 0.5, width), texel(theta / PI, height));
        let mut image = Image::new(width, height).expect("a size");
        image.pixels_mut().fill([0.25; 3]);
        image.pixels_mut()[(y * width + x) as usize] = [20_000.0; 3];
        let map = EnvironmentMap::new(&image).expect("radiance");
        let expected = reflected(&reference, lobe::Vec3::new(v.x, v.z, v.y), |l| {
            f64::from(map.radiance(Vec3::new(l.x as f32, l.z as f32, l.y as f32)).g)
        });
        let environment = Some(Environment::Map(Arc::new(map)));
        let shot = |surface| {
            let material = Material::new("metal", surface);
            let scene = Scene { meshes: vec![floor(5.0, 0)], materials: vec![material], ..Scene::default() };
            let options = Options { strategy, environment: environment.clone(), ..small(16) };
            spread(&scene, &view(down_at_origin(eye), BLACK, vec![]), &options)
        };
        let (own, mean) = shot(Surface::Other(Arc::new(metal)));
        let (by_cosine, _) = shot(Surface::other(metal));
        assert!(by_cosine > 50.0 * own, "{strategy:?}: {own:e}, by the cosine {by_cosine:e}");
        // 256 pixels.
        let error = (own / 256.0).sqrt();
        assert!(
            error < 0.03 * mean && (mean - expected).abs() < 5.0 * error + 2e-3 * expected,
            "{strategy:?}: {mean} ± {error}, expected {expected}"
        );
    }
}

/// In a closed room of the emission `e` and the albedo `ρ` everything is `e/(1 − ρ)` bright.
#[test]
fn a_closed_room_has_the_sum_of_all_reflections() {
    let material = Material { emission: Rgb::splat(0.5), ..lambert(0.5) };
    let inside = Camera { eye: Vec3::new(0.1, 0.2, 0.05), target: Vec3::X, ..Camera::default() };
    let (points, faces) = sphere(Vec3::ZERO, 1.0, 12);
    let room = Mesh::flat(points, &faces, 0).expect("a room");
    let scene = Scene { meshes: vec![room], materials: vec![material], ..Scene::default() };
    let view = view(inside, BLACK, vec![]);
    for strategy in strategies() {
        let options = Options { strategy, max_depth: 24, ..small(16) };
        assert_near(mean(&scene, &view, &options), 1.0, 5e-3, &format!("{strategy:?}"));
    }
    // One reflection is the half of it, two are three quarters …
    for (max_depth, expected) in [(0, 0.5), (1, 0.75), (2, 0.875), (3, 0.9375)] {
        assert_near(mean(&scene, &view, &Options { max_depth, ..small(16) }), expected, 5e-3, &format!("{max_depth}"));
    }
    // Roulette does not change the mean, however early, and shortens paths.
    for roulette_from in [1, 3, u32::MAX] {
        let options = Options { max_depth: 24, roulette_from, ..small(16) };
        assert_near(mean(&scene, &view, &options), 1.0, 1e-2, &format!("roulette from {roulette_from}"));
    }
}

/// The form factor of a rectangle over a point, from the corner above it (Howell's C-5 is this with four of them).
fn form_factor(a: f64, b: f64, height: f64) -> f64 {
    let (x, y) = (a / height, b / height);
    let (p, q) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    (x / p * (y / p).atan() + y / q * (x / q).atan()) / TAU
}

/// A floor under a rectangular light whose middle is right above the origin but for `(0.2, 0.1)`.
fn under_a_lamp(material: Material) -> Scene {
    let lamp = rectangle(Vec3::new(0.2, 1.0, 0.1), [Vec3::X * 0.5, Vec3::Z * 0.3], 1);
    Scene { meshes: vec![floor(5.0, 0), lamp], materials: vec![material, shining(3.0)], ..Scene::default() }
}

#[test]
fn a_floor_under_a_rectangle_has_its_closed_form() {
    let scene = under_a_lamp(lambert(0.6));
    let whole = whole_lamp();
    let view = view(down_at_origin(Vec3::new(3.0, 2.0, 0.5)), BLACK, vec![]);
    for strategy in strategies() {
        let options = Options { strategy, max_depth: 1, ..small(128) };
        assert_near(mean(&scene, &view, &options), 0.6 * 3.0 * whole, 5e-3, &format!("{strategy:?}"));
    }
}

/// The form factor of that light from the origin.
fn whole_lamp() -> f64 {
    [(0.7, 0.4), (0.7, 0.2), (0.3, 0.4), (0.3, 0.2)].iter().map(|(a, b)| form_factor(*a, *b, 1.0)).sum()
}

/// Far from the origin coordinates have few digits, and the light must still not lie in its own shadow.
#[test]
fn a_lamp_far_from_the_origin_or_from_the_floor_is_whole() {
    let far_lamp: f64 = 4.0 * form_factor(100.0, 100.0, 1000.0);
    let near_lamp = whole_lamp();
    for (offset, distance, half, expected) in [
        (Vec3::new(300.0, -50.0, 20.0), 1.0, [0.5, 0.3], near_lamp),
        (Vec3::ZERO, 1000.0, [100.0, 100.0], far_lamp),
        // The lamp is near the origin, the floor far from it.
        (Vec3::Y * -1000.0, 1000.0, [100.0, 100.0], far_lamp),
    ] {
        let center = if distance > 1.0 { Vec3::Y * distance } else { Vec3::new(0.2, 1.0, 0.1) };
        let lamp = rectangle(center, [Vec3::X * half[0], Vec3::Z * half[1]], 1);
        // A surface that is open makes shadow rays go from one to the next.
        for open in [false, true] {
            let pane = rectangle(center / 2.0, [Vec3::X * 300.0, Vec3::Z * 300.0], 2);
            let mut meshes = vec![floor(5.0, 0), lamp.clone()];
            meshes.extend(open.then_some(pane));
            for mesh in &mut meshes {
                mesh.positions.iter_mut().for_each(|position| *position += offset);
            }
            let pane = Material { dissolve: 0.5, ..shining(0.0) };
            let scene = Scene { meshes, materials: vec![lambert(0.6), shining(3.0), pane], ..Scene::default() };
            let camera = down_at_origin(Vec3::new(1.0, 0.3, 0.2));
            let camera = Camera { eye: camera.eye + offset, target: offset, height: Some(0.01), ..camera };
            let expected = expected * 1.8 * if open { 0.5 } else { 1.0 };
            for strategy in [Strategy::Both, Strategy::Lights] {
                let options = Options { strategy, max_depth: 1, ..small(64) };
                let (mean, error) = mean(&scene, &view(camera, BLACK, vec![]), &options);
                let name = format!("{strategy:?} {offset} {distance} {open}: {mean} ± {error}, expected {expected}");
                // Rays start 32 units of the last place above the floor, a thousandth at coordinates of 300.
                assert!(error < 1e-2 * mean && (mean - expected).abs() < 5.0 * error + 3e-3 * expected, "{name}");
            }
        }
    }
}

#[test]
fn a_light_with_a_picture_is_as_bright_as_its_texels() {
    use crate::texture::{Encoding, Map, Sampler, Texture};
    let texels = vec![[0, 0, 0, 255], [255; 4]];
    let sampler = Sampler { nearest: true, ..Sampler::default() };
    let texture = Arc::new(Texture::new(2, 1, texels, Encoding::Linear, sampler).expect("a texture"));
    let map = Map { texture, set: 0, transform: (glam::Mat2::IDENTITY, glam::Vec2::ZERO) };
    let mut scene = under_a_lamp(lambert(0.6));
    let factors = Factors { emission: [3.0; 3], base_color: [0.0; 3], double_sided: true, ..Factors::default() };
    let maps = crate::Maps { emission: Some(map), ..crate::Maps::default() };
    scene.materials[1] = Material::from_gltf("lamp", GltfMaterial { factors, maps });
    // u along x: the half beyond x = 0.2 shines.
    let lamp = &mut scene.meshes[1];
    lamp.vertices = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        .map(|uv| crate::Vertex { uv: [glam::Vec2::from(uv); 2], ..crate::Vertex::default() })
        .to_vec();
    lamp.triangles.iter_mut().for_each(|triangle| triangle.vertices = triangle.positions);
    let half: f64 = [0.4, 0.2].iter().map(|b| form_factor(0.7, *b, 1.0) - form_factor(0.2, *b, 1.0)).sum();
    let view = view(down_at_origin(Vec3::new(3.0, 2.0, 0.5)), BLACK, vec![]);
    for strategy in strategies() {
        let options = Options { strategy, max_depth: 1, ..small(128) };
        assert_near(mean(&scene, &view, &options), 1.8 * half, 1e-2, &format!("{strategy:?}"));
    }
}

/// `∫ f_r L (n·l) dω` over the upper half, by the midpoint rule.
fn reflected(brdf: &dyn Brdf<f64>, v: lobe::Vec3<f64>, radiance: impl Fn(lobe::Vec3<f64>) -> f64) -> f64 {
    let n = 600;
    let mut sum = 0.0;
    for i in 0..n {
        let z = (f64::from(i) + 0.5) / f64::from(n);
        let ring = (1.0 - z * z).sqrt();
        for j in 0..n {
            let (sine, cosine) = ((f64::from(j) + 0.5) / f64::from(n) * TAU).sin_cos();
            let l = lobe::Vec3::new(ring * cosine, ring * sine, z);
            sum += brdf.eval_cos(l, v).g * radiance(l);
        }
    }
    sum * TAU / f64::from(n * n)
}

#[test]
fn light_from_the_sky_is_that_of_quadrature() {
    let (bottom, top) = (0.2_f32, 1.4_f32);
    let sky = Background::Gradient { bottom: Rgb::splat(bottom), top: Rgb::splat(top) };
    // For a floor that faces up, half of the slope weighs 2/3 under the cosine.
    let lambertian = 0.5 * (f64::from(bottom + top) / 2.0 + f64::from(top - bottom) / 3.0);
    let eye = Vec3::new(3.0, 2.0, 0.0);
    let v = eye.as_dvec3().normalize();
    let v = lobe::Vec3::new(v.x, v.z, v.y);
    let glossy = MetallicRoughness::new(Rgb::splat(0.5_f64), 0.3, Alpha(0.36));
    let up = |l: lobe::Vec3<f64>| f64::from(bottom) + f64::from(top - bottom) * (0.5 + 0.5 * l.z);
    let factors =
        Factors { base_color: [0.5; 3], metallic: 0.3, roughness: 0.6, double_sided: true, ..Factors::default() };
    for (material, expected, most) in
        [(lambert(0.5), lambertian, 1e-3), (gltf(factors), reflected(&glossy, v, up), 3e-3)]
    {
        let scene = Scene { meshes: vec![floor(5.0, 0)], materials: vec![material], ..Scene::default() };
        let view = view(down_at_origin(eye), sky, vec![]);
        for strategy in strategies() {
            let options = Options { strategy, ..small(128) };
            assert_near(mean(&scene, &view, &options), expected, most, &format!("{strategy:?}"));
        }
    }
}

#[test]
fn light_from_a_picture_is_that_of_its_texels() {
    // A sun of one texel, in a dim sky; the floor sees the upper half.
    let (width, height) = (32_u32, 16_u32);
    let mut image = Image::new(width, height).expect("a size");
    image.pixels_mut().fill([0.25; 3]);
    image.pixels_mut()[(3 * width + 20) as usize] = [200.0; 3];
    let map = EnvironmentMap::new(&image).expect("radiance");
    let expected = 0.5
        * reflected(&Lambert::new(Rgb::splat(1.0_f64)), lobe::Vec3::new(0.0, 0.0, 1.0), |l| {
            f64::from(map.radiance(Vec3::new(l.x as f32, l.z as f32, l.y as f32)).g)
        });
    let environment = Some(Environment::Map(Arc::new(map)));
    let scene = Scene { meshes: vec![floor(5.0, 0)], materials: vec![lambert(0.5)], ..Scene::default() };
    let view = view(down_at_origin(Vec3::new(3.0, 2.0, 0.0)), BLACK, vec![]);
    for strategy in [Strategy::Both, Strategy::Lights] {
        let options = Options { strategy, environment: environment.clone(), ..small(128) };
        let (mean, error) = mean(&scene, &view, &options);
        assert!(error < 2e-3 * mean && (mean / expected - 1.0).abs() < 3e-3, "{strategy:?}: {mean} {error} {expected}");
    }
}

/// A glossy floor, a lamp, a ball that throws a shadow, and a sky: all the ways to find light at once.
fn mixed() -> (Scene, View) {
    let factors =
        Factors { base_color: [0.8, 0.5, 0.3], metallic: 0.5, roughness: 0.45, clearcoat: 0.7, ..Factors::default() };
    let factors = Factors { clearcoat_roughness: 0.3, double_sided: true, ..factors };
    let mut scene = under_a_lamp(gltf(factors));
    let half = Material { dissolve: 0.5, ..lambert(0.7) };
    scene.meshes.push(ball(Vec3::new(-0.6, 0.4, 0.2), 0.4, 16, 2));
    scene.materials.push(half);
    let camera = Camera { eye: Vec3::new(1.0, 1.6, 3.0), target: Vec3::new(0.0, 0.3, 0.0), ..Camera::default() };
    let sky = Background::Gradient { bottom: Rgb::splat(0.02), top: Rgb::new(0.2, 0.3, 0.4) };
    (scene, view(camera, sky, vec![]))
}

#[test]
fn all_strategies_have_one_mean() {
    let (scene, view) = mixed();
    let [both, lobes, lights] =
        strategies().map(|strategy| mean(&scene, &view, &Options { strategy, max_depth: 4, width: 24, ..small(128) }));
    for (other, name) in [(lobes, "lobes"), (lights, "lights")] {
        let error = both.1.hypot(other.1);
        assert!(error < 5e-3 * both.0, "{name}: the noise {error} is too large to tell");
        assert!((both.0 - other.0).abs() < 5.0 * error, "{name}: {both:?} {other:?}");
    }
    // Several ways together are better than the worse of them alone.
    assert!(both.1 < lobes.1.max(lights.1), "{both:?} {lobes:?} {lights:?}");
}

#[test]
fn a_seed_is_a_picture_for_any_number_of_threads() {
    let (scene, view) = mixed();
    let options = Options { seed: 7, ..small(9) };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| picture(&scene, &view, &options))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(5));
    assert!(one != picture(&scene, &view, &Options { seed: 8, ..options.clone() }));
    // In other passes.
    let renderer = Renderer::new(&scene).expect("a scene");
    let mut tracer = PathTracer::new(&renderer, &view, &options).expect("options");
    for samples in [1, 5, 3] {
        tracer.advance(samples, None);
    }
    assert!(one == tracer.rendered().expect("a size").image.pixels());
}

#[test]
fn progress_counts_every_row_of_every_pass() {
    let (scene, view) = mixed();
    let (most, calls) = (AtomicU64::new(0), AtomicU64::new(0));
    let report = |done: u64, all: u64| {
        assert!(done <= all && all == 16 * 2);
        most.fetch_max(done, Ordering::Relaxed);
        calls.fetch_add(1, Ordering::Relaxed);
    };
    render(&scene, &view, &small(PASS + 1), Some(&report)).expect("a picture");
    assert_eq!((most.into_inner(), calls.into_inner()), (32, 32));
}

/// With lamps alone and one reflection it is what the other renderer computes.
#[test]
fn direct_light_is_that_of_the_ray_caster() {
    let scene = crate::default_scene(&LoadOptions::default()).expect("built in");
    let mut view = scene.views[0].clone();
    let lamps = view.lights.take().expect("its own lights");
    let cone = crate::Cone { direction: Vec3::NEG_Y, inner: 0.1, outer: 1.2 };
    let mut lights: Vec<Light> = lamps.into_iter().filter(|light| !matches!(light, Light::Ambient(_))).collect();
    lights.push(Light::Directional { to_light: Vec3::new(0.3, 1.0, 0.5), irradiance: Rgb::splat(0.5) });
    let (position, intensity) = (Vec3::Y * 4.0, Rgb::splat(5.0));
    lights.push(Light::Punctual { position, intensity, range: 10.0, cone: Some(cone) });
    view.lights = Some(lights);
    view.background = BLACK;
    // Materials that shine by themselves or as mirrors are another matter.
    let mut scene = scene;
    for material in &mut scene.materials {
        material.ambient = Rgb::splat(0.0);
        material.emission = Rgb::splat(0.0);
        material.mirror = Mirror::new(Rgb::splat(0.0));
    }
    let settings = Settings { width: 32, height: 18, samples: 256, ..Settings::default() };
    let cast = Renderer::new(&scene).and_then(|renderer| renderer.render(&view, &settings, None)).expect("a picture");
    let options = Options { width: 32, height: 18, samples: 256, max_depth: 1, ..Options::default() };
    let traced = picture(&scene, &view, &options);
    let sum = |pixels: &[[f32; 3]]| pixels.as_flattened().iter().map(|x| f64::from(*x)).sum::<f64>();
    let (whole, same) = (sum(cast.pixels()), sum(&traced));
    assert!(whole > 0.0 && (same / whole - 1.0).abs() < 5e-3, "{same} {whole}");
    let off: f64 =
        cast.pixels().as_flattened().iter().zip(traced.as_flattened()).map(|(a, b)| f64::from((a - b).abs())).sum();
    assert!(off / whole < 0.05, "{}", off / whole);
}

#[test]
fn no_light_gets_through_a_closed_surface() {
    // Eight corners around, and normals of a ball: as bent as can be.
    for (factor, inside) in [(1.0, true), (1.0, false)] {
        let material = lambert(factor);
        let scene = Scene {
            meshes: vec![ball(Vec3::ZERO, 1.0, 8, 0), ball(Vec3::ZERO, if inside { 3.0 } else { 0.3 }, 8, 1)],
            materials: vec![material, shining(1.0)],
            ..Scene::default()
        };
        let eye = if inside { Vec3::new(0.2, 0.1, 0.3) } else { Vec3::Z * 4.0 };
        let light = Light::Point { position: Vec3::splat(0.1), intensity: Rgb::splat(1.0), radius: 0.0 };
        let lights = if inside { vec![] } else { vec![light] };
        let background = if inside { WHITE } else { BLACK };
        let camera = Camera { eye, target: Vec3::new(0.0, 0.1, -0.2), ..Camera::default() };
        let pixels = picture(&scene, &view(camera, background, lights), &small(64));
        assert!(pixels.iter().all(|pixel| *pixel == [0.0; 3]), "{inside}");
    }
}

#[test]
fn a_mirror_shows_a_light_without_noise() {
    let mut scene = under_a_lamp(Material { mirror: Mirror::new(Rgb::splat(0.8)), ..shining(0.0) });
    // The camera is where the lamp's image is straight in the mirror.
    let view = view(down_at_origin(Vec3::new(-0.2, 1.0, -0.1) * 0.9), BLACK, vec![]);
    for strategy in strategies() {
        for pixel in picture(&scene, &view, &Options { strategy, ..small(4) }) {
            assert!((pixel[1] - 2.4).abs() < 1e-5, "{strategy:?}: {pixel:?}");
        }
    }
    // With a diffuse lobe beside it both are there.
    scene.materials[0] = Material { mirror: Mirror::new(Rgb::splat(0.5)), ..lambert(0.3) };
    let whole = whole_lamp();
    let measured = mean(&scene, &view, &Options { max_depth: 1, ..small(128) });
    assert_near(measured, 1.5 + 0.9 * whole, 5e-3, "mirror and floor");
}

#[test]
fn half_of_the_light_passes_what_is_half_there() {
    let pane = Material { dissolve: 0.25, ..shining(0.0) };
    let scene = Scene { meshes: vec![floor(5.0, 0)], materials: vec![pane], ..Scene::default() };
    let seen = view(down_at_origin(Vec3::new(1.0, 2.0, 0.0)), WHITE, vec![]);
    assert_near(mean(&scene, &seen, &small(64)), 0.75, 1e-2, "seen through");
    // And in the shadow of a pane: a floor, the pane over it, and a lamp.
    let mut scene = under_a_lamp(lambert(0.6));
    scene.meshes.push(rectangle(Vec3::Y * 0.5, [Vec3::X * 2.0, Vec3::Z * 2.0], 2));
    scene.materials.push(Material { dissolve: 0.25, ..shining(0.0) });
    // What is cut out is not there at all.
    scene.meshes.push(rectangle(Vec3::Y * 0.6, [Vec3::X * 2.0, Vec3::Z * 2.0], 3));
    scene.materials.push(gltf(Factors { cutoff: Some(2.0), double_sided: true, ..Factors::default() }));
    let whole = whole_lamp();
    let below = view(down_at_origin(Vec3::new(3.0, 0.3, 0.5)), BLACK, vec![]);
    for strategy in strategies() {
        let options = Options { strategy, max_depth: 1, ..small(128) };
        assert_near(mean(&scene, &below, &options), 0.75 * 1.8 * whole, 1e-2, &format!("{strategy:?}"));
    }
}

#[test]
fn a_light_that_is_half_there_gives_half() {
    let mut scene = under_a_lamp(lambert(0.6));
    scene.materials[1].dissolve = 0.5;
    let whole = whole_lamp();
    let view = view(down_at_origin(Vec3::new(3.0, 2.0, 0.5)), BLACK, vec![]);
    for strategy in strategies() {
        let options = Options { strategy, max_depth: 1, ..small(64) };
        assert_near(mean(&scene, &view, &options), 0.9 * whole, 1e-2, &format!("{strategy:?}"));
    }
}

/// A lobe that is wrong somewhere.
#[derive(Debug)]
struct Wrong(f32);

impl Brdf<f32> for Wrong {
    fn eval(&self, l: lobe::Vec3, v: lobe::Vec3) -> Rgb {
        if l.z.min(v.z) <= 0.0 {
            return Rgb::splat(0.0);
        }
        Rgb::splat(if l.x > 0.5 { self.0 } else { FRAC_1_PI as f32 })
    }
}

#[test]
fn what_is_no_radiance_is_counted_and_not_shown() {
    for wrong in [f32::NAN, f32::INFINITY, -10.0] {
        let material = Material::new("wrong", Surface::other(Wrong(wrong)));
        let scene = Scene { meshes: vec![floor(5.0, 0)], materials: vec![material], ..Scene::default() };
        let view = view(down_at_origin(Vec3::new(0.0, 2.0, 0.3)), WHITE, vec![]);
        let rendered = render(&scene, &view, &small(16), None).expect("a picture");
        assert!(rendered.nan_samples > 100 && rendered.nan_samples < 16 * 256, "{wrong}: {}", rendered.nan_samples);
        let pixels = rendered.image.pixels().as_flattened();
        assert!(pixels.iter().all(|channel| channel.is_finite() && *channel >= 0.0));
        let mean = pixels.iter().sum::<f32>() / pixels.len() as f32;
        assert!(mean > 0.3 && mean < 2.0, "{mean}");
    }
}

#[test]
fn one_sided_lights_shine_to_the_front() {
    let factors =
        |double_sided| Factors { emission: [3.0; 3], base_color: [0.0; 3], double_sided, ..Factors::default() };
    let whole = whole_lamp();
    let view = view(down_at_origin(Vec3::new(3.0, 0.5, 0.5)), BLACK, vec![]);
    for strategy in strategies() {
        let options = Options { strategy, max_depth: 1, ..small(64) };
        for (double_sided, turned, expected) in
            [(true, false, 1.0), (false, false, 1.0), (false, true, 0.0), (true, true, 1.0)]
        {
            let mut scene = under_a_lamp(lambert(0.6));
            scene.materials[1] = gltf(factors(double_sided));
            if turned {
                scene.meshes[1] = rectangle(Vec3::new(0.2, 1.0, 0.1), [Vec3::Z * 0.3, Vec3::X * 0.5], 1);
            }
            let (mean, error) = mean(&scene, &view, &options);
            let expected = expected * 1.8 * whole;
            assert!((mean - expected).abs() <= 5.0 * error + 1e-5, "{strategy:?} {double_sided} {turned}: {mean}");
        }
    }
}

#[test]
fn options_outside_their_domain_are_errors() {
    let (scene, view) = mixed();
    let wrong = [
        Options { samples: 0, ..small(1) },
        Options { samples: MAX_SAMPLES + 1, ..small(1) },
        Options { max_depth: MAX_DEPTH + 1, ..small(1) },
        Options { width: 0, ..small(1) },
        Options { environment: Some(Background::Solid(Rgb::splat(-1.0)).into()), ..small(1) },
        Options { environment: Some(Background::Solid(Rgb::splat(f32::NAN)).into()), ..small(1) },
    ];
    for options in wrong {
        assert!(render(&scene, &view, &options, None).is_err(), "{options:?}");
    }
}

#[test]
fn all_materials_of_mtl_are_finite_and_agree() {
    let lamp = rectangle(Vec3::new(0.2, 1.0, 0.1), [Vec3::X * 0.5, Vec3::Z * 0.3], 1);
    let view = view(down_at_origin(Vec3::new(3.0, 2.0, 0.5)), BLACK, vec![]);
    for model in ShadingModel::ALL {
        let mtl = MtlMaterial {
            kd: [0.3; 3],
            ks: [0.4; 3],
            ns: 20.0,
            illumination: crate::mtl::Illumination::Highlight,
            ..MtlMaterial::default()
        };
        let material = Material { ambient: Rgb::splat(0.0), ..Material::from_mtl(&mtl, model) };
        let meshes = vec![floor(5.0, 0), lamp.clone()];
        let scene = Scene { meshes, materials: vec![material, shining(3.0)], ..Scene::default() };
        let [lobes, lights] = [Strategy::Lobes, Strategy::Lights]
            .map(|strategy| mean(&scene, &view, &Options { strategy, max_depth: 1, ..small(128) }));
        let error = lobes.1.hypot(lights.1);
        assert!(error < 1e-2 * lights.0 && (lobes.0 - lights.0).abs() < 5.0 * error, "{model}: {lobes:?} {lights:?}");
    }
}
