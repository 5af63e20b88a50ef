//! What a viewer sees: a sphere under three lights.

use lobe::{Frame, Rgb, Vec3};
use palette::{FromColor as _, IntoColor as _, Lab, LinSrgb, Srgb, white_point::D65};

/// By how much two pictures differ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// The mean of ΔE 2000.
    pub mean: f64,
    /// The largest ΔE 2000.
    pub worst: f64,
    /// The largest difference of a channel of sRGB, in steps of eight bits.
    pub steps: u8,
}

/// The pixels that show the sphere, each with its three lights, in the frame of the surface.
pub(crate) struct Sphere {
    /// All pixels for the first light, then all for the second.
    pub(crate) l: [Vec<f32>; 3],
    pub(crate) v: [Vec<f32>; 3],
    pub(crate) irradiance: Vec<f32>,
}

/// Above on the left, from the right, and from behind, where lobes are met at grazing angles; with their irradiances.
const LIGHTS: [([f32; 3], f32); 3] =
    [([-0.48, 0.6, 0.64], 1.0), ([0.8, -0.1, 0.591_608], 0.4), ([0.5, 0.5, -std::f32::consts::FRAC_1_SQRT_2], 0.8)];

impl Sphere {
    /// A sphere of `size` by `size` pixels, seen from far away.
    pub(crate) fn new(size: u32) -> Self {
        let mut normals = Vec::new();
        for (x, y) in (0..size).flat_map(|y| (0..size).map(move |x| (x, y))) {
            let at = |i: u32| (i as f32 + 0.5) / size as f32 * 2.0 - 1.0;
            let (x, y) = (at(x), -at(y));
            let z2 = 1.0 - x * x - y * y;
            if z2 > 0.0 {
                normals.push(Vec3::new(x, y, z2.sqrt()).normalize());
            }
        }
        let mut sphere = Self { l: Default::default(), v: Default::default(), irradiance: Vec::new() };
        let push =
            |to: &mut [Vec<f32>; 3], w: Vec3| to.iter_mut().zip(<[f32; 3]>::from(w)).for_each(|(to, c)| to.push(c));
        for ([x, y, z], irradiance) in LIGHTS {
            for &n in &normals {
                let frame = Frame::from_normal(n);
                push(&mut sphere.l, frame.to_local(Vec3::new(x, y, z)));
                push(&mut sphere.v, frame.to_local(Vec3::new(0.0, 0.0, 1.0)));
                sphere.irradiance.push(irradiance);
            }
        }
        sphere
    }
}

/// The picture of a sphere from `eval_cos` of its points.
pub(crate) fn picture(sphere: &Sphere, values: &[[f64; 3]]) -> Vec<Rgb<f64>> {
    let count = values.len() / LIGHTS.len();
    let of = |i: usize| {
        let parts = (0..LIGHTS.len()).map(|k| (values[k * count + i], f64::from(sphere.irradiance[k * count + i])));
        parts.fold(Rgb::splat(0.0), |sum, ([r, g, b], e)| sum + Rgb::new(r, g, b) * e)
    };
    (0..count).map(of).collect()
}

/// What the picture is multiplied with: the brightest percent of the pixels becomes white.
pub(crate) fn exposure(picture: &[Rgb<f64>]) -> f64 {
    let mut largest: Vec<f64> = picture.iter().map(|c| c.r.max(c.g).max(c.b)).filter(|x| x.is_finite()).collect();
    largest.sort_by(f64::total_cmp);
    match largest.get(largest.len() * 99 / 100) {
        Some(&x) if x > 0.0 => 1.0 / x,
        _ => 1.0,
    }
}

/// The difference of two pictures at one exposure.
pub(crate) fn compare(a: &[Rgb<f64>], b: &[Rgb<f64>], exposure: f64) -> Seen {
    let colour = |c: Rgb<f64>| {
        let shown = |x: f64| (x * exposure).clamp(0.0, 1.0);
        LinSrgb::new(shown(c.r), shown(c.g), shown(c.b))
    };
    let (mut seen, mut sum) = (Seen::default(), 0.0);
    for (&a, &b) in a.iter().zip(b) {
        let (a, b) = (colour(a), colour(b));
        // Most pixels are alike, and their difference is 0.
        if a == b {
            continue;
        }
        let (delta, steps) = colour_difference(a, b);
        sum += delta;
        seen.worst = seen.worst.max(delta);
        seen.steps = seen.steps.max(steps);
    }
    seen.mean = sum / a.len().max(1) as f64;
    seen
}

/// CIE ΔE 2000 of two linear colours from 0 to 1, and the largest difference of a channel of sRGB in steps of eight bits.
#[must_use]
pub fn delta_e(a: [f64; 3], b: [f64; 3]) -> (f64, u8) {
    if a == b {
        return (0.0, 0);
    }
    colour_difference(LinSrgb::from(a), LinSrgb::from(b))
}

fn colour_difference(a: LinSrgb<f64>, b: LinSrgb<f64>) -> (f64, u8) {
    let lab = |c: LinSrgb<f64>| -> Lab<D65, f64> { c.into_color() };
    let eight = |c: LinSrgb<f64>| -> Srgb<u8> { Srgb::from_color(c).into_format() };
    let delta = difference(lab(a), lab(b));
    let (a, b) = (eight(a), eight(b));
    (delta, a.red.abs_diff(b.red).max(a.green.abs_diff(b.green)).max(a.blue.abs_diff(b.blue)))
}

fn difference(a: Lab<D65, f64>, b: Lab<D65, f64>) -> f64 {
    use palette::color_difference::Ciede2000 as _;
    a.difference(b)
}
