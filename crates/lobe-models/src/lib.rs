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
//! A model is added in one place, its file under `families/`: the command reads it, the property suite and the sweep
//! of the extremes run over it.

mod catalogue;
mod families;
mod number;
mod parameter;
mod reader;

pub use catalogue::{Bound, Lobe, Model, model, models};
pub use number::{AnyBrdf, Number};
pub use parameter::{Error, Kind, Parameter, Value};
pub use reader::Reader;
