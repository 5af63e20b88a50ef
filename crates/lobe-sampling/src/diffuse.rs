//! Diffuse lobes, by the cosine or by one that is transformed.

use crate::draw::{Draw, sample_by_drawing, tilted};
use crate::map::azimuth;
use core::f64::consts::{FRAC_1_PI, TAU};
use lobe::{Brdf, BurleyDiffuse, Eon, Lambert, OrenNayar, OrenNayarQualitative, Real, Rgb, Vec3};

/// By the cosine: the weight is the albedo, for every sample.
impl<R: Real> Draw<R> for Lambert<R> {
    #[inline(always)]
    fn weight(&self, _: Vec3<R>, _: Vec3<R>, _: R) -> Rgb<R> {
        self.albedo()
    }
    #[inline(always)]
    fn guess(&self, _: Vec3<R>) -> R {
        self.albedo().luminance()
    }
}

/// Lobes that are drawn by the cosine, and reflect about their albedo.
macro_rules! by_the_cosine {
    ($($lobe:ident)+) => {$(
        /// By the cosine: the weight is `π f_r`, finite where the cosine is 0.
        impl<R: Real> Draw<R> for $lobe<R> {
            #[inline(always)]
            fn guess(&self, _: Vec3<R>) -> R {
                self.albedo().luminance()
            }
        }
    )+};
}
by_the_cosine! { OrenNayar OrenNayarQualitative BurleyDiffuse }

/// A cosine lobe that is transformed by `((a, 0, b), (0, c, 0), (d, 0, 1))`, in the frame whose x is the azimuth of the
/// viewer, and of which what lies below the horizon is cut off before.
struct Clipped<R> {
    a: R,
    b: R,
    c: R,
    d: R,
    /// The part of the disc under the cosine lobe that is left, `(1 + 1/√(1 + d²))/2`.
    left: R,
    /// Cosine and sine of the azimuth of the viewer.
    azimuth: (R, R),
    /// The part of the samples that is even over the hemisphere.
    even: R,
}

impl<R: Real> Clipped<R> {
    /// The fits of the paper, in `μ = n·v` and the roughness `r`.
    #[inline(always)]
    fn new(v: Vec3<R>, r: R) -> Self {
        let (m, one, zero) = (v.z, r.lift(1.0), r.lift(0.0));
        let a = r * (m * m.times(0.111709).plus(-0.518982) + r * m.times(0.335918).plus(-0.276266)).plus(0.303392);
        let b = r * (m.times(1.15859).plus(-1.16407) + r * m.times(-0.150105).plus(0.150815))
            / (m * m.squared()).plus(-1.43545);
        let c = r * (m * m.times(0.261777).plus(-0.506373)).plus(0.20013);
        let d = r * (m * m.times(0.475392).plus(-1.01625)).plus(0.540852) / (m * m.plus(0.0725628)).plus(-1.0743);
        // The fit is 0.0035 r at the normal, where the other side of the disc would have to be cut (test
        // `eon_cuts_its_disc_on_the_right_side`).
        let d = d.min(zero);
        let left = d.squared().plus(1.0).rsqrt().plus(1.0).times(0.5);
        let even = r.pow(one.times(0.1)) * (m * (m * m.times(-0.290822).plus(0.538233)).plus(-0.372058)).plus(0.162925);
        // At the normal there is no azimuth, and any will do.
        let flat = Vec3::new(v.x, v.y, zero).normalize_or(Vec3::new(one, zero, zero));
        Self { a: a.plus(1.0), b, c: c.plus(1.0), d, left, azimuth: (flat.x, flat.y), even }
    }

    /// The direction of the cosine lobe that is left, by a disc whose x is moved to end where the horizon is.
    #[inline(always)]
    fn direction(&self, [x, y]: [R; 2]) -> Vec3<R> {
        let Self { a, b, c, d, left, azimuth: (cos, sin), .. } = *self;
        let (sin_phi, cos_phi) = azimuth(y);
        let radius = x.sqrt();
        let (one, zero) = (x.lift(1.0), x.lift(0.0));
        let y = radius * sin_phi;
        // Rounded, y may exceed 1, and x² + y² too: a negative square would be NaN.
        let rest = (one - y.squared()).max(zero);
        let x = -((one - left) * rest.sqrt() + left * (radius * cos_phi));
        let z = (rest - x.squared()).max(zero).sqrt();
        let (x, y, z) = (a * x + b * z, c * y, d * x + z);
        Vec3::new(cos * x - sin * y, sin * x + cos * y, z).normalize()
    }

    /// `det²/|adj l|⁴ (n·adj l)/π`, of the part that is left.
    #[inline(always)]
    fn density(&self, l: Vec3<R>) -> R {
        let Self { a, b, c, d, left, azimuth: (cos, sin), .. } = *self;
        let (x, y) = (cos * l.x + sin * l.y, cos * l.y - sin * l.x);
        let plane = a - b * d;
        let back = Vec3::new(c * (x - b * l.z), plane * y, c * (a * l.z - d * x));
        let ratio = c * plane / back.length_squared();
        ratio.squared() * back.z.max(l.z.lift(0.0)).times(FRAC_1_PI) / left
    }
}

/// By a clipped linearly transformed cosine lobe, and evenly where `u[0]` is below a part of at most 0.163.
///
/// Portsmouth, Kutz and Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025, its "CLTC"
/// sampling with the fitted numbers. The transformed lobe vanishes at grazing light from behind, where the value does
/// not: hence the even part (test `eon_has_light_where_its_lobe_has_none`). Without roughness it is the cosine alone.
/// The weight is `f_r (n·l)/pdf`, a quotient of two numbers of the order of 1. The variance of a white one of `r = 1`
/// is a tenth of that by the cosine (test `eon_varies_less_than_by_the_cosine`: 0.023 for 0.215 at `n·v = 1/2`).
impl<R: Real> Draw<R> for Eon<R> {
    #[inline(always)]
    fn direction(&self, v: Vec3<R>, [choice, x, y]: [R; 3]) -> Vec3<R> {
        let lobe = Clipped::new(v, self.roughness());
        Vec3::select(choice.lt(lobe.even), tilted(x, y), lobe.direction([x, y]))
    }
    #[inline(always)]
    fn density(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        let lobe = Clipped::new(v, self.roughness());
        lobe.even.times(1.0 / TAU) + (l.z.lift(1.0) - lobe.even) * lobe.density(l)
    }
    #[inline(always)]
    fn weight(&self, l: Vec3<R>, v: Vec3<R>, pdf: R) -> Rgb<R> {
        self.eval_cos(l, v) / pdf
    }
    #[inline(always)]
    fn guess(&self, _: Vec3<R>) -> R {
        self.albedo().luminance()
    }
}

sample_by_drawing! {
    [] Lambert<R>;
    [] OrenNayar<R>;
    [] OrenNayarQualitative<R>;
    [] BurleyDiffuse<R>;
    [] Eon<R>;
}
