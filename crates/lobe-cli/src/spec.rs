//! BRDFs in JSON: `{"lobes": [{"model": "lambert", "albedo": 0.8}, {"model": "phong", "ks": 0.1, "q": 50}]}`.
//!
//! A wrong parameter is named with its lobe, its line and what would be right. That is why each value is checked by
//! the visitor that reads it: afterwards the place in the text is no longer known.

use crate::error::{Failure, reason};
use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::{BlinnPhong, Brdf, CommonNormalization, Lambert, NormalIncidence, Phong, Real, Rgb, Shininess, Vec3};
use serde::de::{DeserializeSeed, Deserializer, Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::io::Read as _;
use std::path::Path;

/// The materials that have a name, as the JSON that they stand for.
pub const PRESETS: &[(&str, &str)] = &[
    ("paper", r#"{"lobes": [{"model": "lambert", "albedo": 0.8}]}"#),
    (
        "red-plastic",
        r#"{"lobes": [{"model": "lambert", "albedo": [0.5, 0.05, 0.05]}, {"model": "blinn-phong", "ks": 0.04, "q": 80}]}"#,
    ),
    ("glossy", r#"{"lobes": [{"model": "lambert", "albedo": 0.2}, {"model": "phong", "ks": 0.3, "q": 30}]}"#),
    ("gold", r#"{"lobes": [{"model": "blinn-phong", "ks": [1.0, 0.77, 0.34], "q": 200}]}"#),
    ("mirror-lobe", r#"{"lobes": [{"model": "phong", "ks": 1, "q": 50}]}"#),
    ("half-vector-lobe", r#"{"lobes": [{"model": "blinn-phong", "ks": 1, "q": 50}]}"#),
    (
        "lecture-phong",
        r#"{"lobes": [{"model": "lambert", "albedo": 0.6}, {"model": "lecture-phong", "ks": 0.4, "q": 20}]}"#,
    ),
    (
        "lecture-blinn-torrance",
        r#"{"lobes": [{"model": "lambert", "albedo": 0.6}, {"model": "lecture-blinn-torrance", "ks": 0.4, "q": 20}]}"#,
    ),
];

/// The largest exponent, and the end of the domain of [`Shininess`].
const MAX_Q: f64 = 1e6;
/// More lobes than any material has; a file with more is another kind of file.
const MAX_LOBES: usize = 1000;

/// A BRDF as it was written: a sum of lobes.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// What to call it: its own `name`, the name of the preset or file, or a short description.
    pub name: String,
    /// The lobes.
    pub lobes: Vec<LobeSpec>,
}

/// One lobe with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "model", rename_all = "kebab-case")]
pub enum LobeSpec {
    /// [`Lambert`].
    Lambert {
        /// The albedo ρ.
        albedo: [f64; 3],
    },
    /// [`Phong`].
    Phong {
        /// The reflectance.
        ks: [f64; 3],
        /// The exponent.
        q: f64,
    },
    /// [`BlinnPhong`].
    BlinnPhong {
        /// The reflectance.
        ks: [f64; 3],
        /// The exponent.
        q: f64,
        /// The factor N(q).
        normalization: NormalizationSpec,
    },
    /// [`PhongHighlight`].
    LecturePhong {
        /// The coefficient.
        ks: [f64; 3],
        /// The exponent.
        q: f64,
    },
    /// [`BlinnTorranceHighlight`].
    LectureBlinnTorrance {
        /// The coefficient.
        ks: [f64; 3],
        /// The exponent.
        q: f64,
    },
}

/// Which factor normalises the half-vector lobe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NormalizationSpec {
    /// [`NormalIncidence`].
    #[default]
    NormalIncidence,
    /// [`CommonNormalization`].
    Common,
}

/// The models by name, with the parameters that they take.
const MODELS: &[(&str, &[&str])] = &[
    ("lambert", &["albedo"]),
    ("phong", &["ks", "q"]),
    ("blinn-phong", &["ks", "q", "normalization"]),
    ("lecture-phong", &["ks", "q"]),
    ("lecture-blinn-torrance", &["ks", "q"]),
];

/// What `--brdf` was given: JSON, `@file`, or the name of a preset.
pub(crate) fn from_argument(argument: &str) -> Result<Spec, Failure> {
    if let Some(file) = argument.strip_prefix('@') {
        let text = read_some(file).map_err(|error| {
            Failure::Input(format!(
                "{file}: cannot read this file: {}; after @ stands a file with a BRDF in JSON",
                reason(&error)
            ))
        })?;
        let mut spec = parse_unnamed(&text, file)?;
        if spec.name.is_empty() {
            spec.name = Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        }
        return Ok(spec);
    }
    if argument.trim_start().starts_with(['{', '[', '"']) {
        return parse(argument, "--brdf");
    }
    let Some((name, text)) = PRESETS.iter().find(|(name, _)| *name == argument) else {
        let known: Vec<_> = PRESETS.iter().map(|(name, _)| *name).collect();
        return Err(Failure::Usage(format!(
            "unknown preset `{argument}` for --brdf; the presets are {}; or give JSON or @FILE",
            known.join(", ")
        )));
    };
    let spec = parse_unnamed(text, name)?;
    Ok(Spec { name: (*name).to_owned(), ..spec })
}

/// A text of at most a mebibyte; a pipe will do, and `/dev/zero` has an end.
fn read_some(file: &str) -> std::io::Result<String> {
    const LIMIT: u64 = 1 << 20;
    let mut text = String::new();
    std::fs::File::open(file)?.take(LIMIT + 1).read_to_string(&mut text)?;
    if text.len() as u64 > LIMIT {
        return Err(std::io::Error::other("it has more than 1 MiB"));
    }
    Ok(text)
}

/// Reads a BRDF from JSON; `source` is named in errors, as in `source:line:column: what; what would be right`.
///
/// # Errors
/// [`Failure::Input`] for text that is no JSON, an unknown model or parameter, or a parameter outside its domain.
pub fn parse(text: &str, source: &str) -> Result<Spec, Failure> {
    let mut spec = parse_unnamed(text, source)?;
    if spec.name.is_empty() {
        spec.name = spec.description();
    }
    Ok(spec)
}

fn parse_unnamed(text: &str, source: &str) -> Result<Spec, Failure> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Raw {
        #[serde(default)]
        name: String,
        #[serde(deserialize_with = "lobes")]
        lobes: Vec<LobeSpec>,
    }
    // Editors of Windows put a byte order mark at the start.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim_ascii_start().starts_with(['[', '"']) {
        let line = text.len() - text.trim_ascii_start().len();
        let line = text[..line].matches('\n').count() + 1;
        let right = "a BRDF is an object such as {\"lobes\": [{\"model\": \"lambert\", \"albedo\": 0.8}]}";
        return Err(Failure::Input(format!("{source}:{line}:1: expected an object; {right}")));
    }
    let raw: Raw = serde_json::from_str(text).map_err(|error| {
        let (line, column) = (error.line().max(1), error.column().max(1));
        let message = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        let message = message.strip_suffix(&place).unwrap_or(&message);
        let right = match error.classify() {
            // Ours, and serde's, say what would be right.
            serde_json::error::Category::Data => "",
            _ => "; JSON such as {\"lobes\": [{\"model\": \"lambert\", \"albedo\": 0.8}]}",
        };
        Failure::Input(format!("{source}:{line}:{column}: {message}{right}"))
    })?;
    Ok(Spec { name: raw.name, lobes: raw.lobes })
}

impl Spec {
    /// What it is made of, in a few words: `lambert + blinn-phong q=80`.
    #[must_use]
    pub fn description(&self) -> String {
        let lobes: Vec<_> = self.lobes.iter().map(LobeSpec::short).collect();
        if lobes.is_empty() { "no lobes".to_owned() } else { lobes.join(" + ") }
    }

    /// What is allowed and still suspicious: a coefficient above 1.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        for (index, lobe) in self.lobes.iter().enumerate() {
            let (name, colour) = lobe.colour();
            if colour.iter().any(|&channel| channel > 1.0) {
                warnings.push(format!(
                    "{}: lobes[{index}]: `{name}` is above 1, so more light leaves than arrives; use at most 1",
                    self.name
                ));
            }
        }
        warnings
    }

    /// The BRDF in the number type of `witness`.
    pub fn build<R: Real>(&self, witness: R) -> Material<R> {
        let rgb = |[r, g, b]: [f64; 3]| Rgb::new(witness.lift(r), witness.lift(g), witness.lift(b));
        let shininess = |q: f64| Shininess(witness.lift(q));
        let lobe = |spec: &LobeSpec| match *spec {
            LobeSpec::Lambert { albedo } => Lobe::Lambert(Lambert::new(rgb(albedo))),
            LobeSpec::Phong { ks, q } => Lobe::Phong(Phong::new(rgb(ks), shininess(q))),
            LobeSpec::BlinnPhong { ks, q, normalization: NormalizationSpec::NormalIncidence } => {
                Lobe::BlinnPhong(BlinnPhong::with_normalization(rgb(ks), shininess(q)))
            }
            LobeSpec::BlinnPhong { ks, q, normalization: NormalizationSpec::Common } => {
                Lobe::BlinnPhongCommon(BlinnPhong::with_normalization(rgb(ks), shininess(q)))
            }
            LobeSpec::LecturePhong { ks, q } => Lobe::LecturePhong(PhongHighlight::new(rgb(ks), shininess(q))),
            LobeSpec::LectureBlinnTorrance { ks, q } => {
                Lobe::LectureBlinnTorrance(BlinnTorranceHighlight::new(rgb(ks), shininess(q)))
            }
        };
        Material { zero: witness.lift(0.0), lobes: self.lobes.iter().map(lobe).collect() }
    }
}

