//! The statistics that would notice a wrong sampler, for anything that samples: a lobe of [`lobe_sampling`], or a
//! user's own as closures.
//!
//! ```
//! use lobe::{Lambert, Rgb};
//! use lobe_verify::sampling::verify;
//!
//! let report = verify("paper", &Lambert::new(Rgb::splat(0.8_f64)));
//! assert!(report.holds(), "{report}");
//! ```
//!
//! | property | how it is looked for |
//! |---|---|
//! | finite | `u` at 0, the last number before 1, subnormal, crossed, at the view and at a grazing one |
//! | below horizon, NaN | viewers and lights on and below it; a NaN in each component in turn that matters |
//! | pdf of sample, weight | against `pdf(l, v)` and `f_r cos/pdf`, beyond what the rounding of `l` explains |
//! | ∫ pdf | adaptive quadrature, to 1e-4 of what a low-discrepancy sequence keeps |
//! | rejected | their number, by the binomial distribution |
//! | χ² fit | bins of equal mass, the rejected in a cell of their own |
//! | KS of cos θ, of φ | Kolmogorov and Smirnov, at quantiles of other samples |
//! | mean weight | against [`directional_albedo`](lobe_energy::directional_albedo()), within its standard error |
//! | albedo | over the sequence, per channel, to 1e-3 where its standard error allows to tell |
//!
//! The tests that have a `p` share one significance, however many samplers and views there are: a suite of true
//! samplers raises a false alarm once in a thousand, as a whole (Holm's correction). Seeds are hashes of the names, so
//! that nobody picks one, and the numbers do not depend on threads.
//!
//! [`models`] is that suite of all samplers of this workspace.
//!
//! How small a fault is found is measured with planted ones: see [`mutants`].

mod catalogue;
mod claims;
mod draws;
pub mod mutants;
mod partition;
mod pointwise;
mod random;
mod report;
mod sampler;
mod statistics;
mod suite;
mod variance;
mod view;

pub use catalogue::{Catalogue, models};
pub use claims::Claims;
pub use random::Points;
pub use report::{Case, Fit, Observed, Outcome, Property, Report, Suite, Verdict, View};
pub use sampler::{AsSampler, Claiming, InDouble, InSingle, OfFn, Sampler};
pub use variance::{Variance, variances};
pub use view::view;

use lobe_sampling::Sample;
use rayon::prelude::*;

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Samples for the statistics.
    pub samples: usize,
    /// Bins for χ².
    pub bins: usize,
    /// Random samples that are looked at one by one, beside the 512 with extreme `u`.
    pub single: usize,
    /// Samples of the sequence, sixteen times.
    pub even: usize,
    /// The estimated error of all cells together down to which the quadrature is refined.
    pub tolerance: f64,
    /// The most cells that it may have before it is cut into bins.
    pub cells: usize,
    /// To what two quadratures of the albedo have to agree; see [`lobe_energy::directional_albedo_to`]. Where they do
    /// not, that of the cells is taken, which knows where the samples are.
    pub agreement: f64,
    /// The chance of any false alarm of the whole suite.
    pub significance: f64,
    /// For [`models`]: lobes of each model.
    pub lobes: usize,
    /// For [`models`]: views, at most five.
    pub views: usize,
}

impl Effort {
    /// Some hundredths of a second for a sampler and a view.
    pub const QUICK: Self = Self {
        samples: 1 << 16,
        bins: 128,
        single: 512,
        even: 1 << 12,
        tolerance: 1e-5,
        cells: 6000,
        agreement: 1.0,
        significance: 1e-3,
        lobes: 1,
        views: 3,
    };
    /// A second or two.
    pub const FULL: Self = Self {
        samples: 1 << 22,
        bins: 512,
        single: 8192,
        even: 1 << 16,
        tolerance: 1e-6,
        cells: 60_000,
        agreement: 1e-6,
        lobes: 8,
        views: 4,
        ..Self::QUICK
    };
}

/// The views of [`verify`]: along the normal, oblique and grazing, off the axes.
#[must_use]
pub fn views() -> [[f64; 3]; 3] {
    [view(1.0, 0.0), view(0.5, 30.0), view(0.01, 75.0)]
}

/// Looks for all properties of one sampler at three views, with the claims that samplers of its kind have and a quick
/// effort.
///
/// It takes a [`Sample<f64>`](Sample), a `Sample<f32>` or any [`Sampler`], such as closures in [`OfFn`]. The seeds are
/// made from the name: that of the test is as good as any.
pub fn verify<K>(name: &str, sampler: &impl AsSampler<K>) -> Report {
    let sampler = sampler.as_sampler();
    verify_with(name, &&*sampler, &sampler.claims(), &views(), Effort::QUICK)
}

/// [`verify`], with claims, views and an effort of one's own. The tests of all views share the significance.
pub fn verify_with<K>(
    name: &str,
    sampler: &impl AsSampler<K>,
    claims: &Claims,
    views: &[[f64; 3]],
    effort: Effort,
) -> Report {
    let sampler = sampler.as_sampler();
    let report = report(name, &*sampler, claims, views, &effort);
    let mut suite = Suite::judged(effort.significance, vec![report]);
    suite.reports.pop().unwrap_or_else(|| Report { name: name.to_owned(), views: Vec::new() })
}

/// Many samplers by their names, each at the same views and with its own claims, see [`Claiming`]; the tests of all
/// share the significance.
#[must_use]
pub fn verify_all(samplers: &[(&str, &dyn Sampler)], views: &[[f64; 3]], effort: Effort) -> Suite {
    counted(samplers, views, &effort, &|| ())
}

/// [`verify_all`]; `done` is called after each sampler.
fn counted(samplers: &[(&str, &dyn Sampler)], views: &[[f64; 3]], effort: &Effort, done: &(dyn Fn() + Sync)) -> Suite {
    let of = |(name, sampler): &(&str, &dyn Sampler)| {
        let report = report(name, *sampler, &sampler.claims(), views, effort);
        done();
        report
    };
    Suite::judged(effort.significance, samplers.par_iter().map(of).collect())
}

/// [`verify_all`] of lobes in boxes.
#[must_use]
pub fn verify_lobes(lobes: &[(&str, Box<dyn Sample<f64> + Send + Sync>)], views: &[[f64; 3]], effort: Effort) -> Suite {
    let lobes: Vec<_> = lobes.iter().map(|(name, lobe)| (*name, InDouble(&**lobe))).collect();
    let samplers: Vec<_> = lobes.iter().map(|(name, lobe)| (*name, lobe as &dyn Sampler)).collect();
    verify_all(&samplers, views, effort)
}

fn report(name: &str, sampler: &dyn Sampler, claims: &Claims, views: &[[f64; 3]], effort: &Effort) -> Report {
    let views = views.par_iter().map(|v| view::check(name, sampler, claims, *v, effort)).collect();
    Report { name: name.to_owned(), views }
}

#[cfg(test)]
mod tests;
