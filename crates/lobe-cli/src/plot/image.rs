//! The image slice: a whole isotropic BRDF at a glance, as BRDF Explorer shows it.
//!
//! Burley, *Physically Based Shading at Disney*, 2012, section 3: the angle of the halfway vector to the right, that between it
//! and the light upwards, both directions across the plane of the halfway vector. The highlight is at the left edge, Fresnel's
//! grazing light at the top, light sent back to where it came from at the bottom.

use super::svg::{Anchor, Svg};
use super::{Series, Setting, short_name};
use lobe::Vec3;
use lobe_scene::Image;
use lobe_scene::image::Display;

/// Pixels a side: half a degree each.
const SIDE: u32 = 180;
const LEFT: f64 = 70.0;
const TOP: f64 = 30.0;
/// The side on the page.
const WIDTH: f64 = 420.0;
/// How many decades a logarithmic one has, down from [`WHITE`].
const DECADES: f64 = 5.0;
/// What white stands for on a logarithmic scale, in sr⁻¹; on a linear one it is 1.
const WHITE: f64 = 100.0;

/// Draws one BRDF.
pub(crate) fn image(one: &Series<'_>, setting: Setting) -> Result<Svg, lobe_scene::Error> {
    let png = slice(one, setting)?.to_png(&Display::default())?;
    let (right, bottom) = (LEFT + WIDTH, TOP + WIDTH);
    let mut svg = Svg::new(right + 30.0, bottom + 92.0, &format!("Image slice of {}", one.name));
    svg.image((LEFT, TOP), WIDTH, WIDTH, &png);
    svg.path("axis", &[(LEFT, TOP), (LEFT, bottom), (right, bottom), (right, TOP)], true);
    for angle in (0..=90).step_by(30) {
        let part = f64::from(angle) / 90.0 * WIDTH;
        svg.line("axis", (LEFT + part, bottom), (LEFT + part, bottom + 5.0));
        svg.line("axis", (LEFT - 5.0, bottom - part), (LEFT, bottom - part));
        let text = format!("{angle}°");
        svg.text("soft", (LEFT + part, bottom + 20.0), Anchor::Middle, &text);
        svg.text("soft", (LEFT - 10.0, bottom - part + 5.0), Anchor::End, &text);
    }
    svg.math(
        "soft",
        (LEFT + WIDTH / 2.0, bottom + 38.0),
        Anchor::Middle,
        "*θ*_{h}, between the normal and the halfway vector",
    );
    svg.math("soft", (4.0, TOP - 12.0), Anchor::Start, "*θ*_{d}, between the halfway vector and the light");
    let white = match setting.log {
        true => format!("black to white: {DECADES} decades, up to {WHITE} sr⁻¹"),
        false => "white: 1 sr⁻¹ or more".to_owned(),
    };
    svg.text("", (LEFT, bottom + 62.0), Anchor::Start, &short_name(&one.name, 48));
    svg.text("soft", (LEFT, bottom + 84.0), Anchor::Start, &white);
    Ok(svg)
}

/// The picture inside the axes.
fn slice(one: &Series<'_>, setting: Setting) -> Result<Image, lobe_scene::Error> {
    let mut picture = Image::new(SIDE, SIDE)?;
    let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    for (pixel, (x, y)) in picture.pixels_mut().iter_mut().zip(places) {
        let angle = |at: u32| (f64::from(at) + 0.5) / f64::from(SIDE) * std::f64::consts::FRAC_PI_2;
        *pixel = colour(one, setting, angle(x), angle(SIDE - 1 - y));
    }
    Ok(picture)
}

/// Light and viewer of a place, to both sides of the plane of normal and halfway vector: φ_d = 90°.
fn directions(theta_h: f64, theta_d: f64) -> [Vec3<f64>; 2] {
    let ((sin_h, cos_h), (sin_d, cos_d)) = (theta_h.sin_cos(), theta_d.sin_cos());
    [sin_d, -sin_d].map(|across| Vec3::new(cos_d * sin_h, across, cos_d * cos_h))
}

