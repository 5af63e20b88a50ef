//! The directional albedo of any BRDF, by quadrature around the mirror direction.

use crate::quadrature::{logarithmic, panels, up_to};
use lobe::{Brdf, Real, Rgb, Vec3};

/// A directional albedo and what is known of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Albedo {
    /// `E(v)`, per channel: the fraction of a uniform white world that is reflected to `v`.
    pub value: Rgb<f64>,
    /// The largest difference of a channel to the next coarser quadrature: an estimate from above.
    pub error: f64,
}

/// A lobe with its directions exchanged: `f(l, v)` becomes `f(v, l)`. For a reciprocal lobe, the lobe itself.
///
/// The directional albedo of `Exchanged(lobe)` at `l` is the part of the light from `l` that is reflected anywhere.
/// The lecture's highlights, which are not reciprocal, may conserve energy in one sense and gain it in the other.
///
/// ```
/// use lobe::{Rgb, Shininess, Vec3, illumination::PhongHighlight};
/// use lobe_energy::{Exchanged, directional_albedo};
///
/// let highlight = PhongHighlight::new(Rgb::splat(1.0), Shininess(8.0));
/// let grazing = Vec3::new((1.0_f64 - 0.01 * 0.01).sqrt(), 0.0, 0.01);
/// assert!(directional_albedo(&highlight, grazing).value.g < 0.2);
/// assert!(directional_albedo(&Exchanged(&highlight), grazing).value.g > 2.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exchanged<B>(pub B);

impl<R: Real, B: Brdf<R>> Brdf<R> for Exchanged<B> {
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.0.eval(v, l)
    }
}

/// The directional albedo `E(v) = ∫ f_r(l, v) (n·l) dω_l` over the upper hemisphere.
///
/// For a reciprocal lobe it is also the part of the light from `v` that is reflected anywhere; for one that is not,
/// that is the albedo of [`Exchanged`].
///
/// `v` is a unit vector in the local frame, `v.z > 0`; from below the horizon the albedo is 0.
///
/// The integral is taken in polar coordinates around the mirror direction of `v`, with a logarithmic radius, so that
/// lobes of any sharpness up to q = 10⁶ are met with the same number of points; each circle is cut exactly at the
/// horizon. Sixteen-point Gauss-Legendre panels are halved until two results agree to 1e-7 or 2²¹ points are spent:
/// see [`Albedo::error`].
pub fn directional_albedo<B: Brdf<f64> + ?Sized>(brdf: &B, v: Vec3<f64>) -> Albedo {
    directional_albedo_to(AGREEMENT, brdf, v)
}

/// [`directional_albedo`], but the panels are halved only until two results agree to `agreement`, an absolute difference
/// of albedos. Each halving that is saved is three quarters of the points: a lobe with edges, such as those of
/// V-cavities, takes many.
///
/// Two coarse results may agree by chance on what neither has seen: of a lobe with steps or narrow ridges, such as
/// [`Tabulated`](lobe::distribution::Tabulated) facets, an agreement of 3e-4 has been told where the albedo was off by
/// 2e-2. Ask for less.
pub fn directional_albedo_to<B: Brdf<f64> + ?Sized>(agreement: f64, brdf: &B, v: Vec3<f64>) -> Albedo {
    Albedo::refined(agreement, |refinement| integrate(brdf, v, refinement))
}

impl Albedo {
    /// A quadrature whose panels are halved until two results agree to `agreement`, or sixteen times as many are reached.
    pub(crate) fn refined(agreement: f64, quadrature: impl Fn(u32) -> Rgb<f64>) -> Self {
        let mut coarse = quadrature(1);
        let mut error = f64::INFINITY;
        for refinement in [2, 4, 8, 16] {
            let fine = quadrature(refinement);
            error = largest(fine - coarse);
            coarse = fine;
            // A NaN ends it too: finer points would not mend it.
            if error.partial_cmp(&agreement) != Some(core::cmp::Ordering::Greater) {
                break;
            }
        }
        Self { value: coarse, error }
    }
}

