//! Each lobe, one direction pair at a time, beside its plain version: ns per evaluation, interleaved by group.
//!
//! Both versions read the same 16,384 pairs, most above the horizon, and write as many colours, in two ways:
//!
//! - `loop`: an ordinary loop over the pairs, as a user writes it. The compiler may do with it what it can, and with
//!   code that is free of calls and branches it can do more.
//! - `opaque`: each pair passes through `black_box`, so that nothing is known but one pair at a time.
//!
//! ```text
//! cargo bench -p lobe-benches --bench lobes
//! ```
//!
//! The ratio is what counts.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, BlinnPhong, Brdf, Lambert, Microfacet, Phong, Rgb, Shininess};
use lobe_benches::{directions, plain};
use std::hint::black_box;

const COUNT: usize = 16_384;

/// Not inlined, so that each kernel is compiled once, as it would stand in a user's loop.
#[inline(never)]
fn run_loop<T>(pairs: &[(Vec3, Vec3)], out: &mut [T], f: impl Fn(Vec3, Vec3) -> T) {
    for (out, &(l, v)) in out.iter_mut().zip(pairs) {
        *out = f(l, v);
    }
}

/// The same, one pair at a time.
#[inline(never)]
fn run_opaque<T>(pairs: &[(Vec3, Vec3)], out: &mut [T], f: impl Fn(Vec3, Vec3) -> T) {
    for (out, pair) in out.iter_mut().zip(pairs) {
        let (l, v) = *black_box(pair);
        *out = f(l, v);
    }
}

fn compare(
    c: &mut Criterion,
    name: &str,
    plain: impl Fn(Vec3, Vec3) -> Vec3 + Copy,
    ours: impl Fn(Vec3, Vec3) -> Rgb + Copy,
) {
    let pairs = directions(COUNT);
    let mut plain_out = vec![Vec3::ZERO; COUNT];
    let mut our_out = vec![Rgb::splat(0.0); COUNT];
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function(BenchmarkId::new("loop", "plain"), |b| {
        b.iter(|| run_loop(black_box(&pairs), black_box(&mut plain_out), plain));
    });
    group.bench_function(BenchmarkId::new("loop", "lobe"), |b| {
        b.iter(|| run_loop(black_box(&pairs), black_box(&mut our_out), ours));
    });
    group.bench_function(BenchmarkId::new("opaque", "plain"), |b| {
        b.iter(|| run_opaque(black_box(&pairs), black_box(&mut plain_out), plain));
    });
    group.bench_function(BenchmarkId::new("opaque", "lobe"), |b| {
        b.iter(|| run_opaque(black_box(&pairs), black_box(&mut our_out), ours));
    });
    group.finish();
}

fn lobes(c: &mut Criterion) {
    let ks = Vec3::new(0.3, 0.2, 0.1);
    let rgb = Rgb::new(0.3, 0.2, 0.1);
    let q = 50.0;

    let (a, b) = (plain::Lambert { albedo: ks }, Lambert::new(rgb));
    compare(c, "lambert", |l, v| a.eval(l, v), |l, v| b.eval(l.into(), v.into()));
    // What the promise about NaN costs: the plain version reads two cosines, ours all six components.
    compare(c, "lambert-keeping-nan", |l, v| a.eval_keeping_nan(l, v), |l, v| b.eval(l.into(), v.into()));

    let (a, b) = (plain::Phong::new(ks, q), Phong::new(rgb, Shininess(q)));
    compare(c, "phong", |l, v| a.eval(l, v), |l, v| b.eval(l.into(), v.into()));

    let (a, b) = (plain::BlinnPhong::new(ks, q), BlinnPhong::new(rgb, Shininess(q)));
    compare(c, "blinn-phong", |l, v| a.eval(l, v), |l, v| b.eval(l.into(), v.into()));

    let (diffuse, glossy) = (plain::Lambert { albedo: ks }, plain::BlinnPhong::new(ks, q));
    let sum = Lambert::new(rgb) + BlinnPhong::new(rgb, Shininess(q));
    compare(
        c,
        "lambert+blinn-phong",
        |l, v| diffuse.eval(l, v) + glossy.eval(l, v),
        |l, v| sum.eval(l.into(), v.into()),
    );

    let a = plain::Ggx { alpha: 0.3, f0: ks };
    let b = Microfacet::new(Ggx::new(Alpha(0.3)), SmithCorrelated, Schlick::new(rgb));
    compare(c, "ggx", |l, v| a.eval(l, v), |l, v| b.eval(l.into(), v.into()));

    let a = plain::LecturePhong { kd: ks, ks, q };
    let b = lobe::illumination::Phong { ka: rgb, kd: rgb, ks: rgb, q: Shininess(q) };
    compare(
        c,
        "lecture-phong",
        |l, v| a.reflected(Vec3::Z, l, v),
        |l, v| b.reflected(Vec3::Z.into(), l.into(), v.into()),
    );
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(60);
    targets = lobes
}
criterion_main!(benches);
