//! The diffuse models against their papers' equations, their limits and their energy.

use lobe::{
    Alpha, Brdf, BurleyDiffuse, Charlie, Eon, Lambert, Minnaert, OrenNayar, OrenNayarQualitative, PerceptualRoughness,
    Rgb, Vec3,
};
use lobe_energy::directional_albedo;
use std::f64::consts::{FRAC_1_PI, PI};

const WHITE: Rgb<f64> = Rgb::splat(1.0);

fn at(theta: f64, phi: f64) -> Vec3<f64> {
    Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos())
}

/// Pairs of directions, with their angles to the normal and the azimuth between them.
fn pairs() -> impl Iterator<Item = (Vec3<f64>, Vec3<f64>, [f64; 3])> {
    let angles = [0.01, 0.2, 0.7, 1.0, 1.3, 1.5];
    let azimuths = [0.0, 0.4, 1.2, 1.9, 3.0, PI];
    angles.into_iter().flat_map(move |a| {
        angles
            .into_iter()
            .flat_map(move |b| azimuths.into_iter().map(move |phi| (at(a, 0.3), at(b, 0.3 + phi), [a, b, phi])))
    })
}

fn close(value: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((value - expected).abs() <= tolerance * expected.abs(), "{what}: {value}, not {expected}");
}

/// The equations of the paper, by angles.
#[test]
fn oren_nayar_is_the_paper_s() {
    for sigma in [0.05, 0.3, 0.6] {
        let (rho, s2) = (0.8, sigma * sigma);
        let full = OrenNayar::new(Rgb::splat(rho), sigma);
        let short = OrenNayarQualitative::new(Rgb::splat(rho), sigma);
        for (l, v, [theta_l, theta_v, phi]) in pairs() {
            let (alpha, beta, cos) = (theta_l.max(theta_v), theta_l.min(theta_v), phi.cos());
            let (c1, rough) = (1.0 - 0.5 * s2 / (s2 + 0.33), s2 / (s2 + 0.09));
            let c2 = 0.45 * rough * (alpha.sin() - if cos < 0.0 { (2.0 * beta / PI).powi(3) } else { 0.0 });
            let c3 = 0.125 * rough * (4.0 * alpha * beta / (PI * PI)).powi(2);
            let once = c1 + cos * c2 * beta.tan() + (1.0 - cos.abs()) * c3 * ((alpha + beta) / 2.0).tan();
            let twice = 0.17 * s2 / (s2 + 0.13) * (1.0 - cos * (2.0 * beta / PI).powi(2));
            let expected = (rho * once + rho * rho * twice) / PI;
            close(full.eval(l, v).g, expected, 1e-11, "full");
            let expected = rho / PI * (c1 + 0.45 * rough * cos.max(0.0) * alpha.sin() * beta.tan());
            close(short.eval(l, v).g, expected, 1e-11, "qualitative");
        }
    }
}

/// Without roughness all are Lambert's.
#[test]
fn smooth_is_lambert() {
    let lambert = Lambert::new(Rgb::splat(0.6));
    let models: [&dyn Brdf<f64>; 4] = [
        &OrenNayar::new(Rgb::splat(0.6), 0.0),
        &OrenNayarQualitative::new(Rgb::splat(0.6), 0.0),
        &Eon::new(Rgb::splat(0.6), 0.0),
        &Minnaert::new(Rgb::splat(0.6), 1.0),
    ];
    for (number, model) in models.into_iter().enumerate() {
        for (l, v, _) in pairs() {
            close(model.eval(l, v).g, lambert.eval(l, v).g, 1e-14, &format!("{number}"));
        }
    }
}

/// At the normal there is no azimuth, and the model needs none; without the guard it would be 0/0.
#[test]
fn the_normal_has_no_azimuth() {
    let sigma = 0.4_f32;
    let (c1, s2) = (1.0 - 0.5 * 0.16 / 0.49, 0.16);
    let expected = (c1 + 0.17 * s2 / (s2 + 0.13)) / PI;
    let up = Vec3::new(0.0_f32, 0.0, 1.0);
    let model = OrenNayar::new(Rgb::splat(1.0), sigma);
    for v in [up, Vec3::new(0.6, 0.0, 0.8), Vec3::new(1e-20, 0.0, 1.0)] {
        let f = f64::from(model.eval(up, v).g);
        close(f, expected, 1e-6, &format!("{v:?}"));
        close(f64::from(model.eval(v, up).g), expected, 1e-6, &format!("{v:?}"));
    }
}

