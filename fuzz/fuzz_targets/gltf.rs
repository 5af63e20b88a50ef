//! glTF, text or binary, with the files that it names: a scene whose views can all be drawn, or an error.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe_fuzz::Files;
use lobe_scene::{Renderer, Settings, gltf};

fuzz_target!(|input: &[u8]| {
    let files = Files::new(input);
    match gltf::parse(files.first, "a.gltf", &mut |name| files.read(name)) {
        Ok(scene) => {
            assert!(!scene.views.is_empty());
            let Ok(renderer) = Renderer::new(&scene) else { panic!("a scene that was read can be drawn") };
            let settings = Settings { width: 3, height: 2, depth: 2, ..Settings::default() };
            for view in scene.views.iter().take(4) {
                let image = renderer.render(view, &settings, None);
                assert!(image.is_ok() || view.camera.is_none(), "{:?}", image.err());
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
