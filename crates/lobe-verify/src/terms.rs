//! The terms of microfacet models, each alone: `D`, `G₁` and `F` in `f32` against `f64` of the same inputs.
//!
//! Here the half vector is an input, not something that is rounded on the way: what remains is the error of the term.

use crate::extremes::{Random, tilted, unit};
use crate::ulp::{Summary, summary};
use lobe::distribution::{Beckmann, Distribution, Gaussian, Ggx, Gtr, PhongPower, SmithLambda, SmithTable, StudentT};
use lobe::fresnel::{Conductor, CookFresnel, Dielectric, F82Tint, Fresnel, Gulbrandsen, Incidence, Lazanyi, Schlick};
use lobe::{Alpha, Ior, Real, Rgb, Vec3};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// `u`, half a step of `f32` at 1.
const U: f64 = 1.0 / 16_777_216.0;
/// `126 ln 2`: below this depth under the peak a distribution is 0.
const DARK: f64 = 87.3;

/// One value of a term.
#[derive(Clone, Debug)]
struct Sample {
    value: f32,
    exact: f64,
    /// The relative error that is allowed; not finite where the bound says nothing.
    allowed: f64,
    /// Of `α`, `γ`, `η` and what else the term takes.
    parameters: Vec<f32>,
    direction: Vec3,
}

/// A term and what was found.
#[derive(Clone, Debug)]
pub struct Term {
    /// `D`, `G1` or `F`, and the name.
    pub name: &'static str,
    /// Its bound, `u` = 2⁻²⁴, as its documentation derives it.
    pub bound: &'static str,
    /// What the parameters of the worst input are.
    pub parameters: &'static str,
    /// How many values were compared.
    pub compared: usize,
    /// Their relative errors.
    pub errors: Summary,
    /// The largest error as a part of what is allowed there.
    pub part: f64,
    /// Where that was.
    pub worst: String,
    /// Values outside `[0, 1]`, for `D` below 0; NaN counts.
    pub outside: usize,
}

impl Term {
    /// Whether every value is within its bound and inside its range.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.part <= 1.0 && self.outside == 0
    }
}

type Draw = fn(&mut Random) -> Sample;

/// A width, even over its decades, and one up to 16 times as large or small; every fourth time the same.
fn widths(random: &mut Random) -> (f32, f32) {
    let x = random.step(-4.0, 0.0).abs();
    let y = if random.below(4) == 0 { x } else { (x * 16_f64.powf(random.between(-1.0, 1.0))).clamp(1e-4, 1.0) };
    ((x as f32).clamp(1e-4, 1.0), (y as f32).clamp(1e-4, 1.0))
}

/// A half vector: at a tilt of a thousandth to a hundred times the width, anywhere, or towards the horizon.
fn half_vector(width: f32, random: &mut Random) -> Vec3 {
    let phi = random.between(0.0, TAU);
    match random.below(8) {
        0..5 => {
            let h = tilted((f64::from(width) * random.step(-3.0, 2.0).abs()).atan(), phi);
            Vec3::new(h.x as f32, h.y as f32, h.z as f32)
        }
        5 | 6 => unit(random.unit(), phi),
        _ => unit(random.step(-20.0, 0.0).abs(), phi),
    }
}

/// `D` of a distribution in both number types; `allowed` gets `|ln(D/D_max)|`.
fn d_term(
    (single, double): (impl Distribution<f32>, impl Distribution<f64>),
    h: Vec3,
    parameters: Vec<f32>,
    allowed: impl Fn(f64) -> f64,
) -> Sample {
    let exact = double.d(h.map(f64::from));
    let depth = (exact / double.d(Vec3::new(0.0, 0.0, 1.0))).ln().abs();
    let allowed = if depth > DARK || exact < 1e-37 { f64::INFINITY } else { allowed(depth) };
    Sample { value: single.d(h), exact, allowed, parameters, direction: h }
}

fn two<T>(x: f32, y: f32, of: impl Fn(Alpha<f32>, Alpha<f32>) -> T) -> T {
    of(Alpha(x), Alpha(y))
}

