//! Fresnel's reflectance in all its forms: against complex arithmetic, closed forms and limits, and `f32` against `f64`.

use lobe::fresnel::{Conductor, CookFresnel, Dielectric, F82Tint, Fresnel, Gulbrandsen, Incidence, Lazanyi, Schlick};
use lobe::{F0, Ior, Rgb};
use lobe_verify::strategies::cosine;
use proptest::prelude::*;

const U: f64 = 1.0 / 16_777_216.0;

/// The angle in `f32`, both numbers rounded from the same angle, and the same two numbers in `f64`.
fn angle(cos: f64) -> (Incidence, Incidence<f64>) {
    let single = Incidence::new(cos as f32, ((1.0 - cos) * (1.0 + cos)) as f32);
    (single, Incidence::new(f64::from(single.cos), f64::from(single.sin2)))
}

/// Grazing, normal and between; exactly at the ends too.
fn incidence() -> impl Strategy<Value = f64> {
    prop_oneof![12 => cosine(), 1 => Just(0.0), 1 => Just(1.0), 1 => (-38.0..-18.0_f64).prop_map(|e| 10_f64.powf(e))]
}

fn index() -> impl Strategy<Value = f32> {
    prop_oneof![
        3 => 1.000_001_f32..4.0,
        3 => (-6.0..0.47_f64).prop_map(|e| (1.0 + 10_f64.powf(e)) as f32),
        1 => Just(1.000_001_f32),
        1 => Just(4.0_f32)
    ]
}

fn extinction() -> impl Strategy<Value = f32> {
    prop_oneof![
        3 => 0.0_f32..10.0,
        3 => (-8.0..1.0_f64).prop_map(|e| 10_f64.powf(e) as f32),
        1 => Just(0.0_f32),
        1 => Just(10.0_f32)
    ]
}

fn unit() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => 0.0_f32..1.0,
        2 => (-9.0..0.0_f64).prop_map(|e| 10_f64.powf(e) as f32),
        2 => (-7.0..0.0_f64).prop_map(|e| (1.0 - 10_f64.powf(e)) as f32),
        1 => Just(0.0_f32),
        1 => Just(1.0_f32)
    ]
}

fn grey<R: Copy>(x: R) -> Rgb<R> {
    Rgb::splat(x)
}

/// Complex numbers, as few operations as Fresnel's equations need.
#[derive(Clone, Copy)]
struct Complex(f64, f64);

impl Complex {
    fn plus(self, o: Self) -> Self {
        Self(self.0 + o.0, self.1 + o.1)
    }
    fn scaled(self, s: f64) -> Self {
        Self(self.0 * s, self.1 * s)
    }
    fn squared(self) -> Self {
        Self(self.0 * self.0 - self.1 * self.1, 2.0 * self.0 * self.1)
    }
    fn norm2(self) -> f64 {
        self.0 * self.0 + self.1 * self.1
    }
    /// The principal root, by polar coordinates.
    fn root(self) -> Self {
        let (length, angle) = (self.0.hypot(self.1).sqrt(), self.1.atan2(self.0) / 2.0);
        Self(length * angle.cos(), length * angle.sin())
    }
}

/// The amplitudes as they stand in the textbook, squared and averaged.
fn textbook(eta: f64, k: f64, cos: f64) -> f64 {
    let n2 = Complex(eta, k).squared();
    let w = n2.plus(Complex(-(1.0 - cos) * (1.0 + cos), 0.0)).root();
    let c = Complex(cos, 0.0);
    let s = c.plus(w.scaled(-1.0)).norm2() / c.plus(w).norm2();
    let p = n2.scaled(cos).plus(w.scaled(-1.0)).norm2() / n2.scaled(cos).plus(w).norm2();
    0.5 * (s + p)
}

