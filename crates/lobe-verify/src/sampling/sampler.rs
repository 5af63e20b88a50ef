//! What can be checked: a lobe that implements [`Sample`], or a user's sampler as closures.

use super::claims::Claims;
use crate::subject::Precision;
use lobe::{Rgb, Vec3};
use lobe_sampling::{Outcome, Sample};
use std::fmt;

/// A sampler as a check sees it: vectors are `[x, y, z]` in the local frame, `n = +z`, of unit length.
pub trait Sampler: Sync {
    /// A direction of light for the viewer `v` from three numbers of `[0, 1)`.
    fn sample(&self, v: [f64; 3], u: [f64; 3]) -> Outcome<f64>;

    /// The density in sr⁻¹ with which [`sample`](Self::sample) gives `l`.
    fn pdf(&self, l: [f64; 3], v: [f64; 3]) -> f64;

    /// `f_r (n·l)` and the density beside it, if the sampler knows what it samples: without it, weights are not
    /// checked.
    fn eval_cos_pdf(&self, _l: [f64; 3], _v: [f64; 3]) -> Option<([f64; 3], f64)> {
        None
    }

    /// The number type that it computes in: views and `u` are rounded to it.
    fn precision(&self) -> Precision {
        Precision::Double
    }

    /// What it claims if the user claims nothing.
    fn claims(&self) -> Claims {
        Claims::OTHERS
    }
}

impl<S: Sampler + ?Sized> Sampler for &S {
    fn sample(&self, v: [f64; 3], u: [f64; 3]) -> Outcome<f64> {
        S::sample(self, v, u)
    }
    fn pdf(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        S::pdf(self, l, v)
    }
    fn eval_cos_pdf(&self, l: [f64; 3], v: [f64; 3]) -> Option<([f64; 3], f64)> {
        S::eval_cos_pdf(self, l, v)
    }
    fn precision(&self) -> Precision {
        S::precision(self)
    }
    fn claims(&self) -> Claims {
        S::claims(self)
    }
}

/// A [`Sample`] of `f64`.
#[derive(Clone, Copy, Debug)]
pub struct InDouble<S>(pub S);

/// A [`Sample`] of `f32`.
#[derive(Clone, Copy, Debug)]
pub struct InSingle<S>(pub S);

/// A sampler with claims of its own, for a list of many.
#[derive(Clone, Copy, Debug)]
pub struct Claiming<S> {
    /// The sampler.
    pub sampler: S,
    /// What it claims.
    pub claims: Claims,
}

impl<S: Sampler> Sampler for Claiming<S> {
    fn sample(&self, v: [f64; 3], u: [f64; 3]) -> Outcome<f64> {
        self.sampler.sample(v, u)
    }
    fn pdf(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        self.sampler.pdf(l, v)
    }
    fn eval_cos_pdf(&self, l: [f64; 3], v: [f64; 3]) -> Option<([f64; 3], f64)> {
        self.sampler.eval_cos_pdf(l, v)
    }
    fn precision(&self) -> Precision {
        self.sampler.precision()
    }
    fn claims(&self) -> Claims {
        self.claims
    }
}

fn vector<T>([x, y, z]: [T; 3]) -> Vec3<T> {
    Vec3::new(x, y, z)
}

impl<S: Sample<f64> + Sync> Sampler for InDouble<S> {
    fn sample(&self, v: [f64; 3], u: [f64; 3]) -> Outcome<f64> {
        self.0.sample(vector(v), u).outcome()
    }
    fn pdf(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        self.0.pdf(vector(l), vector(v))
    }
    fn eval_cos_pdf(&self, l: [f64; 3], v: [f64; 3]) -> Option<([f64; 3], f64)> {
        let (value, pdf) = self.0.eval_cos_pdf(vector(l), vector(v));
        Some((value.into(), pdf))
    }
    fn claims(&self) -> Claims {
        Claims::LOBE
    }
}

impl<S: Sample<f32> + Sync> Sampler for InSingle<S> {
    fn sample(&self, v: [f64; 3], u: [f64; 3]) -> Outcome<f64> {
        let (v, u) = (single(v), u.map(|x| x as f32));
        let color = |c: Rgb<f32>| Rgb::new(f64::from(c.r), f64::from(c.g), f64::from(c.b));
        match self.0.sample(v, u).outcome() {
            Outcome::Scattered { l, weight, pdf } => {
                Outcome::Scattered { l: l.map(f64::from), weight: color(weight), pdf: f64::from(pdf) }
            }
            Outcome::Delta { l, weight } => Outcome::Delta { l: l.map(f64::from), weight: color(weight) },
            Outcome::Rejected => Outcome::Rejected,
        }
    }
    fn pdf(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        f64::from(self.0.pdf(single(l), single(v)))
    }
    fn eval_cos_pdf(&self, l: [f64; 3], v: [f64; 3]) -> Option<([f64; 3], f64)> {
        let (value, pdf) = self.0.eval_cos_pdf(single(l), single(v));
        let value: [f32; 3] = value.into();
        Some((value.map(f64::from), f64::from(pdf)))
    }
    fn precision(&self) -> Precision {
        Precision::Single
    }
    fn claims(&self) -> Claims {
        Claims::LOBE
    }
}