fn wide(x: f32) -> Alpha<f64> {
    Alpha(f64::from(x))
}

fn g1_term(
    (single, double): (impl SmithLambda<f32>, impl SmithLambda<f64>),
    allowed: f64,
    parameters: Vec<f32>,
    random: &mut Random,
) -> Sample {
    let phi = random.between(0.0, TAU);
    let w = match random.below(4) {
        0 | 1 => unit(random.between(0.01, 1.0), phi),
        2 => unit(random.step(-20.0, 0.0).abs(), phi),
        _ => half_vector(0.1, random),
    };
    Sample { value: single.g1(w), exact: double.g1(w.map(f64::from)), allowed, parameters, direction: w }
}

/// A colour with all channels the same.
fn grey<R: Real>(x: R) -> Rgb<R> {
    Rgb { r: x, g: x, b: x }
}

fn f_term(
    (single, double): (impl Fresnel<f32>, impl Fresnel<f64>),
    parameters: Vec<f32>,
    random: &mut Random,
    allowed: impl Fn(Incidence<f64>, f64) -> f64,
) -> Sample {
    let phi = random.between(0.0, TAU);
    let w = match random.below(4) {
        0 | 1 => unit(random.between(0.0, 1.0), phi),
        2 => unit(random.step(-19.0, 0.0).abs(), phi),
        _ => half_vector(1.0, random),
    };
    let incidence = Incidence::of(w);
    // The same two numbers, so that the error is that of the term.
    let exactly = Incidence::new(f64::from(incidence.cos), f64::from(incidence.sin2));
    let exact = double.fresnel(exactly).g;
    let allowed = if exact < 1e-30 { f64::INFINITY } else { allowed(exactly, exact) };
    Sample { value: single.fresnel(incidence).g, exact, allowed, parameters, direction: w }
}

/// In [0, 1], with a lean towards both ends.
fn fraction(random: &mut Random) -> f32 {
    let x = match random.below(4) {
        0 => random.step(-6.0, 0.0).abs(),
        1 => 1.0 - random.step(-6.0, 0.0).abs(),
        _ => random.unit(),
    };
    x as f32
}

fn schlick(f0: f32, cos: Incidence<f64>) -> f64 {
    let f0 = f64::from(f0);
    f0 + (1.0 - f0) * cos.one_minus_cos.powi(5)
}

