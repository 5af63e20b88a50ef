//! Writes the glTF scene of materials: `cargo run --example make_gltf` from the root of the repository.
//!
//! Twelve spheres on a floor, each a material of glTF 2.0: metals, a mirror, plastic, a car paint, cloth, brushed metal, chalk,
//! and some with textures. One sphere is in the file, and twelve nodes show it.

use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::path::Path;

fn main() -> std::io::Result<()> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/materials.glb");
    std::fs::write(path, file()?)
}

/// The bytes of the file.
pub(crate) fn file() -> std::io::Result<Vec<u8>> {
    let mut glb = Glb { views: Vec::new(), accessors: Vec::new(), bytes: Vec::new() };
    let sphere = glb.sphere(64);
    let floor = glb.floor();
    let images = [glb.picture(&tiles())?, glb.picture(&bumps())?];

    let materials = materials();
    let columns = 4;
    let mut nodes: Vec<Value> = (0..materials.len() - 1)
        .map(|at| {
            let (row, column) = (at / columns, at % columns);
            json!({
                "name": materials[at]["name"],
                "mesh": at,
                "translation": [2.3 * column as f64 - 3.45, 1.0, -2.6 * row as f64 + 2.6],
            })
        })
        .collect();
    let mut meshes: Vec<Value> =
        (0..materials.len() - 1).map(|at| json!({"primitives": [sphere.primitive(at)]})).collect();
    meshes.push(json!({"name": "floor", "primitives": [floor.primitive(materials.len() - 1)]}));
    nodes.push(json!({"name": "floor", "mesh": materials.len() - 1}));
    // Down by 27°: the quaternion of a turn about x.
    let (s, c) = (-0.235_f64).sin_cos();
    nodes.push(json!({"name": "front", "camera": 0, "translation": [0, 6.6, 12.6], "rotation": [s, 0, 0, c]}));
    let (s, c) = (-0.5_f64).sin_cos();
    nodes.push(json!({"name": "sun", "rotation": [s, 0.2, 0, c], "extensions": {"KHR_lights_punctual": {"light": 0}}}));
    nodes.push(json!({"name": "lamp", "translation": [-6, 7, 5], "extensions": {"KHR_lights_punctual": {"light": 1}}}));
    nodes.push(json!({
        "name": "spot", "translation": [5.5, 8, 2], "rotation": [-0.66, 0.21, 0.21, 0.69],
        "extensions": {"KHR_lights_punctual": {"light": 2}},
    }));
    let root = json!({
        "asset": {"version": "2.0", "generator": "the example make_gltf of lobe-scene"},
        "scene": 0,
        "scenes": [{"nodes": (0..nodes.len()).collect::<Vec<_>>()}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "cameras": [{"name": "front", "type": "perspective", "perspective": {"yfov": 0.52, "znear": 0.1}}],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "directional", "intensity": 1.6, "color": [1, 0.95, 0.9]},
            {"type": "point", "intensity": 130, "color": [0.85, 0.92, 1]},
            {"type": "spot", "intensity": 160, "range": 40, "spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.6}},
        ]}},
        "extensionsUsed": [
            "KHR_lights_punctual", "KHR_materials_anisotropy", "KHR_materials_clearcoat",
            "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_sheen", "KHR_materials_specular",
            "KHR_texture_transform",
        ],
        "images": images.map(|view| json!({"bufferView": view, "mimeType": "image/png"})),
        "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
        "textures": [{"source": 0, "sampler": 0}, {"source": 1, "sampler": 0}],
        "accessors": glb.accessors,
        "bufferViews": glb.views,
        "buffers": [{"byteLength": glb.bytes.len()}],
    });
    let mut text = root.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let word = |x: usize| (x as u32).to_le_bytes();
    let length = 12 + 8 + text.len() + 8 + glb.bytes.len();
    Ok([
        b"glTF".as_slice(),
        &word(2),
        &word(length),
        &word(text.len()),
        b"JSON",
        &text,
        &word(glb.bytes.len()),
        b"BIN\0",
        &glb.bytes,
    ]
    .concat())
}

