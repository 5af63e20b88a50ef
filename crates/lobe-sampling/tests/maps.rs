//! The maps: even where they should be, there and back.

mod common;

use common::points;
use lobe::{Real, Vec3};
use lobe_sampling::map::*;

fn length(v: Vec3<f64>) -> f64 {
    v.length()
}

/// Numbers of `[0, 1)` with both ends.
const SIDES: [f64; 8] = [0.0, 1e-40, 1.0 / 16_777_216.0, 0.25, 0.5, 0.500_001, 0.75, 1.0 - 1.0 / 16_777_216.0];

fn ends() -> impl Iterator<Item = [f32; 2]> {
    SIDES.into_iter().flat_map(|x| SIDES.into_iter().map(move |y| [x as f32, y as f32]))
}

fn is_unit(l: Vec3<f32>) -> bool {
    (length(l.map(f64::from)) - 1.0).abs() < 1e-6
}

fn near<R: Real + Into<f64>>([a, b]: [R; 2], [c, d]: [R; 2], bound: f64) -> bool {
    (a - c).abs().into() < bound && (b - d).abs().into() < bound
}

#[test]
fn there_and_back() {
    let axis = Vec3::new(0.48_f32, -0.6, 0.64);
    let caps = [1e-6_f32, 1e-3, 0.2, 1.0, 1.9].map(|q| SphericalCap::new(axis, q));
    let inside =
        points(4096).map(|[x, y, _]| [x as f32, y as f32]).chain(ends().filter(|u| u.iter().all(|&u| u > 1e-4)));
    for u in inside {
        assert!(near(concentric_disc_inverse(concentric_disc(u)), u, 1e-6), "{u:?}");
        let l = cosine_hemisphere(u);
        assert!(is_unit(l) && near(cosine_hemisphere_inverse(l), u, 1e-6), "{u:?}");
        let l = uniform_hemisphere(u);
        assert!(is_unit(l) && near(uniform_hemisphere_inverse(l), u, 1e-6), "{u:?}");
        for cap in caps {
            let l = cap.sample(u);
            // A direction has 24 bits, of which a cap of 1e-3 rad has fourteen.
            let bound = if cap.pdf() > 1e3 { 1e-4 } else { 1e-5 };
            assert!(is_unit(l) && near(cap.inverse(l), u, bound), "{u:?} {:?} {}", cap.inverse(l), cap.pdf());
        }
        let (u, cap) = (u.map(f64::from), SphericalCap::new(axis.map(f64::from).normalize(), 1e-8));
        assert!(near(cap.inverse(cap.sample(u)), u, 1e-9), "{u:?}");
    }
}

#[test]
fn the_ends_are_finite() {
    let axis = Vec3::new(0.0_f32, 0.0, -1.0);
    let corner =
        SphericalTriangle::new(Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0_f32));
    for u in ends() {
        let [x, y] = concentric_disc(u);
        assert!(x * x + y * y <= 1.0 + 1e-6);
        assert!(is_unit(cosine_hemisphere(u)) && cosine_hemisphere(u).z >= 0.0);
        assert!(is_unit(uniform_hemisphere(u)) && uniform_hemisphere(u).z >= 0.0);
        for q in [1e-12, 1e-4, 1.0, 2.0] {
            assert!(is_unit(SphericalCap::new(axis, q).sample(u)), "{u:?} {q}");
        }
        assert!(is_unit(corner.sample(u)), "{u:?}");
    }
    // A triangle without an area has a direction all the same.
    let flat = SphericalTriangle::new(axis, axis, axis);
    assert_eq!(flat.sample([0.3, 0.6]), axis);
}

/// Densities integrate to 1 over the sphere, on a grid.
#[test]
fn densities_are_normalised() {
    const SIDE: usize = 400;
    let (mut cosine, mut uniform) = (0.0, 0.0);
    for i in 0..2 * SIDE {
        let z = (i as f64 + 0.5) / SIDE as f64 - 1.0;
        let l = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
        let ring = core::f64::consts::TAU / SIDE as f64;
        cosine += cosine_hemisphere_pdf(l) * ring;
        uniform += uniform_hemisphere_pdf(l) * ring;
    }
    assert!((cosine - 1.0).abs() < 1e-9 && (uniform - 1.0).abs() < 1e-9, "{cosine} {uniform}");
    let axis = Vec3::new(0.0, 0.0, 1.0);
    assert!((SphericalCap::new(axis, 2.0).pdf() * 2.0 * core::f64::consts::TAU - 1.0_f64).abs() < 1e-15);
    // The sun, of the sine of half its width, in single precision.
    let (sin2, single) =
        (4.65e-3_f64.powi(2), SphericalCap::from_sin2(Vec3::new(0.0_f32, 0.0, 1.0), 4.65e-3 * 4.65e-3));
    let exact = 1.0 / (core::f64::consts::TAU * (1.0 - (1.0 - sin2).sqrt()));
    assert!((f64::from(single.pdf()) / exact - 1.0).abs() < 1e-6, "{} {exact}", single.pdf());
}

