//! `lobe eval`: pairs of directions in, values of `f_r` out, line by line.

use crate::args::{EvalArgs, Number};
use crate::error::{Failure, reason};
use crate::output;
use crate::progress::Progress;
use crate::spec;
use lobe::number::{Approximate, Coarse, Fast};
use lobe::{Half, Real, Vec3};
use lobe_models::{Material, Number as Built};
use serde_json::json;
use std::fmt::Debug;
use std::io::{BufRead, BufReader, BufWriter, IsTerminal as _, Read as _, Write};

/// Six numbers of a thousand digits each would fit; a file without line ends does not fill the memory.
const MAX_LINE: u64 = 8192;

/// What a line holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Line<R> {
    /// The directions to the light and to the viewer.
    Pair(Vec3<R>, Vec3<R>),
    /// Nothing: blank, a comment, or the header.
    Skip,
}

/// The scalar types that lines are read in.
pub trait Scalar: Real + Built + Debug {
    /// How far from 1 a length may be: a unit vector of `f32` is off by 1e-7, one printed with six decimals by 1e-6. A
    /// lobe of exponent `q` turns an error of the length into one `q` times as large, so what is off by more has to be
    /// normalised.
    const LENGTH_TOLERANCE: f64 = 1e-5;
    /// The lengths that can be normalised.
    const LENGTHS: &str = "1e-37 to 1e38";

    /// The number that a text stands for.
    fn parse(text: &str) -> Option<Self>;
    /// The same number, exactly.
    fn wide(self) -> f64;
    /// The shortest decimal that reads back the same; very small and very large ones have an exponent.
    fn print(self) -> String;
}

impl Scalar for f32 {
    fn parse(text: &str) -> Option<Self> {
        text.parse().ok()
    }
    fn wide(self) -> f64 {
        f64::from(self)
    }
    fn print(self) -> String {
        format!("{self:?}")
    }
}

impl Scalar for f64 {
    fn parse(text: &str) -> Option<Self> {
        text.parse().ok()
    }
    fn wide(self) -> f64 {
        self
    }
    fn print(self) -> String {
        format!("{self:?}")
    }
}

impl Scalar for Half {
    // A component of a unit vector is off by 2.4e-4 there, and so is the length.
    const LENGTH_TOLERANCE: f64 = 2e-3;
    // Shorter ones have squares of a few digits only, longer ones none at all.
    const LENGTHS: &str = "0.05 to 200";

    fn parse(text: &str) -> Option<Self> {
        text.parse::<f64>().ok().map(Self::from)
    }
    fn wide(self) -> f64 {
        self.into()
    }
    fn print(self) -> String {
        // Four or five digits tell numbers of binary16 apart; those of `f32` are more than it has, but read back the same.
        format!("{:?}", f32::from(self))
    }
}

/// Of a precision that trades digits: they are read and printed as those of `f32`.
macro_rules! approximate {
    ($($precision:ident)+) => {$(
        impl Scalar for Approximate<f32, $precision> {
            fn parse(text: &str) -> Option<Self> {
                text.parse().ok().map(Self::new)
            }
            fn wide(self) -> f64 {
                f64::from(self.value())
            }
            fn print(self) -> String {
                self.value().print()
            }
            // The largest of the estimates that unit vectors are made with is off by 3.7e-4.
            const LENGTH_TOLERANCE: f64 = 1e-3;
            // Beyond, an estimate has no reciprocal of the square of a length.
            const LENGTHS: &str = "1e-18 to 1e18";
        }
    )+};
}
approximate!(Fast Coarse);

