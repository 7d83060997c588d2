//! Checkpoint of a run: everything its next step depends on, what was summed so far, and where its files stand.

mod due;
mod origin;

pub use due::Due;
pub use origin::Origin;

use crate::deforming::Deforming;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::results::{Results, Standing};
use std::path::{Path, PathBuf};
use vaso_fluid::Real;
use vaso_io::{Archive, EndReason, IoError};
use vaso_particles::Memory;

/// Kind of the archive.
pub const KIND: &str = "checkpoint";
/// Layout version; to be raised whenever a part of a run remembers something else.
pub const VERSION: u32 = 2;
/// Name of the file in the output folder.
pub const FILE: &str = "checkpoint.h5";

/// Why a run may end, once it may, also in words.
pub type Ending = Option<(EndReason, String)>;

/// What a checkpoint keeps beside flow and results.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// Wall time spent so far \[s\].
    pub wall_clock: f64,
    /// Why the run may end, where its last step has been taken before its end time.
    pub ending: Ending,
}

/// Name of [`Surroundings::ending`] in the archive.
const ENDING: &str = "ending";
/// Name of the [`Origin`] in the archive.
const ORIGIN: &str = "origin";
/// Name of [`Surroundings::wall_clock`] in the archive.
const WALL_CLOCK: &str = "wall_clock_s";

/// Writes `checkpoint.h5` beside the results, whole or not at all.
///
/// # Errors
/// When the disk or the folder refuses; an older checkpoint then stays.
pub fn write<R: Real, W: Deforming>(
    origin: &Origin,
    flow: &mut Flow<R, W>,
    results: &mut Results<W::File>,
    surroundings: &Surroundings,
) -> Result<(), IoError> {
    // What lies in the tables has to be there for as long as the checkpoint that counts on it.
    results.sync()?;
    let mut archive = Archive::new(KIND, VERSION);
    archive.remember(|memory| flow.remember(memory));
    archive.remember(|memory| results.standing(flow.time).remember(memory));
    archive.remember(|memory| results.remember(memory));
    archive.put_floats(WALL_CLOCK, &[surroundings.wall_clock]);
    archive.put_bytes(ORIGIN, &json(origin));
    archive.put_bytes(ENDING, &json(&surroundings.ending));
    archive.write(&results.folder().join(FILE))
}

fn json<T: serde::Serialize>(value: &T) -> Vec<u8> {
    serde_json::to_vec(value).expect("plain structs with string keys always serialize")
}

/// A checkpoint that has been read.
pub struct Checkpoint {
    path: PathBuf,
    archive: Archive,
    /// What run it belongs to.
    pub origin: Origin,
    /// Where the files of the run stood.
    pub standing: Standing,
    /// What is kept beside flow and results.
    pub surroundings: Surroundings,
}

impl Checkpoint {
    /// Reads the checkpoint in the output folder `out`.
    ///
    /// # Errors
    /// When there is none, it is damaged, or it is of another version of the program.
    pub fn read(out: &Path) -> Result<Self, DriverError> {
        let path = out.join(FILE);
        if !path.exists() {
            return Err(DriverError::input(format!(
                "{}: there is no {FILE} in it, so there is nothing to go on from; start with `vaso run CASE --out {0}`",
                out.display()
            )));
        }
        let unusable = |what: String| {
            DriverError::input(format!(
                "{what}; nothing has been changed, and the frames in {} can still be read: put back a sound {FILE}, or start anew with \
                 `vaso run CASE` and another `--out`",
                out.display()
            ))
        };
        let archive = Archive::read(&path, KIND, VERSION).map_err(|error| unusable(error.to_string()))?;
        let missing = |name: &str| unusable(format!("{}: `{name}` is missing", path.display()));
        let text = |name| archive.bytes(name).ok_or_else(|| missing(name));
        let origin = serde_json::from_slice(text(ORIGIN)?).map_err(|_| missing(ORIGIN))?;
        let ending = serde_json::from_slice(text(ENDING)?).map_err(|_| missing(ENDING))?;
        let wall_clock = archive.floats(WALL_CLOCK).and_then(<[f64]>::first).copied();
        let surroundings =
            Surroundings { ending, wall_clock: wall_clock.ok_or_else(|| missing(WALL_CLOCK))? };
        let mut standing = Standing::default();
        archive.recall(&path, |memory| standing.remember(memory)).map_err(|e| unusable(e.to_string()))?;
        Ok(Self { path, archive, origin, standing, surroundings })
    }

    /// Puts the flow where it was. It has to be made from the same case before.
    ///
    /// # Errors
    /// When the checkpoint is not one of such a flow.
    pub fn restore<R: Real, W: Deforming>(&self, flow: &mut Flow<R, W>) -> Result<(), DriverError> {
        self.recall(|memory| flow.remember(memory))?;
        flow.resume().map_err(|error| DriverError::input(format!("{}: {error}", self.path.display())))
    }

    /// Puts what was summed up where it was.
    ///
    /// # Errors
    /// When the checkpoint is not one of such results.
    pub fn restore_results<F>(&self, results: &mut Results<F>) -> Result<(), DriverError> {
        self.recall(|memory| results.remember(memory))
    }

    fn recall(&self, part: impl FnOnce(&mut dyn Memory)) -> Result<(), DriverError> {
        self.archive.recall(&self.path, part).map_err(|error| DriverError::input(error.to_string()))
    }
}
