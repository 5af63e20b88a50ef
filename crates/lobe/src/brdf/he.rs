//! He, Torrance, Sillion, Greenberg: `f_r = ks F S G D/(π (n·l)(n·v))`, diffraction by a rough surface, from the
//! wave equation.

use super::{Brdf, above_horizon};
use crate::carry::carry;
use crate::color::Rgb;
use crate::fresnel::{Dielectric, Fresnel, Incidence};
use crate::number::Real;
use crate::parameter::Ior;
use crate::vector::Vec3;
use core::f64::consts::{LN_2, LOG2_E, PI, SQRT_2};

/// The directional-diffuse lobe of He, Torrance, Sillion and Greenberg: `f_r = ks F S G D/(π (n·l)(n·v))` sr⁻¹.
///
/// "A Comprehensive Physical Model for Light Reflection", SIGGRAPH 1991, equations 24, 25 and 75 to 84, unpolarised, with
/// the exponential in equation 25 that the paper's errata add. With `s = l + v`, lengths in wavelengths:
///
/// - `D = π²τ²/4 Σ gᵐ e⁻ᵍ/(m! m) exp(−A/m)` over `m ≥ 1`, `A = π²τ² (s.x² + s.y²)`, `g = (2πσ s.z)²`;
/// - `σ = σ₀/√(1 + x²)`, the roughness of what is seen, where `x exp(x²/2) = (K(l) + K(v))/√(8π)` and
///   `K = tan θ erfc(w)`, `w = τ cot θ/(2σ₀)`;
/// - `S = S₁(l) S₁(v)`, `S₁ = (1 − erfc(w)/2)/(1 + Λ)`, `Λ = exp(−w²)/(2√π w) − erfc(w)/2`;
/// - `G = (|s|²/s.z)²`: the quotient of the four products in equation 76 is 1, because `s` and `p` there are a basis of the
///   plane across the ray (test `he_agrees_with_the_paper`);
/// - `F` of a dielectric of index `η`, at the half angle.
///
/// `σ₀` is the root mean square height and `τ` the correlation length. For `g ≫ 1` the lobe is that of
/// Torrance and Sparrow with Beckmann's distribution of `α = 2σ/τ`; for `g ≪ 1` it has the width `1/(2πτ)`, and is
/// `g` times as bright: the rest of the light is the coherent reflection `F S e⁻ᵍ`, a delta along the mirror direction,
/// which is not in this lobe. `ks` is a factor for fits; physics has 1.
///
/// In the fits of Ngan et al. 2005 one unit of `σ` and `τ` is one wavelength. Where `g ≪ 1` in them (the specular
/// phenolics) the lobe's width is `λ/(2πτ)`, and the widths fitted with other models to the same materials, 0.0067 to
/// 0.0076, give `λ` = 1.2 to 1.3: with 0.5, a wavelength in micrometres, the lobe would be too narrow by 2.5.
///
/// Reciprocal to the last bit. Domain: `ks ≥ 0`, `η ∈ [1, 15]`, `σ₀ ∈ [0.01, 100]`, `τ ∈ [0.1, 1000]`. It stays finite to
/// the horizon, since `S₁` goes to 0 as the cosine: their quotient is what is computed.
///
/// **The series.** The term `m` counts how often the phase was disturbed; the largest is `m* = g eʸ` with `2y = W(2A/g²)`
/// (Lambert's function), its width `√(m*/(1 + 2y))`. Up to `m* = 20` the first fifty terms are summed. Beyond, the sum is
/// the integral over `m`, to 1e-13, and that is the sum of 17 points 0.8 widths apart (the trapezoidal rule is exact for
/// what has no frequency beyond its own), with `m!` from Stirling's series and `m ln(m/g) − m + g` in the form that has
/// no cancellation (Loader, "Fast and Accurate Computation of Binomial Probabilities", 2000). So the number of
/// operations is fixed, `g` may be anything, and the error of the method is below 2e-6.
///
/// Error against `f64` of the same inputs, `u = 2⁻²⁴`, `L = ln(Σ(A = 0)/Σ(A))`, the depth down the lobe:
/// `|δf/f| ≤ u (200 + 70 L)`. *Derivation.* `A` is off by `9u` and the exponent of each term by `2u` more, which the mean of
/// `A/m ≤ L` multiplies. `g` is off by `50u`, most of it from `erfc` in `K`, and `|∂ ln Σ/∂ ln g| = |E m − g| ≤ L + 1`, because
/// `2y eʸ − eʸ + 1 ≥ eʸ − 1`. Ten roundings of `e⁻ᵍ` count twenty times. The rest, `F`, `S` and factors, has less than
/// 100 roundings.
///
/// Values below 2⁻¹²⁶ of the peak are 0.
///
/// ```
/// use lobe::{Brdf, HeTorrance, Ior, Rgb, Vec3};
/// let nickel = HeTorrance::new(Rgb::new(0.21_f32, 0.16, 0.10), Ior(9.1), 0.65, 28.0);
/// let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// assert!(nickel.eval(l, v).r > 5.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeTorrance<R = f32> {
    ks: Rgb<R>,
    fresnel: Dielectric<R>,
    sigma: R,
    tau: R,
}

