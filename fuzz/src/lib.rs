//! What the fuzz targets share: texts in sections, numbers from bits.

use lobe::{Rgb, Shininess, Vec3};
use lobe_scene::{Renderer, Scene, Settings};
use std::io;

/// One input that holds several files: the first one, then each after a line `@name`.
///
/// The same form as the files of `crates/lobe-scene/tests/corpus`, so that a finding becomes a test by copying it, and
/// those files are the seeds of these targets.
pub struct Files<'a> {
    /// The first file.
    pub first: &'a [u8],
    others: Vec<(&'a [u8], &'a [u8])>,
}

impl<'a> Files<'a> {
    /// Takes an input apart.
    #[must_use]
    pub fn new(input: &'a [u8]) -> Self {
        let mut files = Self { first: input, others: Vec::new() };
        let mut start = 0;
        while let Some(at) = next_heading(input, start) {
            let end_of_name = input[at..].iter().position(|&byte| byte == b'\n').map_or(input.len(), |n| at + n);
            match files.others.last_mut() {
                Some((_, content)) => *content = &input[start..at],
                None => files.first = &input[..at],
            }
            start = (end_of_name + 1).min(input.len());
            files.others.push((&input[at + 1..end_of_name], &input[start..]));
        }
        files
    }

    /// The file of this name. A name that was not given gets the second file, if there is one: a mutation of the name
    /// then does not end the run.
    ///
    /// # Errors
    /// Not found, when there is but one file.
    pub fn read(&self, name: &str) -> io::Result<Vec<u8>> {
        let found = self.others.iter().find(|(given, _)| *given == name.as_bytes()).or(self.others.first());
        found.map(|(_, content)| content.to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into())
    }
}

/// Draws the first views of a scene that was read: all of that works.
pub fn draw(scene: &Scene) {
    assert!(!scene.views.is_empty());
    let Ok(renderer) = Renderer::new(scene) else { panic!("a scene that was read can be drawn") };
    let settings = Settings { width: 3, height: 2, depth: 2, ..Settings::default() };
    for view in scene.views.iter().take(4) {
        // A view with its own camera was checked while it was read; a framed one may be out of reach.
        let image = renderer.render(view, &settings, None);
        assert!(image.is_ok() || view.camera.is_none(), "{:?}", image.err());
    }
}

/// The next `@` at the start of a line.
fn next_heading(input: &[u8], from: usize) -> Option<usize> {
    (from..input.len()).find(|&at| input[at] == b'@' && (at == 0 || input[at - 1] == b'\n'))
}

/// Numbers taken from the input one by one; 0 after its end.
pub struct Bits<'a>(pub &'a [u8]);

impl Bits<'_> {
    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let (first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        *first
    }

    /// The next four bytes as a float, whatever it is.
    pub fn float(&mut self) -> f32 {
        f32::from_le_bytes([self.byte(), self.byte(), self.byte(), self.byte()])
    }

    /// Three floats.
    pub fn vector(&mut self) -> Vec3 {
        Vec3::new(self.float(), self.float(), self.float())
    }

    /// A colour of any bits.
    pub fn colour(&mut self) -> Rgb {
        Rgb::new(self.float(), self.float(), self.float())
    }

    /// A float in [0, `end`]: by its bits, so that the small ones are as likely as the large.
    pub fn up_to(&mut self, end: f32) -> f32 {
        let bits = self.float().to_bits();
        f32::from_bits(bits % (end.to_bits() + 1))
    }

    /// A reflectance in [0, 1].
    pub fn reflectance(&mut self) -> Rgb {
        Rgb::new(self.up_to(1.0), self.up_to(1.0), self.up_to(1.0))
    }

    /// An exponent in [0, 10⁶].
    pub fn shininess(&mut self) -> Shininess {
        Shininess(self.up_to(1e6))
    }

    /// A direction of unit length; `other` is one that it may be close to, opposite to, or the mirror image of.
    pub fn direction(&mut self, other: Vec3) -> Vec3 {
        let kind = self.byte();
        match kind % 8 {
            // Any three bit patterns, if they have a direction.
            0..=2 => unit(self.vector()),
            // A cosine of any size, and an azimuth.
            3 | 4 => {
                let z = self.up_to(1.0);
                let (sin, cos) = (self.up_to(1.0) * std::f32::consts::TAU).sin_cos();
                let r = (1.0 - f64::from(z) * f64::from(z)).sqrt() as f32;
                Vec3::new(r * cos, r * sin, z)
            }
            5 => self.nudge(other),
            6 => self.nudge(Vec3::new(-other.x, -other.y, other.z)),
            _ => self.nudge(-other),
        }
    }

    /// The same, some units in the last place away.
    fn nudge(&mut self, v: Vec3) -> Vec3 {
        let mut step = |x: f32| {
            let by = self.byte() as i8;
            f32::from_bits(x.to_bits().wrapping_add_signed(i32::from(by / 8)))
        };
        let moved = Vec3::new(step(v.x), step(v.y), step(v.z));
        // A step across zero or infinity gives something else altogether.
        if is_unit(moved) { moved } else { v }
    }
}

/// The unit vector along `v`, computed in `f64`; straight up where there is none.
#[must_use]
pub fn unit(v: Vec3) -> Vec3 {
    let wide = v.map(f64::from).normalize().map(|c| c as f32);
    if is_unit(wide) { wide } else { Vec3::new(0.0, 0.0, 1.0) }
}

/// Whether the length is 1 but for rounding.
#[must_use]
pub fn is_unit(v: Vec3) -> bool {
    (v.map(f64::from).length() - 1.0).abs() < 1e-5
}

/// The channels.
#[must_use]
pub fn channels(c: Rgb) -> [f32; 3] {
    c.into()
}

/// The components.
#[must_use]
pub fn components(v: Vec3) -> [f32; 3] {
    v.into()
}

/// Whether two values are the same to the last bit; two NaNs are.
#[must_use]
pub fn same(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()))
}

/// Whether two values are equal, −0 and 0 too; two NaNs are.
#[must_use]
pub fn equal(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| *a == b || (a.is_nan() && b.is_nan()))
}
