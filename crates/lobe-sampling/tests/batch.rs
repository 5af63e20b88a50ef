//! Batches: lanes have the bits of the scalar, at every level of the machine.

#![cfg(feature = "simd")]

mod common;

use common::*;
use lobe::batch::{Batch, LengthError, levels};
use lobe::distribution::{Beckmann, Ggx};
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Lambert, Microfacet, Mirror, Rgb, Sum, Vec3};
use lobe_sampling::batch::Scatter;
use lobe_sampling::{Sample, SampleBy};

/// Viewers, some below the horizon, and points of the square with its ends.
fn inputs() -> Vec<(Vec3<f32>, [f32; 3])> {
    let mut inputs: Vec<_> =
        (points(97).enumerate()).map(|(i, u)| (single(at(COSINES[i % 7], i as f64)), u.map(|u| u as f32))).collect();
    for x in single_ends() {
        inputs.extend(single_ends().map(|y| (single(at(0.3, 2.0)), [0.4, x, y])));
        inputs.push((single(at(-0.3, 2.0)), [x, 0.5, 0.5]));
        inputs.push((Vec3::new(f32::NAN, 0.0, 1.0), [x, 0.5, 0.5]));
    }
    inputs
}

fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// The samples of a batch at each level are those of the scalar.
macro_rules! same_bits {
    ($lobe:expr) => {{
        let (lobe, inputs) = ($lobe, inputs());
        let column = |f: fn(&(Vec3<f32>, [f32; 3])) -> f32| inputs.iter().map(f).collect::<Vec<_>>();
        let v = [column(|i| i.0.x), column(|i| i.0.y), column(|i| i.0.z)];
        let u = [column(|i| i.1[0]), column(|i| i.1[1]), column(|i| i.1[2])];
        for (name, level) in levels(Batch::new().level()).chain([("best", Batch::new().level())]) {
            let mut out = core::array::from_fn::<_, 7, _>(|_| vec![7.0_f32; inputs.len()]);
            let [x, y, z, r, g, b, pdf] = &mut out;
            let l = Vec3 { x: &mut x[..], y: &mut y[..], z: &mut z[..] };
            let weight = Rgb { r: &mut r[..], g: &mut g[..], b: &mut b[..] };
            let viewer = Vec3::new(&v[0][..], &v[1][..], &v[2][..]);
            Batch::at(level)
                .run(Scatter(lobe), (viewer, (&u[0][..], &u[1][..], &u[2][..])), (l, weight, &mut pdf[..]))
                .expect("one length");
            for (i, (v, u)) in inputs.iter().enumerate() {
                let one = lobe.sample(*v, *u);
                let pdf = if one.delta { f32::INFINITY } else { one.pdf };
                let scalar = [one.l.x, one.l.y, one.l.z, one.weight.r, one.weight.g, one.weight.b, pdf];
                let lanes = core::array::from_fn::<_, 7, _>(|k| out[k][i]);
                assert!(
                    scalar.iter().zip(lanes).all(|(&a, b)| same(a, b)),
                    "{name}: {v:?} {u:?}\n{scalar:?}\n{lanes:?}"
                );
            }
        }
    }};
}

#[test]
fn lanes_have_the_bits_of_the_scalar() {
    let f = Schlick::new(Rgb::new(0.9_f32, 0.6, 0.3));
    let ggx = Microfacet::new(Ggx::anisotropic(Alpha(0.4), Alpha(0.1)), SmithCorrelated, f);
    let chalk = Lambert::new(Rgb::splat(0.5_f32));
    same_bits!(ggx);
    same_bits!(Microfacet::new(Beckmann::new(Alpha(0.3_f32)), SmithCorrelated, f));
    same_bits!(Sum { a: chalk, b: ggx.by(lobe_sampling::facets::ByDistribution) });
    same_bits!(Sum { a: chalk, b: Mirror::new(Rgb::splat(0.7_f32)) });
}

#[test]
fn a_delta_is_infinite_and_a_short_slice_an_error() {
    let one = [0.6_f32];
    let (zero, height) = ([0.0_f32], [0.8_f32]);
    let (mut x, mut y, mut z, mut r, mut g, mut b, mut pdf) = ([0.0], [0.0], [0.0], [0.0], [0.0], [0.0], [0.0]);
    let v = Vec3::new(&one[..], &zero[..], &height[..]);
    let u = (&one[..], &one[..], &one[..]);
    let mirror = Scatter(Mirror::new(Rgb::splat(0.5_f32)));
    let l = Vec3 { x: &mut x[..], y: &mut y[..], z: &mut z[..] };
    let weight = Rgb { r: &mut r[..], g: &mut g[..], b: &mut b[..] };
    Batch::new().run(mirror, (v, u), (l, weight, &mut pdf[..])).expect("one length");
    assert_eq!((x[0], r[0], pdf[0]), (-0.6, 0.5, f32::INFINITY));
    let l = Vec3 { x: &mut x[..], y: &mut y[..], z: &mut z[..] };
    let weight = Rgb { r: &mut r[..], g: &mut g[..], b: &mut b[..] };
    let error = Batch::new().run(mirror, (v, u), (l, weight, &mut pdf[..0])).unwrap_err();
    assert_eq!(error, LengthError { index: 12, length: 0, expected: 1 });
}
