//! A small ray caster that shades a scene with its lobes.
//!
//! For every sample of a pixel a ray finds the nearest triangle; there each light that is not in shadow gives
//! `eval_cos(l, v) · E`, a mirror sends a ray on, and a dissolved surface lets one through. The lobes are evaluated in
//! batches: all lights at all points of a row that have one material.

use crate::batch::LitPoints;
use crate::bvh::{Bvh, Hit};
use crate::camera::FARTHEST;
use crate::error::Error;
use crate::gltf_material::GltfMaterial;
use crate::image::Image;
use crate::material::{MappedAt, Material, Surface};
use crate::mesh::{Vertex, area_vector};
use crate::scene::{Background, Cone, Light, Scene, View};
use glam::{Vec2, Vec3};
use lobe::{
    Alpha, AmbientLight, Black, Clearcoat, DirectionalLight, Frame, Incident, PointLight, Rgb, interpolate_normal,
};
use lobe_models::AnyPrecision;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::atomic::{AtomicU64, Ordering};

/// Called now and then with the rows that are finished and the rows in all, from any thread.
pub type Progress<'a> = &'a (dyn Fn(u64, u64) + Sync);

/// Size and quality of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// Pixels in a row, 1 … [`MAX_SIDE`](crate::image::MAX_SIDE).
    pub width: u32,
    /// Rows, 1 … [`MAX_SIDE`](crate::image::MAX_SIDE).
    pub height: u32,
    /// Rays for each pixel, 1 … 4096, spread evenly over it; their mean is the pixel.
    pub samples: u32,
    /// How many mirrors and dissolved surfaces in a row are followed, 0 … 32.
    pub depth: u32,
    /// How many digits the lobes are asked for.
    pub precision: AnyPrecision,
}

impl Default for Settings {
    fn default() -> Self {
        Self { width: 1280, height: 720, samples: 1, depth: 8, precision: AnyPrecision::Precise }
    }
}

impl Settings {
    fn check(&self) -> Result<(), Error> {
        if !(1..=4096).contains(&self.samples) {
            return Err(Error::setting("samples", self.samples, "a pixel has 1 to 4096 of them"));
        }
        if self.depth > 32 {
            return Err(Error::setting("depth", self.depth, "it is at most 32: rays can double at each step"));
        }
        Ok(())
    }
}

/// A scene made ready for rays.
///
/// # What happens at the edges
///
/// * **Two sides.** Every surface is seen and lit from both sides. Its normals are turned to the side of the viewer,
///   whatever way round the file lists the corners.
/// * **Shading normals that face away.** At the outline of a coarse smooth mesh the interpolated normal can point
///   away from a viewer who does see the triangle. It is then bent in the plane of view to the nearest direction with
///   `n·v = 0.001`, so that no lobe is asked about a viewer below the horizon.
/// * **Shadows of smooth meshes.** A ray that starts on a flat triangle of a smooth mesh meets its neighbours near the
///   shadow's edge, and the facets show. The start is moved out to the curved surface that the normals mean (Hanika,
///   *Hacking the shadow terminator*, Ray Tracing Gems II, 2021).
/// * **Mirrors under the horizon.** A reflection that would go below the triangle is mirrored up at it.
/// * **Depth.** Mirror reflections and passages through dissolved surfaces are followed up to [`Settings::depth`] in a
///   row. Beyond it a mirror is black and a dissolved surface is solid.
///
/// The picture does not depend on the number of threads: each pixel is computed by itself, in one order.
pub struct Renderer<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) bvh: Bvh,
    pub(crate) triangles: Vec<ShadingTriangle>,
    pub(crate) bounds: (Vec3, Vec3),
    /// Whether some surface lets light through, so that shadows have to be multiplied up.
    dissolved: bool,
}

impl std::fmt::Debug for Renderer<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Renderer").field("triangles", &self.triangles.len()).field("bounds", &self.bounds).finish()
    }
}

/// What shading needs to know of a triangle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShadingTriangle {
    pub(crate) corners: [Vec3; 3],
    normals: [Vec3; 3],
    /// Of the plane, unit length, counter-clockwise side.
    pub(crate) face: Vec3,
    pub(crate) material: u32,
    /// Which mesh of the scene it is in, and which triangle there.
    place: [u32; 2],
}

