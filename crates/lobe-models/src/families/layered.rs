//! glTF 2.0 with its extensions, and coats.

use super::{U, constructor, constructors};
use crate::{Bound, Model, Number, Parameter, Reader, Value};
use lobe::distribution::{Ggx, GgxAnisotropic};
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Clearcoat, Coat, Lambert, MetallicRoughness, Microfacet, Real as _, Rgb, SheenLayer, Vec3};

const ROUGHNESS: Parameter = Parameter::number("roughness", 0.01, 1.0, "the perceptual roughness, whose square is α");

pub(super) static MODELS: &[Model] = &[
    Model {
        name: "gltf",
        summary: "metallic-roughness of glTF 2.0, appendix B, with KHR_materials_ior, specular and anisotropy",
        parameters: GLTF,
        reciprocal: true,
        finite: true,
        bound: Bound::Excess { formula: OF_BASE, at: gltf_bound },
        build: constructors!(gltf),
    },
    Model {
        name: "gltf-clearcoat",
        summary: "the same under KHR_materials_clearcoat, whose energy split depends on the viewer alone",
        parameters: GLTF_CLEARCOAT,
        reciprocal: false,
        finite: true,
        bound: Bound::Excess { formula: OF_BASE, at: clearcoat_bound },
        build: constructors!(gltf_clearcoat),
    },
    Model {
        name: "gltf-sheen",
        summary: "the same under KHR_materials_sheen, scaled by the sheen's albedo",
        parameters: GLTF_SHEEN,
        reciprocal: true,
        finite: true,
        bound: Bound::Excess { formula: "that of gltf + that of charlie + 40u base/f", at: sheen_bound },
        build: constructors!(gltf_sheen),
    },
    Model {
        name: "coat",
        summary: "Lambert under a GGX coat, split by the coat's Fresnel term both ways",
        parameters: &[
            Parameter::reflectance("albedo", "the albedo of the base"),
            Parameter::alpha(),
            Parameter::reflectance("f0", "the coat's reflectance at normal incidence"),
        ],
        reciprocal: true,
        finite: true,
        bound: Bound::Constant,
        build: constructors!(coat),
    },
];

const UNIT: Parameter = Parameter::number("", 0.0, 1.0, "");
const GLTF: &[Parameter] = &[
    Parameter::reflectance("base-color", "the base colour"),
    Parameter { name: "metallic", doc: "0 dielectric, 1 metal", ..UNIT }.or(Value::Number(1.0)),
    ROUGHNESS.or(Value::Number(1.0)),
    Parameter::number("ior", 1.0, 4.0, "KHR_materials_ior").or(Value::Number(1.5)),
    Parameter { name: "specular", doc: "KHR_materials_specular, the weight", ..UNIT }.or(Value::Number(1.0)),
    Parameter {
        name: "specular-color",
        kind: crate::Kind::Colour { max: 25.0 },
        default: Some(Value::Colour([1.0; 3])),
        doc: "KHR_materials_specular, the colour of f0",
    },
    Parameter { name: "anisotropy", doc: "KHR_materials_anisotropy, the strength", ..UNIT }.or(Value::Number(0.0)),
];
const GLTF_CLEARCOAT: &[Parameter] = &gltf_and([
    Parameter { name: "clearcoat", doc: "the intensity of the coat", ..UNIT }.or(Value::Number(1.0)),
    // The specification's default is 0, a mirror; that is a delta, and the domain begins at 0.01.
    Parameter::number("clearcoat-roughness", 0.01, 1.0, "its perceptual roughness").or(Value::Number(0.01)),
]);
const GLTF_SHEEN: &[Parameter] = &gltf_and([
    Parameter::reflectance("sheen-color", "the colour of the sheen"),
    Parameter::number("sheen-roughness", 0.1, 1.0, "its perceptual roughness").or(Value::Number(0.5)),
]);

/// The parameters of the material and the two of the layer above it.
const fn gltf_and([first, second]: [Parameter; 2]) -> [Parameter; GLTF.len() + 2] {
    let mut all = [first; GLTF.len() + 2];
    let mut i = 0;
    while i < GLTF.len() {
        all[i] = GLTF[i];
        i += 1;
    }
    all[GLTF.len() + 1] = second;
    all
}

