//! Polar plots: the lobes in the plane of incidence, as distances from the point that is lit, and the distribution of
//! the facets' normals.

use super::chart::Scale;
use super::svg::{Anchor, Point, Svg, label};
use super::terms::Cut;
use super::{Series, Setting, legend, line_class, peak, profile, short_name};

const WIDTH: f64 = 600.0;
const CENTRE: Point = (300.0, 312.0);
const RADIUS: f64 = 248.0;
/// Decades of a logarithmic radius below that of the peak.
const DECADES: i32 = 4;

/// Draws `series`, all to one scale.
pub(crate) fn polar(series: &[Series<'_>], setting: Setting) -> Svg {
    let profiles: Vec<_> = series.iter().map(|one| profile(one, setting)).collect();
    let largest = peak(&profiles);
    let title = format!("Lobes in the plane of incidence, light at {}°", label(setting.incidence));
    let mut svg = paper(&title, series.len());
    let scale = scale(largest, setting.log);
    grid(&mut svg, scale, setting.quantity());
    lobes(&mut svg, scale, &profiles);
    directions(&mut svg, setting.incidence);
    for (index, (one, curve)) in series.iter().zip(&profiles).enumerate() {
        let peak = label(peak(std::slice::from_ref(curve)));
        legend(&mut svg, index, LEGEND, &format!("{}  (peak {peak})", short_name(&one.name, 46)));
    }
    svg
}

/// Draws `D(θ_h)` on both sides of the normal, each to its own peak, as Ashikhmin, Premože and Shirley draw their
/// `p(h)`: that is `D` over its integral, and so the same curve.
pub(crate) fn distribution(cuts: &[Cut], log: bool) -> Svg {
    let profiles: Vec<Vec<(f64, f64)>> = cuts
        .iter()
        .map(|cut| {
            let largest = cut.peak();
            let scale = if largest > 0.0 { largest.recip() } else { 0.0 };
            let side = cut.d.iter().map(|&(theta, d)| (theta, d * scale));
            side.clone().rev().map(|(theta, d)| (-theta, d)).chain(side).collect()
        })
        .collect();
    let mut svg = paper("Distribution of the facets' normals", cuts.len());
    let scale = scale(1.0, log);
    grid(&mut svg, scale, "*D*(*θ*_{h}) / max *D*");
    lobes(&mut svg, scale, &profiles);
    svg.line("thin", CENTRE, at(0.0, RADIUS + 2.0));
    svg.math("", (CENTRE.0, CENTRE.1 - RADIUS - 27.0), Anchor::Middle, "*n*");
    for (index, cut) in cuts.iter().enumerate() {
        let text = format!("{}  (max D = {} sr⁻¹)", short_name(&cut.name, 40), label(cut.peak()));
        legend(&mut svg, index, LEGEND, &text);
    }
    svg
}

/// Where the legend begins.
const LEGEND: Point = (40.0, CENTRE.1 + 74.0);

fn paper(title: &str, rows: usize) -> Svg {
    Svg::new(WIDTH, LEGEND.1 + 10.0 + 22.0 * rows as f64, title)
}

fn scale(largest: f64, log: bool) -> Scale {
    if log { Scale::below(largest, DECADES) } else { Scale::linear(largest) }
}

/// The surface, the rings with their values, and the angles.
fn grid(svg: &mut Svg, scale: Scale, quantity: &str) {
    svg.rectangle("ground", (CENTRE.0 - RADIUS - 26.0, CENTRE.1), 2.0 * RADIUS + 52.0, 7.0);
    for (part, text) in scale.ticks().into_iter().skip(1) {
        svg.path("grid", &arc(part * RADIUS), false);
        for side in [-1.0, 1.0] {
            let at = (CENTRE.0 + side * part * RADIUS, CENTRE.1 + 24.0);
            svg.line("axis", (at.0, CENTRE.1), (at.0, CENTRE.1 + 7.0));
            svg.math("soft", at, Anchor::Middle, &text);
        }
    }
    let foot = match scale.ticks().first() {
        Some((_, foot)) if matches!(scale, Scale::Log { .. }) => format!("{quantity}, from {foot} in the middle"),
        _ => quantity.to_owned(),
    };
    svg.math("soft", (CENTRE.0, CENTRE.1 + 45.0), Anchor::Middle, &foot);
    for tick in -6..=6_i32 {
        let angle = f64::from(tick) * 15.0;
        let inner = if tick % 2 == 0 { 0.0 } else { RADIUS - 8.0 };
        svg.line("grid", at(angle, inner), at(angle, RADIUS));
        if tick % 2 == 0 && tick.abs() < 6 {
            let (x, y) = at(angle, RADIUS + 13.0);
            svg.text("soft", (x, y + 4.0), Anchor::Middle, &format!("{}°", angle.abs()));
        }
    }
}

/// The curves, closed through the middle, and the surface over their feet.
fn lobes(svg: &mut Svg, scale: Scale, profiles: &[Vec<(f64, f64)>]) {
    for (index, curve) in profiles.iter().enumerate() {
        let points: Vec<Point> = std::iter::once(CENTRE)
            .chain(curve.iter().map(|&(theta, value)| at(theta.to_degrees(), scale.part(value) * RADIUS)))
            .collect();
        svg.path(&format!("f{} fill", index % super::svg::SERIES), &points, true);
        svg.path(&line_class(index), &points, true);
    }
    svg.line("ink", (CENTRE.0 - RADIUS - 26.0, CENTRE.1), (CENTRE.0 + RADIUS + 26.0, CENTRE.1));
}

/// The normal, the light as it arrives, and the way a mirror would send it.
fn directions(svg: &mut Svg, incidence: f64) {
    svg.line("thin", CENTRE, at(0.0, RADIUS + 2.0));
    svg.math("", (CENTRE.0, CENTRE.1 - RADIUS - 27.0), Anchor::Middle, "*n*");
    svg.arrow(at(-incidence, RADIUS * 0.98), at(-incidence, RADIUS * 0.55));
    svg.line("ray", at(-incidence, RADIUS * 0.55), CENTRE);
    svg.line("thin", CENTRE, at(incidence, RADIUS * 0.86));
    svg.arrow(at(incidence, RADIUS * 0.86), at(incidence, RADIUS * 0.98));
    // Beyond the labels of the angles, which stand at 13, and beside that of the normal.
    let (x, y) = at(-incidence, RADIUS + 34.0);
    svg.math("", (x.clamp(26.0, CENTRE.0 - 40.0), (y + 4.0).min(CENTRE.1 - 6.0)), Anchor::Middle, "light *l*");
    let (x, y) = at(incidence, RADIUS + 34.0);
    svg.math("", (x.clamp(CENTRE.0 + 46.0, WIDTH - 30.0), (y + 4.0).min(CENTRE.1 - 6.0)), Anchor::Middle, "mirror *r*");
}

/// The point at an angle from the normal, in degrees, positive to the right.
fn at(degrees: f64, radius: f64) -> Point {
    let (sin, cos) = degrees.to_radians().sin_cos();
    (CENTRE.0 + radius * sin, CENTRE.1 - radius * cos)
}

fn arc(radius: f64) -> Vec<Point> {
    (-45..=45).map(|i| at(f64::from(i) * 2.0, radius)).collect()
}
