//! Batches give the bits of the scalar at every level that the machine has, whatever their length; and say what is wrong
//! with their slices. Every model of the catalogue is run so by the tests of `lobe-models`.
#![cfg(feature = "simd")]

use lobe::batch::{self, Batch, Eval, EvalCos, InWorld, Kernel, LengthError, Level, OneChannel, Uniform};
use lobe::distribution::{Beckmann, Ggx};
use lobe::fresnel::{Conductor, Schlick};
use lobe::masking::{SmithCorrelated, SmithSeparable};
use lobe::number::{Coarse, Fast, Precision};
use lobe::{Alpha, Brdf, Frame, Lambert, MetallicRoughness, Microfacet, Phong, Real, Rgb, Shininess, Vec3};
use lobe_verify::strategies::pair_above;
use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;

/// The scalar, and every level that the machine has.
fn levels() -> impl Iterator<Item = Level> {
    std::iter::once(Level::baseline()).chain(batch::levels(Level::new()).map(|(_, level)| level))
}

/// Pairs that lean on the extremes, some of them below the horizon.
fn pairs(count: usize) -> Vec<(Vec3, Vec3)> {
    let mut runner = TestRunner::deterministic();
    (0..count)
        .map(|i| {
            let (l, v) = pair_above().new_tree(&mut runner).expect("a pair").current();
            if i % 16 == 5 { (-l, v) } else { (l, v) }
        })
        .collect()
}

/// A vector of each component.
fn columns(vectors: impl Iterator<Item = Vec3> + Clone) -> [Vec<f32>; 3] {
    [vectors.clone().map(|w| w.x).collect(), vectors.clone().map(|w| w.y).collect(), vectors.map(|w| w.z).collect()]
}

fn slices([x, y, z]: &[Vec<f32>; 3]) -> Vec3<&[f32]> {
    Vec3::new(x, y, z)
}

fn colours([r, g, b]: &mut [Vec<f32>; 3]) -> Rgb<&mut [f32]> {
    Rgb { r, g, b }
}

