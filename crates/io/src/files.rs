//! Whole files in, whole files out. Reading takes regular files of bounded size only; writing goes through a temporary
//! file beside the target that replaces it in one step, so that no reader ever sees half a file.

use crate::IoError;
use crate::limits::Room;
use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// Reads a regular file of at most so many bytes. Pipes and devices are refused: opening one may block for ever.
pub(crate) fn read_file(path: &Path, limit: impl Into<Room>) -> Result<Vec<u8>, IoError> {
    let limit = limit.into();
    let open = |e: io::Error| IoError::open(path, &e);
    let refuse = |reason: &str| IoError::Open {
        path: path.into(),
        place: String::new(),
        reason: format!("cannot open: {reason}"),
    };
    let kind = fs::metadata(path).map_err(open)?;
    if kind.is_dir() {
        return Err(refuse("it is a folder"));
    }
    if !kind.is_file() {
        return Err(refuse("it is not a regular file"));
    }
    let file = File::open(path).map_err(open)?;
    let size = file.metadata().map_err(open)?.len();
    limit.check(path, "", size)?;
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or(0));
    // The file may grow while it is read: the limit holds all the same.
    file.take(limit.left().saturating_add(1)).read_to_end(&mut bytes).map_err(open)?;
    limit.check(path, "", bytes.len() as u64)?;
    Ok(bytes)
}

/// Reads a text of at most so many bytes.
///
/// # Errors
/// `CannotOpen`; `BadData` if it is longer, or no UTF-8.
pub fn read_text(path: impl AsRef<Path>, most: u64) -> Result<String, IoError> {
    let path = path.as_ref();
    let bytes = read_file(path, most)?;
    String::from_utf8(bytes).map_err(|e| IoError::data(path, "", format!("no text: {}", e.utf8_error())))
}

/// Writes a text in one step: no reader sees half of it, and if it fails, an older file is as it was.
///
/// # Errors
/// `CannotWrite`.
pub fn write_text(path: impl AsRef<Path>, text: &str) -> Result<(), IoError> {
    write_atomic(path.as_ref(), |file| file.write_all(text.as_bytes()).map_err(|e| e.to_string()))
}

/// Writes a file through `fill` in one step: temporary file in the same folder, flush to disk, rename. When anything
/// fails, `path` is as it was and the temporary file is gone. One that is left by a process that was killed is removed the
/// next time the same target is written.
pub(crate) fn write_atomic(
    path: &Path,
    fill: impl FnOnce(&mut File) -> Result<(), String>,
) -> Result<(), IoError> {
    let fail = |e: io::Error| IoError::write(path, e);
    let target = write_target(path)?;
    let folder = folder_of(&target);
    remove_leftovers(folder, &target);
    let mut temporary = temporary_beside(folder, &target).map_err(|reason| IoError::write(path, reason))?;
    fill(temporary.as_file_mut()).map_err(|reason| IoError::write(path, reason))?;
    temporary.as_file().sync_all().map_err(fail)?;
    temporary.persist(&target).map_err(|e| fail(e.error))?;
    sync_folder(folder);
    Ok(())
}

/// Whether a file could be written there now: the target is a regular file or nothing yet, and its folder takes new files.
/// Leaves nothing behind. What is asked before hours of work may of course have changed after them.
///
/// # Errors
/// `CannotWrite`, as the write itself would fail.
pub fn check_writable(path: impl AsRef<Path>) -> Result<(), IoError> {
    let path = path.as_ref();
    let target = write_target(path)?;
    temporary_beside(folder_of(&target), &target).map_err(|reason| IoError::write(path, reason))?;
    Ok(())
}

