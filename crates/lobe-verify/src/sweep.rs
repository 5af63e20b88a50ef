//! Every one-argument function of `f32`, tried on every argument there is.
//!
//! The table [`FUNCTIONS`] is the promise: the name, the allowed error, the exact value. The tests try a dense sample
//! and all boundaries; `lobe sweep` tries all 2³² bit patterns.

use crate::ulp::ulps_between;
use lobe::Real;
use rayon::prelude::*;

/// A function of one 32-bit float, with what it promises.
#[derive(Clone, Copy, Debug)]
pub struct Function {
    /// Its name in [`Real`].
    pub name: &'static str,
    /// The largest allowed error, in ulps, on the whole range.
    pub allowed_ulps: f64,
    /// The function as `lobe` computes it in `f32`.
    pub f32: fn(f32) -> f32,
    /// The exact value, up to the rounding of `f64`, special values and ends of the domain included.
    pub exact: fn(f64) -> f64,
}

/// All of them.
pub const FUNCTIONS: &[Function] = &[
    Function {
        name: "exp2",
        allowed_ulps: 1.0,
        f32: |x| Real::exp2(x),
        exact: |x| if x < -126.0 { 0.0 } else { libm::exp2(x) },
    },
    Function { name: "log2", allowed_ulps: 1.0, f32: |x| Real::log2(x), exact: libm::log2 },
    Function {
        name: "log2_1p",
        allowed_ulps: 1.0,
        f32: |x| x.log2_1p(),
        exact: |x| libm::log1p(x) * std::f64::consts::LOG2_E,
    },
    Function { name: "sin", allowed_ulps: 1.0, f32: |x| Real::sin_cos(x).0, exact: |x| in_turns(x, libm::sin) },
    Function { name: "cos", allowed_ulps: 1.0, f32: |x| Real::sin_cos(x).1, exact: |x| in_turns(x, libm::cos) },
    Function {
        name: "atan",
        allowed_ulps: 2.0,
        // With a component of 1 the other one may be anything.
        f32: |x| Real::atan2(x, 1.0),
        exact: libm::atan,
    },
    Function {
        name: "erfc",
        allowed_ulps: 6.0,
        f32: |x| Real::erfc(x),
        exact: |x| if x >= 9.1875 { 0.0 } else { libm::erfc(x) },
    },
    Function { name: "sqrt", allowed_ulps: 0.5, f32: |x| Real::sqrt(x), exact: libm::sqrt },
    Function { name: "recip", allowed_ulps: 0.5, f32: |x| Real::recip(x), exact: |x| 1.0 / x },
];

/// The domain of `sin_cos` ends at 512.
pub(crate) fn in_turns(x: f64, f: fn(f64) -> f64) -> f64 {
    if x.abs() <= 512.0 { f(x) } else { f64::NAN }
}

/// What a sweep has found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// How many arguments were tried.
    pub tried: u64,
    /// The largest error, in ulps.
    pub ulps: f64,
    /// An argument that has it.
    pub argument: f32,
    /// The value there.
    pub value: f32,
    /// What it should be.
    pub exact: f64,
}

impl Worst {
    const NOTHING: Self = Self { tried: 0, ulps: 0.0, argument: 0.0, value: 0.0, exact: 0.0 };

    fn or(self, other: Self) -> Self {
        let worse = if other.ulps > self.ulps { other } else { self };
        Self { tried: self.tried + other.tried, ..worse }
    }
}

/// The worst error over every `stride`-th bit pattern, on all cores. A `stride` of 1 tries all 2³² of them; 0 counts
/// as 1. `progress` is told how many have been tried since it was last told.
pub fn sweep(function: &Function, stride: u32, progress: &(dyn Fn(u64) + Sync)) -> Worst {
    const BLOCK: u64 = 1 << 22;
    let stride = u64::from(stride.max(1));
    (0..(1u64 << 32) / BLOCK)
        .into_par_iter()
        .map(|block| {
            // The first multiple of the stride in this block.
            let first = (block * BLOCK).div_ceil(stride) * stride;
            let end = (block + 1) * BLOCK;
            let worst = (first..end)
                .step_by(stride as usize)
                .map(|bits| try_one(function, bits as u32))
                .fold(Worst::NOTHING, Worst::or);
            progress(worst.tried);
            worst
        })
        .reduce(|| Worst::NOTHING, Worst::or)
}

/// The worst error over the neighbourhoods of every value at which something changes: zeros, ends of ranges, powers of
/// two, halves and multiples of π/4.
pub fn sweep_boundaries(function: &Function) -> Worst {
    boundaries().map(|bits| try_one(function, bits)).fold(Worst::NOTHING, Worst::or)
}

/// Those neighbourhoods, as bits.
pub(crate) fn boundaries() -> impl Iterator<Item = u32> {
    let powers = (-149..=127).map(|e| libm::ldexp(1.0, e) as f32);
    let steps = (0..=512).map(|i| i as f32 * 0.5);
    let turns = (1..=700).map(|k| (f64::from(k) * std::f64::consts::FRAC_PI_4) as f32);
    let special = [0.0, f32::INFINITY, f32::NAN, f32::MAX, f32::MIN_POSITIVE];
    powers
        .chain(steps)
        .chain(turns)
        .chain(special)
        .flat_map(|x| (-64i32..=64).map(move |d| x.to_bits().wrapping_add_signed(d)))
        .flat_map(|bits| [bits, bits ^ (1 << 31)])
}

fn try_one(function: &Function, bits: u32) -> Worst {
    let argument = f32::from_bits(bits);
    let value = (function.f32)(argument);
    let exact = (function.exact)(f64::from(argument));
    Worst { tried: 1, ulps: ulps_between(value, exact), argument, value, exact }
}
