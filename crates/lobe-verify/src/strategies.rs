//! `proptest` strategies that lean on the extremes: grazing and normal directions, `l = v`, `l ≈ −v`, lobes met at
//! their peak, tiny and large parameters.
//!
//! ```
//! use lobe::{Brdf, Lambert, Rgb};
//! use lobe_verify::strategies::pair_above;
//! use proptest::prelude::*;
//!
//! proptest!(|((l, v) in pair_above())| {
//!     let f = Lambert::new(Rgb::splat(0.5_f32)).eval(l, v);
//!     prop_assert!(f.g > 0.0);
//! });
//! ```

use lobe::Vec3;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A unit vector with the given cosine and azimuth, rounded to `f32`. A cosine too small to change the length is kept
/// to its last digit.
fn unit(z: f64, phi: f64) -> Vec3 {
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new((r * phi.cos()) as f32, (r * phi.sin()) as f32, z as f32)
}

/// A cosine in (0, 1]: even, grazing down to 1e-20, or so near to normal incidence that `1 − z` has no digit left.
pub fn cosine() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => 1e-6..1.0_f64,
        2 => (-20.0..0.0_f64).prop_map(|e| 10_f64.powf(e)),
        2 => (-16.0..0.0_f64).prop_map(|e| (1.0 - 0.5 * 10_f64.powf(e)).sqrt()),
        1 => Just(1.0),
        1 => Just(1e-20),
    ]
}

/// An azimuth, with a lean towards the axes.
pub fn azimuth() -> impl Strategy<Value = f64> {
    prop_oneof![3 => 0.0..TAU, 1 => (0..8_i32).prop_map(|i| f64::from(i) * TAU / 8.0)]
}

/// A direction above the horizon of the local frame, cosine from 1e-20 to 1.
pub fn above() -> impl Strategy<Value = Vec3> {
    (cosine(), azimuth()).prop_map(|(z, phi)| unit(z, phi))
}

/// Any direction: above, below, or exactly on the horizon.
pub fn direction() -> impl Strategy<Value = Vec3> {
    let signed = (above(), any::<bool>()).prop_map(|(d, up)| if up { d } else { Vec3::new(d.x, d.y, -d.z) });
    prop_oneof![9 => signed, 1 => azimuth().prop_map(|phi| unit(0.0, phi))]
}

/// Two directions above the horizon: independent, equal, near the mirror direction of each other (where the lobes
/// are), or nearly opposite.
pub fn pair_above() -> impl Strategy<Value = (Vec3, Vec3)> {
    let near_mirror = (cosine(), azimuth(), -8.0..0.0_f64, azimuth()).prop_map(|(z, phi, e, turn)| {
        let l = unit(z, phi);
        (l, nudged(Vec3::new(-l.x, -l.y, l.z), 10_f64.powf(e), turn))
    });
    let opposite = (-20.0..-1.0_f64, -20.0..-1.0_f64, azimuth(), -10.0..0.0_f64).prop_map(|(a, b, phi, turn)| {
        let apart = phi + TAU / 2.0 + 10_f64.powf(turn);
        (unit(10_f64.powf(a), phi), unit(10_f64.powf(b), apart))
    });
    prop_oneof![
        4 => (above(), above()),
        1 => above().prop_map(|l| (l, l)),
        1 => above().prop_map(|l| (l, Vec3::new(-l.x, -l.y, l.z))),
        4 => near_mirror,
        1 => opposite,
    ]
}

/// `d` moved by about `angle` and lifted above the horizon again.
fn nudged(d: Vec3, angle: f64, turn: f64) -> Vec3 {
    let [x, y, z] = <[f32; 3]>::from(d).map(f64::from);
    // Two directions orthogonal to d, in double precision.
    let r = x.hypot(y);
    let (cx, cy) = if r > 0.0 { (x / r, y / r) } else { (1.0, 0.0) };
    let (s, c) = (turn.sin() * angle, turn.cos() * angle);
    let moved = [x + c * cx * z - s * cy, y + c * cy * z + s * cx, z - c * r];
    let length = (moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]).sqrt();
    Vec3::new((moved[0] / length) as f32, (moved[1] / length) as f32, (moved[2] / length).abs().max(1e-20) as f32)
}

/// An exponent of a cosine lobe over its whole domain, [0, 10⁶].
pub fn shininess() -> impl Strategy<Value = f32> {
    prop_oneof![
        1 => Just(0.0_f32),
        1 => Just(1e6_f32),
        3 => 0.0_f32..100.0,
        5 => (-6.0_f64..6.0).prop_map(|e| 10_f64.powf(e) as f32),
    ]
}

/// A reflectance, [0, 1] per channel, with a lean towards the ends.
pub fn reflectance() -> impl Strategy<Value = [f32; 3]> {
    let channel = prop_oneof![4 => 0.0_f32..=1.0, 1 => Just(0.0), 1 => Just(1.0), 1 => Just(1e-6_f32)];
    proptest::array::uniform3(channel)
}

/// The smallest width that lobes are declared for.
const LEAST_ALPHA: f32 = 1e-4;

/// A width `α`, [1e-4, 1]: even over the orders of magnitude, and the ends.
pub fn alpha() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => (-4.0_f64..0.0).prop_map(|e| (10_f64.powf(e) as f32).clamp(LEAST_ALPHA, 1.0)),
        2 => 0.1_f32..=1.0,
        1 => Just(LEAST_ALPHA),
        1 => Just(1.0_f32),
    ]
}

/// Two widths, one along the tangent and one along the bitangent: equal, or up to 16 times apart.
pub fn alphas() -> impl Strategy<Value = (f32, f32)> {
    let other = (alpha(), -4.0_f64..4.0).prop_map(|(x, e)| {
        let y = (f64::from(x) * e.exp2()) as f32;
        (x, y.clamp(LEAST_ALPHA, 1.0))
    });
    prop_oneof![1 => alpha().prop_map(|x| (x, x)), 3 => other]
}

/// A refractive index `η`, [1, 4]: next to 1, glass, and semiconductors.
pub fn ior() -> impl Strategy<Value = f32> {
    prop_oneof![
        1 => Just(1.0_f32),
        1 => (-6.0_f64..-1.0).prop_map(|e| (1.0 + 10_f64.powf(e)) as f32),
        4 => 1.0_f32..=4.0,
        1 => Just(1.5_f32),
        1 => Just(4.0_f32),
    ]
}

/// An albedo, [0, 1] in each channel: even, black, white, and next to either.
pub fn albedo() -> impl Strategy<Value = [f32; 3]> {
    let channel = prop_oneof![
        4 => 0.0_f32..=1.0,
        1 => Just(0.0_f32),
        1 => Just(1.0_f32),
        1 => (-7.0_f64..0.0).prop_map(|e| 10_f64.powf(e) as f32),
        1 => (-7.0_f64..0.0).prop_map(|e| (1.0 - 10_f64.powf(e)) as f32),
    ];
    proptest::array::uniform3(channel)
}

#[cfg(test)]
mod tests {
    use super::*;

    proptest! {
        #[test]
        fn all_are_inside_their_domains(a in alpha(), (x, y) in alphas(), eta in ior(), rho in albedo()) {
            for alpha in [a, x, y] {
                prop_assert!((LEAST_ALPHA..=1.0).contains(&alpha));
            }
            prop_assert!((1.0..=4.0).contains(&eta));
            prop_assert!(rho.iter().all(|x| (0.0..=1.0).contains(x)));
        }
    }
}