fn close(a: f64, b: f64, tolerance: f64) -> Result<(), TestCaseError> {
    // What the smallest normal numbers cannot hold.
    prop_assert!((a - b).abs() <= tolerance * b.abs() + 1e-37, "{a:e}, not {b:e}: off by {:e}", a / b - 1.0);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn exact_forms_are_those_of_the_textbook(eta in index(), below in 0.02_f64..1.0, k in extinction(), cos in cosine()) {
        let (eta, k) = (f64::from(eta), f64::from(k));
        let at = Incidence::from_cos(cos);
        close(Dielectric::new(Ior(eta)).fresnel(at).g, textbook(eta, 0.0, cos), 1e-8)?;
        close(Conductor::new(grey(eta), grey(k)).fresnel(at).g, textbook(eta, k, cos), 1e-8)?;
        close(Conductor::new(grey(below), grey(k)).fresnel(at).g, textbook(below, k, cos), 1e-6)?;
        close(Dielectric::new(Ior(below)).fresnel(at).g, textbook(below, 0.0, cos), 1e-6)?;
    }

    #[test]
    fn a_conductor_without_extinction_is_a_dielectric(eta in index(), cos in incidence()) {
        let (at, wide) = angle(cos);
        let zero = Conductor::new(grey(eta), grey(0.0));
        close(f64::from(zero.fresnel(at).g), Dielectric::new(Ior(f64::from(eta))).fresnel(wide).g, 1.5e-6)?;
    }

    #[test]
    fn dielectric_has_its_digits(eta in index(), cos in incidence()) {
        let (at, wide) = angle(cos);
        let form = Dielectric::new(Ior(eta));
        close(f64::from(form.fresnel(at).g), form.map(f64::from).fresnel(wide).g, 1e-6)?;
    }

    /// The bound for `η < 1` that its documentation derives.
    #[test]
    fn total_reflection_has_the_error_of_its_slope(eta in 0.25_f32..1.0, near in -8.0..0.0_f64, random in cosine(), critical: bool) {
        let eta_wide = f64::from(eta);
        let cos = if critical { (1.0 - eta_wide * eta_wide).sqrt() * (1.0 + 10_f64.powf(near)) } else { random };
        prop_assume!(cos <= 1.0);
        let (at, wide) = angle(cos);
        let form = Dielectric::new(Ior(eta));
        let exact = form.map(f64::from).fresnel(wide).g;
        let ratio2 = 1.0 + (eta_wide - 1.0) * (eta_wide + 1.0) / wide.cos.powi(2);
        let ratio_error = (3.0 * U / ratio2.max(0.0).sqrt()).min((6.0 * U).sqrt());
        let bound = 1e-6 + if ratio2 > -6.0 * U { 4.0 / eta_wide.powi(2) * ratio_error } else { 0.0 };
        close(f64::from(form.fresnel(at).g), exact, bound)?;
    }

    #[test]
    fn conductor_has_its_digits(eta in index(), k in extinction(), metal in 0.01_f32..4.0, strong in 1.0_f32..10.0, cos in incidence()) {
        let (at, wide) = angle(cos);
        for form in [Conductor::new(grey(eta), grey(k)), Conductor::new(grey(metal), grey(strong))] {
            close(f64::from(form.fresnel(at).g), form.map(f64::from).fresnel(wide).g, 1e-6)?;
        }
    }

    #[test]
    fn forms_by_f0_have_their_digits(f0 in unit(), f90 in unit(), g in unit(), cos in incidence()) {
        let (at, wide) = angle(cos);
        let cook = CookFresnel::new(grey(f0));
        // The amplitude of these two has up to twelve roundings, which its square doubles: 24u.
        close(f64::from(cook.fresnel(at).g), cook.map(f64::from).fresnel(wide).g, 1.5e-6)?;
        let schlick = Schlick::with_f90(grey(f0), grey(f90));
        close(f64::from(schlick.fresnel(at).g), schlick.map(f64::from).fresnel(wide).g, 1e-6)?;
        let artistic = Gulbrandsen::new(grey(f0), grey(g));
        close(f64::from(artistic.fresnel(at).g), artistic.map(f64::from).fresnel(wide).g, 1.5e-6)?;
    }

    #[test]
    fn forms_that_subtract_have_the_digits_of_what_they_subtract_from(
        f0 in unit(), tint in unit(), a in 0.0_f32..4.0, alpha in 1.0_f32..10.0, cos in incidence()
    ) {
        let (at, wide) = angle(cos);
        let schlick = Schlick::new(grey(f64::from(f0))).fresnel(wide).g;
        let form = F82Tint::new(grey(f0), grey(tint));
        let (value, exact) = (f64::from(form.fresnel(at).g), form.map(f64::from).fresnel(wide).g);
        prop_assert!((value - exact).abs() <= 1e-6 * schlick + 1e-30, "f82: {value:e}, not {exact:e}, of {schlick:e}");
        let form = Lazanyi::new(grey(f0), grey(a), alpha);
        let (value, exact) = (f64::from(form.fresnel(at).g), form.map(f64::from).fresnel(wide).g);
        let bump = f64::from(a) * wide.cos * wide.one_minus_cos.powf(f64::from(alpha));
        prop_assert!((value - exact).abs() <= 1e-6 * schlick.max(bump) + 1e-30, "Lazányi: {value:e}, not {exact:e}");
    }

    #[test]
    fn inside_the_unit_interval(
        eta in index(), below in 0.01_f32..1.0, k in extinction(), f0 in unit(), other in unit(), a in 0.0_f32..4.0,
        alpha in 1.0_f32..10.0, cos in incidence()
    ) {
        let (at, _) = angle(cos);
        let forms: [&dyn Fresnel<f32>; 10] = [
            &Dielectric::new(Ior(eta)),
            &Dielectric::new(Ior(below)),
            &Conductor::new(grey(eta), grey(k)),
            &Conductor::new(grey(below), grey(k)),
            &CookFresnel::new(grey(f0)),
            &Schlick::new(grey(f0)),
            &Schlick::with_f90(grey(f0), grey(other)),
            &F82Tint::new(grey(f0), grey(other)),
            &Gulbrandsen::new(grey(f0), grey(other)),
            &Lazanyi::new(grey(f0), grey(a), alpha),
        ];
        for (number, form) in forms.into_iter().enumerate() {
            let f = form.fresnel(at).g;
            prop_assert!((0.0..=1.0).contains(&f), "{number}: {f:e}");
        }
    }

    /// Gulbrandsen's two promises: `r` is the reflectance at normal incidence, and `η` is his equation.
    #[test]
    fn gulbrandsen_keeps_his_promises(r in 1e-6_f64..0.999, g in 0.0_f64..1.0) {
        let form = Gulbrandsen::new(grey(r), grey(g));
        close(form.fresnel(Incidence::from_cos(1.0)).g, r, 1e-11)?;
        let conductor = form.conductor();
        let eta = g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + r.sqrt()) / (1.0 - r.sqrt());
        close(conductor.eta().g, eta, 1e-12)?;
        let k2 = (r * (eta + 1.0).powi(2) - (eta - 1.0).powi(2)) / (1.0 - r);
        prop_assert!((conductor.k().g.powi(2) - k2).abs() < 1e-10 * (eta + 1.0).powi(2) / (1.0 - r), "{k2}");
    }

    #[test]
    fn f0_and_ior_are_each_other(eta in 1.001_f64..4.0) {
        let f0 = F0::from_ior(Ior(eta));
        close(Ior::from_f0(f0).0, eta, 1e-12)?;
        close(Dielectric::new(Ior(eta)).fresnel(Incidence::from_cos(1.0)).g, f0.0, 1e-12)?;
        close(CookFresnel::grey(f0).fresnel(Incidence::from_cos(0.3)).g, Dielectric::new(Ior(eta)).fresnel(Incidence::from_cos(0.3)).g, 1e-10)?;
    }
}

