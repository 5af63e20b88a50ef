//! The ports, written as engines write them: dot products of `f64`, clamps, and a place for each fault.

use super::{Fault, Port};
use lobe::Vec3;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

pub(super) const ALBEDO: f64 = 0.8;
pub(super) const F0: f64 = 0.9;
/// Odd, so that a negative base stays negative.
pub(super) const EXPONENT: f64 = 21.0;
pub(super) const SIGMA: f64 = 0.5;
pub(super) const WIDTH: f64 = 0.3;
pub(super) const WIDTHS: [f64; 2] = [0.1, 0.5];

impl Port {
    /// `f_r`, the same in all channels.
    pub(super) fn value(&self, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
        // Not "both above": with a NaN neither is true, and the sum keeps it.
        let below = l.z <= 0.0 || v.z <= 0.0;
        if self.has(Fault::HorizonMissing) {
            return self.above(l, v) + nan_of(l, v);
        }
        if self.has(Fault::NanDropped) {
            return if l.z > 0.0 && v.z > 0.0 { self.above(l, v) } else { 0.0 };
        }
        (if below { 0.0 } else { self.above(l, v) }) + nan_of(l, v)
    }

    fn above(&self, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
        match self.fault {
            Fault::PiMissing
            | Fault::CosineMissing
            | Fault::CosineTwice
            | Fault::HorizonMissing
            | Fault::NanDropped => self.lambert(l),
            Fault::AlbedoAsF0 => self.albedo * (1.0 - if self.planted { self.albedo } else { 0.04 }) * FRAC_1_PI,
            Fault::PlusEight | Fault::ClampRemoved => self.phong(l, v),
            Fault::AzimuthUnclamped | Fault::AzimuthUnwrapped => self.oren_nayar(l, v),
            _ => self.ggx(l, v),
        }
    }

    fn lambert(&self, l: Vec3<f64>) -> f64 {
        let scale = if self.has(Fault::PiMissing) { 1.0 } else { FRAC_1_PI };
        self.albedo * scale * if self.has(Fault::CosineTwice) { l.z } else { 1.0 }
    }

    fn phong(&self, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
        let r_dot_v = l.z * v.z - l.x * v.x - l.y * v.y;
        let base = if self.has(Fault::ClampRemoved) { r_dot_v } else { r_dot_v.max(0.0) };
        let factor = EXPONENT + if self.has(Fault::PlusEight) { 8.0 } else { 2.0 };
        factor / TAU * base.powi(EXPONENT as i32)
    }

    /// The qualitative model; `AzimuthUnwrapped` is of a variant whose cosine of the azimuth is linear.
    fn oren_nayar(&self, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
        let sigma2 = SIGMA * SIGMA;
        let (a, b) = (1.0 - 0.5 * sigma2 / (sigma2 + 0.33), 0.45 * sigma2 / (sigma2 + 0.09));
        let sin = |d: Vec3<f64>| d.x.hypot(d.y);
        let azimuth = |d: Vec3<f64>| d.y.atan2(d.x);
        let (sin_alpha, tan_beta) = if l.z < v.z { (sin(l), sin(v) / v.z) } else { (sin(v), sin(l) / l.z) };
        let apart = (azimuth(l) - azimuth(v)).abs();
        let cos = if self.fault == Fault::AzimuthUnwrapped {
            let apart = if self.planted { apart } else { apart.min(TAU - apart) };
            1.0 - 2.0 * apart / PI
        } else if sin(l) * sin(v) > 0.0 {
            (l.x * v.x + l.y * v.y) / (sin(l) * sin(v))
        } else {
            0.0
        };
        let cos = if self.has(Fault::AzimuthUnclamped) { cos } else { cos.max(0.0) };
        self.albedo * FRAC_1_PI * (a + b * cos * sin_alpha * tan_beta)
    }

    fn ggx(&self, l: Vec3<f64>, v: Vec3<f64>) -> f64 {
        let [x, y] = match self.fault {
            Fault::WidthsSwapped if self.planted => [WIDTHS[1], WIDTHS[0]],
            Fault::WidthsSwapped => WIDTHS,
            _ => [WIDTH; 2],
        };
        let s = l + v;
        let h = s.normalize();
        let l_dot_h = 0.5 * s.length();
        // D.
        let (dx, dy) = if self.has(Fault::AlphaForItsSquare) { (x.sqrt(), y.sqrt()) } else { (x, y) };
        let stretched = (h.x / dx) * (h.x / dx) + (h.y / dy) * (h.y / dy) + h.z * h.z;
        let area = if self.has(Fault::Unnormalised) { 1e-2 } else { dx * dy };
        let d = 1.0 / (PI * area * stretched * stretched);
        // G/(4 (n·l)(n·v)).
        let root = |w: Vec3<f64>| (w.z * w.z + (x * w.x) * (x * w.x) + (y * w.y) * (y * w.y)).sqrt();
        let visibility = if self.has(Fault::Uncorrelated) {
            1.0 / ((l.z + root(l)) * (v.z + root(v)))
        } else if self.has(Fault::ViewerMaskingOnly) {
            0.5 / (l.z * (v.z + root(v)))
        } else {
            0.5 / (l.z * root(v) + v.z * root(l))
        };
        let visibility = if self.has(Fault::ViewCosineMissing) { visibility * v.z } else { visibility };
        // F.
        let cos = if self.has(Fault::FresnelOfView) { v.z } else { l_dot_h };
        d * visibility * (F0 + (1.0 - F0) * (1.0 - cos).max(0.0).powi(5))
    }
}

/// 0, or NaN where a component is NaN.
fn nan_of(l: Vec3<f64>, v: Vec3<f64>) -> f64 {
    (l.x + l.y + l.z + v.x + v.y + v.z) * 0.0
}
