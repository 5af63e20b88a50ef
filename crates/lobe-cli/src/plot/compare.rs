//! The lecture's comparison: the mirror lobe `(v·r)^q` against the half-vector lobe `(n·h)^q`.
//!
//! In the plane of incidence the angle between `n` and `h` is half of that between `r` and `v`, so `(n·h)^q` is about
//! twice as wide, and `(n·h)^(4q)` about as wide as `(v·r)^q`. Out of the plane no exponent makes them equal: towards
//! grazing light the half-vector lobe becomes a narrow upright streak, as seen on wet roads, while the mirror lobe
//! stays round. So each panel shows both: the lobes in the plane, and the outline at half of the maximum around the
//! mirror direction.

use super::direction;
use super::svg::{Anchor, Point, Svg, label};
use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::{Brdf, Rgb, Shininess, Vec3};
use std::f64::consts::PI;

const PANEL: f64 = 460.0;
const RADIUS: f64 = 186.0;
const HEIGHT: f64 = 586.0;
/// The second incidence: where the two differ most.
const GRAZING: f64 = 85.0;

/// Two panels, side by side: the incidence that is asked for, and grazing light.
pub(crate) fn compare(q: f64, incidence: f64) -> Svg {
    let title = format!("Mirror lobe against half-vector lobe, q = {}, light at {incidence}° and {GRAZING}°", label(q));
    let mut svg = Svg::new(2.0 * PANEL, HEIGHT, &title);
    draw(&mut svg, 0.0, q, incidence);
    draw(&mut svg, PANEL, q, GRAZING);
    svg
}

/// One of the panels alone.
pub(crate) fn compare_panel(q: f64, incidence: f64) -> Svg {
    let title = format!("Mirror lobe against half-vector lobe, q = {}, light at {incidence}°", label(q));
    let mut svg = Svg::new(PANEL, HEIGHT, &title);
    draw(&mut svg, 0.0, q, incidence);
    svg
}

/// A lobe with a maximum of 1.
struct Shape {
    name: String,
    value: Box<dyn Fn(Vec3<f64>) -> f64>,
}

fn shapes(q: f64, l: Vec3<f64>) -> [Shape; 3] {
    // The lecture's highlights are `power/π` with the cosine.
    let mirror = PhongHighlight::new(Rgb::splat(PI), Shininess(q));
    let half = |q: f64| BlinnTorranceHighlight::new(Rgb::splat(PI), Shininess(q));
    let (same, matched) = (half(q), half(4.0 * q));
    [
        Shape {
            name: format!("(*v*·*r*)^{{*q*}}   mirror lobe, *q* = {}", label(q)),
            value: Box::new(move |v| mirror.eval_cos(l, v).g),
        },
        Shape {
            name: format!("(*n*·*h*)^{{*q*}}   half-vector lobe, *q* = {}", label(q)),
            value: Box::new(move |v| same.eval_cos(l, v).g),
        },
        Shape {
            name: format!("(*n*·*h*)^{{4*q*}}  half-vector lobe, 4*q* = {}", label(4.0 * q)),
            value: Box::new(move |v| matched.eval_cos(l, v).g),
        },
    ]
}

/// The mirror lobe is broad and pale, so that the matched lobe, which falls on it, is seen too.
fn line_class(index: usize) -> &'static str {
    match index {
        0 => "c0 wide",
        1 => "c1",
        _ => "c2",
    }
}

fn draw(svg: &mut Svg, left: f64, q: f64, incidence: f64) {
    let l = direction(-incidence.to_radians());
    let shapes = shapes(q, l);
    let centre = (left + PANEL / 2.0, 252.0);
    svg.text("head", (centre.0, 24.0), Anchor::Middle, &format!("Light at {}°", label(incidence)));
    in_the_plane(svg, centre, &shapes, incidence);
    outlines(svg, (left + PANEL / 2.0, 410.0), &shapes, incidence);
    for (index, shape) in shapes.iter().enumerate() {
        let y = HEIGHT - 52.0 + 21.0 * index as f64;
        svg.line(line_class(index), (left + 64.0, y - 5.0), (left + 104.0, y - 5.0));
        svg.math("", (left + 116.0, y), Anchor::Start, &shape.name);
    }
}

