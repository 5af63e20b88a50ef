//! Kernels as they must not be: `tests/assembly.rs` has to find what is wrong with each.

use lobe::Real;
use lobe::batch::{Batch, Kernel, Level};

/// It calls a function for each register.
#[derive(Clone, Copy, Debug)]
pub struct Calls;

#[inline(never)]
fn not_inlined<R: Real>(x: R) -> R {
    x.squared().plus(1.0).recip()
}

impl<R: Real> Kernel<R, R> for Calls {
    #[inline(always)]
    fn apply(&self, x: R) -> R {
        not_inlined(x) * x
    }
}

/// It needs more registers than there are: 64 numbers, each of which is needed again after all of them were.
#[derive(Clone, Copy, Debug)]
pub struct Spills;

macro_rules! all_needed_twice {
    ($x:ident; $($name:ident $c:literal),+) => {{
        $(let $name = $x.plus($c);)+
        let sum = $x $(+ $name)+;
        $x $(+ sum * $name)+
    }};
}

impl<R: Real> Kernel<R, R> for Spills {
    #[inline(always)]
    fn apply(&self, x: R) -> R {
        all_needed_twice!(
            x;
            x0 0.0, x1 1.0, x2 2.0, x3 3.0, x4 4.0, x5 5.0, x6 6.0, x7 7.0,
            x8 8.0, x9 9.0, x10 10.0, x11 11.0, x12 12.0, x13 13.0, x14 14.0, x15 15.0,
            x16 16.0, x17 17.0, x18 18.0, x19 19.0, x20 20.0, x21 21.0, x22 22.0, x23 23.0,
            x24 24.0, x25 25.0, x26 26.0, x27 27.0, x28 28.0, x29 29.0, x30 30.0, x31 31.0,
            x32 32.0, x33 33.0, x34 34.0, x35 35.0, x36 36.0, x37 37.0, x38 38.0, x39 39.0,
            x40 40.0, x41 41.0, x42 42.0, x43 43.0, x44 44.0, x45 45.0, x46 46.0, x47 47.0,
            x48 48.0, x49 49.0, x50 50.0, x51 51.0, x52 52.0, x53 53.0, x54 54.0, x55 55.0,
            x56 56.0, x57 57.0, x58 58.0, x59 59.0, x60 60.0, x61 61.0, x62 62.0, x63 63.0
        )
    }
}

/// Runs one of them.
pub fn calls(level: Level, x: &[f32], out: &mut [f32]) {
    Batch::at(level).run(Calls, x, out).expect("the slices are equally long");
}

/// Runs the other one.
pub fn spills(level: Level, x: &[f32], out: &mut [f32]) {
    Batch::at(level).run(Spills, x, out).expect("the slices are equally long");
}
