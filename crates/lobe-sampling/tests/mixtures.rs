//! Sums, layers and deltas.

mod common;

use common::*;
use lobe::distribution::{Beckmann, Ggx};
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Black, Brdf, Clearcoat, Coat, Lambert, Microfacet, Mirror, Real, Rgb, SheenLayer, Sum, Vec3};
use lobe_energy::{CoupledDiffuse, FdezAguera, GgxTable, KullaConty, Turquin};
use lobe_sampling::{ByCosine, Outcome, Sample, SampleBy, Sampled};

type Facets<R> = Microfacet<Ggx<R>, SmithCorrelated, Schlick<R>>;

fn facets<R: Real>(w: R, alpha: f64, f0: f64) -> Facets<R> {
    Microfacet::new(Ggx::new(Alpha(w.lift(alpha))), SmithCorrelated, Schlick::new(Rgb::splat(w.lift(f0))))
}

fn chalk<R: Real>(w: R) -> Lambert<R> {
    Lambert::new(Rgb::new(w.lift(0.8), w.lift(0.5), w.lift(0.1)))
}

/// The mixtures with a density, their facets of this width.
fn lobes<R: Real + 'static>(w: R, alpha: f64) -> Vec<Named<R>> {
    let (a, top, base) = (Alpha(w.lift(alpha)), facets(w, alpha, 0.04), chalk(w));
    let varnish = Schlick::new(Rgb::splat(w.lift(0.04)));
    let beckmann = Microfacet::new(Beckmann::new(a), SmithCorrelated, varnish);
    let gold = Schlick::new(Rgb::new(w.lift(1.0), w.lift(0.77), w.lift(0.34)));
    let (grey, white) = (Rgb::splat(w.lift(0.5)), Rgb::splat(w.lift(1.0)));
    let (color, sheen) = (Rgb::new(w.lift(0.6), w.lift(0.5), w.lift(0.2)), Alpha(w.lift(0.3)));
    vec![
        ("chalk by cosine".into(), Box::new(ByCosine(base))),
        ("sum".into(), Box::new(Sum { a: base, b: top })),
        ("sum of three".into(), Box::new(Sum { a: base, b: top } + beckmann)),
        ("sum of sums".into(), Box::new(Sum { a: Sum { a: top, b: beckmann }, b: base + facets(w, 0.4, 0.9) })),
        ("facets and nothing".into(), Box::new(Sum { a: top, b: Black })),
        ("coat".into(), Box::new(Coat::new(top, varnish, base))),
        ("coat over a coat".into(), Box::new(Coat::new(beckmann, varnish, Coat::new(top, gold, base)))),
        ("clearcoat".into(), Box::new(Clearcoat::new(base, w.lift(0.7), a))),
        ("clearcoat over facets".into(), Box::new(Clearcoat::new(facets(w, 0.4, 0.9), w.lift(1.0), a))),
        ("sheen".into(), Box::new(SheenLayer::new(base, color, sheen))),
        ("sheen over facets".into(), Box::new(SheenLayer::new(top, color, sheen))),
        ("kulla-conty".into(), Box::new(KullaConty::<_, R>::new(a, gold))),
        ("kulla-conty by table".into(), Box::new(KullaConty::<_, R, GgxTable<R>>::new(a, gold))),
        ("turquin".into(), Box::new(Turquin::<_, R>::new(a, gold))),
        ("fdez-aguera".into(), Box::new(FdezAguera::new(a, grey, white))),
        ("coupled".into(), Box::new(CoupledDiffuse::new(a, w.lift(0.04), white))),
    ]
}

#[test]
fn densities_are_normalised() {
    for alpha in [0.15, 0.6] {
        for (name, lobe) in lobes(0.0, alpha) {
            for v in [at(1.0, 0.0), at(0.7, 0.4), at(0.2, 2.0)] {
                density_is_normalised(&format!("{name} {alpha}"), &*lobe, v);
            }
        }
    }
}

