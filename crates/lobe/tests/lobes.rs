//! One registry of all lobes, and one suite that runs over it: whatever is promised in `Brdf`.

use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::{Black, BlinnPhong, Brdf, CommonNormalization, Lambert, Phong, Rgb, Shininess, Vec3};
use lobe_verify::strategies::{direction, pair_above, reflectance, shininess};
use proptest::prelude::*;
use proptest::strategy::ValueTree;

/// The unit roundoff of `f32`.
const U: f64 = 1.0 / 16_777_216.0;
/// The smallest normal number.
const TINY: f64 = f32::MIN_POSITIVE as f64;

struct Entry {
    name: &'static str,
    reciprocal: bool,
    f32: Box<dyn Brdf<f32>>,
    f64: Box<dyn Brdf<f64>>,
    /// The bound of `|δf/f|` in units of `U`, from `f64` values of `|ln(f/f_max)|` and `q (1/c − 1)`.
    bound: fn(Geometry) -> f64,
}

/// What the bounds depend on.
#[derive(Clone, Copy, Debug)]
struct Geometry {
    /// `|ln(f/f_max)|` of the half-vector lobe.
    half_vector: f64,
    /// `|ln(f/f_max)|` of the mirror lobe.
    mirror: f64,
    /// `q (1/(r·v) − 1)`.
    mirror_condition: f64,
}

impl Geometry {
    fn new(l: Vec3<f64>, v: Vec3<f64>, q: f64) -> Self {
        let s = l + v;
        let tan2 = (s.x * s.x + s.y * s.y) / (s.z * s.z);
        let d = Vec3::new(l.x + v.x, l.y + v.y, l.z - v.z);
        let c = (1.0 - 0.5 * d.dot(d)).max(0.0);
        let mirror = if c > 0.0 { -q * c.ln() } else { f64::INFINITY };
        // Where r·v is below 2⁻¹² its own relative error is no longer small, and the first-order bound ends.
        let condition = if c < 1.0 / 4096.0 { f64::INFINITY } else { q * (1.0 / c - 1.0) };
        Self { half_vector: 0.5 * q * tan2.ln_1p(), mirror, mirror_condition: condition }
    }
}

/// Every lobe of the crate. A new one is added here, or `every_lobe_is_registered` fails.
fn registry(k: [f32; 3], q: f32) -> Vec<Entry> {
    fn entry<A: Brdf<f32> + 'static, B: Brdf<f64> + 'static>(
        name: &'static str,
        reciprocal: bool,
        f32: A,
        f64: B,
        bound: fn(Geometry) -> f64,
    ) -> Entry {
        Entry { name, reciprocal, f32: Box::new(f32), f64: Box::new(f64), bound }
    }
    let (k, q) = (Rgb::from(k), Shininess(q));
    let lambert = Lambert::new(k);
    let phong = Phong::new(k, q);
    let blinn = BlinnPhong::new(k, q);
    let common = BlinnPhong::<f32, CommonNormalization>::with_normalization(k, q);
    let mirror_highlight = PhongHighlight::new(k, q);
    let half_highlight = BlinnTorranceHighlight::new(k, q);
    let w = f64::from;
    vec![
        entry("Lambert", true, lambert, lambert.map(w), |_| 2.0),
        entry("Phong", true, phong, phong.map(w), |g| 7.0 + 5.0 * g.mirror_condition + 6.0 * g.mirror),
        entry("BlinnPhong", true, blinn, blinn.map(w), |g| 14.0 + 14.0 * g.half_vector),
        entry("BlinnPhong<Common>", true, common, common.map(w), |g| 14.0 + 14.0 * g.half_vector),
        entry("PhongHighlight", false, mirror_highlight, mirror_highlight.map(w), |g| {
            7.0 + 5.0 * g.mirror_condition + 6.0 * g.mirror
        }),
        entry("BlinnTorranceHighlight", false, half_highlight, half_highlight.map(w), |g| 14.0 + 14.0 * g.half_vector),
        entry("Sum", true, lambert + blinn, lambert.map(w) + blinn.map(w), |g| 15.0 + 14.0 * g.half_vector),
        entry("Black", true, Black, Black, |_| 0.0),
    ]
}

