//! Ashikhmin-Shirley: `f_r = √((nu+1)(nv+1))/(8π) · (n·h)^e F(l·h)/((l·h) max(n·l, n·v))`,
//! `e = (nu h.x² + nv h.y²)/(1 − h.z²)`; and the diffuse lobe that goes with it.

use super::power::half_vector_power;
use super::{Brdf, Shininess, above_horizon, both_above, keep_nan};
use crate::carry::carry;
use crate::color::Rgb;
use crate::fresnel::{Fresnel, Incidence, Schlick};
use crate::number::Real;
use crate::vector::Vec3;
use core::f64::consts::PI;

/// The specular lobe: `f_r = √((nu+1)(nv+1))/(8π) · (n·h)^e F(l·h)/((l·h) max(n·l, n·v))` sr⁻¹, where
/// `e = (nu h.x² + nv h.y²)/(1 − h.z²)` and `F` is Schlick's with `f0 = Rs`.
///
/// Ashikhmin and Shirley, "An Anisotropic Phong BRDF Model", Journal of Graphics Tools 5(2), 2000, equation 4. Without
/// the diffuse lobe: that is [`AshikhminShirleyDiffuse`], and [`with_diffuse`](Self::with_diffuse) the sum.
///
/// Reciprocal to the last bit. Domain: `f0 ∈ [0, 1]`, `nu, nv ∈ [0, 10⁶]`. The albedo is at most 1 (test
/// `ashikhmin_shirley_conserves_energy`).
///
/// Along the mirror direction `f_r (n·l)` is `√((nu+1)(nv+1))/(8π (n·l))`, without bound towards the horizon. So
/// `eval_cos` ends at 2¹²⁷, which no cosine above 3e-34 reaches; `eval` has no such end, and leaves the range of `f32`
/// along the mirror direction below cosines of `√((nu+1)(nv+1))^½ 1e-20`.
///
/// Error against `f64` of the same inputs, `u = 2⁻²⁴`, `L = |ln (n·h)^e|`: `|δf/f| ≤ u (64 + 26 L)`. It grows with how far
/// down the lobe the value is, and not with the exponents. *Derivation.* Of `s = l + v` each component is off by `u`; the
/// shares `s.x²/(s.x² + s.y²)` by `9u`, the mean of the exponents by `11u`, all terms being positive; `tan²` by `7u`, its
/// logarithm by `5u` more, the product by one: `26u L` with the second order. The factor has eight roundings, the cosine
/// of the half angle five, the rest six, `exp2` two. Schlick's term of a black channel is a fifth power of `1 − cos =
/// sin²/(1 + cos)`, which has `7.5u`, five of the square of `l − v`: `42u` with its own roundings.
///
/// Values below 2⁻¹²⁶ of the lobe's peak are 0.
///
/// ```
/// use lobe::{AshikhminShirley, Brdf, Rgb, Shininess, Vec3};
/// let lobe = AshikhminShirley::new(Rgb::splat(0.05_f32), Shininess(10.0), Shininess(1000.0));
/// let plastic = lobe.with_diffuse(Rgb::new(0.5, 0.1, 0.1));
/// let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// assert!(plastic.eval(l, v).g > lobe.eval(l, v).g);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AshikhminShirley<R = f32> {
    f0: Rgb<R>,
    nu: Shininess<R>,
    nv: Shininess<R>,
    fresnel: Schlick<R>,
    /// `√((nu+1)(nv+1))/(8π)`.
    peak: R,
}

carry!([] AshikhminShirley<f32> => AshikhminShirley<S> { f0, nu, nv, fresnel, peak });

impl<R: Real> AshikhminShirley<R> {
    /// The lobe of reflectance `f0` at normal incidence, with one exponent along the tangent and one along the
    /// bitangent.
    #[inline(always)]
    pub fn new(f0: Rgb<R>, nu: Shininess<R>, nv: Shininess<R>) -> Self {
        // Two roots: the product leaves the range of binary16 at exponents of 255.
        let peak = (nu.0.plus(1.0).sqrt() * nv.0.plus(1.0).sqrt()).times(1.0 / (8.0 * PI));
        Self { f0, nu, nv, fresnel: Schlick::new(f0), peak }
    }

    /// The isotropic lobe, `nu = nv = q`.
    #[inline(always)]
    pub fn isotropic(f0: Rgb<R>, q: Shininess<R>) -> Self {
        Self::new(f0, q, q)
    }

    /// The whole model of the paper: this lobe and the diffuse one that its Fresnel term leaves room for.
    #[inline(always)]
    pub fn with_diffuse(self, albedo: Rgb<R>) -> super::Sum<Self, AshikhminShirleyDiffuse<R>> {
        self + AshikhminShirleyDiffuse::new(albedo, self.f0)
    }

    /// The reflectance at normal incidence.
    #[inline(always)]
    pub fn f0(&self) -> Rgb<R> {
        self.f0
    }

    /// The exponents `nu` and `nv`.
    #[inline(always)]
    pub fn shininess(&self) -> (Shininess<R>, Shininess<R>) {
        (self.nu, self.nv)
    }