/// Name, bound, parameters, and how to draw a value; whether it ends at 1.
const TERMS: [(&str, &str, &str, bool, Draw); 17] = [
    ("D ggx", "1e-6", "αx, αy", false, |random| {
        let (x, y) = widths(random);
        let both = (two(x, y, Ggx::anisotropic), Ggx::anisotropic(wide(x), wide(y)));
        d_term(both, half_vector(x, random), vec![x, y], |_| 1e-6)
    }),
    ("D beckmann", "u (15 + 10 t), t = tan²θ/α²", "αx, αy", false, |random| {
        let (x, y) = widths(random);
        let both = (two(x, y, Beckmann::anisotropic), Beckmann::anisotropic(wide(x), wide(y)));
        let h = half_vector(x, random);
        let slope = |w: f32, alpha: f32| f64::from(w) / f64::from(alpha) / f64::from(h.z);
        let t = slope(h.x, x).powi(2) + slope(h.y, y).powi(2);
        // The exponential ends before its quotient by cos⁴ does.
        let allowed = if t > DARK { f64::INFINITY } else { U * (15.0 + 10.0 * t) };
        d_term(both, h, vec![x, y], |_| allowed)
    }),
    ("D blinn", "u (8 + 20 L), L = |ln(D/D_max)|", "αx, αy", false, |random| {
        let (x, y) = widths(random);
        let both = (two(x, y, PhongPower::anisotropic), PhongPower::anisotropic(wide(x), wide(y)));
        d_term(both, half_vector(x, random), vec![x, y], |depth| U * (8.0 + 20.0 * depth))
    }),
    ("D gtr", "u (25 + 12 γ)", "αx, αy, γ", false, |random| {
        let ((x, y), gamma) = (widths(random), random.between(0.5, 5.0) as f32);
        let both =
            (two(x, y, |x, y| Gtr::anisotropic(x, y, gamma)), Gtr::anisotropic(wide(x), wide(y), f64::from(gamma)));
        d_term(both, half_vector(x, random), vec![x, y, gamma], |_| U * (25.0 + 12.0 * f64::from(gamma)))
    }),
    ("D gaussian", "u (24 + 20 L)", "αx, αy", false, |random| {
        let (x, y) = widths(random);
        let both = (two(x, y, Gaussian::anisotropic), Gaussian::anisotropic(wide(x), wide(y)));
        d_term(both, half_vector(x, random), vec![x, y], |depth| U * (24.0 + 20.0 * depth))
    }),
    ("D student-t", "u (20 + 10 γ)", "αx, αy, γ", false, |random| {
        let ((x, y), gamma) = (widths(random), random.between(1.6, 40.0) as f32);
        let both = (
            two(x, y, |x, y| StudentT::anisotropic(x, y, gamma)),
            StudentT::anisotropic(wide(x), wide(y), f64::from(gamma)),
        );
        d_term(both, half_vector(x, random), vec![x, y, gamma], |_| U * (20.0 + 10.0 * f64::from(gamma)))
    }),
    ("G1 ggx", "1e-6", "αx, αy", true, |random| {
        let (x, y) = widths(random);
        let both = (two(x, y, Ggx::anisotropic), Ggx::anisotropic(wide(x), wide(y)));
        g1_term(both, 1e-6, vec![x, y], random)
    }),
    ("G1 beckmann", "1e-6", "αx, αy", true, |random| {
        let (x, y) = widths(random);
        let both = (two(x, y, Beckmann::anisotropic), Beckmann::anisotropic(wide(x), wide(y)));
        g1_term(both, 1e-6, vec![x, y], random)
    }),
    ("G1 blinn, tabulated", "4e-6", "α", true, |random| {
        let x = widths(random).0;
        let single: SmithTable<_, f32> = SmithTable::new(PhongPower::new(Alpha(x)), Alpha(x));
        let double: SmithTable<_, f64> = SmithTable::new(PhongPower::new(wide(x)), wide(x));
        g1_term((single, double), 4e-6, vec![x], random)
    }),
    ("G1 student-t, tabulated", "4e-6", "α, γ", true, |random| {
        let (x, gamma) = (widths(random).0, random.between(1.6, 40.0) as f32);
        let single: SmithTable<_, f32> = SmithTable::new(StudentT::new(Alpha(x), gamma), Alpha(x));
        let double: SmithTable<_, f64> = SmithTable::new(StudentT::new(wide(x), f64::from(gamma)), wide(x));
        g1_term((single, double), 4e-6, vec![x, gamma], random)
    }),
    ("F dielectric, η ≥ 1", "1e-6", "η", true, |random| {
        let eta = if random.bits() & 1 == 0 { 1.0 + random.step(-6.0, 0.4).abs() } else { random.between(1.0, 4.0) };
        let eta = (eta as f32).clamp(1.0, 4.0);
        let both = (Dielectric::new(Ior(eta)), Dielectric::new(Ior(f64::from(eta))));
        f_term(both, vec![eta], random, |_, _| 1e-6)
    }),
    ("F conductor, η ≥ 1 or k ≥ 1", "1e-6", "η, k", true, |random| {
        let (eta, k) = (random.between(0.0, 4.0) as f32, random.between(0.0, 10.0) as f32);
        let eta = if k < 1.0 { eta.max(1.0) } else { eta };
        let both = (Conductor::new(grey(eta), grey(k)), Conductor::new(grey(f64::from(eta)), grey(f64::from(k))));
        f_term(both, vec![eta, k], random, |_, _| 1e-6)
    }),
    ("F cook, from F0", "1.5e-6", "F0", true, |random| {
        let f0 = fraction(random);
        let both = (CookFresnel::new(grey(f0)), CookFresnel::new(grey(f64::from(f0))));
        f_term(both, vec![f0], random, |_, _| 1.5e-6)
    }),
    ("F schlick", "1e-6", "f0, f90", true, |random| {
        let (f0, f90) = (fraction(random), fraction(random));
        let both =
            (Schlick::with_f90(grey(f0), grey(f90)), Schlick::with_f90(grey(f64::from(f0)), grey(f64::from(f90))));
        f_term(both, vec![f0, f90], random, |_, _| 1e-6)
    }),
    ("F gulbrandsen", "1.5e-6", "r, g", true, |random| {
        let (r, g) = (fraction(random), fraction(random));
        let both = (Gulbrandsen::new(grey(r), grey(g)), Gulbrandsen::new(grey(f64::from(r)), grey(f64::from(g))));
        f_term(both, vec![r, g], random, |_, _| 1.5e-6)
    }),
    ("F f82-tint", "1e-6 S/F, S Schlick's part", "f0, tint", true, |random| {
        let (f0, tint) = (fraction(random), fraction(random));
        let both = (F82Tint::new(grey(f0), grey(tint)), F82Tint::new(grey(f64::from(f0)), grey(f64::from(tint))));
        f_term(both, vec![f0, tint], random, |at, f| 1e-6 * schlick(f0, at) / f)
    }),
    ("F lazanyi", "1e-6 (S + a cos θ (1 − cos θ)^α)/F", "f0, a, α", true, |random| {
        let (f0, a) = (fraction(random), random.between(0.0, 4.0) as f32);
        let alpha = random.between(1.0, 10.0) as f32;
        let both = (
            Lazanyi::new(grey(f0), grey(a), alpha),
            Lazanyi::new(grey(f64::from(f0)), grey(f64::from(a)), f64::from(alpha)),
        );
        f_term(both, vec![f0, a, alpha], random, |at, f| {
            let less = f64::from(a) * at.cos * at.one_minus_cos.powf(f64::from(alpha));
            1e-6 * (schlick(f0, at) + less) / f
        })
    }),
];

