//! The pictures of the report: every view, small enough together for one page.

use crate::error::Failure;
use crate::render;
use lobe_scene::image::Display;
use lobe_scene::{Image, Renderer, Scene, Settings, View, path};
use serde::Serialize;
use std::time::Instant;

/// A view that was rendered.
#[derive(Debug, Serialize)]
pub(crate) struct Picture {
    pub(crate) name: String,
    pub(crate) caption: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) samples: u32,
    pub(crate) seconds: f64,
    /// The PNG file.
    #[serde(skip)]
    pub(crate) png: Vec<u8>,
}

/// All pictures together, as PNG. In the page they are a third larger, by its base64; with all else that is in it, it stays at about 5 MB.
const MOST_BYTES: usize = 2_400_000;
/// A page of a hundred views is no page.
const MOST_VIEWS: usize = 16;

/// Surfaces that a path may meet.
const DEPTH: u32 = 16;
/// Paths for each pixel, for each ray that the ray caster takes there.
const PATHS: u32 = 16;

/// The first view, with and without the light between surfaces.
#[derive(Debug, Serialize)]
pub(crate) struct Between {
    /// By the ray caster.
    pub(crate) cast: Picture,
    /// By paths.
    pub(crate) traced: Picture,
    /// Samples of paths that were no radiance.
    pub(crate) nan_samples: u64,
}

/// A picture that can still be made smaller.
struct Taken {
    picture: Picture,
    image: Image,
    display: Display,
}

impl Taken {
    fn new(view: &View, caption: String, image: Image, samples: u32, seconds: f64) -> Result<Self, Failure> {
        let display = Display { exposure: view.exposure, ..Display::default() };
        let (width, height, png) = (image.width(), image.height(), image.to_png(&display)?);
        let picture = Picture { name: view.name.clone(), caption, width, height, samples, seconds, png };
        Ok(Self { picture, image, display })
    }
}

/// Renders the views of a scene, the first of them by paths too; a warning for what is left out.
pub(crate) fn take(
    scene: &Scene,
    renderer: &Renderer<'_>,
    (width, samples): (u32, u32),
    built_in: bool,
    quiet: bool,
) -> Result<(Vec<Picture>, Between, Vec<String>), Failure> {
    let default = View::default();
    let views = if scene.views.is_empty() { std::slice::from_ref(&default) } else { &scene.views[..] };
    let size = |width: u32| (width, (width * 9).div_ceil(16));
    let cast = |view: &View, width: u32, caption: String| -> Result<Taken, Failure> {
        let (width, height) = size(width);
        let settings = Settings { width, height, samples, ..Settings::default() };
        let start = Instant::now();
        let image = render::take(renderer, view, &settings, &view.name, quiet)?;
        Taken::new(view, caption, image, samples, start.elapsed().as_secs_f64())
    };
    let mut taken = Vec::new();
    for (index, view) in views.iter().take(MOST_VIEWS).enumerate() {
        let width = if index == 0 { width } else { width * 2 / 3 };
        taken.push(cast(view, width, caption(view, built_in))?);
    }
    let first = views.first().unwrap_or(&default);
    // Half of the width: of more paths nobody would wait for the end.
    let mut beside = cast(first, width / 2, String::new())?;
    beside.picture.caption =
        "What comes straight from the lights or by mirrors. An ambient term stands for all other light.".to_owned();
    let (mut traced, nan_samples) = traced(renderer, first, size(width / 2), PATHS * samples, quiet)?;

    let mut warnings = Vec::new();
    if views.len() > MOST_VIEWS {
        warnings
            .push(format!("the report shows {MOST_VIEWS} of {} views; `lobe render --view` draws any", views.len()));
    }
    if nan_samples > 0 {
        warnings.push(format!("{nan_samples} samples of paths were no radiance, and are left out"));
    }
    fit(&mut taken.iter_mut().chain([&mut beside, &mut traced]).collect::<Vec<_>>())?;
    let between = Between { cast: beside.picture, traced: traced.picture, nan_samples };
    Ok((taken.into_iter().map(|taken| taken.picture).collect(), between, warnings))
}

