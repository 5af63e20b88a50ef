//! A lobe in three dimensions: each direction as far out as the value is large.
//!
//! The surface is laid out around the mirror direction, dense there, and ends exactly at the horizon. Its patches are
//! sorted by depth and painted from the back: a surface that every ray from the origin meets once, cut finely, has no
//! two patches that hide each other.

use super::svg::{Anchor, Point, Svg, label};
use super::{Series, Setting, direction, short_name};
use lobe::Vec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const WIDTH: f64 = 600.0;
const HEIGHT: f64 = 448.0;
const CENTRE: Point = (300.0, 290.0);
const RADIUS: f64 = 236.0;
/// Patches along and around the lobe.
const RINGS: u32 = 48;
/// Those up to a right angle from the mirror direction.
const INNER_RINGS: u32 = 36;
const SECTORS: u32 = 72;

/// What is painted from the back to the front.
enum Shape {
    Patch { corners: [Vec3<f64>; 4], shade: f64, edges: [bool; 2] },
    Segment { class: &'static str, from: Vec3<f64>, to: Vec3<f64> },
    Head { tip: Vec3<f64>, back: Vec3<f64> },
}

/// The viewer is far away: parallel projection.
struct View {
    right: Vec3<f64>,
    up: Vec3<f64>,
    towards: Vec3<f64>,
}

impl View {
    fn new(azimuth: f64, elevation: f64) -> Self {
        let (sin_a, cos_a) = azimuth.to_radians().sin_cos();
        let (sin_e, cos_e) = elevation.to_radians().sin_cos();
        let towards = Vec3::new(cos_e * cos_a, cos_e * sin_a, sin_e);
        let right = Vec3::new(-sin_a, cos_a, 0.0);
        Self { right, up: towards.cross(right), towards }
    }

    fn point(&self, p: Vec3<f64>) -> Point {
        (CENTRE.0 + RADIUS * p.dot(self.right), CENTRE.1 - RADIUS * p.dot(self.up))
    }

