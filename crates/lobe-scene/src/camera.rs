//! A pinhole camera.

use crate::Error;
use glam::Vec3;

/// The largest coordinate of a camera. Well beyond [`MAX_COORDINATE`](crate::MAX_COORDINATE), so that the largest
/// scene can be seen from outside; its square is still far inside the range of `f32`.
pub(crate) const FARTHEST: f32 = 1e12;

/// Where the picture is taken from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Where the camera is. Its coordinates and those of the target are at most 1e12 in size.
    pub eye: Vec3,
    /// The point in the middle of the picture.
    pub target: Vec3,
    /// A direction that points up in the picture; it need not be at a right angle to the view.
    pub up: Vec3,
    /// The angle between the upper and the lower edge of the picture, in degrees, above 0 and below 180.
    pub fov_y_degrees: f32,
    /// An orthographic camera: the height of what it sees, in units of the scene, in place of the angle.
    pub height: Option<f32>,
}

impl Default for Camera {
    /// At `(0, 0, 1)`, looking at the origin with an angle of 35°.
    fn default() -> Self {
        Self { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, fov_y_degrees: 35.0, height: None }
    }
}

impl Camera {
    /// A camera that sees a whole box, given by two opposite corners, from slightly above and to its right, in a
    /// picture of this width divided by height.
    #[must_use]
    pub fn framing(low: Vec3, high: Vec3, aspect: f32) -> Self {
        let fov_y_degrees = 35.0_f32;
        let target = (low + high) / 2.0;
        // A box without an extent is a point: any distance will do.
        let radius = ((high - low) / 2.0).length().max(1e-6 * target.abs().max_element()).max(f32::MIN_POSITIVE);
        let half_y = fov_y_degrees.to_radians() / 2.0;
        let half_x = (half_y.tan() * aspect.clamp(0.01, 100.0)).atan();
        let distance = radius / half_y.min(half_x).sin();
        let from = Vec3::new(0.45, 0.35, 1.0).normalize();
        Self { eye: target + from * distance, target, up: Vec3::Y, fov_y_degrees, height: None }
    }

    /// Whether a picture can be taken with it.
    ///
    /// # Errors
    /// [`Error::Setting`] with what is wrong: no direction, an angle that is none, a point that is too far away.
    pub fn check(&self) -> Result<(), Error> {
        self.rays(1, 1).map(|_| ())
    }

    /// The rays of a picture of this size.
    ///
    /// # Errors
    /// [`Error::Setting`] when the camera has no direction, or an angle that is none.
    pub(crate) fn rays(&self, width: u32, height: u32) -> Result<Rays, Error> {
        for (what, point) in [("the eye of the camera", self.eye), ("the target of the camera", self.target)] {
            if !point.abs().cmple(Vec3::splat(FARTHEST)).all() {
                return Err(Error::setting(what, point, "its coordinates are finite and at most 1e12 in size"));
            }
        }
        let forward = (self.target.as_dvec3() - self.eye.as_dvec3()).try_normalize().ok_or_else(|| {
            Error::setting("the target of the camera", self.target, "it is a point apart from the eye")
        })?;
        let right = forward
            .cross(self.up.as_dvec3().normalize_or_zero())
            .try_normalize()
            .filter(|right| right.is_finite())
            .ok_or_else(|| Error::setting("`up` of the camera", self.up, "it does not point along the view"))?;
        if !(self.fov_y_degrees > 0.0 && self.fov_y_degrees < 180.0) {
            return Err(Error::setting("fov_y_degrees", self.fov_y_degrees, "it lies between 0 and 180"));
        }
        let up = right.cross(forward);
        if let Some(seen) = self.height.filter(|seen| !(*seen > 0.0 && *seen <= FARTHEST)) {
            return Err(Error::setting("the height of an orthographic camera", seen, "it lies between 0 and 1e12"));
        }
        let parallel = self.height.is_some();
        let half_height = self
            .height
            .map_or_else(|| (f64::from(self.fov_y_degrees).to_radians() / 2.0).tan(), |seen| f64::from(seen) / 2.0);
        let half_width = half_height * f64::from(width) / f64::from(height);
        let across = up * half_height - right * half_width;
        Ok(Rays {
            eye: self.eye,
            forward: forward.as_vec3(),
            corner: if parallel { across } else { forward + across }.as_vec3(),
            right: (right * 2.0 * half_width / f64::from(width)).as_vec3(),
            down: (-up * 2.0 * half_height / f64::from(height)).as_vec3(),
            parallel,
        })
    }
}

