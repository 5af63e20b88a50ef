//! Time against error: what each number type and each approximation of a material costs, and which of them are worth it.

use super::chart::Scale;
use super::short_name;
use super::svg::{Anchor, Svg, label};

/// One dot.
#[derive(Clone, Debug)]
pub(crate) struct Dot {
    /// What it is, for the list of those that are worth it.
    pub(crate) name: String,
    /// Nanoseconds.
    pub(crate) time: f64,
    /// The relative error; 0 is drawn at the foot.
    pub(crate) error: f64,
    /// Its colour, by number.
    pub(crate) kind: usize,
}

const WIDTH: f64 = 600.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 584.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 380.0;
/// The colours in a row of the legend.
const COLUMNS: usize = 4;

/// The places of the dots that no other one beats in both, the fastest first. An error that is less by a twentieth only
/// is not less: of two precisions behind one approximation it is chance which is nearer.
pub(crate) fn front(dots: &[Dot]) -> Vec<usize> {
    let mut sorted: Vec<(usize, &Dot)> = dots.iter().enumerate().collect();
    sorted.sort_by(|(_, a), (_, b)| a.time.total_cmp(&b.time).then(a.error.total_cmp(&b.error)));
    let mut least = f64::INFINITY;
    sorted.retain(|(_, dot)| {
        let better = dot.error < 0.95 * least;
        least = least.min(dot.error);
        better
    });
    sorted.into_iter().map(|(index, _)| index).collect()
}

/// Draws the dots of a material; `kinds` are the names of the colours.
pub(crate) fn pareto(title: &str, dots: &[Dot], kinds: &[&str]) -> Svg {
    let mut svg = pareto_panel(title, dots, kinds);
    svg.text("head", (LEFT, 18.0), Anchor::Start, &short_name(title, 60));
    svg
}

/// The same without the title above it, for a page that has one.
pub(crate) fn pareto_panel(title: &str, dots: &[Dot], kinds: &[&str]) -> Svg {
    let front: Vec<&Dot> = front(dots).into_iter().map(|index| &dots[index]).collect();
    // A colour that no dot has needs no name.
    let kinds: Vec<_> = kinds.iter().enumerate().filter(|(kind, _)| dots.iter().any(|dot| dot.kind == *kind)).collect();
    let list = BOTTOM + 66.0 + 22.0 * kinds.len().div_ceil(COLUMNS) as f64;
    let height = list + 16.0 + 20.0 * front.len() as f64;
    let mut svg = Svg::new(WIDTH, height, &format!("{title}: time against error"));
    let errors = Scale::decades(dots.iter().map(|dot| dot.error));
    let times = Scale::decades(dots.iter().map(|dot| dot.time));
    let at = |dot: &Dot| {
        let (x, y) = (times.part(dot.time), errors.part(dot.error));
        (LEFT + x * (RIGHT - LEFT), BOTTOM - y * (BOTTOM - TOP))
    };
    for (part, text) in errors.ticks() {
        let y = BOTTOM - part * (BOTTOM - TOP);
        svg.line("grid", (LEFT, y), (RIGHT, y));
        svg.math("soft", (LEFT - 8.0, y + 4.0), Anchor::End, &text);
    }
    for (part, text) in times.ticks() {
        let x = LEFT + part * (RIGHT - LEFT);
        svg.line("grid", (x, TOP), (x, BOTTOM));
        svg.math("soft", (x, BOTTOM + 18.0), Anchor::Middle, &text);
    }
    svg.path("axis", &[(LEFT, TOP), (LEFT, BOTTOM), (RIGHT, BOTTOM)], false);
    svg.text("soft", (10.0, 36.0), Anchor::Start, "relative error, 99th percentile (0 at the foot)");
    svg.text("soft", ((LEFT + RIGHT) / 2.0, BOTTOM + 36.0), Anchor::Middle, "ns for an evaluation");
    let steps: Vec<_> = front.iter().map(|dot| at(dot)).collect();
    svg.path("thin", &steps, false);
    for dot in dots {
        svg.dot(&format!("f{}", dot.kind % super::svg::SERIES), at(dot), 4.5);
    }
    for (place, (kind, name)) in kinds.into_iter().enumerate() {
        let (x, y) = (LEFT + 125.0 * (place % COLUMNS) as f64, BOTTOM + 58.0 + 22.0 * (place / COLUMNS) as f64);
        svg.dot(&format!("f{}", kind % super::svg::SERIES), (x, y), 4.5);
        svg.text("soft", (x + 10.0, y + 4.0), Anchor::Start, name);
    }
    // Numbers beside the dots, and their names below: names beside them would lie on each other.
    for (index, (dot, (x, y))) in front.iter().zip(&steps).enumerate() {
        svg.text("soft", (x - 7.0, y - 7.0), Anchor::End, &(index + 1).to_string());
        let text = format!("{}  {}: {} ns, {}", index + 1, dot.name, label(dot.time), label(dot.error));
        svg.text("soft", (LEFT, list + 20.0 * index as f64), Anchor::Start, &text);
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_not_beaten_is_in_front() {
        let dot = |name: &str, time, error| Dot { name: name.to_owned(), time, error, kind: 0 };
        let dots = [
            dot("a", 1.0, 0.1),
            dot("b", 2.0, 0.2),
            dot("c", 3.0, 0.0),
            dot("d", 0.5, 0.3),
            dot("e", 3.0, 0.05),
            dot("f", 1.5, 0.099),
        ];
        let names: Vec<_> = front(&dots).into_iter().map(|index| dots[index].name.as_str()).collect();
        assert_eq!(names, ["d", "a", "c"]);
        let picture = pareto("gold", &dots, &["scalar", "lanes"]).file();
        // In the legend only the colour that there is.
        assert_eq!(picture.matches("<circle").count(), dots.len() + 1);
        assert!(!picture.contains("lanes"));
    }
}
