//! Pictures and PBR statements in MTL, seen in pictures that are small enough to be checked.

use glam::Vec3;
use lobe_scene::obj::{self, Options};
use lobe_scene::{Background, Camera, Light, Material, Renderer, Scene, Settings, ShadingModel, View, mtl};
use std::collections::HashMap;
use std::io;

/// A square from −1 to 1 in the plane z = 0, with the texture upright on it.
const SQUARE: &str = "mtllib lib/a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                      usemtl m\nf 1/1 2/2 3/3 4/4\n";

fn png(width: u32, texels: &[[u8; 4]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, texels.len() as u32 / width);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().and_then(|mut to| to.write_image_data(texels.as_flattened())).expect("a picture");
    bytes
}

const RED: [u8; 4] = [255, 0, 0, 255];
const GREEN: [u8; 4] = [0, 255, 0, 255];
const BLUE: [u8; 4] = [0, 0, 255, 255];
const WHITE: [u8; 4] = [255, 255, 255, 255];
const BLACK: [u8; 4] = [0, 0, 0, 255];

fn load(library: &str, pictures: &[(&str, Vec<u8>)], shading: ShadingModel) -> (Scene, Vec<String>) {
    let pictures: HashMap<_, _> = pictures.iter().map(|(name, bytes)| (format!("lib/{name}"), bytes)).collect();
    let mut loader = |name: &str| match name {
        "lib/a.mtl" => Ok(format!("newmtl m\n{library}").into_bytes()),
        name => pictures.get(name).map(|bytes| bytes.to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into()),
    };
    let model = obj::parse(SQUARE, "a.obj", &mut loader, &Options::default()).expect("a model");
    let scene = Scene::from_model(model, shading);
    let warnings = scene.warnings.iter().map(ToString::to_string).collect();
    (scene, warnings)
}

/// The square fills the picture exactly, seen from +z; lit by `lights`.
fn shot(scene: &Scene, side: u32, lights: Vec<Light>) -> Vec<[f32; 3]> {
    let camera = Camera { eye: Vec3::new(0.0, 0.0, 5.0), target: Vec3::ZERO, height: Some(2.0), ..Camera::default() };
    let view =
        View { camera: Some(camera), lights: Some(lights), background: Background::default(), ..View::default() };
    let settings = Settings { width: side, height: side, ..Settings::default() };
    Renderer::new(scene).expect("a renderer").render(&view, &settings, None).expect("a picture").pixels().to_vec()
}

/// From straight above, so strong that a white diffuse surface sends out 1.
fn sun(to_light: Vec3) -> Vec<Light> {
    vec![Light::Directional { to_light, irradiance: lobe::Rgb::splat(std::f32::consts::PI) }]
}

fn near(a: [f32; 3], b: [f32; 3], tolerance: f32) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

#[test]
fn a_picture_lies_upright_and_its_options_move_it() {
    let corners = png(2, &[RED, GREEN, BLUE, WHITE]);
    for (options, expected) in [
        ("", [RED, GREEN, BLUE, WHITE]),
        // By half of its width: everything changes sides. By half of its height: above and below.
        ("-o 0.5 0 0", [GREEN, RED, WHITE, BLUE]),
        ("-o 0 0.5", [BLUE, WHITE, RED, GREEN]),
        // The lower left quarter, which is blue, fills everything.
        ("-clamp on -s 0.2 0.2", [BLUE; 4]),
        // The upper right one.
        ("-s 0.2 0.2 1 -o 0.65 0.65", [GREEN; 4]),
    ] {
        let pictures = [("tex/a b.png", corners.clone())];
        let (scene, warnings) =
            load(&format!("Kd 0.5\nillum 0\nmap_Kd {options} tex\\a b.png\n"), &pictures, ShadingModel::Phong);
        assert!(warnings.is_empty(), "{warnings:?}");
        // Texels are as large as a quarter of the picture: the corners of it are their middles' colours or beyond.
        let pixels = shot(&scene, 16, Vec::new());
        let found = [2 * 16 + 3, 2 * 16 + 12, 12 * 16 + 3, 12 * 16 + 12].map(|at| pixels[at]);
        for (found, expected) in found.into_iter().zip(expected) {
            let expected = [0, 1, 2].map(|i| f32::from(expected[i]) / 510.0);
            assert!(near(found, expected, 0.13), "{options}: {found:?} {expected:?}");
        }
    }
}