/// Two quadratures that agree to this are enough for an albedo that is shown with four digits.
pub(crate) const AGREEMENT: f64 = 1e-7;

/// The largest magnitude of a channel; NaN if one is.
fn largest(difference: Rgb<f64>) -> f64 {
    let (r, g, b) = (difference.r.abs(), difference.g.abs(), difference.b.abs());
    Real::max(Real::max(r, g), b) + 0.0 * (r + g + b)
}

/// One quadrature; `refinement` multiplies the number of panels in both directions.
fn integrate<B: Brdf<f64> + ?Sized>(brdf: &B, v: Vec3<f64>, refinement: u32) -> Rgb<f64> {
    // The mirror direction of `v` is the pole; `up` is the direction on its circle that rises steepest.
    let pole = Vec3::new(-v.x, -v.y, v.z);
    let sin_pole = libm::sqrt(v.x * v.x + v.y * v.y);
    let (ux, uy) = if sin_pole > 0.0 { (v.x / sin_pole, v.y / sin_pole) } else { (1.0, 0.0) };
    let up = Vec3::new(ux * v.z, uy * v.z, sin_pole);
    let side = pole.cross(up);
    // Where the circle around the pole first meets the horizon, and where it has gone below.
    let elevation = libm::atan2(v.z, sin_pole);
    let last = core::f64::consts::PI - elevation;

    let circle = |radius: f64| -> Rgb<f64> {
        let (sin, cos) = Real::sin_cos(radius);
        // z = cos·pole.z + sin·cos φ·up.z > 0 for |φ| < half.
        let rising = -cos * pole.z / (sin * sin_pole);
        let half = if rising < -1.0 || sin * sin_pole == 0.0 {
            core::f64::consts::PI
        } else {
            libm::acos(Real::min(rising, 1.0))
        };
        let arc = panels(-half, half, 4 * refinement, |phi| {
            let (sin_phi, cos_phi) = Real::sin_cos(phi);
            let l = pole * cos + (up * cos_phi + side * sin_phi) * sin;
            brdf.eval_cos(l, v)
        });
        arc * sin
    };

    // [0, 1e-8] in one step; from there in panels of equal ratio up to the horizon's first touch.
    let touch = Real::max(elevation, SMALLEST_RADIUS);
    let inner = panels(0.0, SMALLEST_RADIUS, 1, circle)
        + logarithmic(SMALLEST_RADIUS, 0.5 * touch, refinement, circle)
        + up_to(touch, 0.5 * touch, refinement, circle);
    // Then the arc shrinks like a square root at both ends; radius = end ± w² makes it smooth. A lobe around the
    // mirror direction ends at a right angle, which is always in between.
    let right_angle = core::f64::consts::FRAC_PI_2;
    let middle = 0.5 * (touch + right_angle);
    let shrinking = |w: f64| circle(touch + w * w) * (2.0 * w);
    let vanishing = |w: f64| circle(last - w * w) * (2.0 * w);
    inner
        + panels(0.0, SMALLEST_RADIUS, 1, shrinking)
        + logarithmic(SMALLEST_RADIUS, libm::sqrt(Real::max(middle - touch, 0.0)), refinement, shrinking)
        + up_to(right_angle, right_angle - middle, refinement, circle)
        + panels(0.0, libm::sqrt(Real::max(last - right_angle, 0.0)), 2 * refinement, vanishing)
}

/// Inside this angle around the mirror direction, in radians, the sharpest lobe of the domain holds 1e-9 of its light.
const SMALLEST_RADIUS: f64 = 1e-8;

#[cfg(test)]
mod tests {
    use super::*;
    use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
    use lobe::{BlinnPhong, CommonNormalization, Lambert, Phong, Shininess};

