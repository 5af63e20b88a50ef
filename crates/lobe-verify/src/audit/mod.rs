//! What the published formulas of engines do with light: each put through furnaces, exchanged directions and the exact terms.
//!
//! The formulas are written anew from their published equations, in `f64`: what is found is the formula's doing, not that of a
//! number format. Real-time engines trade for speed, and say so; the figures say what is paid.
//!
//! ```
//! use lobe_verify::audit::{ENGINES, audit, Effort};
//! let filament = ENGINES.iter().find(|engine| engine.name.starts_with("Filament")).unwrap();
//! let found = audit(filament, Effort::QUICK);
//! // White metal is white to a percent.
//! assert!(found.white_metal.least.albedo > 0.99 && found.white_metal.most.albedo < 1.01);
//! ```

mod engines;

pub use engines::{Asked, ENGINES, Engine, exact};

use lobe::{Alpha, Brdf, Rgb, Vec3};
use lobe_energy::{Exchanged, microfacet_albedo_to};
use rayon::prelude::*;

/// How many roughnesses and views are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Perceptual roughnesses, even from 0.1 to 1.
    pub roughnesses: usize,
    /// Cosines of the view, even in the root from 0.05 to 1.
    pub views: usize,
    /// Cosines and azimuths of the light, for each view, where values are compared.
    pub lights: (usize, usize),
}

impl Effort {
    /// Some seconds for all engines.
    pub const QUICK: Self = Self { roughnesses: 4, views: 5, lights: (6, 5) };
    /// A minute or so.
    pub const FULL: Self = Self { roughnesses: 10, views: 12, lights: (16, 12) };

    fn roughnesses(self) -> impl Iterator<Item = f64> {
        even(self.roughnesses, 0.1, 1.0)
    }

    fn views(self) -> impl Iterator<Item = f64> {
        even(self.views, 0.05_f64.sqrt(), 1.0).map(|root| root * root)
    }
}

fn even(count: usize, from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| from + (to - from) * i as f64 / (count.max(2) - 1) as f64)
}

/// An albedo and where it is met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// `E(v)`.
    pub albedo: f64,
    /// The perceptual roughness.
    pub roughness: f64,
    /// `n·v`.
    pub n_dot_v: f64,
}

/// The least and the most that is reflected, over all roughnesses and views.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Where the most light is lost.
    pub least: Place,
    /// Where the most is gained.
    pub most: Place,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Audit {
    /// The engine.
    pub engine: &'static Engine,
    /// A metal with `F0 = 1` in a white world: 1 is right everywhere.
    pub white_metal: Range,
    /// A white dielectric, seen: 1 is right everywhere.
    pub white_dielectric: Range,
    /// The same, lit by one beam: what is sent out in all directions.
    pub white_dielectric_lit: Range,
    /// `E(v)` of the white metal: perceptual roughness, then pairs of `n·v` and albedo.
    pub curves: Vec<(f64, Vec<(f64, f64)>)>,
    /// The largest ratio of `f(l, v)` and `f(v, l)`, 1 for what is reciprocal.
    pub defect: f64,
    /// The relative difference of the gold metal to GGX with Smith's correlated masking and Schlick's term: median and worst, where
    /// that is above a thousandth of its peak.
    pub median_error: f64,
    /// The worst.
    pub worst_error: f64,
}

/// Quadratures agree to this: four digits are shown.
const AGREEMENT: f64 = 1e-5;

fn at(mu: f64, azimuth: f64) -> Vec3<f64> {
    let sin = ((1.0 - mu) * (1.0 + mu)).max(0.0).sqrt();
    Vec3::new(sin * azimuth.cos(), sin * azimuth.sin(), mu)
}

/// Puts one engine's formula through all.
#[must_use]
pub fn audit(engine: &'static Engine, effort: Effort) -> Audit {
    let white = Rgb::splat(1.0);
    let (white_metal, curves) = furnace(engine, effort, Asked { base: white, metallic: 1.0, roughness: 0.0 }, false);
    let dielectric = Asked { base: white, metallic: 0.0, roughness: 0.0 };
    let (white_dielectric, _) = furnace(engine, effort, dielectric, false);
    let (white_dielectric_lit, _) = furnace(engine, effort, dielectric, true);
    let (defect, median_error, worst_error) = values(engine, effort);
    Audit { engine, white_metal, white_dielectric, white_dielectric_lit, curves, defect, median_error, worst_error }
}

/// All engines, in parallel.
#[must_use]
pub fn audit_all(effort: Effort, done: &(dyn Fn() + Sync)) -> Vec<Audit> {
    ENGINES
        .par_iter()
        .map(|engine| {
            let found = audit(engine, effort);
            done();
            found
        })
        .collect()
}

type Curves = Vec<(f64, Vec<(f64, f64)>)>;

fn furnace(engine: &Engine, effort: Effort, asked: Asked, exchanged: bool) -> (Range, Curves) {
    let nowhere = |albedo| Place { albedo, roughness: 0.0, n_dot_v: 0.0 };
    let mut range = Range { least: nowhere(f64::INFINITY), most: nowhere(f64::NEG_INFINITY) };
    let mut curves = Vec::new();
    for roughness in effort.roughnesses() {
        let brdf = engine.brdf(Asked { roughness, ..asked });
        let alpha = Alpha(roughness * roughness);
        let mut curve = Vec::new();
        for n_dot_v in effort.views() {
            let v = at(n_dot_v, 0.0);
            let albedo = match exchanged {
                true => microfacet_albedo_to(AGREEMENT, &Exchanged(&*brdf), (alpha, alpha), v),
                false => microfacet_albedo_to(AGREEMENT, &*brdf, (alpha, alpha), v),
            };
            let place = Place { albedo: albedo.value.g, roughness, n_dot_v };
            if place.albedo < range.least.albedo {
                range.least = place;
            }
            if place.albedo > range.most.albedo {
                range.most = place;
            }
            curve.push((n_dot_v, place.albedo));
        }
        curves.push((roughness, curve));
    }
    (range, curves)
}

/// The worst exchange, and the differences to the exact terms.
fn values(engine: &Engine, effort: Effort) -> (f64, f64, f64) {
    let gold = Rgb::new(1.0, 0.77, 0.34);
    let mut defect = 1.0_f64;
    let mut errors = Vec::new();
    for roughness in effort.roughnesses() {
        let asked = Asked { base: gold, metallic: 1.0, roughness };
        let (brdf, exact) = (engine.brdf(asked), exact(asked));
        let peak = exact.eval(at(1.0, 0.0), at(1.0, 0.0)).g;
        for n_dot_v in effort.views() {
            let v = at(n_dot_v, 0.0);
            for n_dot_l in even(effort.lights.0, 0.05, 1.0) {
                for azimuth in even(effort.lights.1, 0.0, std::f64::consts::PI) {
                    let l = at(n_dot_l, azimuth);
                    let (one, other) = (brdf.eval(l, v).g, brdf.eval(v, l).g);
                    if one > 0.0 && other > 0.0 {
                        defect = defect.max(one / other).max(other / one);
                    }
                    let right = exact.eval(l, v).g;
                    if right > 1e-3 * peak {
                        errors.push((one / right - 1.0).abs());
                    }
                }
            }
        }
    }
    errors.sort_by(f64::total_cmp);
    let median = errors.get(errors.len() / 2).copied().unwrap_or(0.0);
    (defect, median, errors.last().copied().unwrap_or(0.0))
}
