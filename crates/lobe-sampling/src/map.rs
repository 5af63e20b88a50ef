//! Maps of the unit square onto what is to be sampled, and back.
//!
//! All are defined and finite for every `u` in `[0, 1)²`, 0 and the last number before 1 among them. What has a density
//! has it as a function beside the map.

use core::f64::consts::{FRAC_1_PI, FRAC_PI_4, PI, TAU};
use lobe::{Frame, Real, Vec3};

/// The disc of radius 1, evenly, from the square `[0, 1)²`: concentric, so that what is near in the square is near in
/// the disc.
///
/// Shirley and Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997. Density `1/π`.
#[inline(always)]
pub fn concentric_disc<R: Real>(u: [R; 2]) -> [R; 2] {
    let [x, y] = centred(u);
    let wide = y.abs().lt(x.abs());
    // The radius has the sign of the longer side, the angle goes from −45° to 45° around its axis.
    let radius = R::select(wide, x, y);
    let other = R::select(wide, y, x);
    // The middle of the square is the middle of the disc; 0/0 would be NaN.
    let safe = R::select(radius.eq(radius.lift(0.0)), radius.lift(1.0), radius);
    let (sin, cos) = sin_cos_pi((other / safe).times(0.25));
    [radius * R::select(wide, cos, sin), radius * R::select(wide, sin, cos)]
}

/// The way back from the disc: the `u` of which [`concentric_disc`] makes the point `(x, y)`.
///
/// In `f32` within 4e-7 of it, along the diagonals of the square too.
#[inline(always)]
pub fn concentric_disc_inverse<R: Real>([x, y]: [R; 2]) -> [R; 2] {
    let wide = y.abs().lt(x.abs());
    let (long, short) = (R::select(wide, x, y), R::select(wide, y, x));
    let radius = (x.squared() + y.squared()).sqrt().copysign(long);
    // The angle from the axis of the longer side, from −45° to 45°; of the middle it is 0.
    let angle = (short * long.lift(1.0).copysign(long)).atan2(long.abs());
    let other = radius * angle.times(1.0 / FRAC_PI_4);
    let half = |side: R| side.times(0.5).plus(0.5);
    [half(R::select(wide, radius, other)), half(R::select(wide, other, radius))]
}

/// The square from −1 to 1.
#[inline(always)]
fn centred<R: Real>(u: [R; 2]) -> [R; 2] {
    // Written out: `map` of an array stays a call where lanes are wide.
    let [x, y] = u;
    [x.times(2.0).plus(-1.0), y.times(2.0).plus(-1.0)]
}

/// The sine and the cosine of `πb`, for `b` from −1/2 to 1/2.
///
/// Minimax polynomials (`tools/minimax.py`; the first coefficient is π to 3e-15), within 4e-15, in `f32` within 2e-7. An azimuth
/// needs no more: 2e-7 is about what the components of a direction round off, and its weight and density are those of the
/// direction as it is.
#[inline(always)]
fn sin_cos_pi<R: Real>(b: R) -> (R, R) {
    let z = b.squared();
    let s = z.lift(-2.108569597959884e-5).mul_add(z, z.lift(0.00046594207538471585));
    let s = horner(z, s, [-0.0073703474717529557, 0.082145875597028313, -0.59926452849591818]);
    let s = horner(z, s, [2.5501640398445751, -5.1677127800493854, PI]);
    let c =
        horner(z, z.lift(-0.00010045783677301087), [0.0019279086098649712, -0.025806546326359239, 0.23533059102664743]);
    let c = horner(z, c, [-1.3352627664554753, 4.0587121263473691, -4.9348022005440002]);
    (s * b, c.mul_add(z, z.lift(1.0)))
}

/// `((p x + a) x + b) x + c`.
#[inline(always)]
fn horner<R: Real>(x: R, p: R, [a, b, c]: [f64; 3]) -> R {
    p.mul_add(x, x.lift(a)).mul_add(x, x.lift(b)).mul_add(x, x.lift(c))
}

/// The sine and the cosine of `2πu`, the azimuth of a number of `[0, 1]`, each within 4e-7 in `f32`.
///
/// Folded to a quarter of a turn by signs, in place of the three parts of π and the selects that an angle of any size needs.
#[inline(always)]
pub(crate) fn azimuth<R: Real>(u: R) -> (R, R) {
    // 2πu = π + πs; with b = |s| − 1/2 cos πs is −sin πb, and |sin πs| is cos πb.
    let s = u.times(2.0).plus(-1.0);
    let (cos, sin) = sin_cos_pi(s.abs().plus(-0.5));
    (sin.copysign(-s), cos)
}

/// The radius of the point that [`concentric_disc`] makes of `u`: the longer of both sides, without the rounding of a
/// root.
#[inline(always)]
fn radius_of_disc<R: Real>(u: [R; 2]) -> R {
    let [x, y] = centred(u);
    x.abs().max(y.abs())
}

