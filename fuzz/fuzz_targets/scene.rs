//! From the text to the picture: OBJ and MTL, every shading model, a picture of 4 by 4.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe_fuzz::Files;
use lobe_scene::image::Display;
use lobe_scene::{Renderer, Scene, Settings, ShadingModel, View, obj};

fuzz_target!(|input: &[u8]| {
    let files = Files::new(input);
    let model = obj::parse(files.first, "a.obj", &mut |name| files.read(name), &obj::Options::default());
    let Ok(model) = model else { return };
    // Reflectances and emissions of a sane size; beyond, a product may honestly leave the range.
    let sane = model
        .materials
        .iter()
        .all(|m| [m.kd, m.ks, m.ke, m.ka.unwrap_or_default()].iter().flatten().all(|c| *c <= 1e3));
    for shading in ShadingModel::ALL {
        let scene = Scene::from_model(model.clone(), shading);
        let renderer = match Renderer::new(&scene) {
            Ok(renderer) => renderer,
            Err(error) => panic!("a model that was read can be drawn: {error}"),
        };
        let settings = Settings { width: 4, height: 4, depth: 3, ..Settings::default() };
        let image = match renderer.render(&View::default(), &settings, None) {
            Ok(image) => image,
            Err(error) => panic!("the default view can be taken of any model: {error}"),
        };
        if sane {
            assert!(image.pixels().iter().flatten().all(|c| c.is_finite() && *c >= 0.0), "{:?}", image.pixels());
        }
        assert!(image.to_png(&Display::default()).is_ok());
    }
});
