//! The lecture's illumination equation, exactly as the lecture has it:
//!
//! ```text
//! L_o = k_a k_d + [ k_d (n·l) + k_s (v·r)^q ] L_i / r²
//! ```
//!
//! with its Blinn-Torrance variant, `(n·h)^q` for `(v·r)^q`, and the point light without the specular term.
//!
//! # These are not BRDFs
//!
//! Read as a BRDF, the bracket is `f_r (n·l)`, so `f_r = k_d + k_s (v·r)^q / (n·l)`:
//!
//! - **Energy.** There is no `1/π` and no normalisation. With `k_d = 1` a surface sends out π times what it receives;
//!   the highlight adds `2π k_s/(q + 1)` at normal incidence. With `k_d = k_s = 1`, `q = 1`, the albedo is 2π.
//! - **Reciprocity.** The specular term is not multiplied by the cosine, so `f_r` is divided by it: exchanging `l` and
//!   `v` changes the value by the factor `(n·v)/(n·l)`, without bound.
//! - **The horizon.** A highlight seen at grazing incidence does not fade; it is cut off where the light sets.
//!
//! The first is a matter of units: if `L_i` stands for `I/π`, `k_d` is an albedo and the equation is [`Lambert`] plus a
//! highlight `k_s/π (v·r)^q`. That reading is what [`PhongHighlight`] and [`BlinnTorranceHighlight`] are for, and how
//! old material files are meant. The other two remain. The normalised, reciprocal lobes are [`crate::Phong`] and
//! [`crate::BlinnPhong`].
//!
//! Vectors here are in world space and of unit length: `n` the normal, `l` to the light, `v` to the viewer.
//!
//! ```
//! use lobe::illumination::{BlinnTorrance, Phong};
//! use lobe::{PointLight, Rgb, Shininess, Vec3};
//!
//! let red = Phong { ka: Rgb::splat(0.1), kd: Rgb::new(0.6, 0.1, 0.1), ks: Rgb::splat(0.4), q: Shininess(20.0_f32) };
//! let (point, n, v) = (Vec3::default(), Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.6, 0.8));
//! let light = PointLight::new(Vec3::new(0.0, -3.0, 4.0), Rgb::splat(50.0)).at(point);
//! let seen = red.radiance(n, light.l, v, light.irradiance);
//! assert!(seen.r > seen.g);
//! # let variant = BlinnTorrance { ka: red.ka, kd: red.kd, ks: red.ks, q: red.q };
//! # assert!(variant.radiance(n, light.l, v, light.irradiance).r > 0.0);
//! ```

use crate::brdf::power::{self, Shininess};
use crate::brdf::{Brdf, Lambert, Sum, above_horizon};
use crate::carry::carry;
use crate::color::Rgb;
use crate::number::Real;
use crate::vector::{Vec3, mirror};
use core::f64::consts::FRAC_1_PI;

/// `L_o = k_a k_d + k_d (n·l) L_i/r²`: ambient and diffuse light, no highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse<R = f32> {
    /// The ambient coefficient `k_a`.
    pub ka: Rgb<R>,
    /// The diffuse coefficient `k_d`.
    pub kd: Rgb<R>,
}

/// `L_o = k_a k_d + [k_d (n·l) + k_s (v·r)^q] L_i/r²`, with `r` the mirror direction of `l`.
///
/// Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong<R = f32> {
    /// The ambient coefficient `k_a`.
    pub ka: Rgb<R>,
    /// The diffuse coefficient `k_d`.
    pub kd: Rgb<R>,
    /// The specular coefficient `k_s`.
    pub ks: Rgb<R>,
    /// The exponent `q`.
    pub q: Shininess<R>,
}

/// `L_o = k_a k_d + [k_d (n·l) + k_s (n·h)^q] L_i/r²`, with `h` halfway between `l` and `v`.
///
/// Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977, after Torrance and Sparrow.
/// It is what MTL files call `illum 2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlinnTorrance<R = f32> {
    /// The ambient coefficient `k_a`.
    pub ka: Rgb<R>,
    /// The diffuse coefficient `k_d`.
    pub kd: Rgb<R>,
    /// The specular coefficient `k_s`.
    pub ks: Rgb<R>,
    /// The exponent `q`.
    pub q: Shininess<R>,
}

impl<R: Real> Diffuse<R> {
    /// The ambient term, `k_a k_d`: the same for any number of lights, to be added once.
    #[inline(always)]
    pub fn ambient(&self) -> Rgb<R> {
        self.ka * self.kd
    }

    /// The bracket for one light, `k_d (n·l)`; 0 where `n·l ≤ 0`.
    #[inline(always)]
    pub fn reflected(&self, n: Vec3<R>, l: Vec3<R>) -> Rgb<R> {
        let n_dot_l = n.dot(l);
        self.kd * n_dot_l.max(n_dot_l.lift(0.0))
    }

    /// The whole equation for one light; `irradiance` is `L_i/r²`.
    #[inline(always)]
    pub fn radiance(&self, n: Vec3<R>, l: Vec3<R>, irradiance: Rgb<R>) -> Rgb<R> {
        self.ambient() + self.reflected(n, l) * irradiance
    }
}

impl<R: Real> Phong<R> {
    /// The ambient term, `k_a k_d`: the same for any number of lights, to be added once.
    #[inline(always)]
    pub fn ambient(&self) -> Rgb<R> {
        self.ka * self.kd
    }

