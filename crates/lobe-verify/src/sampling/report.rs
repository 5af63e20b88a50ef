//! What was found.

use crate::subject::Precision;
use serde::Serialize;
use std::fmt;

/// What a sampler is checked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Property {
    /// Directions, weights and densities are finite, for `u` at its ends too; directions are unit vectors above the
    /// horizon.
    Finite,
    /// A viewer below the horizon gets a rejected sample, and the density there is 0.
    BelowHorizon,
    /// NaN in gives a NaN weight.
    Nan,
    /// The density that comes with a sample is `pdf(l, v)`.
    Density,
    /// The weight is `f_r (n·l)/pdf`.
    Weight,
    /// The density integrates to 1 less what is rejected or goes into deltas.
    Normalised,
    /// As many samples are rejected as the density leaves: a test of the binomial distribution.
    Rejection,
    /// The samples are distributed as the density: χ² over bins of equal mass.
    Fit,
    /// So is their polar angle: Kolmogorov and Smirnov.
    Polar,
    /// So is their azimuth: Kolmogorov and Smirnov.
    Azimuth,
    /// The mean weight is the directional albedo, within its standard error.
    MeanWeight,
    /// The mean weight over a low-discrepancy sequence is the directional albedo to 1e-3, per channel.
    Albedo,
}

impl Property {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Finite,
        Self::BelowHorizon,
        Self::Nan,
        Self::Density,
        Self::Weight,
        Self::Normalised,
        Self::Rejection,
        Self::Fit,
        Self::Polar,
        Self::Azimuth,
        Self::MeanWeight,
        Self::Albedo,
    ];

    /// Its name, in a few words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Finite => "finite",
            Self::BelowHorizon => "below horizon",
            Self::Nan => "NaN stays NaN",
            Self::Density => "pdf of sample",
            Self::Weight => "weight",
            Self::Normalised => "∫ pdf",
            Self::Rejection => "rejected",
            Self::Fit => "χ² fit",
            Self::Polar => "KS of cos θ",
            Self::Azimuth => "KS of φ",
            Self::MeanWeight => "mean weight",
            Self::Albedo => "albedo",
        }
    }

    /// What the size of a defect is counted in.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Finite | Self::BelowHorizon | Self::Nan => "numbers",
            Self::Density | Self::Weight => "relative",
            Self::Normalised | Self::Rejection => "of all samples",
            Self::Fit => "χ² beyond its mean",
            Self::Polar | Self::Azimuth => "of the distribution",
            Self::MeanWeight | Self::Albedo => "albedo",
        }
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A number and what it is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Observed {
    /// `pdf(l, v)`, samples in the bin, …
    pub what: String,
    /// The number.
    pub value: f64,
}

/// An input and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Case {
    /// The viewer.
    pub v: [f64; 3],
    /// The three numbers, if one sample shows it.
    pub u: Option<[f64; 3]>,
    /// The light: of the sample, or the middle of the bin.
    pub l: Option<[f64; 3]>,
    /// How large the defect is.
    pub size: f64,
    /// The numbers that show it.
    pub observed: Vec<Observed>,
    /// The number type that the input is printed in.
    #[serde(skip)]
    pub precision: Precision,
}

impl Case {
    pub(crate) fn new(v: [f64; 3], precision: Precision, size: f64) -> Self {
        Self { v, u: None, l: None, size, observed: Vec::new(), precision }
    }

    pub(crate) fn of(mut self, u: [f64; 3], l: Option<[f64; 3]>) -> Self {
        self.u = Some(u);
        self.l = l;
        self
    }

    pub(crate) fn with(mut self, what: &str, value: f64) -> Self {
        self.observed.push(Observed { what: what.to_owned(), value });
        self
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers = |d: [f64; 3]| d.map(|x| self.precision.print(x)).join(",");
        write!(f, "v = {}", numbers(self.v))?;
        if let Some(u) = self.u {
            write!(f, ", u = {}", numbers(u))?;
        }
        if let Some(l) = self.l {
            write!(f, ", l = {}", numbers(l))?;
        }
        for (index, seen) in self.observed.iter().enumerate() {
            let sign = if index == 0 { ":" } else { "," };
            write!(f, "{sign} {} = {}", seen.what, plain(seen.value))?;
        }
        Ok(())
    }
}

