//! MTL: any bytes are materials inside their domains, or an error that names the file.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe_scene::mtl::{self, MAX_EXPONENT};

fuzz_target!(|input: &[u8]| {
    match mtl::parse(input, "a.mtl") {
        Ok((materials, warnings)) => {
            for m in &materials {
                let colours = [m.kd, m.ks, m.ke, m.ka.unwrap_or_default()];
                assert!(colours.iter().flatten().all(|c| c.is_finite() && *c >= 0.0), "{m:?}");
                assert!((0.0..=MAX_EXPONENT).contains(&m.ns) && (0.0..=1.0).contains(&m.d), "{m:?}");
            }
            assert!(warnings.iter().all(|warning| warning.to_string().lines().count() == 1), "{warnings:?}");
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.starts_with("a.mtl:") && message.lines().count() == 1, "{message}");
        }
    }
});
