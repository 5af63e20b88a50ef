//! The scene's materials: what they are made of, and how much light they reflect.

use super::furnace::{self, Curve};
use super::sampling::{self, Sampling};
use lobe::{Alpha, Brdf, Rgb, Vec3};
use lobe_energy::{Albedo, Exchanged, directional_albedo_to, microfacet_albedo_to};
use lobe_models::{Lobe, Value};
use lobe_scene::image::Display;
use lobe_scene::{LobeRecord, Material, Renderer, Scene, Settings, Surface, View, procedural};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;

/// A material that a view shows.
pub(crate) struct Shown<'a> {
    pub(crate) material: Material,
    /// What it was built from, if a view puts it in the place of one of the scene's materials.
    pub(crate) lobes: Option<&'a lobe_models::Material>,
    /// The views that put it there.
    views: Vec<String>,
}

/// What the views show, once each: the materials of the scene, and what a view puts in their place.
pub(crate) fn shown(scene: &Scene) -> Vec<Shown<'_>> {
    let mut shown: Vec<Shown<'_>> = Vec::new();
    static NOTHING: BTreeMap<String, lobe_models::Material> = BTreeMap::new();
    let named: Vec<&str> = scene.views.iter().map(|view| view.name.as_str()).collect();
    let replaced = scene.views.iter().map(|view| &view.materials);
    let all: Vec<_> = if named.is_empty() { vec![&NOTHING] } else { replaced.collect() };
    for (index, replaced) in all.into_iter().enumerate() {
        for material in &scene.materials {
            let lobes = replaced.get(&material.name).or_else(|| replaced.get(View::ALL));
            let name = match lobes {
                Some(lobes) if lobes.name != lobes.description() => &lobes.name,
                _ => &material.name,
            };
            let view = lobes.and(named.get(index)).map(|view| (*view).to_owned());
            if let Some(known) = shown.iter_mut().find(|known| known.material.name == *name && known.lobes == lobes) {
                known.views.extend(view.filter(|view| !known.views.contains(view)));
                continue;
            }
            let material = match lobes {
                Some(lobes) => Material { dissolve: material.dissolve, ..Material::from_lobes(name, lobes) },
                None => material.clone(),
            };
            shown.push(Shown { material, lobes, views: view.into_iter().collect() });
        }
    }
    shown
}

/// A row of the table.
#[derive(Debug, Serialize)]
pub(crate) struct MaterialFacts {
    pub(crate) name: String,
    /// The views that put it in the place of another; empty for a material of the scene itself.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) views: Vec<String>,
    pub(crate) lobes: Vec<LobeFacts>,
    pub(crate) ambient: [f32; 3],
    pub(crate) emission: [f32; 3],
    pub(crate) dissolve: f32,
    /// The directional albedo, with the mirror, at [`SHOWN`] degrees. Empty if a lobe cannot be integrated.
    pub(crate) albedo: Vec<[f64; 3]>,
    /// The highest albedo of a channel at any of the angles tried: of what is seen in a white world, or of what is
    /// reflected of the light from one direction. For reciprocal lobes the two are the same.
    pub(crate) highest: Option<f64>,
    /// Where it is, in words: `seen from 45°`, or `light from 89°`.
    pub(crate) highest_at: String,
    pub(crate) gains_energy: bool,
    /// The verdict in words, with what would mend it.
    pub(crate) verdict: String,
    /// Which lobes it is made of, and why, in words.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) reasons: Vec<String>,
    /// How it is sampled; nothing for one without lobes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sampling: Option<Sampling>,
    /// A PNG file of a sphere of it.
    #[serde(skip)]
    pub(crate) ball: Option<Vec<u8>>,
    /// The albedo over the angle of the view, in degrees.
    #[serde(skip)]
    pub(crate) curve: Curve,
    /// A PNG file of a sphere of it in a white world.
    #[serde(skip)]
    pub(crate) furnace: Option<Vec<u8>>,
}

/// The pixels of a sphere, to both sides.
pub(crate) const BALL: u32 = 128;

/// All spheres together, as PNG: beside the pictures of the views the page stays below 5 MB.
const MOST_BYTES: usize = 500_000;

/// Takes away the spheres that the page has no room for.
pub(crate) fn keep_the_first_balls(materials: &mut [MaterialFacts]) {
    let mut bytes = 0;
    for material in materials {
        bytes += [&material.ball, &material.furnace].into_iter().flatten().map(Vec::len).sum::<usize>();
        if bytes > MOST_BYTES {
            material.ball = None;
            material.furnace = None;
        }
    }
}

