//! Reading files that may be anything, and writing files never by halves.
//!
//! A file is written under a temporary name in its own folder, brought to the disk, and then renamed. So a file that
//! exists is at any moment either the old or the new one, whole.

use crate::Error;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Writes a file in one step: whoever reads it finds the old content or the new, whole.
///
/// A symbolic link stays one, and what it points to is written. A device or a pipe is written to directly.
///
/// # Errors
/// [`Error::Write`] when the system refuses. An existing file then is as it was.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    write_all_atomically(&[(path, bytes)])
}

/// Writes several files that belong together: first all of them under temporary names, then all are renamed. So what
/// can fail has failed before the first of the old files is gone.
///
/// # Errors
/// [`Error::Write`] with the first file that the system refuses.
pub fn write_all_atomically(files: &[(&Path, &[u8])]) -> Result<(), Error> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        |source| Error::Write { path, source }
    };
    let mut temporaries = Vec::new();
    for &(path, bytes) in files {
        let temporary = match Target::of(path).map_err(failed(path))? {
            Target::File(target) => Some(Temporary::write(target, bytes).map_err(failed(path))?),
            Target::Stream => None,
        };
        temporaries.push(temporary);
    }
    for (&(path, bytes), temporary) in files.iter().zip(temporaries) {
        match temporary {
            Some(temporary) => temporary.put_in_place(),
            None => fs::write(path, bytes),
        }
        .map_err(failed(path))?;
    }
    Ok(())
}

/// Whether [`write_atomically`] can be expected to write this file: its folder is there and takes new files, and it is
/// no folder itself. To be asked before a long computation.
///
/// # Errors
/// [`Error::Write`] when it cannot.
pub fn check_writable(path: &Path) -> Result<(), Error> {
    let probe = || match Target::of(path)? {
        Target::File(target) => Temporary::write(target, &[]).map(drop),
        Target::Stream => Ok(()),
    };
    probe().map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// Where the bytes go.
enum Target {
    /// A file, or the place for one; all links are followed.
    File(PathBuf),
    /// Something that cannot be replaced, such as `/dev/null`.
    Stream,
}

impl Target {
    fn of(path: &Path) -> io::Result<Self> {
        const LINKS: usize = 40;
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => return Err(io::Error::other("it is a folder")),
            Ok(found) if !found.is_file() => return Ok(Self::Stream),
            _ => {}
        }
        let mut path = path.to_owned();
        // One by one, because the last may point to a file that is not there yet.
        for _ in 0..LINKS {
            match fs::symlink_metadata(&path) {
                Ok(found) if found.is_symlink() => {
                    let next = fs::read_link(&path)?;
                    path = path.parent().unwrap_or(Path::new("")).join(next);
                }
                _ => return Ok(Self::File(path)),
            }
        }
        Err(io::Error::other("too many symbolic links"))
    }
}

/// A finished file that waits to be renamed. It is removed if that does not happen.
struct Temporary {
    path: PathBuf,
    target: PathBuf,
}

impl Temporary {
    fn write(target: PathBuf, bytes: &[u8]) -> io::Result<Self> {
        static COUNTER: AtomicU32 = AtomicU32::new(0);
        if target.file_name().is_none() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "this is not the name of a file"));
        }
        // Not made from the name of the target, which may have the greatest length that there is.
        let (process, mut taken) = (std::process::id(), 0);
        let (mut file, path) = loop {
            let number = COUNTER.fetch_add(1, Ordering::Relaxed);
            let path = target.with_file_name(format!(".lobe-{process:x}-{number:x}.tmp"));
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => break (file, path),
                // Left behind by a process of the same number that was killed.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists && taken < 1000 => taken += 1,
                Err(error) => return Err(error),
            }
        };
        let temporary = Self { path, target };
        file.write_all(bytes)?;
        if !bytes.is_empty() {
            file.sync_all()?;
        }
        Ok(temporary)
    }

    fn put_in_place(self) -> io::Result<()> {
        fs::rename(&self.path, &self.target)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // After the renaming there is nothing to remove; and what went wrong before is what the caller needs to know.
        let _ = fs::remove_file(&self.path);
    }
}

