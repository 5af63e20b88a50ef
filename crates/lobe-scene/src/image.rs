//! Pictures, and the files that hold them.
//!
//! | ending | content |
//! |---|---|
//! | `.png` | 8 or 16 bits a channel: exposure, a [`Tone`] if asked for, then the curve of sRGB, then rounding. Values outside 0 … 1 are clipped. |
//! | `.exr` | OpenEXR, 32-bit float, linear: the radiance itself, without exposure |
//! | `.pfm` | Portable float map, the same numbers |
//!
//! A file is written in one step, see [`write_atomically`](crate::write_atomically).

use crate::Error;
use glam::Vec3;
use std::io;
use std::path::{Path, PathBuf};

/// A picture of linear radiance, row by row from the upper left.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

/// Bits a channel in a PNG file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Depth {
    /// 8 bits.
    #[default]
    Eight,
    /// 16 bits.
    Sixteen,
}

/// How linear radiance becomes the numbers of a PNG file.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Display {
    /// In stops: the radiance is multiplied by `2^exposure` first. 0 by default.
    pub exposure: f32,
    /// Bits a channel.
    pub depth: Depth,
    /// How what is brighter than white is brought into the range. Not at all by default.
    pub tone: Tone,
}

/// How a linear colour is brought into 0 … 1, after the exposure and before the curve of sRGB.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tone {
    /// It is clipped.
    #[default]
    None,
    /// `x/(1 + x)` of each channel (Reinhard, Stark, Shirley and Ferwerda, *Photographic tone reproduction for digital
    /// images*, 2002, equation 3, there of the luminance).
    Reinhard,
    /// `x (2.51 x + 0.03)/(x (2.43 x + 0.59) + 0.14)` of each channel: Narkowicz's fit to the curve of ACES (*ACES filmic
    /// tone mapping curve*, 2016). It is a curve alone, without the colour spaces of ACES.
    Aces,
    /// Khronos' PBR Neutral (*PBR neutral tone mapper specification*, 2024): colours below 0.8 as they are but for the 4 %
    /// that a dielectric reflects, brighter ones compressed and made paler.
    PbrNeutral,
}

impl Tone {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::None, Self::Reinhard, Self::Aces, Self::PbrNeutral];

    /// Its name: `none`, `reinhard`, `aces-fit` or `pbr-neutral`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Reinhard => "reinhard",
            Self::Aces => "aces-fit",
            Self::PbrNeutral => "pbr-neutral",
        }
    }

    /// The colour on a screen, still linear; for colours that are not negative.
    #[must_use]
    pub fn apply(self, colour: [f32; 3]) -> [f32; 3] {
        match self {
            Self::None => colour,
            // Through the reciprocal, so that an infinite radiance is white and not NaN.
            Self::Reinhard => colour.map(|x| 1.0 / (1.0 + 1.0 / x.max(0.0))),
            Self::Aces => colour.map(|x| {
                // Beyond, the quotient is 2.51/2.43, which is clipped; and squares would overflow.
                let x = x.min(1e6);
                (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)
            }),
            Self::PbrNeutral => pbr_neutral(colour),
        }
    }
}

impl std::fmt::Display for Tone {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// The specification's equations, with its names.
fn pbr_neutral(colour: [f32; 3]) -> [f32; 3] {
    const F90: f32 = 0.04;
    const START: f32 = 0.8 - F90;
    const DESATURATION: f32 = 0.15;
    let colour = colour.map(|x| x.min(1e30));
    let [r, g, b] = colour;
    let x = r.min(g).min(b);
    let offset = if x <= 2.0 * F90 { x - x * x / (4.0 * F90) } else { F90 };
    let colour = colour.map(|c| c - offset);
    let peak = colour[0].max(colour[1]).max(colour[2]);
    if peak <= START {
        return colour;
    }
    let room = 1.0 - START;
    let compressed = 1.0 - room * room / (peak + room - START);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    colour.map(|c| c * (compressed / peak) * (1.0 - white) + compressed * white)
}

/// The kind of a file, by its ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
    Pfm,
}

/// The longest side of a picture in pixels.
pub const MAX_SIDE: u32 = 32_768;
/// The most pixels of a picture.
pub const MAX_PIXELS: u64 = 1 << 28;

