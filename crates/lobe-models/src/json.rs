//! Materials in JSON: `{"lobes": [{"model": "lambert", "albedo": 0.8}, {"model": "phong", "ks": 0.1, "q": 50}]}`.
//!
//! The parameters are those of the catalogue, and a `weight` that the whole lobe is multiplied with. A colour may be one number, widths may be one or two; a word that brings
//! parameters of its own may hold them, so that `"fresnel": {"schlick": {"f0": 0.04}}` is another spelling of
//! `"fresnel": "schlick", "f0": 0.04`.
//!
//! A wrong value is named with its lobe, its line and what would be right. That is why each value is checked by the
//! visitor that reads it, if the model stands before it: afterwards the place in the text is no longer known.

use crate::catalogue::{Lobe, Model, model, models};
use crate::material::Material;
use crate::parameter::{Kind, Parameter, Value};
use serde::de::{DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeMap as _, SerializeStruct as _};
use serde::{Deserialize, Serialize, Serializer};
use std::fmt;

/// More lobes than any material has; a file with more is another kind of file.
pub const MAX_LOBES: usize = 1000;

/// What every lobe may be multiplied with.
static WEIGHT: Parameter = Parameter::reflectance("weight", "what the whole lobe is multiplied with");

/// More numbers than any parameter has.
const MAX_NUMBERS: usize = 32;

/// What is wrong in a text, where, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JsonError {
    /// The line, counted from 1.
    pub line: usize,
    /// The column, counted from 1.
    pub column: usize,
    /// What is wrong and what would be right.
    pub message: String,
}

impl fmt::Display for JsonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

impl std::error::Error for JsonError {}

const EXAMPLE: &str = "{\"lobes\": [{\"model\": \"lambert\", \"albedo\": 0.8}]}";

impl Material {
    /// Reads a material from JSON. One without a name is called what it is made of.
    ///
    /// # Errors
    /// For text that is no JSON, an unknown model or parameter, or a value outside its domain; weights above 1 are let
    /// pass, see [`warnings`](Self::warnings).
    pub fn from_json(text: &str) -> Result<Self, JsonError> {
        // Editors of Windows put a byte order mark at the start.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim_ascii_start().starts_with(['[', '"']) {
            let before = text.len() - text.trim_ascii_start().len();
            let line = text[..before].matches('\n').count() + 1;
            let message = format!("expected an object; a BRDF is an object such as {EXAMPLE}");
            return Err(JsonError { line, column: 1, message });
        }
        serde_json::from_str(text).map_err(|error| {
            let message = error.to_string();
            let place = format!(" at line {} column {}", error.line(), error.column());
            let message = message.strip_suffix(&place).unwrap_or(&message);
            let right = match error.classify() {
                // Ours, and serde's, say what would be right.
                serde_json::error::Category::Data => String::new(),
                _ => format!("; JSON such as {EXAMPLE}"),
            };
            let (line, column) = (error.line().max(1), error.column().max(1));
            JsonError { line, column, message: format!("{message}{right}") }
        })
    }
}

impl<'de> Deserialize<'de> for Material {
    /// From an object with `lobes`, or the name of a [`preset`](crate::preset).
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Fields {
            #[serde(default)]
            name: String,
            lobes: Lobes,
        }
        struct Whole;
        impl<'de> Visitor<'de> for Whole {
            type Value = Material;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a BRDF such as {EXAMPLE}, or the name of a preset")
            }
            fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Material, E> {
                crate::preset(name).map_err(E::custom)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Material, A::Error> {
                let fields = Fields::deserialize(serde::de::value::MapAccessDeserializer::new(map))?;
                let mut material = Material { name: fields.name, lobes: fields.lobes.0 };
                if material.name.is_empty() {
                    material.name = material.description();
                }
                Ok(material)
            }
        }
        deserializer.deserialize_any(Whole)
    }
}

/// The list of lobes; an error names which lobe it was.
struct Lobes(Vec<Lobe>);