/// The types that `brdf/mod.rs` and `illumination.rs` implement `Brdf` for, read from the source.
#[test]
fn every_lobe_is_registered() {
    let sources = ["src/brdf", "src"].map(|folder| format!("{}/{folder}", env!("CARGO_MANIFEST_DIR")));
    let names: Vec<_> = registry([0.5; 3], 10.0).iter().map(|e| e.name).collect();
    // The models of the catalogue have a suite there that runs over all of them.
    let families = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../lobe-models/src/families")).unwrap();
    let catalogue: String = families.map(|f| std::fs::read_to_string(f.unwrap().path()).unwrap()).collect();
    let registered = |lobe: &str| {
        let mut words = catalogue.split(|c: char| !c.is_alphanumeric());
        names.contains(&lobe) || words.any(|word| word == lobe)
    };
    let mut found = 0;
    for file in sources.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap()) {
        let path = file.unwrap().path();
        if path.extension().is_none_or(|e| e != "rs") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        for (i, _) in text.match_indices("Brdf<R> for ") {
            let lobe: String = text[i + 12..].chars().take_while(|c| c.is_alphanumeric()).collect();
            // `&B` and the `$name` of a macro.
            if !lobe.is_empty() {
                found += 1;
                assert!(registered(&lobe), "{lobe} of {} is not in the registry", path.display());
            }
        }
        // The two that a macro writes.
        for line in text.lines().filter(|line| line.ends_with("_lobe") && line.contains(", power::")) {
            let lobe = line.split(',').next().unwrap_or_default().trim();
            found += 1;
            assert!(names.contains(&lobe), "{lobe} of {} is not in the registry", path.display());
        }
    }
    assert!(found >= 7, "only {found} implementations found: has the layout changed?");
}

fn channels(c: Rgb) -> [f32; 3] {
    c.into()
}

