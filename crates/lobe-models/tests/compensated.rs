//! The compensated models of the catalogue: each is its type, and keeps the light that it promises to keep.

use lobe::fresnel::{Conductor, Dielectric, Schlick, metals};
use lobe::{Alpha, Brdf, Ior, MetallicRoughness, Rgb, Vec3};
use lobe_energy::{AlbedoCoat, CoupledDiffuse, FdezAguera, KullaConty, Least, Turquin, microfacet_albedo_to};
use lobe_models::{Lobe, Value, model};

const L: Vec3<f64> = Vec3 { x: 0.96, y: 0.0, z: 0.28 };
const V: Vec3<f64> = Vec3 { x: -0.48, y: 0.36, z: 0.8 };
const F0: Value = Value::Colour([0.9, 0.5, 0.2]);

fn named(name: &str, given: &[(&str, Value)]) -> Box<dyn Brdf<f64> + Send + Sync> {
    Lobe::new(model(name).expect("there is one"), given).expect("inside the domain").build::<f64>()
}

#[test]
fn each_name_is_its_type() {
    let alpha = Alpha(0.4);
    let width = ("alpha", Value::Number(0.4));
    let eval = |lobe: &dyn Brdf<f64>| (lobe.eval(L, V), lobe.eval_cos(L, V));
    macro_rules! both {
        ($fresnel:expr, $given:expr) => {
            let given: &[_] = $given;
            let (kulla, turquin) =
                (KullaConty::<_, f64>::new(alpha, $fresnel), Turquin::<_, f64>::new(alpha, $fresnel));
            assert_eq!(eval(&*named("kulla-conty", given)), eval(&kulla), "{given:?}");
            assert_eq!(eval(&*named("turquin", given)), eval(&turquin), "{given:?}");
        };
    }
    let f0 = Rgb::new(0.9, 0.5, 0.2);
    both!(Schlick::with_f90(f0, Rgb::splat(1.0)), &[width, ("f0", F0)]);
    both!(Dielectric::new(Ior(1.7)), &[width, ("fresnel", Value::Choice("dielectric")), ("ior", Value::Number(1.7))]);
    let gold = metals::METALS.iter().find(|metal| metal.name == "gold").expect("there is one").conductor(1.0);
    both!(gold, &[width, ("fresnel", Value::Choice("conductor")), ("metal", Value::Choice("gold"))]);
    let own = Conductor::new(Rgb::splat(1.5), Rgb::splat(3.0));
    both!(own, &[width, ("fresnel", Value::Choice("conductor"))]);

    let albedo = ("albedo", Value::Colour([0.3, 0.6, 0.9]));
    let rho = Rgb::new(0.3, 0.6, 0.9);
    let fdez = FdezAguera::new(alpha, f0, rho);
    assert_eq!(eval(&*named("fdez-aguera", &[width, albedo, ("f0", F0)])), eval(&fdez));
    let coupled = CoupledDiffuse::new(alpha, 0.1, rho);
    assert_eq!(eval(&*named("coupled-diffuse", &[width, albedo, ("f0", Value::Number(0.1))])), eval(&coupled));
    let metal = MetallicRoughness::new(f0, 1.0, Alpha(0.25));
    let coat: AlbedoCoat<_, Least, f64> = AlbedoCoat::new(alpha, 0.04, metal);
    let given = [width, ("base-color", F0), ("roughness", Value::Number(0.5))];
    assert_eq!(eval(&*named("albedo-coat", &given)), eval(&coat));
}

/// To the ends of the domains a white one is white, as far as is said, and without it half of the light is gone.
#[test]
fn what_is_white_stays_white() {
    let white = Value::Colour([1.0; 3]);
    for (name, given, allowed) in [
        ("kulla-conty", &[("f0", white)] as &[_], 1e-3),
        ("turquin", &[("f0", white)], 2e-3),
        ("fdez-aguera", &[("f0", Value::Colour([0.04; 3])), ("albedo", white)], 1e-2),
        ("coupled-diffuse", &[("f0", Value::Number(0.04)), ("albedo", white)], 1e-2),
        ("coupled-diffuse", &[("f0", Value::Number(0.5)), ("albedo", white)], 1e-2),
    ] {
        let mut worst = 0.0_f64;
        for alpha in [1e-4, 0.03, 0.3, 1.0] {
            let given: Vec<_> = given.iter().copied().chain([("alpha", Value::Number(alpha))]).collect();
            let lobe = named(name, &given);
            for mu in [1e-3, 0.05, 0.3, 1.0_f64] {
                let v = Vec3::new((1.0 - mu * mu).sqrt(), 0.0, mu);
                let albedo = microfacet_albedo_to(1e-5, &*lobe, (Alpha(alpha), Alpha(alpha)), v);
                worst = worst.max((albedo.value.g - 1.0).abs());
            }
        }
        println!("{name}: {worst:.1e}");
        assert!(worst < allowed, "{name}: {worst:e}");
    }
    let once = named("microfacet", &[("alpha", Value::Widths([1.0; 2])), ("f0", white)]);
    let albedo = microfacet_albedo_to(1e-5, &*once, (Alpha(1.0), Alpha(1.0)), Vec3::new(0.0, 0.0, 1.0));
    assert!(albedo.value.g < 0.31, "{albedo:?}");
}
