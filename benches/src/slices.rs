//! The inputs of the batches, as a structure of arrays.

use lobe::Vec3;

/// Numbers that begin where a line of the cache does, as those of a renderer do that cares: a register that reaches into a second
/// line is read and written twice.
#[derive(Debug)]
pub struct Aligned {
    numbers: Vec<f32>,
    start: usize,
    count: usize,
}

impl Aligned {
    /// The numbers.
    #[must_use]
    pub fn new(numbers: impl ExactSizeIterator<Item = f32>) -> Self {
        const LINE: usize = 64;
        let count = numbers.len();
        let mut all = vec![0.0; count + LINE / size_of::<f32>()];
        let start = all.as_ptr().align_offset(LINE);
        for (place, number) in all[start..].iter_mut().zip(numbers) {
            *place = number;
        }
        Self { numbers: all, start, count }
    }

    /// All of them.
    #[must_use]
    pub fn get(&self) -> &[f32] {
        &self.numbers[self.start..][..self.count]
    }

    /// All of them, to write to.
    #[must_use]
    pub fn get_mut(&mut self) -> &mut [f32] {
        &mut self.numbers[self.start..][..self.count]
    }
}

/// Pairs of directions, a slice for each component.
#[derive(Debug)]
pub struct Slices([Aligned; 6]);

impl Slices {
    /// `count` pairs, those of [`directions_of`](crate::directions_of) the `seed`.
    #[must_use]
    pub fn of(count: usize, seed: u64) -> Self {
        let pairs = crate::directions_of(count, seed);
        let column = |f: fn(&(glam::Vec3, glam::Vec3)) -> f32| Aligned::new(pairs.iter().map(f));
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
        Vec3::new(self.0[0].get(), self.0[1].get(), self.0[2].get())
    }

    /// The directions to the viewer.
    #[must_use]
    pub fn v(&self) -> Vec3<&[f32]> {
        Vec3::new(self.0[3].get(), self.0[4].get(), self.0[5].get())
    }
}

/// Viewers and the three numbers that a sample is drawn from, a slice for each.
#[derive(Debug)]
pub struct Draws {
    columns: [Aligned; 6],
    points: Vec<(Vec3, [f32; 3])>,
}

impl Draws {
    /// `count` of them; one viewer in thirty-two is below the horizon.
    #[must_use]
    pub fn of(count: usize, seed: u64) -> Self {
        let pairs = crate::directions_of(count, seed);
        let column = |f: fn(&(glam::Vec3, glam::Vec3)) -> f32| Aligned::new(pairs.iter().map(f));
        let mut next = crate::numbers(!seed);
        let mut numbers = || Aligned::new((0..count).map(|_| next()));
        let columns = [column(|p| p.1.x), column(|p| p.1.y), column(|p| p.1.z), numbers(), numbers(), numbers()];
        let [vx, vy, vz, u0, u1, u2] = columns.each_ref().map(Aligned::get);
        let point = |i| (Vec3::new(vx[i], vy[i], vz[i]), [u0[i], u1[i], u2[i]]);
        let points = (0..count).map(point).collect();
        Self { columns, points }
    }

    /// The directions to the viewer.
    #[must_use]
    pub fn v(&self) -> Vec3<&[f32]> {
        Vec3::new(self.columns[0].get(), self.columns[1].get(), self.columns[2].get())
    }

    /// The three numbers of `[0, 1)`.
    #[must_use]
    pub fn u(&self) -> (&[f32], &[f32], &[f32]) {
        (self.columns[3].get(), self.columns[4].get(), self.columns[5].get())
    }

    /// The same, point by point: as they are where they are not made of slices.
    #[must_use]
    pub fn points(&self) -> &[(Vec3, [f32; 3])] {
        &self.points
    }
}

/// Somewhere to write `N` numbers for each point to.
#[derive(Debug)]
pub struct Out<const N: usize>([Aligned; N]);

impl<const N: usize> Out<N> {
    /// Zeros.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self(std::array::from_fn(|_| Aligned::new(vec![0.0; count].into_iter())))
    }

    /// The slices.
    #[must_use]
    pub fn get(&mut self) -> [&mut [f32]; N] {
        self.0.each_mut().map(Aligned::get_mut)
    }
}
