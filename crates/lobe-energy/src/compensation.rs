//! Light that is reflected more than once between the facets, given back to a GGX.

use crate::{GgxAlbedo, GgxFit, GgxTable};
use core::f64::consts::FRAC_1_PI;
use lobe::distribution::Ggx;
use lobe::fresnel::{Fresnel, Incidence};
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Carry, Microfacet, Real, Rgb, Vec3};

/// The mean reflectance `2 ∫ F(μ) μ dμ` of an interface for light from everywhere.
///
/// By eight Gauss-Legendre points in `√μ`, where Fresnel's equations are smooth at grazing light too: within 1e-5 for Schlick's term
/// (in closed form `F0 + (1 − F0)/21`), 1e-4 for conductors and for dielectrics with `η ≤ 3` (test `the_mean_of_fresnel`). `witness` is any number of
/// the type.
#[inline]
pub fn average_fresnel<R: Real, F: Fresnel<R>>(fresnel: &F, witness: R) -> Rgb<R> {
    let mut sum = Rgb::splat(witness.lift(0.0));
    for (root, weight) in GAUSS_LEGENDRE_8 {
        // μ = t², dμ = 2 t dt.
        let mu = witness.lift(root * root);
        sum = sum + fresnel.fresnel(Incidence::from_cos(mu)) * witness.lift(4.0 * weight * root * root * root);
    }
    sum
}

/// Nodes on [0, 1] and weights.
const GAUSS_LEGENDRE_8: [(f64, f64); 8] = [
    (0.019_855_071_751_231_884, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_63, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_64),
    (0.408_282_678_752_175_1, 0.181_341_891_689_180_99),
    (0.591_717_321_247_824_9, 0.181_341_891_689_180_99),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_64),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];

/// The part of the light that has been reflected once and not got out which gets out in the end,
/// `F² E/(1 − F (1 − E))` for the mean reflectance `F` and the mean albedo `E`.
#[inline(always)]
fn recovered<R: Real>(f: R, mean_loss: R) -> R {
    let one = f.lift(1.0);
    f.squared() * (one - mean_loss) / (one - f * mean_loss)
}

/// A GGX with the light of further reflections as a lobe of its own:
/// `f = f_single + F_ms (1 − E(l)) (1 − E(v))/(π (1 − E_mean))`, `F_ms = F² E_mean/(1 − F (1 − E_mean))`.
///
/// Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course, after Kelemen and Szirmay-Kalos
/// 2001; with the square of the mean reflectance `F` that the second of two reflections needs (Hill, "A Multi-Faceted Exploration",
/// part 3, 2018). Reciprocal to the last bit.
///
/// A white one (`F0 = 1`) reflects everything: for `α` from 1e-4 to 1 and every view its albedo is within 1.5e-3 of 1 with [`GgxTable`], with
/// [`GgxFit`] within 6e-4 (test `a_white_metal_is_white`).
///
/// ```
/// use lobe::{Alpha, Brdf, Rgb, Vec3, fresnel::Schlick};
/// use lobe_energy::{KullaConty, directional_albedo};
///
/// let white = Schlick::new(Rgb::splat(1.0));
/// let metal: KullaConty<_, f64> = KullaConty::new(Alpha(0.8), white);
/// let albedo = directional_albedo(&metal, Vec3::new(0.6, 0.0, 0.8));
/// assert!((albedo.value.g - 1.0).abs() < 1e-3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KullaConty<F, R = f32, E = GgxFit<R>> {
    single: Microfacet<Ggx<R>, SmithCorrelated, F>,
    energy: E,
    scale: Rgb<R>,
}

impl<R: Real, F: Fresnel<R>, E: GgxAlbedo<R>> KullaConty<F, R, E> {
    /// Facets of this width and Fresnel term, from a conductor to a dielectric.
    #[inline]
    pub fn new(alpha: Alpha<R>, fresnel: F) -> Self {
        let energy = E::new(alpha);
        let mean = energy.mean_loss();
        let scale = average_fresnel(&fresnel, alpha.0).map(|f| recovered(f, mean).times(FRAC_1_PI) / mean);
        Self { single: Microfacet::new(Ggx::new(alpha), SmithCorrelated, fresnel), energy, scale }
    }

