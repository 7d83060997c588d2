//! The machine-readable results: `summary.json`, `particles.json` and the answer of `vaso check --json`.
//!
//! All quantities are in SI units and carry the unit in their name. A number that is not finite is written
//! as `null` and read back as NaN.

use crate::{IoError, json};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

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
    /// Largest relative deviation of the density from its rest value [-].
    #[serde(deserialize_with = "json::number")]
    pub max_density_error: f64,
    /// Largest speed over sound speed [-].
    #[serde(deserialize_with = "json::number")]
    pub max_mach: f64,
    /// Fluid particles found outside the lumen.
    pub escaped_particles: u64,
    /// Values that were not finite.
    pub non_finite: u64,
    /// Inflow minus outflow minus storage, over the inflow [-].
    #[serde(deserialize_with = "json::number")]
    pub mass_balance_error: f64,
    /// Energy that nothing supplied, over the total [-].
    #[serde(deserialize_with = "json::number")]
    pub energy_growth: f64,
}

/// An opening as the geometry gives it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct OpeningEntry {
    /// Name from the case, or one made from the rank by area.
    pub name: String,
    /// Centroid [m].
    #[serde(deserialize_with = "json::vector")]
    pub center_m: [f64; 3],
    /// Unit normal out of the domain [-].
    #[serde(deserialize_with = "json::vector")]
    pub normal: [f64; 3],
    /// Area [m^2].
    #[serde(deserialize_with = "json::number")]
    pub area_m2: f64,
    /// Radius of the circle of equal area [m].
    #[serde(deserialize_with = "json::number")]
    pub radius_m: f64,
}

/// An opening with its means over the run (over the last cycle of a pulsatile one).
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct OpeningSummary {
    /// The geometry.
    #[serde(flatten)]
    pub opening: OpeningEntry,
    /// Mean flow, positive out of the domain [m^3/s].
    #[serde(deserialize_with = "json::number")]
    pub mean_flow_m3_s: f64,
    /// Mean pressure [Pa].
    #[serde(deserialize_with = "json::number")]
    pub mean_pressure_pa: f64,
}

/// One effect the program knows: whether the scene switches it on, and what it cost.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EffectEntry {
    /// Dotted name such as `wall.shell`.
    pub name: String,
    /// Computed in this run.
    pub on: bool,
    /// The dimensionless numbers of the scene ask for it.
    #[serde(default)]
    pub called_for: bool,
    /// Why it is on or off.
    pub reason: String,
    /// Wall time spent in it [s]; absent before a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
    /// Memory held by it [bytes]; absent before a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<u64>,
}

/// The geometry audit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceReport {
    /// Triangles after repair.
    pub triangles: u64,
    /// Enclosed volume with the openings capped [m^3].
    #[serde(deserialize_with = "json::number")]
    pub volume_m3: f64,
    /// Area with the openings capped [m^2].
    #[serde(deserialize_with = "json::number")]
    pub area_m2: f64,
    /// Closed once the openings are capped.
    pub watertight: bool,
    /// Connected pieces kept.
    pub components: u64,
    /// What was mended, in words.
    pub repairs: Vec<String>,
    /// Unit of the coordinates in the file.
    pub unit: String,
}

/// Dimensionless (and two dimensional) numbers of the scene; `None` where the scene does not define one.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Numbers {
    /// Peak speed times diameter over kinematic viscosity [-].
    pub reynolds_peak: Option<f64>,
    /// Radius times square root of angular frequency over kinematic viscosity [-].
    pub womersley: Option<f64>,
    /// Expected radial strain of the wall [-].
    pub radial_strain: Option<f64>,
    /// Artificial sound speed [m/s].
    pub sound_speed_m_s: Option<f64>,
}

/// What a run is expected to need.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Predicted {
    /// Particles of each body.
    pub particles: ParticleCounts,
    /// Memory [bytes].
    pub memory_bytes: u64,
    /// Wall time [s].
    #[serde(deserialize_with = "json::number")]
    pub wall_clock_s: f64,
}

