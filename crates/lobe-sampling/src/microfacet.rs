//! Microfacet lobes: a facet is drawn, and the light is where it mirrors the viewer to.

use crate::facets::{Facets, SampleNormals};
use crate::map::{cosine_hemisphere, cosine_hemisphere_pdf};
use crate::mixture::{Part, blend, one_of_two, probability};
use crate::rules::{above, incidence_of, nan_of, upwards};
use crate::{Sample, Sampled};
use core::f64::consts::FRAC_1_PI;
use lobe::distribution::Distribution;
use lobe::fresnel::{Fresnel, Incidence};
use lobe::masking::Masking;
use lobe::{Blinn1977, Brdf, Carry, CookTorrance, Facet, FacetTerms, MetallicRoughness, Microfacet, Real, Rgb, Vec3};

/// A lobe, its facets drawn by a method of the user's choice: made by [`SampleBy::by`].
///
/// ```
/// use lobe::{Alpha, Microfacet, Rgb, Vec3};
/// use lobe::{distribution::Ggx, fresnel::Schlick, masking::SmithCorrelated};
/// use lobe_sampling::{Sample, SampleBy, facets::Caps};
/// let gold = Schlick::new(Rgb::new(1.0_f32, 0.77, 0.34));
/// let lobe = Microfacet::new(Ggx::new(Alpha(0.5)), SmithCorrelated, gold);
/// let (v, u) = (Vec3::new(0.8, 0.0, 0.6), [0.0, 0.9, 0.3]);
/// // The lobe is the same, the samples and their density are others.
/// let (one, other) = (lobe.sample(v, u), lobe.by(Caps).sample(v, u));
/// assert!(one.l != other.l && one.pdf != other.pdf);
/// assert!((lobe.by(Caps).eval_cos_pdf(one.l, v).0 == lobe.eval_cos_pdf(one.l, v).0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct By<L, M> {
    /// The lobe.
    pub lobe: L,
    /// How its facets are drawn.
    pub method: M,
}

impl<L: Carry, M: Copy> Carry for By<L, M> {
    type In<S: Real> = By<L::In<S>, M>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
        By { lobe: self.lobe.carry(lift), method: self.method }
    }
}

impl<R: Real, L: Brdf<R>, M> Brdf<R> for By<L, M> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.lobe.eval(l, v)
    }
    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.lobe.eval_cos(l, v)
    }
}

/// `lobe.by(method)`.
pub trait SampleBy: Sized {
    /// The lobe, its facets drawn by `method`: one of [`facets`](crate::facets).
    #[inline(always)]
    fn by<M>(self, method: M) -> By<Self, M> {
        By { lobe: self, method }
    }
}

impl<D, G, F> SampleBy for Microfacet<D, G, F> {}
impl<R, G, D> SampleBy for MetallicRoughness<R, G, D> {}
impl<F, R> SampleBy for CookTorrance<F, R> {}
impl<D, F, R> SampleBy for Blinn1977<D, F, R> {}

/// What facets of a distribution and a masking make of a pair of directions, without Fresnel's term.
#[derive(Clone, Copy)]
pub(crate) struct Specular<R> {
    /// `D G/(4 n·v)`, and the density of the light; numbers of no meaning below the horizon.
    value: R,
    pdf: R,
    /// `value/pdf`, which holds no `D`.
    weight: R,
    incidence: Incidence<R>,
}

impl<R: Real> Specular<R> {
    #[inline(always)]
    fn new<D, G, M>(distribution: &D, masking: &G, method: &M, l: Vec3<R>, v: Vec3<R>) -> Self
    where
        D: Distribution<R>,
        G: Masking<R, D>,
        M: Facets<R, D>,
    {
        let facet = Facet::between(l, v);
        let FacetTerms { d, visibility, incidence } = facet.terms(distribution, masking, l.z);
        Self {
            value: d * visibility,
            pdf: method.pdf(distribution, v, &facet, d),
            weight: visibility * method.area(distribution, v, &facet),
            incidence,
        }
    }
}

/// The light that a drawn facet mirrors to `v`.
///
/// Below the horizon the viewer is mirrored up, so that what is drawn for it, and then rejected, is a direction too.
#[inline(always)]
pub(crate) fn mirrored<R: Real, D, M: Facets<R, D>>(distribution: &D, method: &M, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
    method.light(distribution, upwards(v), u)
}

