//! `D`: how the normals of the microfacets are distributed, one file a distribution.
//!
//! `D(h)` in sr⁻¹ is the area of the facets with normal `h` per area of the surface and solid angle, so that
//! `∫ D(h) (n·h) dω = 1` over the hemisphere. `h` is a unit vector of the local frame.
//!
//! Every function here takes vectors, never cosines: with `α = 0.01` a GGX from `1 − (n·h)²` in `f32` is wrong by tens
//! of percent, from the components of `h` by 5e-7.

mod beckmann;
mod gaussian;
mod ggx;
mod gtr;
mod phong_power;
mod quadrature;
mod smith_table;
mod student_t;
mod tabulated;

pub use beckmann::Beckmann;
pub use gaussian::Gaussian;
pub use ggx::{Ggx, GgxAnisotropic};
pub use gtr::Gtr;
pub use phong_power::PhongPower;
pub use smith_table::SmithTable;
pub use student_t::StudentT;
pub use tabulated::Tabulated;

use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;

/// A distribution of microfacet normals.
pub trait Distribution<R: Real> {
    /// `D(h)` in sr⁻¹ for a unit vector `h` with `h.z ≥ 0`.
    fn d(&self, h: Vec3<R>) -> R;

    /// `D` in the direction of `s`, a vector of any length from `2⁻⁶³` to `2⁶³` in `f32` whose square is `length2`.
    ///
    /// A distribution that needs no unit vector overrides this, and saves a root and a division.
    #[inline(always)]
    fn d_along(&self, s: Vec3<R>, length2: R) -> R {
        self.d(s * length2.rsqrt())
    }

    /// Into how many pieces of equal angle, from the normal to the horizon, an isotropic density falls that is smooth
    /// only between its corners: a quadrature that does not stop there is off by a fifth. 0 where it is smooth.
    #[inline(always)]
    fn pieces(&self) -> usize {
        0
    }
}

/// A distribution whose Smith function `Λ` is known.
///
/// `Λ(w)` is what Smith's masking `G₁(w) = 1/(1 + Λ(w))` needs; without shadowing `(1 + Λ(w)) cos θ_w` is the area of
/// the microfacets that face `w`, projected (Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based
/// BRDFs", JCGT 3(2), 2014, equations 12 to 17).
pub trait SmithLambda<R: Real>: Distribution<R> {
    /// `Λ(w) cos θ_w`, for a unit vector `w` with `w.z ≥ 0`: finite to the horizon, where `Λ` itself is not.
    fn lambda_cos(&self, w: Vec3<R>) -> R;

    /// `(1 + Λ(w)) cos θ_w`: the area of the facets that face `w`, projected.
    #[inline(always)]
    fn facing(&self, w: Vec3<R>) -> R {
        w.z + self.lambda_cos(w)
    }

    /// `(1 + 2 Λ(w)) cos θ_w`: the area of all facets, those that face away too.
    #[inline(always)]
    fn facing_either_way(&self, w: Vec3<R>) -> R {
        w.z + self.lambda_cos(w).times(2.0)
    }

    /// `G₁(w) = 1/(1 + Λ(w))`, at most 1 to the last bit.
    #[inline(always)]
    fn g1(&self, w: Vec3<R>) -> R {
        w.z / (w.z + self.lambda_cos(w))
    }
}

/// The two widths of a distribution that may be anisotropic, along the tangent x and the bitangent y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Widths<R> {
    pub(crate) x: crate::Alpha<R>,
    pub(crate) y: crate::Alpha<R>,
    /// `1/αx`, `1/αy`.
    pub(crate) inverse: (R, R),
    /// `1/(π αx αy)`: the value of GGX and Beckmann at the peak.
    pub(crate) peak: R,
}

carry!([] Widths<f32> => Widths<S> { x, y, inverse, peak });

impl<R: Real> Widths<R> {
    #[inline(always)]
    pub(crate) fn new(x: crate::Alpha<R>, y: crate::Alpha<R>) -> Self {
        let inverse = (x.recip(), y.recip());
        // 1/π before the second quotient: without it binary16 ends at α = 4e-3, not at 2.2e-3.
        Self { x, y, inverse, peak: inverse.0.times(core::f64::consts::FRAC_1_PI) * inverse.1 }
    }

    /// `(w.x/αx)² + (w.y/αy)²`.
    #[inline(always)]
    pub(crate) fn stretched(&self, w: Vec3<R>) -> R {
        sum_of_squares(w.x * self.inverse.0, w.y * self.inverse.1)
    }

    /// `(αx w.x)² + (αy w.y)²`.
    #[inline(always)]
    pub(crate) fn shrunk(&self, w: Vec3<R>) -> R {
        sum_of_squares(w.x * self.x.0, w.y * self.y.0)
    }
}

/// `x² + y²`.
#[inline(always)]
pub(crate) fn sum_of_squares<R: Real>(x: R, y: R) -> R {
    y.mul_add(y, x.squared())
}
