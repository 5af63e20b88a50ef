//! The terms of a microfacet lobe, one by one: for a plot, or to compare models by what they are made of.

use crate::function::Function;
use crate::number::{AnyBrdf, Built, Number};
use crate::sampler::AnySampler;
use lobe::distribution::Distribution;
use lobe::fresnel::{Fresnel, Incidence};
use lobe::masking::Masking;
use lobe::{Brdf, Microfacet, Rgb, Vec3};
use lobe_sampling::Sample;

/// The terms of a microfacet lobe in `f64`.
pub type AnyTerms = Box<dyn Terms<f64>>;

/// A microfacet lobe `f_r = D(h) F(l·h) G(l, v)/(4 (n·l)(n·v))` of which each term can be asked.
///
/// ```
/// use lobe::Vec3;
///
/// let gold = &lobe_models::preset("ggx-gold")?.lobes[0];
/// let terms = gold.terms().expect("it is made of them");
/// let up = Vec3::new(0.0, 0.0, 1.0);
/// // The peak of GGX is 1/(π α²).
/// assert!((terms.d(up) * std::f64::consts::PI * 0.15 * 0.15 - 1.0).abs() < 1e-12);
/// assert_eq!((terms.g(up, up), terms.f(1.0).g), (1.0, 0.77));
/// # Ok::<(), lobe_models::Error>(())
/// ```
pub trait Terms<R: Number>: Send + Sync {
    /// `D(h)` in sr⁻¹ for a unit vector `h` with `h.z ≥ 0`; `∫ D(h) (n·h) dω = 1`.
    fn d(&self, h: Vec3<R>) -> R;
    /// `G(l, v)`, the part of the facets that is both lit and seen, for unit vectors above the horizon. Where `l` is
    /// the normal and `G` is one of Smith's, this is `G₁(v)`.
    fn g(&self, l: Vec3<R>, v: Vec3<R>) -> R;
    /// `F(θ)` for the angle between the light and the normal of the facet, by its cosine.
    fn f(&self, cos: R) -> Rgb<R>;
    /// The lobe that they make together.
    fn into_brdf(self: Box<Self>) -> AnyBrdf<R>;
    /// The sampler of that lobe.
    fn into_sampler(self: Box<Self>) -> AnySampler<R>;
    /// The function that evaluates that lobe.
    fn function(&self) -> Function;
}

impl<R, D, G, F> Terms<R> for Microfacet<D, G, F>
where
    R: Number,
    D: Distribution<R>,
    G: Masking<R, D>,
    F: Fresnel<R>,
    Self: Brdf<R> + Sample<R> + Send + Sync + 'static,
{
    fn d(&self, h: Vec3<R>) -> R {
        self.distribution().d(h)
    }

    fn g(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let sum = l + v;
        let length = sum.length_squared().sqrt();
        // A visibility is G/(4 (n·l)(n·v)), times a weight.
        let weight = (l.z * v.z).times(4.0);
        self.masking().visibility(self.distribution(), l, v, sum * length.recip(), length.times(0.5), weight)
    }

    fn f(&self, cos: R) -> Rgb<R> {
        self.fresnel().fresnel(Incidence::from_cos(cos))
    }

    fn into_brdf(self: Box<Self>) -> AnyBrdf<R> {
        self
    }

    fn into_sampler(self: Box<Self>) -> AnySampler<R> {
        self
    }

    fn function(&self) -> Function {
        Function::scalar::<Self, R>()
    }
}

/// What the constructor of a lobe with terms ends with.
pub(crate) fn boxed<R: Number>(lobe: impl Terms<R> + 'static) -> Box<dyn Terms<R>> {
    Box::new(lobe)
}

/// What the constructor of a lobe ends with that has such terms.
pub(crate) fn built<R: Number>(terms: Box<dyn Terms<R>>) -> Built<R> {
    Built { function: terms.function(), brdf: terms.into_brdf() }
}
