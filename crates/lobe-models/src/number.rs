//! The number types that a model can be built in at run time.

use crate::catalogue::Model;
use crate::function::Function;
use crate::reader::Reader;
use lobe::{Brdf, Half, Real};

/// A model of which only the number type is known.
pub type AnyBrdf<R> = Box<dyn Brdf<R> + Send + Sync>;

/// A number type that the catalogue builds its models in.
///
/// A function pointer cannot be generic, so each model holds one for each of these.
pub trait Number: Real + Send + Sync + 'static {
    /// The constant.
    fn from_f64(value: f64) -> Self;
    /// The model in this type, with the parameters of the reader.
    fn construct(model: &Model, reader: &Reader<'_, Self>) -> AnyBrdf<Self>;
    /// The functions that evaluate it.
    fn functions(model: &Model, reader: &Reader<'_, Self>) -> Vec<Function>;
}

impl Number for f32 {
    fn from_f64(value: f64) -> Self {
        value as f32
    }
    fn construct(model: &Model, reader: &Reader<'_, Self>) -> AnyBrdf<Self> {
        (model.build.f32)(reader).brdf
    }
    fn functions(model: &Model, reader: &Reader<'_, Self>) -> Vec<Function> {
        vec![(model.build.f32)(reader).function]
    }
}

impl Number for f64 {
    fn from_f64(value: f64) -> Self {
        value
    }
    fn construct(model: &Model, reader: &Reader<'_, Self>) -> AnyBrdf<Self> {
        (model.build.f64)(reader).brdf
    }
    fn functions(model: &Model, reader: &Reader<'_, Self>) -> Vec<Function> {
        vec![(model.build.f64)(reader).function]
    }
}

impl Number for Half {
    fn from_f64(value: f64) -> Self {
        Self::from(value)
    }
    fn construct(model: &Model, reader: &Reader<'_, Self>) -> AnyBrdf<Self> {
        (model.build.half)(reader).brdf
    }
    fn functions(model: &Model, reader: &Reader<'_, Self>) -> Vec<Function> {
        vec![(model.build.half)(reader).function]
    }
}

/// What a constructor makes: the lobe, and the function behind its pointer.
pub(crate) struct Built<R> {
    pub(crate) brdf: AnyBrdf<R>,
    pub(crate) function: Function,
}

/// What a constructor ends with.
pub(crate) fn boxed<R: Number, B: Brdf<R> + Send + Sync + 'static>(lobe: B) -> Built<R> {
    Built { brdf: Box::new(lobe), function: Function::scalar::<B, R>() }
}
