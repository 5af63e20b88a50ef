//! BRDFs in JSON: a BRDF that can be evaluated, or an error in one line that names the place.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe::Vec3;
use lobe_cli::spec;

fuzz_target!(|input: &[u8]| {
    let Ok(text) = std::str::from_utf8(input) else { return };
    match spec::parse(text, "x") {
        Ok(spec) => {
            let _ = (spec.description(), spec.warnings());
            for lobe in &spec.lobes {
                for (parameter, value) in lobe.values() {
                    assert!(parameter.check_weighted(value) == Ok(value), "{lobe:?}");
                }
                assert!(lobe.weight().iter().all(|c| c.is_finite() && *c >= 0.0), "{lobe:?}");
            }
            let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.48, 0.36, 0.8));
            let wide = spec.build::<f64>().eval(l, v);
            assert!([wide.r, wide.g, wide.b].iter().all(|c| *c >= 0.0), "{wide:?}");
            let _ = spec.build::<f32>().eval(l.map(|c| c as f32), v.map(|c| c as f32));
        }
        Err(failure) => {
            let message = failure.to_string();
            assert!(message.starts_with("x:") && message.lines().count() == 1, "{message}");
        }
    }
});
