//! The parts of a microfacet lobe that are chosen at run time: one type for all forms.
//!
//! A match and not a pointer, so that lanes may pass: all of a register take the same arm.

use lobe::distribution::SmithLambda;
use lobe::fresnel::{
    Conductor, CookFresnel, Dielectric, F82Tint, Fresnel, Gulbrandsen, Incidence, Lazanyi, SchlickF90,
};
use lobe::masking::{
    Hammon, Implicit, Kelemen, Masking, Neumann, RationalBeckmann, SchlickGgx, SmithCorrelated, SmithSeparable, VCavity,
};
use lobe::number::Quotient;
use lobe::{Carry, Real, Rgb, Vec3};

/// One type for the forms of a part: `$name<R>` with a variant for each, and [`Carry`] for it.
macro_rules! forms {
    ($(#[$doc:meta])* $name:ident { $($variant:ident($type:ident $(<$number:ident>)?)),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(crate) enum $name<R> {
            $($variant($type $(<$number>)?)),+
        }

        impl Carry for $name<f32> {
            type In<S: Real> = $name<S>;
            #[inline(always)]
            fn carry<S: Real>(&self, lift: &impl Fn(f32) -> S) -> $name<S> {
                match self {
                    $(Self::$variant(form) => $name::$variant(form.carry(lift))),+
                }
            }
        }
    };
}

forms! {
    /// `F`.
    AnyFresnel {
        Schlick(SchlickF90<R>),
        Dielectric(Dielectric<R>),
        Conductor(Conductor<R>),
        Cook(CookFresnel<R>),
        F82Tint(F82Tint<R>),
        Gulbrandsen(Gulbrandsen<R>),
        Lazanyi(Lazanyi<R>),
    }
}

impl<R: Real> Fresnel<R> for AnyFresnel<R> {
    #[inline(always)]
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        match self {
            Self::Schlick(f) => f.fresnel(incidence),
            Self::Dielectric(f) => f.fresnel(incidence),
            Self::Conductor(f) => f.fresnel(incidence),
            Self::Cook(f) => f.fresnel(incidence),
            Self::F82Tint(f) => f.fresnel(incidence),
            Self::Gulbrandsen(f) => f.fresnel(incidence),
            Self::Lazanyi(f) => f.fresnel(incidence),
        }
    }
}

forms! {
    /// `G` without Smith's, which only a distribution with a `Λ` has.
    AnyMasking {
        VCavity(VCavity),
        Implicit(Implicit),
        Neumann(Neumann),
        Kelemen(Kelemen),
        Hammon(Hammon<R>),
        SchlickGgx(SchlickGgx<R>),
        RationalBeckmann(RationalBeckmann<R>),
    }
}

impl<R: Real, D> Masking<R, D> for AnyMasking<R> {
    #[inline(always)]
    fn quotient(&self, d: &D, l: Vec3<R>, v: Vec3<R>, h: Vec3<R>, cos_d: R, weight: R) -> Quotient<R> {
        match self {
            Self::VCavity(g) => g.quotient(d, l, v, h, cos_d, weight),
            Self::Implicit(g) => g.quotient(d, l, v, h, cos_d, weight),
            Self::Neumann(g) => g.quotient(d, l, v, h, cos_d, weight),
            Self::Kelemen(g) => g.quotient(d, l, v, h, cos_d, weight),
            Self::Hammon(g) => g.quotient(d, l, v, h, cos_d, weight),
            Self::SchlickGgx(g) => g.quotient(d, l, v, h, cos_d, weight),
            Self::RationalBeckmann(g) => g.quotient(d, l, v, h, cos_d, weight),
        }
    }
}

forms! {
    /// `G`, Smith's among them.
    AnySmith {
        Correlated(SmithCorrelated),
        Separable(SmithSeparable),
        Other(AnyMasking<R>),
    }
}

impl<R: Real, D: SmithLambda<R>> Masking<R, D> for AnySmith<R> {
    #[inline(always)]
    fn quotient(&self, d: &D, l: Vec3<R>, v: Vec3<R>, h: Vec3<R>, cos_d: R, weight: R) -> Quotient<R> {
        match self {
            Self::Correlated(g) => g.quotient(d, l, v, h, cos_d, weight),
            Self::Separable(g) => g.quotient(d, l, v, h, cos_d, weight),
            Self::Other(g) => g.quotient(d, l, v, h, cos_d, weight),
        }
    }
}
