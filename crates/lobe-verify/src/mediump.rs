//! Which models survive a shader's `mediump`, on which part of their domain: every operation in binary16, against `f64`
//! of the same binary16 inputs.

use crate::extremes::{Random, across, random_value, tilted, unit};
use lobe::{Half, Real as _, Rgb, Vec3};
use lobe_models::{Kind, Lobe, Model, Parameter, Value};
use std::f64::consts::{PI, TAU};

/// The largest number of binary16.
pub const MOST: f64 = 65504.0;

/// How many values are tried for each row of a model.
pub const VALUES: usize = 3000;

/// A part of the domain: widths of the lobe from one to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The smallest `α`.
    pub from: f64,
    /// The largest.
    pub to: f64,
}

impl Band {
    /// A width, even over the decade.
    fn draw(self, random: &mut Random) -> f64 {
        self.from * (self.to / self.from).powf(random.unit())
    }
}

/// The decades of `α`, from wide to narrow.
pub const BANDS: [Band; 4] = [
    Band { from: 0.1, to: 1.0 },
    Band { from: 0.01, to: 0.1 },
    Band { from: 1e-3, to: 0.01 },
    Band { from: 1e-4, to: 1e-3 },
];

/// What became of the values of one part of the domain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// All values.
    pub values: usize,
    /// Those whose exact value is a normal number of binary16 or 0; the others cannot be right there.
    pub in_range: usize,
    /// Of these, how many are finite in binary16;
    pub finite: usize,
    /// how many are within 1 % of the exact value;
    pub within_1: usize,
    /// and within 10 %.
    pub within_10: usize,
    /// Not finite: NaN.
    pub nan: usize,
    /// Not finite: infinite.
    pub infinite: usize,
    /// 0, where the exact value is not.
    pub lost: usize,
}

impl Tally {
    fn add(&mut self, value: Half, exact: f64) {
        self.values += 1;
        let normal = (Half::MIN_POSITIVE..=MOST).contains(&exact);
        if !normal && exact != 0.0 {
            return;
        }
        self.in_range += 1;
        let value = f64::from(value);
        self.nan += usize::from(value.is_nan());
        self.infinite += usize::from(value.is_infinite());
        self.finite += usize::from(value.is_finite());
        self.lost += usize::from(value == 0.0 && exact != 0.0);
        let error = if exact == 0.0 { value.abs() } else { (value - exact).abs() / exact };
        self.within_1 += usize::from(error <= 0.01);
        self.within_10 += usize::from(error <= 0.1);
    }

    /// A count as a part of those in range.
    #[must_use]
    pub fn part(&self, count: usize) -> f64 {
        if self.in_range == 0 { f64::NAN } else { count as f64 / self.in_range as f64 }
    }
}

/// One part of a model's domain.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The model.
    pub model: &'static Model,
    /// Which part; `None` for a model without a width.
    pub band: Option<Band>,
    /// What became of the values.
    pub tally: Tally,
}

/// How a parameter says the width of a lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Width {
    /// `α` itself.
    Alpha,
    /// An exponent: `α = √(2/(q + 2))`.
    Exponent,
    /// A perceptual roughness: `α = r²`.
    Roughness,
    /// Löw's B: `α = 1/√B`.
    InverseSquare,
}

impl Width {
    /// What the parameter of that name says in that model.
    fn of(model: &Model, parameter: &Parameter) -> Option<Self> {
        match (model.name, parameter.name) {
            (_, "alpha" | "width") | ("torrance-sparrow" | "blinn-1977", "c") | ("cook-torrance", "m") => {
                Some(Self::Alpha)
            }
            (_, "q" | "nu" | "nv") => Some(Self::Exponent),
            (name, "roughness" | "clearcoat-roughness" | "sheen-roughness") if name.starts_with("gltf") => {
                Some(Self::Roughness)
            }
            (name, "b") if name.starts_with("low-") => Some(Self::InverseSquare),
            _ => None,
        }
    }

    fn alpha(self, x: f64) -> f64 {
        match self {
            Self::Alpha => x,
            Self::Exponent => (2.0 / (x + 2.0)).sqrt(),
            Self::Roughness => x * x,
            Self::InverseSquare => x.sqrt().recip(),
        }
    }

    fn parameter(self, alpha: f64) -> f64 {
        match self {
            Self::Alpha => alpha,
            Self::Exponent => 2.0 / (alpha * alpha) - 2.0,
            Self::Roughness => alpha.sqrt(),
            Self::InverseSquare => (alpha * alpha).recip(),
        }
    }
}

/// The width of the narrowest lobe that the parameters make, as an `α`. `None` if they say none.
#[must_use]
pub fn narrowest(lobe: &Lobe) -> Option<f64> {
    let width = |(parameter, value)| match (Width::of(lobe.model(), parameter)?, value) {
        (_, Value::Widths([x, y])) => Some(x.min(y)),
        (width, Value::Number(x)) => Some(width.alpha(x)),
        _ => None,
    };
    lobe.values().filter_map(width).reduce(f64::min)
}