/// Reads a line `lx,ly,lz,vx,vy,vz`. If `normalize`, directions are scaled to unit length; otherwise their length is
/// within [`Scalar::LENGTH_TOLERANCE`] of 1.
///
/// # Errors
/// What is wrong with the line, and what would be right.
pub fn parse_line<R: Scalar>(line: &[u8], normalize: bool) -> Result<Line<R>, String> {
    const RIGHT: &str = "a line has six numbers, lx,ly,lz,vx,vy,vz";
    let text = std::str::from_utf8(line).map_err(|_| format!("this is not text; {RIGHT}"))?.trim();
    if text.is_empty() || text.starts_with('#') || is_header(text) {
        return Ok(Line::Skip);
    }
    let mut numbers: [Option<R>; 6] = [None; 6];
    let mut count = 0_usize;
    for field in text.split(',') {
        if let Some(number) = numbers.get_mut(count) {
            let field = field.trim();
            let value = R::parse(field).ok_or_else(|| format!("`{}` is not a number; {RIGHT}", shorten(field)))?;
            if !value.wide().is_finite() {
                return Err(format!("`{}` is not a finite number; {RIGHT}", shorten(field)));
            }
            *number = Some(value);
        }
        count += 1;
    }
    let (6, [Some(lx), Some(ly), Some(lz), Some(vx), Some(vy), Some(vz)]) = (count, numbers) else {
        let s = if count == 1 { "" } else { "s" };
        return Err(format!("{count} number{s}; {RIGHT}"));
    };
    let l = direction("l", Vec3::new(lx, ly, lz), normalize)?;
    let v = direction("v", Vec3::new(vx, vy, vz), normalize)?;
    Ok(Line::Pair(l, v))
}

/// Whether this is the line that names the columns.
fn is_header(text: &str) -> bool {
    text.split(',').map(str::trim).eq(["lx", "ly", "lz", "vx", "vy", "vz"])
}

fn direction<R: Scalar>(name: &str, d: Vec3<R>, normalize: bool) -> Result<Vec3<R>, String> {
    // Of the numbers as they were read, in `f64`: the check is the same for all number types.
    let length = d.map(R::wide).length();
    if length == 0.0 {
        return Err(format!("direction {name} has length 0; a direction has unit length"));
    }
    if normalize {
        let unit = d.normalize();
        return match unit.map(R::wide).length() {
            unit_length if (unit_length - 1.0).abs() <= R::LENGTH_TOLERANCE => Ok(unit),
            _ => Err(format!("direction {name} has length {length}; a length from {} can be normalized", R::LENGTHS)),
        };
    }
    if (length - 1.0).abs() > R::LENGTH_TOLERANCE {
        return Err(format!("direction {name} has length {length}; give it unit length, or use --normalize"));
    }
    Ok(d)
}

/// The start of a field that may be very long.
fn shorten(field: &str) -> String {
    if field.chars().count() <= 40 { field.to_owned() } else { field.chars().take(40).chain(['…']).collect() }
}

/// Runs the verb.
pub(crate) fn run(args: &EvalArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    if args.list_presets {
        return list_presets(json);
    }
    let spec = spec::from_argument(&args.brdf)?;
    if !quiet {
        for warning in spec.warnings() {
            let _ = writeln!(std::io::stderr(), "warning: {warning}");
        }
    }
    // Values that run over the terminal are progress enough.
    let bar = Progress::counting("pairs", quiet || std::io::stdout().is_terminal());
    match args.number {
        Number::F32 => stream::<f32>(&spec, args.normalize, json, &bar),
        Number::F64 => stream::<f64>(&spec, args.normalize, json, &bar),
        Number::Half => stream::<Half>(&spec, args.normalize, json, &bar),
        Number::Fast => stream::<Approximate<f32, Fast>>(&spec, args.normalize, json, &bar),
        Number::Coarse => stream::<Approximate<f32, Coarse>>(&spec, args.normalize, json, &bar),
    }
}

fn list_presets(json: bool) -> Result<(), Failure> {
    let mut text = String::new();
    if json {
        let list: serde_json::Map<_, _> = lobe_models::PRESETS
            .iter()
            .filter_map(|(name, text)| Some(((*name).to_owned(), serde_json::from_str(text).ok()?)))
            .collect();
        text = format!("{:#}\n", json!(list));
    } else {
        for (name, spec) in lobe_models::PRESETS {
            text += &format!("{name:<24} {spec}\n");
        }
    }
    output::print(text.as_bytes())
}

