//! The models, a file a family.

mod classic;
mod diffuse;
mod empirical;
mod fresnel;
mod layered;
mod microfacet;
mod physical;

use crate::catalogue::Model;

/// All families.
pub(crate) const ALL: &[&[Model]] =
    &[classic::MODELS, diffuse::MODELS, empirical::MODELS, layered::MODELS, microfacet::MODELS, physical::MODELS];

/// The constructors of a model in each number type, from the name of a generic function of a [`Reader`](crate::Reader);
/// with `facets`, from that of a function that gives a lobe with its terms.
macro_rules! constructors {
    ($build:ident) => {
        crate::catalogue::Constructors { f32: $build, f64: $build, half: $build, terms: None }
    };
    (facets: $facets:ident) => {
        crate::catalogue::Constructors {
            f32: |p| $facets(p).into_brdf(),
            f64: |p| $facets(p).into_brdf(),
            half: |p| $facets(p).into_brdf(),
            terms: Some(|p| $facets(p)),
        }
    };
    ($build:ident, terms: $terms:ident) => {
        crate::catalogue::Constructors { f32: $build, f64: $build, half: $build, terms: Some($terms) }
    };
}
pub(crate) use constructors;

/// A [`Model`] whose constructor is one expression; its bound is constant unless it says otherwise.
///
/// `build` reads like a closure over a [`Reader`](crate::Reader) and is compiled as a generic function.
macro_rules! model {
    (
        name: $name:literal, summary: $summary:literal, parameters: $parameters:expr,
        reciprocal: $reciprocal:literal, finite: $finite:literal, build: |$reader:ident| $build:expr $(,)?
    ) => {
        crate::families::model! {
            name: $name, summary: $summary, parameters: $parameters, reciprocal: $reciprocal, finite: $finite,
            bound: crate::Bound::Constant, build: |$reader| $build,
        }
    };
    (
        name: $name:literal, summary: $summary:literal, parameters: $parameters:expr, reciprocal: $reciprocal:literal,
        finite: $finite:literal, bound: $bound:expr, build: |$reader:ident| $build:expr $(,)?
    ) => {{
        fn build<R: crate::Number>($reader: &crate::Reader<'_, R>) -> crate::AnyBrdf<R> {
            Box::new($build)
        }
        crate::Model {
            name: $name,
            summary: $summary,
            parameters: $parameters,
            reciprocal: $reciprocal,
            finite: $finite,
            bound: $bound,
            build: crate::families::constructors!(build),
        }
    }};
}
pub(crate) use model;
