//! How much of the light a lobe reflects, and what to do about the rest: albedos by deterministic quadrature, furnaces, and lobes that
//! give back what single reflections lose.
//!
//! ```
//! use lobe::{Alpha, Microfacet, Rgb, Vec3};
//! use lobe::{distribution::Ggx, fresnel::Schlick, masking::SmithCorrelated};
//! use lobe_energy::{KullaConty, directional_albedo};
//!
//! let (alpha, white) = (Alpha(0.8), Schlick::new(Rgb::splat(1.0)));
//! let v = Vec3::new(0.6, 0.0, 0.8);
//! // A rough white metal in a white world should vanish. Reflecting once, it is grey.
//! let once = Microfacet::new(Ggx::new(alpha), SmithCorrelated, white);
//! assert!(directional_albedo(&once, v).value.g < 0.6);
//! // With the light of further reflections it is white.
//! let metal: KullaConty<_, f64> = KullaConty::new(alpha, white);
//! assert!((directional_albedo(&metal, v).value.g - 1.0).abs() < 1e-3);
//! ```
//!
//! | to know | call | right to |
//! |---|---|---|
//! | `E(v)` of any lobe | [`directional_albedo`] | its own estimate; short of points for `α < 0.01` near the horizon |
//! | `E(v)` of a microfacet lobe | [`microfacet_albedo`] | 1e-6 for `α` from 1e-4 to 1 at any view |
//! | `E` of light from everywhere | [`average_albedo`] | as what it is given |
//! | whether `G` belongs to `D` | [`weak_white_furnace`] | 1e-6 |
//! | `E(μ)` of GGX, quickly, in any number type | [`GgxFit`], [`GgxTable`] | 5e-4, 1.5e-3 |
//!
//! | to keep the light | | reciprocal | a white one is white to |
//! |---|---|---|---|
//! | metals and dielectrics | [`KullaConty`] | to the last bit | 6e-4 |
//! | the same, cheaper | [`Turquin`] | no | 1.2e-3 |
//! | Schlick's term over a diffuse base | [`FdezAguera`] | no | 7e-3 |
//! | a dielectric over a diffuse base | [`CoupledDiffuse`] | to the last bit | 7e-3 |
//! | a dielectric over any base | [`AlbedoCoat`] | to the last bit | see there |
//! | as engines do it | [`engines`] | no | see there |

#![no_std]
#![forbid(unsafe_code)]

mod albedo;
#[allow(clippy::approx_constant, reason = "the loss of the roughest along its normal is ln 2")]
mod baked;
mod coat;
mod compensation;
mod corner;
pub mod engines;
mod furnace;
mod ggx;
mod half_vector;
mod quadrature;

pub use albedo::{Albedo, Exchanged, directional_albedo, directional_albedo_to};
pub use coat::{AlbedoCoat, Even, Least, Share};
pub use compensation::{CoupledDiffuse, FdezAguera, KullaConty, Turquin, average_fresnel};
pub use corner::Corner;
pub use furnace::{masking, weak_white_furnace, weak_white_furnace_to};
pub use ggx::{GgxAlbedo, GgxFit, GgxTable};
pub use half_vector::{average_albedo, microfacet_albedo, microfacet_albedo_to};
