//! A kernel at each SIMD level: the loops over registers.

use super::columns::{Columns, ColumnsMut, MAX_INPUTS, MAX_OUTPUTS};
use super::{Kernel, Level};
use crate::number::{Estimate, Precision};
use crate::{Rgb, Vec3};
use core::cell::Cell;

#[cfg(all(
    not(lobe_scalar),
    any(
        target_arch = "x86",
        target_arch = "x86_64",
        target_arch = "aarch64",
        all(target_arch = "wasm32", target_feature = "simd128")
    )
))]
use {
    crate::number::Wide,
    fearless_simd::{Simd, SimdBase},
};

/// What a loop needs of a register: how wide it is, and how it is read and written.
trait Register: Estimate {
    /// What it is made with: the token of a SIMD level, or nothing.
    type Token: Copy;
    /// Its numbers in memory.
    type Array: AsRef<[f32]>;
    /// How many numbers it holds.
    const LANES: usize;
    /// The same number in every lane.
    fn splat(token: Self::Token, x: f32) -> Self;
    fn read(token: Self::Token, array: &Self::Array) -> Self;
    fn write(self, array: &mut Self::Array);
    /// A slice as registers, without what does not fill one.
    fn arrays(slice: &[f32]) -> &[Self::Array];
    fn arrays_mut(slice: &mut [f32]) -> &mut [Self::Array];
    /// Runs `f` as code for this level. Not inlined: the instructions are another level's.
    fn run(token: Self::Token, f: impl FnOnce());
}

/// The register of `LANES` lanes whose token is `Token`; `$splat`, `$read`, `$write` and `$run` are what differs.
macro_rules! register {
    ($register:ty, $lanes:literal, $token:ty, $splat:expr, $read:expr, $write:expr, $run:expr) => {
        impl Register for $register {
            type Token = $token;
            type Array = [f32; $lanes];
            const LANES: usize = $lanes;
            #[inline(always)]
            fn splat(token: $token, x: f32) -> Self {
                $splat(token, x)
            }
            #[inline(always)]
            fn read(token: $token, array: &[f32; $lanes]) -> Self {
                $read(token, array)
            }
            #[inline(always)]
            fn write(self, array: &mut [f32; $lanes]) {
                $write(self, array);
            }
            #[inline(always)]
            fn arrays(slice: &[f32]) -> &[[f32; $lanes]] {
                slice.as_chunks().0
            }
            #[inline(always)]
            fn arrays_mut(slice: &mut [f32]) -> &mut [[f32; $lanes]] {
                slice.as_chunks_mut().0
            }
            #[inline(always)]
            fn run(token: $token, f: impl FnOnce()) {
                $run(token, f);
            }
        }
    };
}
register! {
    f32, 1, (),
    |(), x| x,
    |(), &[x]: &[f32; 1]| x,
    |x, [to]: &mut [f32; 1]| *to = x,
    |(), f: _| call(f)
}

#[inline(always)]
fn call(f: impl FnOnce()) {
    f();
}

/// The widest register.
const MAX_LANES: usize = 16;

/// The whole batch: what fills registers, and then the rest by way of buffers that are padded to one, through the same
/// instructions. `start` is 0, or where the rest begins: then it is the rest alone. With `ADD` the results are added to
/// what is there.
#[inline]
fn run_from<F, P, K, C, O, const ADD: bool>(
    token: F::Token,
    kernel: K,
    inputs: C,
    outputs: O,
    start: usize,
    count: usize,
) where
    F: Register,
    P: Precision,
    C: Columns,
    O: ColumnsMut,
    K: Kernel<C::At<P::Of<F>>, O::At<P::Of<F>>> + Copy,
{
    const { assert!(C::COUNT <= MAX_INPUTS && O::COUNT <= MAX_OUTPUTS, "too many slices in one batch") };
    let rest = count % F::LANES;
    let whole = count - rest;
    let (out, last) = outputs.split(whole);
    if whole > start {
        let arrays = inputs.read(&|slice| F::arrays(slice), &|_| &[][..]);
        let results = out.each(&mut |slice| F::arrays_mut(slice));
        registers::<F, P, K, C, O, ADD>(token, kernel, &inputs, &arrays, results, whole / F::LANES);
    }
    if rest > 0 {
        run_rest::<F, P, K, C, O, ADD>(token, kernel, inputs, last, whole);
    }
}

