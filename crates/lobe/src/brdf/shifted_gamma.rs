//! Shifted-Gamma: `f_r = ks F D G₁(l) G₁(v)/(π (n·l)(n·v))`, `D = K exp(−t)/(π t^p (n·h)⁴)`, `t = α + tan²θ_h/α`.

use super::{Brdf, above_horizon};
use crate::carry::carry;
use crate::color::Rgb;
use crate::fresnel::{Incidence, fifth_power};
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::{FRAC_1_PI, LOG2_E};

/// The parameters of [`ShiftedGamma`] for one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShiftedGammaChannel<R = f32> {
    /// The factor `ks` of the lobe.
    pub ks: R,
    /// The width `α > 0` of the distribution.
    pub alpha: R,
    /// The exponent `p` of its fall.
    pub p: R,
    /// Its factor `K`: normalised it is `1/(α Γ(1 − p, α))`, which the published sets keep to 1e-3.
    pub k_ap: R,
    /// `F₀` of `F = F₀ − F₁ cos θ + (1 − F₀)(1 − cos θ)⁵`.
    pub f0: R,
    /// `F₁` of the same; may be negative.
    pub f1: R,
    /// `λ` of `G₁ = 1 + λ (1 − exp(c (θ − θ₀)^k))`.
    pub lambda: R,
    /// `log₂ c`. The logarithm, because published values of `c` go from 1e-8 to 1e109.
    pub log2_c: R,
    /// `k`.
    pub k: R,
    /// `θ₀` in radians, below which nothing is masked; may be negative.
    pub theta0: R,
}

carry!([] ShiftedGammaChannel<f32> => ShiftedGammaChannel<S> { ks, alpha, p, k_ap, f0, f1, lambda, log2_c, k, theta0 });

impl<R> ShiftedGammaChannel<R> {
    /// The same parameters in another number type.
    #[inline(always)]
    pub fn map<S>(self, f: impl Fn(R) -> S) -> ShiftedGammaChannel<S> {
        ShiftedGammaChannel {
            ks: f(self.ks),
            alpha: f(self.alpha),
            p: f(self.p),
            k_ap: f(self.k_ap),
            f0: f(self.f0),
            f1: f(self.f1),
            lambda: f(self.lambda),
            log2_c: f(self.log2_c),
            k: f(self.k),
            theta0: f(self.theta0),
        }
    }
}

/// The microfacet model with a shifted Gamma distribution: `f_r = ks F D G₁(l) G₁(v)/(π (n·l)(n·v))` sr⁻¹, with, per
/// channel,
///
/// - `D = K exp(−t)/(π t^p (n·h)⁴)`, `t = α + tan²θ_h/α`;
/// - `G₁(θ) = 1 + λ (1 − exp(c (θ − θ₀)^k))` for `θ > θ₀`, 1 below; kept in `[0, 1]`, which fits leave near the horizon;
/// - `F = F₀ − F₁ cos θ_d + (1 − F₀)(1 − cos θ_d)⁵`, kept at or above 0.
///
/// Bagher, Soler and Holzschuch, "Accurate Fitting of Measured Reflectances Using a Shifted Gamma Micro-Facet
/// Distribution", EGSR 2012. The three channels are fitted apart, with all of their parameters.
///
/// Reciprocal to the last bit. `G₁` is fitted, and does not go to 0 as the cosine: `f_r (n·l)` grows towards the horizon of
/// `v` as `1/(n·v)`. `1/((n·l)(n·v))` and `1/(n·v)` end at 2⁹⁰.
///
/// Error against `f64` of the same inputs, `u = 2⁻²⁴`: `|δf/f| ≤ u (150 + 20 t) + Γ(l) + Γ(v)`, where
/// `Γ = u (8 k θ/(θ − θ₀) + 4 |log₂ c| + 8) λ z e^z/G₁` with `z = c (θ − θ₀)^k`: the condition number of a high power of a small
/// difference, which only shows where `z` does, next to the horizon.
///
/// Values below 2⁻¹²⁶ of the peak are 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShiftedGamma<R = f32> {
    channels: Rgb<ShiftedGammaChannel<R>>,
}

carry!([] ShiftedGamma<f32> => ShiftedGamma<S> { channels });

