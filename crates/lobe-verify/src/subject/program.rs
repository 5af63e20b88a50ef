//! A program that speaks the lines of `lobe eval`: a BRDF in any language can be checked as it is.

use super::{Pair, Precision, Subject, SubjectError, Value};
use std::collections::VecDeque;
use std::ffi::OsString;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// So much of the end of a program's standard error goes into the report.
const STDERR: usize = 600;

/// A line that is longer is not three numbers; without an end the memory would fill.
const MAX_LINE: usize = 8192;

/// A program that reads lines `lx,ly,lz,vx,vy,vz` and prints for each a line `r,g,b` of `f_r` in sr⁻¹, without the
/// cosine, until its input ends; as `lobe eval` does.
///
/// It is started once for each batch of pairs. Blank lines, comments (`#`) and a header `r,g,b` in what it prints are
/// skipped.
#[derive(Clone, Debug)]
pub struct Program {
    command: OsString,
    args: Vec<OsString>,
    silence: Duration,
    precision: Precision,
}

impl Program {
    /// The program `command`, a path or a name that is searched for as a shell does, with its arguments. No shell comes
    /// between.
    ///
    /// It is taken to compute in `f32` and may be silent for 30 seconds.
    pub fn new(command: impl AsRef<Path>, args: impl IntoIterator<Item = impl Into<OsString>>) -> Self {
        Self {
            command: command.as_ref().into(),
            args: args.into_iter().map(Into::into).collect(),
            silence: Duration::from_secs(30),
            precision: Precision::Single,
        }
    }

    /// The same program, killed when it has printed nothing for this long. One that answers only when its input has
    /// ended needs enough for a whole batch, some 100 000 lines.
    #[must_use]
    pub fn silent_for(self, silence: Duration) -> Self {
        Self { silence, ..self }
    }

    /// The same program, which computes in this number type: directions are rounded to it, and printed with all of its
    /// digits.
    #[must_use]
    pub fn in_precision(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }

    /// The command and its arguments, as one would type them.
    fn name(&self) -> String {
        let words: Vec<_> =
            std::iter::once(&self.command).chain(&self.args).map(|word| word.to_string_lossy()).collect();
        words.join(" ")
    }
}

impl Subject for Program {
    fn eval(&self, pairs: &[Pair]) -> Result<Vec<Value>, SubjectError> {
        if pairs.is_empty() {
            return Ok(Vec::new());
        }
        let rounded: Vec<Pair> = pairs.iter().map(|pair| pair.map(|x| self.precision.round(x))).collect();
        let spawned = Command::new(&self.command)
            .args(&self.args)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn();
        let mut child =
            spawned.map_err(|error| SubjectError::CannotStart { program: self.name(), reason: error.to_string() })?;
        let mut conversation = Conversation::start(self, &rounded, &mut child);
        let result = conversation.read_all(&mut child);
        if result.is_err() {
            // It may have ended already; then there is nothing to kill and nothing to report.
            let _ = child.kill();
        }
        let _ = child.wait();
        result
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    fn line(&self, index: usize) -> Option<usize> {
        Some(index + 1)
    }

    /// The lines hold finite numbers; `lobe eval` refuses others.
    fn takes_nan(&self) -> bool {
        false
    }
}

/// What is said to one run of the program and what it answers.
struct Conversation<'a> {
    program: &'a Program,
    pairs: &'a [Pair],
    output: Receiver<Vec<u8>>,
    stderr: Arc<Mutex<VecDeque<u8>>>,
    stderr_ended: Receiver<()>,
    values: Vec<Value>,
    /// The line of output that is read, from 1, and what there is of it.
    line: usize,
    rest: Vec<u8>,
}

impl<'a> Conversation<'a> {
    /// Starts a thread for each of the three streams, so that none can wait for another. They are not waited for: a
    /// process that a killed program has left behind may hold a stream open.
    fn start(program: &'a Program, pairs: &'a [Pair], child: &mut Child) -> Self {
        let (sender, output) = channel();
        let (ended, stderr_ended) = channel();
        let stderr = Arc::new(Mutex::new(VecDeque::new()));
        if let Some(stdin) = child.stdin.take() {
            let text: String = pairs.iter().map(|pair| program.precision.line(pair) + "\n").collect();
            thread::spawn(move || write(stdin, &text));
        }
        if let Some(stdout) = child.stdout.take() {
            thread::spawn(move || pass_on(stdout, &sender));
        }
        if let Some(pipe) = child.stderr.take() {
            let end = Arc::clone(&stderr);
            thread::spawn(move || {
                keep_end(pipe, &end);
                drop(ended);
            });
        }
        let values = Vec::with_capacity(pairs.len());
        Self { program, pairs, output, stderr, stderr_ended, values, line: 1, rest: Vec::new() }
    }

