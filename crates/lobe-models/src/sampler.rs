//! A sampler of which only the values are known at run time.

use crate::catalogue::{Lobe, Model};
use crate::material::Material;
use crate::number::Number;
use crate::reader::Reader;
use lobe::{Black, Rgb, Sum, Vec3};
use lobe_sampling::{Sample, Sampled};

/// A sampler of which only the number type is known.
pub type AnySampler<R> = Box<dyn Sample<R> + Send + Sync>;

/// A number type that the catalogue makes samplers in: `f32` and `f64`.
pub trait SampleNumber: Number {
    /// The sampler of the model in this type, with the parameters of the reader.
    fn sampler(model: &Model, reader: &Reader<'_, Self>) -> AnySampler<Self>;
}

impl SampleNumber for f32 {
    fn sampler(model: &Model, reader: &Reader<'_, Self>) -> AnySampler<Self> {
        (model.build.sampler_f32)(reader)
    }
}

impl SampleNumber for f64 {
    fn sampler(model: &Model, reader: &Reader<'_, Self>) -> AnySampler<Self> {
        (model.build.sampler_f64)(reader)
    }
}

/// What a constructor ends with.
pub(crate) fn boxed<R: Number, B: Sample<R> + Send + Sync + 'static>(lobe: B) -> AnySampler<R> {
    Box::new(lobe)
}

impl Lobe {
    /// The sampler of the lobe in a number type, with its weight.
    ///
    /// ```
    /// use lobe::Vec3;
    ///
    /// let phong = lobe_models::model("phong").expect("there is one").typical();
    /// let (sampler, brdf) = (phong.sampler::<f64>(), phong.build::<f64>());
    /// let v = Vec3::new(0.6, 0.0, 0.8);
    /// let sampled = sampler.sample(v, [0.5, 0.2, 0.7]);
    /// let expected = brdf.eval_cos(sampled.l, v).g / sampled.pdf;
    /// assert!((sampled.weight.g / expected - 1.0).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn sampler<R: SampleNumber>(&self) -> AnySampler<R> {
        let sampler = self.with_reader(R::sampler);
        if self.weight() == [1.0; 3] {
            return sampler;
        }
        let [r, g, b] = self.weight().map(R::from_f64);
        Box::new(Weighted { sampler, weight: Rgb::new(r, g, b) })
    }
}

impl Material {
    /// The sampler in a number type: of each sample one lobe draws the direction, and all of them count.
    #[must_use]
    pub fn sampler<R: SampleNumber>(&self) -> AnySampler<R> {
        let mut lobes = self.lobes.iter().map(Lobe::sampler::<R>);
        let first = lobes.next().unwrap_or_else(|| Box::new(Black));
        lobes.fold(first, |a, b| Box::new(Sum { a: Held(a), b: Held(b) }))
    }
}

/// A sampler behind its pointer.
struct Held<R>(AnySampler<R>);

impl<R: Number> Sample<R> for Held<R> {
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        self.0.sample(v, u)
    }
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        self.0.pdf(l, v)
    }
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        self.0.eval_cos_pdf(l, v)
    }
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        self.0.albedo_guess(v)
    }
}

/// A sampler of a lobe times a colour.
struct Weighted<R> {
    sampler: AnySampler<R>,
    weight: Rgb<R>,
}

impl<R: Number> Sample<R> for Weighted<R> {
    fn sample(&self, v: Vec3<R>, u: [R; 3]) -> Sampled<R> {
        let sampled = self.sampler.sample(v, u);
        Sampled { weight: sampled.weight * self.weight, ..sampled }
    }
    fn pdf(&self, l: Vec3<R>, v: Vec3<R>) -> R {
        self.sampler.pdf(l, v)
    }
    fn eval_cos_pdf(&self, l: Vec3<R>, v: Vec3<R>) -> (Rgb<R>, R) {
        let (value, pdf) = self.sampler.eval_cos_pdf(l, v);
        (value * self.weight, pdf)
    }
    /// A guess is of the luminance alone, so that of the weight scales it.
    fn albedo_guess(&self, v: Vec3<R>) -> R {
        self.sampler.albedo_guess(v) * self.weight.luminance()
    }
}
