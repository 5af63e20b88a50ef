//! Lobes over slices, at the speed of the machine and to the precision that the caller picks.
//!
//! ```
//! use lobe::batch::Batch;
//! use lobe::number::Fast;
//! use lobe::{Alpha, Microfacet, Rgb, Vec3, distribution::Ggx, fresnel::Schlick, masking::SmithCorrelated};
//!
//! // A structure of arrays: every component a slice of its own.
//! let l = Vec3::new(&[0.6_f32, 0.0, 0.48][..], &[0.0, 0.8, 0.6], &[0.8, 0.6, 0.64]);
//! let v = Vec3::new(&[0.0_f32, 0.6, 0.0][..], &[0.0, 0.0, 0.6], &[1.0, 0.8, 0.8]);
//! let (mut r, mut g, mut b) = ([0.0_f32; 3], [0.0; 3], [0.0; 3]);
//! let out = Rgb { r: &mut r[..], g: &mut g, b: &mut b };
//!
//! let gold = Microfacet::new(Ggx::new(Alpha(0.2)), SmithCorrelated, Schlick::new(Rgb::new(1.0_f32, 0.77, 0.34)));
//! Batch::new().precision::<Fast>().eval_cos(&gold, l, v, out)?;
//! assert!(r[0] > g[0] && g[0] > b[0]);
//! # Ok::<(), lobe::batch::LengthError>(())
//! ```
//!
//! # What goes in and out
//!
//! Anything that is made of slices ([`Columns`]): `&[f32]` is a number for each point, `Vec3<&[f32]>` a direction,
//! `Rgb<&[f32]>` a colour, [`Uniform`] the same number for all, and tuples of these. What is computed is a [`Kernel`],
//! written once over [`Real`](crate::Real) like every formula of this crate: [`Eval`], [`EvalCos`], [`Shade`], [`InWorld`], or one of
//! yours. So a textured material is a kernel that builds its lobe from what comes in:
//!
//! ```
//! use lobe::batch::{Batch, Kernel, Uniform};
//! use lobe::{Alpha, Brdf, MetallicRoughness, Real, Rgb, Vec3};
//!
//! struct Painted;
//! impl<R: Real> Kernel<(Vec3<R>, Vec3<R>, Rgb<R>, R, R), Rgb<R>> for Painted {
//!     #[inline(always)]
//!     fn apply(&self, (l, v, base_color, metallic, alpha): (Vec3<R>, Vec3<R>, Rgb<R>, R, R)) -> Rgb<R> {
//!         MetallicRoughness::new(base_color, metallic, Alpha(alpha)).eval_cos(l, v)
//!     }
//! }
//!
//! let up = Vec3::new(Uniform(0.0), Uniform(0.0), Uniform(1.0));
//! let (red, rest, alpha) = ([0.9, 0.5, 0.1, 0.7, 0.3], [0.2; 5], [0.1, 0.2, 0.3, 0.4, 0.5]);
//! let base_color = Rgb { r: &red[..], g: &rest, b: &rest };
//! let (mut r, mut g, mut b) = ([0.0; 5], [0.0; 5], [0.0; 5]);
//! let out = Rgb { r: &mut r[..], g: &mut g, b: &mut b };
//! Batch::new().run(&Painted, (up, up, base_color, Uniform(0.0), &alpha[..]), out)?;
//! assert!(r[0] > r[1] && r[1] > r[2]);
//! # Ok::<(), lobe::batch::LengthError>(())
//! ```
//!
//! Slices of unequal length are an error, and nothing is written. What is left over at the end, less than a register,
//! goes through the same instructions: the result for a point does not depend on how many others there are.
//!
//! # Precision
//!
//! [`Precise`] lanes give the bits of the scalar `f32`, at every level.
//! [`Fast`](crate::number::Fast) and [`Coarse`](crate::number::Coarse) trade digits for speed; `docs/trade.md` has the
//! measured table of all lobes.
//!
//! # Without `std`
//!
//! What the machine can do is asked once by [`Batch::new`], which needs `std`; without, pass a [`Level`]. Where there are
//! no lanes, the same calls run the scalar formula.

mod columns;
mod kernel;
mod level;

pub use columns::{Columns, ColumnsMut, Uniform};
pub use fearless_simd::Level;
pub use kernel::{Eval, EvalCos, InWorld, Kernel, OneChannel, Shade};
use level::SealedLights as _;
pub use level::{AtEveryLevel, LightsAtEveryLevel, levels};

use crate::number::{Precise, Precision};
use crate::{Rgb, Vec3};
use core::convert::Infallible;
use core::marker::PhantomData;

/// How a batch is run: at which SIMD level, and to which precision.
#[derive(Clone, Copy, Debug)]
pub struct Batch<P = Precise> {
    level: Level,
    precision: PhantomData<P>,
}

/// A slice that is not as long as the first one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthError {
    /// Which slice it is, counted from 0 in the order of the arguments, inputs first.
    pub index: usize,
    /// How long it is.
    pub length: usize,
    /// How long the first one is.
    pub expected: usize,
}

impl core::fmt::Display for LengthError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { index, length, expected } = self;
        write!(f, "slice {index} of the batch has {length} numbers, slice 0 has {expected}; all must be equally long")
    }
}

impl core::error::Error for LengthError {}

impl Batch {
    /// Bit-exact, at the best level that this machine has.
    #[cfg(feature = "std")]
    #[must_use]
    pub fn new() -> Self {
        Self::at(Level::new())
    }

    /// Bit-exact, at the given level.
    #[must_use]
    pub const fn at(level: Level) -> Self {
        Self { level, precision: PhantomData }
    }
}

