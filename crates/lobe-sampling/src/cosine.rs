//! Any BRDF by the cosine: the fallback for a lobe of which nothing is known.

use crate::map::{cosine_hemisphere, cosine_hemisphere_pdf};
use crate::rules::{above, nan_of};
use crate::{Sample, Sampled};
use lobe::{Brdf, Carry, Real, Rgb, Vec3};

/// A lobe with samples in proportion to the cosine: density `(n·l)/π`, weight `π f_r`.
///
/// For any BRDF. The sharper the lobe, the more its weights vary: for a highlight take what knows it.
///
/// ```
/// use lobe::{Brdf, Real, Rgb, Vec3};
/// use lobe_sampling::{ByCosine, Sample};
/// /// Darker towards the edge.
/// struct Felt;
/// impl<R: Real> Brdf<R> for Felt {
///     fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
///         Rgb::splat(R::select(l.z.min(v.z).le(l.z.lift(0.0)), l.z.lift(0.0), l.z * v.z))
///     }
/// }
/// let sample = ByCosine(Felt).sample(Vec3::new(0.6_f64, 0.0, 0.8), [0.5, 0.25, 0.75]);
/// assert!((sample.weight.g - sample.l.z * 0.8 * core::f64::consts::PI).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ByCosine<B>(pub B);

impl<B: Carry> Carry for ByCosine<B> {
    type In<S: Real> = ByCosine<B::In<S>>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
        ByCosine(self.0.carry(lift))
    }
}

impl<R: Real, B: Brdf<R>> Brdf<R> for ByCosine<B> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.0.eval(l, v)
    }
    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.0.eval_cos(l, v)
    }
}

impl<R: Real, B: Brdf<R>> Sample<R> for ByCosine<B> {
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, [choice, x, y]: [R; 3]) -> Sampled<R> {
        let l = cosine_hemisphere([x, y]);
        let nan = nan_of(v, [choice, x, y]);
        let (zero, pdf) = (l.z.lift(0.0), cosine_hemisphere_pdf(l));
        // On the horizon, at the edge of the square, the density is 0; the value with its cosine is too.
        let value = self.0.eval_cos(l, v) / R::select(pdf.le(zero), zero.plus(1.0), pdf);
        Sampled::new(l, value + Rgb::splat(nan), pdf + nan, l.z.min(v.z).le(nan))
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        above(l, v, cosine_hemisphere_pdf(l))
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        (self.0.eval_cos(l, v), self.pdf(l, v))
    }
    /// Half of the light, whatever the lobe: nothing is known of it.
    #[inline(always)]
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        v.z.lift(0.5)
    }
}
