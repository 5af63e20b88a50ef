//! Cook-Torrance: `f_r = F D G/(π (n·l)(n·v))`, with D Beckmann's and G that of V-cavities.

use super::{Brdf, Microfacet};
use crate::Alpha;
use crate::Carry;
use crate::carry::carry;
use crate::color::Rgb;
use crate::distribution::Beckmann;
use crate::fresnel::Fresnel;
use crate::masking::VCavity;
use crate::number::Real;
use crate::vector::Vec3;

/// The model of Cook and Torrance with its factor of 1981: `f_r = ks F D G/(π (n·l)(n·v))`, where `D` is Beckmann's
/// distribution, normalised, and `G` that of [V-cavities](VCavity).
///
/// Cook and Torrance, "A Reflectance Model for Computer Graphics", SIGGRAPH 1981. The factor `1/π` is theirs; the one
/// that conserves energy is `1/4`, which makes this `4/π = 1.27` times
/// `Microfacet<Beckmann, VCavity, F>`, the modern form, to which [`modern`](Self::modern) goes. As printed, the paper's
/// `D` also lacks the `1/π` that normalises it; whoever fits data takes it with. The fits of Ngan et al. 2005 are
/// of this form (`docs/materials.md` has the evidence).
///
/// Reciprocal to the last bit. Domain: `ks ∈ [0, 1]`, `α = m ∈ [1e-4, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CookTorrance<F, R = f32> {
    ks: Rgb<R>,
    alpha: Alpha<R>,
    terms: Microfacet<Beckmann<R>, VCavity, F>,
}

carry!([F: Carry] CookTorrance<F, f32> => CookTorrance<F::In<S>, S> { ks, alpha, terms });

impl<R: Real, F: Fresnel<R> + Copy> CookTorrance<F, R> {
    /// The lobe with coefficient `ks`, root mean square slope `m` and Fresnel term.
    #[inline(always)]
    pub fn new(ks: Rgb<R>, m: Alpha<R>, fresnel: F) -> Self {
        Self { ks, alpha: m, terms: Microfacet::new(Beckmann::new(m), VCavity, fresnel) }
    }

    /// The coefficient `ks`.
    #[inline(always)]
    pub fn ks(&self) -> Rgb<R> {
        self.ks
    }

    /// The slope `m`, in the newtype of its equals.
    #[inline(always)]
    pub fn alpha(&self) -> Alpha<R> {
        self.alpha
    }

    /// The same terms with the factor `1/4` in place of `1/π`, and without `ks`.
    #[inline(always)]
    pub fn modern(&self) -> Microfacet<Beckmann<R>, VCavity, F> {
        self.terms
    }
}

impl<R: Real, F: Fresnel<R> + Copy> Brdf<R> for CookTorrance<F, R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.terms.eval(l, v) * self.ks * l.z.lift(4.0 * core::f64::consts::FRAC_1_PI)
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.terms.eval_cos(l, v) * self.ks * l.z.lift(4.0 * core::f64::consts::FRAC_1_PI)
    }
}