fn folder_of(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The file that is really meant: links are followed, so that the link stays and what it points to is replaced.
fn write_target(path: &Path) -> Result<PathBuf, IoError> {
    if path.file_name().is_none() {
        return Err(IoError::write(path, "the path has no file name"));
    }
    let Ok(kind) = fs::metadata(path) else { return Ok(path.into()) };
    if kind.is_dir() {
        return Err(IoError::write(path, "it is a folder"));
    }
    if !kind.is_file() {
        return Err(IoError::write(path, "it is not a regular file"));
    }
    fs::canonicalize(path).map_err(|e| IoError::write(path, e))
}

/// What the names of temporary files for a target begin and end with; six letters or digits stand between.
fn temporary_name(target: &Path) -> (OsString, &'static str) {
    let mut prefix = OsString::from(".");
    prefix.push(target.file_name().unwrap_or_default());
    prefix.push(".");
    (prefix, ".tmp")
}

/// Removes temporary files for this target that no process writes any more: those that are not locked. What cannot be
/// removed stays.
fn remove_leftovers(folder: &Path, target: &Path) {
    let (prefix, suffix) = temporary_name(target);
    let (prefix, suffix) = (prefix.as_encoded_bytes(), suffix.as_bytes());
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let middle = name.as_encoded_bytes().strip_prefix(prefix).and_then(|n| n.strip_suffix(suffix));
        let ours = middle.is_some_and(|m| m.len() == 6 && m.iter().all(u8::is_ascii_alphanumeric));
        let regular = entry.file_type().is_ok_and(|t| t.is_file());
        if !(ours && regular) {
            continue;
        }
        // Not to be waited for: where a file cannot be opened, or locks are not known, it stays.
        if let Ok(file) = File::options().write(true).open(entry.path())
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// A new file, locked as long as it is open, so that nobody takes it for a leftover. The reason of a failure names the
/// folder: nobody knows the temporary file.
fn temporary_beside(folder: &Path, target: &Path) -> Result<tempfile::NamedTempFile, String> {
    let (prefix, suffix) = temporary_name(target);
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(suffix);
    #[cfg(unix)]
    {
        // As an ordinary new file: read and write for all, less the umask. (The default is private to the user.)
        use std::os::unix::fs::PermissionsExt;
        let mode = fs::metadata(target).map_or(0o666, |m| m.permissions().mode() & 0o777);
        builder.permissions(fs::Permissions::from_mode(mode));
    }
    let failed = |e: io::Error| match fs::metadata(folder) {
        Err(why) if why.kind() == io::ErrorKind::NotFound => {
            format!("there is no folder {}", folder.display())
        }
        Ok(kind) if !kind.is_dir() => format!("{} is no folder", folder.display()),
        _ => format!("the folder {} takes no new file: {}", folder.display(), e.kind()),
    };
    loop {
        let temporary = builder.tempfile_in(folder).map_err(failed)?;
        // Another process may have removed it between its birth and the lock: then it is not there any more. Where there
        // are no locks nobody removes anything.
        let locked = temporary.as_file().try_lock();
        let taken = matches!(locked, Err(TryLockError::WouldBlock)) || !temporary.path().exists();
        if !taken {
            return Ok(temporary);
        }
    }
}

/// Makes the rename last through a power cut, where folders can be synchronised; elsewhere the file is whole anyway.
fn sync_folder(folder: &Path) {
    if let Ok(handle) = File::open(folder) {
        let _ = handle.sync_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(dir: &Path) -> Vec<String> {
        let mut v: Vec<_> =
            fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        v.sort();
        v
    }

    #[test]
    fn a_failed_write_keeps_the_old_file_and_leaves_nothing() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("out.png");
        fs::write(&path, "old").unwrap();
        let e = write_atomic(&path, |f| {
            f.write_all(b"half").unwrap();
            Err("disk on fire".into())
        })
        .unwrap_err();
        assert_eq!(e.to_string(), format!("{}: cannot write: disk on fire", path.display()));
        assert_eq!(e.kind(), crate::ErrorKind::CannotWrite);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(dir.path()), ["out.png"]);
        write_atomic(&path, |f| f.write_all(b"new").map_err(|e| e.to_string())).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(dir.path()), ["out.png"]);
    }

    #[test]
    fn leftovers_of_the_killed_go_and_those_of_the_living_stay() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("out.png");
        let others =
            [".out.png.abc12.tmp", ".out.png.abc-23.tmp", ".out.jpg.abc123.tmp", "out.png.abc123.tmp"];
        for name in others.into_iter().chain([".out.png.abc123.tmp", ".out.png.XYZ789.tmp"]) {
            fs::write(dir.path().join(name), "half").unwrap();
        }
        fs::create_dir(dir.path().join(".out.png.folder.tmp")).unwrap();
        let alive = File::open(dir.path().join(".out.png.XYZ789.tmp")).unwrap();
        alive.try_lock().unwrap();
        write_atomic(&path, |f| {
            // While one is being written, the next writer lets it be.
            let before = names(dir.path());
            write_atomic(&path, |_| Ok(())).unwrap();
            assert!(before.iter().all(|n| names(dir.path()).contains(n)), "{before:?}");
            f.write_all(b"new").map_err(|e| e.to_string())
        })
        .unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        let mut want: Vec<&str> = others.to_vec();
        want.extend([".out.png.XYZ789.tmp", ".out.png.folder.tmp", "out.png"]);
        want.sort();
        assert_eq!(names(dir.path()), want);
        drop(alive);
        write_atomic(&path, |_| Ok(())).unwrap();
        assert!(!names(dir.path()).contains(&".out.png.XYZ789.tmp".to_string()));
    }

    #[test]
    fn refuses_targets_that_are_no_files() {
        let dir = tempfile::tempdir().unwrap();
        let ok = |_: &mut File| Ok(());
        assert!(write_atomic(dir.path(), ok).unwrap_err().to_string().ends_with("it is a folder"));
        assert!(check_writable(dir.path()).unwrap_err().to_string().ends_with("it is a folder"));
        let (none, file) = (dir.path().join("none"), dir.path().join("file"));
        let e = check_writable(none.join("a.png")).unwrap_err();
        assert_eq!(e.kind(), crate::ErrorKind::CannotWrite);
        assert!(
            e.to_string().ends_with(&format!("cannot write: there is no folder {}", none.display())),
            "{e}"
        );
        fs::write(&file, "").unwrap();
        let e = check_writable(file.join("a.png")).unwrap_err();
        assert!(e.to_string().ends_with(&format!("cannot write: {} is no folder", file.display())), "{e}");
        fs::remove_file(file).unwrap();
        check_writable(dir.path().join("a.png")).unwrap();
        assert_eq!(names(dir.path()), [""; 0]);
        let e = write_atomic(&dir.path().join("none/out.png"), ok).unwrap_err();
        assert_eq!(e.kind(), crate::ErrorKind::CannotWrite);
        #[cfg(unix)]
        assert!(write_atomic(Path::new("/dev/null"), ok).unwrap_err().to_string().contains("not a regular"));
    }

    #[cfg(unix)]
    #[test]
    fn follows_links_and_keeps_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let dir = tempfile::tempdir().unwrap();
        let real = dir.path().join("real.png");
        fs::write(&real, "old").unwrap();
        fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).unwrap();
        let link = dir.path().join("link.png");
        std::os::unix::fs::symlink(&real, &link).unwrap();
        write_atomic(&link, |f| f.write_all(b"new").map_err(|e| e.to_string())).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&real).unwrap(), b"new");
        assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);
    }

    #[test]
    fn reading_is_bounded_and_takes_files_only() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        fs::write(&path, [0u8; 10]).unwrap();
        assert_eq!(read_file(&path, 10).unwrap().len(), 10);
        assert_eq!(read_file(&path, 9).unwrap_err().kind(), crate::ErrorKind::BadData);
        assert!(read_file(dir.path(), 9).unwrap_err().to_string().ends_with("it is a folder"));
        let e = read_file(&dir.path().join("b"), 9).unwrap_err();
        assert_eq!(e.kind(), crate::ErrorKind::CannotOpen);
        #[cfg(unix)]
        assert!(read_file(Path::new("/dev/zero"), 9).unwrap_err().to_string().contains("regular"));
    }
}
