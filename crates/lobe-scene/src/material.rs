//! A material: the lecture's equation as lobes.

use crate::gltf_material::{Factors, GltfMaterial, Maps};
use crate::maps::MtlMaps;
use crate::mtl::{Illumination, MtlMaterial, Pbr};
use crate::texture::Map;
use glam::Vec2;
use lobe::illumination::{BlinnTorranceHighlight, PhongHighlight};
use lobe::{BlinnPhong, Brdf, Lambert, Mirror, Phong, Rgb, Shininess, Sum};
use lobe_sampling::{ByCosine, Sample};
use std::fmt;
use std::sync::Arc;

/// How `Ks` and `Ns` of a material file become a highlight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ShadingModel {
    /// `ks/π · (n·h)^q`: what MTL itself says, and the lecture's second form. Not a BRDF.
    #[default]
    BlinnTorrance,
    /// `ks/π · (v·r)^q`, with `r` the mirror direction of the light: the lecture's first form. Not a BRDF.
    Phong,
    /// [`Phong`](lobe::Phong): the same lobe as a normalised BRDF whose albedo is at most `ks`.
    NormalizedPhong,
    /// [`BlinnPhong`](lobe::BlinnPhong): the same for the halfway vector.
    NormalizedBlinnPhong,
}

impl ShadingModel {
    /// All of them, in the order of the docs.
    pub const ALL: [Self; 4] = [Self::BlinnTorrance, Self::Phong, Self::NormalizedPhong, Self::NormalizedBlinnPhong];

    /// The name in scene descriptions: `blinn-torrance`, `phong`, `normalized-phong`, `normalized-blinn-phong`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::BlinnTorrance => "blinn-torrance",
            Self::Phong => "phong",
            Self::NormalizedPhong => "normalized-phong",
            Self::NormalizedBlinnPhong => "normalized-blinn-phong",
        }
    }
}

impl fmt::Display for ShadingModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for ShadingModel {
    type Err = crate::Error;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL.into_iter().find(|model| model.name() == name).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            crate::Error::setting("the shading model", format!("`{name}`"), format!("it is one of {names}"))
        })
    }
}

/// What a picture needs of a lobe of your own: values for the ray caster, samples for [`path`](crate::path).
///
/// Every lobe of `lobe` and `lobe-energy` has both. Of a BRDF of which nothing else is known [`Surface::other`] makes one.
pub trait AnyBrdf: Brdf<f32> + Sample<f32> + Send + Sync + fmt::Debug {}
impl<B: Brdf<f32> + Sample<f32> + Send + Sync + fmt::Debug> AnyBrdf for B {}

/// The sum of lobes of a material.
///
/// Each variant is a concrete type: it is chosen once for a hit, not once for a light, and a lobe that is not there
/// is not evaluated.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub enum Surface {
    /// Nothing reacts to lights.
    #[default]
    Black,
    /// Diffuse only.
    Diffuse(Lambert),
    /// The lecture's equation with the halfway vector.
    BlinnTorrance(Sum<Lambert, BlinnTorranceHighlight>),
    /// The lecture's equation with the mirror direction.
    Phong(Sum<Lambert, PhongHighlight>),
    /// Diffuse and the normalised Phong lobe.
    NormalizedPhong(Sum<Lambert, Phong>),
    /// Diffuse and the normalised Blinn-Phong lobe.
    NormalizedBlinnPhong(Sum<Lambert, BlinnPhong>),
    /// Lobes of the catalogue, by name.
    Lobes(Arc<NamedLobes>),
    /// A material of glTF 2.0, whose numbers may differ from point to point.
    Gltf(Arc<GltfMaterial>),
    /// The lecture's equation with pictures in place of some of its numbers.
    Mapped(Arc<MappedLobes>),
    /// Any other BRDF, given from Rust, with its samples.
    Other(Arc<dyn AnyBrdf>),
}

/// The lobes of a material of MTL with pictures.
///
/// Diffuse and highlight are shaded one by one, each with its own weight at every point; so they are the same kernels as
/// without pictures.
#[derive(Debug, Clone)]
pub struct MappedLobes {
    /// The lobes with their numbers, without the pictures.
    pub lobes: Surface,
    /// The pictures.
    pub maps: MtlMaps,
    pub(crate) diffuse: Lambert,
    pub(crate) highlight: Option<Surface>,
}