impl<'a> Renderer<'a> {
    /// Checks the scene and builds the tree for its rays.
    ///
    /// # Errors
    /// [`Error::Setting`] when a mesh or a material holds a value outside its domain.
    pub fn new(scene: &'a Scene) -> Result<Self, Error> {
        for mesh in &scene.meshes {
            mesh.check(scene.materials.len())?;
        }
        for material in &scene.materials {
            if !(0.0..=1.0).contains(&material.dissolve) {
                let what = format!("the dissolve of material `{}`", material.name);
                return Err(Error::setting(what, material.dissolve, "it lies between 0 and 1"));
            }
        }
        let triangles: Vec<ShadingTriangle> = scene
            .meshes
            .iter()
            .zip(0_u32..)
            .flat_map(|(mesh, at)| {
                mesh.triangles.iter().zip(0_u32..).map(move |(triangle, within)| {
                    let corners = mesh.corners(triangle);
                    ShadingTriangle {
                        corners,
                        normals: triangle.normals.map(|normal| mesh.normals[normal as usize]),
                        face: area_vector(corners).normalize_or_zero().as_vec3(),
                        material: triangle.material,
                        place: [at, within],
                    }
                })
            })
            .collect();
        let bounds = scene
            .bounds()
            .ok_or_else(|| Error::setting("the number of triangles", 0, "a scene has at least one triangle"))?;
        let corners: Vec<[Vec3; 3]> = triangles.iter().map(|triangle| triangle.corners).collect();
        let dissolved = scene.materials.iter().any(Material::is_open);
        Ok(Self { scene, bvh: Bvh::new(&corners), triangles, bounds, dissolved })
    }

    /// Takes a picture: linear radiance, without exposure.
    ///
    /// It uses the threads of the current `rayon` pool and is the same for any number of them.
    ///
    /// # Errors
    /// [`Error::Setting`] for settings, a camera or lights outside their domain.
    pub fn render(&self, view: &View, settings: &Settings, progress: Option<Progress<'_>>) -> Result<Image, Error> {
        settings.check()?;
        let mut image = Image::new(settings.width, settings.height)?;
        let aspect = settings.width as f32 / settings.height as f32;
        let camera = view.camera_for(self.bounds.0, self.bounds.1, aspect);
        let rays = camera.rays(settings.width, settings.height)?;
        let lights = Lights::new(&view.lights_for(&camera))?;
        let materials = view.materials_of(&self.scene.materials);
        let (width_at_start, mut spread) = rays.pixel();
        // A pixel of many samples is seen as sharp as its samples are dense.
        spread /= (settings.samples as f32).sqrt();
        let pass = Pass {
            renderer: self,
            materials,
            lights,
            background: view.background,
            precision: settings.precision,
            spread,
        };
        let samples = sample_points(settings.samples);
        let weight = 1.0 / settings.samples as f32;
        let rows_done = AtomicU64::new(0);
        let rows = u64::from(settings.height);
        let width = settings.width as usize;
        image.pixels_mut().par_chunks_exact_mut(width).enumerate().for_each_init(
            || Row::new(width, pass.materials.len()),
            |row, (y, pixels)| {
                for x in 0..width {
                    for (sample, [dx, dy]) in samples.iter().enumerate() {
                        let (px, py) = (x as f32 + dx, y as f32 + dy);
                        let ray = Ray {
                            origin: rays.origin(px, py),
                            direction: rays.direction(px, py),
                            weight: Rgb::splat(1.0),
                            depth: settings.depth,
                            skips: MOST_SURFACES,
                            width: width_at_start,
                        };
                        pass.follow(&ray, x, Jitter::new(x, y, sample), row);
                    }
                }
                pass.shade(row);
                for (pixel, sum) in pixels.iter_mut().zip(&mut row.sums) {
                    *pixel = (std::mem::replace(sum, Rgb::splat(0.0)) * weight).into();
                }
                if let Some(progress) = progress {
                    progress(rows_done.fetch_add(1, Ordering::Relaxed) + 1, rows);
                }
            },
        );
        Ok(image)
    }

    /// The part of the light that arrives: the product of `1 − d` over the surfaces on the way.
    pub(crate) fn visible(&self, materials: &[Material], start: Vec3, to_light: Vec3, distance: f32) -> f32 {
        if !self.dissolved {
            return f32::from(u8::from(self.bvh.is_free(start.into(), to_light.into(), distance)));
        }
        // From surface to surface, as the view does, so that a ray through a shared edge counts one triangle.
        let (mut start, mut distance, mut visible) = (start, distance, 1.0);
        for _ in 0..MOST_SURFACES {
            let Some(hit) = self.bvh.nearest(start.into(), to_light.into(), distance) else {
                return visible;
            };
            let triangle = &self.triangles[hit.triangle as usize];
            let material = &materials[triangle.material as usize];
            let point = Point::new(triangle, &hit, to_light);
            let solid = match material.is_open() && material.is_textured() {
                true => {
                    let at = Textured::new(self.scene, &point, 0.0);
                    material.opacity(at.uv, at.footprint, at.color[3])
                }
                false => material.dissolve,
            };
            visible *= 1.0 - solid;
            if visible <= 0.0 {
                return 0.0;
            }
            // The ray starts a little behind the surface: without that, it would end as much behind its end.
            distance -= (point.inside - start).dot(to_light);
            start = point.inside;
        }
        0.0
    }
}