/// Six digits, with an exponent where they would be hidden by zeros.
fn plain(x: f64) -> String {
    match x {
        x if x == 0.0 || !x.is_finite() => format!("{x}"),
        x if (1e-3..1e7).contains(&x.abs()) => format!("{x:.6}").trim_end_matches('0').trim_end_matches('.').to_owned(),
        x => format!("{x:.5e}"),
    }
}

/// How a check ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// As claimed.
    Holds,
    /// Not as claimed.
    Fails,
    /// Not looked at, because …
    NotChecked(String),
    /// The sampler panicked, and said …
    Broken(String),
}

/// What was found of one property at one view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Which property.
    pub property: Property,
    /// How it ended.
    pub outcome: Outcome,
    /// How many samples it is of.
    pub tried: usize,
    /// The largest defect.
    pub size: f64,
    /// Of a statistical test: how likely a true sampler does as badly.
    pub p: Option<f64>,
    /// The same, corrected for all tests of the suite (Holm): it fails if that is not above the significance.
    pub adjusted: Option<f64>,
    /// Where the largest defect is.
    pub worst: Option<Case>,
    /// The simplest input that shows a tenth of it, if it fails.
    pub simplest: Option<Case>,
    /// What else is to be told.
    pub remark: String,
}

impl Verdict {
    pub(crate) fn new(property: Property, outcome: Outcome) -> Self {
        Self {
            property,
            outcome,
            tried: 0,
            size: 0.0,
            p: None,
            adjusted: None,
            worst: None,
            simplest: None,
            remark: String::new(),
        }
    }

    pub(crate) fn not_checked(property: Property, reason: &str) -> Self {
        Self::new(property, Outcome::NotChecked(reason.to_owned()))
    }

    /// Whether nothing speaks against it: it holds, or could not be checked.
    #[must_use]
    pub fn holds(&self) -> bool {
        !matches!(self.outcome, Outcome::Fails | Outcome::Broken(_))
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let outcome = match &self.outcome {
            Outcome::Holds => "holds",
            Outcome::Fails => "FAILS",
            Outcome::NotChecked(_) => "not checked",
            Outcome::Broken(_) => "BROKEN",
        };
        write!(f, "{:<14} {outcome:<12}", self.property)?;
        match &self.outcome {
            Outcome::NotChecked(reason) | Outcome::Broken(reason) => return write!(f, "{reason}"),
            _ => write!(f, "{:>9} tried  worst {} {}", self.tried, plain(self.size), self.property.unit())?,
        }
        if let (Some(p), Some(adjusted)) = (self.p, self.adjusted) {
            write!(f, "; p = {p:.2e}, {adjusted:.2e} in the suite")?;
        }
        if !self.remark.is_empty() {
            write!(f, "; {}", self.remark)?;
        }
        if self.outcome == Outcome::Holds {
            return Ok(());
        }
        if let Some(case) = &self.worst {
            write!(f, "\n    at {case}")?;
        }
        match &self.simplest {
            Some(case) if self.worst.as_ref() != Some(case) => write!(f, "\n    simplest: {case}"),
            _ => Ok(()),
        }
    }
}

/// What was found at one view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct View {
    /// The viewer.
    pub v: [f64; 3],
    /// One for each property.
    pub verdicts: Vec<Verdict>,
    /// `∫ pdf dω` and its estimated error.
    pub integral: f64,
    /// See [`integral`](Self::integral).
    pub integral_error: f64,
    /// The part of the samples that was rejected.
    pub rejected: f64,
    /// The part that went into deltas.
    pub delta: f64,
    /// The directional albedo of the part that has a density, if the sampler has values: mean of the channels.
    pub albedo: Option<f64>,
    /// The variance of the weight, mean of the channels: of one sample, rejected ones and deltas included.
    pub variance: f64,
    /// How many samples give the albedo to 1 %, one standard error; `None` if nothing is reflected.
    pub samples_for_one_percent: Option<f64>,
    /// What the test of fit was made of.
    pub fit: Option<Fit>,
}

/// A χ² statistic.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// `Σ (observed − expected)²/expected`.
    pub statistic: f64,
    /// Cells less one.
    pub degrees: f64,
    /// The most that the error of the quadrature can add: the noncentrality that `p` allows for.
    pub from_quadrature: f64,
    /// How many samples.
    pub samples: f64,
}

impl View {
    /// Whether every verdict does.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.verdicts.iter().all(Verdict::holds)
    }

    /// What was found of one property.
    #[must_use]
    pub fn verdict(&self, property: Property) -> Option<&Verdict> {
        self.verdicts.iter().find(|verdict| verdict.property == property)
    }

    /// The verdict with the smallest `p`, corrected for the suite if it has been.
    pub fn least(&self) -> Option<&Verdict> {
        let of = |verdict: &&Verdict| verdict.p.unwrap_or(1.0);
        self.verdicts.iter().filter(|verdict| verdict.p.is_some()).min_by(|a, b| of(a).total_cmp(&of(b)))
    }
}