/// The rays through the pixels of a picture.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rays {
    eye: Vec3,
    forward: Vec3,
    corner: Vec3,
    right: Vec3,
    down: Vec3,
    parallel: bool,
}

impl Rays {
    /// The unit direction through a point of the picture, in pixels from its upper left corner.
    #[inline]
    pub(crate) fn direction(&self, x: f32, y: f32) -> Vec3 {
        if self.parallel { self.forward } else { (self.corner + self.right * x + self.down * y).normalize() }
    }

    /// Where the ray through that point starts.
    #[inline]
    pub(crate) fn origin(&self, x: f32, y: f32) -> Vec3 {
        if self.parallel { self.eye + self.corner + self.right * x + self.down * y } else { self.eye }
    }

    /// The width of a pixel at the start of its ray, and by how much it grows with each unit of length.
    pub(crate) fn pixel(&self) -> (f32, f32) {
        let side = self.down.length();
        if self.parallel { (side, 0.0) } else { (0.0, side) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_target_is_in_the_middle_and_the_edges_are_at_half_the_angle() -> Result<(), Error> {
        let camera =
            Camera { eye: Vec3::ZERO, target: Vec3::NEG_Z * 3.0, up: Vec3::Y, fov_y_degrees: 90.0, height: None };
        let rays = camera.rays(200, 100)?;
        assert!((rays.direction(100.0, 50.0) - Vec3::NEG_Z).length() < 1e-6);
        assert!((rays.direction(100.0, 0.0) - Vec3::new(0.0, 1.0, -1.0).normalize()).length() < 1e-6);
        assert!((rays.direction(200.0, 50.0) - Vec3::new(2.0, 0.0, -1.0).normalize()).length() < 1e-6);
        Ok(())
    }

    #[test]
    fn a_framed_box_is_inside_the_picture() -> Result<(), Error> {
        for (low, high) in [
            (Vec3::ZERO, Vec3::ONE),
            (Vec3::new(-1e6, 3.0, 0.0), Vec3::new(1e6, 3.0, 1.0)),
            (Vec3::splat(-1e-6), Vec3::splat(1e-6)),
        ] {
            for (width, height) in [(160, 90), (50, 200)] {
                let camera = Camera::framing(low, high, width as f32 / height as f32);
                let rays = camera.rays(width, height)?;
                let (forward, top) =
                    (rays.direction(width as f32 / 2.0, height as f32 / 2.0), rays.direction(width as f32 / 2.0, 0.0));
                for corner in 0..8 {
                    let point = Vec3::new(
                        if corner & 1 == 0 { low.x } else { high.x },
                        if corner & 2 == 0 { low.y } else { high.y },
                        if corner & 4 == 0 { low.z } else { high.z },
                    );
                    let angle = (point - camera.eye).angle_between(forward);
                    let side = rays.direction(0.0, height as f32 / 2.0).angle_between(forward);
                    assert!(angle <= top.angle_between(forward).min(side) + 1e-3, "{low} {high} {angle}");
                }
            }
        }
        Ok(())
    }

    #[test]
    fn senseless_cameras_are_errors() {
        let good = Camera { eye: Vec3::ZERO, target: Vec3::X, up: Vec3::Y, fov_y_degrees: 40.0, height: None };
        for bad in [
            Camera { target: Vec3::ZERO, ..good },
            Camera { target: Vec3::splat(f32::NAN), ..good },
            Camera { eye: Vec3::splat(f32::INFINITY), ..good },
            Camera { eye: Vec3::splat(1e13), ..good },
            Camera { up: Vec3::X, ..good },
            Camera { up: Vec3::ZERO, ..good },
            Camera { fov_y_degrees: 0.0, ..good },
            Camera { fov_y_degrees: 180.0, ..good },
            Camera { fov_y_degrees: f32::NAN, ..good },
        ] {
            assert!(bad.rays(4, 4).is_err(), "{bad:?}");
        }
        assert!(good.rays(4, 4).is_ok());
    }
}
