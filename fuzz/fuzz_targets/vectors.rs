//! Vectors, frames, interpolated normals and lights on any bit pattern.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe::{Frame, PointLight, Vec3, halfway, interpolate_normal, mirror, reflect};
use lobe_fuzz::{Bits, channels, components, equal, same};

const U: f64 = 1.0 / 16_777_216.0;

fn wide(v: Vec3) -> Vec3<f64> {
    v.map(f64::from)
}

fn any_nan(v: Vec3) -> bool {
    components(v).iter().any(|c| c.is_nan())
}

fn all_nan(v: Vec3) -> bool {
    components(v).iter().all(|c| c.is_nan())
}

fn off(v: Vec3) -> f64 {
    (wide(v).length() - 1.0).abs()
}

/// Whatever the numbers are.
fn anywhere(bits: &mut Bits<'_>) {
    let (a, b, c) = (bits.vector(), bits.vector(), bits.vector());
    let weights = [bits.float(), bits.float(), bits.float()];
    let h = halfway(a, b);
    assert!(equal(components(h), components(halfway(b, a))), "halfway {a:?} {b:?}");
    let at = PointLight::new(a, bits.colour()).at(b);
    let _ = (reflect(a, b), mirror(a, b), Frame::from_normal(a).to_world(b), Frame::from_normal(a).to_local(b));
    let _ = Frame::from_normal_tangent(a, b);
    let n = interpolate_normal([a, b, c], weights, c);
    assert!(!(weights.iter().any(|w| w.is_nan())) || all_nan(n), "{n:?} for {weights:?}");
    if any_nan(a) {
        assert!(all_nan(a.normalize()) && all_nan(a.normalize_or(c)) && a.length().is_nan(), "normalize {a:?}");
        assert!(all_nan(h), "halfway {a:?} {b:?}: {h:?}");
        assert!(any_nan(reflect(a, b)) && any_nan(mirror(a, b)));
        assert!(any_nan(n), "interpolate {a:?} {b:?} {c:?} {weights:?}: {n:?}");
        assert!(all_nan(at.l) && channels(at.irradiance).iter().all(|c| c.is_nan()), "{at:?}");
    }
    let length = wide(a).length();
    if length.is_finite() && length > 0.0 {
        assert!(off(a.normalize()) <= 4.0 * U && same(components(a.normalize()), components(a.normalize_or(b))));
        if length >= f64::from(f32::MIN_POSITIVE) && length < 3.4e38 {
            assert!((f64::from(a.length()) / length - 1.0).abs() < 4.0 * U, "{a:?}: {} {length}", a.length());
        }
    }
    if a == b && length.is_finite() {
        assert_eq!((channels(at.irradiance), components(at.l), at.distance), ([0.0; 3], [0.0, 0.0, 1.0], 0.0));
    }
}

/// Unit vectors.
fn inside(bits: &mut Bits<'_>) {
    let l = bits.direction(Vec3::new(0.0, 0.0, 1.0));
    let v = bits.direction(l);
    let n = bits.direction(v);
    let tangent = bits.vector();

    let h = halfway(l, v);
    assert!(off(h) < 4.0 * U, "{l:?} {v:?}: {h:?}");
    assert!(same(components(halfway(l, -l)), components(halfway(-l, l))));
    let unit = off(n) * 2.0 + off(n) * off(n);
    let back = reflect(reflect(l, n), n);
    assert!((wide(back) - wide(l)).length() <= (16.0 * U + 4.0 * unit) * wide(l).length(), "{l:?} {n:?}: {back:?}");
    assert_eq!(mirror(l, n), -reflect(l, n));

    // From a unit vector to its last digit.
    let n = n.normalize();
    let finite = components(tangent).iter().all(|c| c.is_finite());
    for frame in
        [Some(Frame::from_normal(n)), finite.then(|| Frame::from_normal_tangent(n, tangent))].into_iter().flatten()
    {
        let [t, b, n] = [frame.tangent, frame.bitangent, frame.normal].map(wide);
        for x in [t.dot(n), b.dot(n), t.dot(b), t.length() - 1.0, b.length() - 1.0] {
            assert!(x.abs() <= 8.0 * U, "{x:e} in {frame:?}");
        }
        let local = frame.to_local(l);
        assert!((wide(frame.to_world(local)) - wide(l)).length() < 12.0 * U, "{frame:?} {l:?}");
    }

    // Weights of a point inside a triangle.
    let (a, b) = (bits.up_to(1.0), bits.up_to(1.0));
    let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
    let inner = interpolate_normal([l, v, n], [1.0 - a - b, a, b], n);
    assert!(off(inner) < 1e-5, "{l:?} {v:?} {n:?} {a} {b}: {inner:?}");
    assert_eq!(interpolate_normal([l, v, n], [0.0, 1.0, 0.0], n), v);
}

fuzz_target!(|input: &[u8]| {
    anywhere(&mut Bits(input));
    inside(&mut Bits(input));
});
