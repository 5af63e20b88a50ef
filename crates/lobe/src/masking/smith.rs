//! Smith's masking, with the exact `Λ` of the distribution.

use super::Masking;
use crate::distribution::SmithLambda;
use crate::number::Real;
use crate::vector::Vec3;

/// Smith's masking, light and viewer correlated by height: `G = 1/(1 + Λ(l) + Λ(v))`.
///
/// Ross, Dion and Potvin 2005; Heitz 2014, equation 99. The more accurate one, and what engines use today.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmithCorrelated;

impl<R: Real, D: SmithLambda<R>> Masking<R, D> for SmithCorrelated {
    #[inline(always)]
    fn visibility(&self, distribution: &D, l: Vec3<R>, v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> R {
        let (lambda_l, lambda_v) = (distribution.lambda_cos(l), distribution.lambda_cos(v));
        let (n_dot_l, n_dot_v) = (l.z.times(R::SCALE), v.z.times(R::SCALE));
        // The product of the cosines in a symmetric form.
        let denominator = (n_dot_l * lambda_v + n_dot_v * lambda_l) + n_dot_l * v.z;
        weight.times(0.25 * R::SCALE) / denominator
    }
}

/// Smith's masking, light and viewer apart: `G = G₁(l) G₁(v)`.
///
/// Smith, "Geometrical Shadowing of a Random Rough Surface", 1967; Walter et al. 2007, equation 23. It masks too much.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmithSeparable;

impl<R: Real, D: SmithLambda<R>> Masking<R, D> for SmithSeparable {
    #[inline(always)]
    fn visibility(&self, distribution: &D, l: Vec3<R>, v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> R {
        weight.times(0.25) / ((l.z + distribution.lambda_cos(l)) * (v.z + distribution.lambda_cos(v)))
    }
}
