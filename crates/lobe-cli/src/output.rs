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

/// Writes a file so that a reader finds either the old content or the new, whole: under a temporary name in the same
/// folder, then renamed. `-` is standard output; a device or a pipe is written to directly.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if path.as_os_str() == "-" {
        return print(bytes);
    }
    let right = "name a file in a folder that exists and can be written to";
    replace(path, bytes).map_err(|error| Failure::write(path, &error, right))
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if let Ok(found) = std::fs::metadata(path) {
        if found.is_dir() {
            return Err(io::Error::other("it is a folder"));
        }
        if !found.is_file() {
            return std::fs::write(path, bytes);
        }
    }
    // A link stays a link: what it points to is replaced.
    let path = &std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lobe-").suffix(".tmp");
    #[cfg(unix)]
    {
        // What the umask leaves of it, as for any new file; a temporary file would be private.
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

/// Makes the folder `path`, with its parents, and tries whether it can be written to: before the work, not after.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    let right = "name a folder that can be made and written to with -o";
    std::fs::create_dir_all(path)
        .and_then(|()| tempfile::Builder::new().prefix(".lobe-").tempfile_in(path).map(drop))
        .map_err(|error| {
            let error = if path.is_file() { io::Error::other("it is a file, not a folder") } else { error };
            Failure::write(path, &error, right)
        })
}
