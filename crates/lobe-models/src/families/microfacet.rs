//! The microfacet model of any terms.

use super::constructors;
use crate::{AnyBrdf, Bound, Model, Number, Parameter, Reader};
use lobe::distribution::{Ggx, SmithLambda};
use lobe::fresnel::{Fresnel, Incidence, Schlick};
use lobe::masking::{SmithCorrelated, SmithSeparable};
use lobe::{Microfacet, Rgb};

pub(super) const MODELS: &[Model] = &[Model {
    name: "microfacet",
    summary: "D F G/(4 (n·l)(n·v)) of any terms (Torrance and Sparrow 1967, Walter et al. 2007)",
    parameters: &[
        Parameter::choice("distribution", &["ggx"], "the distribution D"),
        Parameter::alpha(),
        Parameter::choice("masking", &["smith-correlated", "smith-separable"], "the masking G"),
        Parameter::reflectance("f0", "the reflectance at normal incidence"),
    ],
    reciprocal: true,
    finite: true,
    bound: Bound::Constant,
    build: constructors!(microfacet),
}];

/// A form of `F` chosen at run time.
struct AnyFresnel<R>(Box<dyn Fresnel<R> + Send + Sync>);

impl<R: Number> Fresnel<R> for AnyFresnel<R> {
    fn fresnel(&self, incidence: Incidence<R>) -> Rgb<R> {
        self.0.fresnel(incidence)
    }
}

fn microfacet<R: Number>(p: &Reader<'_, R>) -> AnyBrdf<R> {
    let (x, y) = p.widths("alpha");
    smith(p, Ggx::anisotropic(x, y))
}

fn smith<R: Number, D: SmithLambda<R> + Send + Sync + 'static>(p: &Reader<'_, R>, d: D) -> AnyBrdf<R> {
    let fresnel = AnyFresnel(Box::new(Schlick::new(p.rgb("f0"))));
    match p.choice("masking") {
        "smith-separable" => Box::new(Microfacet::new(d, SmithSeparable, fresnel)),
        _ => Box::new(Microfacet::new(d, SmithCorrelated, fresnel)),
    }
}
