//! Tangent frames, and normals interpolated over a triangle.

use crate::number::Real;
use crate::vector::Vec3;

/// Three orthonormal directions around a surface point. In the frame's own coordinates `n` is `+z`, so a cosine with
/// the normal is a z component; lobes are evaluated there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<R = f32> {
    /// The tangent: local `+x`.
    pub tangent: Vec3<R>,
    /// The bitangent, `n × tangent`: local `+y`.
    pub bitangent: Vec3<R>,
    /// The normal: local `+z`.
    pub normal: Vec3<R>,
}

impl<R: Real> Frame<R> {
    /// A frame around the unit vector `normal`, with a tangent of no particular direction.
    ///
    /// Without a branch or a normalisation, and continuous except across `z = 0`: Duff, Burgess, Christensen, Hery,
    /// Kensler, Liani, Villemin, "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, listing 3. The dot
    /// products of the result are within 4u of 0 and 1 (u = 2⁻²⁴ in `f32`) if `normal` has unit length.
    #[inline(always)]
    pub fn from_normal(normal: Vec3<R>) -> Self {
        let one = normal.z.lift(1.0);
        let sign = one.copysign(normal.z);
        let a = -(one / (sign + normal.z));
        let b = normal.x * normal.y * a;
        Self {
            tangent: Vec3::new(one + sign * normal.x.squared() * a, sign * b, -(sign * normal.x)),
            bitangent: Vec3::new(b, sign + normal.y.squared() * a, -normal.y),
            normal,
        }
    }

    /// The frame around the unit vector `normal` whose tangent is `tangent` made orthogonal to it (Gram-Schmidt).
    ///
    /// `tangent` may have any length. Where it is zero or along the normal (its orthogonal part is below 2⁻¹⁰ of its
    /// length, so at most half of its digits say where it points) the tangent of
    /// [`from_normal`](Self::from_normal) takes its place.
    #[inline(always)]
    pub fn from_normal_tangent(normal: Vec3<R>, tangent: Vec3<R>) -> Self {
        let fallback = Self::from_normal(normal);
        let unit = tangent.normalize_or(normal);
        let orthogonal = unit - normal * normal.dot(unit);
        // Once more: after one step a tangent near the normal is off by the rounding of that step.
        let orthogonal = orthogonal - normal * normal.dot(orthogonal);
        let length_squared = orthogonal.length_squared();
        let degenerate = length_squared.le(length_squared.lift(1.0 / 1_048_576.0));
        let tangent = Vec3::select(degenerate, fallback.tangent, orthogonal.normalize());
        Self { tangent, bitangent: normal.cross(tangent), normal }
    }

    /// World to local: `(tangent·w, bitangent·w, normal·w)`.
    #[inline(always)]
    pub fn to_local(&self, world: Vec3<R>) -> Vec3<R> {
        Vec3::new(self.tangent.dot(world), self.bitangent.dot(world), self.normal.dot(world))
    }

    /// Local to world: `x tangent + y bitangent + z normal`.
    #[inline(always)]
    pub fn to_world(&self, local: Vec3<R>) -> Vec3<R> {
        self.tangent * local.x + self.bitangent * local.y + self.normal * local.z
    }
}

/// The shading normal inside a triangle: `Σ wᵢ nᵢ`, renormalised (Phong, "Illumination for Computer Generated
/// Pictures", CACM 18(6), 1975).
///
/// `normals` are the unit normals at the corners, `weights` the barycentric coordinates; they need not sum to 1.
///
/// **Corners are exact**: weights `(1, 0, 0)` give the first normal, bit for bit.
/// **Degenerate**: where the weighted normals cancel to zero there is no answer, and the result is `fallback`: pass
/// the triangle's own normal.
#[inline(always)]
pub fn interpolate_normal<R: Real>(normals: [Vec3<R>; 3], weights: [R; 3], fallback: Vec3<R>) -> Vec3<R> {
    let [n0, n1, n2] = normals;
    let [w0, w1, w2] = weights;
    let (zero, one) = (w0.lift(0.0), w0.lift(1.0));
    let sum = n0 * w0 + n1 * w1 + n2 * w2;
    // At a corner the sum is that corner's normal already, and dividing by its rounded length could only move it.
    let corner = (w0.eq(one) & w1.eq(zero) & w2.eq(zero))
        | (w1.eq(one) & w2.eq(zero) & w0.eq(zero))
        | (w2.eq(one) & w0.eq(zero) & w1.eq(zero));
    Vec3::select(corner, sum, sum.normalize_or(fallback))
}
