//! What the samplers of single lobes share: the trait [`Draw`], from which [`Sample`](crate::Sample) follows, and a few
//! maps.

use crate::Sampled;
use crate::map::azimuth;
use core::f64::consts::LN_2;
use lobe::{Brdf, Real, Rgb, Vec3};

/// What is particular to the sampler of a lobe. The horizon and NaN are the same for all: [`sample`], [`pdf`].
pub(crate) trait Draw<R: Real>: Brdf<R> {
    /// A unit vector, finite for each `u` in `[0, 1)³` and each unit vector `v`.
    fn direction(&self, v: Vec3<R>, u: [R; 3]) -> Vec3<R>;
    /// The density of `l` in sr⁻¹, where both directions are above the horizon; elsewhere it is not used.
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R;
    /// `f_r (n·l)/pdf`, with what both have in common cancelled; `pdf` is that of [`density`](Self::density), above 0.
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, pdf: R) -> Rgb<R>;
    /// About the albedo at `v`, above the horizon, as luminance.
    fn guess(&self, v: Vec3<R>) -> R;
}

/// [`Sample`](crate::Sample) for lobes that [`Draw`].
macro_rules! sample_by_drawing {
    ($([$($generics:tt)*] $lobe:ty;)+) => {$(
        impl<R: ::lobe::Real $($generics)*> $crate::Sample<R> for $lobe {
            #[inline(always)]
            fn sample(&self, v: ::lobe::Vec3<R>, u: [R; 3]) -> $crate::Sampled<R> {
                $crate::draw::sample(self, v, u)
            }
            #[inline(always)]
            fn pdf(&self, l: ::lobe::Vec3<R>, v: ::lobe::Vec3<R>) -> R {
                $crate::draw::pdf(self, l, v)
            }
            #[inline(always)]
            fn eval_cos_pdf(&self, l: ::lobe::Vec3<R>, v: ::lobe::Vec3<R>) -> (::lobe::Rgb<R>, R) {
                (::lobe::Brdf::eval_cos(self, l, v), $crate::draw::pdf(self, l, v))
            }
            #[inline(always)]
            fn albedo_guess(&self, v: ::lobe::Vec3<R>) -> R {
                let z = v.z.max(v.z.lift(0.0)).min(v.z.lift(1.0));
                $crate::draw::Draw::guess(self, ::lobe::Vec3::new(v.x, v.y, z))
            }
        }
    )+};
}
pub(crate) use sample_by_drawing;

/// The sample: rejected where either direction is not above the horizon, and where the density is 0, which for some
/// lobes it is for the last numbers before 1. So what is not rejected has a density above 0.
#[inline(always)]
pub(crate) fn sample<R: Real, B: Draw<R>>(lobe: &B, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
    let l = lobe.direction(v, u);
    let density = lobe.density(l, v);
    let weight = lobe.weight(l, v, density);
    // NaN in any of them must show; of numbers 0 is added, and compared with.
    let [a, b, c] = u;
    let nan = ((a + b + c) + (l.x + l.y + l.z) + (v.x + v.y + v.z)).times(0.0);
    let rejected = l.z.le(nan) | v.z.le(nan) | density.le(nan);
    Sampled::new(l, weight + Rgb::splat(nan), density + nan, rejected)
}

/// The density, 0 where either direction is not above the horizon, NaN where one holds a NaN.
#[inline(always)]
pub(crate) fn pdf<R: Real, B: Draw<R>>(lobe: &B, l: Vec3<R>, v: Vec3<R>) -> R {
    let s = l + v;
    let (zero, nan) = (l.z.lift(0.0), (s.x + s.y + s.z).times(0.0));
    R::select(l.z.le(zero) | v.z.le(zero), zero, lobe.density(l, v)) + nan
}

/// The mirror direction of `v`.
#[inline(always)]
pub(crate) fn mirrored<R: Real>(v: Vec3<R>) -> Vec3<R> {
    Vec3::new(-v.x, -v.y, v.z)
}

/// The direction of light for a facet of the unit normal `h`: `2 (v·h) h − v`. Above the horizon only for `v·h > 0`, if
/// `h` is.
#[inline(always)]
pub(crate) fn by_facet<R: Real>(h: Vec3<R>, v: Vec3<R>) -> Vec3<R> {
    h * h.dot(v).times(2.0) - v
}

/// `s = l + v` by [`Real::SCALE`], and `|s|` by as much: grazing cosines of 1e-20 have squares below the range of
/// `f32`.
#[inline(always)]
pub(crate) fn scaled_sum<R: Real>(l: Vec3<R>, v: Vec3<R>) -> (Vec3<R>, R) {
    let s = (l + v) * l.z.lift(R::SCALE);
    (s, s.length_squared().sqrt())
}

/// The unit vector with the angle to `+z` that has `1 − cos = t`, and the azimuth `2π y`.
#[inline(always)]
pub(crate) fn tilted<R: Real>(t: R, y: R) -> Vec3<R> {
    let (sin_phi, cos_phi) = azimuth(y);
    let sin = (t * (t.lift(2.0) - t)).sqrt();
    Vec3::new(sin * cos_phi, sin * sin_phi, t.lift(1.0) - t)
}

/// `ln(1 − x)`, not above 0.
#[inline(always)]
pub(crate) fn ln_complement<R: Real>(x: R) -> R {
    (-x).log2_1p().times(LN_2)
}

/// `(e^x − 1)/x`, 1 at 0: by Taylor's series between −1/2 and 1/2, within `4u`.
#[inline(always)]
pub(crate) fn exp_m1_by<R: Real>(x: R) -> R {
    let one = x.lift(1.0);
    let mut series = one;
    // Thirteen terms leave 1e-15 at 1/2.
    for n in (2..=13).rev() {
        series = series * x.times(1.0 / f64::from(n)) + one;
    }
    let small = x.abs().lt(x.lift(0.5));
    R::select(small, series, x.exp().plus(-1.0) / R::select(small, one, x))
}

/// `ln(1 + x)/x` for `x > −1`, 1 at 0.
#[inline(always)]
pub(crate) fn ln_1p_by<R: Real>(x: R) -> R {
    let (one, flat) = (x.lift(1.0), x.eq(x.lift(0.0)));
    let safe = R::select(flat, one, x);
    R::select(flat, one, safe.log2_1p().times(LN_2) / safe)
}

/// `c · π`, for weights of what is sampled by the cosine: `f_r (n·l)/((n·l)/π)`.
#[inline(always)]
pub(crate) fn times_pi<R: Real>(c: Rgb<R>) -> Rgb<R> {
    c.map(
        #[inline(always)]
        |c| c.times(core::f64::consts::PI),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quotients_are_smooth_through_zero() {
        for x in [-30.0_f64, -0.6, -0.5, -0.49, -1e-9, 0.0, 1e-300, 0.3, 0.499, 0.5, 3.0] {
            let exact = if x == 0.0 { 1.0 } else { x.exp_m1() / x };
            assert!((exp_m1_by(x) / exact - 1.0).abs() < 2e-15, "{x}");
            let single = f64::from(exp_m1_by(x as f32));
            assert!((single / exact - 1.0).abs() < 4e-7, "{x}: {single}");
        }
        for x in [-0.999_f64, -0.5, -1e-9, 0.0, 1e-300, 0.3, 1e7] {
            let exact = if x == 0.0 { 1.0 } else { x.ln_1p() / x };
            assert!((ln_1p_by(x) / exact - 1.0).abs() < 2e-15, "{x}");
        }
    }
}