impl<R: Real> ShiftedGamma<R> {
    /// The lobe with these parameters of the three channels.
    #[inline(always)]
    pub fn new(channels: Rgb<ShiftedGammaChannel<R>>) -> Self {
        Self { channels }
    }

    /// The parameters of the three channels.
    #[inline(always)]
    pub fn channels(&self) -> Rgb<ShiftedGammaChannel<R>> {
        self.channels
    }

    /// The same lobe in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> ShiftedGamma<S> {
        ShiftedGamma::new(self.channels.map(
            #[inline(always)]
            |c| c.map(&f),
        ))
    }

    #[inline(always)]
    fn weighted(&self, l: Vec3<R>, v: Vec3<R>, visibility: R) -> Rgb<R> {
        let s = l + v;
        let r = s.z.recip();
        // Divided before it is squared: the squares underflow between opposite directions at the horizon.
        let tan2 = (s.x * r).squared() + (s.y * r).squared();
        let cos_d = s.length_squared().sqrt().times(0.5).min(r.lift(1.0));
        let away = Incidence::halfway(l, v, cos_d).one_minus_cos;
        let (theta_l, theta_v) = (angle(l), angle(v));
        let visibility = above_horizon(l, v, visibility.min(visibility.lift(END)));
        self.channels.map(
            #[inline(always)]
            |c| {
                let masking = g1(&c, theta_l) * g1(&c, theta_v);
                let fresnel = (c.f0 - c.f1 * cos_d) + (away.lift(1.0) - c.f0) * fifth_power(away);
                c.ks * fresnel.max(away.lift(0.0)) * (d(&c, tan2) * masking) * visibility
            },
        )
    }
}

/// Where `1/((n·l)(n·v))` ends: an infinity times a masking of 0 would be NaN (the suite's `finite_to_the_last_float`).
const END: f64 = (1u128 << 90) as f64;

/// The angle to the normal.
#[inline(always)]
fn angle<R: Real>(w: Vec3<R>) -> R {
    (w.x.squared() + w.y.squared()).sqrt().atan2(w.z)
}

#[inline(always)]
fn g1<R: Real>(c: &ShiftedGammaChannel<R>, theta: R) -> R {
    let (zero, one) = (theta.lift(0.0), theta.lift(1.0));
    let beyond = (theta - c.theta0).max(zero);
    // c x^k as one power of two: c alone leaves the range. At most 2⁶: e⁶⁴ − 1 is finite, and G₁ is 0 there for any λ.
    let z = (c.log2_c + c.k * beyond.log2()).min(one.lift(6.0)).exp2();
    (one - c.lambda * exp_m1(z)).max(zero).min(one)
}

/// `e^z − 1` for `z ≥ 0`, by Taylor's series up to 1/2: `λ` is 1e7 in a published set, and would multiply what the
/// difference loses (test `shifted_gamma_needs_no_difference`).
#[inline(always)]
fn exp_m1<R: Real>(z: R) -> R {
    let mut series = z.lift(1.0);
    for n in (2..=10).rev() {
        series = series * z.times(1.0 / f64::from(n)) + z.lift(1.0);
    }
    R::select(z.lt(z.lift(0.5)), series * z, z.exp().plus(-1.0))
}

/// `K exp(−t) t^(−p) (1 + tan²)²/π`; `(n·h)⁻⁴` is `(1 + tan²)²`.
#[inline(always)]
fn d<R: Real>(c: &ShiftedGammaChannel<R>, tan2: R) -> R {
    let t = c.alpha + tan2 / c.alpha;
    // Beyond, exp(−t) is 0 and the other factors may be infinite.
    let visible = t.lt(t.lift(87.0));
    let power = (-(c.p * t.log2())).exp2() * tan2.plus(1.0).squared();
    let value = c.k_ap.times(FRAC_1_PI) * t.times(-LOG2_E).exp2_where(visible) * power;
    R::select(visible, value, t.lift(0.0))
}

impl<R: Real> Brdf<R> for ShiftedGamma<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        // One after the other: the product of small cosines underflows.
        self.weighted(l, v, (l.z.max(v.z).recip() / l.z.min(v.z)).times(FRAC_1_PI))
    }

    /// `(n·l)` taken from the denominator.
    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, v.z.recip().times(FRAC_1_PI))
    }
}
