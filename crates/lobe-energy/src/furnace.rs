//! The weak white furnace: whether a masking belongs to its distribution.

use crate::albedo::{AGREEMENT, Albedo};
use crate::half_vector::Slopes;
use lobe::distribution::Distribution;
use lobe::masking::Masking;
use lobe::{Alpha, Rgb, Vec3};

/// The masking `G₁(v, h)` of one direction: `G` with the other one along the normal, where nothing is hidden.
pub fn masking<D: Distribution<f64>, G: Masking<f64, D>>(
    distribution: &D,
    masking: &G,
    v: Vec3<f64>,
    h: Vec3<f64>,
) -> f64 {
    let n = Vec3::new(0.0, 0.0, 1.0);
    masking.visibility(distribution, n, v, h, v.dot(h), 1.0) * 4.0 * v.z
}

/// The weak white furnace `∫ G₁(v, h) D(h) max(0, v·h)/(n·v) dω_h`: the area of the facets that `v` sees, as a part of the
/// surface that it sees.
///
/// It is 1 where the masking is right, for mirrors that scatter once and are never shadowed: then `v` gets all the light
/// of a white world, from above the horizon and from below (two-sided). More is light out of nothing, less is lost, before any
/// light is lost to shadowing. Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT
/// 3(2), 2014, equations 20 and 34.
///
/// `alpha` are the widths of the distribution, which only say where the points are. The error is as that of
/// [`microfacet_albedo`](crate::microfacet_albedo); a `D` or `G` with edges makes it larger. `v` as there.
///
/// ```
/// use lobe::{Alpha, Vec3};
/// use lobe::{distribution::Ggx, masking::{Implicit, SmithCorrelated}};
/// use lobe_energy::weak_white_furnace;
///
/// let (alpha, v) = (Alpha(0.5), Vec3::new(0.96, 0.0, 0.28));
/// let smith = weak_white_furnace(&Ggx::new(alpha), &SmithCorrelated, (alpha, alpha), v);
/// assert!((smith.value.g - 1.0).abs() < 1e-6);
/// let implicit = weak_white_furnace(&Ggx::new(alpha), &Implicit, (alpha, alpha), v);
/// assert!(implicit.value.g < 0.5);
/// ```
pub fn weak_white_furnace<D: Distribution<f64>, G: Masking<f64, D>>(
    distribution: &D,
    g: &G,
    alpha: (Alpha<f64>, Alpha<f64>),
    v: Vec3<f64>,
) -> Albedo {
    weak_white_furnace_to(AGREEMENT, distribution, g, alpha, v)
}

/// [`weak_white_furnace`], but the panels are halved only until two results agree to `agreement`: a distribution with
/// corners, such as a [`Tabulated`](lobe::distribution::Tabulated), takes many.
pub fn weak_white_furnace_to<D: Distribution<f64>, G: Masking<f64, D>>(
    agreement: f64,
    distribution: &D,
    g: &G,
    (x, y): (Alpha<f64>, Alpha<f64>),
    v: Vec3<f64>,
) -> Albedo {
    if v.z <= 0.0 {
        return Albedo { value: Rgb::splat(0.0), error: 0.0 };
    }
    let slopes = Slopes::new((x.0, y.0), v);
    Albedo::refined(agreement, |refinement| {
        slopes.integral(refinement, Slopes::horizon_of_facets, |facet| {
            // Rounding may put the last point beyond the horizon.
            let visible = facet.v_dot_h.max(0.0);
            let part = masking(distribution, g, v, facet.h) * distribution.d(facet.h) * visible / v.z;
            Rgb::splat(part * facet.measure)
        })
    })
}
