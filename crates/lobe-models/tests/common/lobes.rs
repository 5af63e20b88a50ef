//! Lobes of a model with parameters all over their domains.

use lobe_models::{Kind, Lobe, Model, TABLE, Value};
use lobe_verify::strategies::{reflectance, shininess};
use proptest::prelude::*;

/// A value anywhere in the domain of its kind, with a lean towards the ends, rounded to `f32`.
fn value(name: &str, kind: Kind) -> BoxedStrategy<Value> {
    match kind {
        Kind::Colour { max } => {
            reflectance().prop_map(move |c| Value::Colour(c.map(|x| rounded(f64::from(x) * max, 0.0, max)))).boxed()
        }
        Kind::Number { .. } if name == "q" => shininess().prop_map(|q| Value::Number(f64::from(q))).boxed(),
        Kind::Number { min, max } => prop_oneof![4 => min..=max, 1 => Just(min), 1 => Just(max)]
            .prop_map(move |x| Value::Number(rounded(x, min, max)))
            .boxed(),
        Kind::Widths => {
            let width =
                || prop_oneof![5 => (-4.0..0.0_f64).prop_map(|e| 10_f64.powf(e)), 1 => Just(1e-4), 1 => Just(1.0)];
            let inside = |x: f64| rounded(x, 1e-4, 1.0);
            prop_oneof![
                width().prop_map(move |a| Value::Widths([inside(a); 2])),
                (width(), 1.0..16.0_f64, any::<bool>()).prop_map(move |(a, aspect, swap)| {
                    let b = (a / aspect).max(1e-4);
                    Value::Widths(if swap { [inside(b), inside(a)] } else { [inside(a), inside(b)] })
                }),
            ]
            .boxed()
        }
        Kind::Table => {
            let number = || prop_oneof![1 => Just(0.0), 3 => 0.0..1.0_f64, 1 => 0.0..1e6_f64];
            // One that is not 0, anywhere.
            (proptest::collection::vec(number(), TABLE), 0..TABLE, 0.01..1e6_f64)
                .prop_map(|(mut list, at, most)| {
                    list[at] = most;
                    Value::Table(std::array::from_fn(|i| rounded(list[i], 0.0, 1e6)))
                })
                .boxed()
        }
        Kind::Choice(words) => proptest::sample::select(words.to_vec()).prop_map(Value::Choice).boxed(),
    }
}

/// An `f32` next to `x ≥ 0` that is inside the domain: rounding may leave it by half a step.
fn rounded(x: f64, min: f64, max: f64) -> f64 {
    let near = x as f32;
    let down = f64::from(f32::from_bits(near.to_bits().saturating_sub(1)));
    let up = f64::from(f32::from_bits(near.to_bits() + 1));
    if f64::from(near) > max {
        down
    } else if f64::from(near) < min {
        up
    } else {
        f64::from(near)
    }
}

/// A lobe of the model with parameters all over their domains.
pub(crate) fn lobe(model: &'static Model) -> impl Strategy<Value = Lobe> {
    let values: Vec<_> = model.parameters.iter().map(|p| value(p.name, p.kind)).collect();
    values.prop_map(move |values| {
        let given: Vec<_> = model.parameters.iter().map(|p| p.name).zip(values).collect();
        Lobe::new(model, &given).expect("inside the domain")
    })
}
