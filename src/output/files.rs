//! The output files of a run appear all together or not at all.
//!
//! Everything is written to temporary files beside the targets; only when all are complete are they
//! renamed over them. What was there is kept aside until the last is in its place: where one cannot
//! be renamed, those before it are taken back.
//!
//! A program that has to end at once leaves no temporary file behind: all of them are noted, and
//! [`OutputFiles::stop_all`] removes them.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile, TempPath};

/// Files that are written together.
#[derive(Debug, Default)]
pub struct OutputFiles {
    pending: Vec<(PathBuf, NamedTempFile)>,
}

/// The temporary files of all runs; held while one is made, and while files are put in their places.
static TEMPORARY: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn temporary() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// As long as it is held no file is made or put in its place.
#[derive(Debug)]
pub struct Stopped {
    _held: MutexGuard<'static, BTreeSet<PathBuf>>,
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

/// Whether a file can be created at a path: its folder is there, its name can be, and what is there
/// already is a file.
///
/// # Errors
/// What creating it would fail with.
pub fn check_target(path: &Path) -> Result<(), WriteError> {
    let failed = |source: io::Error| Err(WriteError { path: path.to_owned(), source });
    let fail = |kind: io::ErrorKind, what: &str| failed(io::Error::new(kind, what.to_owned()));
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => fail(io::ErrorKind::IsADirectory, "it is a folder"),
        Ok(there) if !there.is_file() => {
            fail(io::ErrorKind::InvalidInput, "it is a device or pipe, not a file")
        }
        Ok(_) => Ok(()),
        Err(_) if !folder_of(path).is_dir() => {
            fail(io::ErrorKind::NotFound, "its folder does not exist")
        }
        Err(fault) if fault.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(fault) => failed(fault),
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Makes something under a name that nothing has, in a folder. What fails is told without that name,
/// which means nothing to the user.
fn under_new_name<T>(
    folder: &Path,
    suffix: &str,
    mut make: impl FnMut(&Path) -> io::Result<T>,
) -> io::Result<NamedTempFile<T>> {
    let mut code = None;
    let made = Builder::new()
        .prefix(".beamwright-")
        .suffix(suffix)
        .make_in(folder, |path| make(path).inspect_err(|fault| code = fault.raw_os_error()));
    made.map_err(|fault| code.map_or(fault, io::Error::from_raw_os_error))
}

/// What is in a file, under a second name beside it; none where there is no file.
fn set_aside(path: &Path) -> io::Result<Option<TempPath>> {
    // A folder is never replaced.
    if fs::symlink_metadata(path).map_or(true, |there| there.is_dir()) {
        return Ok(None);
    }
    // Not every file system has two names for a file; there it has only the second for a while.
    let aside = under_new_name(folder_of(path), ".old", |name| fs::hard_link(path, name))
        .or_else(|_| under_new_name(folder_of(path), ".old", |name| fs::rename(path, name)))?;
    Ok(Some(aside.into_temp_path()))
}

/// A file in its place, and what was there.
struct Placed {
    path: PathBuf,
    before: Option<TempPath>,
}

impl Placed {
    /// Puts back what was there. What cannot be put back stays beside, under its other name.
    fn take_back(self) {
        match self.before {
            Some(before) => {
                if let Err(fault) = before.persist(&self.path) {
                    let _ = fault.path.keep();
                }
            }
            None => {
                let _ = fs::remove_file(&self.path);
            }
        }
    }
}

impl Drop for OutputFiles {
    fn drop(&mut self) {
        let mut temporary = temporary();
        for (_, file) in self.pending.drain(..) {
            temporary.remove(file.path());
        }
    }
}

impl OutputFiles {
    /// Removes the temporary files of all runs and lets nobody write any more: for a program that is
    /// about to end before its runs do. Waits until files that are being put in their places are there.
    pub fn stop_all() -> Stopped {
        let held = temporary();
        for path in &*held {
            let _ = fs::remove_file(path);
        }
        Stopped { _held: held }
    }

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
        let file = {
            let mut temporary = temporary();
            let file = under_new_name(folder_of(&target), ".part", |name| {
                File::options().write(true).create_new(true).open(name)
            })
            .map_err(failed)?;
            temporary.insert(file.path().to_owned());
            file
        };
        self.pending.push((target, file));
        let written = self.pending.last().map_or(Ok(()), |(_, file)| write_to(file, write));
        written.map_err(|fault| {
            self.drop_last();
            failed(fault)
        })
    }

    /// Takes back what could not be written.
    fn drop_last(&mut self) {
        let mut temporary = temporary();
        if let Some((_, file)) = self.pending.pop() {
            temporary.remove(file.path());
        }
    }

    /// Where the files will be.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.pending.iter().map(|(path, _)| path.as_path())
    }

