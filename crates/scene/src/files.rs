//! The files a case names: those on disk, or those that were handed over.

use std::collections::BTreeMap;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// Where the files a case names are looked up.
#[derive(Debug)]
pub(crate) enum Files {
    /// On disk.
    Disk,
    /// Among these, by their path from the folder of the case.
    Given(BTreeMap<PathBuf, String>),
}

impl Files {
    /// Whether there is such a file.
    pub(crate) fn has(&self, path: &Path) -> bool {
        match self {
            Self::Disk => path.is_file(),
            Self::Given(files) => files.contains_key(from_case(path)),
        }
    }

    /// The text of a file.
    pub(crate) fn read(&self, path: &Path) -> std::io::Result<String> {
        match self {
            Self::Disk => std::fs::read_to_string(path),
            Self::Given(files) => {
                files.get(from_case(path)).cloned().ok_or_else(|| Error::from(ErrorKind::NotFound))
            }
        }
    }

    /// The name of a folder, which only folders on disk have.
    pub(crate) fn folder_name(&self, folder: &Path) -> Option<String> {
        match self {
            Self::Disk => Some(folder.canonicalize().ok()?.file_name()?.to_string_lossy().into_owned()),
            Self::Given(_) => None,
        }
    }
}

fn from_case(path: &Path) -> &Path {
    path.strip_prefix(".").unwrap_or(path)
}
