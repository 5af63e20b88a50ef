//! The value over the angle of the viewer, on a logarithmic scale: what a polar plot hides at the foot of a lobe.

use super::svg::{Anchor, Point, SERIES, Svg, label};
use super::{Series, Setting, peak, profile, short_name};

const WIDTH: f64 = 600.0;
const LEFT: f64 = 66.0;
const RIGHT: f64 = 584.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 320.0;
/// More decades than this are not worth their ink.
const DECADES: f64 = 8.0;

/// Draws `series` over the angles from −90° to 90° in the plane of incidence.
pub(crate) fn curve(series: &[Series<'_>], setting: Setting) -> Svg {
    let profiles: Vec<_> = series.iter().map(|one| profile(one, setting)).collect();
    let largest = peak(&profiles);
    let high = if largest > 0.0 { largest.log10().ceil() } else { 0.0 };
    let smallest = profiles.iter().flatten().fold(f64::INFINITY, |min, &(theta, value)| {
        // At the very horizon a cosine takes everything to 0; that is no reason for more decades.
        if value > 0.0 && theta.abs() < 1.55 { value.min(min) } else { min }
    });
    let low = smallest.log10().floor().clamp(high - DECADES, high - 1.0);

    let x = |theta: f64| LEFT + (theta.to_degrees() + 90.0) / 180.0 * (RIGHT - LEFT);
    let y = |log: f64| BOTTOM - (log - low) / (high - low) * (BOTTOM - TOP);
    let height = BOTTOM + 62.0 + 22.0 * series.len() as f64;
    let title = format!("Reflectance over the viewing angle, light at {}°", label(setting.incidence));
    let mut svg = Svg::new(WIDTH, height, &title);

    for decade in low as i32..=high as i32 {
        let at = y(f64::from(decade));
        svg.line("grid", (LEFT, at), (RIGHT, at));
        svg.math("soft", (LEFT - 8.0, at + 4.0), Anchor::End, &power_of_ten(decade));
        for digit in 2..=9 {
            let minor = y(f64::from(decade) + f64::from(digit).log10());
            if minor > TOP {
                svg.line("axis", (LEFT, minor), (LEFT + 4.0, minor));
            }
        }
    }
    for tick in -6..=6 {
        let angle = f64::from(tick) * 15.0;
        let at = x(angle.to_radians());
        svg.line("grid", (at, TOP), (at, BOTTOM));
        if tick % 2 == 0 {
            svg.text("soft", (at, BOTTOM + 18.0), Anchor::Middle, &format!("{angle}°").replace('-', "−"));
        }
    }
    for (angle, text) in [(-setting.incidence, "*l*"), (setting.incidence, "*r*")] {
        let at = x(angle.to_radians());
        svg.line("thin", (at, TOP), (at, BOTTOM));
        svg.math("", (at, TOP - 7.0), Anchor::Middle, text);
    }
    svg.path("axis", &[(LEFT, TOP), (LEFT, BOTTOM), (RIGHT, BOTTOM)], false);
    svg.math("soft", (LEFT - 60.0, TOP - 26.0), Anchor::Start, setting.quantity());
    let below = "viewing angle *θ* in the plane of incidence";
    svg.math("soft", ((LEFT + RIGHT) / 2.0, BOTTOM + 35.0), Anchor::Middle, below);

    for (index, (one, profile)) in series.iter().zip(&profiles).enumerate() {
        let class = format!("c{}", index % SERIES);
        let logs: Vec<_> = profile.iter().map(|&(theta, value)| (theta, value.max(1e-300).log10())).collect();
        for piece in above(&logs, low) {
            let points: Vec<Point> = piece.iter().map(|&(theta, log)| (x(theta), y(log))).collect();
            svg.path(&class, &points, false);
        }
        let row = BOTTOM + 60.0 + 22.0 * index as f64;
        svg.line(&class, (40.0, row - 5.0), (76.0, row - 5.0));
        svg.text("", (86.0, row), Anchor::Start, &short_name(&one.name, 60));
    }
    svg
}

/// The pieces of a curve that are above `floor`, cut where they cross it.
fn above(curve: &[(f64, f64)], floor: f64) -> Vec<Vec<(f64, f64)>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<(f64, f64)> = Vec::new();
    let mut last: Option<(f64, f64)> = None;
    for &(x, y) in curve {
        if let Some((x0, y0)) = last
            && (y0 < floor) != (y < floor)
        {
            piece.push((x0 + (x - x0) * (floor - y0) / (y - y0), floor));
        }
        if y >= floor {
            piece.push((x, y));
        } else if !piece.is_empty() {
            pieces.push(std::mem::take(&mut piece));
        }
        last = Some((x, y));
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

fn power_of_ten(exponent: i32) -> String {
    match exponent {
        -2..=3 => label(10.0_f64.powi(exponent)),
        _ => format!("10^{{{}}}", exponent.to_string().replace('-', "−")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_cut_at_the_floor() {
        let pieces = above(&[(0.0, -2.0), (1.0, 0.0), (2.0, 1.0), (3.0, -1.0)], -1.0);
        assert_eq!(pieces, vec![vec![(0.5, -1.0), (1.0, 0.0), (2.0, 1.0), (3.0, -1.0)]]);
    }
}