#[test]
fn mean_weights_are_albedos() {
    for alpha in [0.15, 0.6] {
        for (name, lobe) in lobes(0.0, alpha) {
            for v in [at(0.9, 0.3), at(0.3, 2.0)] {
                weights_sum_to_the_albedo(&format!("{name} {alpha}"), &*lobe, v);
            }
        }
    }
}

#[test]
fn weights_and_densities_belong_to_the_samples() {
    for alpha in [1e-4, 1e-2, 0.3, 1.0] {
        for (name, lobe) in lobes(0.0_f64, alpha) {
            for cos in [1.0, 0.7, 0.1, 1e-3, 1e-6] {
                samples_are_consistent(&format!("{name} {alpha}"), &*lobe, at(cos, 0.4), 1e-11);
            }
        }
    }
}

#[test]
fn weights_in_single_precision() {
    for alpha in [1e-4, 1e-2, 0.3, 1.0] {
        for ((name, lobe), (_, exact)) in lobes(0.0_f32, alpha).into_iter().zip(lobes(0.0_f64, alpha)) {
            for cos in [1.0, 0.7, 0.1, 1e-3] {
                let error = error_of_weight(&*lobe, &*exact, at(cos, 0.4));
                assert!(error < 2e-4, "{name} {alpha} from {cos}: {error:e}");
            }
        }
    }
}

#[test]
fn the_ends_of_the_square_are_finite() {
    for alpha in [1e-4, 1e-2, 1.0] {
        for (name, lobe) in lobes(0.0_f32, alpha) {
            ends_are_finite(&format!("{name} {alpha}"), &*lobe, 0.0);
        }
        for (name, lobe) in lobes(0.0_f64, alpha) {
            ends_are_finite(&format!("{name} {alpha}"), &*lobe, 0.0);
        }
    }
    ends_are_finite("mirror", &Mirror::new(Rgb::splat(0.5_f32)), 0.0);
    ends_are_finite("black", &Black, 0.0_f32);
    ends_are_finite(
        "mirror under facets",
        &Sum { a: Mirror::new(Rgb::splat(0.5_f32)), b: facets(0.0, 1e-4, 0.5) },
        0.0,
    );
}

#[test]
fn a_nan_shows_and_below_the_horizon_there_is_nothing() {
    for (name, lobe) in lobes(0.0_f32, 0.3) {
        nan_shows_and_below_is_nothing(&name, &*lobe, 0.0);
    }
    nan_shows_and_below_is_nothing("mirror", &Mirror::new(Rgb::splat(0.5_f32)), 0.0);
    nan_shows_and_below_is_nothing("black", &Black, 0.0_f32);
    nan_shows_and_below_is_nothing(
        "mirror and chalk",
        &Sum { a: Mirror::new(Rgb::splat(0.5_f32)), b: chalk(0.0) },
        0.0,
    );
}

#[test]
fn a_mirror_is_a_delta() {
    let (silver, v) = (Mirror::new(Rgb::new(0.9_f32, 0.8, 0.7)), Vec3::new(0.6, 0.0, 0.8));
    let expected = Outcome::Delta { l: Vec3::new(-0.6, 0.0, 0.8), weight: silver.ks() };
    assert_eq!(silver.sample(v, [0.1, 0.2, 0.3]).outcome(), expected);
    assert_eq!(silver.eval_cos_pdf(Vec3::new(-0.6, 0.0, 0.8), v), (Rgb::splat(0.0), 0.0));
    assert_eq!(Black.sample(v, [0.1, 0.2, 0.3]).outcome(), Outcome::Rejected);
}