/// Where light of one polarisation is not reflected at all: half of `rs²` is left, `((η² − 1)/(η² + 1))²/2`.
#[test]
fn brewsters_angle() {
    for eta in [1.000_01_f64, 1.33, 1.5, 2.4, 4.0] {
        let cos = 1.0 / (1.0 + eta * eta).sqrt();
        let left = 0.5 * ((eta * eta - 1.0) / (eta * eta + 1.0)).powi(2);
        let f = Dielectric::new(Ior(eta)).fresnel(Incidence::from_cos(cos)).g;
        assert!((f / left - 1.0).abs() < 1e-10, "{eta}: {f}");
    }
}

#[test]
fn normal_incidence_and_grazing() {
    let (normal, grazing) = (Incidence::from_cos(1.0_f32), Incidence::from_cos(0.0_f32));
    for eta in [0.05_f32, 0.2, 0.7, 1.000_001, 1.5, 4.0] {
        for k in [0.0_f32, 1e-4, 0.5, 3.0, 10.0] {
            let form = Conductor::new(grey(eta), grey(k));
            let (n, x) = (f64::from(eta), f64::from(k));
            let f0 = ((n - 1.0).powi(2) + x * x) / ((n + 1.0).powi(2) + x * x);
            assert!((f64::from(form.fresnel(normal).g) / f0 - 1.0).abs() < 1e-6, "{eta} {k}");
            assert!((form.fresnel(grazing).g - 1.0).abs() < 1e-6, "{eta} {k}");
        }
        assert!((Dielectric::new(Ior(eta)).fresnel(grazing).g - 1.0).abs() < 1e-6, "{eta}");
    }
    for f0 in [0.0_f32, 0.04, 0.5, 1.0] {
        assert_eq!(Schlick::with_f90(grey(f0), grey(0.3)).fresnel(grazing).g, 0.3);
        assert_eq!(F82Tint::new(grey(f0), grey(0.3)).fresnel(grazing).g, 1.0);
        assert_eq!(Lazanyi::new(grey(f0), grey(0.3), 6.0).fresnel(grazing).g, 1.0);
        assert_eq!(F82Tint::new(grey(f0), grey(0.3)).fresnel(normal).g, f0);
        assert_eq!(Lazanyi::new(grey(f0), grey(0.3), 6.0).fresnel(normal).g, f0);
        assert!((CookFresnel::new(grey(f0)).fresnel(normal).g - f0).abs() <= 1e-6 * f0);
    }
}

