//! The JSON scene description with the files that it names: a scene whose views can all be drawn, or an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe_fuzz::{Files, draw};
use lobe_scene::{LoadOptions, parse_description};

fuzz_target!(|input: &[u8]| {
    let files = Files::new(input);
    let Ok(text) = std::str::from_utf8(files.first) else { return };
    match parse_description(text, "a.json", &mut |name| files.read(name), &LoadOptions::default()) {
        Ok(scene) => draw(&scene),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
