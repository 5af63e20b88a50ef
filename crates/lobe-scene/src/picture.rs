//! Pictures in files, for textures: PNG, JPEG and WebP.

use std::io::{BufReader, Cursor};

/// The most texels of a picture: what a file merely states is not believed beyond it.
const MAX_TEXELS: u64 = 1 << 26;

/// How many texels the pictures of one scene may still have. A small file may hold many large ones.
pub(crate) struct Budget(u64);

impl Default for Budget {
    /// 2²⁸: 1 GiB.
    fn default() -> Self {
        Self(1 << 28)
    }
}

impl Budget {
    fn take(&mut self, width: u32, height: u32) -> Result<(), String> {
        let texels = u64::from(width) * u64::from(height);
        self.0 =
            self.0.checked_sub(texels).ok_or("is one too many: the pictures of a scene have at most 2^28 texels")?;
        Ok(())
    }
}

/// A picture of four channels, row by row from the upper left.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picture {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) texels: Vec<[u8; 4]>,
}

/// Reads a picture; its first bytes say of which kind it is. Sixteen bits become eight.
///
/// # Errors
/// What is wrong, in words.
pub(crate) fn read(bytes: &[u8], budget: &mut Budget) -> Result<Picture, String> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => png(bytes, budget),
        [0xff, 0xd8, 0xff, ..] => jpeg(bytes, budget),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => webp(bytes, budget),
        [0xab, b'K', b'T', b'X', ..] => {
            Err("is a KTX picture, which is not supported; PNG, JPEG and WebP are".to_owned())
        }
        _ => Err("is neither PNG nor JPEG nor WebP".to_owned()),
    }
}

fn check_size(width: u32, height: u32, budget: &mut Budget) -> Result<(), String> {
    let largest = crate::texture::MAX_TEXTURE_SIDE;
    let texels = u64::from(width) * u64::from(height);
    if width == 0 || height == 0 || width > largest || height > largest || texels > MAX_TEXELS {
        return Err(format!(
            "says that it has {width}x{height} texels; each side has 1 to {largest}, and there are at most {MAX_TEXELS}"
        ));
    }
    budget.take(width, height)
}

fn png(bytes: &[u8], budget: &mut Budget) -> Result<Picture, String> {
    let wrong = |error: png::DecodingError| format!("is not a whole PNG picture: {error}");
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: 1 << 30 });
    decoder.set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(wrong)?;
    let (width, height) = (reader.info().width, reader.info().height);
    check_size(width, height, budget)?;
    let size = reader.output_buffer_size().ok_or("is larger than this machine's memory")?;
    let mut data = vec![0; size];
    let frame = reader.next_frame(&mut data).map_err(wrong)?;
    data.truncate(frame.buffer_size());
    texels(width, height, &data, frame.color_type.samples())
}

fn jpeg(bytes: &[u8], budget: &mut Budget) -> Result<Picture, String> {
    use zune_jpeg::zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions};
    let wrong = |error: zune_jpeg::errors::DecodeErrors| format!("is not a whole JPEG picture: {error}");
    let side = crate::texture::MAX_TEXTURE_SIDE as usize;
    let options =
        DecoderOptions::default().set_max_width(side).set_max_height(side).jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(wrong)?;
    let (width, height) = decoder.dimensions().ok_or("is a JPEG picture without a size")?;
    let (width, height) = (u32::try_from(width).unwrap_or(0), u32::try_from(height).unwrap_or(0));
    check_size(width, height, budget)?;
    let data = decoder.decode().map_err(wrong)?;
    texels(width, height, &data, 3)
}

fn webp(bytes: &[u8], budget: &mut Budget) -> Result<Picture, String> {
    let wrong = |error: image_webp::DecodingError| format!("is not a whole WebP picture: {error}");
    let mut decoder = image_webp::WebPDecoder::new(BufReader::new(Cursor::new(bytes))).map_err(wrong)?;
    let (width, height) = decoder.dimensions();
    check_size(width, height, budget)?;
    decoder.set_memory_limit(1 << 30);
    let size = decoder.output_buffer_size().ok_or("is larger than this machine's memory")?;
    let mut data = vec![0; size];
    decoder.read_image(&mut data).map_err(wrong)?;
    texels(width, height, &data, if decoder.has_alpha() { 4 } else { 3 })
}

/// Texels of one to four channels: grey, grey and alpha, colour, colour and alpha.
fn texels(width: u32, height: u32, data: &[u8], channels: usize) -> Result<Picture, String> {
    let texels: Vec<[u8; 4]> = data
        .chunks_exact(channels.max(1))
        .map(|texel| match *texel {
            [y] => [y, y, y, 255],
            [y, a] => [y, y, y, a],
            [r, g, b] => [r, g, b, 255],
            [r, g, b, a, ..] => [r, g, b, a],
            [] => [0; 4],
        })
        .collect();
    let expected = u64::from(width) * u64::from(height);
    match texels.len() as u64 {
        found if found == expected => Ok(Picture { width, height, texels }),
        found => Err(format!("has {found} texels where its size says {expected}")),
    }
}
