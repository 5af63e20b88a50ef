//! MTL, the material library of Wavefront OBJ.
//!
//! A material holds the constants of the lighting equation that the file format was made for
//! (Wavefront, *Advanced Visualizer Manual*, appendix B2, 1995). For `illum 2` it reads
//!
//! ```text
//! colour = Ka Ia + Kd Σ (N·Lj) Ij + Ks Σ (H·Hj)^Ns Ij
//! ```
//!
//! with `H·Hj` the cosine between the normal and the halfway vector: Blinn's form of Phong's highlight.
//!
//! | statement | meaning | domain | when absent |
//! |---|---|---|---|
//! | `Ka r g b` | reflection of the ambient light | ≥ 0 | the same as `Kd` |
//! | `Kd r g b` | diffuse reflection | ≥ 0 | 0.8 |
//! | `Ks r g b` | specular reflection | ≥ 0 | 0 |
//! | `Ke r g b` | light that the surface sends out by itself | ≥ 0 | 0 |
//! | `Ns q` | exponent of the highlight | 0 … 10⁶ | 10 |
//! | `d a` | dissolve: 1 is solid, 0 is not there | 0 … 1 | 1 |
//! | `Tr t` | the same as `d` with `1 − t` | 0 … 1 | |
//! | `illum n` | which terms are used, see [`Illumination`] | 0 … 10 | 2 if `Ks` is not 0, else 1 |
//! | `map_Ka map_Kd map_Ks map_Ke map_d file` | a picture that the number is multiplied with | | |
//! | `norm file`, `bump file` | a normal map; a map of heights, or of normals if it is not grey | | |
//!
//! A material with one of these is a [`Pbr`] material instead: `Kd` is its base colour, and `Ka`, `Ks` and `illum` have no effect.
//!
//! | statement | meaning | domain | when absent |
//! |---|---|---|---|
//! | `Pr r` | perceptual roughness, whose square is `α` | 0 … 1 | `(2/(Ns + 2))^¼` if there is an `Ns`, else 1 |
//! | `Pm m` | metallic | 0 … 1 | 0 |
//! | `Ps s` | sheen | 0 … 1 | 0 |
//! | `Pc c`, `Pcr r` | clearcoat, its roughness | 0 … 1 | 0 |
//! | `aniso a`, `anisor t` | anisotropy, its rotation in turns | 0 … 1 | 0 |
//! | `map_Pr map_Pm map_Ps file` | a picture that the number is multiplied with | | |
//!
//! Colours are linear RGB; those of pictures follow the curve of sRGB. One number alone stands for all three. `Ni` and
//! `sharpness` concern refraction and blurred reflections, which are not supported; they are checked and have no effect but
//! one: `Ni` is the `ior` of a PBR material.

use crate::error::{Error, Warning, Warnings};
use crate::lines::{Place, Statements, keyword, shown, text, words};
use std::collections::{HashMap, HashSet};

/// The largest exponent `Ns` that is accepted; the lobes are accurate up to there.
pub const MAX_EXPONENT: f32 = 1e6;

/// The longest material library that is read from a file: 64 MiB.
pub const MAX_BYTES: u64 = 64 << 20;

/// Which terms of the equation a material uses: the statement `illum`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Illumination {
    /// `illum 0`: the colour `Kd` everywhere, without any light.
    Constant,
    /// `illum 1`: ambient and diffuse.
    Diffuse,
    /// `illum 2`: ambient, diffuse and highlight.
    Highlight,
    /// `illum 3`, `5` and `8`: as 2, and a mirror reflection weighted by `Ks`. `5` asks for Fresnel's
    /// law besides and gets the reflection without it.
    Mirror,
}

/// The statements that make a material one of metallic and roughness: an extension of the format that came with exporters of
/// such materials (Exocortex, 2013), of which there is no specification.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Pbr {
    /// `Pr`: perceptual roughness.
    pub roughness: Option<f32>,
    /// `Pm`.
    pub metallic: f32,
    /// `Ps`: sheen.
    pub sheen: f32,
    /// `Pc`: clearcoat.
    pub clearcoat: f32,
    /// `Pcr`: its roughness.
    pub clearcoat_roughness: f32,
    /// `aniso`: anisotropy.
    pub anisotropy: f32,
    /// `anisor`: its rotation, in turns.
    pub anisotropy_rotation: f32,
    /// `Ni`: the index of refraction.
    pub ior: f32,
}

