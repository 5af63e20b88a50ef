//! Measures what the shading mathematics of [`lobe`] promises: errors in ulps against the `f64` reference, and the
//! properties that a BRDF must have.
//!
//! ```
//! use lobe_verify::properties::{Property, verify};
//!
//! // A diffuse surface whose author forgot the 1/π: anything that can be called is looked at.
//! let report = verify(&|l: [f64; 3], v: [f64; 3]| if l[2] > 0.0 && v[2] > 0.0 { [0.8; 3] } else { [0.0; 3] });
//! let failures: Vec<_> = report.failures().map(|verdict| verdict.property).collect();
//! assert_eq!(failures, [Property::Energy]);
//! ```

pub mod audit;
pub mod certify;
pub mod comparison;
pub mod extremes;
pub mod interval;
pub mod mediump;
pub mod properties;
pub mod rough;
pub mod sampling;
pub mod strategies;
pub mod subject;
pub mod sweep;
pub mod terms;
pub mod ulp;