    /// The same lobe in another number type, its factor computed anew there.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> AshikhminShirley<S> {
        AshikhminShirley::new(self.f0.map(&f), self.nu.map(&f), self.nv.map(&f))
    }

    /// `F · value(peak (n·h)^e, weight/max(n·l, n·v), l·h)`, with one division for both quotients of the exponent. (One for the
    /// cosines and for what Schlick's form takes would leave the range at the horizon.)
    #[inline(always)]
    fn lobe(&self, l: Vec3<R>, v: Vec3<R>, weight: R, value: impl Fn(R, R, R) -> R) -> Rgb<R> {
        let s = (l + v) * l.z.lift(R::COSINE_SCALE);
        let (x2, y2, z2) = (s.x.squared(), s.y.squared(), s.z.squared().off_zero());
        let sin2 = x2 + y2;
        // The mean of the exponents along h. At h = n it is 0/0, and any value will do, since sin² is 0: with the
        // smallest normal number in its place it is 0/tiny. Each share first: a square times an exponent may leave the range.
        let inverse = sin2.max(sin2.lift(R::MIN_POSITIVE)).recip();
        let exponent = self.nu.0.mul_add(x2 * inverse, self.nv.0 * (y2 * inverse));
        let power = half_vector_power(sin2, z2, exponent, both_above(l, v));
        // |l + v|/2; of rounded unit vectors it may exceed 1.
        let cos_d = (sin2 + z2).sqrt().times(0.5 / R::COSINE_SCALE).min(sin2.lift(1.0));
        let (incidence, share) = (Incidence::halfway(l, v, cos_d), weight / l.z.max(v.z));
        let power = self.peak * power;
        // A zero is kept: what it would be divided by may be 0 at the horizon.
        let value = R::select(power.eq(power.lift(0.0)), power, value(power, share, cos_d));
        self.fresnel.fresnel(incidence) * keep_nan(l, v, value)
    }
}

impl<R: Real> Brdf<R> for AshikhminShirley<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        // One after the other: the product of two cosines of 1e-20 underflows.
        self.lobe(
            l,
            v,
            l.z.lift(1.0),
            #[inline(always)]
            |power, share, cos_d| power * share / cos_d,
        )
    }

    /// `(n·l)/max(n·l, n·v) ≤ 1` is finite; what is left of the denominator is `l·h`.
    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.lobe(
            l,
            v,
            l.z,
            // The quotient first: both are as small as cosines, and what a share of 1e-18 leaves of the power is 0 (test
            // `a_share_next_to_nothing_is_kept`). Without the bound a pixel at the horizon is infinite, and the mean of
            // its neighbours too (test `bounded_at_the_horizon`).
            #[inline(always)]
            |power, share, cos_d| (power * (share / cos_d)).min(power.lift((1u128 << 127) as f64)),
        )
    }
}

/// The diffuse lobe: `f_r = 28/(23π) ρ (1 − f0) (1 − (1 − (n·l)/2)⁵) (1 − (1 − (n·v)/2)⁵)` sr⁻¹.
///
/// Ashikhmin and Shirley 2000, equation 5: what is left where [`AshikhminShirley`] reflects more, so that the sum
/// conserves energy, and is reciprocal.
///
/// Reciprocal to the last bit. Domain: `ρ, f0 ∈ [0, 1]`. At most 20 roundings: a relative error of `20·2⁻²⁴`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AshikhminShirleyDiffuse<R = f32> {
    albedo: Rgb<R>,
    f0: Rgb<R>,
    /// `28/(23π) ρ (1 − f0)`.
    factor: Rgb<R>,
}

carry!([] AshikhminShirleyDiffuse<f32> => AshikhminShirleyDiffuse<S> { albedo, f0, factor });

impl<R: Real> AshikhminShirleyDiffuse<R> {
    /// The diffuse lobe `ρ` beneath a surface that reflects `f0`.
    #[inline(always)]
    pub fn new(albedo: Rgb<R>, f0: Rgb<R>) -> Self {
        let transmitted = f0.map(
            #[inline(always)]
            |f| f.lift(1.0) - f,
        );
        Self { albedo, f0, factor: albedo * transmitted * albedo.r.lift(28.0 / (23.0 * PI)) }
    }

    /// `ρ`, of which the factor `1 − f0` is not yet taken.
    #[inline(always)]
    pub fn albedo(&self) -> Rgb<R> {
        self.albedo
    }

    /// The same lobe in another number type.
    #[inline(always)]
    pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> AshikhminShirleyDiffuse<S> {
        AshikhminShirleyDiffuse::new(self.albedo.map(&f), self.f0.map(&f))
    }
}

/// `1 − (1 − c/2)⁵` as `c/2 · (1 + y + y² + y³ + y⁴)` with `y = 1 − c/2`: nothing cancels at the horizon.
#[inline(always)]
fn let_in<R: Real>(cos: R) -> R {
    let x = cos.times(0.5);
    let y = x.lift(1.0) - x;
    let y2 = y.squared();
    x * ((y + y2.squared()) + (y2 + y2 * y).plus(1.0))
}

impl<R: Real> Brdf<R> for AshikhminShirleyDiffuse<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.factor * above_horizon(l, v, let_in(l.z) * let_in(v.z))
    }
}
