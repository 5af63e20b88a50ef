//! Samples in batches beside the scalar: ratios, interleaved in one run.
//!
//! ```text
//! cargo bench -p lobe-benches --bench sampling [-- NAME...]
//! ```
//!
//! At the best level of the machine, or at the one that `LOBE_LEVEL` names (`sse4.2`, `avx2`, `avx512`).
//!
//! A sample is a direction, its weight and its density, from a viewer and three numbers. The scalar is the same code in `f32`, compiled
//! for the default target: *called* once for each sample, as where a path chooses its next direction, and as a *loop* over slices,
//! in which the compiler vectorises what it can. Ratios are to the call. Three of eight lobes are the same GGX, its facets drawn in
//! three ways.

use lobe::batch::{Batch, Level};
use lobe::distribution::{Ggx, GgxAnisotropic};
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::number::{Coarse, Fast};
use lobe::{Alpha, BlinnPhong, Lambert, Microfacet, Phong, Rgb, Shininess, Sum, Vec3};
use lobe_benches::rounds::{CACHED, Run, compare, wanted_level};
use lobe_benches::slices::{Draws, Out};
use lobe_sampling::batch::Scatter;
use lobe_sampling::facets::{Caps, ProjectedDisc};
use lobe_sampling::{Sample, SampleBy, Sampled};

/// The direction, the weight and the density of each sample.
type Result = Out<7>;

/// The slices as a batch takes them.
fn columns(out: &mut Result) -> (Vec3<&mut [f32]>, Rgb<&mut [f32]>, &mut [f32]) {
    let [x, y, z, r, g, b, pdf] = out.get();
    (Vec3 { x, y, z }, Rgb { r, g, b }, pdf)
}

/// The samples of all draws, one after the other. Inlined into a function of its own for each lobe.
#[inline(always)]
fn each(draws: &Draws, out: &mut Result, sample: impl Fn(Vec3<f32>, [f32; 3]) -> Sampled<f32>) {
    let (v, (u0, u1, u2)) = (draws.v(), draws.u());
    let (l, weight, pdf) = columns(out);
    let n = pdf.len();
    let (vx, vy, vz) = (&v.x[..n], &v.y[..n], &v.z[..n]);
    let (u0, u1, u2) = (&u0[..n], &u1[..n], &u2[..n]);
    let (x, y, z) = (&mut l.x[..n], &mut l.y[..n], &mut l.z[..n]);
    let (r, g, b) = (&mut weight.r[..n], &mut weight.g[..n], &mut weight.b[..n]);
    for i in 0..n {
        let one = sample(Vec3::new(vx[i], vy[i], vz[i]), [u0[i], u1[i], u2[i]]);
        (x[i], y[i], z[i]) = (one.l.x, one.l.y, one.l.z);
        (r[i], g[i], b[i]) = (one.weight.r, one.weight.g, one.weight.b);
        pdf[i] = one.pdf;
    }
}

/// The same by calls, from points that lie as a path has them: put together from slices beside each call, their halves would have to
/// be written before the call can read them whole, which is a sixth of the time of GGX by bounded normals and none of the sampler's.
fn each_call<B: Sample<f32>>(lobe: &B, draws: &Draws, out: &mut Result) {
    let (l, weight, pdf) = columns(out);
    let n = pdf.len();
    let (x, y, z) = (&mut l.x[..n], &mut l.y[..n], &mut l.z[..n]);
    let (r, g, b) = (&mut weight.r[..n], &mut weight.g[..n], &mut weight.b[..n]);
    for (i, (v, u)) in draws.points()[..n].iter().enumerate() {
        let one = call(lobe, *v, *u);
        (x[i], y[i], z[i]) = (one.l.x, one.l.y, one.l.z);
        (r[i], g[i], b[i]) = (one.weight.r, one.weight.g, one.weight.b);
        pdf[i] = one.pdf;
    }
}

/// One sample, which no loop is inlined around.
#[inline(never)]
fn call<B: Sample<f32>>(lobe: &B, v: Vec3<f32>, u: [f32; 3]) -> Sampled<f32> {
    lobe.sample(v, u)
}

/// A lobe as a scalar and to every precision.
macro_rules! lobes {
    ($level:ident; $($title:literal: $lobe:expr;)+) => {$(
        {
            let lobe = $lobe;
            let batch = Batch::at($level);
            let run = Scatter(lobe);
            let mut runs: Vec<Run<'_, Draws, Result>> = vec![
                ("scalar, called".into(), Box::new(|s, out| each_call(&lobe, s, out))),
                ("scalar, in a loop".into(), Box::new(|s, out| each(s, out, |v, u| lobe.sample(v, u)))),
                ("precise".into(), Box::new(|s, out| batch.run(run, (s.v(), s.u()), columns(out)).expect("one length"))),
                ("fast".into(), Box::new(|s, out| {
                    batch.precision::<Fast>().run(run, (s.v(), s.u()), columns(out)).expect("one length");
                })),
                ("coarse".into(), Box::new(|s, out| {
                    batch.precision::<Coarse>().run(run, (s.v(), s.u()), columns(out)).expect("one length");
                })),
            ];
            compare($title, CACHED, |seed| Draws::of(CACHED, seed), Out::new(CACHED), &mut runs);
        }
    )+};
}

fn main() {
    let (name, level): (_, Level) = wanted_level();
    println!("level: {name}");
    let (grey, rgb) = (Rgb::splat(0.5_f32), Rgb::new(0.9_f32, 0.6, 0.3));
    let ggx = Microfacet::new(Ggx::new(Alpha(0.3)), SmithCorrelated, Schlick::new(rgb));
    let brushed = Microfacet::new(GgxAnisotropic::new(Alpha(0.4), Alpha(0.1)), SmithCorrelated, Schlick::new(rgb));
    let lambert = Lambert::new(grey);

    lobes! { level;
        "ggx, bounded": ggx;
        "ggx, caps": ggx.by(Caps);
        "ggx, projected disc": ggx.by(ProjectedDisc);
        "ggx of two widths, bounded": brushed;
        "lambert": lambert;
        "phong, q = 50": <Phong>::new(rgb, Shininess(50.0));
        "blinn-phong, q = 50": <BlinnPhong>::new(rgb, Shininess(50.0));
        "lambert + ggx": Sum { a: lambert, b: ggx };
    }
}
