//! Facets in proportion to their projected area, `D (n·h)`, for every distribution.

use super::{Bounded, Facets, VisibleSlopes};
use crate::map::{azimuth, cosine_hemisphere};
use crate::special::{exp_m1, exp_m1_by, ln_1p_by, ln_complement};
use core::f64::consts::{FRAC_PI_2, PI};
use lobe::distribution::{
    Beckmann, Distribution, Gaussian, Ggx, GgxAnisotropic, Gtr, PhongPower, SmithTable, StudentT, Tabulated,
};
use lobe::{Alpha, Facet, Real, Vec3};

/// A distribution of which facets can be drawn without a look at the viewer.
pub trait SampleNormals<R: Real>: Distribution<R> + Sized {
    /// How facets are drawn for a viewer, if nobody says otherwise.
    type Method: Facets<R, Self> + Default;

    /// The unit normal of a facet, from two numbers of `[0, 1)`, with the density `D(h)/normal_area(h)` sr⁻¹.
    fn sample_normal(&self, u: [R; 2]) -> Vec3<R>;

    /// `D(h)/pdf(h)` for a unit vector above the horizon: `1/(n·h)` where the inversion is exact.
    #[inline(always)]
    fn normal_area(&self, h: Vec3<R>) -> R {
        h.z.recip()
    }

    /// The density of `h` in sr⁻¹, where `D(h)` is `d`.
    #[inline(always)]
    fn normal_pdf(&self, h: Vec3<R>, d: R) -> R {
        d / self.normal_area(h)
    }
}

/// Facets by the distribution alone, `D (n·h)`, whether they are seen or not: density of the light `D (n·h)/(4 l·h)`.
///
/// For every distribution; Walter et al. 2007, equations 35 to 41. Towards grazing views most facets drawn are hidden
/// and the weights `F G (l·h)/((n·v)(n·h))` grow without bound.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ByDistribution;

impl<R: Real, D: SampleNormals<R>> Facets<R, D> for ByDistribution {
    #[inline(always)]
    fn normal(&self, distribution: &D, _: Vec3<R>, u: [R; 2]) -> Vec3<R> {
        distribution.sample_normal(u)
    }

    #[inline(always)]
    fn area(&self, distribution: &D, _: Vec3<R>, facet: &Facet<R>) -> R {
        facet.cos().times(4.0) * distribution.normal_area(facet.normal())
    }

    #[inline(always)]
    fn pdf(&self, distribution: &D, _: Vec3<R>, facet: &Facet<R>, d: R) -> R {
        distribution.normal_pdf(facet.normal(), d) / facet.cos().times(4.0)
    }
}

/// The normal of a facet with these slopes.
#[inline(always)]
fn of_slopes<R: Real>(x: R, y: R) -> Vec3<R> {
    Vec3::new(x, y, x.lift(1.0)).normalize()
}

/// The direction at the azimuth `2π x` of an ellipse with the half axes `αx`, `αy`: its points, and its square radius
/// there.
#[inline(always)]
fn ellipse<R: Real>((x, y): (Alpha<R>, Alpha<R>), turn: R) -> (R, R, R) {
    let (sin, cos) = azimuth(turn);
    let (x, y) = (x.0 * cos, y.0 * sin);
    (x, y, x.squared() + y.squared())
}

/// `−ln(1 − u)`: 0 at 0, and 16.6 at the last `f32` before 1.
#[inline(always)]
fn exponential<R: Real>(u: R) -> R {
    -ln_complement(u)
}

impl<R: Real> SampleNormals<R> for Ggx<R> {
    type Method = Bounded;
    /// A point of the cosine hemisphere, stretched: `tan θ = α √(u/(1 − u))` (Walter et al. 2007, equation 35).
    #[inline(always)]
    fn sample_normal(&self, u: [R; 2]) -> Vec3<R> {
        let (m, alpha) = (cosine_hemisphere(u), self.alpha().0);
        Vec3::new(m.x * alpha, m.y * alpha, m.z).normalize()
    }
}

