//! OBJ, the text format for meshes of Wavefront (*Advanced Visualizer Manual*, appendix B1, 1995).
//!
//! Read are `v`, `vt`, `vn`, `f`, `s`, `g`, `o`, `usemtl` and `mtllib`, with comments, line continuation and both
//! kinds of line end. An index may be positive (counted from 1) or negative (counted back from the newest), and must
//! name something that stands above it. Polygons become triangles, concave ones too. Lines, points and free-form
//! curves and surfaces are skipped with a warning.
//!
//! Normals come from the file. Where it has none they are computed, see [`Smoothing`]: from the smoothing groups when
//! there is an `s` statement anywhere, else across edges up to the crease angle of [`Options`].

use crate::error::{Error, Warning, Warnings};
use crate::files;
use crate::lines::{Place, Statements, keyword, shown, text, words};
use crate::maps::{MtlMaps, Pictures};
use crate::mesh::{MAX_COORDINATE, Mesh, Triangle, Vertex};
use crate::mtl::{self, MtlMaterial};
use crate::normals::{self, MISSING, Smoothing};
use crate::tangents;
use crate::triangulate::{Cut, triangulate};
use glam::{Vec2, Vec3};
use std::collections::{HashMap, HashSet};
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The longest OBJ file that is read: 1 GiB.
pub const MAX_BYTES: u64 = 1 << 30;

/// How a file is to be understood where it leaves a choice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// In a file with neither normals nor smoothing groups, edges bent by up to this angle are smooth.
    /// In degrees, 0 … 180; 30 by default. 0 keeps everything flat but what lies in one plane.
    pub crease_degrees: f32,
}

impl Default for Options {
    fn default() -> Self {
        Self { crease_degrees: 30.0 }
    }
}

/// A named piece of a model: what stands under one `o` or `g`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// The names after `o` or `g`.
    pub name: String,
    /// Its triangles in the mesh.
    pub triangles: Range<usize>,
}

/// What an OBJ file and its material libraries hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// All triangles, with unit normals at all corners.
    pub mesh: Mesh,
    /// The materials in the order of their first use; [`Triangle::material`] counts them.
    pub materials: Vec<MtlMaterial>,
    /// The pictures of each material.
    pub maps: Vec<MtlMaps>,
    /// The named pieces that hold a triangle, in the order of the file.
    pub parts: Vec<Part>,
    /// What was skipped or assumed.
    pub warnings: Vec<Warning>,
}

/// Reads an OBJ file and the libraries that it names, which are sought in its own folder.
///
/// # Errors
/// [`Error::Read`] when the file cannot be read, and all errors of [`parse`].
pub fn load(path: &Path, options: &Options) -> Result<Model, Error> {
    let text = files::read(path, MAX_BYTES).map_err(|source| Error::read(path, source))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    parse(text, &path.display().to_string(), &mut |name| files::read(&folder.join(name), mtl::MAX_BYTES), options)
}

/// Reads the text of an OBJ file.
///
/// `file` is the name for messages. `loader` gives the text of a material library by the name that stands after
/// `mtllib`, and then the pictures by theirs, as they lie beside the library. A library that it cannot give is a warning, and
/// its materials become the default grey; without a picture a material keeps its numbers.
///
/// ```
/// use lobe_scene::obj;
///
/// let text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n";
/// let model = obj::parse(text, "a.obj", &mut |_| Ok(b"newmtl red\nKd 1 0 0\n".to_vec()), &obj::Options::default())?;
/// assert_eq!(model.mesh.triangles.len(), 2);
/// assert_eq!(model.materials[0].kd, [1.0, 0.0, 0.0]);
/// # Ok::<(), lobe_scene::Error>(())
/// ```
///
/// # Errors
/// [`Error::Syntax`] with file and line when a statement of the file or of a library is wrong;
/// [`Error::NoTriangles`] when there is nothing to draw.
pub fn parse(
    text: impl AsRef<[u8]>,
    file: &str,
    loader: &mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
    options: &Options,
) -> Result<Model, Error> {
    if !(0.0..=180.0).contains(&options.crease_degrees) {
        return Err(Error::setting("the crease angle", options.crease_degrees, "it lies between 0 and 180 degrees"));
    }
    let text = text.as_ref();
    let newlines = |text: &[u8]| text.iter().filter(|&&byte| byte == b'\n').count();
    if let Some(at) = text.iter().position(|&byte| byte == 0) {
        return Err(Error::syntax(file, newlines(&text[..at]) + 1, "a byte of value 0", NOT_OBJ));
    }
    let mut reader = Reader::new(file, loader);
    let mut statements = Statements::new(text);
    while let Some((line, statement)) = statements.next() {
        reader.statement(Place { file, line }, statement)?;
    }
    if reader.mesh.positions.is_empty() {
        let lines = newlines(text) + usize::from(!text.is_empty() && !text.ends_with(b"\n"));
        return Err(Error::syntax(file, 1, format!("not one `v` line in {lines} lines"), NOT_OBJ));
    }
    reader.finish(options)
}

