//! One path, from the camera on.

use super::lights::{Sources, opacity};
use super::random::{Numbers, Purpose};
use super::scatter::{Scatter, is_behind};
use super::{Options, Strategy};
use crate::material::Material;
use crate::render::{MOST_SURFACES, Point, Renderer, Textured, is_black};
use glam::Vec3;
use lobe::Rgb;
use lobe_sampling::mis;
use std::borrow::Cow;

/// A scene with its lights, ready for paths.
pub(crate) struct Tracer<'a> {
    pub(crate) renderer: &'a Renderer<'a>,
    pub(crate) materials: Cow<'a, [Material]>,
    pub(crate) sources: Sources,
    /// By how much the width of a pixel grows with each unit of its ray.
    pub(crate) spread: f32,
    pub(crate) options: Options,
}

/// How the ray came to where it is: what it needs to weigh a light that it meets.
enum Last {
    /// From the camera or by mirrors alone since then, or since a density: no light is looked for that way.
    Single,
    /// From a lobe, whose ray started here, with this density in sr⁻¹.
    Density { from: Vec3, pdf: f32 },
}

impl Tracer<'_> {
    /// The radiance along a ray: one estimate.
    pub(crate) fn radiance(&self, mut origin: Vec3, mut direction: Vec3, mut width: f32, numbers: &Numbers) -> Rgb {
        let mut sum = Rgb::splat(0.0);
        let mut weight = Rgb::splat(1.0);
        let mut last = Last::Single;
        let mut spread = self.spread;
        // Vertices of the path: 0 is the camera.
        let mut vertex = 1;
        let mut crossed = 0;
        loop {
            let Some(hit) = self.renderer.bvh.nearest(origin.into(), direction.into(), f32::INFINITY) else {
                let (light, pdf) = self.sources.outside(direction, matches!(last, Last::Density { .. }));
                return sum + weight * light * self.share(&last, pdf);
            };
            let triangle = &self.renderer.triangles[hit.triangle as usize];
            let material = &self.materials[triangle.material as usize];
            let point = Point::new(triangle, &hit, direction);
            width += spread * hit.t;
            let textured = material.is_textured().then(|| Textured::new(self.renderer.scene, &point, width));
            let mut solid = opacity(material, textured.as_ref());
            // The back of a surface of one side is not seen. For light that comes by way of other surfaces it is there, as it is
            // for shadows: one rule for both, or the ways to find a light would not agree.
            if matches!(last, Last::Single) && is_behind(material, &point) {
                solid = 0.0;
            }
            if solid < 1.0 && numbers.one(vertex, Purpose::Opacity, crossed) >= solid {
                crossed += 1;
                if crossed > MOST_SURFACES {
                    return sum;
                }
                origin = point.inside;
                continue;
            }
            let scatter = Scatter::new(material, &point, textured.as_ref());
            if !is_black(scatter.emitted) {
                let pdf = match last {
                    Last::Density { from, .. } => self.sources.pdf(hit.triangle, &point, from),
                    Last::Single => 0.0,
                };
                sum = sum + weight * scatter.emitted * self.share(&last, pdf);
            }
            if vertex > self.options.max_depth {
                return sum;
            }
            if scatter.has_density() {
                sum = sum + weight * self.direct(&scatter, &point, numbers, vertex);
            }
            let choice = numbers.one(vertex, Purpose::Lobe, 0);
            let Some(bounce) = scatter.sample(choice, numbers.pair(vertex, Purpose::Direction)) else {
                return sum;
            };
            weight = weight * bounce.weight;
            if is_black(weight) {
                return sum;
            }
            if !(weight.r + weight.g + weight.b).is_finite() {
                // No radiance: it is counted as such.
                return weight;
            }
            if vertex >= self.options.roulette_from {
                // By the largest channel: what is left of a path goes on at about the weight 1.
                let survival = weight.r.max(weight.g).max(weight.b);
                if survival < 1.0 {
                    if numbers.one(vertex, Purpose::Roulette, 0) >= survival {
                        return sum;
                    }
                    weight = weight / survival;
                }
            }
            (origin, direction) = (bounce.start, bounce.direction);
            if let Some(pdf) = bounce.pdf {
                last = Last::Density { from: origin, pdf };
                (width, spread) = (0.0, 0.0);
            } else {
                last = Last::Single;
            }
            vertex += 1;
            crossed = 0;
        }
    }

    /// How much a light counts that a ray met by itself, and that would have been looked for with this density.
    fn share(&self, last: &Last, looked_for: f32) -> f32 {
        match (last, self.options.strategy) {
            (Last::Single, _) | (_, Strategy::Lobes) => 1.0,
            (Last::Density { pdf, .. }, Strategy::Both) => mis::power(*pdf, looked_for),
            (Last::Density { .. }, Strategy::Lights) => 0.0,
        }
    }

    /// What comes straight from lights: from one lamp, and from a point of one light that has a size.
    fn direct(&self, scatter: &Scatter<'_>, point: &Point<'_>, numbers: &Numbers, vertex: u32) -> Rgb {
        let mut sum = Rgb::splat(0.0);
        let start = scatter.start();
        if let Some(lamp) = self.sources.towards_lamp(point, start, numbers, vertex) {
            let (f, _) = scatter.eval(lamp.l);
            if !is_black(f) {
                let visible = self.renderer.visible(&self.materials, start, lamp.towards, lamp.distance);
                sum = sum + f * lamp.light * visible;
            }
        }
        if matches!(self.options.strategy, Strategy::Lobes) {
            return sum;
        }
        let materials = &self.materials;
        if let Some(light) = self.sources.towards_extended(self.renderer, materials, start, numbers, vertex) {
            let (f, pdf) = scatter.eval(light.l);
            if !is_black(f) && !is_black(light.light) {
                let share = match self.options.strategy {
                    Strategy::Both => mis::power(light.pdf, pdf),
                    Strategy::Lights | Strategy::Lobes => 1.0,
                };
                let visible = self.renderer.visible(materials, start, light.towards, light.distance);
                sum = sum + f * light.light * (visible * share / light.pdf);
            }
        }
        sum
    }
}