impl<'de> Deserialize<'de> for Lobes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct List;
        impl<'de> Visitor<'de> for List {
            type Value = Lobes;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list of lobes, [{\"model\": ...}, ...]")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Lobes, A::Error> {
                let mut lobes = Vec::new();
                loop {
                    // serde_json takes the place of an error from the end of its text, so it is not lost here.
                    let named = |error: A::Error| A::Error::custom(format!("lobes[{}]: {error}", lobes.len()));
                    match list.next_element::<Lobe>().map_err(named)? {
                        None => return Ok(Lobes(lobes)),
                        Some(_) if lobes.len() == MAX_LOBES => {
                            return Err(A::Error::custom(format!("more than {MAX_LOBES} lobes; a material has a few")));
                        }
                        Some(lobe) => lobes.push(lobe),
                    }
                }
            }
        }
        deserializer.deserialize_seq(List)
    }
}

impl<'de> Deserialize<'de> for Lobe {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct One;
        impl<'de> Visitor<'de> for One {
            type Value = Lobe;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a lobe, {\"model\": ...}")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Lobe, A::Error> {
                let mut given = Given { model: None, values: Vec::new() };
                while let Some(key) = map.next_key::<String>()? {
                    if key != "model" {
                        let name = given.announce(key)?;
                        map.next_value_seed(ValueOf { name, given: &mut given })?;
                    } else if given.model.is_some() {
                        return Err(A::Error::duplicate_field("model"));
                    } else {
                        given.model = Some(map.next_value::<Name>()?.0);
                    }
                }
                given.lobe().map_err(A::Error::custom)
            }
        }
        deserializer.deserialize_map(One)
    }
}

/// What a lobe has been given so far.
struct Given {
    model: Option<&'static Model>,
    values: Vec<(String, Raw)>,
}

/// A value before it is known what it should be.
#[derive(Clone, Debug)]
enum Raw {
    Number(f64),
    List(Vec<f64>),
    Word(String),
}

impl Given {
    /// Checks the name of a parameter, as far as can be told.
    fn announce<E: serde::de::Error>(&self, name: String) -> Result<String, E> {
        if self.values.iter().any(|(known, _)| *known == name) {
            return Err(E::custom(format!("duplicate field `{name}`; once is enough")));
        }
        match self.model {
            // Every lobe has one, whatever the model.
            _ if name == WEIGHT.name => Ok(name),
            Some(model) => model.parameter(&name).map(|_| name).map_err(E::custom),
            None => Ok(name),
        }
    }

    /// The parameter, if the model is known already.
    fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        if name == WEIGHT.name {
            return Some(&WEIGHT);
        }
        self.model.and_then(|model| model.parameter(name).ok())
    }

    /// Keeps a value, after a check if the model is known.
    fn keep<E: serde::de::Error>(&mut self, name: String, raw: Raw) -> Result<(), E> {
        if let Some(parameter) = self.parameter(&name) {
            raw.value(parameter).map_err(E::custom)?;
        }
        self.values.push((name, raw));
        Ok(())
    }

    fn lobe(self) -> Result<Lobe, String> {
        let model = self.model.ok_or_else(|| format!("a lobe has a `model`; {}", known()))?;
        let mut values = Vec::new();
        let mut weight = [1.0; 3];
        for (name, raw) in &self.values {
            if name == WEIGHT.name {
                if let Value::Colour(colour) = raw.value(&WEIGHT)? {
                    weight = colour;
                }
                continue;
            }
            let parameter = model.parameter(name).map_err(|error| error.to_string())?;
            values.push((name.as_str(), raw.value(parameter)?));
        }
        let lobe = Lobe::weighted(model, &values).and_then(|lobe| lobe.with_weight(weight));
        lobe.map_err(|error| error.to_string())
    }
}

