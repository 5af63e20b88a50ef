//! glTF 2.0: `.gltf` with its buffers and pictures, and `.glb`.
//!
//! ```no_run
//! let scene = lobe_scene::gltf::load("helmet.glb".as_ref())?;
//! for warning in &scene.warnings {
//!     eprintln!("warning: {warning}");
//! }
//! # Ok::<(), lobe_scene::Error>(())
//! ```
//!
//! What is read: triangles, strips and fans, indexed or not, with normals, tangents, two sets of texture coordinates and
//! colours; sparse, normalised and quantised accessors (`KHR_mesh_quantization`); the scene graph, whose instances are
//! copied; perspective and orthographic cameras, a [`View`] each; `KHR_lights_punctual`; materials with their textures
//! ([`GltfMaterial`](crate::GltfMaterial)), `KHR_texture_transform`, and the extensions `ior`, `specular`, `clearcoat`,
//! `sheen`, `anisotropy`, `emissive_strength` and `unlit` of `KHR_materials`. Anything else is named in a warning, and the
//! rest is shaded.
//!
//! Numbers that a file states are believed only as far as there are bytes for them; paths that lead out of the file's
//! folder are not followed.

mod accessor;
mod geometry;
mod material;

use crate::camera::Camera;
use crate::error::{Error, Warnings};
use crate::files;
use crate::picture::Budget;
use crate::scene::{Light, Scene, View};
use ::gltf::{Document, json};
use accessor::Buffers;
use base64::Engine as _;
use glam::{DMat4, DVec3, Vec3};
use lobe::Rgb;
use std::io;
use std::path::{Component, Path};

/// The most bytes of a file, of its buffers together, and of a picture: 1 GiB.
pub const MAX_BYTES: u64 = 1 << 30;
/// The most triangles of a scene, copies counted: a small file may ask for many copies, and a renderer takes a few hundred
/// bytes for each.
pub const MAX_TRIANGLES: usize = 5_000_000;
/// The deepest scene graph.
const MAX_DEPTH: usize = 256;

/// What is wrong, without the name of the file.
#[derive(Debug)]
struct Problem(String);

/// Gives the bytes of a file that is named relative to the glTF file, or says why not. At most [`MAX_BYTES`].
pub type Loader<'a> = &'a mut dyn FnMut(&str) -> io::Result<Vec<u8>>;

/// Reads a `.gltf` or `.glb` file, and what it names.
///
/// # Errors
/// [`Error::Read`] when a file cannot be read, [`Error::Json`] and [`Error::Content`] when it is wrong.
pub fn load(path: &Path) -> Result<Scene, Error> {
    let bytes = files::read(path, MAX_BYTES).map_err(|source| Error::read(path, source))?;
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    parse(&bytes, &path.display().to_string(), &mut |name| files::read(&folder.join(name), MAX_BYTES))
}

/// Reads a glTF file in memory, text or binary. `file` is its name in messages.
///
/// # Errors
/// As for [`load`].
pub fn parse(bytes: &[u8], file: &str, loader: Loader<'_>) -> Result<Scene, Error> {
    let content = |Problem(problem): Problem| Error::Content { file: file.to_owned(), problem };
    let (text, blob) = split(bytes).map_err(content)?;
    let root = read_json(text, file)?;
    let mut warnings = Warnings::new(file);
    check(&root, &mut warnings).map_err(content)?;
    let document = Document::from_json_without_validation(root);
    let buffers = read_buffers(&document, blob, loader).map_err(content)?;
    let mut reader = Reader {
        document: &document,
        buffers,
        scene: Scene::default(),
        warnings,
        triangles: 0,
        points: 0,
        pictures: Budget::default(),
    };
    reader.read(loader).map_err(content)?;
    let Reader { mut scene, warnings, .. } = reader;
    if scene.triangle_count() == 0 {
        let problem = "no triangle with an area; a glTF file needs a scene whose nodes have meshes".to_owned();
        return Err(Error::Content { file: file.to_owned(), problem });
    }
    scene.warnings = warnings.finish();
    Ok(scene)
}

