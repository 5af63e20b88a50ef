//! Parameters: their names, domains and values.

use std::fmt;

/// The smallest and the largest width α of a microfacet distribution.
pub(crate) const ALPHA: (f64, f64) = (1e-4, 1.0);

/// How many values a table has: at 0°, 5° … 90° from the normal.
pub const TABLE: usize = 19;
/// The largest value of a table, and the least that its largest may be: its integral is a factor in `f32`.
const TABLE_RANGE: (f64, f64) = (1e6, 1e-3);

/// A parameter of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in JSON and on the command line.
    pub name: &'static str,
    /// What it may be.
    pub kind: Kind,
    /// What it is if it is not given; `None` if it must be given.
    pub default: Option<Value>,
    /// What it means, in a few words.
    pub doc: &'static str,
}

/// What a parameter may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Linear RGB, each channel from 0 to `max`.
    Colour {
        /// The largest channel.
        max: f64,
    },
    /// A number.
    Number {
        /// The smallest.
        min: f64,
        /// The largest.
        max: f64,
    },
    /// A width α of a distribution, or `[αx, αy]`: from 1e-4 to 1.
    Widths,
    /// A distribution of the angle to the normal, in any unit: [`TABLE`] numbers at equal steps from 0° to 90°, from 0 to
    /// 1e6, the largest at least 1e-3.
    Table,
    /// One of some words.
    Choice(&'static [&'static str]),
}

/// The value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// Linear RGB.
    Colour([f64; 3]),
    /// A number.
    Number(f64),
    /// `[αx, αy]`.
    Widths([f64; 2]),
    /// Numbers at equal steps of an angle.
    Table([f64; TABLE]),
    /// A word.
    Choice(&'static str),
}

impl Parameter {
    /// A colour from 0 to 1 that must be given.
    #[must_use]
    pub const fn reflectance(name: &'static str, doc: &'static str) -> Self {
        Self { name, kind: Kind::Colour { max: 1.0 }, default: None, doc }
    }

    /// A number that must be given.
    #[must_use]
    pub const fn number(name: &'static str, min: f64, max: f64, doc: &'static str) -> Self {
        Self { name, kind: Kind::Number { min, max }, default: None, doc }
    }

    /// The exponent `q`.
    #[must_use]
    pub const fn shininess() -> Self {
        Self::number("q", 0.0, 1e6, "the exponent q")
    }

    /// The width `alpha`.
    #[must_use]
    pub const fn alpha() -> Self {
        Self {
            name: "alpha", kind: Kind::Widths, default: None, doc: "the width α of the distribution, or [αx, αy]"
        }
    }

    /// A word out of some, the first by default.
    #[must_use]
    pub const fn choice(name: &'static str, words: &'static [&'static str], doc: &'static str) -> Self {
        let default = match words {
            [first, ..] => Some(Value::Choice(first)),
            [] => None,
        };
        Self { name, kind: Kind::Choice(words), default, doc }
    }

    /// The same parameter with a default.
    #[must_use]
    pub const fn or(self, default: Value) -> Self {
        Self { default: Some(default), ..self }
    }

    /// The value, if it is in the domain; for a choice, the model's own copy of the word.
    ///
    /// # Errors
    /// What was wrong and what would be right.
    pub fn check(&self, value: Value) -> Result<Value, Error> {
        let inside = |x: f64, min: f64, max: f64| x.is_finite() && x >= min && x <= max;
        let good = match (self.kind, value) {
            (Kind::Colour { max }, Value::Colour(c)) => c.iter().all(|&x| inside(x, 0.0, max)),
            (Kind::Number { min, max }, Value::Number(x)) => inside(x, min, max),
            (Kind::Widths, Value::Widths(a)) => a.iter().all(|&x| inside(x, ALPHA.0, ALPHA.1)),
            (Kind::Table, Value::Table(t)) => {
                t.iter().all(|&x| inside(x, 0.0, TABLE_RANGE.0)) && t.iter().any(|&x| x >= TABLE_RANGE.1)
            }
            (Kind::Choice(words), Value::Choice(word)) => match words.iter().find(|w| **w == word) {
                Some(own) => return Ok(Value::Choice(own)),
                None => false,
            },
            _ => false,
        };
        if good { Ok(value) } else { Err(Error(format!("`{}` is {value}; {}", self.name, self.domain()))) }
    }
}

impl Parameter {
    /// Whether the lobe is proportional to it: an albedo or a `ks`.
    #[must_use]
    pub fn is_weight(&self) -> bool {
        matches!(self.kind, Kind::Colour { .. }) && matches!(self.name, "albedo" | "kd" | "ks" | "weight")
    }