/// `η → 1`: `F → ((η − 1)/2)² (1 + (1 − 2 sin²θ)²)/(2 cos⁴θ)`, the first term of the series, and the usual form is wrong
/// in its second digit in `f32`.
#[test]
fn near_one_the_usual_form_is_wrong_by_percents() {
    let mut worst_naive = 0.0_f64;
    let angles = [1.0_f32, 0.9, 0.7, 0.5, 0.3];
    for (eta, cos) in [1.000_001_f32, 1.000_002, 1.000_005].into_iter().flat_map(|eta| angles.map(|cos| (eta, cos))) {
        let excess = f64::from(eta) - 1.0;
        let c = f64::from(cos);
        let sin2 = 1.0 - c * c;
        let limit = (excess / 2.0).powi(2) * (1.0 + (1.0 - 2.0 * sin2).powi(2)) / (2.0 * c.powi(4));
        let f = f64::from(Dielectric::new(Ior(eta)).fresnel(Incidence::from_cos(cos)).g);
        assert!((f / limit - 1.0).abs() < 5.0 * excess / (c * c), "{cos}: {f:e} {limit:e}");
        let g = (eta * eta - 1.0 + cos * cos).sqrt();
        let (s, p) = ((cos - g) / (cos + g), (eta * eta * cos - g) / (eta * eta * cos + g));
        worst_naive = worst_naive.max((f64::from(0.5 * (s * s + p * p)) / limit - 1.0).abs());
    }
    assert!(worst_naive > 0.01, "{worst_naive}");
}