/// The JSON of a file, and the first buffer if it is binary.
fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Problem> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    let word = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
        word.map(u32::from_le_bytes)
            .ok_or_else(|| Problem(format!("ends after {} bytes, inside a header", bytes.len())))
    };
    match word(4)? {
        2 => {}
        version => return Err(Problem(format!("is a binary glTF file of version {version}; version 2 is read"))),
    }
    let stated = word(8)? as usize;
    if stated > bytes.len() {
        return Err(Problem(format!("says that it has {stated} bytes, and has {}: it was cut off", bytes.len())));
    }
    let (mut text, mut blob, mut at) = (None, None, 12);
    while at + 8 <= stated {
        let (length, kind) = (word(at)? as usize, word(at + 4)?.to_le_bytes());
        let chunk = bytes.get(at + 8..(at + 8).saturating_add(length)).ok_or_else(|| {
            Problem(format!("has a chunk of {length} bytes at byte {at}, and {} bytes in all", bytes.len()))
        })?;
        match &kind {
            b"JSON" if text.is_none() => text = Some(chunk),
            b"BIN\0" if blob.is_none() => blob = Some(chunk),
            // Others are to be skipped.
            _ => {}
        }
        at += 8 + length;
    }
    let text = text.ok_or_else(|| Problem("has no chunk of JSON".to_owned()))?;
    Ok((text, blob))
}

fn read_json(text: &[u8], file: &str) -> Result<json::Root, Error> {
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    serde_json::from_slice(text).map_err(|error| {
        let message = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        let problem = message.strip_suffix(&place).unwrap_or(&message);
        let problem = format!("{problem}; a .gltf file is JSON, and a .glb file begins with the letters glTF");
        Error::Json { file: file.to_owned(), line: error.line().max(1), column: error.column().max(1), problem }
    })
}

/// The extensions that are read, or that change nothing here.
const KNOWN: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "EXT_texture_webp",
];

/// Everything that the reader of the document relies on: indices that exist, words that are known.
fn check(root: &json::Root, warnings: &mut Warnings) -> Result<(), Problem> {
    use json::mesh::Semantic;
    use json::validation::{Checked, Error as Fault, Validate as _};
    // The validation below looks these up before it has compared them (found by fuzzing gltf-json 1.4.1; the file
    // `positions-nowhere.gltf` of the corpus panics there without this).
    for (mesh, primitives) in root.meshes.iter().map(|mesh| &mesh.primitives).enumerate() {
        for (part, primitive) in primitives.iter().enumerate() {
            let positions = primitive.attributes.get(&Checked::Valid(Semantic::Positions)).map(json::Index::value);
            if let Some(index) = positions.filter(|index| *index >= root.accessors.len()) {
                let (path, count) = (format!("meshes[{mesh}].primitives[{part}]"), root.accessors.len());
                return Err(Problem(format!("the positions of `{path}` are accessor {index} of {count}")));
            }
        }
    }
    // A camera has the numbers of its kind, not just of any (`camera-kind.gltf`).
    for (index, camera) in root.cameras.iter().enumerate() {
        use json::camera::Type;
        let (kind, there) = match camera.type_ {
            Checked::Valid(Type::Perspective) => ("perspective", camera.perspective.is_some()),
            Checked::Valid(Type::Orthographic) => ("orthographic", camera.orthographic.is_some()),
            Checked::Invalid => continue,
        };
        if !there {
            return Err(Problem(format!("camera {index} is {kind}, and has no `{kind}`")));
        }
    }
    let mut fault = None;
    root.validate(root, json::Path::new, &mut |path, error| {
        let path = path().to_string();
        // Extensions are looked at below; bounds of accessors are not needed.
        let harmless = error == Fault::Unsupported
            || error == Fault::Missing && (path.ends_with(".min") || path.ends_with(".max"));
        if fault.is_none() && !harmless {
            let what = match error {
                Fault::IndexOutOfBounds => "names something that is not there",
                Fault::Invalid => "has a value that glTF 2.0 does not know",
                Fault::Missing => "is missing",
                Fault::Oversize => "is larger than this machine's memory",
                Fault::Unsupported => "is not supported",
            };
            fault = Some(Problem(format!("`{path}` {what}")));
        }
    });
    if let Some(fault) = fault {
        return Err(fault);
    }
    for name in root.extensions_used.iter().filter(|name| !KNOWN.contains(&name.as_str())) {
        let needed = if root.extensions_required.contains(name) { ", which the file says it needs" } else { "" };
        warnings.push(0, format!("the extension {name} is not supported{needed}; the rest is shaded without it"));
    }
    Ok(())
}

