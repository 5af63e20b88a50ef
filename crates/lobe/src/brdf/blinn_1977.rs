//! Blinn 1977: `f_r (n·l) = ks F G D(h)/D(n) / (n·v)`.

use super::{Brdf, Microfacet};
use crate::Carry;
use crate::carry::carry;
use crate::color::Rgb;
use crate::distribution::Distribution;
use crate::fresnel::Fresnel;
use crate::masking::VCavity;
use crate::number::Real;
use crate::vector::Vec3;

/// Blinn's form of the model of Torrance and Sparrow: the highlight `s = ks F G D(h)/D(n) / (n·v)`, as a BRDF
/// `f_r = s/(n·l)`.
///
/// Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977: the highlight is `D G F/(N·E)`
/// with a `D` that is 1 at its peak, and multiplies the light without a cosine. His three distributions are
/// [`BlinnPhong`](crate::BlinnPhong)'s power, the Gaussian of Torrance and Sparrow, and the one of Trowbridge and Reitz,
/// which he found to match best, and which is [`Ggx`](crate::distribution::Ggx) with `c₃ = α`.
///
/// **It does not conserve energy**: with `D(n) = 1` the lobe has the same height whatever its width, `4/D(n)` times
/// that of the normalised model. Reciprocal to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blinn1977<D, F, R = f32> {
    ks: Rgb<R>,
    /// `4 ks/D(n)`.
    factor: Rgb<R>,
    terms: Microfacet<D, VCavity, F>,
}

carry!([D: Carry, F: Carry] Blinn1977<D, F, f32> => Blinn1977<D::In<S>, F::In<S>, S> { ks, factor, terms });

impl<R: Real, D: Distribution<R>, F: Fresnel<R>> Blinn1977<D, F, R> {
    /// The highlight with coefficient `ks`, a distribution that is scaled to 1 at its peak, and a Fresnel term.
    #[inline(always)]
    pub fn new(ks: Rgb<R>, distribution: D, fresnel: F) -> Self {
        let zero = ks.r.lift(0.0);
        let peak = distribution.d(Vec3::new(zero, zero, zero.plus(1.0)));
        Self { ks, factor: ks * (peak.lift(4.0) / peak), terms: Microfacet::new(distribution, VCavity, fresnel) }
    }

    /// The coefficient `ks`.
    #[inline(always)]
    pub fn ks(&self) -> Rgb<R> {
        self.ks
    }

    /// What the value is of [`modern`](Self::modern)'s: `4 ks/D(n)`.
    #[inline(always)]
    pub fn factor(&self) -> Rgb<R> {
        self.factor
    }

    /// The same terms as [`modern`](Self::modern), by reference.
    #[inline(always)]
    pub fn terms(&self) -> &Microfacet<D, VCavity, F> {
        &self.terms
    }

    /// The same terms with the factor `1/4` and a normalised distribution, and without `ks`.
    #[inline(always)]
    pub fn modern(self) -> Microfacet<D, VCavity, F> {
        self.terms
    }
}

impl<R: Real, D: Distribution<R>, F: Fresnel<R>> Brdf<R> for Blinn1977<D, F, R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.terms.eval(l, v) * self.factor
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.terms.eval_cos(l, v) * self.factor
    }
}
