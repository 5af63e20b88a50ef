//! Smith's masking, with the exact `Λ` of the distribution.

use super::Masking;
use crate::distribution::SmithLambda;
use crate::number::{Quotient, Real};
use crate::vector::Vec3;

/// Smith's masking, light and viewer correlated by height: `G = 1/(1 + Λ(l) + Λ(v))`.
///
/// Ross, Dion and Potvin 2005; Heitz 2014, equation 99. The more accurate one, and what engines use today.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmithCorrelated;

impl<R: Real, D: SmithLambda<R>> Masking<R, D> for SmithCorrelated {
    #[inline(always)]
    fn quotient(&self, distribution: &D, l: Vec3<R>, v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> Quotient<R> {
        let (area_l, area_v) = (distribution.facing_either_way(l), distribution.facing_either_way(v));
        let (n_dot_l, n_dot_v) = (l.z.times(R::COSINE_SCALE), v.z.times(R::COSINE_SCALE));
        // 1 + Λ(l) + Λ(v) is half of the sum of (1 + 2 Λ)(l) and (1 + 2 Λ)(v): positive terms only, and symmetric.
        Quotient::new(weight.times(0.5 * R::COSINE_SCALE), n_dot_l.mul_add(area_v, n_dot_v * area_l).off_zero())
    }
}

/// Smith's masking, light and viewer apart: `G = G₁(l) G₁(v)`.
///
/// Smith, "Geometrical Shadowing of a Random Rough Surface", 1967; Walter et al. 2007, equation 23. It masks too much.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmithSeparable;

impl<R: Real, D: SmithLambda<R>> Masking<R, D> for SmithSeparable {
    #[inline(always)]
    fn quotient(&self, distribution: &D, l: Vec3<R>, v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> Quotient<R> {
        Quotient::new(weight.times(0.25), distribution.facing(l) * distribution.facing(v))
    }
}
