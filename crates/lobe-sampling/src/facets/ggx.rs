//! GGX by visible normals: the distribution of the normals of an ellipsoid is that of a sphere, stretched (Heitz 2018).

use super::Facets;
use crate::map::{azimuth, concentric_disc};
use lobe::distribution::{Ggx, GgxAnisotropic, SmithLambda};
use lobe::{Facet, Real, Vec3};

/// A distribution whose facets are those of a stretched sphere: GGX.
pub trait StretchedSphere<R: Real>: SmithLambda<R> {
    /// `αx`, `αy`.
    fn widths(&self) -> (R, R);
}

impl<R: Real> StretchedSphere<R> for Ggx<R> {
    #[inline(always)]
    fn widths(&self) -> (R, R) {
        (self.alpha().0, self.alpha().0)
    }
}

impl<R: Real> StretchedSphere<R> for GgxAnisotropic<R> {
    #[inline(always)]
    fn widths(&self) -> (R, R) {
        let (x, y) = self.alpha();
        (x.0, y.0)
    }
}

/// GGX by visible normals, by the sphere's projection onto a disc.
///
/// Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018. Density of the light `D G₁(v)/(4 n·v)`,
/// which is `D/(4 (1 + Λ(v)) cos θ_v)`, finite to the horizon.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProjectedDisc;

/// GGX by visible normals, by a cap of the sphere of mirrored directions.
///
/// Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023. The density is that of
/// [`ProjectedDisc`], for fewer operations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Caps;

/// GGX by visible normals without most of those that reflect below the horizon.
///
/// Eto and Tokuyoshi, "Bounded VNDF Sampling for Smith-GGX Reflections", SIGGRAPH Asia 2023 Technical Communications:
/// the cap of [`Caps`] ends at a lower bound of the horizon, `z ≥ −k z_v` with `k = (1 − a²) s²/(s² + a² (n·v)²)`, `a`
/// the smaller width and `s = 1 + |(v.x, v.y)|`, their equations 5 and 6. Density of the light `D/(2 (k n·v + t))`,
/// `t = √((αx v.x)² + (αy v.y)² + v.z²)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounded;

/// A point of the sphere in the space of the ellipsoid, or the other way.
#[inline(always)]
fn stretched<R: Real>(distribution: &impl StretchedSphere<R>, m: Vec3<R>) -> Vec3<R> {
    let (x, y) = distribution.widths();
    Vec3::new(m.x * x, m.y * y, m.z)
}

/// The facets of a stretched sphere are known by their normals of any length: to mirror at one takes no root.
macro_rules! facets_of_any_length {
    () => {
        #[inline(always)]
        fn normal(&self, distribution: &D, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
            self.facet(distribution, v, u).normalize()
        }

        /// `2 (m·v)/(m·m) m − v`.
        #[inline(always)]
        fn light(&self, distribution: &D, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
            let m = self.facet(distribution, v, u);
            m * (m.dot(v).times(2.0) / m.length_squared()) - v
        }
    };
}

impl ProjectedDisc {
    /// The normal of a facet, times [`Real::ROOT_SCALE`] and about as long.
    #[inline(always)]
    fn facet<R: Real>(self, distribution: &impl StretchedSphere<R>, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
        let w = stretched(distribution, v).normalize();
        let (zero, one) = (w.z.lift(0.0), w.z.lift(1.0));
        let across = w.x.squared() + w.y.squared();
        // Seen along the normal every axis is as good as any other; 0/0 would be NaN.
        let upright = across.le(across.lift(R::MIN_POSITIVE));
        let scale = R::select(upright, one, across).rsqrt();
        let first = Vec3::select(upright, Vec3::new(one, zero, zero), Vec3::new(-w.y * scale, w.x * scale, zero));
        let second = w.cross(first);
        let [x, y] = concentric_disc(u);
        // The half of the disc that the surface hides is moved into the half that is seen.
        let chord2 = (one - x) * (one + x);
        // Rounding may take the ends of both roots below 0 (test `the_ends_of_the_square_are_finite`).
        let seen = w.z.plus(1.0).times(0.5);
        let y = (one - seen) * chord2.max(zero).sqrt() + seen * y;
        let rest = (chord2 - y.squared()).max(zero).sqrt();
        let m = first * x + second * y + w * rest;
        stretched(distribution, Vec3::new(m.x, m.y, m.z.max(zero)) * one.times(R::ROOT_SCALE))
    }
}

impl<R: Real, D: StretchedSphere<R>> Facets<R, D> for ProjectedDisc {
    facets_of_any_length!();

