//! Low, Kronander, Ynnerman, Unger: `f_r = A F(θ_d)/(1 + B |l_xy + v_xy|²)^C`, and with facets
//! `f_r = A F(θ_d) G (1 + B (1 − n·h))^(−C)/(π (n·l)(n·v))`.

use super::microfacet::Facet;
use super::{Brdf, above_horizon};
use crate::carry::carry;
use crate::color::Rgb;
use crate::fresnel::{Dielectric, Fresnel, Incidence};
use crate::masking::{Masking, VCavity};
use crate::number::Real;
use crate::parameter::Ior;
use crate::vector::Vec3;
use core::f64::consts::PI;

/// `(1 + B x)^(−C)`: the "ABC" form that the power spectra of polished surfaces have.
///
/// The logarithm of `1 + B x` is taken without forming the sum, so that nothing is lost for small `B x`.
#[inline(always)]
fn abc<R: Real>(b: R, c: R, x: R) -> R {
    (-c * (b * x).log2_1p()).exp2()
}

/// The smooth-surface model: `f_r = A F(θ_d)/(1 + B |l_xy + v_xy|²)^C` sr⁻¹.
///
/// Löw, Kronander, Ynnerman and Unger, "BRDF Models for Accurate and Efficient Rendering of Glossy Surfaces", ACM
/// Transactions on Graphics 31(1), 2012, equations 9 to 14. From the Rayleigh-Rice theory of scattering by surfaces that
/// are smooth against the wavelength: the lobe is a function of the projected deviation `l_xy + v_xy` from the mirror
/// direction. `F` is the reflectance of a dielectric of index `η`, at the angle with `sin²θ_d = |l_xy − v_xy|²/4`; the
/// cosine is computed as `√(|l_xy + v_xy|² + 2 (n·l)² + 2 (n·v)²)/2`, which is the same for unit vectors and does not
/// cancel.
///
/// The three numbers are fitted, not measured: nothing bounds the albedo.
///
/// Reciprocal to the last bit. Domain: `A ∈ [0, 10⁴]`, `B ∈ [0, 10⁷]`, `C ∈ [0, 3]`, `η ∈ [1, 100]`. Relative error at most
/// 2e-5 against `f64` of the same inputs: the exponent, below 53, is off by `6u`, and `C u` times 5 from `B x`.
///
/// ```
/// use lobe::{Brdf, Ior, LowSmooth, Rgb, Vec3};
/// // Their fit of the PVC of the MERL data.
/// let pvc = LowSmooth::new(Rgb::new(160.17775_f32, 153.97784, 149.6), 3148.802163, 1.005975, Ior(1.17567));
/// let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
/// assert!(pvc.eval(l, v).r > 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowSmooth<R = f32> {
    a: Rgb<R>,
    b: R,
    c: R,
    fresnel: Dielectric<R>,
}

carry!([] LowSmooth<f32> => LowSmooth<S> { a, b, c, fresnel });

/// The microfacet model: `f_r = A F(θ_d) G (1 + B (1 − n·h))^(−C)/(π (n·l)(n·v))` sr⁻¹, `G` of V-cavities.
///
/// Löw et al. 2012, equation 15: the ABC form in place of a distribution, not normalised. The factor `1/π` belongs to the
/// fits that the authors published; the equation in the paper leaves it to `A`.
///
/// Reciprocal to the last bit. Domain and error as for [`LowSmooth`]. `1 − n·h` is `(h.x² + h.y²)/(1 + h.z)`, which does not
/// cancel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowMicrofacet<R = f32> {
    a: Rgb<R>,
    b: R,
    c: R,
    fresnel: Dielectric<R>,
}

carry!([] LowMicrofacet<f32> => LowMicrofacet<S> { a, b, c, fresnel });

macro_rules! parameters {
    ($($name:ident)+) => {$(
        impl<R: Real> $name<R> {
            /// The lobe with the height `A`, the width `1/√B` and the fall `C`, of index `η`.
            #[inline(always)]
            pub fn new(a: Rgb<R>, b: R, c: R, eta: Ior<R>) -> Self {
                Self { a, b, c, fresnel: Dielectric::new(eta) }
            }

            /// The height `A`.
            #[inline(always)]
            pub fn a(&self) -> Rgb<R> {
                self.a
            }

            /// `B`: the width is `1/√B`.
            #[inline(always)]
            pub fn b(&self) -> R {
                self.b
            }

            /// The fall `C`.
            #[inline(always)]
            pub fn c(&self) -> R {
                self.c
            }

            /// The index `η`.
            #[inline(always)]
            pub fn ior(&self) -> Ior<R> {
                self.fresnel.ior()
            }

            /// The same lobe in another number type.
            #[inline(always)]
            pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> $name<S> {
                $name::new(self.a.map(&f), f(self.b), f(self.c), self.fresnel.ior().map(&f))
            }
        }
    )+};
}
parameters!(LowSmooth LowMicrofacet);

impl<R: Real> Brdf<R> for LowSmooth<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let (sx, sy, dx, dy) = (l.x + v.x, l.y + v.y, l.x - v.x, l.y - v.y);
        let deviation2 = sx.squared() + sy.squared();
        let sin2 = (dx.squared() + dy.squared()).times(0.25);
        // Of grazing cosines the squares may underflow; then F is 1 to the last digit, with or without.
        let cos2 = (deviation2 + (l.z.squared() + v.z.squared()).times(2.0)).times(0.25);
        let cos = cos2.sqrt().min(cos2.lift(1.0));
        let lobe = above_horizon(l, v, abc(self.b, self.c, deviation2));
        self.fresnel.fresnel(Incidence::new(cos, sin2)) * self.a * lobe
    }
}

impl<R: Real> LowMicrofacet<R> {
    #[inline(always)]
    fn weighted(&self, l: Vec3<R>, v: Vec3<R>, weight: R) -> Rgb<R> {
        let facet = Facet::between(l, v);
        let (h, cos_d) = (facet.normal(), facet.cos());
        let from_peak = (h.x.squared() + h.y.squared()) / h.z.plus(1.0);
        let visibility = VCavity.visibility(&(), l, v, h, cos_d, weight.times(4.0 / PI));
        let lobe = above_horizon(l, v, abc(self.b, self.c, from_peak) * visibility);
        self.fresnel.fresnel(Incidence::halfway(l, v, cos_d)) * self.a * lobe
    }
}

impl<R: Real> Brdf<R> for LowMicrofacet<R> {
    #[inline(always)]
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z.lift(1.0))
    }

    #[inline(always)]
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weighted(l, v, l.z)
    }
}
