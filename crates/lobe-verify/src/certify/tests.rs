//! What is true is proved, what is false is not, and a proof that was tampered with is found out.

use super::albedo as energy;
use super::models::*;
use super::*;
use lobe::{Phong, Shininess, Vec3};
use proptest::prelude::*;

/// Enough for the small boxes of these tests.
const EFFORT: Effort = Effort { work: 1 << 18, cells: 1 << 12, wide: false };

/// A family without a parameter, made of a formula for `f_r` from `(l, v)`.
struct Planted<F>(F);

/// `f_r` as a formula over any number: what a closure cannot be.
trait Formula: Sync {
    fn f<R: Real>(&self, l: Vec3<R>, v: Vec3<R>) -> R;
}

struct AsBrdf<'a, F>(&'a F);

impl<F: Formula, R: Real> Brdf<R> for AsBrdf<'_, F> {
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        Rgb::splat(self.0.f(l, v))
    }
}

impl<F: Formula> Family for Planted<F> {
    fn name(&self) -> String {
        "planted".to_owned()
    }
    fn parameters(&self) -> Vec<Axis> {
        Vec::new()
    }
    fn symmetry(&self) -> Symmetry {
        Symmetry::Isotropic
    }
    fn lobe<R: Real>(&self, _one: R, _parameters: &[R]) -> impl Brdf<R> {
        AsBrdf(&self.0)
    }
}

macro_rules! planted {
    ($($name:ident: |$l:ident, $v:ident| $f:expr;)+) => {$(
        struct $name;
        impl Formula for $name {
            fn f<R: Real>(&self, $l: Vec3<R>, $v: Vec3<R>) -> R {
                $f
            }
        }
    )+};
}

const INV_PI: f64 = std::f64::consts::FRAC_1_PI;

planted! {
    // Lambert, and Lambert without its π.
    Sound: |l, _v| l.z.lift(INV_PI);
    WithoutPi: |l, _v| l.z.lift(1.0);
    // A lobe that is normalised at the normal only by accident: 3/(2π) z has the albedo 1 everywhere, 3.3/(2π) 1.1.
    Cosine: |l, _v| l.z.times(1.5 * INV_PI);
    Gaining: |l, _v| l.z.times(1.65 * INV_PI);
    // A sign: 1/2 − z is negative for steep light.
    Negative: |l, v| (l.z.lift(0.5) - l.z * v.z).times(INV_PI);
    // A pole in the middle of the domain: where l.x = v.x.
    Pole: |l, v| (l.x - v.x).squared().recip();
    // 0/0 at l = v, hidden behind clamps.
    Hidden: |l, v| ((l.x - v.x) / -(v.x - l.x)).max(l.x.lift(0.0)).min(l.x.lift(1.0));
}

fn steep(family: &impl Family, limit: f64) -> Outcome {
    energy::prove(family, Axis::linear("view", 0.0, 0.375), limit, &EFFORT)
}

#[test]
fn what_conserves_energy_is_certified_and_what_gains_is_refuted() {
    assert!(steep(&Planted(Sound), 1.001).is_certified());
    assert!(steep(&Planted(Cosine), 1.001).is_certified());
    for gained in [steep(&Planted(WithoutPi), 1.001), steep(&Planted(Gaining), 1.001)] {
        let Outcome::Refuted(found) = &gained else { panic!("{gained}") };
        assert!(found.value.lo > found.limits.1, "{gained}");
    }
    let tight = steep(&Planted(Gaining), 1.101);
    assert!(tight.is_certified(), "{tight}");
}

