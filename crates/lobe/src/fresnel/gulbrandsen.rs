//! Gulbrandsen: Fresnel's conductor, for `η` and `k` from a reflectivity `r` and an edge tint `g`.

use super::{Conductor, Fresnel, Incidence, conductor};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;

/// Fresnel's reflectance of a conductor by two parameters that artists can turn: the reflectivity `r` at normal
/// incidence and the edge tint `g`, which moves the index between its two ends,
/// `η = g (1 − r)/(1 + r) + (1 − g)(1 + √r)/(1 − √r)`, `k² = (r (η + 1)² − (η − 1)²)/(1 − r)`.
///
/// Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014, equations 2, 5 and 6.
///
/// `k²` is computed as `g Δ ((1 − g) Δ + η_min − (1 − √r)/(1 + √r))`, where `Δ` is the distance between the ends: the
/// published difference loses all digits for `g → 0`.
///
/// Domain: `r`, `g` in `[0, 1]`. `η` is infinite at `r = 1`, which is taken as 1 − 2⁻²³. Error against `f64` of the same
/// inputs: 24u = 1.5e-6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gulbrandsen<R = f32> {
    reflectivity: Rgb<R>,
    edge_tint: Rgb<R>,
    red: Channel<R>,
    green: Channel<R>,
    blue: Channel<R>,
}

carry!([] Gulbrandsen<f32> => Gulbrandsen<S> { reflectivity, edge_tint, red, green, blue });

/// The index of one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Channel<R> {
    eta: R,
    /// `η² − 1`.
    difference: R,
    k: R,
}

carry!([] Channel<f32> => Channel<S> { eta, difference, k });

impl<R: Real> Channel<R> {
    #[inline(always)]
    fn new(r: R, g: R) -> Self {
        // Without this `η` is 1/0 for a perfect mirror, and `F` NaN (test `the_ends_are_finite`).
        let r = r.min(r.lift(1.0 - f32::EPSILON as f64));
        let one = r.lift(1.0);
        let rest = one - g;
        let s = r.sqrt();
        let above = s.plus(1.0);
        let below = (one - r) / above;
        let around = r.plus(1.0);
        // η_max − η_min.
        let range = (s * above).times(2.0) / (below * around);
        // η − 1 = (1 − g)(η_max − 1) + g (η_min − 1).
        let eta_minus_one = s.times(2.0) * (rest / below - g * s / around);
        // (1 + √r)/(1 − √r) (1 − g) + (1 − r)/(1 + r) g.
        let eta = rest * above / below + g * (one - r) / around;
        let k2 = g * range * (rest * range + (s * below).times(2.0) / (around * above));
        Self { eta, difference: eta_minus_one * eta.plus(1.0), k: k2.sqrt() }
    }

    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> R {
        conductor::reflectance(self.eta, self.difference, self.k, incidence)
    }
}

impl<R: Real> Gulbrandsen<R> {
    /// The metal of reflectivity `r` and edge tint `g`.
    #[inline(always)]
    pub fn new(reflectivity: Rgb<R>, edge_tint: Rgb<R>) -> Self {
        Self {
            reflectivity,
            edge_tint,
            red: Channel::new(reflectivity.r, edge_tint.r),
            green: Channel::new(reflectivity.g, edge_tint.g),
            blue: Channel::new(reflectivity.b, edge_tint.b),
        }
    }

    /// The index `η` and the extinction coefficient `k` that belong to the parameters.
    #[inline(always)]
    pub fn conductor(&self) -> Conductor<R> {
        Conductor::new(
            Rgb::new(self.red.eta, self.green.eta, self.blue.eta),
            Rgb::new(self.red.k, self.green.k, self.blue.k),
        )
    }

    /// The same metal in another number type, its indices computed anew there.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Gulbrandsen<S> {
        Gulbrandsen::new(self.reflectivity.map(&f), self.edge_tint.map(&f))
    }
}

impl<R: Real> Fresnel<R> for Gulbrandsen<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        Rgb::new(self.red.fresnel(incidence), self.green.fresnel(incidence), self.blue.fresnel(incidence))
    }
}
