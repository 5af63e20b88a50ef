//! What shines where there is nothing: a background, or a picture all around.

use crate::{Background, Error, Image};
use glam::{DVec3, Vec3};
use lobe::Rgb;
use std::f64::consts::{PI, TAU};
use std::path::Path;
use std::sync::Arc;

/// The light from outside the scene. It is seen, too.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Environment {
    /// A colour, or a blend from below to above.
    Background(Background),
    /// A picture.
    Map(Arc<EnvironmentMap>),
}

impl From<Background> for Environment {
    fn from(background: Background) -> Self {
        Self::Background(background)
    }
}

impl Environment {
    /// A picture of the whole sphere as [`EnvironmentMap`] has it, from a file: `.exr`, `.pfm` or `.png`.
    ///
    /// # Errors
    /// Those of [`Image::load`] and of [`EnvironmentMap::new`].
    pub fn load(path: &Path) -> Result<Self, Error> {
        Ok(Self::Map(Arc::new(EnvironmentMap::new(&Image::load(path)?)?)))
    }

    /// The radiance from the unit direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Rgb {
        match self {
            Self::Background(background) => background.radiance(towards),
            Self::Map(map) => map.radiance(towards),
        }
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        let colours = match self {
            Self::Background(Background::Solid(colour)) => [*colour; 2],
            Self::Background(Background::Gradient { bottom, top }) => [*bottom, *top],
            Self::Map(_) => return Ok(()),
        };
        for colour in colours {
            if !is_radiance(colour) {
                let expected = "it is finite and not negative";
                return Err(Error::setting("the colour of the background", format!("{colour:?}"), expected));
            }
        }
        Ok(())
    }

    /// Whether there is any light.
    pub(crate) fn shines(&self) -> bool {
        match self {
            Self::Background(background) => background.mean().luminance() > 0.0,
            Self::Map(map) => map.rows.sum > 0.0,
        }
    }

    /// A unit direction in proportion to the luminance, and its density in sr⁻¹.
    pub(crate) fn sample(&self, [u, w]: [f64; 2]) -> (Vec3, f32) {
        let direction = match self {
            Self::Background(background) => {
                let [below, above] = ends(background);
                // The height t of [0, 1] with the density 2 (b + (a − b) t)/(a + b): by inversion, in a form without a
                // difference of near numbers.
                let by = below + (below * below * (1.0 - u) + above * above * u).sqrt();
                // Straight down where it is black there and u is 0.
                let t = if by > 0.0 { u * (below + above) / by } else { 0.0 };
                let ring = (4.0 * t * (1.0 - t)).max(0.0).sqrt();
                let (sine, cosine) = (TAU * w).sin_cos();
                DVec3::new(ring * sine, 2.0 * t - 1.0, ring * cosine).as_vec3()
            }
            Self::Map(map) => map.sample([u, w]),
        };
        (direction, self.pdf(direction))
    }

    /// The density of [`sample`](Self::sample) in sr⁻¹.
    pub(crate) fn pdf(&self, direction: Vec3) -> f32 {
        match self {
            Self::Background(background) => {
                let [below, above] = ends(background);
                let t = f64::from(0.5 + 0.5 * direction.y).clamp(0.0, 1.0);
                ((below * (1.0 - t) + above * t) / ((below + above) * TAU)) as f32
            }
            Self::Map(map) => map.pdf(direction),
        }
    }
}

/// The luminance straight down and straight up.
fn ends(background: &Background) -> [f64; 2] {
    match background {
        Background::Solid(_) => [1.0; 2],
        Background::Gradient { bottom, top } => [*bottom, *top].map(|colour| f64::from(colour.luminance())),
    }
}

fn is_radiance(colour: Rgb) -> bool {
    <[f32; 3]>::from(colour).iter().all(|part| part.is_finite() && *part >= 0.0)
}

