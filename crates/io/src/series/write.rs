//! Appending frames so that the public file is whole at every moment.

use super::plan::{Planner, Step};
use super::read::SeriesReader;
use super::{Frame, FrameData, layout};
use crate::hdf5::{self, Write};
use crate::{IoError, atomic};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes a time series of particles to one VTKHDF file.
///
/// An HDF5 file is readable only once it is closed, and a process killed while it appends can spoil what
/// was good. So two copies take turns: a frame is appended to the hidden one, which is closed, forced to
/// disk and renamed over the public one; the former public file becomes the hidden one and is one frame
/// behind. The public name therefore always leads to a complete file with all frames appended so far,
/// whenever the process dies, and a frame costs the same whether it is the first or the thousandth. The
/// price is the disk space of the second copy until the writer is dropped. Measurements and the
/// alternatives are in `docs/decisions/0002-series-on-disk.md`.
///
/// A program that reads the public file while the run goes on sees the frames up to its opening. If it
/// still holds the file when its turn comes, the writer makes a fresh copy instead of waiting.
#[derive(Debug)]
pub struct SeriesWriter {
    path: PathBuf,
    pub(super) planner: Planner,
    /// The hidden copy and the one step it lacks; `None` when it must be made from the public file first.
    hidden: Option<(PathBuf, Step)>,
    /// Which of the two hidden names is free.
    turn: usize,
    /// The public file exists and is ours.
    public: bool,
}

impl SeriesWriter {
    /// Starts a new series. The file appears with the first frame; one of the same name is then replaced.
    pub fn create(path: impl Into<PathBuf>) -> Self {
        let path = path.into();
        let writer = Self { path, planner: Planner::default(), hidden: None, turn: 0, public: false };
        writer.tidy();
        writer
    }

    /// Goes on with a series: frames later than `time` \[s\] are dropped, those up to it stay. A missing file
    /// makes a new series.
    ///
    /// The frames kept are copied into a new file that takes the place of the old one at once. A run resumed
    /// from a checkpoint leaves the same file as an unbroken one, byte for byte.
    ///
    /// # Errors
    /// [`IoError::Hdf5`], [`IoError::Kind`] or [`IoError::Damaged`] when the file is not a series of ours.
    pub fn continue_at(path: impl Into<PathBuf>, time: f64) -> Result<Self, IoError> {
        let mut writer = Self::create(path);
        if !writer.path.exists() {
            return Ok(writer);
        }
        let reader = SeriesReader::open(&writer.path)?;
        writer.replay(&reader, time, |planner, frame| planner.plan(&frame.view()))?;
        Ok(writer)
    }

    /// Writes the frames up to `time` \[s\] of the present public file anew and puts them in its place.
    pub(super) fn replay(
        &mut self,
        reader: &SeriesReader,
        time: f64,
        plan: impl Fn(&mut Planner, FrameData) -> Result<Step, String>,
    ) -> Result<(), IoError> {
        let kept = reader.info().times.iter().take_while(|&&t| t <= time).count();
        let draft = atomic::beside(&self.path, "cut");
        for index in 0..kept {
            let added = reader.frame(index).and_then(|frame| {
                let step = plan(&mut self.planner, frame).map_err(|what| self.damaged(what))?;
                self.add(&draft, &step, &self.planner)
            });
            if let Err(error) = added {
                atomic::remove_if_present(&draft);
                return Err(error);
            }
        }
        if kept == 0 {
            atomic::remove_if_present(&self.path);
        } else {
            atomic::publish(&draft, &self.path)?;
            self.public = true;
        }
        Ok(())
    }

    /// The public file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of frames in the public file.
    pub fn len(&self) -> usize {
        self.planner.steps as usize
    }

    /// True before the first frame.
    pub fn is_empty(&self) -> bool {
        self.planner.steps == 0
    }

    /// Time of the last frame \[s\].
    pub fn last_time(&self) -> Option<f64> {
        self.planner.last_time
    }