/// What has been read so far.
struct Reader<'a> {
    file: &'a str,
    loader: &'a mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
    mesh: Mesh,
    /// The `vt`, from the upper edge of a picture.
    texture: Vec<Vec2>,
    /// Where each `vn` is in the mesh, in which one of length 0 has no entry.
    normal_index: Vec<u32>,
    zero_normals: Tally,
    /// The smoothing group of each triangle.
    groups: Vec<u32>,
    group: u32,
    groups_given: bool,
    parts: Vec<Part>,
    /// The names after `usemtl` with the line of their first use; entry 0 is for faces above any `usemtl`.
    material_names: Vec<(String, usize)>,
    material_by_name: HashMap<String, u32>,
    material: u32,
    /// By name, each with the file that it stands in, and the folder of that, as the loader knows it.
    library: HashMap<String, (MtlMaterial, Arc<(String, PathBuf)>)>,
    loaded: HashSet<String>,
    unsupported: HashSet<Vec<u8>>,
    freeform: bool,
    colours: bool,
    guesses: Tally,
    warnings: Warnings,
    /// Room for one face, kept from line to line.
    corners: Vec<Corner>,
    points: Vec<Vec3>,
    cut: Vec<[u32; 3]>,
}

/// Something that happened a number of times, first in this line.
#[derive(Debug, Default, Clone, Copy)]
struct Tally {
    count: usize,
    line: usize,
}

impl Tally {
    fn add(&mut self, line: usize) {
        if self.count == 0 {
            self.line = line;
        }
        self.count += 1;
    }
}

/// A corner of a face: indices from 0.
#[derive(Debug, Clone, Copy)]
struct Corner {
    position: u32,
    texture: u32,
    normal: u32,
    form: Form,
}

/// How a corner is written. All corners of a face are written alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Position,
    Texture,
    Normal,
    Both,
}

impl Form {
    fn shown(self) -> &'static str {
        match self {
            Self::Position => "v",
            Self::Texture => "v/vt",
            Self::Normal => "v//vn",
            Self::Both => "v/vt/vn",
        }
    }
}

const NOT_OBJ: &str = "this is not an OBJ file, a text with `v x y z` and `f 1 2 3` lines";

const FACE_HELP: &str = "write `f` and three corners or more, each as v, v/vt, v//vn or v/vt/vn";

impl<'a> Reader<'a> {
    fn new(file: &'a str, loader: &'a mut dyn FnMut(&str) -> io::Result<Vec<u8>>) -> Self {
        Self {
            file,
            loader,
            mesh: Mesh::default(),
            texture: Vec::new(),
            normal_index: Vec::new(),
            zero_normals: Tally::default(),
            groups: Vec::new(),
            group: 0,
            groups_given: false,
            parts: Vec::new(),
            material_names: vec![(String::new(), 0)],
            material_by_name: HashMap::new(),
            material: 0,
            library: HashMap::new(),
            loaded: HashSet::new(),
            unsupported: HashSet::new(),
            freeform: false,
            colours: false,
            guesses: Tally::default(),
            warnings: Warnings::new(file),
            corners: Vec::new(),
            points: Vec::new(),
            cut: Vec::new(),
        }
    }