/// The same family with the published factor and with a wrong one.
#[test]
fn a_wrong_normalisation_is_refuted() {
    struct Wrong;
    impl Family for Wrong {
        fn name(&self) -> String {
            "phong, q + 8".to_owned()
        }
        fn parameters(&self) -> Vec<Axis> {
            vec![Axis::shifted("q", 0.0, 2.0)]
        }
        fn symmetry(&self) -> Symmetry {
            Symmetry::Isotropic
        }
        fn lobe<R: Real>(&self, one: R, parameters: &[R]) -> impl Brdf<R> {
            let q = parameters[0];
            Phong::new(Rgb::splat(q.plus(8.0) / q.plus(2.0)) * one, Shininess(q))
        }
    }
    let right = steep(&Phongs { lo: 0.0, hi: 2.0 }, 1.06);
    assert!(right.is_certified(), "{right}");
    assert!(steep(&Wrong, 1.06).is_refuted());
    // What is said of the common normalisation: at q = 8 it gains 7.5 %.
    let common = CommonBlinnPhongs { lo: 7.9, hi: 8.1 };
    let gain = energy::prove(&common, Axis::linear("view", 0.0, 0.01), 1.07, &EFFORT);
    assert!(gain.is_refuted(), "{gain}");
    let gain = energy::prove(&common, Axis::linear("view", 0.0, 0.01), 1.08, &EFFORT);
    assert!(gain.is_certified(), "{gain}");
    // And of the exact one that it does not.
    assert!(steep(&BlinnPhongs { lo: 7.9, hi: 8.1 }, 1.03).is_certified());
}

#[test]
fn signs_poles_and_hidden_nans_are_found() {
    assert!(range::prove_lobe(&Planted(Sound), 1e-20, &EFFORT).is_certified());
    assert!(range::prove_lobe(&Planted(Negative), 1e-20, &EFFORT).is_refuted());
    let little = Effort { work: 1 << 12, ..EFFORT };
    for outcome in
        [range::prove_lobe(&Planted(Pole), 1e-3, &little), range::prove_lobe(&Planted(Hidden), 1e-3, &little)]
    {
        assert!(matches!(&outcome, Outcome::Open(open) if !open.bound.is_finite()), "{outcome}");
    }
}

/// `F0 − (1 − F0) x⁵`, a sign mistake; and `x⁵` of the wrong side.
#[test]
fn a_wrong_reflectance_is_refuted() {
    struct Wrong(f64);
    impl Quantity for Wrong {
        fn name(&self) -> String {
            "F".to_owned()
        }
        fn axes(&self) -> Vec<Axis> {
            SchlickReflectance.axes()
        }
        fn value<R: Number>(&self, x: &[R]) -> R {
            let (f0, one) = (x[0], x[0].lift(1.0));
            let x = one - x[1];
            f0 + (one - f0) * (x.squared().squared() * x).times(self.0)
        }
    }
    let limits = (0.0, 1.0 + 1e-12);
    assert!(range::prove(&Wrong(1.0), limits, &EFFORT).is_certified());
    assert!(range::prove(&Wrong(-1.0), limits, &EFFORT).is_refuted());
    assert!(range::prove(&Wrong(1.01), limits, &EFFORT).is_refuted());
    assert!(range::prove(&SchlickReflectance, limits, &EFFORT).is_certified());
}

/// `1/(1 + Λ)` with a minus is above 1.
#[test]
fn a_wrong_masking_is_refuted() {
    #[derive(Clone)]
    struct Wrong;
    impl MaskingTerm for Wrong {
        fn name(&self) -> String {
            "G".to_owned()
        }
        fn visibility<R: Real>(&self, alpha: R, l: Vec3<R>, v: Vec3<R>) -> R {
            let ggx = lobe::distribution::Ggx::new(lobe::Alpha(alpha));
            let area = |w: Vec3<R>| w.z - lobe::distribution::SmithLambda::lambda_cos(&ggx, w);
            (area(l) * area(v)).times(4.0).recip()
        }
    }
    let of = |limit| (0.0, limit);
    let right = MaskingOf { term: GgxSeparable, angle: 0.25, alpha: 0.2 };
    assert!(range::prove(&right, of(1.01), &EFFORT).is_certified());
    let wrong = MaskingOf { term: Wrong, angle: 0.25, alpha: 0.2 };
    assert!(range::prove(&wrong, of(1.01), &EFFORT).is_refuted());
}

