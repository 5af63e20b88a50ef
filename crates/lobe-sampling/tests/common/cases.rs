//! Lobes in three number types, and what their samplers must do.

use super::{COSINES, Integrand, nan_shows_and_below_is_nothing, point, single_ends};
use lobe::number::{Approximate, Fast};
use lobe::{Real, Rgb, Vec3};
use lobe_energy::directional_albedo_to;
use lobe_sampling::Sample;

/// One lobe in three number types.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) double: Box<dyn Sample<f64>>,
    pub(crate) single: Box<dyn Sample<f32>>,
    pub(crate) fast: Box<dyn Sample<Approximate<f32, Fast>>>,
    /// How far `weight` may be from `eval_cos/pdf` in `f32`, of itself or of a hundredth of the albedo, whichever is
    /// more.
    pub(crate) tolerance: f64,
}

/// A case of an expression that makes a lobe of `f64` with a method `map`.
#[macro_export]
macro_rules! case {
    ($tolerance:expr, $lobe:expr) => {{
        let lobe = $lobe;
        $crate::common::cases::Case {
            name: stringify!($lobe).split_whitespace().collect::<Vec<_>>().join(" "),
            double: Box::new(lobe),
            single: Box::new(lobe.map(|x: f64| x as f32)),
            fast: Box::new(lobe.map(|x: f64| lobe::number::Approximate::<f32, lobe::number::Fast>::new(x as f32))),
            tolerance: $tolerance,
        }
    }};
}

/// A unit vector with the cosine `z`, at an azimuth of no particular kind.
pub(crate) fn view(z: f64) -> Vec3<f64> {
    let sin = ((1.0 - z) * (1.0 + z)).sqrt();
    Vec3::new(0.6 * sin, -0.8 * sin, z)
}

/// From the normal to where most lobes lose half of their samples.
pub(crate) const VIEWS: [f64; 4] = [1.0, 0.8, 0.3, 0.03];

/// `∫ f` over the hemisphere, with points that are dense around the mirror direction of `v`.
fn integral(what: &str, v: Vec3<f64>, f: impl Fn(Vec3<f64>) -> Rgb<f64>) -> Rgb<f64> {
    let result = directional_albedo_to(1e-4, &Integrand(f), v);
    // Edges, such as a horizon of the sampled lobe, leave some.
    let scale = result.value.r.abs().max(1.0);
    assert!(result.error < 3e-4 * scale, "{what}: {result:?} at {v:?}");
    result.value
}

/// Sums for a mean and its standard error.
#[derive(Default)]
struct Mean(f64, f64);

impl Mean {
    fn add(&mut self, x: f64) {
        self.0 += x;
        self.1 += x * x;
    }
    /// The mean, and the standard error that as many independent samples would have. Halton's are spread more evenly:
    /// within one, a test tells more faults than within four.
    fn of(&self, n: f64) -> (f64, f64) {
        let mean = self.0 / n;
        (mean, ((self.1 / n - mean * mean).max(0.0) / n).sqrt())
    }
}