    fn statement(&mut self, place: Place<'_>, statement: &[u8]) -> Result<(), Error> {
        let (key, rest) = keyword(statement);
        match key {
            b"v" => self.position(place, rest)?,
            b"vt" => self.texture(place, rest)?,
            b"vn" => self.normal(place, rest)?,
            // `fo` is the name of `f` in version 2 of the format.
            b"f" | b"fo" => self.face(place, rest)?,
            b"s" => self.smoothing(place, rest)?,
            b"o" | b"g" => self.part(rest),
            b"usemtl" => self.use_material(place, rest)?,
            b"mtllib" => self.material_library(place, rest)?,
            b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim"
            | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"mg" | b"bzp" | b"bsp" | b"cdc" | b"cdp" | b"res" => {
                if !self.freeform {
                    self.freeform = true;
                    let text = format!("free-form curves and surfaces (`{}`) are not supported: skipped", shown(key));
                    self.warnings.push(place.line, text);
                }
            }
            _ => {
                if self.unsupported.len() < Warnings::LIMIT && self.unsupported.insert(key.to_vec()) {
                    let text = match key {
                        b"l" | b"p" => format!("`{}` draws no surface: skipped", shown(key)),
                        _ => format!("`{}` is not supported: skipped", shown(key)),
                    };
                    self.warnings.push(place.line, text);
                }
            }
        }
        Ok(())
    }

    fn position(&mut self, place: Place<'_>, rest: &[u8]) -> Result<(), Error> {
        // x y z, or with a weight (which only curves use), or with a colour, or with both.
        let (numbers, count) = numbers::<7>(place, rest)?;
        if !matches!(count, 3 | 4 | 6 | 7) {
            return Err(place.error(format!("v has {count} numbers"), "write `v x y z`"));
        }
        if count > 4 && !self.colours {
            self.colours = true;
            self.warnings.push(place.line, "colours of points are not supported and have no effect");
        }
        if let Some(far) = numbers[..3].iter().find(|number| number.abs() > MAX_COORDINATE) {
            return Err(place.error(format!("the coordinate {far} is too far out"), "coordinates go up to 1e9"));
        }
        self.mesh.positions.push(Vec3::new(numbers[0], numbers[1], numbers[2]));
        Ok(())
    }

    fn texture(&mut self, place: Place<'_>, rest: &[u8]) -> Result<(), Error> {
        let ([u, v, _], count) = numbers::<3>(place, rest)?;
        if count == 0 || count > 3 {
            return Err(place.error(format!("vt has {count} numbers"), "write `vt u v`"));
        }
        self.texture.push(Vec2::new(u, 1.0 - v));
        Ok(())
    }

    fn normal(&mut self, place: Place<'_>, rest: &[u8]) -> Result<(), Error> {
        let (numbers, count) = numbers::<3>(place, rest)?;
        if count != 3 {
            return Err(place.error(format!("vn has {count} numbers"), "write `vn x y z`"));
        }
        let normal = glam::DVec3::from_array(numbers[..3].try_into().unwrap_or([0.0; 3]).map(f64::from));
        match normal.try_normalize() {
            Some(normal) => {
                self.normal_index.push(self.mesh.normals.len() as u32);
                self.mesh.normals.push(normal.as_vec3());
            }
            None => {
                self.zero_normals.add(place.line);
                self.normal_index.push(MISSING);
            }
        }
        Ok(())
    }

