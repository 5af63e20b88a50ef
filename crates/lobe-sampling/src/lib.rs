//! Where the light that a lobe reflects to a viewer comes from, by chance: for each lobe of `lobe` a sample with its weight, the
//! density of the samples, and the value, in any number type.
//!
//! ```
//! use lobe::{Lambert, Rgb, Vec3};
//! use lobe_sampling::{Outcome, Sample};
//!
//! let chalk = Lambert::new(Rgb::new(0.8_f32, 0.7, 0.6));
//! let v = Vec3::new(0.6, 0.0, 0.8);
//! // Three numbers of [0, 1), of a generator or of a sequence.
//! match chalk.sample(v, [0.1, 0.5, 0.7]).outcome() {
//!     Outcome::Scattered { l, weight, pdf } => {
//!         // Radiance seen is `weight` times the radiance from `l`, on average.
//!         assert_eq!(weight.r, 0.8);
//!         assert_eq!(pdf, chalk.pdf(l, v));
//!     }
//!     Outcome::Delta { .. } | Outcome::Rejected => unreachable!("chalk is no mirror, and all its samples are above it"),
//! }
//! ```
//!
//! # Conventions
//!
//! Those of `lobe`: directions point away, in the local frame, `n = +z`. The viewer `v` is given and the light `l` is chosen, as a path
//! from the camera has it; a reciprocal lobe serves the other way too. Densities are per solid angle of `l`, in sr⁻¹.

#![no_std]
#![forbid(unsafe_code)]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)]
#![cfg_attr(not(test), deny(clippy::std_instead_of_core, clippy::alloc_instead_of_core))]

mod diffuse;
mod draw;
mod empirical;
mod gaussian;
pub mod map;
pub mod mis;
mod power;
mod sample;
mod sheen;

pub use sample::{Outcome, Sample, Sampled};