fn same(a: f32, b: f32) -> bool {
    // Two NaN are alike, whatever their bits.
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// `$lobe` in batches of every length from 0 to 40, by the bits.
macro_rules! check {
    ($lobe:expr) => {{
        let lobe = $lobe;
        let pairs = pairs(40);
        for level in levels() {
            for length in 0..=pairs.len() {
                let pairs = &pairs[..length];
                let (l, v) = (columns(pairs.iter().map(|p| p.0)), columns(pairs.iter().map(|p| p.1)));
                let mut f = [vec![-1.0; length], vec![-1.0; length], vec![-1.0; length]];
                let mut cos = f.clone();
                let batch = Batch::at(level);
                batch.eval(&lobe, slices(&l), slices(&v), colours(&mut f)).expect("one length");
                batch.eval_cos(&lobe, slices(&l), slices(&v), colours(&mut cos)).expect("one length");
                for (i, &(l, v)) in pairs.iter().enumerate() {
                    let one: [[f32; 3]; 2] = [lobe.eval(l, v).into(), lobe.eval_cos(l, v).into()];
                    for channel in 0..3 {
                        assert!(
                            same(f[channel][i], one[0][channel]) && same(cos[channel][i], one[1][channel]),
                            "{level:?}, {length}: {} and {} for {one:?} at {l:?} {v:?}",
                            f[channel][i],
                            cos[channel][i]
                        );
                    }
                }
            }
        }
    }};
}

#[test]
fn a_batch_has_the_bits_of_the_scalar_at_every_level_and_length() {
    check!(Lambert::new(Rgb::new(0.8_f32, 0.2, 0.1)) + Phong::new(Rgb::new(0.3, 0.2, 0.1), Shininess(7.5)));
    check!(Microfacet::new(Ggx::new(Alpha(0.01_f32)), SmithCorrelated, Schlick::new(Rgb::new(0.9, 0.5, 0.04))));
    check!(Microfacet::new(
        Beckmann::anisotropic(Alpha(0.2_f32), Alpha(0.5)),
        SmithSeparable,
        Conductor::new(Rgb::new(0.2, 1.1, 2.0), Rgb::new(3.0, 2.0, 0.5))
    ));
}

/// Every function of one number and two, on any bits at all, subnormal numbers, infinities and NaN among them.
struct Functions;

impl<R: Real> Kernel<(R, R), (Vec3<R>, Vec3<R>)> for Functions {
    #[inline(always)]
    fn apply(&self, (x, y): (R, R)) -> (Vec3<R>, Vec3<R>) {
        let (sin, cos) = x.sin_cos();
        (Vec3::new(x.exp2(), x.log2(), x.log2_1p()), Vec3::new(sin, cos, x.pow(y)))
    }
}

struct More;

impl<R: Real> Kernel<(R, R), (Vec3<R>, Vec3<R>)> for More {
    #[inline(always)]
    fn apply(&self, (x, y): (R, R)) -> (Vec3<R>, Vec3<R>) {
        (Vec3::new(x.max(y), x.min(y), x.copysign(y)), Vec3::new(x.atan2(y), x.erfc(), x.sqrt() / y))
    }
}

#[test]
fn every_function_has_the_bits_of_the_scalar_at_every_level() {
    let mut bits = 1_u32;
    let mut number = |i: usize| {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        // Any bits, and numbers that a formula meets.
        if i.is_multiple_of(2) { f32::from_bits(bits) } else { (bits >> 8) as f32 / 8_388_608.0 - 1.0 }
    };
    let count = 100_003;
    let (x, y): (Vec<f32>, Vec<f32>) = (0..count).map(|i| (number(i), number(i / 3))).unzip();
    macro_rules! check {
        ($kernel:expr) => {
            for level in levels() {
                let mut out: [Vec<f32>; 6] = std::array::from_fn(|_| vec![0.0; count]);
                let [a, b, c, d, e, f] = &mut out;
                let to = (Vec3::new(&mut a[..], &mut b[..], &mut c[..]), Vec3::new(&mut d[..], &mut e[..], &mut f[..]));
                Batch::at(level).run(&$kernel, (&x[..], &y[..]), to).expect("one length");
                for i in 0..count {
                    let (one, other): (Vec3, Vec3) = $kernel.apply((x[i], y[i]));
                    for (k, scalar) in [one.x, one.y, one.z, other.x, other.y, other.z].into_iter().enumerate() {
                        let lane = out[k][i];
                        assert!(same(lane, scalar), "{level:?}, {k}: {lane:e}, {scalar:e} for {:e} {:e}", x[i], y[i]);
                    }
                }
            }
        };
    }
    check!(Functions);
    check!(More);
}

#[test]
fn slices_of_other_lengths_are_an_error_and_nothing_is_written() {
    let lobe = Lambert::new(Rgb::splat(0.5_f32));
    let (long, short) = (vec![0.6_f32; 20], vec![0.6_f32; 19]);
    let mut out = [vec![7.0_f32; 20], vec![7.0; 20], vec![7.0; 20]];
    let l = Vec3::new(&long[..], &long, &long);
    let v = Vec3::new(&long[..], &short, &long);
    let batch = Batch::new();
    let error = batch.eval(&lobe, l, v, colours(&mut out)).unwrap_err();
    assert_eq!(error, LengthError { index: 4, length: 19, expected: 20 });
    assert_eq!(error.to_string(), "slice 4 of the batch has 19 numbers, slice 0 has 20; all must be equally long");
    out[2].pop();
    let error = batch.accumulate(EvalCos(&lobe), (l, l), colours(&mut out)).unwrap_err();
    assert_eq!(error, LengthError { index: 8, length: 19, expected: 20 });
    out[2].push(7.0);
    let light = (v, Rgb::new(Uniform(1.0), Uniform(1.0), Uniform(1.0)));
    let error = batch.shade_lights(&lobe, l, &[light], colours(&mut out)).unwrap_err();
    assert_eq!(error, LengthError { index: 4, length: 19, expected: 20 });
    assert!(out.iter().flatten().all(|&x| x == 7.0));
}

#[test]
fn many_lights_are_the_sum_of_each() {
    let lobe = Microfacet::new(Ggx::new(Alpha(0.3_f32)), SmithCorrelated, Schlick::new(Rgb::new(0.9, 0.5, 0.1)));
    for length in [0, 1, 15, 16, 37] {
        let pairs = pairs(4 * length);
        let v = columns(pairs[..length].iter().map(|p| p.1));
        let lights: Vec<_> = (0..4).map(|k| columns(pairs[k * length..(k + 1) * length].iter().map(|p| p.0))).collect();
        let red: Vec<f32> = (0..length).map(|i| i as f32).collect();
        let irradiance = Rgb { r: &red[..], g: &red[..], b: &red[..] };
        let lights: Vec<_> = lights.iter().map(|l| (slices(l), irradiance)).collect();
        for level in levels() {
            let batch = Batch::at(level);
            let mut fused = [vec![0.5; length], vec![0.5; length], vec![0.5; length]];
            batch.shade_lights(&lobe, slices(&v), &lights, colours(&mut fused)).expect("one length");
            for i in 0..length {
                let v = Vec3::new(v[0][i], v[1][i], v[2][i]);
                let sum = lights.iter().fold(Rgb::splat(0.5), |sum, (l, e)| {
                    let l = Vec3::new(l.x[i], l.y[i], l.z[i]);
                    sum + lobe.eval_cos(l, v) * Rgb::new(e.r[i], e.g[i], e.b[i])
                });
                for (lane, scalar) in [fused[0][i], fused[1][i], fused[2][i]].into_iter().zip(<[f32; 3]>::from(sum)) {
                    assert!(same(lane, scalar), "{level:?}, {length}: {lane} {scalar}");
                }
            }
        }
    }
}

#[test]
fn world_space_one_channel_and_accumulation() {
    let lobe = MetallicRoughness::new(Rgb::new(0.9_f32, 0.5, 0.1), 0.5, Alpha(0.3));
    let pairs = pairs(21);
    let (l, v) = (columns(pairs.iter().map(|p| p.0)), columns(pairs.iter().map(|p| p.1)));
    let n = Vec3::new(0.48_f32, 0.6, 0.64);
    let t = Vec3::new(1.0_f32, 0.0, 0.0);
    let (normal, tangent) = (n.map(Uniform), t.map(Uniform));
    let mut out = [vec![0.0; 21], vec![0.0; 21], vec![0.0; 21]];
    let mut grey = [1.0; 21];
    let batch = Batch::new();
    batch
        .run(InWorld(Eval(&lobe)), ((normal, tangent), slices(&l), slices(&v)), colours(&mut out))
        .expect("one length");
    batch
        .accumulate(OneChannel(InWorld(Eval(&lobe))), (normal, slices(&l), slices(&v)), &mut grey[..])
        .expect("one length");
    for (i, &(l, v)) in pairs.iter().enumerate() {
        let frame = Frame::from_normal_tangent(n, t);
        let one = lobe.eval(frame.to_local(l), frame.to_local(v));
        assert!(same(out[0][i], one.r) && same(out[2][i], one.b));
        let frame = Frame::from_normal(n);
        let one = lobe.eval(frame.to_local(l), frame.to_local(v));
        assert!(same(grey[i], 1.0 + one.r));
    }
}

/// The lanes of a precision are within `bound` of the scalar, where that is above the horizon and not tiny.
fn near<P: Precision>(bound: f32) {
    let pairs = pairs(1000);
    let (l, v) = (columns(pairs.iter().map(|p| p.0)), columns(pairs.iter().map(|p| p.1)));
    let lobe = Microfacet::new(Ggx::new(Alpha(0.3_f32)), SmithCorrelated, Schlick::new(Rgb::new(0.9, 0.5, 0.1)));
    for level in levels() {
        let mut out = [vec![0.0; 1000], vec![0.0; 1000], vec![0.0; 1000]];
        Batch::at(level)
            .precision::<P>()
            .eval_cos(&lobe, slices(&l), slices(&v), colours(&mut out))
            .expect("one length");
        for (i, &(l, v)) in pairs.iter().enumerate() {
            let one = lobe.eval_cos(l, v);
            assert!(
                !one.r.is_finite() || (out[0][i].is_finite() && out[0][i] >= 0.0),
                "{level:?}: {} at {l:?} {v:?}",
                out[0][i]
            );
            // Nearer the horizon opposite directions have no digits: `Real::COSINE_SCALE`.
            if l.z.max(v.z) > 0.0 && l.z.max(v.z) < 1e-18 {
                continue;
            }
            assert!((out[0][i] - one.r).abs() <= bound * one.r, "{level:?}: {} {} at {l:?} {v:?}", out[0][i], one.r);
        }
    }
}

/// The largest of 1/x (6e-5 to 4e-4, five of them in a lobe) and of the polynomials, with room: what each model keeps is
/// measured by the tests of `lobe-models`.
#[test]
fn less_precise_lanes_are_near() {
    near::<Fast>(4e-3);
    near::<Coarse>(1e-2);
}