/// The mean of a function over the samples is that over what is sampled evenly: its moments.
#[test]
fn caps_and_hemispheres_are_even() {
    let count = 1 << 14;
    let axis = Vec3::new(0.6, 0.0, -0.8);
    for q in [1e-4, 0.3, 1.0, 2.0] {
        let cap = SphericalCap::new(axis, q);
        let (mut first, mut second, mut side) = (0.0, 0.0, 0.0);
        for [x, y, _] in points(count) {
            let l = cap.sample([x, y]);
            let height = (l - axis).length_squared() / 2.0 / q;
            first += height / count as f64;
            second += height * height / count as f64;
            side += l.y / count as f64;
        }
        assert!((first - 0.5).abs() < 1e-3 && (second - 1.0 / 3.0).abs() < 1e-3 && side.abs() < 2e-3 * q.sqrt(), "{q}");
    }
}

fn triangles() -> Vec<[Vec3<f64>; 3]> {
    let unit = |x: f64, y: f64, z: f64| Vec3::new(x, y, z).normalize();
    vec![
        [unit(1.0, 0.0, 0.0), unit(0.0, 1.0, 0.0), unit(0.0, 0.0, 1.0)],
        [unit(1.0, 0.1, 0.2), unit(-0.4, 0.7, 0.1), unit(-0.5, -0.8, 0.3)],
        [unit(0.3, 0.2, 1.0), unit(0.31, 0.2, 1.0), unit(0.3, 0.22, 1.0)],
        [unit(0.3, 0.2, 1.0), unit(0.300_1, 0.2, 1.0), unit(0.3, 0.200_1, 1.0)],
        [unit(0.3, 0.2, 1.0), unit(1.3, 0.2, 1.0), unit(0.8, 0.201, 1.0)],
    ]
}

/// The solid angle by three dihedral angles, and of an octant.
#[test]
fn solid_angles() {
    for [a, b, c] in triangles() {
        let angle = |a: Vec3<f64>, b: Vec3<f64>, c: Vec3<f64>| {
            let (m, n) = (a.cross(b), a.cross(c));
            m.cross(n).length().atan2(m.dot(n))
        };
        let excess = angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - core::f64::consts::PI;
        let triangle = SphericalTriangle::new(a, b, c);
        assert!((triangle.solid_angle() - excess).abs() < 1e-14, "{} {excess}", triangle.solid_angle());
        assert!((SphericalTriangle::new(c, b, a).solid_angle() / triangle.solid_angle() - 1.0).abs() < 1e-7);
        // From the same corners in single precision.
        let [x, y, z] = [a, b, c].map(|v| v.map(|x| x as f32));
        let [p, q, r] = [x, y, z].map(|v| v.map(f64::from).normalize());
        let (narrow, exact) = (SphericalTriangle::new(x, y, z), SphericalTriangle::new(p, q, r).solid_angle());
        assert!((f64::from(narrow.solid_angle()) / exact - 1.0).abs() < 2e-6, "{} {exact}", narrow.solid_angle());
    }
    let [a, b, c] = triangles()[0];
    assert!((SphericalTriangle::new(a, b, c).pdf() * core::f64::consts::FRAC_PI_2 - 1.0).abs() < 1e-15);
}

/// Samples are in the triangle, and each of the four triangles between the middles of its edges has its part of them.
#[test]
fn triangles_are_even() {
    let count = 1 << 14;
    for [a, b, c] in triangles() {
        let triangle = SphericalTriangle::new(a, b, c);
        let det = a.dot(b.cross(c));
        let [ab, bc, ca] = [a + b, b + c, c + a].map(Vec3::normalize);
        let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
        let mut counts = [0; 4];
        for [x, y, _] in points(count) {
            let l = triangle.sample([x, y]);
            assert!((l.length() - 1.0).abs() < 1e-14);
            let within = |[p, q, r]: [Vec3<f64>; 3], room: f64| {
                [[p, q], [q, r], [r, p]].iter().all(|[p, q]| p.cross(*q).dot(l) * det.signum() >= -room)
            };
            assert!(within([a, b, c], 1e-14), "{l:?}");
            for (count, part) in counts.iter_mut().zip(parts) {
                *count += i32::from(within(part, 0.0));
            }
            // In single precision within a few units of the corners' digits.
            let [p, q, r] = [a, b, c].map(|v| v.map(|x| x as f32));
            let near = SphericalTriangle::new(p, q, r).sample([x as f32, y as f32]).map(f64::from);
            assert!((near - l).length() < 3e-6, "{near:?} {l:?}");
        }
        for (found, [p, q, r]) in counts.into_iter().zip(parts) {
            let share = SphericalTriangle::new(p, q, r).solid_angle() / triangle.solid_angle();
            assert!((f64::from(found) / count as f64 - share).abs() < 3e-3, "{found} {share}");
        }
    }
}
