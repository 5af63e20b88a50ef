//! glTF files, right and wrong, made here byte by byte.

use base64::Engine as _;
use glam::Vec3;
use lobe_scene::{Background, Error, Light, Renderer, Scene, Settings, Surface, View, gltf};
use serde_json::{Value, json};
use std::io;

/// A file with one buffer: accessors are added, and name their views by themselves.
struct File {
    json: Value,
    bytes: Vec<u8>,
}

const F32: u32 = 5126;
const U32: u32 = 5125;
const U16: u32 = 5123;
const I16: u32 = 5122;
const U8: u32 = 5121;
const I8: u32 = 5120;

impl File {
    /// A file with one mesh, `primitive`, in one node.
    fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}}]}],
            "accessors": [],
            "bufferViews": [],
            "buffers": [{"byteLength": 0}],
        });
        Self { json, bytes: Vec::new() }
    }

    /// A triangle in the plane z = 0.
    fn triangle() -> Self {
        let mut file = Self::new();
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        file.attribute("POSITION", positions);
        file
    }

    /// Bytes as a buffer view.
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        self.bytes.extend(bytes);
        self.push("bufferViews", view)
    }

    fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json.as_object_mut().expect("an object").entry(list).or_insert(json!([]));
        let list = list.as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({"bufferView": view, "componentType": component, "count": count, "type": kind}))
    }

    fn floats(&mut self, kind: &str, numbers: &[f32]) -> usize {
        let components = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(kind, F32, numbers.len() / components, &bytes)
    }

    fn attribute(&mut self, name: &str, accessor: usize) {
        self.json["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
    }

    fn indices(&mut self, indices: &[u32]) {
        let bytes: Vec<u8> = indices.iter().flat_map(|x| x.to_le_bytes()).collect();
        let accessor = self.accessor("SCALAR", U32, indices.len(), &bytes);
        self.primitive("indices", json!(accessor));
    }

    fn primitive(&mut self, key: &str, value: Value) {
        self.json["meshes"][0]["primitives"][0][key] = value;
    }

    /// One material for the mesh.
    fn material(&mut self, material: Value) {
        let material = self.push("materials", material);
        self.primitive("material", json!(material));
    }

    /// A picture of 8 bits as a texture.
    fn texture(&mut self, width: u32, height: u32, rgba: &[u8]) -> usize {
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.write_header().and_then(|mut writer| writer.write_image_data(rgba)).expect("a picture");
        let view = self.view(&png);
        let image = self.push("images", json!({"bufferView": view, "mimeType": "image/png"}));
        self.push("textures", json!({"source": image}))
    }

    fn text(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        let data = base64::engine::general_purpose::STANDARD.encode(&self.bytes);
        json["buffers"] = json!([{
            "byteLength": self.bytes.len(),
            "uri": format!("data:application/octet-stream;base64,{data}"),
        }]);
        json.to_string().into_bytes()
    }

    fn binary(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{"byteLength": self.bytes.len()}]);
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bytes = self.bytes.clone();
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        let word = |x: usize| (x as u32).to_le_bytes();
        let parts: [&[u8]; 9] = [
            b"glTF",
            &word(2),
            &word(12 + 8 + text.len() + 8 + bytes.len()),
            &word(text.len()),
            b"JSON",
            &text,
            &word(bytes.len()),
            b"BIN\0",
            &bytes,
        ];
        parts.concat()
    }

    fn read(&self) -> Result<Scene, Error> {
        read(&self.text())
    }
}

fn read(bytes: &[u8]) -> Result<Scene, Error> {
    gltf::parse(bytes, "a.gltf", &mut |_| Err(io::ErrorKind::NotFound.into()))
}

fn problem(bytes: &[u8]) -> String {
    read(bytes).map(|scene| format!("{} triangles", scene.triangle_count())).expect_err("it is wrong").to_string()
}

fn corners(scene: &Scene) -> Vec<[Vec3; 3]> {
    let mesh = &scene.meshes[0];
    mesh.triangles.iter().map(|triangle| triangle.positions.map(|at| mesh.positions[at as usize])).collect()
}