/// Points in the unit square for the samples of a pixel: Hammersley's set, centred, so that one sample is the middle.
fn sample_points(count: u32) -> Vec<[f32; 2]> {
    let inverse = |at: u32| at.reverse_bits() as f32 * 0.5_f32.powi(32);
    let mean = (0..count).map(inverse).sum::<f32>() / count as f32;
    (0..count).map(|at| [(at as f32 + 0.5) / count as f32, inverse(at) - mean + 0.5]).collect()
}

/// The lights of a view, sorted by kind.
pub(crate) struct Lights {
    ambient: AmbientLight,
    pub(crate) points: Vec<Lamp>,
    pub(crate) directional: Vec<DirectionalLight>,
}

/// A light at a point, of either kind.
pub(crate) struct Lamp {
    pub(crate) light: PointLight,
    /// 0 for a point.
    radius: f32,
    /// Infinite for no end.
    range: f32,
    pub(crate) cone: Option<Cone>,
}

impl Lamp {
    /// What arrives at a point, and where it comes from; nothing beyond the end of the light and outside its cone. `in_ball` is
    /// a point of the unit ball, which a light with a radius is picked by.
    #[inline]
    pub(crate) fn reach(&self, point: Vec3, in_ball: impl FnOnce() -> Vec3) -> Option<(Incident, Vec3)> {
        let mut light = self.light;
        if self.radius > 0.0 {
            light.position = (Vec3::from(light.position) + in_ball() * self.radius).into();
        }
        let mut incident = light.at(point.into());
        // Exactly 1 for a light without an end and without a cone.
        let within = (1.0 - (incident.distance / self.range).powi(4)).max(0.0);
        let part = within * self.cone.map_or(1.0, |cone| cone.part(-Vec3::from(incident.l)));
        if part <= 0.0 {
            return None;
        }
        incident.irradiance = incident.irradiance * part;
        Some((incident, light.position.into()))
    }
}

impl Lights {
    pub(crate) fn new(lights: &[Light]) -> Result<Self, Error> {
        let colour = |colour: Rgb| match <[f32; 3]>::from(colour).iter().all(|part| part.is_finite() && *part >= 0.0) {
            true => Ok(colour),
            false => {
                Err(Error::setting("the colour of a light", format!("{colour:?}"), "it is finite and not negative"))
            }
        };
        let mut sorted =
            Self { ambient: AmbientLight::new(Rgb::splat(0.0)), points: Vec::new(), directional: Vec::new() };
        let place = |position: Vec3| match position.abs().cmple(Vec3::splat(10.0 * FARTHEST)).all() {
            true => Ok(position.into()),
            // The default light stands a few times as far out as the camera.
            false => {
                let expected = "its coordinates are finite and at most 1e13 in size";
                Err(Error::setting("the position of a light", position, expected))
            }
        };
        for light in lights {
            match *light {
                Light::Point { position, intensity, radius } => {
                    if !(radius >= 0.0 && radius.is_finite()) {
                        return Err(Error::setting("the radius of a light", radius, "it is finite and not negative"));
                    }
                    let light = PointLight::new(place(position)?, colour(intensity)?);
                    sorted.points.push(Lamp { light, radius, range: f32::INFINITY, cone: None });
                }
                Light::Punctual { position, intensity, range, cone } => {
                    if range.is_nan() || range <= 0.0 {
                        return Err(Error::setting("the range of a light", range, "it is positive, or infinite"));
                    }
                    let light = PointLight::new(place(position)?, colour(intensity)?);
                    sorted.points.push(Lamp { light, radius: 0.0, range, cone });
                }
                Light::Directional { to_light, irradiance } => {
                    let to_light = to_light.as_dvec3().try_normalize().ok_or_else(|| {
                        Error::setting("the direction of a light", to_light, "it is finite and not zero")
                    })?;
                    sorted.directional.push(DirectionalLight::new(to_light.as_vec3().into(), colour(irradiance)?));
                }
                Light::Ambient(radiance) => sorted.ambient.radiance = sorted.ambient.radiance + colour(radiance)?,
            }
        }
        Ok(sorted)
    }
}