impl Default for Pbr {
    fn default() -> Self {
        Self {
            roughness: None,
            metallic: 0.0,
            sheen: 0.0,
            clearcoat: 0.0,
            clearcoat_roughness: 0.0,
            anisotropy: 0.0,
            anisotropy_rotation: 0.0,
            ior: 1.5,
        }
    }
}

/// What a picture is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MapUse {
    /// `map_Ka`.
    Ambient,
    /// `map_Kd`.
    Diffuse,
    /// `map_Ks`.
    Specular,
    /// `map_Ke`.
    Emission,
    /// `map_d`.
    Dissolve,
    /// `map_Pr`.
    Roughness,
    /// `map_Pm`.
    Metallic,
    /// `map_Ps`.
    Sheen,
    /// `norm`.
    Normal,
    /// `bump`, `map_bump` or `map_Bump`.
    Bump,
}

impl MapUse {
    fn of(key: &[u8]) -> Option<Self> {
        Some(match key {
            b"map_Ka" => Self::Ambient,
            b"map_Kd" => Self::Diffuse,
            b"map_Ks" => Self::Specular,
            b"map_Ke" => Self::Emission,
            b"map_d" => Self::Dissolve,
            b"map_Pr" => Self::Roughness,
            b"map_Pm" => Self::Metallic,
            b"map_Ps" => Self::Sheen,
            b"norm" | b"map_norm" => Self::Normal,
            b"bump" | b"map_bump" | b"map_Bump" => Self::Bump,
            _ => return None,
        })
    }

    fn is_pbr(self) -> bool {
        matches!(self, Self::Roughness | Self::Metallic | Self::Sheen)
    }
}

/// A statement that names a picture: `map_Kd -s 2 2 wood.png`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MapStatement {
    /// What the picture is for.
    pub target: MapUse,
    /// Its name as it stands in the file.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// `-s`: what texture coordinates are multiplied with.
    pub scale: [f32; 2],
    /// `-o`: what is then added.
    pub offset: [f32; 2],
    /// `-clamp on`: nothing is seen beyond the edge but its last texel.
    pub clamp: bool,
    /// `-bm`: what the slopes of `bump`, or the x and y of `norm`, are multiplied with.
    pub multiplier: f32,
    /// `-imfchan r|g|b|m`: the channel of a map of numbers; without it its alpha if that is not 1 everywhere, else its
    /// luminance.
    pub channel: Option<usize>,
}

impl MapStatement {
    /// Options, and then the name, which may have spaces.
    fn new(target: MapUse, place: Place<'_>, mut rest: &[u8], say: &mut dyn FnMut(String)) -> Result<Self, String> {
        let mut map = Self {
            target,
            file: String::new(),
            line: place.line,
            scale: [1.0; 2],
            offset: [0.0; 2],
            clamp: false,
            multiplier: 1.0,
            channel: None,
        };
        while rest.first() == Some(&b'-') {
            let (option, mut words) = keyword(rest);
            let mut word = || {
                let (word, after) = keyword(words);
                words = after;
                word
            };
            match option {
                b"-bm" => {
                    let number = word();
                    map.multiplier = place.number(number).map_err(|_| "has an option -bm without a number")?;
                }
                b"-clamp" => map.clamp = word() == b"on",
                b"-imfchan" => {
                    let channel = word();
                    map.channel = [&b"r"[..], b"g", b"b", b"m"].iter().position(|name| *name == channel);
                }
                b"-s" | b"-o" | b"-t" => {
                    // One number to three.
                    let mut numbers = [None; 3];
                    for number in &mut numbers {
                        let (word, after) = keyword(words);
                        let Ok(found) = place.number(word) else { break };
                        (*number, words) = (Some(found), after);
                    }
                    let [Some(u), v, _] = numbers else {
                        return Err(format!("has an option {} without a number", shown(option)));
                    };
                    match option {
                        b"-s" => map.scale = [u, v.unwrap_or(1.0)],
                        b"-o" => map.offset = [u, v.unwrap_or(0.0)],
                        _ => say("has an option -t, which has no effect".to_owned()),
                    }
                }
                b"-mm" => {
                    word();
                    word();
                    say("has an option -mm, which has no effect".to_owned());
                }
                _ => {
                    word();
                    // What these ask for is a finer filter, or none.
                    if !matches!(option, b"-blendu" | b"-blendv" | b"-boost" | b"-texres" | b"-cc" | b"-type") {
                        say(format!("has an option {}, which has no effect", shown(option)));
                    }
                }
            }
            rest = words;
        }
        match rest {
            b"" => Err("names no file".to_owned()),
            rest => Ok(Self { file: text(rest), ..map }),
        }
    }
}