/// The bytes of a regular file of at most `limit` bytes.
///
/// Anything else has no end (`/dev/zero`) or keeps one waiting (a pipe).
pub(crate) fn read(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let found = fs::metadata(path)?;
    if found.is_dir() {
        return Err(io::Error::other("it is a folder"));
    }
    if !found.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    let too_large = || io::Error::other(format!("it has more than {} MiB", limit >> 20));
    if found.len() > limit {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    // The length is no promise: the files of /proc say 0.
    File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(too_large()) } else { Ok(bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    fn count(folder: &Path) -> io::Result<usize> {
        Ok(fs::read_dir(folder)?.count())
    }

    #[test]
    fn a_probe_leaves_nothing_and_knows_what_cannot_be_written() -> Outcome {
        let folder = tempfile::tempdir()?;
        let file = folder.path().join("a");
        check_writable(&file)?;
        assert_eq!(count(folder.path())?, 0);
        write_atomically(&file, b"old")?;
        check_writable(&file)?;
        assert_eq!(fs::read(&file)?, b"old");
        for wrong in [folder.path().to_owned(), folder.path().join("no/a"), file.join("a"), "..".into(), "".into()] {
            assert!(matches!(check_writable(&wrong), Err(Error::Write { .. })), "{wrong:?}");
            assert!(matches!(write_atomically(&wrong, b""), Err(Error::Write { .. })), "{wrong:?}");
        }
        assert_eq!(count(folder.path())?, 1);
        Ok(())
    }

    #[test]
    fn files_that_belong_together_are_all_written_or_none() -> Outcome {
        let folder = tempfile::tempdir()?;
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        write_atomically(&a, b"old")?;
        fs::create_dir(&b)?;
        assert!(write_all_atomically(&[(&a, b"new"), (&b, b"new")]).is_err());
        assert_eq!(fs::read(&a)?, b"old");
        fs::remove_dir(&b)?;
        write_all_atomically(&[(&a, b"new"), (&b, b"new")])?;
        assert_eq!((fs::read(&a)?, fs::read(&b)?), (b"new".to_vec(), b"new".to_vec()));
        assert_eq!(count(folder.path())?, 2);
        Ok(())
    }

    #[test]
    fn the_longest_name_can_be_written() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("a".repeat(255));
        write_atomically(&path, b"new")?;
        assert_eq!(fs::read(&path)?, b"new");
        Ok(())
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_a_device_is_no_file() -> Outcome {
        let folder = tempfile::tempdir()?;
        fs::create_dir(folder.path().join("sub"))?;
        let (link, second) = (folder.path().join("link"), folder.path().join("second"));
        std::os::unix::fs::symlink("sub/target", &link)?;
        std::os::unix::fs::symlink("link", &second)?;
        for content in ["into a link that points nowhere", "into one that points to a file"] {
            write_atomically(&second, content.as_bytes())?;
            assert_eq!(fs::read_to_string(folder.path().join("sub/target"))?, content);
            assert!(fs::symlink_metadata(&link)?.is_symlink() && fs::symlink_metadata(&second)?.is_symlink());
        }
        std::os::unix::fs::symlink("loop", folder.path().join("loop"))?;
        assert!(write_atomically(&folder.path().join("loop"), b"").is_err());

        write_atomically("/dev/null".as_ref(), b"gone")?;
        for wrong in ["/dev/zero", "/dev", "/dev/none"] {
            assert!(read(wrong.as_ref(), 10).is_err(), "{wrong}");
        }
        Ok(())
    }

    #[test]
    fn a_file_is_read_up_to_the_limit() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("a");
        fs::write(&path, "0123456789")?;
        assert_eq!(read(&path, 10)?, b"0123456789");
        assert!(read(&path, 9).is_err());
        Ok(())
    }
}
