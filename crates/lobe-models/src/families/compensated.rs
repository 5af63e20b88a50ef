//! GGX with what single reflections lose: further reflections given back, and diffuse bases under it.

use super::fresnel::{self, any_fresnel};
use super::{U, constructor, constructors};
use crate::forms::AnyFresnel;
use crate::{Bound, Model, Number, Parameter, Reader, Value};
use lobe::{Alpha, MetallicRoughness, Vec3};
use lobe_energy::{
    AlbedoCoat, Corner, CoupledDiffuse, FdezAguera, GgxAlbedo, GgxFit, GgxTable, KullaConty, Least, Turquin,
    average_fresnel,
};

/// One width: what is lost depends on the direction's azimuth where there are two, and no table knows that.
const ALPHA: Parameter = Parameter::number("alpha", 1e-4, 1.0, "the width α of the distribution");

pub(super) static MODELS: &[Model] = &[
    Model {
        name: "kulla-conty",
        summary: "GGX and its further reflections as a lobe of their own (Kulla and Conty 2017), reciprocal",
        parameters: INTERFACE,
        reciprocal: true,
        finite: true,
        bound: Bound::Excess {
            formula: "2e-5, what microfacet adds for its Fresnel term, and \
                      8u F_ms (w_l (1 − E(v)) + w_v (1 − E(l)))/(π (1 − E_mean) f), \
                      w = x (α² + α (1 − x) + (1 − x)²/2), x ≈ cos θ/(cos θ + α)",
            at: kulla_conty_bound,
        },
        build: constructors!(kulla_conty),
    },
    Model {
        name: "turquin",
        summary: "GGX brightened by what it loses towards the viewer (Turquin 2019; Filament's compensation)",
        parameters: INTERFACE,
        reciprocal: false,
        finite: true,
        bound: Bound::Excess { formula: "2e-5, and what microfacet adds for its Fresnel term", at: interface_bound },
        build: constructors!(turquin),
    },
    Model {
        name: "fdez-aguera",
        summary: "GGX with its further reflections and a diffuse base, by the viewer's cosine (Fdez-Agüera 2019)",
        parameters: &[
            Parameter::reflectance("albedo", "the albedo of the base; 0 for metals"),
            ALPHA,
            Parameter::reflectance("f0", "the reflectance at normal incidence"),
        ],
        reciprocal: false,
        finite: true,
        bound: Bound::Excess { formula: "2e-5 + 4u (1 − E) (1 − f0)/(π f)", at: fdez_aguera_bound },
        build: constructors!(fdez_aguera),
    },
    Model {
        name: "coupled-diffuse",
        summary: "a diffuse base under a GGX dielectric, nothing lost (Kelemen and Szirmay-Kalos 2001), reciprocal",
        parameters: &[
            Parameter::reflectance("albedo", "the albedo of the base"),
            ALPHA,
            // Of a metal nothing reaches a base.
            Parameter::number("f0", 0.0, 0.5, "the reflectance at normal incidence").or(Value::Number(0.04)),
        ],
        reciprocal: true,
        finite: true,
        bound: Bound::Constant,
        build: constructors!(coupled_diffuse),
    },
    Model {
        name: "albedo-coat",
        summary: "metallic-roughness of glTF under a GGX coat, scaled by what the coat's albedo leaves, reciprocal",
        parameters: &[
            Parameter::reflectance("base-color", "the base colour"),
            Parameter::number("metallic", 0.0, 1.0, "0 dielectric, 1 metal").or(Value::Number(1.0)),
            Parameter::number("roughness", 0.01, 1.0, "the perceptual roughness of the base, whose square is its α")
                .or(Value::Number(1.0)),
            Parameter { doc: "the width α of the coat", ..ALPHA },
            Parameter::number("f0", 0.0, 0.5, "the coat's reflectance at normal incidence").or(Value::Number(0.04)),
        ],
        reciprocal: true,
        finite: true,
        bound: Bound::Constant,
        build: constructors!(albedo_coat),
    },
];

