//! A lobe over slices of which only the values are known at run time.

use crate::catalogue::Model;
use crate::function::Function;
use crate::number::{AnyBrdf, Built, Number};
use crate::reader::Reader;
use lobe::batch::{AtEveryLevel, Batch, LengthError, Level, Shade};
use lobe::number::{Approximate, Coarse, Fast, Precise, Precision};
use lobe::{Brdf, Carry, Rgb, Vec3};
use std::fmt;
use std::sync::Arc;

/// A lobe over slices of which only that is known.
pub type AnyBatch = Box<dyn BatchBrdf + Send + Sync>;

/// A precision chosen at run time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AnyPrecision {
    /// The bits of the scalar `f32`.
    #[default]
    Precise,
    /// About 13 binary digits.
    Fast,
    /// About 10 binary digits, enough for a picture of eight bits.
    Coarse,
}

impl AnyPrecision {
    /// All of them, the most precise first.
    pub const ALL: [Self; 3] = [Self::Precise, Self::Fast, Self::Coarse];

    /// Its name: `precise`, `fast` or `coarse`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Precise => Precise::NAME,
            Self::Fast => Fast::NAME,
            Self::Coarse => Coarse::NAME,
        }
    }
}

impl fmt::Display for AnyPrecision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A lobe over slices, at a level and to a precision that are chosen with each call.
///
/// ```
/// use lobe::batch::Level;
/// use lobe::{Rgb, Vec3};
/// use lobe_models::{AnyPrecision, preset};
///
/// let gold = preset("ggx-gold")?.batch();
/// let (x, z) = ([0.6_f32, 0.0, 0.28], [0.8_f32, 1.0, 0.96]);
/// let (l, v) = (Vec3::new(&x[..], &[0.0; 3], &z), Vec3::new(&[0.0_f32; 3][..], &[0.0; 3], &[1.0; 3]));
/// let (mut r, mut g, mut b) = ([0.0; 3], [0.0; 3], [0.0; 3]);
/// let out = Rgb { r: &mut r[..], g: &mut g, b: &mut b };
/// gold.eval_cos(Level::new(), AnyPrecision::Fast, l, v, out)?;
/// assert!(r[1] > r[2] && r[2] > r[0] && r[1] > b[1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait BatchBrdf {
    /// Adds to `out` what each point sends to `v` of the irradiance from `l`: `eval_cos(l, v) · E`.
    ///
    /// For a lobe without a weight, and the precision [`Precise`](AnyPrecision::Precise), with the bits of the scalar
    /// `f32`. A sum of lobes is added lobe by lobe, and a weight is multiplied with the irradiance first: the last digits
    /// may differ.
    ///
    /// # Errors
    /// [`LengthError`] if the slices are not equally long; then nothing is written. They are counted in the order of the
    /// arguments.
    fn shade(
        &self,
        level: Level,
        precision: AnyPrecision,
        l: Vec3<&[f32]>,
        v: Vec3<&[f32]>,
        irradiance: Rgb<&[f32]>,
        out: Rgb<&mut [f32]>,
    ) -> Result<(), LengthError>;

    /// [`eval_cos`](Brdf::eval_cos) of each pair of directions.
    ///
    /// With [`Precise`](AnyPrecision::Precise) the bits of the scalar `f32`, for a material too.
    ///
    /// # Errors
    /// As for [`shade`](Self::shade).
    fn eval_cos(
        &self,
        level: Level,
        precision: AnyPrecision,
        l: Vec3<&[f32]>,
        v: Vec3<&[f32]>,
        out: Rgb<&mut [f32]>,
    ) -> Result<(), LengthError> {
        same_length(&[l.x, l.y, l.z, v.x, v.y, v.z, &*out.r, &*out.g, &*out.b])?;
        // −0 and not 0: −0 + x is x for every x, and 0 + (−0) is not. So one kernel does for both.
        let Rgb { r, g, b } = out;
        r.fill(-0.0);
        g.fill(-0.0);
        b.fill(-0.0);
        // So many that a call for each is not felt, and so few that they stay in the first cache.
        const CHUNK: usize = 256;
        let ones = [1.0; CHUNK];
        for ((r, g), (b, start)) in
            r.chunks_mut(CHUNK).zip(g.chunks_mut(CHUNK)).zip(b.chunks_mut(CHUNK).zip((0..).step_by(CHUNK)))
        {
            let part = |slice: &'_ [f32]| -> std::ops::Range<usize> { start..slice.len().min(start + CHUNK) };
            let (l, v) = (l.map(|s| &s[part(s)]), v.map(|s| &s[part(s)]));
            let one = &ones[..r.len()];
            self.shade(level, precision, l, v, Rgb { r: one, g: one, b: one }, Rgb { r, g, b })?;
        }
        Ok(())
    }

    /// The lobe as a scalar of the precision [`Fast`], with the numbers that its constructor derived in `f32`.
    fn fast(&self) -> AnyBrdf<Approximate<f32, Fast>>;

    /// The lobe as a scalar of the precision [`Coarse`], with the numbers that its constructor derived in `f32`.
    fn coarse(&self) -> AnyBrdf<Approximate<f32, Coarse>>;

    /// The functions that [`shade`](Self::shade) runs, one for each lobe; what goes before and after their loops is not
    /// among them.
    fn functions(&self, precision: AnyPrecision) -> Vec<Function>;

    /// The functions that evaluate the lobe as a scalar of that precision, one for each lobe.
    fn scalar_functions(&self, precision: AnyPrecision) -> Vec<Function>;
}

