//! Every lobe on any bit pattern: what `Brdf` promises, and no panic beyond its domain.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe::illumination::{self, BlinnTorranceHighlight, PhongHighlight};
use lobe::{Black, BlinnPhong, Brdf, CommonNormalization, Lambert, Mirror, Phong, Rgb, Shininess, Vec3};
use lobe_fuzz::{Bits, channels, components, same};

struct Entry {
    name: &'static str,
    reciprocal: bool,
    lobe: Box<dyn Brdf<f32>>,
}

fn every_lobe(k: Rgb, q: Shininess) -> Vec<Entry> {
    fn entry(name: &'static str, reciprocal: bool, lobe: impl Brdf<f32> + 'static) -> Entry {
        Entry { name, reciprocal, lobe: Box::new(lobe) }
    }
    let (lambert, phong, blinn) = (Lambert::new(k), Phong::new(k, q), BlinnPhong::new(k, q));
    vec![
        entry("Lambert", true, lambert),
        entry("Phong", true, phong),
        entry("BlinnPhong", true, blinn),
        entry("BlinnPhong<Common>", true, BlinnPhong::<f32, CommonNormalization>::with_normalization(k, q)),
        entry("PhongHighlight", false, PhongHighlight::new(k, q)),
        entry("BlinnTorranceHighlight", false, BlinnTorranceHighlight::new(k, q)),
        entry("Sum", true, lambert + blinn + phong),
        entry("Black", true, Black),
        entry("Sum with Black", true, blinn + Black),
        entry("Sum on Black", true, Black + phong),
    ]
}

fn finite(v: Vec3) -> bool {
    components(v).iter().all(|c| c.is_finite())
}

fn good(f: Rgb) -> bool {
    channels(f).iter().all(|c| c.is_finite() && *c >= 0.0)
}

/// Whatever the numbers are.
fn anywhere(bits: &mut Bits<'_>) {
    let (k, q, l, v) = (bits.colour(), Shininess(bits.float()), bits.vector(), bits.vector());
    for Entry { name, reciprocal, lobe } in every_lobe(k, q) {
        let (f, cos, back) = (lobe.eval(l, v), lobe.eval_cos(l, v), lobe.eval(v, l));
        if !(finite(l) && finite(v)) {
            for f in [f, cos] {
                assert!(channels(f).iter().all(|c| c.is_nan()), "{name}: {f:?} at {l:?} {v:?}");
            }
        }
        assert!(!reciprocal || same(channels(f), channels(back)), "{name}: {f:?} {back:?} at {l:?} {v:?}");
        let _ = lobe.eval_cos(v, l);
    }
    let seen = Mirror::new(k).reflect(v);
    assert!(same(components(seen.l), [-v.x, -v.y, v.z]));
    assert!(!v.z.is_nan() || channels(seen.weight).iter().all(|c| c.is_nan()), "{seen:?}");
    in_world_space(k, bits.colour(), k, q, bits.vector(), l, v);
}

/// The lecture's equation: unlike a lobe it has no rule for infinities.
fn in_world_space(ka: Rgb, kd: Rgb, ks: Rgb, q: Shininess, n: Vec3, l: Vec3, v: Vec3) -> [Rgb; 3] {
    let diffuse = illumination::Diffuse { ka, kd }.reflected(n, l);
    let phong = illumination::Phong { ka, kd, ks, q }.reflected(n, l, v);
    let torrance = illumination::BlinnTorrance { ka, kd, ks, q }.reflected(n, l, v);
    let has_nan = |v: Vec3| components(v).iter().any(|c| c.is_nan());
    for f in [diffuse, phong, torrance] {
        if has_nan(n) || has_nan(l) {
            assert!(channels(f).iter().all(|c| c.is_nan()), "{f:?} at {n:?} {l:?} {v:?}");
        }
    }
    if has_nan(v) && n.dot(l) > 0.0 {
        for f in [phong, torrance] {
            assert!(channels(f).iter().all(|c| c.is_nan()), "{f:?} at {n:?} {l:?} {v:?}");
        }
    }
    [diffuse, phong, torrance]
}

/// Inside the domain.
fn inside(bits: &mut Bits<'_>) {
    let up = Vec3::new(0.0, 0.0, 1.0);
    let (k, q) = (bits.reflectance(), bits.shininess());
    let l = bits.direction(up);
    let v = bits.direction(l);
    for Entry { name, reciprocal, lobe } in every_lobe(k, q) {
        let (f, cos) = (lobe.eval(l, v), lobe.eval_cos(l, v));
        let what = (name, l, v, k, q, f, cos);
        if l.z <= 0.0 || v.z <= 0.0 {
            assert!([f, cos].map(channels).as_flattened().iter().all(|c| *c == 0.0), "{what:?}");
        }
        // Between opposite directions whose cosines are both subnormal the half vector is 0/0.
        if l.z.max(v.z) >= f32::MIN_POSITIVE || l.z.min(v.z) <= 0.0 {
            assert!(good(cos), "{what:?}");
        }
        // Below a cosine of 1e-20 nothing is promised of `eval`, and a highlight that is divided by the cosine has no
        // bound.
        if l.z.min(v.z) >= 1e-20 && reciprocal {
            assert!(good(f), "{what:?}");
        }
    }
    let seen = Mirror::new(k).reflect(v);
    let weight = if v.z > 0.0 { channels(k) } else { [0.0; 3] };
    assert_eq!(channels(seen.weight), weight);
    let n = bits.direction(l);
    let colour = bits.reflectance();
    for f in in_world_space(k, colour, k, q, n, l, v) {
        // Here too; in world space that is a light and a viewer that are opposite but for components of that size.
        let [x, y, z] = components(l + v).map(f32::abs);
        let size = x.max(y).max(z);
        if size == 0.0 || (size >= 1e-20 && n.dot(l + v).abs() >= 1e-20) {
            assert!(good(f), "{f:?} {k:?} {q:?} at {n:?} {l:?} {v:?}");
        }
    }
}

fuzz_target!(|input: &[u8]| {
    anywhere(&mut Bits(input));
    inside(&mut Bits(input));
});
