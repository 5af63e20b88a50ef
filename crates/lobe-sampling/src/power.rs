//! Power lobes: around the mirror direction, around an axis of their own, and of half vectors.
//!
//! With `1 − cos θ = −expm1(ln(1 − u)/(q + 1))` the angle of a lobe of any exponent has all its digits; the cosine
//! itself, near 1, has lost them at `q = 10⁶`. The density is that of the direction as it was rounded: a unit in the
//! last place of the direction moves it by `√q u` and more down the lobe, but the weight, from which the lobe has
//! cancelled, by `u`.

use crate::draw::{Draw, mirrored, sample_by_drawing, scaled_sum, tilted};
use crate::map::{azimuth, cosine_hemisphere};
use crate::rules::by_facet;
use crate::special::{exp_m1, ln_complement};
use core::f64::consts::{FRAC_1_PI, PI, TAU};
use lobe::fresnel::{Fresnel, Incidence, Schlick};
use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::{
    AshikhminShirley, AshikhminShirleyDiffuse, BlinnPhong, Brdf, Frame, Lafortune, Minnaert, Normalization, Phong,
    Real, Rgb, Vec3,
};

/// The hemisphere around `+z` with the density `(q + 1)/2π cos^q`, `q ≥ 0`.
#[inline(always)]
fn power_hemisphere<R: Real>(q: R, x: R, y: R) -> Vec3<R> {
    tilted(fall(ln_complement(x), q.plus(1.0).recip()), y)
}

/// `1 − e^(log share)`, at least 0.
#[inline(always)]
fn fall<R: Real>(log: R, share: R) -> R {
    -exp_m1(log * share)
}

/// The same around another axis.
#[inline(always)]
fn power_around<R: Real>(axis: Vec3<R>, q: R, x: R, y: R) -> Vec3<R> {
    Frame::from_normal(axis).to_world(power_hemisphere(q, x, y))
}

/// `(q + 1)/2π (a·l)^q`, from the distance of both; 0 beyond a right angle.
#[inline(always)]
fn power_density<R: Real>(l: Vec3<R>, axis: Vec3<R>, q: R) -> R {
    let one_minus_cos = (l - axis).length_squared().times(0.5);
    let power = (q * (-one_minus_cos).log2_1p_div(q.lift(1.0))).exp2_where(one_minus_cos.lt(q.lift(1.0)));
    q.plus(1.0).times(1.0 / TAU) * power + q.times(0.0)
}

/// `(n·h)^q/π`.
#[inline(always)]
fn half_vector_power<R: Real>(l: Vec3<R>, v: Vec3<R>, q: R) -> R {
    BlinnTorranceHighlight::new(Rgb::splat(q.lift(1.0)), lobe::Shininess(q)).eval_cos(l, v).r
}

/// About the mean of `n·l` over a lobe of this exponent whose axis has the cosine `z`: `z`, and at the horizon the half
/// of the width.
#[inline(always)]
fn mean_cosine<R: Real>(z: R, q: R) -> R {
    z.max(q.plus(1.0).sqrt().recip().times(0.5))
}

/// By its own power around the mirror direction: the weight is `ks (q + 2)/(q + 1) (n·l)`.
///
/// The part of the lobe below the horizon is rejected: none at the normal of a sharp lobe, half of it at grazing views.
impl<R: Real> Draw<R> for Phong<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        power_around(mirrored(v), self.shininess().0, x, y)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        power_density(l, mirrored(v), self.shininess().0)
    }
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, _: Vec3<R>, _: R) -> Rgb<R> {
        let q = self.shininess().0;
        self.ks() * (q.plus(2.0) / q.plus(1.0) * l.z)
    }
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        self.ks().luminance() * mean_cosine(v.z, self.shininess().0)
    }
}

/// By its own power around the mirror direction: the weight is `2 ks/(q + 1)`.
impl<R: Real> Draw<R> for PhongHighlight<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        power_around(mirrored(v), self.shininess().0, x, y)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        power_density(l, mirrored(v), self.shininess().0)
    }
    #[inline(always)]
    fn weight(&self, _: Vec3<R>, _: Vec3<R>, _: R) -> Rgb<R> {
        let q = self.shininess().0;
        self.ks() * (q.lift(2.0) / q.plus(1.0))
    }
    /// Of the lobe from a half, at the horizon, to all is above it.
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        self.ks().luminance() * (v.z.plus(1.0) / self.shininess().0.plus(1.0))
    }
}

