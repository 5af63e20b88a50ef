//! Quadrature over the slopes: against closed forms, against the other quadrature, and against the definition of masking.

use lobe::distribution::{Beckmann, Gaussian, Ggx, GgxAnisotropic, Gtr, PhongPower, SmithTable, StudentT, Tabulated};
use lobe::fresnel::Schlick;
use lobe::masking::{
    Hammon, Implicit, Kelemen, Neumann, RationalBeckmann, SchlickGgx, SmithCorrelated, SmithSeparable, VCavity,
};
use lobe::{Alpha, Brdf, Lambert, Microfacet, Rgb, Vec3};
use lobe_energy::{
    average_albedo, directional_albedo, masking, microfacet_albedo, weak_white_furnace, weak_white_furnace_to,
};

const WIDTHS: [f64; 4] = [1e-4, 0.01, 0.3, 1.0];
const COSINES: [f64; 5] = [1e-6, 1e-3, 0.1, 0.6, 1.0];

fn at(mu: f64, azimuth: f64) -> Vec3<f64> {
    let sin = ((1.0 - mu) * (1.0 + mu)).sqrt();
    Vec3::new(sin * azimuth.cos(), sin * azimuth.sin(), mu)
}

fn white() -> Schlick<f64> {
    Schlick::new(Rgb::splat(1.0))
}

/// The albedo of a white GGX with `α = 1` along the normal is `1 − ln 2`: `D = 1/π`, and `G` of the reflected direction
/// `2 c/(1 + c)` with its cosine `c`.
#[test]
fn the_closed_form_of_the_roughest_holds() {
    let lobe = Microfacet::new(Ggx::new(Alpha(1.0)), SmithCorrelated, white());
    let albedo = microfacet_albedo(&lobe, (Alpha(1.0), Alpha(1.0)), at(1.0, 0.0));
    assert!((albedo.value.g - (1.0 - 2.0_f64.ln())).abs() < 1e-12, "{albedo:?}");
}

/// Masking is defined by it: Smith's and that of V-cavities see exactly the surface.
#[test]
fn the_weak_white_furnace_is_white_where_the_masking_is_right() {
    for alpha in WIDTHS.map(Alpha) {
        let widths = (alpha, alpha);
        let (ggx, beckmann) = (Ggx::new(alpha), Beckmann::new(alpha));
        for mu in COSINES {
            let v = at(mu, 0.3);
            let found = [
                ("ggx, correlated", weak_white_furnace(&ggx, &SmithCorrelated, widths, v)),
                ("ggx, separable", weak_white_furnace(&ggx, &SmithSeparable, widths, v)),
                ("ggx, V-cavities", weak_white_furnace(&ggx, &VCavity, widths, v)),
                ("beckmann", weak_white_furnace(&beckmann, &SmithCorrelated, widths, v)),
            ];
            for (name, found) in found {
                let error = found.value.g - 1.0;
                assert!(error.abs() < 1e-6 && found.error < 1e-6, "{name} {alpha:?} {mu}: {error:e} {found:?}");
            }
        }
    }
    // Two widths, from any side.
    let (x, y) = (Alpha(0.8), Alpha(0.05));
    for (mu, azimuth) in [(0.02, 0.0), (0.02, 1.2), (0.4, 1.57), (0.9, 2.0)] {
        let found = weak_white_furnace(&GgxAnisotropic::new(x, y), &SmithCorrelated, (x, y), at(mu, azimuth));
        assert!((found.value.g - 1.0).abs() < 1e-6, "{mu} {azimuth}: {found:?}");
    }
}

