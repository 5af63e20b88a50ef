//! The samplers of this workspace, for one suite: every model of the catalogue, and what is built of them.

use super::random::seed;
use super::sampler::{InDouble, InSingle, Sampler};
use super::{Effort, Suite, counted, view};
use crate::extremes::{Random, grid_values, is_logarithmic, lobe};
use lobe::distribution::{Beckmann, Ggx};
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Black, Clearcoat, Coat, Lambert, Microfacet, Mirror, Phong, Real, Rgb, Shininess, Sum};
use lobe_models::{AnySampler, Kind, Lobe, Model, Parameter, Value};
use lobe_sampling::facets::{Bounded, ByDistribution, Caps, ProjectedDisc};
use lobe_sampling::{ByCosine, SampleBy};

/// Cosine and azimuth of the views: along the normal, grazing and oblique, and between.
const VIEWS: [(f64, f64); 5] = [(1.0, 0.0), (0.01, 75.0), (0.5, 30.0), (0.1, 120.0), (0.9, 210.0)];

/// The samplers of this workspace, at the first [`Effort::views`] of five views with cosines from 1 to 0.01:
///
/// - [`Effort::lobes`] lobes of each model of the catalogue or more, so that each value that counts for a sampler is
///   there: each word of a choice, widths of 1e-3, 0.05, 0.3 and 1 and aspects to 16, exponents from 0 to 1e6,
///   roughness from 0.1 to 1; of `microfacet`, whose distributions and maskings are many, six times as many;
/// - the sharp ones among them in `f32` too, and an ordinary one;
/// - GGX by each way to draw its facets, mixtures of up to four lobes, with a mirror too, and coats.
///
/// ```
/// use lobe_verify::sampling::{Catalogue, Effort};
///
/// let lambert = lobe_models::models().find(|model| model.name == "lambert").unwrap();
/// let catalogue = Catalogue::of(lambert, Effort { views: 1, ..Effort::QUICK });
/// let suite = catalogue.verify(&|| print!("."));
/// assert!(suite.holds() && suite.reports.len() == catalogue.len());
/// ```
#[expect(missing_debug_implementations, reason = "samplers in boxes show nothing")]
pub struct Catalogue {
    list: List,
    effort: Effort,
}

impl Catalogue {
    /// All of them.
    #[must_use]
    pub fn new(effort: Effort) -> Self {
        Self { list: List::new(effort), effort }
    }

    /// Those of one model.
    #[must_use]
    pub fn of(model: &Model, effort: Effort) -> Self {
        let mut list = List::new(effort);
        list.double.retain(|(name, _)| is_of(name, model));
        list.single.retain(|(name, _)| is_of(name, model));
        Self { list, effort }
    }

    /// How many samplers there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.list.double.len() + self.list.single.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The verdicts of [`verify_all`](super::verify_all); `done` is called after each sampler.
    #[must_use]
    pub fn verify(&self, done: &(dyn Fn() + Sync)) -> Suite {
        let double: Vec<_> = self.list.double.iter().map(|(name, lobe)| (&**name, InDouble(&**lobe))).collect();
        let single: Vec<_> = self.list.single.iter().map(|(name, lobe)| (&**name, InSingle(&**lobe))).collect();
        let mut samplers: Vec<_> = double.iter().map(|(name, lobe)| (*name, lobe as &dyn Sampler)).collect();
        samplers.extend(single.iter().map(|(name, lobe)| (*name, lobe as &dyn Sampler)));
        let views: Vec<_> = VIEWS.iter().take(self.effort.views).map(|(cos, azimuth)| view(*cos, *azimuth)).collect();
        counted(&samplers, &views, &self.effort, done)
    }
}

/// [`Catalogue::verify`] of all samplers of this workspace: with [`Effort::QUICK`] a quarter of a minute of two cores,
/// with [`Effort::FULL`] three quarters of an hour.
#[must_use]
pub fn models(effort: Effort) -> Suite {
    Catalogue::new(effort).verify(&|| ())
}

fn is_of(name: &str, model: &Model) -> bool {
    name.split(' ').next() == Some(model.name)
}

/// A sampler with its name.
type Named<R> = (String, AnySampler<R>);

/// The samplers of [`models`]. Their names begin with that of the model, where there is one.
struct List {
    double: Vec<Named<f64>>,
    single: Vec<Named<f32>>,
}

impl List {
    fn new(effort: Effort) -> Self {
        let every = effort.lobes > 1;
        let (mut double, mut single) = (methods(every), Vec::new());
        double.extend(combined(0.0_f64));
        if every {
            single.extend(combined(0.0_f32));
        }
        for model in lobe_models::models() {
            let (typical, lobes) = (model.typical(), lobes(model, effort.lobes));
            for lobe in &lobes {
                if is_sharp(lobe) && *lobe != typical {
                    single.push((name(lobe), lobe.sampler()));
                }
                double.push((name(lobe), lobe.sampler()));
            }
            if every || !lobes.iter().any(is_sharp) {
                single.push((name(&typical), typical.sampler()));
            }
        }
        for (name, _) in &mut single {
            name.push_str(" in f32");
        }
        Self { double, single }
    }
}

