//! GTR: `D = k (h.x²/αx² + h.y²/αy² + h.z²)^−γ`.

use super::{Distribution, Widths, quadrature};
use crate::Alpha;
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;

/// Generalised Trowbridge-Reitz: `D = k (h.x²/αx² + h.y²/αy² + h.z²)^−γ`, with any `γ`.
///
/// Burley, "Physically Based Shading at Disney", 2012, appendix B, where `γ = 2` is [`Ggx`](super::Ggx) and `γ = 1`, of
/// Berry 1923, is the clearcoat. The isotropic factor, with `A = α²`:
///
/// ```text
/// k = (γ − 1)(1 − A)/(π A (1 − A^(γ − 1)))        and its limit for γ → 1, (1 − A)/(−π A ln A)
/// ```
///
/// Both limits, that and `α → 1`, are taken without a quotient of two zeros. With two widths the paper has a factor for
/// `γ = 2` only; for any other the constructor integrates `1/k` over the azimuth, to 1e-7 for aspect ratios up to 16.
///
/// There is no closed form of Smith's `Λ` but for `γ = 2`. Use [`SmithTable`](super::SmithTable). Domain:
/// `α ∈ [1e-4, 1]`, `γ ∈ [0.5, 5]`. Error against `f64`: within `u (25 + 12 γ)`, `u = 2⁻²⁴`, with two
/// widths within 5e-6; below 2⁻¹²⁶ of the peak it is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gtr<R = f32> {
    widths: Widths<R>,
    gamma: R,
    /// `k`.
    peak: R,
}

carry!([] Gtr<f32> => Gtr<S> { widths, gamma, peak });

impl<R: Real> Gtr<R> {
    /// The isotropic distribution.
    #[inline(always)]
    pub fn new(alpha: Alpha<R>, gamma: R) -> Self {
        let widths = Widths::new(alpha, alpha);
        Self { widths, gamma, peak: widths.peak / one_over_k(alpha.0.squared(), gamma) }
    }

    /// The distribution with one width along the tangent and one along the bitangent.
    #[inline]
    pub fn anisotropic(x: Alpha<R>, y: Alpha<R>, gamma: R) -> Self {
        let widths = Widths::new(x, y);
        let mean = quadrature::mean_over_azimuth(
            &widths,
            #[inline(always)]
            |a2| one_over_k(a2, gamma),
        );
        Self { widths, gamma, peak: widths.peak / mean }
    }

    /// `αx` and `αy`.
    #[inline(always)]
    pub fn alpha(&self) -> (Alpha<R>, Alpha<R>) {
        (self.widths.x, self.widths.y)
    }

    /// The exponent `γ`.
    #[inline(always)]
    pub fn gamma(&self) -> R {
        self.gamma
    }

    /// `k`, the value at the normal.
    #[inline(always)]
    pub fn peak(&self) -> R {
        self.peak
    }

    /// The same distribution in another number type, its factor computed anew there.
    #[inline]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Gtr<S> {
        Gtr::anisotropic(self.widths.x.map(&f), self.widths.y.map(&f), f(self.gamma))
    }
}

/// `1/(π A k) = −ln A/(1 − A) · φ((γ − 1) ln A)`, `φ(x) = (eˣ − 1)/x`.
#[inline(always)]
fn one_over_k<R: Real>(a2: R, gamma: R) -> R {
    let (zero, one) = (a2.lift(0.0), a2.lift(1.0));
    let rest = one - a2;
    // 1 − A is exact from 1/2 on; below, A itself is what the logarithm needs.
    let log2 = R::select(rest.lt(a2.lift(0.5)), (-rest).log2_1p(), a2.log2());
    let log_over_rest = R::select(rest.eq(zero), one, log2.times(-core::f64::consts::LN_2) / rest);
    // φ(x) = (u − 1)/ln u with u = eˣ: what the exponential rounds off is in both, and cancels (Kahan).
    let u = (gamma.plus(-1.0) * log2).exp2();
    let phi = R::select(u.eq(one), one, (u - one) / u.ln());
    log_over_rest * phi
}

impl<R: Real> Distribution<R> for Gtr<R> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        self.peak * (self.widths.stretched(h) + h.z.squared()).pow(-self.gamma)
    }
}
