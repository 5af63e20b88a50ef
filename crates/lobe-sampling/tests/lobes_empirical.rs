//! The lobes that were fitted, and He's.

mod common;

use common::cases::{self as checks, Case, VIEWS};
use lobe::{HeTorrance, Ior, LowMicrofacet, LowSmooth, Rgb, ShiftedGamma, ShiftedGammaChannel};

const A: Rgb<f64> = Rgb::new(160.0, 120.0, 90.0);

fn channel(ks: f64, alpha: f64, p: f64, k_ap: f64) -> ShiftedGammaChannel<f64> {
    ShiftedGammaChannel { ks, alpha, p, k_ap, f0: 0.9, f1: 0.1, lambda: 4.0, log2_c: -12.0, k: 14.0, theta0: 0.1 }
}

fn abc() -> Vec<Case> {
    let mut cases = Vec::new();
    for (b, c) in
        [(0.0, 0.0), (0.0, 2.0), (1e-8, 1.0), (3.0, 0.5), (3000.0, 1.0), (3148.8, 1.005975), (1e7, 0.0), (1e7, 3.0)]
    {
        cases.push(case!(1e-6, LowSmooth::new(A, b, c, Ior(1.5))));
        cases.push(case!(3e-6, LowMicrofacet::new(A, b, c, Ior(1.5))));
    }
    cases
}

fn covered() -> Vec<Case> {
    let mut cases = Vec::new();
    for (sigma, tau) in [(0.01, 0.1), (0.05, 20.0), (0.3, 3.0), (1.0, 1000.0), (100.0, 1000.0)] {
        cases.push(case!(1e-6, HeTorrance::new(Rgb::splat(1.0), Ior(1.7), sigma, tau)));
    }
    // Channels of widths as different as the fits of one material never have.
    let three = Rgb::new(channel(0.1, 0.0056, 0.17, 160.0), channel(0.3, 0.13, 0.24, 8.0), channel(0.2, 0.5, 0.4, 3.0));
    cases.push(case!(1e-6, ShiftedGamma::new(three)));
    cases
}

#[test]
fn samples_agree_with_quadrature() {
    // Of the functions that take long, half of the views.
    for case in abc().iter().chain(&covered()) {
        checks::agrees_with_quadrature(case, &[0.8, 0.03]);
    }
}

#[test]
fn weights_are_quotients_in_f32() {
    for case in abc().iter().chain(&covered()) {
        checks::weights_are_quotients_in_f32(case, &VIEWS);
    }
}

#[test]
fn the_ends_of_u_and_v_are_finite() {
    for case in abc().iter().chain(&covered()) {
        checks::ends_are_finite(case);
    }
}

#[test]
fn nan_shows_and_below_the_horizon_is_nothing() {
    for case in abc().iter().chain(&covered()) {
        checks::nan_and_horizon(case);
    }
}

/// Of the lobes whose density is another's: no direction has much more value than density.
#[test]
fn covered_lobes_have_bounded_weights() {
    for case in covered() {
        checks::weights_are_at_most(10.0, &case, &[1.0, 0.5, 0.1]);
    }
}
