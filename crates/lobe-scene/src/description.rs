//! A scene from a file: a model alone, glTF or OBJ, or a small JSON description that names one.

use crate::camera::Camera;
use crate::error::Error;
use crate::files;
use crate::gltf;
use crate::material::ShadingModel;
use crate::mtl;
use crate::obj;
use crate::scene::{Background, Light, Scene, View};
use glam::Vec3;
use lobe::Rgb;
use serde::Deserialize;
use std::collections::{BTreeMap, HashSet};
use std::io;
use std::path::Path;

/// The longest description that is read: 64 MiB.
const MAX_BYTES: u64 = 64 << 20;

/// What a caller wants other than a file says.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadOptions {
    /// How `Ks` and `Ns` become a highlight. `None`: as the description says, else Blinn-Torrance.
    pub shading_model: Option<ShadingModel>,
    /// The crease angle of [`obj::Options`]. `None`: as the description says, else 30.
    pub crease_degrees: Option<f32>,
}

/// Reads a scene: a `.gltf` or `.glb` file, an `.obj` file, seen in the default view, or a `.json` description.
///
/// # Errors
/// Any error of reading; [`Error::UnknownFormat`] for another ending.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, Error> {
    let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
    let file = path.display().to_string();
    if path.is_dir() {
        return Err(Error::read(path, io::Error::other("it is a folder; name a .gltf, .glb, .obj or .json file")));
    }
    match ending.as_deref() {
        Some("obj") => {
            let model = obj::load(path, &obj_options(options, None))?;
            Ok(Scene::from_model(model, options.shading_model.unwrap_or_default()))
        }
        Some("json") => {
            let text = files::read(path, MAX_BYTES)
                .and_then(|bytes| String::from_utf8(bytes).map_err(|_| io::Error::other("it is not text in UTF-8")))
                .map_err(|source| Error::read(path, source))?;
            let folder = path.parent().unwrap_or(Path::new(""));
            // The model comes first, then its libraries.
            let mut limit = obj::MAX_BYTES;
            let mut loader =
                |name: &str| files::read(&folder.join(name), std::mem::replace(&mut limit, mtl::MAX_BYTES));
            parse(&text, &file, &mut loader, options)
        }
        Some("gltf" | "glb") => gltf::load(path),
        _ => Err(Error::UnknownFormat { path: path.to_owned(), expected: "scenes end in .gltf, .glb, .obj or .json" }),
    }
}