/// `summary.json`: the outcome of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Summary {
    /// Version of the program.
    pub vaso_version: String,
    /// How the run stands.
    pub status: Status,
    /// Title of the case.
    pub case: String,
    /// What went wrong, if anything did.
    pub message: Option<String>,
    /// Simulated time reached [s].
    #[serde(deserialize_with = "json::number")]
    pub time_s: f64,
    /// Wall time spent [s].
    #[serde(deserialize_with = "json::number")]
    pub wall_clock_s: f64,
    /// Worker threads.
    pub threads: u64,
    /// Particles at the end.
    pub particles: ParticleCounts,
    /// Steps taken.
    pub steps: StepCounts,
    /// Particles times acoustic steps over wall time [1/s].
    #[serde(deserialize_with = "json::number")]
    pub particle_substeps_per_s: f64,
    /// Particle spacing [m].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// Artificial sound speed [m/s].
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

/// What `vaso check --json` prints.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct CheckReport {
    /// The geometry audit.
    pub surface: SurfaceReport,
    /// Openings, largest first.
    pub openings: Vec<OpeningEntry>,
    /// Numbers of the scene; `None` for a bare surface.
    pub numbers: Option<Numbers>,
    /// The plan; empty for a bare surface.
    pub effects: Vec<EffectEntry>,
    /// Expected cost; `None` for a bare surface.
    pub predicted: Option<Predicted>,
    /// Advice.
    pub warnings: Vec<String>,
}

/// Quality of one generated body; lengths in particle spacings.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Quality {
    /// Number of particles.
    pub count: u64,
    /// Sum of particle volumes over the volume they stand for, minus one [-].
    #[serde(deserialize_with = "json::number")]
    pub volume_error: f64,
    /// Smallest distance between two particles [spacings].
    #[serde(deserialize_with = "json::number")]
    pub nearest_neighbor_min: f64,
    /// Standard deviation over mean of the distance to the nearest particle [-].
    #[serde(deserialize_with = "json::number")]
    pub nearest_neighbor_cv: f64,
    /// Mean of the kernel sum over particles with full support [-].
    #[serde(deserialize_with = "json::number")]
    pub kernel_sum_mean: f64,
    /// Standard deviation of the kernel sum [-].
    #[serde(deserialize_with = "json::number")]
    pub kernel_sum_std: f64,
    /// Root mean square of the kernel gradient sum, times the spacing [-].
    #[serde(deserialize_with = "json::number")]
    pub gradient_residual_rms: f64,
    /// Standard deviation over mean of the particle volumes [-].
    #[serde(deserialize_with = "json::number")]
    pub volume_cv: f64,
    /// Particles on the wrong side of the surface.
    pub outside: u64,
    /// Wall time of the generation [s].
    #[serde(deserialize_with = "json::number")]
    pub seconds: f64,
    /// Relaxation iterations.
    pub iterations: u64,
}

/// `particles.json`: the outcome of `vaso particles`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ParticlesReport {
    /// Version of the program.
    pub vaso_version: String,
    /// Title of the case.
    pub case: String,
    /// Generator used.
    pub generator: String,
    /// Particle spacing [m].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// The geometry audit.
    pub surface: SurfaceReport,
    /// Openings, largest first.
    pub openings: Vec<OpeningEntry>,
    /// Particles of each body.
    pub particles: ParticleCounts,
    /// Quality by body name (`fluid`, `wall`, `shell`).
    pub quality: BTreeMap<String, Quality>,
    /// Advice.
    #[serde(default)]
    pub warnings: Vec<String>,
}

macro_rules! json_file {
    ($($type:ty),*) => {$(
        impl $type {
            /// Writes the file whole or not at all.
            ///
            /// # Errors
            /// [`IoError::System`] when the disk or the folder refuses.
            pub fn write(&self, path: &Path) -> Result<(), IoError> {
                json::write(path, self)
            }

            /// Reads the file.
            ///
            /// # Errors
            /// [`IoError::System`] or, when the content is not what it should be, [`IoError::Json`].
            pub fn read(path: &Path) -> Result<Self, IoError> {
                json::read(path)
            }

            /// The same text for a terminal.
            pub fn to_json(&self) -> String {
                serde_json::to_string_pretty(self)
                    .expect("plain structs with string keys always serialize; non-finite numbers become null")
            }
        }
    )*};
}

json_file!(Summary, CheckReport, ParticlesReport);
