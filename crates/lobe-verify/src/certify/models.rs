//! The families and quantities of [`lobe`] that certificates are made for.

use super::{Axis, Certificate, Effort, Family, Number, Outcome, Quantity, Recheck, Symmetry, albedo, range};
use lobe::distribution::{Beckmann, Distribution, Ggx};
use lobe::fresnel::{Conductor, Fresnel, Incidence, Schlick};
use lobe::masking::{Masking, RationalBeckmann, SmithCorrelated, SmithSeparable};
use lobe::{Alpha, BlinnPhong, Brdf, CommonNormalization, Eon, Lambert, Microfacet, NormalIncidence, Phong};
use lobe::{Real, Rgb, Shininess, Vec3};
use std::fmt;

/// Families of one parameter: `name: Type { "parameter" } = |one, parameter| lobe`.
macro_rules! families {
    ($($(#[$doc:meta])* $name:ident, $label:literal, $axis:ident $parameter:literal: |$one:ident, $x:ident| $lobe:expr;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            /// From here.
            pub lo: f64,
            /// To here.
            pub hi: f64,
        }

        impl Family for $name {
            fn name(&self) -> String {
                $label.to_owned()
            }
            fn parameters(&self) -> Vec<Axis> {
                vec![Axis::$axis($parameter, self.lo, self.hi)]
            }
            fn symmetry(&self) -> Symmetry {
                Symmetry::Isotropic
            }
            fn lobe<R: Real>(&self, $one: R, parameters: &[R]) -> impl Brdf<R> {
                let $x = parameters[0];
                $lobe
            }
        }
    )+};
}

families! {
    /// [`Lambert`], by its albedo `ρ`.
    Lamberts, "lambert", linear "rho": |_one, rho| Lambert::new(Rgb::splat(rho));
    /// [`Phong`] with `ks = 1`, by its exponent `q`.
    Phongs, "phong", shifted "q": |one, q| Phong::new(Rgb::splat(one), Shininess(q));
    /// [`BlinnPhong`] with `ks = 1` and the normalisation at normal incidence, by its exponent `q`.
    BlinnPhongs, "blinn-phong", shifted "q":
        |one, q| BlinnPhong::<R, NormalIncidence>::with_normalization(Rgb::splat(one), Shininess(q));
    /// [`BlinnPhong`] with `ks = 1` and the [`CommonNormalization`], which gains energy, by its exponent `q`.
    CommonBlinnPhongs, "blinn-phong (q + 8)", shifted "q":
        |one, q| BlinnPhong::<R, CommonNormalization>::with_normalization(Rgb::splat(one), Shininess(q));
    /// [`Eon`] with `ρ = 1`, by its roughness `r`.
    Eons, "eon", linear "r": |one, r| Eon::new(Rgb::splat(one), r);
    /// GGX with Smith's correlated masking and `F = 1`, by its width `α`.
    Ggxs, "ggx", logarithmic "alpha":
        |one, alpha| Microfacet::new(Ggx::new(Alpha(alpha)), SmithCorrelated, Schlick::new(Rgb::splat(one)));
    /// Beckmann with Smith's correlated masking and `F = 1`, by its width `α`.
    Beckmanns, "beckmann", logarithmic "alpha":
        |one, alpha| Microfacet::new(Beckmann::new(Alpha(alpha)), SmithCorrelated, Schlick::new(Rgb::splat(one)));
}

/// Schlick's `F`, by `F0` and `cos θ`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchlickReflectance;

impl Quantity for SchlickReflectance {
    fn name(&self) -> String {
        "F of schlick".to_owned()
    }
    fn axes(&self) -> Vec<Axis> {
        vec![Axis::linear("F0", 0.0, 1.0), Axis::linear("cos", 0.0, 1.0)]
    }
    fn value<R: Number>(&self, x: &[R]) -> R {
        Schlick::new(Rgb::splat(x[0])).fresnel(Incidence::from_cos(x[1])).g
    }
}

/// Fresnel's `F` of a conductor, by `η`, `k` and `cos θ`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductorReflectance {
    /// The least `η`.
    pub least: f64,
}

impl Quantity for ConductorReflectance {
    fn name(&self) -> String {
        "F of a conductor".to_owned()
    }
    fn axes(&self) -> Vec<Axis> {
        vec![Axis::linear("eta", self.least, 4.0), Axis::linear("k", 0.0, 10.0), Axis::linear("cos", 0.0, 1.0)]
    }
    fn value<R: Number>(&self, x: &[R]) -> R {
        Conductor::new(Rgb::splat(x[0]), Rgb::splat(x[1])).fresnel(Incidence::from_cos(x[2])).g
    }
}