    /// The bracket for one light, `k_d (n·l) + k_s max(0, v·r)^q`; 0 where `n·l ≤ 0`.
    #[inline(always)]
    pub fn reflected(&self, n: Vec3<R>, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let n_dot_l = n.dot(l);
        let one_minus_cos = (mirror(l, n) - v).length_squared().times(0.5);
        let (zero, q) = (n_dot_l.lift(0.0), self.q.0);
        let zero_or_nan = (one_minus_cos * q).times(0.0);
        let power = power::mirror_power(one_minus_cos, q, n_dot_l.gt(zero)) + zero_or_nan;
        self.kd * n_dot_l.max(zero) + self.ks * power
    }

    /// The whole equation for one light; `irradiance` is `L_i/r²`.
    #[inline(always)]
    pub fn radiance(&self, n: Vec3<R>, l: Vec3<R>, v: Vec3<R>, irradiance: Rgb<R>) -> Rgb<R> {
        self.ambient() + self.reflected(n, l, v) * irradiance
    }

    /// The bracket as a sum of lobes, for light given as `I = π L_i`.
    #[inline(always)]
    pub fn lobes(&self) -> Sum<Lambert<R>, PhongHighlight<R>> {
        Lambert::new(self.kd) + PhongHighlight::new(self.ks, self.q)
    }
}

impl<R: Real> BlinnTorrance<R> {
    /// The ambient term, `k_a k_d`: the same for any number of lights, to be added once.
    #[inline(always)]
    pub fn ambient(&self) -> Rgb<R> {
        self.ka * self.kd
    }

    /// The bracket for one light, `k_d (n·l) + k_s max(0, n·h)^q`; 0 where `n·l ≤ 0`.
    #[inline(always)]
    pub fn reflected(&self, n: Vec3<R>, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let n_dot_l = n.dot(l);
        let (zero, q) = (n_dot_l.lift(0.0), self.q.0);
        let s = (l + v) * q.lift(R::SCALE);
        let n_dot_s = n.dot(s);
        let zero_or_nan = (n_dot_s * q).times(0.0);
        let visible = n_dot_l.gt(zero) & n_dot_s.gt(zero);
        let power = power::half_vector_power(n.cross(s).length_squared(), n_dot_s.squared(), q, visible) + zero_or_nan;
        self.kd * n_dot_l.max(zero) + self.ks * power
    }

    /// The whole equation for one light; `irradiance` is `L_i/r²`.
    #[inline(always)]
    pub fn radiance(&self, n: Vec3<R>, l: Vec3<R>, v: Vec3<R>, irradiance: Rgb<R>) -> Rgb<R> {
        self.ambient() + self.reflected(n, l, v) * irradiance
    }

    /// The bracket as a sum of lobes, for light given as `I = π L_i`.
    #[inline(always)]
    pub fn lobes(&self) -> Sum<Lambert<R>, BlinnTorranceHighlight<R>> {
        Lambert::new(self.kd) + BlinnTorranceHighlight::new(self.ks, self.q)
    }
}

/// One of the lecture's highlights as a lobe of the local frame.
macro_rules! highlight {
    ($(#[$doc:meta])* $name:ident, $lobe:path) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<R = f32> {
            ks: Rgb<R>,
            q: Shininess<R>,
        }

        carry!([] $name<f32> => $name<S> { ks, q });

        impl<R: Real> $name<R> {
            /// The highlight with coefficient `k_s` and exponent `q`.
            #[inline(always)]
            pub fn new(ks: Rgb<R>, q: Shininess<R>) -> Self {
                Self { ks, q }
            }

            /// The coefficient `k_s`.
            #[inline(always)]
            pub fn ks(&self) -> Rgb<R> {
                self.ks
            }

            /// The exponent `q`.
            #[inline(always)]
            pub fn shininess(&self) -> Shininess<R> {
                self.q
            }

            /// The same highlight in another number type.
            #[inline(always)]
            pub fn map<S: Real>(self, f: impl Fn(R) -> S) -> $name<S> {
                $name::new(self.ks.map(&f), self.q.map(&f))
            }

            #[inline(always)]
            fn power(&self, l: Vec3<R>, v: Vec3<R>) -> R {
                // The lobe loses a NaN in `q`; no factor has it here.
                ($lobe(l, v, self.q.0) + self.q.0.times(0.0)).times(FRAC_1_PI)
            }
        }

        impl<R: Real> Brdf<R> for $name<R> {
            /// `eval_cos / (n·l)`: without bound towards the horizon of the light.
            #[inline(always)]
            fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
                // Selected once more: on the horizon itself the quotient is 0/0.
                self.ks * above_horizon(l, v, self.power(l, v) / l.z)
            }

            #[inline(always)]
            fn eval_cos(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
                self.ks * self.power(l, v)
            }
        }
    };
}

highlight! {
    /// The lecture's Phong highlight as a lobe: `f_r (n·l) = k_s/π · max(0, v·r)^q`.
    ///
    /// **Not a BRDF**: not reciprocal (`f(l, v) (n·l) = f(v, l) (n·v)`), and its albedo at normal incidence is
    /// `2 k_s/(q + 1)`, above 1 for `k_s = 1`, `q < 1`. See the [module](self) and [`crate::Phong`].
    PhongHighlight, power::mirror_lobe
}

highlight! {
    /// The lecture's Blinn-Torrance highlight as a lobe: `f_r (n·l) = k_s/π · (n·h)^q`.
    ///
    /// **Not a BRDF**: not reciprocal (`f(l, v) (n·l) = f(v, l) (n·v)`), and its albedo at normal incidence is
    /// `8 k_s (1 − 2^(−(q+2)/2))/(q + 2)`, above 1 for `k_s = 1`, `q < 5.38`. See the [module](self) and
    /// [`crate::BlinnPhong`].
    BlinnTorranceHighlight, power::half_vector_lobe
}