/// What the parts of a material are multiplied with at a point, and its normal in the tangent frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MappedAt {
    pub(crate) ambient: Rgb,
    pub(crate) diffuse: Rgb,
    pub(crate) specular: Rgb,
    pub(crate) emission: Rgb,
    pub(crate) normal: glam::Vec3,
}

impl Default for MappedAt {
    /// Without pictures.
    fn default() -> Self {
        let one = Rgb::splat(1.0);
        Self { ambient: one, diffuse: one, specular: one, emission: one, normal: glam::Vec3::Z }
    }
}

impl MappedLobes {
    pub(crate) fn at(&self, uv: [Vec2; 2], footprint: [f32; 2]) -> MappedAt {
        let rgb = |map: &Option<Map>| {
            let [r, g, b, _] = map.as_ref().map_or([1.0; 4], |map| map.at(uv, footprint));
            Rgb::new(r, g, b)
        };
        let maps = &self.maps;
        MappedAt {
            ambient: rgb(&maps.ambient),
            diffuse: rgb(&maps.diffuse),
            specular: rgb(&maps.specular),
            emission: rgb(&maps.emission),
            normal: maps.normal.as_ref().map_or(glam::Vec3::Z, |map| map.normal(maps.normal_scale, uv, footprint)),
        }
    }
}

/// Lobes of the catalogue, ready to be evaluated.
///
/// The model of each is chosen through a pointer, once for a batch of points, and any model can be named in a file.
pub struct NamedLobes {
    material: lobe_models::Material,
    brdf: lobe_models::AnyBrdf<f32>,
    batch: lobe_models::AnyBatch,
    sampler: lobe_models::AnySampler<f32>,
}

impl NamedLobes {
    /// Builds the lobes.
    #[must_use]
    pub fn new(material: lobe_models::Material) -> Self {
        Self { brdf: material.build(), batch: material.batch(), sampler: material.sampler(), material }
    }

    /// What they were built from.
    #[must_use]
    pub fn material(&self) -> &lobe_models::Material {
        &self.material
    }

    /// The lobes, for one pair of directions at a time.
    #[must_use]
    pub fn brdf(&self) -> &dyn Brdf<f32> {
        &*self.brdf
    }

    /// The lobes over slices, as pictures are shaded.
    #[must_use]
    pub fn batch(&self) -> &dyn lobe_models::BatchBrdf {
        &*self.batch
    }

    /// The lobes as paths draw directions from them.
    #[must_use]
    pub fn sampler(&self) -> &dyn Sample<f32> {
        &*self.sampler
    }
}

/// The directional albedo at 45°, to a percent: enough for an ambient term, and a thousandth of the work of an exact one.
///
/// In polar coordinates around the mirror direction, with a logarithmic radius, so that sharp lobes are met too.
fn reflected_at_45_degrees(brdf: &dyn Brdf<f64>) -> Rgb<f64> {
    use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};
    const RINGS: u32 = 96;
    const SECTORS: u32 = 24;
    const SMALLEST: f64 = 1e-4;
    let v = lobe::Vec3::new(FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
    let pole = lobe::Vec3::new(-FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
    let (right, up) = (v, lobe::Vec3::new(0.0, 1.0, 0.0));
    let step = (PI / SMALLEST).ln() / f64::from(RINGS);
    let mut sum = Rgb::splat(0.0);
    for ring in 0..RINGS {
        let angle = SMALLEST * ((f64::from(ring) + 0.5) * step).exp();
        for sector in 0..SECTORS {
            let (sine, cosine) = ((f64::from(sector) + 0.5) * TAU / f64::from(SECTORS)).sin_cos();
            let l = pole * angle.cos() + (right * cosine + up * sine) * angle.sin();
            sum = sum + brdf.eval_cos(l, v) * (angle.sin() * angle * step * TAU / f64::from(SECTORS));
        }
    }
    sum
}

impl fmt::Debug for NamedLobes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("NamedLobes").field(&self.material).finish()
    }
}