#[test]
fn text_and_binary_are_the_same_and_flat_without_normals() {
    let mut file = File::triangle();
    file.indices(&[0, 1, 2]);
    for bytes in [file.text(), file.binary()] {
        let scene = read(&bytes).expect("a scene");
        assert_eq!(corners(&scene), [[Vec3::ZERO, Vec3::X, Vec3::Y]]);
        let mesh = &scene.meshes[0];
        assert!(mesh.triangles[0].normals.iter().all(|&at| mesh.normals[at as usize] == Vec3::Z));
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        assert!(Renderer::new(&scene).is_ok());
    }
}

#[test]
fn strips_and_fans_have_one_front() {
    for (mode, order) in [(5, [0, 1, 2, 3]), (6, [0, 1, 3, 2])] {
        let mut file = File::new();
        let at = |i: usize| [(i % 2) as f32, (i / 2) as f32, 0.0];
        let positions: Vec<f32> = order.iter().flat_map(|&i| at(i)).collect();
        let positions = file.floats("VEC3", &positions);
        file.attribute("POSITION", positions);
        file.primitive("mode", json!(mode));
        let scene = file.read().expect("a scene");
        let all = corners(&scene);
        assert_eq!(all.len(), 2);
        assert!(all.iter().all(|[a, b, c]| (*b - *a).cross(*c - *a) == Vec3::Z), "mode {mode}: {all:?}");
    }
}

#[test]
fn a_mirrored_node_keeps_its_front_and_instances_are_copied() {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[0.0, 0.6, 0.8, 0.0, 0.6, 0.8, 0.0, 0.6, 0.8]);
    file.attribute("NORMAL", normals);
    file.json["nodes"] = json!([
        {"children": [1, 2], "translation": [0, 0, 5]},
        {"mesh": 0, "scale": [-1, 1, 1]},
        {"mesh": 0, "matrix": [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1]},
    ]);
    let scene = file.read().expect("a scene");
    assert_eq!(scene.meshes.len(), 2);
    let all: Vec<[Vec3; 3]> =
        scene.meshes.iter().map(|mesh| mesh.triangles[0].positions.map(|at| mesh.positions[at as usize])).collect();
    for [a, b, c] in &all {
        assert!((*b - *a).cross(*c - *a).z > 0.0 && a.z == 5.0, "{all:?}");
    }
    let normal = |mesh: usize| scene.meshes[mesh].normals[0];
    assert!((normal(0) - Vec3::new(0.0, 0.6, 0.8)).length() < 1e-6, "{}", normal(0));
    assert!(all.iter().any(|[a, ..]| a.x == 3.0));
}

