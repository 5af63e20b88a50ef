//! The bounds of the catalogue, where they are larger than a constant.

use lobe::Vec3;
use lobe_models::{Lobe, Value, model};

/// What is beyond a constant, or beyond the roundings that were once counted: the worst inputs of a sweep.
#[test]
fn bounds_count_every_rounding() {
    let share = |name: &str, values: &[(&'static str, Value)], [lx, ly, lz, vx, vy, vz]: [f32; 6]| {
        let lobe = Lobe::new(model(name).expect("a model"), values).expect("inside the domain");
        let (l, v) = (Vec3::new(lx, ly, lz), Vec3::new(vx, vy, vz));
        let (l64, v64) = (l.map(f64::from), v.map(f64::from));
        let (f, exact) = (lobe.build::<f32>().eval(l, v), lobe.build::<f64>().eval(l64, v64));
        let of = |f: f32, exact: f64| if exact == 0.0 { 0.0 } else { (f64::from(f) / exact - 1.0).abs() };
        let error = of(f.r, exact.r).max(of(f.g, exact.g)).max(of(f.b, exact.b));
        (error, error / lobe.tolerance(l64, v64))
    };
    let colour = |r, g, b| Value::Colour([r, g, b]);

    // A dark base under a dielectric that reflects all but 2e-3.
    let gltf = [
        ("base-color", colour(0.136_361_702_763_266_34, 0.0, 0.040_245_704_352_855_68)),
        ("metallic", Value::Number(0.322_750_717_401_504_5)),
        ("roughness", Value::Number(0.108_991_190_791_130_07)),
        ("ior", Value::Number(1.659_859_538_078_308)),
        ("specular-color", colour(3.907_260_656_356_811_5, 16.213_756_561_279_297, 15.001_502_990_722_656)),
        ("anisotropy", Value::Number(0.897_771_298_885_345_5)),
    ];
    let at = [-0.713_335_2, -0.696_155_3, 0.080_750_54, 0.744_833_23, -0.542_514_3, 0.388_460_6];
    let (error, part) = share("gltf", &gltf, at);
    assert!(error > 2e-5 && part <= 1.0, "{error:e} {part}");

    // A sixth power of 1 − cos θ, next to where it is as large as what it is taken from: 32 of 80
    // roundings were once counted. The masking shares its division.
    let (one, third) = (0.999_944_150_447_845_5, 0.317_256_838_083_267_2);
    let tinted = [
        ("alpha", Value::Widths([0.025_000_000_372_529_03, 0.100_000_001_490_116_12])),
        ("distribution", Value::Choice("gtr")),
        ("gamma", Value::Number(0.501_442_193_984_985_4)),
        ("masking", Value::Choice("schlick-ggx-remapped")),
        ("fresnel", Value::Choice("f82-tint")),
        ("f0", colour(one, third, one)),
        ("tint", colour(0.0, 0.430_254_727_602_005, 0.023_000_672_459_602_356)),
    ];
    let at = [-0.874_102_1, 0.462_235, 0.149_279_76, 0.877_066_8, -0.460_767_9, 0.135_819_75];
    let (_, part) = share("microfacet", &tinted, at);
    assert!(part > 32.0 / 80.0 && part <= 1.0, "{part}");

    // The fifth power of a black channel, at the top of the lobe: 40 roundings were once counted.
    let black = [
        ("f0", colour(0.814_955_770_969_390_9, 0.0, 1.951_415_242_729_126_5e-6)),
        ("q", Value::Number(1_404.946_533_203_125)),
    ];
    let at = [0.159_667_92, -0.508_906_96, 0.845_884_1, -0.159_330_67, 0.508_998_1, 0.845_892_85];
    let (error, part) = share("ashikhmin-shirley", &black, at);
    assert!(error > 40.0 / 16_777_216.0 && part <= 1.0, "{error:e} {part}");
}
