//! Subjects that are values of this program: lobes and closures.

use super::{Pair, Precision, Subject, SubjectError, Value, catch};
use crate::properties::Claims;
use lobe::{Brdf, Rgb, Vec3};
use rayon::prelude::*;
use std::fmt;

/// `f` of each pair, on all cores; a panic names the pair.
fn each(pairs: &[Pair], f: impl Fn(&Pair) -> Value + Sync) -> Result<Vec<Value>, SubjectError> {
    // As many as pay for a thread's attention at 10 ns each.
    const CHUNK: usize = 2048;
    let parts: Vec<Result<Vec<Value>, SubjectError>> = pairs
        .par_chunks(CHUNK)
        .map(|chunk| {
            let mut done = Vec::with_capacity(chunk.len());
            let caught = catch(|| chunk.iter().for_each(|pair| done.push(f(pair))));
            match caught {
                Ok(()) => Ok(done),
                Err(message) => {
                    let pair = chunk.get(done.len()).copied().unwrap_or([f64::NAN; 6]);
                    Err(SubjectError::Panicked { pair, message })
                }
            }
        })
        .collect();
    // One after the other, so that the first pair that panics is named each time.
    let mut values = Vec::with_capacity(pairs.len());
    for part in parts {
        values.extend(part?);
    }
    Ok(values)
}

fn directions(&[lx, ly, lz, vx, vy, vz]: &Pair) -> (Vec3<f64>, Vec3<f64>) {
    (Vec3::new(lx, ly, lz), Vec3::new(vx, vy, vz))
}

fn single(d: Vec3<f64>) -> Vec3 {
    d.map(|x| x as f32)
}

fn value(f: Rgb<f64>) -> Value {
    f.into()
}

/// A [`Brdf`] in `f64`.
#[derive(Clone, Copy, Debug)]
pub struct InDouble<'a, B>(pub &'a B);

impl<B: Brdf<f64> + Sync> Subject for InDouble<'_, B> {
    fn eval(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        each(pairs, |pair| {
            let (l, v) = directions(pair);
            value(self.0.eval(l, v))
        })
    }
    fn eval_cos(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        each(pairs, |pair| {
            let (l, v) = directions(pair);
            value(self.0.eval_cos(l, v))
        })
    }
    fn has_own_cosine(&self) -> bool {
        true
    }
    fn claims(&self) -> Claims {
        Claims::LOBE
    }
    fn pointwise(&self) -> Option<Box<dyn Brdf<f64> + Sync + '_>> {
        Some(Box::new(self.0))
    }
}

/// A [`Brdf`] in `f32`: directions are rounded to it first.
#[derive(Clone, Copy, Debug)]
pub struct InSingle<'a, B>(pub &'a B);

impl<B: Brdf<f32> + Sync> Subject for InSingle<'_, B> {
    fn eval(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        each(pairs, |pair| {
            let (l, v) = directions(pair);
            value(Rounded(self.0).eval(l, v))
        })
    }
    fn eval_cos(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        each(pairs, |pair| {
            let (l, v) = directions(pair);
            value(Rounded(self.0).eval_cos(l, v))
        })
    }
    fn has_own_cosine(&self) -> bool {
        true
    }
    fn precision(&self) -> Precision {
        Precision::Single
    }
    fn claims(&self) -> Claims {
        Claims::LOBE
    }
    fn pointwise(&self) -> Option<Box<dyn Brdf<f64> + Sync + '_>> {
        Some(Box::new(Rounded(self.0)))
    }
}

/// A BRDF in `f32` for directions in `f64`. Not [`InSingle`] itself, which would be two kinds of subject at once.
struct Rounded<'a, B>(&'a B);

impl<B: Brdf<f32>> Brdf<f64> for Rounded<'_, B> {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.0.eval(single(l), single(v)).map(f64::from)
    }
    fn eval_cos(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.0.eval_cos(single(l), single(v)).map(f64::from)
    }
}

/// A closure `Fn([f64; 3], [f64; 3]) -> [f64; 3]` of `l` and `v`: `f_r` in sr⁻¹, without the cosine.
#[derive(Clone, Copy)]
pub struct OfFn<F> {
    f: F,
    precision: Precision,
}

impl<F: Fn([f64; 3], [f64; 3]) -> [f64; 3]> OfFn<F> {
    /// The closure, which computes in `f64`.
    pub fn new(f: F) -> Self {
        Self { f, precision: Precision::Double }
    }

    /// The closure, which computes in `f32` inside: it gets directions of `f32`.
    pub fn in_single(f: F) -> Self {
        Self { f, precision: Precision::Single }
    }
}

impl<F: Fn([f64; 3], [f64; 3]) -> [f64; 3] + Sync> Subject for OfFn<F> {
    fn eval(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        each(pairs, |pair| {
            let [lx, ly, lz, vx, vy, vz] = pair.map(|x| self.precision.round(x));
            (self.f)([lx, ly, lz], [vx, vy, vz])
        })
    }
    fn precision(&self) -> Precision {
        self.precision
    }
}

impl<F> fmt::Debug for OfFn<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OfFn").field("precision", &self.precision).finish_non_exhaustive()
    }
}
