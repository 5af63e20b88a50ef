//! Lobes that were fitted to measurements or derived from wave optics: two by their own profile, two by facets that
//! cover them.

use crate::draw::{Draw, sample_by_drawing, scaled_sum, tilted};
use crate::facets::{Caps, Facets};
use crate::map::azimuth;
use crate::rules::by_facet;
use crate::special::{exp_m1_by, ln_1p_by};
use core::f64::consts::{FRAC_1_PI, LOG2_E, PI};
use lobe::distribution::{Distribution, Ggx};
use lobe::fresnel::{Dielectric, Fresnel, Incidence};
use lobe::{Alpha, Brdf, Facet, HeTorrance, LowMicrofacet, LowSmooth, Real, Rgb, ShiftedGamma, Vec3};

/// The profile `(1 + B x)^(−C)` over `x` from 0 to an end, and its way back: `∫ = (((1 + B x)^(1−C) − 1)/(B (1 − C))`,
/// whose limits `C → 1`, a logarithm, and `B → 0`, `x` itself, come out of quotients that are smooth there.
struct Profile<R> {
    b: R,
    /// `1 − C`.
    rise: R,
    /// `ln(1 + B x)/B` at the end.
    log: R,
    /// The integral up to the end.
    whole: R,
}

impl<R: Real> Profile<R> {
    #[inline(always)]
    fn new(b: R, c: R, end: R) -> Self {
        let rise = c.lift(1.0) - c;
        let log = end * ln_1p_by(b * end);
        Self { b, rise, log, whole: log * exp_m1_by(rise * (b * log)) }
    }

    /// `x` with the part `u` of the integral below it.
    #[inline(always)]
    fn at(&self, u: R) -> R {
        let below = u * self.whole;
        // Of a profile that has fallen to less than a rounding this is −1 for the last u, and the logarithm infinite,
        // or below and NaN (test `the_last_number_is_at_the_end`).
        let rise = (self.rise * (self.b * below)).max(u.lift(-1.0));
        let log = (below * ln_1p_by(rise)).min(self.log);
        log * exp_m1_by(self.b * log)
    }

    /// The density of `x`.
    #[inline(always)]
    fn density(&self, x: R) -> R {
        ((self.rise.plus(-1.0)) * (self.b * x).log2_1p()).exp2() / self.whole
    }
}

/// A dielectric at the angle `θ` of `v`: about what reflects along the mirror direction.
#[inline(always)]
fn reflectance<R: Real>(ior: lobe::Ior<R>, v: Vec3<R>) -> Rgb<R> {
    Dielectric::new(ior).fresnel(Incidence::from_cos(v.z))
}

/// The profile of a view: over `|l_xy + v_xy|²`, to the farthest point of the disc.
#[inline(always)]
fn deviation<R: Real>(lobe: &LowSmooth<R>, v: Vec3<R>) -> Profile<R> {
    let end = (v.x.squared() + v.y.squared()).sqrt().plus(1.0).squared();
    Profile::new(lobe.b(), lobe.c(), end)
}

/// By its own profile: `l_xy` on a disc around `−v_xy`, with the density `(1 + B |l_xy + v_xy|²)^(−C)`, of which what
/// lies outside the unit disc is rejected; per solid angle `n·l` times as much. The weight is `A F` and the profile's
/// integral, the same for all samples but for `F`.
impl<R: Real> Draw<R> for LowSmooth<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        let (sin, cos) = azimuth(y);
        let radius = deviation(self, v).at(x).sqrt();
        let (x, y, zero) = (radius * cos - v.x, radius * sin - v.y, v.x.lift(0.0));
        let length = (x.squared() + y.squared()).sqrt();
        let one = length.lift(1.0);
        let outside = one.le(length);
        // Outside: the nearest point of the horizon, which is a unit vector and is rejected.
        let to_rim = R::select(outside, length, one).recip();
        let z = R::select(outside, zero, (one - length) * (one + length)).sqrt();
        Vec3::new(x * to_rim, y * to_rim, z)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let deviation2 = (l.x + v.x).squared() + (l.y + v.y).squared();
        deviation(self, v).density(deviation2).times(FRAC_1_PI) * l.z
    }
    /// Without `B` the lobe is `A F`.
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, _: R) -> Rgb<R> {
        let zero = l.z.lift(0.0);
        LowSmooth::new(self.a(), zero, zero, self.ior()).eval(l, v) * deviation(self, v).whole.times(PI)
    }
    /// About half of the lobe is above the horizon where the viewer is on it.
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let above = v.z.times(0.5).plus(0.5);
        (self.a() * reflectance(self.ior(), v)).luminance() * (deviation(self, v).whole.times(PI) * above)
    }
}

