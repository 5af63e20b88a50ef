//! Measures what the shading mathematics of [`lobe`] promises: errors in ulps against the `f64` reference, and the
//! properties that a BRDF must have.
//!
//! ```
//! use lobe_verify::ulp::ulps_between;
//! assert_eq!(ulps_between(1.0_f32, 1.0 + f64::from(f32::EPSILON)), 1.0);
//! ```

pub mod audit;
pub mod comparison;
pub mod extremes;
pub mod mediump;
pub mod rough;
pub mod strategies;
pub mod sweep;
pub mod terms;
pub mod ulp;