    const UP: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: 1.0 };
    const WHITE: Rgb<f64> = Rgb::splat(1.0);
    const EXPONENTS: [f64; 12] = [0.0, 0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 32.0, 1e2, 1e3, 1e4, 1e6];

    fn at(degrees: f64) -> Vec3<f64> {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        Vec3::new(sin, 0.0, cos)
    }

    fn albedo(brdf: &dyn Brdf<f64>, v: Vec3<f64>) -> f64 {
        let albedo = directional_albedo(brdf, v);
        assert!(albedo.error < 1e-6, "{albedo:?} at {v:?}");
        albedo.value.g
    }

    #[test]
    fn lambert_reflects_its_albedo_from_everywhere() {
        for degrees in [0.0, 1.0, 30.0, 45.0, 60.0, 85.0, 89.9, 89.9999] {
            let error = albedo(&Lambert::new(Rgb::splat(0.7)), at(degrees)) - 0.7;
            assert!(error.abs() < 1e-9, "{degrees}: {error}");
        }
    }

    #[test]
    fn the_closed_forms_hold_at_normal_incidence() {
        for q in EXPONENTS {
            let common = (q + 8.0) * (libm::exp2(-q / 2.0) + q) / ((q + 2.0) * (q + 4.0));
            let torrance = 8.0 * (1.0 - libm::exp2(-(q + 2.0) / 2.0)) / (q + 2.0);
            let q = Shininess(q);
            let lobes: [(&str, &dyn Brdf<f64>, f64); 5] = [
                ("phong", &Phong::new(WHITE, q), 1.0),
                ("blinn-phong", &BlinnPhong::new(WHITE, q), 1.0),
                (
                    "common",
                    &BlinnPhong::<f64, CommonNormalization>::with_normalization(WHITE, q),
                    if q.0 == 0.0 { 1.0 } else { common },
                ),
                ("highlight", &PhongHighlight::new(WHITE, q), 2.0 / (q.0 + 1.0)),
                ("torrance highlight", &BlinnTorranceHighlight::new(WHITE, q), torrance),
            ];
            for (name, lobe, exact) in lobes {
                let error = albedo(lobe, UP) / exact - 1.0;
                assert!(error.abs() < 2e-8, "{name}, {q:?}: {error:e}");
            }
        }
    }

    /// The two normalised lobes never reflect more than they receive.
    #[test]
    fn normalised_lobes_conserve_energy_at_every_angle() {
        for q in EXPONENTS.map(Shininess) {
            for degrees in [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0] {
                let (phong, blinn) = (Phong::new(WHITE, q), BlinnPhong::new(WHITE, q));
                assert!(albedo(&phong, at(degrees)) < 1.0 + 1e-7, "phong {q:?} {degrees}");
                assert!(albedo(&blinn, at(degrees)) < 1.0 + 1e-7, "blinn-phong {q:?} {degrees}");
            }
        }
    }

    /// By how much the lecture's equation fails as a BRDF: it sends out more than it receives.
    #[test]
    fn the_lecture_gains_energy() {
        let lecture = lobe::illumination::Phong { ka: WHITE, kd: WHITE, ks: WHITE, q: Shininess(1.0) };
        // Without the 1/π of `lobes()`: 2π for k_d = k_s = 1, q = 1.
        let as_it_stands = albedo(&lecture.lobes(), UP) * core::f64::consts::PI;
        assert!((as_it_stands - core::f64::consts::TAU).abs() < 1e-6, "{as_it_stands}");
        // And it loses no energy towards the horizon, where a BRDF must: the cosine is missing.
        let sharp = PhongHighlight::new(WHITE, Shininess(1.0));
        assert!(albedo(&sharp, at(60.0)) > 0.75);
    }

    #[test]
    fn a_nan_ends_the_quadrature_and_shows() {
        let broken = Lambert::new(Rgb::new(f64::NAN, 0.5, 0.5));
        let albedo = directional_albedo(&broken, UP);
        assert!(albedo.value.r.is_nan() && albedo.error.is_nan());
    }
}
