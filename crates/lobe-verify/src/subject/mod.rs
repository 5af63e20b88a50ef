//! What can be checked: anything that gives values of `f_r` for many pairs of directions at once, and may fail at it.
//!
//! | subject | what it is |
//! |---|---|
//! | [`InDouble`], [`InSingle`] | a [`Brdf`] of `f64` or of `f32` |
//! | [`OfFn`] | a closure `Fn([f64; 3], [f64; 3]) -> [f64; 3]` of `l` and `v` |
//! | [`Program`] | a program that reads and writes the lines of `lobe eval` |
//!
//! A [`Table`] holds samples and has no value in between: it is checked by
//! [`verify_table`](crate::properties::verify_table).

mod error;
mod memory;
mod precision;
mod program;
mod quiet;
mod table;

pub use error::SubjectError;
pub use memory::{InDouble, InSingle, OfFn};
pub use precision::Precision;
pub use program::Program;
pub(crate) use quiet::catch;
pub use table::{Row, Table};

use crate::properties::Claims;
use lobe::Brdf;

/// The directions to the light and to the viewer, `lx, ly, lz, vx, vy, vz`: unit vectors in the local frame, `n = +z`.
pub type Pair = [f64; 6];

/// The three channels of a value in sr⁻¹.
pub type Value = [f64; 3];

/// A BRDF as a check sees it.
///
/// Pairs come in batches, because a program has to be started for each, and can be evaluated in any order.
pub trait Subject: Sync {
    /// `f_r(l, v)` of each pair, in sr⁻¹ and without the cosine: as many values as there are pairs.
    ///
    /// # Errors
    /// A [`SubjectError`], if there is no value for one of them: what went wrong, where, and what would be right.
    fn eval(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError>;

    /// `f_r(l, v) · max(0, n·l)` of each pair. The product, unless the subject has a form of its own for it.
    ///
    /// # Errors
    /// As of [`eval`](Self::eval).
    fn eval_cos(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        let mut values = self.eval(pairs)?;
        for (value, pair) in values.iter_mut().zip(pairs) {
            *value = times_cos(*value, pair);
        }
        Ok(values)
    }

    /// Whether [`eval_cos`](Self::eval_cos) is more than the product.
    fn has_own_cosine(&self) -> bool {
        false
    }

    /// The number type that it computes in: inputs are rounded to it, and defects are counted in its ulps.
    fn precision(&self) -> Precision {
        Precision::Double
    }

    /// What it claims if the user claims nothing.
    fn claims(&self) -> Claims {
        Claims::OTHERS
    }

    /// Whether a NaN can be asked for.
    fn takes_nan(&self) -> bool {
        true
    }

    /// The line on which the pair with this index of a batch is read, if it is read in lines.
    fn line(&self, _index: usize) -> Option<usize> {
        None
    }

    /// The same BRDF point by point, if that costs nothing: an integral can then choose its points as it goes.
    fn pointwise(&self) -> Option<Box<dyn Brdf<f64> + Sync + '_>> {
        None
    }
}

impl<S: Subject + ?Sized> Subject for &S {
    fn eval(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        S::eval(self, pairs)
    }
    fn eval_cos(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        S::eval_cos(self, pairs)
    }
    fn has_own_cosine(&self) -> bool {
        S::has_own_cosine(self)
    }
    fn precision(&self) -> Precision {
        S::precision(self)
    }
    fn claims(&self) -> Claims {
        S::claims(self)
    }
    fn takes_nan(&self) -> bool {
        S::takes_nan(self)
    }
    fn line(&self, index: usize) -> Option<usize> {
        S::line(self, index)
    }
    fn pointwise(&self) -> Option<Box<dyn Brdf<f64> + Sync + '_>> {
        S::pointwise(self)
    }
}

/// `value · max(0, n·l)`; 0 below the horizon, whatever the value is there.
pub(crate) fn times_cos(value: Value, pair: &Pair) -> Value {
    let [_, _, cos, ..] = *pair;
    if cos <= 0.0 { [0.0; 3] } else { value.map(|x| x * cos) }
}

/// What can be given to [`verify`](crate::properties::verify) as it is: a `Brdf<f64>`, a `Brdf<f32>`, a closure or a
/// [`Subject`].
///
/// `Kind` is found by the compiler, from which of them the type is. A lobe that is a `Brdf` in every number type, such
/// as `Black`, is wrapped by hand: `InDouble(&lobe)`.
pub trait AsSubject<Kind> {
    /// The value as a subject.
    fn as_subject(&self) -> Box<dyn Subject + '_>;
}

/// The kinds of [`AsSubject`]: markers that tell its implementations apart, and have no values.
pub mod kinds {
    /// A `Brdf<f64>`.
    #[derive(Debug)]
    pub enum Double {}
    /// A `Brdf<f32>`.
    #[derive(Debug)]
    pub enum Single {}
    /// A closure.
    #[derive(Debug)]
    pub enum Closure {}
    /// A subject already.
    #[derive(Debug)]
    pub enum Itself {}
}

impl<B: Brdf<f64> + Sync> AsSubject<kinds::Double> for B {
    fn as_subject(&self) -> Box<dyn Subject + '_> {
        Box::new(InDouble(self))
    }
}

impl<B: Brdf<f32> + Sync> AsSubject<kinds::Single> for B {
    fn as_subject(&self) -> Box<dyn Subject + '_> {
        Box::new(InSingle(self))
    }
}

impl<F: Fn([f64; 3], [f64; 3]) -> [f64; 3] + Sync> AsSubject<kinds::Closure> for F {
    fn as_subject(&self) -> Box<dyn Subject + '_> {
        Box::new(OfFn::new(self))
    }
}

impl<S: Subject> AsSubject<kinds::Itself> for S {
    fn as_subject(&self) -> Box<dyn Subject + '_> {
        Box::new(self)
    }
}
