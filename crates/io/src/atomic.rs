//! Files that appear whole or not at all.

use crate::IoError;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

/// `name.ext` becomes `name.ext.<suffix>.tmp` in the same folder, so that a rename stays on one file system.
pub(crate) fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{suffix}.tmp"));
    path.with_file_name(name)
}

/// Writes `bytes` to a neighbouring file, forces them to disk and renames it to `path`.
///
/// Whatever happens, a reader finds the old content or the new one, never a part.
///
/// # Errors
/// [`IoError::System`] when the disk or the folder refuses.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), IoError> {
    let draft = beside(path, "new");
    let written = File::create(&draft)
        .and_then(|mut file| file.write_all(bytes))
        .map_err(|source| IoError::system(path, "write", source));
    if let Err(error) = written {
        remove_if_present(&draft);
        return Err(error);
    }
    publish(&draft, path)
}

/// Forces a finished file to disk, moves it to its public name and asks the folder to remember it.
pub(crate) fn publish(draft: &Path, path: &Path) -> Result<(), IoError> {
    // Opened for writing, as one system (Windows) flushes no other handle.
    let moved = File::options()
        .write(true)
        .open(draft)
        .and_then(|file| file.sync_all())
        .and_then(|()| fs::rename(draft, path));
    if let Err(source) = moved {
        remove_if_present(draft);
        return Err(IoError::system(path, "replace", source));
    }
    sync_folder(path);
    Ok(())
}

/// Makes a rename survive a power cut where the system can do that.
///
/// Its failure loses nothing that was promised before (the old name is still whole), so it is not an error.
fn sync_folder(path: &Path) {
    if let Some(folder) = path.parent() {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let _ = File::open(folder).and_then(|handle| handle.sync_all());
    }
}

/// Removes a file of ours that may not be there; a leftover is only untidy, so a failure is not an error.
pub(crate) fn remove_if_present(path: &Path) {
    let _ = fs::remove_file(path);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_is_replaced_and_no_draft_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        write(&path, b"one").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let error = write(&folder.path().join("no/such/a.json"), b"x").unwrap_err();
        assert!(error.to_string().contains("check the path"), "{error}");
    }
}
