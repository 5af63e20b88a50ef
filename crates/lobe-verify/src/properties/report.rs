//! What was found.

use crate::subject::{Pair, Precision, SubjectError, Value};
use std::fmt;

/// What a BRDF can be checked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Property {
    /// Neither NaN nor infinite.
    Finite,
    /// Not below 0.
    NonNegative,
    /// 0 where a direction is on the horizon or below it.
    BelowHorizon,
    /// `f(l, v) = f(v, l)`.
    Reciprocal,
    /// The same after a turn around the normal.
    Isotropic,
    /// The form with the cosine is `f_r` times the cosine.
    Cosine,
    /// No jump above the horizon: to grazing, across the pole, around the azimuth.
    Continuous,
    /// No more is reflected than arrives.
    Energy,
    /// NaN in gives NaN out.
    Nan,
    /// A larger albedo gives no smaller value.
    Monotone,
    /// The same as another subject.
    Agreement,
}

impl Property {
    /// Those that [`verify`](super::verify) looks at, in its order. The last two need something to compare with.
    pub const OF_ONE: [Self; 9] = [
        Self::Finite,
        Self::NonNegative,
        Self::BelowHorizon,
        Self::Reciprocal,
        Self::Isotropic,
        Self::Cosine,
        Self::Continuous,
        Self::Energy,
        Self::Nan,
    ];

    /// Its name, in one or two words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Finite => "finite",
            Self::NonNegative => "not negative",
            Self::BelowHorizon => "0 below horizon",
            Self::Reciprocal => "reciprocal",
            Self::Isotropic => "isotropic",
            Self::Cosine => "cosine",
            Self::Continuous => "continuous",
            Self::Energy => "energy",
            Self::Nan => "NaN stays NaN",
            Self::Monotone => "monotone",
            Self::Agreement => "agreement",
        }
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// What the size of a defect is counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Units in the last place of the subject's number type.
    Ulps,
    /// As a part of the larger value.
    Relative,
    /// sr⁻¹.
    Absolute,
    /// An albedo.
    Albedo,
    /// Channels.
    Channels,
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ulps => "ulp",
            Self::Relative => "relative",
            Self::Absolute => "/sr",
            Self::Albedo => "albedo",
            Self::Channels => "channels",
        })
    }
}

/// A value, what it is of, and the pair that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Observed {
    /// `f(l, v)`, `f(v, l)`, the reference, …
    pub what: String,
    /// The directions that were asked for.
    pub pair: Pair,
    /// The channels.
    pub value: Value,
}

/// An input and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The directions.
    pub pair: Pair,
    /// The number type that they are printed in.
    pub precision: Precision,
    /// How large the defect is.
    pub size: f64,
    /// The values that show it.
    pub observed: Vec<Observed>,
    /// The line of the table, or of what was written to a program in one batch.
    pub line: Option<usize>,
}

impl Case {
    /// The input as a line of `lobe eval`, with every digit; a direction that is integrated over is `*,*,*`.
    #[must_use]
    pub fn input(&self) -> String {
        self.precision.line(&self.pair).replace("NaN,NaN,NaN", "*,*,*")
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.input())?;
        if let Some(line) = self.line {
            write!(f, " (line {line})")?;
        }
        for (index, seen) in self.observed.iter().enumerate() {
            let sign = if index == 0 { ":" } else { "," };
            let [r, g, b] = seen.value.map(|x| self.precision.print(x));
            write!(f, "{sign} {} = ", seen.what)?;
            if r == g && g == b {
                write!(f, "{r}")?
            } else {
                write!(f, "{r},{g},{b}")?
            }
            // By their bits: one may hold a NaN.
            let is = |pair: &Pair| pair.map(f64::to_bits) == seen.pair.map(f64::to_bits);
            if !is(&self.pair) && !is(&super::place::exchanged(&self.pair)) {
                write!(f, " at {}", self.precision.line(&seen.pair))?;
            }
        }
        Ok(())
    }
}

/// How a check ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// As claimed, wherever it was tried.
    Holds,
    /// Not as claimed.
    Fails,
    /// Not claimed; its size is told.
    Measured,
    /// Not looked at, because …
    NotChecked(String),
    /// The subject gave no value.
    Broken(SubjectError),
}

/// What was found of one property.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Which property.
    pub property: Property,
    /// How it ended.
    pub outcome: Outcome,
    /// How many inputs were tried.
    pub tried: usize,
    /// The largest defect, 0 if there is none; for a claim that holds it is the largest that is within the claim.
    pub size: f64,
    /// What it is counted in.
    pub unit: Unit,
    /// Where the largest defect is.
    pub worst: Option<Case>,
    /// The simplest input that was found to fail, if any does.
    pub simplest: Option<Case>,
    /// What else is to be told: what is lost, how sure a number is.
    pub remark: String,
}

impl Verdict {
    pub(crate) fn new(property: Property, unit: Unit, outcome: Outcome) -> Self {
        Self { property, outcome, tried: 0, size: 0.0, unit, worst: None, simplest: None, remark: String::new() }
    }

    /// Whether nothing speaks against it: it holds, is not claimed, or could not be checked.
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
            Outcome::Measured => "measured",
            Outcome::NotChecked(_) => "not checked",
            Outcome::Broken(_) => "BROKEN",
        };
        write!(f, "{:<16} {outcome:<12}", self.property)?;
        match &self.outcome {
            Outcome::NotChecked(reason) => return write!(f, "{reason}"),
            Outcome::Broken(error) => write!(f, "{error}")?,
            _ => {
                write!(f, "{:>9} tried  worst {}", self.tried, size(self.size, self.unit))?;
                if !self.remark.is_empty() {
                    write!(f, "; {}", self.remark)?;
                }
            }
        }
        // Of a claim that holds nothing has to be looked for; of a defect of 0 there is nothing to see.
        if matches!(self.outcome, Outcome::Holds) || self.size == 0.0 && self.simplest.is_none() {
            return Ok(());
        }
        if let Some(case) = &self.worst {
            write!(f, "\n    at {case}")?;
        }
        match &self.simplest {
            Some(case) if self.worst.as_ref().is_none_or(|worst| worst.pair != case.pair) => {
                write!(f, "\n    simplest: {case}")
            }
            _ => Ok(()),
        }
    }
}

fn size(size: f64, unit: Unit) -> String {
    let number = match size {
        0.0 => "0".to_owned(),
        x if (1e-3..1e5).contains(&x) => format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').to_owned(),
        x => format!("{x:.2e}"),
    };
    format!("{number} {unit}")
}

/// What was found of all properties.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// One for each property.
    pub verdicts: Vec<Verdict>,
}

impl Report {
    /// Whether every verdict does.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.verdicts.iter().all(Verdict::holds)
    }

    /// Those that do not.
    pub fn failures(&self) -> impl Iterator<Item = &Verdict> {
        self.verdicts.iter().filter(|verdict| !verdict.holds())
    }

    /// What was found of one property.
    #[must_use]
    pub fn verdict(&self, property: Property) -> Option<&Verdict> {
        self.verdicts.iter().find(|verdict| verdict.property == property)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for verdict in &self.verdicts {
            writeln!(f, "{verdict}")?;
        }
        Ok(())
    }
}
