//! Diffuse lobes and sheen.

mod common;

use common::cases::{self as checks, Case, VIEWS};
use lobe::{
    Alpha, Brdf, BurleyDiffuse, Charlie, Eon, Lambert, OrenNayar, OrenNayarQualitative, PerceptualRoughness, Rgb,
};
use lobe_sampling::Sample;

const RHO: Rgb<f64> = Rgb::new(1.0, 0.7, 0.0);

fn cases() -> Vec<Case> {
    let mut cases = vec![case!(1e-6, Lambert::new(RHO))];
    for sigma in [0.0, 0.3, 0.6] {
        cases.push(case!(1e-6, OrenNayar::new(RHO, sigma)));
        cases.push(case!(1e-6, OrenNayarQualitative::new(RHO, sigma)));
    }
    for r in [0.0, 1e-6, 0.1, 0.5, 1.0] {
        cases.push(case!(1e-6, BurleyDiffuse::new(RHO, PerceptualRoughness(r))));
        cases.push(case!(1e-6, Eon::new(RHO, r)));
    }
    for alpha in [0.01, 0.06, 0.3, 1.0] {
        cases.push(case!(1e-6, Charlie::new(RHO, Alpha(alpha))));
    }
    cases
}

#[test]
fn samples_agree_with_quadrature() {
    for case in cases() {
        checks::agrees_with_quadrature(&case, &VIEWS);
    }
}

#[test]
fn weights_are_quotients_in_f32() {
    for case in cases() {
        checks::weights_are_quotients_in_f32(&case, &VIEWS);
    }
}

#[test]
fn the_ends_of_u_and_v_are_finite() {
    for case in cases() {
        checks::ends_are_finite(&case);
    }
}

#[test]
fn nan_shows_and_below_the_horizon_is_nothing() {
    for case in cases() {
        checks::nan_and_horizon(&case);
    }
}

/// Grazing light from behind: the transformed lobe is 0 there, and the weight would be infinite but for the even part.
#[test]
fn eon_has_light_where_its_lobe_has_none() {
    for r in [0.1, 1.0] {
        let lobe = case!(0.0, Eon::new(Rgb::splat(1.0), r));
        checks::weights_are_at_most(8.0, &lobe, &[1.0, 0.5, 0.1, 0.01]);
    }
}

/// At the normal the fit would cut the disc on the other side: a sample of the first would be below the horizon.
#[test]
fn eon_cuts_its_disc_on_the_right_side() {
    let sample = Eon::new(Rgb::splat(1.0), 1.0).sample(checks::view(1.0), [0.9, 1.0 - 1e-7, 0.0]);
    assert!(!sample.rejected, "{sample:?}");
}

/// What the transformed lobe is for: less variance than the cosine has.
#[test]
fn eon_varies_less_than_by_the_cosine() {
    let (lobe, chalk) = (Eon::new(Rgb::splat(1.0), 1.0), Lambert::new(Rgb::splat(1.0)));
    for z in [0.1, 0.5] {
        let v = checks::view(z);
        let square = |weight: &dyn Fn(u32) -> f64| (0..20_000).map(|i| weight(i).powi(2)).sum::<f64>() / 20_000.0;
        let own = square(&|i| lobe.sample(v, common::point(i)).weight.g) - 1.0;
        let cosine = square(&|i| {
            let l = chalk.sample(v, common::point(i)).l;
            lobe.eval(l, v).g * std::f64::consts::PI
        }) - 1.0;
        println!("n·v = {z}: variance {own:.3}, by the cosine {cosine:.3}");
        assert!(own < 0.7 * cosine, "{z}: {own}, by the cosine {cosine}");
    }
}

/// As the document of the guess says.
#[test]
fn the_guess_for_sheen_is_near() {
    for alpha in [0.06, 0.3, 1.0] {
        let sheen = Charlie::new(Rgb::splat(1.0), Alpha(alpha));
        for z in [0.01, 0.1, 0.3, 0.6, 1.0] {
            let v = checks::view(z);
            let (guess, exact) = (sheen.albedo_guess(v), lobe_energy::directional_albedo_to(1e-3, &sheen, v).value.g);
            println!("{alpha} {z}: {guess:.3} for {exact:.3}");
            assert!((guess - exact).abs() < 0.25, "{alpha} {z}: {guess}, {exact}");
        }
    }
}
