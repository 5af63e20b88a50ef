//! To be written.

mod bvh;
mod camera;
mod error;
pub mod image;
mod lines;
mod material;
mod mesh;
pub mod mtl;
mod normals;
pub mod obj;
mod render;
mod scene;
mod triangulate;

pub use camera::Camera;
pub use error::{Error, Warning};
pub use image::Image;
pub use material::{AnyBrdf, LobeRecord, Material, ShadingModel, Surface};
pub use mesh::{MAX_COORDINATE, Mesh, Triangle};
pub use normals::Smoothing;
pub use render::{Progress, Renderer, Settings};
pub use scene::{Background, Light, Scene, View};