/// Between grazing directions at a right angle the rounded product is noise: it must be exact.
#[test]
fn grazing_needs_exact_products() {
    let grazing = 1e-6_f32;
    let mut worst_naive = 0.0_f64;
    for i in 1..100 {
        let (sin, cos) = (i as f32 * 0.015).sin_cos();
        let (l, v) = (Vec3::new(cos, sin, grazing), Vec3::new(-sin, cos + 1e-7, grazing));
        let model = OrenNayarQualitative::new(Rgb::splat(1.0), 0.5);
        let exact = model.map(f64::from).eval(l.map(f64::from), v.map(f64::from)).g;
        close(f64::from(model.eval(l, v).g), exact, 4e-6, "exact products");
        let (a, b) = (1.0 - 0.5 * 0.25 / 0.58, 0.45 * 0.25 / 0.34);
        let naive = (a + b * f64::from((l.x * v.x + l.y * v.y).max(0.0)) / f64::from(grazing)) * FRAC_1_PI;
        worst_naive = worst_naive.max((naive / exact - 1.0).abs());
    }
    assert!(worst_naive > 1e-3, "{worst_naive}");
}

/// `E` of the first term, as the paper has it, by angles.
fn published_albedo(cos: f64, r: f64) -> f64 {
    let a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * r);
    let sin = (1.0 - cos * cos).sqrt();
    let g = sin * (cos.acos() - sin * cos) + 2.0 / 3.0 * (sin / cos * (1.0 - sin.powi(3)) - sin);
    a + a * r * g / PI
}

#[test]
fn eon_is_the_paper_s() {
    for r in [0.1, 0.5, 1.0] {
        let a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * r);
        let mean = a * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * r);
        let rho: f64 = 0.7;
        let model = Eon::new(Rgb::splat(rho), r);
        for (l, v, [theta_l, theta_v, phi]) in pairs() {
            let s = theta_l.sin() * theta_v.sin() * phi.cos();
            let t = if s > 0.0 { l.z.max(v.z) } else { 1.0 };
            let once = rho / PI * a * (1.0 + r * s / t);
            let rho_m = rho * rho * mean / (1.0 - rho * (1.0 - mean));
            let lost = (1.0 - published_albedo(l.z, r)) * (1.0 - published_albedo(v.z, r)) / (1.0 - mean);
            close(model.eval(l, v).g, once + rho_m / PI * lost, 1e-10, "EON");
        }
    }
}

#[test]
fn eon_preserves_energy() {
    for r in [0.0, 0.2, 0.6, 1.0] {
        for degrees in [0.0_f64, 20.0, 45.0, 70.0, 85.0, 89.0] {
            let v = at(degrees.to_radians(), 0.0);
            let white = directional_albedo(&Eon::new(WHITE, r), v);
            assert!((white.value.g - 1.0).abs() < 1e-6, "r = {r}, {degrees}°: {white:?}");
            // In colour, the closed form of the paper.
            let (rho, e) = (0.5_f64, published_albedo(v.z, r));
            let mean = (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * r) / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * r);
            let expected = rho * e + rho * rho * mean / (1.0 - rho * (1.0 - mean)) * (1.0 - e);
            let grey = directional_albedo(&Eon::new(Rgb::splat(rho), r), v);
            assert!((grey.value.g - expected).abs() < 1e-6, "r = {r}, {degrees}°: {grey:?} {expected}");
        }
    }
}

/// What the qualitative model loses, which EON gives back.
#[test]
fn oren_nayar_loses_energy() {
    let lost = |sigma| 1.0 - directional_albedo(&OrenNayarQualitative::new(WHITE, sigma), at(0.0, 0.0)).value.g;
    // At normal incidence s = 0: exactly 1 − A.
    assert!((lost(0.5) - 0.5 * 0.25 / 0.58).abs() < 1e-6, "{}", lost(0.5));
    assert!(lost(0.2) < lost(0.5) && lost(0.5) < lost(1.5));
}