/// What a surface does with light: the lecture's equation as lobes.
///
/// # One radiometric convention
///
/// A point light has the intensity `I`, a surface that faces it at distance `r` receives the irradiance `E = I/r²`,
/// and the radiance towards the viewer is
///
/// ```text
/// L = Ke + Ka Ia + Σ eval_cos(l, v) E + Ks L(mirror direction)
/// ```
///
/// The lecture writes `L_o = ka kd + [kd (n·l) + ks (n·h)^q] L_i/r²`. That is this, with `L_i = I/π`: the diffuse
/// term is [`Lambert`] with albedo `kd`, since `eval_cos = kd/π · (n·l)`, and the highlight is
/// [`BlinnTorranceHighlight`] with `eval_cos = ks/π · (n·h)^q`. So a light that the lecture gives as `L_i` is
/// entered here as `I = π L_i`, and a white diffuse surface does not send out more than it receives.
///
/// `Ka Ia` is the ambient term as MTL has it: `Ka` alone, where the lecture writes `ka kd`.
#[derive(Debug, Clone)]
pub struct Material {
    /// Its name in messages and tables.
    pub name: String,
    /// `Ka`: the part of the ambient radiance that is sent on, without a lobe.
    pub ambient: Rgb,
    /// `Ke`: radiance that the surface sends out by itself.
    pub emission: Rgb,
    /// `d`: 1 is solid. Below that the picture is a blend, `d` times the surface and `1 − d` times what lies behind
    /// (no refraction), and a shadow lets `1 − d` of the light through at each surface that the ray crosses.
    pub dissolve: f32,
    /// What is seen in it as in a mirror; its reflectance is 0 for most materials.
    pub mirror: Mirror,
    /// How it reacts to lights.
    pub surface: Surface,
}

impl Default for Material {
    /// The grey of [`MtlMaterial::default`].
    fn default() -> Self {
        Self::from_mtl(&MtlMaterial::default(), ShadingModel::default())
    }
}

impl Material {
    /// A material with these lobes and nothing else: no ambient reflection, no emission, solid.
    #[must_use]
    pub fn new(name: impl Into<String>, surface: Surface) -> Self {
        let none = Rgb::splat(0.0);
        Self { name: name.into(), ambient: none, emission: none, dissolve: 1.0, mirror: Mirror::new(none), surface }
    }

    /// A material of lobes of the catalogue. Of a uniform ambient light it sends on what it reflects at 45°.
    #[must_use]
    pub fn from_lobes(name: impl Into<String>, lobes: &lobe_models::Material) -> Self {
        let albedo = reflected_at_45_degrees(&*lobes.build::<f64>());
        // More than arrives, or a quadrature that ended in nothing, is no ambient term.
        let channel = |x: f64| if x.is_finite() { x.clamp(0.0, 1.0) as f32 } else { 0.0 };
        let surface = Surface::Lobes(Arc::new(NamedLobes::new(lobes.clone())));
        Self { ambient: albedo.map(channel), ..Self::new(name, surface) }
    }

    /// A material of glTF 2.0. Emission and ambient light are its own affair, point by point.
    #[must_use]
    pub fn from_gltf(name: impl Into<String>, material: GltfMaterial) -> Self {
        Self::new(name, Surface::Gltf(Arc::new(material)))
    }

    /// The material of glTF 2.0 that it is, if so.
    #[must_use]
    pub fn gltf(&self) -> Option<&GltfMaterial> {
        match &self.surface {
            Surface::Gltf(material) => Some(material),
            _ => None,
        }
    }

    /// Its lobes with pictures, if it is of MTL and has any.
    #[must_use]
    pub fn mapped(&self) -> Option<&MappedLobes> {
        match &self.surface {
            Surface::Mapped(mapped) => Some(mapped),
            _ => None,
        }
    }

    /// What of a uniform ambient light it sends on, roughly and without its pictures.
    pub(crate) fn colour(&self) -> Rgb {
        match self.gltf() {
            Some(gltf) => Rgb::from(gltf.factors.base_color),
            None => self.ambient,
        }
    }

    /// Whether some of its numbers are pictures.
    pub(crate) fn is_textured(&self) -> bool {
        self.mapped().is_some() || self.gltf().is_some()
    }

    /// How solid it is at a point, its dissolve included.
    pub(crate) fn opacity(&self, uv: [Vec2; 2], footprint: [f32; 2], color: f32) -> f32 {
        let map = match &self.surface {
            Surface::Gltf(gltf) => gltf.opacity(uv, footprint, color),
            Surface::Mapped(mapped) => mapped.maps.dissolve.as_ref().map_or(1.0, |map| map.at(uv, footprint)[0]),
            _ => 1.0,
        };
        self.dissolve * map
    }