    /// The lobe of the single reflections.
    #[inline(always)]
    pub fn single(&self) -> &Microfacet<Ggx<R>, SmithCorrelated, F> {
        &self.single
    }

    #[inline(always)]
    fn further(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R> {
        let losses = self.energy.loss(l.z) * self.energy.loss(v.z);
        self.scale * above_horizon(l, v, losses * weight)
    }
}

/// `factor` where both directions are above the horizon, and 0 elsewhere; the lobe beside it keeps a NaN.
#[inline(always)]
pub(crate) fn above_horizon<R: Real>(l: Vec3<R>, v: Vec3<R>, factor: R) -> R {
    let zero = factor.lift(0.0);
    R::select(l.z.min(v.z).gt(zero), factor, zero)
}

impl<R: Real, F: Fresnel<R>, E: GgxAlbedo<R>> Brdf<R> for KullaConty<F, R, E> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.single.eval(l, v) + self.further(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.single.eval_cos(l, v) + self.further(l, v, l.z)
    }
}

impl<F: Carry, E: Carry> Carry for KullaConty<F, f32, E> {
    type In<S: Real> = KullaConty<F::In<S>, S, E::In<S>>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
        KullaConty { single: self.single.carry(lift), energy: self.energy.carry(lift), scale: self.scale.carry(lift) }
    }
}

/// A GGX brightened by what it loses: `f = f_single (1 + F0 (1 − E(v))/E(v))`.
///
/// Turquin, "Practical Multiple Scattering Compensation for Microfacet Models", 2019, equation 16; Filament's `energyCompensation` is
/// the same with its own table for `E`. Cheap, and of the shape of the single reflection. Not reciprocal: it depends on the viewer's
/// `E` alone, so `f(l, v)` and `f(v, l)` differ by up to `E(l)/E(v)`, a factor of three.
///
/// A white one (`F0 = 1`) is within 1.2e-3 of white with [`GgxFit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turquin<F, R = f32, E = GgxFit<R>> {
    single: Microfacet<Ggx<R>, SmithCorrelated, F>,
    energy: E,
    f0: Rgb<R>,
}

impl<R: Real, F: Fresnel<R>, E: GgxAlbedo<R>> Turquin<F, R, E> {
    /// Facets of this width and Fresnel term; `F0` is its value at normal incidence.
    #[inline]
    pub fn new(alpha: Alpha<R>, fresnel: F) -> Self {
        let f0 = fresnel.fresnel(Incidence::from_cos(alpha.0.lift(1.0)));
        Self { single: Microfacet::new(Ggx::new(alpha), SmithCorrelated, fresnel), energy: E::new(alpha), f0 }
    }

    /// The lobe of the single reflections.
    #[inline(always)]
    pub fn single(&self) -> &Microfacet<Ggx<R>, SmithCorrelated, F> {
        &self.single
    }

    /// What the single reflections are multiplied by, `1 + F0 (1 − E(v))/E(v)`; 1 below the horizon.
    #[inline(always)]
    pub fn gain(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let one = v.z.lift(1.0);
        let loss = self.energy.loss(v.z);
        // Selected before the product: below the horizon the loss is not a number.
        let gain = above_horizon(l, v, loss / (one - loss));
        self.f0.map(
            #[inline(always)]
            |f0| (f0 * gain).plus(1.0),
        )
    }
}

impl<R: Real, F: Fresnel<R>, E: GgxAlbedo<R>> Brdf<R> for Turquin<F, R, E> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.single.eval(l, v) * self.gain(l, v)
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.single.eval_cos(l, v) * self.gain(l, v)
    }
}

