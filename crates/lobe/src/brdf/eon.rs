//! EON: Fujii's form of Oren-Nayar and the light that it loses,
//! `f_r = ρ/π A (1 + r s/t) + ρₘ/π (1 − E(l))(1 − E(v))/(1 − Ē)`.

use super::{Brdf, above_horizon, plane};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

/// EON, the energy-preserving Oren-Nayar: `f_r = ρ/π A (1 + r s/t) + ρₘ/π (1 − E(l))(1 − E(v))/(1 − Ē)` sr⁻¹ with
/// `s = l·v − (n·l)(n·v)`, `t = max(n·l, n·v)` where `s > 0` and 1 elsewhere, `A = 1/(1 + (1/2 − 2/(3π)) r)`, the albedo
/// `E` of the first term for `ρ = 1`, its mean `Ē = A (1 + (2/3 − 28/(15π)) r)`, and `ρₘ = ρ² Ē/(1 − ρ (1 − Ē))`.
///
/// Portsmouth, Kutz and Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025 (arXiv
/// 2410.18026), listing 1, with the exact `E`. For `ρ = 1` all light is reflected, at every angle.
///
/// The published `1 − E` and `1 − Ē` are differences that vanish for `r → 0` and towards the horizon, and need an ε. Here
/// they are `A r H/π` and `A r (c₁ − c₂)`, where `c₁`, `c₂` are the constants above and, with `S = sin θ` and the elevation
/// `φ`, `H = (π/2 − 2/3)(1 − S) + S φ − S cos θ (1 − S)(S + 2)/(3 (1 + S))`, `1 − S = cos²θ/(1 + S)`.
///
/// Reciprocal to the last bit. Domain: `ρ`, `r` in `[0, 1]`. Error against `f64` of the same inputs: 4e-6.
///
/// ```
/// use lobe::{Brdf, Eon, Rgb, Vec3};
/// // Without roughness it is Lambert's.
/// let f = Eon::new(Rgb::splat(0.5_f32), 0.0).eval(Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, 0.8));
/// assert!((f.g - 0.5 / core::f32::consts::PI).abs() < 1e-7);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eon<R = f32> {
    albedo: Rgb<R>,
    roughness: R,
    /// `ρ A/π`.
    single: Rgb<R>,
    /// `ρₘ A r/(π³ (c₁ − c₂))`.
    multiple: Rgb<R>,
}

carry!([] Eon<f32> => Eon<S> { albedo, roughness, single, multiple });

/// `c₁`.
const LOSS: f64 = 0.5 - 2.0 / (3.0 * PI);
/// `c₂`.
const MEAN: f64 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

impl<R: Real> Eon<R> {
    /// The lobe of single-scattering albedo `ρ` and roughness `r`.
    #[inline(always)]
    pub fn new(albedo: Rgb<R>, roughness: R) -> Self {
        let a = roughness.times(LOSS).plus(1.0).recip();
        let mean = a * roughness.times(MEAN).plus(1.0);
        // 1 − Ē.
        let lost = a * roughness.times(LOSS - MEAN);
        let multiple = albedo.map(
            #[inline(always)]
            |rho| rho.squared() * mean / (rho.lift(1.0) - rho * lost),
        );
        let scale = FRAC_1_PI * FRAC_1_PI * FRAC_1_PI / (LOSS - MEAN);
        Self {
            albedo,
            roughness,
            single: albedo * a.times(FRAC_1_PI),
            multiple: multiple * (a * roughness).times(scale),
        }
    }

    /// The single-scattering albedo `ρ`.
    #[inline(always)]
    pub fn albedo(&self) -> Rgb<R> {
        self.albedo
    }

    /// The roughness `r`.
    #[inline(always)]
    pub fn roughness(&self) -> R {
        self.roughness
    }

    /// The same lobe in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Eon<S> {
        Eon::new(self.albedo.map(&f), f(self.roughness))
    }

    #[inline(always)]
    fn weighted(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R> {
        let (zero, one) = (weight.lift(0.0), weight.lift(1.0));
        let r = self.roughness;
        let s = plane::dot(l, v);
        let toward = weight + (r * s) * (weight / l.z.max(v.z));
        let away = weight * ((one - r) + r * plane::one_plus_dot(l, v));
        let single = R::select(s.gt(zero), toward, away);
        let multiple = weight * (loss(l) * loss(v));
        self.single * above_horizon(l, v, single) + self.multiple * above_horizon(l, v, multiple)
    }
}

impl<R: Real> Brdf<R> for Eon<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z)
    }
}

/// `H`, from π/2 − 2/3 at the normal down to 0 at the horizon.
#[inline(always)]
fn loss<R: Real>(w: Vec3<R>) -> R {
    let sin = plane::sin(w);
    let above = sin.plus(1.0);
    let rest = w.z.squared() / above;
    let elevation = w.z.atan2(sin);
    rest.times(FRAC_PI_2 - 2.0 / 3.0) + sin * elevation - (sin * w.z) * rest * sin.plus(2.0) / above.times(3.0)
}
