//! The GGX distribution as it is written elsewhere, each form in `f32` and in binary16 against `f64` of the same inputs.
//!
//! All forms are equal on paper. They get the same half vector, `(l + v)/|l + v|` in `f32`; what is exact comes from `l`
//! and `v` in `f64`.

use crate::extremes::{Random, across, tilted, unit};
use crate::ulp::{Summary, summary};
use lobe::distribution::{Distribution as _, Ggx};
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf as _, Half, Microfacet, Real, Rgb, Vec3};
use std::f64::consts::{FRAC_1_PI, TAU};

/// The widths that are compared.
pub const WIDTHS: [f32; 4] = [0.1, 0.01, 1e-3, 1e-4];

/// The widths that are compared in binary16.
pub const WIDTHS_IN_HALF: [f32; 5] = [0.3, 0.1, 0.03, 0.01, 3e-3];

/// One way to write `D`.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    /// Whose it is.
    pub name: &'static str,
    /// The equation.
    pub equation: &'static str,
    /// `D(h)` in `f32` for a width.
    pub d: fn(Vec3, f32) -> f32,
    /// The same in binary16.
    pub half: fn(Vec3<Half>, Half) -> Half,
}

/// A form from one function that is generic over the number type.
macro_rules! form {
    ($name:literal, $equation:literal, $d:ident) => {
        Form { name: $name, equation: $equation, d: $d, half: $d }
    };
}

/// All forms.
pub const FORMS: [Form; 5] = [
    form!("lobe", "1/(π α² ((h.x/α)² + (h.y/α)² + h.z²)²)", ours),
    form!("Filament", "k²/π, k = α/((n × h)² + (α n·h)²)", filament),
    form!("glTF, appendix B", "α²/(π ((n·h)² (α² − 1) + 1)²)", gltf),
    form!("Walter 2007, tan² from n·h", "α²/(π cos⁴ (α² + tan²)²)", walter),
    form!("pbrt", "1/(π α² cos⁴ (1 + e)²), e = tan² (cos²φ + sin²φ)/α²", pbrt),
];

fn ours<R: Real>(h: Vec3<R>, alpha: R) -> R {
    Ggx::new(Alpha(alpha)).d(h)
}

/// Guy and Agopian, *Physically Based Rendering in Filament*, the form for `mediump`.
fn filament<R: Real>(h: Vec3<R>, alpha: R) -> R {
    let cross2 = h.x * h.x + h.y * h.y;
    let a = h.z * alpha;
    let k = alpha / (cross2 + a * a);
    (k * k).times(FRAC_1_PI)
}

/// Khronos, *glTF 2.0 Specification*, appendix B.3.2.
fn gltf<R: Real>(h: Vec3<R>, alpha: R) -> R {
    let a2 = alpha * alpha;
    let f = (h.z * h.z * a2.plus(-1.0)).plus(1.0);
    a2.times(FRAC_1_PI) / (f * f)
}

/// Walter et al. 2007, equation 33, with the tangent from the cosine.
fn walter<R: Real>(h: Vec3<R>, alpha: R) -> R {
    let (a2, c2) = (alpha * alpha, h.z * h.z);
    let sum = a2 + (-c2).plus(1.0) / c2;
    a2.times(FRAC_1_PI) / (c2 * c2 * sum * sum)
}

/// Pharr, Jakob and Humphreys, *Physically Based Rendering*, 4th edition, section 9.6.1: `sin²` is `1 − cos²`.
fn pbrt<R: Real>(h: Vec3<R>, alpha: R) -> R {
    let (zero, one) = (alpha.lift(0.0), alpha.lift(1.0));
    let c2 = h.z * h.z;
    let s2 = (one - c2).max(zero);
    let (tan2, sin) = (s2 / c2, s2.sqrt());
    let upright = sin.eq(zero);
    let clamp = |x: R| x.max(-one).min(one);
    let cos_phi = R::select(upright, one, clamp(h.x / sin));
    let sin_phi = R::select(upright, zero, clamp(h.y / sin));
    let e = tan2 * ((cos_phi / alpha) * (cos_phi / alpha) + (sin_phi / alpha) * (sin_phi / alpha));
    let sum = one + e;
    let d = one.times(FRAC_1_PI) / (alpha * alpha * c2 * c2 * sum * sum);
    R::select((c2 * c2).lt(c2.lift(1e-16)), zero, d)
}

/// The errors of one form, or of the whole lobe, at each of [`WIDTHS`].
#[derive(Clone, Debug)]
pub struct Row {
    /// Whose.
    pub name: &'static str,
    /// The equation.
    pub equation: &'static str,
    /// Relative errors.
    pub errors: [Summary; 4],
}

/// How many pairs of directions each width is tried with.
pub const PAIRS: usize = 200_000;

/// Directions with a half vector from a hundredth of the width of the distribution to ten times it, at incidences up to
/// 80°: where a picture shows the lobe.
fn pairs(alpha: f32) -> impl Iterator<Item = (Vec3, Vec3)> {
    let mut random = Random::new(7);
    (0..PAIRS).map(move |_| {
        let v = unit(random.between(0.17, 1.0), random.between(0.0, TAU));
        let tilt = (f64::from(alpha) * random.step(-2.0, 1.0).abs()).atan();
        (across(v, tilted(tilt, random.between(0.0, TAU))), v)
    })
}

