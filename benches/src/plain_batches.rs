//! The same lobes, times the cosine, as bodies of a loop over slices: without an early return, which would keep the
//! compiler from vectorising the loop. Cosines are clamped instead, as shaders have it.
//!
//! `glam` takes its square roots from `libm` where anything in the build asks for that, as `lobe` does without `std`; on
//! x86 that is inline assembly which no loop is vectorised around. So the lengths here are written with `f32::sqrt`.

use glam::Vec3;
use std::f32::consts::{FRAC_1_PI, PI};

/// The least cosine.
const MIN_COS: f32 = 1e-6;

/// `h` and the two cosines with the normal.
#[inline(always)]
fn half(l: Vec3, v: Vec3) -> (Vec3, f32, f32) {
    let s = l + v;
    (s * (1.0 / s.dot(s).sqrt()), l.z.max(MIN_COS), v.z.max(MIN_COS))
}

#[inline(always)]
fn schlick(f0: Vec3, cos: f32) -> Vec3 {
    let x = 1.0 - cos;
    let x2 = x * x;
    f0 + (Vec3::ONE - f0) * (x2 * x2 * x)
}

/// `D` and the visibility of GGX.
#[inline(always)]
fn ggx_terms(alpha: f32, h: Vec3, nl: f32, nv: f32) -> f32 {
    let a2 = alpha * alpha;
    let q = h.z * h.z * (a2 - 1.0) + 1.0;
    let masked = |c: f32| (c * c * (1.0 - a2) + a2).sqrt();
    a2 / (PI * q * q) * (0.5 / (nl * masked(nv) + nv * masked(nl)))
}

/// GGX, Smith's correlated masking, Schlick's Fresnel term.
#[inline(always)]
pub fn ggx(alpha: f32, f0: Vec3, l: Vec3, v: Vec3) -> Vec3 {
    let (h, nl, nv) = half(l, v);
    schlick(f0, v.dot(h)) * (ggx_terms(alpha, h, nl, nv) * nl)
}

/// The same with the exact Fresnel term of a conductor.
#[inline(always)]
pub fn ggx_conductor(alpha: f32, eta: Vec3, k: Vec3, l: Vec3, v: Vec3) -> Vec3 {
    let (h, nl, nv) = half(l, v);
    let c = v.dot(h).min(1.0);
    let (c2, s2) = (c * c, 1.0 - c * c);
    let channel = |eta: f32, k: f32| {
        let t0 = eta * eta - k * k - s2;
        let a2b2 = (t0 * t0 + 4.0 * eta * eta * k * k).sqrt();
        let t1 = a2b2 + c2;
        let a = (0.5 * (a2b2 + t0)).max(0.0).sqrt();
        let t2 = 2.0 * a * c;
        let rs = (t1 - t2) / (t1 + t2);
        let t3 = c2 * a2b2 + s2 * s2;
        let t4 = t2 * s2;
        0.5 * (rs + rs * (t3 - t4) / (t3 + t4))
    };
    let f = Vec3::new(channel(eta.x, k.x), channel(eta.y, k.y), channel(eta.z, k.z));
    f * (ggx_terms(alpha, h, nl, nv) * nl)
}

/// `ks N (n·h)^q`; `peak` is `ks N`.
#[inline(always)]
pub fn blinn_phong(q: f32, peak: Vec3, l: Vec3, v: Vec3) -> Vec3 {
    let (h, nl, _) = half(l, v);
    peak * (h.z.max(0.0).powf(q) * nl)
}

/// Beckmann, the rational masking of Walter et al., Schlick.
#[inline(always)]
pub fn beckmann(alpha: f32, f0: Vec3, l: Vec3, v: Vec3) -> Vec3 {
    let (h, nl, nv) = half(l, v);
    let (c2, a2) = (h.z * h.z, alpha * alpha);
    let d = ((c2 - 1.0) / (a2 * c2)).exp() / (PI * a2 * c2 * c2);
    let g1 = |c: f32| {
        let a = c / (alpha * (1.0 - c * c).sqrt());
        if a < 1.6 { (3.535 * a + 2.181 * a * a) / (1.0 + 2.276 * a + 2.577 * a * a) } else { 1.0 }
    };
    schlick(f0, v.dot(h)) * (d * g1(nl) * g1(nv) / (4.0 * nl * nv) * nl)
}

/// Ward.
#[inline(always)]
pub fn ward(alpha: [f32; 2], ks: Vec3, l: Vec3, v: Vec3) -> Vec3 {
    let (h, nl, nv) = half(l, v);
    let (x, y) = (h.x / alpha[0], h.y / alpha[1]);
    let e = (-(x * x + y * y) / (h.z * h.z)).exp();
    ks * (e / (4.0 * PI * alpha[0] * alpha[1] * (nl * nv).sqrt()) * nl)
}

/// Ashikhmin and Shirley's lobe.
#[inline(always)]
pub fn ashikhmin_shirley(nu: f32, nv: f32, f0: Vec3, l: Vec3, v: Vec3) -> Vec3 {
    let (h, n_dot_l, n_dot_v) = half(l, v);
    let exponent = (nu * h.x * h.x + nv * h.y * h.y) / (1.0 - h.z * h.z);
    let cos = v.dot(h);
    let d = ((nu + 1.0) * (nv + 1.0)).sqrt() / (8.0 * PI) * h.z.powf(exponent);
    schlick(f0, cos) * (d / (cos * n_dot_l.max(n_dot_v)) * n_dot_l)
}

/// Oren and Nayar's qualitative model.
#[inline(always)]
pub fn oren_nayar(sigma: f32, albedo: Vec3, l: Vec3, v: Vec3) -> Vec3 {
    let (nl, nv) = (l.z.max(MIN_COS), v.z.max(MIN_COS));
    let s2 = sigma * sigma;
    let a = 1.0 - 0.5 * s2 / (s2 + 0.33);
    let b = 0.45 * s2 / (s2 + 0.09);
    let s = (l.x * v.x + l.y * v.y).max(0.0) / nl.max(nv);
    albedo * ((a + b * s) * (FRAC_1_PI * nl))
}

/// glTF's metallic-roughness.
#[inline(always)]
pub fn gltf(base: Vec3, metallic: f32, alpha: f32, l: Vec3, v: Vec3) -> Vec3 {
    let (h, nl, nv) = half(l, v);
    let a2 = alpha * alpha;
    let q = h.z * h.z * (a2 - 1.0) + 1.0;
    let g = |c: f32| 1.0 / (c + (a2 + (1.0 - a2) * c * c).sqrt());
    let specular = a2 / (PI * q * q) * g(nl) * g(nv);
    let x = 1.0 - v.dot(h);
    let x2 = x * x;
    let x5 = x2 * x2 * x;
    let metal = base + (Vec3::ONE - base) * x5;
    let f = 0.04 + 0.96 * x5;
    let dielectric = base * ((1.0 - f) * FRAC_1_PI) + f * specular;
    (metal * (specular * metallic) + dielectric * (1.0 - metallic)) * nl
}
