//! Batches beside the plain loops that a good engineer writes: ratios, interleaved in one run.
//!
//! ```text
//! cargo bench -p lobe-benches --bench batch [-- NAME...]
//! ```
//!
//! At the best level of the machine, or at the one that `LOBE_LEVEL` names (`sse4.2`, `avx2`, `avx512`).
//!
//! The baseline is the same formula as a plain `f32` loop over the same slices, with `glam` and `powf`, compiled for the
//! default target, where the compiler vectorises what it can. Each figure is the median of many rounds, in each of which
//! every contender runs once, over several buffers in turn; the ratio is the median of the rounds' ratios, with its
//! quartiles.

use lobe::batch::{Batch, Kernel, Shade};
use lobe::distribution::{Beckmann, Ggx};
use lobe::fresnel::{Conductor, Schlick};
use lobe::masking::{RationalBeckmann, SmithCorrelated};
use lobe::number::{Coarse, Fast};
use lobe::{
    Alpha, AshikhminShirley, BlinnPhong, MetallicRoughness, Microfacet, OrenNayarQualitative, Real, Rgb, Shininess,
    Vec3, Ward,
};
use lobe_benches::plain_batches as plain;
use lobe_benches::rounds::{self, CACHED, wanted_level};
use lobe_benches::slices::{self, Slices};

type Run<'a> = rounds::Run<'a, Slices, Out>;

/// The channels of the result.
struct Out(slices::Out<3>);

impl Out {
    fn get(&mut self) -> Rgb<&mut [f32]> {
        let [r, g, b] = self.0.get();
        Rgb { r, g, b }
    }
}

/// [`rounds::compare`] of what shades `count` pairs of directions.
fn compare(title: &str, count: usize, runs: &mut [Run<'_>]) {
    rounds::compare(title, count, |seed| Slices::of(count, seed), Out(slices::Out::new(count)), runs);
}

/// The loop of the baseline. The outputs are arguments of their own, so that the compiler knows that they do not overlap.
#[inline(never)]
fn plain_loop(
    l: Vec3<&[f32]>,
    v: Vec3<&[f32]>,
    r: &mut [f32],
    g: &mut [f32],
    b: &mut [f32],
    f: impl Fn(glam::Vec3, glam::Vec3) -> glam::Vec3,
) {
    let n = r.len();
    let (g, b) = (&mut g[..n], &mut b[..n]);
    let (lx, ly, lz) = (&l.x[..n], &l.y[..n], &l.z[..n]);
    let (vx, vy, vz) = (&v.x[..n], &v.y[..n], &v.z[..n]);
    for i in 0..n {
        let f = f(glam::Vec3::new(lx[i], ly[i], lz[i]), glam::Vec3::new(vx[i], vy[i], vz[i]));
        r[i] = f.x;
        g[i] = f.y;
        b[i] = f.z;
    }
}

/// A lobe of ours to both precisions, and its plain version.
macro_rules! lobes {
    ($batch:ident; $($title:literal: $plain:expr, $lobe:expr;)+) => {$(
        {
            let (plain, lobe) = ($plain, $lobe);
            let mut runs: Vec<Run<'_>> = vec![(
                "plain".into(),
                Box::new(move |s: &Slices, out: &mut Out| {
                    let Rgb { r, g, b } = out.get();
                    plain_loop(s.l(), s.v(), r, g, b, plain);
                }),
            )];
            runs.push(("precise".into(), Box::new(|s: &Slices, out: &mut Out| {
                $batch.eval_cos(&lobe, s.l(), s.v(), out.get()).expect("one length");
            })));
            runs.push(("fast".into(), Box::new(|s: &Slices, out: &mut Out| {
                $batch.precision::<Fast>().eval_cos(&lobe, s.l(), s.v(), out.get()).expect("one length");
            })));
            runs.push(("coarse".into(), Box::new(|s: &Slices, out: &mut Out| {
                $batch.precision::<Coarse>().eval_cos(&lobe, s.l(), s.v(), out.get()).expect("one length");
            })));
            compare($title, CACHED, &mut runs);
        }
    )+};
}

/// The roots and divisions of GGX, and nothing else.
struct Divider;
impl<R: Real> Kernel<(Vec3<R>, Vec3<R>), Rgb<R>> for Divider {
    #[inline(always)]
    fn apply(&self, (l, v): (Vec3<R>, Vec3<R>)) -> Rgb<R> {
        Rgb { r: l.x.sqrt() + l.y / v.x, g: l.z.sqrt() + v.y / v.z, b: v.x.sqrt() }
    }
}

/// Six numbers in, three out.
struct Move;
impl<R: Real> Kernel<(Vec3<R>, Vec3<R>), Rgb<R>> for Move {
    #[inline(always)]
    fn apply(&self, (l, v): (Vec3<R>, Vec3<R>)) -> Rgb<R> {
        Rgb { r: l.x + v.x, g: l.y + v.y, b: l.z + v.z }
    }
}

