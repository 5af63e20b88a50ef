//! A dielectric coat over any lobe, whose base gets what the coat's albedo leaves.

use crate::compensation::{Interface, above_horizon};
use core::marker::PhantomData;
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Carry, Microfacet, Real, Rgb, Vec3};

/// How much of a base shows through a coat, from what the coat lets pass in each direction, `p(μ) = 1 − E(μ)`.
pub trait Share<R: Real>: Copy {
    /// The factor of the base for `p(n·l)`, `p(n·v)` and the mean `2 ∫ p(μ) μ dμ`; the same both ways.
    fn share(l: R, v: R, mean: R) -> R;
}

/// `p(l) p(v)/p_mean`: a Lambert base sends on exactly what it gets. A base that mirrors shows by up to `p(v)/p_mean` more than
/// what there is, 5 % along the normal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Even;

impl<R: Real> Share<R> for Even {
    #[inline(always)]
    fn share(l: R, v: R, mean: R) -> R {
        l * v / mean
    }
}

/// `min(p(l), p(v))`: no base shows by more than what there is, in either direction. A Lambert base loses some.
///
/// As `KHR_materials_sheen` of glTF has it for its layer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Least;

impl<R: Real> Share<R> for Least {
    #[inline(always)]
    fn share(l: R, v: R, _: R) -> R {
        l.min(v)
    }
}

/// A base under a GGX dielectric with Schlick's term: `f = f_coat + share(l, v) f_base`, by [`Even`] or [`Least`] shares of what the
/// coat's albedo `E` leaves.
///
/// [`Coat`](lobe::Coat) splits by Fresnel's term of a smooth interface, once for each way; what the base sends back up and
/// the coat reflects down again is lost there. Here it is not: Kulla and Conty, "Revisiting Physically Based Shading at
/// Imageworks", SIGGRAPH 2017 course, after Kelemen and Szirmay-Kalos 2001, for any base. Neither refracts: a base is seen at the angles
/// outside, and is as sharp as it is.
///
/// Albedo of the whole with a coat of `F0` 0.04 and 0.17, `α` from 0.01 to 1 and `n·v` from 0.03 to 1 (test
/// `coats_over_white_bases`):
///
/// | white base | [`Even`] | [`Least`] | [`Coat`](lobe::Coat) |
/// |---|---|---|---|
/// | Lambert | 1.000 to 1.002 | 0.961 to 1.002 | 0.195 to 0.920 |
/// | metal, `α = 0.3` | 0.980 to 1.019 | 0.962 to 1.002 | 0.188 to 0.938 |
///
/// The 2e-3 above 1 are the error of the table of `E`.
///
/// Reciprocal to the last bit if the base is. Domain: `α` from 1e-4 to 1, `F0` from 0 to 0.5.
///
/// ```
/// use lobe::{Alpha, Brdf, Rgb, Vec3, fresnel::Schlick};
/// use lobe_energy::{AlbedoCoat, KullaConty};
///
/// let gold = Schlick::new(Rgb::new(1.0, 0.77, 0.34_f32));
/// let metal: KullaConty<_> = KullaConty::new(Alpha(0.4), gold);
/// let lacquered: AlbedoCoat<_> = AlbedoCoat::new(Alpha(0.05), 0.04, metal);
/// // Far from the coat's highlight the metal shows, a little darker.
/// let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.0, 1.0));
/// let (bare, f) = (metal.eval(l, v), lacquered.eval(l, v));
/// assert!(f.r < bare.r && f.r > 0.9 * bare.r && f == lacquered.eval(v, l));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlbedoCoat<B, S = Least, R = f32> {
    top: Microfacet<Ggx<R>, SmithCorrelated, Schlick<R>>,
    interface: Interface<R>,
    mean: R,
    base: B,
    share: PhantomData<S>,
}

impl<B, S: Share<R>, R: Real> AlbedoCoat<B, S, R> {
    /// A coat of this width and `F0` over the lobe `base`.
    #[inline]
    pub fn new(alpha: Alpha<R>, f0: R, base: B) -> Self {
        let interface = Interface::new(alpha, f0);
        let top = Microfacet::new(Ggx::new(alpha), SmithCorrelated, Schlick::new(Rgb::splat(f0)));
        Self { top, interface, mean: interface.mean_passed(), base, share: PhantomData }
    }

    /// The lobe of the coat.
    #[inline(always)]
    pub fn top(&self) -> &Microfacet<Ggx<R>, SmithCorrelated, Schlick<R>> {
        &self.top
    }

    /// The base.
    #[inline(always)]
    pub fn base(&self) -> &B {
        &self.base
    }

    /// The factor of the base, `share(l, v)`; 0 below the horizon.
    #[inline(always)]
    pub fn transmitted(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        // Below the horizon the base is 0, and an albedo that is not a number there must not spoil it.
        above_horizon(l, v, S::share(self.interface.passed(l.z), self.interface.passed(v.z), self.mean))
    }
}

impl<B: Brdf<R>, S: Share<R>, R: Real> Brdf<R> for AlbedoCoat<B, S, R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.top.eval(l, v) + self.base.eval(l, v) * self.transmitted(l, v)
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.top.eval_cos(l, v) + self.base.eval_cos(l, v) * self.transmitted(l, v)
    }
}

impl<B: Carry, S> Carry for AlbedoCoat<B, S, f32> {
    type In<T: Real> = AlbedoCoat<B::In<T>, S, T>;
    #[inline(always)]
    fn carry<T: Real>(&self, lift: &impl Fn(f32) -> T) -> Self::In<T> {
        AlbedoCoat {
            top: self.top.carry(lift),
            interface: self.interface.carry(lift),
            mean: self.mean.carry(lift),
            base: self.base.carry(lift),
            share: PhantomData,
        }
    }
}
