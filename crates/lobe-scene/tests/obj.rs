//! What the readers of OBJ and MTL accept, what they refuse, and where they say it is.

use glam::Vec3;
use lobe_scene::mtl::{self, Illumination};
use lobe_scene::obj::{self, Model, Options};
use lobe_scene::{Error, Warning};
use proptest::prelude::*;
use std::io;

const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn parse(text: &str) -> Result<Model, Error> {
    parse_with(text, "")
}

fn parse_with(text: &str, library: &str) -> Result<Model, Error> {
    let mut loader = |name: &str| match name {
        "a.mtl" => Ok(library.as_bytes().to_vec()),
        _ => Err(io::ErrorKind::NotFound.into()),
    };
    obj::parse(text, "dir/a.obj", &mut loader, &Options::default())
}

fn texts(warnings: &[Warning]) -> Vec<String> {
    warnings.iter().map(ToString::to_string).collect()
}

/// A wrong line is reported with its number, what is wrong and what would be right.
#[test]
fn each_error_names_its_line() {
    let cases = [
        ("f 1 2", "5: a face with 2 corners; write `f` and three"),
        ("f 1", "5: a face with 1 corner;"),
        ("f", "5: a face with 0 corners;"),
        ("f 1 2 0", "5: index 0 in `0`; the first `v` is 1"),
        ("f 1 2 5", "5: index 5 in `5` is out of range; 4 `v` stand above this line"),
        ("f 1 2 -5", "5: index -5 in `-5` is out of range"),
        ("f 1 2 99999999999999999999999999", "5: index 99999999999999999999999999 in"),
        ("f 1 2 x", "5: `x` is not a corner; write `f`"),
        ("f 1 2 -", "5: `-` is not a corner"),
        ("f 1 2 3.0", "5: `3.0` is not a corner"),
        ("f 1/ 2/ 3/", "5: `1/` is not a corner"),
        ("f /1 /2 /3", "5: `/1` is not a corner"),
        ("f 1//", "5: `1//` is not a corner"),
        ("f 1/1/1/1 2 3", "5: `1/1/1/1` is not a corner"),
        ("f 1/1 2/1 3/1", "5: index 1 in `1/1` is out of range; 0 `vt`"),
        ("f 1//1 2//1 3//1", "5: index 1 in `1//1` is out of range; 0 `vn`"),
        ("vn 0 0 1\nf 1//1 2 3", "6: the corner `2` is not written like the first one, v//vn;"),
        ("v 1 2", "5: v has 2 numbers; write `v x y z`"),
        ("v 1 2 3 4 5", "5: v has 5 numbers"),
        ("v 1 2 3 4 5 6 7 8", "5: v has 8 numbers"),
        ("v 1 2 nan", "5: `nan` is not a finite number;"),
        ("v inf 2 3", "5: `inf` is not a finite number"),
        ("v 1 2 1e39", "5: `1e39` is not a finite number"),
        ("v 1 2 2e9", "5: the coordinate 2000000000 is too far out; coordinates go up to 1e9"),
        ("v 1 2 3a", "5: `3a` is not a number; write a decimal number"),
        ("vt", "5: vt has 0 numbers"),
        ("vt 1 2 3 4", "5: vt has 4 numbers"),
        ("vn 1 0", "5: vn has 2 numbers"),
        ("vn 1 0 NaN", "5: `NaN` is not a finite number"),
        ("s some", "5: the smoothing group is `some`; write `s off` or `s number`"),
        ("s -1", "5: the smoothing group is `-1`"),
        ("usemtl", "5: usemtl without a name"),
        ("mtllib", "5: mtllib without a name"),
        ("# \\\n\nf 1 2 \\\n 3 \\\n 9", "7: index 9 in `9`"),
    ];
    for (line, expected) in cases {
        // With Windows line ends the lines are the same.
        for text in [format!("{POINTS}{line}\n"), format!("{POINTS}{line}\n").replace('\n', "\r\n")] {
            let message = parse(&text).map(|_| ()).expect_err(line).to_string();
            assert!(message.starts_with(&format!("dir/a.obj:{expected}")), "{line}: {message}");
        }
    }
    let message = parse(POINTS).expect_err("no face").to_string();
    assert!(message.starts_with("dir/a.obj: no triangle"), "{message}");
    let message = obj::load("nowhere/a.obj".as_ref(), &Options::default()).expect_err("no file").to_string();
    assert!(message.starts_with("nowhere/a.obj: cannot read this file"), "{message}");
    assert!(obj::parse(POINTS, "a", &mut |_| Ok(Vec::new()), &Options { crease_degrees: f32::NAN }).is_err());
}

