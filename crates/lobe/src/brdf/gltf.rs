//! glTF 2.0: `mix(fresnel_mix(ρ/π, S), F_metal S, metallic)`, `S` a GGX without Fresnel.

use super::microfacet::Facet;
use super::{Brdf, above_horizon};
use crate::Alpha;
use crate::Carry;
use crate::carry::carry;
use crate::color::Rgb;
use crate::distribution::{Distribution, Ggx, GgxAnisotropic};
use crate::fresnel::{Incidence, fifth_power, one_minus_fifth_power};
use crate::masking::{Masking, SmithCorrelated, SmithSeparable};
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::FRAC_1_PI;

/// The metallic-roughness material of glTF 2.0, as its appendix B has it:
///
/// ```text
/// f = mix(dielectric, metal, metallic)
/// dielectric = (1 − w max(F_d)) base/π + w F_d S    F_d = f0 + (1 − f0)(1 − l·h)⁵
/// metal      = F_m S                                F_m = base + (1 − base)(1 − l·h)⁵
/// S          = D G/(4 (n·l)(n·v))                   D is GGX
/// ```
///
/// Khronos, *glTF 2.0 Specification*, appendix B.2 and B.3, with `α` the square of the material's `roughness`. `G` is
/// the product of two Smith terms there; `KHR_materials_anisotropy` has the height-correlated one, and
/// [`with_anisotropy`](Self::with_anisotropy) changes to it.
///
/// `f0` is 0.04, or by `KHR_materials_ior` `((η − 1)/(η + 1))²`; `KHR_materials_specular` scales it with a colour (at
/// most to 1) and everything that the dielectric reflects with the weight `w`.
///
/// Reciprocal to the last bit: both Fresnel terms depend on the half vector alone. Where `1 − F` would cancel, it is
/// formed from `1 − x⁵ = (1 − x)(1 + x + x² + x³ + x⁴)`.
///
/// Domain: colours, `metallic` and `w` in `[0, 1]`, the specular colour not negative, `α ∈ [1e-4, 1]`, which is a
/// roughness from 0.01.
///
/// ```
/// use lobe::{Alpha, Brdf, MetallicRoughness, Rgb, Vec3};
/// let roughness = 0.4_f32;
/// let gold = MetallicRoughness::new(Rgb::new(1.0, 0.77, 0.34), 1.0, Alpha(roughness * roughness));
/// let f = gold.eval(Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// assert!(f.r > f.g && f.g > f.b);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness<R = f32, G = SmithSeparable, D = Ggx<R>> {
    base_color: Rgb<R>,
    metallic: R,
    distribution: D,
    masking: G,
    /// `f0` of the dielectric, at most 1.
    f0: Rgb<R>,
    /// `w`.
    specular: R,
}

carry!([G: Carry, D: Carry] MetallicRoughness<f32, G, D> => MetallicRoughness<S, G::In<S>, D::In<S>> {
    base_color, metallic, distribution, masking, f0, specular
});

impl<R: Real> MetallicRoughness<R> {
    /// The material without extensions: `f0 = 0.04`, `w = 1`.
    #[inline(always)]
    pub fn new(base_color: Rgb<R>, metallic: R, alpha: Alpha<R>) -> Self {
        let f0 = Rgb::splat(metallic.lift(0.04));
        Self {
            base_color,
            metallic,
            distribution: Ggx::new(alpha),
            masking: SmithSeparable,
            f0,
            specular: metallic.lift(1.0),
        }
    }

    /// `KHR_materials_anisotropy`: along the tangent the width grows to `mix(α, 1, strength²)`; to be called last.
    ///
    /// The rotation of the extension is that of the tangent frame: it is the caller's.
    #[inline(always)]
    pub fn with_anisotropy(self, strength: R) -> MetallicRoughness<R, SmithCorrelated, GgxAnisotropic<R>> {
        let alpha = self.distribution.alpha();
        let s2 = strength.squared();
        let along = Alpha(alpha.0 * (s2.lift(1.0) - s2) + s2);
        MetallicRoughness {
            base_color: self.base_color,
            metallic: self.metallic,
            distribution: Ggx::anisotropic(along, alpha),
            masking: SmithCorrelated,
            f0: self.f0,
            specular: self.specular,
        }
    }
}

impl<R: Real, G, D> MetallicRoughness<R, G, D> {
    /// `KHR_materials_ior` and `KHR_materials_specular`: `f0 = min(1, ((η − 1)/(η + 1))² colour)`, `w = weight`.
    ///
    /// Without the first, `η = 1.5`, where `f0 = 0.04`; without the second, white and 1.
    #[inline(always)]
    pub fn with_specular(self, ior: R, weight: R, color: Rgb<R>) -> Self {
        let one = ior.lift(1.0);
        let f0 = color * ((ior - one) / (ior + one)).squared();
        Self { f0: Rgb::new(f0.r.min(one), f0.g.min(one), f0.b.min(one)), specular: weight, ..self }
    }

    /// The distribution of the facets.
    #[inline(always)]
    pub fn distribution(&self) -> &D {
        &self.distribution
    }

    /// The masking of the facets.
    #[inline(always)]
    pub fn masking(&self) -> &G {
        &self.masking
    }

