//! What `summary.json` says of a wall that is a shell.

use crate::json;
use serde::{Deserialize, Serialize};

/// Where a shell stands at the end of a run, and what went through it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ShellSummary {
    /// Distance between its particles \[m\].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// Ghosts that the blood sees of it.
    pub ghosts: u64,
    /// Sub-steps over acoustic steps.
    #[serde(deserialize_with = "json::number")]
    pub substeps_per_step: f64,
    /// Largest displacement of the mid-surface \[m\].
    #[serde(deserialize_with = "json::number")]
    pub max_displacement_m: f64,
    /// Force of all supports on it \[N\].
    pub reaction_n: [f64; 3],
    /// Work the blood has done on it \[J\].
    #[serde(deserialize_with = "json::number")]
    pub blood_work_j: f64,
    /// Work of blood, pressures and tissue on it \[J\].
    #[serde(deserialize_with = "json::number")]
    pub load_work_j: f64,
    /// Energy of its motion, the turning of its sections included \[J\].
    #[serde(deserialize_with = "json::number")]
    pub kinetic_j: f64,
    /// Energy of the strain of its mid-surface \[J\].
    #[serde(deserialize_with = "json::number")]
    pub membrane_j: f64,
    /// Energy of its bending \[J\].
    #[serde(deserialize_with = "json::number")]
    pub bending_j: f64,
    /// Energy of its transverse shear \[J\].
    #[serde(deserialize_with = "json::number")]
    pub shear_j: f64,
    /// Energy of the hourglass control \[J\].
    #[serde(deserialize_with = "json::number")]
    pub hourglass_j: f64,
    /// Energy that damping has taken \[J\].
    #[serde(deserialize_with = "json::number")]
    pub dissipated_j: f64,
    /// Stored, plus taken, minus brought in \[J\]: the error of the time step.
    #[serde(deserialize_with = "json::number")]
    pub balance_j: f64,
}