/// That all slices are as long as the first.
fn same_length(slices: &[&[f32]]) -> Result<(), LengthError> {
    let expected = slices.first().map_or(0, |slice| slice.len());
    match slices.iter().enumerate().find(|(_, slice)| slice.len() != expected) {
        Some((index, slice)) => Err(LengthError { index, length: slice.len(), expected }),
        None => Ok(()),
    }
}

/// What goes into a kernel: `(v, (l, E))`.
#[cfg_attr(any(test, lobe_scalar), allow(dead_code, reason = "see `Compiled`"))]
type Inputs<'a> = (Vec3<&'a [f32]>, (Vec3<&'a [f32]>, Rgb<&'a [f32]>));

/// A lobe whose kernels are compiled: one for each level and precision.
#[cfg_attr(any(test, lobe_scalar), allow(dead_code, reason = "its constructor is not there"))]
pub(crate) struct Compiled<B>(B);

impl<B> BatchBrdf for Compiled<B>
where
    B: Copy + Carry,
    B::In<Approximate<f32, Fast>>: Brdf<Approximate<f32, Fast>> + Send + Sync + 'static,
    B::In<Approximate<f32, Coarse>>: Brdf<Approximate<f32, Coarse>> + Send + Sync + 'static,
    for<'b> Shade<B>: AtEveryLevel<Precise, Inputs<'b>, Rgb<&'b mut [f32]>>
        + AtEveryLevel<Fast, Inputs<'b>, Rgb<&'b mut [f32]>>
        + AtEveryLevel<Coarse, Inputs<'b>, Rgb<&'b mut [f32]>>,
{
    fn shade(
        &self,
        level: Level,
        precision: AnyPrecision,
        l: Vec3<&[f32]>,
        v: Vec3<&[f32]>,
        e: Rgb<&[f32]>,
        out: Rgb<&mut [f32]>,
    ) -> Result<(), LengthError> {
        same_length(&[l.x, l.y, l.z, v.x, v.y, v.z, e.r, e.g, e.b, &*out.r, &*out.g, &*out.b])?;
        let (batch, kernel) = (Batch::at(level), Shade(self.0));
        match precision {
            AnyPrecision::Precise => batch.accumulate(kernel, (v, (l, e)), out),
            AnyPrecision::Fast => batch.precision::<Fast>().accumulate(kernel, (v, (l, e)), out),
            AnyPrecision::Coarse => batch.precision::<Coarse>().accumulate(kernel, (v, (l, e)), out),
        }
    }

    fn fast(&self) -> AnyBrdf<Approximate<f32, Fast>> {
        Box::new(self.0.carry(&Approximate::new))
    }

    fn coarse(&self) -> AnyBrdf<Approximate<f32, Coarse>> {
        Box::new(self.0.carry(&Approximate::new))
    }

    fn functions(&self, precision: AnyPrecision) -> Vec<Function> {
        vec![match precision {
            AnyPrecision::Precise => Function::lanes::<Precise, Shade<B>>(),
            AnyPrecision::Fast => Function::lanes::<Fast, Shade<B>>(),
            AnyPrecision::Coarse => Function::lanes::<Coarse, Shade<B>>(),
        }]
    }

    fn scalar_functions(&self, precision: AnyPrecision) -> Vec<Function> {
        vec![match precision {
            AnyPrecision::Precise => Function::scalar::<B, f32>(),
            AnyPrecision::Fast => Function::scalar::<B::In<Approximate<f32, Fast>>, Approximate<f32, Fast>>(),
            AnyPrecision::Coarse => Function::scalar::<B::In<Approximate<f32, Coarse>>, Approximate<f32, Coarse>>(),
        }]
    }
}