    fn depth(&self, shape: &Shape) -> f64 {
        match shape {
            Shape::Patch { corners, .. } => corners.iter().map(|c| c.dot(self.towards)).sum::<f64>() / 4.0,
            // A line on the surface is in front of it.
            Shape::Segment { from, to, .. } | Shape::Head { tip: from, back: to } => {
                (*from + *to).dot(self.towards) / 2.0 + 2e-3
            }
        }
    }
}

/// Draws one lobe, its peak at length 1.
pub(crate) fn surface(series: &Series<'_>, setting: Setting) -> Svg {
    let view = View::new(-64.0, 24.0);
    let mirror = setting.incidence.to_radians();
    let grid = grid(series, setting, mirror);
    let peak = grid.iter().flatten().fold(0.0_f64, |max, (_, value)| max.max(*value));
    let scale = if peak > 0.0 { 1.0 / peak } else { 0.0 };

    let mut shapes = patches(&grid, scale, &view);
    let light = direction(-mirror);
    shapes.extend(segments("ray", light * 1.12, light * 0.03));
    shapes.push(Shape::Head { tip: light * 0.6, back: light * 0.7 });
    shapes.extend(segments("thin", direction(mirror) * 0.04, direction(mirror) * 1.16));
    shapes.extend(segments("thin", Vec3::default(), Vec3::new(0.0, 0.0, 1.12)));
    for degrees in -90..90 {
        let (from, to) = (f64::from(degrees).to_radians(), f64::from(degrees + 1).to_radians());
        shapes.push(Shape::Segment { class: "axis", from: direction(from), to: direction(to) });
    }
    for tick in -2..=2 {
        let d = direction((f64::from(tick) * 30.0).to_radians());
        shapes.push(Shape::Segment { class: "axis", from: d * 0.975, to: d * 1.025 });
    }
    shapes.sort_by(|a, b| view.depth(a).total_cmp(&view.depth(b)));

    let title = format!("{} in three dimensions, light at {}°", series.name, label(setting.incidence));
    let mut svg = Svg::new(WIDTH, HEIGHT, &title);
    base(&mut svg, &view);
    svg.dot("tip", CENTRE, 2.5);
    paint(&mut svg, &view, &shapes);
    labels(&mut svg, &view, mirror);
    svg.text("", (24.0, HEIGHT - 32.0), Anchor::Start, &short_name(&series.name, 64));
    let peak = label(peak);
    let below = format!("{}; light at {}°; outer ring: {peak}", setting.quantity(), label(setting.incidence));
    svg.math("soft", (24.0, HEIGHT - 12.0), Anchor::Start, &below);
    svg
}

/// The directions of the upper hemisphere with their values, in rings around the mirror direction. Two of the rings are
/// at right angles to it, one on each side: there a mirror lobe ends, and with a small exponent it ends in a step.
fn grid(series: &Series<'_>, setting: Setting, mirror: f64) -> Vec<Vec<(Vec3<f64>, f64)>> {
    let pole = direction(mirror);
    let (up, side) = (Vec3::new(-mirror.cos(), 0.0, mirror.sin()), Vec3::new(0.0, 1.0, 0.0));
    (0..=RINGS)
        .map(|ring| {
            (0..=SECTORS)
                .map(|sector| {
                    let turn = up * angle_of(sector).cos() + side * angle_of(sector).sin();
                    // z = pole.z cos a + turn.z sin a is 0 at the horizon; just above it the lobe still has a value.
                    let horizon = (pole.z).atan2(-turn.z).min(PI) * (1.0 - 1e-9);
                    let (sin, cos) = ring_angle(ring, horizon).sin_cos();
                    let v = pole * cos + turn * sin;
                    (v, setting.value(series.brdf, v))
                })
                .collect()
        })
        .collect()
}

/// The angle between the mirror direction and a ring, which ends at `horizon`: dense near the mirror direction.
fn ring_angle(ring: u32, horizon: f64) -> f64 {
    let inner = horizon.min(FRAC_PI_2 * (1.0 - 1e-9));
    if ring <= INNER_RINGS {
        let part = f64::from(ring) / f64::from(INNER_RINGS);
        inner * part * part
    } else {
        let outer = horizon.min(FRAC_PI_2 * (1.0 + 1e-9));
        outer + (horizon - outer) * f64::from(ring - INNER_RINGS - 1) / f64::from(RINGS - INNER_RINGS - 1)
    }
}

fn angle_of(sector: u32) -> f64 {
    f64::from(sector) / f64::from(SECTORS) * TAU
}

fn patches(grid: &[Vec<(Vec3<f64>, f64)>], scale: f64, view: &View) -> Vec<Shape> {
    // From the upper left, in front.
    let lamp = Vec3::new(-0.55, -0.75, 0.6).normalize();
    let at = |(v, value): (Vec3<f64>, f64)| v * (value * scale);
    let mut shapes = Vec::new();
    for (ring, rows) in grid.windows(2).enumerate() {
        let [inner, outer] = rows else { continue };
        for (sector, (a, b)) in inner.windows(2).zip(outer.windows(2)).enumerate() {
            let (&[a0, a1], &[b0, b1]) = (a, b) else { continue };
            let corners = [at(a0), at(a1), at(b1), at(b0)];
            let normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
            // Too small to be seen, or the far side of the lobe. From above nobody looks into its open end.
            if normal.length() < 1e-12 || normal.dot(view.towards) <= 0.0 {
                continue;
            }
            let facing = normal.normalize().dot(lamp);
            // What faces away from the lamp is dark, not black.
            let shade = 0.32 + 0.68 * (0.5 + 0.5 * facing).clamp(0.0, 1.0);
            shapes.push(Shape::Patch { corners, shade, edges: [ring % 4 == 3, sector % 6 == 0] });
        }
    }
    shapes
}

/// A line in pieces, so that each can be hidden by itself.
fn segments(class: &'static str, from: Vec3<f64>, to: Vec3<f64>) -> impl Iterator<Item = Shape> {
    const PIECES: u32 = 48;
    // Every other piece of a thin line is left out: dashes would start anew on each.
    let step = if class == "thin" { 2 } else { 1 };
    (0..PIECES).step_by(step).map(move |i| {
        let at = |i: u32| from + (to - from) * (f64::from(i) / f64::from(PIECES));
        Shape::Segment { class, from: at(i), to: at(i + 1) }
    })
}

/// The surface with its rings: all of it is behind the lobe for a viewer from above.
fn base(svg: &mut Svg, view: &View) {
    let ring = |radius: f64| -> Vec<Point> {
        (0..120)
            .map(|i| f64::from(i) / 120.0 * TAU)
            .map(|a| view.point(Vec3::new(radius * a.cos(), radius * a.sin(), 0.0)))
            .collect()
    };
    svg.path("ground", &ring(1.0), true);
    svg.path("grid", &ring(0.5), true);
    svg.path("axis", &ring(1.0), true);
    for axis in [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)] {
        svg.line("grid", view.point(-axis), view.point(axis));
    }
}

