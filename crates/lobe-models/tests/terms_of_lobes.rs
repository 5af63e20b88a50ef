//! The terms that a lobe hands out are those that it is made of.

use lobe::Vec3;
use lobe_models::{Lobe, Value, model, models};

/// A model, its parameters, and the factor on `D F G/(4 (n·l)(n·v))`.
type Case<'a> = (&'a str, &'a [(&'a str, Value)], f64);

#[test]
fn d_f_g_make_the_lobe() -> Result<(), Box<dyn std::error::Error>> {
    let colour = Value::Colour([0.9, 0.5, 0.25]);
    let cases: &[Case<'_>] = &[
        ("microfacet", &[("alpha", Value::Widths([0.3, 0.2])), ("f0", colour)], 1.0),
        (
            "microfacet",
            &[
                ("distribution", Value::Choice("student-t")),
                ("masking", Value::Choice("kelemen")),
                ("fresnel", Value::Choice("conductor")),
                ("metal", Value::Choice("gold")),
                ("alpha", Value::Widths([0.4; 2])),
            ],
            1.0,
        ),
        ("torrance-sparrow", &[("c", Value::Number(0.3)), ("ior", Value::Number(1.5))], 1.0),
        (
            "tabulated-facets",
            &[("table", Value::Table(std::array::from_fn(|i| [3.0, 1.0, 2.0][i % 3]))), ("f0", colour)],
            1.0,
        ),
        ("ashikhmin-premoze-shirley", &[("width", Value::Number(0.3)), ("f0", colour)], 1.0),
        (
            "cook-torrance",
            &[("ks", Value::Colour([1.0; 3])), ("m", Value::Number(0.3)), ("f0", colour)],
            4.0 / std::f64::consts::PI,
        ),
        (
            "blinn-1977",
            &[("ks", Value::Colour([1.0; 3])), ("c", Value::Number(0.3)), ("f0", colour)],
            4.0 * std::f64::consts::PI * 0.09,
        ),
    ];
    let (l, v): (Vec3<f64>, Vec3<f64>) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.48, 0.36, 0.8));
    let sum = l + v;
    let (h, cos) = (sum.normalize(), sum.length_squared().sqrt() / 2.0);
    for (name, values, factor) in cases {
        let lobe = Lobe::new(model(name).ok_or("no such model")?, values)?;
        let terms = lobe.terms().ok_or("no terms")?;
        let product = terms.f(cos) * (factor * terms.d(h) * terms.g(l, v) / (4.0 * l.z * v.z));
        let value = lobe.build::<f64>().eval(l, v);
        for (product, value) in [(product.r, value.r), (product.g, value.g), (product.b, value.b)] {
            assert!((product / value - 1.0).abs() < 1e-12, "{name}: {product} {value}");
        }
    }
    let with_terms: Vec<_> = models().filter(|model| model.has_terms()).map(|model| model.name).collect();
    assert!(cases.iter().all(|(name, ..)| with_terms.contains(name)) && with_terms.len() == 6, "{with_terms:?}");
    Ok(())
}