    #[inline(always)]
    fn area(&self, distribution: &D, v: Vec3<R>, _: &Facet<R>) -> R {
        distribution.facing(v).times(4.0)
    }
}

/// The normal of the facet of the cap `z ≥ −bound` that mirrors to `v`, with `above = v.z − bound`.
///
/// In the space of the sphere `v` has the length `t`, and the cap is taken of a sphere of that radius: so nothing is divided by `t`.
/// `z = (1 − y)(t + bound) − bound`; `t² − z² = d (2 t − d)` with `d = t − z = y (t + bound)`. The sum with `v` has
/// `z + v.z = (1 − y)(t + bound) + above`: positive terms, so that facets near the horizon keep their digits. All times
/// [`Real::ROOT_SCALE`]: for widths and cosines of 1e-15 the squares of these lengths would leave the range of `f32` (test
/// `the_narrowest_facets_keep_their_digits`).
#[inline(always)]
fn of_cap<R: Real>(distribution: &impl StretchedSphere<R>, v: Vec3<R>, bound: R, above: R, [x, y]: [R; 2]) -> Vec3<R> {
    let (one, scale) = (v.z.lift(1.0), v.z.lift(R::ROOT_SCALE));
    let t = distribution.facing_either_way(v) * scale;
    let (sin, cos) = azimuth(x);
    let height = bound.mul_add(scale, t);
    let depth = y * height;
    // Rounding may take it below 0 where the cap is the whole sphere.
    let radius = (depth * (t.times(2.0) - depth)).max(v.z.lift(0.0)).sqrt();
    let z = (one - y).mul_add(height, above * scale);
    let w = stretched(distribution, v * scale);
    stretched(distribution, Vec3::new(radius.mul_add(cos, w.x), radius.mul_add(sin, w.y), z))
}

impl Caps {
    #[inline(always)]
    fn facet<R: Real>(self, distribution: &impl StretchedSphere<R>, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
        of_cap(distribution, v, v.z, v.z.lift(0.0), u)
    }
}

impl<R: Real, D: StretchedSphere<R>> Facets<R, D> for Caps {
    facets_of_any_length!();

    #[inline(always)]
    fn area(&self, distribution: &D, v: Vec3<R>, _: &Facet<R>) -> R {
        distribution.facing(v).times(4.0)
    }
}

/// `k`, and `1 − k = a² (s² + (n·v)²)/(s² + a² (n·v)²)`, each of positive terms.
#[inline(always)]
fn bound<R: Real>(distribution: &impl StretchedSphere<R>, v: Vec3<R>) -> (R, R) {
    let (x, y) = distribution.widths();
    let one = v.z.lift(1.0);
    // Their equation 6: beyond 1 the bound does not hold.
    let a = x.min(y).min(one);
    let s = (v.x.squared() + v.y.squared()).sqrt().plus(1.0);
    let (a2, s2, z2) = (a.squared(), s.squared(), v.z.squared());
    let scale = (s2 + a2 * z2).recip();
    ((one - a) * (one + a) * s2 * scale, a2 * (s2 + z2) * scale)
}

impl Bounded {
    #[inline(always)]
    fn facet<R: Real>(self, distribution: &impl StretchedSphere<R>, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
        let (k, rest) = bound(distribution, v);
        of_cap(distribution, v, k * v.z, rest * v.z, u)
    }
}

impl<R: Real, D: StretchedSphere<R>> Facets<R, D> for Bounded {
    facets_of_any_length!();

    #[inline(always)]
    fn area(&self, distribution: &D, v: Vec3<R>, _: &Facet<R>) -> R {
        let (k, _) = bound(distribution, v);
        (k * v.z + distribution.facing_either_way(v)).times(2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe::Alpha;

    #[test]
    fn the_narrowest_facets_keep_their_digits() {
        let (alpha, v) = (1e-15_f32, Vec3::new(1.0_f32, 0.0, 1e-15));
        for u in [[0.3_f32, 0.5], [0.3, 0.999], [0.3, 1.0 - f32::EPSILON / 2.0], [0.8, 1.0 - f32::EPSILON / 2.0]] {
            for method in [true, false] {
                let (single, double) = (Ggx::new(Alpha(alpha)), Ggx::new(Alpha(f64::from(alpha))));
                let (v64, u64) = (v.map(f64::from), u.map(f64::from));
                let (found, exact) = if method {
                    (Bounded.light(&single, v, u), Bounded.light(&double, v64, u64))
                } else {
                    (Caps.light(&single, v, u), Caps.light(&double, v64, u64))
                };
                assert!((f64::from(found.z) / exact.z - 1.0).abs() < 1e-5, "{u:?}: {found:?} {exact:?}");
            }
        }
    }
}