/// A sphere of the material under the light of a contact sheet. Nothing for one that cannot be drawn.
fn ball(material: &Material) -> Option<Vec<u8>> {
    let scene = procedural::swatch(material.clone()).ok()?;
    let settings = Settings { width: BALL, height: BALL, samples: 4, ..Settings::default() };
    let image = Renderer::new(&scene).ok()?.render(scene.views.first()?, &settings, None).ok()?;
    image.to_png(&Display::default()).ok()
}

/// One lobe of a material.
#[derive(Debug, Serialize)]
pub(crate) struct LobeFacts {
    pub(crate) model: String,
    pub(crate) reflectance: Option<[f32; 3]>,
    pub(crate) exponent: Option<f32>,
    /// The other parameters, in words.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(crate) parameters: String,
}

/// The angles in the table.
pub(crate) const SHOWN: [f64; 3] = [0.0, 45.0, 85.0];
/// The angles at which the verdict looks, those of the table first.
const TRIED: [f64; 7] = [0.0, 45.0, 85.0, 25.0, 65.0, 75.0, 89.0];

/// The largest error of an albedo that is shown: four digits are.
const QUADRATURE_ERROR: f64 = 1e-5;

/// The lobes of a material as one BRDF.
pub(crate) struct Whole(Vec<LobeRecord>);

impl Brdf<f64> for Whole {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.sum(|lobe| lobe.eval(l, v))
    }
    fn eval_cos(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.sum(|lobe| lobe.eval_cos(l, v))
    }
}

impl Whole {
    fn sum(&self, value: impl Fn(&dyn Brdf<f64>) -> Rgb<f64>) -> Rgb<f64> {
        let lobes = self.0.iter().filter_map(|record| record.reference.as_deref());
        lobes.fold(Rgb::splat(0.0), |sum, lobe| sum + value(lobe))
    }

    /// All lobes of the material that can be evaluated in `f64`.
    pub(crate) fn of(material: &Material) -> Self {
        Self(material.surface.lobes())
    }

    /// Whether there is something beside the diffuse lobe.
    pub(crate) fn has_highlight(&self) -> bool {
        self.0.iter().any(|lobe| lobe.model != "lambert")
    }

    /// The name for a legend: `gold: q=200`.
    pub(crate) fn legend(&self, name: &str) -> String {
        match self.0.iter().find_map(|lobe| lobe.exponent) {
            Some(q) => format!("{name}: q={q}"),
            None => name.to_owned(),
        }
    }
}

/// The names of `lobe eval` for the lecture's highlights.
fn model_name(model: &str) -> &str {
    match model {
        "phong-highlight" => "lecture-phong",
        "blinn-torrance-highlight" => "lecture-blinn-torrance",
        other => other,
    }
}

