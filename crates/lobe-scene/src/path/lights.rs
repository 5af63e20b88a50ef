//! From a point to a light: which one, where on it, and with which density.

use super::alias::Alias;
use super::environment::Environment;
use super::random::{Numbers, Purpose, unit};
use super::scatter::{emitted, is_behind};
use crate::bvh::Hit;
use crate::material::Material;
use crate::mesh::{area_vector, first_in_place};
use crate::render::{Jitter, Lights, OFFSET_UNITS, Point, Renderer, Textured};
use glam::{Vec2, Vec3};
use lobe::Rgb;
use rayon::prelude::*;
use std::f64::consts::PI;

/// All that shines, with the tables to pick from.
pub(crate) struct Sources {
    lights: Lights,
    /// Over points and then directions; none without any.
    lamps: Option<Alias>,
    environment: Environment,
    /// How often the environment is picked, and not a triangle.
    environment_share: f32,
    triangles: Option<Alias>,
    /// Which triangles those are.
    emitters: Vec<u32>,
    /// Of each triangle of the scene the density with which a point of it is picked, over its area; empty without emitters.
    per_area: Vec<f32>,
}

/// What arrives from a light, if nothing is between.
pub(crate) struct Arriving {
    /// The unit direction to the light, and what is reflected of it.
    pub(crate) l: Vec3,
    /// Where the shadow ray goes, and how far.
    pub(crate) towards: Vec3,
    pub(crate) distance: f32,
    /// The irradiance of a lamp, by the probability of the pick; the radiance of what has a size.
    pub(crate) light: Rgb,
    /// In sr⁻¹; of a lamp 0.
    pub(crate) pdf: f32,
}

impl Sources {
    pub(crate) fn new(
        renderer: &Renderer<'_>,
        materials: &[Material],
        lights: Lights,
        environment: Environment,
    ) -> Self {
        let (low, high) = renderer.bounds;
        let radius = f64::from((high - low).length()) / 2.0;
        let luminance = |colour: Rgb| f64::from(colour.luminance());
        let points = lights.points.iter().map(|lamp| {
            // The part of the sphere that a cone covers.
            let part = lamp.cone.map_or(1.0, |cone| (0.5 * f64::from(cone.outer)).sin().powi(2));
            luminance(lamp.light.intensity) * 4.0 * PI * part
        });
        let far = lights.directional.iter().map(|light| luminance(light.irradiance) * PI * radius * radius);
        let lamps = Alias::new(&points.chain(far).collect::<Vec<_>>());

        let brightness: Vec<f64> = materials.iter().map(brightness).collect();
        let mut emitters = Vec::new();
        let mut weights = Vec::new();
        let mut per_area = Vec::new();
        let mut table = None;
        if brightness.iter().any(|bright| *bright > 0.0) {
            // Of triangles in one place rays meet the first alone.
            let is_first = first_in_place(renderer.triangles.par_iter().map(|triangle| triangle.corners));
            for ((triangle, first), at) in renderer.triangles.iter().zip(is_first).zip(0..) {
                let bright = brightness.get(triangle.material as usize).copied().unwrap_or(0.0);
                if bright > 0.0 && first {
                    emitters.push(at);
                    weights.push(bright * area_vector(triangle.corners).length() / 2.0);
                }
            }
            table = Alias::new(&weights);
        }
        if let Some(table) = &table {
            per_area = vec![0.0; renderer.triangles.len()];
            for (entry, at) in emitters.iter().enumerate() {
                if let Some(triangle) = renderer.triangles.get(*at as usize) {
                    let area = area_vector(triangle.corners).length() / 2.0;
                    per_area[*at as usize] = (f64::from(table.probability(entry)) / area) as f32;
                }
            }
        }
        let environment_share = match (environment.shines(), table.is_some()) {
            (false, _) => 0.0,
            (true, false) => 1.0,
            (true, true) => 0.5,
        };
        Self { lights, lamps, environment, environment_share, triangles: table, emitters, per_area }
    }

    /// The radiance from outside the scene, and the density with which [`towards_extended`](Self::towards_extended) goes there.
    pub(crate) fn outside(&self, direction: Vec3, with_pdf: bool) -> (Rgb, f32) {
        let pdf = if with_pdf && self.environment_share > 0.0 {
            self.environment_share * self.environment.pdf(direction)
        } else {
            0.0
        };
        (self.environment.radiance(direction), pdf)
    }

    /// The density in sr⁻¹ with which a point of a triangle is picked that is seen from `from`.
    pub(crate) fn pdf(&self, triangle: u32, point: &Point<'_>, from: Vec3) -> f32 {
        let per_area = self.per_area.get(triangle as usize).copied().unwrap_or(0.0);
        if per_area <= 0.0 {
            return 0.0;
        }
        let away = from - point.position;
        // d² / cos, with the direction of the ray: from afar the difference of both points says the same.
        (1.0 - self.environment_share) * per_area * away.length_squared() / point.face.dot(point.v).abs()
    }

    /// One of the lights without a size: of a few in proportion to what arrives of each if nothing is between, of many in proportion
    /// to their power.
    pub(crate) fn towards_lamp(
        &self,
        point: &Point<'_>,
        start: Vec3,
        numbers: &Numbers,
        vertex: u32,
    ) -> Option<Arriving> {
        let (at, probability) = self.pick_lamp(point, numbers.bits(vertex, Purpose::Lamp, 0))?;
        if let Some(lamp) = self.lights.points.get(at) {
            let in_ball = || {
                let [a, b] = numbers.pair(vertex, Purpose::InLamp);
                Jitter([a, b, numbers.one(vertex, Purpose::InLampRadius, 0)]).in_ball()
            };
            let (incident, position) = lamp.reach(point.position, in_ball)?;
            let way = position - start;
            return Some(Arriving {
                l: incident.l.into(),
                towards: way.normalize_or_zero(),
                distance: way.length(),
                light: incident.irradiance / probability,
                pdf: 0.0,
            });
        }
        let light = self.lights.directional.get(at - self.lights.points.len())?.incident();
        let l = Vec3::from(light.l);
        Some(Arriving { l, towards: l, distance: f32::INFINITY, light: light.irradiance / probability, pdf: 0.0 })
    }

