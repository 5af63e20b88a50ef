//! What can go wrong ([`Error`]) and what was worth saying ([`Warning`]).
//!
//! An error names the place, what was wrong there and what would be right. A warning is a value: it
//! comes back with the scene, and the caller decides whether to print it.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a scene could not be read, a picture not be made, or a file not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read.
    #[error("{}: cannot read this file: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file could not be written. An older file of that name is still whole.
    #[error("{}: cannot write this file: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A line of an OBJ or MTL file is wrong.
    #[error("{file}:{line}: {problem}; {expected}")]
    Syntax {
        /// The file as the caller named it.
        file: String,
        /// The line, counted from 1. Of a statement continued with `\`, the first line.
        line: usize,
        /// What is wrong.
        problem: String,
        /// What would be right.
        expected: String,
    },
    /// A scene description in JSON is wrong.
    #[error("{file}:{line}:{column}: {problem}")]
    Json {
        /// The file as the caller named it.
        file: String,
        /// The line, counted from 1.
        line: usize,
        /// The column, counted from 1.
        column: usize,
        /// What is wrong, and where it can be said, what would be right.
        problem: String,
    },
    /// A glTF file is wrong.
    #[error("{file}: {problem}")]
    Content {
        /// The file as the caller named it.
        file: String,
        /// What is wrong, and where it can be said, what would be right.
        problem: String,
    },
    /// A file holds no triangle that could be drawn.
    #[error("{file}: no triangle with an area; an OBJ file needs `v` lines and `f` lines of three corners or more")]
    NoTriangles {
        /// The file as the caller named it.
        file: String,
    },
    /// A value given from Rust or in a scene description is outside its domain.
    #[error("{what} is {value}; {expected}")]
    Setting {
        /// Which value.
        what: String,
        /// What it is.
        value: String,
        /// What would be right.
        expected: String,
    },
    /// The ending of a file name says nothing that this crate knows.
    #[error("{}: unknown kind of file; {expected}", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// The endings that are known.
        expected: &'static str,
    },
    /// A picture could not be turned into bytes.
    #[error("{}: cannot encode this picture: {problem}", path.display())]
    Encode {
        /// The file that was to be written.
        path: PathBuf,
        /// What the encoder said.
        problem: String,
    },
}

impl Error {
    /// An error in a line of a text file.
    pub(crate) fn syntax(file: &str, line: usize, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::Syntax { file: file.to_owned(), line, problem: problem.into(), expected: expected.into() }
    }

    /// An error in a value that a caller gave.
    pub(crate) fn setting(what: impl Into<String>, value: impl fmt::Display, expected: impl Into<String>) -> Self {
        Self::Setting { what: what.into(), value: value.to_string(), expected: expected.into() }
    }

    /// An error of reading `path`.
    pub(crate) fn read(path: &Path, source: io::Error) -> Self {
        Self::Read { path: path.to_owned(), source }
    }
}

/// Something in a file that was understood differently, or not at all, without stopping the work.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// The file as the caller named it.
    pub file: String,
    /// The line, counted from 1; 0 when the warning is about the file as a whole.
    pub line: usize,
    /// What was found, and what was done instead.
    pub text: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line == 0 {
            write!(f, "{}: {}", self.file, self.text)
        } else {
            write!(f, "{}:{}: {}", self.file, self.line, self.text)
        }
    }
}

/// The warnings of one file.
///
/// A file of another kind altogether can hold a new unknown keyword in each line; after
/// [`LIMIT`](Self::LIMIT) warnings the rest are only counted.
#[derive(Debug)]
pub(crate) struct Warnings {
    file: String,
    list: Vec<Warning>,
    more: usize,
}

impl Warnings {
    /// How many warnings of one file are kept.
    pub(crate) const LIMIT: usize = 100;

    pub(crate) fn new(file: &str) -> Self {
        Self { file: file.to_owned(), list: Vec::new(), more: 0 }
    }

    /// Notes a warning about a line (0: about the whole file).
    pub(crate) fn push(&mut self, line: usize, text: impl Into<String>) {
        if self.list.len() < Self::LIMIT {
            self.list.push(Warning { file: self.file.clone(), line, text: text.into() });
        } else {
            self.more += 1;
        }
    }

    /// Whether this was said.
    pub(crate) fn contains(&self, text: &str) -> bool {
        self.list.iter().any(|warning| warning.text == text)
    }

    /// Adds the warnings of another file.
    pub(crate) fn append(&mut self, other: Vec<Warning>) {
        self.list.extend(other);
    }

    pub(crate) fn finish(mut self) -> Vec<Warning> {
        if self.more > 0 {
            let text = format!("and {} more warnings", self.more);
            self.list.push(Warning { file: self.file, line: 0, text });
        }
        self.list
    }
}
