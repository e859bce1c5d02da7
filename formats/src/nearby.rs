//! Files named by another file: found only inside that file's own folder.
//!
//! A mesh from somewhere else must not make the program open `/etc/passwd` or wait for a pipe, so
//! a name is first judged as text, and then again after all links in it have been followed.

use std::io;
use std::path::{Component, Path, PathBuf};

/// Why a named file cannot be used.
#[derive(Debug)]
pub(crate) enum NotNearby {
    /// The name leads out of the folder.
    Outside,
    /// There is no such file, or it is not allowed to be read.
    Io(io::Error),
}

/// The path of the file that `name` means in `folder`.
///
/// Both kinds of slashes part folders, as names are often written on another system.
pub(crate) fn find(folder: &Path, name: &str) -> Result<PathBuf, NotNearby> {
    let name = name.replace('\\', "/");
    if leads_out(&name) {
        return Err(NotNearby::Outside);
    }
    let folder = folder.canonicalize().map_err(NotNearby::Io)?;
    let path = folder.join(name).canonicalize().map_err(NotNearby::Io)?;
    if !path.starts_with(&folder) {
        return Err(NotNearby::Outside);
    }
    if !path.metadata().map_err(NotNearby::Io)?.is_file() {
        return Err(NotNearby::Io(io::Error::other("not a file")));
    }
    Ok(path)
}

/// Whether a name, taken as text, leaves the folder it starts from.
fn leads_out(name: &str) -> bool {
    let has_drive = name.as_bytes().get(1) == Some(&b':');
    let mut depth = 0;
    has_drive
        || Path::new(name).components().any(|component| {
            match component {
                Component::Normal(_) => depth += 1,
                Component::ParentDir => depth -= 1,
                Component::CurDir => {}
                Component::RootDir | Component::Prefix(_) => return true,
            }
            depth < 0
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_leave_the_folder_are_outside() {
        for name in ["/etc/passwd", "../a", "a/../../b", "C:\\a", "\\\\host\\a", "..\\a", "./../a"]
        {
            let result = find(Path::new("."), name);
            assert!(matches!(result, Err(NotNearby::Outside)), "{name}: {result:?}");
        }
    }

    #[test]
    fn names_inside_the_folder_are_found() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("sub")).unwrap();
        std::fs::write(folder.path().join("sub/a b.bin"), "x").unwrap();
        for name in ["sub/a b.bin", "sub\\a b.bin", "./sub/../sub/a b.bin"] {
            assert!(find(folder.path(), name).is_ok(), "{name}");
        }
        assert!(matches!(find(folder.path(), "sub"), Err(NotNearby::Io(_))));
        assert!(matches!(find(folder.path(), "none"), Err(NotNearby::Io(_))));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_out_of_the_folder_is_outside() {
        let folder = tempfile::tempdir().unwrap();
        std::os::unix::fs::symlink("/etc", folder.path().join("link")).unwrap();
        let result = find(folder.path(), "link/passwd");
        assert!(matches!(result, Err(NotNearby::Outside)), "{result:?}");
    }
}
