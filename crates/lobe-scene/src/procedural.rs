//! Scenes made by a formula, for tests and measurements.

use crate::material::{Material, ShadingModel};
use crate::mesh::Mesh;
use crate::mtl::{Illumination, MtlMaterial};
use crate::scene::{Light, Scene, View};
use crate::{Camera, Error};
use glam::Vec3;
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
        }),
        lights: Some(vec![
            Light::Point { position: Vec3::new(-5.0, 8.0, 6.0), intensity: Rgb::splat(300.0), radius: 0.0 },
            Light::Ambient(Rgb::splat(0.1)),
        ]),
        ..View::default()
    };
    Ok(Scene { meshes, materials, views: vec![view], ..Scene::default() })
}
