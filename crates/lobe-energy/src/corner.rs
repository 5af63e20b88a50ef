//! Coordinates in which the albedo of a microfacet lobe has no corner.

use lobe::Real;

/// Where a view of the cosine `μ` is, seen from the corner `μ = α = 0`.
///
/// There the loss `1 − E(μ, α)` of a microfacet lobe depends on the way it is gone to: along `μ = c α` it tends to a number
/// that depends on `c`, 0.11 at worst for GGX. A table by `μ` and `α` makes an error as large, however fine it is. By
/// `x = √(μ (μ (1 + 2α) + α²))/(μ + α)`, from 0 at the horizon to 1 along the normal, it is smooth.
///
/// Of a view far from the corner the loss is a small number, `α² (1 + μ⁻²)/2` for GGX with a small `α`. So that it keeps its
/// digits it is tabulated in units of `w = α² + α (1 − x) + (1 − x)²/2`, which tends to the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner<R> {
    /// `x`, from 0 to 1.
    pub x: R,
    /// `w`.
    pub scale: R,
}

impl<R: Real> Corner<R> {
    /// The place of a width and a cosine, both from 0 to 1 and not both 0.
    #[inline(always)]
    pub fn new(alpha: R, mu: R) -> Self {
        let one = alpha.lift(1.0);
        let inverse = (mu + alpha).recip();
        // Of the smallest cosines the product with α² is below the smallest normal number: a power of two keeps its
        // digits.
        let square = mu.times(R::ROOT_SCALE * R::ROOT_SCALE) * (mu * alpha.times(2.0).plus(1.0) + alpha.squared());
        let x = (square.sqrt().times(1.0 / R::ROOT_SCALE) * inverse).min(one);
        // 1 − x = (1 − x²)/(1 + x), without the difference: 1 − x² = α (1 − μ) (2μ + α)/(μ + α)².
        let rest = (alpha * inverse) * (one - mu) * ((mu + mu + alpha) * inverse) / x.plus(1.0);
        Self { x, scale: alpha * (alpha + rest) + rest.squared().times(0.5) }
    }
}

impl Corner<f64> {
    /// The cosine `μ` of a width and `x`.
    #[must_use]
    pub fn cosine(alpha: f64, x: f64) -> f64 {
        // (1 + 2α − x²) μ² + (α² − 2αx²) μ = α² x².
        let (x2, a2) = (x * x, alpha * alpha);
        let (a, b, c) = (1.0 + 2.0 * alpha - x2, a2 - 2.0 * alpha * x2, a2 * x2);
        let root = libm::sqrt(b * b + 4.0 * a * c);
        // Two forms of the root, each without a difference.
        let mu = if b > 0.0 { 2.0 * c / (b + root) } else { (root - b) / (2.0 * a) };
        Real::min(mu, 1.0)
    }
}