#[test]
fn quantised_normalised_strided_and_sparse_numbers_are_read() {
    let mut file = File::new();
    // Positions of 16 bits, eight bytes apart.
    let bytes: Vec<u8> = [[0_i16, 0, 0], [32767, 0, 0], [0, 32767, 0]]
        .iter()
        .flat_map(|p| p.iter().chain(&[7]).flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>())
        .collect();
    let positions = file.accessor("VEC3", I16, 3, &bytes);
    file.json["accessors"][positions]["normalized"] = json!(true);
    let view = file.json["accessors"][positions]["bufferView"].as_u64().expect("a view") as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(8);
    file.attribute("POSITION", positions);
    // Normals of 8 bits; the last one is replaced.
    let normals = file.accessor("VEC3", I8, 3, &[0, 0, 127, 0, 0, 127, 0, 0, 127]);
    file.json["accessors"][normals]["normalized"] = json!(true);
    let place = file.view(&2_u16.to_le_bytes());
    let value = file.view(&[0, 127, 0]);
    file.json["accessors"][normals]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": place, "componentType": U16},
        "values": {"bufferView": value},
    });
    file.attribute("NORMAL", normals);
    let uv = file.accessor("VEC2", U8, 3, &[0, 0, 255, 0, 0, 51]);
    file.json["accessors"][uv]["normalized"] = json!(true);
    file.attribute("TEXCOORD_0", uv);
    file.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let scene = file.read().expect("a scene");
    assert_eq!(corners(&scene), [[Vec3::ZERO, Vec3::X, Vec3::Y]]);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.normals[2], Vec3::Y);
    assert_eq!(mesh.vertices[1].uv[0].x, 1.0);
    assert!((mesh.vertices[2].uv[0].y - 0.2).abs() < 1e-6);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn cameras_and_lights_become_views() {
    let mut file = File::triangle();
    file.json["cameras"] = json!([
        {"name": "lens", "type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 2.0, "ymag": 1.5, "zfar": 10.0, "znear": 0.1}},
    ]);
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": 3.0, "color": [1.0, 0.5, 0.25]},
        {"type": "spot", "intensity": 100.0, "range": 8.0, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}},
    ]}});
    file.json["scenes"] = json!([{"nodes": [0, 1, 2, 3, 4]}]);
    file.json["nodes"] = json!([
        {"mesh": 0},
        {"camera": 0, "translation": [0, 0, 4]},
        {"camera": 1, "translation": [0, 0, 4]},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [0, 0, 2]},
    ]);
    let scene = file.read().expect("a scene");
    let names: Vec<_> = scene.views.iter().map(|view| view.name.as_str()).collect();
    assert_eq!(names, ["lens", "camera 1"]);
    assert_eq!(scene.views[1].camera.and_then(|camera| camera.height), Some(3.0));
    let lights = scene.views[0].lights.as_ref().expect("lights");
    assert!(
        matches!(lights[0], Light::Directional { to_light, irradiance } if to_light == Vec3::Z && irradiance.g == 1.5)
    );
    let Light::Punctual { range, cone: Some(cone), .. } = lights[1] else { panic!("{lights:?}") };
    assert!(range == 8.0 && cone.part(Vec3::NEG_Z) == 1.0 && cone.part(Vec3::X) == 0.0);
    // Both look at the triangle; the orthographic one sees it as large as it is.
    for view in &scene.views {
        let settings = Settings { width: 60, height: 60, ..Settings::default() };
        let image = Renderer::new(&scene).expect("a renderer").render(view, &settings, None).expect("a picture");
        let lit = image.pixels().iter().filter(|pixel| pixel[0] > 0.06).count();
        // Half of a square of 1/3 of the picture's height: 200 pixels, of which some 50 are cut by an edge.
        assert!(view.name == "lens" || lit.abs_diff(200) < 25, "{}: {lit}", view.name);
        assert!(lit > 50, "{}: {lit}", view.name);
    }
}