/// The materials of the spheres, and the floor's.
fn materials() -> Vec<Value> {
    let plain = |name: &str, color: [f64; 3], metallic: f64, roughness: f64| {
        let [r, g, b] = color;
        json!({"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1], "metallicFactor": metallic, "roughnessFactor": roughness,
        }})
    };
    let with = |mut material: Value, name: &str, extension: Value| {
        material["extensions"][name] = extension;
        material
    };
    let textured = |mut material: Value, scale: f64| {
        let map = |index: usize| json!({"index": index, "extensions": {"KHR_texture_transform": {"scale": [2.0 * scale, scale]}}});
        material["pbrMetallicRoughness"]["baseColorTexture"] = map(0);
        material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = map(0);
        material["normalTexture"] = map(1);
        material
    };
    let gold = [1.0, 0.77, 0.34];
    vec![
        plain("gold", gold, 1.0, 0.25),
        with(
            plain("brushed metal", [0.9, 0.9, 0.92], 1.0, 0.3),
            "KHR_materials_anisotropy",
            json!({"anisotropyStrength": 0.8}),
        ),
        plain("copper, rough", [0.95, 0.64, 0.54], 1.0, 0.6),
        textured(plain("tiles", [1.0, 1.0, 1.0], 1.0, 1.0), 6.0),
        plain("red plastic", [0.6, 0.03, 0.03], 0.0, 0.2),
        with(
            plain("car paint", [0.02, 0.12, 0.4], 0.6, 0.45),
            "KHR_materials_clearcoat",
            json!({"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.05}),
        ),
        with(
            plain("velvet", [0.25, 0.02, 0.12], 0.0, 0.9),
            "KHR_materials_sheen",
            json!({"sheenColorFactor": [0.9, 0.35, 0.6], "sheenRoughnessFactor": 0.4}),
        ),
        {
            let mut bumpy = plain("bumps under a coat", [0.05, 0.3, 0.1], 0.0, 0.5);
            let scale = json!({"KHR_texture_transform": {"scale": [8, 4]}});
            bumpy["normalTexture"] = json!({"index": 1, "extensions": scale});
            with(bumpy, "KHR_materials_clearcoat", json!({"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.08}))
        },
        plain("mirror", [0.95, 0.95, 0.95], 1.0, 0.02),
        with(plain("high index", [0.4, 0.4, 0.45], 0.0, 0.15), "KHR_materials_ior", json!({"ior": 2.4})),
        with(
            plain("chalk without gloss", [0.85, 0.85, 0.8], 0.0, 0.7),
            "KHR_materials_specular",
            json!({"specularFactor": 0.0}),
        ),
        {
            let mut lamp = plain("glowing", [0.1, 0.1, 0.1], 0.0, 0.4);
            lamp["emissiveFactor"] = json!([1.0, 0.5, 0.12]);
            with(lamp, "KHR_materials_emissive_strength", json!({"emissiveStrength": 1.4}))
        },
        plain("floor", [0.22, 0.225, 0.24], 0.0, 0.55),
    ]
}

/// A binary file being made.
struct Glb {
    views: Vec<Value>,
    accessors: Vec<Value>,
    bytes: Vec<u8>,
}

/// The accessors of a mesh.
struct Mesh {
    attributes: Value,
    indices: usize,
}

impl Mesh {
    fn primitive(&self, material: usize) -> Value {
        json!({"attributes": self.attributes, "indices": self.indices, "material": material})
    }
}

impl Glb {
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()}));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    fn floats<const N: usize>(&mut self, kind: &str, elements: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = elements.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let bound = |pick: fn(f32, f32) -> f32| {
            (0..N).map(|i| elements.iter().map(|e| e[i]).reduce(pick).unwrap_or(0.0)).collect::<Vec<_>>()
        };
        self.accessors.push(json!({
            "bufferView": view, "componentType": 5126, "count": elements.len(), "type": kind,
            "min": bound(f32::min), "max": bound(f32::max),
        }));
        self.accessors.len() - 1
    }

    fn mesh(&mut self, points: &[([f32; 3], [f32; 3], [f32; 2])], faces: &[[u16; 3]]) -> Mesh {
        let position = self.floats("VEC3", &points.iter().map(|p| p.0).collect::<Vec<_>>());
        let normal = self.floats("VEC3", &points.iter().map(|p| p.1).collect::<Vec<_>>());
        let uv = self.floats("VEC2", &points.iter().map(|p| p.2).collect::<Vec<_>>());
        let bytes: Vec<u8> = faces.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes);
        self.accessors
            .push(json!({"bufferView": view, "componentType": 5123, "count": 3 * faces.len(), "type": "SCALAR"}));
        let attributes = json!({"POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv});
        Mesh { attributes, indices: self.accessors.len() - 1 }
    }

    /// The unit sphere, with a seam for its texture coordinates.
    fn sphere(&mut self, around: u16) -> Mesh {
        let rings = around / 2;
        let mut points = Vec::new();
        for ring in 0..=rings {
            for step in 0..=around {
                let (u, v) = (f64::from(step) / f64::from(around), f64::from(ring) / f64::from(rings));
                let ((st, ct), (sp, cp)) = ((PI * v).sin_cos(), (TAU * u).sin_cos());
                let p = [st * sp, ct, st * cp].map(|x| x as f32);
                points.push((p, p, [u as f32, v as f32]));
            }
        }
        let at = |ring: u16, step: u16| ring * (around + 1) + step;
        let mut faces = Vec::new();
        for ring in 0..rings {
            for step in 0..around {
                let [a, b, c, d] = [at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)];
                if ring + 1 < rings {
                    faces.push([a, b, c]);
                }
                if ring > 0 {
                    faces.push([a, c, d]);
                }
            }
        }
        self.mesh(&points, &faces)
    }

    fn floor(&mut self) -> Mesh {
        let corner = |x: f32, z: f32| ([14.0 * x, 0.0, 14.0 * z], [0.0, 1.0, 0.0], [x, z]);
        let points = [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)];
        self.mesh(&points, &[[0, 1, 2], [0, 2, 3]])
    }

    fn picture(&mut self, rgb: &[[u8; 3]]) -> std::io::Result<usize> {
        let side = rgb.len().isqrt() as u32;
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, side, side);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header()?.write_image_data(rgb.as_flattened())?;
        Ok(self.view(&bytes))
    }
}