    fn face(&mut self, place: Place<'_>, rest: &[u8]) -> Result<(), Error> {
        self.corners.clear();
        for word in words(rest) {
            let corner = self.corner(place, word)?;
            if let Some(first) = self.corners.first().filter(|first| first.form != corner.form) {
                return Err(place.error(
                    format!("the corner `{}` is not written like the first one, {}", shown(word), first.form.shown()),
                    "write all corners of a face alike",
                ));
            }
            self.corners.push(corner);
        }
        let count = self.corners.len();
        if count < 3 {
            let corners = if count == 1 { "corner" } else { "corners" };
            return Err(place.error(format!("a face with {count} {corners}"), FACE_HELP));
        }
        self.cut.clear();
        self.points.clear();
        if count == 3 {
            self.cut.push([0, 1, 2]);
        } else {
            self.points.extend(self.corners.iter().map(|corner| self.mesh.positions[corner.position as usize]));
            if triangulate(&self.points, &mut self.cut) == Cut::Guess {
                self.guesses.add(place.line);
            }
        }
        for cut in &self.cut {
            let [a, b, c] = cut.map(|corner| self.corners[corner as usize]);
            self.mesh.triangles.push(Triangle {
                positions: [a.position, b.position, c.position],
                normals: [a.normal, b.normal, c.normal],
                vertices: [a.texture, b.texture, c.texture],
                material: self.material,
            });
            self.groups.push(self.group);
        }
        Ok(())
    }

    /// One of the four forms `v`, `v/vt`, `v//vn`, `v/vt/vn`.
    fn corner(&self, place: Place<'_>, word: &[u8]) -> Result<Corner, Error> {
        let mut pieces = word.split(|&byte| byte == b'/');
        let broken = || place.error(format!("`{}` is not a corner", shown(word)), FACE_HELP);
        let position = pieces.next().filter(|piece| !piece.is_empty()).ok_or_else(broken)?;
        let position = index(place, word, position, self.mesh.positions.len(), "v")?;
        let (texture, normal) = (pieces.next(), pieces.next());
        if pieces.next().is_some() || texture == Some(b"") && normal.is_none() || normal == Some(b"") {
            return Err(broken());
        }
        let texture = texture.filter(|piece| !piece.is_empty());
        let texture = texture.map(|texture| index(place, word, texture, self.texture.len(), "vt")).transpose()?;
        let normal = normal.map(|normal| index(place, word, normal, self.normal_index.len(), "vn")).transpose()?;
        let form = match (texture, normal) {
            (None, None) => Form::Position,
            (Some(_), None) => Form::Texture,
            (None, Some(_)) => Form::Normal,
            (Some(_), Some(_)) => Form::Both,
        };
        let normal = normal.map_or(MISSING, |normal| self.normal_index[normal as usize]);
        Ok(Corner { position, texture: texture.unwrap_or(MISSING), normal, form })
    }

    fn smoothing(&mut self, place: Place<'_>, rest: &[u8]) -> Result<(), Error> {
        self.groups_given = true;
        self.group = match rest {
            b"off" => 0,
            // Blender has written `s on`.
            b"on" => 1,
            _ => std::str::from_utf8(rest).ok().and_then(|word| word.parse().ok()).ok_or_else(|| {
                place.error(format!("the smoothing group is `{}`", shown(rest)), "write `s off` or `s number`")
            })?,
        };
        Ok(())
    }

    fn part(&mut self, name: &[u8]) {
        let start = self.mesh.triangles.len();
        self.close_part();
        let name = if name.is_empty() { "default".to_owned() } else { text(name) };
        self.parts.push(Part { name, triangles: start..start });
    }

    fn close_part(&mut self) {
        let end = self.mesh.triangles.len();
        if let Some(part) = self.parts.last_mut() {
            part.triangles.end = end;
        }
        if self.parts.last().is_some_and(|part| part.triangles.is_empty()) {
            self.parts.pop();
        }
    }

    fn use_material(&mut self, place: Place<'_>, name: &[u8]) -> Result<(), Error> {
        if name.is_empty() {
            return Err(place.error("usemtl without a name", "write `usemtl name`"));
        }
        let name = text(name);
        self.material = match self.material_by_name.get(&name) {
            Some(&known) => known,
            None => {
                let index = self.material_names.len() as u32;
                self.material_by_name.insert(name.clone(), index);
                self.material_names.push((name, place.line));
                index
            }
        };
        Ok(())
    }

