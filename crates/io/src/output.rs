//! The output folder: what may be written over, and what is left alone.

use crate::{IoError, Status, Summary};
use std::path::{Path, PathBuf};

/// Names a run may leave in its folder. Nothing else is ever removed.
const OUTPUTS: &[&str] = &[
    "fluid.vtkhdf",
    "wall.vtkhdf",
    "lumen.vtkhdf",
    "openings.csv",
    "probes.csv",
    "report.html",
    "checkpoint.h5",
    "failure.vtkhdf",
    "failure.json",
    "summary.json",
];

/// The series in the folder `out` that tells of the wall as a surface: where `wall.vtkhdf` has the particles of a solid, that is a file of its
/// own. Nothing where the run has written neither.
pub fn wall_surface(out: &Path) -> Option<PathBuf> {
    ["lumen.vtkhdf", "wall.vtkhdf"].map(|name| out.join(name)).into_iter().find(|path| path.exists())
}

/// An output folder (`OUT`).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputDir {
    path: PathBuf,
}

impl OutputDir {
    /// Makes the folder ready for a new run: creates it if need be, removes what an earlier run of ours left
    /// so that two runs do not mix, and writes a `summary.json` with the status `running`.
    ///
    /// A folder with a finished run, or one that can be resumed, is refused unless `force` is given; so is one with files of our names
    /// but no summary, as they may be somebody's own. Files of other names stay, always.
    ///
    /// # Errors
    /// [`IoError::Finished`], [`IoError::Resumable`], [`IoError::Foreign`], or [`IoError::System`] when the folder cannot be made or
    /// written. Nothing has been written or removed then.
    pub fn prepare(path: impl Into<PathBuf>, force: bool) -> Result<Self, IoError> {
        let output = Self::open(path)?;
        Self::keep_run(&output.path, force)?;
        match Summary::read(&output.file("summary.json")) {
            Ok(_) => {}
            Err(_) if force => {}
            Err(_) => {
                if let Some(file) = OUTPUTS.iter().find(|name| output.file(name).exists()) {
                    return Err(IoError::Foreign { path: output.path.clone(), file: (*file).to_owned() });
                }
            }
        }
        // The summary goes last and is replaced, not removed: a kill in between leaves a folder known as ours.
        for name in OUTPUTS.iter().filter(|name| **name != "summary.json") {
            let file = output.file(name);
            if std::fs::symlink_metadata(&file).is_ok_and(|found| found.is_file()) {
                std::fs::remove_file(&file).map_err(|source| IoError::system(&file, "remove", source))?;
            }
        }
        output.claim()?;
        Ok(output)
    }

    /// Refuses a folder whose run is finished or can be resumed, unless `force` is given.
    ///
    /// # Errors
    /// [`IoError::Finished`] or [`IoError::Resumable`].
    pub fn keep_run(path: &Path, force: bool) -> Result<(), IoError> {
        let Ok(found) = Summary::read(&path.join("summary.json")) else { return Ok(()) };
        let is_there = |name: &str| path.join(name).exists();
        // What diverged is run again after a change of the case; what a full disk ended is not.
        let has_diverged = found.status == Status::Failed && is_there("failure.vtkhdf");
        if force {
            Ok(())
        } else if found.status == Status::Completed {
            Err(IoError::Finished { path: path.to_owned() })
        } else if is_there("checkpoint.h5") && !has_diverged {
            Err(IoError::Resumable { path: path.to_owned() })
        } else {
            Ok(())
        }
    }

    /// Refuses files that are in the way of results, before any work is done for them.
    ///
    /// # Errors
    /// [`IoError::Exists`] for the first of `files` that is there, unless `force` is given; a folder of that name is in
    /// the way in any case.
    pub fn keep_clear(files: impl IntoIterator<Item = PathBuf>, force: bool) -> Result<(), IoError> {
        let in_the_way = |file: &PathBuf| match std::fs::symlink_metadata(file) {
            Ok(found) => !force || found.is_dir(),
            Err(_) => false,
        };
        match files.into_iter().find(in_the_way) {
            Some(path) => Err(IoError::Exists { path }),
            None => Ok(()),
        }
    }

    /// Takes the folder of a run that goes on, as it is: writes a `summary.json` with the status `running`.
    ///
    /// # Errors
    /// [`IoError::System`] when the folder cannot be written; nothing has been changed then.
    pub fn go_on(path: impl Into<PathBuf>) -> Result<Self, IoError> {
        let output = Self::open(path)?;
        output.claim()?;
        Ok(output)
    }