/// One picture being taken.
struct Pass<'a> {
    renderer: &'a Renderer<'a>,
    materials: Cow<'a, [Material]>,
    lights: Lights,
    background: Background,
    precision: AnyPrecision,
    /// By how much the width of a pixel grows with each unit of its ray.
    spread: f32,
}

/// A point that is being shaded, seen from the unit direction `v`.
pub(crate) struct Point<'a> {
    pub(crate) triangle: &'a ShadingTriangle,
    weights: [f32; 3],
    pub(crate) position: Vec3,
    pub(crate) v: Vec3,
    /// The plane's normal on the viewer's side.
    pub(crate) face: Vec3,
    /// Where rays start that leave on the viewer's side.
    pub(crate) outside: Vec3,
    /// Where rays start that pass through.
    pub(crate) inside: Vec3,
    pub(crate) frame: Frame,
}

/// How far a ray starts from the surface, in units in the last place of the largest coordinate around.
///
/// A point on a triangle is only known up to rounding: it lies above or below the plane by up to about 4 of these
/// units, and the ray test rounds by as much again. A ray that starts at the point itself meets the same triangle
/// again at half of all points, and the surface is covered with a pattern of its own shadow (the test
/// `without_an_offset_a_surface_shadows_itself` shows it). 32 units are a safe multiple, and are still only 2⁻¹⁸ of
/// the size of the scene. A fixed distance would be too little far from the origin and too much in a small scene.
pub(crate) const OFFSET_UNITS: f32 = 32.0;

/// The least cosine between shading normal and viewer.
const LEAST_COSINE: f32 = 1e-3;

impl<'a> Point<'a> {
    pub(crate) fn new(triangle: &'a ShadingTriangle, hit: &Hit, direction: Vec3) -> Self {
        Self::with_offset(triangle, hit, direction, OFFSET_UNITS)
    }

    fn with_offset(triangle: &'a ShadingTriangle, hit: &Hit, direction: Vec3, units: f32) -> Self {
        let v = -direction;
        let [a, b, c] = triangle.corners;
        let [wa, wb, wc] = hit.weights;
        // From the corners, not along the ray: the error then does not grow with the distance of the viewer.
        let position = a * wa + b * wb + c * wc;
        let face = if triangle.face.dot(v) < 0.0 { -triangle.face } else { triangle.face };
        let size = a.abs().max(b.abs()).max(c.abs()).max_element();
        let offset = face * (units * f32::EPSILON * size);

        let mut normal: Vec3 = interpolate_normal(triangle.normals.map(Into::into), hit.weights, face.into()).into();
        if normal.dot(face) < 0.0 {
            normal = -normal;
        }
        let normal = bent(normal, v, face);
        Self {
            triangle,
            weights: hit.weights,
            position,
            v,
            face,
            outside: position + offset,
            inside: position - offset,
            frame: Frame::from_normal(normal.into()),
        }
    }

    /// Where shadow rays start: on the curved surface that the normals at the corners mean.
    pub(crate) fn shadow_start(&self) -> Vec3 {
        let ShadingTriangle { corners, normals, .. } = self.triangle;
        let mut lift = Vec3::ZERO;
        for ((corner, normal), weight) in corners.iter().zip(normals).zip(self.weights) {
            let normal = if normal.dot(self.face) < 0.0 { -*normal } else { *normal };
            // The distance of the point below the tangent plane of the corner.
            let below = (self.position - corner).dot(normal).min(0.0);
            lift -= normal * (below * weight);
        }
        self.outside + lift
    }
}

/// A unit normal, or where it faces away from the viewer, the nearest direction in the plane of view that does not.
fn bent(normal: Vec3, v: Vec3, face: Vec3) -> Vec3 {
    if normal.dot(v) >= LEAST_COSINE {
        return normal;
    }
    let across = (normal - v * normal.dot(v)).normalize_or(face);
    (across + v * LEAST_COSINE).normalize()
}

/// What textures need to know of a point.
pub(crate) struct Textured {
    pub(crate) uv: [Vec2; 2],
    /// The side of the pixel on the surface, in both sets of texture coordinates.
    pub(crate) footprint: [f32; 2],
    pub(crate) color: [f32; 4],
    tangent: Vec3,
    /// ±1: on which side of normal and tangent the bitangent lies.
    hand: f32,
}

