//! Which function of a program evaluates a lobe, by its name.

use lobe::{Brdf, Real};
use std::any::type_name;

/// The function that evaluates a lobe, by what its name in a program is made of: so that it can be found there, and its
/// machine code be looked at.
///
/// Only names of the version `v0` say what a generic function was made for (`-C symbol-mangling-version=v0`). The parts
/// are as `{:#}` of `rustc-demangle` prints them: with modules, without the hashes of crates.
///
/// ```
/// let phong = lobe_models::model("phong").expect("there is one").typical();
/// let functions = phong.functions::<f64>();
/// assert_eq!(
///     functions[0].to_string(),
///     "<lobe::brdf::phong::Phong<f64> as lobe::brdf::Brdf<f64>>::eval_cos"
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// [`Brdf::eval_cos`] of a scalar.
    Scalar {
        /// The type of the lobe.
        lobe: &'static str,
        /// The trait, with its number type.
        brdf: &'static str,
    },
    /// The loop of a batch, of which there is one for each SIMD level.
    Lanes {
        /// The type of the precision.
        precision: &'static str,
        /// The type of the kernel.
        kernel: &'static str,
    },
}

impl Function {
    /// `eval_cos` of `B`, called with numbers `R`.
    pub(crate) fn scalar<B, R: Real + 'static>() -> Self {
        let object = type_name::<dyn Brdf<R>>();
        Self::Scalar { lobe: type_name::<B>(), brdf: object.strip_prefix("dyn ").unwrap_or(object) }
    }

    /// The loop of the kernel `K` to the precision `P`.
    #[cfg(feature = "batch")]
    #[cfg_attr(any(test, lobe_scalar), allow(dead_code, reason = "see `Compiled`"))]
    pub(crate) fn lanes<P, K>() -> Self {
        Self::Lanes { precision: type_name::<P>(), kernel: type_name::<K>() }
    }
}

/// The whole name of a scalar's function; of a batch's the arguments that follow the register of the level.
impl std::fmt::Display for Function {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Scalar { lobe, brdf } => write!(f, "<{lobe} as {brdf}>::eval_cos"),
            Self::Lanes { precision, kernel } => write!(f, "{precision}, {kernel}"),
        }
    }
}
