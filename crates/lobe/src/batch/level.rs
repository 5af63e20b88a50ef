//! A kernel at each SIMD level: the loops over registers.

use super::columns::{Columns, ColumnsMut, MAX_INPUTS, MAX_OUTPUTS, Slices, SlicesMut};
use super::{Kernel, Level};
use crate::number::{Estimate, Precision};
use crate::{Rgb, Vec3};

#[cfg(any(
    target_arch = "x86",
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
use {
    crate::number::Wide,
    fearless_simd::{Simd, SimdBase},
};

/// What a loop needs of a register: how wide it is, and how it is read and written.
trait Register: Estimate {
    /// What it is made with: the token of a SIMD level, or nothing.
    type Token: Copy;
    /// How many numbers it holds.
    const LANES: usize;
    /// The same number in every lane.
    fn splat(token: Self::Token, x: f32) -> Self;
    /// The first `LANES` numbers of a slice; 0 if there are fewer, which does not happen.
    fn read(token: Self::Token, slice: &[f32]) -> Self;
    /// Writes the lanes to the first `LANES` numbers of a slice.
    fn write(self, slice: &mut [f32]);
    /// Runs `f` as code for this level. Not inlined: the instructions are another level's.
    fn run(token: Self::Token, f: impl FnOnce());
}