carry!([] HeTorrance<f32> => HeTorrance<S> { ks, fresnel, sigma, tau });

/// Terms of the series for few disturbances; at the largest term 20 the next one is 1e-8 of the sum.
const TERMS: u32 = 50;
const LAST_LARGEST: f64 = 20.0;
/// Distance of the points of the integral in widths; and how many lie below and above the largest term.
const STEP: f64 = 0.8;
const BELOW: i32 = 7;
const ABOVE: i32 = 9;

impl<R: Real> HeTorrance<R> {
    /// The lobe of a surface with the index `η`, the root mean square height `σ₀` and the correlation length `τ`, both
    /// in wavelengths, times `ks`.
    #[inline(always)]
    pub fn new(ks: Rgb<R>, eta: Ior<R>, sigma: R, tau: R) -> Self {
        Self { ks, fresnel: Dielectric::new(eta), sigma, tau }
    }

    /// The factor `ks`.
    #[inline(always)]
    pub fn ks(&self) -> Rgb<R> {
        self.ks
    }

    /// The index `η`.
    #[inline(always)]
    pub fn ior(&self) -> Ior<R> {
        self.fresnel.ior()
    }

    /// The root mean square height `σ₀`, in wavelengths.
    #[inline(always)]
    pub fn sigma(&self) -> R {
        self.sigma
    }

    /// The correlation length `τ`, in wavelengths.
    #[inline(always)]
    pub fn tau(&self) -> R {
        self.tau
    }

    /// The same lobe in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> HeTorrance<S> {
        HeTorrance::new(self.ks.map(&f), self.fresnel.ior().map(&f), f(self.sigma), f(self.tau))
    }

    /// `S₁(w)/cos θ` and `K(w)`.
    #[inline(always)]
    fn side(&self, w: Vec3<R>) -> (R, R) {
        let sin = (w.x.squared() + w.y.squared()).sqrt();
        // Infinite at the normal, where erfc and the exponential are 0.
        let cot = w.z / sin;
        let t = cot * (self.tau / self.sigma).times(0.5);
        let erfc = t.erfc();
        let seen = t.lift(1.0) - erfc.times(0.5);
        // (1 + Λ) cos θ, with cos θ/w = 2σ₀ sin θ/τ: nothing is divided by the cosine, and nothing cancels.
        let edge = (self.sigma / self.tau * sin).times(1.0 / SQRT_PI) * (-t.squared()).exp();
        let s = seen / (w.z * seen + edge);
        (s, sin / w.z * erfc)
    }

    /// `1/(1 + x²)`, with `x exp(x²/2) = f₀ = k/√(8π)`, or `x² = W(f₀²)`.
    #[inline(always)]
    fn seen_share(&self, k: R) -> R {
        // Below 1e-12 the square of x is nothing beside 1; the logarithm of 0 would be infinite.
        let f0 = k.times(1.0 / (2.0 * SQRT_2 * SQRT_PI)).max(k.lift(1e-12));
        lambert(f0.ln().times(2.0)).plus(1.0).recip()
    }

    #[inline(always)]
    fn value(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let (pi_tau, s) = (self.tau.times(PI), l + v);
        let ((side_l, k_l), (side_v, k_v)) = (self.side(l), self.side(v));
        let share = self.seen_share(k_l + k_v);
        let phase = self.sigma.times(2.0 * PI).squared() * share;
        let g = phase * s.z.squared();
        let a = (pi_tau * s.x).squared() + (pi_tau * s.y).squared();
        // G D/π, where (|s|²/s.z)² g is |s|⁴ (2πσ)².
        let length2 = s.length_squared();
        let factor = (pi_tau.squared() * phase).times(0.25 / PI) * (side_l * side_v) * length2;
        let cos_d = length2.sqrt().times(0.5).min(g.lift(1.0));
        let fresnel = self.fresnel.fresnel(Incidence::halfway(l, v, cos_d));
        // The series last: it may be small, and the factor as large. Its 2⁶⁴ is taken back in two parts, so that nothing is
        // subnormal on the way.
        let series = above_horizon(l, v, length2 * series(g, a));
        fresnel * self.ks * above_horizon(l, v, factor.times(TWO_POW_MINUS_24)) * series * g.lift(TWO_POW_MINUS_40)
    }
}

