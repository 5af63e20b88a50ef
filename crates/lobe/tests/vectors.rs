//! Vectors, frames, interpolated normals and lights, against `f64` and against their own definitions.

use lobe::{Frame, PointLight, Rgb, Vec3, halfway, interpolate_normal, mirror, reflect};
use lobe_verify::strategies::{above, azimuth, cosine, direction, pair_above};
use proptest::prelude::*;

const U: f64 = 1.0 / 16_777_216.0;
const UP: Vec3 = Vec3 { x: 0.0, y: 0.0, z: 1.0 };

fn wide(v: Vec3) -> Vec3<f64> {
    v.map(f64::from)
}

/// `|a − b|`.
fn apart(a: Vec3, b: Vec3<f64>) -> f64 {
    (wide(a) - b).length()
}

fn bits(v: Vec3) -> [u32; 3] {
    <[f32; 3]>::from(v).map(f32::to_bits)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn reflect_is_an_involution(d in direction(), n in direction(), length in 1e-3_f32..1e3) {
        let d = d * length;
        let back = reflect(reflect(d, n), n);
        // The normal's own rounding, |n|² − 1, counts four times; see the function's documentation.
        let unit = (wide(n).length_squared() - 1.0).abs();
        prop_assert!(apart(back, wide(d)) <= (16.0 * U + 4.0 * unit) * f64::from(length));
    }

    #[test]
    fn reflect_keeps_the_length_and_flips_the_cosine(d in direction(), n in direction()) {
        let r = wide(reflect(d, n));
        prop_assert!((r.length() - 1.0).abs() < 8.0 * U);
        prop_assert!((r.dot(wide(n)) + wide(d).dot(wide(n))).abs() < 8.0 * U);
        prop_assert_eq!(mirror(d, n), -reflect(d, n));
    }

    #[test]
    fn halfway_is_symmetric_to_the_last_bit((l, v) in pair_above()) {
        prop_assert_eq!(bits(halfway(l, v)), bits(halfway(v, l)));
        prop_assert_eq!(bits(halfway(l, -l)), bits(halfway(-l, l)));
    }

    /// Against the bisector of the exactly normalised inputs, in double precision, for lengths that are off.
    #[test]
    fn halfway_is_accurate_for_lengths_that_are_off(l in direction(), v in direction(), a in -2e-6_f32..2e-6, b in -2e-6_f32..2e-6) {
        let (l, v) = (l * (1.0 + a), v * (1.0 + b));
        check_halfway(l, v, 2.5e-6)?;
    }

    /// The hard case: nearly opposite, with lengths that are off by rounding.
    #[test]
    fn halfway_is_accurate_for_nearly_opposite_directions(l in direction(), other in direction(), angle in -6.0_f32..-1.0) {
        let v = (-l + other * 10_f32.powf(angle)).normalize();
        check_halfway(l, v, 1e-7)?;
    }

    #[test]
    fn halfway_of_opposite_directions_is_orthogonal(l in direction(), longer in -1e-6_f32..1e-6) {
        let longer = 1.0 + longer;
        let h = wide(halfway(l, -l * longer));
        prop_assert!((h.length() - 1.0).abs() < 4.0 * U);
        // Where the rounded inputs are not quite parallel, h is orthogonal to what they do span.
        prop_assert!(h.dot(wide(l)).abs() < 1e-5, "{h:?}");
    }

    #[test]
    fn normalize_survives_any_length(d in direction(), exponent in -37.0_f64..38.0) {
        let scale = 10_f64.powf(exponent);
        let v = wide(d).map(|c| (c * scale) as f32);
        let n = v.normalize();
        let exact = wide(v) * (1.0 / wide(v).length());
        prop_assert!(apart(n, exact) <= 3.0 * U, "{v:?}: {n:?}");
        prop_assert!((f64::from(v.length()) / wide(v).length() - 1.0).abs() < 4.0 * U);
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed(n in direction(), t in direction(), length in 1e-20_f32..1e20) {
        for frame in [Frame::from_normal(n), Frame::from_normal_tangent(n, t * length)] {
            let [t, b, n] = [frame.tangent, frame.bitangent, frame.normal].map(wide);
            for (what, x) in [("tn", t.dot(n)), ("bn", b.dot(n)), ("tb", t.dot(b)), ("t", t.length() - 1.0), ("b", b.length() - 1.0)] {
                prop_assert!(x.abs() <= 6.0 * U, "{what}: {x:e} in {frame:?}");
            }
            prop_assert!((t.cross(b) - n).length() < 8.0 * U);
        }
    }

    #[test]
    fn a_frame_takes_a_direction_there_and_back(n in direction(), d in direction()) {
        let frame = Frame::from_normal(n);
        let local = frame.to_local(d);
        prop_assert!((f64::from(local.z) - wide(n).dot(wide(d))).abs() < 4.0 * U);
        prop_assert!(apart(frame.to_world(local), wide(d)) < 12.0 * U);
    }

    #[test]
    fn a_tangent_keeps_its_side(n in direction(), t in direction()) {
        let across = wide(t) - wide(n) * wide(n).dot(wide(t));
        prop_assume!(across.length() > 2e-3);
        let frame = Frame::from_normal_tangent(n, t);
        prop_assert!(apart(frame.tangent, across * (1.0 / across.length())) < 1e-3);
    }

    #[test]
    fn interpolation_is_exact_at_the_corners(a in direction(), b in direction(), c in direction(), f in direction()) {
        let corners = [a, b, c];
        for (i, corner) in corners.into_iter().enumerate() {
            let mut w = [0.0; 3];
            w[i] = 1.0;
            prop_assert_eq!(interpolate_normal(corners, w, f), corner);
        }
    }

    #[test]
    fn interpolation_is_the_normalised_sum(a in above(), b in above(), c in above(), u in 0.0_f32..1.0, v in 0.0_f32..1.0) {
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        let w = [1.0 - u - v, u, v];
        let sum = wide(a) * f64::from(w[0]) + wide(b) * f64::from(w[1]) + wide(c) * f64::from(w[2]);
        prop_assume!(sum.length() > 1e-2);
        let n = interpolate_normal([a, b, c], w, UP);
        prop_assert!(apart(n, sum * (1.0 / sum.length())) < 1e-4);
        prop_assert!((wide(n).length() - 1.0).abs() < 4.0 * U);
    }

    #[test]
    fn a_point_light_obeys_the_inverse_square(d in direction(), e in -15.0_f64..15.0, i in 1e-3_f32..1e3) {
        let r = 10_f64.powf(e);
        let position = wide(d).map(|c| (c * r) as f32);
        let at = PointLight::new(position, Rgb::splat(i)).at(Vec3::default());
        let r = wide(position).length();
        prop_assert!((f64::from(at.irradiance.g) * r * r / f64::from(i) - 1.0).abs() < 8.0 * U);
        prop_assert!((f64::from(at.distance) / r - 1.0).abs() < 4.0 * U);
        prop_assert!(apart(at.l, wide(position) * (1.0 / r)) < 4.0 * U);
    }

    #[test]
    fn nan_in_nan_out(d in direction(), n in direction(), which in 0..3_usize) {
        let mut broken = <[f32; 3]>::from(d);
        broken[which] = f32::NAN;
        let broken = Vec3::from(broken);
        let all_nan = |v: Vec3| <[f32; 3]>::from(v).iter().all(|c| c.is_nan());
        prop_assert!(all_nan(broken.normalize()) && all_nan(broken.normalize_or(n)));
        prop_assert!(all_nan(halfway(broken, n)) && all_nan(halfway(n, broken)));
        prop_assert!(all_nan(interpolate_normal([broken, n, n], [0.2, 0.3, 0.5], n)));
        prop_assert!(broken.length().is_nan() && <[f32; 3]>::from(reflect(broken, n)).iter().any(|c| c.is_nan()));
        let light = PointLight::new(broken, Rgb::splat(1.0)).at(n);
        prop_assert!(light.irradiance.g.is_nan() && all_nan(light.l));
    }

    #[test]
    fn a_direction_of_the_strategies_is_of_unit_length(z in cosine(), phi in azimuth(), d in direction()) {
        prop_assert!(z > 0.0 && z <= 1.0 && phi.is_finite());
        prop_assert!((wide(d).length() - 1.0).abs() < 2.0 * U);
    }
}

/// The error of `halfway` against the exact bisector, where it is determined by the inputs.
fn check_halfway(l: Vec3, v: Vec3, off: f64) -> Result<(), TestCaseError> {
    let unit = |v: Vec3| wide(v) * (1.0 / wide(v).length());
    let sum = unit(l) + unit(v);
    let h = halfway(l, v);
    // Directions that are opposite to within their rounding have no bisector to compare with.
    prop_assume!(sum.length() > 4.0 * U);
    let exact = sum * (1.0 / sum.length());
    let error = apart(h, exact);
    // ε of the lengths to the second order over |s|, and rounding; the coefficients of l and v differ by it.
    let bound = off + off * off / sum.length() + 8.0 * U;
    prop_assert!(error <= bound, "{l:?} {v:?}: {h:?}, not {exact:?}: {error:e} > {bound:e}");
    Ok(())
}

#[test]
fn glam_at_the_door() {
    let v: Vec3 = glam::Vec3::new(1.0, 2.0, 3.0).into();
    assert_eq!(glam::Vec3::from(v), glam::Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(Vec3::from(glam::Vec3A::from(v)), v);
    assert_eq!(glam::DVec3::from(wide(v)), glam::DVec3::new(1.0, 2.0, 3.0));
    let (d, n) = (glam::Vec3::new(0.6, 0.0, -0.8), glam::Vec3::Z);
    assert_eq!(glam::Vec3::from(reflect(d.into(), n.into())), d.reflect(n));
}

#[test]
fn degenerate_cases_are_as_stated() {
    let zero = Vec3::<f32>::default();
    assert!(zero.normalize().x.is_nan());
    assert_eq!(zero.normalize_or(UP), UP);
    assert_eq!(zero.length(), 0.0);
    assert_eq!(Vec3::new(1e-30_f32, 0.0, 0.0).normalize(), Vec3::new(1.0, 0.0, 0.0));
    assert_eq!(Vec3::new(0.0, -1e30_f32, 0.0).normalize(), Vec3::new(0.0, -1.0, 0.0));
    assert_eq!(Vec3::new(0.0, f32::MAX, 0.0).length(), f32::MAX);
    assert_eq!(Vec3::new(0.0, 0.0, 1e-45_f32).normalize(), UP);
    // Normals that cancel.
    let x = Vec3::new(1.0, 0.0, 0.0);
    assert_eq!(interpolate_normal([x, -x, UP], [0.5, 0.5, 0.0], UP), UP);
    // A tangent along the normal, and none.
    for tangent in [UP, -UP * 3.0, zero] {
        assert_eq!(Frame::from_normal_tangent(UP, tangent).tangent, Frame::from_normal(UP).tangent);
    }
    // Both poles.
    assert_eq!(Frame::from_normal(-UP).normal, -UP);
    // A light that one stands on, and one that is almost there.
    let light = PointLight::new(UP, Rgb::splat(5.0));
    let there = light.at(UP);
    assert_eq!((there.irradiance, there.l, there.distance), (Rgb::splat(0.0), UP, 0.0));
    assert_eq!(PointLight::new(Vec3::new(0.0, 0.0, 1e-18), Rgb::splat(1.0)).at(zero).irradiance.r, 1e36);
    assert_eq!(PointLight::new(Vec3::new(0.0, 0.0, 1e-30), Rgb::splat(1.0)).at(zero).irradiance.r, f32::INFINITY);
    // Opposite along z.
    assert_eq!(halfway(UP, -UP), x);
}