/// The lobe with all its parameters.
fn name(lobe: &Lobe) -> String {
    let parts = lobe.values().filter(|(parameter, value)| parameter.default != Some(*value));
    let parts = parts.map(|(parameter, value)| {
        let value = match value {
            // The shape of a table, by its largest value.
            Value::Table(values) => {
                let most = values.iter().zip(0..).max_by(|a, b| a.0.total_cmp(b.0));
                format!("{} at {}", most.map_or(0.0, |(x, _)| *x), most.map_or(0, |(_, i)| i))
            }
            value => value.bare(),
        };
        format!(" {}={value}", parameter.name)
    });
    std::iter::once(lobe.model().name.to_owned()).chain(parts).collect()
}

/// At most `most` lobes, of which more than one are at least as many as a parameter has values: each value comes as
/// often as any other of its parameter, in an order of its own. Of a model with more than twenty words, `microfacet`,
/// six times as many.
fn lobes(model: &'static Model, most: usize) -> Vec<Lobe> {
    let mut axes: Vec<_> = model.parameters.iter().map(|parameter| values(model, parameter)).collect();
    let words = model.parameters.iter().map(|parameter| match parameter.kind {
        Kind::Choice(words) => words.len(),
        _ => 0,
    });
    let scale = if words.sum::<usize>() > 20 { 6 } else { 1 };
    let longest = axes.iter().map(Vec::len).max().unwrap_or(0);
    let count = if most > 1 { (scale * most).max(longest) } else { most };
    let mut random = Random::new(seed(model.name));
    let mut lobes: Vec<Lobe> = Vec::new();
    for i in 0..count {
        let mut values = Vec::new();
        for axis in &mut axes {
            let place = i % axis.len().max(1);
            // From the front on: the value that comes next is one of those that are left.
            if place < axis.len() {
                let other = place + random.below(axis.len() - place);
                axis.swap(place, other);
            }
            values.extend(axis.get(place).copied());
        }
        // No name twice: the seeds are made from them.
        lobes.extend(lobe(model, values).filter(|lobe| !lobes.contains(lobe)));
    }
    lobes
}

/// The values of a parameter, all inside its domain.
fn values(model: &'static Model, parameter: &'static Parameter) -> Vec<Value> {
    let typical = model.typical().value(parameter.name);
    let values: Vec<Value> = match parameter.kind {
        // Of one colour, and with a channel without light.
        Kind::Colour { max } => {
            let top = max.min(1.0);
            typical.into_iter().chain([Value::Colour([top, 0.04 * top, 0.0])]).collect()
        }
        Kind::Number { min, max } => {
            let numbers: &[f64] = match parameter.name {
                "roughness" | "clearcoat-roughness" | "sheen-roughness" => &[0.1, 0.5, 1.0],
                _ if is_logarithmic(min, max) => &[0.0, 1.0, 50.0, 1e4, 1e6],
                // A width.
                _ if min > 0.0 && min <= 0.01 && max == 1.0 => &[1e-3, 0.05, 0.3, 1.0],
                _ => &[min, min + (max - min) / 3.0, max],
            };
            let inside = numbers.iter().filter(|x| (min..=max).contains(x));
            inside.map(|x| Value::Number(*x)).chain(typical).collect()
        }
        Kind::Widths => [[1e-3; 2], [0.05; 2], [0.3; 2], [1.0; 2], [1.0, 0.0625], [0.05, 0.8], [1e-3, 4e-3]]
            .map(Value::Widths)
            .to_vec(),
        kind @ (Kind::Table | Kind::Choice(_)) => grid_values(kind).into_iter().chain(typical).collect(),
    };
    let mut seen: Vec<Value> = Vec::new();
    for value in values {
        if !seen.contains(&value) {
            seen.push(value);
        }
    }
    seen
}

/// Whether a width or an exponent makes a lobe narrower than a degree or two.
fn is_sharp(lobe: &Lobe) -> bool {
    lobe.values().any(|(parameter, value)| match (parameter.kind, value) {
        (_, Value::Widths(widths)) => widths.iter().any(|x| *x <= 0.05),
        (Kind::Number { min, max }, Value::Number(x)) if is_logarithmic(min, max) => x >= 1e4,
        (Kind::Number { min, max }, Value::Number(x)) => min > 0.0 && max == 1.0 && x <= 0.1,
        _ => false,
    })
}

type Metal<R> = Microfacet<Ggx<R>, SmithCorrelated, Schlick<R>>;

/// GGX without a loss at the facets.
fn metal<R: Real>(x: R, y: R) -> Microfacet<lobe::distribution::GgxAnisotropic<R>, SmithCorrelated, Schlick<R>> {
    Microfacet::new(Ggx::anisotropic(Alpha(x), Alpha(y)), SmithCorrelated, Schlick::new(Rgb::splat(x.lift(1.0))))
}