impl LobeSpec {
    /// The name of its model.
    #[must_use]
    pub fn model(&self) -> &'static str {
        match self {
            Self::Lambert { .. } => "lambert",
            Self::Phong { .. } => "phong",
            Self::BlinnPhong { .. } => "blinn-phong",
            Self::LecturePhong { .. } => "lecture-phong",
            Self::LectureBlinnTorrance { .. } => "lecture-blinn-torrance",
        }
    }

    /// The exponent, if the model has one.
    #[must_use]
    pub fn exponent(&self) -> Option<f64> {
        match *self {
            Self::Lambert { .. } => None,
            Self::Phong { q, .. }
            | Self::BlinnPhong { q, .. }
            | Self::LecturePhong { q, .. }
            | Self::LectureBlinnTorrance { q, .. } => Some(q),
        }
    }

    /// Whether the model is reciprocal: the lecture's highlights are not.
    #[must_use]
    pub fn is_reciprocal(&self) -> bool {
        !matches!(self, Self::LecturePhong { .. } | Self::LectureBlinnTorrance { .. })
    }

    /// Its colour, with the name that the parameter has.
    #[must_use]
    pub fn colour(&self) -> (&'static str, [f64; 3]) {
        match *self {
            Self::Lambert { albedo } => ("albedo", albedo),
            Self::Phong { ks, .. }
            | Self::BlinnPhong { ks, .. }
            | Self::LecturePhong { ks, .. }
            | Self::LectureBlinnTorrance { ks, .. } => ("ks", ks),
        }
    }

    fn short(&self) -> String {
        match self.exponent() {
            None => self.model().to_owned(),
            Some(q) => format!("{} q={q}", self.model()),
        }
    }
}