#[test]
fn each_error_in_a_library_names_its_line() {
    let cases = [
        ("Kd 1 0", "2: Kd has 2 numbers; write `Kd r g b`"),
        ("Kd", "2: Kd has 0 numbers"),
        ("Ks 1 1 1 1", "2: Ks has more than 3 numbers"),
        ("Ka 1 -0.5 1", "2: Ka is -0.5; a colour has no negative part"),
        ("Ke 1 x 1", "2: `x` is not a number"),
        ("Kd nan 0 0", "2: `nan` is not a finite number"),
        ("Ns -1", "2: Ns is -1; an exponent lies between 0 and 1000000"),
        ("Ns 1000001", "2: Ns is 1000001; an exponent"),
        ("Ns inf", "2: `inf` is not a finite number"),
        ("Ns", "2: Ns without a number; write `Ns number`"),
        ("Ns 1 2", "2: Ns has more than one number"),
        ("d 1.5", "2: d is 1.5; it lies between 0 and 1"),
        ("d -0.1", "2: d is -0.1; it lies between 0 and 1"),
        ("Tr 2", "2: Tr is 2; it lies between 0 and 1"),
        ("illum 11", "2: illum is `11`; it is a whole number from 0 to 10"),
        ("illum -1", "2: illum is `-1`"),
        ("illum", "2: illum is ``"),
        ("newmtl", "2: newmtl without a name"),
        ("Pr 1.5", "2: Pr is 1.5; it lies between 0 and 1"),
        ("aniso x", "2: `x` is not a number"),
    ];
    for (line, expected) in cases {
        let message = parse_with(&format!("mtllib a.mtl\n{POINTS}f 1 2 3"), &format!("newmtl m\n{line}\n"))
            .expect_err(line)
            .to_string();
        assert!(message.starts_with(&format!("dir/a.mtl:{expected}")), "{line}: {message}");
    }
    let message = mtl::parse("\nKd 1 1 1", "b.mtl").expect_err("no newmtl").to_string();
    assert!(message.starts_with("b.mtl:2: `Kd` stands before the first material; start a material"), "{message}");
}

#[test]
fn what_is_skipped_is_said_once() -> Result<(), Error> {
    let model = parse_with(
        &format!(
            "mtllib missing.mtl a.mtl\n{POINTS}v 0 0 1 0.5 0.5 0.5\nv 0 0 2 1 1 1\nvn 0 0 0\nvn 0 0 0\n\
             l 1 2\nl 2 3\ncstype bezier\ncurv 0 1 1 2\nlod 3\nlod 4\nusemtl m\nf 1//1 2//1 3//2\nusemtl ghost\n\
             f 1 2 3\nusemtl m\nusemtl ghost\nf 1 1 2\nf 1 3 2 4\nf 1 2 2 3\n"
        ),
        "newmtl m\nKs 0.5\nKd 2 0 0\nmap_Kd -s 1 1 a.png\nrefl b.png\nTf 1 1 1\nTf 1 1 1\nillum 7\nd -halo 0.5\nNi 1.5\n\
         newmtl m2\nKa spectral a.rfl\nillum 10\nnewmtl m2\n",
    )?;
    let expected = [
        ":1: the material library `missing.mtl` was sought at dir/missing.mtl: entity not found; its materials are grey",
        "dir/a.mtl:3: Kd is above 1: more light leaves than arrives",
        "dir/a.mtl:4: material `m`: the picture `a.png` cannot be read: entity not found; it is shaded without this picture",
        "dir/a.mtl:5: material `m`: the map `refl b.png` is not supported and has no effect",
        "dir/a.mtl:6: `Tf` is not supported and has no effect",
        "dir/a.mtl:9: `d -halo` is not supported: the same dissolve from all sides",
        "dir/a.mtl:1: material `m`: illum 7 asks for glass, which is not supported: shaded as illum 3 with its dissolve",
        "dir/a.mtl:1: material `m` has Ks but no Ns: exponent 10 assumed",
        "dir/a.mtl:12: `Ka spectral a.rfl` is not supported and has no effect",
        "dir/a.mtl:11: material `m2`: illum 10 (shadows on invisible surfaces) is not supported: shaded as illum 2",
        "dir/a.mtl:14: material `m2` is given twice: the later one is used",
        ":6: colours of points are not supported and have no effect",
        ":10: `l` draws no surface: skipped",
        ":12: free-form curves and surfaces (`cstype`) are not supported: skipped",
        ":14: `lod` is not supported: skipped",
        ":8: 2 normals (vn) of length 0: computed from the faces instead",
        ":23: 1 polygons cross themselves, have no area or have too many corners: drawn as they come",
        ": 2 triangles without an area: dropped",
        ": 2 triangles lie exactly on an earlier one: dropped",
        ":18: no library has the material `ghost`: grey",
    ];
    let mut found = texts(&model.warnings);
    found.sort();
    let mut expected: Vec<String> = expected
        .iter()
        .map(|text| if text.starts_with(':') { format!("dir/a.obj{text}") } else { (*text).to_owned() })
        .collect();
    expected.sort();
    assert_eq!(found, expected);
    assert_eq!(model.mesh.triangles.len(), 3);
    Ok(())
}

