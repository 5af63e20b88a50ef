//! Fresnel, dielectric: `F = (rs² + rp²)/2`, `rs = (cos θ − g)/(cos θ + g)`, `rp = (η² cos θ − g)/(η² cos θ + g)`,
//! `g² = η² − sin² θ`.

use super::{Fresnel, Incidence, at_most_one, felt};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::parameter::Ior;

/// Fresnel's reflectance between two dielectrics, for unpolarised light: `F = (rs² + rp²)/2` with
/// `rs = (cos θ − g)/(cos θ + g)`, `rp = (η² cos θ − g)/(η² cos θ + g)` and `g² = η² − sin² θ`.
///
/// Fresnel 1823; Born and Wolf, *Principles of Optics*, 1959, section 1.5. For `η < 1` the reflection is total, `F = 1`,
/// from `sin θ = η` on.
///
/// Near `η = 1` the differences above lose their digits: at `η = 1 + 1e-6` the usual form is wrong by percents in `f32`.
/// They are taken out of the formula: `cos²θ − g² = −(η² − 1)` and `η⁴ cos²θ − g² = (η² − 1)(η² cos²θ − sin²θ)`, with
/// `η² − 1 = (η − 1)(η + 1)`.
///
/// Domain: `η ∈ [0.25, 4]`, 1 included, where `F = 0`. Error against `f64` of the same inputs: 1e-6 for `η ≥ 1`. For
/// `η < 1` the slope of `F` is infinite at the critical angle: `g²` is a difference and has an absolute error of at most
/// `6u cos²θ`, so `ρ = g/cos θ` has one of at most `min(3u/ρ, √(6u))`, and `|∂ ln F/∂ρ| ≤ 4/η²`. The relative error is at
/// most `1e-6 + (4/η²) min(3u/ρ, √(6u))`, `u = 2⁻²⁴`.
///
/// ```
/// use lobe::{Ior, fresnel::{Dielectric, Fresnel, Incidence}};
/// let glass = Dielectric::new(Ior(1.5_f32));
/// assert!((glass.fresnel(Incidence::from_cos(1.0)).g - 0.04).abs() < 1e-7);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric<R = f32> {
    eta: Ior<R>,
}

carry!([] Dielectric<f32> => Dielectric<S> { eta });

impl<R: Real> Dielectric<R> {
    /// The interface of a relative index of refraction: of the far side over that of the side of the light.
    #[inline(always)]
    pub fn new(eta: Ior<R>) -> Self {
        Self { eta }
    }

    /// The index.
    #[inline(always)]
    pub fn ior(&self) -> Ior<R> {
        self.eta
    }

    /// The same interface in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Dielectric<S> {
        Dielectric::new(self.eta.map(f))
    }
}

impl<R: Real> Fresnel<R> for Dielectric<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        let eta = self.eta.0;
        let difference = eta.plus(-1.0) * eta.plus(1.0);
        Rgb::splat(reflectance(eta, eta.lift(1.0), difference, incidence))
    }
}

/// The reflectance for `η = n/d`, with `n² − d²` given, which knows its digits near `η = 1`. With `d = 0` it is 1.
#[inline(always)]
pub(super) fn reflectance<R: Real>(n: R, d: R, difference: R, incidence: Incidence<R>) -> R {
    let cos = felt(incidence.cos);
    let (zero, one) = (cos.lift(0.0), cos.lift(1.0));
    let near = cos * d;
    // All times d² or d⁴.
    let n2 = n.squared();
    let far = incidence.sin2 * d.squared();
    let g2 = root_free(n2, difference, far, near.squared(), n.lt(d) & incidence.sin2.lt(one.times(0.5)));
    let g = g2.max(zero).sqrt();
    let rs = difference / (g + near).squared();
    let brewster = n2 * cos.squared() - far;
    let rp = difference * brewster / (n2 * cos + g * d).squared();
    let f = at_most_one((rs.squared() + rp.squared()).times(0.5));
    R::select(g2.le(zero), one, f)
}

/// `n² − d² sin²θ`, either so or as `(n² − d²) + d² cos²θ`. For `η ≥ 1` the second has no cancellation; for `η < 1` both
/// have, and the one with the smaller terms is better: the first for steep light.
#[inline(always)]
pub(super) fn root_free<R: Real>(n2: R, difference: R, far: R, near2: R, steep: R::Mask) -> R {
    R::select(steep, n2 - far, difference + near2)
}
