//! The value over the angle of the viewer: on a logarithmic scale, what a polar plot hides at the foot of a lobe; and
//! in slices, one for each of some angles of the light.

use super::chart::{Chart, Scale};
use super::svg::{Anchor, Svg, label};
use super::{Series, Setting, legend, line_class, peak, profile, short_name};

const WIDTH: f64 = 600.0;
const BOTTOM: f64 = 320.0;
/// The angles of the light of [`slices`], in degrees.
const SLICES: [f64; 4] = [0.0, 30.0, 60.0, 80.0];

/// Draws `series` over the angles from −90° to 90° in the plane of incidence.
pub(crate) fn curve(series: &[Series<'_>], setting: Setting) -> Svg {
    let profiles: Vec<_> = series.iter().map(|one| profile(one, setting)).collect();
    let chart = chart(decades(&profiles));
    let title = format!("Reflectance over the viewing angle, light at {}°", label(setting.incidence));
    let mut svg = Svg::new(WIDTH, BOTTOM + 62.0 + 22.0 * series.len() as f64, &title);
    chart.axes(&mut svg, setting.quantity(), "viewing angle *θ* in the plane of incidence");
    // At normal incidence the two are one line.
    let marks = [(-setting.incidence, "*l*", -1.0), (setting.incidence, "*r*", 1.0)];
    for (angle, text, side) in marks {
        let at = chart.x(angle);
        svg.line("thin", (at, chart.top), (at, chart.bottom));
        let apart = if setting.incidence < 3.0 { 8.0 * side } else { 0.0 };
        svg.math("", (at + apart, chart.top - 7.0), Anchor::Middle, text);
    }
    for (index, (one, profile)) in series.iter().zip(&profiles).enumerate() {
        chart.curve(&mut svg, &line_class(index), profile);
        legend(&mut svg, index, (40.0, BOTTOM + 60.0), &short_name(&one.name, 60));
    }
    svg
}

/// Draws one BRDF over the angle of the viewer for each of [`SLICES`].
pub(crate) fn slices(one: &Series<'_>, setting: Setting) -> Svg {
    let at = |incidence| Setting { incidence, ..setting };
    let profiles: Vec<_> = SLICES.into_iter().map(|incidence| profile(one, at(incidence))).collect();
    let chart = chart(if setting.log { decades(&profiles) } else { Scale::linear(peak(&profiles)) });
    let title = format!("{} over the viewing angle, for four angles of the light", one.name);
    let mut svg = Svg::new(WIDTH, BOTTOM + 84.0 + 22.0 * SLICES.len() as f64, &title);
    let below = "viewing angle *θ*_{v} in the plane of incidence; the light is at −*θ*_{l}";
    chart.axes(&mut svg, setting.quantity(), below);
    svg.text("", (40.0, BOTTOM + 64.0), Anchor::Start, &short_name(&one.name, 60));
    for (index, (incidence, profile)) in SLICES.into_iter().zip(&profiles).enumerate() {
        chart.curve(&mut svg, &line_class(index), profile);
        let peak = label(peak(std::slice::from_ref(profile)));
        let text = format!("light at {}°  (peak {peak})", label(incidence));
        legend(&mut svg, index, (40.0, BOTTOM + 88.0), &text);
    }
    svg
}

fn chart(scale: Scale) -> Chart {
    Chart { left: 66.0, right: 584.0, top: 44.0, bottom: BOTTOM, angles: (-90, 90), scale }
}

/// The decades that the profiles fill.
fn decades(profiles: &[Vec<(f64, f64)>]) -> Scale {
    // At the very horizon a cosine takes everything to 0; that is no reason for more decades.
    let inside = profiles.iter().flatten().filter(|(theta, _)| theta.abs() < 1.55);
    let largest = peak(profiles);
    Scale::decades(inside.map(|&(_, value)| value).chain([largest]))
}