impl Textured {
    /// At a point that is seen with a pixel of this width.
    pub(crate) fn new(scene: &Scene, point: &Point<'_>, width: f32) -> Self {
        let [mesh, triangle] = point.triangle.place.map(|index| index as usize);
        let found = scene.meshes.get(mesh).and_then(|mesh| {
            let triangle = mesh.triangles.get(triangle)?;
            let [a, b, c] = triangle.vertices.map(|index| mesh.vertices.get(index as usize).copied());
            Some([a?, b?, c?])
        });
        let corners = found.unwrap_or([Vertex::default(); 3]);
        let [wa, wb, wc] = point.weights;
        let [a, b, c] = &corners;
        let uv = [0, 1].map(|set| a.uv[set] * wa + b.uv[set] * wb + c.uv[set] * wc);
        let tangent = a.tangent * wa + b.tangent * wb + c.tangent * wc;
        // A pixel covers width × width/cos on the surface: the square of the same area.
        let [p, q, r] = point.triangle.corners;
        let area = (q - p).cross(r - p).length();
        // Seen from its edge that would be infinite, and the texture as if near (test
        // `a_texture_seen_from_its_edge_is_filtered`).
        let seen = width * width / point.face.dot(point.v).max(LEAST_COSINE);
        let footprint = [0, 1].map(|set| {
            let (u, v) = (b.uv[set] - a.uv[set], c.uv[set] - a.uv[set]);
            let side = (u.perp_dot(v).abs() * seen / area).sqrt();
            if side.is_finite() { side } else { 0.0 }
        });
        Self {
            uv,
            footprint,
            color: std::array::from_fn(|i| a.color[i] * wa + b.color[i] * wb + c.color[i] * wc),
            tangent: tangent.truncate(),
            hand: if tangent.w < 0.0 { -1.0 } else { 1.0 },
        }
    }

    /// The frame of a lobe whose normal is given in the tangent frame of the point, and the direction that it is to be turned
    /// to, if the lobe is not the same all around.
    ///
    /// A mapped normal that faces away from the viewer is bent as an interpolated one is: else bumps would have black
    /// outlines.
    pub(crate) fn frame(&self, point: &Point<'_>, normal: Vec3, direction: Option<Vec2>) -> Frame {
        if normal == Vec3::Z && direction.is_none() {
            return point.frame;
        }
        // From behind all three axes point the other way.
        let side = if point.triangle.face.dot(point.v) < 0.0 { -1.0 } else { 1.0 };
        let around = Frame::from_normal_tangent(point.frame.normal, (self.tangent * side).into());
        let (t, n) = (Vec3::from(around.tangent), Vec3::from(around.normal));
        let b = Vec3::from(around.bitangent) * (self.hand * side);
        let mapped = (t * normal.x + b * normal.y + n * normal.z).normalize_or(n);
        let mapped = bent(mapped, point.v, point.face);
        match direction {
            Some(direction) => Frame::from_normal_tangent(mapped.into(), (t * direction.x + b * direction.y).into()),
            None => Frame::from_normal(mapped.into()),
        }
    }
}

/// Where in its cluster each light is sampled.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jitter(pub(crate) [f32; 3]);

impl Jitter {
    /// For sample `sample` of a pixel: the additive recurrence R3 (Roberts, 2018), shifted by a hash of the pixel so
    /// that neighbours differ.
    fn new(x: usize, y: usize, sample: usize) -> Self {
        let hash = |salt: u32| {
            let mut bits = (x as u32).wrapping_mul(0x9e37_79b1) ^ (y as u32).wrapping_mul(0x85eb_ca77) ^ salt;
            bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
            bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
            (bits ^ (bits >> 16)) as f32 * 0.5_f32.powi(32)
        };
        let steps = [0.819_172_5, 0.671_043_6, 0.549_700_5];
        Self([0, 1, 2].map(|axis| (hash(axis as u32 * 0x27d4_eb2f) + steps[axis] * sample as f32).fract()))
    }

    /// A point of the unit ball, evenly spread.
    pub(crate) fn in_ball(self) -> Vec3 {
        let [a, b, c] = self.0;
        let z = 1.0 - 2.0 * a;
        let (sine, cosine) = (std::f32::consts::TAU * b).sin_cos();
        let ring = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(ring * cosine, ring * sine, z) * c.cbrt()
    }
}

/// A ray on its way from the viewer, and the part of what it finds that reaches the pixel.
struct Ray {
    origin: Vec3,
    direction: Vec3,
    weight: Rgb,
    depth: u32,
    /// How many surfaces that are not there at all it may still pass.
    skips: u32,
    /// The width of its pixel where it starts.
    width: f32,
}

/// Light that has passed so many surfaces is taken as lost.
pub(crate) const MOST_SURFACES: u32 = 256;

