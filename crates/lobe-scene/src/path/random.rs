//! The random numbers of a path: a function of seed, pixel, sample and dimension, without any state.
//!
//! Each pair of dimensions is a Sobol' sequence of its own, shuffled and scrambled after Owen by a hash (Burley, *Practical
//! Hash-based Owen Scrambling*, JCGT 9(4), 2020, with the permutation of Vegdahl, *Building a Better LK Hash*, 2021). Its seeds
//! come from PCG as a hash (Jarzynski and Olano, *Hash Functions for GPU Rendering*, JCGT 9(3), 2020). So any first `2ᵏ`
//! samples of a pixel are spread evenly over every pair, and each number by itself is uniform.

/// What a pair of numbers is for. Each vertex of a path has all of them.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Purpose {
    Pixel,
    Opacity,
    Light,
    OnLight,
    Lamp,
    InLamp,
    InLampRadius,
    Lobe,
    Direction,
    Roulette,
}

/// The numbers of one sample of one pixel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Numbers {
    pixel: u32,
    index: u32,
}

impl Numbers {
    pub(crate) fn new(seed: u64, x: u32, y: u32, index: u32) -> Self {
        let seed = hash(seed as u32 ^ hash((seed >> 32) as u32));
        Self { pixel: hash(x ^ hash(y ^ seed)), index }
    }

    /// Two numbers of 32 bits for a vertex. `again` tells apart what is drawn more than once there.
    #[inline]
    pub(crate) fn bits(&self, vertex: u32, purpose: Purpose, again: u32) -> [u32; 2] {
        let seed = hash(self.pixel ^ hash(vertex << 4 | purpose as u32 | again << 20));
        // The digits of the index from the first to the last, as the scrambling wants them; then what takes them apart again.
        let index = scramble(self.index.reverse_bits(), seed).reverse_bits();
        let [x, y] = [hash(seed ^ 0x9e37_79b9), hash(seed ^ 0x7f4a_7c15)];
        [scramble(index, x).reverse_bits(), scramble(pascal(index), y).reverse_bits()]
    }

    /// Two numbers of `[0, 1)`, with 24 bits each.
    #[inline]
    pub(crate) fn pair(&self, vertex: u32, purpose: Purpose) -> [f32; 2] {
        self.bits(vertex, purpose, 0).map(unit)
    }

    /// One number of `[0, 1)`, with 24 bits.
    #[inline]
    pub(crate) fn one(&self, vertex: u32, purpose: Purpose, again: u32) -> f32 {
        let [x, _] = self.bits(vertex, purpose, again);
        unit(x)
    }

    /// Two numbers of `[0, 1)` with all 32 bits, for tables of many entries.
    #[inline]
    pub(crate) fn fine(&self, vertex: u32, purpose: Purpose) -> [f64; 2] {
        self.bits(vertex, purpose, 0).map(|bits| f64::from(bits) * 0.5_f64.powi(32))
    }
}

/// The first 24 bits as a number of `[0, 1)`: every one of them is an `f32`.
#[inline]
pub(crate) fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * 0.5_f32.powi(24)
}

/// PCG's output function (RXS-M-XS) after one step.
#[inline]
fn hash(x: u32) -> u32 {
    let state = x.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// Owen's scrambling of a fraction whose digits go from the last bit to the first: every step lets a bit depend on those before it
/// alone.
#[inline]
fn scramble(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// The generator matrix of the second Sobol' dimension: Pascal's triangle modulo 2, the fivefold Kronecker product of
/// `[[1, 1], [0, 1]]`. The first one is the identity.
#[inline]
fn pascal(mut x: u32) -> u32 {
    x ^= (x >> 16) & 0x0000_ffff;
    x ^= (x >> 8) & 0x00ff_00ff;
    x ^= (x >> 4) & 0x0f0f_0f0f;
    x ^= (x >> 2) & 0x3333_3333;
    x ^ (x >> 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every box of the area `2⁻ᵏ` with sides of powers of two holds one of the first `2ᵏ` points: a (0, k, 2)-net.
    #[test]
    fn each_pair_is_a_net() {
        for (seed, x, y) in [(0, 0, 0), (1, 7, 3), (u64::MAX, 1 << 14, 5)] {
            for (vertex, purpose) in [(0, Purpose::Pixel), (3, Purpose::Direction), (40, Purpose::OnLight)] {
                for k in [1_u32, 4, 7, 10] {
                    let points: Vec<_> =
                        (0..1 << k).map(|at| Numbers::new(seed, x, y, at).bits(vertex, purpose, 0)).collect();
                    for wide in 0..=k {
                        let mut seen = vec![false; 1 << k];
                        for [u, v] in &points {
                            let column = u64::from(*u) >> (32 - wide);
                            let row = u64::from(*v) >> (32 - (k - wide));
                            seen[(row << wide | column) as usize] = true;
                        }
                        assert!(seen.iter().all(|seen| *seen), "{k} {wide}");
                    }
                }
            }
        }
    }

    /// Pixels and purposes have nothing to do with each other: their first numbers are uniform, and independent in pairs.
    #[test]
    fn first_numbers_are_uniform_and_independent() {
        let mut boxes = [0_u32; 64];
        let mut count = 0;
        for x in 0..200 {
            for y in 0..200 {
                let numbers = Numbers::new(5, x, y, 0);
                let (a, b) = (numbers.one(1, Purpose::Lobe, 0), numbers.one(2, Purpose::Lobe, 0));
                assert!((0.0..1.0).contains(&a) && (0.0..1.0).contains(&b));
                boxes[(a * 8.0) as usize * 8 + (b * 8.0) as usize] += 1;
                count += 1;
            }
        }
        let expected = f64::from(count) / 64.0;
        let chi2: f64 = boxes.iter().map(|n| (f64::from(*n) - expected).powi(2) / expected).sum();
        // 63 degrees of freedom: beyond 120 once in 50,000 seeds, and the seed is fixed.
        assert!(chi2 < 120.0, "{chi2}");
    }
}