/// By `h` with the density `(q + 2)/2π (n·h)^(q+1)`: the weight is `ks N 4π/(q + 2) |l + v|² (n·l)/(n·l + n·v)`,
/// bounded.
///
/// With `(n·h)^q` the weight is bounded too, but at the normal it is `(n·h)` times as much: more variance for a wide
/// lobe.
impl<R: Real, N: Normalization> Draw<R> for BlinnPhong<R, N> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        by_facet(power_hemisphere(self.shininess().0.plus(1.0), x, y), v)
    }
    /// `(q + 2)/2π (n·h)^(q+1)/(4 l·h)`, `l·h = |l + v|/2`.
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let (q, (_, length)) = (self.shininess().0, scaled_sum(l, v));
        half_vector_power(l, v, q.plus(1.0)) * q.plus(2.0) * (q.lift(0.25 * R::SCALE) / length)
    }
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, _: R) -> Rgb<R> {
        let q = self.shininess().0;
        let factor = N::factor(q).times(4.0 * PI) / q.plus(2.0);
        self.ks() * (factor * (l + v).length_squared() * (l.z / (l.z + v.z)))
    }
    /// A sharp lobe has `N 8π/(q + 2) cos²θ`.
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let q = self.shininess().0;
        let peak = N::factor(q).times(8.0 * PI) / q.plus(2.0);
        self.ks().luminance() * peak * mean_cosine(v.z, q).squared()
    }
}

/// By `h` with the density `(q + 1)/2π (n·h)^q`: the weight is `8 ks (l·h)/(q + 1)`.
///
/// With another factor `n·h` in the density it would be divided by `n·h`, without bound.
impl<R: Real> Draw<R> for BlinnTorranceHighlight<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        by_facet(power_hemisphere(self.shininess().0, x, y), v)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let (q, (_, length)) = (self.shininess().0, scaled_sum(l, v));
        half_vector_power(l, v, q) * q.plus(1.0) * (q.lift(0.25 * R::SCALE) / length)
    }
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, _: R) -> Rgb<R> {
        let length = scaled_sum(l, v).1;
        self.ks() * (length.times(4.0 / R::SCALE) / self.shininess().0.plus(1.0))
    }
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let q = self.shininess().0;
        self.ks().luminance() * (mean_cosine(v.z, q).times(8.0) / q.plus(2.0))
    }
}

/// By `h` with the density `√((nu+1)(nv+1))/2π (n·h)^e`, `e = nu cos²φ + nv sin²φ`: the weight is `F (n·l)/max(n·l,
/// n·v)`, at most 1.
///
/// Ashikhmin and Shirley, "An Anisotropic Phong BRDF Model", JGT 5(2), 2000. The azimuth, there `tan φ =
/// √((nu+1)/(nv+1)) tan(πu/2)` in the first quadrant and turned into the others, is here that of `(cos ψ/√(nu+1), sin
/// ψ/√(nv+1))` with `ψ = 2πu`: the same in all four, and without a tangent that is infinite. The square of that vector
/// is `1/(e + 1)`.
impl<R: Real> Draw<R> for AshikhminShirley<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        let (nu, nv) = self.shininess();
        let (sin, cos) = azimuth(y);
        let (a, b) = (cos / nu.0.plus(1.0).sqrt(), sin / nv.0.plus(1.0).sqrt());
        let square = a.squared() + b.squared();
        let t = fall(ln_complement(x), square);
        let along = (t * (t.lift(2.0) - t) / square).sqrt();
        by_facet(Vec3::new(a * along, b * along, t.lift(1.0) - t), v)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let ((nu, nv), (s, length)) = (self.shininess(), scaled_sum(l, v));
        let (x2, y2) = (s.x.squared(), s.y.squared());
        // At h = n any mean of the exponents will do, since the power of 1 is 1; 0/0 would be NaN.
        let inverse = (x2 + y2).max(x2.lift(R::MIN_POSITIVE)).recip();
        // To the bit what the lobe has, so that the power is the same there.
        let exponent = nu.0.mul_add(x2 * inverse, nv.0 * (y2 * inverse));
        let peak = nu.0.plus(1.0).sqrt() * nv.0.plus(1.0).sqrt();
        half_vector_power(l, v, exponent) * peak * (x2.lift(0.25 * R::SCALE) / length)
    }
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, _: R) -> Rgb<R> {
        let length = scaled_sum(l, v).1;
        let cos = length.times(0.5 / R::SCALE).min(l.z.lift(1.0));
        let sin2 = (l - v).length_squared().times(0.25).min(l.z.lift(1.0));
        Schlick::new(self.f0()).fresnel(Incidence::new(cos, sin2)) * (l.z / l.z.max(v.z))
    }
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        Schlick::new(self.f0()).fresnel(Incidence::from_cos(v.z)).luminance()
    }
}

/// By the cosine: the weight is `28/23 ρ (1 − f0)` of what is let in both ways.
impl<R: Real> Draw<R> for AshikhminShirleyDiffuse<R> {
    /// The albedo itself: that of light along the normal is `31/32` let in, that of all light `23/28`.
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let zero = v.z.lift(0.0);
        let up = Vec3::new(zero, zero, v.z.lift(1.0));
        self.eval(up, v).luminance().times(PI * (23.0 / 28.0) * (32.0 / 31.0))
    }
}

