//! Sheen, evenly over the hemisphere.

use crate::draw::{Draw, sample_by_drawing, tilted};
use core::f64::consts::TAU;
use lobe::{Brdf, Charlie, Real, Rgb, Vec3};

/// Evenly over the hemisphere: `pdf = 1/2π`, and the weight is `2π f_r (n·l)`, which is bounded for every view.
///
/// Its `D` could be sampled, `sin θ_h = u^(α/(2α + 1))`. But `D` has most of its facets near the horizon of `h`, and
/// the weight `(l·h)/(n·h)` is without bound there: the mean of its square is `∫ D/(n·h)`, infinite. Estevez and Kulla
/// 2017 found even samples to do better too.
impl<R: Real> Draw<R> for Charlie<R> {
    #[inline(always)]
    fn direction(&self, _: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        tilted(x, y)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, _: Vec3<R>) -> R {
        l.z.lift(1.0 / TAU)
    }
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, _: R) -> Rgb<R> {
        self.eval_cos(l, v) * l.z.lift(TAU)
    }
    /// Within 0.25 of the albedo for `α ≥ 0.06` and `n·v ≥ 0.01` (test `the_guess_for_sheen_is_near`).
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let root = v.z.sqrt();
        let fibres = (root.lift(1.0) - root).times(0.85) + (self.alpha().0 * root).times(0.16);
        self.color().luminance() * fibres
    }
}

sample_by_drawing! { [] Charlie<R>; }
