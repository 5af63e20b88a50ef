//! Certified statements: bounds that hold for *every* direction and parameter of a box, proved by adaptive subdivision.
//!
//! A test by samples says that no fault was found. A certificate says that there is none: the box is cut into smaller
//! ones until, on each, the formula over [`Interval`] is within its limits (branch and bound;
//! Moore, Kearfott and Cloud, *Introduction to Interval Analysis*, 2009, chapters 5 and 9). It is the source of the lobe
//! itself that is evaluated, so it is the code that is verified, not a copy of its formula.
//!
//! | statement | by | what it says |
//! |---|---|---|
//! | [`range::prove`] | [`Quantity`] | a quantity is defined, finite and within limits: `0 ≤ F ≤ 1`, `G ≤ 1` |
//! | [`range::prove_lobe`] | [`Family`] | `f_r cos θ` of a lobe is defined, finite and not negative |
//! | [`albedo::prove`] | [`Family`] | the directional albedo is at most a limit, for every view and every parameter |
//!
//! All are about the formula in real numbers, with the constants of its source: what rounding adds in `f32` is measured
//! elsewhere in this crate. See [`interval`](crate::interval) for what is enclosed, and how.
//!
//! The outcome is a [`Certificate`], which holds its own proof as a text and can be checked again without any search; a
//! [`Counterexample`], a point at which the lower bound itself violates the limit; or it stays [`Open`]. The search is
//! the same on every machine and with any number of threads.
//!
//! ```
//! use lobe::{Brdf, Phong, Real, Rgb, Shininess};
//! use lobe_verify::certify::{Axis, Effort, Family, Outcome, Symmetry, albedo};
//!
//! /// Phong's lobe, with exponents from 1 to 2.
//! struct Soft;
//! impl Family for Soft {
//!     fn name(&self) -> String {
//!         "phong".into()
//!     }
//!     fn parameters(&self) -> Vec<Axis> {
//!         vec![Axis::linear("q", 1.0, 2.0)]
//!     }
//!     fn symmetry(&self) -> Symmetry {
//!         Symmetry::Isotropic
//!     }
//!     fn lobe<R: Real>(&self, one: R, parameters: &[R]) -> impl Brdf<R> {
//!         Phong::new(Rgb::splat(one), Shininess(parameters[0]))
//!     }
//! }
//!
//! // For every view from the normal to 45° no more than 102 % of the light is reflected.
//! let outcome = albedo::prove(&Soft, Axis::linear("view", 0.0, 0.25), 1.02, &Effort::QUICK);
//! let Outcome::Certified(certificate) = outcome else { panic!("{outcome}") };
//! assert!(certificate.bound.1 <= 1.02);
//! assert!(albedo::check(&Soft, &certificate).holds());
//! ```

pub mod albedo;
pub mod models;
mod number;
pub mod range;
mod search;
mod slopes;

pub use models::{Claim, certificates, claims};
pub use number::Number;
pub use slopes::Slopes;

use crate::interval::Interval;
use lobe::{Brdf, Real, Rgb};
use std::fmt;

/// How an axis is halved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// In the middle.
    Linear,
    /// At the geometric mean: for numbers over many orders of magnitude. Both ends are positive.
    Logarithmic,
    /// At the geometric mean of `1 + x`, less 1: for numbers from 0 over many orders of magnitude.
    Shifted,
}

/// A variable of a statement, and the range for which it is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it is: `"alpha"`, `"n_dot_v"`.
    pub name: &'static str,
    /// From here.
    pub lo: f64,
    /// To here.
    pub hi: f64,
    /// How it is halved.
    pub scale: Scale,
}

impl Axis {
    /// From `lo` to `hi`, halved in the middle.
    pub fn linear(name: &'static str, lo: f64, hi: f64) -> Self {
        Self { name, lo, hi, scale: Scale::Linear }
    }

    /// From `lo > 0` to `hi`, halved at the geometric mean.
    pub fn logarithmic(name: &'static str, lo: f64, hi: f64) -> Self {
        Self { name, lo, hi, scale: Scale::Logarithmic }
    }

    /// From `lo ≥ 0` to `hi`, halved at the geometric mean of `1 + x`.
    pub fn shifted(name: &'static str, lo: f64, hi: f64) -> Self {
        Self { name, lo, hi, scale: Scale::Shifted }
    }

