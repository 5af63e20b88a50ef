//! A small writer of SVG.
//!
//! The plotting crates draw axes with lines and bars. A polar lobe with its light and mirror directions, or a lobe in
//! three dimensions with its hidden surfaces removed, they do not, and each would take more code around a crate than
//! the few shapes below. All that varies between light and dark is in classes, and written out twice: `var()` would be
//! shorter, but the programs that turn SVG into print do not know it.

use base64::Engine as _;
use std::fmt::Write as _;

/// A PNG file as an address that holds it.
pub(crate) fn data_uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", base64::engine::general_purpose::STANDARD.encode(png))
}

/// A point of the picture: x to the right, y down.
pub(crate) type Point = (f64, f64);

/// A picture that is being drawn.
#[derive(Debug)]
pub(crate) struct Svg {
    width: f64,
    height: f64,
    title: String,
    body: String,
}

/// Where a text stands to its point.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// How many different line styles there are.
pub(crate) const SERIES: usize = 6;

const STYLE: &str = "\
.lobe-plot{font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif;font-size:15.5px}\
.lobe-plot text{fill:#222}.lobe-plot .soft{fill:#666;font-size:13.5px}.lobe-plot .head{font-weight:600}\
.lobe-plot .i{font-style:italic;font-family:Georgia,'Times New Roman',serif;font-size:107%}\
.lobe-plot .sub{font-size:75%}\
.lobe-plot .paper{fill:#fff}.lobe-plot .grid{fill:none;stroke:#dcdcdc;stroke-width:1}\
.lobe-plot .axis{fill:none;stroke:#8a8a8a;stroke-width:1}.lobe-plot .ink{fill:none;stroke:#222;stroke-width:2}\
.lobe-plot .thin{fill:none;stroke:#777;stroke-width:1.2;stroke-dasharray:5 4}\
.lobe-plot .ray{fill:none;stroke:#222;stroke-width:1.6}.lobe-plot .tip{fill:#222}\
.lobe-plot .dash{fill:none;stroke:#777;stroke-width:1.2}\
.lobe-plot .mesh{fill:none;stroke:#0b2f50;stroke-opacity:.55}\
.lobe-plot .ground{fill:#efefef}.lobe-plot .below{fill:#e6e6e6}\
.lobe-plot .c0,.lobe-plot .c1,.lobe-plot .c2,.lobe-plot .c3,.lobe-plot .c4,.lobe-plot .c5,\
.lobe-plot .red,.lobe-plot .green,.lobe-plot .blue\
{fill:none;stroke-width:2.2;stroke-linejoin:round;stroke-linecap:round}\
.lobe-plot .wide{stroke-width:6;stroke-opacity:.45}.lobe-plot .fill{stroke:none;fill-opacity:.1}\
.lobe-plot .c0{stroke:#0067a5}.lobe-plot .c1{stroke:#c8500a;stroke-dasharray:9 5}\
.lobe-plot .c2{stroke:#00805a;stroke-dasharray:2 5}.lobe-plot .c3{stroke:#9c3f8c;stroke-dasharray:11 4 2 4}\
.lobe-plot .c4{stroke:#8a6a00;stroke-dasharray:5 3}.lobe-plot .c5{stroke:#444;stroke-dasharray:15 4}\
.lobe-plot .red{stroke:#c62828}.lobe-plot .green{stroke:#1c8440;stroke-dasharray:9 5}\
.lobe-plot .blue{stroke:#2f5fd0;stroke-dasharray:2 5}\
.lobe-plot .drawn{fill:none;stroke:#e8560c;stroke-width:2;stroke-linecap:round}\
.lobe-plot .f0{fill:#0067a5}.lobe-plot .f1{fill:#c8500a}.lobe-plot .f2{fill:#00805a}\
.lobe-plot .f3{fill:#9c3f8c}.lobe-plot .f4{fill:#8a6a00}.lobe-plot .f5{fill:#444}";