/// One material as it stands in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct MtlMaterial {
    /// The name after `newmtl`.
    pub name: String,
    /// Reflection of the ambient light; `None` means the same as `kd`.
    pub ka: Option<[f32; 3]>,
    /// Diffuse reflection.
    pub kd: [f32; 3],
    /// Specular reflection.
    pub ks: [f32; 3],
    /// Radiance that the surface sends out by itself.
    pub ke: [f32; 3],
    /// Exponent of the highlight, 0 … 10⁶.
    pub ns: f32,
    /// Dissolve: 1 is solid, 0 is not there.
    pub d: f32,
    /// The terms in use.
    pub illumination: Illumination,
    /// What it is instead, if it has a statement of PBR.
    pub pbr: Option<Pbr>,
    /// The pictures, at most one for each use.
    pub maps: Vec<MapStatement>,
}

impl Default for MtlMaterial {
    /// The grey of a surface to which the file gives no material.
    fn default() -> Self {
        Self {
            name: "default".to_owned(),
            ka: None,
            kd: [0.8; 3],
            ks: [0.0; 3],
            ke: [0.0; 3],
            ns: 10.0,
            d: 1.0,
            illumination: Illumination::Diffuse,
            pbr: None,
            maps: Vec::new(),
        }
    }
}

/// A material while it is being read: what has been given so far.
struct Draft {
    material: MtlMaterial,
    line: usize,
    illum: Option<u32>,
    exponent_given: bool,
    /// The numbers of PBR, and whether there was one.
    pbr: Pbr,
    is_pbr: bool,
}

/// Reads the text of an MTL file. `file` is the name for messages.
///
/// ```
/// let (materials, warnings) = lobe_scene::mtl::parse("newmtl red\nKd 1 0 0\nKs 0.5\nNs 40\n", "a.mtl")?;
/// assert_eq!(materials[0].kd, [1.0, 0.0, 0.0]);
/// assert!(warnings.is_empty());
///
/// let wrong = lobe_scene::mtl::parse("newmtl red\nNs -3\n", "a.mtl").unwrap_err();
/// assert!(wrong.to_string().starts_with("a.mtl:2: Ns is -3"));
/// # Ok::<(), lobe_scene::Error>(())
/// ```
///
/// # Errors
/// [`Error::Syntax`] with file and line when a statement is wrong.
pub fn parse(text: impl AsRef<[u8]>, file: &str) -> Result<(Vec<MtlMaterial>, Vec<Warning>), Error> {
    let mut library = Library {
        warnings: Warnings::new(file),
        materials: Vec::new(),
        by_name: HashMap::new(),
        unknown: HashSet::new(),
    };
    let mut draft: Option<Draft> = None;
    let mut statements = Statements::new(text.as_ref());
    while let Some((line, statement)) = statements.next() {
        let place = Place { file, line };
        let (key, rest) = keyword(statement);
        if key == b"newmtl" {
            if let Some(finished) = draft.take() {
                library.add(finished);
            }
            draft = Some(Draft::new(place, rest)?);
            continue;
        }
        match &mut draft {
            Some(draft) => library.statement(draft, place, key, rest)?,
            None => {
                return Err(place.error(
                    format!("`{}` stands before the first material", shown(key)),
                    "start a material with `newmtl name`",
                ));
            }
        }
    }
    if let Some(finished) = draft {
        library.add(finished);
    }
    Ok((library.materials, library.warnings.finish()))
}

impl Draft {
    fn new(place: Place<'_>, name: &[u8]) -> Result<Self, Error> {
        if name.is_empty() {
            return Err(place.error("newmtl without a name", "write `newmtl name`"));
        }
        let material = MtlMaterial { name: text(name), ..MtlMaterial::default() };
        let pbr = Pbr::default();
        Ok(Self { material, line: place.line, illum: None, exponent_given: false, pbr, is_pbr: false })
    }
}

/// What has been read of a file.
struct Library {
    warnings: Warnings,
    materials: Vec<MtlMaterial>,
    by_name: HashMap<String, usize>,
    unknown: HashSet<Vec<u8>>,
}