/// The bytes of all buffers.
fn read_buffers(document: &Document, blob: Option<&[u8]>, loader: Loader<'_>) -> Result<Buffers, Problem> {
    let mut total = 0;
    let mut all = Vec::new();
    for buffer in document.buffers() {
        let index = buffer.index();
        let bytes = match buffer.source() {
            ::gltf::buffer::Source::Bin => {
                let blob =
                    blob.ok_or_else(|| Problem(format!("buffer {index} has no URI, and the file no binary part")))?;
                blob.to_vec()
            }
            ::gltf::buffer::Source::Uri(uri) => {
                fetch(uri, loader).map_err(|why| Problem(format!("buffer {index}: {why}")))?
            }
        };
        if bytes.len() < buffer.length() {
            let (stated, found) = (buffer.length(), bytes.len());
            return Err(Problem(format!("buffer {index} should have {stated} bytes, and has {found}: it was cut off")));
        }
        total += bytes.len() as u64;
        if total > MAX_BYTES {
            return Err(Problem(format!("its buffers have more than {MAX_BYTES} bytes together")));
        }
        all.push(bytes);
    }
    Ok(all)
}

/// What a URI stands for: data, or a file beside this one.
fn fetch(uri: &str, loader: Loader<'_>) -> Result<Vec<u8>, String> {
    let short: String = uri.chars().take(60).collect();
    if let Some(data) = uri.strip_prefix("data:") {
        let (head, data) = data.split_once(',').ok_or_else(|| format!("`{short}` has no comma before its data"))?;
        return match head.ends_with(";base64") {
            true => base64::engine::general_purpose::STANDARD
                .decode(data)
                .map_err(|error| format!("the data of `{short}` is not base64: {error}")),
            false => Ok(percent_encoding::percent_decode_str(data).collect()),
        };
    }
    if uri.contains("://") {
        return Err(format!("`{short}` is an address; only files beside this one are read"));
    }
    let name = percent_encoding::percent_decode_str(uri);
    let name = name.decode_utf8().map_err(|_| format!("the name `{short}` is not UTF-8"))?;
    let inside = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
    if name.contains(['\\', '\0']) || !Path::new(name.as_ref()).components().all(inside) {
        return Err(format!("`{short}` leads out of the folder of this file; only files in it are read"));
    }
    loader(&name).map_err(|error| format!("cannot read `{short}`: {error}"))
}

/// A file being read.
struct Reader<'d> {
    document: &'d Document,
    buffers: Buffers,
    scene: Scene,
    warnings: Warnings,
    /// How many there are so far, with all copies.
    triangles: usize,
    points: usize,
    pictures: Budget,
}