/// Two triangles from −1 to 1 with texture coordinates, seen from straight above by an orthographic camera.
fn square(material: Value, textures: &[(u32, u32, Vec<u8>)]) -> File {
    let mut file = File::new();
    let positions = file.floats("VEC3", &[-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, -1.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
    let uv = file.floats("VEC2", &[0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    file.attribute("POSITION", positions);
    file.attribute("TEXCOORD_0", uv);
    file.primitive("mode", json!(5));
    for (width, height, texels) in textures {
        file.texture(*width, *height, texels);
    }
    file.material(material);
    file.json["cameras"] =
        json!([{"type": "orthographic", "orthographic": {"xmag": 1.0, "ymag": 1.0, "zfar": 10.0, "znear": 0.1}}]);
    file.push("nodes", json!({"camera": 0, "translation": [0, 0, 3]}));
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    file
}

/// The picture of the square, `side` pixels wide.
fn picture(file: &File, side: u32) -> Vec<[f32; 3]> {
    let scene = file.read().expect("a scene");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let settings = Settings { width: side, height: side, ..Settings::default() };
    let image = Renderer::new(&scene).expect("a renderer").render(&scene.views[0], &settings, None).expect("a picture");
    image.pixels().to_vec()
}

#[test]
fn a_texture_lies_the_right_way_round_and_is_filtered() {
    // Red, green; blue, white, from the upper left.
    let texels = vec![255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255];
    let unlit = json!({
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
        "extensions": {"KHR_materials_unlit": {}},
    });
    let mut file = square(unlit, &[(2, 2, texels)]);
    file.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
    file.json["samplers"] = json!([{"magFilter": 9728}]);
    file.json["textures"][0]["sampler"] = json!(0);
    let pixels = picture(&file, 4);
    assert_eq!(pixels[0], [1.0, 0.0, 0.0]);
    assert_eq!(pixels[3], [0.0, 1.0, 0.0]);
    assert_eq!(pixels[12], [0.0, 0.0, 1.0]);
    assert_eq!(pixels[15], [1.0, 1.0, 1.0]);
    // In one pixel it is the mean: half of each.
    let [r, g, b] = picture(&file, 1)[0];
    assert!([r, g, b].iter().all(|x| (x - 0.5).abs() < 0.01), "{r} {g} {b}");
}

#[test]
fn cut_outs_and_backs_are_seen_through() {
    let texels = vec![255, 255, 255, 255, 255, 255, 255, 0];
    let unlit = json!({
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
        "alphaMode": "MASK",
        "extensions": {"KHR_materials_unlit": {}},
    });
    let mut file = square(unlit, &[(2, 1, texels)]);
    file.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
    let pixels = picture(&file, 8);
    assert_eq!(pixels[0], [1.0; 3]);
    assert!(pixels[7][0] < 0.1, "the background");
    // From behind it is not there, but for one that has two sides.
    file.json["nodes"][0]["rotation"] = json!([0, 1, 0, 0]);
    assert!(picture(&file, 8).iter().all(|pixel| pixel[0] < 0.1));
    file.json["materials"][0]["doubleSided"] = json!(true);
    assert!(picture(&file, 8).iter().any(|pixel| pixel[0] == 1.0));
}

#[test]
fn blending_lets_a_part_through() {
    let unlit = json!({
        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]},
        "alphaMode": "BLEND",
        "extensions": {"KHR_materials_unlit": {}},
    });
    let mut file = square(unlit, &[]);
    file.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
    let [r, ..] = picture(&file, 2)[0];
    // The background is 0.05.
    assert!((r - (0.25 + 0.75 * 0.05)).abs() < 1e-6, "{r}");
}

/// The middle of the square, lit from one direction.
fn lit(material: Value, textures: &[(u32, u32, Vec<u8>)], used: &[&str]) -> [f32; 3] {
    let mut file = square(material, textures);
    let mut all = vec!["KHR_lights_punctual"];
    all.extend(used);
    file.json["extensionsUsed"] = json!(all);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 2.0}]}});
    // Down by 0.3 rad about the x axis.
    let (s, c) = 0.15_f32.sin_cos();
    let light = json!({"extensions": {"KHR_lights_punctual": {"light": 0}}, "rotation": [s, 0, 0, c]});
    file.push("nodes", light);
    file.json["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    picture(&file, 3)[4]
}

/// What a lobe of the catalogue gives there: light from 0.3 rad, seen from above.
fn expected(lobe: &str) -> [f32; 3] {
    let material = lobe_models::Material::from_json(&format!("{{\"lobes\": [{lobe}]}}")).expect("a lobe");
    let (s, c) = 0.3_f32.sin_cos();
    let l = lobe::Vec3::new(0.0, -s, c);
    let f = material.build::<f32>().eval_cos(l, lobe::Vec3::new(0.0, 0.0, 1.0));
    [f.r * 2.0, f.g * 2.0, f.b * 2.0]
}

fn near(found: [f32; 3], expected: [f32; 3]) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < 2e-5 * expected.abs().max(1e-3), "{found} {expected}");
    }
}