impl Image {
    /// A black picture.
    ///
    /// # Errors
    /// [`Error::Setting`] when a side is 0 or above [`MAX_SIDE`], or there are more than [`MAX_PIXELS`].
    pub fn new(width: u32, height: u32) -> Result<Self, Error> {
        let pixels = u64::from(width) * u64::from(height);
        if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) || pixels > MAX_PIXELS {
            return Err(Error::setting(
                "the size of the picture",
                format!("{width}x{height}"),
                format!("each side has 1 to {MAX_SIDE} pixels, and there are at most {MAX_PIXELS} in all"),
            ));
        }
        Ok(Self { width, height, pixels: vec![[0.0; 3]; pixels as usize] })
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row from the upper left.
    #[must_use]
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// All pixels, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.pixels
    }

    /// One pixel, counted from the upper left; `None` outside the picture.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[f32; 3]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        self.pixels.get(y as usize * self.width as usize + x as usize).copied()
    }

    /// Writes the picture in the format that the ending of the file says.
    ///
    /// # Errors
    /// [`Error::UnknownFormat`] for an ending other than `.png`, `.exr` and `.pfm`, [`Error::Write`] when the system
    /// refuses. An existing file then is as it was.
    pub fn save(&self, path: &Path, display: &Display) -> Result<(), Error> {
        let bytes = match format_of(path)? {
            Format::Png => self.png(display).map_err(|error| error.to_string()),
            Format::Exr => self.exr().map_err(|error| error.to_string()),
            Format::Pfm => Ok(self.pfm()),
        };
        let bytes = bytes.map_err(|problem| Error::Encode { path: path.to_owned(), problem })?;
        crate::write_atomically(path, &bytes)
    }

    /// Reads a picture: `.png` by the curve of sRGB, and without its opacity, `.exr` and `.pfm` as they stand.
    ///
    /// # Errors
    /// [`Error::UnknownFormat`] for another ending, [`Error::Read`] when the file cannot be read, [`Error::Content`] when it
    /// is not what its ending says, or larger than [`MAX_PIXELS`].
    pub fn load(path: &Path) -> Result<Self, Error> {
        let format = format_of(path)?;
        let bytes = crate::files::read(path, 1 << 32).map_err(|source| Error::read(path, source))?;
        let read = match format {
            Format::Png => from_png(&bytes),
            Format::Exr => from_exr(&bytes),
            Format::Pfm => from_pfm(&bytes),
        };
        read.map_err(|problem| Error::Content { file: path.display().to_string(), problem })
    }

    /// The picture as the bytes of a PNG file with 8 bits a channel: what a web page would show.
    ///
    /// # Errors
    /// [`Error::Encode`] when the encoder refuses.
    pub fn to_png(&self, display: &Display) -> Result<Vec<u8>, Error> {
        self.png(display).map_err(|error| Error::Encode { path: PathBuf::from("png"), problem: error.to_string() })
    }

    fn png(&self, display: &Display) -> Result<Vec<u8>, png::EncodingError> {
        let gain = display.exposure.exp2();
        let channels = self.pixels.iter().flat_map(|&pixel| display_colour(pixel, gain, display.tone));
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        let data: Vec<u8> = match display.depth {
            Depth::Eight => {
                encoder.set_depth(png::BitDepth::Eight);
                channels.map(|value| (value * 255.0 + 0.5) as u8).collect()
            }
            Depth::Sixteen => {
                encoder.set_depth(png::BitDepth::Sixteen);
                channels.flat_map(|value| ((value * 65535.0 + 0.5) as u16).to_be_bytes()).collect()
            }
        };
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&data)?;
        writer.finish()?;
        Ok(bytes)
    }

    fn exr(&self) -> Result<Vec<u8>, exr::error::Error> {
        use exr::prelude::{
            Encoding, Image as Exr, ImageAttributes, Layer, LayerAttributes, SpecificChannels, WritableImage as _,
        };
        let size = (self.width as usize, self.height as usize);
        let colour = |at: exr::prelude::Vec2<usize>| {
            let [r, g, b] = self.pixels[at.y() * size.0 + at.x()];
            (r, g, b)
        };
        let layer =
            Layer::new(size, LayerAttributes::default(), Encoding::FAST_LOSSLESS, SpecificChannels::rgb(colour));
        let image = Exr::new(ImageAttributes::new(layer.absolute_bounds()), layer);
        let mut bytes = io::Cursor::new(Vec::new());
        image.write().non_parallel().to_buffered(&mut bytes)?;
        Ok(bytes.into_inner())
    }

    fn pfm(&self) -> Vec<u8> {
        // A negative scale means little-endian; rows go from the bottom to the top.
        let mut bytes = format!("PF\n{} {}\n-1.0\n", self.width, self.height).into_bytes();
        for row in self.pixels.chunks_exact(self.width as usize).rev() {
            bytes.extend(row.iter().flatten().flat_map(|channel| channel.to_le_bytes()));
        }
        bytes
    }
}

