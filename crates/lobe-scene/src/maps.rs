//! The pictures that a material library names, made into textures.

use crate::mtl::{MapStatement, MapUse, MtlMaterial};
use crate::picture::{self, Budget, Picture};
use crate::texture::{Encoding, Map, Sampler, Texture, Wrap};
use glam::{Mat2, Vec2, Vec3};
use std::collections::HashMap;
use std::io;
use std::path::{Component, Path};
use std::sync::Arc;

/// The textures of a material of MTL; each multiplies its number.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct MtlMaps {
    /// RGB.
    pub ambient: Option<Map>,
    /// RGB; of a PBR material the opacity in A.
    pub diffuse: Option<Map>,
    /// RGB.
    pub specular: Option<Map>,
    /// RGB.
    pub emission: Option<Map>,
    /// The dissolve in R; none of a PBR material.
    pub dissolve: Option<Map>,
    /// Roughness in G, metallic in B.
    pub metallic_roughness: Option<Map>,
    /// RGB.
    pub sheen: Option<Map>,
    /// The normal, in the tangent frame.
    pub normal: Option<Map>,
    /// What its x and y are multiplied with.
    pub normal_scale: f32,
}

impl MtlMaps {
    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        *self == Self { normal_scale: self.normal_scale, ..Self::default() }
    }
}

/// Which pictures a material has, with their sizes, in words.
pub(crate) fn pictures(all: &[(&str, &Option<Map>)]) -> Option<String> {
    let named = all.iter().filter_map(|(name, map)| {
        let [width, height] = map.as_ref()?.texture.size();
        Some(format!("{name} {width} × {height}"))
    });
    let named: Vec<_> = named.collect();
    (!named.is_empty()).then(|| format!("pictures: {}", named.join(", ")))
}

/// The largest picture file: 1 GiB.
const MAX_BYTES: u64 = 1 << 30;

/// Pictures that were read, by name, and what became of them.
#[derive(Default)]
pub(crate) struct Pictures {
    known: HashMap<String, Result<Arc<Picture>, String>>,
    textures: Vec<(Key, Arc<Texture>)>,
    budget: Budget,
}

/// What one texture is made of.
type Key = (Vec<(String, Option<usize>)>, Kind, bool);

/// What the texels of a texture mean.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Colour,
    /// Colour and opacity, of one picture each.
    Open,
    Numbers,
    MetallicRoughness,
    Normals,
    /// Heights, or normals if they are not grey, times this.
    Bump(f32),
}

impl Pictures {
    /// The textures of a material whose library lies in `folder`. `say` hears what could not be read, with its line.
    pub(crate) fn of(
        &mut self,
        material: &MtlMaterial,
        folder: &Path,
        loader: &mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
        say: &mut dyn FnMut(usize, String),
    ) -> MtlMaps {
        let mut find = |target| {
            let statement = material.maps.iter().find(|map| map.target == target)?;
            let name = place(folder, &statement.file);
            let picture = self.known.entry(name.clone()).or_insert_with(|| {
                let read = loader(&name).map_err(|error| format!("cannot be read: {error}"));
                let read = read.and_then(|bytes| match bytes.len() as u64 > MAX_BYTES {
                    true => Err(format!("has more than {MAX_BYTES} bytes")),
                    false => picture::read(&bytes, &mut self.budget),
                });
                read.map(Arc::new)
            });
            match picture {
                Ok(picture) => Some((statement, (name, picture.clone()))),
                Err(why) => {
                    let text = format!(
                        "material `{}`: the picture `{name}` {why}; it is shaded without this picture",
                        material.name
                    );
                    say(statement.line, text);
                    None
                }
            }
        };
        let all = [
            MapUse::Ambient,
            MapUse::Diffuse,
            MapUse::Specular,
            MapUse::Emission,
            MapUse::Dissolve,
            MapUse::Roughness,
            MapUse::Metallic,
            MapUse::Sheen,
            MapUse::Normal,
            MapUse::Bump,
        ];
        let [ambient, diffuse, specular, emission, dissolve, roughness, metallic, sheen, normal, bump] =
            all.map(&mut find);
        let mut map = |first: Option<Found<'_>>, second: Option<Found<'_>>, kind| self.map(first, second, kind);
        let mut maps = MtlMaps { normal_scale: 1.0, ..MtlMaps::default() };
        if let Some((statement, _)) = &normal {
            maps.normal_scale = statement.multiplier;
        }
        let strength = bump.as_ref().map_or(1.0, |(statement, _)| statement.multiplier);
        maps.normal = map(normal, None, Kind::Normals).or_else(|| map(bump, None, Kind::Bump(strength)));
        maps.ambient = map(ambient, None, Kind::Colour);
        maps.specular = map(specular, None, Kind::Colour);
        maps.emission = map(emission, None, Kind::Colour);
        maps.sheen = map(sheen, None, Kind::Colour);
        if material.pbr.is_some() {
            maps.metallic_roughness = map(roughness, metallic, Kind::MetallicRoughness);
            maps.diffuse = match dissolve {
                Some(dissolve) => map(diffuse, Some(dissolve), Kind::Open),
                None => map(diffuse, None, Kind::Colour),
            };
        } else {
            maps.diffuse = map(diffuse, None, Kind::Colour);
            maps.dissolve = map(dissolve, None, Kind::Numbers);
        }
        maps
    }