#[test]
fn materials_have_the_value_of_the_catalogue() {
    let pbr = json!({"baseColorFactor": [0.8, 0.5, 0.25, 1], "metallicFactor": 0.4, "roughnessFactor": 0.5});
    let base = r#""base-color": [0.8, 0.5, 0.25], "metallic": 0.4, "roughness": 0.5"#;
    near(lit(json!({"pbrMetallicRoughness": pbr}), &[], &[]), expected(&format!(r#"{{"model": "gltf", {base}}}"#)));
    let with = |name: &str, extension: Value| {
        lit(json!({"pbrMetallicRoughness": pbr, "extensions": {name: extension}}), &[], &[name])
    };
    near(
        with("KHR_materials_ior", json!({"ior": 2.0})),
        expected(&format!(r#"{{"model": "gltf", {base}, "ior": 2.0}}"#)),
    );
    near(
        with("KHR_materials_specular", json!({"specularFactor": 0.5, "specularColorFactor": [1, 2, 3]})),
        expected(&format!(r#"{{"model": "gltf", {base}, "specular": 0.5, "specular-color": [1, 2, 3]}}"#)),
    );
    near(
        with("KHR_materials_clearcoat", json!({"clearcoatFactor": 0.7, "clearcoatRoughnessFactor": 0.3})),
        expected(&format!(r#"{{"model": "gltf-clearcoat", {base}, "clearcoat": 0.7, "clearcoat-roughness": 0.3}}"#)),
    );
    near(
        with("KHR_materials_sheen", json!({"sheenColorFactor": [0.5, 0.25, 0], "sheenRoughnessFactor": 0.4})),
        expected(&format!(
            r#"{{"model": "gltf-sheen", {base}, "sheen-color": [0.5, 0.25, 0], "sheen-roughness": 0.4}}"#
        )),
    );
    // The tangent points along u, which is x; the light comes from −y.
    near(
        with("KHR_materials_anisotropy", json!({"anisotropyStrength": 0.6})),
        expected(&format!(r#"{{"model": "gltf", {base}, "anisotropy": 0.6}}"#)),
    );
    let turned = with("KHR_materials_anisotropy", json!({"anisotropyStrength": 0.6, "anisotropyRotation": 1.5707964}));
    let (s, c) = 0.3_f32.sin_cos();
    let material =
        lobe_models::Material::from_json(&format!(r#"{{"lobes": [{{"model": "gltf", {base}, "anisotropy": 0.6}}]}}"#))
            .expect("one");
    let f = material.build::<f32>().eval_cos(lobe::Vec3::new(-s, 0.0, c), lobe::Vec3::new(0.0, 0.0, 1.0));
    near(turned, [f.r * 2.0, f.g * 2.0, f.b * 2.0]);
}

#[test]
fn maps_multiply_their_factors() {
    // Linear 128/255 in every channel but sRGB where it is a colour.
    let half = 128.0 / 255.0;
    let grey = (1, 1, vec![128, 128, 128, 255]);
    let map = json!({"index": 0});
    let pbr = json!({
        "baseColorFactor": [0.8, 0.5, 0.25, 1], "baseColorTexture": map, "metallicFactor": 0.6, "roughnessFactor": 0.9,
        "metallicRoughnessTexture": map,
    });
    let colour = ((half + 0.055) / 1.055_f32).powf(2.4);
    let [r, g, b] = [0.8 * colour, 0.5 * colour, 0.25 * colour];
    let lobe = format!(
        r#"{{"model": "gltf", "base-color": [{r}, {g}, {b}], "metallic": {}, "roughness": {}}}"#,
        0.6 * half,
        0.9 * half
    );
    near(lit(json!({"pbrMetallicRoughness": pbr}), &[grey], &[]), expected(&lobe));
}

#[test]
fn a_flat_normal_map_changes_nothing_and_a_tilted_one_tilts() {
    let pbr = json!({"metallicFactor": 0.0, "roughnessFactor": 1.0});
    let plain = lit(json!({"pbrMetallicRoughness": pbr}), &[], &[]);
    let mapped = |texel: [u8; 3]| {
        let [x, y, z] = texel;
        lit(json!({"pbrMetallicRoughness": pbr, "normalTexture": {"index": 0}}), &[(1, 1, vec![x, y, z, 255])], &[])
    };
    let flat = mapped([128, 128, 255]);
    assert!((flat[0] / plain[0] - 1.0).abs() < 0.01, "{flat:?} {plain:?}");
    // Green up is +v of the picture's upper edge, which is +y here; the light comes from −y.
    assert!(mapped([128, 90, 250])[0] > 1.02 * plain[0]);
    assert!(mapped([128, 166, 250])[0] < 0.98 * plain[0]);
}

#[test]
fn what_is_not_supported_is_said_once_and_the_rest_is_shaded() {
    let mut file = File::triangle();
    file.material(json!({"name": "glass", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0}}}));
    file.json["extensionsUsed"] = json!(["KHR_materials_transmission"]);
    file.json["extensionsRequired"] = json!(["KHR_materials_transmission"]);
    let scene = file.read().expect("a scene");
    let said: Vec<_> = scene.warnings.iter().map(ToString::to_string).collect();
    assert!(
        said.iter().any(|text| text.contains("KHR_materials_transmission") && text.contains("`glass`")),
        "{said:?}"
    );
    assert!(matches!(scene.materials[0].surface, Surface::Gltf(_)));
}

#[test]
fn broken_files_say_what_is_wrong() {
    let whole = File::triangle();
    for cut in [4, 11, 19, 60, whole.binary().len() - 5] {
        let text = problem(&whole.binary()[..cut]);
        assert!(text.starts_with("a.gltf: ") || text.starts_with("a.gltf:1:"), "{cut}: {text}");
    }
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut file = File::triangle();
        file.indices(&[0, 1, 2]);
        change(&mut file.json);
        problem(&file.text())
    };
    for (change, expected) in [
        (&|json: &mut Value| json["accessors"][0]["count"] = json!(4) as Value, "past the end"),
        (&|json: &mut Value| json["accessors"][0]["count"] = json!(4_294_967_295_u32), "past the end"),
        (&|json: &mut Value| json["bufferViews"][0]["byteOffset"] = json!(1_000_000), "needs bytes 1000000"),
        (&|json: &mut Value| json["bufferViews"][0]["byteLength"] = json!(u32::MAX), "of buffer 0, which has"),
        (&|json: &mut Value| json["accessors"][0]["type"] = json!("VEC2"), "where 3 numbers are read"),
        (&|json: &mut Value| json["accessors"][1]["componentType"] = json!(F32), "unsigned whole numbers"),
        (
            &|json: &mut Value| json["meshes"][0]["primitives"][0]["indices"] = json!(77),
            "names something that is not there",
        ),
        (&|json: &mut Value| json["scenes"][0]["nodes"] = json!([9]), "names something that is not there"),
        (&|json: &mut Value| json["nodes"] = json!([{"children": [0], "mesh": 0}]), "node 0 is reached twice"),
        (&|json: &mut Value| json["nodes"] = json!([{"scale": [1e39, 1, 1], "mesh": 0}]), "a.gltf"),
        (&|json: &mut Value| json["nodes"] = json!([{"mesh": 0, "translation": [1e20, 0, 0]}]), "at most 1e9"),
        (&|json: &mut Value| json["meshes"] = json!([]), "a.gltf"),
        (&|json: &mut Value| json["asset"] = json!({}), "missing field `version`"),
    ] as [(&dyn Fn(&mut Value), &str); 13]
    {
        let text = changed(change);
        assert!(text.contains(expected), "{text}\nexpected: {expected}");
    }
    assert!(problem(b"glTF\x01\0\0\0\x0c\0\0\0").contains("version 1"));
    assert!(problem(b"solid").contains("a .gltf file is JSON"));
    let mut file = File::triangle();
    file.indices(&[0, 1, 3]);
    assert!(problem(&file.text()).contains("mesh 0: it has the index 3, and 3 points"));
}

#[test]
fn a_zero_accessor_of_billions_takes_no_memory() {
    let mut file = File::triangle();
    let index = file.view(&[0]);
    let value = file.view(&[0; 12]);
    file.json["accessors"][0] = json!({
        "componentType": F32, "count": 4_000_000_000_u32, "type": "VEC3",
        "sparse": {"count": 1, "indices": {"bufferView": index, "componentType": U8}, "values": {"bufferView": value}},
    });
    let text = problem(&file.text());
    assert!(text.contains("4000000000 elements without data"), "{text}");
}

#[test]
fn normals_that_are_not_numbers_are_replaced() {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0, f32::NAN, 0.0, 1.0, 0.0, 0.0, 0.0]);
    file.attribute("NORMAL", normals);
    let scene = file.read().expect("a scene");
    assert!(scene.warnings[0].text.contains("normals without a direction"));
    let mesh = &scene.meshes[0];
    assert!(mesh.triangles[0].normals.iter().all(|&at| mesh.normals[at as usize] == Vec3::Z));
    assert!(Renderer::new(&scene).is_ok());
}

#[test]
fn pictures_that_lie_and_paths_that_lead_out_are_left_out_with_a_warning() {
    let mut png = vec![0x89, b'P', b'N', b'G', 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13];
    let mut header = b"IHDR".to_vec();
    header.extend(60_000_u32.to_be_bytes());
    header.extend(60_000_u32.to_be_bytes());
    header.extend([8, 6, 0, 0, 0]);
    png.extend(&header);
    png.extend([0xd8, 0x8e, 0x2b, 0x3b]);
    let data = base64::engine::general_purpose::STANDARD.encode(&png);
    for (uri, expected) in [
        (format!("data:image/png;base64,{data}"), "picture 0"),
        ("../secret.png".to_owned(), "leads out of the folder"),
        ("/etc/passwd".to_owned(), "leads out of the folder"),
        ("a/%2e%2e/%2e%2e/b.png".to_owned(), "leads out of the folder"),
        ("https://example.com/a.png".to_owned(), "is an address"),
        ("data:image/png;base64,!!".to_owned(), "not base64"),
        ("not-there.png".to_owned(), "cannot read `not-there.png`"),
    ] {
        let mut file = File::triangle();
        file.push("images", json!({"uri": uri}));
        file.push("textures", json!({"source": 0}));
        file.material(json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}));
        let scene = file.read().expect("a scene without its picture");
        let text = &scene.warnings.first().expect("a warning").text;
        assert!(text.contains(expected) && text.contains("shaded without this picture"), "{text}");
    }
    let mut file = File::triangle();
    file.json["buffers"] = json!([{"byteLength": 36, "uri": "../a.bin"}]);
    let text = problem(&file.json.to_string().into_bytes());
    assert!(text.contains("leads out of the folder"), "{text}");
}

#[test]
fn the_scene_of_materials_is_read_whole() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/materials.glb");
    let scene = gltf::load(&path).expect("the scene");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert_eq!((scene.materials.len(), scene.meshes.len()), (13, 13));
    let lights = scene.views[0].lights.as_ref().map(Vec::len);
    assert_eq!((scene.views[0].name.as_str(), lights), ("front", Some(3)));
    // Bumps need tangents, and plain spheres do not.
    let has_tangents = |mesh: usize| scene.meshes[mesh].vertices.iter().any(|vertex| vertex.tangent.w != 0.0);
    assert!(has_tangents(3) && has_tangents(7) && !has_tangents(0));
    let settings = Settings { width: 64, height: 36, ..Settings::default() };
    let image = Renderer::new(&scene).expect("a renderer").render(&scene.views[0], &settings, None).expect("a picture");
    assert!(image.pixels().iter().flatten().all(|x| x.is_finite() && *x >= 0.0));
}

/// From its edge the pixel's square on the surface is larger than any texture.
#[test]
fn a_texture_seen_from_its_edge_is_filtered() {
    let texels: Vec<u8> = (0..64 * 64)
        .flat_map(|at| [if (at + at / 64) % 2 == 0 { 255 } else { 0 }; 3].into_iter().chain([255]))
        .collect();
    let unlit = json!({
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
        "doubleSided": true,
        "extensions": {"KHR_materials_unlit": {}},
    });
    let mut file = square(unlit, &[(64, 64, texels)]);
    file.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
    // 0.1 degrees off the edge: every row of the picture sees many texels.
    let (s, c) = ((90.0_f32 - 0.1).to_radians() / 2.0).sin_cos();
    file.json["nodes"][0]["rotation"] = json!([s, 0, 0, c]);
    let seen: Vec<f32> = picture(&file, 1001).into_iter().map(|p| p[0]).filter(|x| (*x - 0.05).abs() > 1e-6).collect();
    assert!(seen.len() > 900, "{}", seen.len());
    assert!(seen.iter().all(|x| (x - 0.5).abs() < 0.02), "{seen:?}");
}

/// Sixteen meshes of a million zeros each, with one triangle: a thousand bytes that must not become gigabytes.
#[test]
fn points_that_no_triangle_has_are_dropped() {
    let mut file = File::triangle();
    let places = file.view(&[0, 1, 2]);
    let values = file.json["accessors"][0]["bufferView"].clone();
    file.json["accessors"][0] = json!({
        "componentType": F32, "count": 1 << 20, "type": "VEC3",
        "sparse": {"count": 3, "indices": {"bufferView": places, "componentType": U8}, "values": {"bufferView": values}},
    });
    let scene = file.read().expect("a scene");
    assert_eq!(corners(&scene), [[Vec3::ZERO, Vec3::X, Vec3::Y]]);
    assert_eq!(scene.meshes[0].positions.len(), 3);
    file.json["nodes"] = json!((0..16).map(|_| json!({"mesh": 0})).collect::<Vec<_>>());
    file.json["scenes"] = json!([{"nodes": (0..16).collect::<Vec<_>>()}]);
    let text = file.read().expect_err("15 million points are enough").to_string();
    assert!(text.contains("15728640 points, copies counted"), "{text}");
}

/// What a coat lets through of the base it lets through of the light that the base sends out.
#[test]
fn a_coat_is_above_the_emission_too() {
    let material = |coat: f64| {
        json!({
            "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0},
            "emissiveFactor": [1, 0.5, 0.25],
            "extensions": {
                "KHR_materials_clearcoat": {"clearcoatFactor": coat, "clearcoatRoughnessFactor": 1},
                "KHR_materials_specular": {"specularFactor": 0},
            },
        })
    };
    let used = ["KHR_materials_clearcoat", "KHR_materials_specular"];
    let lights = |coat: f64| lit(material(coat), &[], &used);
    let (with, without) = (lights(1.0), lights(0.0));
    let coat = expected(
        r#"{"model": "gltf-clearcoat", "base-color": 0, "specular": 0, "metallic": 0, "clearcoat-roughness": 1}"#,
    );
    for ((with, without), coat) in with.into_iter().zip(without).zip(coat) {
        assert!((with - coat - 0.96 * without).abs() < 1e-5, "{with} {without} {coat}");
    }
}

/// A mirror of metal, tilted up and down, under a sky of 2 over a ground of 0, and then under another square.
#[test]
fn metals_show_the_environment_and_what_stands_before_it() {
    let metal = json!({"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1], "roughnessFactor": 0.01}});
    let seen = |degrees: f32, covered: bool| {
        let mut file = square(metal.clone(), &[]);
        let (s, c) = (degrees.to_radians() / 2.0).sin_cos();
        file.json["nodes"][0]["rotation"] = json!([s, 0, 0, c]);
        if covered {
            // Two above it, facing down; its own colour is what is seen of it.
            file.json["nodes"].as_array_mut().expect("a list").push(json!({
                "mesh": 0, "translation": [0, 2, 0], "rotation": [std::f32::consts::FRAC_1_SQRT_2, 0, 0, std::f32::consts::FRAC_1_SQRT_2],
            }));
            file.json["scenes"] = json!([{"nodes": [0, 1, 2]}]);
        }
        let scene = file.read().expect("a scene");
        let view = View {
            background: Background::Gradient { bottom: lobe::Rgb::splat(0.0), top: lobe::Rgb::splat(2.0) },
            lights: Some(vec![Light::Ambient(lobe::Rgb::splat(0.5))]),
            ..scene.views[0].clone()
        };
        let settings = Settings { width: 3, height: 3, ..Settings::default() };
        let image = Renderer::new(&scene).expect("a renderer").render(&view, &settings, None).expect("a picture");
        image.pixels()[4]
    };
    // Half of the sky is what the ambient light of 0.5 is on the mean; Karis' fit has a metal reflect its base colour, roughly.
    let near = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.06);
    assert!(near(seen(-45.0, false), [1.0, 0.5, 0.0]), "{:?}", seen(-45.0, false));
    assert!(near(seen(45.0, false), [0.0; 3]), "{:?}", seen(45.0, false));
    assert!(near(seen(0.0, false), [0.5, 0.25, 0.0]), "{:?}", seen(0.0, false));
    assert!(near(seen(-45.0, true), [0.5, 0.125, 0.0]), "{:?}", seen(-45.0, true));
}

#[test]
fn pictures_without_data_and_cameras_of_another_kind_are_named() {
    let mut file = File::triangle();
    file.push("images", json!({}));
    file.push("textures", json!({"source": 0}));
    file.push("textures", json!({}));
    file.material(json!({"normalTexture": {"index": 0}, "emissiveTexture": {"index": 1}}));
    let warnings: Vec<_> = file.read().expect("a scene").warnings.into_iter().map(|warning| warning.text).collect();
    let expected = ["texture 1 has no picture", "picture 0: has neither a URI nor a buffer view"];
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    for expected in expected {
        assert!(warnings.iter().any(|text| text.contains(expected)), "{warnings:?}");
    }
    let mut file = File::triangle();
    file.json["cameras"] =
        json!([{"type": "perspective", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 9, "znear": 1}}]);
    let text = file.read().expect_err("not its numbers").to_string();
    assert!(text.contains("camera 0 is perspective, and has no `perspective`"), "{text}");
}