fn single(d: [f64; 3]) -> Vec3<f32> {
    vector(d.map(|x| x as f32))
}

/// A user's sampler as two closures, and a third if weights are to be checked.
///
/// ```
/// use lobe::{Rgb, Vec3};
/// use lobe_sampling::Outcome;
/// use lobe_verify::sampling::{OfFn, verify};
/// use std::f64::consts::{FRAC_1_PI, TAU};
///
/// // A white diffuse surface. Its author drew the height evenly: right for the sphere, wrong for the cosine.
/// let sample = |_v: [f64; 3], [_, x, y]: [f64; 3]| {
///     let (sin, cos) = (TAU * y).sin_cos();
///     let r = (1.0 - x * x).sqrt();
///     Outcome::Scattered { l: Vec3::new(r * cos, r * sin, x), weight: Rgb::splat(1.0), pdf: x * FRAC_1_PI }
/// };
/// let pdf = |l: [f64; 3], _v: [f64; 3]| l[2].max(0.0) * FRAC_1_PI;
/// let report = verify("my diffuse", &OfFn::new(sample, pdf));
/// assert!(!report.holds());
/// ```
#[derive(Clone, Copy)]
pub struct OfFn<S, P, E = fn([f64; 3], [f64; 3]) -> [f64; 3]> {
    sample: S,
    pdf: P,
    eval_cos: Option<E>,
}

impl<S, P> OfFn<S, P> {
    /// From `sample(v, u)` and `pdf(l, v)`.
    pub fn new(sample: S, pdf: P) -> Self {
        Self { sample, pdf, eval_cos: None }
    }

    /// With `eval_cos(l, v) = f_r (n·l)` in sr⁻¹, three channels.
    pub fn with_value<E>(self, eval_cos: E) -> OfFn<S, P, E> {
        OfFn { sample: self.sample, pdf: self.pdf, eval_cos: Some(eval_cos) }
    }
}

impl<S, P, E> fmt::Debug for OfFn<S, P, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OfFn").field("eval_cos", &self.eval_cos.is_some()).finish_non_exhaustive()
    }
}

impl<S, P, E> Sampler for OfFn<S, P, E>
where
    S: Fn([f64; 3], [f64; 3]) -> Outcome<f64> + Sync,
    P: Fn([f64; 3], [f64; 3]) -> f64 + Sync,
    E: Fn([f64; 3], [f64; 3]) -> [f64; 3] + Sync,
{
    fn sample(&self, v: [f64; 3], u: [f64; 3]) -> Outcome<f64> {
        (self.sample)(v, u)
    }
    fn pdf(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        (self.pdf)(l, v)
    }
    fn eval_cos_pdf(&self, l: [f64; 3], v: [f64; 3]) -> Option<([f64; 3], f64)> {
        self.eval_cos.as_ref().map(|eval_cos| (eval_cos(l, v), self.pdf(l, v)))
    }
}

/// What can be given to [`verify`](super::verify) as it is: a `Sample<f64>`, a `Sample<f32>`, or a [`Sampler`] such as
/// [`OfFn`].
///
/// `Kind` is found by the compiler, from which of them the type is. A lobe that samples in every number type is wrapped
/// by hand: `InDouble(&lobe)`.
pub trait AsSampler<Kind> {
    /// The value as a sampler.
    fn as_sampler(&self) -> Box<dyn Sampler + '_>;
}

impl<S: Sample<f64> + Sync> AsSampler<crate::subject::kinds::Double> for S {
    fn as_sampler(&self) -> Box<dyn Sampler + '_> {
        Box::new(InDouble(self))
    }
}

impl<S: Sample<f32> + Sync> AsSampler<crate::subject::kinds::Single> for S {
    fn as_sampler(&self) -> Box<dyn Sampler + '_> {
        Box::new(InSingle(self))
    }
}

impl<S: Sampler> AsSampler<crate::subject::kinds::Itself> for S {
    fn as_sampler(&self) -> Box<dyn Sampler + '_> {
        Box::new(self)
    }
}