fn sized(width: usize, height: usize) -> Result<Image, String> {
    let side = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
    Image::new(side(width), side(height)).map_err(|error| error.to_string())
}

fn from_png(bytes: &[u8]) -> Result<Image, String> {
    let wrong = |error: png::DecodingError| format!("this is not a whole PNG picture: {error}");
    let mut decoder = png::Decoder::new_with_limits(io::Cursor::new(bytes), png::Limits { bytes: 1 << 32 });
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(wrong)?;
    let mut image = sized(reader.info().width as usize, reader.info().height as usize)?;
    let size = reader.output_buffer_size().ok_or("this picture is larger than the machine's memory")?;
    let mut data = vec![0; size];
    let frame = reader.next_frame(&mut data).map_err(wrong)?;
    let wide = frame.bit_depth == png::BitDepth::Sixteen;
    let channels = frame.color_type.samples();
    let step = channels * if wide { 2 } else { 1 };
    for (pixel, texel) in image.pixels.iter_mut().zip(data.chunks_exact(step)) {
        let channel = |i: usize| match texel.get(2 * i..2 * i + 2) {
            Some(&[high, low]) if wide => f32::from(u16::from_be_bytes([high, low])) / 65535.0,
            _ => texel.get(i).map_or(0.0, |code| f32::from(*code) / 255.0),
        };
        *pixel = if channels < 3 { [channel(0); 3] } else { [channel(0), channel(1), channel(2)] }.map(linear);
    }
    Ok(image)
}

fn from_exr(bytes: &[u8]) -> Result<Image, String> {
    use exr::prelude::{ReadChannels as _, ReadLayers as _, read};
    let reader = read().no_deep_data().largest_resolution_level().rgb_channels(
        |size: exr::prelude::Vec2<usize>, _| sized(size.width(), size.height()),
        |image: &mut Result<Image, String>, at: exr::prelude::Vec2<usize>, (r, g, b): (f32, f32, f32)| {
            if let Ok(image) = image {
                let index = at.y() * image.width as usize + at.x();
                if let Some(pixel) = image.pixels.get_mut(index) {
                    *pixel = [r, g, b];
                }
            }
        },
    );
    let read = reader.first_valid_layer().all_attributes().non_parallel().from_buffered(io::Cursor::new(bytes));
    read.map_err(|error| format!("this is not a whole OpenEXR picture: {error}"))?.layer_data.channel_data.pixels
}

fn from_pfm(bytes: &[u8]) -> Result<Image, String> {
    let wrong = || "this is not a whole PFM picture of three channels".to_owned();
    let mut rest = bytes;
    let mut words = Vec::new();
    while words.len() < 4 {
        let end = rest.iter().position(u8::is_ascii_whitespace).ok_or_else(wrong)?;
        let (word, after) = rest.split_at(end);
        words.push(std::str::from_utf8(word).map_err(|_| wrong())?);
        rest = after.get(1..).unwrap_or(&[]);
    }
    let (&["PF", width, height, scale], false) = (words.as_slice(), words.iter().any(|word| word.is_empty())) else {
        return Err(wrong());
    };
    let (width, height) = (width.parse().map_err(|_| wrong())?, height.parse().map_err(|_| wrong())?);
    let little = scale.parse::<f32>().map_err(|_| wrong())? < 0.0;
    let mut image = sized(width, height)?;
    if rest.len() < image.pixels.len() * 12 {
        return Err(wrong());
    }
    // From the bottom to the top.
    for (row, data) in image.pixels.chunks_exact_mut(width).rev().zip(rest.chunks_exact(12 * width)) {
        for (channel, bytes) in row.as_flattened_mut().iter_mut().zip(data.chunks_exact(4)) {
            let bytes = bytes.try_into().unwrap_or([0; 4]);
            *channel = if little { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) };
        }
    }
    Ok(image)
}

/// The inverse of [`srgb`]: what a screen sends out for `code`, from 0 to 1.
#[must_use]
pub fn linear(code: f32) -> f32 {
    if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}

