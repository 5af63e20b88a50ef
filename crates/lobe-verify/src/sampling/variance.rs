//! What a sampler costs: how many samples an albedo takes.

use super::draws::pilot;
use super::partition::{Chart, Density, Partition};
use super::random::seed;
use super::view::around_mirror;
use super::{Effort, Sampler};
use rayon::prelude::*;
use serde::Serialize;
use std::fmt;

/// The variance of a sampler at a view, by quadrature of `f²/pdf`; of the part that has a density.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Variance {
    /// The sampler's name.
    pub name: String,
    /// The viewer.
    pub v: [f64; 3],
    /// The directional albedo, mean of the channels.
    pub albedo: f64,
    /// Of the weight of one sample.
    pub variance: f64,
    /// So many samples give the albedo to 1 %, one standard error: `variance/(0.01 albedo)²`, and not fewer than one.
    pub samples: f64,
    /// The part of the samples that is rejected: what the density leaves.
    pub rejected: f64,
}

impl fmt::Display for Variance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, v: [_, _, z], albedo, variance, samples, rejected } = self;
        write!(f, "| {name} | {z:.4} | {albedo:.5} | {variance:.3e} | {:.2} % | {samples:.0} |", 100.0 * rejected)
    }
}

/// A table: one row for each sampler that gives values, at each view. A lobe without light to reflect has no row.
#[must_use]
pub fn variances(samplers: &[(&str, &dyn Sampler)], views: &[[f64; 3]]) -> Vec<Variance> {
    let all: Vec<_> = samplers.iter().flat_map(|sampler| views.iter().map(move |v| (sampler, *v))).collect();
    all.into_par_iter().filter_map(|((name, sampler), v)| variance(name, *sampler, v)).collect()
}

fn variance(name: &str, sampler: &dyn Sampler, v: [f64; 3]) -> Option<Variance> {
    let v = v.map(|x| sampler.precision().round(x));
    let mut places = pilot(sampler, v, Chart::new(v), seed(&format!("{name} {v:?}")), 1 << 14);
    places.extend(around_mirror(v));
    let Effort { tolerance, cells, .. } = Effort::QUICK;
    let (sums, ..) = Partition::new(&Density { sampler, v }, &mut places, tolerance, cells).total();
    let albedo = sums.mean_value();
    let variance = (sums.second - albedo * albedo).max(0.0);
    let samples = (variance / (1e-4 * albedo * albedo)).max(1.0);
    let rejected = (1.0 - sums.pdf).max(0.0);
    (albedo > 0.0).then(|| Variance { name: name.to_owned(), v, albedo, variance, samples, rejected })
}