#[test]
fn coincident_triangles_are_counted_and_dropped() -> Result<(), Error> {
    let faces = "f 1 2 3\nf 2 3 1\ng other\nf 3 1 2\nf 3 2 1\nf 1 3 4\n";
    let model = parse(&format!("{POINTS}v 0 -0 0\n{faces}f 5 2 3\n"))?;
    assert_eq!(texts(&model.warnings), ["dir/a.obj: 3 triangles lie exactly on an earlier one: dropped"]);
    let kept: Vec<_> = model.mesh.triangles.iter().map(|triangle| triangle.positions).collect();
    assert_eq!(kept, [[0, 1, 2], [2, 1, 0], [0, 2, 3]], "the other side is another triangle");
    assert_eq!(model.parts[0].triangles, 1..3);
    Ok(())
}

#[test]
fn what_is_no_obj_file_is_called_so() {
    for (bytes, expected) in [
        (&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], "a.obj:3: a byte of value 0; this is not an OBJ file"),
        (b"", "a.obj:1: not one `v` line in 0 lines; this is not an OBJ file"),
        (b"dear all,\nthe minutes\n", "a.obj:1: not one `v` line in 2 lines; this is not an OBJ file"),
    ] {
        let message = obj::parse(bytes, "a.obj", &mut |_| Ok(Vec::new()), &Options::default());
        let message = message.expect_err("no OBJ file").to_string();
        assert!(message.starts_with(expected), "{message}");
    }
}

#[test]
fn only_files_are_read() {
    let read = |path: &str| obj::load(path.as_ref(), &Options::default()).expect_err(path).to_string();
    assert_eq!(read("src"), "src: cannot read this file: it is a folder");
    if cfg!(unix) {
        assert_eq!(read("/dev/zero"), "/dev/zero: cannot read this file: it is not a regular file");
    }
}

#[test]
fn a_file_of_nonsense_gives_a_bounded_list() {
    let mut text: String = (0..10_000).map(|at| format!("word{at} 1 2 3\n")).collect();
    text.push_str(&format!("{POINTS}f 1 2 3\n"));
    let model = parse(&text).expect("unknown words are no errors");
    assert!(model.warnings.len() <= 101);
}