    /// Whether light gets through it somewhere.
    pub(crate) fn is_open(&self) -> bool {
        let mapped = |mapped: &MappedLobes| mapped.maps.dissolve.is_some();
        self.dissolve < 1.0 || self.gltf().is_some_and(GltfMaterial::is_open) || self.mapped().is_some_and(mapped)
    }

    /// Which lobes it is made of, and why, in words with `code` between backticks. Empty for lobes that were named.
    #[must_use]
    pub fn reasons(&self) -> Vec<String> {
        const BOTH: &str = "a diffuse lobe and a highlight: `illum` asks for one, and `Ks` is not black";
        let mut reasons = Vec::new();
        let lecture = |surface: &Surface| match surface {
            Surface::Black => Some("no lobe: `illum 0` is a colour without light"),
            Surface::Diffuse(_) => Some("a diffuse lobe alone: `illum` asks for no highlight, or `Ks` is black"),
            Surface::BlinnTorrance(_) | Surface::Phong(_) => Some(BOTH),
            Surface::NormalizedPhong(_) | Surface::NormalizedBlinnPhong(_) => Some(BOTH),
            Surface::Mapped(_) | Surface::Gltf(_) | Surface::Lobes(_) | Surface::Other(_) => None,
        };
        match &self.surface {
            Surface::Gltf(gltf) => reasons = gltf.reasons(),
            Surface::Mapped(mapped) => {
                let maps = &mapped.maps;
                reasons.extend(lecture(&mapped.lobes).map(str::to_owned));
                reasons.extend(crate::maps::pictures(&[
                    ("ambient", &maps.ambient),
                    ("diffuse", &maps.diffuse),
                    ("highlight", &maps.specular),
                    ("emission", &maps.emission),
                    ("dissolve", &maps.dissolve),
                    ("normal", &maps.normal),
                ]));
            }
            surface => reasons.extend(lecture(surface).map(str::to_owned)),
        }
        if self.mirror.ks() != Rgb::splat(0.0) {
            reasons.push("a mirror: `illum` is 3 or above".to_owned());
        }
        reasons
    }

    /// The material of a file, with its pictures.
    #[must_use]
    pub fn from_mtl_with(mtl: &MtlMaterial, maps: &MtlMaps, model: ShadingModel) -> Self {
        if let Some(pbr) = &mtl.pbr {
            return Self::from_gltf(mtl.name.as_str(), metallic_roughness(mtl, pbr, maps));
        }
        let mut material = Self::from_mtl(mtl, model);
        if maps.is_empty() {
            return material;
        }
        let mut maps = maps.clone();
        // What stands for another number takes its picture, too.
        if mtl.ka.is_none() {
            maps.ambient = maps.ambient.or_else(|| maps.diffuse.clone());
        }
        if mtl.illumination == Illumination::Constant {
            maps.emission = maps.diffuse.clone();
        }
        let lobes = std::mem::take(&mut material.surface);
        let (diffuse, highlight) = match lobes {
            Surface::Black => (Rgb::splat(0.0), None),
            Surface::Diffuse(_) => (Rgb::from(mtl.kd), None),
            _ => {
                let highlight = Surface::new(model, Rgb::splat(0.0), Rgb::from(mtl.ks), Shininess(mtl.ns));
                (Rgb::from(mtl.kd), Some(highlight))
            }
        };
        let mapped = MappedLobes { lobes, maps, diffuse: Lambert::new(diffuse), highlight };
        material.surface = Surface::Mapped(Arc::new(mapped));
        material
    }

    /// The material of a file as lobes, without its pictures. What is not there by `illum` is left out.
    #[must_use]
    pub fn from_mtl(mtl: &MtlMaterial, model: ShadingModel) -> Self {
        let (kd, ks) = (Rgb::from(mtl.kd), Rgb::from(mtl.ks));
        let ambient = mtl.ka.map_or(kd, Rgb::from);
        let emission = Rgb::from(mtl.ke);
        let shiny = mtl.ks != [0.0; 3];
        let mut material = Self::new(mtl.name.as_str(), Surface::Diffuse(Lambert::new(kd)));
        material.dissolve = mtl.d;
        material.emission = emission;
        material.ambient = ambient;
        match mtl.illumination {
            // The colour Kd without any light is a surface that sends out Kd.
            Illumination::Constant => {
                material.emission = emission + kd;
                material.ambient = Rgb::splat(0.0);
                material.surface = Surface::Black;
            }
            Illumination::Diffuse => {}
            Illumination::Highlight | Illumination::Mirror if shiny => {
                material.surface = Surface::new(model, kd, ks, Shininess(mtl.ns));
                if mtl.illumination == Illumination::Mirror {
                    material.mirror = Mirror::new(ks);
                }
            }
            Illumination::Highlight | Illumination::Mirror => {}
        }
        material
    }
}