/// Of a mirror with chalk, and of one under a coat, both parts come out with what they reflect.
#[test]
fn deltas_in_mixtures() {
    let (silver, v) = (Mirror::new(Rgb::splat(0.3)), at(0.6, 0.4));
    let varnish = Schlick::new(Rgb::splat(0.04));
    let mixed = Sum { a: chalk(0.0), b: silver };
    let coated = Coat::new(facets(0.0, 0.3, 0.04), varnish, silver);
    let mirrored = Vec3::new(-v.x, -v.y, v.z);
    let passed = coated.transmitted(mirrored, v).g;
    let cases: [(&str, &dyn Sample<f64>, f64); 2] = [("sum", &mixed, 0.3), ("coat", &coated, 0.3 * passed)];
    for (name, sampler, reflected) in cases {
        density_is_normalised(name, sampler, v);
        let (mut delta, mut count) = (0.0, 0);
        for u in points(1 << 14) {
            let Sampled { l, weight, pdf, delta: mask, rejected } = sampler.sample(v, u);
            if mask && !rejected {
                assert_eq!((l, pdf), (mirrored, 0.0));
                delta += weight.g;
                count += 1;
            }
        }
        let share = f64::from(count) / 16384.0;
        assert!((0.05..0.95).contains(&share), "{name}: {share}");
        assert!((delta / 16384.0 / reflected - 1.0).abs() < 1e-3, "{name}: {}", delta / 16384.0);
    }
}

/// Nothing is spent on a lobe that is not there.
#[test]
fn black_is_never_drawn() {
    let (v, lone) = (at(0.6, 0.4), chalk(0.0));
    for u in points(256) {
        let (one, other) = (Sum { a: Black, b: lone }.sample(v, u), lone.sample(v, u));
        assert_eq!((one.l, one.rejected), (other.l, false));
        assert!((one.weight.g / other.weight.g - 1.0).abs() < 1e-14);
    }
    assert!((0..8).all(|i| Sum { a: Black, b: Black }.sample(v, [f64::from(i) / 8.0, 0.1, 0.2]).rejected));
}

/// A dim lobe beside a bright one is drawn every sixteenth time, so that no weight exceeds 16 times its own.
#[test]
fn no_part_is_starved() {
    let (dim, bright) = (facets(0.0, 0.5, 1e-6), Lambert::new(Rgb::splat(0.9)));
    for v in [at(1.0, 0.0), at(0.1, 0.4), at(1e-3, 0.4)] {
        let mixed = Sum { a: dim, b: bright };
        let mut first = 0;
        for i in 0..1600 {
            let u = [f64::from(i) / 1600.0, 0.4, 0.7];
            let sample = mixed.sample(v, u);
            first += i32::from(sample.l == dim.sample(v, u).l);
            assert!(sample.weight.g < 16.0, "{v:?}: {sample:?}");
            // Where the value is, the density is at least a sixteenth of the part's.
            let alone = dim.pdf(sample.l, v);
            assert!(mixed.pdf(sample.l, v) >= alone / 16.0 * (1.0 - 1e-12));
        }
        assert!(first >= 99, "{v:?}: {first}");
    }
    // A guess of 0 at one angle is no proof that there is nothing at others.
    assert!(facets(0.0, 0.5, 0.0).albedo_guess(at(1.0, 0.0)) > 0.0);
}

/// Two lobes of the sharpest kind, whose densities are beyond 1e7, next to the horizon too.
#[test]
fn sharp_lobes_stay_in_range() {
    let white = Schlick::new(Rgb::splat(1.0_f32));
    let sharp = Microfacet::new(Ggx::new(Alpha(1e-4_f32)), SmithCorrelated, white);
    let mixed = Sum { a: sharp, b: sharp.by(lobe_sampling::facets::ByDistribution) };
    for cos in COSINES {
        let v = single(at(cos, 0.4));
        for u in points(2048) {
            let sample = mixed.sample(v, u.map(|u| u as f32));
            assert!((0.0..40.0).contains(&sample.weight.g) && sample.pdf.is_finite(), "{cos}: {sample:?}");
        }
    }
}

/// The value of a layered lobe is still its own, to the last bit.
#[test]
fn values_are_those_of_the_lobes() {
    for (name, lobe) in lobes(0.0_f32, 0.3) {
        for u in points(256) {
            let u = u.map(|u| u as f32);
            let l = lobe_sampling::map::uniform_hemisphere([u[0], u[1]]);
            let v = lobe_sampling::map::uniform_hemisphere([u[1], u[2]]);
            let brdf: Rgb<f32> = Brdf::eval_cos(&*lobe, l, v);
            assert_eq!(lobe.eval_cos_pdf(l, v).0, brdf, "{name}");
        }
    }
}
