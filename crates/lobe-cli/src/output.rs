//! Writing: to standard output, where a reader that has gone away is no error, and to files, never by halves.

use crate::error::Failure;
use std::io::{self, Write};
use std::path::Path;

/// Prints `bytes` on standard output.
pub(crate) fn print(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    stdout_result(out.write_all(bytes).and_then(|()| out.flush())).map(drop)
}

/// What an attempt to print comes to: `Ok(true)` to go on, `Ok(false)` if the reader has closed the pipe (as `head`
/// does when it has seen enough).
pub(crate) fn stdout_result(result: io::Result<()>) -> Result<bool, Failure> {
    match result {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(false),
        Err(error) => Err(Failure::write(Path::new("<stdout>"), &error, "a pipe or file that takes the output")),
    }
}

/// Writes a file in one step, see [`lobe_scene::write_atomically`]. `-` is standard output.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if path.as_os_str() == "-" {
        return print(bytes);
    }
    Ok(lobe_scene::write_atomically(path, bytes)?)
}

/// Makes the folder `path`, with its parents, and tries whether these files can be written in it: before the work, not
/// after.
pub(crate) fn make_folder(path: &Path, files: &[&Path]) -> Result<(), Failure> {
    let right = "name a folder that can be made and written to with -o";
    std::fs::create_dir_all(path).map_err(|error| {
        let error = if path.is_file() { io::Error::other("it is a file, not a folder") } else { error };
        Failure::write(path, &error, right)
    })?;
    files.iter().try_for_each(|file| Ok(lobe_scene::check_writable(file)?))
}