/// Reads the text of a JSON description. `loader` gives the files that it and its model name, by a path relative to
/// the description.
///
/// ```json
/// {
///   "obj": "model.obj",
///   "shading_model": "blinn-torrance",
///   "crease_degrees": 30,
///   "camera": {"eye": [0, 1, 5], "target": [0, 1, 0], "up": [0, 1, 0], "fov_y_degrees": 40},
///   "lights": [
///     {"point": {"position": [-2, 4, 3], "intensity": [90, 90, 90], "radius": 0.2}},
///     {"directional": {"to_light": [0, 1, 0], "irradiance": [0.5, 0.5, 0.5]}},
///     {"ambient": [0.1, 0.1, 0.1]}
///   ],
///   "background": {"bottom": [0.2, 0.2, 0.2], "top": [0.5, 0.6, 0.8]},
///   "exposure": 0,
///   "materials": {"copper": {"lobes": [{"model": "microfacet", "alpha": 0.2, "fresnel": {"conductor": {"metal": "copper"}}}]},
///                 "*": "ngan:pvc/ward"},
///   "views": [{"name": "front"}, {"name": "top", "camera": {"eye": [0, 9, 0], "target": [0, 0, 0], "up": [0, 0, -1]}}]
/// }
/// ```
///
/// Only the model is required, `obj` or `gltf`; its path is relative to the JSON file. The cameras and lights of a glTF
/// file are taken where the description has none. `materials` replaces those of the model by lobes of
/// [`lobe_models`], or by a preset; `*` is all that are not named. `background` may be one colour. What a view does not
/// say is taken from the description itself; without `views` there is one, named `default`. A misspelt word is an
/// error, not ignored. Colours are linear; intensity is in W·sr⁻¹, irradiance in W·m⁻².
///
/// ```
/// use lobe_scene::{LoadOptions, parse_description};
///
/// let mut files = |name: &str| match name {
///     "a.obj" => Ok(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec()),
///     _ => Err(std::io::ErrorKind::NotFound.into()),
/// };
/// let scene = parse_description(r#"{"obj": "a.obj"}"#, "a.json", &mut files, &LoadOptions::default())?;
/// assert_eq!(scene.views[0].name, "default");
///
/// let wrong = parse_description("{\"obj\": \"a.obj\",\n \"lihgts\": []}", "a.json", &mut files, &LoadOptions::default());
/// assert!(wrong.unwrap_err().to_string().starts_with("a.json:2:9: unknown field `lihgts`"));
/// # Ok::<(), lobe_scene::Error>(())
/// ```
///
/// # Errors
/// [`Error::Json`] with line and column, and all errors of reading the model.
pub fn parse(
    text: &str,
    file: &str,
    loader: &mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
    options: &LoadOptions,
) -> Result<Scene, Error> {
    // Editors of Windows put a byte order mark at the start.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let right = "a description is an object such as {\"obj\": \"model.obj\"}";
    if let Some(at) = text.find(|c: char| !c.is_ascii_whitespace()).filter(|&at| !text[at..].starts_with('{')) {
        let line = text[..at].matches('\n').count() + 1;
        let column = text[..at].rsplit('\n').next().map_or(0, str::len) + 1;
        let problem = format!("expected an object; {right}");
        return Err(Error::Json { file: file.to_owned(), line, column, problem });
    }
    let description: Description = serde_json::from_str(text).map_err(|error| {
        // serde_json ends its message with the place, which stands at the front here.
        let message = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        let mut problem = message.strip_suffix(&place).unwrap_or(&message).to_owned();
        if !error.is_data() {
            problem = format!("{problem}; {right}");
        }
        let (line, column) = (error.line().max(1), error.column().max(1));
        Error::Json { file: file.to_owned(), line, column, problem }
    })?;
    let mut names = HashSet::new();
    if let Some(twice) = description.views.iter().flatten().find(|view| !names.insert(view.name.as_str())) {
        let what = format!("{file}: the name of a view");
        return Err(Error::setting(
            what,
            format!("`{}`", twice.name),
            "another view has it already; give each its own",
        ));
    }
    let (model, is_gltf) = match (&description.obj, &description.gltf) {
        (Some(model), None) => (model, false),
        (None, Some(model)) => (model, true),
        (both, _) => {
            let problem = if both.is_some() { "both `obj` and `gltf`" } else { "neither `obj` nor `gltf`" };
            let problem = format!("{problem}; a description names one model, such as {{\"obj\": \"model.obj\"}}");
            return Err(Error::Json { file: file.to_owned(), line: 1, column: 1, problem });
        }
    };
    let path = Path::new(model);
    let shown = Path::new(file).with_file_name(path);
    let content = loader(model).map_err(|source| Error::read(&shown, source))?;
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let mut beside = |name: &str| loader(&folder.join(name).to_string_lossy());
    let scene = if is_gltf {
        let mut scene = gltf::parse(&content, &shown.display().to_string(), &mut beside)?;
        let described = description.views(scene.views.first());
        // Its own cameras stay, after what the description says.
        let names: HashSet<String> = described.iter().map(|view| view.name.clone()).collect();
        let own = std::mem::replace(&mut scene.views, described);
        scene.views.extend(own.into_iter().filter(|view| view.camera.is_some() && !names.contains(&view.name)));
        scene
    } else {
        let obj_options = obj_options(options, description.crease_degrees.map(|Crease(degrees)| degrees));
        let model = obj::parse(content, &shown.display().to_string(), &mut beside, &obj_options)?;
        let shading = options.shading_model.or(description.shading_model).unwrap_or_default();
        let mut scene = Scene::from_model(model, shading);
        scene.views = description.views(None);
        scene
    };
    for name in scene.views.iter().flat_map(|view| view.materials.keys()) {
        if name != View::ALL && scene.materials.iter().all(|material| material.name != *name) {
            let known: Vec<_> = scene.materials.iter().map(|material| material.name.as_str()).collect();
            let near = lobe_models::nearest(name, known, 3).join("`, `");
            let expected = format!("the model has none of that name; the nearest are `{near}`, and `*` is all");
            return Err(Error::setting(format!("{file}: the name of a material"), format!("`{name}`"), expected));
        }
    }
    Ok(scene)
}