/// A grey lobe of facets without Fresnel's term, as one part of a mixture.
#[inline(always)]
pub(crate) fn grey_value_and_pdf<R, D, G, M>(
    distribution: &D,
    masking: &G,
    method: &M,
    l: Vec3<R>,
    v: Vec3<R>,
) -> (R, R)
where
    R: Real,
    D: Distribution<R>,
    G: Masking<R, D>,
    M: Facets<R, D>,
{
    let specular = Specular::new(distribution, masking, method, l, v);
    (above(l, v, specular.value), above(l, v, specular.pdf))
}

/// A lobe of facets whose value is `factor` times that of the model.
#[derive(Clone, Copy)]
struct Scaled<'a, D, G, F, M, R> {
    lobe: &'a Microfacet<D, G, F>,
    method: M,
    factor: Rgb<R>,
}

impl<R: Real, D, G, F, M> Sample<R> for Scaled<'_, D, G, F, M, R>
where
    D: Distribution<R>,
    G: Masking<R, D>,
    F: Fresnel<R>,
    M: Facets<R, D>,
{
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, [choice, x, y]: [R; 3]) -> Sampled<R> {
        let (distribution, masking) = (self.lobe.distribution(), self.lobe.masking());
        // The same viewer for all of it, so that what both steps need is computed once.
        let up = upwards(v);
        let l = self.method.light(distribution, up, [x, y]);
        let nan = nan_of(v, [choice, x, y]) + (l.x + l.y + l.z).times(0.0);
        // Of the direction as it is rounded, not of the facet that was drawn: so the density of the sample is that of
        // `pdf`.
        let specular = Specular::new(distribution, masking, &self.method, l, up);
        let weight = self.lobe.fresnel().fresnel(specular.incidence) * specular.weight * self.factor + Rgb::splat(nan);
        Sampled::new(l, weight, specular.pdf + nan, l.z.min(v.z).le(nan))
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let specular = Specular::new(self.lobe.distribution(), self.lobe.masking(), &self.method, l, v);
        above(l, v, specular.pdf)
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let specular = Specular::new(self.lobe.distribution(), self.lobe.masking(), &self.method, l, v);
        let value = self.lobe.fresnel().fresnel(specular.incidence) * above(l, v, specular.value);
        (value * self.factor, above(l, v, specular.pdf))
    }
    #[inline(always)]
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        let seen = (self.lobe.fresnel().fresnel(incidence_of(v)) * self.factor).luminance();
        // A term that is 0 at one angle is not at others: without this a part that a mixture needs would never be
        // chosen.
        seen.max(self.factor.luminance().times(1.0 / 256.0))
    }
}

/// [`Sample`] by what an expression says of `self`.
macro_rules! sample_as {
    ([$($generics:tt)*] $lobe:ty, [$($bounds:tt)*], |$this:ident, $witness:ident| $part:expr) => {
        impl<$($generics)*> Sample<R> for $lobe
        where
            $($bounds)*
        {
            #[inline(always)]
            fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
                let ($this, $witness) = (self, v.z);
                $part.sample(v, u)
            }
            #[inline(always)]
            fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
                let ($this, $witness) = (self, v.z);
                $part.pdf(l, v)
            }
            #[inline(always)]
            fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
                let ($this, $witness) = (self, v.z);
                $part.eval_cos_pdf(l, v)
            }
            #[inline(always)]
            fn albedo_guess(&self, v: Vec3<R>) -> R {
                let ($this, $witness) = (self, v.z);
                $part.albedo_guess(v)
            }
        }
    };
}

/// The factor that changes nothing.
#[inline(always)]
fn one<R: Real>(witness: R) -> Rgb<R> {
    Rgb::splat(witness.lift(1.0))
}

