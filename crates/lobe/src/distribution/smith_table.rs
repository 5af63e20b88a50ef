//! Smith's `Λ` of any isotropic distribution, integrated once and interpolated.

use super::{Distribution, SmithLambda, Widths};
use crate::Alpha;
use crate::Carry;
use crate::carry::carry;
use crate::number::Real;
use crate::vector::Vec3;

/// A distribution with its Smith function in a table: `Λ(w) cos θ = s I(a)`, `s = √((αx w.x)² + (αy w.y)²)`,
/// `a = cos θ/s`.
///
/// `I(a) = ∫ (m − a) p(m) dm` from `a` to infinity, where `p` is the density of the slope `m` along one axis, in units
/// of the width (Walter et al. 2007, appendix A; Heitz 2014, section 5.1). The constructor integrates
/// it, and its derivative, at `N` values of `a`; in between it is a cubic (Hermite). An evaluation adds up all `N`
/// pieces: nothing is indexed by a value.
///
/// With the 64 nodes of the default `(1 + Λ) cos θ` is within 3e-7 of the closed forms of GGX and Beckmann in `f64`, of
/// [`Gtr`](super::Gtr) with `γ ≤ 1` and `α = 1e-4`, whose slopes spread over four decades, within 5e-5. In `f32` it is
/// within 4e-6 of `f64`. Of a [`Tabulated`](super::Tabulated), which is integrated from corner to corner, it is within 6e-5, for
/// single peaks of two steps of 5° and for what is rough from step to step (test `smiths_function_of_a_drawn_distribution`).
///
/// Exact in this sense for every isotropic distribution, and for an anisotropic one whose slopes keep their shape when they are
/// stretched ([`Ggx`](super::Ggx), [`Beckmann`](super::Beckmann), [`StudentT`](super::StudentT)). For the others with
/// two widths it is what a stretched copy of the isotropic one would have, an approximation that gets better as they
/// get sharper: `(1 + Λ) cos θ` is off by at most 8e-6 with the widths 0.02 and 0.08 ([`Gtr`](super::Gtr) with `γ = 1.5`: 5 %), and with widths
/// up to 1 and aspects up to 16 by 20 % for [`PhongPower`](super::PhongPower), 6 % for
/// [`Gaussian`](super::Gaussian), 37 % for that `Gtr` (test `a_stretched_table_is_near`). There a BRDF loses or gains
/// about as much towards the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmithTable<D, R = f32, const N: usize = 64> {
    distribution: D,
    widths: Widths<R>,
    /// `I` and its derivative by `u · (N − 1)`, at `u = i/(N − 1)`.
    nodes: [(R, R); N],
}

carry!([D: Carry, const N: usize] SmithTable<D, f32, N> => SmithTable<D::In<S>, S, N> { distribution, widths, nodes });

impl<R: Real, D: Distribution<R>, const N: usize> SmithTable<D, R, N> {
    /// The table of an isotropic distribution of this width.
    ///
    /// The width only says where the table is dense: any that is about that of the distribution will do.
    #[inline]
    pub fn new(distribution: D, width: Alpha<R>) -> Self {
        let nodes = table(&distribution, width);
        Self { distribution, widths: Widths::new(width, width), nodes }
    }

    /// The table of a distribution with two widths, from the isotropic one of the width `√(αx αy)`.
    #[inline]
    pub fn anisotropic(distribution: D, x: Alpha<R>, y: Alpha<R>, isotropic: &impl Distribution<R>) -> Self {
        let nodes = table(isotropic, Alpha((x.0 * y.0).sqrt()));
        Self { distribution, widths: Widths::new(x, y), nodes }
    }

    /// The distribution itself.
    #[inline(always)]
    pub fn distribution(&self) -> &D {
        &self.distribution
    }
}

/// `a` and `da/du` at `u` in [0, 1): `log₂(1 + a) = 2u/(1 − u)`. Dense at the widths, and far enough for slopes of 1e6.
fn argument(u: f64) -> (f64, f64) {
    let log2 = BEND * u / (1.0 - u);
    let power = libm::exp2(log2);
    (power - 1.0, power * core::f64::consts::LN_2 * BEND / ((1.0 - u) * (1.0 - u)))
}

const BEND: f64 = 3.0;
/// Beyond this `a` a node is 0: there `I` is far below the last place of `a`.
const LAST: f64 = 1e9;

#[inline]
fn table<R: Real, const N: usize>(distribution: &impl Distribution<R>, width: Alpha<R>) -> [(R, R); N] {
    const { assert!(N >= 2) };
    core::array::from_fn(
        #[inline(always)]
        |i| {
            let u = i as f64 / (N - 1) as f64;
            let (a, da_du) = if i + 1 < N { argument(u) } else { (f64::INFINITY, 0.0) };
            let zero = width.0.lift(0.0);
            if a > LAST {
                return (zero, zero);
            }
            let (value, tail) = match distribution.pieces() {
                0 => integrals(distribution, width.0, a),
                pieces => by_pieces(distribution, width.0, a, pieces),
            };
            (value, -tail.times(da_du / (N - 1) as f64))
        },
    )
}

