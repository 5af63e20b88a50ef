//! The same formulas without `lobe`: `glam`, `normalize`, `dot`, `powf`.

use glam::Vec3;
use std::f32::consts::{FRAC_1_PI, PI, TAU};

/// `ρ/π`.
#[derive(Clone, Copy, Debug)]
pub struct Lambert {
    /// `ρ`.
    pub albedo: Vec3,
}

impl Lambert {
    /// `f_r(l, v)`.
    #[inline(always)]
    pub fn eval(&self, l: Vec3, v: Vec3) -> Vec3 {
        if l.z <= 0.0 || v.z <= 0.0 {
            return Vec3::ZERO;
        }
        self.albedo * FRAC_1_PI
    }

    /// `f_r(l, v)`, NaN if a component of either direction is.
    #[inline(always)]
    pub fn eval_keeping_nan(&self, l: Vec3, v: Vec3) -> Vec3 {
        if l.is_nan() || v.is_nan() {
            return Vec3::NAN;
        }
        self.eval(l, v)
    }
}

/// `ks (q+2)/2π (r·v)^q`.
#[derive(Clone, Copy, Debug)]
pub struct Phong {
    /// `ks (q+2)/2π`.
    pub peak: Vec3,
    /// `q`.
    pub q: f32,
}

impl Phong {
    /// The lobe with reflectance `ks` and exponent `q`.
    pub fn new(ks: Vec3, q: f32) -> Self {
        Self { peak: ks * ((q + 2.0) / TAU), q }
    }

    /// `f_r(l, v)`.
    #[inline(always)]
    pub fn eval(&self, l: Vec3, v: Vec3) -> Vec3 {
        if l.z <= 0.0 || v.z <= 0.0 {
            return Vec3::ZERO;
        }
        let r = Vec3::new(-l.x, -l.y, l.z);
        self.peak * r.dot(v).max(0.0).powf(self.q)
    }
}

/// `ks (q+2)(q+4)/(8π(2^(−q/2)+q)) (n·h)^q`.
#[derive(Clone, Copy, Debug)]
pub struct BlinnPhong {
    /// `ks N(q)`.
    pub peak: Vec3,
    /// `q`.
    pub q: f32,
}

impl BlinnPhong {
    /// The lobe with reflectance `ks` and exponent `q`.
    pub fn new(ks: Vec3, q: f32) -> Self {
        Self { peak: ks * ((q + 2.0) * (q + 4.0) / (8.0 * PI * ((-q / 2.0).exp2() + q))), q }
    }

    /// `f_r(l, v)`.
    #[inline(always)]
    pub fn eval(&self, l: Vec3, v: Vec3) -> Vec3 {
        if l.z <= 0.0 || v.z <= 0.0 {
            return Vec3::ZERO;
        }
        let h = (l + v).normalize();
        self.peak * h.z.max(0.0).powf(self.q)
    }
}

/// GGX with Smith's correlated masking and Schlick's Fresnel term, from cosines, as shaders have it.
#[derive(Clone, Copy, Debug)]
pub struct Ggx {
    /// `α`.
    pub alpha: f32,
    /// `f0`.
    pub f0: Vec3,
}

impl Ggx {
    /// `f_r(l, v)`.
    #[inline(always)]
    pub fn eval(&self, l: Vec3, v: Vec3) -> Vec3 {
        if l.z <= 0.0 || v.z <= 0.0 {
            return Vec3::ZERO;
        }
        let h = (l + v).normalize();
        let a2 = self.alpha * self.alpha;
        let f = h.z * h.z * (a2 - 1.0) + 1.0;
        let d = a2 / (PI * f * f);
        let masked = |c: f32| (c * c * (1.0 - a2) + a2).sqrt();
        let visibility = 0.5 / (l.z * masked(v.z) + v.z * masked(l.z));
        let x = 1.0 - v.dot(h);
        let x2 = x * x;
        let fresnel = self.f0 + (Vec3::ONE - self.f0) * (x2 * x2 * x);
        fresnel * (d * visibility)
    }
}

/// The lecture's `k_d (n·l) + k_s (v·r)^q`, vectors in world space.
#[derive(Clone, Copy, Debug)]
pub struct LecturePhong {
    /// `k_d`.
    pub kd: Vec3,
    /// `k_s`.
    pub ks: Vec3,
    /// `q`.
    pub q: f32,
}

impl LecturePhong {
    /// The bracket for one light.
    #[inline(always)]
    pub fn reflected(&self, n: Vec3, l: Vec3, v: Vec3) -> Vec3 {
        let n_dot_l = n.dot(l);
        if n_dot_l <= 0.0 {
            return Vec3::ZERO;
        }
        let r = n * (2.0 * n_dot_l) - l;
        self.kd * n_dot_l + self.ks * v.dot(r).max(0.0).powf(self.q)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::directions;
    use lobe::fresnel::Schlick;
    use lobe::masking::SmithCorrelated;
    use lobe::{Alpha, Brdf, Microfacet, Rgb, Shininess};

    const KS: Vec3 = Vec3::new(0.3, 0.2, 0.1);

    fn assert_same(plain: impl Fn(Vec3, Vec3) -> Vec3, ours: impl Fn(Vec3, Vec3) -> Rgb) {
        let mut lit = 0;
        for (l, v) in directions(10_000) {
            let (a, b) = (plain(l, v), ours(l, v));
            let b = Vec3::new(b.r, b.g, b.b);
            lit += u32::from(b.x > 0.0);
            assert!(a.abs_diff_eq(b, 1e-5 * (1.0 + a.max_element())), "{a} {b} at {l} {v}");
        }
        assert!(lit > 5_000, "only {lit} of the pairs are lit");
    }

    #[test]
    fn the_baselines_compute_the_same() {
        let rgb = Rgb::new(KS.x, KS.y, KS.z);
        let (plain, ours) = (Lambert { albedo: KS }, lobe::Lambert::new(rgb));
        assert_same(|l, v| plain.eval(l, v), |l, v| ours.eval(l.into(), v.into()));
        let (plain, ours) = (Phong::new(KS, 8.0), lobe::Phong::new(rgb, Shininess(8.0)));
        assert_same(|l, v| plain.eval(l, v), |l, v| ours.eval(l.into(), v.into()) + Rgb::splat(1e-20));
        let (plain, ours) = (BlinnPhong::new(KS, 8.0), lobe::BlinnPhong::new(rgb, Shininess(8.0)));
        assert_same(|l, v| plain.eval(l, v), |l, v| ours.eval(l.into(), v.into()));
        let plain = Ggx { alpha: 0.3, f0: KS };
        let ours = Microfacet::new(lobe::distribution::Ggx::new(Alpha(0.3)), SmithCorrelated, Schlick::new(rgb));
        assert_same(|l, v| plain.eval(l, v), |l, v| ours.eval(l.into(), v.into()));
        let ours = lobe::illumination::Phong { ka: rgb, kd: rgb, ks: rgb, q: Shininess(8.0) };
        let plain = LecturePhong { kd: KS, ks: KS, q: 8.0 };
        assert_same(|l, v| plain.reflected(Vec3::Z, l, v), |l, v| ours.reflected(Vec3::Z.into(), l.into(), v.into()));
    }
}
