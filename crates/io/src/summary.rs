//! `summary.json`: the outcome of a run.
//!
//! All quantities are in SI units and carry the unit in their name. A number that is not finite is written
//! as `null` and read back as NaN. The file is written when a run starts (status `running`) and again at
//! its end, whatever the end is.

use crate::check::{EffectEntry, Numbers, OpeningEntry, SurfaceReport};
use crate::cycles::{CycleSummary, EndReason, EnergySummary};
use crate::json;
use crate::wall::WallSummary;
use crate::{ShellSummary, SolidSummary};
use serde::{Deserialize, Serialize};

/// `summary.json`: the outcome of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Summary {
    /// Version of the program.
    pub vaso_version: String,
    /// How the run stands.
    pub status: Status,
    /// Title of the case.
    pub case: String,
    /// Tables of the case, and its surface, with digests of what they say at any spacing: by them a study is known to be of the
    /// same case.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub identity: Vec<[String; 2]>,
    /// What went wrong, if anything did.
    pub message: Option<String>,
    /// Simulated time reached \[s\].
    #[serde(deserialize_with = "json::number")]
    pub time_s: f64,
    /// Wall time spent \[s\].
    #[serde(deserialize_with = "json::number")]
    pub wall_clock_s: f64,
    /// Worker threads.
    pub threads: u64,
    /// Particles at the end.
    pub particles: ParticleCounts,
    /// Steps taken.
    pub steps: StepCounts,
    /// Particles times acoustic steps over wall time \[1/s\].
    #[serde(deserialize_with = "json::number")]
    pub particle_substeps_per_s: f64,
    /// Particle spacing \[m\].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// Artificial sound speed \[m/s\].
    #[serde(deserialize_with = "json::number")]
    pub sound_speed_m_s: f64,
    /// `mixed` or `double`.
    pub precision: String,
    /// What the guards saw.
    pub stability: Stability,
    /// Openings with their means.
    pub openings: Vec<OpeningSummary>,
    /// Every effect the program knows.
    pub effects: Vec<EffectEntry>,
    /// Why a completed run came to its end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end_reason: Option<EndReason>,
    /// Its whole cycles, in order; absent without a period.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cycles: Vec<CycleSummary>,
    /// Where the energy went; absent where no account was kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub energy: Option<EnergySummary>,
    /// Stresses of the wall; absent where they were not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall: Option<WallSummary>,
    /// The wall where it is a solid; absent where it is not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid: Option<SolidSummary>,
    /// The same of a shell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shell: Option<ShellSummary>,
    /// The geometry audit.
    #[serde(default)]
    pub surface: Option<SurfaceReport>,
    /// Numbers of the scene.
    #[serde(default)]
    pub numbers: Option<Numbers>,
    /// Advice given at the start and events of the run.
    #[serde(default)]
    pub warnings: Vec<String>,
}

/// How a run stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Status {
    /// Going on, or broken off without a chance to say so (power cut, SIGKILL).
    #[default]
    Running,
    /// Reached its end time.
    Completed,
    /// Stopped by the user; can be resumed.
    Interrupted,
    /// Broke down; `message` says how.
    Failed,
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Running => "running",
            Self::Completed => "completed",
            Self::Interrupted => "interrupted",
            Self::Failed => "failed",
        })
    }
}

/// Number of particles of each body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct ParticleCounts {
    /// Blood.
    pub fluid: u64,
    /// Rigid or deformable wall made of several layers.
    pub wall: u64,
    /// Wall made of one layer with thickness.
    pub shell: u64,
}

impl ParticleCounts {
    /// All bodies together.
    pub fn total(&self) -> u64 {
        self.fluid + self.wall + self.shell
    }
}

/// Number of time steps taken at each level of the loop nest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct StepCounts {
    /// Steps of the flow time scale.
    pub advection: u64,
    /// Steps of the sound time scale.
    pub acoustic: u64,
    /// Steps of the wall's sound time scale.
    pub solid: u64,
}

/// What the guards saw over the whole run.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Stability {
    /// Largest relative deviation of the density from its rest value \[-\].
    #[serde(deserialize_with = "json::number")]
    pub max_density_error: f64,
    /// Largest speed over sound speed \[-\].
    #[serde(deserialize_with = "json::number")]
    pub max_mach: f64,
    /// Fluid particles found outside the lumen.
    pub escaped_particles: u64,
    /// Values that were not finite.
    pub non_finite: u64,
    /// Inflow minus outflow minus storage, over the inflow \[-\].
    #[serde(deserialize_with = "json::number")]
    pub mass_balance_error: f64,
    /// Energy that nothing supplied, over the total \[-\].
    #[serde(deserialize_with = "json::number")]
    pub energy_growth: f64,
}

/// An opening with its means over the run (over the last cycle of a pulsatile one).
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct OpeningSummary {
    /// The geometry.
    #[serde(flatten)]
    pub opening: OpeningEntry,
    /// Mean flow, positive out of the domain \[m^3/s\].
    #[serde(deserialize_with = "json::number")]
    pub mean_flow_m3_s: f64,
    /// Mean pressure \[Pa\].
    #[serde(deserialize_with = "json::number")]
    pub mean_pressure_pa: f64,
}

json::file!(Summary);