fn paint(svg: &mut Svg, view: &View, shapes: &[Shape]) {
    svg.group("stroke-width=\".6\" stroke-linejoin=\"round\"");
    for shape in shapes {
        match shape {
            Shape::Patch { corners, shade, edges } => {
                let fill = colour(*shade);
                let points = corners.map(|corner| view.point(corner));
                svg.patch(fill, fill, &points);
                let [along, across] = *edges;
                if along {
                    svg.path("mesh", &points[2..4], false);
                }
                if across {
                    svg.path("mesh", &[points[0], points[3]], false);
                }
            }
            Shape::Segment { class, from, to } => {
                let class = if *class == "thin" { "dash" } else { class };
                svg.line(class, view.point(*from), view.point(*to));
            }
            Shape::Head { tip, back } => svg.arrow(view.point(*back), view.point(*tip)),
        }
    }
    svg.end_group();
}

fn labels(svg: &mut Svg, view: &View, mirror: f64) {
    let (x, y) = view.point(direction(-mirror) * 1.17);
    svg.math("", (x.max(56.0), y + 4.0), Anchor::End, "light *l*");
    let (x, y) = view.point(direction(mirror) * 1.19);
    if x < WIDTH - 76.0 {
        svg.math("", (x, y + 4.0), Anchor::Start, "mirror *r*");
    } else {
        svg.math("", (WIDTH - 6.0, y - 10.0), Anchor::End, "mirror *r*");
    }
    let (x, y) = view.point(Vec3::new(0.0, 0.0, 1.15));
    svg.math("", (x, y), Anchor::Middle, "*n*");
    for tick in -2..=2 {
        let degrees = f64::from(tick) * 30.0;
        let (x, y) = view.point(direction(degrees.to_radians()) * 1.07);
        if tick != 0 && (degrees.to_radians().abs() - mirror).abs() > 0.12 {
            svg.text("soft", (x, y + 4.0), Anchor::Middle, &format!("{}°", degrees.abs()));
        }
    }
}

/// From a deep to a pale blue, readable on white and on black.
fn colour(shade: f64) -> [u8; 3] {
    let (dark, light) = ([16.0, 54.0, 92.0], [188.0, 224.0, 246.0]);
    let mut rgb = [0_u8; 3];
    for ((out, dark), light) in rgb.iter_mut().zip(dark).zip(light) {
        *out = (dark + (light - dark) * shade).round().clamp(0.0, 255.0) as u8;
    }
    rgb
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_projection_is_a_rotation() {
        let view = View::new(-64.0, 24.0);
        for (a, b) in [(view.right, view.up), (view.up, view.towards), (view.towards, view.right)] {
            assert!(a.dot(b).abs() < 1e-15 && (a.length() - 1.0).abs() < 1e-15);
        }
        // Up in the world is up in the picture.
        assert!(view.point(Vec3::new(0.0, 0.0, 1.0)).1 < CENTRE.1);
    }

    #[test]
    fn the_grid_ends_at_the_horizon_and_never_below() {
        let spec = crate::spec::from_argument("paper");
        let brdf = spec.map(|spec| spec.build::<f64>());
        for incidence in [0.0, 30.0, 85.0] {
            let Ok(brdf) = &brdf else { panic!("no preset") };
            let series = Series { name: String::new(), brdf: &**brdf };
            let setting = Setting { incidence, cosine: false, log: false };
            let grid = grid(&series, setting, incidence.to_radians());
            for (v, value) in grid.iter().flatten() {
                assert!(v.z > 0.0 && v.z <= 1.0 && *value > 0.25, "{incidence} {v:?} {value}");
            }
            assert!(grid.last().is_some_and(|ring| ring.iter().all(|(v, _)| v.z < 1e-8)));
        }
    }
}
