//! The power of the suite: models as an engine would port them, each with a fault that is often made, which it must
//! find.
//!
//! Which check finds a fault depends on what the fault spoils. A lobe that is too wide, or has its widths exchanged, is
//! still a lobe that is finite, reciprocal and loses energy: only a reference tells. The table says so.
//!
//! ```
//! use lobe_verify::properties::mutants::{Fault, Port};
//! use lobe_verify::properties::{Effort, agrees_with, verify};
//!
//! let swapped = Port::new(Fault::WidthsSwapped);
//! assert!(verify(&swapped).holds());
//! assert!(!agrees_with(&swapped, &Port::sound(Fault::WidthsSwapped), 1e-9, Effort::QUICK).holds());
//! ```

mod models;

use super::{Claims, Effort, Property, Report, Verdict, agrees_with, verify_family, verify_with};
use crate::subject::InDouble;
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Lambert, Microfacet, OrenNayarQualitative, Phong, Rgb, Shininess, Vec3};
use std::fmt;

/// A fault of a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Lambert: `ρ` for `ρ/π`.
    PiMissing,
    /// Lambert: `eval_cos` without the cosine.
    CosineMissing,
    /// Lambert: `f` with the cosine already in it, so that the renderer takes it twice.
    CosineTwice,
    /// Lambert: no test for the horizon.
    HorizonMissing,
    /// Lambert: the test for the horizon turns NaN into black.
    NanDropped,
    /// Lambert under a Fresnel reflection: the albedo taken for `f0` too, `ρ (1 − ρ)`.
    AlbedoAsF0,
    /// Phong: `q + 8` for `q + 2`.
    PlusEight,
    /// Phong: the clamp of `r·v` removed, with an odd exponent.
    ClampRemoved,
    /// Oren-Nayar: `cos Δφ` without its `max(0, …)`.
    AzimuthUnclamped,
    /// Oren-Nayar with a linear azimuth: `Δφ` not brought back to [0, π].
    AzimuthUnwrapped,
    /// GGX: `α` for `α²` in `D`.
    AlphaForItsSquare,
    /// GGX with two widths: `αx` and `αy` exchanged.
    WidthsSwapped,
    /// GGX: light and viewer masked apart.
    Uncorrelated,
    /// GGX: the masking of the viewer alone.
    ViewerMaskingOnly,
    /// GGX: Schlick's form of `n·v` instead of `h·v`.
    FresnelOfView,
    /// GGX: `D` without `α²`, so that it is not normalised.
    Unnormalised,
    /// GGX: `4 (n·l)(n·v)` with `n·v` missing.
    ViewCosineMissing,
}

impl Fault {
    /// All of them.
    pub const ALL: [Self; 17] = [
        Self::PiMissing,
        Self::CosineMissing,
        Self::CosineTwice,
        Self::HorizonMissing,
        Self::NanDropped,
        Self::AlbedoAsF0,
        Self::PlusEight,
        Self::ClampRemoved,
        Self::AzimuthUnclamped,
        Self::AzimuthUnwrapped,
        Self::AlphaForItsSquare,
        Self::WidthsSwapped,
        Self::Uncorrelated,
        Self::ViewerMaskingOnly,
        Self::FresnelOfView,
        Self::Unnormalised,
        Self::ViewCosineMissing,
    ];

    /// In a few words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PiMissing => "Lambert: ρ for ρ/π",
            Self::CosineMissing => "Lambert: eval_cos without the cosine",
            Self::CosineTwice => "Lambert: the cosine in f",
            Self::HorizonMissing => "Lambert: no test for the horizon",
            Self::NanDropped => "Lambert: NaN becomes black",
            Self::AlbedoAsF0 => "Lambert under f0: ρ taken for f0",
            Self::PlusEight => "Phong: q + 8 for q + 2",
            Self::ClampRemoved => "Phong: r·v not clamped",
            Self::AzimuthUnclamped => "Oren-Nayar: cos Δφ not clamped",
            Self::AzimuthUnwrapped => "Oren-Nayar, linear in Δφ: not wrapped",
            Self::AlphaForItsSquare => "GGX: α for α² in D",
            Self::WidthsSwapped => "GGX: αx and αy exchanged",
            Self::Uncorrelated => "GGX: masking not correlated",
            Self::ViewerMaskingOnly => "GGX: masking of the viewer only",
            Self::FresnelOfView => "GGX: F(n·v) for F(h·v)",
            Self::Unnormalised => "GGX: D not normalised",
            Self::ViewCosineMissing => "GGX: n·v missing in the denominator",
        }
    }

    /// The lobe of [`lobe`] that the sound port is of, if there is one, in a box.
    fn reference(self) -> Option<Box<dyn Brdf<f64> + Sync>> {
        let white = Rgb::splat(1.0);
        let metal = Schlick::new(Rgb::splat(models::F0));
        Some(match self {
            Self::PiMissing | Self::CosineMissing | Self::CosineTwice | Self::HorizonMissing | Self::NanDropped => {
                Box::new(Lambert::new(Rgb::splat(models::ALBEDO)))
            }
            Self::PlusEight | Self::ClampRemoved => Box::new(Phong::new(white, Shininess(models::EXPONENT))),
            Self::AzimuthUnclamped => Box::new(OrenNayarQualitative::new(Rgb::splat(models::ALBEDO), models::SIGMA)),
            Self::WidthsSwapped => {
                let [x, y] = models::WIDTHS.map(Alpha);
                Box::new(Microfacet::new(Ggx::anisotropic(x, y), SmithCorrelated, metal))
            }
            Self::AlphaForItsSquare
            | Self::Uncorrelated
            | Self::ViewerMaskingOnly
            | Self::FresnelOfView
            | Self::Unnormalised
            | Self::ViewCosineMissing => {
                Box::new(Microfacet::new(Ggx::new(Alpha(models::WIDTH)), SmithCorrelated, metal))
            }
            Self::AlbedoAsF0 | Self::AzimuthUnwrapped => return None,
        })
    }

    /// What the port claims.
    fn claims(self) -> Claims {
        if self == Self::WidthsSwapped { ROUNDED } else { ROUNDED.isotropic() }
    }
}