sample_as! {
    [R: Real, D, G, F] Microfacet<D, G, F>,
    [D: SampleNormals<R>, G: Masking<R, D>, F: Fresnel<R>],
    |this, x| Scaled { lobe: this, method: D::Method::default(), factor: one(x) }
}
sample_as! {
    [R: Real, D, G, F, M] By<Microfacet<D, G, F>, M>,
    [D: Distribution<R>, G: Masking<R, D>, F: Fresnel<R>, M: Facets<R, D> + Copy],
    |this, x| Scaled { lobe: &this.lobe, method: this.method, factor: one(x) }
}
sample_as! {
    [R: Real, D, F] Blinn1977<D, F, R>,
    [D: SampleNormals<R>, F: Fresnel<R>],
    |this, _x| Scaled { lobe: this.terms(), method: D::Method::default(), factor: this.factor() }
}
sample_as! {
    [R: Real, D, F, M] By<Blinn1977<D, F, R>, M>,
    [D: Distribution<R>, F: Fresnel<R>, M: Facets<R, D> + Copy],
    |this, _x| Scaled { lobe: this.lobe.terms(), method: this.method, factor: this.lobe.factor() }
}

/// The factor of Cook and Torrance, `4 ks/π`.
#[inline(always)]
fn printed<R: Real, F: Fresnel<R> + Copy>(lobe: &CookTorrance<F, R>) -> Rgb<R> {
    lobe.ks() * lobe.alpha().0.lift(4.0 * FRAC_1_PI)
}

sample_as! {
    [R: Real, F] CookTorrance<F, R>,
    [F: Fresnel<R> + Copy],
    |this, _x| Scaled {
        lobe: &this.modern(), method: crate::facets::VisibleSlopes, factor: printed(this)
    }
}
sample_as! {
    [R: Real, F, M] By<CookTorrance<F, R>, M>,
    [F: Fresnel<R> + Copy, M: Facets<R, lobe::distribution::Beckmann<R>> + Copy],
    |this, _x| Scaled { lobe: &this.lobe.modern(), method: this.method, factor: printed(&this.lobe) }
}

/// The two parts of a metallic-roughness material.
#[derive(Clone, Copy)]
struct Metallic<'a, R, G, D, M> {
    material: &'a MetallicRoughness<R, G, D>,
    method: M,
}

impl<R: Real, G: Masking<R, D>, D: Distribution<R>, M: Facets<R, D>> Metallic<'_, R, G, D, M> {
    /// About what the facets and what the base reflect.
    #[inline(always)]
    fn guesses(&self, v: Vec3<R>) -> (R, R) {
        let (f, transmitted) = self.material.split(incidence_of(v));
        // A dielectric with a weight of 0 has no facets; any other has some at every angle.
        (f.luminance(), self.material.base_color().luminance() * transmitted)
    }
}

impl<R: Real, G: Masking<R, D>, D: Distribution<R>, M: Facets<R, D>> Sample<R> for Metallic<'_, R, G, D, M> {
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        let up = upwards(v);
        one_of_two(
            v,
            u,
            self.guesses(up),
            #[inline(always)]
            |[_, x, y]| Part::scattered(mirrored(self.material.distribution(), &self.method, up, [x, y])),
            #[inline(always)]
            |[_, x, y]| Part::scattered(cosine_hemisphere([x, y])),
            #[inline(always)]
            |l| self.eval_cos_pdf(l, up),
        )
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        self.eval_cos_pdf(l, v).1
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let Self { material, method } = self;
        let specular = Specular::new(material.distribution(), material.masking(), method, l, v);
        let (f, transmitted) = material.split(specular.incidence);
        let diffuse = transmitted * l.z.times(FRAC_1_PI);
        let value = material.base_color() * above(l, v, diffuse) + f * above(l, v, specular.value);
        let first = probability(self.guesses(v));
        (value, above(l, v, blend(first, specular.pdf, cosine_hemisphere_pdf(l))))
    }
    #[inline(always)]
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        let (facets, base) = self.guesses(v);
        facets + base
    }
}

sample_as! {
    [R: Real, G, D] MetallicRoughness<R, G, D>,
    [D: SampleNormals<R>, G: Masking<R, D>],
    |this, _x| Metallic { material: this, method: D::Method::default() }
}
sample_as! {
    [R: Real, G, D, M] By<MetallicRoughness<R, G, D>, M>,
    [D: Distribution<R>, G: Masking<R, D>, M: Facets<R, D> + Copy],
    |this, _x| Metallic { material: &this.lobe, method: this.method }
}
