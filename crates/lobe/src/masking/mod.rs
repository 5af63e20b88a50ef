//! `G`: which part of the microfacets is both seen and lit, one file a model.
//!
//! What a BRDF needs is the *visibility* `V = G/(4 (n·l)(n·v))`, which has no cosine in its denominator that the
//! numerator does not tame.

mod hammon;
mod implicit;
mod kelemen;
mod neumann;
mod rational_beckmann;
mod schlick_ggx;
mod smith;
mod v_cavity;

pub use hammon::Hammon;
pub use implicit::Implicit;
pub use kelemen::Kelemen;
pub use neumann::Neumann;
pub use rational_beckmann::RationalBeckmann;
pub use schlick_ggx::SchlickGgx;
pub use smith::{SmithCorrelated, SmithSeparable};
pub use v_cavity::VCavity;

use crate::number::{Quotient, Real};
use crate::vector::Vec3;

/// A masking and shadowing function for facets of the distribution `D`.
pub trait Masking<R: Real, D> {
    /// `weight · G(l, v)/(4 (n·l)(n·v))`, for unit vectors above the horizon, `h` between them and `cos_d = l·h = v·h`.
    ///
    /// A quotient, because a BRDF has other divisions to share with it; its denominator is between 1e-30 and 2⁶⁵.
    ///
    /// The weight is 1 or `n·l`. It is a factor of the numerator before the division, so that with `n·l` the result
    /// stays finite to the last float of a cosine.
    ///
    /// Cosines are scaled by [`Real::SCALE`] before they are multiplied with each other or with a small width: at the
    /// smallest normal cosine the product would be subnormal and lose its digits (test
    /// `eval_cos_keeps_its_digits_at_the_horizon`).
    fn quotient(&self, distribution: &D, l: Vec3<R>, v: Vec3<R>, h: Vec3<R>, cos_d: R, weight: R) -> Quotient<R>;

    /// The value of that quotient.
    #[inline(always)]
    fn visibility(&self, distribution: &D, l: Vec3<R>, v: Vec3<R>, h: Vec3<R>, cos_d: R, weight: R) -> R {
        self.quotient(distribution, l, v, h, cos_d, weight).value()
    }
}

/// 2¹⁰⁰, where a visibility ends that has no limit of its own. `D` is at most `1/(π α²) < 2²⁵`, so `D V` stays in the
/// range of `f32`; without this end it is infinite between opposite directions at the horizon, and of a channel that
/// reflects nothing `0 · ∞` makes NaN (test `finite_to_the_last_float` of the catalogue).
pub const MAX_VISIBILITY: f64 = (1u128 << 100) as f64;