impl<R: Real> SampleNormals<R> for GgxAnisotropic<R> {
    type Method = Bounded;
    #[inline(always)]
    fn sample_normal(&self, u: [R; 2]) -> Vec3<R> {
        let (m, (x, y)) = (cosine_hemisphere(u), self.alpha());
        Vec3::new(m.x * x.0, m.y * y.0, m.z).normalize()
    }
}

impl<R: Real> SampleNormals<R> for Beckmann<R> {
    type Method = VisibleSlopes;
    /// `tan² θ = −α² ln(1 − u)` (Walter et al. 2007, equation 28).
    #[inline(always)]
    fn sample_normal(&self, [x, y]: [R; 2]) -> Vec3<R> {
        let (slope_x, slope_y, _) = ellipse(self.alpha(), x);
        let r = exponential(y).sqrt();
        of_slopes(slope_x * r, slope_y * r)
    }
}

impl<R: Real> SampleNormals<R> for StudentT<R> {
    type Method = ByDistribution;
    /// `tan² θ = α² (γ − 1)((1 − u)^(−1/(γ − 1)) − 1)`, by inversion of the slopes' distribution.
    #[inline(always)]
    fn sample_normal(&self, [x, y]: [R; 2]) -> Vec3<R> {
        let (slope_x, slope_y, _) = ellipse(self.alpha(), x);
        let degrees = self.gamma().plus(-1.0);
        let r = (degrees * exp_m1(exponential(y) / degrees)).sqrt();
        of_slopes(slope_x * r, slope_y * r)
    }
}

impl<R: Real> SampleNormals<R> for PhongPower<R> {
    type Method = ByDistribution;
    /// `cos² θ = (1 − u)^(α²)`, which is `(1 − u)^(2/(q + 2))`, with `α` that of the azimuth (Ashikhmin and Shirley
    /// 2000, equations 9 and 10, over the whole turn).
    ///
    /// As a slope, `tan² θ = (1 − u)^(−α²) − 1`, so that a sharp lobe keeps its digits.
    #[inline(always)]
    fn sample_normal(&self, [x, y]: [R; 2]) -> Vec3<R> {
        let (slope_x, slope_y, alpha2) = ellipse(self.alpha(), x);
        let tan2 = exp_m1(exponential(y) * alpha2);
        let r = (tan2 / alpha2).sqrt();
        of_slopes(slope_x * r, slope_y * r)
    }
}

/// `1/α² = cos² φ/αx² + sin² φ/αy²` at the azimuth of `h`, as `α²`; of the normal itself, which has none, `αx²`.
#[inline(always)]
fn width_at<R: Real>((x, y): (Alpha<R>, Alpha<R>), h: Vec3<R>) -> R {
    // Scaled, so that the squares of facets within 1e-28 of the normal are not 0.
    let scale = h.x.lift(R::ROOT_SCALE);
    let (across, along) = (h.x * scale, h.y * scale);
    let r2 = across.squared() + along.squared();
    let stretched = (across / x.0).squared() + (along / y.0).squared();
    let normal = r2.le(r2.lift(R::MIN_POSITIVE));
    R::select(normal, x.0.squared(), r2 / R::select(normal, r2.lift(1.0), stretched))
}

/// `(1 − A^(γ − 1))/(γ − 1)` for `A = α²`, as `−ln A φ((γ − 1) ln A)` with `φ(x) = (eˣ − 1)/x`, which has the limit
/// `γ = 1` in it.
#[inline(always)]
fn gtr_terms<R: Real>(a2: R, gamma: R) -> R {
    // 1 − A is exact from 1/2 on, and there the logarithm of a number near 1 is to its last digits.
    let log = -a2.ln();
    let x = -(gamma.plus(-1.0) * log);
    log * exp_m1_by(x)
}

