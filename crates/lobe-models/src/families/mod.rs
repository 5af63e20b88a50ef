//! The models, a file a family.

mod classic;
mod compensated;
mod diffuse;
mod empirical;
mod fresnel;
mod layered;
mod microfacet;
mod physical;

use crate::catalogue::Model;

/// The unit roundoff of `f32`.
const U: f64 = 1.0 / 16_777_216.0;

/// All families.
///
/// Statics, and no constants: the value of a constant is made anew in every crate that names it, and all constructors and
/// kernels behind these pointers would be compiled once more there.
pub(crate) static ALL: [&[Model]; 7] = [
    classic::MODELS,
    compensated::MODELS,
    diffuse::MODELS,
    empirical::MODELS,
    layered::MODELS,
    microfacet::MODELS,
    physical::MODELS,
];

/// A constructor in each number type, and that of the batch, from one text: a generic function and one of `f32`, in a
/// module of the name that is given, where the last calls of the text are to what `finish` names.
macro_rules! constructor {
    ($name:ident |$reader:ident, $finish:ident| $body:expr) => {
        crate::families::constructor! { batched: $name |$reader, $finish| $body }
    };
    // One that gives a lobe with its terms. The batch of what ends with `table` goes point by point.
    (facets: $name:ident |$reader:ident, $finish:ident, $table:ident| $body:expr) => {
        mod $name {
            #[allow(unused_imports, reason = "each constructor uses some of them")]
            use super::*;
            pub(super) fn terms<R: crate::Number>($reader: &crate::Reader<'_, R>) -> Box<dyn crate::Terms<R>> {
                #[allow(unused_imports, reason = "most have no table, and one has nothing else")]
                use crate::terms::{boxed as $finish, boxed as $table};
                $body
            }
            #[cfg(feature = "batch")]
            pub(super) fn batch($reader: &crate::Reader<'_, f32>) -> crate::AnyBatch {
                #[allow(dead_code, reason = "not every constructor names its number type")]
                type R = f32;
                #[allow(unused_imports, reason = "most have no table, and one has nothing else")]
                use crate::batch::{batched as $finish, pointwise as $table};
                $body
            }
        }
    };
    // One whose batch ends with another function of `crate::batch`.
    ($batched:ident: $name:ident |$reader:ident, $finish:ident| $body:expr) => {
        mod $name {
            #[allow(unused_imports, reason = "each constructor uses some of them")]
            use super::*;
            pub(super) fn brdf<R: crate::Number>($reader: &crate::Reader<'_, R>) -> crate::number::Built<R> {
                use crate::number::boxed as $finish;
                $body
            }
            pub(super) fn sampler<R: crate::Number>($reader: &crate::Reader<'_, R>) -> crate::AnySampler<R> {
                use crate::sampler::boxed as $finish;
                $body
            }
            #[cfg(feature = "batch")]
            pub(super) fn batch($reader: &crate::Reader<'_, f32>) -> crate::AnyBatch {
                #[allow(dead_code, reason = "not every constructor names its number type")]
                type R = f32;
                use crate::batch::$batched as $finish;
                $body
            }
        }
    };
}
pub(crate) use constructor;

/// The [`Constructors`](crate::catalogue::Constructors) of a model from the name of its [`constructor!`].
macro_rules! constructors {
    ($build:ident) => {
        crate::families::constructors!($build, None)
    };
    ($build:ident, terms: $terms:ident) => {
        crate::families::constructors!($build, Some($terms))
    };
    (facets: $facets:ident) => {
        crate::catalogue::Constructors {
            f32: |p| crate::terms::built($facets::terms(p)),
            f64: |p| crate::terms::built($facets::terms(p)),
            half: |p| crate::terms::built($facets::terms(p)),
            sampler_f32: |p| $facets::terms(p).into_sampler(),
            sampler_f64: |p| $facets::terms(p).into_sampler(),
            #[cfg(feature = "batch")]
            batch: $facets::batch,
            terms: Some(|p| $facets::terms(p)),
        }
    };
    ($build:ident, $terms:expr) => {
        crate::catalogue::Constructors {
            f32: $build::brdf,
            f64: $build::brdf,
            half: $build::brdf,
            sampler_f32: $build::sampler,
            sampler_f64: $build::sampler,
            #[cfg(feature = "batch")]
            batch: $build::batch,
            terms: $terms,
        }
    };
}
pub(crate) use constructors;

/// A [`Model`] whose constructor is one expression; its bound is constant unless it says otherwise.
///
/// `build` reads like a closure over a [`Reader`](crate::Reader) and is compiled by [`constructor!`].
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
        crate::families::constructor! { build |$reader, finish| finish($build) }
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
