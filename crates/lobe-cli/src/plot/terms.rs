//! The terms of a microfacet lobe, side by side: the distribution `D`, the masking `G` and the Fresnel term `F`.

use super::chart::{Chart, Scale};
use super::svg::{Anchor, Svg};
use super::{direction, line_class, short_name};
use crate::error::Failure;
use lobe::Vec3;
use lobe_models::{AnyTerms, Lobe, Material, Value, models};
use std::f64::consts::FRAC_PI_2;

/// A panel and what is between two of them.
const PANEL: f64 = 330.0;
const BOTTOM: f64 = 316.0;

/// A lobe that is made of terms.
pub(crate) struct Facets<'a> {
    lobe: &'a Lobe,
    terms: AnyTerms,
    /// How many lobes with terms the material has.
    count: usize,
}

impl<'a> Facets<'a> {
    /// The first lobe of a material that is made of terms.
    ///
    /// # Errors
    /// That there is none, and which models have terms.
    pub(crate) fn of(material: &'a Material) -> Result<Self, Failure> {
        let mut found = material.lobes.iter().filter_map(|lobe| Some((lobe, lobe.terms()?)));
        let Some((lobe, terms)) = found.next() else {
            let known: Vec<_> = models().filter(|model| model.has_terms()).map(|model| model.name).collect();
            return Err(Failure::Usage(format!(
                "`{}` has no lobe that is made of D, G and F; the models that are: {}",
                material.name,
                known.join(", ")
            )));
        };
        Ok(Self { lobe, terms, count: 1 + found.count() })
    }

    /// Its name, with a word if it is one of several.
    fn name(&self) -> String {
        match self.count {
            1 => self.lobe.description(),
            count => format!("{}, the first of {count} lobes with terms", self.lobe.description()),
        }
    }

    /// `D` over the angle from the normal: one cut, or one along the tangent and one along the bitangent.
    pub(crate) fn cuts(&self, name: &str) -> Vec<Cut> {
        let two = self.lobe.values().any(|(_, value)| matches!(value, Value::Widths([x, y]) if x != y));
        let cut = |name: String, towards: fn(f64) -> Vec3<f64>| {
            let d = angles().into_iter().map(|theta| (theta, finite(self.terms.d(towards(theta))))).collect();
            Cut { name, d }
        };
        let along_x = cut(if two { format!("{name}, along x") } else { name.to_owned() }, direction);
        let along_y = two.then(|| {
            cut(format!("{name}, along y"), |theta| {
                let h = direction(theta);
                Vec3::new(h.y, h.x, h.z)
            })
        });
        std::iter::once(along_x).chain(along_y).collect()
    }
}

/// A distribution in one plane through the normal.
pub(crate) struct Cut {
    pub(crate) name: String,
    /// The angle from the normal in radians, from 0 to 90°, and `D` in sr⁻¹.
    pub(super) d: Vec<(f64, f64)>,
}

impl Cut {
    /// The largest value.
    pub(super) fn peak(&self) -> f64 {
        self.d.iter().fold(0.0, |max, &(_, d)| d.max(max))
    }
}

/// From 0 to just above the horizon, dense where sharp distributions have all that they are.
fn angles() -> Vec<f64> {
    let near = (0..200).map(|i| 1e-5 * 10.0_f64.powf(f64::from(i) / 50.0));
    let even = (1..360).map(|i| (f64::from(i) * 0.25).to_radians());
    let mut angles: Vec<f64> = [0.0, FRAC_PI_2 * 0.9999].into_iter().chain(near).chain(even).collect();
    angles.sort_by(f64::total_cmp);
    angles
}

/// What overflows cannot be drawn.
fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { 0.0 }
}

