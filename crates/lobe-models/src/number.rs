//! The number types that a model can be built in at run time.

use crate::catalogue::Model;
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
    /// The model's constructor in this type.
    fn constructor(model: &Model) -> fn(&Reader<'_, Self>) -> AnyBrdf<Self>;
}

impl Number for f32 {
    fn from_f64(value: f64) -> Self {
        value as f32
    }
    fn constructor(model: &Model) -> fn(&Reader<'_, Self>) -> AnyBrdf<Self> {
        model.build.f32
    }
}

impl Number for f64 {
    fn from_f64(value: f64) -> Self {
        value
    }
    fn constructor(model: &Model) -> fn(&Reader<'_, Self>) -> AnyBrdf<Self> {
        model.build.f64
    }
}

impl Number for Half {
    fn from_f64(value: f64) -> Self {
        Self::from(value)
    }
    fn constructor(model: &Model) -> fn(&Reader<'_, Self>) -> AnyBrdf<Self> {
        model.build.half
    }
}
