//! OBJ with its material libraries: any bytes are a model that can be used, or an error that names the file.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe_fuzz::{Files, is_unit};
use lobe_scene::obj::{self, Options};

fuzz_target!(|input: &[u8]| {
    let files = Files::new(input);
    match obj::parse(files.first, "a.obj", &mut |name| files.read(name), &Options::default()) {
        Ok(model) => {
            assert!(!model.mesh.triangles.is_empty());
            assert!(model.mesh.positions.iter().all(|p| p.is_finite()));
            for normal in &model.mesh.normals {
                assert!(is_unit((*normal).into()), "{normal}");
            }
            for triangle in &model.mesh.triangles {
                assert!(triangle.positions.iter().all(|&p| (p as usize) < model.mesh.positions.len()));
                assert!(triangle.normals.iter().all(|&n| (n as usize) < model.mesh.normals.len()));
                assert!((triangle.material as usize) < model.materials.len());
            }
            for part in &model.parts {
                assert!(part.triangles.start < part.triangles.end);
                assert!(part.triangles.end <= model.mesh.triangles.len());
            }
            for warning in &model.warnings {
                assert_eq!(warning.to_string().lines().count(), 1, "{warning}");
            }
        }
        Err(error) => {
            let message = error.to_string();
            assert_eq!(message.lines().count(), 1, "{message}");
        }
    }
});