/// A port rounds its products in another order when the directions are exchanged.
const ROUNDED: Claims = Claims { reciprocal: Some(64.0), ..Claims::LOBE };

/// The two agree to this where they are the same formula: `f64` has 2e-16, and a port's `1 − (n·h)²` cancels.
const AGREEMENT: f64 = 1e-9;

/// A port of a model in `f64`, sound or with a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Port {
    fault: Fault,
    planted: bool,
    albedo: f64,
}

impl Port {
    /// The port with this fault.
    #[must_use]
    pub fn new(fault: Fault) -> Self {
        Self { fault, planted: true, albedo: models::ALBEDO }
    }

    /// The same port without the fault.
    #[must_use]
    pub fn sound(fault: Fault) -> Self {
        Self { planted: false, ..Self::new(fault) }
    }

    /// The same with another albedo, if it has one.
    #[must_use]
    pub fn with_albedo(self, albedo: f64) -> Self {
        Self { albedo, ..self }
    }

    /// Whether this fault is planted.
    fn has(&self, fault: Fault) -> bool {
        self.planted && self.fault == fault
    }
}

impl Brdf<f64> for Port {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        Rgb::splat(self.value(l, v))
    }

    fn eval_cos(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        let f = self.eval(l, v);
        if self.has(Fault::CosineMissing) || l.z <= 0.0 { f } else { f * l.z }
    }
}

/// What the suite says of a port.
#[derive(Clone, Debug)]
pub struct Row {
    /// The fault.
    pub fault: Fault,
    /// The verdicts of the port with the fault that do not hold.
    pub caught_by: Vec<Verdict>,
    /// Those of the sound port that do not: none.
    pub false_alarms: Vec<Verdict>,
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let by: Vec<_> = self.caught_by.iter().map(|verdict| verdict.property.name()).collect();
        let by = if by.is_empty() { "NOT CAUGHT".to_owned() } else { by.join(", ") };
        write!(f, "| {} | {by} |", self.fault.name())?;
        // The check that tells most of the fault is the first in the order of the suite.
        match self.caught_by.first().and_then(|verdict| verdict.simplest.as_ref()) {
            Some(case) => write!(f, " `{case}` |"),
            None => write!(f, " |"),
        }
    }
}

/// The whole suite over all faults: which check finds each, and whether one is raised without a fault.
#[must_use]
pub fn survey(effort: Effort) -> Vec<Row> {
    let row = |fault| {
        let failures = |port| failures(port, effort);
        Row { fault, caught_by: failures(Port::new(fault)), false_alarms: failures(Port::sound(fault)) }
    };
    Fault::ALL.map(row).to_vec()
}

fn failures(port: Port, effort: Effort) -> Vec<Verdict> {
    let Report { mut verdicts } = verify_with(&port, &port.fault.claims(), effort);
    verdicts.push(verify_family(|albedo| port.with_albedo(albedo), effort));
    if let Some(reference) = port.fault.reference() {
        verdicts.push(agrees_with(&port, &InDouble(&&*reference), AGREEMENT, effort));
    }
    verdicts.retain(|verdict| !verdict.holds());
    verdicts
}

/// The properties that find this fault.
#[must_use]
pub fn caught_by(row: &Row) -> Vec<Property> {
    row.caught_by.iter().map(|verdict| verdict.property).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What finds a fault where it should be found: without a reference where physics can tell.
    #[test]
    fn every_fault_is_caught_and_no_sound_port_is() {
        let expected = [
            (Fault::PiMissing, Property::Energy),
            (Fault::CosineMissing, Property::Cosine),
            (Fault::CosineTwice, Property::Reciprocal),
            (Fault::HorizonMissing, Property::BelowHorizon),
            (Fault::NanDropped, Property::Nan),
            (Fault::AlbedoAsF0, Property::Monotone),
            (Fault::PlusEight, Property::Energy),
            (Fault::ClampRemoved, Property::NonNegative),
            (Fault::AzimuthUnclamped, Property::NonNegative),
            (Fault::AzimuthUnwrapped, Property::Continuous),
            (Fault::AlphaForItsSquare, Property::Agreement),
            (Fault::WidthsSwapped, Property::Agreement),
            (Fault::Uncorrelated, Property::Agreement),
            (Fault::ViewerMaskingOnly, Property::Reciprocal),
            (Fault::FresnelOfView, Property::Reciprocal),
            (Fault::Unnormalised, Property::Energy),
            (Fault::ViewCosineMissing, Property::Reciprocal),
        ];
        for (row, (fault, property)) in survey(Effort::QUICK).iter().zip(expected) {
            println!("{row}");
            assert_eq!(row.fault, fault);
            assert!(caught_by(row).contains(&property), "{}: {:?}", fault.name(), caught_by(row));
            assert!(row.false_alarms.is_empty(), "{}:\n{}", fault.name(), row.false_alarms[0]);
        }
    }
}