impl Register for f32 {
    type Token = ();
    const LANES: usize = 1;
    #[inline(always)]
    fn splat((): (), x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn read((): (), slice: &[f32]) -> f32 {
        slice.first().copied().unwrap_or(0.0)
    }
    #[inline(always)]
    fn write(self, slice: &mut [f32]) {
        if let Some(x) = slice.first_mut() {
            *x = self;
        }
    }
    #[inline(always)]
    fn run((): (), f: impl FnOnce()) {
        f();
    }
}

/// The widest register.
const MAX_LANES: usize = 16;

/// What becomes of a result: written, or added to what is there.
#[derive(Clone, Copy, Debug)]
pub enum Store {
    Write,
    Add,
}

/// The whole batch: what fills registers, and then the rest by way of buffers that are padded to one, through the same
/// instructions.
#[inline(always)]
fn run<F, P, K, C, O>(token: F::Token, kernel: &K, inputs: C, outputs: O, store: Store, count: usize)
where
    F: Register,
    P: Precision,
    C: Columns,
    O: ColumnsMut,
    K: Kernel<C::At<P::Of<F>>, O::At<P::Of<F>>>,
{
    const { assert!(C::COUNT <= MAX_INPUTS && O::COUNT <= MAX_OUTPUTS, "too many slices in one batch") };
    let mut slices: Slices<'_> = [&[]; MAX_INPUTS];
    let mut places = slices.iter_mut();
    let _ = inputs.visit(&mut |slice| -> Result<(), ()> {
        if let Some(place) = places.next() {
            *place = slice;
        }
        Ok(())
    });
    let mut out: SlicesMut<'_> = core::array::from_fn(|_| &mut [][..]);
    let mut places = out.iter_mut();
    outputs.take(&mut |slice| {
        if let Some(place) = places.next() {
            *place = slice;
        }
    });

    let rest = count % F::LANES;
    let whole = count - rest;
    if whole > 0 {
        chunks::<F, P, K, C, O>(token, kernel, &inputs, &slices, out.each_mut().map(|slice| &mut **slice), store, whole);
    }
    if rest > 0 {
        let mut padded = [[0.0; MAX_LANES]; MAX_INPUTS];
        for (buffer, slice) in padded.iter_mut().zip(&slices) {
            // The last number again and again, so that no lane holds anything that the caller did not give.
            let tail = slice.get(whole..count).unwrap_or(&[]);
            buffer.fill(tail.last().copied().unwrap_or(0.0));
            buffer.iter_mut().zip(tail).for_each(|(to, from)| *to = *from);
        }
        let mut results = [[0.0; MAX_LANES]; MAX_OUTPUTS];
        for (buffer, slice) in results.iter_mut().zip(&out) {
            let tail = slice.get(whole..count).unwrap_or(&[]);
            buffer.iter_mut().zip(tail).for_each(|(to, from)| *to = *from);
        }
        let buffers = padded.each_ref().map(|buffer| &buffer[..]);
        let to = results.each_mut().map(|buffer| &mut buffer[..]);
        chunks::<F, P, K, C, O>(token, kernel, &inputs, &buffers, to, store, F::LANES);
        for (buffer, slice) in results.iter().zip(&mut out) {
            let tail = slice.get_mut(whole..count).unwrap_or(&mut []);
            tail.iter_mut().zip(buffer).for_each(|(to, from)| *to = *from);
        }
    }
}

/// `count` points, a multiple of the register's width.
#[inline(never)]
fn chunks<F, P, K, C, O>(
    token: F::Token,
    kernel: &K,
    inputs: &C,
    slices: &Slices<'_>,
    mut out: SlicesMut<'_>,
    store: Store,
    count: usize,
) where
    F: Register,
    P: Precision,
    C: Columns,
    O: ColumnsMut,
    K: Kernel<C::At<P::Of<F>>, O::At<P::Of<F>>>,
{
    let slices = *slices;
    let add = matches!(store, Store::Add);
    F::run(
        token,
        #[inline(always)]
        || {
            let mut start = 0;
            while start + F::LANES <= count {
                let mut from = slices.iter();
                let input = inputs.load(
                    &mut || {
                        let chunk = from.next().and_then(|slice| slice.get(start..start + F::LANES));
                        P::number(chunk.map_or_else(|| F::splat(token, 0.0), |chunk| F::read(token, chunk)))
                    },
                    &|x| P::number(F::splat(token, x)),
                );
                let mut to = out.iter_mut();
                O::store(kernel.apply(input), &mut |result| {
                    if let Some(chunk) = to.next().and_then(|slice| slice.get_mut(start..start + F::LANES)) {
                        let result = P::value(result);
                        let sum = if add { F::read(token, chunk) + result } else { result };
                        sum.write(chunk);
                    }
                });
                start += F::LANES;
            }
        },
    );
}

/// `out += Σ kernel(v, light)`, a register of points after the other, each for all lights.
#[inline(never)]
fn run_lights<F, P, K, L>(
    token: F::Token,
    kernel: &K,
    v: Vec3<&[f32]>,
    lights: &[L],
    out: Rgb<&mut [f32]>,
    count: usize,
) where
    F: Register,
    P: Precision,
    L: Columns,
    K: Kernel<(Vec3<P::Of<F>>, L::At<P::Of<F>>), Rgb<P::Of<F>>>,
{
    F::run(
        token,
        #[inline(always)]
        || {
            let mut start = 0;
            while start < count {
                let end = (start + F::LANES).min(count);
                let read = |slice: &[f32]| P::number(read_padded::<F>(token, slice, start, end));
                let v = v.map(read);
                let mut sum = Rgb { r: read(out.r), g: read(out.g), b: read(out.b) };
                for light in lights {
                    let mut slices: Slices<'_> = [&[]; MAX_INPUTS];
                    let mut places = slices.iter_mut();
                    let _ = light.visit(&mut |slice| -> Result<(), ()> {
                        if let Some(place) = places.next() {
                            *place = slice;
                        }
                        Ok(())
                    });
                    let mut from = slices.iter();
                    let light = light.load(
                        &mut || from.next().map_or_else(|| read(&[]), |slice| read(slice)),
                        &|x| P::number(F::splat(token, x)),
                    );
                    sum = sum + kernel.apply((v, light));
                }
                write_partly(P::value(sum.r), out.r, start, end);
                write_partly(P::value(sum.g), out.g, start, end);
                write_partly(P::value(sum.b), out.b, start, end);
                start = end;
            }
        },
    );
}

/// The numbers of a slice from `start` to `end`, the last one again and again in the lanes that are left.
#[inline(always)]
fn read_padded<F: Register>(token: F::Token, slice: &[f32], start: usize, end: usize) -> F {
    match slice.get(start..start + F::LANES) {
        Some(whole) => F::read(token, whole),
        None => F::read(token, &padded(slice.get(start..end).unwrap_or(&[]))),
    }
}

#[cold]
#[inline(never)]
fn padded(tail: &[f32]) -> [f32; MAX_LANES] {
    let mut buffer = [tail.last().copied().unwrap_or(0.0); MAX_LANES];
    buffer.iter_mut().zip(tail).for_each(|(to, from)| *to = *from);
    buffer
}

/// Writes as many lanes as there are numbers from `start` to `end`.
#[inline(always)]
fn write_partly<F: Register>(lanes: F, slice: &mut [f32], start: usize, end: usize) {
    if let Some(whole) = slice.get_mut(start..start + F::LANES) {
        lanes.write(whole);
    } else {
        let mut buffer = [0.0; MAX_LANES];
        lanes.write(&mut buffer);
        copy(slice.get_mut(start..end).unwrap_or(&mut []), &buffer);
    }
}

#[cold]
#[inline(never)]
fn copy(to: &mut [f32], from: &[f32]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
}

/// A [`Kernel`] that runs at every level of this architecture, to the precision `P`: every one that is written over
/// [`Real`] does.
pub trait AtEveryLevel<P: Precision, C: Columns, O: ColumnsMut>: Sealed<P, C, O> {}

/// A [`Kernel`] that runs so for many lights `L`.
pub trait LightsAtEveryLevel<P: Precision, L: Columns>: SealedLights<P, L> {}

mod sealed {
    use super::{Columns, ColumnsMut, Level, Precision, Rgb, Store, Vec3};