fn wide(v: Vec3) -> Vec3<f64> {
    v.map(f64::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4_000))]

    #[test]
    fn finite_and_not_negative((l, v) in pair_above(), k in reflectance(), q in shininess()) {
        for e in registry(k, q) {
            for (what, f) in [("eval", e.f32.eval(l, v)), ("eval_cos", e.f32.eval_cos(l, v))] {
                // The lecture's highlight divides by the cosine: towards the horizon `eval` has no bound, and for a
                // cosine below 1e-38 times the value it honestly leaves the range.
                if e.reciprocal || what == "eval_cos" {
                    prop_assert!(channels(f).iter().all(|c| c.is_finite() && *c >= 0.0), "{} {what}: {f:?}", e.name);
                }
            }
        }
    }

    #[test]
    fn finite_to_the_last_float(bits in (1_u32..0x3f80_0000, 1_u32..0x3f80_0000), k in reflectance(), q in shininess()) {
        let grazing = |b: u32, x: f32| Vec3::new(x, 0.0, f32::from_bits(b));
        for (l, v) in [(grazing(bits.0, 1.0), grazing(bits.1, 1.0)), (grazing(bits.0, 1.0), grazing(bits.1, -1.0))] {
            for e in registry(k, q) {
                let f = e.f32.eval_cos(l, v);
                prop_assert!(channels(f).iter().all(|c| c.is_finite() && *c >= 0.0), "{}: {f:?} at {l:?} {v:?}", e.name);
            }
        }
    }

    #[test]
    fn reciprocal_to_the_last_bit((l, v) in pair_above(), k in reflectance(), q in shininess()) {
        for e in registry(k, q).iter().filter(|e| e.reciprocal) {
            let (a, b) = (e.f32.eval(l, v), e.f32.eval(v, l));
            prop_assert_eq!(channels(a).map(f32::to_bits), channels(b).map(f32::to_bits), "{}", e.name);
        }
    }

    #[test]
    fn zero_below_the_horizon(below in direction(), other in direction(), k in reflectance(), q in shininess(), light in any::<bool>()) {
        let below = Vec3::new(below.x, below.y, -below.z.abs());
        let (l, v) = if light { (below, other) } else { (other, below) };
        for e in registry(k, q) {
            prop_assert_eq!(channels(e.f32.eval(l, v)), [0.0; 3], "{}", e.name);
            prop_assert_eq!(channels(e.f32.eval_cos(l, v)), [0.0; 3], "{}", e.name);
        }
    }

    #[test]
    fn nan_in_nan_out(
        l in direction(), v in direction(), k in reflectance(), q in shininess(),
        which in 0..6_usize, poison in prop_oneof![Just(f32::NAN), Just(f32::INFINITY), Just(f32::NEG_INFINITY)],
    ) {
        let mut all = [l.x, l.y, l.z, v.x, v.y, v.z];
        all[which] = poison;
        let (l, v) = (Vec3::new(all[0], all[1], all[2]), Vec3::new(all[3], all[4], all[5]));
        for e in registry(k, q) {
            for f in [e.f32.eval(l, v), e.f32.eval_cos(l, v)] {
                prop_assert!(channels(f).iter().all(|c| c.is_nan()), "{}: {f:?} at {l:?} {v:?}", e.name);
            }
            for f in [e.f64.eval(wide(l), wide(v)), e.f64.eval_cos(wide(l), wide(v))] {
                prop_assert!([f.r, f.g, f.b].iter().all(|c| c.is_nan()), "{} in f64: {f:?}", e.name);
            }
        }
    }

    #[test]
    fn nan_parameters_show((l, v) in pair_above(), q in shininess()) {
        for e in registry([f32::NAN, 0.5, 0.5], q).iter().filter(|e| e.name != "Black") {
            prop_assert!(e.f32.eval(l, v).r.is_nan(), "{}", e.name);
        }
        for e in registry([0.5; 3], f32::NAN).iter().filter(|e| !["Black", "Lambert"].contains(&e.name)) {
            // The mirror lobe is 0 behind its right angle, whatever its exponent.
            let f = e.f32.eval(l, v);
            prop_assert!(f.r.is_nan() || (f.r == 0.0 && e.name.starts_with("Phong")), "{} {f:?}", e.name);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30_000))]

    /// The promise of `docs/numerics.md`: the error grows with how far down the lobe the value is, not with `q`.
    #[test]
    fn equal_to_f64_within_the_bound((l, v) in pair_above(), k in reflectance(), q in shininess()) {
        let geometry = Geometry::new(wide(l), wide(v), f64::from(q));
        for e in registry(k, q) {
            for part in part_of_the_bound(&e, l, v, geometry, q) {
                prop_assert!(part <= 1.0, "{}: {part:.2} of the bound", e.name);
            }
        }
    }

    /// A sharp lobe met where it is visible: this is where a rounded cosine has no digit left.
    #[test]
    fn sharp_lobes_keep_their_digits(theta in 0.0_f32..1.4, q in 1e4_f32..1e6) {
        let v = Vec3::new(theta.sin(), 0.0, theta.cos());
        let l = Vec3::new(-v.x, -v.y, v.z);
        let l = Vec3::new(l.x + 1e-3 / q.sqrt(), l.y, l.z);
        for lobe in [&BlinnPhong::new(Rgb::splat(1.0), Shininess(q)) as &dyn Brdf<f32>, &Phong::new(Rgb::splat(1.0), Shininess(q))] {
            let peak = lobe.eval(Vec3::new(-v.x, -v.y, v.z), v).g;
            let f = lobe.eval(l, v).g;
            prop_assert!(f > 0.99 * peak && f <= 1.00001 * peak, "{f} of {peak}");
        }
    }

    #[test]
    fn eval_cos_is_eval_times_the_cosine((l, v) in pair_above(), k in reflectance(), q in shininess()) {
        for e in registry(k, q) {
            let (f, c) = (e.f64.eval(wide(l), wide(v)), e.f64.eval_cos(wide(l), wide(v)));
            let exact = f.g * f64::from(l.z);
            prop_assert!((c.g - exact).abs() <= 4.0 * f64::EPSILON * exact + 1e-300, "{}: {} {exact}", e.name, c.g);
        }
    }
}

/// The error of each channel as a part of the bound; 0 where the bound says nothing.
fn part_of_the_bound(e: &Entry, l: Vec3, v: Vec3, geometry: Geometry, q: f32) -> [f64; 3] {
    // The lecture's highlights are defined by their `eval_cos`.
    let (a, b) = if e.reciprocal {
        (e.f32.eval(l, v), e.f64.eval(wide(l), wide(v)))
    } else {
        (e.f32.eval_cos(l, v), e.f64.eval_cos(wide(l), wide(v)))
    };
    let bound = (e.bound)(geometry) * U;
    let [a, b] = [channels(a).map(f64::from), [b.r, b.g, b.b]];
    std::array::from_fn(|i| {
        // A power below 2^-126 is 0: then f is below peak · 2^-126, and the peak below q + 1.
        let error = (a[i] - b[i]).abs() - TINY * (2.0 + f64::from(q));
        // A bound that is no longer small says nothing.
        if error <= 0.0 || bound > 0.1 { 0.0 } else { error / (b[i] * bound) }
    })
}