const DARK: &str = "\
.lobe-plot text{fill:#e8e8e8}.lobe-plot .soft{fill:#a8a8a8}.lobe-plot .paper{fill:#16181c}\
.lobe-plot .grid{stroke:#363a41}.lobe-plot .axis{stroke:#7d838c}.lobe-plot .ink{stroke:#e8e8e8}\
.lobe-plot .thin,.lobe-plot .dash{stroke:#9aa0a8}.lobe-plot .ray{stroke:#e8e8e8}.lobe-plot .tip{fill:#e8e8e8}\
.lobe-plot .ground{fill:#24272d}.lobe-plot .below{fill:#2a2e35}\
.lobe-plot .c0{stroke:#5db5ee}.lobe-plot .c1{stroke:#ff9350}.lobe-plot .c2{stroke:#3fcf9e}\
.lobe-plot .c3{stroke:#e29ad6}.lobe-plot .c4{stroke:#e3c04b}.lobe-plot .c5{stroke:#c4c4c4}\
.lobe-plot .red{stroke:#ff7d76}.lobe-plot .green{stroke:#5dd488}.lobe-plot .blue{stroke:#86aeff}\
.lobe-plot .f0{fill:#5db5ee}.lobe-plot .f1{fill:#ff9350}.lobe-plot .f2{fill:#3fcf9e}\
.lobe-plot .f3{fill:#e29ad6}.lobe-plot .f4{fill:#e3c04b}.lobe-plot .f5{fill:#c4c4c4}";

impl Svg {
    /// An empty picture; `title` is read aloud by screen readers.
    pub(crate) fn new(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: title.to_owned(), body: String::new() }
    }

    /// A straight line.
    pub(crate) fn line(&mut self, class: &str, from: Point, to: Point) {
        self.path(class, &[from, to], false);
    }

    /// A line through all points; with `closed`, back to the first.
    pub(crate) fn path(&mut self, class: &str, points: &[Point], closed: bool) {
        let _ = writeln!(self.body, "<path class=\"{class}\" d=\"{}\"/>", path_data(points, closed));
    }

    /// A polygon of one colour, its edge drawn in another.
    pub(crate) fn patch(&mut self, fill: [u8; 3], stroke: [u8; 3], points: &[Point]) {
        let hex = |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}");
        let data = path_data(points, true);
        let _ = writeln!(self.body, "<path fill=\"{}\" stroke=\"{}\" d=\"{data}\"/>", hex(fill), hex(stroke));
    }

    /// Opens a group of shapes that share attributes.
    pub(crate) fn group(&mut self, attributes: &str) {
        let _ = writeln!(self.body, "<g {attributes}>");
    }

    /// Closes it.
    pub(crate) fn end_group(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// A rectangle.
    pub(crate) fn rectangle(&mut self, class: &str, (x, y): Point, width: f64, height: f64) {
        let (x, y, width, height) = (short(x), short(y), short(width), short(height));
        let _ =
            writeln!(self.body, "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/>");
    }

    /// A PNG file, its pixels as they are.
    pub(crate) fn image(&mut self, (x, y): Point, width: f64, height: f64, png: &[u8]) {
        let data = data_uri(png);
        let (x, y, width, height) = (short(x), short(y), short(width), short(height));
        let _ = writeln!(
            self.body,
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
             href=\"{data}\"/>"
        );
    }

    /// A small disc.
    pub(crate) fn dot(&mut self, class: &str, (x, y): Point, radius: f64) {
        let _ =
            writeln!(self.body, "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"{radius}\"/>", short(x), short(y));
    }

    /// Many dots of the width of the class's line, in one element.
    pub(crate) fn dots(&mut self, class: &str, points: &[Point]) {
        let _ = write!(self.body, "<path class=\"{class}\" d=\"");
        for &(x, y) in points {
            let _ = write!(self.body, "M{} {}h0", short(x), short(y));
        }
        self.body.push_str("\"/>\n");
    }

    /// An arrow of the class `ray`.
    pub(crate) fn arrow(&mut self, from: Point, to: Point) {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = dx.hypot(dy).max(1e-9);
        let (ux, uy) = (dx / length, dy / length);
        let back = (to.0 - 10.0 * ux, to.1 - 10.0 * uy);
        self.line("ray", from, back);
        let sides = [to, (back.0 - 4.0 * uy, back.1 + 4.0 * ux), (back.0 + 4.0 * uy, back.1 - 4.0 * ux)];
        self.path("tip", &sides, true);
    }

    /// A text as it stands.
    pub(crate) fn text(&mut self, class: &str, at: Point, anchor: Anchor, text: &str) {
        self.raw_text(class, at, anchor, &escape(text));
    }

    /// A text with letters of mathematics: `*x*` is italic, `_{i}` and `^{i}` are set low and high.
    pub(crate) fn math(&mut self, class: &str, at: Point, anchor: Anchor, text: &str) {
        self.raw_text(class, at, anchor, &math(text));
    }

    fn raw_text(&mut self, class: &str, (x, y): Point, anchor: Anchor, markup: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y) = (short(x), short(y));
        let _ =
            writeln!(self.body, "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{markup}</text>");
    }

    /// The file: with a background of its own, so that it can be read wherever it is opened.
    pub(crate) fn file(&self) -> String {
        let head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
        let paper = format!("<rect class=\"paper\" width=\"{}\" height=\"{}\"/>\n", self.width, self.height);
        let size = format!(" width=\"{}\" height=\"{}\"", self.width, self.height);
        format!("{head}{}", self.element(&size, &format!("<style>{}</style>\n{paper}", style())))
    }

    /// The element for a page, which brings the [`style`] and shows its own background.
    pub(crate) fn inline(&self) -> String {
        self.element("", "")
    }

    fn element(&self, size: &str, first: &str) -> String {
        let title = escape(&self.title);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"lobe-plot\" role=\"img\" aria-label=\"{title}\" \
             viewBox=\"0 0 {} {}\"{size}>\n<title>{title}</title>\n{first}{}</svg>\n",
            self.width, self.height, self.body
        )
    }
}

