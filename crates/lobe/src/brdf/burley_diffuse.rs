//! Burley's diffuse lobe: `f_r = ρ/π (1 + (F90 − 1)(1 − n·l)⁵)(1 + (F90 − 1)(1 − n·v)⁵)`, `F90 = 1/2 + 2 r cos² θ_d`.

use super::{Brdf, above_horizon};
use crate::PerceptualRoughness;
use crate::carry::carry;
use crate::color::Rgb;
use crate::fresnel::fifth_power;
use crate::number::Real;
use crate::vector::Vec3;

/// Burley's diffuse lobe: `f_r = ρ/π (1 + (F90 − 1)(1 − n·l)⁵)(1 + (F90 − 1)(1 − n·v)⁵)` sr⁻¹ with
/// `F90 = 1/2 + 2 r cos² θ_d`, where `θ_d` is the angle between a direction and the half vector and `r` the roughness.
///
/// Burley, "Physically Based Shading at Disney", 2012, section 5.3. A fit to measured materials: dark towards grazing
/// where smooth, bright backwards where rough. It gains energy there: for `r = 1`, `ρ = 1` the albedo exceeds 1.
///
/// Reciprocal to the last bit. Domain: `ρ`, `r` in `[0, 1]`. Error against `f64` of the same inputs: 4e-6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurleyDiffuse<R = f32> {
    albedo: Rgb<R>,
    roughness: PerceptualRoughness<R>,
}

carry!([] BurleyDiffuse<f32> => BurleyDiffuse<S> { albedo, roughness });

impl<R: Real> BurleyDiffuse<R> {
    /// The lobe of base colour `ρ` and roughness `r`.
    #[inline(always)]
    pub fn new(albedo: Rgb<R>, roughness: PerceptualRoughness<R>) -> Self {
        Self { albedo, roughness }
    }

    /// The base colour `ρ`.
    #[inline(always)]
    pub fn albedo(&self) -> Rgb<R> {
        self.albedo
    }

    /// The roughness `r`.
    #[inline(always)]
    pub fn roughness(&self) -> PerceptualRoughness<R> {
        self.roughness
    }

    /// The same lobe in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> BurleyDiffuse<S> {
        BurleyDiffuse::new(self.albedo.map(&f), self.roughness.map(&f))
    }
}

impl<R: Real> Brdf<R> for BurleyDiffuse<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        // 2 r cos² θ_d − 1/2, with cos² θ_d = |l + v|²/4.
        let change = (self.roughness.0 * (l + v).length_squared()).times(0.5).plus(-0.5);
        let side = |cos: R| {
            let x = cos.lift(1.0) - cos;
            (change * fifth_power(x)).plus(1.0)
        };
        let value = (side(l.z) * side(v.z)).times(core::f64::consts::FRAC_1_PI);
        self.albedo * above_horizon(l, v, value)
    }
}
