//! The microfacet model of any terms.

use super::constructors;
use super::fresnel::{self, any_fresnel};
use crate::{AnyBrdf, Bound, Model, Number, Parameter, Reader};
use lobe::Microfacet;
use lobe::distribution::{Ggx, SmithLambda};
use lobe::masking::{SmithCorrelated, SmithSeparable};

pub(super) const MODELS: &[Model] = &[Model {
    name: "microfacet",
    summary: "D F G/(4 (n·l)(n·v)) of any terms (Torrance and Sparrow 1967, Walter et al. 2007)",
    parameters: &[
        Parameter::choice("distribution", &["ggx"], "the distribution D"),
        Parameter::alpha(),
        Parameter::choice("masking", &["smith-correlated", "smith-separable"], "the masking G"),
        fresnel::FORM,
        fresnel::F0,
        fresnel::F90,
        fresnel::TINT,
        fresnel::A,
        fresnel::EXPONENT,
        fresnel::IOR,
        fresnel::METAL,
        fresnel::ETA,
        fresnel::K,
        fresnel::REFLECTIVITY,
        fresnel::EDGE_TINT,
    ],
    reciprocal: true,
    finite: true,
    bound: Bound::Derived { formula: fresnel::FORMULA, at: |p, l, v| Bound::WORST + fresnel::excess(p, l, v) },
    build: constructors!(microfacet),
}];

fn microfacet<R: Number>(p: &Reader<'_, R>) -> AnyBrdf<R> {
    let (x, y) = p.widths("alpha");
    smith(p, Ggx::anisotropic(x, y))
}

fn smith<R: Number, D: SmithLambda<R> + Send + Sync + 'static>(p: &Reader<'_, R>, d: D) -> AnyBrdf<R> {
    let fresnel = any_fresnel(p);
    match p.choice("masking") {
        "smith-separable" => Box::new(Microfacet::new(d, SmithSeparable, fresnel)),
        _ => Box::new(Microfacet::new(d, SmithCorrelated, fresnel)),
    }
}