/// Everything about all materials; `done` is called after each.
pub(crate) fn facts(materials: &[Shown<'_>], done: &(dyn Fn() + Sync)) -> Vec<MaterialFacts> {
    materials
        .par_iter()
        .map(|shown| {
            let facts = one(shown);
            done();
            facts
        })
        .collect()
}

fn one(shown: &Shown<'_>) -> MaterialFacts {
    let material = &shown.material;
    let whole = Whole::of(material);
    let mirror: Rgb<f64> = material.mirror.ks().map(f64::from);
    let can_be_integrated = whole.0.iter().all(|lobe| lobe.reference.is_some());
    let at_all_angles = |brdf: &dyn Brdf<f64>| -> Vec<[f64; 3]> {
        let directions = TRIED.map(|angle| angle.to_radians().sin_cos()).map(|(sin, cos)| Vec3::new(sin, 0.0, cos));
        let albedos: Vec<Albedo> =
            directions.iter().map(|&v| directional_albedo_to(QUADRATURE_ERROR, brdf, v)).collect();
        // One that has not converged, or is NaN, is no figure to show.
        let good = albedos.iter().all(|albedo| albedo.error <= QUADRATURE_ERROR);
        if good { albedos.iter().map(|albedo| (albedo.value + mirror).into()).collect() } else { Vec::new() }
    };
    let seen = if can_be_integrated { at_all_angles(&whole) } else { Vec::new() };
    let reflected = match shown.lobes {
        _ if !can_be_integrated => Vec::new(),
        Some(lobes) if lobes.is_reciprocal() => seen.clone(),
        _ => at_all_angles(&Exchanged(&whole)),
    };
    let known = !seen.is_empty() && !reflected.is_empty();
    let highest = [("seen from", &seen), ("light from", &reflected)]
        .into_iter()
        .flat_map(|(side, all)| TRIED.iter().zip(all).map(move |(angle, rgb)| (side, angle, rgb)))
        .map(|(side, angle, rgb)| (format!("{side} {angle}°"), rgb.iter().fold(0.0_f64, |max, &x| max.max(x))))
        // The first of equals, but for the rounding of the quadrature.
        .fold((String::new(), 0.0), |best, next| if next.1 > best.1 + 1e-6 { next } else { best });

    let mut lobes: Vec<LobeFacts> = whole
        .0
        .iter()
        .map(|lobe| LobeFacts {
            model: model_name(lobe.model).to_owned(),
            reflectance: lobe.reflectance,
            exponent: lobe.exponent,
            parameters: lobe.parameters.clone(),
        })
        .collect();
    if mirror != Rgb::splat(0.0) {
        let reflectance = Some(material.mirror.ks().into());
        lobes.push(LobeFacts { model: "mirror".to_owned(), reflectance, exponent: None, parameters: String::new() });
    }
    // The tolerance is that of the quadrature; coefficients that were rounded to f32 are below it.
    let gains_energy = highest.1 > 1.0 + QUADRATURE_ERROR;
    let mut curve: Curve = TRIED.into_iter().zip(seen.iter().copied()).collect();
    curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    MaterialFacts {
        name: material.name.clone(),
        views: shown.views.clone(),
        ambient: material.ambient.into(),
        emission: material.emission.into(),
        dissolve: material.dissolve,
        albedo: seen.iter().take(SHOWN.len()).copied().collect(),
        highest: known.then_some(highest.1),
        gains_energy,
        verdict: match lost(material, seen.first()) {
            Some(remedy) if known && !gains_energy => verdict(known, &highest, gains_energy, &lobes) + &remedy,
            _ => verdict(known, &highest, gains_energy, &lobes),
        },
        reasons: material.reasons(),
        sampling: sampling::of(material),
        ball: ball(material),
        furnace: furnace::picture(&curve),
        curve,
        highest_at: highest.0,
        lobes,
    }
}

fn verdict(known: bool, (place, highest): &(String, f64), gains_energy: bool, lobes: &[LobeFacts]) -> String {
    if !known {
        return "not known: a lobe cannot be integrated, or its integral does not converge".to_owned();
    }
    if lobes.is_empty() {
        return "reflects no light".to_owned();
    }
    let lecture = lobes.iter().any(|lobe| lobe.model.starts_with("lecture-") && lobe.reflectance != Some([0.0; 3]));
    if !gains_energy && lecture {
        return format!(
            "at most {:.1} % up to 89°; nearer to grazing light the lecture's highlight, which has no cosine, gains without bound",
            highest * 100.0
        );
    }
    if !gains_energy {
        return format!("conserves energy: reflects at most {:.1} %", highest * 100.0);
    }
    let mirrored = lobes.iter().any(|lobe| lobe.model == "mirror");
    if lecture && !mirrored && place.starts_with("light") {
        return format!(
            "gains energy: {:.0} %, {place}: the lecture's highlight has no cosine, so towards grazing light it gains without \
             bound. Render with --shading normalized-blinn-phong and Kd + Ks at most 1",
            highest * 100.0
        );
    }
    if lobes.iter().any(|lobe| lobe.model.starts_with("gltf")) {
        return format!(
            "gains energy: {:.1} %, {place}, as the equations of glTF 2.0 do towards grazing light: they weigh what is below \
             by the Fresnel term of one direction alone",
            highest * 100.0
        );
    }
    // Rounded down, so that the factor that is named does mend it.
    let factor = (99.9 / highest).floor() / 100.0;
    let mut text = format!("gains energy: {:.1} %, {place}. Scale Kd and Ks by {factor:.2}", highest * 100.0);
    match (lecture, mirrored) {
        (_, true) => text += ", or lower Ks: it counts twice, for the mirror and for the highlight",
        (true, false) => text += ", or render with --shading normalized-blinn-phong and Kd + Ks at most 1",
        (false, false) => text += ", so that Kd + Ks is at most 1",
    }
    text
}

/// The part of the light that a metal loses between its facets, straight on, from which on a remedy is named.
const WORTH_A_WORD: f64 = 0.01;

/// What a rough metal loses between its facets and what would give it back, in words; `seen` is the albedo straight on.
fn lost(material: &Material, seen: Option<&[f64; 3]>) -> Option<String> {
    let lobes = match &material.surface {
        Surface::Lobes(named) => named.material().lobes.clone(),
        Surface::Gltf(gltf) => gltf.lobes(),
        _ => return None,
    };
    let straight_on = Vec3::new(0.0, 0.0, 1.0);
    let mut gain = [0.0; 3];
    let mut replaced = Vec::new();
    for lobe in &lobes {
        let Some((alpha, better)) = compensated(lobe) else { continue };
        let albedo = |lobe: &Lobe| {
            let width = (Alpha(alpha), Alpha(alpha));
            microfacet_albedo_to(QUADRATURE_ERROR, &*lobe.build::<f64>(), width, straight_on)
        };
        let (once, all) = (albedo(lobe), albedo(&better));
        let (once, all) = (<[f64; 3]>::from(once.value), <[f64; 3]>::from(all.value));
        for (gain, (all, once)) in gain.iter_mut().zip(all.into_iter().zip(once)) {
            *gain += all - once;
        }
        if !replaced.contains(&lobe.model().name) {
            replaced.push(lobe.model().name);
        }
    }
    // Of the channels that which gains most: what a colour loses, it loses where it is bright.
    let (seen, gain) =
        seen?.iter().zip(gain).fold((0.0, 0.0), |most, (seen, gain)| if gain > most.1 { (*seen, gain) } else { most });
    (gain >= WORTH_A_WORD).then(|| {
        format!(
            ". Straight on it reflects {:.1} %, and loses light between its facets: with `kulla-conty` in the place of \
             `{}`, which gives further reflections back, it would be {:.1} %",
            seen * 100.0,
            replaced.join("` and `"),
            (seen + gain) * 100.0
        )
    })
}

/// The width of a lobe that is a metal's GGX and reflects once, and the same with its further reflections.
fn compensated(lobe: &Lobe) -> Option<(f64, Lobe)> {
    const METAL: f64 = 0.2;
    let number = |name: &str| match lobe.value(name) {
        Some(Value::Number(x)) => Some(x),
        _ => None,
    };
    let is_bright = |name: &str| matches!(lobe.value(name), Some(Value::Colour(c)) if c.iter().any(|c| *c >= METAL));
    let (alpha, given): (f64, Vec<(&str, Value)>) = match lobe.model().name {
        "microfacet" => {
            let word = |name: &str| match lobe.value(name) {
                Some(Value::Choice(word)) => word,
                _ => "",
            };
            let Some(Value::Widths([x, y])) = lobe.value("alpha") else { return None };
            let metal = match word("fresnel") {
                "schlick" => is_bright("f0"),
                form => form == "conductor",
            };
            if x != y || !metal || word("distribution") != "ggx" || word("masking") != "smith-correlated" {
                return None;
            }
            let terms = ["fresnel", "f0", "f90", "metal", "eta", "k"];
            (x, terms.into_iter().filter_map(|name| Some((name, lobe.value(name)?))).collect())
        }
        "gltf" if number("metallic") == Some(1.0) && number("anisotropy") == Some(0.0) && is_bright("base-color") => {
            (number("roughness")?.powi(2), vec![("f0", lobe.value("base-color")?)])
        }
        _ => return None,
    };
    let given: Vec<_> = given.into_iter().chain([("alpha", Value::Number(alpha))]).collect();
    let better = Lobe::new(lobe_models::model("kulla-conty")?, &given).ok()?;
    Some((alpha, better.with_weight(lobe.weight()).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(lobes: &str) -> String {
        let lobes = lobe_models::Material::from_json(&format!("{{\"lobes\": [{lobes}]}}")).expect("a material");
        let material = Material::from_lobes("m", &lobes);
        one(&Shown { material, lobes: Some(&lobes), views: Vec::new() }).verdict
    }

    /// The roughest white mirror reflects 1 − ln 2 of the light once, and all of it in the end.
    #[test]
    fn a_rough_metal_is_told_what_it_loses() {
        let white = told(r#"{"model": "microfacet", "alpha": 1, "f0": 1}"#);
        let expected = "Straight on it reflects 30.7 %, and loses light between its facets: with `kulla-conty` in the \
                        place of `microfacet`, which gives further reflections back, it would be 100.0 %";
        assert!(white.ends_with(expected), "{white}");
        let gltf = told(r#"{"model": "gltf", "base-color": [1, 1, 1], "metallic": 1, "roughness": 1}"#);
        assert!(gltf.ends_with(&expected.replace("microfacet", "gltf")), "{gltf}");
        let half = told(r#"{"model": "microfacet", "alpha": 1, "f0": 1, "weight": 0.5}"#);
        assert!(half.contains("reflects 15.3 %") && half.ends_with("50.0 %"), "{half}");
        let gold = told(r#"{"model": "microfacet", "alpha": 0.6, "fresnel": "conductor", "metal": "gold"}"#);
        assert!(gold.contains("kulla-conty"), "{gold}");
    }

    #[test]
    fn what_loses_little_is_told_nothing() {
        for lobe in [
            r#"{"model": "microfacet", "alpha": 0.05, "f0": 1}"#,
            r#"{"model": "microfacet", "alpha": 1, "f0": 0.04}"#,
            r#"{"model": "kulla-conty", "alpha": 1, "f0": 1}"#,
            r#"{"model": "gltf", "base-color": [1, 1, 1], "metallic": 0, "roughness": 1}"#,
            r#"{"model": "lambert", "albedo": 0.5}"#,
        ] {
            let verdict = told(lobe);
            assert!(!verdict.contains("in the place of"), "{lobe}: {verdict}");
        }
    }
}