/// By its own profile: `h` with the density `(1 + B (1 − n·h))^(−C)`. The weight is `8π A F G (l·h)/(π (n·v))` and the
/// profile's integral; with `G` of V-cavities at most 2 `(n·h)(n·v)/(l·h)` it is bounded at every view.
impl<R: Real> Draw<R> for LowMicrofacet<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        let one = v.z.lift(1.0);
        by_facet(tilted(Profile::new(self.b(), self.c(), one).at(x), y), v)
    }
    /// `p/2π/(4 l·h)`, with `1 − n·h = sin²/(1 + n·h)`.
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let (s, length) = scaled_sum(l, v);
        let (x, y, z) = (s.x / length, s.y / length, s.z / length);
        let from_peak = (x.squared() + y.squared()) / z.plus(1.0);
        let p = Profile::new(self.b(), self.c(), z.lift(1.0)).density(from_peak);
        p * (z.lift(0.25 / PI * R::SCALE) / length)
    }
    /// Without `B` the lobe is `A F G/(π (n·l)(n·v))`.
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, _: R) -> Rgb<R> {
        let (zero, (_, length)) = (l.z.lift(0.0), scaled_sum(l, v));
        let whole = Profile::new(self.b(), self.c(), l.z.lift(1.0)).whole;
        // The small cosine and the large quotient next to each other.
        LowMicrofacet::new(self.a(), zero, zero, self.ior()).eval_cos(l, v) * length.times(4.0 * PI / R::SCALE) * whole
    }
    /// At the mirror direction `G` is 1, and `l·h` is `n·v`.
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let whole = Profile::new(self.b(), self.c(), v.z.lift(1.0)).whole;
        (self.a() * reflectance(self.ior(), v)).luminance() * whole.times(8.0)
    }
}

/// GGX whose visible facets cover a lobe of about this width, and have a tail beyond it. The width is kept in the
/// domain of `α`: below, the density leaves the range, and above 1 facets are not of use.
#[inline(always)]
fn facets<R: Real>(alpha: R) -> Ggx<R> {
    Ggx::new(Alpha(alpha.max(alpha.lift(1e-4)).min(alpha.lift(1.0))))
}

/// The light by those facets.
#[inline(always)]
fn by_facets<R: Real>(facets: &Ggx<R>, v: Vec3<R>, x: R, y: R) -> Vec3<R> {
    crate::microfacet::mirrored(facets, &Caps, v, [y, x])
}

/// Its density.
#[inline(always)]
fn density_by_facets<R: Real>(facets: &Ggx<R>, v: Vec3<R>, facet: &Facet<R>) -> R {
    Caps.pdf(facets, v, facet, facets.d(facet.normal()))
}

/// The width of the lobe in half vectors, `α² = (2σ/τ)² + w²`: of the slopes where the surface is rough; where it is
/// smooth, of the deviation `1/(πτ)` that diffraction gives, by the sum of the cosines, of which that of the light is
/// about `√((n·v)² + 1/(πτ))`.
#[inline(always)]
fn he<R: Real>(lobe: &HeTorrance<R>, v: Vec3<R>) -> Ggx<R> {
    let deviation = lobe.tau().times(PI).recip();
    let smooth = deviation / (v.z + (v.z.squared() + deviation).sqrt());
    let rough = (lobe.sigma() / lobe.tau()).times(2.0);
    facets((smooth.squared() + rough.squared()).sqrt())
}

