//! Microfacet lobes: every distribution by every method that it has.

mod common;

use common::*;
use lobe::distribution::*;
use lobe::fresnel::{Conductor, Dielectric, Schlick};
use lobe::masking::{SmithCorrelated, SmithSeparable, VCavity};
use lobe::{Alpha, Blinn1977, CookTorrance, Ior, MetallicRoughness, Microfacet, Real, Rgb, TorranceSparrow};
use lobe_sampling::facets::{Bounded, ByDistribution, Caps, ProjectedDisc, VisibleSlopes};
use lobe_sampling::{ByCosine, SampleBy};

/// A bell with an empty step before a second, smaller one.
fn drawn<R: Real>(w: R) -> Tabulated<R, 16> {
    let values = [8.0, 6.5, 4.0, 2.0, 1.0, 0.5, 0.0, 0.0, 0.0, 0.2, 0.4, 0.2, 0.1, 0.0, 0.0, 0.0];
    Tabulated::new(values.map(|p| w.lift(p)))
}

/// All lobes with the widths `αx`, `αy`.
fn lobes<R: Real + 'static>(w: R, x: f64, y: f64) -> Vec<Named<R>> {
    let (ax, ay) = (Alpha(w.lift(x)), Alpha(w.lift(y)));
    let f = Schlick::new(Rgb::new(w.lift(0.9), w.lift(0.6), w.lift(0.3)));
    let metal = Conductor::new(Rgb::splat(w.lift(0.2)), Rgb::splat(w.lift(3.0)));
    let ggx = Microfacet::new(Ggx::anisotropic(ax, ay), SmithCorrelated, f);
    let beckmann = Microfacet::new(Beckmann::anisotropic(ax, ay), SmithCorrelated, metal);
    let ks = Rgb::splat(w.lift(0.5));
    let up = (f, VCavity);
    let mut lobes: Vec<Named<R>> = vec![
        ("ggx".into(), Box::new(ggx)),
        ("ggx, bounded".into(), Box::new(ggx.by(Bounded))),
        ("ggx, caps".into(), Box::new(ggx.by(Caps))),
        ("ggx, disc".into(), Box::new(ggx.by(ProjectedDisc))),
        ("ggx, by distribution".into(), Box::new(ggx.by(ByDistribution))),
        ("ggx, separable".into(), Box::new(Microfacet::new(Ggx::anisotropic(ax, ay), SmithSeparable, f))),
        ("ggx, cavities".into(), Box::new(Microfacet::new(Ggx::anisotropic(ax, ay), VCavity, f))),
        ("beckmann".into(), Box::new(beckmann)),
        ("beckmann, by distribution".into(), Box::new(beckmann.by(ByDistribution))),
        ("phong power".into(), Box::new(Microfacet::new(PhongPower::anisotropic(ax, ay), up.1, up.0))),
        ("torrance-sparrow".into(), Box::new(TorranceSparrow::new(Gaussian::anisotropic(ax, ay), VCavity, f))),
        ("blinn 1977".into(), Box::new(Blinn1977::new(ks, PhongPower::anisotropic(ax, ay), f))),
        ("blinn 1977, ggx".into(), Box::new(Blinn1977::new(ks, Ggx::anisotropic(ax, ay), f).by(Caps))),
    ];
    for gamma in [1.6, 2.0, 3.0, 40.0] {
        let d = StudentT::anisotropic(ax, ay, w.lift(gamma));
        lobes.push((format!("student-t {gamma}"), Box::new(Microfacet::new(d, VCavity, f))));
    }
    for gamma in [0.5, 1.0, 1.5, 2.0, 5.0] {
        let d = Gtr::anisotropic(ax, ay, w.lift(gamma));
        lobes.push((format!("gtr {gamma}"), Box::new(Microfacet::new(d, VCavity, f))));
    }
    if x == y {
        let plastic = Dielectric::new(Ior(w.lift(1.5)));
        let round = Microfacet::new(Ggx::new(ax), SmithCorrelated, plastic);
        lobes.push(("ggx, round".into(), Box::new(round)));
        lobes.push(("ggx, round, disc".into(), Box::new(round.by(ProjectedDisc))));
        let table = SmithTable::<_, R, 64>::new(PhongPower::new(ax), ax);
        lobes.push(("phong power, smith".into(), Box::new(Microfacet::new(table, SmithCorrelated, f))));
        lobes.push(("cook-torrance".into(), Box::new(CookTorrance::new(ks, ax, f))));
        lobes
            .push(("cook-torrance, by distribution".into(), Box::new(CookTorrance::new(ks, ax, f).by(ByDistribution))));
        for metallic in [0.0, 0.3, 1.0] {
            let base = Rgb::new(w.lift(0.7), w.lift(0.4), w.lift(0.1));
            let material = MetallicRoughness::new(base, w.lift(metallic), ax);
            lobes.push((format!("metallic {metallic}"), Box::new(material)));
            lobes.push((format!("metallic {metallic}, caps"), Box::new(material.by(Caps))));
        }
        let brushed = MetallicRoughness::new(ks, w.lift(0.5), ax).with_anisotropy(w.lift(0.5));
        lobes.push(("brushed".into(), Box::new(brushed)));
    }
    lobes
}