/// The view by paths, and how many samples were no radiance.
fn traced(
    renderer: &Renderer<'_>,
    view: &View,
    (width, height): (u32, u32),
    samples: u32,
    quiet: bool,
) -> Result<(Taken, u64), Failure> {
    let options = path::Options { width, height, samples, max_depth: DEPTH, ..path::Options::default() };
    let start = Instant::now();
    let rendered = render::take_by_paths(renderer, view, &options, "paths", quiet)?;
    let seconds = start.elapsed().as_secs_f64();
    let caption = format!(
        "What comes by way of other surfaces too, over up to {DEPTH} of them, and no ambient term. Shadows are lit by what stands \
         around, and colours pass from one surface to the next. What is left of grain is chance: half of it with four times the paths."
    );
    Ok((Taken::new(view, caption, rendered.image, samples, seconds)?, rendered.nan_samples))
}

/// Halves the largest picture until all have room.
fn fit(taken: &mut [&mut Taken]) -> Result<(), Failure> {
    while taken.iter().map(|taken| taken.picture.png.len()).sum::<usize>() > MOST_BYTES {
        let Some(Taken { picture, image, display }) = taken.iter_mut().max_by_key(|taken| taken.picture.png.len())
        else {
            break;
        };
        if image.width() < 64 || image.height() < 64 {
            break;
        }
        *image = halved(image)?;
        picture.png = image.to_png(display)?;
        (picture.width, picture.height) = (image.width(), image.height());
    }
    Ok(())
}

/// The picture at half of the size: each pixel the mean of four.
fn halved(image: &Image) -> Result<Image, Failure> {
    let (width, height) = (image.width() / 2, image.height() / 2);
    let mut half = Image::new(width.max(1), height.max(1))?;
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (2 * x, 2 * y)));
    for (pixel, (x, y)) in half.pixels_mut().iter_mut().zip(places) {
        let four = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)].map(|(x, y)| image.pixel(x, y).unwrap_or_default());
        for (channel, out) in pixel.iter_mut().enumerate() {
            *out = four.iter().map(|p| p[channel]).sum::<f32>() / 4.0;
        }
    }
    Ok(half)
}

/// What is to be seen.
fn caption(view: &View, built_in: bool) -> String {
    let known = match view.name.as_str() {
        "overview" => {
            "All of the built-in scene: materials at the back, the row of exponents and the row of lights in front."
        }
        "exponent" => {
            "The same sphere with exponents q = 1, 4, 16, 64, 256 and 1024, from left to right. The highlight shrinks; its \
             coefficient, and so its brightness in the middle, stays: the lecture's highlight is not normalised."
        }
        "light" => {
            "The same sphere lit from five directions. The highlight moves towards the light, halfway to the viewer; \
             what is turned away has only the ambient term."
        }
        "materials" => {
            "Diffuse, glossy and mirror-like materials side by side. Only the mirror needs rays that go on; all else is \
             local: the light, the viewer and the normal."
        }
        "smooth-flat" => {
            "One mesh, twice. Flat shading takes the normal of the triangle, smooth shading the normals of the corners, \
             interpolated: the same triangles, until one looks at the outline."
        }
        "models" => {
            "Microfacet and measured materials. In the row gold, a GGX with the Fresnel term of the metal, with the \
             widths α = 0.6, 0.4, 0.25, 0.15, 0.08 and 0.04. Behind it, as fits to measurements: dark red paint, nickel \
             and, on the knots, blue metallic paint; in the middle the plastic of glTF."
        }
        _ => "",
    };
    if built_in && !known.is_empty() {
        return known.to_owned();
    }
    let lights = match view.lights.as_ref().map(Vec::len) {
        None => "the default light".to_owned(),
        Some(1) => "1 light".to_owned(),
        Some(count) => format!("{count} lights"),
    };
    let camera = if view.camera.is_some() { "its own camera" } else { "a camera that sees everything" };
    format!("View `{}`: {lights}, {camera}.", view.name)
}