/// A row of pixels being computed.
///
/// First all of its rays are followed, and every light at every point that is met is put into the queue of its material.
/// Then each queue is shaded as one batch, and last the lights that are not black there are looked for from their points.
struct Row {
    /// Of each pixel.
    sums: Vec<Rgb>,
    /// Of each material, and then of the second lobe of each: the coat, or the highlight of one with pictures.
    queues: Vec<Queue>,
    /// What a batch has given, cleared after each.
    reflected: [Vec<f32>; 3],
}

impl Row {
    fn new(width: usize, materials: usize) -> Self {
        Self {
            sums: vec![Rgb::splat(0.0); width],
            queues: (0..2 * materials).map(|_| Queue::default()).collect(),
            reflected: Default::default(),
        }
    }
}

/// The lights that may reach points of one material.
#[derive(Default)]
struct Queue {
    lit: LitPoints,
    ways: Vec<Way>,
}

/// From a point to a light, and where the light goes from there.
struct Way {
    start: Vec3,
    to_light: Vec3,
    distance: f32,
    pixel: usize,
    weight: Rgb,
}

impl Queue {
    fn push(&mut self, frame: &Frame, light: Incident, v: lobe::Vec3, parameters: &[f32], way: Way) {
        self.lit.push(frame.to_local(light.l), v, light.irradiance, parameters);
        self.ways.push(way);
    }

    fn clear(&mut self) {
        self.lit.clear();
        self.ways.clear();
    }
}