impl<F: Carry, E: Carry> Carry for Turquin<F, f32, E> {
    type In<S: Real> = Turquin<F::In<S>, S, E::In<S>>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Self::In<S> {
        Turquin { single: self.single.carry(lift), energy: self.energy.carry(lift), f0: self.f0.carry(lift) }
    }
}

/// A GGX with Schlick's term over a diffuse base, all light accounted for:
/// `f = f_single + (F_ms E_ms + ρ (1 − F_ss E_ss − F_ms E_ms))/π`, each by the viewer's cosine.
///
/// Fdez-Agüera, "A Multiple-Scattering Microfacet Model for Real-Time Image-Based Lighting", JCGT 8(1), 2019, section 3 and listing 2:
/// `F_ss E_ss = F0 A + B`, `E_ms = 1 − A − B`, `F_ms = F_ss E_ss F/(1 − E_ms F)`, `F = F0 + (1 − F0)/21`. For light from everywhere
/// it is meant, and as a BRDF it is not reciprocal: the diffuse part depends on the viewer alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FdezAguera<R = f32> {
    single: Microfacet<Ggx<R>, SmithCorrelated, lobe::fresnel::Schlick<R>>,
    table: GgxTable<R>,
    f0: Rgb<R>,
    rho: Rgb<R>,
}

impl<R: Real> FdezAguera<R> {
    /// Facets of this width and `F0` over a base of the albedo `ρ`; metals have none.
    #[inline]
    pub fn new(alpha: Alpha<R>, f0: Rgb<R>, rho: Rgb<R>) -> Self {
        let single = Microfacet::new(Ggx::new(alpha), SmithCorrelated, lobe::fresnel::Schlick::new(f0));
        Self { single, table: GgxTable::new(alpha), f0, rho }
    }

    /// The lobe of the single reflections.
    #[inline(always)]
    pub fn single(&self) -> &Microfacet<Ggx<R>, SmithCorrelated, lobe::fresnel::Schlick<R>> {
        &self.single
    }

    /// What is added to the single reflection, in sr⁻¹.
    #[inline(always)]
    fn diffuse(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R> {
        let (lost, through) = (self.table.loss(v.z), self.table.through_weight(v.z));
        let (f0, rho) = (self.f0, self.rho);
        let rgb = Rgb::new(
            added(f0.r, rho.r, lost, through),
            added(f0.g, rho.g, lost, through),
            added(f0.b, rho.b, lost, through),
        );
        rgb.map(
            #[inline(always)]
            |value| above_horizon(l, v, value * weight),
        )
    }
}

/// `(F_ms E_ms + ρ (1 − F_ss E_ss − F_ms E_ms))/π` from `1 − A − B` and `1 − w` of Schlick's term.
#[inline(always)]
fn added<R: Real>(f0: R, rho: R, lost: R, through: R) -> R {
    let one = f0.lift(1.0);
    let single = (one - lost) * (f0 + (one - f0) * (one - through));
    let mean = f0 + (one - f0).times(1.0 / 21.0);
    // What is left for the base as a sum over the same denominator: the difference loses its digits where that is
    // little.
    let left = (one - f0) * ((one - lost) * through + lost.times(20.0 / 21.0));
    (single * mean * lost + rho * left).times(FRAC_1_PI) / (one - lost * mean)
}

impl<R: Real> Brdf<R> for FdezAguera<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.single.eval(l, v) + self.diffuse(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.single.eval_cos(l, v) + self.diffuse(l, v, l.z)
    }
}

impl Carry for FdezAguera<f32> {
    type In<S: Real> = FdezAguera<S>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> FdezAguera<S> {
        FdezAguera {
            single: self.single.carry(lift),
            table: self.table.carry(lift),
            f0: self.f0.carry(lift),
            rho: self.rho.carry(lift),
        }
    }
}

/// What a GGX dielectric with Schlick's term reflects and lets pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interface<R> {
    table: GgxTable<R>,
    f0: R,
}

