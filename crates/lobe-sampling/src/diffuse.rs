//! Diffuse lobes, by the cosine.

use crate::map::cosine_hemisphere;
use crate::{Sample, Sampled};
use core::f64::consts::FRAC_1_PI;
use lobe::{Brdf, Lambert, Real, Rgb, Vec3};

/// The weight is the albedo, for every sample.
impl<R: Real> Sample<R> for Lambert<R> {
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Sampled<R> {
        let l = cosine_hemisphere([x, y]);
        // NaN in either must show; of a number 0 is added.
        let nan = (l.x + v.x + v.y + v.z).times(0.0);
        Sampled::new(l, self.albedo() + Rgb::splat(nan), l.z.times(FRAC_1_PI) + nan, v.z.le(nan))
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        Lambert::new(Rgb::splat(l.z.lift(1.0))).eval_cos(l, v).r
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let pdf = self.pdf(l, v);
        (self.albedo() * pdf, pdf)
    }
    #[inline(always)]
    fn albedo_guess(&self, _: Vec3<R>) -> R {
        self.albedo().luminance()
    }
}
