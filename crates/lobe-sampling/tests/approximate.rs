//! Samples in numbers with fewer digits.

mod common;

use common::*;
use lobe::distribution::{Beckmann, Gaussian, Ggx, Gtr, PhongPower, StudentT};
use lobe::fresnel::Schlick;
use lobe::masking::{SmithCorrelated, VCavity};
use lobe::number::{Approximate, Coarse, Fast};
use lobe::{Alpha, Carry, Lambert, Microfacet, Real, Rgb, Sum, Vec3};
use lobe_sampling::facets::{ByDistribution, Caps, ProjectedDisc};
use lobe_sampling::{Sample, SampleBy};

/// At every end of the square the sample is finite; of viewers from 0.1 up and away from the ends it is near that of
/// `f32`.
fn near<P, L>(name: &str, lobe: &L, bound: f32)
where
    L: Sample<f32> + Carry,
    Approximate<f32, P>: Real<Mask = bool>,
    L::In<Approximate<f32, P>>: Sample<Approximate<f32, P>>,
{
    type N<P> = Approximate<f32, P>;
    let rough = lobe.carry(&N::<P>::new);
    let sample = |v: Vec3<f32>, u: [f32; 3]| rough.sample(v.map(N::new), u.map(N::new));
    for cos in COSINES {
        for x in single_ends() {
            for y in single_ends() {
                let (v, u) = (single(at(cos, 0.9)), [0.3, x, y]);
                let drawn = sample(v, u);
                let (l, weight, pdf) = (drawn.l.map(N::value), drawn.weight.map(N::value), drawn.pdf.value());
                let finite = (l.x + l.y + l.z + weight.r + weight.g + weight.b + pdf).is_finite();
                assert!(
                    finite && (l.length() - 1.0).abs() < bound,
                    "{name} at {cos}, {u:?}: {drawn:?}",
                    drawn = (l, weight, pdf)
                );
            }
        }
    }
    for cos in [1.0, 0.7, 0.1] {
        let v = single(at(cos, 0.9));
        for u in points(512).map(|u| u.map(|u| u as f32)) {
            let (exact, drawn) = (lobe.sample(v, u), sample(v, u));
            let l = drawn.l.map(N::value);
            assert!((exact.l - l).length() < bound, "{name} at {cos}, {u:?}: {:?} {l:?}", exact.l);
            // Its weight is that of the direction as it was drawn.
            let (value, pdf) = lobe.eval_cos_pdf(l, v);
            let weight = drawn.weight.map(N::value);
            if !drawn.rejected && pdf > 1e-20 && l.z > 1e-2 {
                let expected = value.g / pdf;
                assert!(
                    (weight.g - expected).abs() < bound * expected,
                    "{name} at {cos}, {u:?}: {} {expected}",
                    weight.g
                );
            }
        }
    }
}

fn all<P>(bound: f32)
where
    Approximate<f32, P>: Real<Mask = bool>,
{
    let f = Schlick::new(Rgb::new(0.9_f32, 0.6, 0.3));
    let (x, y) = (Alpha(0.5), Alpha(0.3));
    let ggx = Microfacet::new(Ggx::anisotropic(x, y), SmithCorrelated, f);
    near::<P, _>("ggx", &ggx, bound);
    near::<P, _>("ggx, caps", &ggx.by(Caps), bound);
    near::<P, _>("ggx, disc", &ggx.by(ProjectedDisc), bound);
    near::<P, _>("ggx, by distribution", &ggx.by(ByDistribution), bound);
    near::<P, _>("beckmann", &Microfacet::new(Beckmann::anisotropic(x, y), SmithCorrelated, f), bound);
    near::<P, _>("phong power", &Microfacet::new(PhongPower::anisotropic(x, y), VCavity, f), bound);
    near::<P, _>("student-t", &Microfacet::new(StudentT::anisotropic(x, y, 3.0), VCavity, f), bound);
    near::<P, _>("gtr", &Microfacet::new(Gtr::anisotropic(x, y, 1.0), VCavity, f), bound);
    near::<P, _>("gaussian", &Microfacet::new(Gaussian::anisotropic(x, y), VCavity, f), bound);
    near::<P, _>("sum", &Sum { a: Lambert::new(Rgb::splat(0.5_f32)), b: ggx }, bound);
}

#[test]
fn samples_in_fast_numbers() {
    all::<Fast>(0.02);
}

#[test]
fn samples_in_coarse_numbers() {
    all::<Coarse>(0.1);
}
