//! Time against error: what each number type and each approximation of a material costs, and which of them are worth it.

use super::chart::Scale;
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

const WIDTH: f64 = 760.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 744.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 380.0;

/// The dots that no other one beats in both, the fastest first. An error that is less by a twentieth only is not less:
/// of two precisions behind one approximation it is chance which is nearer.
pub(crate) fn front(dots: &[Dot]) -> Vec<&Dot> {
    let mut sorted: Vec<&Dot> = dots.iter().collect();
    sorted.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.error.total_cmp(&b.error)));
    let mut least = f64::INFINITY;
    sorted.retain(|dot| {
        let better = dot.error < 0.95 * least;
        least = least.min(dot.error);
        better
    });
    sorted
}

/// Draws the dots of a material; `kinds` are the names of the colours.
pub(crate) fn pareto(title: &str, dots: &[Dot], kinds: &[&str]) -> Svg {
    let front = front(dots);
    let rows = front.len() as f64;
    let mut svg = Svg::new(WIDTH, BOTTOM + 104.0 + 20.0 * rows, &format!("{title}: time against error"));
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
    svg.text("head", (LEFT, 18.0), Anchor::Start, title);
    svg.text("soft", (10.0, 36.0), Anchor::Start, "relative error, 99th percentile (0 at the foot)");
    svg.text("soft", ((LEFT + RIGHT) / 2.0, BOTTOM + 36.0), Anchor::Middle, "ns for an evaluation");
    let steps: Vec<_> = front.iter().map(|dot| at(dot)).collect();
    svg.path("thin", &steps, false);
    for dot in dots {
        svg.dot(&format!("f{}", dot.kind % super::svg::SERIES), at(dot), 4.5);
    }
    for (index, kind) in kinds.iter().enumerate() {
        let x = LEFT + 110.0 * index as f64;
        svg.dot(&format!("f{index}"), (x, BOTTOM + 58.0), 4.5);
        svg.text("soft", (x + 10.0, BOTTOM + 62.0), Anchor::Start, kind);
    }
    // Numbers beside the dots, and their names below: names beside them would lie on each other.
    for (index, (dot, (x, y))) in front.iter().zip(&steps).enumerate() {
        svg.text("soft", (x - 7.0, y - 7.0), Anchor::End, &(index + 1).to_string());
        let text = format!("{}  {}: {} ns, {}", index + 1, dot.name, label(dot.time), label(dot.error));
        svg.text("soft", (LEFT, BOTTOM + 88.0 + 20.0 * index as f64), Anchor::Start, &text);
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
        let names: Vec<_> = front(&dots).iter().map(|dot| dot.name.as_str()).collect();
        assert_eq!(names, ["d", "a", "c"]);
        let picture = pareto("gold", &dots, &["scalar"]).file();
        assert_eq!(picture.matches("<circle").count(), dots.len() + 1);
    }
}
