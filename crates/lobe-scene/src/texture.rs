//! Pictures on surfaces, filtered to the size that a pixel sees.

use crate::Error;
use glam::{Mat2, Vec2, Vec3};
use std::fmt;
use std::sync::Arc;

/// The longest side of a texture.
pub const MAX_TEXTURE_SIDE: u32 = 16_384;

/// What the numbers of a texture mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// Colours, by the curve of sRGB; alpha is linear.
    Srgb,
    /// Numbers as they stand.
    Linear,
}

/// What is seen beyond the edge of a texture, along one of its sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Wrap {
    /// It begins again.
    #[default]
    Repeat,
    /// Every second copy is mirrored.
    Mirror,
    /// The last texel.
    Clamp,
}

/// How a texture is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Sampler {
    /// Along `u` and `v`.
    pub wrap: [Wrap; 2],
    /// Magnified, every texel is a sharp square. Made smaller, all textures are filtered, whatever their file says.
    pub nearest: bool,
}

/// A picture of four channels of 8 bits, with itself at a half, a quarter … of the size.
///
/// The smaller ones are means over light, not over codes: sRGB is decoded, averaged and encoded again.
#[derive(Clone, PartialEq)]
pub struct Texture {
    levels: Vec<Level>,
    encoding: Encoding,
    sampler: Sampler,
}

#[derive(Clone, PartialEq)]
struct Level {
    width: u32,
    height: u32,
    texels: Arc<[[u8; 4]]>,
}

impl fmt::Debug for Texture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.size();
        f.debug_struct("Texture")
            .field("width", &width)
            .field("height", &height)
            .field("encoding", &self.encoding)
            .finish_non_exhaustive()
    }
}

impl Texture {
    /// A texture of `width × height` texels, row by row from the upper left.
    ///
    /// # Errors
    /// [`Error::Setting`] when a side is 0 or above [`MAX_TEXTURE_SIDE`], or the number of texels is another.
    pub fn new(
        width: u32,
        height: u32,
        texels: Vec<[u8; 4]>,
        encoding: Encoding,
        sampler: Sampler,
    ) -> Result<Self, Error> {
        let sides = 1..=MAX_TEXTURE_SIDE;
        if !sides.contains(&width) || !sides.contains(&height) {
            let expected = format!("each side has 1 to {MAX_TEXTURE_SIDE} texels");
            return Err(Error::setting("the size of a texture", format!("{width}x{height}"), expected));
        }
        if texels.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(Error::setting("the number of texels", texels.len(), format!("{width}x{height} of them")));
        }
        let mut levels = vec![Level { width, height, texels: texels.into() }];
        while let Some(last) = levels.last().filter(|last| last.width > 1 || last.height > 1) {
            levels.push(last.half(encoding));
        }
        Ok(Self { levels, encoding, sampler })
    }

    /// Width and height in texels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.levels.first().map_or([0; 2], |level| [level.width, level.height])
    }

    /// The four channels at `(u, v)`, from the upper left corner, as means over a square whose side is `footprint` texels of
    /// the full size: between two levels, and in each between four texels.
    #[must_use]
    pub fn sample(&self, uv: Vec2, footprint: f32) -> [f32; 4] {
        let level = footprint.max(1.0).log2().min((self.levels.len() - 1) as f32);
        let (whole, part) = (level as usize, level.fract());
        let near = self.level(whole, uv, footprint <= 1.0);
        if part == 0.0 {
            return near;
        }
        let far = self.level(whole + 1, uv, false);
        std::array::from_fn(|i| near[i] + (far[i] - near[i]) * part)
    }

    fn level(&self, index: usize, uv: Vec2, magnified: bool) -> [f32; 4] {
        let Some(level) = self.levels.get(index.min(self.levels.len() - 1)) else { return [1.0; 4] };
        let size = Vec2::new(level.width as f32, level.height as f32);
        // Where wrapping begins anew, before digits are lost to the size.
        let at = Vec2::new(fold(uv.x, self.sampler.wrap[0]), fold(uv.y, self.sampler.wrap[1])) * size;
        if magnified && self.sampler.nearest {
            let [x, y] = [at.x.floor() as i64, at.y.floor() as i64];
            return self.texel(level, x, y);
        }
        let at = at - 0.5;
        let base = at.floor();
        let Vec2 { x: fx, y: fy } = at - base;
        let [x, y] = [base.x as i64, base.y as i64];
        let corners = [
            (self.texel(level, x, y), (1.0 - fx) * (1.0 - fy)),
            (self.texel(level, x + 1, y), fx * (1.0 - fy)),
            (self.texel(level, x, y + 1), (1.0 - fx) * fy),
            (self.texel(level, x + 1, y + 1), fx * fy),
        ];
        std::array::from_fn(|i| corners.iter().map(|(texel, weight)| texel[i] * weight).sum())
    }

    fn texel(&self, level: &Level, x: i64, y: i64) -> [f32; 4] {
        let x = wrap(x, level.width, self.sampler.wrap[0]);
        let y = wrap(y, level.height, self.sampler.wrap[1]);
        let index = y as usize * level.width as usize + x as usize;
        level.texels.get(index).map_or([1.0; 4], |texel| decode(*texel, self.encoding))
    }
}

