//! Albedos by quadrature over the slopes of the facets, where a microfacet lobe is smooth whatever its width.

use crate::albedo::{AGREEMENT, Albedo};
use crate::quadrature::{logarithmic, panels, up_to};
use core::f64::consts::FRAC_PI_2;
use lobe::{Alpha, Brdf, Real, Rgb, Vec3};

/// The directional albedo `E(v) = ∫ f_r(l, v) (n·l) dω_l` of a microfacet lobe with the widths `(αx, αy)`.
///
/// The same number as [`directional_albedo`](crate::directional_albedo), but right to 1e-6 for `α` from 1e-4 to 1 at any
/// view down to `n·v = 1e-6`, where that one, which looks around the mirror direction, may run out of points. `v` is a
/// unit vector of the local frame, `v.z > 0`; from below the horizon the albedo is 0.
///
/// The integral is taken over the slopes of the facet that mirrors `l` to `v`, in units of the widths:
/// `dω_l = 4 (v·h) (n·h)³ αx αy r dr dφ`. There a lobe is as wide as one, and the directions above the horizon are those with
/// `r < r_max(φ)`, in closed form. The radius is logarithmic; the azimuth is dense where a grazing viewer's horizon turns
/// away. Sixteen-point Gauss-Legendre panels are halved until two results agree to 1e-7 (see [`Albedo::error`]).
///
/// The widths only say where the points are: the result is right for any lobe that is smooth in these coordinates.
///
/// ```
/// use lobe::{Alpha, Microfacet, Rgb, Vec3};
/// use lobe::{distribution::Ggx, fresnel::Schlick, masking::SmithCorrelated};
/// use lobe_energy::microfacet_albedo;
///
/// // The roughest mirror: what is reflected once along its normal is 1 − ln 2 of the light.
/// let white = Schlick::new(Rgb::splat(1.0));
/// let rough = Microfacet::new(Ggx::new(Alpha(1.0)), SmithCorrelated, white);
/// let albedo = microfacet_albedo(&rough, (Alpha(1.0), Alpha(1.0)), Vec3::new(0.0, 0.0, 1.0));
/// assert!((albedo.value.g - (1.0 - 2.0_f64.ln())).abs() < 1e-9);
/// ```
pub fn microfacet_albedo<B: Brdf<f64> + ?Sized>(brdf: &B, alpha: (Alpha<f64>, Alpha<f64>), v: Vec3<f64>) -> Albedo {
    microfacet_albedo_to(AGREEMENT, brdf, alpha, v)
}

/// [`microfacet_albedo`], but the panels are halved only until two results agree to `agreement`.
pub fn microfacet_albedo_to<B: Brdf<f64> + ?Sized>(
    agreement: f64,
    brdf: &B,
    (x, y): (Alpha<f64>, Alpha<f64>),
    v: Vec3<f64>,
) -> Albedo {
    if v.z <= 0.0 {
        return Albedo { value: Rgb::splat(0.0), error: 0.0 };
    }
    let slopes = Slopes::new((x.0, y.0), v);
    Albedo::refined(agreement, |refinement| {
        slopes.integral(refinement, Slopes::horizon_of_light, |facet| {
            brdf.eval_cos(facet.mirror(v), v) * (4.0 * facet.v_dot_h * facet.measure)
        })
    })
}

/// The mean albedo `2 ∫ E(μ) μ dμ` of a lobe whose directional albedo depends on `μ = n·v` alone: what is reflected of
/// light that comes evenly from everywhere.
///
/// `directional` is asked for some hundred cosines between 0 and 1, dense towards 0. The error is that of the quadrature
/// over `μ` and the largest of `directional`'s.
///
/// ```
/// use lobe::{Lambert, Rgb, Vec3};
/// use lobe_energy::{average_albedo, directional_albedo};
///
/// let grey = Lambert::new(Rgb::splat(0.3));
/// let mean = average_albedo(|mu| directional_albedo(&grey, Vec3::new((1.0 - mu * mu).sqrt(), 0.0, mu)));
/// assert!((mean.value.g - 0.3).abs() < 1e-6);
/// ```
pub fn average_albedo(directional: impl Fn(f64) -> Albedo) -> Albedo {
    let worst = core::cell::Cell::new(0.0);
    let mean = Albedo::refined(AGREEMENT, |refinement| {
        let weighted = |mu: f64| {
            let albedo = directional(mu);
            worst.set(Real::max(worst.get(), albedo.error));
            albedo.value * (2.0 * mu)
        };
        // Below the first cosine there is 1e-8 of the light.
        panels(0.0, 1e-4, 1, weighted) + logarithmic(1e-4, 1.0, refinement, weighted)
    });
    Albedo { value: mean.value, error: mean.error + worst.get() }
}

