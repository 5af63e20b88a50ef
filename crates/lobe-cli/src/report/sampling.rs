//! What directions are drawn from a material, over what it reflects: a sampler that misses something is seen at once.

use super::random::Random;
use crate::plot::samples;
use crate::plot::svg::Svg;
pub(crate) use crate::plot::{DECADES, SHOWN};
use lobe::Vec3;
use lobe_sampling::Outcome;
use lobe_scene::Material;
use serde::Serialize;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Those that the numbers are from.
pub(crate) const DRAWN: u32 = 1 << 14;

/// How well a material is sampled, for a viewer at 45°.
#[derive(Debug, Serialize)]
pub(crate) struct Sampling {
    /// The part of the samples that are none: what was drawn lies below the horizon.
    pub(crate) rejected: f64,
    /// The variance of the weights, in luminance, over the square of their mean: the noise of one sample in a white world.
    pub(crate) relative_variance: f64,
    /// What it would be with samples by the cosine. Nothing where it has no bound.
    pub(crate) relative_variance_by_cosine: Option<f64>,
    #[serde(skip)]
    pub(crate) svg: Svg,
}

/// The samples of a material; nothing for one that reflects nothing but in a mirror.
pub(super) fn of(material: &Material) -> Option<Sampling> {
    let sampler = material.surface.sampler()?;
    let v = Vec3::new(FRAC_1_SQRT_2 as f32, 0.0, FRAC_1_SQRT_2 as f32);
    let mut random = Random::new();
    let (mut sums, mut rejected, mut shown) = (Sums::default(), 0, Vec::new());
    for drawn in 0..DRAWN {
        let u = [random.unit(), random.unit(), random.unit()].map(|u| (u as f32).min(BELOW_ONE));
        match sampler.sample(v, u).outcome() {
            Outcome::Scattered { l, weight, .. } => {
                let f = f64::from(sampler.eval_cos_pdf(l, v).0.luminance()) / f64::from(l.z);
                sums.add(f64::from(weight.luminance()), f);
                if (drawn as usize) < SHOWN {
                    shown.push((f64::from(l.x), f64::from(l.y)));
                }
            }
            Outcome::Delta { .. } | Outcome::Rejected => rejected += 1,
        }
    }
    let (relative_variance, by_cosine) = sums.relative_variances()?;
    // The lecture's highlights have no cosine: divided by it they have no bound at the horizon.
    let bounded = material.surface.lobes().iter().all(|lobe| !lobe.model.ends_with("-highlight"));
    let name = &material.name;
    let title =
        format!("{SHOWN} directions of light drawn from {name} for a viewer at 45°, over what it reflects from there");
    Some(Sampling {
        rejected: f64::from(rejected) / f64::from(DRAWN),
        relative_variance,
        relative_variance_by_cosine: bounded.then_some(by_cosine),
        svg: samples(&*sampler, v, &shown, &title)?,
    })
}

/// The last number before 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// Sums over samples; those that are rejected add nothing.
#[derive(Default)]
struct Sums {
    weight: f64,
    square: f64,
    by_cosine: f64,
}

impl Sums {
    /// A sample where the BRDF is `f`.
    fn add(&mut self, weight: f64, f: f64) {
        self.weight += weight;
        self.square += weight * weight;
        // By the cosine the weight were `π f`, and its square has the mean ∫ π f² (n·l) dl: of samples of another density the
        // mean of their weight times `π f`. So a peak is met that the cosine itself would hardly ever find.
        self.by_cosine += weight * PI * f;
    }

    /// The relative variance, and that by the cosine; nothing without light, and of numbers that are none.
    fn relative_variances(&self) -> Option<(f64, f64)> {
        let count = f64::from(DRAWN);
        let mean = self.weight / count;
        let of = |square: f64| (square / count / (mean * mean) - 1.0).max(0.0);
        let (own, cosine) = (of(self.square), of(self.by_cosine));
        (mean > 0.0 && own.is_finite() && cosine.is_finite()).then_some((own, cosine))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn sampling(lobes: &str) -> Sampling {
        let lobes = lobe_models::Material::from_json(&format!("{{\"lobes\": [{lobes}]}}")).expect("a material");
        of(&Material::from_lobes("m", &lobes)).expect("it reflects")
    }

    #[test]
    fn the_numbers_are_those_that_are_known() {
        // By the cosine each weight is the albedo.
        let chalk = sampling(r#"{"model": "lambert", "albedo": 0.5}"#);
        assert!(chalk.rejected == 0.0 && chalk.relative_variance < 1e-9, "{chalk:?}");
        assert!(chalk.relative_variance_by_cosine.is_some_and(|x| x < 1e-6), "{chalk:?}");
        // A smooth metal: its own samples are nearly even, and one by the cosine in some hundreds meets the highlight.
        let metal = sampling(r#"{"model": "microfacet", "alpha": 0.05, "f0": 1}"#);
        assert!(metal.rejected < 0.01 && metal.relative_variance < 0.05, "{metal:?}");
        assert!(metal.relative_variance_by_cosine.is_some_and(|x| x > 50.0), "{metal:?}");
    }

    #[test]
    fn the_variance_by_the_cosine_is_that_of_such_samples() {
        let sampler = lobe_models::model("blinn-phong").expect("there is one").typical().sampler::<f32>();
        let v = Vec3::new(FRAC_1_SQRT_2 as f32, 0.0, FRAC_1_SQRT_2 as f32);
        let mut random = Random::new();
        let (mut own, mut direct) = (Sums::default(), (0.0, 0.0));
        for _ in 0..DRAWN {
            let u = [random.unit(), random.unit(), random.unit()].map(|u| u as f32);
            if let Outcome::Scattered { l, weight, .. } = sampler.sample(v, u).outcome() {
                own.add(f64::from(weight.luminance()), f64::from(sampler.eval_cos_pdf(l, v).0.luminance() / l.z));
            }
        }
        let draws = 40 * DRAWN;
        for _ in 0..draws {
            let (r, z) = (random.unit(), TAU * random.unit());
            let l = Vec3::new(r.sqrt() * z.cos(), r.sqrt() * z.sin(), (1.0 - r).sqrt()).map(|x| x as f32);
            let weight = PI * f64::from(sampler.eval_cos_pdf(l, v).0.luminance() / l.z);
            direct = (direct.0 + weight, direct.1 + weight * weight);
        }
        let count = f64::from(draws);
        let expected = direct.1 / count / (direct.0 / count).powi(2) - 1.0;
        let (_, found) = own.relative_variances().expect("it reflects");
        assert!((found / expected - 1.0).abs() < 0.05, "{found} {expected}");
    }

    #[test]
    fn a_picture_has_its_dots_and_what_reflects_nothing_has_none() {
        let chalk = sampling(r#"{"model": "lambert", "albedo": 0.5}"#);
        let svg = chalk.svg.inline();
        let dots = svg.split("class=\"drawn\"").nth(1).and_then(|rest| rest.split("/>").next());
        assert_eq!(dots.map(|dots| dots.matches("h0").count()), Some(SHOWN));
        assert!(svg.contains("<image") && !svg.contains("NaN"));
        assert!(of(&Material::new("black", lobe_scene::Surface::Black)).is_none());
    }
}
