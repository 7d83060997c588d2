//! Where the files of a run stand, so that one that goes on can cut off what lies beyond its checkpoint.

use crate::error::DriverError;
use std::path::Path;
use vaso_io::{read_series_info, read_table};
use vaso_particles::Memory;

/// Frames and rows that belong to a checkpoint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Standing {
    /// Simulated time \[s\].
    pub time: f64,
    /// Frames in each series.
    pub frames: u64,
    /// Time of the last of them \[s\].
    pub last_frame: Option<f64>,
    /// Rows in each table.
    pub rows: u64,
}

impl Standing {
    /// Shows all of it.
    pub fn remember(&mut self, memory: &mut dyn Memory) {
        let Self { time, frames, last_frame, rows } = self;
        memory.fields("output.time_s", &mut [time]);
        memory.counts("output.counts", &mut [frames, rows]);
        memory.optional("output.last_frame_s", last_frame);
    }

    /// Time up to which frames belong to the checkpoint \[s\]. One more that stands for an interruption does not: an unbroken run has none.
    pub fn kept_frames(&self) -> f64 {
        self.last_frame.unwrap_or(f64::NEG_INFINITY)
    }

    /// Whether the folder still holds all frames and rows that a run going on counts on; `series` and `tables` are its files.
    ///
    /// # Errors
    /// Names the files that lack some.
    pub fn check(&self, out: &Path, series: &[&str], tables: &[&str]) -> Result<(), DriverError> {
        let mut problems = Vec::new();
        let up_to = |times: Vec<f64>, end: f64| times.iter().filter(|&&t| t <= end).count() as u64;
        let mut compare = |name: &str, what: &str, seen: Result<u64, vaso_io::IoError>, needed: u64| {
            let file = out.join(name);
            let problem = match seen {
                Ok(seen) if seen == needed => return,
                Ok(seen) => format!("{}: it has {seen} {what}, and had {needed}", file.display()),
                Err(error) => error.to_string(),
            };
            problems.push(format!(
                "{problem} when the checkpoint at {:.6e} s was written; put the file back, or start anew with `vaso run`",
                self.time
            ));
        };
        for name in series.iter().filter(|_| self.frames > 0) {
            let info = read_series_info(&out.join(name));
            let seen = info.map(|info| up_to(info.times, self.kept_frames()));
            compare(name, "frames", seen, self.frames);
        }
        for name in tables {
            let table = read_table(&out.join(name));
            let seen = table.map(|t| up_to(t.rows.iter().map(|row| row[0]).collect(), self.time));
            compare(name, "rows", seen, self.rows);
        }
        if problems.is_empty() { Ok(()) } else { Err(DriverError::Input { problems }) }
    }
}
