//! The lobes in the plane of incidence, as distances from the point that is lit.

use super::svg::{Anchor, Point, Svg, label, nice_step};
use super::{Series, Setting, peak, profile, short_name};

const WIDTH: f64 = 600.0;
const CENTRE: Point = (300.0, 312.0);
const RADIUS: f64 = 248.0;

/// Draws `series`, all to one scale.
pub(crate) fn polar(series: &[Series<'_>], setting: Setting) -> Svg {
    let profiles: Vec<_> = series.iter().map(|one| profile(one, setting)).collect();
    let largest = peak(&profiles);
    let step = nice_step(if largest > 0.0 { largest } else { 1.0 }, 4.0);
    // The outermost ring is the first that holds everything.
    let rings = (largest / step).ceil().clamp(1.0, 10.0);
    let scale = RADIUS / (rings * step);
    let height = CENTRE.1 + 62.0 + 22.0 * series.len() as f64;
    let title = format!("Lobes in the plane of incidence, light at {}°", label(setting.incidence));
    let mut svg = Svg::new(WIDTH, height, &title);

    svg.rectangle("ground", (CENTRE.0 - RADIUS - 26.0, CENTRE.1), 2.0 * RADIUS + 52.0, 7.0);
    for ring in 1..=rings as u32 {
        let value = f64::from(ring) * step;
        svg.path("grid", &arc(value * scale), false);
        for side in [-1.0, 1.0] {
            let at = (CENTRE.0 + side * value * scale, CENTRE.1 + 22.0);
            svg.line("axis", (at.0, CENTRE.1), (at.0, CENTRE.1 + 7.0));
            svg.text("soft", at, Anchor::Middle, &label(value));
        }
    }
    svg.math("soft", (CENTRE.0, CENTRE.1 + 22.0), Anchor::Middle, setting.quantity());
    for tick in -6..=6_i32 {
        let angle = f64::from(tick) * 15.0;
        let inner = if tick % 2 == 0 { 0.0 } else { RADIUS - 8.0 };
        svg.line("grid", at(angle, inner), at(angle, RADIUS));
        if tick % 2 == 0 && tick.abs() < 6 {
            let (x, y) = at(angle, RADIUS + 13.0);
            svg.text("soft", (x, y + 4.0), Anchor::Middle, &format!("{}°", angle.abs()));
        }
    }

    for (index, curve) in profiles.iter().enumerate() {
        let points: Vec<Point> = std::iter::once(CENTRE)
            .chain(curve.iter().map(|&(theta, value)| at(theta.to_degrees(), value * scale)))
            .collect();
        let class = index % super::svg::SERIES;
        svg.path(&format!("f{class} fill"), &points, true);
        svg.path(&format!("c{class}"), &points, true);
    }
    svg.line("ink", (CENTRE.0 - RADIUS - 26.0, CENTRE.1), (CENTRE.0 + RADIUS + 26.0, CENTRE.1));
    directions(&mut svg, setting.incidence);

    for (index, (one, curve)) in series.iter().zip(&profiles).enumerate() {
        let y = CENTRE.1 + 52.0 + 22.0 * index as f64;
        svg.line(&format!("c{}", index % super::svg::SERIES), (40.0, y - 5.0), (76.0, y - 5.0));
        let peak = label(peak(std::slice::from_ref(curve)));
        svg.text("", (86.0, y), Anchor::Start, &format!("{}  (peak {peak})", short_name(&one.name, 50)));
    }
    svg
}

/// The normal, the light as it arrives, and the way a mirror would send it.
fn directions(svg: &mut Svg, incidence: f64) {
    svg.line("thin", CENTRE, at(0.0, RADIUS + 2.0));
    svg.math("", (CENTRE.0 + 5.0, CENTRE.1 - RADIUS - 27.0), Anchor::Start, "*n*");
    svg.arrow(at(-incidence, RADIUS * 0.98), at(-incidence, RADIUS * 0.55));
    svg.line("ray", at(-incidence, RADIUS * 0.55), CENTRE);
    svg.line("thin", CENTRE, at(incidence, RADIUS * 0.86));
    svg.arrow(at(incidence, RADIUS * 0.86), at(incidence, RADIUS * 0.98));
    // Beyond the labels of the angles, which stand at 13.
    let (x, y) = at(-incidence, RADIUS + 34.0);
    svg.math("", (x.max(26.0), (y + 4.0).min(CENTRE.1 - 6.0)), Anchor::Middle, "light *l*");
    let (x, y) = at(incidence, RADIUS + 34.0);
    svg.math("", (x.min(WIDTH - 30.0), (y + 4.0).min(CENTRE.1 - 6.0)), Anchor::Middle, "mirror *r*");
}

/// The point at an angle from the normal, in degrees, positive to the right.
fn at(degrees: f64, radius: f64) -> Point {
    let (sin, cos) = degrees.to_radians().sin_cos();
    (CENTRE.0 + radius * sin, CENTRE.1 - radius * cos)
}

fn arc(radius: f64) -> Vec<Point> {
    (-45..=45).map(|i| at(f64::from(i) * 2.0, radius)).collect()
}
