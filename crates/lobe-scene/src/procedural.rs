//! Scenes made by a formula, for tests and measurements.

use crate::material::{Material, ShadingModel};
use crate::mesh::{Mesh, Vertex};
use crate::mtl::{Illumination, MtlMaterial};
use crate::scene::{Light, Scene, View};
use crate::tangents;
use crate::{Camera, Error};
use glam::{Vec2, Vec3};
use lobe::Rgb;

/// The points and faces of a sphere of `2 · around · (around / 2 − 1)` triangles, counter-clockwise from outside.
/// `around` is at least 4; smaller values count as 4.
#[must_use]
pub fn sphere(center: Vec3, radius: f32, around: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let around = around.clamp(4, 1 << 14);
    let rings = around / 2;
    let mut points = vec![center + Vec3::Y * radius];
    for ring in 1..rings {
        let (sine, cosine) = (std::f64::consts::PI * f64::from(ring) / f64::from(rings)).sin_cos();
        for step in 0..around {
            let (s, c) = (std::f64::consts::TAU * f64::from(step) / f64::from(around)).sin_cos();
            points.push(center + glam::DVec3::new(sine * s, cosine, sine * c).as_vec3() * radius);
        }
    }
    points.push(center - Vec3::Y * radius);
    let last = points.len() as u32 - 1;
    let at = |ring: u32, step: u32| 1 + (ring - 1) * around + step % around;
    let mut faces = Vec::new();
    for step in 0..around {
        faces.push([0, at(1, step), at(1, step + 1)]);
        for ring in 1..rings - 1 {
            let [a, b, c, d] = [at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
        faces.push([last, at(rings - 1, step + 1), at(rings - 1, step)]);
    }
    (points, faces)
}

/// A field of glossy spheres over a floor, with at least so many triangles (up to 10 million), one point light that
/// throws shadows, and a camera that sees all of it: the scene that rendering times are measured on.
///
/// # Errors
/// None for any input; the meshes are checked like all others.
pub fn sphere_field(triangles: u32) -> Result<Scene, Error> {
    const ACROSS: u32 = 10;
    let wanted = triangles.min(10_000_000) / (ACROSS * ACROSS) + 1;
    // A sphere of `n` around has n² − 2n triangles.
    let around = (1.0 + f64::from(wanted + 1).sqrt()).ceil() as u32;
    let around = (around + around % 2).max(4);
    let mut meshes = Vec::new();
    for row in 0..ACROSS {
        for column in 0..ACROSS {
            let center = Vec3::new(column as f32 - 4.5, 0.42, 4.5 - row as f32);
            let (points, faces) = sphere(center, 0.42, around);
            meshes.push(Mesh::smooth(points, &faces, (row + column) % 3, 60.0)?);
        }
    }
    let side = 7.0;
    let floor = [[-side, side], [side, side], [side, -side], [-side, -side]].map(|[x, z]| Vec3::new(x, 0.0, z));
    meshes.push(Mesh::flat(floor.to_vec(), &[[0, 1, 2], [0, 2, 3]], 3)?);
    let glossy = |kd: [f32; 3], ns: f32| MtlMaterial {
        kd,
        ks: [0.3; 3],
        ns,
        illumination: Illumination::Highlight,
        ..MtlMaterial::default()
    };
    let materials = [glossy([0.6, 0.1, 0.1], 20.0), glossy([0.1, 0.5, 0.2], 80.0), glossy([0.1, 0.2, 0.6], 320.0)];
    let mut materials = materials.map(|mtl| Material::from_mtl(&mtl, ShadingModel::BlinnTorrance)).to_vec();
    materials.push(Material::default());
    let view = View {
        name: "field".to_owned(),
        camera: Some(Camera {
            eye: Vec3::new(0.0, 7.0, 10.0),
            target: Vec3::new(0.0, 0.0, 0.5),
            up: Vec3::Y,
            fov_y_degrees: 42.0,
            height: None,
        }),
        lights: Some(vec![
            Light::Point { position: Vec3::new(-5.0, 8.0, 6.0), intensity: Rgb::splat(300.0), radius: 0.0 },
            Light::Ambient(Rgb::splat(0.1)),
        ]),
        ..View::default()
    };
    Ok(Scene { meshes, materials, views: vec![view], ..Scene::default() })
}

/// The points and faces of a tube along a trefoil knot that fits into a ball of radius `size`.
#[must_use]
pub fn knot(center: Vec3, size: f32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    const ALONG: u32 = 480;
    const AROUND: u32 = 40;
    /// Half of the thickness of the tube, where the curve reaches out to 1.5.
    const TUBE: f64 = 0.36;
    let curve = |t: f64| {
        let ring = 1.0 + 0.5 * (3.0 * t).cos();
        glam::DVec3::new(ring * (2.0 * t).cos(), ring * (2.0 * t).sin(), 0.55 * (3.0 * t).sin())
    };
    let scale = f64::from(size) / (1.5 + TUBE);
    let mut points = Vec::new();
    for step in 0..ALONG {
        let t = std::f64::consts::TAU * f64::from(step) / f64::from(ALONG);
        let here = curve(t);
        let ahead = (curve(t + 1e-4) - curve(t - 1e-4)).normalize();
        // Away from the middle, at a right angle to the curve: it closes after one round.
        let side = ahead.cross(here).normalize();
        let out = side.cross(ahead);
        for turn in 0..AROUND {
            let (s, c) = (std::f64::consts::TAU * f64::from(turn) / f64::from(AROUND)).sin_cos();
            points.push(center + ((here + (out * c + side * s) * TUBE) * scale).as_vec3());
        }
    }
    let at = |step: u32, turn: u32| step % ALONG * AROUND + turn % AROUND;
    let mut faces = Vec::new();
    for step in 0..ALONG {
        for turn in 0..AROUND {
            let (a, b) = (at(step, turn), at(step, turn + 1));
            let (c, d) = (at(step + 1, turn + 1), at(step + 1, turn));
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    (points, faces)
}

/// A sphere and a knot of one material on a grey floor: what a material looks like.
///
/// # Errors
/// None for any material; the meshes are checked like all others.
pub fn show_material(material: &lobe_models::Material) -> Result<Scene, Error> {
    let (points, faces) = sphere(Vec3::new(-1.15, 1.0, 0.0), 1.0, 128);
    let ball = Mesh::smooth(points, &faces, 0, 60.0)?;
    let (points, faces) = knot(Vec3::new(1.15, 1.05, 0.0), 1.05);
    let knot = Mesh::smooth(points, &faces, 0, 60.0)?;
    let side = 40.0;
    let floor = [[-side, side], [side, side], [side, -side], [-side, -side]].map(|[x, z]| Vec3::new(x, 0.0, z));
    let floor = Mesh::flat(floor.to_vec(), &[[0, 1, 2], [0, 2, 3]], 1)?;
    let grey = Material {
        ambient: Rgb::splat(0.3),
        ..Material::new("floor", crate::Surface::Diffuse(lobe::Lambert::new(Rgb::splat(0.3))))
    };
    let view = View {
        name: "material".to_owned(),
        camera: Some(Camera {
            eye: Vec3::new(0.0, 2.6, 7.6),
            target: Vec3::new(0.0, 0.95, 0.0),
            up: Vec3::Y,
            fov_y_degrees: 24.0,
            height: None,
        }),
        lights: Some(show_lights()),
        background: crate::Background::Gradient { bottom: Rgb::splat(0.25), top: Rgb::new(0.4, 0.43, 0.48) },
        ..View::default()
    };
    let shown = Material::from_lobes(material.name.as_str(), material);
    Ok(Scene { meshes: vec![ball, knot, floor], materials: vec![shown, grey], views: vec![view], ..Scene::default() })
}

/// A lamp from the upper left, a weaker one from the right, one from behind, and the sky.
fn show_lights() -> Vec<Light> {
    let lamp = |position: [f32; 3], intensity: f32, radius: f32| Light::Point {
        position: position.into(),
        intensity: Rgb::splat(intensity),
        radius,
    };
    vec![
        lamp([-4.0, 6.0, 5.0], 170.0, 0.25),
        lamp([6.0, 3.5, 4.0], 45.0, 0.3),
        lamp([1.0, 5.0, -5.0], 70.0, 0.3),
        Light::Ambient(Rgb::splat(0.16)),
    ]
}

/// A sphere alone, lit from the upper left and a little from the right: one field of a contact sheet, which is square.
///
/// # Errors
/// None for any material.
pub fn swatch(material: Material) -> Result<Scene, Error> {
    let (points, faces) = sphere(Vec3::ZERO, 1.0, 64);
    let mut ball = Mesh::smooth(points, &faces, 0, 60.0)?;
    if material.is_textured() {
        wrap(&mut ball);
    }
    let lamp = |to_light: [f32; 3], irradiance: f32| Light::Directional {
        to_light: Vec3::from(to_light).normalize(),
        irradiance: Rgb::splat(irradiance),
    };
    let view = View {
        name: "swatch".to_owned(),
        camera: Some(Camera {
            eye: Vec3::new(0.0, 0.0, 6.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            fov_y_degrees: 21.0,
            height: None,
        }),
        lights: Some(vec![lamp([-0.5, 0.7, 0.75], 2.6), lamp([0.9, 0.15, 0.1], 1.0), Light::Ambient(Rgb::splat(0.12))]),
        background: crate::Background::Solid(Rgb::splat(0.03)),
        ..View::default()
    };
    Ok(Scene { meshes: vec![ball], materials: vec![material], views: vec![view], ..Scene::default() })
}

/// Texture coordinates on a sphere around the origin, each picture once from pole to pole and twice around, and tangents.
fn wrap(ball: &mut Mesh) {
    let mut vertices = Vec::new();
    for triangle in &mut ball.triangles {
        let corners = triangle.positions.map(|at| ball.positions.get(at as usize).copied().unwrap_or_default());
        let middle = corners.iter().sum::<Vec3>();
        let turn = |point: Vec3| point.x.atan2(point.z) / std::f32::consts::PI;
        for (corner, index) in corners.into_iter().zip(&mut triangle.vertices) {
            // A pole has no meridian, and at the seam one corner would be a whole turn away.
            let at_pole = corner.x == 0.0 && corner.z == 0.0;
            let mut u = if at_pole { turn(middle) } else { turn(corner) };
            u -= 2.0 * ((u - turn(middle)) / 2.0).round();
            let v = corner.y.clamp(-1.0, 1.0).acos() / std::f32::consts::PI;
            *index = vertices.len() as u32;
            vertices.push(Vertex { uv: [Vec2::new(u, v); 2], ..Vertex::default() });
        }
    }
    ball.vertices = vertices;
    tangents::fill(ball, 0);
}
