//! Every one-argument function at the precisions [`Fast`] and [`Coarse`], tried on every argument there is: as a scalar,
//! and in lanes at every SIMD level that the machine has.
//!
//! The table [`FUNCTIONS`] is the promise. The tests try a dense sample and all boundaries; `lobe sweep --precision all`
//! tries all 2³² bit patterns.

use crate::sweep::{boundaries, in_turns};
use lobe::Real;
use lobe::batch::{Batch, Kernel, Level, levels};
use lobe::number::{Approximate, Coarse, Fast, Precision as _};
use rayon::prelude::*;

/// A function of one 32-bit float, with what it promises at each precision.
#[derive(Clone, Copy, Debug)]
pub struct Function {
    /// Its name in [`Real`].
    pub name: &'static str,
    /// Where [`domain`](Self::domain) holds, in words.
    pub domain_in_words: &'static str,
    /// Whether the bound is promised at an argument. Elsewhere there is no NaN from a finite argument all the same.
    pub domain: fn(f32) -> bool,
    /// Errors are relative to the exact value, or to this where the value is smaller.
    pub floor: f64,
    /// Whether NaN is promised where the exact value is NaN, as below the domain of `log2`.
    pub keeps_nan: bool,
    /// Whether an argument may give an infinity that `f32` does not give.
    pub may_overflow: fn(f32) -> bool,
    /// The exact value, up to the rounding of `f64`, special values and ends of the domain included.
    pub exact: fn(f64) -> f64,
    /// The largest allowed error at [`Fast`].
    pub fast: Promise,
    /// The largest allowed error at [`Coarse`].
    pub coarse: Promise,
}

/// A function at one precision.
#[derive(Clone, Copy, Debug)]
pub struct Promise {
    /// The largest allowed relative error.
    pub allowed: f64,
    /// The function of each argument, as a scalar.
    pub scalar: fn(&[f32], &mut [f32]),
    /// The function of each argument, in lanes.
    pub lanes: fn(Level, &[f32], &mut [f32]),
}

/// What is below the smallest normal number may be 0, or that number.
const SMALLEST: f64 = f32::MIN_POSITIVE as f64;

/// `$function`, as [`Promise::scalar`] and [`Promise::lanes`] for the precision `$precision`.
macro_rules! promise {
    ($function:expr, $precision:ident, $allowed:literal) => {{
        Promise {
            allowed: $allowed,
            scalar: |x, out| {
                for (&x, out) in x.iter().zip(out) {
                    *out = Kernel::apply(&$function, Approximate::<f32, $precision>::new(x)).value();
                }
            },
            lanes: |level, x, out| {
                let batch = Batch::at(level).precision::<$precision>();
                batch.run(&$function, x, out).expect("the buffers are equally long");
            },
        }
    }};
}

/// The function `$body` of `$x` as a kernel, and the row of it.
macro_rules! functions {
    ($(
        $Kernel:ident $name:literal: |$x:ident| $body:expr, $exact:expr;
        $words:literal, $domain:expr; floor $floor:expr; keeps_nan $keeps:literal; may_overflow $overflow:expr;
        fast $fast:literal; coarse $coarse:literal;
    )+) => {
        $(
            struct $Kernel;
            impl<R: Real> Kernel<R, R> for $Kernel {
                #[inline(always)]
                fn apply(&self, $x: R) -> R {
                    $body
                }
            }
        )+

        /// All of them.
        pub const FUNCTIONS: &[Function] = &[$(Function {
            name: $name,
            domain_in_words: $words,
            domain: $domain,
            floor: $floor,
            keeps_nan: $keeps,
            may_overflow: $overflow,
            exact: $exact,
            fast: promise!($Kernel, Fast, $fast),
            coarse: promise!($Kernel, Coarse, $coarse),
        }),+];
    };
}

