//! What a constructor sees of the parameters.

use crate::number::Number;
use crate::parameter::{Parameter, TABLE, Value};
use lobe::{Alpha, Rgb, Shininess};
use std::marker::PhantomData;

/// The values of a model's parameters, in the number type that is being built.
///
/// A constructor asks for what its own model declares, which the suite tries for each model; for anything else it gets
/// zeros, the smallest width or an empty word.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a, R> {
    parameters: &'a [Parameter],
    values: &'a [Value],
    number: PhantomData<R>,
}

impl<'a, R: Number> Reader<'a, R> {
    pub(crate) fn new(parameters: &'a [Parameter], values: &'a [Value]) -> Self {
        Self { parameters, values, number: PhantomData }
    }

    /// The same values in another number type.
    #[cfg(feature = "batch")]
    pub(crate) fn of<S: Number>(&self) -> Reader<'a, S> {
        Reader { parameters: self.parameters, values: self.values, number: PhantomData }
    }

    fn value(&self, name: &str) -> Option<Value> {
        let found = self.parameters.iter().zip(self.values).find(|(parameter, _)| parameter.name == name);
        debug_assert!(found.is_some(), "the model declares no parameter `{name}`");
        found.map(|(_, value)| *value)
    }

    /// A colour.
    #[must_use]
    pub fn rgb(&self, name: &str) -> Rgb<R> {
        let Some(Value::Colour([r, g, b])) = self.value(name) else { return Rgb::splat(R::from_f64(0.0)) };
        Rgb::new(R::from_f64(r), R::from_f64(g), R::from_f64(b))
    }

    /// A number.
    #[must_use]
    pub fn number(&self, name: &str) -> R {
        let Some(Value::Number(x)) = self.value(name) else { return R::from_f64(0.0) };
        R::from_f64(x)
    }

    /// Whether a number is exactly 0: what it stands for is not there.
    #[must_use]
    pub fn is_zero(&self, name: &str) -> bool {
        self.value(name) == Some(Value::Number(0.0))
    }

    /// The exponent `q`.
    #[must_use]
    pub fn shininess(&self) -> Shininess<R> {
        Shininess(self.number("q"))
    }

    /// The widths along the tangent and the bitangent.
    #[must_use]
    pub fn widths(&self, name: &str) -> (Alpha<R>, Alpha<R>) {
        let Some(Value::Widths([x, y])) = self.value(name) else {
            return (Alpha(R::from_f64(1e-4)), Alpha(R::from_f64(1e-4)));
        };
        (Alpha(R::from_f64(x)), Alpha(R::from_f64(y)))
    }

    /// A table.
    #[must_use]
    pub fn table(&self, name: &str) -> [R; TABLE] {
        let Some(Value::Table(t)) = self.value(name) else { return [R::from_f64(0.0); TABLE] };
        t.map(R::from_f64)
    }

    /// A word.
    #[must_use]
    pub fn choice(&self, name: &str) -> &'static str {
        let Some(Value::Choice(word)) = self.value(name) else { return "" };
        word
    }
}
