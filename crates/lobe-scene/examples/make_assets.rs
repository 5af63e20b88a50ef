//! Writes the built-in scene: `cargo run --example make_assets` from the root of the repository.
//!
//! A studio with two steps, from the back to the front:
//!
//! * two trefoil knots, one smooth, one flat, and between them three large spheres, diffuse, glossy and mirror-like;
//! * a row of spheres that differ in the exponent `q`;
//! * a row of niches with the same sphere in each, which the view `light` lights from a different side each.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets");
    std::fs::create_dir_all(&folder)?;
    for (name, text) in files() {
        std::fs::write(folder.join(name), text)?;
    }
    Ok(())
}

/// All files with their content.
pub(crate) fn files() -> [(&'static str, String); 3] {
    [("lecture.obj", model()), ("lecture.mtl", materials()), ("lecture.json", description())]
}

/// The exponents of the front row.
const EXPONENTS: [u32; 6] = [1, 4, 16, 64, 256, 1024];
/// The widths α of the gold in their place.
const WIDTHS: [f64; 6] = [0.6, 0.4, 0.25, 0.15, 0.08, 0.04];
/// The niches: where the light of each stands, in degrees from the front, to the left and upwards.
const LIGHTS: [[f64; 2]; 5] = [[-58.0, 10.0], [-30.0, 35.0], [0.0, 65.0], [30.0, 35.0], [58.0, 10.0]];
/// Distance of those lights from the middle of their sphere.
const LIGHT_DISTANCE: f64 = 0.74;
/// Heights of the two steps.
const MIDDLE: f64 = 0.85;
const BACK: f64 = 1.7;

type Point = [f64; 3];

/// An OBJ file being written.
struct Writer {
    text: String,
    points: usize,
}

impl Writer {
    /// A piece with its own points; faces count them from 0.
    fn piece(&mut self, name: &str, material: &str, smooth: bool, points: &[Point], faces: &[Vec<usize>]) {
        let smoothing = if smooth { "1" } else { "off" };
        let _ = writeln!(self.text, "o {name}\nusemtl {material}\ns {smoothing}");
        for point in points {
            let [x, y, z] = point.map(short);
            let _ = writeln!(self.text, "v {x} {y} {z}");
        }
        for face in faces {
            self.text.push('f');
            for corner in face {
                let _ = write!(self.text, " {}", self.points + corner + 1);
            }
            self.text.push('\n');
        }
        self.points += points.len();
    }
}

/// Four decimals at most: a tenth of a millimetre if the scene is in metres.
fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn model() -> String {
    let mut writer = Writer {
        text: "# The built-in scene of lobe. Made by the example make_assets; do not edit.\nmtllib lecture.mtl\n"
            .to_owned(),
        points: 0,
    };
    let (points, faces) = studio();
    writer.piece("studio", "studio", true, &points, &faces);

    for (name, low, high) in
        [("middle step", [-6.4, 0.0, 0.5], [6.4, MIDDLE, 2.3]), ("back step", [-6.4, 0.0, -2.8], [6.4, BACK, 0.5])]
    {
        let (points, faces) = cuboid(low, high);
        writer.piece(name, "step", false, &points, &faces);
    }

    for (name, x, smooth) in [("knot smooth", -4.35, true), ("knot flat", 4.35, false)] {
        let (points, faces) = knot([x, BACK + 1.62, -1.1]);
        writer.piece(name, "copper", smooth, &points, &faces);
    }
    for (material, x, around) in [("clay", -1.9, 48), ("glossy", 0.0, 48), ("mirror", 1.9, 64)] {
        let (points, faces) = sphere([x, BACK + 0.85, -0.7], 0.85, around);
        writer.piece(&format!("sphere {material}"), material, true, &points, &faces);
    }
    for (at, exponent) in EXPONENTS.iter().enumerate() {
        let (points, faces) = sphere([1.5 * (at as f64 - 2.5), MIDDLE + 0.52, 1.4], 0.52, 40);
        writer.piece(&format!("sphere q = {exponent}"), &format!("q{exponent}"), true, &points, &faces);
    }
    for at in 0..LIGHTS.len() {
        let (points, faces) = sphere(niche(at), 0.38, 40);
        writer.piece(&format!("sphere in niche {}", at + 1), "jade", true, &points, &faces);
    }
    for wall in 0..=LIGHTS.len() {
        let x = NICHE_WIDTH * (wall as f64 - LIGHTS.len() as f64 / 2.0);
        let (points, faces) = cuboid([x - 0.03, 0.0, 2.3], [x + 0.03, MIDDLE, 3.9]);
        writer.piece(&format!("wall {}", wall + 1), "wall", false, &points, &faces);
    }
    writer.text
}

const NICHE_WIDTH: f64 = 1.6;

fn niche(at: usize) -> Point {
    [NICHE_WIDTH * (at as f64 - 2.0), 0.38, 3.1]
}

/// A floor that bends up into a wall: no horizon is to be seen.
fn studio() -> (Vec<Point>, Vec<Vec<usize>>) {
    let (left, right, front, back, bend, height) = (-30.0, 30.0, 30.0, -9.0, 5.0, 24.0);
    let mut profile = vec![[0.0, front], [0.0, back + bend]];
    for step in 1..16 {
        let (sine, cosine) = (PI / 2.0 * f64::from(step) / 16.0).sin_cos();
        profile.push([bend * (1.0 - cosine), back + bend * (1.0 - sine)]);
    }
    profile.extend([[bend, back], [height, back]]);
    let points: Vec<Point> = profile.iter().flat_map(|&[y, z]| [[left, y, z], [right, y, z]]).collect();
    let faces = (0..profile.len() - 1).map(|at| vec![2 * at, 2 * at + 1, 2 * at + 3, 2 * at + 2]).collect();
    (points, faces)
}

/// A sphere of `around` steps around and half as many from pole to pole.
fn sphere(center: Point, radius: f64, around: usize) -> (Vec<Point>, Vec<Vec<usize>>) {
    let rings = around / 2;
    let at = |ring: usize, step: usize| 1 + (ring - 1) * around + step % around;
    let last = (rings - 1) * around + 1;
    let mut points = vec![[center[0], center[1] + radius, center[2]]];
    for ring in 1..rings {
        let (sine, cosine) = (PI * ring as f64 / rings as f64).sin_cos();
        for step in 0..around {
            let (s, c) = (TAU * step as f64 / around as f64).sin_cos();
            points.push([center[0] + radius * sine * s, center[1] + radius * cosine, center[2] + radius * sine * c]);
        }
    }
    points.push([center[0], center[1] - radius, center[2]]);
    let mut faces = Vec::new();
    for step in 0..around {
        faces.push(vec![0, at(1, step), at(1, step + 1)]);
        for ring in 1..rings - 1 {
            faces.push(vec![at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)]);
        }
        faces.push(vec![last, at(rings - 1, step + 1), at(rings - 1, step)]);
    }
    (points, faces)
}