/// Distributions whose Smith function is a table, and maskings that are approximations: off by as much as is said here.
#[test]
fn other_maskings_are_off_by_a_known_part() {
    let worst = |furnace: &dyn Fn(Alpha<f64>, Vec3<f64>) -> f64, widths: &[f64]| {
        let cases = widths.iter().flat_map(|&alpha| [0.05, 0.3, 1.0].map(|mu| (Alpha(alpha), at(mu, 0.0))));
        let errors: Vec<f64> = cases.map(|(alpha, v)| furnace(alpha, v) - 1.0).collect();
        (errors.iter().copied().fold(f64::INFINITY, f64::min), errors.iter().copied().fold(f64::NEG_INFINITY, f64::max))
    };
    macro_rules! furnace {
        ($d:expr, $g:expr) => {
            &|alpha: Alpha<f64>, v| weak_white_furnace(&$d(alpha), &$g(alpha), (alpha, alpha), v).value.g
        };
    }
    let widths = [0.1, 0.4, 1.0];
    // Name, found, at least, at most.
    let rows = [
        ("gtr 1.5", worst(furnace!(|a| table(Gtr::new(a, 1.5), a), |_| SmithCorrelated), &widths), -1e-6, 1e-6),
        ("student-t", worst(furnace!(|a| table(StudentT::new(a, 3.0), a), |_| SmithCorrelated), &widths), -1e-6, 1e-6),
        ("rational", worst(furnace!(Beckmann::new, RationalBeckmann::new), &widths), -4e-3, 4e-3),
        ("schlick", worst(furnace!(Ggx::new, SchlickGgx::half), &widths), -0.2, 1e-6),
        ("hammon", worst(furnace!(Ggx::new, Hammon::new), &widths), -0.2, 1e-6),
        ("implicit", worst(furnace!(Ggx::new, |_| Implicit), &widths), -1.0, 1e-6),
        ("neumann", worst(furnace!(Ggx::new, |_| Neumann), &widths), -1.0, 1e-6),
        ("kelemen", worst(furnace!(Ggx::new, |_| Kelemen), &widths), 0.5, 200.0),
    ];
    for (name, (low, high), least, most) in rows {
        println!("{name}: {low:.2e} to {high:.2e}");
        assert!(least <= low && high <= most, "{name}: {low:e} to {high:e}");
    }
}

/// Distributions without a closed `Λ`: with Smith's of a table a viewer sees exactly the surface, as far as the table
/// is right.
#[test]
fn the_furnace_of_tabulated_maskings_is_as_white_as_the_table_is_right() {
    for alpha in WIDTHS.map(Alpha) {
        for mu in [1e-3, 0.2, 1.0] {
            let (v, widths) = (at(mu, 0.3), (alpha, alpha));
            let blinn = weak_white_furnace(&table(PhongPower::new(alpha), alpha), &SmithCorrelated, widths, v);
            let gaussian = weak_white_furnace(&table(Gaussian::new(alpha), alpha), &SmithCorrelated, widths, v);
            for (name, found) in [("blinn", blinn), ("gaussian", gaussian)] {
                let error = (found.value.g - 1.0).abs();
                assert!(error < 5e-7 && found.error < 5e-7, "{name} {alpha:?} {mu}: {error:e} {found:?}");
            }
        }
    }
    // Of a drawn one the corners are what the table of Λ is wrong by: a Gaussian of 17° in steps of 1° and of 5°, a
    // ring at 30°, and a single peak of two steps of 5°.
    let bell = |i: usize, step: f64| (-0.09 * (i as f64 * step / 5.0).powi(2)).exp();
    let fine: [f64; 31] = core::array::from_fn(|i| bell(i, 3.0));
    let coarse: [f64; 19] = core::array::from_fn(|i| bell(i, 5.0));
    let ring: [f64; 19] = core::array::from_fn(|i| (-0.5 * (i as f64 - 6.0).powi(2)).exp());
    let peak: [f64; 19] = core::array::from_fn(|i| if i == 4 { 1.0 } else { 0.0 });
    // Name, what it is off by at the most, and what is allowed.
    let rows = [
        ("3°", off(&table(Tabulated::new(fine), Alpha(0.3)), 0.3), 2e-3),
        ("5°", off(&table(Tabulated::new(coarse), Alpha(0.3)), 0.3), 6e-3),
        ("ring", off(&table(Tabulated::new(ring), Alpha(0.5)), 0.5), 5e-2),
        ("peak", off(&table(Tabulated::new(peak), Alpha(0.4)), 0.4), 2.5e-2),
    ];
    for (name, error, most) in rows {
        println!("{name}: {error:.1e}");
        assert!(error < most, "{name}: {error:e}");
    }
}

/// The largest error of the furnace at grazing views, where it is.
fn off(d: &impl lobe::distribution::SmithLambda<f64>, alpha: f64) -> f64 {
    [0.02, 0.1].into_iter().fold(0.0, |worst: f64, mu| {
        let found = weak_white_furnace_to(2e-3, d, &SmithCorrelated, (Alpha(alpha), Alpha(alpha)), at(mu, 0.3));
        assert!(found.error < 2e-3, "{mu}: {found:?}");
        worst.max((found.value.g - 1.0).abs())
    })
}

fn table<D: lobe::distribution::Distribution<f64>>(d: D, alpha: Alpha<f64>) -> SmithTable<D, f64> {
    SmithTable::new(d, alpha)
}

