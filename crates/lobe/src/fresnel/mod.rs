//! `F`: how much a facet reflects, one file a form.

mod schlick;

pub use schlick::Schlick;

use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;

/// An angle of incidence `θ` in `[0, π/2]`, by two numbers: near the normal `cos θ` says nothing about `1 − cos θ`, and
/// towards the horizon `sin θ` nothing about the cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incidence<R = f32> {
    /// `cos θ`, from 0 to 1.
    pub cos: R,
    /// `sin² θ`.
    pub sin2: R,
}

impl<R: Real> Incidence<R> {
    /// The angle of a cosine; `sin² θ = (1 − cos θ)(1 + cos θ)`.
    #[inline(always)]
    pub fn from_cos(cos: R) -> Self {
        let one = cos.lift(1.0);
        Self { cos, sin2: (one - cos) * (one + cos) }
    }

    /// The angle between `l` and the half vector of `l` and `v`, where `cos θ = |l + v|/2` is known:
    /// `sin² θ = |l − v|²/4`.
    #[inline(always)]
    pub(crate) fn halfway(l: Vec3<R>, v: Vec3<R>, cos: R) -> Self {
        Self { cos, sin2: (l - v).length_squared().times(0.25) }
    }

    /// The angle between a unit vector of the local frame and the normal.
    #[inline(always)]
    pub fn of(w: Vec3<R>) -> Self {
        Self { cos: w.z, sin2: w.x.squared() + w.y.squared() }
    }

    /// `1 − cos θ = sin² θ/(1 + cos θ)`, to the last digits at every angle.
    #[inline(always)]
    pub fn one_minus_cos(self) -> R {
        self.sin2 / self.cos.plus(1.0)
    }
}

/// The reflectance of a smooth interface for unpolarised light.
pub trait Fresnel<R: Real> {
    /// `F(θ)` for the angle between the light and the normal of the facet; in `[0, 1]`.
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R>;

    /// `1 − F(θ)`: what passes the interface. A form that can tell it without the difference overrides this.
    #[inline(always)]
    fn transmitted(&self, incidence: Incidence<R>) -> Rgb<R> {
        Rgb::splat(incidence.cos.lift(1.0)) - self.fresnel(incidence)
    }
}
