//! The microfacet model of any terms: `f_r = D(h) F(l·h) G(l, v)/(4 (n·l)(n·v))`.

use super::{Brdf, above_horizon};
use crate::color::Rgb;
use crate::distribution::Distribution;
use crate::fresnel::{Fresnel, Incidence};
use crate::masking::Masking;
use crate::number::Real;
use crate::vector::Vec3;

/// The microfacet model: `f_r = D(h) F(l·h) G(l, v)/(4 (n·l)(n·v))` sr⁻¹.
///
/// Torrance and Sparrow 1967; in this form Walter et al. 2007, equation 20. The terms are types, so that nothing is
/// chosen at run time: `Microfacet<Ggx, SmithCorrelated, Schlick>` is what most engines of today use.
///
/// Reciprocal to the last bit.
///
/// ```
/// use lobe::{Alpha, Brdf, Microfacet, Rgb, Vec3};
/// use lobe::{distribution::Ggx, fresnel::Schlick, masking::SmithCorrelated};
/// let gold = Schlick::new(Rgb::new(1.0_f32, 0.77, 0.34));
/// let lobe = Microfacet::new(Ggx::new(Alpha(0.2)), SmithCorrelated, gold);
/// let f = lobe.eval(Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// assert!(f.r > f.g && f.g > f.b);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microfacet<D, G, F> {
    distribution: D,
    masking: G,
    fresnel: F,
}

impl<D, G, F> Microfacet<D, G, F> {
    /// The model with these terms.
    #[inline(always)]
    pub fn new(distribution: D, masking: G, fresnel: F) -> Self {
        Self { distribution, masking, fresnel }
    }

    #[inline(always)]
    fn weighted<R: Real>(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R>
    where
        D: Distribution<R>,
        G: Masking<R, D>,
        F: Fresnel<R>,
    {
        let (h, cos_d) = unit_halfway(l, v);
        let visibility = self.masking.visibility(&self.distribution, l, v, h, cos_d, weight);
        self.fresnel.fresnel(Incidence::halfway(l, v, cos_d)) * above_horizon(l, v, self.distribution.d(h) * visibility)
    }
}

impl<R: Real, D: Distribution<R>, G: Masking<R, D>, F: Fresnel<R>> Brdf<R> for Microfacet<D, G, F> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z)
    }
}

/// `h = (l + v)/|l + v|` and `cos θ_d = l·h = |l + v|/2 ≤ 1`, for unit vectors above the horizon; noise or NaN
/// elsewhere.
///
/// Each component has a relative error of at most `4u`, whatever cancels in the sum: the inputs are exact, and the sum
/// rounds once. This is the half vector of the directions *as they are given*; see [`crate::halfway`] for the one that
/// takes rounded lengths out.
#[inline(always)]
pub(crate) fn unit_halfway<R: Real>(l: Vec3<R>, v: Vec3<R>) -> (Vec3<R>, R) {
    // Between opposite directions on the horizon the sum is as small as the cosines; 2⁶² keeps its square normal.
    let s = (l + v) * l.z.lift(SCALE);
    let length = s.length_squared().sqrt();
    // Of rounded unit vectors the sum may be longer than 2.
    (s * length.recip(), length.times(0.5 / SCALE).min(length.lift(1.0)))
}

const SCALE: f64 = (1u64 << 62) as f64;