/// Reads, evaluates and prints until the input ends. What was right before a wrong line has been printed.
fn stream<R: Scalar>(spec: &Material, normalize: bool, json: bool, bar: &Progress) -> Result<(), Failure> {
    let material = spec.build::<R>();
    let mut input = BufReader::with_capacity(1 << 16, std::io::stdin().lock());
    let mut out = BufWriter::with_capacity(1 << 16, std::io::stdout().lock());
    let mut line = Vec::new();
    let mut number = 0_usize;
    let failure = loop {
        // Seldom enough to cost nothing.
        if number % 4096 == 4095 {
            bar.advance(4096);
        }
        // Before waiting for more, answer what has been asked: a program at the other end may be waiting too.
        if input.buffer().is_empty() && !output::stdout_result(out.flush())? {
            return Ok(());
        }
        line.clear();
        number += 1;
        match (&mut input).take(MAX_LINE).read_until(b'\n', &mut line) {
            Ok(0) => break None,
            Ok(_) => {}
            Err(error) => {
                let right = "a stream that can be read to its end";
                break Some(Failure::at("<stdin>", number, format!("cannot read: {}", reason(&error)), right));
            }
        }
        if line.len() as u64 == MAX_LINE && !line.ends_with(b"\n") {
            let right = "a line has six numbers, lx,ly,lz,vx,vy,vz";
            break Some(Failure::at("<stdin>", number, format!("this line is longer than {MAX_LINE} bytes"), right));
        }
        // A byte order mark, as some spreadsheets write it.
        let text = if number == 1 { line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&line) } else { &line };
        match parse_line::<R>(text, normalize) {
            Ok(Line::Skip) => {}
            Ok(Line::Pair(l, v)) => {
                if !output::stdout_result(print_value(&mut out, material.eval(l, v), json))? {
                    return Ok(());
                }
            }
            Err(problem) => break Some(Failure::Input(format!("<stdin>:{number}: {problem}"))),
        }
    };
    output::stdout_result(out.flush())?;
    failure.map_or(Ok(()), Err)
}

/// Three numbers with every digit that they have.
fn print_value<R: Scalar>(out: &mut impl Write, f: lobe::Rgb<R>, json: bool) -> std::io::Result<()> {
    if !json {
        return writeln!(out, "{},{},{}", f.r.print(), f.g.print(), f.b.print());
    }
    // JSON has no word for an overflow.
    let [r, g, b] = [f.r, f.g, f.b].map(|x| if x.wide().is_finite() { x.print() } else { "null".to_owned() });
    writeln!(out, "[{r},{g},{b}]")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(line: &str) -> String {
        parse_line::<f32>(line.as_bytes(), false).map_or_else(|p| p, |line| panic!("accepted: {line:?}"))
    }

    #[test]
    fn lines_that_hold_no_pair_are_skipped() {
        for line in ["", "  \r\n", "# a comment", "lx,ly,lz,vx,vy,vz\n", "lx, ly, lz, vx, vy, vz"] {
            assert_eq!(parse_line::<f32>(line.as_bytes(), false), Ok(Line::Skip), "{line:?}");
        }
    }

    #[test]
    fn wrong_lines_say_what_would_be_right() {
        assert_eq!(problem("0,0,1,0,0"), "5 numbers; a line has six numbers, lx,ly,lz,vx,vy,vz");
        assert_eq!(problem("0,0,1,0,0,1,0"), "7 numbers; a line has six numbers, lx,ly,lz,vx,vy,vz");
        assert_eq!(problem("0,0,1,0,x,1"), "`x` is not a number; a line has six numbers, lx,ly,lz,vx,vy,vz");
        assert_eq!(problem("0,0,1,0,NaN,1"), "`NaN` is not a finite number; a line has six numbers, lx,ly,lz,vx,vy,vz");
        assert_eq!(problem("0,0,1,0,0,0"), "direction v has length 0; a direction has unit length");
        assert_eq!(problem("0,0,2,0,0,1"), "direction l has length 2; give it unit length, or use --normalize");
    }

    #[test]
    fn normalizing_takes_any_length() {
        let pair = parse_line::<f64>(b"0,0,1e-30,3,0,4", true);
        assert_eq!(pair, Ok(Line::Pair(Vec3::new(0.0, 0.0, 1.0), Vec3::new(3.0, 0.0, 4.0).normalize())));
        assert!(parse_line::<f64>(b"0,0,1e-200,3,0,4", true).is_err());
        assert!(parse_line::<f64>(b"0,0,1e200,3,0,4", true).is_err());
    }
}