    fn map(&mut self, first: Option<Found<'_>>, second: Option<Found<'_>>, kind: Kind) -> Option<Map> {
        let statement = first.as_ref().or(second.as_ref())?.0;
        let names = [&first, &second].map(|found| match found {
            Some((statement, (name, _))) => (name.clone(), statement.channel),
            None => (String::new(), None),
        });
        let key = (names.to_vec(), kind, statement.clamp);
        let texture = match self.textures.iter().find(|(known, _)| *known == key) {
            Some((_, texture)) => texture.clone(),
            None => {
                let [a, b] = [&first, &second].map(|found| {
                    found.as_ref().map(|(statement, (_, picture))| Channels::new(picture, statement.channel))
                });
                let picture = texels(a, b, kind);
                let encoding =
                    if matches!(kind, Kind::Colour | Kind::Open) { Encoding::Srgb } else { Encoding::Linear };
                let wrap = if statement.clamp { Wrap::Clamp } else { Wrap::Repeat };
                let sampler = Sampler { wrap: [wrap; 2], nearest: false };
                let Picture { width, height, texels } = picture;
                let texture = Arc::new(Texture::new(width, height, texels, encoding, sampler).ok()?);
                self.textures.push((key, texture.clone()));
                texture
            }
        };
        // In the file v points up and 0 is the lower edge; here it points down from the upper one.
        let [scale, offset] = [statement.scale, statement.offset].map(Vec2::from);
        let offset = Vec2::new(offset.x, 1.0 - scale.y - offset.y);
        Some(Map { texture, set: 0, transform: (Mat2::from_diagonal(scale), offset) })
    }
}

/// A statement, and the picture that it names.
type Found<'a> = (&'a MapStatement, (String, Arc<Picture>));

/// Where a picture is sought: beside its library. Of a path on another machine, or out of the folder, its last part is.
fn place(folder: &Path, name: &str) -> String {
    // Exporters on Windows write `folder\file.png`, and `C:\Users\…`.
    let name = name.replace('\\', "/");
    let path = Path::new(&name);
    let inside = path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    let path = match path.file_name() {
        Some(last) if !inside || name.contains(':') => Path::new(last),
        _ => path,
    };
    folder.join(path).to_string_lossy().into_owned()
}

/// A picture, and which of its channels is asked for.
struct Channels<'a> {
    picture: &'a Picture,
    channel: Option<usize>,
}

impl<'a> Channels<'a> {
    /// Without a channel its alpha, if there is one, else its luminance.
    fn new(picture: &'a Picture, channel: Option<usize>) -> Self {
        let channel = channel.or_else(|| picture.texels.iter().any(|texel| texel[3] != 255).then_some(3));
        Self { picture, channel }
    }

    /// The texel at a place of a picture of another size.
    fn at(&self, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> [u8; 4] {
        let scaled = |at: u32, from: u32, to: u32| u64::from(at) * u64::from(to) / u64::from(from.max(1));
        let (x, y) = (scaled(x, width, self.picture.width), scaled(y, height, self.picture.height));
        let index = y * u64::from(self.picture.width) + x;
        self.picture.texels.get(index as usize).copied().unwrap_or([255; 4])
    }

    fn number(&self, texel: [u8; 4]) -> u8 {
        match self.channel {
            Some(channel) => texel[channel.min(3)],
            None => luminance(texel),
        }
    }
}

fn luminance([r, g, b, _]: [u8; 4]) -> u8 {
    ((u32::from(r) * 54 + u32::from(g) * 183 + u32::from(b) * 19 + 128) >> 8) as u8
}

/// The picture of a texture: of one picture, or of two, of which the smaller is enlarged.
fn texels(a: Option<Channels<'_>>, b: Option<Channels<'_>>, kind: Kind) -> Picture {
    let size = [&a, &b]
        .into_iter()
        .flatten()
        .fold([1, 1], |[w, h]: [u32; 2], channels| [w.max(channels.picture.width), h.max(channels.picture.height)]);
    let [width, height] = size;
    if let (Kind::Bump(strength), Some(a)) = (kind, &a) {
        let texels = normals(a.picture, strength);
        return Picture { width, height, texels };
    }
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let [first, second] = [&a, &b].map(|channels| channels.as_ref().map(|c| (c, c.at([x, y], size))));
            let number = |found: Option<(&Channels<'_>, [u8; 4])>| found.map_or(255, |(c, texel)| c.number(texel));
            texels.push(match kind {
                Kind::Numbers => [number(first); 4],
                Kind::MetallicRoughness => [255, number(first), number(second), 255],
                Kind::Open => {
                    let [r, g, b, _] = first.map_or([255; 4], |(_, texel)| texel);
                    [r, g, b, number(second)]
                }
                Kind::Colour | Kind::Normals | Kind::Bump(_) => {
                    let [r, g, b, _] = first.map_or([255; 4], |(_, texel)| texel);
                    [r, g, b, 255]
                }
            });
        }
    }
    Picture { width, height, texels }
}

