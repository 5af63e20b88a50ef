//! Samples over slices, in SIMD lanes.

use crate::{Sample, Sampled};
use lobe::batch::Kernel;
use lobe::{Carry, Real, Rgb, Vec3};

/// [`sample`](Sample::sample) of a lobe: `(l, weight, pdf)` for `(v, (u0, u1, u2))`.
///
/// What masks say of a scalar is in the numbers: a rejected sample has the weight 0 and the density 0, a delta the
/// density infinity.
///
/// ```
/// use lobe::batch::Batch;
/// use lobe::{Alpha, Microfacet, Rgb, Vec3, distribution::Ggx, fresnel::Schlick, masking::SmithCorrelated};
/// use lobe_sampling::{Sample, batch::Scatter};
///
/// let gold = Microfacet::new(Ggx::new(Alpha(0.2)), SmithCorrelated, Schlick::new(Rgb::new(1.0_f32, 0.77, 0.34)));
/// let v = Vec3::new(&[0.6_f32, 0.0, 0.48][..], &[0.0, 0.8, 0.6], &[0.8, 0.6, 0.64]);
/// let u = (&[0.5_f32, 0.5, 0.5][..], &[0.1_f32, 0.4, 0.9][..], &[0.2_f32, 0.5, 0.8][..]);
/// let (mut x, mut y, mut z) = ([0.0_f32; 3], [0.0; 3], [0.0; 3]);
/// let (mut r, mut g, mut b, mut pdf) = ([0.0_f32; 3], [0.0; 3], [0.0; 3], [0.0; 3]);
/// let l = Vec3 { x: &mut x[..], y: &mut y, z: &mut z };
/// let weight = Rgb { r: &mut r[..], g: &mut g, b: &mut b };
/// Batch::new().run(Scatter(gold), (v, u), (l, weight, &mut pdf[..]))?;
///
/// let one = gold.sample(Vec3::new(0.48, 0.6, 0.64), [0.5, 0.9, 0.8]);
/// assert_eq!((x[2], g[2], pdf[2]), (one.l.x, one.weight.g, one.pdf));
/// # Ok::<(), lobe::batch::LengthError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Scatter<B>(pub B);

impl<B: Carry, R: Real> Kernel<(Vec3<R>, (R, R, R)), (Vec3<R>, Rgb<R>, R)> for Scatter<B>
where
    B::In<R>: Sample<R>,
{
    #[inline(always)]
    fn apply(&self, (v, (x, y, z)): (Vec3<R>, (R, R, R))) -> (Vec3<R>, Rgb<R>, R) {
        let lobe = self.0.carry(&lift(v.z));
        let Sampled { l, weight, pdf, delta, .. } = lobe.sample(v, [x, y, z]);
        (l, weight, R::select(delta, pdf.lift(f64::INFINITY), pdf))
    }
}

/// A number of the scalar in the shape of `x`; `f64` holds it exactly.
#[inline(always)]
fn lift<R: Real>(x: R) -> impl Fn(f32) -> R {
    #[inline(always)]
    move |c| x.lift(f64::from(c))
}
