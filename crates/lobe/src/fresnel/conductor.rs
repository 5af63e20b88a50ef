//! Fresnel, conductor: `Rs = |cos θ − w|²/|cos θ + w|²`, `w² = (η + ik)² − sin² θ`, and its `Rp`.

use super::dielectric::root_free;
use super::{Fresnel, Incidence, at_most_one, felt, zip};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;

/// Fresnel's reflectance of a conductor, for unpolarised light, from the index of refraction `η` and the extinction
/// coefficient `k`, per channel.
///
/// With `w = a + ib`, `w² = (η + ik)² − sin² θ`: `Rs = ((a − cos θ)² + b²)/((a + cos θ)² + b²)` and
/// `Rp = Rs ((a cos θ − sin² θ)² + b² cos² θ)/((a cos θ + sin² θ)² + b² cos² θ)`; `F = (Rs + Rp)/2`.
///
/// Born and Wolf, *Principles of Optics*, 1959, section 13.2; in this form Heitz and others after Lagarde, "Memo on
/// Fresnel equations", 2013.
///
/// No digit is lost to a difference: the larger of `a` and `b` comes from the sum `|w|² + |a² − b²|`, the smaller from
/// `a b = η k`; and `a² − cos² θ = (η² − 1) + sin² θ b²/(η² + b²)`, which has no cancellation for `η ≥ 1`, the domain
/// where `Rs` may be small.
///
/// Domain: `η ∈ [0, 4]`, `k ∈ [0, 10]`. Error against `f64` of the same inputs: 1e-6 for `η ≥ 1`, and for any `η` with
/// `k ≥ 1`: all metals. For `η < 1` and `k → 0` it becomes that of [`Dielectric`](super::Dielectric) at the critical
/// angle.
///
/// ```
/// use lobe::{Rgb, fresnel::{Conductor, Fresnel, Incidence}};
/// let metal = Conductor::new(Rgb::splat(2.0_f32), Rgb::splat(3.0));
/// // ((η − 1)² + k²)/((η + 1)² + k²) at normal incidence.
/// assert!((metal.fresnel(Incidence::from_cos(1.0)).g - 10.0 / 18.0).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor<R = f32> {
    eta: Rgb<R>,
    k: Rgb<R>,
}

carry!([] Conductor<f32> => Conductor<S> { eta, k });

impl<R: Real> Conductor<R> {
    /// The conductor of index `η` and extinction coefficient `k`, both relative to the medium of the light.
    #[inline(always)]
    pub fn new(eta: Rgb<R>, k: Rgb<R>) -> Self {
        Self { eta, k }
    }

    /// The index of refraction `η`.
    #[inline(always)]
    pub fn eta(&self) -> Rgb<R> {
        self.eta
    }

    /// The extinction coefficient `k`.
    #[inline(always)]
    pub fn k(&self) -> Rgb<R> {
        self.k
    }

    /// The same conductor in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Conductor<S> {
        Conductor::new(self.eta.map(&f), self.k.map(&f))
    }
}

impl<R: Real> Fresnel<R> for Conductor<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        zip(
            self.eta,
            self.k,
            #[inline(always)]
            |eta, k| reflectance(eta, eta.plus(-1.0) * eta.plus(1.0), k, incidence),
        )
    }
}

/// The reflectance, with `η² − 1` given, which knows its digits near `η = 1`.
#[inline(always)]
pub(super) fn reflectance<R: Real>(eta: R, difference: R, k: R, incidence: Incidence<R>) -> R {
    let (cos, sin2) = (felt(incidence.cos), incidence.sin2);
    let cos2 = cos.squared();
    // w² = p + iq.
    let eta2 = eta.squared();
    let steep = difference.lt(eta.lift(0.0)) & sin2.lt(eta.lift(0.5));
    let p = root_free(eta2, difference, sin2, cos2, steep) - k.squared();
    let half_q = eta * k;
    let modulus = (p.squared() + half_q.squared().times(4.0)).sqrt();
    // Where η = 1 and k = 0 this is cos θ, which `p` has lost below 1e-19.
    let larger = (modulus + p.abs()).times(0.5).sqrt().max(cos.lift(1e-18));
    let smaller = half_q / larger;
    let above = p.ge(p.lift(0.0));
    let (a, b) = (R::select(above, larger, smaller), R::select(above, smaller, larger));
    let b2 = b.squared();

    let sum = a + cos;
    // For η = k = 0, which reflects everything, this is 0/0 at normal incidence.
    let split = b2 / (eta2 + b2).max(eta.lift(1e-36));
    let gap = (difference + sin2 * split) / sum;
    let rs = (gap.squared() + b2) / (sum.squared() + b2);
    let (ac, b2c2) = (a * cos, b2 * cos2);
    let ratio = ((ac - sin2).squared() + b2c2) / ((ac + sin2).squared() + b2c2);
    at_most_one((rs * ratio.plus(1.0)).times(0.5))
}