/// A facet with the slopes `αx r cos φ`, `αy r sin φ`.
pub(crate) struct Facet {
    /// Its unit normal.
    pub(crate) h: Vec3<f64>,
    /// `v·h`.
    pub(crate) v_dot_h: f64,
    /// `dω_h/(dr dφ)`.
    pub(crate) measure: f64,
}

impl Facet {
    /// The direction that it mirrors to `v`.
    fn mirror(&self, v: Vec3<f64>) -> Vec3<f64> {
        self.h * (2.0 * self.v_dot_h) - v
    }
}

/// The plane of slopes as a viewer sees it.
pub(crate) struct Slopes {
    alpha: (f64, f64),
    v: Vec3<f64>,
    /// The length and the azimuth of the viewer's direction in the stretched plane.
    across: f64,
    azimuth: f64,
}

/// Inside this radius, in widths, there is 1e-12 of the light of any lobe of that width.
const SMALLEST: f64 = 1e-6;

impl Slopes {
    pub(crate) fn new(alpha: (f64, f64), v: Vec3<f64>) -> Self {
        let (x, y) = (v.x * alpha.0, v.y * alpha.1);
        Self { alpha, v, across: libm::sqrt(x * x + y * y), azimuth: libm::atan2(y, x) }
    }

    fn facet(&self, r: f64, (sin, cos): (f64, f64)) -> Facet {
        let Self { alpha, v, .. } = self;
        let (x, y) = (alpha.0 * r * cos, alpha.1 * r * sin);
        let z = 1.0 / libm::sqrt(1.0 + x * x + y * y);
        let h = Vec3::new(x * z, y * z, z);
        Facet { h, v_dot_h: v.dot(h), measure: alpha.0 * alpha.1 * r * z * z * z }
    }

    /// `a` and `β`: the squared slope `a r²`, and `v·h = (β r + n·v) n·h`.
    fn coefficients(&self, (sin, cos): (f64, f64)) -> (f64, f64) {
        let (x, y) = (self.alpha.0 * cos, self.alpha.1 * sin);
        (x * x + y * y, self.v.x * x + self.v.y * y)
    }

    /// The radius from which on the mirrored direction is below the horizon: the root of `(n·v) a r² − 2 β r = n·v`.
    pub(crate) fn horizon_of_light(&self, direction: (f64, f64)) -> f64 {
        let (a, beta) = self.coefficients(direction);
        let root = libm::sqrt(beta * beta + self.v.z * self.v.z * a);
        // Two forms of one root, each without a difference.
        if beta > 0.0 { (beta + root) / (self.v.z * a) } else { self.v.z / (root - beta) }
    }

    /// The radius from which on facets turn away from the viewer, or are as good as vertical.
    pub(crate) fn horizon_of_facets(&self, direction: (f64, f64)) -> f64 {
        let (a, beta) = self.coefficients(direction);
        let vertical = 1e12 / libm::sqrt(a);
        if beta < 0.0 { Real::min(self.v.z / -beta, vertical) } else { vertical }
    }

    /// `∫ f` over the plane up to `end`, `f` per `dr dφ`. `refinement` multiplies the panels of both directions.
    pub(crate) fn integral(
        &self,
        refinement: u32,
        end: impl Fn(&Self, (f64, f64)) -> f64,
        f: impl Fn(Facet) -> Rgb<f64>,
    ) -> Rgb<f64> {
        let ray = |phi: f64| {
            let direction = libm::sincos(phi);
            let end = end(self, direction);
            let at = |r: f64| f(self.facet(r, direction));
            let first = Real::min(SMALLEST, 0.5 * end);
            panels(0.0, first, 1, at)
                + logarithmic(first, 0.5 * end, refinement, at)
                + up_to(end, 0.5 * end, refinement, at)
        };
        // Where β passes through 0 the horizon of a grazing viewer goes from near to far, within this angle.
        let (x, y) = self.alpha;
        let wide = Real::max(x, y);
        let turn = if self.across > 0.0 { 0.01 * self.v.z * Real::min(x, y) / self.across } else { 1.0 };
        // Two widths of an aspect of sixteen put features of a sixteenth into every azimuth.
        let turn = Real::max(Real::min(turn, 0.05 * Real::min(x, y) / wide), 1e-12);
        let mut sum = Rgb::splat(0.0);
        for side in [-FRAC_PI_2, FRAC_PI_2] {
            let centre = self.azimuth + side;
            for sign in [-1.0, 1.0] {
                let at = |distance: f64| ray(centre + sign * distance);
                sum = sum + panels(0.0, turn, 1, at) + logarithmic(turn, FRAC_PI_2, refinement, at);
            }
        }
        sum
    }
}