    fn read_all(&mut self, child: &mut Child) -> Result<Vec<Value>, SubjectError> {
        loop {
            match self.output.recv_timeout(self.program.silence) {
                Ok(bytes) => self.read(&bytes)?,
                Err(RecvTimeoutError::Timeout) => return Err(self.silent()),
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        // The last line may have no end.
        if !self.rest.is_empty() {
            self.read(b"\n")?;
        }
        let status = self.wait(child)?;
        if !status.success() || self.values.len() < self.pairs.len() {
            let (line, of) = (self.values.len(), self.pairs.len());
            let status = status.code().map_or_else(|| status.to_string(), |code| format!("status {code}"));
            return Err(SubjectError::Ended { program: self.program.name(), status, line, of, stderr: self.said() });
        }
        Ok(std::mem::take(&mut self.values))
    }

    /// Waits for a program that has closed its output; it may still hang.
    fn wait(&self, child: &mut Child) -> Result<ExitStatus, SubjectError> {
        let start = Instant::now();
        loop {
            match child.try_wait() {
                Ok(Some(status)) => return Ok(status),
                Ok(None) if start.elapsed() < self.program.silence => thread::sleep(Duration::from_millis(1)),
                _ => return Err(self.silent()),
            }
        }
    }

    fn silent(&self) -> SubjectError {
        let (line, of) = (self.values.len(), self.pairs.len());
        let (program, timeout) = (self.program.name(), self.program.silence);
        SubjectError::Silent { program, timeout, line, of, stderr: self.said() }
    }

    /// Takes in what came of the output.
    fn read(&mut self, bytes: &[u8]) -> Result<(), SubjectError> {
        for part in bytes.split_inclusive(|byte| *byte == b'\n') {
            self.rest.extend_from_slice(part);
            if self.rest.len() > MAX_LINE {
                return Err(self.wrong(format!("it is longer than {MAX_LINE} bytes")));
            }
            if part.ends_with(b"\n") {
                let line = std::mem::take(&mut self.rest);
                self.take_line(&line)?;
                self.line += 1;
            }
        }
        Ok(())
    }

    fn take_line(&mut self, line: &[u8]) -> Result<(), SubjectError> {
        let Ok(text) = std::str::from_utf8(line) else {
            return Err(self.wrong("this is not text".to_owned()));
        };
        let text = text.trim();
        if text.is_empty() || text.starts_with('#') || text.split(',').map(str::trim).eq(["r", "g", "b"]) {
            return Ok(());
        }
        if self.values.len() == self.pairs.len() {
            return Err(self.wrong(format!("there were {} lines to answer, and this is one more", self.pairs.len())));
        }
        match numbers(text) {
            Ok(value) => self.values.push(value),
            Err(problem) => return Err(self.wrong(problem)),
        }
        Ok(())
    }

    fn wrong(&self, problem: String) -> SubjectError {
        let asked = self.pairs.get(self.values.len()).or(self.pairs.last());
        let asked = asked.map(|pair| self.program.precision.line(pair)).unwrap_or_default();
        SubjectError::Line { program: self.program.name(), line: self.line, problem, asked, stderr: self.said() }
    }

    /// The end of the standard error, in one line. Of a program that has just ended it may still be on its way.
    fn said(&self) -> String {
        let _ = self.stderr_ended.recv_timeout(Duration::from_millis(200));
        let bytes: Vec<u8> = self.stderr.lock().map(|end| end.iter().copied().collect()).unwrap_or_default();
        let text = String::from_utf8_lossy(&bytes);
        text.lines().map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" / ")
    }
}

/// The numbers of a line.
pub(super) fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let fields: Vec<&str> = text.split(',').map(str::trim).collect();
    if fields.len() != N {
        let s = if fields.len() == 1 { "" } else { "s" };
        return Err(format!("`{}` has {} field{s}, not {N}", shorten(text), fields.len()));
    }
    let mut numbers = [0.0; N];
    for (number, field) in numbers.iter_mut().zip(fields) {
        *number = field.parse().map_err(|_| format!("`{}` is not a number", shorten(field)))?;
    }
    Ok(numbers)
}

fn shorten(field: &str) -> String {
    if field.chars().count() <= 40 { field.to_owned() } else { field.chars().take(40).chain(['…']).collect() }
}

/// A program that ends early closes its input: what it has not read is lost, and its end is reported by its output.
fn write(mut stdin: ChildStdin, text: &str) {
    let _ = stdin.write_all(text.as_bytes());
}

fn pass_on(mut stdout: ChildStdout, sender: &Sender<Vec<u8>>) {
    let mut buffer = vec![0; 1 << 16];
    while let Ok(count @ 1..) = stdout.read(&mut buffer) {
        let bytes = buffer.get(..count).unwrap_or_default();
        if sender.send(bytes.to_vec()).is_err() {
            return;
        }
    }
}

fn keep_end(mut pipe: ChildStderr, end: &Mutex<VecDeque<u8>>) {
    let mut buffer = [0; 1024];
    while let Ok(count @ 1..) = pipe.read(&mut buffer) {
        let Ok(mut end) = end.lock() else { return };
        end.extend(buffer.iter().take(count));
        let excess = end.len().saturating_sub(STDERR);
        end.drain(..excess);
    }
}