/// What the guards are for: without them these are NaN.
#[test]
fn the_ends_are_finite() {
    for cos in [0.0_f32, f32::MIN_POSITIVE, 1e-30, 1e-19, 1e-10, 0.5, 1.0] {
        let at = Incidence::from_cos(cos);
        assert_eq!(Dielectric::new(Ior(1.0)).fresnel(at).g, 0.0);
        assert_eq!(Conductor::new(grey(1.0), grey(0.0)).fresnel(at).g, 0.0);
        assert_eq!(Conductor::new(grey(0.0), grey(0.0)).fresnel(at).g, 1.0);
        assert_eq!(CookFresnel::new(grey(0.0)).fresnel(at).g, 0.0);
        assert!((CookFresnel::new(grey(1.0)).fresnel(at).g - 1.0).abs() < 1e-6);
        for tint in [0.0, 0.5, 1.0] {
            let f = Gulbrandsen::new(grey(1.0), grey(tint)).fresnel(at).g;
            assert!((0.0..=1.0).contains(&f), "{cos} {tint}");
        }
    }
    let perfect = Gulbrandsen::new(grey(1.0_f32), grey(0.5)).fresnel(Incidence::from_cos(1.0)).g;
    assert!((perfect - 1.0).abs() < 1e-6, "{perfect}");
}

#[test]
fn nan_stays() {
    for at in [Incidence::new(f32::NAN, f32::NAN), Incidence::from_cos(f32::NAN)] {
        let forms: [&dyn Fresnel<f32>; 7] = [
            &Dielectric::new(Ior(1.5)),
            &Conductor::new(grey(0.2), grey(3.0)),
            &CookFresnel::new(grey(0.5)),
            &Schlick::new(grey(0.5)),
            &F82Tint::new(grey(0.5), grey(0.5)),
            &Gulbrandsen::new(grey(0.5), grey(0.5)),
            &Lazanyi::new(grey(0.5), grey(0.5), 6.0),
        ];
        for (number, form) in forms.into_iter().enumerate() {
            assert!(form.fresnel(at).g.is_nan(), "{number}");
        }
    }
}

/// The tint is what it says: at `cos θ = 1/7` the reflectance is the tint times Schlick's, and white changes nothing.
#[test]
fn f82_tints_at_82_degrees() {
    for f0 in [0.2, 0.5, 0.95_f64] {
        for cos in [1.0, 0.7, 1.0 / 7.0, 0.01] {
            let at = Incidence::from_cos(cos);
            let schlick = Schlick::new(grey(f0)).fresnel(at).g;
            assert!((F82Tint::new(grey(f0), grey(1.0)).fresnel(at).g - schlick).abs() < 1e-14);
        }
        let at = Incidence::from_cos(1.0 / 7.0);
        let ratio = F82Tint::new(grey(f0), grey(0.6)).fresnel(at).g / Schlick::new(grey(f0)).fresnel(at).g;
        assert!((ratio - 0.6).abs() < 1e-12, "{ratio}");
    }
}

/// The cosine-weighted average of F82-tint has the closed form `f0 + (1 − f0)/21 − b/126`: quadrature agrees.
#[test]
fn the_average_of_f82_is_its_closed_form() {
    let (f0, tint) = (0.6_f64, 0.5_f64);
    let mu = 1.0_f64 / 7.0;
    let schlick = f0 + (1.0 - f0) * (1.0 - mu).powi(5);
    let b = schlick * (1.0 - tint) / (mu * (1.0 - mu).powi(6));
    let form = F82Tint::new(grey(f0), grey(tint));
    let steps = 20_000;
    let sum: f64 = (0..steps)
        .map(|i| (f64::from(i) + 0.5) / f64::from(steps))
        .map(|cos| 2.0 * cos * form.fresnel(Incidence::from_cos(cos)).g)
        .sum();
    let average = sum / f64::from(steps);
    assert!((average - (f0 + (1.0 - f0) / 21.0 - b / 126.0)).abs() < 1e-7, "{average}");
}