/// The hemisphere around `+z`, in proportion to the cosine: `pdf = z/π` sr⁻¹.
///
/// Malley's way: what is evenly on the disc is so under the projection. With `z` from `(1 − x)(1 + x)` of the radius,
/// not from the difference of squares, so that the horizon keeps its digits.
#[inline(always)]
pub fn cosine_hemisphere<R: Real>(u: [R; 2]) -> Vec3<R> {
    let [x, y] = concentric_disc(u);
    let radius = radius_of_disc(u);
    let one = radius.lift(1.0);
    Vec3::new(x, y, ((one - radius) * (one + radius)).sqrt())
}

/// The density of [`cosine_hemisphere`], `z/π` sr⁻¹, and 0 below the horizon.
#[inline(always)]
pub fn cosine_hemisphere_pdf<R: Real>(l: Vec3<R>) -> R {
    l.z.max(l.z.lift(0.0)).times(FRAC_1_PI)
}

/// The `u` of which [`cosine_hemisphere`] makes the unit vector `l`.
#[inline(always)]
pub fn cosine_hemisphere_inverse<R: Real>(l: Vec3<R>) -> [R; 2] {
    concentric_disc_inverse([l.x, l.y])
}

/// The hemisphere around `+z`, evenly: `pdf = 1/2π` sr⁻¹.
#[inline(always)]
pub fn uniform_hemisphere<R: Real>(u: [R; 2]) -> Vec3<R> {
    let [x, _] = u;
    cap_around_z(u, x.lift(1.0))
}

/// The density of [`uniform_hemisphere`], `1/2π` sr⁻¹, and 0 below the horizon.
#[inline(always)]
pub fn uniform_hemisphere_pdf<R: Real>(l: Vec3<R>) -> R {
    let zero = l.z.lift(0.0);
    R::select(l.z.lt(zero), zero, zero.plus(1.0 / TAU))
}

/// The `u` of which [`uniform_hemisphere`] makes the unit vector `l`.
#[inline(always)]
pub fn uniform_hemisphere_inverse<R: Real>(l: Vec3<R>) -> [R; 2] {
    cap_around_z_inverse(l, l.z.lift(1.0))
}

/// A cap of the sphere: the directions within an angle of an axis, each as likely as any other.
///
/// A cap is given by `1 − cos` of its half angle, which keeps its digits for a small one: that of a sun is 1.1e-5, of
/// which `1 − 0.999989` in `f32` has lost all but two. From a sine: [`from_sin2`](Self::from_sin2).
#[derive(Clone, Copy, Debug)]
pub struct SphericalCap<R: Real> {
    frame: Frame<R>,
    one_minus_cos: R,
}

impl<R: Real> SphericalCap<R> {
    /// The cap around the unit vector `axis` whose half angle has this `1 − cos`, from 0 to 2, the whole sphere.
    #[inline(always)]
    pub fn new(axis: Vec3<R>, one_minus_cos: R) -> Self {
        Self { frame: Frame::from_normal(axis), one_minus_cos }
    }

    /// The cap of a half angle up to 90°, from the square of its sine: for a sphere of radius `r` at distance `d` that
    /// is `r²/d²`.
    ///
    /// By `1 − cos = sin²/(1 + cos)`.
    #[inline(always)]
    pub fn from_sin2(axis: Vec3<R>, sin2: R) -> Self {
        let cos = (sin2.lift(1.0) - sin2).sqrt();
        Self::new(axis, sin2 / cos.plus(1.0))
    }

    /// The density, `1/(2π (1 − cos))` sr⁻¹.
    #[inline(always)]
    pub fn pdf(&self) -> R {
        self.one_minus_cos.times(TAU).recip()
    }

    /// A direction of the cap.
    #[inline(always)]
    pub fn sample(&self, u: [R; 2]) -> Vec3<R> {
        self.frame.to_world(cap_around_z(u, self.one_minus_cos))
    }

    /// The `u` of which [`sample`](Self::sample) makes the direction `l`. For a small cap as many digits are lost as
    /// `l` has lost.
    #[inline(always)]
    pub fn inverse(&self, l: Vec3<R>) -> [R; 2] {
        cap_around_z_inverse(self.frame.to_local(l), self.one_minus_cos)
    }
}

/// With the distance `r` from the middle of the disc, `1 − z = r² q` and `sin = r √(q (2 − r² q))`: no difference of
/// nearly equals.
#[inline(always)]
fn cap_around_z<R: Real>(u: [R; 2], one_minus_cos: R) -> Vec3<R> {
    let [x, y] = concentric_disc(u);
    let height = radius_of_disc(u).squared() * one_minus_cos;
    let scale = (one_minus_cos * (height.lift(2.0) - height)).sqrt();
    Vec3::new(x * scale, y * scale, height.lift(1.0) - height)
}