    /// Says that a run is going on here.
    fn claim(&self) -> Result<(), IoError> {
        let version = env!("CARGO_PKG_VERSION").to_owned();
        Summary { vaso_version: version, status: Status::Running, ..Summary::default() }
            .write(&self.file("summary.json"))
    }

    /// Takes the folder as it is, to add to it (`vaso particles`, `report`); creates it if need be.
    ///
    /// # Errors
    /// [`IoError::System`] when it cannot be made or is not a folder.
    pub fn open(path: impl Into<PathBuf>) -> Result<Self, IoError> {
        let path = path.into();
        std::fs::create_dir_all(&path).map_err(|source| IoError::system(&path, "make the folder", source))?;
        Ok(Self { path })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Path of a file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_finished_run_is_kept_unless_forced() {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputDir::prepare(folder.path().join("case/out"), false).unwrap();
        assert_eq!(Summary::read(&out.file("summary.json")).unwrap().status, Status::Running);
        Summary { status: Status::Completed, ..Summary::default() }.write(&out.file("summary.json")).unwrap();
        fs::write(out.file("fluid.vtkhdf"), "frames").unwrap();

        let error = OutputDir::prepare(out.path(), false).unwrap_err();
        assert!(matches!(error, IoError::Finished { .. }));
        assert!(error.to_string().contains("--force"), "{error}");
        assert_eq!(fs::read(out.file("fluid.vtkhdf")).unwrap(), b"frames");

        OutputDir::prepare(out.path(), true).unwrap();
        assert_eq!(names(out.path()), ["summary.json"]);
        assert_eq!(Summary::read(&out.file("summary.json")).unwrap().status, Status::Running);
    }

    #[test]
    fn a_broken_off_run_gives_way_and_other_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputDir::prepare(folder.path(), false).unwrap();
        for name in ["openings.csv", "notes.txt", "particles.json", "old fluid.vtkhdf"] {
            fs::write(out.file(name), "x").unwrap();
        }
        fs::create_dir(out.file("report.html")).unwrap();
        fs::write(out.file("checkpoint.h5"), "x").unwrap();
        let error = OutputDir::prepare(folder.path(), false).unwrap_err();
        assert!(
            matches!(error, IoError::Resumable { .. }) && error.to_string().contains("vaso resume"),
            "{error}"
        );
        // A full disk leaves a run that can go on, a flow that diverged does not.
        Summary { status: Status::Failed, ..Summary::default() }.write(&out.file("summary.json")).unwrap();
        assert!(matches!(OutputDir::prepare(folder.path(), false), Err(IoError::Resumable { .. })));
        fs::write(out.file("failure.vtkhdf"), "x").unwrap();
        OutputDir::prepare(folder.path(), false).unwrap();
        assert_eq!(
            names(folder.path()),
            ["notes.txt", "old fluid.vtkhdf", "particles.json", "report.html", "summary.json"]
        );
    }

    #[test]
    fn files_in_the_way_stay_unless_forced() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        OutputDir::keep_clear([path("a"), path("no/such/b")], false).unwrap();
        fs::write(path("b"), "mine").unwrap();
        let error = OutputDir::keep_clear([path("a"), path("b")], false).unwrap_err();
        assert!(matches!(&error, IoError::Exists { path } if path.ends_with("b")), "{error}");
        OutputDir::keep_clear([path("a"), path("b")], true).unwrap();
        fs::create_dir(path("c")).unwrap();
        assert!(OutputDir::keep_clear([path("c")], true).is_err());
    }

    #[test]
    fn files_of_unknown_origin_are_not_touched() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("report.html"), "my own page").unwrap();
        let error = OutputDir::prepare(folder.path(), false).unwrap_err();
        assert!(matches!(&error, IoError::Foreign { file, .. } if file == "report.html"), "{error}");
        fs::write(folder.path().join("summary.json"), "{\"mine\": 1}").unwrap();
        assert!(matches!(OutputDir::prepare(folder.path(), false), Err(IoError::Foreign { .. })));
        assert_eq!(names(folder.path()), ["report.html", "summary.json"]);

        let file = folder.path().join("report.html");
        assert!(matches!(OutputDir::prepare(&file, true), Err(IoError::System { .. })));
    }
}