/// A picture of the whole sphere by longitude and latitude, `+y` at the upper edge.
///
/// The middle of the picture is seen in the direction `−z`, what is right of it in `+x`. Between texels the radiance is
/// interpolated linearly.
///
/// Sampled by rows, then by columns, from inverted sums. A texel has the integral of the interpolated luminance over it, times the
/// solid angle, and within it directions are even over the solid angle. So no density is divided by `sin θ`, which is 0 at the
/// poles.
#[derive(Clone)]
pub struct EnvironmentMap {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 3]>,
    rows: Sums,
    /// Of each row.
    columns: Vec<Sums>,
}

impl std::fmt::Debug for EnvironmentMap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("EnvironmentMap")
            .field("width", &self.width)
            .field("height", &self.height)
            .finish_non_exhaustive()
    }
}

impl EnvironmentMap {
    /// A picture of linear radiance.
    ///
    /// # Errors
    /// [`Error::Setting`] where a pixel is negative or not finite.
    pub fn new(image: &Image) -> Result<Self, Error> {
        let (width, height) = (image.width() as usize, image.height() as usize);
        for (at, pixel) in image.pixels().iter().enumerate() {
            if !is_radiance((*pixel).into()) {
                let what = format!("pixel {} of row {} of the environment's picture", at % width, at / width);
                return Err(Error::setting(what, format!("{pixel:?}"), "radiance is finite and not negative"));
            }
        }
        let mut map =
            Self { width, height, pixels: image.pixels().to_vec(), rows: Sums::default(), columns: Vec::new() };
        let luminance: Vec<f64> = map.pixels.iter().map(|pixel| f64::from(Rgb::from(*pixel).luminance())).collect();
        let at = |x: usize, y: usize| luminance[y * width + x];
        // The mean over the texel of what is interpolated: an eighth, three quarters, an eighth.
        let along =
            |x: usize, y: usize| 0.75 * at(x, y) + 0.125 * (at((x + width - 1) % width, y) + at((x + 1) % width, y));
        for y in 0..height {
            let (above, below) = (y.saturating_sub(1), (y + 1).min(height - 1));
            let means = (0..width).map(|x| 0.75 * along(x, y) + 0.125 * (along(x, above) + along(x, below)));
            map.columns.push(Sums::new(means));
        }
        map.rows = Sums::new((0..height).map(|y| map.columns[y].sum * map.solid_angle(y)));
        Ok(map)
    }

    /// Of a texel of the row.
    fn solid_angle(&self, row: usize) -> f64 {
        let angle = PI / self.height as f64;
        // cos θ₀ − cos θ₁, as a product.
        let height = 2.0 * ((row as f64 + 0.5) * angle).sin() * (0.5 * angle).sin();
        height * TAU / self.width as f64
    }

    /// Where a direction is in the picture, in texels.
    fn place(&self, direction: Vec3) -> [f64; 2] {
        let d = direction.as_dvec3();
        // Not by arc cosine, which has lost half of the digits at the poles.
        let theta = d.x.hypot(d.z).atan2(d.y);
        let phi = d.x.atan2(-d.z);
        [(phi / TAU + 0.5) * self.width as f64, theta / PI * self.height as f64]
    }

    fn texel(&self, direction: Vec3) -> [usize; 2] {
        let [x, y] = self.place(direction);
        [(x.max(0.0) as usize).min(self.width - 1), (y.max(0.0) as usize).min(self.height - 1)]
    }