/// A PBR material of MTL in the terms of glTF, whose equations it takes.
fn metallic_roughness(mtl: &MtlMaterial, pbr: &Pbr, maps: &MtlMaps) -> GltfMaterial {
    // Of a sheen the file has the amount alone.
    const SHEEN_ROUGHNESS: f32 = 0.5;
    let mut factors = Factors {
        base_color: mtl.kd,
        opacity: mtl.d,
        metallic: pbr.metallic,
        roughness: pbr.roughness.unwrap_or(1.0),
        emission: mtl.ke,
        normal_scale: maps.normal_scale,
        ior: if pbr.ior >= 1.0 { pbr.ior } else { 1.5 },
        anisotropy: pbr.anisotropy,
        anisotropy_rotation: pbr.anisotropy_rotation * std::f32::consts::TAU,
        clearcoat: pbr.clearcoat,
        clearcoat_roughness: pbr.clearcoat_roughness,
        sheen_color: [pbr.sheen; 3],
        sheen_roughness: SHEEN_ROUGHNESS,
        double_sided: true,
        blend: mtl.d < 1.0 || mtl.maps.iter().any(|map| map.target == crate::mtl::MapUse::Dissolve),
        ..Factors::default()
    };
    // A picture alone stands for its number.
    let given = |target| mtl.maps.iter().any(|map| map.target == target);
    if given(crate::mtl::MapUse::Metallic) && pbr.metallic == 0.0 {
        factors.metallic = 1.0;
    }
    if given(crate::mtl::MapUse::Sheen) && pbr.sheen == 0.0 {
        factors.sheen_color = [1.0; 3];
    }
    factors.bring_into_domain();
    let maps = Maps {
        base_color: maps.diffuse.clone(),
        metallic_roughness: maps.metallic_roughness.clone(),
        normal: maps.normal.clone(),
        emission: maps.emission.clone(),
        sheen_color: maps.sheen.clone(),
        ..Maps::default()
    };
    GltfMaterial { factors, maps }
}

/// One lobe of a material, for a table.
pub struct LobeRecord {
    /// The kind of lobe, as `lobe eval` names it where it knows it: `lambert`, `phong`, …
    pub model: &'static str,
    /// Its parameters that are neither, in words: `alpha 0.3, masking smith-correlated`.
    pub parameters: String,
    /// Its reflectance `kd` or `ks`, linear RGB; `None` for a lobe given from Rust.
    pub reflectance: Option<[f32; 3]>,
    /// Its exponent `q`, if it has one.
    pub exponent: Option<f32>,
    /// The lobe in `f64`, for integrals; `None` for a lobe given from Rust.
    pub reference: Option<Box<dyn Brdf<f64> + Send + Sync>>,
}

impl fmt::Debug for LobeRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LobeRecord")
            .field("model", &self.model)
            .field("reflectance", &self.reflectance)
            .field("exponent", &self.exponent)
            .finish_non_exhaustive()
    }
}

impl LobeRecord {
    fn new(
        model: &'static str,
        reflectance: Rgb,
        exponent: Option<Shininess>,
        reference: impl Brdf<f64> + Send + Sync + 'static,
    ) -> Self {
        Self {
            model,
            parameters: String::new(),
            reflectance: Some(reflectance.into()),
            exponent: exponent.map(|q| q.0),
            reference: Some(Box::new(reference)),
        }
    }