impl<R: Real> SampleNormals<R> for Gtr<R> {
    type Method = ByDistribution;
    /// With `A = α²` and `y = 1 + sin² θ (1/A − 1)`, `y^(1 − γ)` is even between 1 and `A^(γ − 1)` (Burley 2012,
    /// appendix B, equation 9; for `γ = 1` its limit, `ln y` even).
    ///
    /// In a form that has the limit in it: `ln y = w ln(1 + x)/x`, `w = u (1 − A^(γ − 1))/(γ − 1)`, `x = −(γ − 1) w`.
    #[inline(always)]
    fn sample_normal(&self, [turn, u]: [R; 2]) -> Vec3<R> {
        let (ax, ay, a2) = ellipse(self.alpha(), turn);
        let one = a2.lift(1.0);
        let w = u * gtr_terms(a2, self.gamma());
        let x = -(self.gamma().plus(-1.0) * w);
        let log = w * ln_1p_by(x);
        // At α = 1 the facets are as even as the cosine.
        let round = a2.eq(one);
        let sin2 = R::select(round, u, exp_m1(log) * (a2 / R::select(round, one, one - a2)));
        // Rounding may take it beyond 1 at the horizon.
        let sin2 = sin2.min(one);
        let r = (sin2 / a2).sqrt();
        Vec3::new(ax * r, ay * r, (one - sin2).sqrt())
    }

    /// With two widths the azimuth is drawn as that of an ellipse, and the factor between its distribution and that of
    /// the facets is here; with one it is 1.
    #[inline(always)]
    fn normal_area(&self, h: Vec3<R>) -> R {
        let (x, y) = self.alpha();
        let a2 = width_at((x, y), h);
        let one = a2.lift(1.0);
        let round = a2.eq(one);
        // 1/(π A k) of the isotropic distribution of the width of this azimuth.
        let area = R::select(round, one, gtr_terms(a2, self.gamma()) / R::select(round, one, one - a2));
        self.peak().times(PI) * x.0 * y.0 * area / h.z
    }
}

impl<R: Real> SampleNormals<R> for Gaussian<R> {
    type Method = ByDistribution;
    /// The angle as that of a plane Gaussian which ends at 90°: `δ² = −α² ln(1 − u (1 − exp(−(π/2α)²)))`.
    ///
    /// It has `2δ` in place of `sin 2δ`, which has no inverse in closed form.
    #[inline(always)]
    fn sample_normal(&self, [turn, u]: [R; 2]) -> Vec3<R> {
        let (x, y, a2) = ellipse(self.alpha(), turn);
        let angle = (a2 * exponential(u * inside(a2))).sqrt();
        let (sin, cos) = angle.min(angle.lift(FRAC_PI_2)).sin_cos();
        let scale = sin / a2.sqrt();
        // Rounded, the cosine of a right angle may be below 0.
        Vec3::new(x * scale, y * scale, cos.max(cos.lift(0.0)))
    }

    /// `π αx αy k (1 − exp(−(π/2α)²)) sin δ/δ`: at most the value at the normal, and 2/π of it at the horizon.
    #[inline(always)]
    fn normal_area(&self, h: Vec3<R>) -> R {
        let (x, y) = self.alpha();
        let sin = (h.x.squared() + h.y.squared()).sqrt();
        let angle = sin.atan2(h.z);
        let normal = angle.eq(angle.lift(0.0));
        let ratio = R::select(normal, sin.lift(1.0), sin / R::select(normal, sin.lift(1.0), angle));
        self.peak().times(PI) * x.0 * y.0 * inside(width_at((x, y), h)) * ratio
    }
}

/// `1 − exp(−(π/2α)²)`: the part of a plane Gaussian within a right angle.
#[inline(always)]
fn inside<R: Real>(a2: R) -> R {
    a2.lift(1.0) - (a2.lift(-FRAC_PI_2 * FRAC_PI_2) / a2).exp()
}

/// The squares of the sines of the nodes of a table, one after the other, by
/// `cos (i + 1)x = 2 cos x cos ix − cos (i − 1)x`.
#[inline(always)]
fn squared_sines(count: usize) -> impl Iterator<Item = f64> {
    let double = 2.0 * libm::cos(PI / (count - 1) as f64);
    (0..count).scan(
        (1.0, 0.5 * double),
        #[inline(always)]
        move |(cos, next), _| {
            let sin2 = 0.5 - 0.5 * *cos;
            (*cos, *next) = (*next, double * *next - *cos);
            Some(sin2)
        },
    )
}

