//! What a surface does with light at one point: up to three lobes, each in its own frame and with its own weight.

use super::lobes::{Lobe, coat};
use crate::gltf_material::{AtPoint, GltfMaterial};
use crate::material::{MappedAt, Material};
use crate::render::{Point, Textured, is_black};
use glam::Vec3;
use lobe::{Frame, Lambert, Rgb};
use lobe_sampling::{Outcome, Sampled};

/// A lobe with its place.
struct Part<'a> {
    lobe: Lobe<'a>,
    frame: Frame,
    /// The viewer, in the frame.
    v: lobe::Vec3,
    tint: Rgb,
    /// Which part of the samples it gets.
    share: f32,
}

impl<'a> Part<'a> {
    fn new(lobe: Lobe<'a>, frame: Frame, point: &Point<'_>, tint: Rgb) -> Option<Self> {
        if is_black(tint) {
            return None;
        }
        let v = frame.to_local(point.v.into());
        let share = lobe.sampler().albedo_guess(v) * tint.luminance();
        Some(Self { lobe, frame, v, tint, share })
    }
}

/// All that is to be known of a point where a path ends or goes on.
pub(crate) struct Scatter<'a> {
    /// What it sends to the viewer by itself.
    pub(crate) emitted: Rgb,
    parts: [Option<Part<'a>>; 3],
    face: Vec3,
    outside: Vec3,
    lifted: Vec3,
}

/// Where a path goes on.
pub(crate) struct Bounce {
    pub(crate) start: Vec3,
    pub(crate) direction: Vec3,
    /// What the radiance from there counts for.
    pub(crate) weight: Rgb,
    /// In sr⁻¹; none for the one direction of a mirror.
    pub(crate) pdf: Option<f32>,
}

/// What a point sends to its viewer by itself: nothing from behind, if the material has one side.
pub(crate) fn emitted(material: &Material, point: &Point<'_>, textured: Option<&Textured>) -> Rgb {
    let Some(at) = textured else { return material.emission };
    if let Some(mapped) = material.mapped() {
        return material.emission * mapped.at(at.uv, at.footprint).emission;
    }
    let Some(gltf) = material.gltf() else { return material.emission };
    let [r, g, b, _] = at.color;
    emitted_gltf(gltf, at, point, &gltf.at(at.uv, at.footprint, Rgb::new(r, g, b)))
}

/// The same of a material of glTF, whose numbers at the point are known.
fn emitted_gltf(gltf: &GltfMaterial, at: &Textured, point: &Point<'_>, found: &AtPoint) -> Rgb {
    if !gltf.factors.double_sided && point.triangle.face.dot(point.v) < 0.0 {
        return Rgb::splat(0.0);
    }
    if gltf.factors.unlit {
        return found.base_color;
    }
    if !gltf.has_coat() || is_black(found.emission) {
        return found.emission;
    }
    let v = at.frame(point, found.coat_normal, None).to_local(point.v.into());
    found.emission * coat(found).transmitted(v)
}

/// Whether a surface of one side is seen from the other.
pub(crate) fn is_behind(material: &Material, point: &Point<'_>) -> bool {
    material.gltf().is_some_and(|gltf| !gltf.factors.double_sided) && point.triangle.face.dot(point.v) < 0.0
}

impl<'a> Scatter<'a> {
    pub(crate) fn new(material: &'a Material, point: &Point<'_>, textured: Option<&Textured>) -> Self {
        let mut scatter = Self {
            emitted: Rgb::splat(0.0),
            parts: [None, None, None],
            face: point.face,
            outside: point.outside,
            lifted: point.shadow_start(),
        };
        let one = Rgb::splat(1.0);
        if let (Some(gltf), Some(at)) = (material.gltf(), textured) {
            let [r, g, b, _] = at.color;
            let found = gltf.at(at.uv, at.footprint, Rgb::new(r, g, b));
            scatter.emitted = emitted_gltf(gltf, at, point, &found);
            if gltf.factors.unlit {
                return scatter;
            }
            let mut below = one;
            if gltf.has_coat() {
                let frame = at.frame(point, found.coat_normal, None);
                below = one * coat(&found).transmitted(frame.to_local(point.v.into()));
                // A picture may take it away at a point.
                if found.coat > 0.0 {
                    scatter.parts[1] = Part::new(Lobe::of_coat(&found), frame, point, one);
                }
            }
            let frame = at.frame(point, found.normal, gltf.is_anisotropic().then_some(found.direction));
            scatter.parts[0] = Part::new(Lobe::of_gltf(gltf, &found), frame, point, below);
            scatter.divide();
            return scatter;
        }
        let mut found = MappedAt::default();
        let mut frame = point.frame;
        scatter.emitted = material.emission;
        if let (Some(mapped), Some(at)) = (material.mapped(), textured) {
            found = mapped.at(at.uv, at.footprint);
            scatter.emitted = material.emission * found.emission;
            frame = at.frame(point, found.normal, None);
            if !is_black(mapped.diffuse.albedo()) {
                let diffuse: Lambert = mapped.diffuse;
                scatter.parts[0] = Part::new(Lobe::Diffuse(diffuse), frame, point, found.diffuse);
            }
            if let Some(highlight) = mapped.highlight.as_ref().and_then(Lobe::of) {
                scatter.parts[1] = Part::new(highlight, frame, point, found.specular);
            }
        } else if let Some(lobes) = Lobe::of(&material.surface) {
            scatter.parts[0] = Part::new(lobes, frame, point, one);
        }
        if !is_black(material.mirror.ks()) {
            scatter.parts[2] = Part::new(Lobe::Mirror(material.mirror), frame, point, found.specular);
        }
        scatter.divide();
        scatter
    }

