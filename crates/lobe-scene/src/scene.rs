//! A scene: meshes, materials, and the views under which they are seen.

use crate::camera::Camera;
use crate::error::{Error, Warning};
use crate::material::{Material, ShadingModel};
use crate::mesh::Mesh;
use crate::obj::{Model, Part};
use glam::Vec3;
use lobe::Rgb;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Everything that can be drawn. It can be put together by hand, without a file:
///
/// ```
/// use lobe_scene::{Material, Mesh, Renderer, Scene, Settings, View};
/// use glam::Vec3;
///
/// let triangle = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
/// let scene = Scene {
///     meshes: vec![Mesh::flat(triangle, &[[0, 1, 2]], 0)?],
///     materials: vec![Material::default()],
///     ..Scene::default()
/// };
/// let settings = Settings { width: 16, height: 9, ..Settings::default() };
/// let image = Renderer::new(&scene)?.render(&View::default(), &settings, None)?;
/// assert_eq!(image.pixels().len(), 144);
/// # Ok::<(), lobe_scene::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// The surfaces. All share the one list of materials.
    pub meshes: Vec<Mesh>,
    /// The materials that [`Triangle::material`](crate::Triangle::material) counts.
    pub materials: Vec<Material>,
    /// Named pieces of the first mesh, when it came from a file.
    pub parts: Vec<Part>,
    /// Ways to look at it; the first one is the main one.
    pub views: Vec<View>,
    /// What was skipped or assumed when it was read.
    pub warnings: Vec<Warning>,
}

impl Scene {
    /// A model from a file, seen in the default view.
    #[must_use]
    pub fn from_model(model: Model, shading: ShadingModel) -> Self {
        Self {
            meshes: vec![model.mesh],
            materials: (model.materials.iter().zip(&model.maps))
                .map(|(mtl, maps)| Material::from_mtl_with(mtl, maps, shading))
                .collect(),
            parts: model.parts,
            views: vec![View::default()],
            warnings: model.warnings,
        }
    }

    /// The view of this name.
    ///
    /// # Errors
    /// [`Error::Setting`] with the names that there are.
    pub fn view(&self, name: &str) -> Result<&View, Error> {
        self.views.iter().find(|view| view.name == name).ok_or_else(|| {
            let names: Vec<_> = self.views.iter().map(|view| format!("`{}`", view.name)).collect();
            let expected = match names.as_slice() {
                [only] => format!("the only view of this scene is {only}"),
                _ => format!("the views of this scene are {}", names.join(", ")),
            };
            Error::setting("the name of the view", format!("`{name}`"), expected)
        })
    }

    /// The smallest box around everything, as its two extreme corners; `None` without triangles.
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let boxes = self.meshes.iter().filter_map(Mesh::bounds);
        boxes.reduce(|(low, high), (other_low, other_high)| (low.min(other_low), high.max(other_high)))
    }

    /// How many triangles there are in all.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.triangles.len()).sum()
    }
}

/// A light.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Light {
    /// A point of intensity `I`, in W·sr⁻¹: irradiance `I/r²`. With a radius it is a ball of points, one of which is
    /// picked for each sample of a pixel: shadows become soft, and with few samples grainy.
    Point {
        /// Where it is.
        position: Vec3,
        /// Intensity.
        intensity: Rgb,
        /// Radius of the ball; 0 for a point.
        radius: f32,
    },
    /// Light from one direction, the same everywhere.
    Directional {
        /// The direction to the light, of any length.
        to_light: Vec3,
        /// Irradiance on a surface that faces it, in W·m⁻².
        irradiance: Rgb,
    },
    /// A point light of `KHR_lights_punctual`, which may have an end and a cone: the irradiance is
    /// `I/r² · max(0, 1 − (r/range)⁴)`, times what is in the cone.
    Punctual {
        /// Where it is.
        position: Vec3,
        /// Intensity, in W·sr⁻¹.
        intensity: Rgb,
        /// How far it reaches; infinite for no end.
        range: f32,
        /// A spot's cone; `None` shines everywhere.
        cone: Option<Cone>,
    },
    /// Light from everywhere: radiance that the ambient reflection of a material multiplies.
    Ambient(Rgb),
}

/// The cone of a spot light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// Where it points, of unit length.
    pub direction: Vec3,
    /// Up to this angle from the direction it is as bright as can be, in radians.
    pub inner: f32,
    /// From this angle on it is dark, in radians, at most π/2.
    pub outer: f32,
}

