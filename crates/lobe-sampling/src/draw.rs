//! What the samplers of single lobes share: the trait [`Draw`], from which [`Sample`](crate::Sample) follows, and a few
//! maps.

use crate::Sampled;
use crate::map::{azimuth, cosine_hemisphere};
use crate::rules::{above, nan_of};
use core::f64::consts::{FRAC_1_PI, PI};
use lobe::{Brdf, Real, Rgb, Vec3};

/// What is particular to the sampler of a lobe: by the cosine, where it says nothing else. The horizon and NaN are the
/// same for all: [`sample`], [`pdf`].
pub(crate) trait Draw<R: Real>: Brdf<R> {
    /// A unit vector, finite for each `u` in `[0, 1)³` and each unit vector `v`.
    #[inline(always)]
    fn direction(&self, _: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        cosine_hemisphere([x, y])
    }
    /// The density of `l` in sr⁻¹, where both directions are above the horizon; elsewhere it is not used.
    #[inline(always)]
    fn density(&self, l: Vec3<R>, _: Vec3<R>) -> R {
        l.z.times(FRAC_1_PI)
    }
    /// `f_r (n·l)/pdf`, with what both have in common cancelled; `pdf` is that of [`density`](Self::density), above 0.
    ///
    /// By the cosine it is `π f_r`.
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, _: R) -> Rgb<R> {
        let value = self.eval(l, v);
        Rgb::new(value.r.times(PI), value.g.times(PI), value.b.times(PI))
    }
    /// About the albedo at `v`, above the horizon, as luminance.
    fn guess(&self, v: Vec3<R>) -> R;
}

/// [`Sample`](crate::Sample) for lobes that [`Draw`].
macro_rules! sample_by_drawing {
    ($([$($generics:tt)*] $lobe:ty;)+) => {$(
        impl<R: ::lobe::Real $($generics)*> $crate::Sample<R> for $lobe {
            #[inline(always)]
            fn sample(&self, v: ::lobe::Vec3<R>, u: [R; 3]) -> $crate::Sampled<R> {
                $crate::draw::sample(self, v, u)
            }
            #[inline(always)]
            fn pdf(&self, l: ::lobe::Vec3<R>, v: ::lobe::Vec3<R>) -> R {
                $crate::draw::pdf(self, l, v)
            }
            #[inline(always)]
            fn eval_cos_pdf(&self, l: ::lobe::Vec3<R>, v: ::lobe::Vec3<R>) -> (::lobe::Rgb<R>, R) {
                (::lobe::Brdf::eval_cos(self, l, v), $crate::draw::pdf(self, l, v))
            }
            #[inline(always)]
            fn albedo_guess(&self, v: ::lobe::Vec3<R>) -> R {
                let z = v.z.max(v.z.lift(0.0)).min(v.z.lift(1.0));
                $crate::draw::Draw::guess(self, ::lobe::Vec3::new(v.x, v.y, z))
            }
        }
    )+};
}
pub(crate) use sample_by_drawing;

/// The sample: rejected where either direction is not above the horizon, and where the density is 0, which for some
/// lobes it is for the last numbers before 1. So what is not rejected has a density above 0.
#[inline(always)]
pub(crate) fn sample<R: Real, B: Draw<R>>(lobe: &B, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
    let l = lobe.direction(v, u);
    let density = lobe.density(l, v);
    let weight = lobe.weight(l, v, density);
    // NaN in any of them must show; of numbers 0 is added, and compared with.
    let nan = nan_of(v, u) + (l.x + l.y + l.z).times(0.0);
    let rejected = l.z.le(nan) | v.z.le(nan) | density.le(nan);
    Sampled::new(l, weight + Rgb::splat(nan), density + nan, rejected)
}

/// The density, 0 where either direction is not above the horizon, NaN where one holds a NaN.
#[inline(always)]
pub(crate) fn pdf<R: Real, B: Draw<R>>(lobe: &B, l: Vec3<R>, v: Vec3<R>) -> R {
    above(l, v, lobe.density(l, v))
}

/// The mirror direction of `v`.
#[inline(always)]
pub(crate) fn mirrored<R: Real>(v: Vec3<R>) -> Vec3<R> {
    Vec3::new(-v.x, -v.y, v.z)
}

/// `s = l + v` by [`Real::SCALE`], and `|s|` by as much: grazing cosines of 1e-20 have squares below the range of
/// `f32`.
#[inline(always)]
pub(crate) fn scaled_sum<R: Real>(l: Vec3<R>, v: Vec3<R>) -> (Vec3<R>, R) {
    let s = (l + v) * l.z.lift(R::SCALE);
    (s, s.length_squared().sqrt())
}

/// The unit vector with the angle to `+z` that has `1 − cos = t`, and the azimuth `2π y`.
#[inline(always)]
pub(crate) fn tilted<R: Real>(t: R, y: R) -> Vec3<R> {
    let (sin_phi, cos_phi) = azimuth(y);
    let sin = (t * (t.lift(2.0) - t)).sqrt();
    Vec3::new(sin * cos_phi, sin * sin_phi, t.lift(1.0) - t)
}
