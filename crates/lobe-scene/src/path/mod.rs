//! Path tracing: a picture with all the light that comes by way of other surfaces.
//!
//! A path starts at the camera and goes on from surface to surface, each time in a direction that is drawn from the lobes of the
//! material there ([`lobe_sampling::Sample`]). At each of its points lights are looked for, too. Both ways to find a
//! light are weighed by the power heuristic of multiple importance sampling ([`lobe_sampling::mis::power`]; Veach and Guibas
//! 1995), so that neither a small light nor a sharp lobe makes noise.
//!
//! ```
//! use lobe_scene::{LoadOptions, default_scene, path};
//!
//! let scene = default_scene(&LoadOptions::default())?;
//! let options = path::Options { width: 32, height: 18, samples: 4, ..path::Options::default() };
//! let rendered = path::render(&scene, &scene.views[0], &options, None)?;
//! assert_eq!((rendered.image.width(), rendered.nan_samples), (32, 0));
//! # Ok::<(), lobe_scene::Error>(())
//! ```
//!
//! # What shines
//!
//! * The [`Environment`]: the background of the view, or another one, or a picture of the whole sphere. Sampled by its luminance.
//! * Triangles that emit: of MTL (`Ke`, and `Kd` with `illum 0`) to both sides; of glTF to both sides if the material
//!   has two, else to the front; an unlit one sends out its base colour. A triangle is picked by its power, a point of it evenly
//!   over its area.
//! * Lamps without a size: points, spots and directional lights. At each point of a path one is picked: of up to 16 by what
//!   arrives of each if nothing is between, of more by their power. A point light with a radius is a ball of points, as it is for [`Renderer`].
//!
//! The *ambient* light of a view is left out: it stands for the light between surfaces, which is computed here. So are the occlusion
//! maps of glTF.
//!
//! # What is exact, and what is not
//!
//! Each sample is an estimate whose mean is the radiance, but for paths longer than [`Options::max_depth`], which are cut off.
//! Nothing is clamped. **Russian roulette**: from the bounce [`Options::roulette_from`] on, a path whose largest channel
//! of its weight is `q < 1` goes on with the probability `q`, and then with its weight divided by `q`.
//!
//! **Normals.** Lobes live in the frame of the shading normal; rays start on the curved surface that the normals of the corners mean,
//! on the viewer's side, and meet whatever is there. So light does not get through a closed surface, whatever its normals.
//! Both ways to find a light use one start and one rule. [`Renderer`] says what happens at the edges.
//!
//! **Opacity.** A surface of the opacity `d` is there for a path with the probability `d`. The back of a one-sided surface is invisible
//! for the camera, also in mirrors; for light on other ways it is there, as it is for shadows.
//!
//! **Textures** are filtered to the size of a pixel where the camera sees them, by mirrors also; after a lobe they
//! are as sharp as they are.
//!
//! # Random numbers
//!
//! Owen-scrambled Sobol' sequences in pairs of dimensions, by a hash of seed, pixel, sample and dimension. So a picture is the
//! same for a seed, whatever the number of threads, and more samples can be added at any time: see [`PathTracer`].

mod alias;
mod environment;
mod lights;
mod lobes;
mod random;
mod scatter;
mod trace;

#[cfg(test)]
mod tests;

pub use environment::{Environment, EnvironmentMap};

use crate::camera::Rays;
use crate::render::Lights;
use crate::{Error, Image, Progress, Renderer, Scene, View};
use lights::Sources;
use lobe::Rgb;
use random::{Numbers, Purpose};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};
use trace::Tracer;

/// How lights that have a size are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Strategy {
    /// In both ways, weighed by the power heuristic.
    #[default]
    Both,
    /// By directions of the lobes alone: without noise for mirrors, hopeless for small lights.
    Lobes,
    /// By points of the lights alone: the other way round. Lights in mirrors are seen all the same.
    Lights,
}