    /// Makes the shares sum to 1. None is below a tenth of the largest: a guess is no more than that, and what is not sampled
    /// at all is missed.
    fn divide(&mut self) {
        let largest = self.parts.iter().flatten().fold(0.0_f32, |largest, part| largest.max(part.share));
        let mut sum = 0.0;
        for part in self.parts.iter_mut().flatten() {
            // All at 0, or not a number: each the same.
            part.share = if largest > 0.0 && part.share >= 0.1 * largest { part.share } else { 0.1 * largest };
            if part.share <= 0.0 || !part.share.is_finite() {
                part.share = 1.0;
            }
            sum += part.share;
        }
        for part in self.parts.iter_mut().flatten() {
            part.share /= sum;
        }
    }

    /// Whether light is reflected in more than single directions.
    pub(crate) fn has_density(&self) -> bool {
        self.parts.iter().flatten().any(|part| !matches!(part.lobe, Lobe::Mirror(_)))
    }

    /// Where rays start that go to a light or on along a density: on the curved surface that the normals mean.
    pub(crate) fn start(&self) -> Vec3 {
        self.lifted
    }

    /// What part of the irradiance from `l`, of a surface that faces it, is reflected to the viewer, and the density with which
    /// [`sample`](Self::sample) goes there.
    pub(crate) fn eval(&self, l: Vec3) -> (Rgb, f32) {
        self.eval_but(None, l)
    }

    fn eval_but(&self, left_out: Option<usize>, l: Vec3) -> (Rgb, f32) {
        let (mut value, mut pdf) = (Rgb::splat(0.0), 0.0);
        for (at, part) in self.parts.iter().enumerate() {
            let Some(part) = part.as_ref().filter(|_| left_out != Some(at)) else { continue };
            let (f, p) = part.lobe.sampler().eval_cos_pdf(part.frame.to_local(l.into()), part.v);
            value = value + part.tint * f;
            pdf += part.share * p;
        }
        (value, pdf)
    }

    /// A direction: of one lobe, by its share, and weighed with the density of all.
    pub(crate) fn sample(&self, choice: f32, [x, y]: [f32; 2]) -> Option<Bounce> {
        let (at, part, choice) = self.choose(choice)?;
        let sampled: Sampled<f32> = part.lobe.sampler().sample(part.v, [choice, x, y]);
        let world = |l: lobe::Vec3| Vec3::from(part.frame.to_world(l));
        match sampled.outcome() {
            Outcome::Rejected => None,
            Outcome::Delta { l, weight } => {
                // Below the triangle it would go into the body: it is mirrored up.
                let l = world(l);
                let below = l.dot(self.face).min(0.0);
                let direction = (l - self.face * (2.0 * below)).normalize_or(self.face);
                Some(Bounce { start: self.outside, direction, weight: part.tint * weight / part.share, pdf: None })
            }
            Outcome::Scattered { l, weight, pdf } => {
                let direction = world(l).normalize_or(self.face);
                let own = part.share * pdf;
                let (others, others_pdf) = self.eval_but(Some(at), direction);
                let pdf = own + others_pdf;
                // By quotients of densities: a product with a sharp one could leave the range.
                let weight = part.tint * weight / part.share * (own / pdf) + others / pdf;
                Some(Bounce { start: self.lifted, direction, weight, pdf: Some(pdf) })
            }
        }
    }

    /// A lobe for a number of `[0, 1)`, and that number stretched over its share.
    fn choose(&self, choice: f32) -> Option<(usize, &Part<'a>, f32)> {
        let mut rest = choice;
        let mut last = None;
        for (at, part) in self.parts.iter().enumerate() {
            let Some(part) = part else { continue };
            last = Some((at, part, (rest / part.share).clamp(0.0, BELOW_ONE)));
            if rest < part.share {
                break;
            }
            rest -= part.share;
        }
        last
    }
}

/// The last number before 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
