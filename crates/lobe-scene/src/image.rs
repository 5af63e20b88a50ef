//! Pictures, and the files that hold them.
//!
//! | ending | content |
//! |---|---|
//! | `.png` | 8 or 16 bits a channel: exposure, then the curve of sRGB, then rounding. Values outside 0 … 1 are clipped. |
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

    /// The picture as the bytes of a PNG file with 8 bits a channel: what a web page would show.
    ///
    /// # Errors
    /// [`Error::Encode`] when the encoder refuses.
    pub fn to_png(&self, display: &Display) -> Result<Vec<u8>, Error> {
        self.png(display).map_err(|error| Error::Encode { path: PathBuf::from("png"), problem: error.to_string() })
    }

    fn png(&self, display: &Display) -> Result<Vec<u8>, png::EncodingError> {
        let gain = display.exposure.exp2();
        let channels = self.pixels.iter().flat_map(|&pixel| display_colour(pixel, gain));
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

/// Exposure and the sRGB curve, clipped to 0 … 1. A pixel that is not a number becomes magenta, so that nobody
/// takes it for a colour of the scene.
fn display_colour(pixel: [f32; 3], gain: f32) -> [f32; 3] {
    let colour = Vec3::from_array(pixel) * gain;
    if colour.is_nan() {
        return [1.0, 0.0, 1.0];
    }
    colour.to_array().map(srgb)
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
            let bytes = image.to_png(&Display { exposure, depth })?;
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
