//! Sums of lobes: one of them is drawn, and the sample counts for all.

use crate::rules::{nan_of, upwards};
use crate::{Sample, Sampled};
use lobe::{Real, Rgb, Sum, Vec3};

/// The least part of the samples that each of two lobes gets, if it reflects anything.
///
/// Guesses are wrong, and where a lobe that is drawn too seldom is the bright one, weights are `1/probability`. With
/// this floor the weight of a sample is at most 16 times the larger of both lobes' own; without it a lobe whose guess
/// vanishes next to the other's would hardly be drawn at all, while its value is there (test `no_part_is_starved`).
const FLOOR: f64 = 1.0 / 16.0;

/// The probability of the first of two lobes with these guesses.
///
/// A guess of 0 says that there is nothing to draw, and is taken at its word unless both say so.
#[inline(always)]
pub(crate) fn probability<R: Real>((a, b): (R, R)) -> R {
    let (zero, one) = (a.lift(0.0), a.lift(1.0));
    let sum = a + b;
    let none = sum.le(zero);
    let ratio = a / R::select(none, one, sum);
    let held = ratio.max(one.times(FLOOR)).min(one.times(1.0 - FLOOR));
    let ratio = R::select(a.le(zero), zero, R::select(b.le(zero), one, held));
    R::select(none, one.times(0.5), ratio)
}

/// `p a + (1 − p) b`.
#[inline(always)]
pub(crate) fn blend<R: Real>(p: R, a: R, b: R) -> R {
    let one = p.lift(1.0);
    // A part that is never drawn must not spoil the sum where its own density is not finite.
    let part = |p: R, x: R| R::select(p.eq(p.lift(0.0)), p, p * x);
    part(p, a) + part(one - p, b)
}

/// What one part of a mixture has drawn.
#[derive(Clone, Copy)]
pub(crate) struct Part<R: Real> {
    l: Vec3<R>,
    /// The weight of a delta; of all others it is not used.
    weight: Rgb<R>,
    rejected: R::Mask,
    delta: R::Mask,
}

impl<R: Real> Part<R> {
    /// A direction with a density.
    #[inline(always)]
    pub(crate) fn scattered(l: Vec3<R>) -> Self {
        let zero = l.z.lift(0.0);
        let never = zero.lt(zero);
        Self { l, weight: Rgb::splat(zero), rejected: never, delta: never }
    }

    /// What a lobe has drawn, of which `factor` is left.
    #[inline(always)]
    pub(crate) fn of(sampled: Sampled<R>, factor: impl Fn(Vec3<R>) -> Rgb<R>) -> Self {
        let Sampled { l, weight, rejected, delta, .. } = sampled;
        Self { l, weight: weight * factor(l), rejected, delta }
    }

    /// What a lobe has drawn.
    #[inline(always)]
    pub(crate) fn whole(Sampled { l, weight, rejected, delta, .. }: Sampled<R>) -> Self {
        Self { l, weight, rejected, delta }
    }

    #[inline(always)]
    fn select(mask: R::Mask, a: Self, b: Self) -> Self {
        Self {
            l: Vec3::select(mask, a.l, b.l),
            weight: Rgb::select(mask, a.weight, b.weight),
            rejected: (mask & a.rejected) | (!mask & b.rejected),
            delta: (mask & a.delta) | (!mask & b.delta),
        }
    }
}

/// A sample of a lobe with two parts: `u[0]` chooses between them by their guesses, and what is left of it goes to the
/// part.
///
/// The value and the density at the direction are those of the whole, as `whole` says; the weight is their quotient.
/// Neither leaves the range of `f32` where the lobes' own do not: no product of densities is formed. It is the
/// one-sample model of Veach and Guibas 1995, section 4, with the balance heuristic. A delta has its own weight over
/// the probability of its part.
#[inline(always)]
pub(crate) fn one_of_two<R: Real>(
    v: Vec3<R>,
    [choice, x, y]: [R; 3],
    guesses: (R, R),
    a: impl Fn([R; 3]) -> Part<R>,
    b: impl Fn([R; 3]) -> Part<R>,
    whole: impl Fn(Vec3<R>) -> (Rgb<R>, R),
) -> Sampled<R> {
    let (zero, one) = (choice.lift(0.0), choice.lift(1.0));
    let p = probability(guesses);
    let rest = one - p;
    let first = choice.lt(p);
    let chosen = R::select(first, p, rest);
    // Of what is left a number of [0, 1) again. The quotient may round to 1, which no sampler has to take.
    let left = R::select(first, choice, choice - p) / chosen;
    let left = left.min(choice.lift(LAST));
    let part = Part::select(first, a([left, x, y]), b([left, x, y]));

    let nan = nan_of(v, [choice, x, y]);
    let (value, pdf) = whole(part.l);
    let no_density = pdf.eq(zero);
    let scattered = value / R::select(no_density, one, pdf);
    let weight = Rgb::select(part.delta, part.weight / chosen, scattered) + Rgb::splat(nan);
    let below = part.l.z.min(v.z).le(nan);
    // Where the density is 0 and it is no delta, the direction is on the horizon or in no lobe's reach: the value is 0
    // too.
    let rejected = (part.rejected & nan.eq(zero)) | below | (no_density & !part.delta & nan.eq(zero));
    let sampled = Sampled::new(part.l, weight, R::select(part.delta, zero, pdf) + nan, rejected);
    Sampled { delta: part.delta & !rejected, ..sampled }
}

/// The last number of `f32` before 1.
const LAST: f64 = 1.0 - 1.0 / 16_777_216.0;

/// One of both is drawn, in proportion to what they are guessed to reflect, at least every sixteenth time. The density
/// is that of the mixture, so that a direction that both lobes could have drawn counts right whichever did: no weight
/// is larger than 16 times the larger of both lobes' own there.
impl<R: Real, A: Sample<R>, B: Sample<R>> Sample<R> for Sum<A, B> {
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        // Below the horizon the viewer is mirrored up; its sample is rejected, and what both steps need is computed once.
        let up = upwards(v);
        one_of_two(
            v,
            u,
            (self.a.albedo_guess(up), self.b.albedo_guess(up)),
            #[inline(always)]
            |u| Part::whole(self.a.sample(up, u)),
            #[inline(always)]
            |u| Part::whole(self.b.sample(up, u)),
            #[inline(always)]
            |l| self.eval_cos_pdf(l, up),
        )
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let first = probability((self.a.albedo_guess(v), self.b.albedo_guess(v)));
        blend(first, self.a.pdf(l, v), self.b.pdf(l, v))
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let first = probability((self.a.albedo_guess(v), self.b.albedo_guess(v)));
        let ((value_a, pdf_a), (value_b, pdf_b)) = (self.a.eval_cos_pdf(l, v), self.b.eval_cos_pdf(l, v));
        (value_a + value_b, blend(first, pdf_a, pdf_b))
    }
    #[inline(always)]
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        self.a.albedo_guess(v) + self.b.albedo_guess(v)
    }
}