/// A BRDF put together at run time. Choosing the model by `match` costs a branch a lobe and a pair, which is nothing
/// beside reading and printing the numbers; a renderer chooses by type.
#[derive(Debug)]
pub struct Material<R> {
    zero: R,
    lobes: Vec<Lobe<R>>,
}

/// Any lobe.
#[derive(Debug)]
enum Lobe<R> {
    Lambert(Lambert<R>),
    Phong(Phong<R>),
    BlinnPhong(BlinnPhong<R, NormalIncidence>),
    BlinnPhongCommon(BlinnPhong<R, CommonNormalization>),
    LecturePhong(PhongHighlight<R>),
    LectureBlinnTorrance(BlinnTorranceHighlight<R>),
}

/// The same call for whichever lobe it is.
macro_rules! of_lobe {
    ($lobe:expr, $f:ident ( $($argument:expr),* )) => {
        match $lobe {
            Lobe::Lambert(lobe) => lobe.$f($($argument),*),
            Lobe::Phong(lobe) => lobe.$f($($argument),*),
            Lobe::BlinnPhong(lobe) => lobe.$f($($argument),*),
            Lobe::BlinnPhongCommon(lobe) => lobe.$f($($argument),*),
            Lobe::LecturePhong(lobe) => lobe.$f($($argument),*),
            Lobe::LectureBlinnTorrance(lobe) => lobe.$f($($argument),*),
        }
    };
}

