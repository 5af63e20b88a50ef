//! Every model of `lobe` by its name, with the parameters that it takes and their domains.
//!
//! For whoever learns only at run time which model is wanted: a file format, a command, a test that runs over all of
//! them. Whoever knows it beforehand takes the type from `lobe`, and pays for no choice.
//!
//! ```
//! use lobe::{Brdf, Vec3};
//! use lobe_models::{Lobe, Value, model};
//!
//! let phong = model("phong").expect("there is one");
//! let lobe = Lobe::new(phong, &[("ks", Value::Colour([0.5; 3])), ("q", Value::Number(20.0))])?;
//! let f = lobe.build::<f32>().eval(Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
//! assert!((f.r - 0.5 * 22.0 / core::f32::consts::TAU).abs() < 1e-6);
//! # Ok::<(), lobe_models::Error>(())
//! ```
//!
//! A sum of such lobes is a [`Material`], which can be read from JSON or taken from the [`preset`]s:
//!
//! ```
//! use lobe_models::Material;
//!
//! let text = r#"{"lobes": [{"model": "lambert", "albedo": [0.5, 0.05, 0.05]}, {"model": "phong", "ks": 0.04, "q": 80}]}"#;
//! let material = Material::from_json(text)?;
//! assert_eq!(material.name, "lambert + phong q=80");
//! let wrong = Material::from_json(r#"{"lobes": [{"model": "phong", "ks": 0.04, "q": -1}]}"#);
//! assert_eq!(wrong.unwrap_err().to_string(), "1:49: lobes[0]: `q` is -1.0; a number from 0 to 1000000");
//! # Ok::<(), lobe_models::JsonError>(())
//! ```
//!
//! With the feature `batch` a lobe or a material also runs over slices, at the SIMD level and to the precision that are
//! picked at run time: [`Lobe::batch`], [`Material::batch`]. It needs Rust 1.89.
//!
//! [`Lobe::sampler`] and [`Material::sampler`] draw directions of light from the lobes, with `lobe-sampling`.
//!
//! A model is added in one place, its file under `families/`: the command reads it, the property suite and the sweep
//! of the extremes run over it.

#[cfg(feature = "batch")]
mod batch;
mod catalogue;
mod families;
mod forms;
mod function;
mod json;
mod material;
mod names;
pub mod ngan;
mod number;
mod parameter;
mod presets;
mod reader;
mod sampler;
mod terms;

#[cfg(feature = "batch")]
pub use batch::{AnyBatch, AnyPrecision, BatchBrdf};
pub use catalogue::{Bound, Lobe, Model, model, models};
pub use function::Function;
pub use json::{JsonError, MAX_LOBES};
pub use material::Material;
pub use names::nearest;
pub use number::{AnyBrdf, Number};
pub use parameter::{Error, Kind, Parameter, TABLE, Value};
pub use presets::{PRESETS, preset};
pub use reader::Reader;
pub use sampler::{AnySampler, SampleNumber};
pub use terms::{AnyTerms, Terms};
