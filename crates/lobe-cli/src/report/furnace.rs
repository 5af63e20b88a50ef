//! A sphere in a white world: what reflects all that arrives cannot be seen there.

use lobe_scene::Image;
use lobe_scene::image::Display;

/// The pixels of the picture, to both sides.
pub(super) const SIDE: u32 = 96;
/// The radius of the sphere, in half sides.
const RADIUS: f64 = 0.8;
/// The radiance of the world: half of white, so that what gains energy is seen as well as what loses it.
const WORLD: f64 = 0.5;

/// An albedo over the angle of the view, in degrees from the normal, by growing angle.
pub(super) type Curve = Vec<(f64, [f64; 3])>;

/// The albedo at an angle, in straight lines between those that are known, and as the last one beyond.
fn at(curve: &[(f64, [f64; 3])], degrees: f64) -> Option<[f64; 3]> {
    let after = curve.iter().position(|(angle, _)| *angle >= degrees);
    let (from, to) = match after {
        Some(0) => (curve.first()?, curve.first()?),
        Some(index) => (curve.get(index - 1)?, curve.get(index)?),
        None => (curve.last()?, curve.last()?),
    };
    let width = to.0 - from.0;
    let part = if width > 0.0 { (degrees - from.0) / width } else { 0.0 };
    Some(std::array::from_fn(|i| from.1[i] + part * (to.1[i] - from.1[i])))
}

/// The sphere as PNG. Seen from far away, so that the angle of the view at the distance `ρ` from the middle is `asin ρ`; in a
/// world that is the same everywhere the radiance there is the albedo times that of the world.
pub(super) fn picture(curve: &[(f64, [f64; 3])]) -> Option<Vec<u8>> {
    let mut image = Image::new(SIDE, SIDE).ok()?;
    let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    for (pixel, (x, y)) in image.pixels_mut().iter_mut().zip(places) {
        // Four samples to a side, or the rim has steps.
        let mut sum = [0.0; 3];
        for sample in 0..16 {
            let place = |at: u32, sub: u32| {
                let at = f64::from(at) + (f64::from(sub) + 0.5) / 4.0;
                (at / f64::from(SIDE) * 2.0 - 1.0) / RADIUS
            };
            let rho = place(x, sample % 4).hypot(place(y, sample / 4));
            let albedo = if rho < 1.0 { at(curve, rho.asin().to_degrees())? } else { [1.0; 3] };
            for (sum, albedo) in sum.iter_mut().zip(albedo) {
                *sum += WORLD * albedo / 16.0;
            }
        }
        *pixel = sum.map(|x| x as f32);
    }
    image.to_png(&Display::default()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_albedo_is_between_its_neighbours() {
        let curve = [(0.0, [1.0, 0.5, 0.0]), (40.0, [0.0, 0.5, 1.0]), (80.0, [0.0; 3])];
        assert_eq!(at(&curve, 0.0), Some([1.0, 0.5, 0.0]));
        assert_eq!(at(&curve, 10.0), Some([0.75, 0.5, 0.25]));
        assert_eq!(at(&curve, 40.0), Some([0.0, 0.5, 1.0]));
        assert_eq!(at(&curve, 89.0), Some([0.0; 3]));
        assert_eq!(at(&[], 10.0), None);
    }

    /// What reflects everything is the world itself.
    #[test]
    fn white_vanishes() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let look = |albedo: f64| -> Result<Vec<[f32; 3]>, Box<dyn std::error::Error>> {
            let path = folder.path().join("furnace.png");
            std::fs::write(&path, picture(&[(0.0, [albedo; 3]), (89.0, [albedo; 3])]).ok_or("a picture")?)?;
            Ok(Image::load(&path)?.pixels().to_vec())
        };
        let white = look(1.0)?;
        assert!(white.iter().all(|pixel| *pixel == white[0]));
        let (dark, bright) = (look(0.5)?, look(1.5)?);
        let middle = (SIDE * SIDE / 2 + SIDE / 2) as usize;
        assert!(dark[middle][0] < 0.6 * white[0][0] && bright[middle][0] > 1.3 * white[0][0]);
        assert_eq!(dark[0], white[0]);
        Ok(())
    }
}