#[cfg(feature = "std")]
impl Default for Batch {
    fn default() -> Self {
        Self::new()
    }
}

impl<P: Precision> Batch<P> {
    /// The same level, to the precision `Q`.
    #[must_use]
    pub const fn precision<Q: Precision>(self) -> Batch<Q> {
        Batch { level: self.level, precision: PhantomData }
    }

    /// The level.
    #[must_use]
    pub const fn level(&self) -> Level {
        self.level
    }

    /// Writes what `kernel` makes of each point of `inputs` to `outputs`.
    ///
    /// # Errors
    /// [`LengthError`] if the slices are not equally long; then nothing is written.
    #[inline]
    pub fn run<K, C, O>(&self, kernel: K, inputs: C, outputs: O) -> Result<(), LengthError>
    where
        C: Columns,
        O: ColumnsMut,
        K: AtEveryLevel<P, C, O>,
    {
        let count = common_length(&inputs, &outputs)?;
        kernel.run_at::<false>(self.level, inputs, outputs, count);
        Ok(())
    }

    /// Adds what `kernel` makes of each point of `inputs` to `outputs`.
    ///
    /// # Errors
    /// As for [`run`](Self::run).
    #[inline]
    pub fn accumulate<K, C, O>(&self, kernel: K, inputs: C, outputs: O) -> Result<(), LengthError>
    where
        C: Columns,
        O: ColumnsMut,
        K: AtEveryLevel<P, C, O>,
    {
        let count = common_length(&inputs, &outputs)?;
        kernel.run_at::<true>(self.level, inputs, outputs, count);
        Ok(())
    }

    /// [`eval`](crate::Brdf::eval) of each pair of directions.
    ///
    /// # Errors
    /// As for [`run`](Self::run).
    #[inline]
    pub fn eval<'a, B: Copy>(
        &self,
        lobe: &B,
        l: Vec3<&'a [f32]>,
        v: Vec3<&'a [f32]>,
        out: Rgb<&'a mut [f32]>,
    ) -> Result<(), LengthError>
    where
        Eval<B>: AtEveryLevel<P, (Vec3<&'a [f32]>, Vec3<&'a [f32]>), Rgb<&'a mut [f32]>>,
    {
        self.run(Eval(*lobe), (l, v), out)
    }

    /// [`eval_cos`](crate::Brdf::eval_cos) of each pair of directions.
    ///
    /// # Errors
    /// As for [`run`](Self::run).
    #[inline]
    pub fn eval_cos<'a, B: Copy>(
        &self,
        lobe: &B,
        l: Vec3<&'a [f32]>,
        v: Vec3<&'a [f32]>,
        out: Rgb<&'a mut [f32]>,
    ) -> Result<(), LengthError>
    where
        EvalCos<B>: AtEveryLevel<P, (Vec3<&'a [f32]>, Vec3<&'a [f32]>), Rgb<&'a mut [f32]>>,
    {
        self.run(EvalCos(*lobe), (l, v), out)
    }

    /// Adds the light of all `lights` that each point sends to its viewer: `out += Σ eval_cos(lᵢ, v) Eᵢ`.
    ///
    /// One pass over the points: what depends on the viewer alone is computed once, and nothing is stored between two
    /// lights. The terms are added in the order of the lights.
    ///
    /// # Errors
    /// As for [`run`](Self::run); the slices of a light count as further inputs.
    #[inline]
    pub fn shade_lights<B: Copy, L>(
        &self,
        lobe: &B,
        v: Vec3<&[f32]>,
        lights: &[L],
        out: Rgb<&mut [f32]>,
    ) -> Result<(), LengthError>
    where
        L: Columns,
        Shade<B>: LightsAtEveryLevel<P, L>,
    {
        let mut lengths = Lengths::default();
        v.visit(&mut |slice| lengths.check(slice))?;
        lights.iter().try_for_each(|light| light.visit(&mut |slice| lengths.check(slice)))?;
        out.visit(&mut |slice| lengths.check(slice))?;
        Shade(*lobe).lights_at(self.level, v, lights, out, lengths.count());
        Ok(())
    }
}

/// The length that all slices have.
///
/// A look at each length and no branch; which slice it is that differs is found out apart, or a short batch would spend more
/// time here than in its loop.
#[inline(always)]
fn common_length(inputs: &impl Columns, outputs: &impl ColumnsMut) -> Result<usize, LengthError> {
    let (mut first, mut same) = (None, true);
    let mut look = |slice: &[f32]| -> Result<(), Infallible> {
        same &= *first.get_or_insert(slice.len()) == slice.len();
        Ok(())
    };
    let (Ok(()), Ok(())) = (inputs.visit(&mut look), outputs.visit(&mut look));
    if same { Ok(first.unwrap_or(0)) } else { find_length(inputs, outputs) }
}

/// The same, with the slice that is not as long.
#[cold]
#[inline(never)]
fn find_length(inputs: &impl Columns, outputs: &impl ColumnsMut) -> Result<usize, LengthError> {
    let mut lengths = Lengths::default();
    inputs.visit(&mut |slice| lengths.check(slice))?;
    outputs.visit(&mut |slice| lengths.check(slice))?;
    Ok(lengths.count())
}

/// Compares the length of each slice with that of the first.
#[derive(Default)]
struct Lengths {
    first: Option<usize>,
    seen: usize,
}

impl Lengths {
    fn check(&mut self, slice: &[f32]) -> Result<(), LengthError> {
        let expected = *self.first.get_or_insert(slice.len());
        let found = LengthError { index: self.seen, length: slice.len(), expected };
        self.seen += 1;
        if found.length == expected { Ok(()) } else { Err(found) }
    }

    fn count(&self) -> usize {
        self.first.unwrap_or(0)
    }
}