    /// Puts all files in their places.
    ///
    /// # Errors
    /// The first file that cannot be put there; then all is as it was before.
    pub fn commit(mut self) -> Result<(), WriteError> {
        let mut temporary = temporary();
        let pending = std::mem::take(&mut self.pending);
        for (_, file) in &pending {
            temporary.remove(file.path());
        }
        let mut placed: Vec<Placed> = Vec::new();
        for (path, file) in pending {
            if let Err(source) = put(file, &path, &mut placed) {
                placed.into_iter().rev().for_each(Placed::take_back);
                return Err(WriteError { path, source });
            }
        }
        Ok(())
    }
}

/// Writes all of a temporary file, past its wrapper, whose errors tell its own name.
fn write_to<E: From<io::Error> + ToString>(
    file: &NamedTempFile,
    write: impl FnOnce(&mut dyn Write) -> Result<(), E>,
) -> io::Result<()> {
    let mut buffered = BufWriter::with_capacity(1 << 16, file.as_file());
    write(&mut buffered).map_err(|e| io::Error::other(e.to_string()))?;
    buffered.flush()
}

/// Puts a file in its place and notes what was there.
fn put(file: NamedTempFile, path: &Path, placed: &mut Vec<Placed>) -> io::Result<()> {
    let before = set_aside(path)?;
    let put = file.persist(path).map_err(|fault| fault.error);
    let done = Placed { path: path.to_owned(), before };
    match put {
        Ok(_) => placed.push(done),
        // Where it was set aside by renaming.
        Err(_) if done.before.is_some() => done.take_back(),
        Err(_) => {}
    }
    put.map(|_| ())
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

    #[test]
    fn a_file_that_cannot_be_put_in_its_place_takes_the_others_back() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        let [new, old, last] = ["new.txt", "old.txt", "last.txt"].map(|n| folder.path().join(n));
        fs::write(&old, "old")?;
        let mut files = OutputFiles::default();
        for path in [&new, &old, &last] {
            files.add(path, |out| out.write_all(b"new")).map_err(io::Error::other)?;
        }
        // A folder has come to be where the last is to go.
        fs::create_dir(&last)?;
        let failed = files.commit().expect_err("no file replaces a folder");
        assert!(failed.to_string().contains("last.txt: "), "{failed}");
        assert_eq!(fs::read_to_string(&old)?, "old");
        let mut names: Vec<_> = fs::read_dir(folder.path())?
            .map(|e| e.map(|e| e.file_name()))
            .collect::<Result<_, _>>()?;
        names.sort();
        assert_eq!(names, ["last.txt", "old.txt"]);
        Ok(())
    }

    #[test]
    fn a_file_that_cannot_be_made_is_told_by_its_own_name() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("none").join("a.txt");
        let failed = OutputFiles::default().add(&path, |out| out.write_all(b"new"));
        let message = failed.expect_err("there is no folder").to_string();
        assert!(!message.contains(".beamwright-"), "{message}");
        Ok(())
    }

    #[test]
    fn a_name_that_is_too_long_is_told_before_anything_is_written() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        assert!(check_target(&folder.path().join("a".repeat(200))).is_ok());
        assert!(check_target(&folder.path().join("a".repeat(300))).is_err());
        Ok(())
    }
}
