//! What every sampler must have, as functions of `&dyn Sample`.

#![allow(dead_code, reason = "not every test uses all of it")]

pub(crate) mod cases;

use lobe::{Brdf, Real, Rgb, Vec3};
use lobe_energy::directional_albedo_to;
use lobe_sampling::Sample;

/// A lobe that can be evaluated and sampled.
pub(crate) trait Lobe<R: Real>: Brdf<R> + Sample<R> {}
impl<R: Real, L: Brdf<R> + Sample<R>> Lobe<R> for L {}

/// A lobe with its name.
pub(crate) type Named<R> = (String, Box<dyn Lobe<R>>);

/// The unit vector at a cosine and an azimuth.
pub(crate) fn at(cos: f64, azimuth: f64) -> Vec3<f64> {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    Vec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos)
}

/// The same direction in `f32`.
pub(crate) fn single(v: Vec3<f64>) -> Vec3<f32> {
    v.map(|x| x as f32)
}

/// Point `i` of Halton's sequence in the bases 2, 3 and 5.
pub(crate) fn point(i: u32) -> [f64; 3] {
    [2, 3, 5].map(|base| {
        let (mut left, mut digit, mut x) = (i + 1, 1.0, 0.0);
        while left > 0 {
            digit /= f64::from(base);
            x += digit * f64::from(left % base);
            left /= base;
        }
        x
    })
}

/// The first of them: the same in every run.
pub(crate) fn points(count: u32) -> impl Iterator<Item = [f64; 3]> {
    (0..count).map(point)
}

/// A function of directions of light as a lobe, so that the quadrature of albedos integrates it.
struct Integrand<F>(F);

impl<F: Fn(Vec3<f64>) -> Rgb<f64>> Brdf<f64> for Integrand<F> {
    fn eval(&self, _: Vec3<f64>, _: Vec3<f64>) -> Rgb<f64> {
        unreachable!("albedos are integrated over eval_cos")
    }
    fn eval_cos(&self, l: Vec3<f64>, _: Vec3<f64>) -> Rgb<f64> {
        (self.0)(l)
    }
}

/// Parts of the samples that are rejected, and that are deltas.
fn without_density(sampler: &dyn Sample<f64>, v: Vec3<f64>, count: u32) -> [f64; 2] {
    let (mut rejected, mut deltas) = (0, 0);
    for u in points(count) {
        let sample = sampler.sample(v, u);
        rejected += usize::from(sample.rejected);
        deltas += usize::from(sample.delta && !sample.rejected);
    }
    [rejected, deltas].map(|part| part as f64 / f64::from(count))
}

/// [`density_is_normalised`] for a density with steps, which mislead a rule of high order: by a fine grid.
pub(crate) fn stepped_density_is_normalised(name: &str, sampler: &dyn Sample<f64>, v: Vec3<f64>) {
    const SIDE: usize = 1000;
    let mut integral = 0.0;
    for i in 0..SIDE {
        let cos = (i as f64 + 0.5) / SIDE as f64;
        for j in 0..SIDE {
            let azimuth = (j as f64 + 0.5) / SIDE as f64 * core::f64::consts::TAU;
            integral += sampler.pdf(at(cos, azimuth), v) * core::f64::consts::TAU;
        }
    }
    integral /= (SIDE * SIDE) as f64;
    let [rejected, deltas] = without_density(sampler, v, 1 << 16);
    assert!((integral + rejected + deltas - 1.0).abs() < 1e-3, "{name} at {v:?}: {integral} + {rejected} + {deltas}");
}

/// The integral of the density, and the parts of the samples that are rejected and deltas; together they are 1.
pub(crate) fn masses(sampler: &dyn Sample<f64>, v: Vec3<f64>, count: u32) -> [f64; 3] {
    let integral = directional_albedo_to(3e-4, &Integrand(|l| Rgb::splat(sampler.pdf(l, v))), v);
    assert!(integral.error < 3e-4, "{integral:?} at {v:?}");
    let [rejected, deltas] = without_density(sampler, v, count);
    [integral.value.g, rejected, deltas]
}

/// The density integrates to 1 less what is rejected or a delta.
pub(crate) fn density_is_normalised(name: &str, sampler: &dyn Sample<f64>, v: Vec3<f64>) {
    let [integral, rejected, deltas] = masses(sampler, v, 1 << 16);
    let error = integral + rejected + deltas - 1.0;
    assert!(error.abs() < 1e-3, "{name} at {v:?}: {integral} + {rejected} + {deltas}");
}