impl Pass<'_> {
    /// Adds to the pixel what arrives along the ray without a light, and puts the lights into their queues.
    fn follow(&self, ray: &Ray, pixel: usize, jitter: Jitter, row: &mut Row) {
        let renderer = self.renderer;
        let Some(hit) = renderer.bvh.nearest(ray.origin.into(), ray.direction.into(), f32::INFINITY) else {
            row.sums[pixel] = row.sums[pixel] + ray.weight * self.background.radiance(ray.direction);
            return;
        };
        let triangle = &renderer.triangles[hit.triangle as usize];
        let material = &self.materials[triangle.material as usize];
        let point = Point::new(triangle, &hit, ray.direction);
        let width = ray.width + self.spread * hit.t;
        let textured = material.is_textured().then(|| Textured::new(renderer.scene, &point, width));
        let mut solid = match &textured {
            Some(at) => material.opacity(at.uv, at.footprint, at.color[3]),
            None => material.dissolve,
        };
        let one_sided = material.gltf().is_some_and(|gltf| !gltf.factors.double_sided);
        if one_sided && triangle.face.dot(ray.direction) > 0.0 {
            solid = 0.0;
        }
        let mut weight = ray.weight;
        let through = if solid <= 0.0 { ray.skips } else { ray.depth };
        if solid < 1.0 && through > 0 {
            let [depth, skips] = if solid <= 0.0 { [ray.depth, ray.skips - 1] } else { [ray.depth - 1, ray.skips] };
            let behind = Ray {
                origin: point.inside,
                direction: ray.direction,
                weight: weight * (1.0 - solid),
                depth,
                skips,
                width,
            };
            self.follow(&behind, pixel, jitter, row);
            weight = weight * solid;
        }
        if solid <= 0.0 {
            return;
        }
        if let (Some(gltf), Some(at)) = (material.gltf(), &textured) {
            self.follow_gltf(gltf, at, &point, pixel, weight, jitter, row);
            return;
        }
        let mut found = MappedAt::default();
        let mut frame = point.frame;
        if let (Some(mapped), Some(at)) = (material.mapped(), &textured) {
            found = mapped.at(at.uv, at.footprint);
            frame = at.frame(&point, found.normal, None);
            if mapped.highlight.is_some() {
                let queue = &mut row.queues[self.materials.len() + triangle.material as usize];
                self.queue_lights(&point, &frame, pixel, weight * found.specular, jitter, &[], queue);
            }
        }
        let ambient = material.ambient * found.ambient * self.lights.ambient.radiance;
        row.sums[pixel] = row.sums[pixel] + weight * (material.emission * found.emission + ambient);
        if !matches!(material.surface, Surface::Black) {
            let queue = &mut row.queues[triangle.material as usize];
            self.queue_lights(&point, &frame, pixel, weight * found.diffuse, jitter, &[], queue);
        }
        if is_black(material.mirror.ks()) || ray.depth == 0 {
            return;
        }
        let seen = material.mirror.reflect(frame.to_local(point.v.into()));
        let mut direction: Vec3 = frame.to_world(seen.l).into();
        let below = direction.dot(point.face).min(0.0);
        direction = (direction - point.face * (2.0 * below)).normalize_or(point.face);
        let mirrored = Ray {
            origin: point.outside,
            direction,
            weight: weight * seen.weight * found.specular,
            depth: ray.depth - 1,
            skips: ray.skips,
            width,
        };
        self.follow(&mirrored, pixel, jitter, row);
    }

    /// A point of a material of glTF: its base, and its coat if it has one, in frames of their own.
    #[allow(clippy::too_many_arguments, reason = "what `follow` knows of the point")]
    fn follow_gltf(
        &self,
        gltf: &GltfMaterial,
        at: &Textured,
        point: &Point<'_>,
        pixel: usize,
        weight: Rgb,
        jitter: Jitter,
        row: &mut Row,
    ) {
        let [r, g, b, _] = at.color;
        let found = gltf.at(at.uv, at.footprint, Rgb::new(r, g, b));
        if gltf.factors.unlit {
            row.sums[pixel] = row.sums[pixel] + weight * found.base_color;
            return;
        }
        let material = point.triangle.material as usize;
        let mut below = weight;
        let frame = at.frame(point, found.normal, gltf.is_anisotropic().then_some(found.direction));
        let seen = |frame: &Frame| Vec3::from(frame.normal).dot(point.v);
        let mut coat_cos = 1.0;
        if gltf.has_coat() {
            let frame = at.frame(point, found.coat_normal, None);
            let v = frame.to_local(point.v.into());
            coat_cos = seen(&frame);
            below = weight * Clearcoat::new(Black, found.coat, Alpha(found.coat_alpha)).transmitted(v);
            let queue = &mut row.queues[self.materials.len() + material];
            self.queue_lights(point, &frame, pixel, weight, jitter, &[found.coat, found.coat_alpha], queue);
        }
        if !is_black(self.lights.ambient.radiance) {
            let (diffuse, specular) = gltf.ambient(&found, seen(&frame), coat_cos);
            let ambient =
                diffuse * self.lights.ambient.radiance + specular * self.mirrored(point, &frame, found.alpha, jitter);
            row.sums[pixel] = row.sums[pixel] + weight * ambient;
        }
        row.sums[pixel] = row.sums[pixel] + below * found.emission;
        let (parameters, count) = gltf.parameters(&found);
        let parameters = parameters.get(..count).unwrap_or(&[]);
        self.queue_lights(point, &frame, pixel, below, jitter, parameters, &mut row.queues[material]);
    }

    /// The ambient light from the mirror direction of the viewer: as much as there is on the mean, spread like the
    /// background. What stands before that is seen as the ambient light that it sends on itself, the less sharply the rougher
    /// the surface is: a slope of `α` turns the mirror direction by twice its angle.
    fn mirrored(&self, point: &Point<'_>, frame: &Frame, alpha: f32, jitter: Jitter) -> Rgb {
        let ambient = self.lights.ambient.radiance;
        let mean = self.background.mean();
        let normal = Vec3::from(frame.normal);
        let mirror = normal * (2.0 * normal.dot(point.v)) - point.v;
        let direction = (mirror + jitter.in_ball() * (2.0 * alpha)).normalize_or(normal);
        if direction.dot(point.face) <= 0.0 {
            return ambient;
        }
        if let Some(hit) = self.renderer.bvh.nearest(point.outside.into(), direction.into(), f32::INFINITY) {
            let triangle = self.renderer.triangles.get(hit.triangle as usize);
            let material = triangle.and_then(|triangle| self.materials.get(triangle.material as usize));
            return material.map_or(ambient, |material| ambient * material.colour());
        }
        let there = self.background.radiance(direction);
        let part = |ambient: f32, there: f32, mean: f32| if mean > 0.0 { ambient * (there / mean) } else { ambient };
        Rgb::new(part(ambient.r, there.r, mean.r), part(ambient.g, there.g, mean.g), part(ambient.b, there.b, mean.b))
    }

    #[allow(clippy::too_many_arguments, reason = "a point, a lobe's frame and numbers, and where they go")]
    fn queue_lights(
        &self,
        point: &Point<'_>,
        frame: &Frame,
        pixel: usize,
        weight: Rgb,
        jitter: Jitter,
        parameters: &[f32],
        queue: &mut Queue,
    ) {
        let v = frame.to_local(point.v.into());
        let start = point.shadow_start();
        for lamp in &self.lights.points {
            let Some((incident, position)) = lamp.reach(point.position, || jitter.in_ball()) else { continue };
            let way = position - start;
            let way = Way { start, to_light: way.normalize_or_zero(), distance: way.length(), pixel, weight };
            queue.push(frame, incident, v, parameters, way);
        }
        for light in &self.lights.directional {
            let way = Way { start, to_light: light.to_light.into(), distance: f32::INFINITY, pixel, weight };
            queue.push(frame, light.incident(), v, parameters, way);
        }
    }

    /// Shades what is in the queues, and empties them.
    fn shade(&self, row: &mut Row) {
        for (index, queue) in row.queues.iter_mut().enumerate() {
            let (lit, out) = (&queue.lit, &mut row.reflected);
            let below = index.checked_sub(self.materials.len()).and_then(|index| self.materials.get(index));
            match (self.materials.get(index), below.and_then(Material::mapped)) {
                (Some(material), _) => material.surface.shade(lit, self.precision, out),
                (None, None) => lit.shade_coat(self.precision, out),
                (None, Some(mapped)) => match &mapped.highlight {
                    Some(highlight) => highlight.shade(lit, self.precision, out),
                    None => Surface::Black.shade(lit, self.precision, out),
                },
            }
            let [r, g, b] = &row.reflected;
            for (way, ((&r, &g), &b)) in queue.ways.iter().zip(r.iter().zip(g).zip(b)) {
                let reflected = Rgb::new(r, g, b);
                if !is_black(reflected) {
                    let visible = self.renderer.visible(&self.materials, way.start, way.to_light, way.distance);
                    row.sums[way.pixel] = row.sums[way.pixel] + way.weight * (reflected * visible);
                }
            }
            queue.clear();
        }
    }
}