#[test]
fn proofs_can_be_checked_and_forgeries_are_found() {
    let family = BlinnPhongs { lo: 1.0, hi: 2.0 };
    let outcome = steep(&family, 1.03);
    let Outcome::Certified(certificate) = outcome else { panic!("{outcome}") };
    assert!(energy::check(&family, &certificate).holds());
    assert!(certificate.boxes > 0 && certificate.cells == certificate.proof.matches('.').count());
    let forged = |change: &dyn Fn(&mut Certificate)| {
        let mut copy = certificate.clone();
        change(&mut copy);
        energy::check(&family, &copy)
    };
    // A stronger statement with the same proof; one box for all; a text that ends early, goes on, or is none.
    assert!(matches!(forged(&|c| c.limits.1 = 0.5), Recheck::Fails(..)));
    assert!(matches!(forged(&|c| c.proof = "(.)".to_owned()), Recheck::Fails(..)));
    assert!(matches!(forged(&|c| _ = c.proof.pop()), Recheck::Malformed(_)));
    assert!(matches!(forged(&|c| c.proof.push('.')), Recheck::Malformed(_)));
    assert!(matches!(forged(&|c| c.proof = "7..".to_owned()), Recheck::Malformed(_)));
    // The proof of another family.
    assert!(!energy::check(&BlinnPhongs { lo: 1.0, hi: 3.0 }, &certificate).holds());
    let gaining = CommonBlinnPhongs { lo: 1.0, hi: 2.0 };
    assert!(!energy::check(&gaining, &certificate).holds());
    // Of a range.
    let Outcome::Certified(certificate) = range::prove(&SchlickReflectance, (-0.1, 1.1), &EFFORT) else { panic!() };
    assert!(range::check(&SchlickReflectance, &certificate).holds());
    let stronger = Certificate { limits: (0.5, 1.1), ..certificate };
    assert!(matches!(range::check(&SchlickReflectance, &stronger), Recheck::Fails(..)));
}

/// The same outcome, whatever the number of threads.
#[test]
fn the_search_is_deterministic() {
    let prove = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| steep(&BlinnPhongs { lo: 0.0, hi: 4.0 }, 1.05))
    };
    assert_eq!(prove(1), prove(2));
}

/// The 4 of `D F G/(4 (n·l)(n·v))` taken for a 2.
#[test]
fn a_wrong_microfacet_lobe_is_refuted() {
    use lobe::distribution::{Ggx, SmithLambda};
    use lobe::fresnel::Schlick;
    use lobe::number::Quotient;

    struct Separable(f64);
    impl<R: Real, D: SmithLambda<R>> lobe::masking::Masking<R, D> for Separable {
        fn quotient(&self, d: &D, l: Vec3<R>, v: Vec3<R>, _h: Vec3<R>, _cos_d: R, weight: R) -> Quotient<R> {
            Quotient::new(weight.times(1.0 / self.0), d.facing(l) * d.facing(v))
        }
    }
    struct Metal(f64);
    impl Family for Metal {
        fn name(&self) -> String {
            "ggx".to_owned()
        }
        fn parameters(&self) -> Vec<Axis> {
            vec![Axis::linear("alpha", 0.6, 0.7)]
        }
        fn symmetry(&self) -> Symmetry {
            Symmetry::Isotropic
        }
        fn lobe<R: Real>(&self, one: R, parameters: &[R]) -> impl Brdf<R> {
            let (ggx, mirror) = (Ggx::new(lobe::Alpha(parameters[0])), Schlick::new(Rgb::splat(one)));
            lobe::Microfacet::new(ggx, Separable(self.0), mirror)
        }
    }
    assert!(steep(&Metal(4.0), 1.02).is_certified());
    assert!(steep(&Metal(2.0), 1.02).is_refuted());
}