impl Library {
    fn statement(&mut self, draft: &mut Draft, place: Place<'_>, key: &[u8], rest: &[u8]) -> Result<(), Error> {
        let material = &mut draft.material;
        if let Some(target) = MapUse::of(key) {
            draft.is_pbr |= target.is_pbr();
            let mut say = |what: String| {
                let text = format!("material `{}`: the map `{} {}` {what}", material.name, shown(key), shown(rest));
                self.warnings.push(place.line, text);
            };
            // Half of all archives have one that is wrong, or empty: no reason to show nothing.
            match MapStatement::new(target, place, rest, &mut say) {
                Ok(map) => {
                    material.maps.retain(|known| known.target != target);
                    material.maps.push(map);
                }
                Err(why) => say(format!("{why}, and has no effect")),
            }
            return Ok(());
        }
        match key {
            b"Ka" => {
                if let Some(ka) = self.colour(place, key, rest)? {
                    material.ka = Some(ka);
                }
            }
            b"Kd" => material.kd = self.colour(place, key, rest)?.unwrap_or(material.kd),
            b"Ks" => material.ks = self.colour(place, key, rest)?.unwrap_or(material.ks),
            b"Ke" => material.ke = self.colour(place, key, rest)?.unwrap_or(material.ke),
            b"Ns" => {
                material.ns = one_number(place, key, rest)?;
                draft.exponent_given = true;
                if !(0.0..=MAX_EXPONENT).contains(&material.ns) {
                    return Err(place.error(format!("Ns is {}", material.ns), "an exponent lies between 0 and 1000000"));
                }
            }
            b"d" | b"Tr" => {
                let rest = match rest.strip_prefix(b"-halo") {
                    Some(rest) => {
                        self.warnings.push(place.line, "`d -halo` is not supported: the same dissolve from all sides");
                        rest.trim_ascii()
                    }
                    None => rest,
                };
                let value = one_number(place, key, rest)?;
                if !(0.0..=1.0).contains(&value) {
                    let problem = format!("{} is {value}", shown(key));
                    return Err(place.error(problem, "it lies between 0 and 1 (`d 1` and `Tr 0` are solid)"));
                }
                material.d = if key == b"d" { value } else { 1.0 - value };
            }
            b"illum" => draft.illum = Some(illum(place, rest)?),
            b"Ni" => draft.pbr.ior = one_number(place, key, rest)?,
            b"sharpness" => {
                one_number(place, key, rest)?;
            }
            b"Pr" | b"Pm" | b"Ps" | b"Pc" | b"Pcr" | b"aniso" | b"anisor" => {
                let value = one_number(place, key, rest)?;
                if !(0.0..=1.0).contains(&value) {
                    return Err(place.error(format!("{} is {value}", shown(key)), "it lies between 0 and 1"));
                }
                let pbr = &mut draft.pbr;
                match key {
                    b"Pr" => pbr.roughness = Some(value),
                    b"Pm" => pbr.metallic = value,
                    b"Ps" => pbr.sheen = value,
                    b"Pc" => pbr.clearcoat = value,
                    b"Pcr" => pbr.clearcoat_roughness = value,
                    b"aniso" => pbr.anisotropy = value,
                    _ => pbr.anisotropy_rotation = value,
                }
                draft.is_pbr = true;
            }
            _ if is_map(key) => self.warnings.push(
                place.line,
                format!(
                    "material `{}`: the map `{} {}` is not supported and has no effect",
                    material.name,
                    shown(key),
                    shown(rest)
                ),
            ),
            _ => {
                if self.unknown.len() < Warnings::LIMIT && self.unknown.insert(key.to_vec()) {
                    let text = format!("`{}` is not supported and has no effect", shown(key));
                    self.warnings.push(place.line, text);
                }
            }
        }
        Ok(())
    }