impl<R: Real> Brdf<R> for Material<R> {
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.sum(|lobe| of_lobe!(lobe, eval(l, v)), l, v)
    }

    fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        self.sum(|lobe| of_lobe!(lobe, eval_cos(l, v)), l, v)
    }
}

impl<R: Real> Material<R> {
    fn sum(&self, value: impl Fn(&Lobe<R>) -> Rgb<R>, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        // The first lobe as it is: a sum that starts from 0 would turn −0 into +0.
        let mut values = self.lobes.iter().map(value);
        match values.next() {
            Some(first) => values.fold(first, |sum, value| sum + value),
            None => lobe::Black.add_to(Rgb::splat(self.zero), l, v),
        }
    }
}

/// Reads the list of lobes, naming in an error which lobe it was.
fn lobes<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<LobeSpec>, D::Error> {
    struct Lobes;
    impl<'de> Visitor<'de> for Lobes {
        type Value = Vec<LobeSpec>;
        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a list of lobes, [{\"model\": ...}, ...]")
        }
        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
            let mut lobes = Vec::new();
            loop {
                // serde_json takes the place of an error from the end of its text, so it is not lost here.
                let named = |error: A::Error| A::Error::custom(format!("lobes[{}]: {error}", lobes.len()));
                match list.next_element::<RawLobe>().map_err(named)? {
                    None => return Ok(lobes),
                    Some(_) if lobes.len() == MAX_LOBES => {
                        return Err(A::Error::custom(format!("more than {MAX_LOBES} lobes; a material has a few")));
                    }
                    Some(lobe) => lobes.push(lobe.0),
                }
            }
        }
    }
    deserializer.deserialize_seq(Lobes)
}

/// A lobe while it is read.
///
/// All parameters of all models side by side: an enum tagged by `model` would be read through a buffer, in which the
/// place of a wrong value is lost.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fields {
    model: Model,
    #[serde(default, deserialize_with = "albedo")]
    albedo: Option<[f64; 3]>,
    #[serde(default, deserialize_with = "ks")]
    ks: Option<[f64; 3]>,
    #[serde(default, deserialize_with = "exponent")]
    q: Option<f64>,
    normalization: Option<NormalizationSpec>,
}

#[derive(Deserialize)]
#[serde(try_from = "Fields")]
struct RawLobe(LobeSpec);

impl TryFrom<Fields> for RawLobe {
    type Error = String;

    fn try_from(fields: Fields) -> Result<Self, String> {
        let Fields { model: Model(model), albedo, ks, q, normalization } = fields;
        let takes = MODELS.iter().find(|(name, _)| *name == model).map_or(&[][..], |(_, takes)| takes);
        let listed = takes.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let given = [
            ("albedo", albedo.is_some()),
            ("ks", ks.is_some()),
            ("q", q.is_some()),
            ("normalization", normalization.is_some()),
        ];
        if let Some((name, _)) = given.iter().find(|(name, given)| *given && !takes.contains(name)) {
            return Err(format!("model `{model}` has no parameter `{name}`; it takes {listed}"));
        }
        let missing = |name: &str| format!("model `{model}` lacks its parameter `{name}`; it takes {listed}");
        let albedo = || albedo.ok_or_else(|| missing("albedo"));
        let ks = || ks.ok_or_else(|| missing("ks"));
        let q = || q.ok_or_else(|| missing("q"));
        Ok(Self(match model {
            "lambert" => LobeSpec::Lambert { albedo: albedo()? },
            "phong" => LobeSpec::Phong { ks: ks()?, q: q()? },
            "blinn-phong" => {
                LobeSpec::BlinnPhong { ks: ks()?, q: q()?, normalization: normalization.unwrap_or_default() }
            }
            "lecture-phong" => LobeSpec::LecturePhong { ks: ks()?, q: q()? },
            _ => LobeSpec::LectureBlinnTorrance { ks: ks()?, q: q()? },
        }))
    }
}

