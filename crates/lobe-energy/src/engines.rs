//! What engines take for the albedo of GGX, and how they compensate with it.
//!
//! Each is what its source prints, with the error that follows. [`GgxFit`](crate::GgxFit) is the one to use; these are here so that
//! results can be compared with a shader's.

use crate::{GgxAlbedo, GgxTable};
use lobe::distribution::Ggx;
use lobe::fresnel::{Fresnel, Incidence};
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Carry, Microfacet, Real, Rgb, Vec3};

/// The albedo of a GGX with Schlick's term, `E = F0 scale + F90 bias`: the split sum of Karis, "Real Shading in Unreal Engine 4",
/// 2013.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split<R> {
    /// What multiplies `F0`.
    pub scale: R,
    /// What multiplies `F90`.
    pub bias: R,
}

/// An approximation of the split sum.
pub trait SplitSum<R: Real> {
    /// The split for facets of this width, seen from the cosine `μ`.
    fn split(&self, alpha: Alpha<R>, mu: R) -> Split<R>;
}

/// The table of this crate, as a split sum: within 7e-3 of the integral.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tabulated;

impl<R: Real> SplitSum<R> for Tabulated {
    fn split(&self, alpha: Alpha<R>, mu: R) -> Split<R> {
        let table = GgxTable::new(alpha);
        let (albedo, weight) = (mu.lift(1.0) - table.loss(mu), table.fresnel_weight(mu));
        Split { scale: albedo * (mu.lift(1.0) - weight), bias: albedo * weight }
    }
}

/// Karis, "Physically Based Shading on Mobile", 2014: a polynomial in the roughness `√α` and an exponential of the cosine. three.js
/// and Unreal's mobile renderer have it, bevy without its table.
///
/// It was fitted by eye to GGX with Schlick's masking. `lobe audit` prints its error against the integral of the correlated form.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KarisMobile;

impl<R: Real> SplitSum<R> for KarisMobile {
    #[inline(always)]
    fn split(&self, alpha: Alpha<R>, mu: R) -> Split<R> {
        let roughness = alpha.0.sqrt();
        let one = roughness.lift(1.0);
        let [x, y, z, w] = [
            one - roughness,
            roughness.times(-0.0275).plus(0.0425),
            roughness.times(-0.572).plus(1.04),
            roughness.times(0.022).plus(-0.04),
        ];
        let a = x.squared().min(mu.times(-9.28).exp2()) * x + y;
        Split { scale: z - a.times(1.04), bias: w + a.times(1.04) }
    }
}

/// MaterialX, `mx_ggx_dir_albedo_analytic` of its shader library: quotients of polynomials in the cosine and `α`, within 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MaterialX;

/// The coefficients of `1, x, y, xy, x², y², x²y, xy², x²y²`: scale and bias, each over its own.
const MATERIAL_X: [[f64; 9]; 4] = [
    [0.1003, -0.6303, 9.748, -2.038, 29.34, -8.245, -26.44, 19.99, -5.448],
    [0.9345, -2.323, 2.229, -3.748, 1.424, -0.7684, 1.436, 0.2913, 0.6286],
    [1.0, -1.765, 8.263, 11.53, 28.96, -7.507, -36.11, 15.86, 33.37],
    [1.0, 0.2281, 15.94, -55.83, 13.08, 41.26, 54.9, 300.2, -285.1],
];

impl<R: Real> SplitSum<R> for MaterialX {
    #[inline(always)]
    fn split(&self, alpha: Alpha<R>, mu: R) -> Split<R> {
        let (x, y) = (mu, alpha.0);
        let one = x.lift(1.0);
        let (x2, y2) = (x.squared(), y.squared());
        let powers = [one, x, y, x * y, x2, y2, x2 * y, x * y2, x2 * y2];
        let [scale, bias, under_scale, under_bias] = MATERIAL_X.map(
            #[inline(always)]
            |row| {
                let mut sum = one.lift(0.0);
                for (power, c) in powers.into_iter().zip(row) {
                    sum = sum + power.times(c);
                }
                sum
            },
        );
        let unit = |x: R| x.max(one.lift(0.0)).min(one);
        Split { scale: unit(scale / under_scale), bias: unit(bias / under_bias) }
    }
}

/// What of a split the factor `1 + F0 (1/E − 1)` takes for `E`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// None.
    Without,
    /// `E = scale + bias`: what Turquin 2019 has, and Filament (whose `dfg.y` is that sum), and MaterialX.
    Sum,
    /// `E = scale` alone: what bevy 0.12 to 0.18 has (`1/F_ab.x`).
    Scale,
}

/// A GGX with Schlick's term, brightened by `1 + F0 (1/E(v) − 1)` with an engine's `E`.
///
/// Not reciprocal: it depends on the viewer's `E` alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brightened<S, R = f32> {
    single: Microfacet<Ggx<R>, SmithCorrelated, lobe::fresnel::Schlick<R>>,
    alpha: Alpha<R>,
    f0: Rgb<R>,
    split: S,
    compensation: Compensation,
}

impl<R: Real, S: SplitSum<R>> Brightened<S, R> {
    /// Facets of this width and `F0`.
    #[inline]
    pub fn new(alpha: Alpha<R>, f0: Rgb<R>, split: S, compensation: Compensation) -> Self {
        let fresnel = lobe::fresnel::Schlick::new(f0);
        let single = Microfacet::new(Ggx::new(alpha), SmithCorrelated, fresnel);
        let f0 = fresnel.fresnel(Incidence::from_cos(alpha.0.lift(1.0)));
        Self { single, alpha, f0, split, compensation }
    }

    #[inline(always)]
    fn brighter(&self, single: Rgb<R>, v: Vec3<R>) -> Rgb<R> {
        let (zero, one) = (v.z.lift(0.0), v.z.lift(1.0));
        let split = self.split.split(self.alpha, v.z.max(zero));
        let albedo = match self.compensation {
            Compensation::Without => return single,
            Compensation::Sum => split.scale + split.bias,
            Compensation::Scale => split.scale,
        };
        // Below the horizon there is nothing to brighten.
        let gain = R::select(v.z.gt(zero), albedo.recip().plus(-1.0), zero);
        single * self.f0.map(|f0| (f0 * gain) + one)
    }
}

impl<R: Real, S: SplitSum<R>> Brdf<R> for Brightened<S, R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.brighter(self.single.eval(l, v), v)
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.brighter(self.single.eval_cos(l, v), v)
    }
}

impl<S: Copy> Carry for Brightened<S, f32> {
    type In<T: Real> = Brightened<S, T>;
    #[inline(always)]
    fn carry<T: Real>(&self, lift: &impl Fn(f32) -> T) -> Brightened<S, T> {
        Brightened {
            single: self.single.carry(lift),
            alpha: self.alpha.carry(lift),
            f0: self.f0.carry(lift),
            split: self.split,
            compensation: self.compensation,
        }
    }
}