/// `G = 4 (n·l)(n·v) V` of a masking for a distribution, by the angles of light and viewer in half turns and the width
/// `α`. It does not depend on the azimuth.
pub trait MaskingTerm: Sync {
    /// What it is.
    fn name(&self) -> String;
    /// `V = G/(4 (n·l)(n·v))`.
    fn visibility<R: Real>(&self, alpha: R, l: Vec3<R>, v: Vec3<R>) -> R;
}

macro_rules! masking_terms {
    ($($(#[$doc:meta])* $name:ident, $label:literal: |$alpha:ident| $masking:expr, $distribution:expr;)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name;

        impl MaskingTerm for $name {
            fn name(&self) -> String {
                $label.to_owned()
            }
            fn visibility<R: Real>(&self, alpha: R, l: Vec3<R>, v: Vec3<R>) -> R {
                let $alpha = Alpha(alpha);
                // Neither of these looks at the facet.
                let one = alpha.lift(1.0);
                visibility(&$masking, &$distribution, l, v, one)
            }
        }
    )+};
}

fn visibility<R: Real, D: Distribution<R>, G: Masking<R, D>>(g: &G, d: &D, l: Vec3<R>, v: Vec3<R>, one: R) -> R {
    g.visibility(d, l, v, l, one, one)
}

masking_terms! {
    /// [`SmithCorrelated`] for GGX.
    GgxCorrelated, "G of smith, correlated, ggx": |alpha| SmithCorrelated, Ggx::new(alpha);
    /// [`SmithSeparable`] for GGX.
    GgxSeparable, "G of smith, separable, ggx": |alpha| SmithSeparable, Ggx::new(alpha);
    /// [`SmithCorrelated`] for Beckmann.
    BeckmannCorrelated, "G of smith, correlated, beckmann": |alpha| SmithCorrelated, Beckmann::new(alpha);
    /// [`SmithSeparable`] for Beckmann.
    BeckmannSeparable, "G of smith, separable, beckmann": |alpha| SmithSeparable, Beckmann::new(alpha);
    /// [`RationalBeckmann`]. Along the seam at `a = 1.6` a bound of its `G` stays open: numerator and denominator are
    /// selected apart there, and a box across it takes one of either side with the other of the other.
    Rational, "G of walter's rational form": |alpha| RationalBeckmann::new(alpha), Beckmann::new(alpha);
}

/// `G` of a [`MaskingTerm`], with the angles up to an end and a range of widths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaskingOf<T> {
    /// The term.
    pub term: T,
    /// The largest angle from the normal, in half turns.
    pub angle: f64,
    /// The least width.
    pub alpha: f64,
}

impl<T: MaskingTerm> Quantity for MaskingOf<T> {
    fn name(&self) -> String {
        self.term.name()
    }
    fn axes(&self) -> Vec<Axis> {
        let angle = |name| Axis::linear(name, 0.0, self.angle);
        vec![angle("light"), angle("view"), Axis::linear("alpha", self.alpha, 1.0)]
    }
    fn value<R: Number>(&self, x: &[R]) -> R {
        let (l, v) = (super::number::in_plane(x[0]), super::number::in_plane(x[1]));
        self.term.visibility(x[2], l, v) * (l.z * v.z).times(4.0)
    }
}

/// What a claim does: prove, and check.
type Prove = Box<dyn Fn(&Effort) -> Outcome + Send + Sync>;
type Check = Box<dyn Fn(&Certificate) -> Recheck + Send + Sync>;

/// A statement about a model, with the way to prove it and the way to check the proof.
pub struct Claim {
    name: String,
    prove: Prove,
    check: Check,
}