/// By the visible facets of a GGX as wide as the lobe. The weight is `f_r (n·l)/pdf`.
///
/// The lobe is a series of Gaussians of which each counts with a weight of its own: none can be drawn in closed form,
/// but all fall faster than GGX, whose density vanishes nowhere above the horizon. A part by the cosine would lower no
/// weight, and add to the variance (test `covered_lobes_have_bounded_weights`).
impl<R: Real> Draw<R> for HeTorrance<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Vec3<R> {
        by_facets(&he(self, v), v, x, y)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        density_by_facets(&he(self, v), v, &Facet::between(l, v))
    }
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, pdf: R) -> Rgb<R> {
        self.eval_cos(l, v) / pdf
    }
    /// `F` and what is not reflected coherently, `1 − e⁻ᵍ` with `g = (4πσ n·v)²`.
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let g = (self.sigma() * v.z).times(4.0 * PI).squared();
        let scattered = g.lift(1.0) - g.times(-LOG2_E).exp2();
        (self.ks() * reflectance(self.ior(), v)).luminance() * scattered
    }
}

/// The widths that cover the three channels, each with its part of the samples. The end `exp(−tan²/α)` of a channel has
/// slopes of `√α`, its peak, where `t^(−p)` begins to fall, those of `α`: for the exponents of published fits, below
/// 1/2, most of the light is in the former.
#[inline(always)]
fn gamma<R: Real>(lobe: &ShiftedGamma<R>) -> [(R, f64); 6] {
    let Rgb { r, g, b } = lobe.channels();
    let (wide, narrow) = (0.25, 1.0 / 12.0);
    [
        (r.alpha.sqrt(), wide),
        (g.alpha.sqrt(), wide),
        (b.alpha.sqrt(), wide),
        (r.alpha, narrow),
        (g.alpha, narrow),
        (b.alpha, narrow),
    ]
}

/// By the visible facets of a GGX of the width `√α` or `α` of one of the channels. The weight is `f_r (n·l)/pdf`.
///
/// The three channels are lobes of their own, of which the widest may be a hundred times as wide as the narrowest: the
/// density of one alone would all but vanish where another has a value (test `covered_lobes_have_bounded_weights`).
impl<R: Real> Draw<R> for ShiftedGamma<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [choice, x, y]: [R; 3]) -> Vec3<R> {
        // The last width whose samples begin at or below `choice`.
        let (mut alpha, mut from) = (choice, 0.0);
        for (width, part) in gamma(self) {
            alpha = R::select(choice.lt(choice.lift(from)), alpha, width);
            from += part;
        }
        by_facets(&facets(alpha), v, x, y)
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let facet = Facet::between(l, v);
        let mut sum = l.z.lift(0.0);
        for (width, part) in gamma(self) {
            sum = sum + density_by_facets(&facets(width), v, &facet).times(part);
        }
        sum
    }
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, pdf: R) -> Rgb<R> {
        self.eval_cos(l, v) / pdf
    }
    /// `ks F`, without masking.
    #[inline(always)]
    fn guess(&self, v: Vec3<R>) -> R {
        let (zero, away) = (v.z.lift(0.0), v.z.lift(1.0) - v.z);
        let fifth = away.squared().squared() * away;
        let channels = self.channels().map(
            #[inline(always)]
            |c| c.ks * ((c.f0 - c.f1 * v.z) + (away.lift(1.0) - c.f0) * fifth).max(zero),
        );
        channels.luminance()
    }
}

sample_by_drawing! {
    [] LowSmooth<R>;
    [] LowMicrofacet<R>;
    [] HeTorrance<R>;
    [] ShiftedGamma<R>;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_number_is_at_the_end() {
        for c in (0..300).map(|i| i as f32 / 100.0) {
            for i in 0..500 {
                let b = 10_f32.powf(i as f32 * 0.03 - 8.0);
                let x = Profile::new(b, c, 1.0).at(1.0 - f32::EPSILON / 2.0);
                assert!((0.0..=1.000_005).contains(&x), "{b} {c}: {x}");
            }
        }
    }

    /// Half of the integral is below what is drawn for 1/2, for the limits of the profile too.
    #[test]
    fn a_profile_is_drawn_back() {
        for (b, c) in [(0.0, 2.0), (1e-12, 1.0), (3.0, 0.0), (1e3, 1.0), (1e3, 1.0 + 1e-12), (1e7, 3.0)] {
            let profile = Profile::new(b, c, 4.0);
            let x: f64 = profile.at(0.5);
            let share = Profile::new(b, c, x).whole / profile.whole;
            assert!((share - 0.5).abs() < 1e-12, "{b} {c}: {x}, {share}");
        }
    }
}
