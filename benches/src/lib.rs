//! The baselines: each lobe as a good engineer writes it with `glam` and `powf`, and the inputs that both versions get.
//!
//! A test holds each baseline to the same values as the lobe, so that the comparison stays honest.

pub mod plain;
pub mod plain_batches;
pub mod rounds;
pub mod slices;

use glam::Vec3;

/// `count` pairs of unit vectors in the local frame, most above the horizon, one in sixteen below, in an order that a
/// branch predictor cannot learn.
pub fn directions(count: usize) -> Vec<(Vec3, Vec3)> {
    directions_of(count, 0)
}

/// [`directions`] of another `seed`.
pub fn directions_of(count: usize, seed: u64) -> Vec<(Vec3, Vec3)> {
    let mut uniform = numbers(seed);
    let mut direction = move || {
        let (phi, z) = (uniform() * std::f32::consts::TAU, uniform());
        let z = if uniform() < 1.0 / 32.0 { -z } else { z };
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * phi.cos(), r * phi.sin(), z)
    };
    (0..count).map(|_| (direction(), direction())).collect()
}

/// Numbers of `[0, 1)`, evenly; other ones for another `seed`.
pub fn numbers(seed: u64) -> impl FnMut() -> f32 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64.wrapping_add(seed.wrapping_mul(0xd134_2543_de82_ef95));
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1u32 << 24) as f32
    }
}
