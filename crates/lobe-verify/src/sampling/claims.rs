//! What a sampler claims of itself.

use crate::subject::Precision;

/// What is claimed beyond the statistics, which are claimed of everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claims {
    /// The density that comes with a sample is `pdf(l, v)` to this relative error, beyond what the rounding of `l`
    /// explains; `None` for 1e-9 in `f64` and 1e-4 in `f32`.
    pub pdf: Option<f64>,
    /// The weight is `f_r (n·l)/pdf` to this relative error, beyond what the rounding of `l` explains; `None` as above.
    pub weight: Option<f64>,
    /// A viewer on or below the horizon gets a rejected sample, and `pdf` is 0 for an `l` below it.
    pub below_horizon: bool,
    /// A NaN in `v`, or in a component of `u` that matters, gives a NaN weight.
    pub nan: bool,
    /// The smallest cosine of a view for which results have to be finite for every `u`.
    pub grazing: f64,
}

impl Claims {
    /// What the trait [`Sample`](lobe_sampling::Sample) promises.
    pub const LOBE: Self = Self { pdf: None, weight: None, below_horizon: true, nan: true, grazing: 1e-8 };

    /// What is asked of code of which nothing else is known: not NaN, nor viewers below the horizon.
    pub const OTHERS: Self = Self { below_horizon: false, nan: false, grazing: 1e-4, ..Self::LOBE };

    pub(crate) fn pdf_error(&self, precision: Precision) -> f64 {
        self.pdf.unwrap_or_else(|| rounding(precision))
    }

    pub(crate) fn weight_error(&self, precision: Precision) -> f64 {
        self.weight.unwrap_or_else(|| rounding(precision))
    }
}

fn rounding(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 1e-4,
        Precision::Double => 1e-9,
    }
}
