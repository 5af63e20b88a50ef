//! Lambert: `f_r = ρ/π`.

use super::{Brdf, above_horizon};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::FRAC_1_PI;

/// A perfectly diffuse surface: `f_r = ρ/π` sr⁻¹ (Lambert, *Photometria*, 1760).
///
/// Reflects the fraction `ρ` of what arrives, evenly in all directions. Domain: `ρ ∈ [0, 1]` per channel; the
/// result is linear in `ρ` beyond. Relative error at most 2·2⁻²⁴ in `f32`.
///
/// ```
/// use lobe::{Brdf, Lambert, Rgb, Vec3};
/// let paper = Lambert::new(Rgb::splat(0.8_f32));
/// let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.0, 1.0));
/// assert_eq!(paper.eval(l, v).g, 0.8 / core::f32::consts::PI);
/// assert_eq!(paper.eval(l, -v).g, 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert<R = f32> {
    albedo: Rgb<R>,
}

carry!([] Lambert<f32> => Lambert<S> { albedo });

impl<R: Real> Lambert<R> {
    /// A diffuse lobe of the given albedo `ρ`.
    #[inline(always)]
    pub fn new(albedo: Rgb<R>) -> Self {
        Self { albedo }
    }

    /// The albedo `ρ`.
    #[inline(always)]
    pub fn albedo(&self) -> Rgb<R> {
        self.albedo
    }

    /// The same lobe in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Lambert<S> {
        Lambert::new(self.albedo.map(f))
    }
}

impl<R: Real> Brdf<R> for Lambert<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.albedo * above_horizon(l, v, l.z.lift(FRAC_1_PI))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.albedo * above_horizon(l, v, l.z.times(FRAC_1_PI))
    }
}