/// What is left from `start` on, less than a register; `outputs` has it alone.
#[cold]
#[inline(never)]
fn run_rest<F, P, K, C, O, const ADD: bool>(token: F::Token, kernel: K, inputs: C, outputs: O, start: usize)
where
    F: Register,
    P: Precision,
    C: Columns,
    O: ColumnsMut,
    K: Kernel<C::At<P::Of<F>>, O::At<P::Of<F>>> + Copy,
{
    let mut buffers = [[0.0; MAX_LANES]; MAX_INPUTS];
    let mut results = [[0.0; MAX_LANES]; MAX_OUTPUTS];
    let mut places = buffers.iter_mut();
    let _ = inputs.visit(&mut |slice| -> Result<(), ()> {
        if let Some(place) = places.next() {
            pad(place, slice.get(start..).unwrap_or(&[]));
        }
        Ok(())
    });
    let mut places = results.iter_mut();
    let _ = outputs.visit(&mut |slice| -> Result<(), ()> {
        if let Some(place) = places.next() {
            pad(place, slice);
        }
        Ok(())
    });

    let mut places = buffers.iter();
    let arrays = inputs.load(
        &mut || places.next().and_then(|place| place.get(..F::LANES)).map_or(&[][..], |place| F::arrays(place)),
        &|_| &[][..],
    );
    let mut places = results.iter_mut();
    let to = O::build(&mut || {
        let place = places.next().and_then(|place| place.get_mut(..F::LANES));
        place.map_or(&mut [][..], |place| F::arrays_mut(place))
    });
    registers::<F, P, K, C, O, ADD>(token, kernel, &inputs, &arrays, to, 1);

    let mut places = results.iter();
    outputs.each(&mut |slice| {
        if let Some(place) = places.next() {
            copy(slice, place);
        }
    });
}

/// The `count` registers of each slice. A function of its own: of two kernels with the same loop a linker's names may keep one, and what
/// looks at machine code finds the other by this one's name.
#[inline(never)]
fn registers<F, P, K, C, O, const ADD: bool>(
    token: F::Token,
    kernel: K,
    inputs: &C,
    arrays: &C::At<&[F::Array]>,
    mut results: O::At<&mut [F::Array]>,
    count: usize,
) where
    F: Register,
    P: Precision,
    C: Columns,
    O: ColumnsMut,
    K: Kernel<C::At<P::Of<F>>, O::At<P::Of<F>>> + Copy,
{
    F::run(
        token,
        #[inline(always)]
        move || {
            let (kernel, inputs) = (kernel, *inputs);
            // Said once, and slice by slice without a loop, so that the compiler knows it below: or it would check every
            // access for itself, nine jumps for each register.
            let known = Cell::new(true);
            let long = |length: usize| known.set(known.get() & (length == count));
            let arrays = inputs.map(
                arrays,
                &|arrays| {
                    long(arrays.len());
                    *arrays
                },
                &|_| &[][..],
            );
            O::store(&mut results, O::build(&mut || ()), &mut |arrays, ()| long(arrays.len()));
            if !known.get() {
                return;
            }
            for i in 0..count {
                let input = inputs.map(
                    &arrays,
                    &|arrays| {
                        P::number(arrays.get(i).map_or_else(|| F::splat(token, 0.0), |array| F::read(token, array)))
                    },
                    &|x| P::number(F::splat(token, x)),
                );
                O::store(&mut results, kernel.apply(input), &mut |arrays, result| {
                    if let Some(array) = arrays.get_mut(i) {
                        let result = P::value(result);
                        let sum = if ADD { F::read(token, array) + result } else { result };
                        sum.write(array);
                    }
                });
            }
        },
    );
}

