//! The scene that is built in.
//!
//! It shows what a lecture on local illumination shows, in the views `overview`, `exponent` (the same sphere with
//! `q` = 1, 4, 16, 64, 256, 1024), `light` (the same sphere lit from five directions), `materials` (diffuse, glossy and
//! mirror-like), `smooth-flat` (one mesh of 20,160 triangles with smooth and with flat shading) and `models`
//! (microfacet metals from rough to smooth, a plastic of glTF and three measured materials).
//!
//! The files are in `assets/`, made by the example `make_assets`.

use crate::description::{self, LoadOptions};
use crate::error::Error;
use crate::scene::Scene;
use std::io;

const DESCRIPTION: &str = include_str!("../../../assets/lecture.json");
const MODEL: &str = include_str!("../../../assets/lecture.obj");
const MATERIALS: &str = include_str!("../../../assets/lecture.mtl");

/// The built-in scene. It goes through the same readers as a file.
///
/// # Errors
/// [`Error::Setting`] when `options` are outside their domain; the files themselves are tested.
pub fn default_scene(options: &LoadOptions) -> Result<Scene, Error> {
    let mut files = |name: &str| match name {
        "lecture.obj" => Ok(MODEL.into()),
        "lecture.mtl" => Ok(MATERIALS.into()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    description::parse(DESCRIPTION, "lecture.json", &mut files, options)
}