    /// The radiance from the unit direction `towards`.
    #[must_use]
    pub fn radiance(&self, towards: Vec3) -> Rgb {
        let [x, y] = self.place(towards).map(|at| at - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (right, down) = ((x - column) as f32, (y - row) as f32);
        let (width, last) = (self.width as i64, self.height as i64 - 1);
        let at = |x: i64, y: i64| {
            let index = y.clamp(0, last) * width + x.rem_euclid(width);
            self.pixels.get(index as usize).map_or(Rgb::splat(f32::NAN), |pixel| Rgb::from(*pixel))
        };
        let (x, y) = (column as i64, row as i64);
        let blend = |y| at(x, y) * (1.0 - right) + at(x + 1, y) * right;
        blend(y) * (1.0 - down) + blend(y + 1) * down
    }

    fn sample(&self, [u, w]: [f64; 2]) -> Vec3 {
        let (row, down) = self.rows.pick(u);
        let Some(columns) = self.columns.get(row) else { return Vec3::Y };
        let (column, right) = columns.pick(w);
        let angle = PI / self.height as f64;
        // Even in the height: cos θ₀ − cos θ = 2 sin((θ₀ + θ)/2) sin((θ − θ₀)/2); near a pole by the half angle, whose
        // square is what is even there.
        let half = |at: f64| (0.5 * at * angle).sin().powi(2);
        let [from, to] = [half(row as f64), half(row as f64 + 1.0)];
        // sin²(θ/2) = (1 − cos θ)/2.
        let square = from + (to - from) * down;
        let (sine, cosine) = (2.0 * (square * (1.0 - square)).max(0.0).sqrt(), 1.0 - 2.0 * square);
        let phi = ((column as f64 + right) / self.width as f64 - 0.5) * TAU;
        DVec3::new(sine * phi.sin(), cosine, -sine * phi.cos()).as_vec3()
    }

    fn pdf(&self, direction: Vec3) -> f32 {
        let [x, y] = self.texel(direction);
        let column = self.columns.get(y).map_or(0.0, |columns| columns.probability(x));
        (self.rows.probability(y) * column / self.solid_angle(y)) as f32
    }
}

/// Weights and their running sums.
#[derive(Debug, Clone, Default)]
struct Sums {
    sum: f64,
    /// Up to the end of each entry, as a part of all.
    upto: Vec<f64>,
}

impl Sums {
    fn new(weights: impl Iterator<Item = f64>) -> Self {
        let mut sum = 0.0;
        let mut upto: Vec<f64> = weights
            .map(|weight| {
                sum += weight;
                sum
            })
            .collect();
        if sum > 0.0 {
            upto.iter_mut().for_each(|part| *part /= sum);
        }
        Self { sum, upto }
    }

    /// The entry for a number of `[0, 1)`, and how far into it the number is.
    fn pick(&self, u: f64) -> (usize, f64) {
        let at = self.upto.partition_point(|part| *part <= u).min(self.upto.len().saturating_sub(1));
        let [from, to] = self.around(at);
        let within = if to > from { (u - from) / (to - from) } else { 0.5 };
        (at, within.clamp(0.0, 1.0))
    }

    fn around(&self, at: usize) -> [f64; 2] {
        let get = |at: usize| self.upto.get(at).copied().unwrap_or(0.0);
        [at.checked_sub(1).map_or(0.0, get), get(at)]
    }