/// Samples against quadratures: the mass, three moments of the density, the albedo. And that a sample is what it says.
pub(crate) fn agrees_with_quadrature(case: &Case, views: &[f64]) {
    const N: u32 = 1 << 15;
    let n = f64::from(N);
    let (name, lobe) = (&case.name, &case.double);
    for v in views.iter().map(|z| view(*z)) {
        let peak = lobe.pdf(Vec3::new(-v.x, -v.y, v.z), v).max(0.1);
        // Bounded, and different wherever the density is of another shape; the second tells the axes apart.
        let moments = |l: Vec3<f64>, pdf: f64| {
            let (s, shape) = (l + v, peak / (peak + pdf));
            let along = s.x * s.x / (s.x * s.x + s.y * s.y).max(1e-300);
            [shape, shape * along, l.z]
        };
        let (mut albedo, mut means, mut rejected) = (Mean::default(), [0; 3].map(|_| Mean::default()), 0.0);
        for i in 0..N {
            let sample = lobe.sample(v, point(i));
            assert!((sample.l.length() - 1.0).abs() < 1e-12 && !sample.delta, "{name}: {sample:?}");
            if sample.rejected {
                assert!((sample.pdf, sample.weight) == (0.0, Rgb::splat(0.0)), "{name}: {sample:?}");
                albedo.add(0.0);
                means.iter_mut().for_each(|mean| mean.add(0.0));
                rejected += 1.0;
                continue;
            }
            let (value, pdf) = lobe.eval_cos_pdf(sample.l, v);
            assert!(sample.pdf == pdf && pdf == lobe.pdf(sample.l, v) && pdf > 0.0, "{name}: {sample:?}, {pdf}");
            let (exact, weight) = ((value * pdf.recip()).g, sample.weight.g);
            assert!((weight - exact).abs() <= 1e-9 * exact.abs() + 1e-15, "{name} {v:?}: {sample:?}, {exact}");
            albedo.add(weight);
            for (mean, moment) in means.iter_mut().zip(moments(sample.l, pdf)) {
                mean.add(moment);
            }
        }
        // More points for a mass, whose edge is the horizon; not where of as many points none is beyond it.
        let of_mass = if rejected > 0.0 { 2 * N } else { N };
        for i in N..of_mass {
            rejected += f64::from(u8::from(lobe.sample(v, point(i)).rejected));
        }
        rejected /= f64::from(of_mass);
        let shapes = integral(name, v, |l| {
            let pdf = lobe.pdf(l, v);
            let [shape, along, _] = moments(l, pdf);
            Rgb::new(1.0, shape, along) * pdf
        });
        assert!((shapes.r + rejected - 1.0).abs() < 1e-3, "{name} {v:?}: {} + {rejected}", shapes.r);
        let values = integral(name, v, |l| {
            let (value, pdf) = lobe.eval_cos_pdf(l, v);
            Rgb::new(value.g, pdf * l.z, 0.0)
        });
        for (mean, exact) in means.iter().zip([shapes.g, shapes.b, values.g]) {
            let (mean, error) = mean.of(n);
            assert!((mean - exact).abs() < error + 2e-5, "{name} {v:?}: {mean} ± {error}, {exact}");
        }
        let exact = values.r;
        let (mean, error) = albedo.of(n);
        assert!(
            (mean - exact).abs() < error + 2e-5 * exact.max(1.0),
            "{name} {v:?}: weights of {mean} ± {error}, albedo {exact}"
        );
        let guess = lobe.albedo_guess(v);
        assert!(guess.is_finite() && guess >= 0.0, "{name} {v:?}: {guess}");
    }
}

/// In `f32`: the weight is the quotient that it stands for.
pub(crate) fn weights_are_quotients_in_f32(case: &Case, views: &[f64]) {
    let mut worst = (0.0, None);
    for v in views.iter().map(|z| view(*z).map(|x| x as f32)) {
        for i in 0..2000 {
            let sample = case.single.sample(v, point(i).map(|u| (u as f32).min(1.0 - f32::EPSILON / 2.0)));
            if sample.rejected {
                continue;
            }
            let (value, pdf) = case.single.eval_cos_pdf(sample.l, v);
            assert!(pdf == sample.pdf, "{}: {sample:?}, {pdf}", case.name);
            let exact = f64::from(value.g) / f64::from(pdf);
            // Far down a lobe a value is known to fewer digits, and a weight far below the albedo counts for less.
            let least = 1e-2 * f64::from(case.single.albedo_guess(v));
            let error = (f64::from(sample.weight.g) - exact).abs() / exact.max(least);
            if error > worst.0 {
                worst = (error, Some((v, sample)));
            }
        }
    }
    // `Fast` numbers, whose every operation is off by 2⁻¹³.
    let mut worst_fast = 0.0_f64;
    for v in views.iter().map(|z| view(*z).map(|x| Approximate::new(x as f32))) {
        for i in 0..2000 {
            let u = point(i).map(|u| Approximate::new((u as f32).min(1.0 - f32::EPSILON / 2.0)));
            let sample = case.fast.sample(v, u);
            if !sample.rejected {
                let (value, pdf) = case.fast.eval_cos_pdf(sample.l, v);
                let exact = f64::from(value.g.value()) / f64::from(pdf.value());
                let least = 1e-2 * f64::from(case.fast.albedo_guess(v).value());
                worst_fast = worst_fast.max((f64::from(sample.weight.g.value()) - exact).abs() / exact.max(least));
            }
        }
    }
    println!("{:9.1e} {:9.1e} {}", worst.0, worst_fast, case.name);
    assert!(worst_fast <= 0.05, "{}: {worst_fast}", case.name);
    assert!(worst.0 <= case.tolerance, "{}: {worst:?}", case.name);
}