    /// `mtllib a.mtl b.mtl`, or one name with spaces in it.
    fn material_library(&mut self, place: Place<'_>, rest: &[u8]) -> Result<(), Error> {
        if rest.is_empty() {
            return Err(place.error("mtllib without a name", "write `mtllib name.mtl`"));
        }
        let whole = text(rest);
        if self.loaded.contains(&whole) {
            return Ok(());
        }
        let names: Vec<String> = words(rest).map(text).collect();
        if names.len() > 1
            && let Ok(found) = (self.loader)(&whole)
        {
            return self.add_library(whole, found);
        }
        for name in names {
            if self.loaded.contains(&name) {
                continue;
            }
            // Exporters on Windows write `folder\file.mtl`.
            let found = (self.loader)(&name).or_else(|error| match name.contains('\\') {
                true => (self.loader)(&name.replace('\\', "/")),
                false => Err(error),
            });
            match found {
                Ok(found) => self.add_library(name, found)?,
                Err(error) => {
                    let sought = Path::new(self.file).with_file_name(&name);
                    let why = system_message(&error);
                    let text = format!(
                        "the material library `{name}` was sought at {}: {why}; its materials are grey",
                        sought.display()
                    );
                    self.warnings.push(place.line, text);
                    self.loaded.insert(name);
                }
            }
        }
        Ok(())
    }

    fn add_library(&mut self, name: String, content: Vec<u8>) -> Result<(), Error> {
        // Messages name the library as it lies beside the OBJ file.
        let file = Path::new(self.file).with_file_name(&name).display().to_string();
        let (materials, warnings) = mtl::parse(content, &file)?;
        self.warnings.append(warnings);
        let folder = Path::new(&name.replace('\\', "/")).parent().unwrap_or(Path::new("")).to_owned();
        let place = Arc::new((file, folder));
        for material in materials {
            self.library.insert(material.name.clone(), (material, place.clone()));
        }
        self.loaded.insert(name);
        Ok(())
    }

    fn finish(mut self, options: &Options) -> Result<Model, Error> {
        self.close_part();
        if self.zero_normals.count > 0 {
            let text = format!("{} normals (vn) of length 0: computed from the faces instead", self.zero_normals.count);
            self.warnings.push(self.zero_normals.line, text);
        }
        if self.guesses.count > 0 {
            let text = format!(
                "{} polygons cross themselves, have no area or have too many corners: drawn as they come",
                self.guesses.count
            );
            self.warnings.push(self.guesses.line, text);
        }
        self.drop_triangles(Mesh::drop_degenerate, "triangles without an area: dropped");
        // Exporters write them by mistake. No ray can tell them apart, and many of them would slow down every ray.
        self.drop_triangles(Mesh::drop_duplicates, "triangles lie exactly on an earlier one: dropped");
        if self.mesh.triangles.is_empty() {
            return Err(Error::NoTriangles { file: self.file.to_owned() });
        }
        let smoothing =
            if self.groups_given { Smoothing::Groups } else { Smoothing::Crease { degrees: options.crease_degrees } };
        normals::fill(&mut self.mesh, &self.groups, smoothing);
        let (materials, maps) = self.resolve_materials();
        self.vertices(&maps);
        Ok(Model { mesh: self.mesh, materials, maps, parts: self.parts, warnings: self.warnings.finish() })
    }

    fn drop_triangles(&mut self, drop: fn(&mut Mesh) -> Vec<bool>, what: &str) {
        let kept = drop(&mut self.mesh);
        let dropped = kept.iter().filter(|&&kept| !kept).count();
        if dropped == 0 {
            return;
        }
        self.warnings.push(0, format!("{dropped} {what}"));
        let mut at = 0;
        self.groups.retain(|_| {
            at += 1;
            kept[at - 1]
        });
        // Where each triangle has moved to.
        let mut moved = Vec::with_capacity(kept.len() + 1);
        let mut left = 0;
        for &kept in &kept {
            moved.push(left);
            left += usize::from(kept);
        }
        moved.push(left);
        for part in &mut self.parts {
            part.triangles = moved[part.triangles.start]..moved[part.triangles.end];
        }
        self.parts.retain(|part| !part.triangles.is_empty());
    }

