//! glTF 2.0 with its extensions, and coats.

use super::constructors;
use crate::{AnyBrdf, Bound, Model, Number, Parameter, Reader, Value};
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Clearcoat, Coat, Lambert, MetallicRoughness, Microfacet, Rgb, SheenLayer, Vec3};

const ROUGHNESS: Parameter = Parameter::number("roughness", 0.01, 1.0, "the perceptual roughness, whose square is α");

pub(super) const MODELS: &[Model] = &[
    Model {
        name: "gltf",
        summary: "metallic-roughness of glTF 2.0, appendix B, with KHR_materials_ior, specular and anisotropy",
        parameters: GLTF,
        reciprocal: true,
        finite: true,
        bound: Bound::Constant,
        build: constructors!(gltf),
    },
    Model {
        name: "gltf-clearcoat",
        summary: "the same under KHR_materials_clearcoat, whose energy split depends on the viewer alone",
        parameters: GLTF_CLEARCOAT,
        reciprocal: false,
        finite: true,
        bound: Bound::Constant,
        build: constructors!(gltf_clearcoat),
    },
    Model {
        name: "gltf-sheen",
        summary: "the same under KHR_materials_sheen, scaled by the sheen's albedo",
        parameters: GLTF_SHEEN,
        reciprocal: true,
        finite: true,
        bound: Bound::Derived { formula: "2e-5 + that of charlie + 40u base/f", at: sheen_bound },
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

/// Finishes one of the two forms that the material has: the one place where the masking depends on whether a parameter
/// is there, as the specification has it.
trait Finish<R: Number> {
    fn finish<B: Brdf<R> + Send + Sync + 'static>(self, material: B) -> AnyBrdf<R>;
}

/// The material as it is.
struct Bare;

impl<R: Number> Finish<R> for Bare {
    fn finish<B: Brdf<R> + Send + Sync + 'static>(self, material: B) -> AnyBrdf<R> {
        Box::new(material)
    }
}

/// The material under a clear coat.
struct Coated<R>(R, Alpha<R>);

impl<R: Number> Finish<R> for Coated<R> {
    fn finish<B: Brdf<R> + Send + Sync + 'static>(self, material: B) -> AnyBrdf<R> {
        Box::new(Clearcoat::new(material, self.0, self.1))
    }
}

fn material<R: Number>(p: &Reader<'_, R>, finish: impl Finish<R>) -> AnyBrdf<R> {
    let plain = MetallicRoughness::new(p.rgb("base-color"), p.number("metallic"), alpha(p, "roughness"));
    let plain = plain.with_specular(p.number("ior"), p.number("specular"), p.rgb("specular-color"));
    if p.is_zero("anisotropy") {
        finish.finish(plain)
    } else {
        finish.finish(plain.with_anisotropy(p.number("anisotropy")))
    }
}

/// The material under a sheen.
struct UnderSheen<R>(Rgb<R>, Alpha<R>);

impl<R: Number> Finish<R> for UnderSheen<R> {
    fn finish<B: Brdf<R> + Send + Sync + 'static>(self, material: B) -> AnyBrdf<R> {
        Box::new(SheenLayer::new(material, self.0, self.1))
    }
}

fn gltf_sheen<R: Number>(p: &Reader<'_, R>) -> AnyBrdf<R> {
    material(p, UnderSheen(p.rgb("sheen-color"), alpha(p, "sheen-roughness")))
}

/// What the base is scaled with is 1 less something near 1: its error counts as far as the base is seen.
fn sheen_bound(p: &Reader<'_, f64>, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    let (base, layered) = (gltf(p).eval(l, v), gltf_sheen(p).eval(l, v));
    let seen = [base.r / layered.r, base.g / layered.g, base.b / layered.b].into_iter().fold(0.0, f64::max);
    Bound::WORST + super::diffuse::of_sheen(alpha(p, "sheen-roughness").0, l, v) + 40.0 * seen / 16_777_216.0
}

fn gltf<R: Number>(p: &Reader<'_, R>) -> AnyBrdf<R> {
    material(p, Bare)
}

fn gltf_clearcoat<R: Number>(p: &Reader<'_, R>) -> AnyBrdf<R> {
    material(p, Coated(p.number("clearcoat"), alpha(p, "clearcoat-roughness")))
}

fn coat<R: Number>(p: &Reader<'_, R>) -> AnyBrdf<R> {
    let (x, y) = p.widths("alpha");
    let interface = Schlick::new(p.rgb("f0"));
    let top = Microfacet::new(Ggx::anisotropic(x, y), SmithCorrelated, interface);
    Box::new(Coat::new(top, interface, Lambert::new(p.rgb("albedo"))))
}