// The tests inside this crate run no batch, and would have all kernels compiled once more. Nor do builds for a
// fuzzer, see `lobe::batch`.
#[cfg(any(test, lobe_scalar))]
pub(crate) use pointwise as batched;

/// What the constructor of a batch ends with.
#[cfg(not(any(test, lobe_scalar)))]
pub(crate) fn batched<B: Send + Sync + 'static>(lobe: B) -> AnyBatch
where
    Compiled<B>: BatchBrdf,
{
    Box::new(Compiled(lobe))
}

/// The same for a lobe whose lanes would be too much code: point by point, as the scalar `f32` in every precision.
///
/// Those are the lobes with a [`SmithTable`](lobe::distribution::SmithTable) or a [`GgxTable`](lobe_energy::GgxTable),
/// which lanes add up node by node: with the former the crate takes a compiler two minutes more.
pub(crate) fn pointwise(lobe: impl Brdf<f32> + Send + Sync + 'static) -> AnyBatch {
    pointwise_any(crate::number::boxed(lobe))
}

/// The same for one of which no more is known.
pub(crate) fn pointwise_any(lobe: Built<f32>) -> AnyBatch {
    Box::new(Pointwise { brdf: Arc::from(lobe.brdf), function: lobe.function })
}

#[derive(Clone)]
struct Pointwise {
    brdf: Arc<dyn Brdf<f32> + Send + Sync>,
    function: Function,
}

impl BatchBrdf for Pointwise {
    fn shade(
        &self,
        _level: Level,
        _precision: AnyPrecision,
        l: Vec3<&[f32]>,
        v: Vec3<&[f32]>,
        e: Rgb<&[f32]>,
        out: Rgb<&mut [f32]>,
    ) -> Result<(), LengthError> {
        same_length(&[l.x, l.y, l.z, v.x, v.y, v.z, e.r, e.g, e.b, &*out.r, &*out.g, &*out.b])?;
        for (i, ((r, g), b)) in out.r.iter_mut().zip(out.g).zip(out.b).enumerate() {
            let f = self.brdf.eval_cos(l.map(|s| s[i]), v.map(|s| s[i])) * e.map(|s| s[i]);
            (*r, *g, *b) = (*r + f.r, *g + f.g, *b + f.b);
        }
        Ok(())
    }

    fn fast(&self) -> AnyBrdf<Approximate<f32, Fast>> {
        Box::new(self.clone())
    }

    fn coarse(&self) -> AnyBrdf<Approximate<f32, Coarse>> {
        Box::new(self.clone())
    }

    fn functions(&self, _precision: AnyPrecision) -> Vec<Function> {
        vec![self.function]
    }

    fn scalar_functions(&self, _precision: AnyPrecision) -> Vec<Function> {
        vec![self.function]
    }
}

impl<P> Brdf<Approximate<f32, P>> for Pointwise
where
    Approximate<f32, P>: lobe::Real,
{
    fn eval(&self, l: Vec3<Approximate<f32, P>>, v: Vec3<Approximate<f32, P>>) -> Rgb<Approximate<f32, P>> {
        self.brdf.eval(l.map(Approximate::value), v.map(Approximate::value)).map(Approximate::new)
    }
    fn eval_cos(&self, l: Vec3<Approximate<f32, P>>, v: Vec3<Approximate<f32, P>>) -> Rgb<Approximate<f32, P>> {
        self.brdf.eval_cos(l.map(Approximate::value), v.map(Approximate::value)).map(Approximate::new)
    }
}