    pub trait Sealed<P: Precision, C: Columns, O: ColumnsMut> {
        fn run_at(&self, level: Level, inputs: C, outputs: O, store: Store, count: usize);
    }

    pub trait SealedLights<P: Precision, L: Columns> {
        fn lights_at(&self, level: Level, v: Vec3<&[f32]>, lights: &[L], out: Rgb<&mut [f32]>, count: usize);
    }
}
pub(super) use sealed::{Sealed, SealedLights};

/// The levels of an architecture, from the best; a level that is not among them runs the scalar.
macro_rules! levels {
    ($($variant:ident => $register:ty),*) => {
        impl<P, C, O, K> Sealed<P, C, O> for K
        where
            P: Precision,
            C: Columns,
            O: ColumnsMut,
            K: Kernel<C::At<P::Of<f32>>, O::At<P::Of<f32>>>,
            $(K: Kernel<C::At<P::Of<$register>>, O::At<P::Of<$register>>>,)*
        {
            #[inline]
            fn run_at(&self, level: Level, inputs: C, outputs: O, store: Store, count: usize) {
                match level {
                    $(Level::$variant(simd) => run::<$register, P, K, C, O>(simd, self, inputs, outputs, store, count),)*
                    #[allow(unreachable_patterns, reason = "where the target has a level built in, lower ones do not exist")]
                    _ => run::<f32, P, K, C, O>((), self, inputs, outputs, store, count),
                }
            }
        }

        impl<P, C, O, K> AtEveryLevel<P, C, O> for K
        where
            P: Precision,
            C: Columns,
            O: ColumnsMut,
            K: Kernel<C::At<P::Of<f32>>, O::At<P::Of<f32>>>,
            $(K: Kernel<C::At<P::Of<$register>>, O::At<P::Of<$register>>>,)*
        {
        }

        impl<P, L, K> SealedLights<P, L> for K
        where
            P: Precision,
            L: Columns,
            K: Kernel<(Vec3<P::Of<f32>>, L::At<P::Of<f32>>), Rgb<P::Of<f32>>>,
            $(K: Kernel<(Vec3<P::Of<$register>>, L::At<P::Of<$register>>), Rgb<P::Of<$register>>>,)*
        {
            #[inline]
            fn lights_at(&self, level: Level, v: Vec3<&[f32]>, lights: &[L], out: Rgb<&mut [f32]>, count: usize) {
                match level {
                    $(Level::$variant(simd) => run_lights::<$register, P, K, L>(simd, self, v, lights, out, count),)*
                    #[allow(unreachable_patterns, reason = "where the target has a level built in, lower ones do not exist")]
                    _ => run_lights::<f32, P, K, L>((), self, v, lights, out, count),
                }
            }
        }

        impl<P, L, K> LightsAtEveryLevel<P, L> for K
        where
            P: Precision,
            L: Columns,
            K: Kernel<(Vec3<P::Of<f32>>, L::At<P::Of<f32>>), Rgb<P::Of<f32>>>,
            $(K: Kernel<(Vec3<P::Of<$register>>, L::At<P::Of<$register>>), Rgb<P::Of<$register>>>,)*
        {
        }

        $(impl Register for $register {
            type Token = fearless_simd::$variant;
            const LANES: usize = Self::LANES;
            #[inline(always)]
            fn splat(simd: Self::Token, x: f32) -> Self {
                Wide::splat(simd, x)
            }
            #[inline(always)]
            fn read(simd: Self::Token, slice: &[f32]) -> Self {
                match slice.get(..Self::LANES) {
                    Some(whole) => Wide(SimdBase::from_slice(simd, whole)),
                    None => Wide::splat(simd, 0.0),
                }
            }
            #[inline(always)]
            fn write(self, slice: &mut [f32]) {
                if let Some(whole) = slice.get_mut(..Self::LANES) {
                    self.0.store_slice(whole);
                }
            }
            #[inline(always)]
            fn run(simd: Self::Token, f: impl FnOnce()) {
                Simd::vectorize(simd, f);
            }
        })*
    };
}

// SSE2 alone, which is all that a build for x86-64 may assume, runs the scalar: no machine of the last fifteen years
// stops there, and every level more is code.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
levels! {
    Avx512 => Wide<fearless_simd::Avx512>,
    Avx2 => Wide<fearless_simd::Avx2>,
    Sse4_2 => Wide<fearless_simd::Sse4_2>
}
#[cfg(target_arch = "aarch64")]
levels! { Neon => Wide<fearless_simd::Neon> }
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
levels! { WasmSimd128 => Wide<fearless_simd::WasmSimd128> }
#[cfg(not(any(
    target_arch = "x86",
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
)))]
levels! {}
