//! The inputs of the batches, as a structure of arrays.

use lobe::Vec3;

/// Pairs of directions, a slice for each component.
#[derive(Clone, Debug)]
pub struct Slices([Vec<f32>; 6]);

impl Slices {
    /// `count` pairs, those of [`directions_of`](crate::directions_of) the `seed`.
    #[must_use]
    pub fn of(count: usize, seed: u64) -> Self {
        let pairs = crate::directions_of(count, seed);
        let column = |f: fn(&(glam::Vec3, glam::Vec3)) -> f32| pairs.iter().map(f).collect();
        Self([
            column(|p| p.0.x),
            column(|p| p.0.y),
            column(|p| p.0.z),
            column(|p| p.1.x),
            column(|p| p.1.y),
            column(|p| p.1.z),
        ])
    }

    /// The directions to the light.
    #[must_use]
    pub fn l(&self) -> Vec3<&[f32]> {
        Vec3::new(&self.0[0], &self.0[1], &self.0[2])
    }

    /// The directions to the viewer.
    #[must_use]
    pub fn v(&self) -> Vec3<&[f32]> {
        Vec3::new(&self.0[3], &self.0[4], &self.0[5])
    }
}
