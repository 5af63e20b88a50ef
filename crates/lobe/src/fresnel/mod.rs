//! `F`: how much a facet reflects, one file a form.
//!
//! | form | parameters | what it is |
//! |---|---|---|
//! | [`Dielectric`] | [`Ior`](crate::Ior) | Fresnel's equations, exact, down to `η = 1`; total reflection for `η < 1` |
//! | [`Conductor`] | `η`, `k` per channel | Fresnel's equations, exact |
//! | [`CookFresnel`] | [`F0`](crate::F0) per channel | exact, for the `η` that belongs to `F0` |
//! | [`Gulbrandsen`] | `r`, `g` per channel | exact, for `η` and `k` by reflectivity and edge tint |
//! | [`Schlick`], [`SchlickF90`] | `f0`, `f90` | a polynomial |
//! | [`F82Tint`] | `f0`, tint | Schlick's, tinted near 82° |
//! | [`Lazanyi`] | `f0`, `a`, `α` | Schlick's, less a term that metals need |
//!
//! All are in `[0, 1]` to the last bit.

mod conductor;
mod cook;
mod dielectric;
mod f82;
mod gulbrandsen;
mod lazanyi;
pub mod metals;
mod schlick;

pub use conductor::Conductor;
pub use cook::CookFresnel;
pub use dielectric::Dielectric;
pub use f82::F82Tint;
pub use gulbrandsen::Gulbrandsen;
pub use lazanyi::Lazanyi;
pub(crate) use schlick::one_minus_fifth_power;
pub use schlick::{Schlick, SchlickF90};

use crate::color::Rgb;
use crate::number::{Quotient, Real};
use crate::vector::Vec3;

/// An angle of incidence `θ` in `[0, π/2]`, by two numbers: near the normal `cos θ` says nothing about `1 − cos θ`, and
/// towards the horizon `sin θ` nothing about the cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incidence<R = f32> {
    /// `cos θ`, from 0 to 1.
    pub cos: R,
    /// `sin² θ`.
    pub sin2: R,
    /// `1 − cos θ`, to the last digits at every angle.
    pub one_minus_cos: R,
}

impl<R: Real> Incidence<R> {
    /// The angle of a cosine; `sin² θ = (1 − cos θ)(1 + cos θ)`.
    #[inline(always)]
    pub fn from_cos(cos: R) -> Self {
        let one = cos.lift(1.0);
        Self { cos, sin2: (one - cos) * (one + cos), one_minus_cos: one - cos }
    }

    /// The angle of a cosine and the square of its sine, of which each has digits that the other lacks.
    #[inline(always)]
    pub fn new(cos: R, sin2: R) -> Self {
        Self {
            cos,
            sin2,
            one_minus_cos: cos.one_minus(
                #[inline(always)]
                || sin2 / cos.plus(1.0),
            ),
        }
    }

    /// The angle between `l` and the half vector of `l` and `v`, where `cos θ = |l + v|/2` is known:
    /// `sin² θ = |l − v|²/4`.
    #[inline(always)]
    pub(crate) fn halfway(l: Vec3<R>, v: Vec3<R>, cos: R) -> Self {
        Self::halfway_and(l, v, cos, Quotient::whole(cos)).0
    }

    /// The same, and the value of a quotient, by the division that `1 − cos θ = sin² θ/(1 + cos θ)` takes anyway.
    #[inline(always)]
    pub(crate) fn halfway_and(l: Vec3<R>, v: Vec3<R>, cos: R, quotient: Quotient<R>) -> (Self, R) {
        let one = cos.lift(1.0);
        // Of rounded unit vectors the difference may be longer than 2, and Schlick's form would exceed 1.
        let sin2 = (l - v).length_squared().times(0.25);
        let (value, exact) = quotient.with(Quotient::new(sin2, cos + one));
        // Below the horizon the denominator that is shared may be 0, and the quotient NaN. In this order the minimum drops
        // it: what is selected there is 0, and a NaN among the directions is added to that.
        (
            Self {
                cos,
                sin2: sin2.min(one),
                one_minus_cos: cos.one_minus(
                    #[inline(always)]
                    || one.min(exact),
                ),
            },
            value,
        )
    }

    /// The angle between a unit vector of the local frame and the normal.
    #[inline(always)]
    pub fn of(w: Vec3<R>) -> Self {
        Self::new(w.z, w.x.squared() + w.y.squared())
    }
}

/// `cos θ`, at least 1e-18. Below, no reflectance moves any more; but an interface that reflects nothing or everything
/// (`η = 1`, `F0 = 1`) would be 0/0 in the squares of cosines (test `the_ends_are_finite`).
#[inline(always)]
fn felt<R: Real>(cos: R) -> R {
    cos.max(cos.lift(1e-18))
}

/// At most 1, which rounding may exceed by some units in the last place (test `inside_the_unit_interval`).
#[inline(always)]
fn at_most_one<R: Real>(f: R) -> R {
    f.min(f.lift(1.0))
}

/// `x⁵`, which Schlick's form and all that follow it take of `1 − cos θ`.
#[inline(always)]
pub(crate) fn fifth_power<R: Real>(x: R) -> R {
    x.squared().squared() * x
}

/// At least 0, for the forms that subtract a term.
#[inline(always)]
fn at_least_zero<R: Real>(f: R) -> R {
    f.max(f.lift(0.0))
}

/// `f` of the channels of two colours.
#[inline(always)]
fn zip<R: Real>(a: Rgb<R>, b: Rgb<R>, f: impl Fn(R, R) -> R) -> Rgb<R> {
    Rgb { r: f(a.r, b.r), g: f(a.g, b.g), b: f(a.b, b.b) }
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
