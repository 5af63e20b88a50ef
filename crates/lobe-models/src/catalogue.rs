//! The list of all models, and a lobe of one of them.

use crate::families;
use crate::number::{AnyBrdf, Number};
use crate::parameter::{Error, Parameter, Value};
use crate::reader::Reader;
use lobe::Vec3;

/// A model by name.
#[derive(Clone, Copy, Debug)]
pub struct Model {
    /// Its name in JSON and on the command line, kebab-case.
    pub name: &'static str,
    /// What it is and whose, in a line.
    pub summary: &'static str,
    /// The parameters that it takes.
    pub parameters: &'static [Parameter],
    /// Whether `f(l, v) = f(v, l)`, then to the last bit.
    pub reciprocal: bool,
    /// Whether `eval` stays finite for cosines down to 1e-20; `eval_cos` does for every model.
    pub finite: bool,
    /// How far `f32` may be from `f64` of the same inputs.
    pub bound: Bound,
    pub(crate) build: Constructors,
}

/// How far `f32` may be from `f64` of the same `f32` inputs and parameters, relatively.
#[derive(Clone, Copy, Debug)]
pub enum Bound {
    /// [`Bound::WORST`], everywhere in the domain.
    Constant,
    /// The condition number of the formula itself forbids a constant: that of an exponential is its argument. The
    /// bound grows with how far down the lobe a value is, and with nothing else.
    Derived {
        /// The bound in a line, for tables; `L` is `|ln(f/f_max)|` and `u` is 2⁻²⁴.
        formula: &'static str,
        /// The bound for these parameters and directions; infinite where it says nothing: where the first order of the
        /// derivation ends, and below 2⁻¹²⁶ of the peak.
        at: fn(&Reader<'_, f64>, Vec3<f64>, Vec3<f64>) -> f64,
    },
}

impl Bound {
    /// The largest relative error of a model whose bound is constant.
    pub const WORST: f64 = 2e-5;
}

/// The model's constructor in each number type; a function pointer cannot be generic. Made by `constructors!`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Constructors {
    pub(crate) f32: fn(&Reader<'_, f32>) -> AnyBrdf<f32>,
    pub(crate) f64: fn(&Reader<'_, f64>) -> AnyBrdf<f64>,
}

/// All models.
pub fn models() -> impl Iterator<Item = &'static Model> {
    families::ALL.iter().copied().flatten()
}

/// The model of that name.
#[must_use]
pub fn model(name: &str) -> Option<&'static Model> {
    models().find(|model| model.name == name)
}

/// One lobe: a model and the values of its parameters, all inside their domains.
#[derive(Clone, Debug)]
pub struct Lobe {
    model: &'static Model,
    /// In the order of the model's parameters.
    values: Vec<Value>,
}

impl PartialEq for Lobe {
    fn eq(&self, other: &Self) -> bool {
        self.model.name == other.model.name && self.values == other.values
    }
}

impl Lobe {
    /// The lobe with these values; what is not given takes its default.
    ///
    /// # Errors
    /// A value outside its domain, of the wrong kind, of a name that the model does not know, or missing.
    pub fn new(model: &'static Model, given: &[(&str, Value)]) -> Result<Self, Error> {
        let listed = || {
            let names: Vec<_> = model.parameters.iter().map(|p| format!("`{}`", p.name)).collect();
            format!("it takes {}", names.join(", "))
        };
        if let Some((name, _)) = given.iter().find(|(name, _)| model.parameters.iter().all(|p| p.name != *name)) {
            return Err(Error(format!("model `{}` has no parameter `{name}`; {}", model.name, listed())));
        }
        let value = |parameter: &Parameter| match given.iter().find(|(name, _)| *name == parameter.name) {
            Some((_, value)) => parameter.check(*value),
            None => parameter.default.ok_or_else(|| {
                Error(format!("model `{}` lacks its parameter `{}`; {}", model.name, parameter.name, listed()))
            }),
        };
        Ok(Self { model, values: model.parameters.iter().map(value).collect::<Result<_, _>>()? })
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &'static Model {
        self.model
    }

    /// The parameters with their values.
    pub fn values(&self) -> impl Iterator<Item = (&'static Parameter, Value)> + '_ {
        self.model.parameters.iter().zip(self.values.iter().copied())
    }

    /// The value of one parameter.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<Value> {
        self.values().find(|(parameter, _)| parameter.name == name).map(|(_, value)| value)
    }

    /// The lobe in a number type.
    #[must_use]
    pub fn build<R: Number>(&self) -> AnyBrdf<R> {
        R::constructor(self.model)(&Reader::new(self.model.parameters, &self.values))
    }

    /// How far `f32` may be from `f64` of the same inputs, relatively, for these directions; infinite where the bound
    /// says nothing.
    #[must_use]
    pub fn tolerance(&self, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
        match self.model.bound {
            Bound::Constant => Bound::WORST,
            Bound::Derived { at, .. } => at(&Reader::new(self.model.parameters, &self.values), l, v),
        }
    }
}