    fn probability(&self, at: usize) -> f64 {
        let [from, to] = self.around(at);
        to - from
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Black but for a sun, a few dim texels, and one at each pole.
    fn sunny() -> Environment {
        let (width, height) = (16, 8);
        let mut image = Image::new(width, height).expect("a size");
        let mut set = |x: u32, y: u32, to: [f32; 3]| image.pixels_mut()[(y * width + x) as usize] = to;
        set(5, 2, [1000.0, 900.0, 800.0]);
        set(12, 6, [0.1, 0.2, 0.3]);
        set(3, 0, [1.0; 3]);
        set(15, 7, [0.0, 0.0, 5.0]);
        Environment::Map(Arc::new(EnvironmentMap::new(&image).expect("radiance")))
    }

    fn all() -> [Environment; 4] {
        let gradient = |bottom: f32, top: f32| {
            Environment::from(Background::Gradient { bottom: Rgb::splat(bottom), top: Rgb::splat(top) })
        };
        [Background::Solid(Rgb::splat(0.3)).into(), gradient(0.0, 1.0), gradient(2.0, 1.9), sunny()]
    }

    /// The middles of `n` by `2n` cells of equal solid angle.
    fn sphere(n: usize) -> impl Iterator<Item = (Vec3, f64)> {
        let whole = 2.0 * TAU / (2 * n * n) as f64;
        (0..n).flat_map(move |i| {
            (0..2 * n).map(move |j| {
                let y = 1.0 - 2.0 * (i as f64 + 0.5) / n as f64;
                let (sine, cosine) = ((j as f64 + 0.5) * PI / n as f64).sin_cos();
                let ring = (1.0 - y * y).sqrt();
                (DVec3::new(ring * sine, y, ring * cosine).as_vec3(), whole)
            })
        })
    }

    #[test]
    fn the_density_integrates_to_one_and_is_that_of_the_samples() {
        for environment in all() {
            let whole: f64 = sphere(800).map(|(d, area)| f64::from(environment.pdf(d)) * area).sum();
            assert!((whole - 1.0).abs() < 2e-3, "{environment:?}: {whole}");
            // For any function g, the mean of g L/pdf over samples is the integral of g L.
            let g = |d: Vec3| f64::from(1.0 + d.x + 2.0 * d.y * d.y + d.x * d.z + (3.0 * d.y).sin());
            let lit = |d: Vec3| f64::from(environment.radiance(d).luminance());
            for only_light in [true, false] {
                let value = |d: Vec3| if only_light { lit(d) } else { lit(d) * g(d) };
                let integral: f64 = sphere(800).map(|(d, area)| value(d) * area).sum();
                let n = 300;
                let mut mean = 0.0;
                for i in 0..n {
                    for j in 0..n {
                        let u = [(f64::from(i) + 0.5) / f64::from(n), (f64::from(j) + 0.5) / f64::from(n)];
                        let (d, pdf) = environment.sample(u);
                        assert!((d.length() - 1.0).abs() < 1e-6 && pdf > 0.0, "{d} {pdf}");
                        mean += value(d) / f64::from(pdf) / f64::from(n * n);
                    }
                }
                // The grid does not meet the edges of texels.
                let tolerance = if matches!(environment, Environment::Map(_)) { 1e-2 } else { 1e-3 };
                assert!((mean / integral - 1.0).abs() < tolerance, "{environment:?}: {mean} {integral}");
            }
        }
    }

    #[test]
    fn the_poles_and_the_corners_of_the_square_are_finite() {
        let below_one = 1.0 - 0.5_f64.powi(32);
        for environment in all() {
            for u in [0.0, 0.5_f64.powi(32), 0.5, below_one] {
                for w in [0.0, 0.5, below_one] {
                    let (d, pdf) = environment.sample([u, w]);
                    assert!(d.is_finite() && (d.length() - 1.0).abs() < 1e-6 && pdf.is_finite(), "{u} {w} {d} {pdf}");
                }
            }
            for pole in [Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z] {
                assert!(environment.pdf(pole).is_finite() && environment.radiance(pole).r.is_finite());
            }
        }
    }

    #[test]
    fn a_picture_lies_as_it_is_said() {
        let mut image = Image::new(4, 3).expect("a size");
        // From left to right: +z on, −x … −z in the middle … +x.
        for (x, value) in [(0, 1.0), (1, 2.0), (2, 3.0), (3, 4.0)] {
            image.pixels_mut()[4 + x] = [value; 3];
        }
        image.pixels_mut()[..4].fill([9.0; 3]);
        let map = EnvironmentMap::new(&image).expect("radiance");
        let at = |d: Vec3| map.radiance(d.normalize()).r;
        assert!((at(Vec3::NEG_Z) - 2.5).abs() < 1e-6, "the middle");
        assert!((at(Vec3::X) - 3.5).abs() < 1e-6, "right of it");
        assert!((at(Vec3::Z) - 2.5).abs() < 1e-6, "the edges meet");
        assert_eq!((at(Vec3::Y), at(Vec3::NEG_Y)), (9.0, 0.0));
        image.pixels_mut()[5] = [0.0, -1.0, 0.0];
        let error = EnvironmentMap::new(&image).map(|_| ()).expect_err("negative").to_string();
        assert!(error.starts_with("pixel 1 of row 1 of the environment's picture is [0.0, -1.0, 0.0]"), "{error}");
    }
}