/// Draws `D`, `G` and `F` of one lobe.
pub(crate) fn terms(name: &str, facets: &Facets<'_>) -> Svg {
    let title = format!("The terms D, G and F of {name}");
    let mut svg = Svg::new(3.0 * PANEL, BOTTOM + 114.0, &title);
    let lobe = facets.name();
    let line = if lobe == name { lobe } else { format!("{name}: {lobe}") };
    svg.text("", (14.0, 24.0), Anchor::Start, &short_name(&line, 110));
    let chart = |panel: f64, last: i32, scale: Scale| Chart {
        left: panel * PANEL + 74.0,
        right: panel * PANEL + 314.0,
        top: 84.0,
        bottom: BOTTOM,
        angles: (0, last),
        scale,
    };
    let unit = Scale::Linear { high: 1.0, step: 0.25 };

    let cuts = facets.cuts("*D*");
    let scale = Scale::decades(cuts.iter().flat_map(|cut| cut.d.iter().map(|&(_, d)| d)));
    // A sharp distribution would be a line along the axis.
    let seen = cuts.iter().flat_map(|cut| &cut.d).filter(|(_, d)| scale.part(*d) > 0.0);
    let widest = seen.fold(0.0, |max: f64, (theta, _)| max.max(theta.to_degrees()));
    let d = chart(
        0.0,
        if widest < 10.0 {
            10
        } else if widest < 30.0 {
            30
        } else {
            90
        },
        scale,
    );
    d.axes(&mut svg, "distribution *D* (sr⁻¹)", "*θ*_{h}, between *n* and *h*");
    for (index, cut) in cuts.iter().enumerate() {
        let text = if cuts.len() > 1 { cut.name.as_str() } else { "*D*(*h*)" };
        entry(&mut svg, &d, index, &line_class(index), &cut.d, text);
    }

    let g = chart(1.0, 90, unit);
    g.axes(&mut svg, "masking *G*", "*θ*, between *n* and *v*");
    let masking = |l: fn(f64) -> Vec3<f64>| -> Vec<(f64, f64)> {
        angles().into_iter().map(|theta| (theta, finite(facets.terms.g(l(theta), direction(theta))))).collect()
    };
    let pairs = [
        ("*G*(*n*, *v*): light along the normal", masking(|_| direction(0.0))),
        ("*G*(*l*, *r*): viewer opposite the light", masking(|theta| direction(-theta))),
    ];
    for (index, (text, profile)) in pairs.iter().enumerate() {
        entry(&mut svg, &g, index, &line_class(index), profile, text);
    }

    let f = chart(2.0, 90, unit);
    f.axes(&mut svg, "Fresnel term *F*", "*θ*_{d}, between *l* and *h*");
    let fresnel: Vec<_> = angles().into_iter().map(|theta| (theta, facets.terms.f(theta.cos()))).collect();
    let channel = |of: fn(&lobe::Rgb<f64>) -> f64| -> Vec<(f64, f64)> {
        fresnel.iter().map(|(theta, f)| (*theta, finite(of(f)))).collect()
    };
    let channels = [("red", channel(|f| f.r)), ("green", channel(|f| f.g)), ("blue", channel(|f| f.b))];
    let [(_, red), (_, green), (_, blue)] = &channels;
    if red == green && green == blue {
        entry(&mut svg, &f, 0, &line_class(0), red, "red, green and blue");
    } else {
        for (index, (text, profile)) in channels.iter().enumerate() {
            entry(&mut svg, &f, index, text, profile, text);
        }
    }
    svg
}

/// A curve and its line in the legend below the chart.
fn entry(svg: &mut Svg, chart: &Chart, index: usize, class: &str, profile: &[(f64, f64)], text: &str) {
    chart.curve(svg, class, profile);
    let at = (chart.left - 60.0, BOTTOM + 62.0 + 20.0 * index as f64);
    svg.line(class, (at.0, at.1 - 5.0), (at.0 + 30.0, at.1 - 5.0));
    svg.math("soft", (at.0 + 38.0, at.1), Anchor::Start, text);
}
