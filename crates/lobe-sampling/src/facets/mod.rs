//! How the facet is drawn that mirrors the light to the viewer: methods as types, chosen where a program is written.
//!
//! | method | for | facets in proportion to | density of the light |
//! |---|---|---|---|
//! | [`Bounded`] | GGX; the default | `D max(0, v·h)`, of those that reflect upwards about | `D/(2 (k n·v + t))` |
//! | [`Caps`], [`ProjectedDisc`] | GGX | `D max(0, v·h)` | `D G₁(v)/(4 n·v)` |
//! | [`VisibleSlopes`] | Beckmann; the default | `D max(0, v·h)` | `D G₁(v)/(4 n·v)` |
//! | [`ByDistribution`] | every distribution; the default elsewhere | `D (n·h)` | `D (n·h)/(4 l·h)` |
//!
//! A density is `D(h)` over something that is smooth and of moderate size, the [`area`](Facets::area). So the weight of
//! a sample is `F · (n·l) G/(4 (n·l)(n·v)) · area`: `D`, which may be 1e30, is in neither numerator nor denominator.

mod by_distribution;
mod ggx;
mod slopes;

pub use by_distribution::{ByDistribution, SampleNormals};
pub use ggx::{Bounded, Caps, ProjectedDisc, StretchedSphere};
pub use slopes::VisibleSlopes;

use lobe::{Facet, Real, Vec3};

/// A way to draw a facet of the distribution `D`.
///
/// The density of the light that the facet mirrors to `v` is `D(h)/area`, for all light above the horizon: an
/// implementation must not give 0 where the lobe is not.
pub trait Facets<R: Real, D> {
    /// The unit normal of a facet for a viewer above the horizon, `v.z ≥ 0`, from two numbers of `[0, 1)`.
    fn normal(&self, distribution: &D, v: Vec3<R>, u: [R; 2]) -> Vec3<R>;

    /// The light that such a facet mirrors to `v`: `2 (h·v) h − v`.
    #[inline(always)]
    fn light(&self, distribution: &D, v: Vec3<R>, u: [R; 2]) -> Vec3<R> {
        let h = self.normal(distribution, v, u);
        h * h.dot(v).times(2.0) - v
    }

    /// `D(h)/pdf(l)`, for the facet between `l` and `v`.
    ///
    /// It may be 0 where `D` is, and is infinite or not a number below the horizon.
    fn area(&self, distribution: &D, v: Vec3<R>, facet: &Facet<R>) -> R;

    /// The density of the light that the facet mirrors, in sr⁻¹, where `D(h)` is `d`.
    #[inline(always)]
    fn pdf(&self, distribution: &D, v: Vec3<R>, facet: &Facet<R>, d: R) -> R {
        d / self.area(distribution, v, facet)
    }
}