const TWO_POW_MINUS_24: f64 = 1.0 / (1u64 << 24) as f64;
const TWO_POW_MINUS_40: f64 = 1.0 / (1u64 << 40) as f64;
/// `log₂` of a factor of the series. Without it the terms beside the largest one become 0 before that one does, and the far
/// sides of a lobe are off by 1e-2 (the suite's `equal_to_f64`). Its rounding, `32u`, is in the bound.
const SERIES_EXPONENT: f64 = 64.0;
const SQRT_PI: f64 = 1.772_453_850_905_516;

/// Lambert's `W(z) > 0`, from `ln z`: three steps of Iacono and Boyd's iteration, `w ← w (1 + ln(z/w))/(1 + w)`, "New
/// Approximations to the Principal Real-Valued Branch of the Lambert W-Function", 2017. From within 10 % on they give
/// every digit of `f64`; how far `w` can be wrong grows with `|ln z|` alone.
#[inline(always)]
fn lambert<R: Real>(ln_z: R) -> R {
    // ln(1 + z), whose exponential must not overflow.
    let large = ln_z.lift(60.0);
    let start = ln_z.min(large).exp().log2_1p().times(LN_2) + (ln_z - large).max(ln_z.lift(0.0));
    // Within 20 % of W; 1 − ln(1 + L)/(2 + L), L = ln(1 + z).
    let mut w = start * (start.lift(1.0) - start.log2_1p().times(LN_2) / start.plus(2.0));
    for _ in 0..4 {
        w = w * (ln_z.plus(1.0) - w.ln()) / w.plus(1.0);
    }
    w
}

/// `2⁶⁴ Σ gᵐ⁻¹ e⁻ᵍ/(m! m) exp(−A/m)` over `m ≥ 1`.
#[inline(always)]
fn series<R: Real>(g: R, a: R) -> R {
    let (zero, one) = (g.lift(0.0), g.lift(1.0));
    // Where the largest term is. Above the smallest numbers, so that no quotient is 0/0; what is there is summed term
    // by term.
    let (g_safe, a_safe) = (g.max(g.lift(1e-18)), a.max(g.lift(1e-12)));
    let y = lambert(a_safe.ln() - g_safe.ln().times(2.0) + one.lift(LN_2)).times(0.5);
    // g eʸ without overflow: m² y = A.
    let largest = (a_safe / y).sqrt();
    let few = largest.le(one.lift(LAST_LARGEST));

    // The first terms, one by one.
    let exponent = a.times(-LOG2_E);
    let mut weight = one;
    let mut sum = zero;
    for m in 1..=TERMS {
        let inverse = 1.0 / f64::from(m);
        sum = sum + weight.times(inverse) * exponent.times(inverse).plus(SERIES_EXPONENT).exp2();
        weight = weight * g.times(1.0 / f64::from(m + 1));
    }
    let first = sum * g.times(-LOG2_E).exp2();

    // The integral. δ = m − g is the exact one, and m follows from it.
    let width = (largest / y.times(2.0).plus(1.0)).sqrt();
    let step = width.times(STEP);
    let start = largest - g;
    let mut integral = zero;
    for j in -BELOW..=ABOVE {
        let delta = start + step.times(f64::from(j));
        let m = g + delta;
        let inside = m.gt(one.lift(0.5));
        let inverse = R::select(inside, m, one).recip();
        let lost = deviance(delta, g, m)
            + a * inverse
            + inverse.times(1.0 / 12.0) * (one - inverse.squared().times(1.0 / 30.0));
        integral = integral + lost.times(-LOG2_E).plus(SERIES_EXPONENT).exp2_where(inside) * (inverse * inverse.sqrt());
    }
    let many = integral * step.times(1.0 / (SQRT_2 * SQRT_PI)) / g_safe;
    R::select(few, first, many)
}

/// `m ln(m/g) − m + g ≥ 0` for `m = g + δ`.
///
/// Near `m = g` it is `δ²/2g` less small terms, while those of the formula are as large as `δ`: so with
/// `v = δ/(m + g)` as `δ v + 2m (v³/3 + v⁵/5 + …)` there. Without it a lobe of `g = 10⁴` is wrong by 1e-3.
#[inline(always)]
fn deviance<R: Real>(delta: R, g: R, m: R) -> R {
    let v = delta / (m + g);
    let v2 = v.squared();
    let tail = v2.times(1.0 / 9.0).plus(1.0 / 7.0);
    let tail = (tail * v2).plus(1.0 / 5.0);
    let tail = (tail * v2).plus(1.0 / 3.0);
    let near = delta * v + (m * v).times(2.0) * (tail * v2);
    // Of m below 0 too, which is not used.
    let far = m * (m.abs() / g.max(g.lift(1e-30))).ln() - delta;
    R::select(v.abs().lt(v.lift(0.1)), near, far)
}

impl<R: Real> Brdf<R> for HeTorrance<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.value(l, v)
    }
}
