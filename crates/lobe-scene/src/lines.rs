//! The lines, words and numbers that OBJ and MTL have in common.

use crate::error::Error;

/// The statements of a file, one after the other: comments and line ends removed, lines that end with
/// `\` joined to the next.
#[derive(Debug)]
pub(crate) struct Statements<'a> {
    rest: &'a [u8],
    line: usize,
    joined: Vec<u8>,
}

impl<'a> Statements<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        // Windows editors put a byte order mark at the start.
        let rest = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        Self { rest, line: 0, joined: Vec::new() }
    }

    /// The next statement that holds a word, with the number of its first line.
    pub(crate) fn next(&mut self) -> Option<(usize, &[u8])> {
        loop {
            let mut current = self.physical_line()?;
            let line = self.line;
            let comment = current.trim_ascii_start().first() == Some(&b'#');
            if comment || current.last() != Some(&b'\\') {
                let statement = without_comment(current).trim_ascii();
                if statement.is_empty() {
                    continue;
                }
                return Some((line, statement));
            }
            self.joined.clear();
            while let Some(head) = current.strip_suffix(b"\\") {
                self.joined.extend_from_slice(head);
                self.joined.push(b' ');
                match self.physical_line() {
                    Some(next) => current = next,
                    None => current = b"",
                }
            }
            self.joined.extend_from_slice(current);
            if without_comment(&self.joined).trim_ascii().is_empty() {
                continue;
            }
            return Some((line, without_comment(&self.joined).trim_ascii()));
        }
    }

    fn physical_line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.line += 1;
        let (line, rest) = match self.rest.iter().position(|&byte| byte == b'\n') {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &self.rest[self.rest.len()..]),
        };
        self.rest = rest;
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    }
}

/// A `#` starts a comment where a word could start; inside a word it belongs to it, because real files
/// name materials `Material#25`.
fn without_comment(line: &[u8]) -> &[u8] {
    let mut previous = b' ';
    for (at, &byte) in line.iter().enumerate() {
        if byte == b'#' && is_space(previous) {
            return &line[..at];
        }
        previous = byte;
    }
    line
}

fn is_space(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == 0x0b
}

/// The words of a statement.
pub(crate) fn words(statement: &[u8]) -> impl Iterator<Item = &[u8]> {
    statement.split(|&byte| is_space(byte)).filter(|word| !word.is_empty())
}

/// The first word of a statement and what follows it.
pub(crate) fn keyword(statement: &[u8]) -> (&[u8], &[u8]) {
    match statement.iter().position(|&byte| is_space(byte)) {
        Some(end) => (&statement[..end], statement[end..].trim_ascii()),
        None => (statement, b""),
    }
}

/// Text for a message or a name; bytes that are not UTF-8 become `�`.
pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A word for a message: not longer than a line.
pub(crate) fn shown(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    if bytes.len() <= LONGEST {
        return text(bytes);
    }
    format!("{}…", String::from_utf8_lossy(&bytes[..LONGEST]))
}

/// Where a statement stands: for error messages.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) file: &'a str,
    pub(crate) line: usize,
}

impl Place<'_> {
    pub(crate) fn error(self, problem: impl Into<String>, expected: impl Into<String>) -> Error {
        Error::syntax(self.file, self.line, problem, expected)
    }

    /// A finite number.
    pub(crate) fn number(self, word: &[u8]) -> Result<f32, Error> {
        let value = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f32>().ok());
        match value {
            Some(value) if value.is_finite() => Ok(value),
            Some(_) => Err(self.error(
                format!("`{}` is not a finite number", shown(word)),
                "write a decimal number between -3.4e38 and 3.4e38",
            )),
            None => Err(self.error(
                format!("`{}` is not a number", shown(word)),
                "write a decimal number such as 1, -0.5 or 2.5e-3",
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Vec<(usize, String)> {
        let mut statements = Statements::new(text.as_bytes());
        let mut list = Vec::new();
        while let Some((line, statement)) = statements.next() {
            list.push((line, String::from_utf8_lossy(statement).into_owned()));
        }
        list
    }

    #[test]
    fn joins_continued_lines_and_counts_the_first() {
        assert_eq!(
            all("a 1\r\n\r\nf 1 2 \\\r\n 3 \\\n4\nb"),
            [(1, "a 1".into()), (3, "f 1 2   3  4".into()), (6, "b".into())]
        );
    }

    #[test]
    fn a_comment_swallows_no_line_and_a_name_may_hold_a_hash() {
        assert_eq!(all("# C:\\scenes\\\nusemtl Material#25 # red\n   #\n"), [(2, "usemtl Material#25".into())]);
    }

    #[test]
    fn a_continuation_at_the_end_of_the_file_ends() {
        assert_eq!(all("a\\"), [(1, "a".into())]);
        assert_eq!(all("\\\n\\\n\\"), []);
        assert_eq!(all("\u{feff}v 1"), [(1, "v 1".into())]);
    }
}