/// [`ends_are_finite`](super::ends_are_finite), and in `Fast` numbers finite and about of unit length.
pub(crate) fn ends_are_finite(case: &Case) {
    super::ends_are_finite(&case.name, &*case.double, 0.0);
    super::ends_are_finite(&case.name, &*case.single, 0.0);
    let views =
        COSINES.into_iter().chain([-1e-20, -0.3, -1.0]).map(|z| view(z.abs()).map(|x| if z < 0.0 { -x } else { x }));
    for v in views.map(|v| v.map(|x| Approximate::new(x as f32))) {
        for a in single_ends() {
            for (b, c) in single_ends().flat_map(|b| single_ends().map(move |c| (b, c))) {
                let sample = case.fast.sample(v, [a, b, c].map(Approximate::new));
                let length = sample.l.map(Approximate::value).length();
                let what = || format!("fast {} {v:?} {:?}: {sample:?}", case.name, [a, b, c]);
                assert!((length - 1.0).abs() < 2e-3, "{}", what());
                assert!(sample.weight.g.value().is_finite() && sample.pdf.value().is_finite(), "{}", what());
            }
        }
    }
}

/// NaN in gives NaN out, a viewer below the horizon no sample, light from there no density.
pub(crate) fn nan_and_horizon(case: &Case) {
    nan_shows_and_below_is_nothing(&case.name, &*case.double, 0.0);
    nan_shows_and_below_is_nothing(&case.name, &*case.single, 0.0);
}

/// Where a lobe has a value, its sampler has a density, and their quotient is at most `bound` times the albedo of its
/// channel.
pub(crate) fn weights_are_at_most(bound: f64, case: &Case, views: &[f64]) {
    for v in views.iter().map(|z| view(*z)) {
        let sum = (0..4096).fold(Rgb::splat(0.0), |sum, i| sum + case.double.sample(v, point(i)).weight);
        let bound = sum * (bound / 4096.0);
        for i in 0..40_000 {
            // Even over the hemisphere, and dense around the mirror direction.
            let [x, y, choice] = point(i);
            let (sin, cos) = Real::sin_cos(y * std::f64::consts::TAU);
            let sin_theta = (x * (2.0 - x)).sqrt();
            let even = Vec3::new(sin_theta * cos, sin_theta * sin, 1.0 - x);
            let near = 10_f64.powf(-5.0 * x);
            let mirrored = Vec3::new(-v.x + near * cos, -v.y + near * sin, v.z + near * (choice - 0.5)).normalize();
            for l in [even, mirrored] {
                let (value, pdf) = case.double.eval_cos_pdf(l, v);
                for (value, bound) in [(value.r, bound.r), (value.g, bound.g), (value.b, bound.b)] {
                    // Far below what counts a value may be rounding alone.
                    let fine = value < 1e-30 || value <= bound * pdf;
                    assert!(fine, "{} {v:?} {l:?}: {value} by {pdf}, at most {bound}", case.name);
                }
            }
        }
    }
}
