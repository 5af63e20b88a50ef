//! Numbers for a sampler: from a generator whose seed is a name, and from a low-discrepancy sequence.

use crate::subject::Precision;

/// A stream of points of `[0, 1)³` for a sampler, in the digits of the number type.
///
/// ```
/// use lobe_verify::sampling::Points;
/// use lobe_verify::subject::Precision;
///
/// // Every four points of the sequence have one in each half of each axis, twice.
/// let low = Points::even("any name").take(Precision::Double, 4).filter(|[x, _, _]| *x < 0.5).count();
/// assert_eq!(low, 2);
/// ```
#[derive(Clone, Debug)]
pub struct Points(Source);

#[derive(Clone, Debug)]
enum Source {
    Random(Random),
    Even(Sobol),
}

impl Points {
    /// Independent points, by splitmix64 (Steele, Lea and Flood 2014) from the hash of a name.
    #[must_use]
    pub fn random(name: &str) -> Self {
        Self(Source::Random(Random::new(seed(name), 0)))
    }

    /// The sequence of Sobol', shifted digitally by the hash of a name: at most 2³² points.
    #[must_use]
    pub fn even(name: &str) -> Self {
        Self(Source::Even(Sobol::new(&mut Random::new(seed(name), 0))))
    }

    /// The first `count` of them, of 24 binary digits or of 53.
    pub fn take(self, precision: Precision, count: usize) -> Box<dyn Iterator<Item = [f64; 3]>> {
        match self.0 {
            Source::Random(mut random) => Box::new((0..count).map(move |_| random.point(precision))),
            Source::Even(sequence) => Box::new(sequence.into_points(precision).take(count)),
        }
    }
}

/// The FNV-1a hash of a name: the seed that nobody picked.
pub(crate) fn seed(name: &str) -> u64 {
    name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// A generator that gives the same numbers everywhere (splitmix64, Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// The stream with this number of a seed. Streams start at places that have nothing to do with each other.
    pub(crate) fn new(seed: u64, stream: u64) -> Self {
        Self(mix(seed ^ mix(stream.wrapping_mul(GOLDEN).wrapping_add(1))))
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        mix(self.0)
    }

    /// Three numbers of `[0, 1)`: of 24 binary digits in `f32`, of 53 in `f64`.
    pub(crate) fn point(&mut self, precision: Precision) -> [f64; 3] {
        let mut next = || unit(self.bits(), precision);
        [next(), next(), next()]
    }
}

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

fn mix(z: u64) -> u64 {
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The first bits as a number of `[0, 1)`: cut off, not rounded, which could give 1.
fn unit(bits: u64, precision: Precision) -> f64 {
    match precision {
        Precision::Single => (bits >> 40) as f64 / (1_u64 << 24) as f64,
        Precision::Double => (bits >> 11) as f64 / (1_u64 << 53) as f64,
    }
}

/// The sequence of Sobol' in three dimensions, shifted digitally: each block of `2ᵏ` points is even in all dimensions.
///
/// With the first primitive polynomials and initial numbers of Joe and Kuo, "Constructing Sobol Sequences with Better
/// Two-Dimensional Projections", SIAM J. Sci. Comput. 30, 2008. (The additive sequence with powers of one root, which
/// is simpler, has in three dimensions hardly a smaller error than random numbers at 2¹⁶ points.)
#[derive(Clone, Debug)]
pub(crate) struct Sobol {
    shift: [u64; 3],
}

/// What each binary digit of the index contributes, for indices below 2³².
static DIRECTIONS: [[u64; 32]; 3] = [directions([1, 1], 0), directions([1, 3], 1), directions([1, 3], 2)];

/// The directions of the polynomial of this degree: none at all for 0, `x + 1` for 1, `x² + x + 1` for 2.
const fn directions(first: [u64; 2], degree: u32) -> [u64; 32] {
    let [mut before, mut now] = first;
    let mut directions = [0; 32];
    let mut k = 0;
    while k < 32 {
        directions[k] = before << (63 - k);
        let next = match degree {
            0 => 1,
            1 => now << 1 ^ now,
            _ => now << 1 ^ before << 2 ^ before,
        };
        before = now;
        now = next;
        k += 1;
    }
    directions
}

impl Sobol {
    pub(crate) fn new(random: &mut Random) -> Self {
        Self { shift: [random.bits(), random.bits(), random.bits()] }
    }

    /// The first `2³²` points, in the order of Gray's code, which changes one digit a step (Antonov and Saleev 1979).
    pub(crate) fn points(&self, precision: Precision) -> impl Iterator<Item = [f64; 3]> + use<> {
        self.clone().into_points(precision)
    }

    fn into_points(self, precision: Precision) -> impl Iterator<Item = [f64; 3]> {
        (1..=u32::MAX).scan(self.shift, move |state, next| {
            let point = state.map(|bits| unit(bits, precision));
            let digit = next.trailing_zeros() as usize;
            for (x, directions) in state.iter_mut().zip(&DIRECTIONS) {
                *x ^= directions.get(digit).copied().unwrap_or_default();
            }
            Some(point)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_is_the_hash_of_its_name() {
        // The published values of FNV-1a.
        assert_eq!((seed(""), seed("a")), (0xcbf2_9ce4_8422_2325, 0xaf63_dc4c_8601_ec8c));
        assert_ne!(Random::new(seed("a"), 0).bits(), Random::new(seed("a"), 1).bits());
    }

    #[test]
    fn the_first_points_are_those_of_sobol() {
        let sequence = Sobol { shift: [0; 3] };
        let points: Vec<_> = sequence.points(Precision::Double).take(8).collect();
        assert_eq!(points.get(..4), Some(&[[0.0; 3], [0.5; 3], [0.75, 0.25, 0.25], [0.25, 0.75, 0.75]][..]));
        // The third digits: m₃ = 1, 5, 3. Gray's code of 7 is 4.
        assert_eq!(points.get(7), Some(&[0.125, 0.625, 0.375]));
        // Every eighth has one of eight points, in each dimension.
        for axis in 0..3 {
            let mut eighths: Vec<_> = points.iter().map(|point| (point[axis] * 8.0) as u32).collect();
            eighths.sort_unstable();
            assert_eq!(eighths, [0, 1, 2, 3, 4, 5, 6, 7]);
        }
    }

    /// The mean of a smooth function is right to about 1/n, not to 1/√n: a thousandth for so many random points.
    #[test]
    fn the_sequence_is_even() {
        let sequence = Sobol::new(&mut Random::new(seed("even"), 0));
        let n = 1 << 14;
        let sum: f64 = sequence.points(Precision::Single).take(n).map(|point| point.iter().product::<f64>()).sum();
        assert!((sum / n as f64 - 0.125).abs() < 3e-5, "{}", sum / n as f64);
    }

    #[test]
    fn no_number_is_one() {
        assert_eq!(unit(u64::MAX, Precision::Single), 1.0 - f64::from(f32::EPSILON) / 2.0);
        assert_eq!(unit(u64::MAX, Precision::Double), 1.0 - f64::EPSILON / 2.0);
    }
}