    /// Which lamp, and the probability of the pick.
    fn pick_lamp(&self, point: &Point<'_>, bits: [u32; 2]) -> Option<(usize, f32)> {
        let lamps = self.lamps.as_ref()?;
        let Lights { points, directional, .. } = &self.lights;
        let count = points.len() + directional.len();
        if count > FEW {
            return Some(lamps.pick(bits));
        }
        let mut arriving = [0.0_f32; FEW];
        let of_points = points.iter().map(|lamp| {
            let reached = lamp.reach(point.position, || Vec3::ZERO);
            reached.map_or(0.0, |(incident, _)| incident.irradiance.luminance())
        });
        let far = directional.iter().map(|light| light.irradiance.luminance());
        let mut sum = 0.0;
        for (place, light) in arriving.iter_mut().zip(of_points.chain(far)) {
            *place = light;
            sum += light;
        }
        if !(sum > 0.0 && sum.is_finite()) {
            // Nothing arrives, or more than there are numbers for: by the power then.
            return (sum != 0.0).then(|| lamps.pick(bits));
        }
        let mut rest = unit(bits[0]) * sum;
        let mut last = None;
        for (at, light) in arriving.iter().enumerate().filter(|(_, light)| **light > 0.0) {
            last = Some((at, light / sum));
            if rest < *light {
                break;
            }
            rest -= light;
        }
        last
    }

    /// A point of a light with a size: of the environment by its luminance, or of an emitting triangle, each triangle in
    /// proportion to its power and in it evenly over the area. Half of the samples go to either, where there are both.
    pub(crate) fn towards_extended(
        &self,
        renderer: &Renderer<'_>,
        materials: &[Material],
        start: Vec3,
        numbers: &Numbers,
        vertex: u32,
    ) -> Option<Arriving> {
        let [which, side] = numbers.bits(vertex, Purpose::Light, 0);
        let in_environment = (u64::from(which) as f64) < f64::from(self.environment_share) * 2.0_f64.powi(32);
        if in_environment {
            let (l, pdf) = self.environment.sample(numbers.fine(vertex, Purpose::OnLight));
            let pdf = pdf * self.environment_share;
            let light = self.environment.radiance(l);
            return (pdf > 0.0).then_some(Arriving { l, towards: l, distance: f32::INFINITY, light, pdf });
        }
        // What is left of the number picks the triangle.
        let which = if self.environment_share > 0.0 { which << 1 } else { which };
        let (entry, _) = self.triangles.as_ref()?.pick([which, side]);
        let at = *self.emitters.get(entry)?;
        let triangle = renderer.triangles.get(at as usize)?;
        let [u, w] = numbers.pair(vertex, Purpose::OnLight);
        let root = u.sqrt();
        let hit = Hit { triangle: at, t: 0.0, weights: [1.0 - root, root * (1.0 - w), root * w] };
        let [a, b, c] = triangle.corners;
        let [wa, wb, wc] = hit.weights;
        let l = (a * wa + b * wb + c * wc - start).try_normalize()?;
        let there = Point::new(triangle, &hit, l);
        let material = materials.get(triangle.material as usize)?;
        if is_behind(material, &there) || there.face.dot(there.v) <= 0.0 {
            return None;
        }
        let textured = material.is_textured().then(|| Textured::new(renderer.scene, &there, 0.0));
        let mut light = emitted(material, &there, textured.as_ref());
        if material.is_open() {
            light = light * opacity(material, textured.as_ref());
        }
        // Up to what lies before the light, not to the light itself: as far before it as the place is known from both ends.
        let margin = OFFSET_UNITS * f32::EPSILON * start.distance(there.position);
        let way = there.outside + there.face * margin - start;
        let pdf = self.pdf(at, &there, start);
        (pdf > 0.0).then(|| Arriving { l, towards: way.normalize_or_zero(), distance: way.length(), light, pdf })
    }
}

/// So many lamps are compared at every point.
const FEW: usize = 16;

/// How solid a point is.
pub(crate) fn opacity(material: &Material, textured: Option<&Textured>) -> f32 {
    match textured {
        Some(at) => material.opacity(at.uv, at.footprint, at.color[3]),
        None => material.dissolve,
    }
}

/// About how bright a material is by itself: for the pick of a triangle. Of a picture the mean counts, which is no less than a
/// step of its code if any texel is bright.
fn brightness(material: &Material) -> f64 {
    let mean = |map: Option<&crate::texture::Map>| {
        map.map_or(Rgb::splat(1.0), |map| {
            let [r, g, b, _] = map.at([Vec2::ZERO; 2], [f32::MAX; 2]);
            Rgb::new(r, g, b).map(|part| part.max(1.0 / 255.0))
        })
    };
    let (colour, map) = match (material.gltf(), material.mapped()) {
        (Some(gltf), _) if gltf.factors.unlit => (Rgb::from(gltf.factors.base_color), gltf.maps.base_color.as_ref()),
        (Some(gltf), _) => (Rgb::from(gltf.factors.emission), gltf.maps.emission.as_ref()),
        (None, Some(mapped)) => (material.emission, mapped.maps.emission.as_ref()),
        (None, None) => (material.emission, None),
    };
    f64::from((colour * mean(map)).luminance())
}