    /// What the facets reflect at this angle, `(1 − metallic) w F_d + metallic F_m`, and the part of the base's colour that
    /// leaves it diffusely, `(1 − metallic) (1 − w max(F_d))`.
    #[inline(always)]
    pub fn split(&self, incidence: Incidence<R>) -> (Rgb<R>, R) {
        let one = incidence.cos.lift(1.0);
        let (x5, one_minus_x5) = (fifth_power(incidence.one_minus_cos), one_minus_fifth_power(incidence));

        let white = Rgb::splat(one);
        let dielectric = (self.f0 + (white - self.f0) * x5) * self.specular;
        let metal = self.base_color + (white - self.base_color) * x5;
        let f = dielectric * (one - self.metallic) + metal * self.metallic;

        // 1 − w max(F_d), of positive terms only.
        let max_f0 = self.f0.r.max(self.f0.g).max(self.f0.b);
        let transmitted = (one - self.specular) + self.specular * (one - max_f0) * one_minus_x5;
        (f, transmitted * (one - self.metallic))
    }

    /// The colour of the base.
    #[inline(always)]
    pub fn base_color(&self) -> Rgb<R> {
        self.base_color
    }

    #[inline(always)]
    fn weighted(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R>
    where
        D: Distribution<R>,
        G: Masking<R, D>,
    {
        let (specular, incidence) = Facet::between(l, v).specular(&self.distribution, &self.masking, weight);
        let (f, transmitted) = self.split(incidence);
        let diffuse = transmitted * weight.times(FRAC_1_PI);

        self.base_color * above_horizon(l, v, diffuse) + f * above_horizon(l, v, specular)
    }
}

impl<R: Real> MetallicRoughness<R> {
    /// The same material in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> MetallicRoughness<S> {
        MetallicRoughness {
            base_color: self.base_color.map(&f),
            metallic: f(self.metallic),
            distribution: self.distribution.map(&f),
            masking: self.masking,
            f0: self.f0.map(&f),
            specular: f(self.specular),
        }
    }
}

impl<R: Real, D: Distribution<R>, G: Masking<R, D>> Brdf<R> for MetallicRoughness<R, G, D> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z)
    }
}

/// `KHR_materials_clearcoat`: `f = mix(base, coat, c (0.04 + 0.96 (1 − n·v)⁵))`, where `coat` is a GGX without Fresnel.
///
/// Khronos, *KHR_materials_clearcoat*, `fresnel_coat`. **Not reciprocal**: the split of the energy depends on the
/// viewer alone. With `c = 1` over black, `f(l, v)/f(v, l)` is the ratio of the two Fresnel terms, up to 25. For a split
/// that is the same both ways take [`Coat`](super::Coat).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearcoat<B, R = f32> {
    base: B,
    clearcoat: R,
    distribution: Ggx<R>,
}

carry!([B: Carry] Clearcoat<B, f32> => Clearcoat<B::In<S>, S> { base, clearcoat, distribution });

impl<B, R: Real> Clearcoat<B, R> {
    /// A coat of the intensity `clearcoat ∈ [0, 1]` and a width `α`, the square of `clearcoatRoughness`, on a base.
    #[inline(always)]
    pub fn new(base: B, clearcoat: R, alpha: Alpha<R>) -> Self {
        Self { base, clearcoat, distribution: Ggx::new(alpha) }
    }

    /// The lobe under the coat.
    #[inline(always)]
    pub fn base(&self) -> &B {
        &self.base
    }

    /// The distribution of the coat's facets; their masking is [`SmithSeparable`].
    #[inline(always)]
    pub fn distribution(&self) -> &Ggx<R> {
        &self.distribution
    }

    /// What the coat reflects to `v`: `c (0.04 + 0.96 (1 − n·v)⁵)`, for `n·v` from 0 to 1.
    #[inline(always)]
    pub fn reflected(&self, v: Vec3<R>) -> R {
        let x5 = fifth_power(Incidence::of(v).one_minus_cos);
        self.clearcoat * x5.times(0.96).plus(0.04)
    }

    /// The part of what is below the coat that is seen through it from `v`: `1 − c (0.04 + 0.96 (1 − n·v)⁵)`, which is the
    /// base's share, and that of its emission.
    ///
    /// Of positive terms, so that nothing cancels. For `n·v` from 0 to 1.
    #[inline(always)]
    pub fn transmitted(&self, v: Vec3<R>) -> R {
        let seen = one_minus_fifth_power(Incidence::of(v)).times(0.96);
        (v.z.lift(1.0) - self.clearcoat) + self.clearcoat * seen
    }

    #[inline(always)]
    fn coated(&self, base: Rgb<R>, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R> {
        let reflected = self.reflected(v);
        let transmitted = self.transmitted(v);
        let (specular, _) = Facet::between(l, v).specular(&self.distribution, &SmithSeparable, weight);
        let coat = above_horizon(l, v, specular * reflected);
        // Selected too: below the horizon the base is 0, and an x⁵ that is not a number there must not spoil it.
        base * above_horizon(l, v, transmitted) + Rgb::splat(coat)
    }
}

impl<R: Real, B: Brdf<R>> Brdf<R> for Clearcoat<B, R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.coated(self.base.eval(l, v), l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.coated(self.base.eval_cos(l, v), l, v, l.z)
    }
}

/// `emissiveFactor`, with `KHR_materials_emissive_strength`: the radiance that the surface emits, `factor · strength`
/// in W sr⁻¹ m⁻², or in nits.
///
/// It is no reflection, so it is in no lobe: a renderer adds it once.
#[inline(always)]
pub fn emission<R: Real>(factor: Rgb<R>, strength: R) -> Rgb<R> {
    factor * strength
}