#[test]
fn each_picture_multiplies_its_number_alone() {
    // The left half of each picture is black.
    let half = [("half.png", png(2, &[BLACK, WHITE]))];
    let numbers = "Ka 0.1 0.1 0.1\nKd 0.5 0.25 0\nKs 0.25 0 0.5\nKe 0 0.125 0\nNs 20\nillum 2\n";
    let lights = || {
        let mut lights = sun(Vec3::Z);
        lights.push(Light::Ambient(lobe::Rgb::splat(1.0)));
        lights
    };
    for shading in ShadingModel::ALL {
        let plain = |numbers: &str| shot(&load(numbers, &[], shading).0, 1, lights())[0];
        let all = plain(numbers);
        for (map, without) in [
            ("map_Ka half.png", numbers.replace("Ka 0.1 0.1 0.1", "Ka 0")),
            ("map_Kd half.png", numbers.replace("Kd 0.5 0.25 0", "Kd 0")),
            ("map_Ks half.png", numbers.replace("Ks 0.25 0 0.5", "Ks 0")),
            ("map_Ke half.png", numbers.replace("Ke 0 0.125 0", "Ke 0")),
        ] {
            let (scene, warnings) = load(&format!("{numbers}{map}\n"), &half, shading);
            assert!(warnings.is_empty(), "{warnings:?}");
            // A texel for each pixel.
            let pixels = shot(&scene, 2, lights());
            let (left, right) = (pixels[0], pixels[1]);
            assert!(near(left, plain(&without), 2e-3), "{shading} {map}: {left:?} {:?}", plain(&without));
            assert!(near(right, all, 2e-3), "{shading} {map}: {right:?} {all:?}");
        }
    }
}

#[test]
fn a_hole_is_seen_through_and_lets_light_through() {
    // By alpha, by luminance, and by a channel that is named.
    for (texels, option) in
        [([[9, 9, 9, 0], [9, 9, 9, 255]], ""), ([BLACK, WHITE], ""), ([[0, 9, 9, 255], [255, 9, 9, 255]], "-imfchan r")]
    {
        for pbr in ["", "Pr 0.5\n"] {
            let library = format!("Kd 1\nillum 0\nKe 1 1 1\n{pbr}map_d {option} hole.png\n");
            let (scene, warnings) = load(&library, &[("hole.png", png(2, &texels))], ShadingModel::Phong);
            assert!(warnings.is_empty(), "{warnings:?}");
            let pixels = shot(&scene, 2, Vec::new());
            let [left, right] = [pixels[0], pixels[1]];
            let background = Background::default().radiance(-Vec3::Z);
            assert!(near(left, background.into(), 0.01), "{pbr}{option}: {left:?} {background:?}");
            assert!(right[0] > 0.95, "{pbr}{option}: {right:?}");
        }
    }
}

#[test]
fn normals_and_heights_turn_the_surface_to_the_light() {
    // Tilted by 45° to the left in the left half, and upwards in the right one.
    let slant = 127.5 + 127.5 * std::f32::consts::FRAC_1_SQRT_2;
    let (low, high) = ((255.0 - slant) as u8, slant as u8);
    let normals = png(2, &[[low, 128, high, 255], [128, high, high, 255]]);
    // Dark at the left, bright at the right: the surface falls to the left, with a slope of 1 and `-bm`.
    let ramp: Vec<[u8; 4]> = (0..64_u8).map(|x| [x, x, x, 255]).collect();
    let heights = png(64, &ramp);
    let (left, up) = (Vec3::new(-1.0, 0.0, 1.0), Vec3::new(0.0, 1.0, 1.0));
    for kind in ["norm", "bump", "map_Bump -bm 1"] {
        for pbr in ["", "Pr 1\nPm 0\n"] {
            let library = format!("Kd 1\n{pbr}{kind} n.png\n");
            let (scene, warnings) = load(&library, &[("n.png", normals.clone())], ShadingModel::Phong);
            assert!(warnings.is_empty(), "{warnings:?}");
            for (light, x, other) in [(left, 0, 1), (up, 1, 0)] {
                let pixels = shot(&scene, 2, sun(light));
                let (lit, turned) = (pixels[x][0], pixels[other][0]);
                // cos 0 and cos 60°; with a rough dielectric on top for PBR.
                assert!((lit - 1.0).abs() < 0.06 && (turned - 0.5).abs() < 0.06, "{kind} {pbr} {lit} {turned}");
            }
        }
    }
    let (scene, _) = load("Kd 1\nbump -bm 255 n.png\n", &[("n.png", heights)], ShadingModel::Phong);
    let lit = shot(&scene, 64, sun(left))[32 * 64 + 32][0];
    assert!((lit - 1.0).abs() < 0.01, "{lit}");
}