// The bounds are what a sweep finds, rounded up; where an estimate of the machine goes in, with the error that the makers
// of x86 allow one of SSE and AVX2, 1.5 · 2⁻¹² = 3.66e-4, in place of what the machine at hand has: `1/x`, `1/√x` and
// `√x` are such estimates, one goes into `atan2`, and two into `erfc`.
functions! {
    // Twice as much at −126 as elsewhere: what falls below the smallest normal number there has lost its leading digit.
    Exp2 "exp2": |x| x.exp2(), f64::exp2;
    "x ≤ 127.5", |x| x <= 127.5; floor SMALLEST; keeps_nan true; may_overflow |_| false;
    fast 1.5e-4; coarse 1.8e-3;

    // Relative to the value near 1 as well, where it is 0: x − 1 is exact there, and the polynomial one of its factors.
    Log2 "log2": |x| x.log2(), f64::log2;
    "x ≥ 2⁻¹²⁶", |x| x >= f32::MIN_POSITIVE; floor SMALLEST; keeps_nan true; may_overflow |_| false;
    fast 1.6e-4; coarse 9.3e-4;

    Log2OnePlus "log2_1p": |x| x.log2_1p(), |x| x.ln_1p() * std::f64::consts::LOG2_E;
    "x > −1", |x| x > -1.0; floor SMALLEST; keeps_nan true; may_overflow |_| false;
    fast 1.6e-4; coarse 9.3e-4;

    // π/2 is held in two parts, which leaves an absolute error of some 1e-9 at 512. No number of this precision keeps a
    // relative one at a zero of the sine that is not 0: its argument has an error too.
    Sin "sin": |x| x.sin_cos().0, |x| in_turns(x, f64::sin);
    "−512 ≤ x ≤ 512", |x| x.abs() <= 512.0; floor 1e-3; keeps_nan true; may_overflow |_| false;
    fast 1.3e-5; coarse 4.2e-4;

    Cos "cos": |x| x.sin_cos().1, |x| in_turns(x, f64::cos);
    "−512 ≤ x ≤ 512", |x| x.abs() <= 512.0; floor 1e-3; keeps_nan true; may_overflow |_| false;
    fast 1.3e-5; coarse 4.2e-4;

    Atan "atan": |x| x.atan2(x.lift(1.0)), f64::atan;
    "any x", |_| true; floor SMALLEST; keeps_nan true; may_overflow |_| false;
    fast 3.9e-4; coarse 1.1e-3;

    Erfc "erfc": |x| x.erfc(), |x| if x >= 9.1875 { 0.0 } else { libm::erfc(x) };
    "any x", |_| true; floor SMALLEST; keeps_nan true; may_overflow |_| false;
    fast 8e-4; coarse 2.6e-3;

    Sqrt "sqrt": |x| x.sqrt(), f64::sqrt;
    "0, x ≥ 2⁻¹²⁶", |x| x == 0.0 || x >= f32::MIN_POSITIVE; floor SMALLEST; keeps_nan false; may_overflow |_| false;
    fast 3.7e-4; coarse 3.7e-4;

    // Some machines take a subnormal number for 0, and give 0 for a result that is nearly one.
    Recip "recip": |x| x.recip(), f64::recip;
    "±x from 2⁻¹²⁶ to 2¹²⁵", |x| (f32::MIN_POSITIVE..=0.25 / f32::MIN_POSITIVE).contains(&x.abs()); floor SMALLEST;
    keeps_nan true; may_overflow |x| x.is_subnormal();
    fast 3.7e-4; coarse 3.7e-4;

    Rsqrt "rsqrt": |x| x.rsqrt(), |x| 1.0 / x.sqrt();
    "x ≥ 2⁻¹²⁶", |x| x >= f32::MIN_POSITIVE; floor SMALLEST; keeps_nan false; may_overflow |x| x.is_subnormal();
    fast 3.7e-4; coarse 6.6e-4;
}

impl Function {
    /// The error of `value` at `x`: relative, and infinite for what must not be.
    fn error(&self, x: f32, value: f32, exact: f64) -> f64 {
        let broken_if = |wrong| if wrong { f64::INFINITY } else { 0.0 };
        if x.is_nan() {
            return broken_if(!value.is_nan());
        }
        if exact.is_nan() {
            return broken_if(self.keeps_nan && !value.is_nan());
        }
        if x.is_infinite() {
            return 0.0;
        }
        if value.is_nan() {
            return f64::INFINITY;
        }
        if value.is_infinite() {
            let overflows = exact.abs() > f64::from(f32::MAX) || (self.may_overflow)(x);
            return broken_if(!overflows);
        }
        if !(self.domain)(x) {
            return 0.0;
        }
        if exact.abs() < SMALLEST {
            return (f64::from(value).abs() / SMALLEST - 1.0).max(0.0);
        }
        (f64::from(value) - exact).abs() / exact.abs().max(self.floor)
    }

