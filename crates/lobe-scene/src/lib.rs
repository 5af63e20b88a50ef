//! glTF, Wavefront OBJ and MTL in, lobes out, and a small ray caster that shades them.
//!
//! ```
//! use lobe_scene::image::Display;
//! use lobe_scene::{LoadOptions, Renderer, Settings, default_scene};
//!
//! let scene = default_scene(&LoadOptions::default())?;
//! let settings = Settings { width: 64, height: 36, ..Settings::default() };
//! let image = Renderer::new(&scene)?.render(&scene.views[0], &settings, None)?;
//! # let folder = tempfile::tempdir().expect("a folder");
//! # std::env::set_current_dir(&folder).expect("to go there");
//! image.save("lecture.png".as_ref(), &Display { exposure: scene.views[0].exposure, ..Display::default() })?;
//! # Ok::<(), lobe_scene::Error>(())
//! ```
//!
//! MTL is the lecture's model: `Ka`, `Kd`, `Ks` and `Ns` are its ambient, diffuse and specular coefficients and its
//! exponent. So a material file becomes a sum of lobes of the crate [`lobe`] without guessing.
//!
//! | where | what |
//! |---|---|
//! | [`load`], [`default_scene`] | a [`Scene`] from a `.gltf`, `.glb`, `.obj` or `.json` file, or the one that is built in |
//! | [`parse_description`] | the JSON: model, cameras, lights, views |
//! | [`obj`], [`mtl`] | the readers, on text in memory; what they accept and what they say |
//! | [`gltf`], [`GltfMaterial`], [`texture`] | glTF 2.0: the reader, its material point by point, filtered textures |
//! | [`Smoothing`] | normals where a file has none |
//! | [`Material`] | how a material becomes lobes, and in which units |
//! | [`Renderer`] | the picture: shadows, mirrors, two sides, smooth outlines |
//! | [`path`] | the picture with all light that comes by way of other surfaces: path tracing |
//! | [`image`] | PNG, EXR and PFM |
//! | [`write_atomically`], [`check_writable`] | files written without ever leaving half of one |
//! | [`procedural`] | scenes made by a formula |
//!
//! # Units
//!
//! A point light of intensity `I` (W·sr⁻¹) gives the irradiance `E = I/r²`; a surface sends out the radiance
//! `eval_cos · E`. The lecture's `L_i` is `I/π`: see [`Material`]. Colours are linear RGB everywhere; the curve of
//! sRGB is applied when a PNG file is written.
//!
//! # Limits
//!
//! No refraction; light that bounces between diffuse surfaces only in [`path`]. Coordinates up to
//! [`MAX_COORDINATE`]. Nothing that a file holds makes a function panic, and nothing is allocated from a number that
//! a file merely states.

#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

mod batch;
mod builtin;
mod bvh;
mod camera;
mod description;
mod error;
mod files;
pub mod gltf;
mod gltf_material;
pub mod image;
mod lines;
mod maps;
mod material;
mod mesh;
pub mod mtl;
mod normals;
pub mod obj;
pub mod path;
mod picture;
pub mod procedural;
mod render;
mod scene;
mod tangents;
pub mod texture;
mod triangulate;

pub use builtin::default_scene;
pub use camera::Camera;
pub use description::{LoadOptions, load, parse as parse_description};
pub use error::{Error, Warning};
pub use files::{check_writable, write_all_atomically, write_atomically};
pub use gltf_material::{Factors, GltfMaterial, Maps};
pub use image::Image;
pub use maps::MtlMaps;
pub use material::{AnyBrdf, LobeRecord, MappedLobes, Material, NamedLobes, ShadingModel, Surface};
pub use mesh::{MAX_COORDINATE, Mesh, Triangle, Vertex};
pub use normals::Smoothing;
pub use render::{Progress, Renderer, Settings};
pub use scene::{Background, Cone, Light, Scene, View};