/// `D` of the half vector, all in `f64`.
fn exact<R: Real + Into<f64>>(l: Vec3<R>, v: Vec3<R>, alpha: R) -> f64 {
    ours((l.map(Into::into) + v.map(Into::into)).normalize(), alpha.into())
}

/// A form in binary16: how many of a hundred values are within 1 %, and within 10 %, at each of [`WIDTHS_IN_HALF`].
#[derive(Clone, Copy, Debug)]
pub struct HalfRow {
    /// The form.
    pub form: Form,
    /// Parts of the values, for 1 % and for 10 %.
    pub within: [(f64, f64); 5],
}

/// The table in binary16. Width and directions are rounded to it first, and every form gets the half vector
/// `(l + v)/|l + v|` formed in it.
#[must_use]
pub fn compare_in_half() -> Vec<HalfRow> {
    let row = |form: Form| {
        let within = WIDTHS_IN_HALF.map(|width| {
            let alpha = Half::from(width);
            let (mut one, mut ten) = (0, 0);
            for (l, v) in pairs(width).step_by(10).map(|(l, v)| (l.map(Half::from), v.map(Half::from))) {
                let exact = exact(l, v, alpha);
                let error = (f64::from((form.half)((l + v).normalize(), alpha)) - exact).abs() / exact;
                one += usize::from(error <= 0.01);
                ten += usize::from(error <= 0.1);
            }
            let part = |count: usize| count as f64 / (PAIRS / 10) as f64;
            (part(one), part(ten))
        });
        HalfRow { form, within }
    };
    FORMS.into_iter().map(row).collect()
}

/// The table.
#[must_use]
pub fn compare() -> Vec<Row> {
    let relative = |value: f32, exact: f64| (f64::from(value) - exact).abs() / exact;
    let mut rows: Vec<Row> = FORMS
        .iter()
        .map(|form| {
            let errors = WIDTHS.map(|alpha| {
                let one = |(l, v): (Vec3, Vec3)| relative((form.d)((l + v).normalize(), alpha), exact(l, v, alpha));
                summary(&mut pairs(alpha).map(one).collect::<Vec<_>>())
            });
            Row { name: form.name, equation: form.equation, errors }
        })
        .collect();
    let errors = WIDTHS.map(|alpha| {
        let f0 = Rgb::splat(0.04_f32);
        let single = Microfacet::new(Ggx::new(Alpha(alpha)), SmithCorrelated, Schlick::new(f0));
        let wide = Alpha(f64::from(alpha));
        let double = Microfacet::new(Ggx::new(wide), SmithCorrelated, Schlick::new(f0.map(f64::from)));
        let one =
            |(l, v): (Vec3, Vec3)| relative(single.eval(l, v).g, double.eval(l.map(f64::from), v.map(f64::from)).g);
        summary(&mut pairs(alpha).map(one).collect::<Vec<_>>())
    });
    rows.push(Row { name: "lobe, the whole model", equation: "D F G/(4 (n·l)(n·v))", errors });
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On paper they are one: at a width of 1 they must agree to some digits, or one of them is written wrongly.
    #[test]
    fn all_forms_are_the_same_where_nothing_cancels() {
        for form in FORMS {
            for h in [unit(0.3, 0.4), unit(0.7, 2.0), unit(0.9, 4.0)] {
                for alpha in [0.5_f32, 0.9] {
                    let exact = f64::from((FORMS[0].d)(h, alpha));
                    let value = f64::from((form.d)(h, alpha));
                    assert!((value / exact - 1.0).abs() < 3e-6, "{}: {value} {exact}", form.name);
                }
            }
        }
    }

    #[test]
    fn ours_keeps_its_digits_and_the_cosine_alone_does_not() {
        let rows = compare();
        let worst = |name: &str| rows.iter().find(|row| row.name == name).map(|row| row.errors.map(|e| e.worst));
        assert!(worst("lobe").is_some_and(|w| w.iter().all(|&e| e < 2e-6)), "{:?}", worst("lobe"));
        assert!(worst("lobe, the whole model").is_some_and(|w| w.iter().all(|&e| e < 4e-6)));
        assert!(worst("glTF, appendix B").is_some_and(|w| w[2] > 0.01), "{:?}", worst("glTF, appendix B"));
    }

    /// The cosine of a half vector has no digits left of its tilt in binary16; the components keep them.
    #[test]
    fn ours_survives_binary16_and_the_cosine_alone_does_not() {
        let rows = compare_in_half();
        let at_a_hundredth = |name: &str| rows.iter().find(|row| row.form.name == name).map(|row| row.within[3].1);
        assert!(at_a_hundredth("lobe").is_some_and(|part| part > 0.99), "{:?}", at_a_hundredth("lobe"));
        assert!(at_a_hundredth("glTF, appendix B").is_some_and(|part| part < 0.5));
    }
}