const SIDE: usize = 128;

fn each_texel(texel: impl Fn(f64, f64) -> [f64; 3]) -> Vec<[u8; 3]> {
    let at = |i: usize| (i as f64 + 0.5) / SIDE as f64;
    let code = |x: f64| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    (0..SIDE * SIDE).map(|i| texel(at(i % SIDE), at(i / SIDE)).map(code)).collect()
}

/// Tiles and grout: as a colour, and as roughness (G) and metallic (B).
fn tiles() -> Vec<[u8; 3]> {
    each_texel(|u, v| {
        let grout = [u, v].into_iter().any(|x| !(0.06..=0.94).contains(&x));
        let dark = ((2.0 * u).floor() + (2.0 * v).floor()) as i64 % 2 == 0;
        match (grout, dark) {
            (true, _) => [0.45, 0.9, 0.1],
            (false, true) => [0.95, 0.25, 0.95],
            (false, false) => [0.55, 0.35, 0.7],
        }
    })
}

/// A round bump in each tile, as normals.
fn bumps() -> Vec<[u8; 3]> {
    each_texel(|u, v| {
        let (x, y) = (u - 0.5, v - 0.5);
        let r2 = (x * x + y * y) / 0.16;
        // The height is (1 − r²)²; v points down, y of the normal up.
        let slope = if r2 < 1.0 { 1.6 * (1.0 - r2) } else { 0.0 };
        let n = [slope * x * 2.5, -slope * y * 2.5, 1.0];
        let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        n.map(|c| 0.5 + 0.5 * c / length)
    })
}