/// The ways to draw the facets of GGX.
fn methods(every: bool) -> Vec<Named<f64>> {
    let widths = [(1e-3, 1e-3), (0.3, 0.3), (1.0, 0.0625), (0.05, 0.05), (1.0, 1.0), (0.01, 0.16)];
    let mut all: Vec<Named<f64>> = Vec::new();
    for (x, y) in widths.into_iter().take(if every { 6 } else { 3 }) {
        let lobe = metal(x, y);
        all.push((format!("ggx {x} {y} by bounded caps"), Box::new(lobe.by(Bounded))));
        all.push((format!("ggx {x} {y} by caps"), Box::new(lobe.by(Caps))));
        all.push((format!("ggx {x} {y} by the projected disc"), Box::new(lobe.by(ProjectedDisc))));
        all.push((format!("ggx {x} {y} by the distribution"), Box::new(lobe.by(ByDistribution))));
        let beckmann = Microfacet::new(Beckmann::anisotropic(Alpha(x), Alpha(y)), SmithCorrelated, *lobe.fresnel());
        all.push((format!("beckmann {x} {y} by the distribution"), Box::new(beckmann.by(ByDistribution))));
    }
    all
}

/// Sums, deltas and layers.
fn combined<R: Real + Send + Sync + 'static>(w: R) -> Vec<Named<R>> {
    let facets = |alpha: f64, f0: f64| -> Metal<R> {
        Microfacet::new(Ggx::new(Alpha(w.lift(alpha))), SmithCorrelated, Schlick::new(Rgb::splat(w.lift(f0))))
    };
    let (chalk, varnish) =
        (Lambert::new(Rgb::new(0.8, 0.5, 0.1).map(|x| w.lift(x))), Schlick::new(Rgb::splat(w.lift(0.04))));
    let gold = Schlick::new(Rgb::new(1.0, 0.77, 0.34).map(|x| w.lift(x)));
    let beckmann = Microfacet::new(Beckmann::new(Alpha(w.lift(0.3))), SmithCorrelated, varnish);
    let highlight = Phong::new(Rgb::splat(w.lift(0.3)), Shininess(w.lift(1e4)));
    let silver = Mirror::new(Rgb::splat(w.lift(0.3)));
    vec![
        ("lambert by the cosine".into(), Box::new(ByCosine(chalk))),
        ("lambert + ggx 0.3".into(), Box::new(Sum { a: chalk, b: facets(0.3, 0.04) })),
        ("lambert + ggx 1e-3".into(), Box::new(Sum { a: chalk, b: facets(1e-3, 0.5) })),
        ("lambert + ggx 0.05 + phong 1e4".into(), Box::new(Sum { a: chalk, b: facets(0.05, 0.3) } + highlight)),
        (
            "lambert + ggx 0.3, ggx 1e-3 + beckmann".into(),
            Box::new(Sum { a: Sum { a: chalk, b: facets(0.3, 0.9) }, b: Sum { a: facets(1e-3, 0.2), b: beckmann } }),
        ),
        ("ggx 0.3 + nothing".into(), Box::new(Sum { a: facets(0.3, 0.5), b: Black })),
        ("mirror".into(), Box::new(silver)),
        ("lambert + mirror".into(), Box::new(Sum { a: chalk, b: silver })),
        ("mirror + ggx 0.05 + lambert".into(), Box::new(Sum { a: silver, b: facets(0.05, 0.5) } + chalk)),
        ("ggx 0.3 over a mirror".into(), Box::new(Coat::new(facets(0.3, 0.04), varnish, silver))),
        ("ggx 1e-3 over lambert".into(), Box::new(Coat::new(facets(1e-3, 0.04), varnish, chalk))),
        (
            "beckmann over ggx 0.05 over lambert".into(),
            Box::new(Coat::new(beckmann, varnish, Coat::new(facets(0.05, 0.8), gold, chalk))),
        ),
        (
            "clearcoat 0.05 over ggx 0.3".into(),
            Box::new(Clearcoat::new(facets(0.3, 0.9), w.lift(1.0), Alpha(w.lift(0.05)))),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_of_every_parameter_is_among_the_full_list() {
        for model in lobe_models::models() {
            let lobes = lobes(model, Effort::FULL.lobes);
            for parameter in model.parameters {
                for value in values(model, parameter) {
                    let has = lobes.iter().any(|lobe| lobe.value(parameter.name) == Some(value));
                    assert!(has, "no lobe of {} has {} = {value}", model.name, parameter.name);
                }
            }
        }
    }

    #[test]
    fn no_name_is_there_twice_and_no_model_is_missing() {
        for effort in [Effort::QUICK, Effort::FULL] {
            let List { double, single } = List::new(effort);
            let names: Vec<_> =
                double.into_iter().map(|(name, _)| name).chain(single.into_iter().map(|(name, _)| name)).collect();
            let different: std::collections::HashSet<_> = names.iter().collect();
            assert_eq!(names.len(), different.len());
            for model in lobe_models::models() {
                let of_model = names.iter().filter(|name| is_of(name, model)).count();
                assert!(of_model > 1, "{}: {of_model}", model.name);
            }
        }
    }
}
