//! What the fits of Ngan et al. 2005 call Blinn-Phong, settled by their other fits: see docs/materials.md.

#[path = "../examples/which_blinn_phong.rs"]
mod which;

#[test]
fn the_fitted_blinn_phong_is_a_half_vector_lobe_with_the_factor_of_the_mirror_lobe() {
    let evidence = which::evidence();
    assert!(evidence.len() > 80);
    let [exponent, mirror, common, none] =
        [0, 1, 2, 3].map(|index| which::quartiles(evidence.iter().map(|row| row[index]).collect()));
    // The half-vector lobe is at 1, a mirror lobe would be at 1/4.
    assert!(exponent[0] > 0.5 && exponent[1] < 2.0, "{exponent:?}");
    // With (q+2)/(2π) the peaks agree; with the others they are off by more than 2 for three quarters of them.
    assert!(mirror[0] > 0.8 && mirror[1] < 1.3 && mirror[2] < 1.6, "{mirror:?}");
    assert!(common[2] < 0.5 && none[2] < 0.5, "{common:?} {none:?}");
}
