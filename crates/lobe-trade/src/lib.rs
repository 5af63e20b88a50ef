//! What digits cost: the time of a value and of a sample, and the machine code, of each model of `lobe` in each number type,
//! beside the error that is seen.
//!
//! ```
//! use lobe_models::{Material, preset};
//! use lobe_trade::{Bench, Effort, Number, Subject};
//!
//! let gold = Subject::of_material(&preset("ggx-gold")?);
//! let rows = Bench::new(Effort::quick()).measure(&gold, &Number::all());
//! // The scalar f64 is what errors are measured against.
//! assert!(rows.iter().any(|row| row.number.name() == "f64" && row.error.worst == 0.0));
//! # Ok::<(), lobe_models::Error>(())
//! ```
//!
//! A [`Subject`] is a material in one or more forms: as it is, and with an approximation in place of one of its parts.
//! A [`Bench`] runs each form in each [`Number`] and gives a [`Row`].
//!
//! # What is timed
//!
//! What a renderer does at a point: the directions to the light and to the viewer and the irradiance of the light are
//! read, `eval_cos · E` is added to the pixel. In lanes that is one call for all points; as scalars it is a call
//! through a pointer for each, as where a material is chosen at run time.
//!
//! - *resident*: buffers of 256 points, eight of them in turn, so that neither branches nor addresses are learnt by
//!   heart. They are 96 KiB together.
//! - *sample*: of the scalars `f32` and `f64`, a direction with its weight and its density, from a viewer and three numbers of
//!   `[0, 1)`, through a pointer for each point; as many buffers, in turn with the above. Of several lobes one draws, and all
//!   of them are evaluated at the direction that it gives.
//! - *streaming*: every point is another one, [`Effort::stream`] bytes in all. A machine whose last cache is larger than
//!   that serves it from there.
//! - *all cores*: the resident loop on every core at once.
//!
//! All numbers of a subject are timed in turn, round after round, each round beginning with another one; the times are
//! medians, with quartiles. [`is_noisy`] says when they are not to be trusted.
//!
//! # What is counted
//!
//! - *bytes*: the machine code of the functions that evaluate the lobes, which the program looks up among its own
//!   symbols. Of a scalar that is `eval_cos` of the lobe's type; in lanes the loop over whole registers of
//!   `eval_cos · E`. Several lobes add up, each function once. What such a function calls is not included (the logarithm
//!   of an `f64`, for one), nor what is the same for all lobes: the sum, the weights, the rest that fills no register.
//!   A microfacet lobe whose terms are chosen at run time is one function with every masking and every Fresnel term: all
//!   of them as scalars, and in lanes all but the common ones ([`Lobe::batch`](lobe_models::Lobe::batch) says which).
//!
//! Only programs in ELF whose names say what a generic function was made for can tell: those that are not stripped and
//! built with `-C symbol-mangling-version=v0`, as the workspace does. Elsewhere [`Bench::no_code`] says why not.
//!
//! # What is compared
//!
//! - *error*: of `eval_cos` against `f64` of the same inputs, as a part of the value, for 4096 pairs of directions, half
//!   of them near the mirror direction of each other. Values below a ten-thousandth of the largest are left out.
//! - *albedo*: the largest error of the directional albedo, for viewers at 0°, 60° and 80°, by the same quadrature for
//!   both.
//! - *seen*: a sphere under three lights, exposed so that the brightest percent of `f64` is just below white, in sRGB.
//!   ΔE 2000 of each pixel, and the largest difference of a channel in steps of eight bits.
//!
//! A form that stands for another is compared with what it stands for.

mod code;
mod measure;
mod picture;
mod subject;

pub use measure::{Bench, Effort, Errors, Number, Quartiles, Row, is_noisy};
pub use picture::{Seen, delta_e};
pub use subject::{Form, Subject, catalogue};
