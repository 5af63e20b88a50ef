//! Directions of light that a BRDF draws, over what it reflects: a sampler that misses something is seen at once.

use super::svg::Svg;
use crate::error::Failure;
use lobe::Vec3;
use lobe_models::Material;
use lobe_sampling::{Outcome, Sample};
use lobe_scene::Image;
use lobe_scene::image::{Display, linear};
use lobe_verify::sampling::{Points, view};
use lobe_verify::subject::Precision;
use std::f64::consts::TAU;

/// The directions in a picture.
pub(crate) const SHOWN: usize = 400;
/// The decades of the colours.
pub(crate) const DECADES: f64 = 4.0;
/// The pixels of the colours, to both sides.
const SIDE: u32 = 64;
/// The picture, to both sides, and the radius of the hemisphere in it.
const WIDTH: f64 = 240.0;
const RADIUS: f64 = 112.0;

/// The picture of a BRDF, for a viewer at this angle in degrees.
pub(crate) fn of(material: &Material, degrees: f64) -> Result<Svg, Failure> {
    let sampler = material.sampler::<f32>();
    let [x, y, z] = view(degrees.to_radians().cos(), 0.0).map(|x| x as f32);
    let v = Vec3::new(x, y, z);
    let points = Points::random(&material.name).take(Precision::Single, SHOWN);
    let shown: Vec<_> = points
        .filter_map(|u| match sampler.sample(v, u.map(|u| u as f32)).outcome() {
            Outcome::Scattered { l, .. } => Some((f64::from(l.x), f64::from(l.y))),
            Outcome::Delta { .. } | Outcome::Rejected => None,
        })
        .collect();
    let title = format!(
        "{} of {SHOWN} directions of light drawn from {} for a viewer at {degrees}°, over what it reflects from there",
        shown.len(),
        material.name
    );
    let nothing = || Failure::Usage(format!("{} reflects nothing that could be drawn", material.name));
    samples(&*sampler, v, &shown, &title).ok_or_else(nothing)
}

/// The hemisphere seen from above, the viewer to the right: `eval_cos` in colours, the directions that were drawn as dots.
pub(crate) fn samples(sampler: &dyn Sample<f32>, v: Vec3<f32>, shown: &[(f64, f64)], title: &str) -> Option<Svg> {
    let value = |x: f64, y: f64| {
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        f64::from(sampler.eval_cos_pdf(Vec3::new(x, y, z).map(|x| x as f32), v).0.luminance())
    };
    let place = |at: u32| (2.0 * f64::from(at) + 1.0) / f64::from(SIDE) - 1.0;
    let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    let values: Vec<f64> = places
        .map(|(x, y)| {
            let (x, y) = (place(x), -place(y));
            // Outside of the hemisphere, where nothing is seen of it, as at its edge.
            let out = x.hypot(y).max(1.0) * (1.0 + 1e-6);
            value(x / out, y / out)
        })
        .collect();
    let peak = values.iter().copied().chain(shown.iter().map(|&(x, y)| value(x, y))).fold(0.0, f64::max);
    let mut image = Image::new(SIDE, SIDE).ok()?;
    for (pixel, value) in image.pixels_mut().iter_mut().zip(&values) {
        *pixel = colour(1.0 + (value / peak).log10() / DECADES);
    }
    let png = image.to_png(&Display::default()).ok()?;

    let middle = WIDTH / 2.0;
    let at = |(x, y): (f64, f64)| (middle + RADIUS * x, middle - RADIUS * y);
    let mut svg = Svg::new(WIDTH, WIDTH, title);
    svg.image((middle - RADIUS, middle - RADIUS), 2.0 * RADIUS, 2.0 * RADIUS, &png);
    let rim: Vec<_> = (0..=120).map(|step| at((TAU * f64::from(step) / 120.0).sin_cos())).collect();
    // What is outside of the circle: around it one way, around the square the other.
    let (low, high) = (0.0, WIDTH);
    let square = [(middle, low), (low, low), (low, high), (high, high), (high, low), (middle, low)];
    svg.path("paper", &[&rim[..], &square[..]].concat(), true);
    svg.path("axis", &rim, true);
    svg.dots("drawn", &shown.iter().copied().map(at).collect::<Vec<_>>());
    let viewer = at((f64::from(v.x), f64::from(v.y)));
    svg.dot("paper", viewer, 4.5);
    svg.dot("tip", viewer, 3.0);
    Some(svg)
}

/// From dark blue to nearly white, for a part of the scale.
fn colour(part: f64) -> [f32; 3] {
    const STOPS: [[f64; 3]; 4] = [[0.05, 0.09, 0.22], [0.12, 0.29, 0.53], [0.42, 0.68, 0.84], [0.94, 0.97, 1.0]];
    // The logarithm of 0 is −∞, and of what is no number there is no part.
    let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
    let place = part * (STOPS.len() - 1) as f64;
    let from = (place as usize).min(STOPS.len() - 2);
    let rest = place - from as f64;
    std::array::from_fn(|i| linear((STOPS[from][i] + rest * (STOPS[from + 1][i] - STOPS[from][i])) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_as_dark_as_nothing() {
        assert!(colour(f64::NEG_INFINITY) == colour(f64::NAN) && colour(0.0) != colour(1.0));
    }
}