#[test]
fn all_forms_of_corners_and_indices_agree() -> Result<(), Error> {
    let head = format!("{POINTS}vt 0 0\nvt 1\nvn 0 0 2\nvn 0 0 1\n");
    let plain = parse(&format!("{head}f 1 2 3 4"))?;
    for face in [
        "f 1/1 2/2 3/1 4/2",
        "f 1//1 2//2 3//1 4//2",
        "f 1/1/1 2/2/2 3/1/1 4/2/2",
        "f -4 -3 -2 -1",
        "f -4/-2/-1 -3/-1/-2 -2/-1/-2 -1/-2/-1",
        "f\t1 \\\n 2\\\n 3 4 # end",
        "fo 1 2 3 4",
        "s 1\nf 1 2 3 4",
        "s off\nf 1 2 3 4",
    ] {
        let model = parse(&format!("{head}{face}"))?;
        assert!(model.warnings.is_empty(), "{face}");
        let geometry = |model: &Model| {
            let at = |triangle: &lobe_scene::Triangle, corner: usize| {
                (
                    model.mesh.positions[triangle.positions[corner] as usize],
                    model.mesh.normals[triangle.normals[corner] as usize],
                )
            };
            model.mesh.triangles.iter().map(|triangle| [0, 1, 2].map(|corner| at(triangle, corner))).collect::<Vec<_>>()
        };
        assert_eq!(geometry(&model), geometry(&plain), "{face}");
        assert!(model.mesh.normals.iter().all(|&normal| normal == Vec3::Z));
    }
    Ok(())
}

#[test]
fn parts_and_materials_keep_their_names() -> Result<(), Error> {
    let model = parse_with(
        &format!(
            "mtllib a.mtl\n{POINTS}f 1 2 4\no box\ng left wall\nusemtl Material#25\nf 1 2 3 4\ng\nusemtl my paint\n\
             f 1 2 2\nf 2 3 4\ng empty\n"
        ),
        "newmtl my paint\nKd 0.1 0.2 0.3 # blue\nnewmtl unused\nnewmtl Material#25\nTr 0.25\n",
    )?;
    let parts: Vec<_> = model.parts.iter().map(|part| (part.name.as_str(), part.triangles.clone())).collect();
    assert_eq!(parts, [("left wall", 1..3), ("default", 3..4)]);
    let names: Vec<_> = model.materials.iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["default", "Material#25", "my paint"]);
    assert_eq!(model.materials[1].d, 0.75);
    assert_eq!(model.materials[2].kd, [0.1, 0.2, 0.3]);
    assert_eq!(model.mesh.triangles.iter().map(|triangle| triangle.material).collect::<Vec<_>>(), [0, 1, 1, 2]);
    assert_eq!(texts(&model.warnings), ["dir/a.obj: 1 triangles without an area: dropped"]);
    Ok(())
}

#[test]
fn illum_selects_the_terms() -> Result<(), Error> {
    for (text, expected) in [
        ("illum 0\nKs 1", Illumination::Constant),
        ("illum 1\nKs 1", Illumination::Diffuse),
        ("illum 2", Illumination::Highlight),
        ("illum 3", Illumination::Mirror),
        ("illum 5", Illumination::Mirror),
        ("illum 8", Illumination::Mirror),
        ("Ks 0 0 0.1\nNs 3", Illumination::Highlight),
        ("Ks 0 0 0\nNs 3", Illumination::Diffuse),
        ("", Illumination::Diffuse),
    ] {
        let (materials, _) = mtl::parse(format!("newmtl m\n{text}"), "a.mtl")?;
        assert_eq!(materials[0].illumination, expected, "{text}");
    }
    Ok(())
}

#[test]
fn names_with_spaces_and_backslashes_are_found() -> Result<(), Error> {
    for (line, found) in [("my lib.mtl", "my lib.mtl"), (r"sub\a.mtl", "sub/a.mtl"), ("x.mtl y.mtl", "y.mtl")] {
        let mut loader = |name: &str| match name == found {
            true => Ok(b"newmtl m\nKd 0.5\n".to_vec()),
            false => Err(io::ErrorKind::NotFound.into()),
        };
        let text = format!("mtllib {line}\nmtllib {line}\n{POINTS}usemtl m\nf 1 2 3\n");
        let model = obj::parse(text, "a.obj", &mut loader, &Options::default())?;
        assert_eq!(model.materials[0].kd, [0.5; 3], "{line}");
    }
    Ok(())
}

/// The largest power of ten that a hostile file could ask to allocate for is in its own length.
#[test]
fn a_huge_index_allocates_nothing() {
    assert!(parse("f 4294967295 4294967296 18446744073709551616\n").is_err());
    assert!(parse(&format!("{POINTS}s 4294967295\nf 1 2 3\n")).is_ok());
    assert!(parse(&format!("{POINTS}s 4294967296\nf 1 2 3\n")).is_err());
}

