//! Every model of the catalogue on any direction and any parameters of its domain: what `Brdf` and `Sample` promise, and
//! no panic beyond it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe::{Rgb, Vec3};
use lobe_fuzz::{Bits, channels, components, is_unit, same};
use lobe_models::{Kind, Lobe, Parameter, Value, models};

/// A value of the parameter's domain.
fn value(parameter: &Parameter, bits: &mut Bits<'_>) -> Value {
    // By its bits, so that the small ones are as likely as the large.
    let mut between = |min: f64, max: f64| (min + f64::from(bits.up_to((max - min) as f32))).clamp(min, max);
    match parameter.kind {
        Kind::Colour { max } => Value::Colour(std::array::from_fn(|_| between(0.0, max))),
        Kind::Number { min, max } => Value::Number(between(min, max)),
        Kind::Widths => Value::Widths(std::array::from_fn(|_| between(1e-4, 1.0))),
        Kind::Table => {
            let mut table = std::array::from_fn(|_| between(0.0, 1e6));
            // Not all 0.
            table[0] = table[0].max(0.01);
            Value::Table(table)
        }
        Kind::Choice(words) => Value::Choice(words[usize::from(bits.byte()) % words.len()]),
    }
}

fn good(f: Rgb) -> bool {
    channels(f).iter().all(|c| c.is_finite() && *c >= 0.0)
}

fuzz_target!(|input: &[u8]| {
    let mut bits = Bits(input);
    let count = models().count();
    let Some(model) = models().nth(usize::from(bits.byte()) % count) else { return };
    let values: Vec<_> = model.parameters.iter().map(|p| (p.name, value(p, &mut bits))).collect();
    let lobe = Lobe::new(model, &values).expect("inside the domain");
    let brdf = lobe.build::<f32>();

    // Whatever the directions are.
    let (l, v) = (bits.vector(), bits.vector());
    let (f, cos) = (brdf.eval(l, v), brdf.eval_cos(l, v));
    if !components(l).iter().chain(&components(v)).all(|c| c.is_finite()) {
        assert!([f, cos].iter().all(|f| channels(*f).iter().all(|c| c.is_nan())), "{lobe:?}: {f:?} at {l:?} {v:?}");
    }

    // Inside the domain.
    let l = bits.direction(Vec3::new(0.0, 0.0, 1.0));
    let v = bits.direction(l);
    let (f, cos, back) = (brdf.eval(l, v), brdf.eval_cos(l, v), brdf.eval(v, l));
    assert!(!model.reciprocal || same(channels(f), channels(back)), "{lobe:?}: {f:?} {back:?} at {l:?} {v:?}");
    let lowest = l.z.min(v.z);
    if lowest <= 0.0 {
        assert!([f, cos].map(channels).as_flattened().iter().all(|c| *c == 0.0), "{lobe:?}: {f:?} at {l:?} {v:?}");
    } else {
        assert!(lowest < f32::MIN_POSITIVE || good(cos), "{lobe:?}: {cos:?} at {l:?} {v:?}");
        assert!(lowest < 1e-20 || !model.finite || good(f), "{lobe:?}: {f:?} at {l:?} {v:?}");
    }

    // Its samples, from any numbers and from those of [0, 1).
    let sampler = lobe.sampler::<f32>();
    let any = [bits.float(), bits.float(), bits.float()];
    let _ = (sampler.sample(bits.vector(), any), sampler.pdf(bits.vector(), v));
    let u = [(); 3].map(|()| bits.up_to(1.0).min(1.0 - f32::EPSILON / 2.0));
    let sampled = sampler.sample(v, u);
    let told = || format!("{lobe:?}: {sampled:?} from {v:?} by {u:?}");
    if v.z <= 0.0 || sampled.rejected {
        assert!(sampled.rejected && channels(sampled.weight) == [0.0; 3], "{}", told());
    } else if v.z > 1e-8 {
        assert!(is_unit(sampled.l) && sampled.l.z > 0.0 && good(sampled.weight), "{}", told());
        assert!(sampled.delta || sampled.pdf > 0.0 && sampled.pdf.is_finite(), "{}", told());
        let (f_cos, pdf) = sampler.eval_cos_pdf(sampled.l, v);
        let near = |pdf: f32| (pdf - sampled.pdf).abs() <= 1e-3 * pdf.max(sampled.pdf);
        assert!(good(f_cos) && near(pdf) && near(sampler.pdf(sampled.l, v)), "{}: {f_cos:?}, {pdf}", told());
    }
});
