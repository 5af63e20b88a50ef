//! The microfacet models of the papers against the papers' formulas in cosines, and against what they claim.

mod common;

use common::directions;
use lobe::distribution::{Beckmann, Distribution, Ggx};
use lobe::fresnel::{Fresnel, Incidence, Schlick};
use lobe::masking::{SmithSeparable, VCavity};
use lobe::{Alpha, Blinn1977, Brdf, CookTorrance, Microfacet, Rgb, Vec3};
use std::f64::consts::PI;

type V = Vec3<f64>;

/// `min(1, 2 (n·h)(n·v)/(v·h), 2 (n·h)(n·l)/(v·h))`.
fn groove(l: V, v: V, h: V) -> f64 {
    let c = v.dot(h);
    (2.0 * h.z * v.z / c).min(2.0 * h.z * l.z / c).min(1.0)
}

fn schlick(f0: f64, cos: f64) -> f64 {
    f0 + (1.0 - f0) * (1.0 - cos).powi(5)
}

#[test]
fn cook_torrance_is_its_paper() {
    let (ks, f0) = (0.3, 0.1);
    for m in [0.05, 0.3, 0.8] {
        let lobe = CookTorrance::new(Rgb::splat(ks), Alpha(m), Schlick::new(Rgb::splat(f0)));
        for l in directions() {
            for v in directions() {
                let h = (l + v).normalize();
                let tan2 = (1.0 - h.z * h.z) / (h.z * h.z);
                let d = (-tan2 / (m * m)).exp() / (PI * m * m * h.z.powi(4));
                let f = ks * schlick(f0, v.dot(h)) * d * groove(l, v, h) / (PI * l.z * v.z);
                let ours = lobe.eval(l, v).g;
                // In cosines the paper's form loses digits that ours keeps; beyond exp(−100) ours is 0.
                assert!((ours - f).abs() <= 1e-9 * f + 1e-40, "{ours} {f} at {l:?} {v:?}");
                assert!((lobe.modern().eval(l, v).g * ks * 4.0 / PI - ours).abs() <= 1e-14 * ours);
            }
        }
    }
}

#[test]
fn blinn_1977_is_its_paper() {
    let (ks, f0, c) = (0.3, 0.1, 0.35_f64);
    let lobe = Blinn1977::new(Rgb::splat(ks), Ggx::new(Alpha(c)), Schlick::new(Rgb::splat(f0)));
    for l in directions() {
        for v in directions() {
            let h = (l + v).normalize();
            // His D₃.
            let d = (c * c / (h.z * h.z * (c * c - 1.0) + 1.0)).powi(2);
            let s = ks * d * groove(l, v, h) * schlick(f0, v.dot(h)) / v.z;
            let ours = lobe.eval_cos(l, v).g;
            assert!((ours / s - 1.0).abs() < 1e-11, "{ours} {s} at {l:?} {v:?}");
        }
    }
}

/// Without light from opposite directions, V-cavities mask more than nothing and less than all, and only that.
#[test]
fn v_cavities_end_where_they_say() {
    let lobe = Microfacet::new(Beckmann::new(Alpha(1.0_f32)), VCavity, Schlick::new(Rgb::splat(0.0_f32)));
    let at = |z: f32| lobe.eval(Vec3::new(1.0, 0.0, z), Vec3::new(-1.0, 0.0, z)).g;
    // D(n) V = 1/π · 1/(4 z²) as long as V is below 2¹⁰⁰, and never infinite.
    assert!((at(1e-10) * 4e-20 * core::f32::consts::PI - 1.0).abs() < 1e-5);
    assert!(at(1e-20).is_finite() && at(1e-20) > 3e29);
}

/// Ashikhmin, Premože and Shirley 2000, equation 10: `ρ = p(h) ⟨n·h⟩ F/(4 g(l) g(v))`, where `p` is a probability
/// density, `⟨n·h⟩` its mean cosine and `g(k) = ∫ max(0, k·h) p(h) dω`. Smith's separable masking is the same thing.
#[test]
fn ashikhmin_premoze_shirley_is_smith_separable() {
    let f0 = 0.2;
    for alpha in [0.3, 0.8] {
        let d = Ggx::new(Alpha(alpha));
        let lobe = Microfacet::new(d, SmithSeparable, Schlick::new(Rgb::splat(f0)));
        // Midpoints: the integrands are smooth but for the edge of max.
        let (n_mu, n_phi) = (2000, 400);
        let mut facets = Vec::new();
        for i in 0..n_mu {
            // tan θ = α √(u/(1 − u)) draws D cos θ evenly; u = 1 − t², because towards the horizon 1/cos θ grows.
            let t = (f64::from(i) + 0.5) / f64::from(n_mu);
            let tan2 = alpha * alpha * (1.0 - t * t) / (t * t);
            let cos = (1.0 + tan2).sqrt().recip();
            let sin = (1.0 - cos * cos).sqrt();
            for j in 0..n_phi {
                let phi = (f64::from(j) + 0.5) / f64::from(n_phi) * 2.0 * PI;
                facets.push((Vec3::new(sin * phi.cos(), sin * phi.sin(), cos), 2.0 * t / cos));
            }
        }
        // D dω is 1/cos of that measure; p is D over its integral.
        let total: f64 = facets.iter().map(|(_, w)| w).sum();
        let g = |k: V| facets.iter().map(|(h, w)| w * k.dot(*h).max(0.0)).sum::<f64>() / total;
        let mean = facets.iter().map(|(h, w)| w * h.z).sum::<f64>() / total;
        let integral = total / facets.len() as f64;
        for (l, v) in [(0.3, 1.2), (0.9, 0.1), (1.4, 1.3)] {
            let (l, v): (f64, f64) = (l, v);
            let l = Vec3::new(l.sin(), 0.0, l.cos());
            let v = Vec3::new(0.6 * v.sin(), -0.8 * v.sin(), v.cos());
            let h = (l + v).normalize();
            let incidence = Incidence::from_cos(l.dot(h));
            let fresnel = Schlick::new(Rgb::splat(f0)).fresnel(incidence).g;
            let rho = d.d(h) / integral * mean * fresnel / (4.0 * g(l) * g(v));
            let ours = lobe.eval(l, v).g;
            assert!((ours / rho - 1.0).abs() < 1e-5, "{ours} {rho}");
        }
    }
}
