//! A coat: `f = f_top + (1 − F(n·l)) (1 − F(n·v)) f_base`.

use super::{Brdf, above_horizon};
use crate::Carry;
use crate::carry::carry;
use crate::color::Rgb;
use crate::fresnel::{Fresnel, Incidence};
use crate::number::Real;
use crate::vector::Vec3;

/// A lobe under a coat: `f = f_top + (1 − F(n·l)) (1 − F(n·v)) f_base`.
///
/// The energy split: light that the coat's interface `F` reflects does not reach the base, on the way in or out; what the
/// base sends back and the coat reflects inwards again is lost. So it never gains for a base that does not, if the
/// top's albedo stays within `F(n·v)`: a smooth top's does; a rough one's may exceed it by what `F` varies over the
/// facets. (A test finds no gain for a GGX top with `α` to 0.3 over a white base.) After Weidlich and Wilkie, "Arbitrarily Layered Micro-Facet Surfaces", 2007,
/// without their absorption and refraction, which would need the directions inside.
///
/// Reciprocal to the last bit if both lobes are.
///
/// ```
/// use lobe::{Alpha, Brdf, Coat, Lambert, Microfacet, Rgb, Vec3};
/// use lobe::{distribution::Ggx, fresnel::Schlick, masking::SmithCorrelated};
/// let varnish = Schlick::new(Rgb::splat(0.04_f32));
/// let top = Microfacet::new(Ggx::new(Alpha(0.05)), SmithCorrelated, varnish);
/// let wood = Coat::new(top, varnish, Lambert::new(Rgb::new(0.4, 0.2, 0.1)));
/// let f = wood.eval(Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.0, 1.0));
/// assert!(f.r > f.b && f.r < 0.4 / core::f32::consts::PI);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat<T, F, B> {
    top: T,
    interface: F,
    base: B,
}

carry!([T: Carry, F: Carry, B: Carry] Coat<T, F, B> => Coat<T::In<S>, F::In<S>, B::In<S>> { top, interface, base });

impl<T, F, B> Coat<T, F, B> {
    /// The lobe `top`, whose interface has the Fresnel term `interface`, over the lobe `base`.
    #[inline(always)]
    pub fn new(top: T, interface: F, base: B) -> Self {
        Self { top, interface, base }
    }

    /// The lobe on top.
    #[inline(always)]
    pub fn top(&self) -> &T {
        &self.top
    }

    /// The Fresnel term of the coat's interface.
    #[inline(always)]
    pub fn interface(&self) -> &F {
        &self.interface
    }

    /// The lobe under the coat.
    #[inline(always)]
    pub fn base(&self) -> &B {
        &self.base
    }

    /// What the coat leaves of the base: `(1 − F(n·l)) (1 − F(n·v))`, 0 below the horizon.
    #[inline(always)]
    pub fn transmitted<R: Real>(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R>
    where
        F: Fresnel<R>,
    {
        let t = self.interface.transmitted(Incidence::of(l)) * self.interface.transmitted(Incidence::of(v));
        // Below the horizon the base is 0, and a Fresnel term that is not a number there must not spoil it.
        Rgb::new(above_horizon(l, v, t.r), above_horizon(l, v, t.g), above_horizon(l, v, t.b))
    }
}

impl<R: Real, T: Brdf<R>, F: Fresnel<R>, B: Brdf<R>> Brdf<R> for Coat<T, F, B> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.top.eval(l, v) + self.base.eval(l, v) * self.transmitted(l, v)
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.top.eval_cos(l, v) + self.base.eval_cos(l, v) * self.transmitted(l, v)
    }
}