fn others<R: Real + 'static>(w: R) -> Vec<Named<R>> {
    let f = Schlick::new(Rgb::new(w.lift(0.9), w.lift(0.6), w.lift(0.3)));
    let ggx = Microfacet::new(Ggx::new(Alpha(w.lift(0.6))), SmithCorrelated, f);
    vec![
        ("tabulated".into(), Box::new(Microfacet::new(drawn(w), VCavity, f))),
        ("tabulated, smith".into(), {
            let table = SmithTable::<_, R, 64>::new(drawn(w), Alpha(w.lift(0.5)));
            Box::new(Microfacet::new(table, SmithSeparable, f))
        }),
        ("flat table".into(), Box::new(Microfacet::new(Tabulated::new([w.lift(3.0); 3]), VCavity, f))),
        ("ggx by cosine".into(), Box::new(ByCosine(ggx))),
    ]
}

const WIDTHS: [(f64, f64); 4] = [(0.15, 0.15), (0.5, 0.5), (1.0, 1.0), (0.8, 0.2)];

#[test]
fn densities_are_normalised() {
    let views = [at(1.0, 0.0), at(0.7, 0.4), at(0.2, 2.0)];
    for (name, lobe) in others(0.0) {
        for v in views {
            if name.starts_with("tabulated") {
                stepped_density_is_normalised(&name, &*lobe, v);
            } else {
                density_is_normalised(&name, &*lobe, v);
            }
        }
    }
    for (i, (x, y)) in WIDTHS.into_iter().enumerate() {
        // Each width of a lobe from another view, so that every lobe has all of them.
        for ((name, lobe), v) in lobes(0.0, x, y).into_iter().zip(views.into_iter().cycle().skip(i)) {
            density_is_normalised(&format!("{name} {x} {y}"), &*lobe, v);
        }
    }
}

#[test]
fn mean_weights_are_albedos() {
    let views = [at(0.9, 0.3), at(0.3, 2.0)];
    for (name, lobe) in others(0.0) {
        for v in views {
            weights_sum_to_the_albedo(&name, &*lobe, v);
        }
    }
    for (i, (x, y)) in WIDTHS.into_iter().enumerate() {
        for ((name, lobe), v) in lobes(0.0, x, y).into_iter().zip(views.into_iter().cycle().skip(i)) {
            weights_sum_to_the_albedo(&format!("{name} {x} {y}"), &*lobe, v);
        }
    }
}

/// Widths from the sharpest to the widest, and aspects to 16.
const ALL_WIDTHS: [(f64, f64); 9] = [
    (1e-4, 1e-4),
    (1e-3, 1e-3),
    (1e-2, 1e-2),
    (0.1, 0.1),
    (0.5, 0.5),
    (1.0, 1.0),
    (1e-4, 1.6e-3),
    (0.05, 0.8),
    (1.0, 0.0625),
];