#[test]
fn statements_of_pbr_become_a_material_of_gltf() {
    let library = "Kd 0.5 0.25 0.125\nKs 1\nPr 0.5\nPm 0.25\nPs 0.1\nPc 0.75\nPcr 0.2\naniso 0.3\nanisor 0.25\nNi 1.4\nKe 2\nd 0.5\n";
    let (scene, warnings) = load(library, &[], ShadingModel::Phong);
    assert!(warnings.is_empty(), "{warnings:?}");
    let gltf = scene.materials[0].gltf().expect("a material of glTF");
    let f = &gltf.factors;
    assert_eq!(f.base_color, [0.5, 0.25, 0.125]);
    assert_eq!([f.roughness, f.metallic, f.clearcoat, f.clearcoat_roughness], [0.5, 0.25, 0.75, 0.2]);
    assert_eq!((f.sheen_color, f.anisotropy, f.ior, f.opacity), ([0.1; 3], 0.3, 1.4, 0.5));
    assert!((f.anisotropy_rotation - std::f32::consts::FRAC_PI_2).abs() < 1e-6 && f.blend && f.double_sided);
    assert_eq!(f.emission, [2.0; 3]);

    // An exponent stands for a roughness that is not given; pictures stand for their numbers.
    let (scene, _) = load("Ns 1248\nPm 1\n", &[], ShadingModel::Phong);
    let roughness = scene.materials[0].gltf().expect("a material of glTF").factors.roughness;
    assert!((roughness - 0.2).abs() < 1e-6, "{roughness}");
    let pictures = [("r.png", png(1, &[[64, 64, 64, 255]])), ("m.png", png(2, &[BLACK, WHITE]))];
    let (scene, warnings) = load("Ns 10\nmap_Pr r.png\nmap_Pm m.png\n", &pictures, ShadingModel::Phong);
    assert!(warnings.is_empty(), "{warnings:?}");
    let gltf = scene.materials[0].gltf().expect("a material of glTF");
    assert_eq!([gltf.factors.roughness, gltf.factors.metallic], [1.0, 1.0]);
    let map = gltf.maps.metallic_roughness.as_ref().expect("a map");
    assert_eq!(map.texture.size(), [2, 1]);
    let [_, roughness, metallic, _] = map.at([glam::Vec2::new(0.75, 0.5); 2], [0.0; 2]);
    assert!((roughness - 64.0 / 255.0).abs() < 1e-6 && metallic == 1.0, "{roughness} {metallic}");
}

#[test]
fn a_picture_that_cannot_be_used_is_said_once_and_the_rest_is_shaded() {
    let library =
        "Kd 0.5\nmap_Kd gone.png\nmap_Ks broken.png\nmap_Ke\nmap_d -s x.png\nmap_Ka -q 1 ok.png\ndisp d.png\n";
    let pictures = [("broken.png", b"\x89PNG\r\n".to_vec()), ("ok.png", png(1, &[WHITE]))];
    let (scene, warnings) = load(library, &pictures, ShadingModel::Phong);
    let expected = [
        "lib/a.mtl:5: material `m`: the map `map_Ke ` names no file, and has no effect",
        "lib/a.mtl:6: material `m`: the map `map_d -s x.png` has an option -s without a number, and has no effect",
        "lib/a.mtl:7: material `m`: the map `map_Ka -q 1 ok.png` has an option -q, which has no effect",
        "lib/a.mtl:8: material `m`: the map `disp d.png` is not supported and has no effect",
        "lib/a.mtl:3: material `m`: the picture `lib/gone.png` cannot be read: entity not found; it is shaded without this picture",
        "lib/a.mtl:4: material `m`: the picture `lib/broken.png` is not a whole PNG picture",
    ];
    assert_eq!(warnings.len(), expected.len(), "{warnings:#?}");
    for (found, expected) in warnings.iter().zip(expected) {
        assert!(found.starts_with(expected), "{found}\n{expected}");
    }
    assert!(scene.materials[0].mapped().is_some(), "one picture was there");
    let plain = Material::from_mtl(&mtl::MtlMaterial { kd: [0.5; 3], ..Default::default() }, ShadingModel::Phong);
    assert_eq!(plain.surface.lobes().len(), scene.materials[0].surface.lobes().len());
}
