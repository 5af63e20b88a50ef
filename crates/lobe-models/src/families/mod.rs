//! The models, a file a family.

mod classic;
mod microfacet;

use crate::catalogue::Model;

/// All families.
pub(crate) const ALL: &[&[Model]] = &[classic::MODELS, microfacet::MODELS];

/// A [`Model`] with its constructor in each number type.
///
/// `build` reads like a closure over a [`Reader`](crate::Reader) and is compiled as a generic function.
macro_rules! model {
    (
        name: $name:literal, summary: $summary:literal, parameters: $parameters:expr,
        reciprocal: $reciprocal:literal, finite: $finite:literal, build: |$reader:ident| $build:expr $(,)?
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
            f32: build::<f32>,
            f64: build::<f64>,
        }
    }};
}
pub(crate) use model;
