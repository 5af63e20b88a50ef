//! The power of the statistics: samplers as an engine would port them, each with a fault that is often made, and how
//! small a part of it would still be found.

mod models;

pub use models::{Model, Port};

use super::statistics::noncentrality_found;
use super::{Claims, Effort, Property, Report, Sampler, verify_with, view};
use lobe_sampling::Outcome;
use serde::Serialize;
use std::fmt;

/// A fault of a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// GGX by visible normals: the density is that of the normal, without `1/(4 (v·h))`.
    JacobianDropped,
    /// GGX by visible normals: `αx` and `αy` exchanged when sampling.
    WidthsSwapped,
    /// Phong: sampled with `q + 2`.
    ExponentOffByTwo,
    /// Phong: the density divided by what is not rejected, but rejected samples still counted.
    Renormalised,
    /// GGX: sampled by all normals, with the density of the visible ones.
    NormalsForVisible,
    /// Lambert: sampled evenly, with the density of the cosine.
    CosineForgotten,
    /// GGX by all normals: an even azimuth for two widths.
    AzimuthNotStretched,
    /// Phong: a sample below the horizon mirrored up.
    MirroredUp,
    /// Phong: a sample below the horizon kept.
    BelowKept,
    /// GGX by visible normals: `G1(l)` for the weight, though masking is correlated.
    WeightUncorrelated,
    /// GGX by all normals: a quotient by `u` that may be 0.
    DividedByZero,
}

impl Fault {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::JacobianDropped,
        Self::WidthsSwapped,
        Self::ExponentOffByTwo,
        Self::Renormalised,
        Self::NormalsForVisible,
        Self::CosineForgotten,
        Self::AzimuthNotStretched,
        Self::MirroredUp,
        Self::BelowKept,
        Self::WeightUncorrelated,
        Self::DividedByZero,
    ];

    /// In a few words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::JacobianDropped => "GGX: 1/(4 v·h) missing in the density",
            Self::WidthsSwapped => "GGX: αx and αy exchanged in the sampler",
            Self::ExponentOffByTwo => "Phong: q + 2 for q in the sampler",
            Self::Renormalised => "Phong: density without the rejected mass",
            Self::NormalsForVisible => "GGX: samples of D cos, density of visible normals",
            Self::CosineForgotten => "Lambert: even samples, density of the cosine",
            Self::AzimuthNotStretched => "GGX: azimuth not stretched by αy/αx",
            Self::MirroredUp => "Phong: mirrored up instead of rejected",
            Self::BelowKept => "Phong: kept instead of rejected",
            Self::WeightUncorrelated => "GGX: weight G1(l) for G2/G1(v)",
            Self::DividedByZero => "GGX: division by u = 0",
        }
    }

    fn model(self) -> Model {
        match self {
            Self::CosineForgotten => Model::Cosine,
            Self::Renormalised => Model::Phong(1.0),
            Self::ExponentOffByTwo | Self::MirroredUp | Self::BelowKept => Model::Phong(4.0),
            Self::AzimuthNotStretched | Self::DividedByZero => Model::Normals([0.4, 0.1]),
            Self::WidthsSwapped => Model::VisibleNormals([0.4, 0.1]),
            Self::JacobianDropped | Self::NormalsForVisible | Self::WeightUncorrelated => {
                Model::VisibleNormals([0.4, 0.4])
            }
        }
    }

    /// The sampler with this fault.
    #[must_use]
    pub fn planted(self) -> Port {
        Port { model: self.model(), fault: Some(self) }
    }

    /// The same sampler without it.
    #[must_use]
    pub fn sound(self) -> Port {
        Port::sound(self.model())
    }
}

/// A part of a fault: so many of the samples are from the sampler with the fault, and so much of the density is its
/// own. The value is that of the truth.
#[derive(Clone, Copy, Debug)]
pub struct Mixed<A, B> {
    /// The sampler with the fault.
    pub fault: A,
    /// The one without.
    pub truth: B,
    /// The part, from 0 to 1.
    pub part: f64,
}

