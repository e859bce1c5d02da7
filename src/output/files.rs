//! Output files appear whole or not at all.
//!
//! Everything is written to temporary files beside the targets; only when all are complete are they
//! renamed over them. A failure on the way leaves what was there before.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

/// Files that are written together.
#[derive(Debug, Default)]
pub struct OutputFiles {
    pending: Vec<(PathBuf, NamedTempFile)>,
}

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// Why.
    pub source: io::Error,
}

/// Whether a file can be created at a path: its folder is there, and what is there already is a
/// file.
///
/// # Errors
/// What creating it would fail with.
pub fn check_target(path: &Path) -> Result<(), WriteError> {
    let fail = |kind: io::ErrorKind, what: &str| {
        Err(WriteError { path: path.to_owned(), source: io::Error::new(kind, what.to_owned()) })
    };
    if path.is_dir() {
        return fail(io::ErrorKind::IsADirectory, "it is a folder");
    }
    if path.exists() && !path.is_file() {
        return fail(io::ErrorKind::InvalidInput, "it is a device or pipe, not a file");
    }
    if !folder_of(path).is_dir() {
        return fail(io::ErrorKind::NotFound, "its folder does not exist");
    }
    Ok(())
}

/// What lies behind an error that tells the name of a temporary file.
fn cause(error: io::Error) -> io::Error {
    let behind = error.get_ref().and_then(|e| e.source()).map(ToString::to_string);
    match behind {
        Some(text) => io::Error::new(error.kind(), text),
        None => error,
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

impl OutputFiles {
    /// Writes a file under a temporary name. Where a link leads to the file, the link stays.
    ///
    /// # Errors
    /// What `write` fails with, or the file system.
    pub fn add<E: From<io::Error> + ToString>(
        &mut self,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> Result<(), E>,
    ) -> Result<(), WriteError> {
        let failed = |source: io::Error| WriteError { path: path.to_owned(), source };
        let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let mut builder = Builder::new();
        builder.prefix(".beamwright-").suffix(".part");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As any new file: the user's mask decides.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(folder_of(&target)).map_err(|e| failed(cause(e)))?;
        // Past the temporary file, whose errors tell its own name.
        let mut buffered = BufWriter::with_capacity(1 << 16, file.as_file());
        write(&mut buffered).map_err(|e| failed(io::Error::other(e.to_string())))?;
        buffered.flush().map_err(failed)?;
        drop(buffered);
        self.pending.push((target, file));
        Ok(())
    }

    /// Where the files will be.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.pending.iter().map(|(path, _)| path.as_path())
    }

    /// Puts all files in their places.
    ///
    /// # Errors
    /// The first file that cannot be renamed; those after it are not written.
    pub fn commit(self) -> Result<(), WriteError> {
        for (path, file) in self.pending {
            file.persist(&path)
                .map_err(|e| WriteError { path: path.clone(), source: cause(e.error) })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_leaves_the_old_file_and_nothing_else() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "old")?;
        let mut files = OutputFiles::default();
        files.add(&path, |out| out.write_all(b"new"))?;
        let second = folder.path().join("b.txt");
        let failed = files.add(&second, |_| Err(io::Error::other("full")));
        assert!(failed.is_err_and(|e| e.to_string().ends_with("b.txt: full")));
        drop(files);
        assert_eq!(std::fs::read_to_string(&path)?, "old");
        assert_eq!(std::fs::read_dir(folder.path())?.count(), 1);
        Ok(())
    }

    #[test]
    fn a_success_replaces_the_old_file() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "old")?;
        let mut files = OutputFiles::default();
        files.add(&path, |out| out.write_all(b"new"))?;
        files.commit()?;
        assert_eq!(std::fs::read_to_string(&path)?, "new");
        Ok(())
    }
}