/// Burley's two ends, section 5.3: grazing retroreflection is halved on each side for a smooth surface and 2.5-fold for a
/// rough one; at normal incidence the lobe is Lambert's.
#[test]
fn burley_at_his_ends() {
    let lobe = |r: f64| BurleyDiffuse::new(WHITE, PerceptualRoughness(r));
    let (grazing, up) = (at(PI / 2.0 - 1e-9, 0.0), at(0.0, 0.0));
    for (r, factor) in [(0.0, 0.5), (0.5, 1.5), (1.0, 2.5)] {
        close(lobe(r).eval(grazing, grazing).g * PI, factor * factor, 1e-7, "retroreflection");
        close(lobe(r).eval(up, up).g, FRAC_1_PI, 1e-15, "normal");
    }
    // It gains energy where it is rough, and how much is said in its documentation.
    let rough = directional_albedo(&lobe(1.0), at(1.4, 0.0)).value.g;
    assert!(rough > 1.0, "{rough}");
}

#[test]
fn minnaert_s_albedo_is_a_power() {
    for k in [0.3_f64, 1.0, 1.7] {
        for theta in [0.0_f64, 0.8, 1.4] {
            let albedo = directional_albedo(&Minnaert::new(Rgb::splat(0.5), k), at(theta, 0.0));
            close(albedo.value.g, 0.5 * theta.cos().powf(k - 1.0), 1e-5, &format!("{k} {theta}"));
        }
    }
}

/// `Λ` as the specification of `KHR_materials_sheen` has it.
fn published_lambda(cos: f64, alpha: f64) -> f64 {
    let weight = (1.0 - alpha).powi(2);
    let between = |rough: f64, fine: f64| rough * (1.0 - weight) + fine * weight;
    let (a, b) = (between(21.5473, 25.3245), between(3.82987, 3.32435));
    let (c, d, e) = (between(0.19823, 0.16801), between(-1.97760, -1.27393), between(-4.32054, -4.85967));
    let log = |x: f64| a / (1.0 + b * x.powf(c)) + d * x + e;
    if cos < 0.5 { log(cos).exp() } else { (2.0 * log(0.5) - log(1.0 - cos)).exp() }
}

#[test]
fn charlie_is_the_specification_s() {
    for alpha in [0.05, 0.3, 1.0] {
        let model = Charlie::new(WHITE, Alpha(alpha));
        for (l, v, _) in pairs() {
            let s = l + v;
            let sin2 = (s.x * s.x + s.y * s.y) / s.length_squared();
            let d = (2.0 + 1.0 / alpha) * sin2.powf(0.5 / alpha) / (2.0 * PI);
            let lambda = published_lambda(l.z, alpha) + published_lambda(v.z, alpha);
            let expected = d / ((1.0 + lambda) * 4.0 * l.z * v.z);
            let f = model.eval(l, v).g;
            // Where the half vector is the normal, both are rounding.
            assert!((f - expected).abs() <= 1e-9 * expected + 1e-15, "{alpha}: {f} {expected}");
            assert!((model.eval_cos(l, v).g - f * l.z).abs() <= 1e-12 * f * l.z);
        }
    }
}

/// `∫ D cosθ dω = 1`: with `l = v` the half vector is that direction, and `V` is known.
#[test]
fn charlie_s_distribution_is_normalised() {
    for alpha in [0.02, 0.2, 1.0] {
        let model = Charlie::new(WHITE, Alpha(alpha));
        let steps = 100_000;
        let sum: f64 = (0..steps)
            .map(|i| (f64::from(i) + 0.5) / f64::from(steps))
            .map(|cos| {
                let l = at(cos.acos(), 0.0);
                let d = model.eval(l, l).g * 4.0 * cos * cos * (1.0 + 2.0 * published_lambda(cos, alpha));
                2.0 * PI * d * cos
            })
            .sum();
        assert!((sum / f64::from(steps) - 1.0).abs() < 1e-5, "{alpha}: {}", sum / f64::from(steps));
    }
}