/// `I(a)` and `−I'(a)`, the integral of the density beyond `a`.
///
/// With the slope `√(a² + ρ²)` of a facet in units of the width, and the integral over its azimuth done,
/// `I = ∫ p₂ 2(ρ − a atan(ρ/a)) ρ dρ` and `−I' = ∫ p₂ 2 atan(ρ/a) ρ dρ`. The rule of trapezoids over `ln ρ` converges
/// exponentially for a smooth distribution. A power of `ρ`, as all heavy tails are, goes on as a geometric series.
#[inline]
fn integrals<R: Real>(distribution: &impl Distribution<R>, width: R, a: f64) -> (R, R) {
    const STEP: f64 = 0.25;
    let (zero, one) = (width.lift(0.0), width.lift(1.0));
    let tiny = width.lift(R::MIN_POSITIVE);
    let (mut i, mut q) = (zero, zero);
    let (mut last, mut before) = ((zero, zero), (zero, zero));
    for k in -40..=72 {
        let rho = libm::exp(f64::from(k) * STEP);
        let slope = width.times(libm::sqrt(a * a + rho * rho));
        let cos2 = (slope.squared() + one).recip();
        let cos = cos2.sqrt();
        let d = distribution.d(Vec3::new(slope * cos, zero, cos));
        // p₂ ρ² in units of the width: the weights of the slopes; ρ of the two is the step of the logarithm.
        let density = d * (cos2 * width.times(rho)).squared();
        let angle = libm::atan2(rho, a);
        before = last;
        last = (density.times(2.0 * STEP * (rho - a * angle)), density.times(2.0 * STEP * angle));
        (i, q) = (i + last.0, q + last.1);
    }
    // The terms that are left, of a geometric series; of an exponential tail there are none.
    let rest = |last: R, before: R| {
        let ratio = (last / before.max(tiny)).min(one.times(0.99));
        last * ratio / (one - ratio)
    };
    (i + rest(last.0, before.0), q + rest(last.1, before.1))
}

/// Nodes and weights of Gauss and Legendre's rule of six points on `[0, 1]`.
const RULE: [(f64, f64); 6] = [
    (0.033_765_242_898_423_97, 0.085_662_246_189_585_17),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_53, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_5, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_17),
];

/// [`integrals`] of a density with corners, from one to the next: `∫ D 2(ρ − a atan(ρ/a)) sin θ cos θ dθ` and `∫ D 2
/// atan(ρ/a) sin θ cos θ dθ` over the facets steeper than `tan θ_a = α a`. A step of the logarithm there is longer than
/// a peak of 10° near the horizon, and misses a fifth of it (test `smiths_function_of_a_drawn_distribution`).
///
/// By `s = √(θ − θ_a)`, in which `ρ` has no root at its start. Angles are counted from the horizon, whose cosines keep
/// their digits; `ρ² = (m − a)(m + a)` with `m − a = sin(θ − θ_a)/(α cos θ cos θ_a)`.
#[inline]
fn by_pieces<R: Real>(distribution: &impl Distribution<R>, width: R, a: f64, pieces: usize) -> (R, R) {
    let (zero, one) = (width.lift(0.0), width.lift(1.0));
    let start = width.times(a);
    // Both from the horizon: θ_a, and the ends of the pieces.
    let beyond = one.atan2(start);
    let at = |piece: usize| {
        let above = core::f64::consts::FRAC_PI_2 * (pieces - piece) as f64 / pieces as f64;
        (beyond.plus(-above)).max(zero).sqrt()
    };
    let cos_start = (start.squared() + one).rsqrt();
    let (mut i, mut q) = (zero, zero);
    for piece in 0..pieces {
        let (from, to) = (at(piece), at(piece + 1));
        for (node, weight) in RULE {
            let s = from + (to - from).times(node);
            let over = s.squared();
            // Of the angle from the horizon: its sine is cos θ.
            let (cos, sin) = (beyond - over).sin_cos();
            let excess = over.sin_cos().0 / (width * cos * cos_start);
            let rho = (excess * excess.plus(2.0 * a)).sqrt();
            let density = distribution.d(Vec3::new(sin, zero, cos)) * sin * cos;
            let angle = rho.atan2(zero.plus(a));
            // dθ = 2s ds.
            let step = density * s * (to - from).times(4.0 * weight);
            i = i + step * (rho - angle.times(a));
            q = q + step * angle;
        }
    }
    (i, q)
}

impl<R: Real, D: Distribution<R>, const N: usize> Distribution<R> for SmithTable<D, R, N> {
    #[inline(always)]
    fn d(&self, h: Vec3<R>) -> R {
        self.distribution.d(h)
    }
    #[inline(always)]
    fn pieces(&self) -> usize {
        self.distribution.pieces()
    }
}

impl<R: Real, D: Distribution<R>, const N: usize> SmithLambda<R> for SmithTable<D, R, N> {
    #[inline(always)]
    fn lambda_cos(&self, w: Vec3<R>) -> R {
        let s = self.widths.shrunk(w).sqrt();
        let (zero, one) = (s.lift(0.0), s.lift(1.0));
        // At normal incidence a is infinite, and so is its logarithm, of which the quotient below would be NaN.
        let a = (w.z / s).min(s.lift(LAST));
        let log2 = a.log2_1p();
        let x = (log2 / log2.plus(BEND)).times((N - 1) as f64);
        let mut sum = zero;
        for (i, &(value, slope)) in self.nodes.iter().enumerate() {
            // Hermite's cubics: (1 − |d|)² (1 + 2|d|) and (1 − |d|)² d, for |d| < 1.
            let d = x.plus(-(i as f64));
            let rest = (one - d.abs()).max(zero);
            sum = sum + rest.squared() * (value * d.abs().times(2.0).plus(1.0) + slope * d);
        }
        // Interpolated, nothing may be below nothing; else G₁ would be above 1.
        s * sum.max(zero)
    }
}
