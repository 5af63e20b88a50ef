//! Random directions for the checks: the same in every run, so that a report can be repeated.

use lobe::Vec3;
use std::f64::consts::TAU;

/// SplitMix64: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
#[derive(Debug)]
pub(crate) struct Random(u64);

/// "lobe" in ASCII; nothing about it was chosen.
pub(crate) const SEED: u64 = 0x6c6f_6265;

impl Random {
    pub(crate) fn new() -> Self {
        Self(SEED)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly from 0 to below 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A direction above the horizon, in `f32`. One in four is grazing, with a cosine between 1e-6 and 1e-2.
    pub(crate) fn direction(&mut self) -> Vec3<f32> {
        let z = if self.unit() < 0.25 { 10.0_f64.powf(-6.0 + 4.0 * self.unit()) } else { 1.0 - self.unit() };
        let (sin, cos) = (TAU * self.unit()).sin_cos();
        let r = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(r * cos, r * sin, z).map(|x| x as f32)
    }

    /// A direction at a random small distance from the mirror direction of `l`: where sharp lobes have a value.
    pub(crate) fn near_mirror(&mut self, l: Vec3<f32>) -> Vec3<f32> {
        let spread = 10.0_f64.powf(-4.0 + 4.0 * self.unit());
        let away = |random: &mut Self| spread * (2.0 * random.unit() - 1.0);
        let (dx, dy, dz) = (away(self), away(self), away(self));
        let v = Vec3::new(-f64::from(l.x) + dx, -f64::from(l.y) + dy, (f64::from(l.z) + dz).abs().max(1e-6));
        v.normalize().map(|x| x as f32)
    }

    /// A pair of directions, every other one near the mirror direction.
    pub(crate) fn pair(&mut self) -> (Vec3<f32>, Vec3<f32>) {
        let l = self.direction();
        let v = if self.unit() < 0.5 { self.near_mirror(l) } else { self.direction() };
        (l, v)
    }
}