#[test]
fn weights_and_densities_belong_to_the_samples() {
    for (name, lobe) in others(0.0_f64) {
        for cos in [1.0, 0.7, 0.1, 1e-3] {
            samples_are_consistent(&name, &*lobe, at(cos, 0.4), 1e-11);
        }
    }
    for (x, y) in ALL_WIDTHS {
        for (name, lobe) in lobes(0.0_f64, x, y) {
            for cos in [1.0, 0.7, 0.1, 1e-3, 1e-6] {
                samples_are_consistent(&format!("{name} {x} {y}"), &*lobe, at(cos, 0.4), 1e-11);
            }
        }
    }
}

/// The weights of `f32` against the quotient in `f64`.
#[test]
fn weights_in_single_precision() {
    let mut worst: std::collections::BTreeMap<String, f64> = Default::default();
    for (x, y) in ALL_WIDTHS {
        for ((name, lobe), (_, exact)) in lobes(0.0_f32, x, y).into_iter().zip(lobes(0.0_f64, x, y)) {
            for cos in [1.0, 0.7, 0.1, 1e-3, 1e-6] {
                let error = error_of_weight(&*lobe, &*exact, at(cos, 0.4));
                let worst = worst.entry(name.clone()).or_default();
                *worst = worst.max(error);
            }
        }
    }
    for (name, error) in &worst {
        println!("{name}: {error:.1e}");
    }
    for (name, error) in worst {
        assert!(error < 1e-4, "{name}: {error:e}");
    }
}

#[test]
fn the_ends_of_the_square_are_finite() {
    for (x, y) in [(1e-4, 1e-4), (1e-2, 1e-2), (1.0, 1.0), (1e-4, 1.6e-3), (1.0, 0.0625)] {
        for (name, lobe) in lobes(0.0_f32, x, y) {
            ends_are_finite(&format!("{name} {x} {y}"), &*lobe, 0.0);
        }
        for (name, lobe) in lobes(0.0_f64, x, y) {
            ends_are_finite(&format!("{name} {x} {y}"), &*lobe, 0.0);
        }
    }
    for (name, lobe) in others(0.0_f32) {
        ends_are_finite(&name, &*lobe, 0.0);
    }
}

#[test]
fn a_nan_shows_and_below_the_horizon_there_is_nothing() {
    for (x, y) in [(0.3, 0.3), (0.5, 0.1)] {
        for (name, lobe) in lobes(0.0_f32, x, y) {
            nan_shows_and_below_is_nothing(&name, &*lobe, 0.0);
        }
    }
    for (name, lobe) in others(0.0_f64) {
        nan_shows_and_below_is_nothing(&name, &*lobe, 0.0);
    }
}

/// What each method is for: of a rough surface the bounded one rejects least, and by the distribution alone weights
/// grow.
#[test]
fn methods_differ_as_they_should() {
    let white = Schlick::new(Rgb::splat(1.0));
    let lobe = Microfacet::new(Ggx::new(Alpha(0.5_f64)), SmithCorrelated, white);
    let v = at(0.3, 0.0);
    let rejected = |sampler: &dyn lobe_sampling::Sample<f64>| masses(sampler, v, 1 << 14)[1];
    let (bounded, caps, disc) = (rejected(&lobe), rejected(&lobe.by(Caps)), rejected(&lobe.by(ProjectedDisc)));
    assert!(bounded < 0.7 * caps && (caps - disc).abs() < 2e-3, "{bounded} {caps} {disc}");
    let largest = |sampler: &dyn lobe_sampling::Sample<f64>| {
        points(1 << 14).map(|u| sampler.sample(v, u).weight.g).fold(0.0, f64::max)
    };
    assert!(largest(&lobe.by(Caps)) <= 1.0 && largest(&lobe.by(ByDistribution)) > 2.0);
    let beckmann = Microfacet::new(Beckmann::new(Alpha(0.5_f64)), SmithCorrelated, white);
    let largest = largest(&beckmann.by(VisibleSlopes));
    assert!(largest <= 1.0 + 1e-15, "{largest}");
}
