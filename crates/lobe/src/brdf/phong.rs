//! Phong: `f_r = ks (q + 2)/(2π) · max(0, r·v)^q`.

use super::{Brdf, Shininess, power};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::TAU;

/// The Phong lobe in the form of a BRDF: `f_r = ks (q + 2)/(2π) · max(0, r·v)^q` sr⁻¹, a lobe around the mirror
/// direction `r` of `l`.
///
/// Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975; the BRDF and its normalisation: Lewis,
/// "Making Shaders More Physically Plausible", 1993, and Lafortune and Willems, "Using the Modified Phong Reflectance
/// Model for Physically Based Rendering", 1994, equation 11. The factor makes the albedo at normal incidence exactly
/// `ks`; at any other angle `θ` it is less, for a sharp lobe `ks cos θ`, because the lobe has no `1/(n·l)` in it.
///
/// Reciprocal to the last bit. Domain: `ks ∈ [0, 1]`, `q ∈ [0, 10⁶]`. Outside it the formula goes on as it stands;
/// for `q < −2` the factor is negative.
///
/// Error against `f64` of the same inputs, `u = 2⁻²⁴`, `L = |ln(f/f_max)|`, `c = r·v`:
/// `|δf/f| ≤ u (7 + 6.5 L + 5 q (1/c − 1))` for `c ≥ 2⁻¹²`. For `q ≥ L`, that is wherever a sharp lobe is visible,
/// `q (1/c − 1) ≤ 1.72 L`: the error grows with `L` alone, not with `q`. Derivation and test: `docs/numerics.md`.
///
/// Values below 2⁻¹²⁶ of the peak are 0. For `q = 0` there is an edge where `r·v` is 0: up to there the power is 1.
///
/// ```
/// use lobe::{Brdf, Phong, Rgb, Shininess, Vec3};
/// let lobe = Phong::new(Rgb::splat(0.5_f32), Shininess(20.0));
/// let f = lobe.eval(Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// assert!((f.r - 0.5 * 22.0 / core::f32::consts::TAU).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong<R = f32> {
    ks: Rgb<R>,
    q: Shininess<R>,
    /// `ks (q + 2)/(2π)`.
    peak: Rgb<R>,
}

carry!([] Phong<f32> => Phong<S> { ks, q, peak });

impl<R: Real> Phong<R> {
    /// A mirror lobe of reflectance `ks` and exponent `q`.
    #[inline(always)]
    pub fn new(ks: Rgb<R>, q: Shininess<R>) -> Self {
        Self { ks, q, peak: ks * q.0.plus(2.0).times(1.0 / TAU) }
    }

    /// The reflectance `ks`: the albedo at normal incidence.
    #[inline(always)]
    pub fn ks(&self) -> Rgb<R> {
        self.ks
    }

    /// The exponent `q`.
    #[inline(always)]
    pub fn shininess(&self) -> Shininess<R> {
        self.q
    }

    /// The same lobe in another number type, its factor computed anew there.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Phong<S> {
        Phong::new(self.ks.map(&f), self.q.map(&f))
    }
}

impl<R: Real> Brdf<R> for Phong<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.peak * power::mirror_lobe(l, v, self.q.0)
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.peak * (power::mirror_lobe(l, v, self.q.0) * l.z.max(l.z.lift(0.0)))
    }
}