/// `out += Σ kernel(v, light)`: whole registers of points one after the other, each for all lights, and then what is left
/// for one light after the other.
#[inline]
fn run_lights<F, P, K, L>(token: F::Token, kernel: K, v: Vec3<&[f32]>, lights: &[L], out: Rgb<&mut [f32]>, count: usize)
where
    F: Register,
    P: Precision,
    L: Columns,
    K: Kernel<(Vec3<P::Of<F>>, L::At<P::Of<F>>), Rgb<P::Of<F>>> + Copy,
{
    let rest = count % F::LANES;
    register_lights::<F, P, K, L>(token, kernel, v, lights, Rgb { r: out.r, g: out.g, b: out.b }, count / F::LANES);
    if rest > 0 {
        for light in lights {
            let out = Rgb { r: &mut *out.r, g: &mut *out.g, b: &mut *out.b };
            run_from::<F, P, K, _, _, true>(token, kernel, (v, *light), out, count - rest, count);
        }
    }
}

/// The first `count` registers of each slice.
#[inline(never)]
fn register_lights<F, P, K, L>(
    token: F::Token,
    kernel: K,
    v: Vec3<&[f32]>,
    lights: &[L],
    out: Rgb<&mut [f32]>,
    count: usize,
) where
    F: Register,
    P: Precision,
    L: Columns,
    K: Kernel<(Vec3<P::Of<F>>, L::At<P::Of<F>>), Rgb<P::Of<F>>> + Copy,
{
    F::run(
        token,
        #[inline(always)]
        move || {
            let kernel = kernel;
            let v = v.map(
                #[inline(always)]
                |slice| F::arrays(slice),
            );
            let (r, g, b) = (F::arrays_mut(out.r), F::arrays_mut(out.g), F::arrays_mut(out.b));
            for i in 0..count {
                let read = |arrays: &[F::Array]| {
                    P::number(arrays.get(i).map_or_else(|| F::splat(token, 0.0), |array| F::read(token, array)))
                };
                let v = Vec3::new(read(v.x), read(v.y), read(v.z));
                let mut sum = Rgb { r: read(r), g: read(g), b: read(b) };
                for light in lights {
                    let light = light.read(&|slice| read(F::arrays(slice)), &|x| P::number(F::splat(token, x)));
                    sum = sum + kernel.apply((v, light));
                }
                if let (Some(r), Some(g), Some(b)) = (r.get_mut(i), g.get_mut(i), b.get_mut(i)) {
                    P::value(sum.r).write(r);
                    P::value(sum.g).write(g);
                    P::value(sum.b).write(b);
                }
            }
        },
    );
}

/// Fills a register, with the last number again and again, so that no lane holds anything that the caller did not give.
#[cold]
#[inline(never)]
fn pad(buffer: &mut [f32; MAX_LANES], tail: &[f32]) {
    buffer.fill(tail.last().copied().unwrap_or(0.0));
    copy(buffer, tail);
}

#[cold]
#[inline(never)]
fn copy(to: &mut [f32], from: &[f32]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
}

/// A [`Kernel`] that runs at every level of this architecture, to the precision `P`: every one that is written over
/// [`Real`](crate::Real) does.
pub trait AtEveryLevel<P: Precision, C: Columns, O: ColumnsMut>: Sealed<P, C, O> + Copy {}
impl<P: Precision, C: Columns, O: ColumnsMut, K: Sealed<P, C, O> + Copy> AtEveryLevel<P, C, O> for K {}

/// A [`Kernel`] that runs so for many lights `L`.
pub trait LightsAtEveryLevel<P: Precision, L: Columns>: SealedLights<P, L> + Copy {}
impl<P: Precision, L: Columns, K: SealedLights<P, L> + Copy> LightsAtEveryLevel<P, L> for K {}

mod sealed {
    use super::{Columns, ColumnsMut, Level, Precision, Rgb, Vec3};

    pub trait Sealed<P: Precision, C: Columns, O: ColumnsMut> {
        fn run_at<const ADD: bool>(self, level: Level, inputs: C, outputs: O, count: usize);
    }

    pub trait SealedLights<P: Precision, L: Columns> {
        fn lights_at(self, level: Level, v: Vec3<&[f32]>, lights: &[L], out: Rgb<&mut [f32]>, count: usize);
    }
}
pub(super) use sealed::{Sealed, SealedLights};