/// A name out of [`MODELS`].
struct Model(&'static str);

impl<'de> Deserialize<'de> for Model {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Name;
        impl Visitor<'_> for Name {
            type Value = Model;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name of a model")
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Model, E> {
                match MODELS.iter().find(|(name, _)| *name == text) {
                    Some((name, _)) => Ok(Model(name)),
                    None => {
                        let known: Vec<_> = MODELS.iter().map(|(name, _)| *name).collect();
                        Err(E::custom(format!("unknown model `{text}`; the models are {}", known.join(", "))))
                    }
                }
            }
        }
        deserializer.deserialize_str(Name)
    }
}

fn albedo<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<[f64; 3]>, D::Error> {
    deserializer.deserialize_any(Colour("albedo")).map(Some)
}

fn ks<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<[f64; 3]>, D::Error> {
    deserializer.deserialize_any(Colour("ks")).map(Some)
}

fn exponent<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    deserializer.deserialize_any(Within { name: "q", max: MAX_Q, right: "an exponent from 0 to 1000000" }).map(Some)
}

/// A colour: one number for all channels, or three.
#[derive(Clone, Copy)]
struct Colour(&'static str);

impl Colour {
    fn channel(self) -> Within {
        Within { name: self.0, max: f64::from(f32::MAX), right: "a reflectance from 0 to 1" }
    }
}

impl<'de> Visitor<'de> for Colour {
    type Value = [f64; 3];
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`: a number, or [r, g, b]", self.0)
    }
    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<[f64; 3], E> {
        self.channel().visit_f64(value).map(|value| [value; 3])
    }
    fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<[f64; 3], E> {
        self.visit_f64(value as f64)
    }
    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<[f64; 3], E> {
        self.visit_f64(value as f64)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<[f64; 3], A::Error> {
        let mut colour = [0.0; 3];
        for (index, channel) in colour.iter_mut().enumerate() {
            *channel = list.next_element_seed(self.channel())?.ok_or_else(|| self.wrong_count(index))?;
        }
        match list.next_element::<serde::de::IgnoredAny>()? {
            None => Ok(colour),
            Some(_) => Err(self.wrong_count("more than 3")),
        }
    }
}

impl Colour {
    fn wrong_count<E: serde::de::Error>(self, count: impl fmt::Display) -> E {
        E::custom(format!("`{}` has {count} numbers; a number, or [r, g, b]", self.0))
    }
}

/// A number from 0 to `max`.
#[derive(Clone, Copy)]
struct Within {
    name: &'static str,
    max: f64,
    right: &'static str,
}

impl<'de> DeserializeSeed<'de> for Within {
    type Value = f64;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<f64, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl Visitor<'_> for Within {
    type Value = f64;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`: {}", self.name, self.right)
    }
    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<f64, E> {
        // −0 is in the range and counts as 0; NaN is not.
        if (0.0..=self.max).contains(&value) {
            Ok(value.abs())
        } else {
            Err(E::custom(format!("`{}` is {value:?}; {}", self.name, self.right)))
        }
    }
    fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<f64, E> {
        self.visit_f64(value as f64)
    }
    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<f64, E> {
        self.visit_f64(value as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        parse(text, "x.json").map_or_else(|failure| failure.to_string(), |spec| panic!("accepted: {spec:?}"))
    }

    #[test]
    fn every_preset_is_right() {
        for (name, text) in PRESETS {
            let spec = parse(text, name).unwrap_or_else(|failure| panic!("{failure}"));
            assert!(spec.warnings().is_empty(), "{name}");
        }
    }

    #[test]
    fn errors_name_the_place_the_lobe_and_what_would_be_right() {
        assert_eq!(
            message("{\"lobes\": [\n {\"model\": \"lambert\", \"albedo\": 0.5},\n {\"model\": \"phnog\"}]}"),
            "x.json:3:18: lobes[1]: unknown model `phnog`; \
             the models are lambert, phong, blinn-phong, lecture-phong, lecture-blinn-torrance"
        );
        assert_eq!(
            message(r#"{"lobes": [{"model": "phong", "ks": 0.5, "q": -1}]}"#),
            "x.json:1:48: lobes[0]: `q` is -1.0; an exponent from 0 to 1000000"
        );
        assert_eq!(
            message(r#"{"lobes": [{"model": "phong", "ks": [0.5, -0.1, 0], "q": 1}]}"#),
            "x.json:1:46: lobes[0]: `ks` is -0.1; a reflectance from 0 to 1"
        );
        assert_eq!(
            message(r#"{"lobes": [{"model": "phong", "ks": [0.5, 0.1], "q": 1}]}"#),
            "x.json:1:46: lobes[0]: `ks` has 2 numbers; a number, or [r, g, b]"
        );
        assert_eq!(
            message(r#"{"lobes": [{"model": "phong", "ks": 0.5}]}"#),
            "x.json:1:41: lobes[0]: model `phong` lacks its parameter `q`; it takes `ks`, `q`"
        );
        assert_eq!(
            message(r#"{"lobes": [{"model": "lambert", "albedo": 0.5, "q": 2}]}"#),
            "x.json:1:55: lobes[0]: model `lambert` has no parameter `q`; it takes `albedo`"
        );
        assert!(message(r#"{"lobes": [{"model": "lambert", "albedo": NaN}]}"#).starts_with("x.json:1:43: "));
        assert!(message(r#"{"lobes": [{"model": "lambert", "albdo": 1}]}"#).contains("unknown field `albdo`"));
        assert!(message(r#"{"lobes": [{"model": "phong", "ks": 1e400, "q": 1}]}"#).contains("x.json:1:"));
        assert!(message("").starts_with("x.json:1:1: "));
    }

    #[test]
    fn a_material_is_the_sum_of_its_lobes_to_the_last_bit() {
        let text = r#"{"lobes": [{"model": "lambert", "albedo": [0.5, 0.25, 0.125]},
                                  {"model": "blinn-phong", "ks": 0.1, "q": 50},
                                  {"model": "blinn-phong", "ks": 0.1, "q": 8, "normalization": "common"},
                                  {"model": "lecture-phong", "ks": 0.2, "q": 3}]}"#;
        let material = parse(text, "").unwrap_or_else(|failure| panic!("{failure}")).build(0.0_f32);
        let by_hand = Lambert::new(Rgb::new(0.5_f32, 0.25, 0.125))
            + BlinnPhong::new(Rgb::splat(0.1), Shininess(50.0))
            + BlinnPhong::<f32, CommonNormalization>::with_normalization(Rgb::splat(0.1), Shininess(8.0))
            + PhongHighlight::new(Rgb::splat(0.2), Shininess(3.0));
        let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.48, 0.36, 0.8));
        assert_eq!(material.eval(l, v), by_hand.eval(l, v));
        assert_eq!(material.eval_cos(l, v), by_hand.eval_cos(l, v));
    }

    #[test]
    fn no_lobes_are_black_and_above_one_is_a_warning() {
        let spec = parse(r#"{"lobes": []}"#, "").unwrap_or_else(|failure| panic!("{failure}"));
        let up = Vec3::new(0.0, 0.0, 1.0);
        assert_eq!(spec.build(0.0_f64).eval(up, up), Rgb::splat(0.0));
        let bright = parse(r#"{"lobes": [{"model": "lambert", "albedo": 1.5}]}"#, "");
        assert_eq!(bright.map(|spec| spec.warnings().len()), Ok(1));
    }
}
