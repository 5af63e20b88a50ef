//! Lights: what arrives at a point, and from where.

use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;

/// What a light sends to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incident<R = f32> {
    /// The unit vector from the point to the light.
    pub l: Vec3<R>,
    /// The irradiance `E` on a surface that faces the light, in W·m⁻² per channel. The cosine is the surface's:
    /// radiance out is `eval_cos(l, v) · E`.
    pub irradiance: Rgb<R>,
    /// The distance to the light; infinite for a directional one.
    pub distance: R,
}

/// A point light: `E = I / r²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight<R = f32> {
    /// Where it is.
    pub position: Vec3<R>,
    /// The radiant intensity `I`, in W·sr⁻¹ per channel.
    pub intensity: Rgb<R>,
}

impl<R: Real> PointLight<R> {
    /// A light at `position` with the radiant intensity `intensity`.
    #[inline(always)]
    pub const fn new(position: Vec3<R>, intensity: Rgb<R>) -> Self {
        Self { position, intensity }
    }

    /// What arrives at `point`: `E = I / r²` from the direction of the light.
    ///
    /// At distance 0 there is no direction and no finite irradiance. A light sends nothing to the point that it
    /// stands on: `E = 0`, `l = (0, 0, 1)`, distance 0. So a light that touches a surface leaves one black point, not
    /// a NaN that spreads. Arbitrarily close, `E` grows as `1/r²` says; in `f32` it overflows to infinity where it
    /// must, below `r = 1e-19 √I`.
    #[inline(always)]
    pub fn at(&self, point: Vec3<R>) -> Incident<R> {
        let to_light = self.position - point;
        let distance = to_light.length();
        let (zero, one) = (distance.lift(0.0), distance.lift(1.0));
        let touching = distance.eq(zero);
        // Divided twice: r² would leave the range of `f32` for r = 1e-30, where I/r² is still to be told from I/r.
        let irradiance = self.intensity / distance / distance;
        Incident {
            l: to_light.normalize_or(Vec3::new(zero, zero, one)),
            irradiance: Rgb::select(touching, Rgb::splat(zero), irradiance),
            distance,
        }
    }
}

/// A light so far away that direction and irradiance are the same everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight<R = f32> {
    /// The unit vector *to* the light.
    pub to_light: Vec3<R>,
    /// The irradiance on a surface that faces it, in W·m⁻² per channel.
    pub irradiance: Rgb<R>,
}

impl<R: Real> DirectionalLight<R> {
    /// A light in the direction `to_light` (unit length) with the given irradiance.
    #[inline(always)]
    pub const fn new(to_light: Vec3<R>, irradiance: Rgb<R>) -> Self {
        Self { to_light, irradiance }
    }

    /// What arrives anywhere.
    #[inline(always)]
    pub fn incident(&self) -> Incident<R> {
        let distance = self.to_light.z.lift(f64::INFINITY);
        Incident { l: self.to_light, irradiance: self.irradiance, distance }
    }
}

/// Light that comes from everywhere alike, with a constant radiance.
///
/// The lecture's ambient term multiplies it with a coefficient of its own and no lobe:
/// see [`illumination`](crate::illumination).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmbientLight<R = f32> {
    /// The radiance, in W·m⁻²·sr⁻¹ per channel.
    pub radiance: Rgb<R>,
}

impl<R: Real> AmbientLight<R> {
    /// Ambient light of the given radiance.
    #[inline(always)]
    pub const fn new(radiance: Rgb<R>) -> Self {
        Self { radiance }
    }
}
