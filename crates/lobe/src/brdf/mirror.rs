//! The perfect mirror: a delta, so a direction and a weight, never a large number.

use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;

/// A perfect mirror: `f_r(l, v) = ks δ(l − r)/(n·l)`, with `r` the mirror direction of `v`.
///
/// It has no value that could be evaluated, so it is no [`Brdf`](crate::Brdf): it answers where the light comes from
/// and what part of it is reflected. `ks ∈ [0, 1]` per channel.
///
/// ```
/// use lobe::{Mirror, Rgb, Vec3};
/// let silver = Mirror::new(Rgb::splat(0.97_f32));
/// let seen = silver.reflect(Vec3::new(0.6, 0.0, 0.8));
/// assert_eq!(seen.l, Vec3::new(-0.6, 0.0, 0.8));
/// assert_eq!(seen.weight.r, 0.97);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror<R = f32> {
    ks: Rgb<R>,
}

carry!([] Mirror<f32> => Mirror<S> { ks });

/// One direction that carries all of the light: `L_o = weight · L(l)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delta<R = f32> {
    /// Where the light comes from, in the local frame.
    pub l: Vec3<R>,
    /// The part of the radiance that is reflected; without unit. The cosine and its reciprocal have cancelled.
    pub weight: Rgb<R>,
}

impl<R: Real> Mirror<R> {
    /// A mirror that reflects the fraction `ks`.
    #[inline(always)]
    pub fn new(ks: Rgb<R>) -> Self {
        Self { ks }
    }

    /// The reflectance `ks`.
    #[inline(always)]
    pub fn ks(&self) -> Rgb<R> {
        self.ks
    }

    /// The same mirror in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Mirror<S> {
        Mirror::new(self.ks.map(f))
    }

    /// What a viewer in the direction `v` (local frame) sees: exactly `(−v.x, −v.y, v.z)`, weight `ks`; weight 0 from
    /// below the horizon (`v.z ≤ 0`). NaN in `v.z` gives a NaN weight.
    #[inline(always)]
    pub fn reflect(&self, v: Vec3<R>) -> Delta<R> {
        let zero = v.z.lift(0.0);
        let weight = self.ks + Rgb::splat(v.z * zero);
        Delta { l: Vec3::new(-v.x, -v.y, v.z), weight: Rgb::select(v.z.le(zero), Rgb::splat(zero), weight) }
    }
}