impl Cone {
    /// The part of the light that goes along the unit vector `away`, by `KHR_lights_punctual`: between the two angles the
    /// square of a straight line over the cosine.
    #[must_use]
    pub fn part(&self, away: Vec3) -> f32 {
        let (inner, outer) = (self.inner.cos(), self.outer.cos());
        // The specification's guard against a cone without a soft edge.
        let part = (self.direction.dot(away) - outer) / (inner - outer).max(1e-3);
        part.clamp(0.0, 1.0).powi(2)
    }
}

/// What is seen where there is nothing, also in mirrors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Background {
    /// The same radiance everywhere.
    Solid(Rgb),
    /// A blend from straight down (−y) to straight up (+y), linear in the y component of the direction.
    Gradient {
        /// Radiance from below.
        bottom: Rgb,
        /// Radiance from above.
        top: Rgb,
    },
}

impl Default for Background {
    fn default() -> Self {
        Self::Solid(Rgb::splat(0.0))
    }
}

impl Background {
    /// The mean radiance over all directions.
    #[must_use]
    pub fn mean(&self) -> Rgb {
        match *self {
            Self::Solid(colour) => colour,
            // Linear in y, whose mean is 0.
            Self::Gradient { bottom, top } => (bottom + top) * 0.5,
        }
    }

    /// The radiance from the unit direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Rgb {
        match *self {
            Self::Solid(colour) => colour,
            Self::Gradient { bottom, top } => {
                let up = (0.5 + 0.5 * towards.y).clamp(0.0, 1.0);
                bottom * (1.0 - up) + top * up
            }
        }
    }
}

/// A way to look at a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Its name.
    pub name: String,
    /// `None`: a camera that sees everything, from slightly above and to the right.
    pub camera: Option<Camera>,
    /// `None`: one point light up and to the left behind the camera, and a weak ambient light.
    pub lights: Option<Vec<Light>>,
    /// What is seen where there is nothing.
    pub background: Background,
    /// Exposure in stops, for [`Display`](crate::image::Display).
    pub exposure: f32,
    /// What stands in place of the scene's materials, by their names; `*` is all that have no entry of their own. The
    /// part that is solid ([`Material::dissolve`]) stays.
    pub materials: BTreeMap<String, lobe_models::Material>,
}

impl Default for View {
    fn default() -> Self {
        Self {
            name: "default".to_owned(),
            camera: None,
            lights: None,
            background: Background::Solid(Rgb::splat(0.05)),
            exposure: 0.0,
            materials: BTreeMap::new(),
        }
    }
}

impl View {
    /// The name in [`materials`](Self::materials) that stands for all.
    pub const ALL: &str = "*";

    /// The materials as this view has them.
    #[must_use]
    pub fn materials_of<'a>(&self, materials: &'a [Material]) -> Cow<'a, [Material]> {
        if self.materials.is_empty() {
            return Cow::Borrowed(materials);
        }
        // Once each, however many materials `*` stands for.
        let built: BTreeMap<&str, Material> =
            self.materials.iter().map(|(name, lobes)| (name.as_str(), Material::from_lobes(name, lobes))).collect();
        let replaced = materials.iter().map(|old| {
            let new = built.get(old.name.as_str()).or_else(|| built.get(Self::ALL));
            new.map_or_else(
                || old.clone(),
                |new| Material { name: old.name.clone(), dissolve: old.dissolve, ..new.clone() },
            )
        });
        replaced.collect()
    }

    /// The camera of this view, or the one that frames a box in a picture of the given width divided by height.
    #[must_use]
    pub fn camera_for(&self, low: Vec3, high: Vec3, aspect: f32) -> Camera {
        self.camera.unwrap_or_else(|| Camera::framing(low, high, aspect))
    }

    /// The lights of this view, or the default ones for a camera.
    ///
    /// The default point light stands at the height of one camera distance above and half of one to the left of the
    /// camera. Its intensity gives a surface that faces it at the target the irradiance π: a white diffuse surface
    /// then has the radiance 1.
    #[must_use]
    pub fn lights_for(&self, camera: &Camera) -> Vec<Light> {
        if let Some(lights) = &self.lights {
            return lights.clone();
        }
        let back = camera.eye - camera.target;
        let distance = back.length();
        let up = camera.up.normalize_or_zero();
        let right = up.cross(back).normalize_or_zero();
        let position = camera.eye + (up - 0.5 * right) * distance;
        let intensity = Rgb::splat(std::f32::consts::PI * (position - camera.target).length_squared());
        vec![Light::Point { position, intensity, radius: 0.0 }, Light::Ambient(Rgb::splat(0.1))]
    }
}