    /// An ordinary value, by the name and the domain.
    pub(crate) fn typical(&self) -> Value {
        match self.kind {
            // A warm colour, so that no channel is like another.
            Kind::Colour { max } => Value::Colour([0.8, 0.5, 0.2].map(|x| x * max.min(1.0))),
            Kind::Widths => Value::Widths([0.3; 2]),
            // A Gaussian of 17°.
            Kind::Table => Value::Table(std::array::from_fn(|i| (-0.09 * (i * i) as f64).exp())),
            Kind::Choice(words) => Value::Choice(words.first().copied().unwrap_or_default()),
            Kind::Number { min, max } => {
                let value: f64 = match self.name {
                    "q" | "nv" => 50.0,
                    "nu" => 200.0,
                    "cxy" | "cx" => -0.95,
                    "cy" => -0.85,
                    "cz" => 0.9,
                    "ior" => 1.5,
                    "k" => 0.8,
                    "tau" => 5.0,
                    // Those of Löw et al.: the lobe is 1/√B wide.
                    "b" => 1000.0,
                    "c" if max > 1.0 => 1.2,
                    "roughness" => 0.5,
                    _ => 0.3,
                };
                Value::Number(value.clamp(min, max))
            }
        }
    }

    /// [`check`](Self::check), but a weight may be above 1.
    ///
    /// # Errors
    /// As for `check`.
    pub fn check_weighted(&self, value: Value) -> Result<Value, Error> {
        match value {
            // The end of f32, so that the weight is finite in every number type.
            Value::Colour(c) if self.is_weight() && c.iter().all(|x| (0.0..=f64::from(f32::MAX)).contains(x)) => {
                Ok(value)
            }
            _ => self.check(value),
        }
    }

    /// What it may be, in a few words: `a number from 0 to 1000000`.
    #[must_use]
    pub fn domain(&self) -> String {
        match self.kind {
            Kind::Colour { max } => format!("a colour from 0 to {max}"),
            Kind::Number { min, max } => format!("a number from {min} to {max}"),
            Kind::Widths => format!("a width from {} to {}, or two", ALPHA.0, ALPHA.1),
            Kind::Table => format!(
                "{TABLE} numbers from 0 to {}, at 0°, 5° … 90°, the largest at least {}",
                TABLE_RANGE.0, TABLE_RANGE.1
            ),
            Kind::Choice(words) => format!("one of {}", words.join(", ")),
        }
    }
}

impl Value {
    /// As it is written in a list of parameters: a word without quotes.
    #[must_use]
    pub fn bare(&self) -> String {
        match self {
            Self::Choice(word) => (*word).to_owned(),
            // `1` and not `1.0`: it is read by people.
            Self::Number(x) => x.to_string(),
            Self::Widths([x, y]) if x == y => x.to_string(),
            Self::Colour([r, g, b]) if r == g && g == b => r.to_string(),
            Self::Table(_) => "…".to_owned(),
            other => other.to_string(),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Colour(c) => write!(f, "{c:?}"),
            Self::Number(x) => write!(f, "{x:?}"),
            Self::Widths([x, y]) if x == y => write!(f, "{x:?}"),
            Self::Widths(a) => write!(f, "{a:?}"),
            Self::Table(t) => write!(f, "{t:?}"),
            Self::Choice(word) => write!(f, "`{word}`"),
        }
    }
}

/// What was wrong with a parameter, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error(pub(crate) String);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}
