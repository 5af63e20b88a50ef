//! A material: a sum of lobes.

use crate::catalogue::Lobe;
use crate::function::Function;
use crate::number::{AnyBrdf, Number};
use crate::parameter::{Kind, Parameter, Value};
use lobe::{Black, Brdf, Rgb, Vec3};

/// A sum of lobes with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// What to call it.
    pub name: String,
    /// The lobes.
    pub lobes: Vec<Lobe>,
}

impl Material {
    /// What it is made of, in a few words: `lambert + blinn-phong q=80`.
    #[must_use]
    pub fn description(&self) -> String {
        let lobes: Vec<_> = self.lobes.iter().map(Lobe::description).collect();
        if lobes.is_empty() { "no lobes".to_owned() } else { lobes.join(" + ") }
    }

    /// What is allowed and still suspicious: a weight above 1.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        for (index, lobe) in self.lobes.iter().enumerate() {
            // A coefficient whose domain goes beyond 1 is no reflectance: He's multiplies a Fresnel term that may be 1e-9.
            let reflectance = |parameter: &Parameter| matches!(parameter.kind, Kind::Colour { max } if parameter.is_weight() && max <= 1.0);
            let parameters = lobe.values().filter(|(parameter, _)| reflectance(parameter));
            let weights = parameters.map(|(parameter, value)| (parameter.name, value));
            for (name, value) in weights.chain([("weight", Value::Colour(lobe.weight()))]) {
                if matches!(value, Value::Colour(c) if c.iter().any(|&x| x > 1.0)) {
                    warnings.push(format!(
                        "{}: lobes[{index}]: `{name}` is above 1, so more light leaves than arrives; use at most 1",
                        self.name
                    ));
                }
            }
        }
        warnings
    }

    /// Whether every lobe is reciprocal.
    #[must_use]
    pub fn is_reciprocal(&self) -> bool {
        self.lobes.iter().all(|lobe| lobe.model().reciprocal)
    }

    /// The BRDF in a number type.
    #[must_use]
    pub fn build<R: Number>(&self) -> AnyBrdf<R> {
        // One lobe needs no sum: a call through a pointer less.
        if let [lobe] = self.lobes.as_slice() {
            return lobe.build();
        }
        Box::new(Composite { lobes: self.lobes.iter().map(Lobe::build).collect() })
    }

    /// The functions that evaluate the lobes of [`build`](Self::build); what adds them up is not among them.
    #[must_use]
    pub fn functions<R: Number>(&self) -> Vec<Function> {
        self.lobes.iter().flat_map(Lobe::functions::<R>).collect()
    }

    /// The BRDF over slices: lobe after lobe, each added to what is there.
    #[cfg(feature = "batch")]
    #[must_use]
    pub fn batch(&self) -> crate::batch::AnyBatch {
        match self.lobes.as_slice() {
            [one] => one.batch(),
            all => crate::batch::sum(all.iter().map(Lobe::weighted_batch).collect()),
        }
    }
}

/// The sum of these lobes.
#[cfg(feature = "batch")]
pub(crate) fn sum<R: Number>(lobes: impl Iterator<Item = AnyBrdf<R>>) -> AnyBrdf<R> {
    Box::new(Composite { lobes: lobes.collect() })
}

/// A sum of lobes put together at run time. Each costs a call through a pointer; who knows the lobes beforehand writes
/// `a + b` and pays for no choice.
struct Composite<R> {
    lobes: Vec<AnyBrdf<R>>,
}

impl<R: Number> Composite<R> {
    fn sum(&self, value: impl Fn(&dyn Brdf<R>) -> Rgb<R>, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        // The first lobe as it is: a sum that starts from 0 would turn −0 into +0.
        let mut values = self.lobes.iter().map(|lobe| value(&**lobe));
        match values.next() {
            Some(first) => values.fold(first, |sum, value| sum + value),
            None => Black.eval(l, v),
        }
    }
}

impl<R: Number> Brdf<R> for Composite<R> {
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.sum(|lobe| lobe.eval(l, v), l, v)
    }
    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.sum(|lobe| lobe.eval_cos(l, v), l, v)
    }
}