/// The sum of lobes, each with its weight.
pub(crate) fn sum(lobes: Vec<(AnyBatch, [f32; 3])>) -> AnyBatch {
    Box::new(Sum(lobes))
}

struct Sum(Vec<(AnyBatch, [f32; 3])>);

impl Sum {
    fn scalar<R: Number>(&self, of: impl Fn(&AnyBatch) -> AnyBrdf<R>) -> AnyBrdf<R> {
        crate::material::sum(self.0.iter().map(|(lobe, weight)| {
            let [r, g, b] = weight.map(|w| R::from_f64(f64::from(w)));
            crate::catalogue::weighted(of(lobe), Rgb::new(r, g, b))
        }))
    }
}

impl BatchBrdf for Sum {
    fn shade(
        &self,
        level: Level,
        precision: AnyPrecision,
        l: Vec3<&[f32]>,
        v: Vec3<&[f32]>,
        e: Rgb<&[f32]>,
        out: Rgb<&mut [f32]>,
    ) -> Result<(), LengthError> {
        same_length(&[l.x, l.y, l.z, v.x, v.y, v.z, e.r, e.g, e.b, &*out.r, &*out.g, &*out.b])?;
        let Rgb { r, g, b } = out;
        const CHUNK: usize = 256;
        let mut buffers = [[0.0; CHUNK]; 3];
        for start in (0..r.len()).step_by(CHUNK) {
            let part = start..r.len().min(start + CHUNK);
            for (lobe, weight) in &self.0 {
                let out = Rgb { r: &mut r[part.clone()], g: &mut g[part.clone()], b: &mut b[part.clone()] };
                let (l, v) = (l.map(|s| &s[part.clone()]), v.map(|s| &s[part.clone()]));
                let e = e.map(|s| &s[part.clone()]);
                if *weight == [1.0; 3] {
                    lobe.shade(level, precision, l, v, e, out)?;
                    continue;
                }
                for ((buffer, e), weight) in buffers.iter_mut().zip([e.r, e.g, e.b]).zip(weight) {
                    buffer.iter_mut().zip(e).for_each(|(to, e)| *to = weight * e);
                }
                let [r, g, b] = buffers.each_ref().map(|buffer| &buffer[..part.len()]);
                lobe.shade(level, precision, l, v, Rgb { r, g, b }, out)?;
            }
        }
        // Nothing is 0 and not −0, which `eval_cos` starts from; but NaN of NaN.
        if self.0.is_empty() {
            let black = batched(lobe::Black);
            return black.shade(level, precision, l, v, e, Rgb { r, g, b });
        }
        Ok(())
    }

    fn fast(&self) -> AnyBrdf<Approximate<f32, Fast>> {
        self.scalar(|lobe| lobe.fast())
    }

    fn coarse(&self) -> AnyBrdf<Approximate<f32, Coarse>> {
        self.scalar(|lobe| lobe.coarse())
    }

    fn functions(&self, precision: AnyPrecision) -> Vec<Function> {
        self.0.iter().flat_map(|(lobe, _)| lobe.functions(precision)).collect()
    }

    fn scalar_functions(&self, precision: AnyPrecision) -> Vec<Function> {
        self.0.iter().flat_map(|(lobe, _)| lobe.scalar_functions(precision)).collect()
    }
}

macro_rules! number {
    ($($precision:ident $scalar:ident)+) => {$(
        /// The numbers that a constructor derives from the parameters are those of `f32`.
        impl Number for Approximate<f32, $precision> {
            fn from_f64(value: f64) -> Self {
                Self::new(value as f32)
            }
            fn construct(model: &Model, reader: &Reader<'_, Self>) -> AnyBrdf<Self> {
                (model.build.batch)(&reader.of()).$scalar()
            }
            fn functions(model: &Model, reader: &Reader<'_, Self>) -> Vec<Function> {
                (model.build.batch)(&reader.of()).scalar_functions(AnyPrecision::$precision)
            }
        }
    )+};
}
number!(Fast fast Coarse coarse);
