//! What the published maps between parameters preserve.

use lobe::distribution::{Distribution, Ggx};
use lobe::fresnel::{Fresnel, Incidence, metals};
use lobe::{Alpha, PerceptualRoughness, Shininess, Vec3};
use std::f64::consts::PI;

fn at(theta: f64) -> Vec3<f64> {
    Vec3::new(theta.sin(), 0.0, theta.cos())
}

/// The Blinn-Phong distribution as it stands in Walter et al. 2007, equation 30.
fn blinn(q: f64, theta: f64) -> f64 {
    (q + 2.0) / (2.0 * PI) * theta.cos().powf(q)
}

const WIDTHS: [f64; 6] = [0.002, 0.01, 0.1, 0.3, 0.6, 0.8];

#[test]
fn the_peak_is_preserved() {
    for alpha in WIDTHS {
        let q = Shininess::with_peak_of(Alpha(alpha));
        assert!((blinn(q.0, 0.0) * PI * alpha * alpha - 1.0).abs() < 1e-12);
        assert!((blinn(q.0, 0.0) / Ggx::new(Alpha(alpha)).d(at(0.0)) - 1.0).abs() < 1e-12);
        assert!((Alpha::with_peak_of(q).0 / alpha - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_variance_of_slopes_is_preserved() {
    for alpha in WIDTHS {
        let q = Shininess::with_slope_variance_of(Alpha(alpha));
        // ∫ D tan²θ cosθ dω by the midpoint rule over tan θ, where the lobe is wide everywhere.
        let (steps, end) = (200_000, 400.0 * alpha);
        let mut variance = 0.0;
        for i in 0..steps {
            let w = (f64::from(i) + 0.5) / f64::from(steps);
            // tan θ = end w³: dense at the peak.
            let (slope, slope_step) = (end * w.powi(3), 3.0 * end * w * w / f64::from(steps));
            let theta = slope.atan();
            variance += 2.0 * PI * blinn(q.0, theta) * slope.powi(3) * theta.cos().powi(4) * slope_step;
        }
        assert!((variance / (alpha * alpha) - 1.0).abs() < 2e-3, "{alpha}: {variance}");
        assert!((Alpha::with_slope_variance_of(q).0 / alpha - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_half_width_of_ggx_is_preserved() {
    for alpha in WIDTHS {
        let q = Shininess::with_half_width_of_ggx(Alpha(alpha));
        let theta = 2f64.powf(-1.0 / q.0).acos();
        let ggx = Ggx::new(Alpha(alpha));
        assert!((ggx.d(at(theta)) / ggx.d(at(0.0)) - 0.5).abs() < 1e-6, "{alpha}");
        assert!((Alpha::ggx_with_half_width_of(q).0 / alpha - 1.0).abs() < 1e-7, "{alpha}");
    }
}

#[test]
fn roughness_is_the_root_of_the_width() {
    assert_eq!(PerceptualRoughness(0.5_f32).alpha(), Alpha(0.25));
    assert_eq!(PerceptualRoughness::from_alpha(Alpha(0.25_f32)), PerceptualRoughness(0.5));
    // Disney: isotropic without anisotropy, an aspect of 1/√0.1 squared = 10 with all of it, at least 0.001.
    assert_eq!(PerceptualRoughness(0.5_f32).disney(0.0), (Alpha(0.25), Alpha(0.25)));
    let (x, y) = PerceptualRoughness(0.4_f64).disney(1.0);
    assert!((x.0 / y.0 - 10.0).abs() < 1e-12 && (x.0 * y.0 - 0.4_f64.powi(4)).abs() < 1e-15);
    assert_eq!(PerceptualRoughness(0.0_f32).disney(0.7), (Alpha(0.001), Alpha(0.001)));
}

/// Reflectances at normal incidence against linear sRGB colours that were published for the same metals, from other
/// measurements and an integration over the spectrum: Lagarde, "Feeding a Physically Based Shading Model", 2011; Hoffman,
/// "Background: Physics and Math of Shading", 2013. Measurements of the same metal differ by some percent.
#[test]
fn metals_have_their_colours() {
    let published = [
        ("gold", [1.0, 0.766, 0.336]),
        ("silver", [0.972, 0.960, 0.915]),
        ("copper", [0.955, 0.638, 0.538]),
        ("aluminium", [0.913, 0.922, 0.924]),
        ("iron", [0.562, 0.565, 0.578]),
        ("titanium", [0.542, 0.497, 0.449]),
        ("chromium", [0.550, 0.556, 0.554]),
        ("nickel", [0.660, 0.609, 0.526]),
        ("platinum", [0.673, 0.637, 0.585]),
    ];
    for (name, colour) in published {
        let metal = metals::METALS.iter().find(|metal| metal.name == name).expect("there is one");
        let f0 = metal.conductor(1.0_f64).fresnel(Incidence::from_cos(1.0));
        for (value, expected) in <[f64; 3]>::from(f0).into_iter().zip(colour) {
            assert!((value - expected).abs() < 0.1, "{name}: {value:.3}, published {expected}");
        }
    }
}