    /// All of it.
    pub(crate) fn whole(&self) -> Interval {
        Interval::new(self.lo, self.hi)
    }

    /// The two halves of a part of it.
    pub(crate) fn halves(&self, part: Interval) -> (Interval, Interval) {
        let middle = match self.scale {
            Scale::Linear => part.middle(),
            Scale::Logarithmic => (part.lo.sqrt() * part.hi.sqrt()).clamp(part.lo, part.hi),
            Scale::Shifted => ((1.0 + part.lo).sqrt() * (1.0 + part.hi).sqrt() - 1.0).clamp(part.lo, part.hi),
        };
        (Interval::new(part.lo, middle), Interval::new(middle, part.hi))
    }

    /// The size of a part, as a share of the whole.
    pub(crate) fn share(&self, part: Interval) -> f64 {
        let size = |a: f64, b: f64| match self.scale {
            Scale::Linear => b - a,
            Scale::Logarithmic => (b / a).ln(),
            Scale::Shifted => ((1.0 + b) / (1.0 + a)).ln(),
        };
        let whole = size(self.lo, self.hi);
        if whole > 0.0 { size(part.lo, part.hi) / whole } else { 0.0 }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} in [{:?}, {:?}]", self.name, self.lo, self.hi)
    }
}

/// A number that depends on some others, written once over the number type.
pub trait Quantity: Sync {
    /// What it is.
    fn name(&self) -> String;
    /// What it depends on: at most ten numbers, the first eight of which have slopes.
    fn axes(&self) -> Vec<Axis>;
    /// Its value, for as many numbers as there are axes.
    fn value<R: Number>(&self, x: &[R]) -> R;
}

/// Whether a lobe looks the same when light and viewer are turned around the normal together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// It does, and it is its own mirror image: `f_r` depends on the two cosines and the size of the angle between the
    /// planes. Proofs are made for a viewer in the xz plane and for light from one side of it.
    Isotropic,
    /// It does not. Proofs are made for all azimuths of both.
    None,
}

/// A lobe with parameters: [`Phong`](lobe::Phong) with all exponents of a range, say.
pub trait Family: Sync {
    /// What it is.
    fn name(&self) -> String;
    /// Its parameters, with their ranges.
    fn parameters(&self) -> Vec<Axis>;
    /// Its symmetry. A family that says it is isotropic and is not gets certificates that mean nothing.
    fn symmetry(&self) -> Symmetry;
    /// The lobe, for as many numbers as there are parameters. `one` is 1, the witness for constants.
    fn lobe<R: Real>(&self, one: R, parameters: &[R]) -> impl Brdf<R>;
    /// The channel that the statement is about: green, unless overridden.
    fn channel<R: Real>(&self, color: Rgb<R>) -> R {
        color.g
    }
}

/// How much work a proof may take. More work never makes a statement false: it makes fewer of them [`Open`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Boxes that are looked at for a bound of a quantity, and cells of all quadratures for that of an albedo.
    pub work: usize,
    /// Cells of the quadrature for one box.
    pub cells: usize,
    /// Whether [`claims`] takes the wide domains, or those of a test that must be quick.
    pub wide: bool,
}

impl Effort {
    /// Some seconds.
    pub const QUICK: Self = Self { work: 1 << 20, cells: 1 << 12, wide: false };
    /// Some minutes.
    pub const FULL: Self = Self { work: 1 << 23, cells: 1 << 14, wide: true };
}

/// A statement that is proved, and its proof.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// What is bounded: `"directional albedo of phong"`.
    pub name: String,
    /// For which box.
    pub axes: Vec<Axis>,
    /// Between which limits it lies, as was to be proved.
    pub limits: (f64, f64),
    /// Between which bounds it lies, as is proved: the lowest and the highest of all boxes. The lower one of an albedo is
    /// that of the boxes as they are, which nobody tried to make tight.
    pub bound: (f64, f64),
    /// Boxes that the proof consists of.
    pub boxes: usize,
    /// Cells of all quadratures; 0 if there is none.
    pub cells: usize,
    /// The subdivision, from which everything can be computed again: a digit halves that axis, and the proofs of the lower
    /// and the upper half follow; `.` is a box that is within the limits. Where there is a quadrature, the box holds in
    /// parentheses how its cells are cut: `a` across the angle from the normal, `b` across the azimuth.
    pub proof: String,
}