/// The levels of an architecture, from the lowest; a level that is not among them runs the scalar.
macro_rules! levels {
    ($($variant:ident $name:literal $from:ident => $register:ty, $lanes:literal);*) => {
        /// The levels with lanes of a machine whose best level is `best`, from the lowest, each with its name: `sse4.2`,
        /// `avx2` and `avx512`, or `neon`, or `simd128`. None where batches run the scalar formula.
        ///
        /// ```
        /// use lobe::batch::{Level, levels};
        /// for (name, level) in levels(Level::new()) {
        ///     println!("{name}: {level:?}");
        /// }
        /// ```
        pub fn levels(best: Level) -> impl Iterator<Item = (&'static str, Level)> + Clone {
            let _ = best;
            // Where there is none, the type of the empty list is not known.
            let all: [Option<(&'static str, Level)>; const { 0 $(+ { let _ = $lanes; 1 })* }] =
                [$(best.$from().map(|simd| ($name, Level::$variant(simd)))),*];
            all.into_iter().flatten()
        }

        impl<P, C, O, K> Sealed<P, C, O> for K
        where
            P: Precision,
            C: Columns,
            O: ColumnsMut,
            K: Kernel<C::At<P::Of<f32>>, O::At<P::Of<f32>>> + Copy,
            $(K: Kernel<C::At<P::Of<$register>>, O::At<P::Of<$register>>>,)*
        {
            #[inline]
            fn run_at<const ADD: bool>(self, level: Level, inputs: C, outputs: O, count: usize) {
                match level {
                    $(Level::$variant(simd) => run_from::<$register, P, K, C, O, ADD>(simd, self, inputs, outputs, 0, count),)*
                    #[allow(unreachable_patterns, reason = "where the target has a level built in, lower ones do not exist")]
                    _ => run_from::<f32, P, K, C, O, ADD>((), self, inputs, outputs, 0, count),
                }
            }
        }

        impl<P, L, K> SealedLights<P, L> for K
        where
            P: Precision,
            L: Columns,
            K: Kernel<(Vec3<P::Of<f32>>, L::At<P::Of<f32>>), Rgb<P::Of<f32>>> + Copy,
            $(K: Kernel<(Vec3<P::Of<$register>>, L::At<P::Of<$register>>), Rgb<P::Of<$register>>>,)*
        {
            #[inline]
            fn lights_at(self, level: Level, v: Vec3<&[f32]>, lights: &[L], out: Rgb<&mut [f32]>, count: usize) {
                match level {
                    $(Level::$variant(simd) => run_lights::<$register, P, K, L>(simd, self, v, lights, out, count),)*
                    #[allow(unreachable_patterns, reason = "where the target has a level built in, lower ones do not exist")]
                    _ => run_lights::<f32, P, K, L>((), self, v, lights, out, count),
                }
            }
        }

        $(register! {
            $register, $lanes, fearless_simd::$variant,
            Wide::splat,
            |simd, array| Wide(SimdBase::from_slice(simd, array)),
            |lanes: $register, array| lanes.0.store_slice(array),
            |simd, f: _| Simd::vectorize(simd, f)
        })*
    };
}

// SSE2 alone, which is all that a build for x86-64 may assume, runs the scalar: no machine of the last fifteen years
// stops there, and every level more is code. With `--cfg lobe_scalar` every machine does: instrumented for a fuzzer, the lanes
// are many minutes of a compiler's time.
#[cfg(all(not(lobe_scalar), any(target_arch = "x86", target_arch = "x86_64")))]
levels! {
    Sse4_2 "sse4.2" as_sse4_2 => Wide<fearless_simd::Sse4_2>, 4;
    Avx2 "avx2" as_avx2 => Wide<fearless_simd::Avx2>, 8;
    Avx512 "avx512" as_avx512 => Wide<fearless_simd::Avx512>, 16
}
#[cfg(all(not(lobe_scalar), target_arch = "aarch64"))]
levels! { Neon "neon" as_neon => Wide<fearless_simd::Neon>, 4 }
#[cfg(all(not(lobe_scalar), target_arch = "wasm32", target_feature = "simd128"))]
levels! { WasmSimd128 "simd128" as_wasm_simd128 => Wide<fearless_simd::WasmSimd128>, 4 }
#[cfg(any(
    lobe_scalar,
    not(any(
        target_arch = "x86",
        target_arch = "x86_64",
        target_arch = "aarch64",
        all(target_arch = "wasm32", target_feature = "simd128")
    ))
))]
levels! {}
