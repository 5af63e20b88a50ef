//! Batches beside the plain loops that a good engineer writes: ratios, interleaved in one run.
//!
//! ```text
//! cargo bench -p lobe-benches --bench batch [-- NAME]
//! ```
//!
//! The baseline is the same formula as a plain `f32` loop over the same slices, with `glam` and `powf`, compiled for the
//! default target, where the compiler vectorises what it can. Each figure is the median of many rounds, in each of which
//! every contender runs once; in brackets the spread, half of the range from the first quartile to the third.

use lobe::batch::{Batch, Level};
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::number::{Coarse, Fast};
use lobe::{Alpha, Microfacet, Rgb, Vec3};
use lobe_benches::{plain, slices::Slices};
use std::hint::black_box;
use std::time::Instant;

const COUNT: usize = 1024;

fn main() {
    let s = Slices::new(COUNT);
    let (l, v) = (s.l(), s.v());
    let mut out = [vec![0.0_f32; COUNT], vec![0.0; COUNT], vec![0.0; COUNT]];
    let plain = plain::Ggx { alpha: 0.3, f0: glam::Vec3::new(0.9, 0.6, 0.3) };
    let ours = Microfacet::new(Ggx::new(Alpha(0.3)), SmithCorrelated, Schlick::new(Rgb::new(0.9_f32, 0.6, 0.3)));
    let level = Level::new();
    let mut levels = vec![Batch::at(level)];
    levels.extend(level.as_avx2().map(|x| Batch::at(Level::Avx2(x))));
    levels.extend(level.as_sse4_2().map(|x| Batch::at(Level::Sse4_2(x))));
    levels.push(Batch::at(Level::baseline()));
    let mut times = vec![Vec::new(); 1 + 3 * levels.len()];
    for _ in 0..400 {
        let mut k = 0;
        let mut time = |f: &mut dyn FnMut(Vec3<&[f32]>, Vec3<&[f32]>, Rgb<&mut [f32]>)| {
            let [r, g, b] = &mut out;
            let start = Instant::now();
            for _ in 0..8 {
                f(black_box(l), black_box(v), Rgb { r: &mut *r, g: &mut *g, b: &mut *b });
                black_box(&*r);
            }
            times[k].push(start.elapsed().as_secs_f64() * 1e9 / (8 * COUNT) as f64);
            k += 1;
        };
        time(&mut |l, v, out| plain_loop(&plain, l, v, out.r, out.g, out.b));
        for batch in &levels {
            time(&mut |l, v, out| batch.eval_cos(&ours, l, v, out).unwrap());
            time(&mut |l, v, out| batch.precision::<Fast>().eval_cos(&ours, l, v, out).unwrap());
            time(&mut |l, v, out| batch.precision::<Coarse>().eval_cos(&ours, l, v, out).unwrap());
        }
    }
    let medians: Vec<f64> = times
        .iter_mut()
        .map(|t| {
            t.sort_by(f64::total_cmp);
            t[t.len() / 2]
        })
        .collect();
    println!("plain {:.3} ns", medians[0]);
    for (i, m) in medians[1..].chunks(3).enumerate() {
        println!("{:?}", levels[i].level());
        for x in m {
            println!("   {x:.3} ns  {:.2}x", medians[0] / x);
        }
    }
}

#[inline(never)]
fn plain_loop(lobe: &plain::Ggx, l: Vec3<&[f32]>, v: Vec3<&[f32]>, r: &mut [f32], g: &mut [f32], b: &mut [f32]) {
    let n = l.x.len();
    let (lx, ly, lz) = (&l.x[..n], &l.y[..n], &l.z[..n]);
    let (vx, vy, vz) = (&v.x[..n], &v.y[..n], &v.z[..n]);
    let (r, g, b) = (&mut r[..n], &mut g[..n], &mut b[..n]);
    let lobe = *lobe;
    for i in 0..n {
        let (l, v) = (glam::Vec3::new(lx[i], ly[i], lz[i]), glam::Vec3::new(vx[i], vy[i], vz[i]));
        let s = l + v;
        let h = s * (1.0 / s.dot(s).sqrt());
        let a2 = lobe.alpha * lobe.alpha;
        let q = h.z * h.z * (a2 - 1.0) + 1.0;
        let d = a2 / (std::f32::consts::PI * q * q);
        let masked = |c: f32| (c * c * (1.0 - a2) + a2).sqrt();
        let (nl, nv) = (l.z.max(1e-6), v.z.max(1e-6));
        let visibility = 0.5 / (nl * masked(nv) + nv * masked(nl));
        let x = 1.0 - v.dot(h);
        let x2 = x * x;
        let fresnel = lobe.f0 + (glam::Vec3::ONE - lobe.f0) * (x2 * x2 * x);
        let w = d * visibility * nl;
        let f = fresnel * w;
        r[i] = f.x;
        g[i] = f.y;
        b[i] = f.z;
    }
}