/// `α = r²`.
fn alpha<R: Number>(p: &Reader<'_, R>, name: &str) -> Alpha<R> {
    Alpha(p.number(name).squared())
}

/// The material as long as it is the same all around. Where it is not, its masking is another, as the specification has
/// it: the one place where a type depends on whether a parameter is there.
fn isotropic<R: Number>(p: &Reader<'_, R>) -> MetallicRoughness<R> {
    let plain = MetallicRoughness::new(p.rgb("base-color"), p.number("metallic"), alpha(p, "roughness"));
    plain.with_specular(p.number("ior"), p.number("specular"), p.rgb("specular-color"))
}

/// The material that is not.
fn anisotropic<R: Number>(p: &Reader<'_, R>) -> MetallicRoughness<R, SmithCorrelated, GgxAnisotropic<R>> {
    isotropic(p).with_anisotropy(p.number("anisotropy"))
}

constructor! { gltf |p, finish| {
    if p.is_zero("anisotropy") { finish(isotropic(p)) } else { finish(anisotropic(p)) }
} }

constructor! { gltf_clearcoat |p, finish| {
    let (weight, alpha) = (p.number("clearcoat"), alpha(p, "clearcoat-roughness"));
    if p.is_zero("anisotropy") {
        finish(Clearcoat::new(isotropic(p), weight, alpha))
    } else {
        finish(Clearcoat::new(anisotropic(p), weight, alpha))
    }
} }

constructor! { gltf_sheen |p, finish| {
    let (color, alpha) = (p.rgb("sheen-color"), alpha(p, "sheen-roughness"));
    if p.is_zero("anisotropy") {
        finish(SheenLayer::new(isotropic(p), color, alpha))
    } else {
        finish(SheenLayer::new(anisotropic(p), color, alpha))
    }
} }

constructor! { coat |p, finish| {
    let (x, y) = p.widths("alpha");
    let interface = Schlick::new(p.rgb("f0"));
    let top = Microfacet::new(Ggx::anisotropic(x, y), SmithCorrelated, interface);
    finish(Coat::new(top, interface, Lambert::new(p.rgb("albedo"))))
} }

const OF_BASE: &str = "2e-5 + 8u w f0 (1 − metallic) base-color/(π f), f0 = ((η − 1)/(η + 1))² specular-color";

/// The diffuse base has what is left of 1 by `w max(f0)`, which has eight roundings: near 1 they are all that is left.
fn of_base(p: &Reader<'_, f64>, f: Rgb<f64>) -> f64 {
    let (base, color, ior) = (p.rgb("base-color"), p.rgb("specular-color"), p.number("ior"));
    let f0 = (color.r.max(color.g).max(color.b) * ((ior - 1.0) / (ior + 1.0)).squared()).min(1.0);
    let error = 8.0 * U * p.number("specular") * f0 * (1.0 - p.number("metallic")) * core::f64::consts::FRAC_1_PI;
    // Nothing of nothing.
    let of = |base: f64, f: f64| if error * base == 0.0 { 0.0 } else { error * base / f };
    Bound::WORST + of(base.r, f.r).max(of(base.g, f.g)).max(of(base.b, f.b))
}

fn gltf_bound(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    of_base(p, gltf::brdf(p).brdf.eval(l, v))
}

/// The coat lets through 1 at most.
fn clearcoat_bound(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    of_base(p, gltf_clearcoat::brdf(p).brdf.eval(l, v))
}

/// What the base is scaled with is 1 less something near 1: its error counts as far as the base is seen.
fn sheen_bound(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let (base, layered) = (gltf::brdf(p).brdf.eval(l, v), gltf_sheen::brdf(p).brdf.eval(l, v));
    let seen = [base.r / layered.r, base.g / layered.g, base.b / layered.b].into_iter().fold(0.0, f64::max);
    of_base(p, layered) + super::diffuse::of_sheen(alpha(p, "sheen-roughness").0, l, v) + 40.0 * U * seen
}