/// Exposure and the sRGB curve, clipped to 0 … 1. A pixel that is not a number becomes magenta, so that nobody
/// takes it for a colour of the scene.
fn display_colour(pixel: [f32; 3], gain: f32, tone: Tone) -> [f32; 3] {
    let colour = Vec3::from_array(pixel) * gain;
    if colour.is_nan() {
        return [1.0, 0.0, 1.0];
    }
    tone.apply(colour.to_array()).map(srgb)
}

/// The curve of IEC 61966-2-1: what a screen is given so that it sends out `linear`. Clipped to 0 … 1.
#[must_use]
pub fn srgb(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Whether [`Image::save`] knows the ending of this file; to be asked before a long computation.
///
/// # Errors
/// [`Error::UnknownFormat`] when it does not.
pub fn check_ending(path: &Path) -> Result<(), Error> {
    format_of(path).map(|_| ())
}

fn format_of(path: &Path) -> Result<Format, Error> {
    let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("png") => Ok(Format::Png),
        Some("exr") => Ok(Format::Exr),
        Some("pfm") => Ok(Format::Pfm),
        _ => Err(Error::UnknownFormat { path: path.to_owned(), expected: "pictures end in .png, .exr or .pfm" }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() -> Result<(), Error> {
        let folder = tempfile::tempdir().expect("a folder");
        let mut image = Image::new(7, 5)?;
        for (at, pixel) in image.pixels_mut().iter_mut().enumerate() {
            *pixel = [at as f32 / 40.0, 0.5, 1.0 - at as f32 / 40.0];
        }
        for (name, depth, tolerance) in [
            ("a.exr", Depth::Eight, 0.0),
            ("a.pfm", Depth::Eight, 0.0),
            ("a.png", Depth::Eight, 5e-3),
            ("b.png", Depth::Sixteen, 2e-5),
        ] {
            let path = folder.path().join(name);
            image.save(&path, &Display { depth, ..Display::default() })?;
            let read = Image::load(&path)?;
            assert_eq!((read.width(), read.height()), (7, 5));
            for (a, b) in image.pixels().iter().flatten().zip(read.pixels().iter().flatten()) {
                assert!((a - b).abs() <= tolerance, "{name}: {a} {b}");
            }
            let bytes = std::fs::read(&path).expect("a file");
            std::fs::write(&path, &bytes[..bytes.len() / 2]).expect("a file");
            let error = Image::load(&path).expect_err("it is cut off").to_string();
            assert!(error.contains(name), "{error}");
        }
        Ok(())
    }

    /// Black stays black, nothing becomes negative or NaN, and more light is not less.
    #[test]
    fn tones_keep_order_and_range() {
        for tone in Tone::ALL {
            let mut last = 0.0;
            for step in 0..400 {
                let x = if step == 0 { 0.0 } else { 1e-6 * 1.1_f32.powi(step) };
                let [r, g, b] = tone.apply([x; 3]);
                assert!(r == g && g == b && r >= last && r.is_finite(), "{tone} {x}: {r}");
                assert!(tone == Tone::None || r <= 1.034, "{tone} {x}: {r}");
                last = r;
            }
            assert_eq!(tone.apply([0.0; 3]), [0.0; 3]);
            assert!(tone.apply([f32::INFINITY; 3]).iter().all(|x| *x >= 1.0), "{tone}");
        }
        // The points of the specification's curve: grey loses 0.04, and 0.8 is where compression begins.
        let [r, ..] = Tone::PbrNeutral.apply([0.5; 3]);
        assert!((r - 0.46).abs() < 1e-6);
        let [r, ..] = Tone::PbrNeutral.apply([0.8; 3]);
        assert!((r - 0.76).abs() < 1e-6);
    }

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    fn test_image() -> Result<Image, Error> {
        let mut image = Image::new(3, 2)?;
        image.pixels_mut().copy_from_slice(&[
            [0.0, 0.5, 1.0],
            [2.0, -1.0, 0.001],
            [f32::NAN, 0.2, 0.2],
            [0.25, 0.25, 0.25],
            [f32::INFINITY, 0.0, 0.0],
            [1e-9, 1e9, 0.1],
        ]);
        Ok(image)
    }

    #[test]
    fn png_holds_srgb() -> Outcome {
        let image = test_image()?;
        for (depth, exposure) in [(Depth::Eight, 0.0), (Depth::Sixteen, 0.0), (Depth::Eight, 1.0)] {
            let bytes = image.to_png(&Display { exposure, depth, tone: Tone::None })?;
            let mut reader = png::Decoder::new(io::Cursor::new(bytes)).read_info()?;
            let mut data = vec![0; reader.output_buffer_size().ok_or("size")?];
            reader.next_frame(&mut data)?;
            let top = if depth == Depth::Eight { 255.0 } else { 65535.0 };
            let channel = |at: usize| match depth {
                Depth::Eight => f64::from(data[at]) / top,
                Depth::Sixteen => f64::from(u16::from_be_bytes([data[2 * at], data[2 * at + 1]])) / top,
            };
            // 0.5 in linear light is 0.7354 on the curve, 0.25 is 0.5371; one stop makes the one the other.
            let expected = if exposure == 0.0 { [0.0, 0.735_357, 1.0, 0.537_099] } else { [0.0, 1.0, 1.0, 0.735_357] };
            for (at, expected) in [0, 1, 2, 9].into_iter().zip(expected) {
                assert!((channel(at) - expected).abs() <= 0.5 / f64::from(top as f32) + 1e-6, "{depth:?} {at}");
            }
            assert_eq!([3, 4].map(channel), [1.0, 0.0]);
            assert_eq!([6, 7, 8].map(channel), [1.0, 0.0, 1.0], "not a number is magenta");
            assert_eq!([12, 13, 14].map(channel), [1.0, 0.0, 0.0]);
        }
        Ok(())
    }

    #[test]
    fn float_formats_hold_the_same_bits() -> Outcome {
        let folder = tempfile::tempdir()?;
        let image = test_image()?;
        let bits = |pixels: &[[f32; 3]]| pixels.iter().flatten().map(|channel| channel.to_bits()).collect::<Vec<_>>();

        let exr = folder.path().join("a.EXR");
        image.save(&exr, &Display { exposure: 3.0, ..Display::default() })?;
        let read = exr::prelude::read_first_rgba_layer_from_file(
            &exr,
            |size, _| vec![[0.0_f32; 3]; size.area()],
            |pixels, at, (r, g, b, _): (f32, f32, f32, f32)| pixels[at.y() * 3 + at.x()] = [r, g, b],
        )?;
        assert_eq!(bits(&read.layer_data.channel_data.pixels), bits(image.pixels()));

        let pfm = folder.path().join("a.pfm");
        image.save(&pfm, &Display::default())?;
        let bytes = std::fs::read(&pfm)?;
        let data = bytes.strip_prefix(b"PF\n3 2\n-1.0\n").ok_or("header")?;
        assert_eq!(data[..4], 0.25_f32.to_le_bytes(), "the first row is the lowest");
        assert_eq!(data.len(), 3 * 2 * 3 * 4);
        Ok(())
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() -> Outcome {
        let folder = tempfile::tempdir()?;
        let image = test_image()?;
        // A folder stands where the file should go.
        let path = folder.path().join("a.png");
        std::fs::create_dir(&path)?;
        std::fs::write(path.join("inside"), "kept")?;
        assert!(matches!(image.save(&path, &Display::default()), Err(Error::Write { .. })));
        assert_eq!(std::fs::read_to_string(path.join("inside"))?, "kept");
        assert_eq!(std::fs::read_dir(folder.path())?.count(), 1, "no temporary file is left");

        // An existing file is replaced in one step: whoever has it open still reads the old one, whole.
        let path = folder.path().join("b.pfm");
        std::fs::write(&path, "old")?;
        let mut old = std::fs::File::open(&path)?;
        image.save(&path, &Display::default())?;
        let mut text = String::new();
        io::Read::read_to_string(&mut old, &mut text)?;
        if cfg!(unix) {
            assert_eq!(text, "old");
        }
        assert!(std::fs::read(&path)?.starts_with(b"PF"));
        assert_eq!(std::fs::read_dir(folder.path())?.count(), 2);
        Ok(())
    }

    #[test]
    fn sizes_and_endings_are_checked() {
        for (width, height) in [(0, 1), (1, 0), (MAX_SIDE + 1, 1), (MAX_SIDE, MAX_SIDE), (u32::MAX, u32::MAX)] {
            assert!(Image::new(width, height).is_err());
        }
        for name in ["a", "a.jpg", ".png", "png"] {
            assert!(check_ending(Path::new(name)).is_err(), "{name}");
        }
        assert!(check_ending(Path::new("x/a.PNG")).is_ok());
    }
}