/// The density of a sample is what `pdf` says, value over density is its weight, to `bound`, and the value is the
/// lobe's.
pub(crate) fn samples_are_consistent(name: &str, lobe: &dyn Lobe<f64>, v: Vec3<f64>, bound: f64) {
    let mut scattered = 0;
    for u in points(4096) {
        let sample = lobe.sample(v, u);
        let length = sample.l.length();
        assert!((length - 1.0).abs() < 1e-13, "{name} at {v:?}, {u:?}: |l| = {length}");
        if sample.rejected {
            assert_eq!((sample.weight, sample.pdf), (Rgb::splat(0.0), 0.0));
            continue;
        }
        scattered += 1;
        assert_eq!(sample.pdf, lobe.pdf(sample.l, v), "{name} at {v:?}, {u:?}");
        let (value, pdf) = lobe.eval_cos_pdf(sample.l, v);
        assert_eq!(pdf, sample.pdf, "{name} at {v:?}, {u:?}");
        let exact = lobe.eval_cos(sample.l, v);
        for (weight, (value, exact)) in
            channels(sample.weight).into_iter().zip(channels(value).into_iter().zip(channels(exact)))
        {
            assert!((value - exact).abs() <= bound * exact, "{name} at {v:?}, {u:?}: {value} {exact}");
            if pdf > 0.0 && exact > 1e-290 {
                assert!((weight * pdf / exact - 1.0).abs() < bound, "{name} at {v:?}, {u:?}: {weight} {value} {pdf}");
            }
        }
    }
    assert!(scattered > 0, "{name} at {v:?} rejects everything");
}

/// The largest relative difference of a weight in `f32` to value over density in `f64` of the same directions.
pub(crate) fn error_of_weight(lobe: &dyn Lobe<f32>, exact: &dyn Lobe<f64>, v: Vec3<f64>) -> f64 {
    let v = single(v);
    let mut worst = 0.0_f64;
    for u in points(2048) {
        let sample = lobe.sample(v, u.map(|u| u as f32));
        if sample.rejected {
            continue;
        }
        let (value, pdf) = exact.eval_cos_pdf(sample.l.map(f64::from), v.map(f64::from));
        if value.g > 1e-30 && pdf > 1e-30 {
            worst = worst.max((f64::from(sample.weight.g) * pdf / value.g - 1.0).abs());
        }
    }
    worst
}

/// The mean weight of the samples is the directional albedo, within four standard errors.
pub(crate) fn weights_sum_to_the_albedo(name: &str, sampler: &dyn Lobe<f64>, v: Vec3<f64>) {
    const COUNT: u32 = 1 << 15;
    let (mut sum, mut squares) = (0.0, 0.0);
    for u in points(COUNT) {
        let weight = sampler.sample(v, u).weight.g;
        sum += weight;
        squares += weight * weight;
    }
    let count = f64::from(COUNT);
    let mean = sum / count;
    let deviation = (squares / count - mean * mean).max(0.0).sqrt() / count.sqrt();
    let albedo = directional_albedo_to(1e-4, &Integrand(|l| sampler.eval_cos(l, v)), v);
    // The points and the quadrature have errors of their own, where every weight is the same.
    let room = 4.0 * deviation + albedo.error + 1e-4 * mean;
    assert!((mean - albedo.value.g).abs() < room, "{name} at {v:?}: {mean} ± {deviation}, albedo {albedo:?}");
}

fn channels<R>(color: Rgb<R>) -> [R; 3] {
    color.into()
}

/// Numbers of the square at its ends; those of 53 digits are no numbers of `f32`, where the last is 1.
pub(crate) const ENDS: [f64; 8] = [
    0.0,
    f64::MIN_POSITIVE / 8.0,
    1e-40,
    1.0 / 16_777_216.0,
    0.5,
    0.750_001,
    1.0 - 1.0 / 16_777_216.0,
    1.0 - f64::EPSILON / 2.0,
];

/// Those of them that are numbers below 1 in `f32`.
pub(crate) fn single_ends() -> impl Iterator<Item = f32> + Clone {
    ENDS.into_iter().map(|x| x as f32).filter(|x| *x < 1.0)
}

/// Viewers, down to the horizon.
pub(crate) const COSINES: [f64; 7] = [1.0, 0.999_999, 0.7, 0.1, 1e-3, 1e-6, 1e-20];