/// To binary16 and back, without leaving the domain.
fn rounded(value: Value, kind: Kind) -> Value {
    let near = |x: f64, min: f64, max: f64| {
        let half = f64::from(Half::from(x));
        // One step of binary16 inwards.
        let half = if half > max { f64::from(Half::from(x * (1.0 - 1.0 / 1024.0))) } else { half };
        if half < min { f64::from(Half::from(x * (1.0 + 1.0 / 1024.0))) } else { half }
    };
    match (value, kind) {
        (Value::Colour(c), Kind::Colour { max }) => Value::Colour(c.map(|x| near(x, 0.0, max))),
        (Value::Number(x), Kind::Number { min, max }) => Value::Number(near(x, min, max)),
        (Value::Widths(w), _) => Value::Widths(w.map(|x| near(x, 1e-4, 1.0))),
        (Value::Table(t), _) => Value::Table(t.map(|x| near(x, 0.0, 1e6))),
        (value, _) => value,
    }
}

/// A lobe of random parameters, all of them numbers of binary16 that a scene may hold: colours are not darker than 0.02,
/// and widths even over their decade.
fn lobe(model: &'static Model, band: Option<Band>, random: &mut Random) -> Option<Lobe> {
    let mut value = |parameter: &Parameter| match (parameter.kind, band) {
        (Kind::Colour { max }, _) => Value::Colour([(); 3].map(|()| random.between(0.02, 1.0) * max.min(1.0))),
        (Kind::Widths, Some(band)) => Value::Widths([(); 2].map(|()| band.draw(random))),
        (Kind::Number { min, max }, Some(band)) => match Width::of(model, parameter) {
            Some(width) => Value::Number(width.parameter(band.draw(random)).clamp(min, max)),
            None => random_value(parameter.kind, random),
        },
        (kind, _) => random_value(kind, random),
    };
    let values: Vec<_> = model.parameters.iter().map(|p| (p.name, rounded(value(p), p.kind))).collect();
    let lobe = Lobe::new(model, &values).ok()?;
    // The ends of a domain may be inside the decade.
    let inside = |band: Band| narrowest(&lobe).is_some_and(|width| (band.from..=band.to * 1.001).contains(&width));
    band.is_none_or(inside).then_some(lobe)
}

/// A pair of binary16 vectors: at incidences up to 84°, half of them with a half vector from a hundredth of the width to
/// ten times it, where a picture shows the lobe.
fn pair(width: f64, random: &mut Random) -> (Vec3<Half>, Vec3<Half>) {
    let v = unit(random.between(0.1, 1.0), random.between(0.0, TAU));
    let l = if random.below(2) == 0 {
        unit(random.between(0.1, 1.0), random.between(0.0, TAU))
    } else {
        let tilt = (width * random.step(-2.0, 1.0).abs()).atan();
        across(v, tilted(tilt, random.between(-PI, PI)))
    };
    (l.map(Half::from), v.map(Half::from))
}

/// The rows of a model. The same numbers every time.
#[must_use]
pub fn survey(model: &'static Model) -> Vec<Row> {
    let mut random = Random::new(11);
    let has_width = model.parameters.iter().any(|parameter| Width::of(model, parameter).is_some());
    let bands: Vec<_> = if has_width { BANDS.into_iter().map(Some).collect() } else { vec![None] };
    let row = |band: Option<Band>| {
        let mut tally = Tally::default();
        // Not every random lobe is in the band; a band that none is in gets no row.
        for _ in 0..VALUES {
            if tally.values >= VALUES {
                break;
            }
            let Some(lobe) = lobe(model, band, &mut random) else { continue };
            let (half, exact) = (lobe.build::<Half>(), lobe.build::<f64>());
            for _ in 0..10 {
                let (l, v) = pair(narrowest(&lobe).unwrap_or(1.0), &mut random);
                let value: Rgb<Half> = half.eval(l, v);
                tally.add(value.g, exact.eval(l.map(f64::from), v.map(f64::from)).g);
            }
        }
        (tally.values > 0).then_some(Row { model, band, tally })
    };
    bands.into_iter().filter_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe_models::model;

    fn part(name: &str, band: usize, count: fn(&Tally) -> usize) -> f64 {
        let rows = survey(model(name).expect("a model"));
        let tally = rows[band].tally;
        tally.part(count(&tally))
    }

    #[test]
    fn what_the_documents_say_of_mediump() {
        assert!(part("lambert", 0, |t| t.within_1) == 1.0);
        assert!(part("blinn-phong", 1, |t| t.within_10) > 0.999);
        // 1/(π α²) leaves the range at α = 2.2e-3.
        assert!(part("ward", 1, |t| t.finite) == 1.0);
        assert!(part("ward", 3, |t| t.finite) == 0.0);
    }

    #[test]
    fn the_parameters_are_numbers_of_binary16_in_their_decade() {
        let mut random = Random::new(5);
        for model in lobe_models::models() {
            for band in BANDS {
                for lobe in (0..50).filter_map(|_| lobe(model, Some(band), &mut random)) {
                    for (_, value) in lobe.values() {
                        let numbers = match value {
                            Value::Number(x) => vec![x],
                            Value::Widths(w) => w.to_vec(),
                            Value::Table(t) => t.to_vec(),
                            Value::Colour(c) => c.to_vec(),
                            Value::Choice(_) => Vec::new(),
                        };
                        assert!(numbers.iter().all(|x| f64::from(Half::from(*x)) == *x), "{lobe}");
                    }
                    assert!(narrowest(&lobe).is_some_and(|w| w >= band.from && w <= band.to * 1.001), "{lobe}");
                }
            }
        }
    }
}