    fn named(lobe: &lobe_models::Lobe) -> Self {
        use lobe_models::Value;
        let product = |a: [f64; 3]| [0, 1, 2].map(|i| (a[i] * lobe.weight()[i]) as f32);
        let mut weights = lobe.values().filter(|(parameter, _)| parameter.is_weight());
        let reflectance = match weights.next() {
            Some((_, Value::Colour(colour))) => Some(product(colour)),
            _ if lobe.weight() == [1.0; 3] => None,
            _ => Some(product([1.0; 3])),
        };
        let exponent = match lobe.value("q") {
            Some(Value::Number(q)) => Some(q as f32),
            _ => None,
        };
        // What is at its default is not worth a line.
        let shown = lobe.values().filter(|(p, value)| !p.is_weight() && p.name != "q" && p.default != Some(*value));
        let shown: Vec<_> = shown.map(|(p, value)| format!("{} {}", p.name, value.bare())).collect();
        let (model, parameters) = (lobe.model().name, shown.join(", "));
        Self { model, parameters, reflectance, exponent, reference: Some(lobe.build::<f64>()) }
    }

    fn lambert(lobe: Lambert) -> Self {
        Self::new("lambert", lobe.albedo(), None, lobe.map(f64::from))
    }
}

impl Surface {
    /// A BRDF of your own. Paths go on from it by the cosine: right for each, and noisy for a sharp one. One that knows how to
    /// sample itself goes into [`Surface::Other`] as it is.
    #[must_use]
    pub fn other(brdf: impl Brdf<f32> + Send + Sync + fmt::Debug + 'static) -> Self {
        Self::Other(Arc::new(ByCosine(brdf)))
    }

    /// Diffuse reflection `kd` and a highlight `ks`, `q` by the given model.
    #[must_use]
    pub fn new(model: ShadingModel, kd: Rgb, ks: Rgb, q: Shininess) -> Self {
        let diffuse = Lambert::new(kd);
        match model {
            ShadingModel::BlinnTorrance => Self::BlinnTorrance(diffuse + BlinnTorranceHighlight::new(ks, q)),
            ShadingModel::Phong => Self::Phong(diffuse + PhongHighlight::new(ks, q)),
            ShadingModel::NormalizedPhong => Self::NormalizedPhong(diffuse + Phong::new(ks, q)),
            ShadingModel::NormalizedBlinnPhong => Self::NormalizedBlinnPhong(diffuse + BlinnPhong::new(ks, q)),
        }
    }

