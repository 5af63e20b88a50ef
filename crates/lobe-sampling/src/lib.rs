//! Where the light that a lobe reflects to a viewer comes from, by chance: for each lobe of `lobe` a sample with its
//! weight, the density of the samples, and the value, in any number type.
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
//! # What is sampled how
//!
//! | lobe | by |
//! |---|---|
//! | [`Microfacet`](lobe::Microfacet), [`CookTorrance`](lobe::CookTorrance), [`Blinn1977`](lobe::Blinn1977) | facets: visible ones for GGX and Beckmann, [`facets`] has the methods; [`by`](SampleBy::by) selects one |
//! | [`MetallicRoughness`](lobe::MetallicRoughness) | facets, or the cosine |
//! | [`Sum`](lobe::Sum), [`Coat`](lobe::Coat), [`Clearcoat`](lobe::Clearcoat), [`AlbedoCoat`](lobe_energy::AlbedoCoat) | one of their parts, with the density of the whole |
//! | [`SheenLayer`](lobe::SheenLayer), [`KullaConty`](lobe_energy::KullaConty), [`FdezAguera`](lobe_energy::FdezAguera), [`CoupledDiffuse`](lobe_energy::CoupledDiffuse) | a part, or the cosine |
//! | [`Turquin`](lobe_energy::Turquin) | facets |
//! | [`Phong`](lobe::Phong), [`BlinnPhong`](lobe::BlinnPhong), [`AshikhminShirley`](lobe::AshikhminShirley), the lecture's highlights | their power of a cosine, around the mirror direction or the normal of the facet |
//! | [`Lafortune`](lobe::Lafortune) | its cosine lobe, or the cosine |
//! | [`Ward`](lobe::Ward) and its successors | their Gaussian of slopes |
//! | [`LowSmooth`](lobe::LowSmooth), [`LowMicrofacet`](lobe::LowMicrofacet), [`HeTorrance`](lobe::HeTorrance), [`ShiftedGamma`](lobe::ShiftedGamma) | their profile or facets as wide, or the cosine |
//! | [`Eon`](lobe::Eon) | its clipped cosines, or evenly; other diffuse lobes by the cosine |
//! | [`Charlie`](lobe::Charlie) | evenly |
//! | [`Mirror`](lobe::Mirror), [`Black`](lobe::Black) | a delta; nothing |
//! | any other [`Brdf`](lobe::Brdf) | [`ByCosine`] |
//!
//! # Conventions
//!
//! Those of `lobe`: directions point away, in the local frame, `n = +z`. The viewer `v` is given and the light `l` is
//! chosen, as a path from the camera has it; a reciprocal lobe serves the other way too. Densities are per solid angle
//! of `l`, in sr⁻¹.

#![no_std]
#![forbid(unsafe_code)]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)]
#![cfg_attr(not(test), deny(clippy::std_instead_of_core, clippy::alloc_instead_of_core))]

#[cfg(feature = "simd")]
#[allow(clippy::incompatible_msrv, reason = "the feature needs Rust 1.89, as its document says")]
pub mod batch;
mod cosine;
mod delta;
mod diffuse;
mod draw;
mod empirical;
pub mod facets;
mod gaussian;
mod layered;
pub mod map;
mod microfacet;
pub mod mis;
mod mixture;
mod power;
mod rules;
mod sample;
mod sheen;
mod special;

pub use cosine::ByCosine;
pub use microfacet::{By, SampleBy};
pub use sample::{Outcome, Sample, Sampled};

#[cfg(test)]
extern crate std;
