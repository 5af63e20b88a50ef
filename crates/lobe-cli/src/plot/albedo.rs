//! Directional albedos over the angle of the view.

use super::chart::{Chart, Scale};
use super::svg::{Anchor, Svg};
use super::{legend, line_class, short_name};

const BOTTOM: f64 = 320.0;

/// Draws albedos over the angle of the view in degrees, each curve by growing angle and with the name of its line. More than
/// [`SERIES`](super::svg::SERIES) share the lines.
pub(crate) fn albedo_curves(title: &str, curves: &[(String, Vec<(f64, f64)>)]) -> Svg {
    let largest = curves.iter().flat_map(|(_, curve)| curve).fold(1.0, |max: f64, &(_, albedo)| albedo.max(max));
    let scale = Scale::linear(largest);
    let chart = Chart { left: 66.0, right: 584.0, top: 70.0, bottom: BOTTOM, angles: (0, 90), scale };
    let mut svg = Svg::new(600.0, BOTTOM + 62.0 + 22.0 * curves.len() as f64, title);
    svg.text("", (6.0, 18.0), Anchor::Start, title);
    chart.axes(&mut svg, "albedo *E*(*v*)", "angle of the view *θ*");
    for (index, (name, curve)) in curves.iter().enumerate() {
        let profile: Vec<_> = curve.iter().map(|&(degrees, albedo)| (degrees.to_radians(), albedo)).collect();
        chart.curve(&mut svg, &line_class(index), &profile);
        legend(&mut svg, index, (40.0, BOTTOM + 60.0), &short_name(name, 60));
    }
    svg
}