/// The linear colour of a place.
fn colour(one: &Series<'_>, setting: Setting, theta_h: f64, theta_d: f64) -> [f32; 3] {
    let [l, v] = directions(theta_h, theta_d);
    let f = match setting.cosine {
        true => one.brdf.eval_cos(l, v),
        false => one.brdf.eval(l, v),
    };
    <[f64; 3]>::from(f).map(|f| {
        let shown = match setting.log {
            // The logarithm of 0 is −∞, and black.
            true => 1.0 + (f / WHITE).log10() / DECADES,
            false => f,
        };
        let shown = shown.clamp(0.0, 1.0) as f32;
        // A scale is read off evenly; a colour goes through the curve of the display.
        if setting.log { lobe_scene::image::linear(shown) } else { shown }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe::{Brdf, Lambert, Rgb};

    #[test]
    fn the_halfway_vector_is_to_the_right_and_grazing_light_at_the_top() -> Result<(), lobe_scene::Error> {
        for (theta_h, theta_d) in [(0.01, 0.6), (0.7, 0.3), (0.2, 1.4), (1.5, 1.5)] {
            let [l, v] = directions(theta_h, theta_d);
            let h = (l + v).normalize();
            assert!((h.z - theta_h.cos()).abs() < 1e-12, "{h:?}");
            assert!(
                (l.dot(h) - theta_d.cos()).abs() < 1e-12 && (v.dot(h) - theta_d.cos()).abs() < 1e-12,
                "{l:?} {v:?}"
            );
        }
        /// White where the light is within half a right angle of the halfway vector.
        struct Near;
        impl Brdf<f64> for Near {
            fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
                Rgb::splat(if l.dot((l + v).normalize()) > 0.5_f64.sqrt() { 1.0 } else { 0.0 })
            }
        }
        let one = Series { name: "near".to_owned(), brdf: &Near };
        let picture = slice(&one, Setting { incidence: 0.0, cosine: false, log: false })?;
        let row = |y: u32| &picture.pixels()[(y * SIDE) as usize..((y + 1) * SIDE) as usize];
        assert!((0..SIDE / 2).all(|y| row(y).iter().all(|&pixel| pixel == [0.0; 3])));
        assert!((SIDE / 2..SIDE).all(|y| row(y).iter().all(|&pixel| pixel == [1.0; 3])));
        Ok(())
    }

    #[test]
    fn lambert_is_one_colour_and_scales_are_what_they_say() {
        let lambert = Lambert::new(Rgb::new(0.5_f64, 0.25, 0.0));
        let one = Series { name: "lambert".to_owned(), brdf: &lambert };
        let setting = Setting { incidence: 0.0, cosine: false, log: false };
        let expected = [0.5, 0.25, 0.0].map(|albedo| albedo / std::f32::consts::PI);
        for (theta_h, theta_d) in [(0.01, 0.01), (0.7, 0.3), (0.2, 1.4)] {
            let found = colour(&one, setting, theta_h, theta_d);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?}");
        }
        // Two and a half decades below 100 are half of the scale.
        let bright = Lambert::new(Rgb::splat(10.0_f64.powf(-0.5) * std::f64::consts::PI));
        let one = Series { name: "bright".to_owned(), brdf: &bright };
        let [half, ..] = colour(&one, Setting { log: true, ..setting }, 0.1, 0.1);
        assert!((lobe_scene::image::srgb(half) - 0.5).abs() < 1e-5, "{half}");
        // Nothing at all is black, on either scale.
        let black = Lambert::new(Rgb::splat(0.0));
        let one = Series { name: "black".to_owned(), brdf: &black };
        for log in [false, true] {
            assert_eq!(colour(&one, Setting { log, ..setting }, 0.1, 0.1), [0.0; 3]);
        }
    }
}