fn obj_options(options: &LoadOptions, described: Option<f32>) -> obj::Options {
    let default = obj::Options::default();
    obj::Options { crease_degrees: options.crease_degrees.or(described).unwrap_or(default.crease_degrees) }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Description {
    obj: Option<String>,
    gltf: Option<String>,
    shading_model: Option<ShadingModel>,
    crease_degrees: Option<Crease>,
    camera: Option<CameraText>,
    lights: Option<Vec<LightText>>,
    background: Option<BackgroundText>,
    exposure: Option<Exposure>,
    #[serde(default)]
    materials: BTreeMap<String, lobe_models::Material>,
    views: Option<Vec<ViewText>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ViewText {
    name: String,
    camera: Option<CameraText>,
    lights: Option<Vec<LightText>>,
    background: Option<BackgroundText>,
    exposure: Option<Exposure>,
    #[serde(default)]
    materials: BTreeMap<String, lobe_models::Material>,
}

impl Description {
    /// The views; what they do not say about camera and lights is that of `model`.
    fn views(self, model: Option<&View>) -> Vec<View> {
        let general = View {
            name: "default".to_owned(),
            camera: self.camera.map(|CameraText(camera)| camera).or(model.and_then(|view| view.camera)),
            lights: self.lights.map(lights).or_else(|| model.and_then(|view| view.lights.clone())),
            background: self.background.map_or(View::default().background, Background::from),
            exposure: self.exposure.map_or(0.0, |Exposure(stops)| stops),
            materials: self.materials,
        };
        match self.views {
            Some(views) if !views.is_empty() => views.into_iter().map(|view| view.over(&general)).collect(),
            _ => vec![general],
        }
    }
}

impl ViewText {
    /// This view, with the rest taken from the description itself.
    fn over(self, general: &View) -> View {
        View {
            name: self.name,
            camera: self.camera.map(|CameraText(camera)| camera).or(general.camera),
            lights: self.lights.map(lights).or_else(|| general.lights.clone()),
            background: self.background.map_or(general.background, Background::from),
            exposure: self.exposure.map_or(general.exposure, |Exposure(stops)| stops),
            // The view's own are taken before those of the description.
            materials: general.materials.clone().into_iter().chain(self.materials).collect(),
        }
    }
}

/// A colour that light can have. Checked while reading, so that an error knows its line.
#[derive(Deserialize, Clone, Copy)]
#[serde(try_from = "[f32; 3]")]
struct Colour(Rgb);

impl TryFrom<[f32; 3]> for Colour {
    type Error = &'static str;
    fn try_from(colour: [f32; 3]) -> Result<Self, Self::Error> {
        match colour.iter().all(|part| part.is_finite() && *part >= 0.0) {
            true => Ok(Self(colour.into())),
            false => Err("a colour has three finite parts, none negative"),
        }
    }
}

/// A point or direction.
#[derive(Deserialize, Clone, Copy)]
#[serde(try_from = "[f32; 3]")]
struct Triple(Vec3);

impl TryFrom<[f32; 3]> for Triple {
    type Error = &'static str;
    fn try_from(triple: [f32; 3]) -> Result<Self, Self::Error> {
        match triple.iter().all(|part| part.is_finite()) {
            true => Ok(Self(triple.into())),
            false => Err("a point has three finite coordinates"),
        }
    }
}

/// A number within limits.
macro_rules! limited {
    ($name:ident, $range:expr, $expected:literal) => {
        #[derive(Deserialize, Clone, Copy)]
        #[serde(try_from = "f32")]
        struct $name(f32);

        impl TryFrom<f32> for $name {
            type Error = &'static str;
            fn try_from(value: f32) -> Result<Self, Self::Error> {
                if $range.contains(&value) { Ok(Self(value)) } else { Err($expected) }
            }
        }
    };
}

limited!(Crease, (0.0..=180.0), "crease_degrees lies between 0 and 180");
limited!(Exposure, (-100.0..=100.0), "exposure lies between -100 and 100 stops");
limited!(Radius, (0.0..=1e9), "a radius lies between 0 and 1e9");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraParts {
    eye: Triple,
    target: Triple,
    #[serde(default = "up")]
    up: Triple,
    #[serde(default = "fov")]
    fov_y_degrees: f32,
}

fn up() -> Triple {
    Triple(Vec3::Y)
}

fn fov() -> f32 {
    35.0
}

#[derive(Deserialize, Clone, Copy)]
#[serde(try_from = "CameraParts")]
struct CameraText(Camera);

impl TryFrom<CameraParts> for CameraText {
    type Error = String;
    fn try_from(parts: CameraParts) -> Result<Self, Self::Error> {
        let camera = Camera {
            eye: parts.eye.0,
            target: parts.target.0,
            up: parts.up.0,
            fov_y_degrees: parts.fov_y_degrees,
            height: None,
        };
        camera.rays(1, 1).map(|_| Self(camera)).map_err(|error| error.to_string())
    }
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum LightText {
    Point {
        position: Triple,
        intensity: Colour,
        #[serde(default = "no_radius")]
        radius: Radius,
    },
    Directional {
        to_light: Direction,
        irradiance: Colour,
    },
    Ambient(Colour),
}

fn no_radius() -> Radius {
    Radius(0.0)
}

#[derive(Deserialize, Clone, Copy)]
#[serde(try_from = "[f32; 3]")]
struct Direction(Vec3);

impl TryFrom<[f32; 3]> for Direction {
    type Error = &'static str;
    fn try_from(triple: [f32; 3]) -> Result<Self, Self::Error> {
        let direction = Vec3::from(triple).as_dvec3().try_normalize();
        direction.map(|unit| Self(unit.as_vec3())).ok_or("a direction is finite and not [0, 0, 0]")
    }
}

fn lights(list: Vec<LightText>) -> Vec<Light> {
    list.into_iter()
        .map(|light| match light {
            LightText::Point { position, intensity, radius } => {
                Light::Point { position: position.0, intensity: intensity.0, radius: radius.0 }
            }
            LightText::Directional { to_light, irradiance } => {
                Light::Directional { to_light: to_light.0, irradiance: irradiance.0 }
            }
            LightText::Ambient(radiance) => Light::Ambient(radiance.0),
        })
        .collect()
}

#[derive(Deserialize, Clone, Copy)]
#[serde(untagged, expecting = "a background is a colour [r, g, b] or {\"bottom\": [r, g, b], \"top\": [r, g, b]}")]
enum BackgroundText {
    Solid(Colour),
    Gradient(GradientText),
}

#[derive(Deserialize, Clone, Copy)]
#[serde(deny_unknown_fields)]
struct GradientText {
    bottom: Colour,
    top: Colour,
}

impl From<BackgroundText> for Background {
    fn from(text: BackgroundText) -> Self {
        match text {
            BackgroundText::Solid(colour) => Self::Solid(colour.0),
            BackgroundText::Gradient(GradientText { bottom, top }) => Self::Gradient { bottom: bottom.0, top: top.0 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Scene, Error> {
        let mut files = |name: &str| match name {
            "sub/a.obj" => Ok(b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n".to_vec()),
            "sub/a.mtl" => Ok(b"newmtl m\nKd 0.5\nKs 0.5\nNs 3\n".to_vec()),
            "bad.obj" => Ok(b"f 1 2 3\n".to_vec()),
            _ => Err(io::ErrorKind::NotFound.into()),
        };
        parse(text, "dir/s.json", &mut files, &LoadOptions::default())
    }

    #[test]
    fn materials_are_replaced_by_name() -> Result<(), Error> {
        let scene = read(
            r#"{"obj": "sub/a.obj", "materials": {"*": "gold"},
                "views": [{"name": "a"}, {"name": "b", "materials": {"m": {"lobes": [
                    {"model": "lambert", "albedo": 0.25}, {"model": "microfacet", "alpha": 0.5, "f0": 0.5}]}}}]}"#,
        )?;
        let lobes = |view: &str| -> Result<Vec<&'static str>, Error> {
            let materials = scene.view(view)?.materials_of(&scene.materials);
            assert_eq!(materials[0].name, "m");
            Ok(materials[0].surface.lobes().iter().map(|lobe| lobe.model).collect())
        };
        assert_eq!(lobes("a")?, ["blinn-phong"]);
        assert_eq!(lobes("b")?, ["lambert", "microfacet"]);
        let ambient = scene.view("b")?.materials_of(&scene.materials)[0].ambient.r;
        assert!(ambient > 0.5 && ambient < 0.8, "{ambient}");
        for (text, expected) in [
            (
                r#"{"obj": "sub/a.obj", "materials": {"n": "gold"}}"#,
                "dir/s.json: the name of a material is `n`; the model has none of that name; the nearest are `m`, and `*` is all",
            ),
            (
                r#"{"obj": "sub/a.obj", "materials": {"m": {"lobes": [{"model": "phong", "ks": 1, "q": -1}]}}}"#,
                "dir/s.json:1:86: lobes[0]: `q` is -1.0; a number from 0 to 1000000",
            ),
            (r#"{"obj": "sub/a.obj", "materials": {"m": "golt"}}"#, "unknown preset `golt`; the nearest are gold, "),
        ] {
            let error = read(text).map(|_| ()).expect_err("wrong").to_string();
            assert!(error.contains(expected), "{error}");
        }
        Ok(())
    }

    #[test]
    fn views_inherit_and_paths_are_relative() -> Result<(), Error> {
        let scene = read(
            r#"{"obj": "sub/a.obj", "shading_model": "phong", "exposure": 1,
                "camera": {"eye": [0, 0, 5], "target": [0, 0, 0]},
                "lights": [{"ambient": [1, 1, 1]}], "background": [0.5, 0.5, 0.5],
                "views": [{"name": "a"}, {"name": "b", "exposure": 0,
                    "lights": [{"directional": {"to_light": [0, 2, 0], "irradiance": [1, 1, 1]}},
                               {"point": {"position": [1, 2, 3], "intensity": [1, 0, 0]}}],
                    "background": {"bottom": [0, 0, 0], "top": [1, 1, 1]}}]}"#,
        )?;
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        assert_eq!(scene.materials[0].surface.lobes()[1].model, "phong-highlight");
        let (a, b) = (scene.view("a")?, scene.view("b")?);
        assert_eq!((a.exposure, b.exposure), (1.0, 0.0));
        assert_eq!(a.camera, b.camera);
        assert_eq!(a.lights.as_deref(), Some(&[Light::Ambient(Rgb::splat(1.0))][..]));
        assert_eq!(b.lights.as_ref().map(Vec::len), Some(2));
        assert_eq!(b.background.radiance(Vec3::X).r, 0.5);
        assert!(a.materials.is_empty());
        let error = scene.view("c").map(|_| ()).expect_err("no such view").to_string();
        assert_eq!(error, "the name of the view is `c`; the views of this scene are `a`, `b`");
        Ok(())
    }

    #[test]
    fn each_error_names_its_place() {
        let cases = [
            ("{\n}", "dir/s.json:1:1: neither `obj` nor `gltf`; a description names one model"),
            ("{\"obj\": 3}", "dir/s.json:1:9: invalid type: integer `3`, expected a string"),
            ("{\"obj\": \"x\", \"light\": []}", "dir/s.json:1:20: unknown field `light`, expected one of `obj`"),
            ("{\"obj\": \"x\",\n\"lights\": [{\"spot\": {}}]}", "dir/s.json:2:18: unknown variant `spot`"),
            ("{\"obj\": \"x\",\n\"lights\": [{\"ambient\": [1, -1, 0]}]}", "dir/s.json:2:33: a colour has three"),
            ("{\"obj\": \"x\", \"lights\": [{\"ambient\": [1, 1]}]}", "dir/s.json:1:42: invalid length 2"),
            (
                "{\"obj\": \"x\", \"lights\": [{\"directional\": {\"to_light\": [0, 0, 0], \"irradiance\": [1, 1, 1]}}]}",
                "dir/s.json:1:62: a direction is finite",
            ),
            (
                "{\"obj\": \"x\", \"camera\": {\"eye\": [0, 0, 0], \"target\": [0, 0, 0]}}",
                "dir/s.json:1:63: the target of the camera is [0, 0, 0]; it is a point apart from the eye",
            ),
            ("{\"obj\": \"x\", \"background\": [1]}", "dir/s.json:1:31: a background is a colour"),
            ("{\"obj\": \"x\", \"crease_degrees\": 181}", "dir/s.json:1:35: crease_degrees lies"),
            ("{\"obj\": \"x\", \"shading_model\": \"gouraud\"}", "dir/s.json:1:39: unknown variant `gouraud`"),
            ("{\"obj\": \"x\"", "dir/s.json:1:11: EOF while parsing an object; a description is an object such as {"),
            ("\u{feff}\n [\"a.obj\"]", "dir/s.json:2:2: expected an object; a description is an object such as {"),
            ("", "dir/s.json:1:1: EOF while parsing a value; a description is"),
            (
                "{\"obj\": \"x\", \"views\": [{\"name\": \"a\"}, {\"name\": \"b\"}, {\"name\": \"a\"}]}",
                "dir/s.json: the name of a view is `a`; another view has it already",
            ),
            ("{\"obj\": \"none.obj\"}", "dir/none.obj: cannot read this file"),
            ("{\"obj\": \"bad.obj\"}", "dir/bad.obj:1: index 1 in `1` is out of range"),
        ];
        let wrong: Vec<_> = cases
            .into_iter()
            .map(|(text, expected)| (read(text).map(|_| ()).expect_err(text).to_string(), expected))
            .filter(|(message, expected)| !message.starts_with(expected))
            .collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
        for path in ["a.ply", "a", "none.json", "none.obj"] {
            assert!(load(Path::new(path), &LoadOptions::default()).is_err());
        }
    }
}