    /// A colour: three numbers, or one for all three. `None` (and a warning) for the two forms that need a spectrum.
    fn colour(&mut self, place: Place<'_>, key: &[u8], rest: &[u8]) -> Result<Option<[f32; 3]>, Error> {
        let mut colour = [0.0_f32; 3];
        let mut count = 0;
        for word in words(rest) {
            if count == 0 && (word == b"spectral" || word == b"xyz") {
                let text = format!("`{} {}` is not supported and has no effect", shown(key), shown(rest));
                self.warnings.push(place.line, text);
                return Ok(None);
            }
            if count == 3 {
                count = 4;
                break;
            }
            colour[count] = place.number(word)?;
            if colour[count] < 0.0 {
                let problem = format!("{} is {}", shown(key), colour[count]);
                return Err(place.error(problem, "a colour has no negative part"));
            }
            count += 1;
        }
        match count {
            1 => colour = [colour[0]; 3],
            3 => {}
            0 | 2 => {
                let problem = format!("{} has {count} numbers", shown(key));
                return Err(place.error(problem, format!("write `{} r g b`", shown(key))));
            }
            _ => {
                let problem = format!("{} has more than 3 numbers", shown(key));
                return Err(place.error(problem, format!("write `{} r g b`", shown(key))));
            }
        }
        if key != b"Ke" && colour.iter().any(|&part| part > 1.0) {
            self.warnings.push(place.line, format!("{} is above 1: more light leaves than arrives", shown(key)));
        }
        Ok(Some(colour))
    }

    /// The material is complete: its `illum` is decided and it joins the others.
    fn add(&mut self, draft: Draft) {
        let Draft { mut material, line, illum, exponent_given, mut pbr, is_pbr } = draft;
        if is_pbr {
            // The width of the microfacet lobe that looks most like that highlight.
            let of_exponent = (2.0 / (material.ns + 2.0)).sqrt().sqrt();
            let mapped = material.maps.iter().any(|map| map.target == MapUse::Roughness);
            pbr.roughness = pbr.roughness.or((exponent_given && !mapped).then_some(of_exponent));
            material.pbr = Some(pbr);
            return self.keep(material, line);
        }
        let shiny = material.ks.iter().any(|&part| part > 0.0);
        material.illumination = match illum {
            Some(0) => Illumination::Constant,
            Some(1) => Illumination::Diffuse,
            Some(2) => Illumination::Highlight,
            Some(3 | 5 | 8) => Illumination::Mirror,
            Some(4 | 6 | 7 | 9) => {
                let text = format!(
                    "material `{}`: illum {} asks for glass, which is not supported: shaded as illum 3 with its dissolve",
                    material.name,
                    illum.unwrap_or(0)
                );
                self.warnings.push(line, text);
                Illumination::Mirror
            }
            Some(_) => {
                let text = format!(
                    "material `{}`: illum 10 (shadows on invisible surfaces) is not supported: shaded as illum 2",
                    material.name
                );
                self.warnings.push(line, text);
                Illumination::Highlight
            }
            None if shiny => Illumination::Highlight,
            None => Illumination::Diffuse,
        };
        let highlight = matches!(material.illumination, Illumination::Highlight | Illumination::Mirror);
        if shiny && highlight && !exponent_given {
            let text = format!("material `{}` has Ks but no Ns: exponent 10 assumed", material.name);
            self.warnings.push(line, text);
        }
        self.keep(material, line);
    }

    fn keep(&mut self, material: MtlMaterial, line: usize) {
        match self.by_name.get(&material.name) {
            Some(&at) => {
                self.warnings.push(line, format!("material `{}` is given twice: the later one is used", material.name));
                self.materials[at] = material;
            }
            None => {
                self.by_name.insert(material.name.clone(), self.materials.len());
                self.materials.push(material);
            }
        }
    }
}

fn one_number(place: Place<'_>, key: &[u8], rest: &[u8]) -> Result<f32, Error> {
    let mut list = words(rest);
    match (list.next(), list.next()) {
        (Some(word), None) => place.number(word),
        (None, _) => {
            Err(place.error(format!("{} without a number", shown(key)), format!("write `{} number`", shown(key))))
        }
        (Some(_), Some(_)) => {
            Err(place
                .error(format!("{} has more than one number", shown(key)), format!("write `{} number`", shown(key))))
        }
    }
}

fn illum(place: Place<'_>, rest: &[u8]) -> Result<u32, Error> {
    let number = std::str::from_utf8(rest).ok().and_then(|word| word.parse::<u32>().ok());
    match number {
        Some(number) if number <= 10 => Ok(number),
        _ => Err(place.error(format!("illum is `{}`", shown(rest)), "it is a whole number from 0 to 10")),
    }
}

/// Statements that name a picture which is not used.
fn is_map(key: &[u8]) -> bool {
    key.starts_with(b"map_") || matches!(key, b"disp" | b"decal" | b"refl")
}
