//! What a ladder of whole flows found, and the page made of it.
//!
//! Times are processor times of one thread, in the same run as the loop they are compared with: on a shared machine seconds vary by a
//! third from hour to hour, such ratios by a tenth.

pub mod page;

use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// All that one run of the ladder found.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Ladder {
    /// What the machine can do.
    pub machine: Machine,
    /// Time of the reference: both pair loops of an acoustic step, plainly written in double precision, on a box \[ns a particle\].
    pub reference_ns: f64,
    /// The same loops on all lanes.
    pub loops: Vec<Loop>,
    /// Whole flows.
    pub rungs: Vec<Rung>,
}

/// What bounds a loop.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Machine {
    /// Instruction set of the loops.
    pub isa: String,
    /// Threads it has.
    pub threads: usize,
    /// Multiply-adds of one core in mixed and in double precision, by 1e9 a second.
    pub multiply_adds: [f64; 2],
    /// What one core streams from and to memory \[GB/s\].
    pub triad_gb_s: f64,
}

/// Both pair loops of an acoustic step, momentum and continuity.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Loop {
    /// Precision, as case files have it.
    pub precision: String,
    /// Time of both \[ns a particle\].
    pub ns: f64,
    /// Pairs of a particle.
    pub pairs: f64,
}

/// A whole flow: the carotid of `cases/carotid` at one spacing.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Rung {
    /// Model of the wall, as case files have it.
    pub wall: String,
    /// Precision.
    pub precision: String,
    /// Spacing \[mm\].
    pub spacing_mm: f64,
    /// Particles of the blood and of the wall.
    pub particles: [usize; 2],
    /// Sound speed \[m/s\].
    pub sound_speed: f64,
    /// Acoustic step \[s\].
    pub step_s: f64,
    /// Acoustic steps an advective one.
    pub acoustic_per_advective: f64,
    /// Sub-steps of the wall an acoustic step; 0 at rest.
    pub wall_substeps: f64,
    /// All there is to an acoustic step, on one core \[ns a particle of the blood\].
    pub ns: f64,
    /// Wall time of one thread over that of all, by their number.
    pub efficiency: f64,
    /// Bytes a particle of the blood holds, rows included, and a particle of a wall that deforms.
    pub bytes: [f64; 2],
    /// Share of each stage.
    pub stages: Vec<(String, f64)>,
}

impl Rung {
    /// Particles of the blood times acoustic steps by second and core, in millions.
    pub fn rate(&self) -> f64 {
        1e3 / self.ns
    }

    /// Share of a stage, 0 where it is absent.
    pub fn share(&self, stage: &str) -> f64 {
        self.stages.iter().find(|s| s.0 == stage).map_or(0.0, |s| s.1)
    }

    /// Time of one sub-step of a wall that deforms \[ns a particle of it\].
    pub fn wall_ns(&self) -> Option<f64> {
        let substeps = self.wall_substeps * self.particles[1] as f64;
        (substeps > 0.0).then(|| self.ns * self.particles[0] as f64 * self.share("wall.motion") / substeps)
    }

    /// Wall time of a second of flow on two cores \[s\].
    pub fn seconds_a_second(&self) -> f64 {
        1e-9 * self.ns * self.particles[0] as f64 / self.step_s / (2.0 * self.efficiency)
    }
}

impl Ladder {
    /// The rung of a wall at a spacing \[mm\].
    pub fn rung(&self, wall: &str, precision: &str, spacing_mm: f64) -> Option<&Rung> {
        let is_it = |r: &&Rung| {
            r.wall == wall && r.precision == precision && (r.spacing_mm - spacing_mm).abs() < 1e-9
        };
        self.rungs.iter().find(is_it)
    }

    /// Reads what was kept.
    ///
    /// # Panics
    /// When it is not there, or not a ladder.
    pub fn kept() -> Self {
        let text = std::fs::read_to_string(file()).expect("the results of the ladder are kept");
        serde_json::from_str(&text).expect("what is kept is a ladder")
    }

    /// Keeps it, and writes the page.
    ///
    /// # Panics
    /// When a file cannot be written.
    pub fn keep(&self) {
        let text = serde_json::to_string_pretty(self).expect("numbers and names");
        std::fs::write(file(), text + "\n").expect("it can be written");
        std::fs::write(root().join("docs/speed.md"), page::render(self)).expect("it can be written");
    }
}

fn file() -> PathBuf {
    root().join("benches/results/speed.json")
}

/// Folder of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the folder above").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_made_of_what_is_kept() {
        let page = std::fs::read_to_string(root().join("docs/speed.md")).expect("there is a page");
        assert!(
            page == page::render(&Ladder::kept()),
            "run `cargo bench -p vaso-benches --bench ladder -- --page`"
        );
    }
}
