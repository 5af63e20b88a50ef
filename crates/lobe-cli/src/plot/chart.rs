//! Axes: a scale of values, straight or by decades, and a chart of values over an angle.

use super::svg::{Anchor, Point, Svg, label, nice_step};

/// More decades than this are not worth their ink.
const DECADES: i32 = 8;

/// How a value becomes a part of the length of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scale {
    /// From 0 to `high`, with a tick at each multiple of `step`.
    Linear { high: f64, step: f64 },
    /// From `10^low` to `10^high`, with a tick at each decade.
    Log { low: i32, high: i32 },
}

impl Scale {
    /// From 0 to the first tick that holds `largest`.
    pub(super) fn linear(largest: f64) -> Self {
        let step = nice_step(if largest > 0.0 { largest } else { 1.0 }, 4.0);
        Self::Linear { high: (largest / step).ceil().clamp(1.0, 10.0) * step, step }
    }

    /// The decades that hold the positive `values`, at most eight below the largest.
    pub(super) fn decades(values: impl Iterator<Item = f64>) -> Self {
        let (smallest, largest) = values
            .filter(|value| *value > 0.0)
            .fold((f64::INFINITY, 0.0_f64), |(min, max), value| (value.min(min), value.max(max)));
        let high = if largest > 0.0 { largest.log10().ceil() as i32 } else { 0 };
        Self::Log { low: (smallest.log10().floor() as i32).clamp(high - DECADES, high - 1), high }
    }

    /// The `count` decades below the power of ten that holds `largest`, and the one that it is in.
    pub(super) fn below(largest: f64, count: i32) -> Self {
        let log = if largest > 0.0 { largest.log10() } else { 0.0 };
        Self::Log { low: log.floor() as i32 - count, high: log.ceil() as i32 }
    }

    /// Where a value stands: 0 at the foot and below it, 1 at the end.
    pub(super) fn part(self, value: f64) -> f64 {
        self.signed_part(value).max(0.0)
    }

    /// The same, negative below the foot.
    fn signed_part(self, value: f64) -> f64 {
        match self {
            Self::Linear { high, .. } => value / high,
            Self::Log { low, high } => (value.max(1e-300).log10() - f64::from(low)) / f64::from(high - low),
        }
    }

    /// The ticks with their labels, in the markup of [`Svg::math`]; the first is at the foot.
    pub(super) fn ticks(self) -> Vec<(f64, String)> {
        match self {
            Self::Linear { high, step } => (0..=(high / step).round() as u32)
                .map(|tick| f64::from(tick) * step)
                .map(|value| (value / high, label(value)))
                .collect(),
            Self::Log { low, high } => (low..=high)
                .map(|decade| (f64::from(decade - low) / f64::from(high - low), power_of_ten(decade)))
                .collect(),
        }
    }
}

fn power_of_ten(exponent: i32) -> String {
    match exponent {
        -2..=3 => label(10.0_f64.powi(exponent)),
        _ => format!("10^{{{}}}", exponent.to_string().replace('-', "−")),
    }
}

/// Values over an angle in degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chart {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
    /// The first and the last angle, multiples of 30 or of 10.
    pub(super) angles: (i32, i32),
    pub(super) scale: Scale,
}

impl Chart {
    /// Where an angle stands, in degrees.
    pub(super) fn x(&self, angle: f64) -> f64 {
        let (first, last) = (f64::from(self.angles.0), f64::from(self.angles.1));
        self.left + (angle - first) / (last - first) * (self.right - self.left)
    }

    fn y(&self, part: f64) -> f64 {
        self.bottom - part * (self.bottom - self.top)
    }

    /// The axes with their ticks: what the values are stands above, what the angle is below.
    pub(super) fn axes(&self, svg: &mut Svg, quantity: &str, below: &str) {
        for (part, text) in self.scale.ticks() {
            let at = self.y(part);
            svg.line("grid", (self.left, at), (self.right, at));
            svg.math("soft", (self.left - 8.0, at + 4.0), Anchor::End, &text);
        }
        if let Scale::Log { low, high } = self.scale {
            let small =
                (low..high).flat_map(|decade| (2..=9).map(move |digit| f64::from(digit) * 10.0_f64.powi(decade)));
            for value in small {
                let at = self.y(self.scale.part(value));
                svg.line("axis", (self.left, at), (self.left + 4.0, at));
            }
        }
        let step = match self.angles.1 - self.angles.0 {
            ..=10 => 1,
            11..=30 => 5,
            _ => 15,
        };
        for angle in (self.angles.0..=self.angles.1).step_by(step as usize) {
            let at = self.x(f64::from(angle));
            svg.line("grid", (at, self.top), (at, self.bottom));
            if angle % (2 * step) == 0 {
                let text = format!("{angle}°").replace('-', "−");
                svg.text("soft", (at, self.bottom + 18.0), Anchor::Middle, &text);
            }
        }
        let frame = [(self.left, self.top), (self.left, self.bottom), (self.right, self.bottom)];
        svg.path("axis", &frame, false);
        svg.math("soft", (self.left - 60.0, self.top - 26.0), Anchor::Start, quantity);
        svg.math("soft", ((self.left + self.right) / 2.0, self.bottom + 35.0), Anchor::Middle, below);
    }

    /// A curve of angles in radians and values; what is below the foot is cut off.
    pub(super) fn curve(&self, svg: &mut Svg, class: &str, profile: &[(f64, f64)]) {
        let parts: Vec<_> =
            profile.iter().map(|&(theta, value)| (theta.to_degrees(), self.scale.signed_part(value))).collect();
        for piece in above(&parts, 0.0) {
            let points: Vec<Point> = piece.iter().map(|&(angle, part)| (self.x(angle), self.y(part))).collect();
            svg.path(class, &points, false);
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_cut_at_the_floor() {
        let pieces = above(&[(0.0, -2.0), (1.0, 0.0), (2.0, 1.0), (3.0, -1.0)], -1.0);
        assert_eq!(pieces, vec![vec![(0.5, -1.0), (1.0, 0.0), (2.0, 1.0), (3.0, -1.0)]]);
    }

    #[test]
    fn a_scale_holds_its_values() {
        assert_eq!(Scale::linear(0.9), Scale::Linear { high: 1.0, step: 0.25 });
        assert_eq!(Scale::decades([0.03, 20.0, 0.0].into_iter()), Scale::Log { low: -2, high: 2 });
        // Of values that are all 0, and of a power of ten itself.
        assert_eq!(Scale::decades([0.0].into_iter()), Scale::Log { low: -1, high: 0 });
        assert_eq!(Scale::below(1.0, 4), Scale::Log { low: -4, high: 0 });
        assert_eq!(Scale::below(3.0, 4), Scale::Log { low: -4, high: 1 });
        let scale = Scale::below(1.0, 4);
        assert_eq!([0.0, 1e-4, 1e-2, 1.0].map(|value| scale.part(value)), [0.0, 0.0, 0.5, 1.0]);
        assert_eq!(scale.ticks().first(), Some(&(0.0, "10^{−4}".to_owned())));
    }
}