/// Normals of heights. The format gives heights no unit: here a step from black to white in one texel is a slope of 1, times
/// `strength`.
///
/// What is not grey is no map of heights: many exporters write `bump` for a map of normals.
fn normals(picture: &Picture, strength: f32) -> Vec<[u8; 4]> {
    let encode = |normal: Vec3| {
        let [x, y, z] = (normal.normalize_or(Vec3::Z) * 127.5 + 127.5).round().to_array().map(|c| c as u8);
        [x, y, z, 255]
    };
    let grey = |[r, g, b, _]: &[u8; 4]| r.abs_diff(*g).max(g.abs_diff(*b)) <= 8;
    if !picture.texels.iter().all(grey) {
        let scaled = |[x, y, z, _]: &[u8; 4]| {
            let [x, y, z] = [*x, *y, *z].map(|c| f32::from(c) / 127.5 - 1.0);
            encode(Vec3::new(x * strength, y * strength, z))
        };
        return picture.texels.iter().map(scaled).collect();
    }
    let (width, height) = (picture.width as usize, picture.height as usize);
    let at = |x: usize, y: usize| {
        let texel = picture.texels.get((y % height) * width + x % width);
        texel.map_or(0.0, |texel| f32::from(luminance(*texel)) / 255.0)
    };
    let mut normals = Vec::with_capacity(picture.texels.len());
    for y in 0..height {
        for x in 0..width {
            let slope_x = (at(x + 1, y) - at(x + width - 1, y)) * 0.5 * strength;
            // Rows go down, and the y of a normal up.
            let slope_y = (at(x, y + height - 1) - at(x, y + 1)) * 0.5 * strength;
            normals.push(encode(Vec3::new(-slope_x, -slope_y, 1.0)));
        }
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, texels: &[[u8; 4]]) -> Picture {
        Picture { width, height: texels.len() as u32 / width, texels: texels.to_vec() }
    }

    #[test]
    fn a_slope_of_heights_tilts_the_normal_down_it() {
        // Brighter to the right, and then the same upwards.
        let ramp = [0_u8, 51, 102, 153].map(|y| [y, y, y, 255]);
        let across: Vec<_> = (0..4).flat_map(|_| ramp).collect();
        let up: Vec<_> = ramp.into_iter().rev().flat_map(|texel| [texel; 4]).collect();
        let expected = Vec3::new(-0.2, 0.0, 1.0).normalize();
        for (texels, expected) in [(across, expected), (up, Vec3::new(0.0, expected.x, expected.z))] {
            let [x, y, z, _] = normals(&picture(4, &texels), 1.0)[5].map(|c| f32::from(c) / 127.5 - 1.0);
            assert!((Vec3::new(x, y, z) - expected).length() < 0.01, "{x} {y} {z}");
        }
        // Colours are normals already.
        assert_eq!(normals(&picture(1, &[[128, 128, 255, 255]]), 3.0), [[129, 129, 255, 255]]);
    }

    #[test]
    fn two_pictures_of_two_sizes_become_one() {
        let rough = picture(2, &[[10, 10, 10, 255], [20, 20, 20, 255]]);
        let metal = picture(1, &[[0, 0, 0, 7]]);
        let joined =
            texels(Some(Channels::new(&rough, None)), Some(Channels::new(&metal, None)), Kind::MetallicRoughness);
        assert_eq!((joined.width, joined.height), (2, 1));
        assert_eq!(joined.texels, [[255, 10, 7, 255], [255, 20, 7, 255]]);
        let open = texels(None, Some(Channels::new(&rough, Some(1))), Kind::Open);
        assert_eq!(open.texels, [[255, 255, 255, 10], [255, 255, 255, 20]]);
    }

    #[test]
    fn pictures_are_sought_beside_their_library() {
        for (name, expected) in [
            ("a b.png", "sub/a b.png"),
            ("tex\\a.png", "sub/tex/a.png"),
            ("C:\\Users\\me\\a.png", "sub/a.png"),
            ("../../etc/a.png", "sub/a.png"),
            ("/etc/a.png", "sub/a.png"),
        ] {
            assert_eq!(place(Path::new("sub"), name), expected);
        }
    }
}