impl Reader<'_> {
    fn read(&mut self, loader: Loader<'_>) -> Result<(), Problem> {
        self.materials(loader)?;
        let document = self.document;
        let roots: Vec<usize> = match document.default_scene().or_else(|| document.scenes().next()) {
            Some(scene) => scene.nodes().map(|node| node.index()).collect(),
            // A file without a scene is a library; all of it is shown.
            None => {
                let children: std::collections::HashSet<usize> = document
                    .nodes()
                    .flat_map(|node| node.children().map(|child| child.index()).collect::<Vec<_>>())
                    .collect();
                document.nodes().map(|node| node.index()).filter(|index| !children.contains(index)).collect()
            }
        };
        let nodes: Vec<_> = document.nodes().collect();
        let mut seen = vec![false; nodes.len()];
        let mut waiting: Vec<_> = roots.into_iter().rev().map(|index| (index, DMat4::IDENTITY, 0)).collect();
        let mut lights = Vec::new();
        while let Some((index, parent, depth)) = waiting.pop() {
            let Some(node) = nodes.get(index) else { continue };
            if std::mem::replace(&mut seen[index], true) {
                return Err(Problem(format!("node {index} is reached twice; the nodes of a scene form trees")));
            }
            if depth > MAX_DEPTH {
                return Err(Problem(format!("node {index} is more than {MAX_DEPTH} nodes below a root")));
            }
            let world = parent * transform(node);
            if !world.is_finite() {
                return Err(Problem(format!("the transform of node {index} is not finite")));
            }
            if let Some(mesh) = node.mesh() {
                if node.skin().is_some() {
                    self.once(format!(
                        "{} has a skin; it is shown at rest",
                        name_of("mesh", mesh.name(), mesh.index())
                    ));
                }
                self.mesh(&mesh, world)?;
            }
            if let Some(camera) = node.camera() {
                self.camera(&camera, node.name(), world);
            }
            if let Some(light) = node.light() {
                lights.extend(self.light(&light, world));
            }
            waiting.extend(node.children().map(|child| (child.index(), world, depth + 1)));
        }
        if self.scene.views.is_empty() {
            self.scene.views.push(View::default());
        }
        for view in &mut self.scene.views {
            view.lights = (!lights.is_empty()).then(|| lights.clone());
        }
        if document.animations().next().is_some() {
            self.once("its animations are not played; it is shown at rest".to_owned());
        }
        Ok(())
    }

    /// A warning, once.
    fn once(&mut self, text: String) {
        if !self.warnings.contains(&text) {
            self.warnings.push(0, text);
        }
    }

    fn camera(&mut self, camera: &::gltf::Camera<'_>, node: Option<&str>, world: DMat4) {
        use ::gltf::camera::Projection;
        let name = camera.name().or(node).map_or_else(|| format!("camera {}", camera.index()), str::to_owned);
        let eye = world.transform_point3(DVec3::ZERO).as_vec3();
        let forward = world.transform_vector3(DVec3::NEG_Z).normalize_or(DVec3::NEG_Z).as_vec3();
        let up = world.transform_vector3(DVec3::Y).normalize_or(DVec3::Y).as_vec3();
        let (fov_y_degrees, height) = match camera.projection() {
            Projection::Perspective(lens) => (lens.yfov().to_degrees(), None),
            Projection::Orthographic(lens) => (35.0, Some(2.0 * lens.ymag().abs())),
        };
        // Any point ahead; one as far as the eye is from the origin keeps the most digits of the direction.
        let target = eye + forward * eye.length().max(1.0);
        let camera = Camera { eye, target, up, fov_y_degrees, height };
        if camera.rays(1, 1).is_err() {
            self.once(format!("the camera `{name}` sees nothing, and is left out"));
            return;
        }
        let taken = self.scene.views.iter().filter(|view| view.name == name).count();
        let name = if taken == 0 { name } else { format!("{name} {}", self.scene.views.len()) };
        self.scene.views.push(View { name, camera: Some(camera), ..View::default() });
    }

    /// `KHR_lights_punctual`: candela and lux are taken as W·sr⁻¹ and W·m⁻².
    fn light(&mut self, light: &::gltf::khr_lights_punctual::Light<'_>, world: DMat4) -> Option<Light> {
        use ::gltf::khr_lights_punctual::Kind;
        let intensity = Rgb::from(light.color()) * light.intensity();
        let position = world.transform_point3(DVec3::ZERO).as_vec3();
        let direction = world.transform_vector3(DVec3::NEG_Z).normalize_or(DVec3::NEG_Z).as_vec3();
        let parts = <[f32; 3]>::from(intensity);
        let range = light.range().unwrap_or(f32::INFINITY);
        if !parts.iter().all(|part| part.is_finite() && *part >= 0.0) || range.is_nan() || range <= 0.0 {
            self.once(format!("light {} has a negative colour or range, and is left out", light.index()));
            return None;
        }
        Some(match light.kind() {
            Kind::Directional => Light::Directional { to_light: -direction, irradiance: intensity },
            Kind::Point => Light::Punctual { position, intensity, range, cone: None },
            Kind::Spot { inner_cone_angle, outer_cone_angle } => {
                let cone = crate::scene::Cone { direction, inner: inner_cone_angle, outer: outer_cone_angle };
                Light::Punctual { position, intensity, range, cone: Some(cone) }
            }
        })
    }
}

/// The transform of a node. Of a matrix all sixteen numbers, though the last row ought to be `0 0 0 1`.
fn transform(node: &::gltf::Node<'_>) -> DMat4 {
    match node.transform() {
        ::gltf::scene::Transform::Matrix { matrix } => glam::Mat4::from_cols_array_2d(&matrix).as_dmat4(),
        ::gltf::scene::Transform::Decomposed { translation, rotation, scale } => {
            let rotation = glam::Quat::from_array(rotation).as_dquat();
            // A file written with few digits has rotations that are nearly of unit length.
            let length = rotation.length();
            let rotation = if length > 0.0 { rotation / length } else { glam::DQuat::IDENTITY };
            DMat4::from_scale_rotation_translation(
                Vec3::from(scale).as_dvec3(),
                rotation,
                Vec3::from(translation).as_dvec3(),
            )
        }
    }
}

/// `mesh \`name\``, or `mesh 3` if it has none.
fn name_of(what: &str, name: Option<&str>, index: usize) -> String {
    name.map_or_else(|| format!("{what} {index}"), |name| format!("{what} `{name}`"))
}
