//! Samplers in `f64` as an engine would have them, each with places for its faults.

use super::Fault;
use crate::sampling::{Claims, Sampler};
use lobe::{Rgb, Vec3};
use lobe_sampling::Outcome;
use std::f64::consts::{FRAC_1_PI, TAU};

/// What is sampled, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Model {
    /// A white Lambertian surface, by the cosine.
    Cosine,
    /// The normalised mirror lobe with this exponent, all around its axis; what is below the horizon is rejected.
    Phong(f64),
    /// GGX with two widths and `F = 1`, masking correlated, by the normals that the viewer sees (Heitz, "Sampling the
    /// GGX Distribution of Visible Normals", JCGT 7(4), 2018).
    VisibleNormals([f64; 2]),
    /// The same lobe by all normals, `D cos` (Walter et al., "Microfacet Models for Refraction through Rough Surfaces",
    /// 2007).
    Normals([f64; 2]),
}

/// A sampler, sound or with a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Port {
    pub(super) model: Model,
    pub(super) fault: Option<Fault>,
}

impl Port {
    /// A model without a fault.
    #[must_use]
    pub fn sound(model: Model) -> Self {
        Self { model, fault: None }
    }

    fn has(&self, fault: Fault) -> bool {
        self.fault == Some(fault)
    }
}