/// A tube along a trefoil knot: 504 steps along it and 20 around it, 20,160 triangles.
///
/// So few steps around leave facets that can be seen.
fn knot(center: Point) -> (Vec<Point>, Vec<Vec<usize>>) {
    const ALONG: usize = 504;
    const AROUND: usize = 20;
    let radius = 0.3;
    let curve = |t: f64| {
        let ring = 1.0 + 0.42 * (3.0 * t).cos();
        [0.95 * ring * (2.0 * t).cos(), 0.95 * ring * (2.0 * t).sin(), 0.5 * (3.0 * t).sin()]
    };
    let mut points = Vec::new();
    for step in 0..ALONG {
        let t = TAU * step as f64 / ALONG as f64;
        let here = curve(t);
        let ahead = unit(minus(curve(t + 1e-4), curve(t - 1e-4)));
        // The direction away from the middle of the knot, at a right angle to the curve: it closes after one round.
        let out = minus(here, [0.0, 0.0, 0.0]);
        let side = unit(cross(ahead, out));
        let out = cross(side, ahead);
        for turn in 0..AROUND {
            let (s, c) = (TAU * turn as f64 / AROUND as f64).sin_cos();
            points.push([0, 1, 2].map(|axis| center[axis] + here[axis] + radius * (c * out[axis] + s * side[axis])));
        }
    }
    let at = |step: usize, turn: usize| step % ALONG * AROUND + turn % AROUND;
    let mut faces = Vec::new();
    for step in 0..ALONG {
        for turn in 0..AROUND {
            faces.push(vec![at(step, turn), at(step, turn + 1), at(step + 1, turn + 1), at(step + 1, turn)]);
        }
    }
    (points, faces)
}

fn cuboid(low: Point, high: Point) -> (Vec<Point>, Vec<Vec<usize>>) {
    let corner = |at: usize| [0, 1, 2].map(|axis| if at >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [2, 6, 7, 3], [0, 1, 5, 4], [4, 5, 7, 6], [0, 2, 3, 1]];
    ((0..8).map(corner).collect(), faces.map(|face| face.to_vec()).to_vec())
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Point) -> Point {
    let length = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt();
    a.map(|part| part / length)
}

fn materials() -> String {
    let mut text = "# The built-in scene of lobe. Made by the example make_assets; do not edit.\n".to_owned();
    let mut material = |name: &str, kd: [f64; 3], ks: f64, ns: u32, illum: u32| {
        let [r, g, b] = kd;
        let _ = writeln!(
            text,
            "\nnewmtl {name}\nKa {r} {g} {b}\nKd {r} {g} {b}\nKs {ks} {ks} {ks}\nNs {ns}\nillum {illum}"
        );
    };
    material("studio", [0.33, 0.37, 0.41], 0.0, 0, 1);
    material("step", [0.58, 0.56, 0.53], 0.0, 0, 1);
    material("wall", [0.58, 0.56, 0.53], 0.0, 0, 1);
    material("copper", [0.62, 0.24, 0.09], 0.4, 40, 2);
    material("clay", [0.72, 0.52, 0.32], 0.0, 0, 1);
    material("glossy", [0.5, 0.02, 0.03], 0.6, 250, 2);
    material("mirror", [0.01, 0.01, 0.01], 0.9, 4000, 3);
    material("jade", [0.08, 0.42, 0.24], 0.45, 60, 2);
    for exponent in EXPONENTS {
        material(&format!("q{exponent}"), [0.05, 0.17, 0.45], 0.4, exponent, 2);
    }
    text
}