/// A conductor or a dielectric.
const INTERFACE: &[Parameter] = &[
    ALPHA,
    // Those of metals and of glass: of a difference, such as F82-tint, the mean loses digits too.
    Parameter::choice("fresnel", &["schlick", "dielectric", "conductor"], "the Fresnel term F"),
    fresnel::F0,
    fresnel::F90,
    fresnel::IOR,
    fresnel::METAL,
    fresnel::ETA,
    fresnel::K,
];

fn interface_bound(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    Bound::WORST + fresnel::excess(p, l, v)
}

/// The polynomial of the loss is a sum of terms near 1, and may itself be near 0 at grazing light: its error is one of
/// `8u` beside them, and counts where the single reflection is as dark.
fn kulla_conty_bound(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let (f, energy) = (kulla_conty::brdf(p).brdf.eval(l, v), GgxFit::new(alpha(p)));
    let one = |mu: f64| {
        let corner = Corner::new(alpha(p).0, mu);
        (corner.x * corner.scale, energy.loss(mu))
    };
    let (((w_l, loss_l), (w_v, loss_v)), mean) = ((one(l.z), one(v.z)), energy.mean_loss());
    let further = average_fresnel(&any_fresnel(p), 1.0).map(|f| f * f * (1.0 - mean) / (1.0 - f * mean));
    let part = |f: f64, further: f64| {
        // Nothing of nothing.
        if further == 0.0 { 0.0 } else { further * (w_l * loss_v + w_v * loss_l) / (core::f64::consts::PI * mean * f) }
    };
    let most = [part(f.r, further.r), part(f.g, further.g), part(f.b, further.b)].into_iter().fold(0.0, f64::max);
    interface_bound(p, l, v) + 8.0 * U * most
}

fn alpha<R: Number>(p: &Reader<'_, R>) -> Alpha<R> {
    Alpha(p.number(ALPHA.name))
}

constructor! { kulla_conty |p, finish| {
    let lobe: KullaConty<AnyFresnel<R>, R, GgxFit<R>> = KullaConty::new(alpha(p), any_fresnel(p));
    finish(lobe)
} }

constructor! { turquin |p, finish| {
    let lobe: Turquin<AnyFresnel<R>, R, GgxFit<R>> = Turquin::new(alpha(p), any_fresnel(p));
    finish(lobe)
} }

// The table adds up its nodes one by one: as lanes it would be too much code.
constructor! { pointwise: fdez_aguera |p, finish| {
    finish(FdezAguera::new(alpha(p), p.rgb("f0"), p.rgb("albedo")))
} }

constructor! { pointwise: coupled_diffuse |p, finish| {
    finish(CoupledDiffuse::new(alpha(p), p.number("f0"), p.rgb("albedo")))
} }

fn base_alpha<R: Number>(p: &Reader<'_, R>) -> Alpha<R> {
    Alpha(p.number("roughness").squared())
}

constructor! { pointwise: albedo_coat |p, finish| {
    let width = base_alpha(p);
    let base = MetallicRoughness::new(p.rgb("base-color"), p.number("metallic"), width);
    let coat: AlbedoCoat<MetallicRoughness<R>, Least, R> = AlbedoCoat::new(alpha(p), p.number("f0"), base);
    finish(coat)
} }

/// The mean of Schlick's term over a reflection is 1 less something near 1 where `f0` is 0, and its error counts as far
/// as further reflections do.
fn fdez_aguera_bound(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let (f, f0) = (fdez_aguera::brdf(p).brdf.eval(l, v), p.rgb("f0"));
    let loss = GgxTable::new(alpha(p)).loss(v.z);
    let part = |f: f64, f0: f64| 4.0 * U * loss * (1.0 - f0) / (core::f64::consts::PI * f);
    Bound::WORST + [part(f.r, f0.r), part(f.g, f0.g), part(f.b, f0.b)].into_iter().fold(0.0, f64::max)
}