impl<A: Sampler, B: Sampler> Sampler for Mixed<A, B> {
    fn sample(&self, v: [f64; 3], [u, x, y]: [f64; 3]) -> Outcome<f64> {
        let sample = if u < self.part {
            self.fault.sample(v, [u / self.part, x, y])
        } else {
            self.truth.sample(v, [(u - self.part) / (1.0 - self.part), x, y])
        };
        let Outcome::Scattered { l, .. } = sample else { return sample };
        let Some((value, pdf)) = self.eval_cos_pdf(l.into(), v) else { return sample };
        Outcome::Scattered { l, weight: lobe::Rgb::from(value.map(|value| value / pdf)), pdf }
    }
    fn pdf(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        self.part * self.fault.pdf(l, v) + (1.0 - self.part) * self.truth.pdf(l, v)
    }
    fn eval_cos_pdf(&self, l: [f64; 3], v: [f64; 3]) -> Option<([f64; 3], f64)> {
        self.truth.eval_cos_pdf(l, v).map(|(value, _)| (value, self.pdf(l, v)))
    }
    fn claims(&self) -> Claims {
        self.truth.claims()
    }
}

/// What the statistics say of a fault.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The fault.
    pub fault: Fault,
    /// The properties that find it, at any view.
    pub caught_by: Vec<Property>,
    /// The smallest `p` of all tests, corrected for the number of tests.
    pub p: f64,
    /// The smallest part of the fault, mixed with the truth, that the test of fit finds nine times in ten at this
    /// number of samples, at the view that shows it best; `None` where that test sees nothing of the fault. From the
    /// noncentral distribution of χ², whose parameter grows with the square of the part.
    pub least_part: Option<f64>,
    /// What is said of the same sampler without the fault, if anything.
    pub false_alarms: Vec<Property>,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let by: Vec<_> = self.caught_by.iter().map(|property| property.name()).collect();
        let by = if by.is_empty() { "NOT CAUGHT".to_owned() } else { by.join(", ") };
        let part = self.least_part.map_or_else(String::new, |part| format!("{:.2} %", 100.0 * part));
        write!(f, "| {} | {by} | {:.0e} | {part} |", self.fault.name(), self.p)
    }
}

/// The views at which faults are looked for.
fn looked_at() -> [[f64; 3]; 3] {
    [view(0.9, 20.0), view(0.5, 30.0), view(0.05, 75.0)]
}

/// All faults: which property finds each, and how small a part of it.
#[must_use]
pub fn survey(effort: Effort) -> Vec<Row> {
    Fault::ALL.map(|fault| row(fault, effort)).to_vec()
}

fn row(fault: Fault, effort: Effort) -> Row {
    let report = |port: Port, name: &str| {
        verify_with(&format!("{} ({name})", fault.name()), &port, &port.claims(), &looked_at(), effort)
    };
    let properties = |report: &Report| {
        let mut properties: Vec<_> = report.failures().map(|verdict| verdict.property).collect();
        properties.sort();
        properties.dedup();
        properties
    };
    let (planted, sound) = (report(fault.planted(), "planted"), report(fault.sound(), "sound"));
    let verdicts = || planted.views.iter().flat_map(|view| &view.verdicts);
    let tests = verdicts().filter(|verdict| verdict.p.is_some()).count();
    let significance = effort.significance / tests as f64;
    let least = |report: &Report, part: f64| {
        let parts = report.views.iter().filter_map(|view| least_part(view, significance, part));
        parts.min_by(f64::total_cmp)
    };
    // Again with three times as much of it, or more until it is seen: where all is wrong, χ² is not what it is of a
    // part.
    let mut least_part = least(&planted, 1.0);
    let mut part = 3.0 * least_part.unwrap_or(1.0);
    while part < 1.0 {
        let mixed = Mixed { fault: fault.planted(), truth: fault.sound(), part };
        let name = format!("{} ({part} of it)", fault.name());
        let found = least(&verify_with(&name, &mixed, &mixed.claims(), &looked_at(), effort), part);
        if found.is_some() {
            least_part = found;
            break;
        }
        part *= 3.0;
    }
    Row {
        fault,
        caught_by: properties(&planted),
        p: verdicts().filter_map(|verdict| verdict.adjusted).fold(1.0, f64::min),
        least_part,
        false_alarms: properties(&sound),
    }
}

/// `χ²` of a part `ε` of a fault is on average its degrees of freedom and `n ε² X²`: from what it is of one part, the
/// part at which it is found.
fn least_part(view: &super::View, significance: f64, part: f64) -> Option<f64> {
    let fit = view.fit?;
    let excess = fit.statistic - fit.degrees;
    // Three standard deviations of χ²: what is less may be chance.
    if excess.is_nan() || excess < 3.0 * (2.0 * fit.degrees).sqrt() {
        return None;
    }
    let needed = noncentrality_found(fit.degrees, significance, 0.9);
    Some(part * (needed / excess).sqrt()).filter(|part| *part <= 1.0)
}
