//! Samples of a BRDF in a file.

use super::{Pair, Precision, SubjectError, Value};
use std::path::{Path, PathBuf};

/// How far from 1 a length may be, as in `lobe eval`: six decimals are enough.
const LENGTH_TOLERANCE: f64 = 1e-5;

/// A sample and where it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The line of the file, from 1.
    pub line: usize,
    /// The directions.
    pub pair: Pair,
    /// `f_r`, in sr⁻¹.
    pub value: Value,
}

/// Samples `lx,ly,lz,vx,vy,vz,r,g,b` of `f_r` in sr⁻¹, without the cosine, one a line, in any order.
///
/// Directions have unit length to 1e-5; those below the horizon are allowed. Blank lines, comments (`#`) and a header
/// with these names are skipped. A value may be `nan` or `inf`: that is for the check to say.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    path: PathBuf,
    rows: Vec<Row>,
}

impl Table {
    /// Reads a file.
    ///
    /// # Errors
    /// If the file cannot be read, or a line is not nine numbers with two unit vectors; the line is named.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, SubjectError> {
        let path = path.as_ref();
        let text = std::fs::read_to_string(path)
            .map_err(|error| SubjectError::CannotRead { path: path.to_owned(), reason: error.to_string() })?;
        Self::parse(path, &text)
    }

    /// Reads a text; `path` is what errors call it.
    ///
    /// # Errors
    /// If a line is not nine numbers with two unit vectors; the line is named.
    pub fn parse(path: impl AsRef<Path>, text: &str) -> Result<Self, SubjectError> {
        let path = path.as_ref().to_owned();
        let mut rows = Vec::new();
        for (index, text) in text.trim_start_matches('\u{feff}').lines().enumerate() {
            let line = index + 1;
            match sample(text.trim()) {
                Ok(Some((pair, value))) => rows.push(Row { line, pair, value }),
                Ok(None) => {}
                Err(problem) => return Err(SubjectError::Table { path, line, problem }),
            }
        }
        if rows.is_empty() {
            let line = text.lines().count().max(1);
            return Err(SubjectError::Table { path, line, problem: "the file ends without a sample".to_owned() });
        }
        Ok(Self { path, rows })
    }

    /// The samples, in their order.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What defects are counted in: measured values have no more digits than `f32`.
    #[must_use]
    pub fn precision(&self) -> Precision {
        Precision::Single
    }
}

/// What a line holds; `None` if nothing.
fn sample(text: &str) -> Result<Option<(Pair, Value)>, String> {
    const NAMES: [&str; 9] = ["lx", "ly", "lz", "vx", "vy", "vz", "r", "g", "b"];
    if text.is_empty() || text.starts_with('#') || text.split(',').map(str::trim).eq(NAMES) {
        return Ok(None);
    }
    let [lx, ly, lz, vx, vy, vz, r, g, b] = super::program::numbers(text)?;
    for (name, [x, y, z]) in [("l", [lx, ly, lz]), ("v", [vx, vy, vz])] {
        let length = libm::sqrt(x * x + y * y + z * z);
        // Not "greater than": a NaN is no direction either.
        if (length - 1.0).abs().partial_cmp(&LENGTH_TOLERANCE).is_none_or(std::cmp::Ordering::is_gt) {
            return Err(format!("direction {name} has length {length}, not 1"));
        }
    }
    Ok(Some(([lx, ly, lz, vx, vy, vz], [r, g, b])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(text: &str) -> String {
        Table::parse("t.csv", text).map_or_else(|error| error.to_string(), |table| panic!("accepted: {table:?}"))
    }

    #[test]
    fn samples_are_read_with_their_lines() {
        let text = "lx,ly,lz,vx,vy,vz,r,g,b\n\n# a comment\n0,0,1,0.6,0,0.8,0.1,nan,0.3\n";
        let table = Table::parse("t.csv", text).unwrap();
        assert_eq!(table.rows().len(), 1);
        assert_eq!((table.rows()[0].line, table.rows()[0].value[2]), (4, 0.3));
    }

    #[test]
    fn wrong_lines_are_named() {
        let right = "a line has nine numbers, lx,ly,lz,vx,vy,vz,r,g,b";
        assert_eq!(problem("0,0,1,0,0,1,1,1"), format!("t.csv:1: `0,0,1,0,0,1,1,1` has 8 fields, not 9; {right}"));
        assert_eq!(problem("\n0,0,1,0,0,1,1,x,1"), format!("t.csv:2: `x` is not a number; {right}"));
        assert_eq!(problem("0,0,2,0,0,1,1,1,1"), format!("t.csv:1: direction l has length 2, not 1; {right}"));
        assert_eq!(problem("# only this\n"), format!("t.csv:1: the file ends without a sample; {right}"));
    }
}