impl Raw {
    /// As the value of a parameter, inside its domain.
    fn value(&self, parameter: &Parameter) -> Result<Value, String> {
        let value = match (parameter.kind, self) {
            (Kind::Colour { .. }, Self::Number(x)) => Value::Colour([*x; 3]),
            (Kind::Colour { .. }, Self::List(list)) => match list[..] {
                [r, g, b] => Value::Colour([r, g, b]),
                _ => return Err(wrong_count(parameter, list.len())),
            },
            (Kind::Widths, Self::Number(x)) => Value::Widths([*x; 2]),
            (Kind::Widths, Self::List(list)) => match list[..] {
                [x, y] => Value::Widths([x, y]),
                _ => return Err(wrong_count(parameter, list.len())),
            },
            (Kind::Number { .. }, Self::Number(x)) => Value::Number(*x),
            (Kind::Table, Self::List(list)) => match list[..].try_into() {
                Ok(table) => Value::Table(table),
                Err(_) => return Err(wrong_count(parameter, list.len())),
            },
            (Kind::Choice(words), Self::Word(word)) => match words.iter().find(|known| *known == word) {
                Some(own) => Value::Choice(own),
                None => return Err(wrong(parameter, &format!("`{word}`"))),
            },
            (_, Self::Word(word)) => return Err(wrong(parameter, &format!("`{word}`"))),
            (_, Self::Number(x)) => return Err(wrong(parameter, &format!("{x:?}"))),
            (_, Self::List(_)) => return Err(wrong(parameter, "a list")),
        };
        // Of a colour, the channel that is wrong says enough.
        let one_by_one = match (value, self) {
            (Value::Colour(c), Self::List(_)) => c.map(|x| Value::Colour([x; 3])).to_vec(),
            _ => Vec::new(),
        };
        for channel in one_by_one.into_iter().chain([value]) {
            if parameter.check_weighted(channel).is_err() {
                let shown = match channel {
                    Value::Colour([x, ..]) => format!("{x:?}"),
                    other => other.to_string(),
                };
                return Err(wrong(parameter, &shown));
            }
        }
        Ok(value)
    }
}

fn wrong(parameter: &Parameter, what: &str) -> String {
    format!("`{}` is {what}; {}", parameter.name, parameter.domain())
}

fn wrong_count(parameter: &Parameter, count: usize) -> String {
    let right = match parameter.kind {
        Kind::Colour { .. } => "a number, or [r, g, b]".to_owned(),
        Kind::Table => parameter.domain(),
        _ => "a number, or [ax, ay]".to_owned(),
    };
    let count = if count > MAX_NUMBERS { format!("more than {MAX_NUMBERS}") } else { count.to_string() };
    format!("`{}` has {count} numbers; {right}", parameter.name)
}

fn known() -> String {
    let names: Vec<_> = models().map(|model| model.name).collect();
    format!("the models are {}", names.join(", "))
}

/// The name of a model of the catalogue.
struct Name(&'static Model);

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Text;
        impl Visitor<'_> for Text {
            type Value = Name;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name of a model")
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Name, E> {
                model(text).map(Name).ok_or_else(|| E::custom(format!("unknown model `{text}`; {}", known())))
            }
        }
        deserializer.deserialize_str(Text)
    }
}

/// Reads the value of a parameter into what is given.
struct ValueOf<'a> {
    name: String,
    given: &'a mut Given,
}

impl<'de> DeserializeSeed<'de> for ValueOf<'_> {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for ValueOf<'_> {
    type Value = ();
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.given.parameter(&self.name) {
            Some(parameter) => write!(f, "`{}`: {}", self.name, parameter.domain()),
            None => write!(f, "`{}`: a number, a list of numbers or a word", self.name),
        }
    }
    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<(), E> {
        // −0 counts as 0.
        self.given.keep(self.name, Raw::Number(value + 0.0))
    }
    fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<(), E> {
        self.visit_f64(value as f64)
    }
    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<(), E> {
        self.visit_f64(value as f64)
    }
    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<(), E> {
        self.given.keep(self.name, Raw::Word(word.to_owned()))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let mut numbers = Vec::new();
        // One more than there may be: then the count is wrong, and the rest need not be read.
        while numbers.len() <= MAX_NUMBERS {
            let seed = NumberOf { name: &self.name, parameter: self.given.parameter(&self.name) };
            match list.next_element_seed(seed)? {
                Some(number) => numbers.push(number),
                None => break,
            }
        }
        self.given.keep(self.name, Raw::List(numbers))
    }
    /// `{"word": {its parameters}}`.
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Self { name, given } = self;
        let lacks = || A::Error::custom(format!("`{name}` is an empty object; a word, or {{\"word\": {{...}}}}"));
        let word: String = map.next_key()?.ok_or_else(lacks)?;
        let only = format!("`{name}` is `{word}` and more; one word can be chosen");
        given.keep(name, Raw::Word(word))?;
        map.next_value_seed(Parameters(given))?;
        match map.next_key::<String>()? {
            None => Ok(()),
            Some(_) => Err(A::Error::custom(only)),
        }
    }
}

