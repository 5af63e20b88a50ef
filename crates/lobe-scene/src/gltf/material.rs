//! The materials of a glTF file, and their pictures.

use super::{Loader, MAX_BYTES, Problem, Reader, accessor, fetch, name_of};
use crate::gltf_material::{Factors, GltfMaterial, Maps};
use crate::material::Material;
use crate::picture;
use crate::texture::{Encoding, Map, Sampler, Texture, Wrap};
use ::gltf::material::AlphaMode;
use ::gltf::texture::{MagFilter, WrappingMode};
use glam::{Mat2, Vec2};
use serde_json::Value;
use std::collections::HashMap;
use std::sync::Arc;

/// Textures that were read, by their index and what their numbers mean; `None` for one that could not be.
type Known = HashMap<(usize, Encoding), Option<Arc<Texture>>>;

/// What a file says of a texture in a place.
struct Info<'a> {
    index: usize,
    set: u32,
    transform: Option<&'a Value>,
}

impl Reader<'_> {
    /// Reads all materials, with the pictures that they use.
    pub(super) fn materials(&mut self, loader: Loader<'_>) -> Result<(), Problem> {
        let mut known = Known::new();
        for material in self.document.materials() {
            let index = material.index().unwrap_or(0);
            let name = material.name().map_or_else(|| format!("material {index}"), str::to_owned);
            let read = self.material(&material, &name, &mut known, loader);
            self.scene.materials.push(read);
        }
        Ok(())
    }

    /// The material of what has none.
    pub(super) fn default_material(&mut self) -> u32 {
        const NAME: &str = "(none)";
        if let Some(at) = self.scene.materials.iter().position(|material| material.name == NAME) {
            return at as u32;
        }
        self.scene.materials.push(Material::from_gltf(NAME, GltfMaterial::default()));
        self.scene.materials.len() as u32 - 1
    }

    /// Whether a material has a map that needs tangents, or a direction along the surface.
    pub(super) fn needs_tangents(&self, material: u32) -> bool {
        self.scene.materials.get(material as usize).and_then(Material::gltf).is_some_and(GltfMaterial::needs_tangents)
    }

    /// The texture coordinates that its tangents follow.
    pub(super) fn tangent_set(&self, material: u32) -> usize {
        let material = self.scene.materials.get(material as usize).and_then(Material::gltf);
        material.and_then(|material| material.maps.normal.as_ref()).map_or(0, |map| map.set)
    }

    fn material(
        &mut self,
        material: &::gltf::Material<'_>,
        name: &str,
        known: &mut Known,
        loader: Loader<'_>,
    ) -> Material {
        let pbr = material.pbr_metallic_roughness();
        let extensions = material.extensions();
        let extension = |key: &str| extensions.and_then(|all| all.get(key));
        const READ: [&str; 3] = ["KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy"];
        for key in extensions.into_iter().flat_map(|all| all.keys()).filter(|key| !READ.contains(&key.as_str())) {
            self.once(format!("material `{name}`: {key} is not supported, and is left out"));
        }
        let [r, g, b, a] = pbr.base_color_factor();
        let mut factors = Factors {
            base_color: [r, g, b],
            opacity: a,
            metallic: pbr.metallic_factor(),
            roughness: pbr.roughness_factor(),
            emission: material.emissive_factor().map(|e| e * material.emissive_strength().unwrap_or(1.0)),
            ior: material.ior().unwrap_or(1.5),
            unlit: material.unlit(),
            double_sided: material.double_sided(),
            cutoff: match material.alpha_mode() {
                AlphaMode::Mask => Some(material.alpha_cutoff().unwrap_or(0.5)),
                _ => None,
            },
            blend: material.alpha_mode() == AlphaMode::Blend,
            ..Factors::default()
        };
        let mut maps = Maps::default();
        let mut read = |info: Option<Info<'_>>, encoding| self.map(&info?, name, encoding, known, loader);
        fn plain<'a>(info: &'a ::gltf::texture::Info<'_>) -> Info<'a> {
            let transform = info.extension_value("KHR_texture_transform");
            Info { index: info.texture().index(), set: info.tex_coord(), transform }
        }
        maps.base_color = read(pbr.base_color_texture().as_ref().map(plain), Encoding::Srgb);
        maps.metallic_roughness = read(pbr.metallic_roughness_texture().as_ref().map(plain), Encoding::Linear);
        maps.emission = read(material.emissive_texture().as_ref().map(plain), Encoding::Srgb);
        if let Some(map) = material.normal_texture() {
            factors.normal_scale = map.scale();
            let transform = map.extension_value("KHR_texture_transform");
            let info = Info { index: map.texture().index(), set: map.tex_coord(), transform };
            maps.normal = read(Some(info), Encoding::Linear);
        }
        if let Some(map) = material.occlusion_texture() {
            factors.occlusion_strength = map.strength();
            let transform = map.extension_value("KHR_texture_transform");
            let info = Info { index: map.texture().index(), set: map.tex_coord(), transform };
            maps.occlusion = read(Some(info), Encoding::Linear);
        }
        if let Some(specular) = material.specular() {
            factors.specular = specular.specular_factor();
            factors.specular_color = specular.specular_color_factor();
            maps.specular = read(specular.specular_texture().as_ref().map(plain), Encoding::Linear);
            maps.specular_color = read(specular.specular_color_texture().as_ref().map(plain), Encoding::Srgb);
        }
        if let Some(coat) = extension(READ[0]) {
            factors.clearcoat = number(coat, "clearcoatFactor", 0.0);
            factors.clearcoat_roughness = number(coat, "clearcoatRoughnessFactor", 0.0);
            maps.clearcoat = read(info(coat, "clearcoatTexture"), Encoding::Linear);
            maps.clearcoat_roughness = read(info(coat, "clearcoatRoughnessTexture"), Encoding::Linear);
            maps.clearcoat_normal = read(info(coat, "clearcoatNormalTexture"), Encoding::Linear);
            factors.clearcoat_normal_scale =
                coat.get("clearcoatNormalTexture").map_or(1.0, |map| number(map, "scale", 1.0));
        }
        if let Some(sheen) = extension(READ[1]) {
            factors.sheen_color = [0, 1, 2].map(|i| {
                let part = sheen.get("sheenColorFactor").and_then(|color| color.get(i)).and_then(Value::as_f64);
                part.unwrap_or(0.0) as f32
            });
            factors.sheen_roughness = number(sheen, "sheenRoughnessFactor", 0.0);
            maps.sheen_color = read(info(sheen, "sheenColorTexture"), Encoding::Srgb);
            maps.sheen_roughness = read(info(sheen, "sheenRoughnessTexture"), Encoding::Linear);
        }
        if let Some(anisotropy) = extension(READ[2]) {
            factors.anisotropy = number(anisotropy, "anisotropyStrength", 0.0);
            factors.anisotropy_rotation = number(anisotropy, "anisotropyRotation", 0.0);
            maps.anisotropy = read(info(anisotropy, "anisotropyTexture"), Encoding::Linear);
        }
        for what in factors.bring_into_domain() {
            self.once(format!("material `{name}`: {what}"));
        }
        Material::from_gltf(name, GltfMaterial { factors, maps })
    }

    /// A texture in a place, or a warning.
    fn map(
        &mut self,
        info: &Info<'_>,
        material: &str,
        encoding: Encoding,
        known: &mut Known,
        loader: Loader<'_>,
    ) -> Option<Map> {
        let texture = match known.get(&(info.index, encoding)) {
            Some(texture) => texture.clone(),
            None => {
                let texture = self.texture(info.index, encoding, loader).map_err(|why| {
                    self.once(format!("material `{material}`: {why}; it is shaded without this picture"));
                });
                let texture = texture.ok().map(Arc::new);
                known.insert((info.index, encoding), texture.clone());
                texture
            }
        }?;
        let mut set = info.set;
        let (mut matrix, mut offset) = (Mat2::IDENTITY, Vec2::ZERO);
        if let Some(transform) = info.transform {
            // Scaled, then rotated counter-clockwise, then moved; v points down.
            let pair = |key: &str, or: f32| {
                let part = |i: usize| transform.get(key).and_then(|pair| pair.get(i)).and_then(Value::as_f64);
                Vec2::new(part(0).map_or(or, |x| x as f32), part(1).map_or(or, |x| x as f32))
            };
            let (sine, cosine) = number(transform, "rotation", 0.0).sin_cos();
            let rotation = Mat2::from_cols(Vec2::new(cosine, -sine), Vec2::new(sine, cosine));
            matrix = rotation * Mat2::from_diagonal(pair("scale", 1.0));
            offset = pair("offset", 0.0);
            if let Some(other) = transform.get("texCoord").and_then(Value::as_u64) {
                set = u32::try_from(other).unwrap_or(u32::MAX);
            }
        }
        if set > 1 {
            self.once(format!(
                "material `{material}` uses set {set} of texture coordinates; the first stands in for it"
            ));
            set = 0;
        }
        Some(Map { texture, set: set as usize, transform: (matrix, offset) })
    }

    fn texture(&mut self, index: usize, encoding: Encoding, loader: Loader<'_>) -> Result<Texture, String> {
        let texture = self.document.textures().nth(index).ok_or_else(|| format!("there is no texture {index}"))?;
        // A picture in WebP stands in an extension, beside one that older programs can read.
        let webp =
            texture.extension_value("EXT_texture_webp").and_then(|webp| webp.get("source")).and_then(Value::as_u64);
        let image = webp.and_then(|index| self.document.images().nth(usize::try_from(index).ok()?));
        let image = image.or_else(|| texture.source()).ok_or_else(|| format!("texture {index} has no picture"))?;
        let name = name_of("picture", image.name(), image.index());
        // Not by `image.source()`, which panics on a picture without data (found by fuzzing; `no-data.gltf`).
        let json = self.document.as_json().images.get(image.index());
        let view = json.and_then(|json| self.document.views().nth(json.buffer_view?.value()));
        let bytes = match (view, json.and_then(|json| json.uri.as_ref())) {
            (Some(view), _) => accessor::slice(&view, &self.buffers).map(<[u8]>::to_vec),
            (None, Some(uri)) => fetch(uri, loader),
            (None, None) => Err("has neither a URI nor a buffer view".to_owned()),
        };
        let bytes = bytes.map_err(|why| format!("{name}: {why}"))?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(format!("{name} has more than {MAX_BYTES} bytes"));
        }
        let picture = picture::read(&bytes, &mut self.pictures).map_err(|why| format!("{name}: {why}"))?;
        let sampler = texture.sampler();
        let wrap = |mode| match mode {
            WrappingMode::Repeat => Wrap::Repeat,
            WrappingMode::MirroredRepeat => Wrap::Mirror,
            WrappingMode::ClampToEdge => Wrap::Clamp,
        };
        let sampler = Sampler {
            wrap: [wrap(sampler.wrap_s()), wrap(sampler.wrap_t())],
            nearest: sampler.mag_filter() == Some(MagFilter::Nearest),
        };
        Texture::new(picture.width, picture.height, picture.texels, encoding, sampler)
            .map_err(|error| format!("{name}: {error}"))
    }
}

/// A number of an extension.
fn number(object: &Value, key: &str, or: f32) -> f32 {
    object.get(key).and_then(Value::as_f64).map_or(or, |number| number as f32)
}

/// A texture of an extension.
fn info<'a>(object: &'a Value, key: &str) -> Option<Info<'a>> {
    let info = object.get(key)?;
    let index = usize::try_from(info.get("index")?.as_u64()?).ok()?;
    let set = info.get("texCoord").and_then(Value::as_u64).unwrap_or(0);
    let transform = info.get("extensions").and_then(|all| all.get("KHR_texture_transform"));
    Some(Info { index, set: u32::try_from(set).unwrap_or(u32::MAX), transform })
}
