//! Oren-Nayar, qualitative: `f_r = ρ/π (A + B max(0, cos Δφ) sin α tan β)`, and in full.

use super::{Brdf, above_horizon, plane};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::{FRAC_1_PI, FRAC_2_PI};

/// The qualitative Oren-Nayar model: `f_r = ρ/π (A + B max(0, cos Δφ) sin α tan β)` sr⁻¹ with
/// `A = 1 − σ²/(2 (σ² + 0.33))`, `B = 0.45 σ²/(σ² + 0.09)`, `α` the larger and `β` the smaller of the two angles to the
/// normal, and `Δφ` the azimuth between the directions.
///
/// Oren and Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, equation 30: V-cavities of Lambertian
/// facets whose slopes' angles have the standard deviation `σ`. Without interreflections: it loses energy, but for small
/// `σ` at grazing views, where it gains (1.5 % with `σ = 0.2` at 89.9°).
///
/// Reciprocal to the last bit. Domain: `ρ ∈ [0, 1]`, `σ ∈ [0, π/2]` radians. Lambert's for `σ = 0`. Error against `f64` of
/// the same inputs: 4e-6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayarQualitative<R = f32> {
    albedo: Rgb<R>,
    sigma: R,
    a: R,
    b: R,
}

carry!([] OrenNayarQualitative<f32> => OrenNayarQualitative<S> { albedo, sigma, a, b });

impl<R: Real> OrenNayarQualitative<R> {
    /// The surface of facet albedo `ρ` and roughness `σ` in radians.
    #[inline(always)]
    pub fn new(albedo: Rgb<R>, sigma: R) -> Self {
        let s2 = sigma.squared();
        let a = sigma.lift(1.0) - (s2 / s2.plus(0.33)).times(0.5);
        Self { albedo, sigma, a, b: (s2 / s2.plus(0.09)).times(0.45) }
    }

    /// The albedo `ρ` of the facets.
    #[inline(always)]
    pub fn albedo(&self) -> Rgb<R> {
        self.albedo
    }

    /// The roughness `σ` in radians.
    #[inline(always)]
    pub fn sigma(&self) -> R {
        self.sigma
    }

    /// The same surface in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> OrenNayarQualitative<S> {
        OrenNayarQualitative::new(self.albedo.map(&f), f(self.sigma))
    }

    #[inline(always)]
    fn weighted(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R> {
        // cos Δφ sin α tan β = (l·v − (n·l)(n·v))/max(n·l, n·v).
        let s = plane::dot(l, v).max(weight.lift(0.0));
        let value = weight * self.a + (self.b * s) * (weight / l.z.max(v.z));
        self.albedo * above_horizon(l, v, value.times(FRAC_1_PI))
    }
}

impl<R: Real> Brdf<R> for OrenNayarQualitative<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z)
    }
}

/// The full Oren-Nayar model with its interreflections: `f_r = ρ/π (C₁ + cos Δφ C₂ tan β + (1 − |cos Δφ|) C₃
/// tan((α + β)/2)) + 0.17 ρ²/π σ²/(σ² + 0.13) (1 − cos Δφ (2β/π)²)` sr⁻¹ with `C₁ = 1 − σ²/(2 (σ² + 0.33))`,
/// `C₂ = 0.45 σ²/(σ² + 0.09) (sin α − [cos Δφ < 0] (2β/π)³)`, `C₃ = 0.125 σ²/(σ² + 0.09) (4αβ/π²)²`.
///
/// Oren and Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, equations 27 to 29.
///
/// Reciprocal to the last bit. Domain: `ρ ∈ [0, 1]`, `σ ∈ [0, 0.6]` radians. Between opposite grazing directions
/// `C₁ + cos Δφ C₂ tan β` tends to `C₁ − 2.7 σ²/(π (σ² + 0.09))`, which is negative from `σ = 0.66` on: what the fit was
/// not made for. Lambert's for `σ = 0`. Error against `f64` of the same inputs: 2e-5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayar<R = f32> {
    albedo: Rgb<R>,
    sigma: R,
    c1: R,
    /// `σ²/(σ² + 0.09)`.
    rough: R,
    /// `0.17 ρ² σ²/(σ² + 0.13)`.
    again: Rgb<R>,
}

carry!([] OrenNayar<f32> => OrenNayar<S> { albedo, sigma, c1, rough, again });

impl<R: Real> OrenNayar<R> {
    /// The surface of facet albedo `ρ` and roughness `σ` in radians.
    #[inline(always)]
    pub fn new(albedo: Rgb<R>, sigma: R) -> Self {
        let s2 = sigma.squared();
        let c1 = sigma.lift(1.0) - (s2 / s2.plus(0.33)).times(0.5);
        let again = albedo * albedo * (s2 / s2.plus(0.13)).times(0.17);
        Self { albedo, sigma, c1, rough: s2 / s2.plus(0.09), again }
    }

    /// The albedo `ρ` of the facets.
    #[inline(always)]
    pub fn albedo(&self) -> Rgb<R> {
        self.albedo
    }

    /// The roughness `σ` in radians.
    #[inline(always)]
    pub fn sigma(&self) -> R {
        self.sigma
    }

    /// The same surface in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> OrenNayar<S> {
        OrenNayar::new(self.albedo.map(&f), f(self.sigma))
    }

    #[inline(always)]
    fn weighted(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R> {
        let (zero, one, least) = (weight.lift(0.0), weight.lift(1.0), weight.lift(1e-36));
        let (sin_l, sin_v) = (plane::sin(l), plane::sin(v));
        let (cos_beta, cos_alpha) = (l.z.max(v.z), l.z.min(v.z));
        let (sin_alpha, sum) = (sin_l.max(sin_v), sin_l + sin_v);
        // 1 − 2α/π and 1 − 2β/π, from the elevations.
        let (up_l, up_v) = (l.z.atan2(sin_l).times(FRAC_2_PI), v.z.atan2(sin_v).times(FRAC_2_PI));
        let up_beta = up_l.max(up_v);
        let (a, b) = (one - up_l.min(up_v), one - up_beta);
        let b2 = b.squared();

        // At the normal there is no azimuth: without `least` 0/0 (test `the_normal_has_no_azimuth`).
        let (s, cross, product) = (plane::dot(l, v), plane::cross(l, v), (sin_l * sin_v).max(least));
        let cos_phi = s / product;
        // 1 − |cos Δφ| = sin² Δφ/(1 + |cos Δφ|).
        let across = (cross / product).squared() / cos_phi.abs().plus(1.0);

        // sin α − (2β/π)³, near the horizon without the difference.
        let low = up_beta * (b.plus(1.0) + b2) - cos_alpha.squared() / sin_alpha.plus(1.0);
        let opposite = R::select(cos_beta.lt(one.times(0.5)), low, sin_alpha - b2 * b) / sin_alpha.max(least);
        let steep = weight / cos_beta;
        let c2 = s * R::select(s.lt(zero), opposite * steep, steep);
        let c3 = across * (a * b).squared() * (sum * (weight / (cos_alpha + cos_beta)));
        let once = weight * self.c1 + self.rough * (c2.times(0.45) + c3.times(0.125));
        let twice = weight * (one - cos_phi * b2);
        (self.albedo * above_horizon(l, v, once) + self.again * above_horizon(l, v, twice)) * weight.lift(FRAC_1_PI)
    }
}

impl<R: Real> Brdf<R> for OrenNayar<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z)
    }
}
