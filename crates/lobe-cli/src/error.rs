//! Why a verb failed, and the exit code that says so.

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

/// The one line that is printed after `error: `, by kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// Something that was promised does not hold: exit code 1.
    Check(String),
    /// The command line asks for what does not exist: exit code 2, as for clap's own errors.
    Usage(String),
    /// A file or a stream that was given is wrong: exit code 3.
    Input(String),
    /// A file cannot be written: exit code 4.
    Write(String),
}

impl Failure {
    /// An error at a place in a text: `source:line: what; right`.
    pub(crate) fn at(source: &str, line: usize, what: impl fmt::Display, right: impl fmt::Display) -> Self {
        Self::Input(format!("{source}:{line}: {what}; {right}"))
    }

    /// `path` cannot be written.
    pub(crate) fn write(path: &Path, error: &std::io::Error, right: &str) -> Self {
        Self::Write(format!("{}: cannot write this: {}; {right}", path.display(), reason(error)))
    }

    /// The exit code, as `lobe --help` lists them.
    #[must_use]
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Check(_) => 1,
            Self::Usage(_) => 2,
            Self::Input(_) => 3,
            Self::Write(_) => 4,
        })
    }
}

impl From<lobe_scene::Error> for Failure {
    fn from(error: lobe_scene::Error) -> Self {
        match &error {
            lobe_scene::Error::Write { path, source } => {
                Self::write(path, source, "name a file in a folder that exists and can be written to")
            }
            lobe_scene::Error::Encode { .. } => Self::Write(error.to_string()),
            lobe_scene::Error::Read { path, source } => {
                let right = "give a file that is there and can be read";
                Self::Input(format!("{}: cannot read this file: {}; {right}", path.display(), reason(source)))
            }
            _ => Self::Input(error.to_string()),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Check(text) | Self::Usage(text) | Self::Input(text) | Self::Write(text)) = self;
        // One error is one line, whatever a file name or a parser's message holds.
        f.write_str(&text.replace(['\n', '\r'], " "))
    }
}

impl std::error::Error for Failure {}

/// What the system said, without the number of the error.
pub(crate) fn reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    match text.find(" (os error") {
        Some(end) => text[..end].to_lowercase(),
        None => text,
    }
}