impl fmt::Debug for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Claim").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Claim {
    /// What is claimed.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The attempt to prove it.
    pub fn prove(&self, effort: &Effort) -> Outcome {
        (self.prove)(effort)
    }

    /// The proof, checked.
    pub fn check(&self, certificate: &Certificate) -> Recheck {
        (self.check)(certificate)
    }

    /// The quantity is within limits.
    pub fn range<Q: Quantity + Clone + Send + 'static>(quantity: Q, limits: (f64, f64)) -> Self {
        let checked = quantity.clone();
        Self {
            name: format!("{} in [{}, {}]", quantity.name(), limits.0, limits.1),
            prove: Box::new(move |effort| range::prove(&quantity, limits, effort)),
            check: Box::new(move |certificate| range::check(&checked, certificate)),
        }
    }

    /// `f_r cos θ` of the family is defined, finite and not negative, for cosines from `least`.
    pub fn lobe<F: Family + Clone + Send + 'static>(family: F, least: f64) -> Self {
        let checked = family.clone();
        Self {
            name: format!("eval_cos of {} finite and not negative", family.name()),
            prove: Box::new(move |effort| range::prove_lobe(&family, least, effort)),
            check: Box::new(move |certificate| range::check_lobe(&checked, least, certificate)),
        }
    }

    /// The directional albedo of the family is at most `limit`, for views up to an angle in half turns.
    pub fn albedo<F: Family + Clone + Send + 'static>(family: F, angle: f64, limit: f64) -> Self {
        let checked = family.clone();
        Self {
            name: format!("directional albedo of {} at most {limit}", family.name()),
            prove: Box::new(move |effort| albedo::prove(&family, Axis::linear("view", 0.0, angle), limit, effort)),
            check: Box::new(move |certificate| albedo::check(&checked, certificate)),
        }
    }
}
/// What is claimed of this library's lobes and terms, for the domains of a quick test or the wide ones.
///
/// The directional albedo of GGX and Beckmann is that of the lobes as they are, integrated: neither the weak furnace nor
/// any other identity of the model is used.
pub fn claims(effort: &Effort) -> Vec<Claim> {
    // 84.375°, n·v = 0.098; and 67.5°, 0.383. Views nearer the horizon need boxes that become as small as their cosines.
    const LOW: f64 = 15.0 / 32.0;
    const STEEP: f64 = 3.0 / 8.0;
    // The cosines of every lobe's domain, and of Eon's, whose `1 + r s/t` loses its sign to the quotient below them.
    const LEAST: f64 = 1e-20;
    const LEAST_OF_EON: f64 = 0.01;
    // Room for the outward rounding of a value that is reached: F = 1 at grazing incidence.
    const ROUNDING: f64 = 1e-12;
    let wide = effort.wide;
    let pick = |quick: f64, full: f64| if wide { full } else { quick };
    let unit = (0.0, 1.0);
    let masking = (0.0, 1.001);
    vec![
        Claim::range(SchlickReflectance, (0.0, 1.0 + ROUNDING)),
        Claim::range(ConductorReflectance { least: 0.05 }, unit),
        Claim::range(MaskingOf { term: GgxCorrelated, angle: LOW, alpha: 0.01 }, masking),
        Claim::range(MaskingOf { term: GgxSeparable, angle: LOW, alpha: 0.01 }, masking),
        Claim::range(
            MaskingOf { term: BeckmannCorrelated, angle: pick(STEEP, LOW), alpha: 0.1 },
            (0.0, pick(1.01, 1.001)),
        ),
        Claim::range(
            MaskingOf { term: BeckmannSeparable, angle: pick(STEEP, LOW), alpha: 0.1 },
            (0.0, pick(1.01, 1.001)),
        ),
        Claim::lobe(Lamberts { lo: 0.0, hi: 1.0 }, LEAST),
        Claim::lobe(Phongs { lo: 0.0, hi: 1e6 }, LEAST),
        Claim::lobe(BlinnPhongs { lo: 0.0, hi: 1e6 }, LEAST),
        Claim::lobe(Eons { lo: 0.0, hi: 1.0 }, LEAST_OF_EON),
        Claim::lobe(Ggxs { lo: 1e-4, hi: 1.0 }, LEAST),
        Claim::lobe(Beckmanns { lo: 1e-4, hi: 1.0 }, LEAST),
        Claim::albedo(Lamberts { lo: 0.0, hi: 1.0 }, LOW, 1.001),
        Claim::albedo(Phongs { lo: 0.0, hi: pick(4.0, 16.0) }, LOW, 1.05),
        Claim::albedo(BlinnPhongs { lo: 0.0, hi: pick(16.0, 64.0) }, LOW, 1.05),
        Claim::albedo(Eons { lo: 0.0, hi: 1.0 }, pick(STEEP, LOW), pick(1.07, 1.04)),
        Claim::albedo(Ggxs { lo: pick(0.4, 0.25), hi: 1.0 }, pick(STEEP, 13.0 / 32.0), 1.02),
        Claim::albedo(Beckmanns { lo: pick(0.6, 0.5), hi: 1.0 }, pick(0.25, STEEP), 1.05),
    ]
}

/// The outcome of all claims.
pub fn certificates(effort: &Effort) -> Vec<Outcome> {
    claims(effort).iter().map(|claim| claim.prove(effort)).collect()
}