impl Level {
    /// The picture at half the size, an odd side rounded down: each texel is the mean over what it covers.
    fn half(&self, encoding: Encoding) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let (columns, rows) = (covered(self.width, width), covered(self.height, height));
        let mut texels = Vec::with_capacity(width as usize * height as usize);
        for (y, weights_y) in &rows {
            for (x, weights_x) in &columns {
                let mut sum = [0.0_f32; 4];
                for (j, wy) in weights_y.iter().enumerate().filter(|(_, w)| **w > 0.0) {
                    for (i, wx) in weights_x.iter().enumerate().filter(|(_, w)| **w > 0.0) {
                        let index = (*y as usize + j) * self.width as usize + *x as usize + i;
                        let texel = self.texels.get(index).map_or([0.0; 4], |texel| decode(*texel, encoding));
                        for (sum, channel) in sum.iter_mut().zip(texel) {
                            *sum += channel * wx * wy;
                        }
                    }
                }
                texels.push(encode(sum, encoding));
            }
        }
        Self { width, height, texels: texels.into() }
    }
}

/// For each of `to` texels the first of `from` that it covers, and how much of it and the two after it, the sum being 1.
fn covered(from: u32, to: u32) -> Vec<(u32, [f32; 3])> {
    let ratio = f64::from(from) / f64::from(to);
    (0..to)
        .map(|at| {
            let (start, end) = (f64::from(at) * ratio, f64::from(at + 1) * ratio);
            let first = start.floor();
            let weight = |i: usize| {
                let low = (first + i as f64).max(start);
                let high = (first + i as f64 + 1.0).min(end);
                ((high - low).max(0.0) / ratio) as f32
            };
            (first as u32, [weight(0), weight(1), weight(2)])
        })
        .collect()
}

/// A coordinate brought near 0 … 1 without a change of what is seen there. What is not finite is 0.
fn fold(x: f32, wrap: Wrap) -> f32 {
    let folded = match wrap {
        Wrap::Repeat => x - x.floor(),
        Wrap::Mirror => x - 2.0 * (0.5 * x).floor(),
        Wrap::Clamp => x.clamp(-1.0, 2.0),
    };
    if folded.is_finite() { folded } else { 0.0 }
}

fn wrap(x: i64, side: u32, wrap: Wrap) -> u32 {
    let side = i64::from(side);
    let x = match wrap {
        Wrap::Repeat => x.rem_euclid(side),
        Wrap::Mirror => {
            let x = x.rem_euclid(2 * side);
            x.min(2 * side - 1 - x)
        }
        Wrap::Clamp => x.clamp(0, side - 1),
    };
    x as u32
}

fn decode(texel: [u8; 4], encoding: Encoding) -> [f32; 4] {
    let [r, g, b, a] = texel;
    let linear = |code: u8| f32::from(code) / 255.0;
    match encoding {
        Encoding::Linear => [linear(r), linear(g), linear(b), linear(a)],
        Encoding::Srgb => {
            let table = srgb_table();
            [table[usize::from(r)], table[usize::from(g)], table[usize::from(b)], linear(a)]
        }
    }
}

fn encode(colour: [f32; 4], encoding: Encoding) -> [u8; 4] {
    let [r, g, b, a] = colour;
    let code = |x: f32| (x * 255.0 + 0.5) as u8;
    let channel = |x: f32| match encoding {
        Encoding::Linear => code(x),
        Encoding::Srgb => code(crate::image::srgb(x)),
    };
    [channel(r), channel(g), channel(b), code(a)]
}

/// [`linear`](crate::image::linear) for each code of 8 bits.
fn srgb_table() -> &'static [f32; 256] {
    static TABLE: std::sync::OnceLock<[f32; 256]> = std::sync::OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(|code| crate::image::linear(code as f32 / 255.0)))
}