/// What is not isotropic is integrated over all azimuths of the viewer: a lobe that reflects only for `v.y > 0`.
#[test]
fn anisotropic_families_turn_the_viewer() {
    struct Half(f64);
    struct HalfLobe(f64);
    impl<R: Real> Brdf<R> for HalfLobe {
        fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
            // 1/π at v.y = 0, more towards v.y = 1.
            Rgb::splat(v.y.times(self.0).plus(1.0).times(INV_PI)) * l.z.lift(1.0)
        }
    }
    impl Family for Half {
        fn name(&self) -> String {
            "half".to_owned()
        }
        fn parameters(&self) -> Vec<Axis> {
            Vec::new()
        }
        fn symmetry(&self) -> Symmetry {
            Symmetry::None
        }
        fn lobe<R: Real>(&self, _one: R, _parameters: &[R]) -> impl Brdf<R> {
            HalfLobe(self.0)
        }
    }
    assert!(steep(&Half(0.0), 1.01).is_certified());
    assert!(steep(&Half(0.5), 1.01).is_refuted());
    assert!(steep(&Half(0.5), 1.5).is_certified());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// The certified bounds of a box have the value at every point of it, and its albedo is that of a plain sum.
    #[test]
    fn bounds_hold_at_samples(view in 0.01..0.4_f64, q in 0.0..10.0_f64) {
        let phong = Phong::new(Rgb::splat(1.0), Shininess(q));
        let v = { let (sin, cos) = Number::half_turns(view); Vec3::new(sin, 0.0, cos) };
        let n = 200;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let (theta, phi) = ((f64::from(i) + 0.5) / f64::from(2 * n), (f64::from(j) + 0.5) / f64::from(n));
                let ((sin, cos), (sin_phi, cos_phi)) = (Number::half_turns(theta), Number::half_turns(phi));
                sum += phong.eval_cos(Vec3::new(sin * cos_phi, sin * sin_phi, cos), v).g * sin;
            }
        }
        let albedo: f64 = sum * std::f64::consts::PI.powi(2) / f64::from(n * n);
        let family = Phongs { lo: q, hi: q + 1e-3 };
        let prove = |limit| energy::prove(&family, Axis::linear("view", view, view + 1e-5), limit, &EFFORT);
        let above = prove(albedo + 0.03);
        prop_assert!(above.is_certified(), "{} {above}", albedo);
        prop_assert!(!prove(albedo - 0.005).is_certified());
        let Outcome::Certified(certificate) = above else { unreachable!() };
        prop_assert!(certificate.bound.0 <= albedo + 1e-4 && albedo - 1e-4 <= certificate.bound.1);
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    /// Slopes enclose differences of `f64`.
    #[test]
    fn slopes_enclose_differences(x in 0.1..2.0_f64, y in 0.1..2.0_f64, width in 1e-6..0.2_f64, t in 0.0..1.0_f64) {
        fn all<R: Number>(x: R, y: R) -> [R; 16] {
            let one = x.lift(1.0);
            [
                x * y, x / y, x - y, x.sqrt(), (x * y).exp2(), (x + y).log2(), (x * y).log2_1p(),
                x.log2_1p_div(y), x.pow(y), x.sin_cos().0 * y.sin_cos().1, x.atan2(y), (x * y).erfc(),
                x.squared().max(y), (x - y).abs(), one.min(x * y), x.half_turns().0 * y.half_turns().1,
            ]
        }
        let (to_x, to_y) = (x + width * t, y + width * (1.0 - t));
        let range = |a: f64| Interval::new(a, a + width);
        let over = all(Slopes::<2>::variable(range(x), 0), Slopes::variable(range(y), 1));
        for (over, (from, to)) in over.iter().zip(all(x, y).into_iter().zip(all(to_x, to_y))) {
            prop_assert!(over.slope.iter().all(|s| s.is_finite()));
            let by = |s: Interval, d: f64| s * Interval::point(d);
            let change = by(over.slope[0], to_x - x) + by(over.slope[1], to_y - y);
            let slack = 1e-13 * (1.0 + from.abs());
            prop_assert!(change.lo - slack <= to - from && to - from <= change.hi + slack);
            prop_assert!(over.value.lo - slack <= to && to <= over.value.hi + slack);
        }
    }
}

/// One of each kind for the whole domain; the others are those of `certificates`.
#[test]
fn claims_of_the_catalogue() {
    let names: Vec<_> = claims(&EFFORT).iter().map(|claim| claim.name().to_owned()).collect();
    assert!(names.len() >= 18 && names.iter().all(|name| !name.is_empty()));
    for claim in
        claims(&EFFORT).iter().filter(|claim| claim.name().starts_with("F ") || claim.name().contains("finite"))
    {
        let outcome = claim.prove(&EFFORT);
        let Outcome::Certified(certificate) = &outcome else { panic!("{outcome}") };
        assert!(claim.check(certificate).holds(), "{outcome}");
    }
    let lamberts = Lamberts { lo: 0.0, hi: 1.0 };
    assert!(steep(&lamberts, 1.001).is_certified());
}
