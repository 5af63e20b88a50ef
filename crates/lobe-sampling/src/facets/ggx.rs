//! GGX by visible normals: the distribution of the normals of an ellipsoid is that of a sphere, stretched (Heitz 2018).

use super::Facets;
use crate::map::concentric_disc;
use core::f64::consts::TAU;
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

/// The direction in which the stretched sphere is seen.
#[inline(always)]
fn stretched<R: Real>(distribution: &impl StretchedSphere<R>, v: Vec3<R>) -> Vec3<R> {
    let (x, y) = distribution.widths();
    Vec3::new(v.x * x, v.y * y, v.z).normalize()
}

/// The facet of a normal of the sphere, of any length.
#[inline(always)]
fn facet<R: Real>(distribution: &impl StretchedSphere<R>, m: Vec3<R>) -> Vec3<R> {
    let (x, y) = distribution.widths();
    Vec3::new(m.x * x, m.y * y, m.z).normalize()
}

impl<R: Real, D: StretchedSphere<R>> Facets<R, D> for ProjectedDisc {
    #[inline(always)]
    fn normal(&self, distribution: &D, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
        let w = stretched(distribution, v);
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
        facet(distribution, Vec3::new(m.x, m.y, m.z.max(zero)))
    }

    #[inline(always)]
    fn area(&self, distribution: &D, v: Vec3<R>, _: &Facet<R>) -> R {
        distribution.facing(v).times(4.0)
    }
}

/// The facet of the cap `z ≥ −bound` that mirrors to `w`, with `above = z_w − bound`.
///
/// `z = (1 − y)(1 + bound) − bound`; `1 − z² = t (2 − t)` with `t = 1 − z = y (1 + bound)`. The sum with `w` has
/// `z + z_w = (1 − y)(1 + bound) + above`: positive terms, so that facets near the horizon keep their digits.
#[inline(always)]
fn of_cap<R: Real>(distribution: &impl StretchedSphere<R>, w: Vec3<R>, bound: R, above: R, [x, y]: [R; 2]) -> Vec3<R> {
    let one = w.z.lift(1.0);
    let (sin, cos) = x.times(TAU).sin_cos();
    let depth = y * bound.plus(1.0);
    // Rounding may take it below 0 where the cap is the whole sphere.
    let radius = (depth * (depth.lift(2.0) - depth)).max(w.z.lift(0.0)).sqrt();
    let z = (one - y) * bound.plus(1.0) + above;
    facet(distribution, Vec3::new(w.x + radius * cos, w.y + radius * sin, z))
}

impl<R: Real, D: StretchedSphere<R>> Facets<R, D> for Caps {
    #[inline(always)]
    fn normal(&self, distribution: &D, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
        let w = stretched(distribution, v);
        of_cap(distribution, w, w.z, w.z.lift(0.0), u)
    }

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

impl<R: Real, D: StretchedSphere<R>> Facets<R, D> for Bounded {
    #[inline(always)]
    fn normal(&self, distribution: &D, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
        let w = stretched(distribution, v);
        let (k, rest) = bound(distribution, v);
        of_cap(distribution, w, k * w.z, rest * w.z, u)
    }

    #[inline(always)]
    fn area(&self, distribution: &D, v: Vec3<R>, _: &Facet<R>) -> R {
        let (k, _) = bound(distribution, v);
        (k * v.z + distribution.facing_either_way(v)).times(2.0)
    }
}