/// A texture as a material uses it.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The texture.
    pub texture: Arc<Texture>,
    /// Which of the two sets of texture coordinates, 0 or 1.
    pub set: usize,
    /// What the coordinates are multiplied with, and what is then added: `KHR_texture_transform`.
    pub transform: (Mat2, Vec2),
}

impl Map {
    /// The channels at a point: `footprint` is the side of the pixel in texture coordinates, both sets.
    #[must_use]
    pub fn at(&self, uv: [Vec2; 2], footprint: [f32; 2]) -> [f32; 4] {
        let (matrix, offset) = self.transform;
        let [width, height] = self.texture.size();
        let scale = (matrix.determinant().abs() * width as f32 * height as f32).sqrt();
        let set = self.set.min(1);
        self.texture.sample(matrix * uv[set] + offset, footprint[set] * scale)
    }

    /// The unit normal of a normal map in the tangent frame, its x and y times `scale`; +z for a texel of no direction.
    #[must_use]
    pub fn normal(&self, scale: f32, uv: [Vec2; 2], footprint: [f32; 2]) -> Vec3 {
        let [x, y, z, _] = self.at(uv, footprint).map(|x| 2.0 * x - 1.0);
        Vec3::new(x * scale, y * scale, z).try_normalize().unwrap_or(Vec3::Z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checker(size: u32, encoding: Encoding, sampler: Sampler) -> Texture {
        let texel = |at: u32| if (at % size + at / size).is_multiple_of(2) { [255; 4] } else { [0, 0, 0, 255] };
        Texture::new(size, size, (0..size * size).map(texel).collect(), encoding, sampler).expect("a texture")
    }

    #[test]
    fn far_away_a_checkerboard_is_half_of_the_light() {
        for (size, encoding) in [(8, Encoding::Srgb), (8, Encoding::Linear), (7, Encoding::Linear)] {
            let texture = checker(size, encoding, Sampler::default());
            let [r, _, _, a] = texture.sample(Vec2::new(0.3, 0.7), 1e6);
            // An odd board has one white field more, and codes round.
            assert!((r - 0.5).abs() < 0.02 && (a - 1.0).abs() < 1e-6, "{size} {encoding:?}: {r}");
        }
    }

    #[test]
    fn each_texel_is_met_in_its_middle_and_wrapping_goes_on() {
        let texels: Vec<[u8; 4]> = (0..6_u8).map(|at| [at * 51; 4]).collect();
        for (wrap, outside) in [(Wrap::Repeat, [5, 0]), (Wrap::Mirror, [3, 2]), (Wrap::Clamp, [3, 2])] {
            let sampler = Sampler { wrap: [wrap; 2], nearest: false };
            let texture = Texture::new(3, 2, texels.clone(), Encoding::Linear, sampler).expect("a texture");
            for (at, texel) in texels.iter().enumerate() {
                let uv = Vec2::new((at % 3) as f32 + 0.5, (at / 3) as f32 + 0.5) / Vec2::new(3.0, 2.0);
                let found = texture.sample(uv, 0.0)[0];
                assert!((found - f32::from(texel[0]) / 255.0).abs() < 1e-6);
            }
            let left = texture.sample(Vec2::new(-1.0 / 6.0, 0.75), 0.0)[0];
            let right = texture.sample(Vec2::new(7.0 / 6.0, 0.25), 0.0)[0];
            assert!((left - f32::from(outside[0] as u8) * 0.2).abs() < 1e-5, "{wrap:?} {left}");
            assert!((right - f32::from(outside[1] as u8) * 0.2).abs() < 1e-5, "{wrap:?} {right}");
        }
    }

    #[test]
    fn nothing_outside_is_read_for_any_coordinate() {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for nearest in [false, true] {
                let texture = checker(4, Encoding::Srgb, Sampler { wrap: [wrap; 2], nearest });
                for x in [f32::NAN, f32::INFINITY, -f32::INFINITY, f32::MAX, -1e-30, 1e9, 16_777_217.0] {
                    for footprint in [0.0, 3.7, f32::INFINITY, f32::NAN] {
                        let found = texture.sample(Vec2::new(x, 0.4), footprint);
                        assert!(found.iter().all(|channel| (0.0..=1.0).contains(channel)), "{x} {footprint} {found:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn sizes_that_are_none_are_errors() {
        for (width, height, count) in [(0, 1, 0), (1, 0, 0), (2, 2, 3), (MAX_TEXTURE_SIDE + 1, 1, 0)] {
            let texels = vec![[0; 4]; count];
            assert!(Texture::new(width, height, texels, Encoding::Linear, Sampler::default()).is_err());
        }
    }
}
