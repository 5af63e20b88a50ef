//! Why a subject has no value.

use super::{Pair, Precision};
use std::path::PathBuf;
use std::time::Duration;

/// Why a subject has no value, where, and what would be right.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SubjectError {
    /// The code of the subject panicked.
    #[error("{message}, for {}; a BRDF gives a value for every pair of directions", Precision::Double.line(pair))]
    Panicked {
        /// The pair that was asked for.
        pair: Pair,
        /// Where and with which words.
        message: String,
    },
    /// A program cannot be started.
    #[error("cannot start `{program}`: {reason}; the command is one that a shell would find, or a path")]
    CannotStart {
        /// The command.
        program: String,
        /// What the system says.
        reason: String,
    },
    /// A line that a program printed is not a value.
    #[error(
        "`{program}`, line {line} of its output: {problem}; for each line lx,ly,lz,vx,vy,vz of its input (here {asked}) \
         it prints one line r,g,b{}",
        said(stderr)
    )]
    Line {
        /// The command.
        program: String,
        /// The line of its standard output, from 1.
        line: usize,
        /// What is wrong with it.
        problem: String,
        /// The line that it should answer.
        asked: String,
        /// The end of its standard error.
        stderr: String,
    },
    /// A program ended before it had answered, or with a status that says that it failed.
    #[error(
        "`{program}` ended with {status} after line {line} of {of}; it prints one line r,g,b for each line of its input \
         and ends with status 0 when that ends{}",
        said(stderr)
    )]
    Ended {
        /// The command.
        program: String,
        /// Its exit status, in words.
        status: String,
        /// How many lines it had printed.
        line: usize,
        /// How many were asked for.
        of: usize,
        /// The end of its standard error.
        stderr: String,
    },
    /// A program did not answer in time and was killed.
    #[error(
        "`{program}` printed nothing for {} s after line {line} of {of} and was killed; it ends when its input ends{}",
        timeout.as_secs_f64(), said(stderr)
    )]
    Silent {
        /// The command.
        program: String,
        /// How long it was waited for.
        timeout: Duration,
        /// How many lines it had printed.
        line: usize,
        /// How many were asked for.
        of: usize,
        /// The end of its standard error.
        stderr: String,
    },
    /// A table cannot be read.
    #[error("cannot read {}: {reason}; a table is a text file", path.display())]
    CannotRead {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A line of a table is not a sample.
    #[error("{}:{line}: {problem}; a line has nine numbers, lx,ly,lz,vx,vy,vz,r,g,b", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
}

fn said(stderr: &str) -> String {
    if stderr.is_empty() { String::new() } else { format!("; it said: {stderr}") }
}