/// Size and quality of a picture.
#[derive(Debug, Clone)]
pub struct Options {
    /// Pixels in a row, 1 … [`MAX_SIDE`](crate::image::MAX_SIDE).
    pub width: u32,
    /// Rows, 1 … [`MAX_SIDE`](crate::image::MAX_SIDE).
    pub height: u32,
    /// Paths for each pixel, 1 … [`MAX_SAMPLES`]. Powers of two are spread best.
    pub samples: u32,
    /// The picture of a seed is always the same.
    pub seed: u64,
    /// How many surfaces may turn a path, 0 … [`MAX_DEPTH`]. With 0 there is only what shines by itself, with 1 light straight
    /// from the lights.
    pub max_depth: u32,
    /// From which bounce on paths are ended by chance, see [the module](self); `u32::MAX` for never.
    pub roulette_from: u32,
    /// The light from outside the scene; `None` for the background of the view.
    pub environment: Option<Environment>,
    /// How lights that have a size are found.
    pub strategy: Strategy,
}

/// The most samples of a pixel.
pub const MAX_SAMPLES: u32 = 1 << 20;
/// The longest path.
pub const MAX_DEPTH: u32 = 1 << 10;

impl Default for Options {
    fn default() -> Self {
        Self {
            width: 1280,
            height: 720,
            samples: 64,
            seed: 0,
            max_depth: 16,
            roulette_from: 4,
            environment: None,
            strategy: Strategy::Both,
        }
    }
}

/// A finished picture.
#[derive(Debug, Clone)]
pub struct Rendered {
    /// Linear radiance, without exposure. All of it is finite, and nothing negative.
    pub image: Image,
    /// How many samples were NaN, infinite or negative. They are left out of the mean of their pixel, which is 0 without any others.
    pub nan_samples: u64,
    /// Samples of each pixel.
    pub samples: u32,
}

/// Takes a picture. It uses the threads of the current `rayon` pool and is the same for any number of them.
///
/// The progress counts rows of passes, of which there are several: [`rows`] in all.
///
/// # Errors
/// [`Error::Setting`] for options, a scene, a camera, lights or an environment outside their domain.
pub fn render(
    scene: &Scene,
    view: &View,
    options: &Options,
    progress: Option<Progress<'_>>,
) -> Result<Rendered, Error> {
    render_with(&Renderer::new(scene)?, view, options, progress)
}

/// The same with a renderer that is there already.
///
/// # Errors
/// As [`render`].
pub fn render_with(
    renderer: &Renderer<'_>,
    view: &View,
    options: &Options,
    progress: Option<Progress<'_>>,
) -> Result<Rendered, Error> {
    let mut tracer = PathTracer::new(renderer, view, options)?;
    let mut before = 0;
    while tracer.samples() < options.samples {
        let count = PASS.min(options.samples - tracer.samples());
        let report = |done: u64, _: u64| {
            if let Some(progress) = progress {
                progress(before + done, rows(options));
            }
        };
        tracer.advance(count, Some(&report));
        before += u64::from(options.height);
    }
    tracer.rendered()
}

/// How many rows of passes a picture of these options is: the end of the progress of [`render`].
#[must_use]
pub fn rows(options: &Options) -> u64 {
    u64::from(options.height) * u64::from(options.samples.div_ceil(PASS))
}

/// Samples of each pixel in a pass of [`render`].
const PASS: u32 = 8;

/// A picture that gets better: each pass adds samples to every pixel, and it can be looked at in between.
///
/// The picture depends on the number of samples alone, not on how they came in passes.
pub struct PathTracer<'a> {
    tracer: Tracer<'a>,
    rays: Rays,
    width_at_start: f32,
    pixels: Vec<Pixel>,
    samples: u32,
}

/// A pixel on its way.
#[derive(Debug, Clone, Copy, Default)]
struct Pixel {
    /// In `f64`: the millionth sample still counts.
    sum: [f64; 3],
    /// Samples that are no radiance.
    wrong: u32,
}

impl std::fmt::Debug for PathTracer<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PathTracer").field("samples", &self.samples).finish_non_exhaustive()
    }
}