    /// Texture coordinates for a mesh with pictures, and tangents if one of them has normals.
    fn vertices(&mut self, maps: &[MtlMaps]) {
        if maps.iter().all(MtlMaps::is_empty) {
            self.mesh.triangles.iter_mut().for_each(|triangle| triangle.vertices = [0; 3]);
            return;
        }
        let vertex = |uv: &Vec2| Vertex { uv: [*uv; 2], ..Vertex::default() };
        // The last one is for corners without.
        let none = self.texture.len() as u32;
        self.mesh.vertices = self.texture.iter().map(vertex).chain([Vertex::default()]).collect();
        for index in self.mesh.triangles.iter_mut().flat_map(|triangle| &mut triangle.vertices) {
            *index = (*index).min(none);
        }
        if maps.iter().any(|maps| maps.normal.is_some()) {
            tangents::fill(&mut self.mesh, 0);
        }
    }

    /// Gives every name that a triangle uses its material, in the order of first use.
    fn resolve_materials(&mut self) -> (Vec<MtlMaterial>, Vec<MtlMaps>) {
        let mut pictures = Pictures::default();
        let mut maps = Vec::new();
        const UNUSED: u32 = u32::MAX;
        let mut index_of = vec![UNUSED; self.material_names.len()];
        let mut materials = Vec::new();
        for triangle in &mut self.mesh.triangles {
            let name_index = triangle.material as usize;
            if index_of[name_index] == UNUSED {
                index_of[name_index] = materials.len() as u32;
                let (name, line) = &self.material_names[name_index];
                let (material, of) = match self.library.remove(name) {
                    Some((material, place)) => {
                        let (file, folder) = &*place;
                        let mut said = Warnings::new(file);
                        let mut say = |line, text| said.push(line, text);
                        let of = pictures.of(&material, folder, self.loader, &mut say);
                        self.warnings.append(said.finish());
                        (material, of)
                    }
                    None if name_index == 0 => (MtlMaterial::default(), MtlMaps::default()),
                    None => {
                        self.warnings.push(*line, format!("no library has the material `{name}`: grey"));
                        (MtlMaterial { name: name.clone(), ..MtlMaterial::default() }, MtlMaps::default())
                    }
                };
                materials.push(material);
                maps.push(of);
            }
            triangle.material = index_of[name_index];
        }
        (materials, maps)
    }
}

/// What the system said, without the number of the error, which says nothing to a reader.
fn system_message(error: &io::Error) -> String {
    let text = error.to_string();
    match text.find(" (os error") {
        Some(end) => text[..end].to_lowercase(),
        None => text,
    }
}

/// Up to `N` numbers and how many there are; a count above `N` only says "too many".
fn numbers<const N: usize>(place: Place<'_>, rest: &[u8]) -> Result<([f32; N], usize), Error> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    for word in words(rest) {
        let number = place.number(word)?;
        if let Some(slot) = numbers.get_mut(count) {
            *slot = number;
        }
        count += 1;
    }
    Ok((numbers, count))
}

/// An index of a corner, turned into one from 0. `known` is how many `kind` stand above.
fn index(place: Place<'_>, word: &[u8], piece: &[u8], known: usize, kind: &str) -> Result<u32, Error> {
    let (negative, digits) = match piece.strip_prefix(b"-") {
        Some(digits) => (true, digits),
        None => (false, piece),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(place.error(format!("`{}` is not a corner", shown(word)), FACE_HELP));
    }
    // More digits than any file can count to stay out of range instead of wrapping around.
    let number = digits
        .iter()
        .fold(0_usize, |number, digit| number.saturating_mul(10).saturating_add(usize::from(digit - b'0')));
    if number == 0 {
        let expected = format!("the first `{kind}` is 1, the newest is -1");
        return Err(place.error(format!("index 0 in `{}`", shown(word)), expected));
    }
    if number > known || known >= MISSING as usize {
        let expected = format!("{known} `{kind}` stand above this line");
        return Err(place.error(format!("index {} in `{}` is out of range", shown(piece), shown(word)), expected));
    }
    Ok(if negative { known - number } else { number - 1 } as u32)
}
