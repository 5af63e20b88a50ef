//! Points that wait to be shaded, and how a surface shades them all at once.

use crate::material::Surface;
use lobe::batch::{AtEveryLevel, Batch, Columns, LengthError, Shade};
use lobe::number::{Coarse, Fast, Precise};
use lobe::{Brdf, Rgb, Vec3};
use lobe_models::AnyPrecision;

/// Lights at points, as a structure of arrays: the directions `l` and `v` in the local frame, and the irradiance `E`.
#[derive(Debug, Clone, Default)]
pub(crate) struct LitPoints([Vec<f32>; 9]);

impl LitPoints {
    pub(crate) fn push(&mut self, l: Vec3, v: Vec3, irradiance: Rgb) {
        let numbers = [l.x, l.y, l.z, v.x, v.y, v.z, irradiance.r, irradiance.g, irradiance.b];
        for (column, number) in self.0.iter_mut().zip(numbers) {
            column.push(number);
        }
    }

    pub(crate) fn clear(&mut self) {
        self.0.iter_mut().for_each(Vec::clear);
    }

    fn len(&self) -> usize {
        self.0[0].len()
    }

    fn l(&self) -> Vec3<&[f32]> {
        let [x, y, z, ..] = &self.0;
        Vec3::new(x, y, z)
    }

    fn v(&self) -> Vec3<&[f32]> {
        let [_, _, _, x, y, z, ..] = &self.0;
        Vec3::new(x, y, z)
    }

    fn irradiance(&self) -> Rgb<&[f32]> {
        let [.., r, g, b] = &self.0;
        Rgb { r, g, b }
    }

    /// One point after the other, for a BRDF of which nothing is known.
    fn each(&self, brdf: &(impl Brdf<f32> + ?Sized), out: Rgb<&mut [f32]>) {
        let (l, v, e) = (self.l(), self.v(), self.irradiance());
        for i in 0..self.len() {
            let (l, v) = (Vec3::new(l.x[i], l.y[i], l.z[i]), Vec3::new(v.x[i], v.y[i], v.z[i]));
            let reflected = brdf.eval_cos(l, v) * Rgb::new(e.r[i], e.g[i], e.b[i]);
            (out.r[i], out.g[i], out.b[i]) = (reflected.r, reflected.g, reflected.b);
        }
    }
}

impl Surface {
    /// `eval_cos(l, v) E` of each point, into vectors of as many numbers.
    pub(crate) fn shade(&self, points: &LitPoints, precision: AnyPrecision, out: &mut [Vec<f32>; 3]) {
        for channel in &mut *out {
            channel.clear();
            channel.resize(points.len(), 0.0);
        }
        let [r, g, b] = out;
        let out = Rgb { r: &mut r[..], g: &mut g[..], b: &mut b[..] };
        if points.len() == 0 {
            return;
        }
        let (l, v, irradiance) = (points.l(), points.v(), points.irradiance());
        let inputs = (v, (l, irradiance));
        let result = match self {
            Self::Black => Ok(()),
            Self::Diffuse(lobes) => run(precision, Shade(*lobes), inputs, out),
            Self::BlinnTorrance(lobes) => run(precision, Shade(*lobes), inputs, out),
            Self::Phong(lobes) => run(precision, Shade(*lobes), inputs, out),
            Self::NormalizedPhong(lobes) => run(precision, Shade(*lobes), inputs, out),
            Self::NormalizedBlinnPhong(lobes) => run(precision, Shade(*lobes), inputs, out),
            Self::Lobes(lobes) => lobes.batch().shade(Batch::new().level(), precision, l, v, irradiance, out),
            Self::Other(lobes) => {
                points.each(&**lobes, out);
                Ok(())
            }
        };
        debug_assert!(result.is_ok(), "all columns grow together");
    }
}

/// A kernel, to a precision that is known at run time.
fn run<'a, K, C: Columns>(
    precision: AnyPrecision,
    kernel: K,
    inputs: C,
    out: Rgb<&'a mut [f32]>,
) -> Result<(), LengthError>
where
    K: AtEveryLevel<Precise, C, Rgb<&'a mut [f32]>>
        + AtEveryLevel<Fast, C, Rgb<&'a mut [f32]>>
        + AtEveryLevel<Coarse, C, Rgb<&'a mut [f32]>>,
{
    let batch = Batch::new();
    match precision {
        AnyPrecision::Precise => batch.run(kernel, inputs, out),
        AnyPrecision::Fast => batch.precision::<Fast>().run(kernel, inputs, out),
        AnyPrecision::Coarse => batch.precision::<Coarse>().run(kernel, inputs, out),
    }
}