/// What was found of one sampler.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Its name, from which the seeds are made.
    pub name: String,
    /// One for each view.
    pub views: Vec<View>,
}

impl Report {
    /// Whether every verdict does.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.views.iter().all(View::holds)
    }

    /// Those that do not.
    pub fn failures(&self) -> impl Iterator<Item = &Verdict> {
        self.views.iter().flat_map(|view| &view.verdicts).filter(|verdict| !verdict.holds())
    }

    /// What was found of one property, one for each view.
    pub fn verdicts(&self, property: Property) -> impl Iterator<Item = &Verdict> {
        self.views.iter().filter_map(move |view| view.verdict(property))
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for view in &self.views {
            writeln!(f, "{}, view at cos θ = {}", self.name, plain(view.cos()))?;
            for verdict in &view.verdicts {
                writeln!(f, "  {verdict}")?;
            }
        }
        Ok(())
    }
}

impl View {
    /// The cosine of the view.
    #[must_use]
    pub fn cos(&self) -> f64 {
        let [_, _, z] = self.v;
        z
    }
}

/// What was found of all samplers of a suite.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Suite {
    /// The chance of any false alarm in the whole suite, at most.
    pub significance: f64,
    /// How many tests share it.
    pub tests: usize,
    /// One for each sampler.
    pub reports: Vec<Report>,
}

impl Suite {
    /// Corrects the tests of all reports for each other, and judges them.
    pub(crate) fn judged(significance: f64, mut reports: Vec<Report>) -> Self {
        fn verdicts(reports: &mut [Report]) -> impl Iterator<Item = &mut Verdict> {
            reports.iter_mut().flat_map(|report| &mut report.views).flat_map(|view| &mut view.verdicts)
        }
        let ps: Vec<f64> = verdicts(&mut reports).filter_map(|verdict| verdict.p).collect();
        let adjusted = super::statistics::holm(&ps);
        let tested = verdicts(&mut reports).filter(|verdict| verdict.p.is_some());
        for (verdict, adjusted) in tested.zip(adjusted) {
            verdict.adjusted = Some(adjusted);
            if adjusted <= significance {
                verdict.outcome = Outcome::Fails;
                verdict.simplest.clone_from(&verdict.worst);
            }
        }
        Self { significance, tests: ps.len(), reports }
    }

    /// Whether every report does.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.reports.iter().all(Report::holds)
    }
}

impl fmt::Display for Suite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "| sampler | cos θ | ∫ pdf | rejected | delta | least p | samples for 1 % | |\n|---|---|---|---|---|---|---|---|"
        )?;
        for report in &self.reports {
            for view in &report.views {
                writeln!(f, "| {} | {view} |", report.name)?;
            }
        }
        let failing = self.reports.iter().filter(|report| !report.holds()).count();
        writeln!(
            f,
            "\n{} samplers, {} statistical tests at a significance of {} for all: {failing} fail",
            self.reports.len(),
            self.tests,
            self.significance
        )?;
        for report in &self.reports {
            for view in report.views.iter().filter(|view| !view.holds()) {
                writeln!(f, "\n{}, view at cos θ = {}", report.name, plain(view.cos()))?;
                for verdict in view.verdicts.iter().filter(|verdict| !verdict.holds()) {
                    writeln!(f, "  {verdict}")?;
                }
            }
        }
        Ok(())
    }
}

/// The columns of a table, without its ends.
impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let least = self.least().and_then(|verdict| verdict.p);
        let least = least.map_or_else(String::new, |p| format!("{p:.1e}"));
        let samples = self.samples_for_one_percent.map_or_else(String::new, |n| format!("{n:.0}"));
        let failures: Vec<_> = self.verdicts.iter().filter(|v| !v.holds()).map(|v| v.property.name()).collect();
        let verdict = if failures.is_empty() { "holds".to_owned() } else { format!("FAILS: {}", failures.join(", ")) };
        write!(
            f,
            "{} | {:.6} ± {:.0e} | {:.5} | {:.5} | {least} | {samples} | {verdict}",
            plain(self.cos()),
            self.integral,
            self.integral_error,
            self.rejected,
            self.delta
        )
    }
}
