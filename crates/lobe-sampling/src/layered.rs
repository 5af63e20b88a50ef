//! Lobes under lobes: the samplers of both, and the value of the whole.

use crate::cosine::ByCosine;
use crate::facets::Bounded;
use crate::map::{cosine_hemisphere, cosine_hemisphere_pdf};
use crate::microfacet::{grey_value_and_pdf, mirrored};
use crate::mixture::{Part, blend, one_of_two, probability};
use crate::rules::{above, incidence_of, upwards};
use crate::{Sample, Sampled};
use lobe::fresnel::Fresnel;
use lobe::masking::SmithSeparable;
use lobe::{Brdf, Clearcoat, Coat, Real, Rgb, SheenLayer, Vec3};
use lobe_energy::{AlbedoCoat, CoupledDiffuse, FdezAguera, GgxAlbedo, KullaConty, Share, Turquin};

/// The probability of the first part, and the value and the density of the whole, for a lobe of two parts.
trait Layers<R: Real> {
    /// About what both parts reflect.
    fn guesses(&self, v: Vec3<R>) -> (R, R);
    fn top(&self, v: Vec3<R>, u: [R; 3]) -> Part<R>;
    fn base(&self, v: Vec3<R>, u: [R; 3]) -> Part<R>;
    /// The value of the whole, and the densities of both parts.
    fn value_and_pdfs(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, (R, R));

    #[inline(always)]
    fn layered(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        one_of_two(
            v,
            u,
            self.guesses(v),
            #[inline(always)]
            |u| self.top(v, u),
            #[inline(always)]
            |u| self.base(v, u),
            #[inline(always)]
            |l| self.value_and_pdf(l, v),
        )
    }
    #[inline(always)]
    fn value_and_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let (value, (top, base)) = self.value_and_pdfs(l, v);
        (value, blend(probability(self.guesses(v)), top, base))
    }
}

/// [`Sample`] for what has [`Layers`].
macro_rules! sample_layers {
    ($(#[$doc:meta])* [$($generics:tt)*] $lobe:ty, [$($bounds:tt)*]) => {
        $(#[$doc])*
        impl<$($generics)*> Sample<R> for $lobe
        where
            $($bounds)*
        {
            #[inline(always)]
            fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
                self.layered(v, u)
            }
            #[inline(always)]
            fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
                self.value_and_pdf(l, v).1
            }
            #[inline(always)]
            fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
                self.value_and_pdf(l, v)
            }
            #[inline(always)]
            fn albedo_guess(&self, v: Vec3<R>) -> R {
                let (top, base) = self.guesses(v);
                top + base
            }
        }
    };
}

impl<R: Real, T: Sample<R>, F: Fresnel<R>, B: Sample<R>> Layers<R> for Coat<T, F, B> {
    #[inline(always)]
    fn guesses(&self, v: Vec3<R>) -> (R, R) {
        let passed = self.interface().transmitted(incidence_of(v)).luminance();
        (Coat::top(self).albedo_guess(v), Coat::base(self).albedo_guess(v) * passed)
    }
    #[inline(always)]
    fn top(&self, v: Vec3<R>, u: [R; 3]) -> Part<R> {
        Part::whole(Coat::top(self).sample(v, u))
    }
    #[inline(always)]
    fn base(&self, v: Vec3<R>, u: [R; 3]) -> Part<R> {
        Part::of(
            Coat::base(self).sample(v, u),
            #[inline(always)]
            |l| self.transmitted(l, v),
        )
    }
    #[inline(always)]
    fn value_and_pdfs(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, (R, R)) {
        let ((top, top_pdf), (base, base_pdf)) =
            (Coat::top(self).eval_cos_pdf(l, v), Coat::base(self).eval_cos_pdf(l, v));
        (top + base * self.transmitted(l, v), (top_pdf, base_pdf))
    }
}