fn main() {
    let level = wanted_level();
    let best = Batch::at(level.1);
    println!("level: {}", level.0);
    let (grey, rgb) = (glam::Vec3::new(0.9, 0.6, 0.3), Rgb::new(0.9_f32, 0.6, 0.3));
    let ggx = Microfacet::new(Ggx::new(Alpha(0.3)), SmithCorrelated, Schlick::new(rgb));
    let (eta, k) = ([0.2_f32, 0.9, 1.1], [3.9_f32, 2.4, 2.2]);
    let conductor = Microfacet::new(Ggx::new(Alpha(0.3)), SmithCorrelated, Conductor::new(eta.into(), k.into()));

    lobes! { best;
        "ggx, schlick": move |l, v| plain::ggx(0.3, grey, l, v), ggx;
        "ggx, exact conductor": move |l, v| plain::ggx_conductor(0.3, eta.into(), k.into(), l, v), conductor;
        "blinn-phong, q = 50": move |l, v| plain::blinn_phong(50.0, grey, l, v), <BlinnPhong>::new(rgb, Shininess(50.0));
        "beckmann": move |l, v| plain::beckmann(0.3, grey, l, v),
            Microfacet::new(Beckmann::new(Alpha(0.3)), RationalBeckmann::new(Alpha(0.3)), Schlick::new(rgb));
        "ward": move |l, v| plain::ward([0.2, 0.4], grey, l, v), Ward::new(rgb, Alpha(0.2), Alpha(0.4));
        "ashikhmin-shirley": move |l, v| plain::ashikhmin_shirley(20.0, 80.0, grey, l, v),
            AshikhminShirley::new(rgb, Shininess(20.0), Shininess(80.0));
        "oren-nayar": move |l, v| plain::oren_nayar(0.4, grey, l, v), OrenNayarQualitative::new(rgb, 0.4);
        "gltf": move |l, v| plain::gltf(grey, 0.5, 0.3, l, v), MetallicRoughness::new(rgb, 0.5, Alpha(0.3));
    }

    // What the exact Fresnel term costs.
    let fast = best.precision::<Fast>();
    compare(
        "conductor for schlick",
        CACHED,
        &mut [
            (
                "schlick, precise".into(),
                Box::new(|s, out| best.eval_cos(&ggx, s.l(), s.v(), out.get()).expect("one length")),
            ),
            (
                "conductor, precise".into(),
                Box::new(|s, out| best.eval_cos(&conductor, s.l(), s.v(), out.get()).expect("one length")),
            ),
            (
                "schlick, fast".into(),
                Box::new(|s, out| fast.eval_cos(&ggx, s.l(), s.v(), out.get()).expect("one length")),
            ),
            (
                "conductor, fast".into(),
                Box::new(|s, out| fast.eval_cos(&conductor, s.l(), s.v(), out.get()).expect("one length")),
            ),
        ],
    );

    // The floors.
    compare(
        "floors of ggx",
        CACHED,
        &mut [
            (
                "ggx, precise".into(),
                Box::new(|s, out| best.eval_cos(&ggx, s.l(), s.v(), out.get()).expect("one length")),
            ),
            (
                "its roots and divisions".into(),
                Box::new(|s, out| best.run(&Divider, (s.l(), s.v()), out.get()).expect("one length")),
            ),
            (
                "its slices, moved".into(),
                Box::new(|s, out| best.run(&Move, (s.l(), s.v()), out.get()).expect("one length")),
            ),
        ],
    );
    // What a call costs, whatever it computes: sixteen points are one register at most levels.
    compare(
        "a call of 16 points",
        16,
        &mut [
            (
                "plain".into(),
                Box::new(|s, out| {
                    let Rgb { r, g, b } = out.get();
                    plain_loop(s.l(), s.v(), r, g, b, |l, v| l + v);
                }),
            ),
            (
                "its slices, moved".into(),
                Box::new(|s, out| best.run(&Move, (s.l(), s.v()), out.get()).expect("one length")),
            ),
            (
                "ggx, precise".into(),
                Box::new(|s, out| best.eval_cos(&ggx, s.l(), s.v(), out.get()).expect("one length")),
            ),
        ],
    );
    let streamed = 1 << 20;
    compare(
        "ggx, streaming from memory",
        streamed,
        &mut [
            (
                "six slices to three, moved".into(),
                Box::new(|s, out| best.run(&Move, (s.l(), s.v()), out.get()).expect("one length")),
            ),
            (
                "ggx, precise".into(),
                Box::new(|s, out| best.eval_cos(&ggx, s.l(), s.v(), out.get()).expect("one length")),
            ),
            ("ggx, fast".into(), Box::new(|s, out| fast.eval_cos(&ggx, s.l(), s.v(), out.get()).expect("one length"))),
        ],
    );

    // Sixteen lights for one view.
    let lights: Vec<Slices> = (0..16).map(|k| Slices::of(CACHED, 100 + k)).collect();
    let columns: Vec<_> = lights.iter().map(|s| (s.l(), Rgb { r: s.v().x, g: s.v().y, b: s.v().z })).collect();
    compare(
        "16 lights, one view, fast",
        CACHED,
        &mut [
            (
                "16 calls".into(),
                Box::new(|s, out| {
                    for &(l, e) in &columns {
                        fast.accumulate(Shade(ggx), (s.v(), (l, e)), out.get()).expect("one length");
                    }
                }),
            ),
            (
                "one call".into(),
                Box::new(|s, out| fast.shade_lights(&ggx, s.v(), &columns, out.get()).expect("one length")),
            ),
        ],
    );
    compare(
        "16 lights, one view, precise",
        CACHED,
        &mut [
            (
                "16 calls".into(),
                Box::new(|s, out| {
                    for &(l, e) in &columns {
                        best.accumulate(Shade(ggx), (s.v(), (l, e)), out.get()).expect("one length");
                    }
                }),
            ),
            (
                "one call".into(),
                Box::new(|s, out| best.shade_lights(&ggx, s.v(), &columns, out.get()).expect("one length")),
            ),
        ],
    );
}