/// The rules for the classes, light and dark.
pub(crate) fn style() -> String {
    format!("{STYLE}@media (prefers-color-scheme:dark){{{DARK}}}@media print{{{STYLE}}}")
}

fn path_data(points: &[Point], closed: bool) -> String {
    let mut data = String::new();
    let mut last: Option<Point> = None;
    for (index, &(x, y)) in points.iter().enumerate() {
        // Points closer than the eye can tell apart only make the file large.
        let near = last.is_some_and(|(x0, y0)| (x - x0).hypot(y - y0) < 0.4);
        if near && index + 1 < points.len() {
            continue;
        }
        let _ = write!(data, "{}{} {}", if last.is_none() { "M" } else { "L" }, short(x), short(y));
        last = Some((x, y));
    }
    if closed {
        data.push('z');
    }
    data
}

/// A coordinate to a hundredth, without zeros at the end. What is no number, or far outside, is kept at the edge.
fn short(x: f64) -> String {
    let x = if x.is_nan() { 0.0 } else { x.clamp(-1e5, 1e5) };
    let rounded = (x * 100.0).round() / 100.0;
    // `-0` would be right, and ugly.
    format!("{}", rounded + 0.0)
}

/// Makes any text safe in XML.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            // XML has no way to write these.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

/// The markup of [`Svg::math`].
fn math(text: &str) -> String {
    let mut out = String::new();
    let mut italic = false;
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let tail = &rest[c.len_utf8()..];
        match (c, tail.strip_prefix('{').and_then(|tail| tail.split_once('}'))) {
            ('*', _) => {
                out.push_str(if italic { "</tspan>" } else { "<tspan class=\"i\">" });
                italic = !italic;
                rest = tail;
            }
            ('_' | '^', Some((inner, after))) => {
                let (there, back) = if c == '_' { ("4", "-4") } else { ("-5", "5") };
                let _ = write!(out, "<tspan class=\"sub\" dy=\"{there}\">{}</tspan>", math(inner));
                // The shift lasts until it is taken back, at the next letter.
                let _ = write!(out, "<tspan dy=\"{back}\">\u{200b}</tspan>");
                rest = after;
            }
            _ => {
                out.push_str(&escape(c.encode_utf8(&mut [0; 4])));
                rest = tail;
            }
        }
    }
    if italic {
        out.push_str("</tspan>");
    }
    out
}

/// A number for an axis or a legend: three digits, an exponent only where it is shorter.
pub(crate) fn label(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let size = x.abs();
    if !(1e-3..1e5).contains(&size) {
        return format!("{x:.2e}");
    }
    let decimals = (2 - size.log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// The largest of 1, 2, 2.5, 5 times a power of ten so that about `count` steps reach `max`.
pub(crate) fn nice_step(max: f64, count: f64) -> f64 {
    let raw = max / count;
    let power = 10.0_f64.powf(raw.log10().floor());
    let digit = [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().find(|digit| digit * power >= raw * 0.999);
    digit.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_is_safe() {
        assert_eq!(escape("a<b>&\"'\u{0}"), "a&lt;b&gt;&amp;&quot;&#39; ");
        assert!(math("*f*_{r} ≤ 1 & *q").ends_with("</tspan>"));
        assert!(math("_{").contains('{'));
    }

    #[test]
    fn labels_are_short() {
        for (x, text) in [(0.0, "0"), (0.25, "0.25"), (12.0, "12"), (1234.5, "1234"), (1e-5, "1.00e-5"), (0.1, "0.1")] {
            assert_eq!(label(x), text);
        }
        assert_eq!(nice_step(1.0, 4.0), 0.25);
        assert_eq!(nice_step(7.3, 4.0), 2.0);
    }
}