    /// What paths draw directions from, without pictures: a material of glTF as the catalogue has it. Nothing for a surface without
    /// lobes.
    #[must_use]
    pub fn sampler(&self) -> Option<Box<dyn Sample<f32> + '_>> {
        Some(match self {
            Self::Black => return None,
            Self::Diffuse(lobe) => Box::new(lobe),
            Self::BlinnTorrance(lobes) => Box::new(lobes),
            Self::Phong(lobes) => Box::new(lobes),
            Self::NormalizedPhong(lobes) => Box::new(lobes),
            Self::NormalizedBlinnPhong(lobes) => Box::new(lobes),
            Self::Lobes(lobes) => Box::new(lobes.sampler()),
            Self::Gltf(material) => material.lobes().first()?.sampler::<f32>(),
            Self::Mapped(mapped) => return mapped.lobes.sampler(),
            Self::Other(lobe) => Box::new(&**lobe),
        })
    }

    /// The lobes with their parameters.
    #[must_use]
    pub fn lobes(&self) -> Vec<LobeRecord> {
        let highlight = |diffuse: Lambert, record: LobeRecord| vec![LobeRecord::lambert(diffuse), record];
        match self {
            Self::Black => Vec::new(),
            Self::Diffuse(diffuse) => vec![LobeRecord::lambert(*diffuse)],
            Self::BlinnTorrance(Sum { a, b }) => highlight(
                *a,
                LobeRecord::new("blinn-torrance-highlight", b.ks(), Some(b.shininess()), b.map(f64::from)),
            ),
            Self::Phong(Sum { a, b }) => {
                highlight(*a, LobeRecord::new("phong-highlight", b.ks(), Some(b.shininess()), b.map(f64::from)))
            }
            Self::NormalizedPhong(Sum { a, b }) => {
                highlight(*a, LobeRecord::new("phong", b.ks(), Some(b.shininess()), b.map(f64::from)))
            }
            Self::NormalizedBlinnPhong(Sum { a, b }) => {
                highlight(*a, LobeRecord::new("blinn-phong", b.ks(), Some(b.shininess()), b.map(f64::from)))
            }
            Self::Lobes(lobes) => lobes.material.lobes.iter().map(LobeRecord::named).collect(),
            Self::Gltf(material) => material.lobes().iter().map(LobeRecord::named).collect(),
            Self::Mapped(mapped) => mapped.lobes.lobes(),
            Self::Other(_) => {
                let parameters = String::new();
                vec![LobeRecord { model: "other", parameters, reflectance: None, exponent: None, reference: None }]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lobe::Vec3;
    use std::f32::consts::PI;

    fn mtl(illumination: Illumination) -> MtlMaterial {
        MtlMaterial {
            kd: [0.5, 0.25, 0.0],
            ks: [0.25; 3],
            ke: [0.0, 0.0, 1.0],
            ns: 8.0,
            d: 0.5,
            illumination,
            ..MtlMaterial::default()
        }
    }

    #[test]
    fn the_ambient_term_is_the_albedo() {
        for (lobe, tolerance) in [
            (r#"{"model": "lambert", "albedo": 0.5}"#, 0.01),
            (r#"{"model": "microfacet", "alpha": 0.1, "f0": 0.9}"#, 0.01),
            (r#"{"model": "blinn-phong", "ks": 0.5, "q": 10000}"#, 0.01),
        ] {
            let lobes = lobe_models::Material::from_json(&format!("{{\"lobes\": [{lobe}]}}")).expect("right");
            let v = Vec3::new(std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2);
            let exact = lobe_energy::directional_albedo(&*lobes.build::<f64>(), v).value.g;
            let ambient = f64::from(Material::from_lobes("m", &lobes).ambient.g);
            assert!((ambient / exact - 1.0).abs() < tolerance, "{lobe}: {ambient} {exact}");
        }
    }

    #[test]
    fn illum_leaves_out_what_is_not_there() {
        let constant = Material::from_mtl(&mtl(Illumination::Constant), ShadingModel::Phong);
        assert_eq!(constant.emission, Rgb::new(0.5, 0.25, 1.0));
        assert!(constant.surface.lobes().is_empty());
        let diffuse = Material::from_mtl(&mtl(Illumination::Diffuse), ShadingModel::Phong);
        assert!(matches!(diffuse.surface, Surface::Diffuse(_)));
        assert_eq!(diffuse.ambient, Rgb::new(0.5, 0.25, 0.0), "without Ka the ambient light sees Kd");
        let mirror = Material::from_mtl(&mtl(Illumination::Mirror), ShadingModel::BlinnTorrance);
        assert_eq!(mirror.mirror.ks(), Rgb::splat(0.25));
        let plain = Material::from_mtl(&mtl(Illumination::Highlight), ShadingModel::BlinnTorrance);
        assert_eq!(plain.mirror.ks(), Rgb::splat(0.0));
        assert_eq!(plain.dissolve, 0.5);
    }

    #[test]
    fn the_lectures_equation_is_met() {
        let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, 0.8));
        let h_z = 1.6 / f32::sqrt(0.36 + 0.36 + 2.56);
        let r_v = 0.64; // v · (−0.6, 0, 0.8)
        for (model, cosine) in [(ShadingModel::BlinnTorrance, h_z), (ShadingModel::Phong, r_v)] {
            let material = Material::from_mtl(&mtl(Illumination::Highlight), model);
            let value = match &material.surface {
                Surface::BlinnTorrance(sum) => sum.eval_cos(l, v),
                Surface::Phong(sum) => sum.eval_cos(l, v),
                other => unreachable!("{other:?}"),
            };
            // For L_i/r² = 1, E = π.
            let bracket = 0.5 * 0.8 + 0.25 * cosine.powi(8);
            assert!((value.r * PI - bracket).abs() < 1e-6, "{model}: {} {bracket}", value.r * PI);
        }
    }

    #[test]
    fn models_have_names_and_records() {
        for model in ShadingModel::ALL {
            assert_eq!(model.name().parse::<ShadingModel>().ok(), Some(model));
            let lobes = Material::from_mtl(&mtl(Illumination::Highlight), model).surface.lobes();
            assert_eq!(lobes.len(), 2);
            assert_eq!(lobes[0].reflectance, Some([0.5, 0.25, 0.0]));
            assert_eq!(lobes[1].exponent, Some(8.0));
            let up = Vec3::new(0.0, 0.0, 1.0);
            assert!(lobes.iter().all(|lobe| lobe.reference.as_ref().is_some_and(|lobe| lobe.eval(up, up).r > 0.0)));
        }
        assert!("gouraud".parse::<ShadingModel>().is_err());
    }
}