    /// The promise for the precision of that name.
    pub fn promise(&self, precision: &str) -> Option<&Promise> {
        if precision == Fast::NAME {
            Some(&self.fast)
        } else if precision == Coarse::NAME {
            Some(&self.coarse)
        } else {
            None
        }
    }
}

/// The precisions, by name.
pub const PRECISIONS: [&str; 2] = [Fast::NAME, Coarse::NAME];

/// How a function was computed: at which precision, as a scalar or at which level.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// [`Fast::NAME`] or [`Coarse::NAME`].
    pub precision: &'static str,
    /// `scalar`, or the name of the SIMD level.
    pub name: &'static str,
    /// The SIMD level; `None` for the scalar.
    pub level: Option<Level>,
}

/// The scalar, and every SIMD level that the machine has, at each of the precisions.
pub fn ways(precisions: &[&'static str]) -> Vec<Way> {
    let levels = levels(Level::new()).map(|(name, level)| (name, Some(level)));
    let levels = std::iter::once(("scalar", None)).chain(levels);
    let of = |&precision: &&'static str| levels.clone().map(move |(name, level)| Way { precision, name, level });
    precisions.iter().flat_map(of).collect()
}

/// What a sweep has found, for one way to compute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// How many arguments were tried.
    pub tried: u64,
    /// The largest error: relative, infinite for a NaN or an infinity that must not be.
    pub error: f64,
    /// An argument that has it.
    pub argument: f32,
    /// The value there.
    pub value: f32,
    /// What it should be.
    pub exact: f64,
}

impl Worst {
    const NOTHING: Self = Self { tried: 0, error: 0.0, argument: 0.0, value: 0.0, exact: 0.0 };

    fn or(self, other: Self) -> Self {
        let worse = if other.error > self.error { other } else { self };
        Self { tried: self.tried + other.tried, ..worse }
    }
}

/// The worst error over every `stride`-th bit pattern for each of the `ways`, on all cores. A `stride` of 1 tries all
/// 2³² of them; 0 counts as 1. `progress` is told how many have been tried since it was last told.
pub fn sweep(function: &Function, ways: &[Way], stride: u32, progress: &(dyn Fn(u64) + Sync)) -> Vec<Worst> {
    // As many arguments as stay in the cache with their values.
    const BLOCK: u64 = 1 << 12;
    let stride = u64::from(stride.max(1));
    let count = (1u64 << 32).div_ceil(stride);
    (0..count.div_ceil(BLOCK))
        .into_par_iter()
        .map(|block| {
            let indices = block * BLOCK..((block + 1) * BLOCK).min(count);
            let arguments: Vec<f32> = indices.map(|i| f32::from_bits((i * stride) as u32)).collect();
            let worst = try_all(function, ways, &arguments);
            progress(arguments.len() as u64);
            worst
        })
        .reduce(|| vec![Worst::NOTHING; ways.len()], either)
}

/// The worst error over the neighbourhoods of every value at which something changes.
pub fn sweep_boundaries(function: &Function, ways: &[Way]) -> Vec<Worst> {
    try_all(function, ways, &boundaries().map(f32::from_bits).collect::<Vec<_>>())
}

fn either(a: Vec<Worst>, b: Vec<Worst>) -> Vec<Worst> {
    a.into_iter().zip(b).map(|(a, b)| a.or(b)).collect()
}

fn try_all(function: &Function, ways: &[Way], arguments: &[f32]) -> Vec<Worst> {
    let exact: Vec<f64> = arguments.iter().map(|&x| (function.exact)(f64::from(x))).collect();
    let mut values = vec![0.0; arguments.len()];
    let worst_of = |way: &Way| {
        if let Some(promise) = function.promise(way.precision) {
            match way.level {
                None => (promise.scalar)(arguments, &mut values),
                Some(level) => (promise.lanes)(level, arguments, &mut values),
            }
        }
        let mut worst = Worst { tried: arguments.len() as u64, ..Worst::NOTHING };
        for ((&argument, &value), &exact) in arguments.iter().zip(&values).zip(&exact) {
            let error = function.error(argument, value, exact);
            if error > worst.error {
                worst = Worst { error, argument, value, exact, ..worst };
            }
        }
        worst
    };
    ways.iter().map(worst_of).collect()
}