/// Calls `f` with the start in `sin² θ`, the length and the height of each step between two nodes.
///
/// The height is the mean of both values and 1/1024 of the mean of all: without that a step without facets beside one
/// with some would have the density 0 for a facet at their border that rounds the wrong way, and its weight would be
/// infinite.
#[inline(always)]
fn steps<R: Real, const N: usize>(table: &Tabulated<R, N>, mut f: impl FnMut(f64, f64, R)) {
    let values = table.values();
    // ∫ D (n·h) dω = 1 means that the mean over sin² θ is 1/π.
    const FLOOR: f64 = 1.0 / (1024.0 * PI);
    let ends = squared_sines(N).zip(squared_sines(N).skip(1));
    for ((&a, &b), (from, to)) in values.iter().zip(values.iter().skip(1)).zip(ends) {
        f(from, to - from, (a + b).times(0.5).plus(FLOOR));
    }
}

/// The sum of all steps.
#[inline(always)]
fn total<R: Real, const N: usize>(table: &Tabulated<R, N>, witness: R) -> R {
    let mut sum = witness.lift(0.0);
    steps(
        table,
        #[inline(always)]
        |_, length, height| sum = sum + height.times(length),
    );
    sum
}

impl<R: Real, const N: usize> SampleNormals<R> for Tabulated<R, N> {
    type Method = ByDistribution;
    /// By a step function of `sin² θ` with the mean of the values at both ends. The sum goes over all steps, of which
    /// one is selected: nothing is indexed by a value.
    #[inline(always)]
    fn sample_normal(&self, [turn, u]: [R; 2]) -> Vec3<R> {
        let (zero, one) = (u.lift(0.0), u.lift(1.0));
        let target = u * total(self, u);
        let (mut below, mut sin2) = (zero, zero);
        steps(
            self,
            #[inline(always)]
            |from, length, height| {
                let at = (target - below) / height;
                sin2 = R::select(below.le(target), at.min(u.lift(length)).plus(from), sin2);
                below = below + height.times(length);
            },
        );
        let (sin, cos) = azimuth(turn);
        let r = sin2.sqrt();
        // A NaN in the azimuth shows by itself; one in `u` has selected nothing.
        let nan = u.times(0.0);
        Vec3::new(r * cos + nan, r * sin + nan, (one - sin2).max(zero).sqrt())
    }

    #[inline(always)]
    fn normal_area(&self, h: Vec3<R>) -> R {
        self.d(h) / self.normal_pdf(h, h.z)
    }

    /// The height of the step at `h`, whether or not `D` is 0 there.
    #[inline(always)]
    fn normal_pdf(&self, h: Vec3<R>, _: R) -> R {
        let sin2 = h.x.squared() + h.y.squared();
        let mut density = sin2;
        steps(
            self,
            #[inline(always)]
            |from, _, height| density = R::select(sin2.ge(sin2.lift(from)), height, density),
        );
        density * h.z / total(self, sin2).times(PI)
    }
}

impl<R: Real, D: SampleNormals<R>, const N: usize> SampleNormals<R> for SmithTable<D, R, N> {
    type Method = ByDistribution;
    #[inline(always)]
    fn sample_normal(&self, u: [R; 2]) -> Vec3<R> {
        self.distribution().sample_normal(u)
    }
    #[inline(always)]
    fn normal_area(&self, h: Vec3<R>) -> R {
        self.distribution().normal_area(h)
    }
    /// That of the distribution: of one that is drawn where `D` is 0 the area is 0 there, and the quotient 0/0 (lobe
    /// `tabulated, smith` of the tests).
    #[inline(always)]
    fn normal_pdf(&self, h: Vec3<R>, d: R) -> R {
        self.distribution().normal_pdf(h, d)
    }
}
