//! Charlie sheen: `f_r = c D V`, `D = (2 + 1/α)/(2π) sin^(1/α) θ_h`, `V = 1/(4 (n·l)(n·v)(1 + Λ(l) + Λ(v)))`.

use super::{Brdf, both_above, power, zero_or_nan};
use crate::Alpha;
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::TAU;

/// Charlie, a sheen of fibres that stand on the surface: `f_r = c D V` sr⁻¹ with `D = (2 + 1/α)/(2π) sin^(1/α) θ_h` and
/// `V = 1/(4 (n·l)(n·v)(1 + Λ(l) + Λ(v)))`, `ln Λ = L(cos θ)` for `cos θ < 1/2` and `2 L(1/2) − L(1 − cos θ)` elsewhere,
/// `L(x) = a/(1 + b xᶜ) + d x + e`, the five fitted numbers between their values for `α = 0` and `α = 1` by `(1 − α)²`.
///
/// Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 course, equations 2 and 3 and table 1;
/// in this form glTF 2.0, `KHR_materials_sheen`, where `α` is the square of the roughness. Without the softened
/// terminator of the paper's section 4.
///
/// Reciprocal to the last bit. Domain: `c ∈ [0, 1]`, `α ∈ [0.01, 1]`. Error against `f64` of the same inputs: 2e-5 and
/// `12 u t` with `t = |ln(D/D_max)|`; `D` is 0 for `t` above 87.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Charlie<R = f32> {
    pub(crate) color: Rgb<R>,
    alpha: Alpha<R>,
    /// `1/α`.
    exponent: R,
    /// `(2 + 1/α)/(8π)`.
    peak: R,
    fit: Fit<R>,
}

carry!([] Charlie<f32> => Charlie<S> { color, alpha, exponent, peak, fit });

/// The numbers of `L`, and `2 L(1/2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fit<R> {
    a: R,
    b: R,
    c: R,
    d: R,
    e: R,
    middle: R,
}

carry!([] Fit<f32> => Fit<S> { a, b, c, d, e, middle });

impl<R: Real> Fit<R> {
    #[inline(always)]
    fn new(alpha: R) -> Self {
        let one = alpha.lift(1.0);
        let smooth = (one - alpha).squared();
        let between = |rough: f64, fine: f64| (one - smooth).times(rough) + smooth.times(fine);
        let mut fit = Self {
            a: between(21.5473, 25.3245),
            b: between(3.82987, 3.32435),
            c: between(0.19823, 0.16801),
            d: between(-1.97760, -1.27393),
            e: between(-4.32054, -4.85967),
            middle: one,
        };
        fit.middle = fit.log(one.times(0.5)).times(2.0);
        fit
    }

    /// `L(x)`.
    #[inline(always)]
    fn log(&self, x: R) -> R {
        self.a / (self.b * x.pow(self.c)).plus(1.0) + self.d * x + self.e
    }

    /// `Λ`.
    #[inline(always)]
    fn lambda(&self, cos: R) -> R {
        let (one, low) = (cos.lift(1.0), cos.lt(cos.lift(0.5)));
        // 1 − cos θ may be −u for a rounded direction, and a negative base is NaN.
        let log = self.log(R::select(low, cos, (one - cos).max(cos.lift(0.0))));
        R::select(low, log, self.middle - log).exp()
    }
}

impl<R: Real> Charlie<R> {
    /// The sheen of colour `c` and width `α`.
    #[inline(always)]
    pub fn new(color: Rgb<R>, alpha: Alpha<R>) -> Self {
        let exponent = alpha.0.recip();
        Self { color, alpha, exponent, peak: exponent.plus(2.0).times(0.25 / TAU), fit: Fit::new(alpha.0) }
    }

    /// The colour `c`.
    #[inline(always)]
    pub fn color(&self) -> Rgb<R> {
        self.color
    }

    /// The width `α`.
    #[inline(always)]
    pub fn alpha(&self) -> Alpha<R> {
        self.alpha
    }

    /// The same sheen in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> Charlie<S> {
        Charlie::new(self.color.map(&f), self.alpha.map(&f))
    }

    /// `2⁶² D/(4 (1 + Λ(l) + Λ(v)))`. `Λ` reaches 10⁸ at the horizon, and without the scale the quotient is subnormal where
    /// the cosines would bring it back.
    #[inline(always)]
    fn without_cosines(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let s = (l + v) * l.z.lift(R::SCALE);
        // With the half vector at the normal the quotient is x/0; D is 0 there to 1e-17 all the same.
        let sin2 = (s.x.squared() + s.y.squared()).max(s.z.squared().times(1e-34));
        // sin^q θ, as the cosine lobe with both exchanged.
        let lobe = power::half_vector_power(s.z.squared(), sin2, self.exponent, both_above(l, v));
        (self.peak * lobe).times(R::SCALE) / (self.fit.lambda(l.z) + self.fit.lambda(v.z)).plus(1.0)
    }
}

impl<R: Real> Brdf<R> for Charlie<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let (zero, scale) = (l.z.lift(0.0), l.z.lift(R::SCALE));
        // The product of two cosines of 1e-20 is subnormal. Scaled, the numerator is at most 2¹²⁷.
        let value = self.without_cosines(l, v) * scale / ((l.z * scale) * (v.z * scale));
        self.color * (R::select(both_above(l, v), value, zero) + zero_or_nan(l, v))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let value = self.without_cosines(l, v) * (l.z.lift(1.0 / R::SCALE) / v.z);
        self.color * (R::select(both_above(l, v), value, l.z.lift(0.0)) + zero_or_nan(l, v))
    }
}
