//! What can go wrong between memory and disk.

use std::path::{Path, PathBuf};

/// A failure to write or read one of the project's files.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IoError {
    /// The operating system refused.
    #[error("cannot {doing} {path:?}: {source}; {}", advice(source))]
    System {
        /// File or folder concerned.
        path: PathBuf,
        /// What was being done, as an infinitive.
        doing: &'static str,
        /// The system's answer.
        source: std::io::Error,
    },
    /// The HDF5 layer refused for a reason that is not the operating system's.
    #[error(
        "cannot {doing} {path:?}: {message}; the file may be damaged or open in another program: \
         close that program, or remove the file and repeat the run"
    )]
    Hdf5 {
        /// File concerned.
        path: PathBuf,
        /// What was being done, as an infinitive.
        doing: &'static str,
        /// The library's words.
        message: String,
    },
    /// A JSON file does not hold what its name promises.
    #[error(
        "cannot read {path:?}: {source}; the file is written by the program: restore it or repeat the run"
    )]
    Json {
        /// File concerned.
        path: PathBuf,
        /// Line, column and cause.
        source: serde_json::Error,
    },
    /// A file is of another kind than the one asked for.
    #[error("{path:?} holds {found}, expected {expected}; check the path")]
    Kind {
        /// File concerned.
        path: PathBuf,
        /// What is in it.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// The content does not match its own checksum or its own counts.
    #[error("{path:?} is damaged: {what}; remove it and repeat the step that wrote it")]
    Damaged {
        /// File concerned.
        path: PathBuf,
        /// The contradiction found.
        what: String,
    },
    /// A frame, row or array does not fit the file it is meant for.
    #[error("cannot add to {path:?}: {what}")]
    Mismatch {
        /// File concerned.
        path: PathBuf,
        /// What does not fit, with the value seen and the one expected.
        what: String,
    },
    /// A table line cannot be read.
    #[error(
        "{path:?} line {line}: {what}; columns are numbers separated by commas, the first line names them"
    )]
    Table {
        /// File concerned.
        path: PathBuf,
        /// Line number, the header being 1.
        line: u64,
        /// What is wrong with it.
        what: String,
    },
    /// The output folder holds a finished run.
    #[error(
        "{path:?} holds a finished run; pass `--force` to write over it or choose another folder with `--out`"
    )]
    Finished {
        /// Output folder.
        path: PathBuf,
    },
    /// The output folder holds a run that can go on.
    #[error(
        "{path:?} holds a run that is not finished; `vaso resume` goes on with it, `--force` writes over it, `--out` takes another \
         folder"
    )]
    Resumable {
        /// Output folder.
        path: PathBuf,
    },
    /// A file is in the way of a result.
    #[error("{path:?} exists; pass `--force` to write over it or choose another name or folder")]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The output folder holds a file of an output's name that no run of ours is known to have written.
    #[error(
        "{path:?} holds {file:?} but no `summary.json` of a run, so it may be somebody's own; \
         pass `--force` to replace it or choose another folder with `--out`"
    )]
    Foreign {
        /// Output folder.
        path: PathBuf,
        /// Name of the file in the way.
        file: String,
    },
}

impl IoError {
    /// Wraps an error of the operating system.
    pub(crate) fn system(path: &Path, doing: &'static str, source: std::io::Error) -> Self {
        Self::System { path: path.to_owned(), doing, source }
    }

    /// Wraps an error of the HDF5 layer, giving system errors back their code where the text carries one.
    pub(crate) fn hdf5(path: &Path, doing: &'static str, message: String) -> Self {
        // The pure-Rust library hides the system error inside private types; its text ends in "(os error N)".
        let code = message
            .rsplit_once("(os error ")
            .and_then(|(_, tail)| tail.split_once(')'))
            .and_then(|(code, _)| code.parse().ok());
        match code {
            Some(code) => Self::system(path, doing, std::io::Error::from_raw_os_error(code)),
            None => Self::Hdf5 { path: path.to_owned(), doing, message },
        }
    }

    /// True when the disk or the quota is full: the caller may end the run in order instead of breaking off.
    pub fn is_disk_full(&self) -> bool {
        use std::io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull};
        matches!(self, Self::System { source, .. }
            if matches!(source.kind(), StorageFull | QuotaExceeded | FileTooLarge))
    }
}

fn advice(source: &std::io::Error) -> &'static str {
    use std::io::ErrorKind as Kind;
    match source.kind() {
        Kind::StorageFull | Kind::QuotaExceeded => {
            "free some space or choose another disk with `--out`, then go on with `vaso resume`"
        }
        Kind::FileTooLarge => "the file system limits the file size: choose another disk with `--out`",
        Kind::PermissionDenied | Kind::ReadOnlyFilesystem => {
            "check who owns the folder or choose another one with `--out`"
        }
        Kind::NotFound => "check the path",
        Kind::IsADirectory | Kind::NotADirectory => "a file and a folder are mixed up: check the path",
        Kind::AlreadyExists => "move it away or choose another folder with `--out`",
        _ => "check the disk and the path",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn system_codes_are_found_inside_library_messages() {
        let error = IoError::hdf5(
            Path::new("out/fluid.vtkhdf"),
            "append to",
            "hdf5-io error: I/O error: No space left on device (os error 28)".to_owned(),
        );
        assert!(error.is_disk_full());
        let text = error.to_string();
        assert!(text.contains("fluid.vtkhdf") && text.contains("vaso resume"), "{text}");
    }

    #[test]
    fn other_library_messages_stay_as_they_are() {
        let error = IoError::hdf5(Path::new("a.h5"), "open", "format error: bad signature".to_owned());
        assert!(!error.is_disk_full());
        assert!(error.to_string().contains("bad signature"));
    }
}
