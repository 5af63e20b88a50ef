//! The list of all models, and a lobe of one of them.

#[cfg(feature = "batch")]
use crate::batch::AnyBatch;
use crate::families;
use crate::function::Function;
use crate::number::{AnyBrdf, Built, Number};
use crate::parameter::{Error, Parameter, Value};
use crate::reader::Reader;
use crate::sampler::AnySampler;
use crate::terms::AnyTerms;
use lobe::{Brdf, Half, Rgb, Vec3};
use std::fmt;

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
    /// [`Bound::WORST`] in most of the domain, and more where something cancels, which is rare: of a hundred values
    /// ninety-nine are as near as with a constant.
    Excess {
        /// As of [`Derived`](Self::Derived).
        formula: &'static str,
        /// As of [`Derived`](Self::Derived).
        at: fn(&Reader<'_, f64>, Vec3<f64>, Vec3<f64>) -> f64,
    },
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
    pub(crate) f32: fn(&Reader<'_, f32>) -> Built<f32>,
    pub(crate) f64: fn(&Reader<'_, f64>) -> Built<f64>,
    pub(crate) half: fn(&Reader<'_, Half>) -> Built<Half>,
    pub(crate) sampler_f32: fn(&Reader<'_, f32>) -> AnySampler<f32>,
    pub(crate) sampler_f64: fn(&Reader<'_, f64>) -> AnySampler<f64>,
    #[cfg(feature = "batch")]
    pub(crate) batch: fn(&Reader<'_, f32>) -> AnyBatch,
    /// Of the models that are made of `D`, `G` and `F`.
    pub(crate) terms: Option<fn(&Reader<'_, f64>) -> AnyTerms>,
}

impl Model {
    /// The parameter of that name.
    ///
    /// # Errors
    /// That there is none, and which there are.
    pub fn parameter(&self, name: &str) -> Result<&'static Parameter, Error> {
        self.parameters
            .iter()
            .find(|parameter| parameter.name == name)
            .ok_or_else(|| Error(format!("model `{}` has no parameter `{name}`; {}", self.name, self.takes())))
    }

    /// A lobe of ordinary values, for an example or a measurement: the default where there is one, and else what a glossy
    /// surface has, such as a width of 0.3.
    #[must_use]
    pub fn typical(&'static self) -> Lobe {
        let values = self.parameters.iter().map(|parameter| parameter.default.unwrap_or_else(|| parameter.typical()));
        Lobe { model: self, values: values.collect(), weight: [1.0; 3] }
    }

    /// Whether it is made of `D`, `G` and `F`, so that [`Lobe::terms`] has them.
    #[must_use]
    pub fn has_terms(&self) -> bool {
        self.build.terms.is_some()
    }

    fn takes(&self) -> String {
        let names: Vec<_> = self.parameters.iter().map(|p| format!("`{}`", p.name)).collect();
        format!("it takes {}", names.join(", "))
    }
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
    /// What the whole lobe is multiplied with.
    weight: [f64; 3],
}

impl PartialEq for Lobe {
    fn eq(&self, other: &Self) -> bool {
        self.model.name == other.model.name && self.values == other.values && self.weight == other.weight
    }
}

impl Lobe {
    /// The lobe with these values; what is not given takes its default.
    ///
    /// # Errors
    /// A value outside its domain, of the wrong kind, of a name that the model does not know, or missing.
    pub fn new(model: &'static Model, given: &[(&str, Value)]) -> Result<Self, Error> {
        Self::checked(model, given, Parameter::check)
    }

    /// The same, but what the lobe is proportional to ([`Parameter::is_weight`]) may be above 1: then more light leaves
    /// than arrives. Fits to measurements have such weights, for models that are far from 1 at a weight of 1.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn weighted(model: &'static Model, given: &[(&str, Value)]) -> Result<Self, Error> {
        Self::checked(model, given, Parameter::check_weighted)
    }

    fn checked(
        model: &'static Model,
        given: &[(&str, Value)],
        check: fn(&Parameter, Value) -> Result<Value, Error>,
    ) -> Result<Self, Error> {
        given.iter().try_for_each(|(name, _)| model.parameter(name).map(drop))?;
        let value = |parameter: &Parameter| match given.iter().find(|(name, _)| *name == parameter.name) {
            Some((_, value)) => check(parameter, *value),
            None => parameter.default.ok_or_else(|| {
                Error(format!("model `{}` lacks its parameter `{}`; {}", model.name, parameter.name, model.takes()))
            }),
        };
        Ok(Self { model, values: model.parameters.iter().map(value).collect::<Result<_, _>>()?, weight: [1.0; 3] })
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &'static Model {
        self.model
    }

    /// The same lobe, multiplied with a colour: a lobe without a weight among its parameters gets one.
    ///
    /// # Errors
    /// A channel that is negative or not finite in `f32`.
    pub fn with_weight(self, weight: [f64; 3]) -> Result<Self, Error> {
        Parameter::reflectance("weight", "").check_weighted(Value::Colour(weight))?;
        Ok(Self { weight, ..self })
    }

    /// `f` of the model and its parameters.
    pub(crate) fn with_reader<R: Number, T>(&self, f: impl FnOnce(&Model, &Reader<'_, R>) -> T) -> T {
        f(self.model, &Reader::new(self.model.parameters, &self.values))
    }

    /// What the whole lobe is multiplied with: 1 if nothing else was said.
    #[must_use]
    pub fn weight(&self) -> [f64; 3] {
        self.weight
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

    /// Its name with the parameters that shape it, for a table: `blinn-phong q=80`.
    #[must_use]
    pub fn description(&self) -> String {
        let shaping = self.values().filter(|(parameter, value)| {
            !matches!(value, Value::Colour(_) | Value::Table(_))
                && parameter.default.is_none_or(|default| default != *value)
        });
        let parts = shaping.map(|(parameter, value)| format!(" {}={}", parameter.name, value.bare()));
        std::iter::once(self.model.name.to_owned()).chain(parts).collect()
    }

    /// The lobe in a number type.
    #[must_use]
    pub fn build<R: Number>(&self) -> AnyBrdf<R> {
        let lobe = R::construct(self.model, &Reader::new(self.model.parameters, &self.values));
        if self.weight == [1.0; 3] {
            return lobe;
        }
        let [r, g, b] = self.weight.map(R::from_f64);
        Box::new(Weighted { lobe, weight: Rgb::new(r, g, b) })
    }

    /// The functions that evaluate [`build`](Self::build); what multiplies the lobe with its weight is not among them.
    #[must_use]
    pub fn functions<R: Number>(&self) -> Vec<Function> {
        R::functions(self.model, &Reader::new(self.model.parameters, &self.values))
    }

    /// The lobe over slices.
    ///
    /// Every model runs in lanes, those of layers too, but for those whose `Λ` is a table, which go point by point as the
    /// scalar `f32`, whatever the precision: `tabulated-facets`, `ashikhmin-premoze-shirley` with `blinn` or `gtr`, and
    /// `microfacet` with another distribution than GGX or Beckmann; and those whose albedo is one: `fdez-aguera`,
    /// `coupled-diffuse` and `albedo-coat`.
    ///
    /// A `microfacet` lobe of GGX or Beckmann with Smith's masking and Schlick's, a conductor's or a dielectric's Fresnel
    /// term has kernels of its own; any other looks up its masking and its Fresnel term for each register.
    #[cfg(feature = "batch")]
    #[must_use]
    pub fn batch(&self) -> AnyBatch {
        let (lobe, weight) = self.weighted_batch();
        if self.weight == [1.0; 3] { lobe } else { crate::batch::sum(vec![(lobe, weight)]) }
    }

    /// The lobe without its weight, and that.
    #[cfg(feature = "batch")]
    pub(crate) fn weighted_batch(&self) -> (AnyBatch, [f32; 3]) {
        let lobe = (self.model.build.batch)(&Reader::new(self.model.parameters, &self.values));
        (lobe, self.weight.map(|w| w as f32))
    }

    /// The terms `D`, `G` and `F` that the lobe is made of, without its weight; `None` for a model that is not made so.
    #[must_use]
    pub fn terms(&self) -> Option<AnyTerms> {
        self.model.build.terms.map(|terms| terms(&Reader::new(self.model.parameters, &self.values)))
    }

    /// How far `f32` may be from `f64` of the same inputs, relatively, for these directions; infinite where the bound
    /// says nothing.
    #[must_use]
    pub fn tolerance(&self, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
        match self.model.bound {
            Bound::Constant => Bound::WORST,
            Bound::Excess { at, .. } | Bound::Derived { at, .. } => {
                at(&Reader::new(self.model.parameters, &self.values), l, v)
            }
        }
    }
}

/// A lobe times a colour.
#[cfg(feature = "batch")]
pub(crate) fn weighted<R: Number>(lobe: AnyBrdf<R>, weight: Rgb<R>) -> AnyBrdf<R> {
    Box::new(Weighted { lobe, weight })
}

/// A lobe times a colour.
struct Weighted<R> {
    lobe: AnyBrdf<R>,
    weight: Rgb<R>,
}

impl<R: Number> Brdf<R> for Weighted<R> {
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weight * self.lobe.eval(l, v)
    }
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.weight * self.lobe.eval_cos(l, v)
    }
}

/// In JSON, as the command reads it: `{"model": "phong", "ks": [0.5, 0.5, 0.5], "q": 20.0}`.
impl fmt::Display for Lobe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{{\"model\": \"{}\"", self.model.name)?;
        for (parameter, value) in self.values() {
            match value {
                Value::Choice(word) => write!(f, ", \"{}\": \"{word}\"", parameter.name)?,
                value => write!(f, ", \"{}\": {value}", parameter.name)?,
            }
        }
        if self.weight != [1.0; 3] {
            write!(f, ", \"weight\": {:?}", self.weight)?;
        }
        f.write_str("}")
    }
}