    /// Adds a frame; when this returns, the public file holds it.
    ///
    /// # Errors
    /// [`IoError::Mismatch`] when lengths, fields or time do not fit the frames before (nothing is written
    /// then), [`IoError::System`] or [`IoError::Hdf5`] when the disk refuses; the public file stays as it was.
    pub fn append(&mut self, frame: &Frame<'_>) -> Result<(), IoError> {
        self.commit(|planner| planner.plan(frame))
    }

    /// Adds the step that `plan` makes.
    pub(super) fn commit(
        &mut self,
        plan: impl FnOnce(&mut Planner) -> Result<Step, String>,
    ) -> Result<(), IoError> {
        // Planned on a copy (the arrays in it are shared): after a failure the writer stands where it stood.
        let mut planner = self.planner.clone();
        let step = plan(&mut planner).map_err(|what| IoError::Mismatch { path: self.path.clone(), what })?;
        let draft = self.catch_up(&planner)?;
        if let Err(error) = self.add(&draft, &step, &planner) {
            atomic::remove_if_present(&draft);
            return Err(error);
        }
        self.swap(draft, step)?;
        self.planner = planner;
        Ok(())
    }

    /// Brings the hidden copy to the state of the public file, making it anew where that cannot be done.
    fn catch_up(&mut self, planner: &Planner) -> Result<PathBuf, IoError> {
        if let Some((path, missing)) = self.hidden.take() {
            // Fails when a reader holds this file from the time it was public: it must not change under it.
            if self.add(&path, &missing, planner).is_ok() {
                return Ok(path);
            }
        }
        let draft = self.hidden_name(self.turn);
        atomic::remove_if_present(&draft);
        if self.public {
            fs::copy(&self.path, &draft).map_err(|source| IoError::system(&self.path, "copy", source))?;
        }
        Ok(draft)
    }

    /// Adds one step to a file that is not public. Every step gets an opening and closing of its own, so that
    /// the bytes of a file follow from its steps and not from what happened between them.
    fn add(&self, path: &Path, step: &Step, planner: &Planner) -> Result<(), IoError> {
        let skeleton =
            |file: &hdf5::Writer| layout::skeleton(file, &planner.fields, planner.triangles.is_some());
        let file = if path.exists() {
            hdf5::Writer::append(path)
        } else {
            hdf5::Writer::create(path).and_then(|file| skeleton(&file).map(|()| file))
        };
        file.and_then(|file| step.apply(&file).and_then(|()| file.close()))
            .map_err(|text| IoError::hdf5(&self.path, "append to", text))
    }

    /// Gives the draft the public name and keeps the former public file as the next draft.
    fn swap(&mut self, draft: PathBuf, step: Step) -> Result<(), IoError> {
        let other = if draft == self.hidden_name(0) { 1 } else { 0 };
        let spare = self.hidden_name(other);
        // Without hard links (some network and removable disks) the next frame copies the file instead.
        atomic::remove_if_present(&spare);
        let kept = self.public && fs::hard_link(&self.path, &spare).is_ok();
        atomic::publish(&draft, &self.path)?;
        self.turn = other;
        self.hidden = kept.then_some((spare, step));
        self.public = true;
        Ok(())
    }

    fn hidden_name(&self, turn: usize) -> PathBuf {
        atomic::beside(&self.path, ["a", "b"][turn])
    }

    fn damaged(&self, what: String) -> IoError {
        IoError::Damaged { path: self.path.clone(), what }
    }

    /// Removes hidden copies, of this run or of one that was killed.
    fn tidy(&self) {
        for draft in [self.hidden_name(0), self.hidden_name(1), atomic::beside(&self.path, "cut")] {
            atomic::remove_if_present(&draft);
        }
    }
}

impl Drop for SeriesWriter {
    fn drop(&mut self) {
        self.tidy();
    }
}