fn dot([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> f64 {
    a * x + b * y + c * z
}

fn scaled([x, y, z]: [f64; 3], s: f64) -> [f64; 3] {
    [x * s, y * s, z * s]
}

fn normalised(d: [f64; 3]) -> [f64; 3] {
    scaled(d, dot(d, d).sqrt().recip())
}

fn half([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    normalised([a + x, b + y, c + z])
}

/// `D(h)` in sr⁻¹ of GGX with the widths `a` and `b`.
fn ggx([a, b]: [f64; 2], [x, y, z]: [f64; 3]) -> f64 {
    let (x, y) = (x / a, y / b);
    let sum = x * x + y * y + z * z;
    FRAC_1_PI / (a * b * sum * sum)
}

/// Smith's `Λ`.
fn lambda([a, b]: [f64; 2], [x, y, z]: [f64; 3]) -> f64 {
    0.5 * ((1.0 + (a * a * x * x + b * b * y * y) / (z * z)).sqrt() - 1.0)
}

/// `n·h` to the power `q`, of the mirror direction.
fn mirror_power(q: f64, [lx, ly, lz]: [f64; 3], [vx, vy, vz]: [f64; 3]) -> f64 {
    (lz * vz - lx * vx - ly * vy).max(0.0).powf(q)
}

impl Sampler for Port {
    fn sample(&self, v: [f64; 3], u: [f64; 3]) -> Outcome<f64> {
        let [_, _, vz] = v;
        // NaN goes on, as in the engines.
        if vz <= 0.0 {
            return Outcome::Rejected;
        }
        let [lx, ly, lz] = match self.model {
            Model::Cosine => self.cosine(u),
            Model::Phong(q) => self.phong(q, v, u),
            Model::VisibleNormals(alpha) if self.has(Fault::NormalsForVisible) => reflected(v, self.normal(alpha, u)),
            Model::VisibleNormals(alpha) => reflected(v, self.visible_normal(alpha, v, u)),
            Model::Normals(alpha) => reflected(v, self.normal(alpha, u)),
        };
        let lz = if self.has(Fault::MirroredUp) { lz.abs() } else { lz };
        if lz <= 0.0 && !self.has(Fault::BelowKept) {
            return Outcome::Rejected;
        }
        let l = [lx, ly, lz];
        Outcome::Scattered { l: Vec3::new(lx, ly, lz), weight: Rgb::splat(self.weight(l, v)), pdf: self.density(l, v) }
    }

    fn pdf(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        let ([_, _, lz], [_, _, vz]) = (l, v);
        if lz <= 0.0 || vz <= 0.0 { 0.0 } else { self.density(l, v) }
    }

    fn eval_cos_pdf(&self, l: [f64; 3], v: [f64; 3]) -> Option<([f64; 3], f64)> {
        let ([_, _, lz], [_, _, vz]) = (l, v);
        if lz <= 0.0 || vz <= 0.0 {
            return Some(([0.0; 3], 0.0));
        }
        Some(([self.value(l, v); 3], self.density(l, v)))
    }

    fn claims(&self) -> Claims {
        Claims { nan: false, ..Claims::LOBE }
    }
}

impl Port {
    /// `f_r (n·l)`.
    fn value(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        let ([_, _, lz], [_, _, vz]) = (l, v);
        match self.model {
            Model::Cosine => lz * FRAC_1_PI,
            Model::Phong(q) => (q + 2.0) / TAU * mirror_power(q, l, v) * lz,
            Model::VisibleNormals(alpha) | Model::Normals(alpha) => {
                ggx(alpha, half(l, v)) / (4.0 * vz * (1.0 + lambda(alpha, l) + lambda(alpha, v)))
            }
        }
    }

    fn density(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        let ([_, _, lz], [_, _, vz]) = (l, v);
        match self.model {
            Model::Cosine => lz * FRAC_1_PI,
            Model::Phong(q) => {
                let pdf = (q + 1.0) / TAU * mirror_power(q, l, v);
                // The part of a cosine lobe around the mirror direction that is above the horizon is (1 + cos θ)/2.
                if self.has(Fault::Renormalised) { pdf * 2.0 / (1.0 + vz) } else { pdf }
            }
            Model::VisibleNormals(alpha) => {
                let h = half(l, v);
                let visible = ggx(alpha, h) / (vz * (1.0 + lambda(alpha, v)));
                if self.has(Fault::JacobianDropped) { visible * dot(v, h) } else { 0.25 * visible }
            }
            Model::Normals(alpha) => {
                let h = half(l, v);
                let [_, _, hz] = h;
                ggx(alpha, h) * hz / (4.0 * dot(v, h))
            }
        }
    }

    fn weight(&self, l: [f64; 3], v: [f64; 3]) -> f64 {
        match self.model {
            Model::VisibleNormals(alpha) if self.has(Fault::WeightUncorrelated) => 1.0 / (1.0 + lambda(alpha, l)),
            _ => self.value(l, v) / self.density(l, v),
        }
    }

    fn cosine(&self, [_, x, y]: [f64; 3]) -> [f64; 3] {
        // 1 − x, so that the height is never 0.
        let z = if self.has(Fault::CosineForgotten) { 1.0 - x } else { (1.0 - x).sqrt() };
        let r = ((1.0 - z) * (1.0 + z)).sqrt();
        let (sin, cos) = (TAU * y).sin_cos();
        [r * cos, r * sin, z]
    }

    fn phong(&self, q: f64, [vx, vy, vz]: [f64; 3], [_, x, y]: [f64; 3]) -> [f64; 3] {
        let q = if self.has(Fault::ExponentOffByTwo) { q + 2.0 } else { q };
        let z = (1.0 - x).powf(1.0 / (q + 1.0));
        let r = ((1.0 - z) * (1.0 + z)).sqrt();
        let (sin, cos) = (TAU * y).sin_cos();
        // A frame around the mirror direction.
        let m = [-vx, -vy, vz];
        let sine = (vx * vx + vy * vy).sqrt();
        let side = if sine > 0.0 { [vy / sine, -vx / sine, 0.0] } else { [1.0, 0.0, 0.0] };
        let up = cross(m, side);
        std::array::from_fn(|i| {
            let at = |d: [f64; 3]| d.get(i).copied().unwrap_or_default();
            at(side) * r * cos + at(up) * r * sin + at(m) * z
        })
    }

    /// In the paper's steps: the viewer stretched, a half disc bent by the projection, the normal stretched back.
    fn visible_normal(&self, [a, b]: [f64; 2], [vx, vy, vz]: [f64; 3], [_, u, w]: [f64; 3]) -> [f64; 3] {
        let [a, b] = if self.has(Fault::WidthsSwapped) { [b, a] } else { [a, b] };
        let stretched = normalised([a * vx, b * vy, vz]);
        let [sx, sy, sz] = stretched;
        let r2 = sx * sx + sy * sy;
        let first = if r2 > 0.0 { [-sy / r2.sqrt(), sx / r2.sqrt(), 0.0] } else { [1.0, 0.0, 0.0] };
        let second = cross(stretched, first);
        let r = u.sqrt();
        let (sin, cos) = (TAU * w).sin_cos();
        let (p, across) = (r * cos, r * sin);
        let s = 0.5 * (1.0 + sz);
        let q = (1.0 - s) * ((1.0 - p) * (1.0 + p)).max(0.0).sqrt() + s * across;
        let height = (1.0 - p * p - q * q).max(0.0).sqrt();
        let [nx, ny, nz] = std::array::from_fn(|i| {
            let at = |d: [f64; 3]| d.get(i).copied().unwrap_or_default();
            p * at(first) + q * at(second) + height * at(stretched)
        });
        normalised([a * nx, b * ny, nz.max(0.0)])
    }

    fn normal(&self, [a, b]: [f64; 2], [_, u, w]: [f64; 3]) -> [f64; 3] {
        let slope = if self.has(Fault::DividedByZero) { ((1.0 - u) / u).sqrt() } else { (u / (1.0 - u)).sqrt() };
        let (sin, cos) = (TAU * w).sin_cos();
        let (x, y) = if self.has(Fault::AzimuthNotStretched) {
            // The slope in this direction is right, but as many directions as if the lobe were round.
            let inverse = ((cos / a) * (cos / a) + (sin / b) * (sin / b)).sqrt();
            (slope * cos / inverse, slope * sin / inverse)
        } else {
            (slope * a * cos, slope * b * sin)
        };
        normalised([x, y, 1.0])
    }
}

fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn reflected(v: [f64; 3], h: [f64; 3]) -> [f64; 3] {
    let ([vx, vy, vz], [x, y, z]) = (v, scaled(h, 2.0 * dot(v, h)));
    [x - vx, y - vy, z - vz]
}