/// The two quadratures have nothing in common but the rule: around the mirror direction, and over slopes.
#[test]
fn both_quadratures_agree_where_both_are_right() {
    for alpha in [0.1, 0.4, 1.0].map(Alpha) {
        for mu in [0.05, 0.4, 0.9] {
            let v = at(mu, 0.7);
            let lobes: [(&str, &dyn Brdf<f64>); 4] = [
                ("ggx", &Microfacet::new(Ggx::new(alpha), SmithCorrelated, white())),
                (
                    "coloured",
                    &Microfacet::new(Beckmann::new(alpha), SmithSeparable, Schlick::new(Rgb::new(0.9, 0.4, 0.04))),
                ),
                ("phong power", &Microfacet::new(PhongPower::new(alpha), Neumann, white())),
                ("lambert", &Lambert::new(Rgb::splat(0.7))),
            ];
            for (name, lobe) in lobes {
                let (a, b) = (microfacet_albedo(lobe, (alpha, alpha), v), directional_albedo(lobe, v));
                let [a_rgb, b_rgb] = [a.value, b.value].map(<[f64; 3]>::from);
                let error = (0..3).map(|i| (a_rgb[i] - b_rgb[i]).abs()).fold(0.0, f64::max);
                assert!(error <= 1e-6 + a.error + b.error, "{name} {alpha:?} {mu}: {a:?} {b:?}");
            }
        }
    }
    // Sharp lobes too, where the viewer is not near the horizon.
    for alpha in [1e-4, 1e-3].map(Alpha) {
        let lobe = Microfacet::new(Ggx::new(alpha), SmithCorrelated, white());
        let v = at(0.5, 0.0);
        let difference = microfacet_albedo(&lobe, (alpha, alpha), v).value.g - directional_albedo(&lobe, v).value.g;
        assert!(difference.abs() < 1e-9, "{alpha:?}: {difference:e}");
    }
}

/// With `α` and `μ` both small the albedo depends on their ratio alone, so a hundredth of both changes nothing.
#[test]
fn the_corner_is_met_to_its_end() {
    let albedo = |alpha: f64, mu: f64| {
        let lobe = Microfacet::new(Ggx::new(Alpha(alpha)), SmithCorrelated, white());
        microfacet_albedo(&lobe, (Alpha(alpha), Alpha(alpha)), at(mu, 0.0))
    };
    for ratio in [0.01, 0.3, 1.0, 3.0, 30.0] {
        let (coarse, fine) = (albedo(1e-3, 1e-3 * ratio), albedo(1e-4, 1e-4 * ratio));
        assert!(coarse.error < 1e-6 && fine.error < 1e-6);
        // The remainder is of the order of the square of the width.
        let error = (coarse.value.g - fine.value.g).abs();
        assert!(error < 1e-5 * (1.0 + ratio * ratio), "{ratio}: {coarse:?} {fine:?}");
    }
}

#[test]
fn from_below_nothing_is_seen() {
    let lobe = Microfacet::new(Ggx::new(Alpha(0.3)), SmithCorrelated, white());
    for v in [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.6, 0.0, -0.8)] {
        assert_eq!(microfacet_albedo(&lobe, (Alpha(0.3), Alpha(0.3)), v).value, Rgb::splat(0.0));
        let furnace = weak_white_furnace(&Ggx::new(Alpha(0.3)), &SmithCorrelated, (Alpha(0.3), Alpha(0.3)), v);
        assert_eq!(furnace.value, Rgb::splat(0.0));
    }
}

/// `G₁` that is read off a masking is the one of its papers.
#[test]
fn masking_is_read_off() {
    let (v, h) = (at(0.3, 0.0), at(0.9, 1.0));
    let ggx = Ggx::new(Alpha(0.4));
    let smith = lobe::distribution::SmithLambda::g1(&ggx, v);
    assert!((masking(&ggx, &SmithCorrelated, v, h) - smith).abs() < 1e-14);
    assert!((masking(&ggx, &SmithSeparable, v, h) - smith).abs() < 1e-14);
    let cavity = (2.0 * h.z * v.z / v.dot(h)).min(1.0);
    assert!((masking(&ggx, &VCavity, v, h) - cavity).abs() < 1e-14);
}

/// The mean of Lambert, and of Schlick's own term: `F0 + (1 − F0)/21` of a smooth mirror.
#[test]
fn means_have_closed_forms() {
    let mean = average_albedo(|mu| directional_albedo(&Lambert::new(Rgb::splat(0.7)), at(mu, 0.0)));
    assert!((mean.value.g - 0.7).abs() < 1e-7, "{mean:?}");
    let alpha = Alpha(1e-4);
    let lobe = Microfacet::new(Ggx::new(alpha), SmithCorrelated, Schlick::new(Rgb::splat(0.3)));
    let mean = average_albedo(|mu| microfacet_albedo(&lobe, (alpha, alpha), at(mu, 0.0)));
    assert!((mean.value.g - (0.3 + 0.7 / 21.0)).abs() < 1e-6, "{mean:?}");
}