impl<R: Real> Interface<R> {
    #[inline]
    pub(crate) fn new(alpha: Alpha<R>, f0: R) -> Self {
        Self { table: GgxTable::new(alpha), f0 }
    }

    /// `1 − E(μ)`, as a sum: what is lost between the facets, and what Fresnel's term lets through.
    #[inline(always)]
    pub(crate) fn passed(&self, mu: R) -> R {
        let one = mu.lift(1.0);
        let loss = self.table.loss(mu);
        loss + (one - loss) * (one - self.f0) * self.table.through_weight(mu)
    }

    /// `2 ∫ (1 − E(μ)) μ dμ`, of what is interpolated.
    #[inline]
    pub(crate) fn mean_passed(&self) -> R {
        let mut mean = self.f0.lift(0.0);
        for (root, weight) in GAUSS_LEGENDRE_8 {
            mean = mean + self.passed(mean.lift(root * root)).times(4.0 * weight * root * root * root);
        }
        mean
    }
}

impl Carry for Interface<f32> {
    type In<S: Real> = Interface<S>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> Interface<S> {
        Interface { table: self.table.carry(lift), f0: self.f0.carry(lift) }
    }
}

/// A diffuse base under a GGX dielectric that takes nothing it does not reflect:
/// `f = f_single + ρ (1 − E(l)) (1 − E(v))/(π (1 − E_mean))`, with `E` the albedo of the specular lobe, Fresnel's term in it.
///
/// Kelemen and Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling", Eurographics 2001,
/// equation 5. Reciprocal to the last bit; with a white base the whole reflects everything, to the error of the table (test
/// `a_white_base_makes_a_white_whole`: 7e-3).
///
/// ```
/// use lobe::{Alpha, Rgb, Vec3};
/// use lobe_energy::{CoupledDiffuse, directional_albedo};
///
/// let white = CoupledDiffuse::new(Alpha(0.3), 0.04, Rgb::splat(1.0));
/// let albedo = directional_albedo(&white, Vec3::new(0.8, 0.0, 0.6));
/// assert!((albedo.value.g - 1.0).abs() < 7e-3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoupledDiffuse<R = f32> {
    single: Microfacet<Ggx<R>, SmithCorrelated, lobe::fresnel::Schlick<R>>,
    interface: Interface<R>,
    scale: Rgb<R>,
}

impl<R: Real> CoupledDiffuse<R> {
    /// A base of the albedo `ρ` under facets of this width and a grey `F0`.
    #[inline]
    pub fn new(alpha: Alpha<R>, f0: R, rho: Rgb<R>) -> Self {
        let single = Microfacet::new(Ggx::new(alpha), SmithCorrelated, lobe::fresnel::Schlick::new(Rgb::splat(f0)));
        let interface = Interface::new(alpha, f0);
        let passed = interface.mean_passed();
        let scale = rho.map(
            #[inline(always)]
            |rho| rho.times(FRAC_1_PI) / passed,
        );
        Self { single, interface, scale }
    }

    /// The lobe of the single reflections.
    #[inline(always)]
    pub fn single(&self) -> &Microfacet<Ggx<R>, SmithCorrelated, lobe::fresnel::Schlick<R>> {
        &self.single
    }

    #[inline(always)]
    fn base(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R> {
        self.scale * above_horizon(l, v, self.interface.passed(l.z) * self.interface.passed(v.z) * weight)
    }
}

impl<R: Real> Brdf<R> for CoupledDiffuse<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.single.eval(l, v) + self.base(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.single.eval_cos(l, v) + self.base(l, v, l.z)
    }
}

impl Carry for CoupledDiffuse<f32> {
    type In<S: Real> = CoupledDiffuse<S>;
    #[inline(always)]
    fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> CoupledDiffuse<S> {
        CoupledDiffuse {
            single: self.single.carry(lift),
            interface: self.interface.carry(lift),
            scale: self.scale.carry(lift),
        }
    }
}