impl<'a> PathTracer<'a> {
    /// A picture without samples. [`Options::samples`] is how many it is expected to get, which the filter of textures is made for.
    ///
    /// # Errors
    /// As [`render`].
    pub fn new(renderer: &'a Renderer<'a>, view: &View, options: &Options) -> Result<Self, Error> {
        if !(1..=MAX_SAMPLES).contains(&options.samples) {
            let expected = format!("a pixel has 1 to {MAX_SAMPLES} of them");
            return Err(Error::setting("samples", options.samples, expected));
        }
        if options.max_depth > MAX_DEPTH {
            return Err(Error::setting("max_depth", options.max_depth, format!("it is at most {MAX_DEPTH}")));
        }
        let Options { width, height, .. } = *options;
        let pixels = Image::new(width, height)?.pixels().len();
        let (low, high) = renderer.bounds;
        let camera = view.camera_for(low, high, width as f32 / height as f32);
        let rays = camera.rays(width, height)?;
        let environment = options.environment.clone().unwrap_or_else(|| view.background.into());
        environment.check()?;
        let lights = Lights::new(&view.lights_for(&camera))?;
        let materials = view.materials_of(&renderer.scene.materials);
        let sources = Sources::new(renderer, &materials, lights, environment);
        let (width_at_start, spread) = rays.pixel();
        // A pixel of many samples is seen as sharp as its samples are dense.
        let spread = spread / (options.samples as f32).sqrt();
        let tracer = Tracer { renderer, materials, sources, spread, options: options.clone() };
        Ok(Self { tracer, rays, width_at_start, pixels: vec![Pixel::default(); pixels], samples: 0 })
    }

    /// How many samples each pixel has.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Adds as many samples to each pixel, as far as [`MAX_SAMPLES`]; the progress counts rows.
    pub fn advance(&mut self, samples: u32, progress: Option<Progress<'_>>) {
        let first = self.samples;
        let next = first.saturating_add(samples).min(MAX_SAMPLES);
        let Options { width, height, seed, .. } = self.tracer.options;
        let done = AtomicU64::new(0);
        let (tracer, rays, width_at_start) = (&self.tracer, &self.rays, self.width_at_start);
        self.pixels.par_chunks_exact_mut(width as usize).zip(0..height).for_each(|(row, y)| {
            for (pixel, x) in row.iter_mut().zip(0..width) {
                for index in first..next {
                    let numbers = Numbers::new(seed, x, y, index);
                    let [dx, dy] = numbers.pair(0, Purpose::Pixel);
                    let (px, py) = (x as f32 + dx, y as f32 + dy);
                    pixel.add(tracer.radiance(rays.origin(px, py), rays.direction(px, py), width_at_start, &numbers));
                }
            }
            if let Some(progress) = progress {
                progress(done.fetch_add(1, Ordering::Relaxed) + 1, u64::from(height));
            }
        });
        self.samples = next;
    }

    /// The picture as it is now; black without samples.
    ///
    /// # Errors
    /// None: the size was checked.
    pub fn rendered(&self) -> Result<Rendered, Error> {
        let mut image = Image::new(self.tracer.options.width, self.tracer.options.height)?;
        for (out, pixel) in image.pixels_mut().iter_mut().zip(&self.pixels) {
            let count = f64::from((self.samples - pixel.wrong).max(1));
            *out = pixel.sum.map(|channel| (channel / count) as f32);
        }
        let nan_samples = self.pixels.iter().map(|pixel| u64::from(pixel.wrong)).sum();
        Ok(Rendered { image, nan_samples, samples: self.samples })
    }
}

impl Pixel {
    fn add(&mut self, sample: Rgb) {
        let sample = <[f32; 3]>::from(sample);
        if sample.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
            for (sum, channel) in self.sum.iter_mut().zip(sample) {
                *sum += f64::from(channel);
            }
        } else {
            self.wrong += 1;
        }
    }
}