/// By `(n·l)^k` around the normal, which is the lobe: every sample has the albedo, `ρ (n·v)^(k−1)`, for its weight.
impl<R: Real> Draw<R> for Minnaert<R> {
    #[inline(always)]
    fn direction(&self, _: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        power_hemisphere(self.k(), x, y)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, _: Vec3<R>) -> R {
        self.k().plus(1.0).times(1.0 / TAU) * l.z.pow(self.k())
    }
    #[inline(always)]
    fn weight(&self, _: Vec3<R>, v: Vec3<R>, _: R) -> Rgb<R> {
        self.albedo() * v.z.pow(self.k().plus(-1.0))
    }
    /// The albedo. Of the horizon itself that of 1e-20: beyond, it may be infinite.
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        self.albedo().luminance() * v.z.max(v.z.lift(1e-20)).pow(self.k().plus(-1.0))
    }
}

/// The lobe of a view: its axis, and what is known of it.
struct Lobe<R> {
    /// The unit vector along `(Cx v.x, Cy v.y, Cz v.z)`.
    axis: Vec3<R>,
    /// What [`Draw::weight`] is for the lobe's part of the density, without the cosine: `2π/(q + 1) ks N |C v|^q`.
    factor: Rgb<R>,
    /// The part of the samples that goes by the cosine.
    cosine: R,
}

/// What of the axis a view gives.
#[inline(always)]
fn lafortune<R: Real>(lobe: &Lafortune<R>, v: Vec3<R>) -> Lobe<R> {
    let (c, q, one) = (lobe.coefficients(), lobe.shininess().0, v.z.lift(1.0));
    let m = c.x.abs().max(c.y.abs()).max(c.z.abs()).max(one.lift(R::MIN_POSITIVE));
    let (x, y, z) = (c.x / m, c.y / m, c.z / m);
    let a = Vec3::new(x * v.x, y * v.y, z * v.z);
    // 1 − |a|², in which nothing cancels for unit vectors.
    let rest = |c: R, v: R| (one - c.abs()) * (one + c.abs()) * v.squared();
    let missing = rest(x, v.x) + rest(y, v.y) + rest(z, v.z);
    let half = q.times(0.5);
    // Near 1 from what is missing, elsewhere from the square: each is 0/0 where the other is not.
    let near = (half * (-missing.min(one.times(0.75))).log2_1p()).exp2();
    let power = R::select(missing.lt(one.times(0.5)), near, a.length_squared().pow(half));
    let zero = one.lift(0.0);
    let axis = a.normalize_or(Vec3::new(zero, zero, one));
    Lobe {
        axis,
        factor: lobe.peak() * (power * (one.lift(TAU) / q.plus(1.0))),
        cosine: R::select(axis.z.le(zero), one.times(0.5), zero),
    }
}

/// By its own power around the axis `(Cx v.x, Cy v.y, Cz v.z)`, on which every value depends as `(a·l)^q`: the weight
/// is `2π/(q + 1) ks N |C v|^q (n·l)`.
///
/// Lafortune, Foo, Torrance and Greenberg, "Non-Linear Approximation of Reflectance Functions", SIGGRAPH 1997. Where
/// the axis is not above the horizon, every second sample is by the cosine: without, most samples would be rejected,
/// all of a sharp lobe, while what is above the horizon has a value (test `an_axis_below_the_horizon`). Where the axis
/// vanishes, the lobe is sampled around the normal, and the value is 0.
impl<R: Real> Draw<R> for Lafortune<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [choice, x, y]: [R; 3]) -> Vec3<R> {
        let Lobe { axis, cosine, .. } = lafortune(self, v);
        let by_power = power_around(axis, self.shininess().0, x, y);
        Vec3::select(choice.lt(cosine), cosine_hemisphere([x, y]), by_power)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let Lobe { axis, cosine, .. } = lafortune(self, v);
        let lobe = power_density(l, axis, self.shininess().0);
        (lobe.lift(1.0) - cosine) * lobe + cosine * l.z.times(FRAC_1_PI)
    }
    /// The lobe's part of the density is computed as in it, so that its quotient is 1 where there is no other part.
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, pdf: R) -> Rgb<R> {
        let Lobe { axis, factor, .. } = lafortune(self, v);
        factor * (l.z * (power_density(l, axis, self.shininess().0) / pdf))
    }
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let Lobe { axis, factor, .. } = lafortune(self, v);
        factor.luminance() * mean_cosine(axis.z, self.shininess().0)
    }
}

sample_by_drawing! {
    [] Phong<R>;
    [] PhongHighlight<R>;
    [, N: Normalization] BlinnPhong<R, N>;
    [] BlinnTorranceHighlight<R>;
    [] AshikhminShirley<R>;
    [] AshikhminShirleyDiffuse<R>;
    [] Minnaert<R>;
    [] Lafortune<R>;
}