/// A point light as it stands in the description.
fn point_light(position: Point, intensity: Point, radius: f64) -> String {
    let [x, y, z] = position.map(short);
    let [r, g, b] = intensity.map(short);
    let radius = short(radius);
    format!("{{\"point\": {{\"position\": [{x}, {y}, {z}], \"intensity\": [{r}, {g}, {b}], \"radius\": {radius}}}}}")
}

/// One light in each niche, at the same distance from each sphere.
fn niche_lights(strength: f64) -> Vec<String> {
    LIGHTS
        .iter()
        .enumerate()
        .map(|(at, [side, up])| {
            let (side, up) = (side.to_radians(), up.to_radians());
            let direction = [side.sin() * up.cos(), up.sin(), side.cos() * up.cos()];
            let center = niche(at);
            let position = [0, 1, 2].map(|axis| center[axis] + LIGHT_DISTANCE * direction[axis]);
            point_light(position, [strength, strength, 0.9 * strength], 0.0)
        })
        .collect()
}

/// The materials of the view `models`: gold from rough to smooth in the row, and others behind it.
fn models() -> String {
    let mut lines: Vec<String> = EXPONENTS
        .iter()
        .zip(WIDTHS)
        .map(|(q, alpha)| {
            let gold = format!(
                "{{\"model\": \"microfacet\", \"alpha\": {alpha}, \"fresnel\": \"conductor\", \"metal\": \"gold\"}}"
            );
            format!("\"q{q}\": {{\"name\": \"gold-{alpha}\", \"lobes\": [{gold}]}}")
        })
        .collect();
    let plastic = "{\"model\": \"gltf\", \"base-color\": [0.03, 0.3, 0.22], \"metallic\": 0, \"roughness\": 0.35}";
    lines.push(format!("\"glossy\": {{\"name\": \"gltf-plastic\", \"lobes\": [{plastic}]}}"));
    let measured = [("clay", "dark-red-paint"), ("mirror", "nickel"), ("copper", "blue-metallic-paint")];
    lines.extend(measured.map(|(name, material)| format!("\"{name}\": \"ngan:{material}/cook-torrance\"")));
    lines.join(",\n      ")
}

fn description() -> String {
    let key = point_light([-7.0, 10.5, 9.5], [640.0, 610.0, 570.0], 1.2);
    let fill = point_light([9.0, 7.0, 9.0], [130.0, 150.0, 190.0], 1.5);
    let rim = point_light([1.0, 9.5, -3.5], [110.0, 115.0, 125.0], 0.8);
    let ambient = "{\"ambient\": [0.13, 0.14, 0.16]}".to_owned();
    let two = [key.as_str(), &fill, &ambient].join(",\n      ");
    let mut general = vec![key.clone(), fill, rim, ambient];
    let general_text = general.join(",\n    ");
    general.extend(niche_lights(0.25));
    let overview = general.join(",\n      ");
    let one = format!("{key},\n      {{\"ambient\": [0.1, 0.1, 0.1]}}");
    let models = models();
    let mut local = niche_lights(0.9);
    local.push("{\"ambient\": [0.04, 0.04, 0.04]}".to_owned());
    let local = local.join(",\n      ");
    format!(
        r#"{{
  "obj": "lecture.obj",
  "shading_model": "blinn-torrance",
  "background": {{"bottom": [0.3, 0.3, 0.3], "top": [0.62, 0.74, 0.95]}},
  "lights": [
    {general_text}
  ],
  "views": [
    {{"name": "overview",
     "camera": {{"eye": [0, 5.3, 14.6], "target": [0, 2, 0], "fov_y_degrees": 29}},
     "lights": [
      {overview}
     ]}},
    {{"name": "exponent",
     "camera": {{"eye": [0, 3.4, 12], "target": [0, 1.4, 1.4], "fov_y_degrees": 27}},
     "lights": [
      {one}
     ]}},
    {{"name": "light",
     "camera": {{"eye": [0, 2.2, 10.8], "target": [0, 0.62, 3.1], "fov_y_degrees": 34}},
     "background": [0.02, 0.02, 0.03],
     "lights": [
      {local}
     ]}},
    {{"name": "materials",
     "camera": {{"eye": [0, 4, 8], "target": [0, 2.6, -0.7], "fov_y_degrees": 23}}}},
    {{"name": "smooth-flat",
     "camera": {{"eye": [0, 4.6, 12.1], "target": [0, 3.3, -1.1], "fov_y_degrees": 29}}}},
    {{"name": "models",
     "camera": {{"eye": [0, 4.3, 13.2], "target": [0, 3.1, 0], "fov_y_degrees": 27.5}},
     "lights": [
      {two}
     ],
     "materials": {{
      {models}
     }}}}
  ]
}}
"#
    )
}