/// Lines that look like OBJ, so that random text gets past the keyword.
fn line() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        "[-+]?[0-9]{1,3}(\\.[0-9]{0,3})?(e[-+]?[0-9]{1,2})?",
        "-?[0-9]{1,2}(/-?[0-9]{0,2}){0,3}",
        "nan|inf|off|on|a.mtl|\\\\|#|[a-z]{1,3}"
    ];
    let key = prop_oneof![4 => Just("v"), 3 => Just("f"), 1 => Just("vn"), 1 => Just("vt"), 1 => Just("s"), 1 => Just("g"),
        1 => Just("usemtl"), 1 => Just("mtllib"), 1 => Just("newmtl"), 1 => Just("Kd"), 1 => Just("Ns"), 1 => Just("illum"), 1 => Just("d")];
    (key, prop::collection::vec(word, 0..6)).prop_map(|(key, words)| format!("{key} {}", words.join(" ")))
}

proptest! {
    #[test]
    fn any_bytes_are_handled(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = obj::parse(&bytes, "a", &mut |_| Ok(bytes.clone()), &Options::default());
        let _ = mtl::parse(&bytes, "a");
    }

    #[test]
    fn any_description_is_handled(text: String, eye in prop::array::uniform3(prop_oneof![any::<f32>(), -9.0_f32..9.0]), fov in prop_oneof![any::<f32>(), 0.0_f32..200.0]) {
        let options = lobe_scene::LoadOptions::default();
        let mut loader = |_: &str| Ok(format!("{POINTS}f 1 2 3").into_bytes());
        let _ = lobe_scene::parse_description(&text, "a.json", &mut loader, &options);
        let [x, y, z] = eye;
        let camera = format!(
            r#"{{"obj": "a.obj", "camera": {{"eye": [{x:e}, {y:e}, {z:e}], "target": [0, 0, 0], "fov_y_degrees": {fov:e}}}}}"#
        );
        if let Ok(scene) = lobe_scene::parse_description(&camera, "a.json", &mut loader, &options) {
            // A camera that is accepted can take a picture.
            let settings = lobe_scene::Settings { width: 3, height: 2, ..lobe_scene::Settings::default() };
            let renderer = lobe_scene::Renderer::new(&scene)?;
            prop_assert!(renderer.render(&scene.views[0], &settings, None).is_ok());
        }
    }

    #[test]
    fn any_lines_are_handled(lines in prop::collection::vec(line(), 0..40), library in prop::collection::vec(line(), 0..20)) {
        let text = format!("{POINTS}{}", lines.join("\n"));
        let library = format!("newmtl a\n{}", library.join("\n"));
        if let Ok(model) = parse_with(&text, &library) {
            // Whatever is accepted can be drawn.
            prop_assert!(model.mesh.check(model.materials.len()).is_ok());
        }
        let _ = mtl::parse(&library, "a");
    }

    /// A mesh written with all its digits comes back with the same bits.
    #[test]
    fn a_mesh_survives_the_round_trip(
        points in prop::collection::vec(prop::array::uniform3(-1e9_f32..1e9), 3..30),
        faces in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..30),
        backwards: bool,
    ) {
        let mut text = String::new();
        for [x, y, z] in &points {
            text += &format!("v {x} {y:e} {z}\n");
        }
        let faces: Vec<[usize; 3]> = faces.iter().map(|(a, b, c)| [a, b, c].map(|at| at.index(points.len()))).collect();
        for face in &faces {
            let [a, b, c] = face.map(|at| if backwards { at as i64 - points.len() as i64 } else { at as i64 + 1 });
            text += &format!("f {a} {b} {c}\n");
        }
        let mut seen = std::collections::HashSet::new();
        let kept: Vec<[u32; 3]> = faces.iter()
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .filter(|&&[a, b, c]| seen.insert([a, b, c].min([b, c, a]).min([c, a, b])))
            .map(|face| face.map(|at| at as u32))
            .collect();
        match parse(&text) {
            Ok(model) => {
                prop_assert_eq!(model.mesh.positions.iter().map(|point| point.to_array()).collect::<Vec<_>>(), points);
                prop_assert_eq!(model.mesh.triangles.iter().map(|triangle| triangle.positions).collect::<Vec<_>>(), kept);
                prop_assert!(model.mesh.check(1).is_ok());
            }
            Err(_) => prop_assert!(kept.is_empty()),
        }
    }
}
