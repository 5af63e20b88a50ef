//! The JSON scene description with the files that it names: a scene whose views can all be drawn, or an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe_fuzz::Files;
use lobe_scene::{LoadOptions, Renderer, Settings, parse_description};

fuzz_target!(|input: &[u8]| {
    let files = Files::new(input);
    let Ok(text) = std::str::from_utf8(files.first) else { return };
    match parse_description(text, "a.json", &mut |name| files.read(name), &LoadOptions::default()) {
        Ok(scene) => {
            assert!(!scene.views.is_empty());
            let Ok(renderer) = Renderer::new(&scene) else { panic!("a scene that was read can be drawn") };
            let settings = Settings { width: 3, height: 2, depth: 2, ..Settings::default() };
            for view in scene.views.iter().take(4) {
                // A view with its own camera was checked while it was read; a framed one may be out of reach.
                let image = renderer.render(view, &settings, None);
                assert!(image.is_ok() || view.camera.is_none(), "{:?}", image.err());
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
