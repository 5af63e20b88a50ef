//! Lobes without a density: the mirror, and no lobe at all.

use crate::rules::{nan_of, upwards};
use crate::{Sample, Sampled};
use lobe::{Black, Mirror, Real, Rgb, Vec3};

/// The one direction of the mirror: a delta, with the density 0 and the weight `ks`.
impl<R: Real> Sample<R> for Mirror<R> {
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        let (seen, nan) = (self.reflect(upwards(v)), nan_of(v, u));
        let zero = v.z.lift(0.0);
        let below = v.z.le(nan);
        let sampled = Sampled::new(seen.l, seen.weight + Rgb::splat(nan), zero, below);
        Sampled { delta: !below, ..sampled }
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        nan_of(v, [l.x, l.y, l.z])
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let nan = nan_of(v, [l.x, l.y, l.z]);
        (Rgb::splat(nan), nan)
    }
    #[inline(always)]
    fn albedo_guess(&self, _: Vec3<R>) -> R {
        self.ks().luminance()
    }
}

/// Nothing is reflected, and every sample is rejected; a sum never asks for one.
impl<R: Real> Sample<R> for Black {
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        let nan = nan_of(v, u);
        let zero = v.z.lift(0.0);
        Sampled::new(Vec3::new(zero, zero, v.z.lift(1.0)), Rgb::splat(nan), nan, nan.eq(zero))
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        nan_of(v, [l.x, l.y, l.z])
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let nan = nan_of(v, [l.x, l.y, l.z]);
        (Rgb::splat(nan), nan)
    }
    #[inline(always)]
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        v.z.lift(0.0)
    }
}