/// A point at which a statement is false, and the interval of the value there, all of which is beyond the limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// What is bounded.
    pub name: String,
    /// Its axes, in the order of the point.
    pub axes: Vec<Axis>,
    /// Between which limits it should be.
    pub limits: (f64, f64),
    /// Where it is not.
    pub point: Vec<f64>,
    /// What it is there.
    pub value: Interval,
}

/// A statement that was neither proved nor refuted with the given effort.
#[derive(Clone, Debug, PartialEq)]
pub struct Open {
    /// What is bounded.
    pub name: String,
    /// Its axes.
    pub axes: Vec<Axis>,
    /// Between which limits it should be.
    pub limits: (f64, f64),
    /// The worst of the boxes that stay open.
    pub region: Vec<Interval>,
    /// What is known there.
    pub bound: Interval,
    /// How many boxes stay open.
    pub open: usize,
    /// How many are proved.
    pub boxes: usize,
    /// Cells of all quadratures that were computed.
    pub cells: usize,
}

/// What came of a proof.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It is true.
    Certified(Certificate),
    /// It is false.
    Refuted(Counterexample),
    /// It is not known.
    Open(Open),
}

impl Outcome {
    /// Whether it is proved.
    pub fn is_certified(&self) -> bool {
        matches!(self, Self::Certified(_))
    }

    /// Whether it is proved to be false.
    pub fn is_refuted(&self) -> bool {
        matches!(self, Self::Refuted(_))
    }
}

/// What came of checking a certificate again.
#[derive(Clone, Debug, PartialEq)]
pub enum Recheck {
    /// Every box of the proof is within the limits, and together they are the whole.
    Holds,
    /// This box is not.
    Fails(Vec<Interval>, Interval),
    /// The proof is no text of this kind, or is about other axes; the position in bytes at which that is seen.
    Malformed(usize),
}

impl Recheck {
    /// Whether the certificate is valid.
    pub fn holds(&self) -> bool {
        *self == Self::Holds
    }
}

/// Six decimals, or for what is large six digits and a power of ten.
fn digits(x: f64) -> String {
    if x.abs() < 1e7 { format!("{x:.6}") } else { format!("{x:.6e}") }
}

/// `name: a in [0, 1], b in [0, 2]`.
fn headline(f: &mut fmt::Formatter<'_>, name: &str, axes: &[Axis], limits: (f64, f64)) -> fmt::Result {
    match limits {
        (f64::NEG_INFINITY, most) => write!(f, "{name} at most {most:?}")?,
        (least, f64::MAX) => write!(f, "{name} finite and at least {least:?}")?,
        (least, most) => write!(f, "{name} in [{least:?}, {most:?}]")?,
    }
    for (i, axis) in axes.iter().enumerate() {
        write!(f, "{} {axis}", if i == 0 { " for" } else { "," })?;
    }
    Ok(())
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("certified: ")?;
        headline(f, &self.name, &self.axes, self.limits)?;
        write!(f, "; within [{}, {}], {} boxes", digits(self.bound.0), digits(self.bound.1), self.boxes)?;
        if self.cells > 0 { write!(f, ", {} cells", self.cells) } else { Ok(()) }
    }
}

impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("refuted: ")?;
        headline(f, &self.name, &self.axes, self.limits)?;
        write!(f, "; between {:.6} and {:.6} at", self.value.lo, self.value.hi)?;
        self.axes.iter().zip(&self.point).try_for_each(|(axis, x)| write!(f, " {} = {x}", axis.name))
    }
}

impl fmt::Display for Open {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("open: ")?;
        headline(f, &self.name, &self.axes, self.limits)?;
        write!(
            f,
            "; {} boxes proved, {} open, at worst [{:.6}, {:.6}] for",
            self.boxes, self.open, self.bound.lo, self.bound.hi
        )?;
        let parts = self.axes.iter().zip(&self.region);
        parts.into_iter().try_for_each(|(axis, x)| write!(f, " {} in [{}, {}]", axis.name, x.lo, x.hi))
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Certified(certificate) => certificate.fmt(f),
            Self::Refuted(counterexample) => counterexample.fmt(f),
            Self::Open(open) => open.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests;
