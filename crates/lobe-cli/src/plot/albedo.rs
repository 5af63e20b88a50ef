//! Directional albedos over the angle of the view.

use super::chart::{Chart, Scale};
use super::svg::{Anchor, SERIES, Svg, label};
use super::{legend, line_class};

const BOTTOM: f64 = 320.0;

/// Draws the albedo for some roughnesses: pairs of `n·v` and albedo of each. Of more curves than there are lines some are left out,
/// evenly.
pub(crate) fn albedo_curves(title: &str, curves: &[(f64, Vec<(f64, f64)>)]) -> Svg {
    let step = curves.len().div_ceil(SERIES).max(1);
    // The last one is always there.
    let shown: Vec<_> = curves.iter().rev().step_by(step).collect();
    let largest = shown.iter().flat_map(|(_, curve)| curve).fold(1.0, |max: f64, &(_, albedo)| albedo.max(max));
    let scale = Scale::linear(largest);
    let chart = Chart { left: 66.0, right: 584.0, top: 58.0, bottom: BOTTOM, angles: (0, 90), scale };
    let mut svg = Svg::new(600.0, BOTTOM + 62.0 + 22.0 * shown.len() as f64, title);
    svg.text("", (6.0, 18.0), Anchor::Start, title);
    chart.axes(&mut svg, "albedo *E*(*v*)", "angle of the view *θ*");
    for (index, (roughness, curve)) in shown.iter().rev().enumerate() {
        let profile: Vec<_> = curve.iter().rev().map(|&(n_dot_v, albedo)| (n_dot_v.min(1.0).acos(), albedo)).collect();
        chart.curve(&mut svg, &line_class(index), &profile);
        legend(&mut svg, index, (40.0, BOTTOM + 60.0), &format!("roughness {}", label(*roughness)));
    }
    svg
}
