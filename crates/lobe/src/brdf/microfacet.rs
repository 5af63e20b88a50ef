//! The microfacet model of any terms: `f_r = D(h) F(l·h) G(l, v)/(4 (n·l)(n·v))`.

use super::{Brdf, above_horizon};
use crate::Carry;
use crate::carry::carry;
use crate::color::Rgb;
use crate::distribution::{Distribution, Gaussian};
use crate::fresnel::{Fresnel, Incidence};
use crate::masking::{Masking, SmithSeparable, VCavity};
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

carry!([D: Carry, G: Carry, F: Carry] Microfacet<D, G, F> => Microfacet<D::In<S>, G::In<S>, F::In<S>> {
    distribution, masking, fresnel
});

impl<D, G, F> Microfacet<D, G, F> {
    /// The model with these terms.
    #[inline(always)]
    pub fn new(distribution: D, masking: G, fresnel: F) -> Self {
        Self { distribution, masking, fresnel }
    }

    /// The distribution `D`.
    #[inline(always)]
    pub fn distribution(&self) -> &D {
        &self.distribution
    }

    /// The masking `G`.
    #[inline(always)]
    pub fn masking(&self) -> &G {
        &self.masking
    }

    /// The Fresnel term `F`.
    #[inline(always)]
    pub fn fresnel(&self) -> &F {
        &self.fresnel
    }

    #[inline(always)]
    fn weighted<R: Real>(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R>
    where
        D: Distribution<R>,
        G: Masking<R, D>,
        F: Fresnel<R>,
    {
        let facet = Facet::between(l, v);
        let (specular, incidence) = facet.specular(&self.distribution, &self.masking, weight);
        self.fresnel.fresnel(incidence) * above_horizon(l, v, specular)
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

/// The model of Torrance and Sparrow, "Theory for Off-Specular Reflection from Roughened Surfaces", JOSA 57(9), 1967: a
/// [`Gaussian`] distribution of the facets' angles and V-cavities, with any Fresnel term.
///
/// Their equation 22 gives the reflected radiance as `F G P/(4 (n·v))` for light that arrives per projected area, with
/// an unknown factor in `P`; here `P` is normalised.
pub type TorranceSparrow<F, R = f32> = Microfacet<Gaussian<R>, VCavity, F>;

/// The model of Ashikhmin, Premože and Shirley, "A Microfacet-Based BRDF Generator", SIGGRAPH 2000, for any
/// distribution: `f_r = p(h) ⟨n·h⟩ F/(4 g(l) g(v))`.
///
/// `p` is the distribution as a probability density, `⟨n·h⟩` its mean cosine and `g(k) = ∫ max(0, k·h) p(h) dω`. With
/// `p = D/∫D dω` the mean is `1/∫D dω` and `g(k)` is `(1 + Λ(k)) cos θ_k/∫D dω`: their shadowing is Smith's, light and
/// viewer apart, with the exact `Λ`. (A test of `lobe-models` integrates it.) For a distribution without a closed
/// `Λ` take [`SmithTable`](crate::distribution::SmithTable).
pub type AshikhminPremozeShirley<D, F> = Microfacet<D, SmithSeparable, F>;

/// The facet that mirrors `l` to `v`, for unit vectors above the horizon; noise or NaN elsewhere.
///
/// Its normal has the direction of `l + v`, each component with a relative error of at most `4u`, whatever cancels in
/// the sum: the inputs are exact, and the sum rounds once. This is the half vector of the directions *as they are given*;
/// see [`crate::halfway`] for the one that takes rounded lengths out.
///
/// ```
/// use lobe::{Alpha, Facet, Vec3, distribution::Ggx, masking::SmithCorrelated};
/// let (l, v) = (Vec3::new(0.6_f32, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// let facet = Facet::between(l, v);
/// assert_eq!(facet.normal().z, 1.0);
/// assert_eq!(facet.cos(), 0.8);
/// let terms = facet.terms(&Ggx::new(Alpha(1.0)), &SmithCorrelated, l.z);
/// assert!((terms.d - core::f32::consts::FRAC_1_PI).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Facet<R> {
    l: Vec3<R>,
    v: Vec3<R>,
    /// `(l + v) 2⁶²`: between opposite directions on the horizon the sum is as small as the cosines, and so its square
    /// is a normal number there too. Without the power of two in numbers that have none ([`Real::COSINE_SCALE`]).
    s: Vec3<R>,
    /// `|s|²`.
    length2: R,
    /// `cos θ_d = l·h = |l + v|/2`, at most 1: of rounded unit vectors the sum may be longer than 2.
    cos: R,
}

/// The terms of a microfacet lobe for one pair of directions, apart: its value is `F d visibility`.
#[derive(Clone, Copy, Debug)]
pub struct FacetTerms<R> {
    /// `D(h)` in sr⁻¹.
    pub d: R,
    /// `weight · G/(4 (n·l)(n·v))`.
    pub visibility: R,
    /// The angle of incidence on the facet, of which `F` is a function.
    pub incidence: Incidence<R>,
}

impl<R: Real> Facet<R> {
    /// The facet that mirrors `l` to `v`, unit vectors above the horizon.
    #[inline(always)]
    pub fn between(l: Vec3<R>, v: Vec3<R>) -> Self {
        let s = (l + v) * l.z.lift(R::COSINE_SCALE);
        let length2 = s.length_squared().off_zero();
        // Of opposite directions the root may be NaN, which this order drops: they are not above the horizon.
        let cos = l.z.lift(1.0).min(length2.sqrt_of_normal().times(0.5 / R::COSINE_SCALE));
        Self { l, v, s, length2, cos }
    }

    /// `h`, of unit length.
    #[inline(always)]
    pub fn normal(&self) -> Vec3<R> {
        self.s * self.length2.rsqrt()
    }

    /// `l·h = v·h = |l + v|/2`, at most 1.
    #[inline(always)]
    pub fn cos(&self) -> R {
        self.cos
    }

    /// `D`, `weight · G/(4 (n·l)(n·v))` and the angle of incidence on the facet; numbers of no meaning below the horizon.
    #[inline(always)]
    pub fn terms<D, G>(&self, distribution: &D, masking: &G, weight: R) -> FacetTerms<R>
    where
        D: Distribution<R>,
        G: Masking<R, D>,
    {
        let Self { l, v, s, length2, cos } = *self;
        let visibility = masking.quotient(distribution, l, v, self.normal(), cos, weight);
        let (incidence, visibility) = Incidence::halfway_and(l, v, cos, visibility);
        FacetTerms { d: distribution.d_along(s, length2), visibility, incidence }
    }

    /// `weight · D G/(4 (n·l)(n·v))`, and the angle of incidence on the facet.
    #[inline(always)]
    pub(crate) fn specular<D, G>(&self, distribution: &D, masking: &G, weight: R) -> (R, Incidence<R>)
    where
        D: Distribution<R>,
        G: Masking<R, D>,
    {
        let FacetTerms { d, visibility, incidence } = self.terms(distribution, masking, weight);
        (d * visibility, incidence)
    }
}
