//! Points that wait to be shaded, and how a surface shades them all at once.

use crate::gltf_material::{Coat, GltfMaterial};
use crate::material::Surface;
use lobe::batch::{AtEveryLevel, Batch, Columns, LengthError, Shade};
use lobe::number::{Coarse, Fast, Precise};
use lobe::{Brdf, Rgb, Vec3};
use lobe_models::AnyPrecision;

/// Lights at points, as a structure of arrays: the directions `l` and `v` in the local frame, the irradiance `E`, and the
/// numbers of a material that differ from point to point.
#[derive(Debug, Clone, Default)]
pub(crate) struct LitPoints {
    columns: [Vec<f32>; 9],
    parameters: Vec<Vec<f32>>,
}

impl LitPoints {
    /// `parameters` are as many for each point of a queue.
    pub(crate) fn push(&mut self, l: Vec3, v: Vec3, irradiance: Rgb, parameters: &[f32]) {
        let numbers = [l.x, l.y, l.z, v.x, v.y, v.z, irradiance.r, irradiance.g, irradiance.b];
        for (column, number) in self.columns.iter_mut().zip(numbers) {
            column.push(number);
        }
        self.parameters.resize_with(parameters.len(), Vec::new);
        for (column, number) in self.parameters.iter_mut().zip(parameters) {
            column.push(*number);
        }
    }

    pub(crate) fn clear(&mut self) {
        self.columns.iter_mut().chain(&mut self.parameters).for_each(Vec::clear);
    }

    /// A column of parameters; empty where there is none, which then is an error of the batch.
    fn parameter(&self, index: usize) -> &[f32] {
        self.parameters.get(index).map_or(&[], Vec::as_slice)
    }

    fn colour(&self, first: usize) -> Rgb<&[f32]> {
        Rgb { r: self.parameter(first), g: self.parameter(first + 1), b: self.parameter(first + 2) }
    }

    /// `eval_cos(l, v) E` of a coat at each point: its intensity and its `α` are the parameters.
    pub(crate) fn shade_coat(&self, precision: AnyPrecision, out: &mut [Vec<f32>; 3]) {
        let Some(out) = cleared(out, self.len()) else { return };
        let lit = (self.l(), self.v(), self.irradiance());
        let result = run(precision, Coat, (lit, (self.parameter(0), self.parameter(1))), out);
        debug_assert!(result.is_ok(), "all columns grow together");
    }

    fn shade_gltf(
        &self,
        material: &GltfMaterial,
        precision: AnyPrecision,
        out: Rgb<&mut [f32]>,
    ) -> Result<(), LengthError> {
        let lit = (self.l(), self.v(), self.irradiance());
        let base = (self.colour(0), self.parameter(3), self.parameter(4));
        if material.is_full() {
            let rest = ((self.parameter(5), self.colour(6)), self.parameter(9), (self.colour(10), self.parameter(13)));
            let (specular, anisotropy, sheen) = rest;
            return run(precision, material.full(), (lit, (base, specular, anisotropy, sheen)), out);
        }
        run(precision, material.plain(), (lit, base), out)
    }

    fn len(&self) -> usize {
        self.columns[0].len()
    }

    fn l(&self) -> Vec3<&[f32]> {
        let [x, y, z, ..] = &self.columns;
        Vec3::new(x, y, z)
    }

    fn v(&self) -> Vec3<&[f32]> {
        let [_, _, _, x, y, z, ..] = &self.columns;
        Vec3::new(x, y, z)
    }

    fn irradiance(&self) -> Rgb<&[f32]> {
        let [.., r, g, b] = &self.columns;
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
        let Some(out) = cleared(out, points.len()) else { return };
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
            Self::Gltf(material) => points.shade_gltf(material, precision, out),
            Self::Mapped(mapped) => run(precision, Shade(mapped.diffuse), inputs, out),
            Self::Other(lobes) => {
                points.each(&**lobes, out);
                Ok(())
            }
        };
        debug_assert!(result.is_ok(), "all columns grow together");
    }
}

/// Three vectors of as many zeros; nothing for none.
fn cleared(out: &mut [Vec<f32>; 3], length: usize) -> Option<Rgb<&mut [f32]>> {
    for channel in &mut *out {
        channel.clear();
        channel.resize(length, 0.0);
    }
    let [r, g, b] = out;
    (length > 0).then_some(Rgb { r: &mut r[..], g: &mut g[..], b: &mut b[..] })
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
