//! Every scalar kernel of `lobe` as a function of its own: what `tests/assembly.rs` of `lobe` reads, and what the
//! `no_std` build compiles for bare metal.
//!
//! ```text
//! cargo rustc --release -p lobe-kernels -- --emit asm
//! ```

#![no_std]

use lobe::distribution::{Beckmann, Ggx};
use lobe::fresnel::Schlick;
use lobe::illumination::{BlinnTorrance, BlinnTorranceHighlight, Diffuse, Phong as LecturePhong, PhongHighlight};
use lobe::masking::{SmithCorrelated, SmithSeparable, VCavity};
use lobe::{
    Black, BlinnPhong, Brdf, Coat, CommonNormalization, Delta, Frame, Incident, Lambert, MetallicRoughness, Microfacet,
    Mirror, Phong, PointLight, Real, Rgb, Sum, Vec3,
};

macro_rules! kernels {
    ($($name:ident: $lobe:ty;)+) => {$(
        /// `eval` and `eval_cos` of one lobe, for one pair of directions.
        pub mod $name {
            use super::*;
            /// `f_r(l, v)`.
            #[inline(never)]
            pub fn eval(lobe: &$lobe, l: &Vec3, v: &Vec3) -> Rgb {
                lobe.eval(*l, *v)
            }
            /// `f_r(l, v) (n·l)`.
            #[inline(never)]
            pub fn eval_cos(lobe: &$lobe, l: &Vec3, v: &Vec3) -> Rgb {
                lobe.eval_cos(*l, *v)
            }
        }
    )+};
}

kernels! {
    lambert: Lambert;
    phong: Phong;
    blinn_phong: BlinnPhong;
    blinn_phong_common: BlinnPhong<f32, CommonNormalization>;
    phong_highlight: PhongHighlight;
    blinn_torrance_highlight: BlinnTorranceHighlight;
    lambert_and_blinn_phong: Sum<Lambert, BlinnPhong>;
    lambert_and_black: Sum<Lambert, Black>;
    blinn_phong_and_black: Sum<BlinnPhong, Black>;
    microfacet_ggx: Microfacet<Ggx, SmithCorrelated, Schlick>;
    microfacet_v_cavity: Microfacet<Beckmann, VCavity, Schlick>;
    microfacet_metallic_roughness: MetallicRoughness;
    microfacet_coat: Coat<Microfacet<Ggx, SmithSeparable, Schlick>, Schlick, Lambert>;
}

/// The rest of the core.
pub mod core_functions {
    use super::*;
    /// `exp2`.
    #[inline(never)]
    pub fn exp2(x: f32) -> f32 {
        Real::exp2(x)
    }
    /// `log2`.
    #[inline(never)]
    pub fn log2(x: f32) -> f32 {
        Real::log2(x)
    }
    /// `log2_1p`.
    #[inline(never)]
    pub fn log2_1p(x: f32) -> f32 {
        Real::log2_1p(x)
    }
    /// `pow`.
    #[inline(never)]
    pub fn pow(x: f32, y: f32) -> f32 {
        Real::pow(x, y)
    }
    /// `sin_cos`.
    #[inline(never)]
    pub fn sin_cos(x: f32) -> (f32, f32) {
        Real::sin_cos(x)
    }
    /// `reflect`.
    #[inline(never)]
    pub fn reflect(d: &Vec3, n: &Vec3) -> Vec3 {
        lobe::reflect(*d, *n)
    }
    /// `halfway`.
    #[inline(never)]
    pub fn halfway(l: &Vec3, v: &Vec3) -> Vec3 {
        lobe::halfway(*l, *v)
    }
    /// `normalize`.
    #[inline(never)]
    pub fn normalize(v: &Vec3) -> Vec3 {
        v.normalize()
    }
    /// `Frame::from_normal`.
    #[inline(never)]
    pub fn from_normal(n: &Vec3) -> Frame {
        Frame::from_normal(*n)
    }
    /// `Frame::from_normal_tangent`.
    #[inline(never)]
    pub fn from_normal_tangent(n: &Vec3, t: &Vec3) -> Frame {
        Frame::from_normal_tangent(*n, *t)
    }
    /// `interpolate_normal`.
    #[inline(never)]
    pub fn interpolate_normal(n: &[Vec3; 3], w: &[f32; 3], fallback: &Vec3) -> Vec3 {
        lobe::interpolate_normal(*n, *w, *fallback)
    }
    /// `PointLight::at`.
    #[inline(never)]
    pub fn point_light(light: &PointLight, p: &Vec3) -> Incident {
        light.at(*p)
    }
    /// `Mirror::reflect`.
    #[inline(never)]
    pub fn mirror(mirror: &Mirror, v: &Vec3) -> Delta {
        mirror.reflect(*v)
    }
    /// The lecture's equation without the highlight.
    #[inline(never)]
    pub fn lecture_diffuse(m: &Diffuse, n: &Vec3, l: &Vec3, e: &Rgb) -> Rgb {
        m.radiance(*n, *l, *e)
    }
    /// The lecture's equation.
    #[inline(never)]
    pub fn lecture_phong(m: &LecturePhong, n: &Vec3, l: &Vec3, v: &Vec3, e: &Rgb) -> Rgb {
        m.radiance(*n, *l, *v, *e)
    }
    /// Its Blinn-Torrance variant.
    #[inline(never)]
    pub fn lecture_blinn_torrance(m: &BlinnTorrance, n: &Vec3, l: &Vec3, v: &Vec3, e: &Rgb) -> Rgb {
        m.radiance(*n, *l, *v, *e)
    }
}