/// Exactly nothing. NaN is something.
pub(crate) fn is_black(colour: Rgb) -> bool {
    colour == Rgb::splat(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural::sphere;

    /// The share of points on a sphere whose shadow ray to a lamp, straight away from the surface, meets something.
    fn shadowed(units: f32) -> f32 {
        let center = Vec3::new(10.0, 20.0, 30.0);
        let (points, faces) = sphere(center, 1.0, 64);
        let corners: Vec<[Vec3; 3]> = faces.iter().map(|face| face.map(|at| points[at as usize])).collect();
        let bvh = Bvh::new(&corners);
        let mut wrong = 0;
        for (at, &corners) in corners.iter().enumerate() {
            let face = area_vector(corners).normalize_or_zero().as_vec3();
            let triangle = ShadingTriangle { corners, normals: [face; 3], face, material: 0, place: [0; 2] };
            let hit = Hit { triangle: at as u32, t: 1.0, weights: [0.2, 0.3, 0.5] };
            let point = Point::with_offset(&triangle, &hit, -face, units);
            wrong += usize::from(!bvh.is_free(point.outside.into(), face.into(), f32::INFINITY));
        }
        wrong as f32 / corners.len() as f32
    }

    #[test]
    fn without_an_offset_a_surface_shadows_itself() {
        assert!(shadowed(0.0) > 0.2, "{}", shadowed(0.0));
        // A quarter of the offset is enough here: the rest is margin.
        assert_eq!(shadowed(OFFSET_UNITS / 4.0), 0.0);
        assert_eq!(shadowed(OFFSET_UNITS), 0.0);
    }

    #[test]
    fn one_sample_is_the_middle_and_many_are_centred() {
        assert_eq!(sample_points(1), [[0.5, 0.5]]);
        for count in [2, 3, 16, 100] {
            let points = sample_points(count);
            for axis in 0..2 {
                let mean = points.iter().map(|point| point[axis]).sum::<f32>() / count as f32;
                assert!((mean - 0.5).abs() < 1e-5);
                assert!(points.iter().all(|point| (0.0..=1.0).contains(&point[axis])));
            }
        }
    }

    #[test]
    fn a_normal_that_faces_away_is_bent_to_the_viewer() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let away = Vec3::new(0.8, 0.0, 0.6);
        let triangle = ShadingTriangle { corners, normals: [away; 3], face: Vec3::Z, material: 0, place: [0; 2] };
        let hit = Hit { triangle: 0, t: 1.0, weights: [0.4, 0.3, 0.3] };
        // The viewer is low on the other side: 0.8·(−0.98) + 0.6·0.2 < 0.
        let v = Vec3::new(-0.98, 0.0, 0.2).normalize();
        let point = Point::new(&triangle, &hit, -v);
        let normal = Vec3::from(point.frame.normal);
        assert!((normal.dot(v) - LEAST_COSINE).abs() < 1e-5, "{normal}");
        assert!(normal.dot(away) > 0.7 && (normal.length() - 1.0).abs() < 1e-6);
    }
}