/// The parameters that a word brings.
struct Parameters<'a>(&'a mut Given);

impl<'de> DeserializeSeed<'de> for Parameters<'_> {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Parameters<'_> {
    type Value = ();
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with parameters, such as {\"f0\": 0.04}")
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            let name = self.0.announce(key)?;
            map.next_value_seed(ValueOf { name, given: &mut *self.0 })?;
        }
        Ok(())
    }
}

/// A number of a list, checked by itself.
struct NumberOf<'a> {
    name: &'a str,
    parameter: Option<&'static Parameter>,
}

impl<'de> DeserializeSeed<'de> for NumberOf<'_> {
    type Value = f64;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<f64, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl Visitor<'_> for NumberOf<'_> {
    type Value = f64;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`: numbers", self.name)
    }
    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<f64, E> {
        if let Some(parameter) = self.parameter {
            let alone = Raw::Number(value).value(parameter);
            // What takes no list says so when the list is whole.
            if !matches!(parameter.kind, Kind::Number { .. } | Kind::Table | Kind::Choice(_)) {
                alone.map_err(E::custom)?;
            }
        }
        Ok(value + 0.0)
    }
    fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<f64, E> {
        self.visit_f64(value as f64)
    }
    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<f64, E> {
        self.visit_f64(value as f64)
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Colour(c) => c.serialize(serializer),
            Self::Number(x) => x.serialize(serializer),
            Self::Widths([x, y]) if x == y => x.serialize(serializer),
            Self::Widths(a) => a.serialize(serializer),
            Self::Table(t) => t.serialize(serializer),
            Self::Choice(word) => word.serialize(serializer),
        }
    }
}

impl Serialize for Lobe {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("model", self.model().name)?;
        for (parameter, value) in self.values() {
            map.serialize_entry(parameter.name, &value)?;
        }
        if self.weight() != [1.0; 3] {
            map.serialize_entry(WEIGHT.name, &self.weight())?;
        }
        map.end()
    }
}

impl Serialize for Material {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Material", 2)?;
        fields.serialize_field("name", &self.name)?;
        fields.serialize_field("lobes", &self.lobes)?;
        fields.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe::Vec3;

    fn message(text: &str) -> String {
        Material::from_json(text).map_or_else(|error| error.to_string(), |spec| panic!("accepted: {spec:?}"))
    }

    fn one(text: &str) -> Material {
        let text = format!("{{\"lobes\": [{text}]}}");
        Material::from_json(&text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    #[test]
    fn errors_name_the_place_the_lobe_and_what_would_be_right() {
        let known = known();
        assert!(known.starts_with("the models are lambert, phong, blinn-phong, lecture-phong, lecture-blinn-torrance"));
        assert_eq!(
            message("{\"lobes\": [\n {\"model\": \"lambert\", \"albedo\": 0.5},\n {\"model\": \"phnog\"}]}"),
            format!("3:18: lobes[1]: unknown model `phnog`; {known}")
        );
        for (text, expected) in [
            (
                r#"{"lobes": [{"model": "phong", "ks": 0.5, "q": -1}]}"#,
                "1:48: lobes[0]: `q` is -1.0; a number from 0 to 1000000",
            ),
            (
                r#"{"lobes": [{"model": "phong", "ks": [0.5, -0.1, 0], "q": 1}]}"#,
                "1:46: lobes[0]: `ks` is -0.1; a colour from 0 to 1",
            ),
            (
                r#"{"lobes": [{"model": "phong", "ks": [0.5, 0.1], "q": 1}]}"#,
                "1:46: lobes[0]: `ks` has 2 numbers; a number, or [r, g, b]",
            ),
            (
                r#"{"lobes": [{"model": "phong", "ks": 0.5}]}"#,
                "1:40: lobes[0]: model `phong` lacks its parameter `q`; it takes `ks`, `q`",
            ),
            (
                r#"{"lobes": [{"model": "lambert", "albedo": 0.5, "q": 2}]}"#,
                "1:50: lobes[0]: model `lambert` has no parameter `q`; it takes `albedo`",
            ),
            (
                r#"{"lobes": [{"model": "lambert", "albdo": 1}]}"#,
                "1:39: lobes[0]: model `lambert` has no parameter `albdo`; it takes `albedo`",
            ),
            (
                r#"{"lobes": [{"model": "microfacet", "alpha": [0.1, 2], "f0": 1}]}"#,
                "1:51: lobes[0]: `alpha` is 2.0; a width from 0.0001 to 1, or two",
            ),
            (
                r#"{"lobes": [{"model": "microfacet", "alpha": 0.1, "masking": "smiht", "f0": 1}]}"#,
                "1:67: lobes[0]: `masking` is `smiht`; one of ",
            ),
            (r#"{"lobes": [{"ks": 1, "q": "x", "model": "phong"}]}"#, "1:48: lobes[0]: `q` is `x`; a number from 0"),
            (r#"{"lobes": [{"model": "phong", "ks": 1, "ks": 1}]}"#, "1:43: lobes[0]: duplicate field `ks`"),
            (r#"{"lobes": [{}]}"#, "1:13: lobes[0]: a lobe has a `model`; the models are lambert, "),
        ] {
            assert!(message(text).starts_with(expected), "{} against {expected}", message(text));
        }
        assert!(message(r#"{"lobes": [{"model": "lambert", "albedo": NaN}]}"#).starts_with("1:43: "));
        assert!(message(r#"{"lobes": [{"model": "phong", "ks": 1e400, "q": 1}]}"#).starts_with("1:"));
        assert!(message("").starts_with("1:1: "));
    }

    #[test]
    fn order_and_nesting_do_not_matter() {
        let flat = one(r#"{"model": "microfacet", "alpha": 0.25, "masking": "smith-separable", "f0": 0.5}"#);
        for text in [
            r#"{"alpha": [0.25, 0.25], "masking": "smith-separable", "f0": [0.5, 0.5, 0.5], "model": "microfacet"}"#,
            r#"{"model": "microfacet", "masking": {"smith-separable": {"f0": 0.5}}, "alpha": 0.25}"#,
            r#"{"masking": {"smith-separable": {"alpha": 0.25}}, "f0": 0.5, "model": "microfacet"}"#,
        ] {
            assert_eq!(one(text).lobes, flat.lobes, "{text}");
        }
        let wrong = |text: &str| message(&format!("{{\"lobes\": [{text}]}}"));
        assert!(wrong(r#"{"model": "microfacet", "masking": {"smith-separable": {"f0": -1}}}"#).contains("`f0` is -1"));
        assert!(wrong(r#"{"model": "microfacet", "masking": {}}"#).contains("an empty object"));
        assert!(wrong(r#"{"model": "microfacet", "f0": {"a": {}}}"#).contains("`f0` is `a`; a colour"));
        assert!(wrong(r#"{"model": "microfacet", "masking": {"smith-separable": {}, "x": {}}}"#).contains("one word"));
    }

    #[test]
    fn a_weight_multiplies_any_lobe() {
        let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, 0.8));
        let plain = one(r#"{"model": "microfacet", "alpha": 0.5, "f0": 0.5}"#).build::<f64>().eval(l, v);
        let text = r#"{"model": "microfacet", "alpha": 0.5, "f0": 0.5, "weight": [0, 0.5, 3]}"#;
        let weighted = one(text).build::<f64>().eval(l, v);
        assert_eq!(<[f64; 3]>::from(weighted), [0.0, 0.5 * plain.g, 3.0 * plain.b]);
        assert_eq!(one(text).warnings().len(), 1);
        let text = serde_json::to_string(&one(text)).unwrap_or_else(|error| panic!("{error}"));
        assert!(text.contains(r#""weight":[0.0,0.5,3.0]"#));
        let wrong = message(r#"{"lobes": [{"weight": [0, -1, 0], "model": "lambert", "albedo": 1}]}"#);
        assert!(wrong.ends_with("lobes[0]: `weight` is -1.0; a colour from 0 to 1"), "{wrong}");
    }

    #[test]
    fn what_is_written_reads_the_same() {
        for (name, _) in crate::PRESETS {
            let material = crate::preset(name).unwrap_or_else(|error| panic!("{error}"));
            let text = serde_json::to_string(&material).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(Material::from_json(&text).as_ref(), Ok(&material), "{text}");
        }
    }
}