/// Tries every term with this many random inputs of its whole domain; the same numbers every time.
#[must_use]
pub fn terms(tries: usize) -> Vec<Term> {
    TERMS
        .par_iter()
        .map(|&(name, bound, parameters, ends_at_one, draw)| {
            let mut random = Random::new(name.len() as u64 + 17);
            // A table is integrated for each value.
            let tries = if name.contains("tabulated") { tries / 200 } else { tries };
            let (mut errors, mut outside) = (Vec::with_capacity(tries), 0);
            let (mut part, mut worst) = (0.0, String::new());
            for _ in 0..tries {
                let sample = draw(&mut random);
                let inside = sample.value >= 0.0 && (!ends_at_one || sample.value <= 1.0);
                outside += usize::from(!inside);
                if !sample.allowed.is_finite() {
                    continue;
                }
                let error = if f64::from(sample.value) == sample.exact {
                    0.0
                } else {
                    (f64::from(sample.value) - sample.exact).abs() / sample.exact
                };
                errors.push(error);
                if error > part * sample.allowed {
                    part = error / sample.allowed;
                    worst = described(parameters, &sample);
                }
            }
            let compared = errors.len();
            Term { name, bound, parameters, compared, errors: summary(&mut errors), part, worst, outside }
        })
        .collect()
}

fn described(parameters: &str, sample: &Sample) -> String {
    let list = |numbers: &[f32]| numbers.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(", ");
    let mut text = String::new();
    let direction = <[f32; 3]>::from(sample.direction);
    let _ = write!(text, "{parameters} = {} at {}", list(&sample.parameters), list(&direction));
    let _ = write!(text, ": {:?}, exactly {:?}", sample.value, sample.exact);
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_term_keeps_its_bound() {
        for term in terms(20_000) {
            assert!(term.holds(), "{term:?}");
            assert!(term.compared >= 100, "{term:?}");
        }
    }
}