/// At every corner of the square, for every viewer, a sample is finite, its weight not negative and its direction a
/// unit vector.
pub(crate) fn ends_are_finite<R: Real<Mask = bool> + Into<f64>>(name: &str, sampler: &dyn Sample<R>, witness: R) {
    let number = |x: f64| witness.lift(x);
    let epsilon = if number(1.0 + 1e-12).into() == 1.0 { 2e-6 } else { 1e-13 };
    let ends: Vec<R> = ENDS.map(number).into_iter().filter(|x| (*x).into() < 1.0).collect();
    for cos in COSINES {
        for azimuth in [0.0, 0.9, 3.0] {
            let v = at(cos, azimuth).map(number);
            let guess: f64 = sampler.albedo_guess(v).into();
            assert!((0.0..1e30).contains(&guess), "{name} at {v:?}: {guess}", v = v.map(Into::<f64>::into));
            for &x in &ends {
                for &y in &ends {
                    for &z in &ends {
                        let sample = sampler.sample(v, [x, y, z]);
                        let (x, y, z): (f64, f64, f64) = (x.into(), y.into(), z.into());
                        let l = sample.l.map(Into::<f64>::into);
                        let (weight, pdf) = (channels(sample.weight).map(Into::<f64>::into), sample.pdf.into());
                        let place = || format!("{name} at {cos} {azimuth}, {x} {y} {z}: {l:?} {weight:?} {pdf}");
                        assert!((l.length() - 1.0).abs() < epsilon, "{}", place());
                        assert!(weight.iter().all(|w| (0.0..1e30).contains(w)), "{}", place());
                        assert!((0.0..f64::MAX).contains(&pdf) && (sample.pdf.times(0.0).into() == 0.0), "{}", place());
                        assert!(sample.rejected || l.z > 0.0, "{}", place());
                        assert_eq!(pdf == 0.0, sample.rejected || sample.delta, "{}", place());
                        if !sample.rejected && !sample.delta {
                            let again: f64 = sampler.pdf(sample.l, v).into();
                            assert_eq!(again, pdf, "{}", place());
                        }
                    }
                }
            }
        }
    }
}

/// A NaN in a component of the viewer or of `u` shows in the weight and in no other way; below the horizon nothing is
/// drawn.
pub(crate) fn nan_shows_and_below_is_nothing<R: Real<Mask = bool> + Into<f64>>(
    name: &str,
    sampler: &dyn Sample<R>,
    witness: R,
) {
    let number = |x: f64| witness.lift(x);
    let is_nan = |x: R| Into::<f64>::into(x).is_nan();
    let v = at(0.6, 0.4);
    let u = [0.3, 0.6, 0.2];
    for i in 0..3 {
        for (broken_v, broken_u) in [(f64::NAN, 0.0), (0.0, f64::NAN)] {
            let mut w = [v.x, v.y, v.z];
            let mut u = u;
            w[i] += broken_v;
            u[i] += broken_u;
            for z in [1.0, -1.0] {
                if z < 0.0 && (i == 2 || broken_v == 0.0) {
                    continue;
                }
                let v = Vec3::new(w[0], w[1], z * w[2]).map(number);
                let sample = sampler.sample(v, u.map(number));
                assert!(channels(sample.weight).iter().all(|w| is_nan(*w)), "{name}: {w:?} {u:?}");
                assert!(z < 0.0 || !sample.rejected, "{name}: {w:?} {u:?}");
                let l = at(0.5, 0.1).map(number);
                if broken_v.is_nan() {
                    for (l, v) in [(l, v), (v, l)] {
                        let (value, pdf) = sampler.eval_cos_pdf(l, v);
                        assert!(is_nan(sampler.pdf(l, v)) && is_nan(pdf) && is_nan(value.g), "{name}: {w:?}");
                    }
                }
            }
        }
    }
    for z in [-1.0, -0.6, -1e-6, -1e-20, -0.0, 0.0] {
        let v = Vec3 { z, ..at(f64::abs(z), 0.4) }.map(number);
        let sample = sampler.sample(v, u.map(number));
        assert!(sample.rejected && !sample.delta, "{name} from {z}");
        assert_eq!(channels(sample.weight).map(Into::<f64>::into), [0.0; 3], "{name} from {z}");
        assert_eq!(sample.pdf.into(), 0.0, "{name} from {z}");
        let l = sample.l.map(Into::<f64>::into);
        assert!((l.length() - 1.0).abs() < 1e-6, "{name} from {z}: {l:?}");
        let l = at(0.5, 0.1).map(number);
        for (l, v) in [(l, v), (v, l)] {
            let (value, pdf) = sampler.eval_cos_pdf(l, v);
            let all = [value.r, value.g, value.b, pdf, sampler.pdf(l, v)].map(Into::<f64>::into);
            assert_eq!(all, [0.0; 5], "{name} from {z}");
        }
        assert!(sampler.albedo_guess(v).into().is_finite(), "{name} from {z}");
    }
    let v = v.map(number);
    assert_eq!(sampler.pdf(at(-0.5, 0.1).map(number), v).into(), 0.0, "{name}");
}