/// The lobes in the plane of incidence, as distances from the point.
fn in_the_plane(svg: &mut Svg, centre: Point, shapes: &[Shape], incidence: f64) {
    let at = |degrees: f64, radius: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        (centre.0 + radius * sin, centre.1 - radius * cos)
    };
    let edge = RADIUS + 14.0;
    svg.rectangle("ground", (centre.0 - edge, centre.1), 2.0 * edge, 6.0);
    for ring in [0.25, 0.5, 0.75, 1.0] {
        let arc: Vec<Point> = (-45..=45).map(|i| at(f64::from(i) * 2.0, ring * RADIUS)).collect();
        svg.path("grid", &arc, false);
        if ring == 0.5 || ring == 1.0 {
            svg.text("soft", (centre.0 - ring * RADIUS, centre.1 + 20.0), Anchor::Middle, &label(ring));
            svg.text("soft", (centre.0 + ring * RADIUS, centre.1 + 20.0), Anchor::Middle, &label(ring));
        }
    }
    for tick in -2..=2 {
        let angle = f64::from(tick) * 30.0;
        svg.line("grid", centre, at(angle, RADIUS));
        let (x, y) = at(angle, RADIUS + 12.0);
        svg.text("soft", (x, y + 4.0), Anchor::Middle, &format!("{}°", angle.abs()));
    }
    svg.line("thin", centre, at(0.0, RADIUS));
    for (index, shape) in shapes.iter().enumerate() {
        let mirror = incidence.to_radians();
        let near = (-200..=200).map(|i| mirror + f64::from(i) * 0.0005);
        let mut angles: Vec<f64> = (-899..=899).map(|i| (f64::from(i) * 0.1).to_radians()).chain(near).collect();
        angles.retain(|angle| angle.to_degrees().abs() <= 89.9);
        angles.sort_by(f64::total_cmp);
        let lobe = angles.into_iter().map(|angle| at(angle.to_degrees(), (shape.value)(direction(angle)) * RADIUS));
        let points: Vec<Point> = std::iter::once(centre).chain(lobe).collect();
        svg.path(&format!("f{index} fill"), &points, true);
        svg.path(line_class(index), &points, true);
    }
    svg.line("ink", (centre.0 - edge, centre.1), (centre.0 + edge, centre.1));
    svg.line("ray", at(-incidence, RADIUS * 0.5), centre);
    svg.arrow(at(-incidence, RADIUS * 0.98), at(-incidence, RADIUS * 0.5));
    svg.line("thin", centre, at(incidence, RADIUS));
    let (x, y) = at(-incidence, RADIUS + 18.0);
    svg.math("", (x - 6.0, (y - 2.0).min(centre.1 - 22.0)), Anchor::Middle, "*l*");
    let (x, y) = at(incidence, RADIUS + 18.0);
    svg.math("", (x + 6.0, (y - 2.0).min(centre.1 - 22.0)), Anchor::Middle, "*r*");
}

/// Around the mirror direction: where each lobe has half of its maximum, in degrees in and across the plane.
fn outlines(svg: &mut Svg, centre: Point, shapes: &[Shape], incidence: f64) {
    let mirror = incidence.to_radians();
    let pole = direction(mirror);
    // Towards the normal, and across the plane of incidence.
    let (up, side) = (Vec3::new(-mirror.cos(), 0.0, mirror.sin()), Vec3::new(0.0, 1.0, 0.0));
    let around = |angle: f64, turn: f64| {
        let (sin, cos) = angle.sin_cos();
        pole * cos + (up * turn.cos() + side * turn.sin()) * sin
    };
    let outlines: Vec<Vec<(f64, f64)>> = shapes
        .iter()
        .map(|shape| {
            (0..=360)
                .map(|degrees| {
                    let turn = f64::from(degrees).to_radians();
                    let angle = half_width(|angle| (shape.value)(around(angle, turn))).to_degrees();
                    (angle * turn.sin(), angle * turn.cos())
                })
                .collect()
        })
        .collect();
    let reach = outlines.iter().flatten().fold(0.0_f64, |max, &(x, y)| max.max(x.abs() * 0.5).max(y.abs()));
    let reach = reach.clamp(1e-3, 90.0);
    let (half_height, half_width) = (82.0, 164.0);
    let scale = half_height / (reach * 1.08);
    let point = |(x, y): (f64, f64)| (centre.0 + x * scale, centre.1 - y * scale);

    let frame = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let frame = frame.map(|(x, y)| (centre.0 + x * half_width, centre.1 + y * half_height));
    // Below the surface: the horizon is a great circle, as good as straight in this window.
    let horizon = centre.1 + (90.0 - incidence) * scale;
    if horizon < centre.1 + half_height {
        let height = centre.1 + half_height - horizon;
        svg.rectangle("below", (centre.0 - half_width, horizon), 2.0 * half_width, height);
        svg.text("soft", (centre.0 + half_width - 6.0, horizon + 16.0), Anchor::End, "below the horizon");
    }
    let step = super::svg::nice_step(reach, 2.0);
    for tick in -6..=6 {
        let value = f64::from(tick) * step;
        let text = format!("{}°", label(value)).replace('-', "−");
        let (x, y) = point((value, value));
        if (x - centre.0).abs() <= half_width {
            svg.line("grid", (x, centre.1 - half_height), (x, centre.1 + half_height));
            if tick % 2 == 0 {
                svg.text("soft", (x, centre.1 + half_height + 16.0), Anchor::Middle, &text);
            }
        }
        if (y - centre.1).abs() <= half_height {
            svg.line("grid", (centre.0 - half_width, y), (centre.0 + half_width, y));
            svg.text("soft", (centre.0 - half_width - 6.0, y + 4.0), Anchor::End, &text);
        }
    }
    svg.path("axis", &frame, true);
    for (index, outline) in outlines.iter().enumerate() {
        let points: Vec<Point> = outline.iter().map(|&p| point(p)).collect();
        svg.path(&format!("f{index} fill"), &points, true);
        svg.path(line_class(index), &points, true);
    }
    svg.dot("tip", centre, 2.5);
    let above = "half-maximum outline around *r*: across (→), in the plane (↑)";
    svg.math("soft", (centre.0, centre.1 - half_height - 10.0), Anchor::Middle, above);
}

/// The angle from the mirror direction at which the value has fallen to a half, or the horizon cuts it off.
fn half_width(value: impl Fn(f64) -> f64) -> f64 {
    let (mut inside, mut outside) = (0.0, PI);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if value(middle) >= 0.5 {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}