/// A bound that nothing comes near would hold for a wrong formula too.
#[test]
fn the_bounds_are_not_idle() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut reached = std::collections::BTreeMap::new();
    for _ in 0..60_000 {
        let tree = (pair_above(), reflectance(), shininess()).new_tree(&mut runner).unwrap();
        let ((l, v), k, q) = tree.current();
        let geometry = Geometry::new(wide(l), wide(v), f64::from(q));
        for e in registry(k, q) {
            let worst: &mut f64 = reached.entry(e.name).or_default();
            *worst = part_of_the_bound(&e, l, v, geometry, q).into_iter().fold(*worst, f64::max);
        }
    }
    println!("worst error as a part of the bound: {reached:.2?}");
    for (name, part) in reached {
        assert!(name == "Black" || (0.2..=1.0).contains(&part), "{name}: {part}");
    }
}

/// The closed forms, at the peak and one step beside it.
#[test]
fn the_closed_forms() {
    use std::f32::consts::{FRAC_1_PI, PI, TAU};
    let (up, k) = (Vec3::new(0.0, 0.0, 1.0), Rgb::splat(0.5_f32));
    let near = |a: f32, b: f32| assert!((a - b).abs() <= 4e-7 * b.abs(), "{a} {b}");
    for q in [0.0_f32, 1.0, 2.0, 50.0, 1e6] {
        let s = Shininess(q);
        near(Phong::new(k, s).eval(up, up).g, 0.5 * (q + 2.0) / TAU);
        near(BlinnPhong::new(k, s).eval(up, up).g, 0.5 * (q + 2.0) * (q + 4.0) / (8.0 * PI * ((-q / 2.0).exp2() + q)));
        near(
            BlinnPhong::<f32, CommonNormalization>::with_normalization(k, s).eval(up, up).g,
            0.5 * (q + 8.0) / (8.0 * PI),
        );
        near(PhongHighlight::new(k, s).eval_cos(up, up).g, 0.5 * FRAC_1_PI);
    }
    // h is 30° from the normal, r·v = cos 60°.
    let tilted = Vec3::new(0.75_f32.sqrt(), 0.0, 0.5);
    near(Phong::new(k, Shininess(3.0)).eval(tilted, up).g, 0.5 * 5.0 / TAU * 0.125);
    near(BlinnTorranceHighlight::new(k, Shininess(2.0)).eval_cos(up, tilted).g, 0.5 * FRAC_1_PI * 0.75);
    // q = 0: the half-vector lobe is Lambert's, the mirror lobe ends at a right angle.
    near(BlinnPhong::new(k, Shininess(0.0)).eval(tilted, up).g, 0.5 * FRAC_1_PI);
    let behind = Vec3::new(0.8, 0.0, 0.6);
    assert_eq!(Phong::new(k, Shininess(0.0)).eval(behind, behind).g, 0.0);
}

/// What `Real::SCALE` is for: without it the squares of a grazing cosine underflow.
#[test]
fn grazing_needs_the_scale() {
    let (l, v) = (Vec3::new(1.0_f32, 0.0, 1e-20), Vec3::new(0.8_f32, 0.6, 1e-20));
    let f = BlinnPhong::new(Rgb::splat(1.0), Shininess(1.0)).eval(l, v).g;
    let exact = BlinnPhong::new(Rgb::splat(1.0), Shininess(1.0)).eval(wide(l), wide(v)).g;
    assert!((f64::from(f) / exact - 1.0).abs() < 1e-5, "{f:e} {exact:e}");
    // The formula without the scale: z² = 4e-40 has lost a third of its digits, and the quotient overflows.
    let s = l + v;
    let naive = (1.0 + (s.x * s.x + s.y * s.y) / (s.z * s.z)).log2();
    assert!(naive.is_infinite());
}

/// The lecture's highlights are not reciprocal; the size of the defect is the ratio of the cosines.
#[test]
fn the_lecture_is_not_reciprocal() {
    let (l, v) = (Vec3::new(0.6_f64, 0.0, 0.8), Vec3::new(-0.8, 0.0, 0.6));
    let highlight = PhongHighlight::new(Rgb::splat(1.0), Shininess(5.0));
    let ratio = highlight.eval(l, v).g / highlight.eval(v, l).g;
    assert!((ratio - 0.6 / 0.8).abs() < 1e-12, "{ratio}");
}
