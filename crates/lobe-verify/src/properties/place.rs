//! Pairs of directions as a person would name them: by angles that can be made simpler without leaving the sphere.

use crate::subject::{Pair, Precision};

/// How far a direction is from the normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Tilt {
    /// By its cosine, negative below the horizon. A small one keeps all of its digits.
    Cos(f64),
    /// By its sine, above the horizon: next to the normal the cosine has no digits left to tell directions apart.
    Sin(f64),
}

/// A direction: a tilt, and an azimuth in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Toward {
    pub(crate) tilt: Tilt,
    pub(crate) azimuth: f64,
}

impl Toward {
    pub(crate) fn new(tilt: Tilt, azimuth: f64) -> Self {
        Self { tilt, azimuth }
    }

    /// The unit vector. Azimuths that are multiples of 45 degrees apart are mirrored to the last bit.
    pub(crate) fn unit(self) -> [f64; 3] {
        let (sin, cos) = match self.tilt {
            Tilt::Cos(cos) => (libm::sqrt(((1.0 - cos) * (1.0 + cos)).max(0.0)), cos),
            Tilt::Sin(sin) => (sin, libm::sqrt(((1.0 - sin) * (1.0 + sin)).max(0.0))),
        };
        let (y, x) = sin_cos_degrees(self.azimuth);
        // Adding zero turns −0 into 0.
        [sin * x + 0.0, sin * y + 0.0, cos]
    }

    /// The cosine.
    pub(crate) fn cos(self) -> f64 {
        let [_, _, z] = self.unit();
        z
    }
}

/// Two directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) l: Toward,
    pub(crate) v: Toward,
}

impl Place {
    /// The vectors, rounded to the number type.
    pub(crate) fn pair(self, precision: Precision) -> Pair {
        let ([lx, ly, lz], [vx, vy, vz]) = (self.l.unit(), self.v.unit());
        [lx, ly, lz, vx, vy, vz].map(|x| precision.round(x))
    }

    /// Both directions turned around the normal.
    pub(crate) fn turned(self, degrees: f64) -> Self {
        let turn = |d: Toward| Toward::new(d.tilt, d.azimuth + degrees);
        Self { l: turn(self.l), v: turn(self.v) }
    }
}

/// The pair with `l` and `v` exchanged.
pub(crate) fn exchanged(&[lx, ly, lz, vx, vy, vz]: &Pair) -> Pair {
    [vx, vy, vz, lx, ly, lz]
}

/// `|l + v|`: what the halfway direction is made of.
pub(crate) fn length_of_sum(&[lx, ly, lz, vx, vy, vz]: &Pair) -> f64 {
    let (x, y, z) = (lx + vx, ly + vy, lz + vz);
    libm::sqrt(x * x + y * y + z * z)
}

/// Sine and cosine of an angle in degrees: exact at multiples of 90, and the same digits in every quadrant.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let turn = degrees % 360.0;
    let quarter = libm::round(turn / 90.0);
    let (sin, cos) = libm::sincos((turn - 90.0 * quarter).to_radians());
    match (quarter as i32).rem_euclid(4) {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_are_exact() {
        let at = |azimuth| Toward::new(Tilt::Cos(0.6), azimuth).unit();
        assert_eq!(at(0.0), [0.8, 0.0, 0.6]);
        assert_eq!(at(90.0), [0.0, 0.8, 0.6]);
        assert_eq!(at(-180.0), [-0.8, 0.0, 0.6]);
        assert_eq!(at(630.0), [0.0, -0.8, 0.6]);
        let ([x, y, _], [p, q, _]) = (at(20.25), at(200.25));
        assert_eq!((x, y), (-p, -q));
        // Mirrored between the axes too.
        let ([x, y, _], [p, q, _]) = (at(20.25), at(69.75));
        assert_eq!((x, y), (q, p));
    }
}
