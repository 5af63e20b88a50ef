//! The trait [`Sample`], and what a sample is.

use lobe::{Real, Rgb, Vec3};

/// What can be sampled: for a viewer, directions of light with a density that follows the lobe.
///
/// For every lobe, in every number type:
///
/// - `weight = f_r(l, v) (n·l)/pdf(l, v)`, in a form that does not divide a large number by another;
/// - `u` are three numbers of `[0, 1)`, the first for choices among lobes, the others for the direction. Every result
///   is finite for each of them: 0, the last number before 1, subnormal numbers;
/// - a viewer below the horizon (`v.z ≤ 0`) gets a rejected sample; NaN in `v` or in `u` gives a NaN weight.
///
/// The trait can be made into an object: `&dyn Sample<f32>`.
pub trait Sample<R: Real> {
    /// A direction of light for the viewer `v`, with its weight and its density.
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R>;

    /// The density in sr⁻¹ with which [`sample`](Self::sample) gives `l`, 0 below the horizon. It integrates to 1 less
    /// the mass that is rejected or that goes into deltas.
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R;

    /// [`eval_cos`](lobe::Brdf::eval_cos) and [`pdf`](Self::pdf), which have much in common: what a renderer needs that
    /// weighs several samplers, see [`mis`](crate::mis). Of a delta both are 0.
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R);

    /// About how much of the light is reflected to `v`, as luminance: what a sum of lobes divides its samples by. Not
    /// negative and finite, but no more than a guess.
    fn albedo_guess(&self, v: Vec3<R>) -> R;
}

impl<R: Real, B: Sample<R> + ?Sized> Sample<R> for &B {
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        B::sample(self, v, u)
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        B::pdf(self, l, v)
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        B::eval_cos_pdf(self, l, v)
    }
    #[inline(always)]
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        B::albedo_guess(self, v)
    }
}

/// A sample: a direction of light and what it counts for, or none. In lanes each point has its own case, told by two
/// masks; of a scalar [`outcome`](Self::outcome) makes an `enum`.
#[derive(Clone, Copy, Debug)]
pub struct Sampled<R: Real> {
    /// Where the light comes from: a unit vector, of a rejected sample too.
    pub l: Vec3<R>,
    /// What the radiance from there counts for: `f_r (n·l)/pdf`, of a delta its reflectance. 0 where the sample is
    /// rejected.
    pub weight: Rgb<R>,
    /// The density in sr⁻¹; 0 where the sample is rejected or a delta.
    pub pdf: R,
    /// Where there is no sample: what was drawn lies below the horizon. It counts as a sample of weight 0.
    pub rejected: R::Mask,
    /// Where the direction is one that a density cannot have, as that of a mirror.
    pub delta: R::Mask,
}

impl<R: Real> Sampled<R> {
    /// A sample with a density, or none where the mask is true. Where a weight is NaN, it is no rejection that hides
    /// it.
    #[inline(always)]
    pub fn new(l: Vec3<R>, weight: Rgb<R>, pdf: R, rejected: R::Mask) -> Self {
        let zero = pdf.lift(0.0);
        Self {
            l,
            weight: Rgb::select(rejected, Rgb::splat(zero), weight),
            pdf: R::select(rejected, zero, pdf),
            rejected,
            delta: zero.lt(zero),
        }
    }

    /// `a` where the mask is true, `b` elsewhere.
    #[inline(always)]
    pub fn select(mask: R::Mask, a: Self, b: Self) -> Self {
        Self {
            l: Vec3::select(mask, a.l, b.l),
            weight: Rgb::select(mask, a.weight, b.weight),
            pdf: R::select(mask, a.pdf, b.pdf),
            rejected: (mask & a.rejected) | (!mask & b.rejected),
            delta: (mask & a.delta) | (!mask & b.delta),
        }
    }
}

impl<R: Real<Mask = bool>> Sampled<R> {
    /// Which of the three cases it is.
    #[inline(always)]
    pub fn outcome(self) -> Outcome<R> {
        let Self { l, weight, pdf, rejected, delta } = self;
        if rejected {
            Outcome::Rejected
        } else if delta {
            Outcome::Delta { l, weight }
        } else {
            Outcome::Scattered { l, weight, pdf }
        }
    }
}

/// What became of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome<R = f32> {
    /// A direction out of a density.
    Scattered {
        /// Where the light comes from.
        l: Vec3<R>,
        /// `f_r (n·l)/pdf`.
        weight: Rgb<R>,
        /// The density in sr⁻¹.
        pdf: R,
    },
    /// The one direction of a mirror.
    Delta {
        /// Where the light comes from.
        l: Vec3<R>,
        /// The reflectance.
        weight: Rgb<R>,
    },
    /// None: it counts as a sample of weight 0.
    Rejected,
}