sample_layers! {
    /// The top or the base is drawn. Either may be a mirror.
    [R: Real, T, F, B] Coat<T, F, B>, [T: Sample<R>, F: Fresnel<R>, B: Sample<R>]
}

/// The way of the coat's facets.
const COAT: Bounded = Bounded;

impl<R: Real, B: Sample<R>> Layers<R> for Clearcoat<B, R> {
    #[inline(always)]
    fn guesses(&self, v: Vec3<R>) -> (R, R) {
        let v = Vec3::new(v.x, v.y, incidence_of(v).cos);
        (self.reflected(v), Clearcoat::base(self).albedo_guess(v) * self.transmitted(v))
    }
    #[inline(always)]
    fn top(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Part<R> {
        Part::scattered(mirrored(self.distribution(), &COAT, v, [x, y]))
    }
    #[inline(always)]
    fn base(&self, v: Vec3<R>, u: [R; 3]) -> Part<R> {
        Part::of(
            Clearcoat::base(self).sample(v, u),
            #[inline(always)]
            |l| Rgb::splat(above(l, v, self.transmitted(v))),
        )
    }
    #[inline(always)]
    fn value_and_pdfs(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, (R, R)) {
        let (coat, coat_pdf) = grey_value_and_pdf(self.distribution(), &SmithSeparable, &COAT, l, v);
        let (base, base_pdf) = Clearcoat::base(self).eval_cos_pdf(l, v);
        // Selected too: an x⁵ below the horizon may be no number.
        let (reflected, passed) = (above(l, v, self.reflected(v)), above(l, v, self.transmitted(v)));
        (base * passed + Rgb::splat(coat * reflected), (coat_pdf, base_pdf))
    }
}

sample_layers! {
    /// The coat or the base is drawn.
    [R: Real, B] Clearcoat<B, R>, [B: Sample<R>]
}

impl<R: Real, B: Sample<R>> Layers<R> for SheenLayer<B, R> {
    #[inline(always)]
    fn guesses(&self, v: Vec3<R>) -> (R, R) {
        let v = upwards(v);
        let left = self.transmitted(v, v);
        // What the sheen takes of the base is what it reflects, in its brightest channel; its table is 0 where a sharp
        // one reflects next to nothing, and yet it does.
        let least = self.sheen_color().luminance().times(1.0 / 256.0);
        ((left.lift(1.0) - left).max(least), SheenLayer::base(self).albedo_guess(v) * left)
    }
    #[inline(always)]
    fn top(&self, _: Vec3<R>, [_, x, y]: [R; 3]) -> Part<R> {
        Part::scattered(cosine_hemisphere([x, y]))
    }
    #[inline(always)]
    fn base(&self, v: Vec3<R>, u: [R; 3]) -> Part<R> {
        Part::of(
            SheenLayer::base(self).sample(v, u),
            #[inline(always)]
            |l| Rgb::splat(self.transmitted(l, v)),
        )
    }
    #[inline(always)]
    fn value_and_pdfs(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, (R, R)) {
        let (sheen, sheen_pdf) = ByCosine(self.sheen()).eval_cos_pdf(l, v);
        let (base, base_pdf) = SheenLayer::base(self).eval_cos_pdf(l, v);
        (sheen + base * self.transmitted(l, v), (sheen_pdf, base_pdf))
    }
}

sample_layers! {
    /// The sheen, by the cosine, or the base is drawn.
    [R: Real, B] SheenLayer<B, R>, [B: Sample<R>]
}

impl<R: Real, B: Sample<R>, S: Share<R>> Layers<R> for AlbedoCoat<B, S, R> {
    #[inline(always)]
    fn guesses(&self, v: Vec3<R>) -> (R, R) {
        let v = Vec3::new(v.x, v.y, incidence_of(v).cos);
        let top = AlbedoCoat::top(self).albedo_guess(v);
        (top, AlbedoCoat::base(self).albedo_guess(v) * (top.lift(1.0) - top).max(top.lift(0.0)))
    }
    #[inline(always)]
    fn top(&self, v: Vec3<R>, u: [R; 3]) -> Part<R> {
        Part::whole(AlbedoCoat::top(self).sample(v, u))
    }
    #[inline(always)]
    fn base(&self, v: Vec3<R>, u: [R; 3]) -> Part<R> {
        Part::of(
            AlbedoCoat::base(self).sample(v, u),
            #[inline(always)]
            |l| Rgb::splat(self.transmitted(l, v)),
        )
    }
    #[inline(always)]
    fn value_and_pdfs(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, (R, R)) {
        let (coat, coat_pdf) = AlbedoCoat::top(self).eval_cos_pdf(l, v);
        let (base, base_pdf) = AlbedoCoat::base(self).eval_cos_pdf(l, v);
        (coat + base * self.transmitted(l, v), (coat_pdf, base_pdf))
    }
}

sample_layers! {
    /// The coat or the base is drawn.
    [R: Real, B, S] AlbedoCoat<B, S, R>, [B: Sample<R>, S: Share<R>]
}

/// A GGX and something wide beside it, whose own value says how both add up.
macro_rules! ggx_and_the_rest {
    ($($(#[$doc:meta])* [$($generics:tt)*] $lobe:ty, [$($bounds:tt)*], |$this:ident, $v:ident| $guesses:expr;)+) => {$(
        impl<$($generics)*> Layers<R> for $lobe
        where
            $($bounds)*
        {
            #[inline(always)]
            fn guesses(&self, v: Vec3<R>) -> (R, R) {
                let ($this, $v) = (self, v);
                $guesses
            }
            #[inline(always)]
            fn top(&self, v: Vec3<R>, [_, x, y]: [R; 3]) -> Part<R> {
                Part::scattered(mirrored(self.single().distribution(), &COAT, v, [x, y]))
            }
            #[inline(always)]
            fn base(&self, _: Vec3<R>, [_, x, y]: [R; 3]) -> Part<R> {
                Part::scattered(cosine_hemisphere([x, y]))
            }
            #[inline(always)]
            fn value_and_pdfs(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, (R, R)) {
                (self.eval_cos(l, v), (self.single().pdf(l, v), above(l, v, cosine_hemisphere_pdf(l))))
            }
        }
        sample_layers! { $(#[$doc])* [$($generics)*] $lobe, [$($bounds)*] }
    )+};
}

ggx_and_the_rest! {
    /// A facet is drawn, or a direction by the cosine for what is reflected further.
    [R: Real, F, E] KullaConty<F, R, E>, [F: Fresnel<R>, E: GgxAlbedo<R>],
    |this, v| {
        // Of rough facets up to 0.6 is reflected further, in proportion to about the width.
        let alpha = this.single().distribution().alpha().0;
        let single = this.single().albedo_guess(v);
        (single, single * alpha.times(0.5))
    };
    /// A facet is drawn, or a direction by the cosine: every lobe of this kind has a wide part.
    [R: Real] FdezAguera<R>, [],
    |this, v| (this.single().albedo_guess(v), v.z.lift(0.5));
    /// A facet is drawn, or a direction by the cosine for the base.
    [R: Real] CoupledDiffuse<R>, [],
    |this, v| (this.single().albedo_guess(v), v.z.lift(0.5));
}

/// By the facets alone: it has the shape of the single reflections, scaled.
impl<R: Real, F: Fresnel<R>, E: GgxAlbedo<R>> Sample<R> for Turquin<F, R, E> {
    #[inline(always)]
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        let single = self.single().sample(v, u);
        let gain = self.gain(single.l, v);
        Sampled { weight: Rgb::select(single.rejected, single.weight, single.weight * gain), ..single }
    }
    #[inline(always)]
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        self.single().pdf(l, v)
    }
    #[inline(always)]
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let (value, pdf) = self.single().eval_cos_pdf(l, v);
        (value * self.gain(l, v), pdf)
    }
    #[inline(always)]
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        self.single().albedo_guess(v)
    }
}
