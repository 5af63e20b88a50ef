//! Maps of the unit square onto what is to be sampled.

use lobe::{Real, Vec3};

/// The disc of radius 1, evenly, from the square `[0, 1)²`: concentric, so that what is near in the square is near in the disc.
///
/// Shirley and Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997. Density `1/π`.
#[inline(always)]
pub fn concentric_disc<R: Real>(u: [R; 2]) -> [R; 2] {
    let [x, y] = u.map(
        #[inline(always)]
        |u| u.times(2.0).plus(-1.0),
    );
    let wide = y.abs().lt(x.abs());
    // The radius has the sign of the longer side, the angle goes from −45° to 45° around its axis.
    let radius = R::select(wide, x, y);
    let other = R::select(wide, y, x);
    // The middle of the square is the middle of the disc; 0/0 would be NaN.
    let safe = R::select(radius.eq(radius.lift(0.0)), radius.lift(1.0), radius);
    let (sin, cos) = (other / safe).times(core::f64::consts::FRAC_PI_4).sin_cos();
    [radius * R::select(wide, cos, sin), radius * R::select(wide, sin, cos)]
}

/// The hemisphere around `+z`, in proportion to the cosine: `pdf = z/π` sr⁻¹.
///
/// Malley's way: what is evenly on the disc is so under the projection. With `z` from `(1 − x)(1 + x)` of the radius, not from the
/// difference of squares, so that the horizon keeps its digits.
#[inline(always)]
pub fn cosine_hemisphere<R: Real>(u: [R; 2]) -> Vec3<R> {
    let [x, y] = concentric_disc(u);
    let [a, b] = u.map(
        #[inline(always)]
        |u| u.times(2.0).plus(-1.0).abs(),
    );
    // The radius is the larger of both.
    let radius = a.max(b);
    let one = radius.lift(1.0);
    Vec3::new(x, y, ((one - radius) * (one + radius)).sqrt())
}
