//! What `summary.json` says of a wall that deforms.

use crate::json;
use serde::{Deserialize, Serialize};

/// Where a solid wall stands at the end of a run, and what went through it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SolidSummary {
    /// Distance between its particles \[m\].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// Layers through its thickness.
    #[serde(deserialize_with = "json::number")]
    pub layers: f64,
    /// Sub-steps over acoustic steps.
    #[serde(deserialize_with = "json::number")]
    pub substeps_per_step: f64,
    /// Largest displacement \[m\].
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
    /// Energy of its motion \[J\].
    #[serde(deserialize_with = "json::number")]
    pub kinetic_j: f64,
    /// Energy of its strain \[J\].
    #[serde(deserialize_with = "json::number")]
    pub strain_j: f64,
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
