//! glTF, text or binary, with the files that it names: a scene whose views can all be drawn, or an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe_fuzz::{Files, draw};
use lobe_scene::gltf;

fuzz_target!(|input: &[u8]| {
    let files = Files::new(input);
    match gltf::parse(files.first, "a.gltf", &mut |name| files.read(name)) {
        Ok(scene) => draw(&scene),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