#[inline(always)]
fn cap_around_z_inverse<R: Real>(l: Vec3<R>, one_minus_cos: R) -> [R; 2] {
    // The scale without the height 1 − z, which has lost its digits near the pole: 2 − height is 1 + z.
    let scale = (one_minus_cos * l.z.plus(1.0)).sqrt();
    concentric_disc_inverse([l.x / scale, l.y / scale])
}

/// A triangle on the sphere, its directions evenly.
///
/// Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995, for the way; the solid angle by Van Oosterom and
/// Strackee, "The Solid Angle of a Plane Triangle", 1983, and the edges by half vectors (Peters, "BRDF Importance
/// Sampling for Polygonal Lights", SIGGRAPH 2021). Arvo's sum of three angles less π, and his arc cosines, have no
/// digits left for a small triangle; here nothing cancels but the determinant of the corners.
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle<R> {
    a: Vec3<R>,
    b: Vec3<R>,
    c: Vec3<R>,
    /// `|a·(b × c)|`, `a·c + b·c`, `1 + a·b`.
    terms: (R, R, R),
    solid_angle: R,
}

impl<R: Real> SphericalTriangle<R> {
    /// The triangle of three unit vectors, in either order. It is the smaller of the two that they bound, and less than
    /// a hemisphere.
    #[inline(always)]
    pub fn new(a: Vec3<R>, b: Vec3<R>, c: Vec3<R>) -> Self {
        // Of the edges, not of the corners: |a·((b − a) × (c − a))| is the same, and small vectors have small products.
        let det = a.dot((b - a).cross(c - a)).abs();
        let terms = (det, a.dot(c) + b.dot(c), a.dot(b).plus(1.0));
        Self { a, b, c, terms, solid_angle: det.atan2(terms.1 + terms.2).times(2.0) }
    }

    /// The solid angle `Ω` in sr: `tan(Ω/2) = |a·(b × c)|/(1 + a·b + b·c + c·a)`.
    #[inline(always)]
    pub fn solid_angle(&self) -> R {
        self.solid_angle
    }

    /// The density `1/Ω` sr⁻¹.
    #[inline(always)]
    pub fn pdf(&self) -> R {
        self.solid_angle.recip()
    }

    /// A direction of the triangle.
    ///
    /// The first number cuts off a triangle `a, b, c'` of that part of the solid angle, with `c'` on the edge from `a`
    /// to `c`: the tangent of half its angle is `y d/(x (1 + a·b) + y (a·c + b·c))` for the half vector `x a + y c` of
    /// `a` and `c'`. The second goes along the arc from `b` to `c'`, evenly in `1 − cos`.
    #[inline(always)]
    pub fn sample(&self, [x, y]: [R; 2]) -> Vec3<R> {
        let (det, along, base) = self.terms;
        let (sin, cos) = (self.solid_angle * x).times(0.5).sin_cos();
        // Where the triangle has no area both terms are 0, and so would be the half vector: then it is a (see the
        // test).
        let scale = (det * cos - along * sin, base * sin);
        let flat = (scale.0.abs() + scale.1.abs()).eq(det.lift(0.0));
        let half = self.a * R::select(flat, det.lift(1.0), scale.0) + self.c * scale.1;
        let half = half.normalize();
        let corner = half * half.dot(self.a).times(2.0) - self.a;
        // 1 − b·c', from the chord.
        let q = (self.b - corner).length_squared().times(0.5);
        let height = q * y;
        let two = q.lift(2.0);
        let part = (y * (two - height) / (two - q)).sqrt();
        let rest = (q.lift(1.0) - height) - part * (q.lift(1.0) - q);
        (corner * part + self.b * rest).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_azimuth_is_that_of_a_turn() {
        let (mut worst, mut worst_single) = (0.0_f64, 0.0_f64);
        for i in 0..=40_000 {
            let u = f64::from(i) / 40_000.0;
            let error = |u: f64, (sin, cos): (f64, f64)| {
                let (s, c) = (libm::sin(TAU * u), libm::cos(TAU * u));
                (sin - s).abs().max((cos - c).abs())
            };
            worst = worst.max(error(u, azimuth(u)));
            let (sin, cos) = azimuth(u as f32);
            worst_single = worst_single.max(error(f64::from(u as f32), (sin.into(), cos.into())));
        }
        std::println!("azimuth: f64 {worst:e}, f32 {worst_single:e}");
        assert!(worst < 4e-15 && worst_single < 4e-7, "{worst:e} {worst_single:e}");
        let (sin, cos) = azimuth(f32::NAN);
        assert!(sin.is_nan() && cos.is_nan());
    }
}
