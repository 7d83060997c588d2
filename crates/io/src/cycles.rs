//! What `summary.json` says of the cycles of a run and of its energy.

use crate::json;
use serde::{Deserialize, Serialize};

/// Why a run that was not interrupted came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum EndReason {
    /// It reached its end time.
    EndTime,
    /// Two successive cycles were alike.
    Periodic,
    /// Flows had stopped to change.
    Steady,
}

/// One cycle of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct CycleSummary {
    /// Number of the cycle, from 0.
    pub index: u64,
    /// Its begin \[s\].
    #[serde(deserialize_with = "json::number")]
    pub start_s: f64,
    /// Its end \[s\].
    #[serde(deserialize_with = "json::number")]
    pub end_s: f64,
    /// Flow and pressure of each opening.
    pub openings: Vec<OpeningCycleSummary>,
    /// Change from the cycle before; absent for the first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub periodicity: Option<PeriodicitySummary>,
    /// What left less what entered, over what entered \[-\]; absent where nothing did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_balance_error: Option<f64>,
    /// Between the pairs of openings that the case names.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pressure_drops: Vec<PressureDropSummary>,
    /// Mean over the wall outside the buffers of the time-averaged wall shear stress \[Pa\]; absent where it was not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean_tawss_pa: Option<f64>,
}

/// An opening over one cycle. Extremes are of means over a hundredth of the cycle.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct OpeningCycleSummary {
    /// Name of the opening.
    pub name: String,
    /// Mean flow, positive out of the domain \[m^3/s\].
    #[serde(deserialize_with = "json::number")]
    pub mean_flow_m3_s: f64,
    /// Smallest flow \[m^3/s\].
    #[serde(deserialize_with = "json::number")]
    pub min_flow_m3_s: f64,
    /// Largest flow \[m^3/s\].
    #[serde(deserialize_with = "json::number")]
    pub max_flow_m3_s: f64,
    /// Mean pressure \[Pa\].
    #[serde(deserialize_with = "json::number")]
    pub mean_pressure_pa: f64,
    /// Largest pressure \[Pa\].
    #[serde(deserialize_with = "json::number")]
    pub systolic_pressure_pa: f64,
    /// Smallest pressure \[Pa\].
    #[serde(deserialize_with = "json::number")]
    pub diastolic_pressure_pa: f64,
    /// Systolic less diastolic pressure \[Pa\].
    #[serde(deserialize_with = "json::number")]
    pub pulse_pressure_pa: f64,
    /// Share of the mean outflow of all openings \[-\]; absent where blood enters on the mean.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flow_split: Option<f64>,
    /// `(Qmax - Qmin) / |Qmean|` \[-\] (Gosling, King 1974).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pulsatility_index: Option<f64>,
    /// `(Qmax - Qmin) / Qmax` \[-\] (Pourcelot 1974).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resistive_index: Option<f64>,
}

/// How much a cycle differs from the one before.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PeriodicitySummary {
    /// Largest change of the flow of any opening, over its range \[-\].
    #[serde(deserialize_with = "json::number")]
    pub flow: f64,
    /// Largest change of the pressure of any opening, over its range \[-\].
    #[serde(deserialize_with = "json::number")]
    pub pressure: f64,
    /// Change of the time-averaged wall shear stress, over its mean \[-\]; absent where it was not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_shear: Option<f64>,
}

/// Pressure from one opening to another over one cycle.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct PressureDropSummary {
    /// Name of the opening the drop is counted from.
    pub proximal: String,
    /// Name of the opening it is counted to.
    pub distal: String,
    /// Mean drop \[Pa\].
    #[serde(deserialize_with = "json::number")]
    pub mean_pa: f64,
    /// Smallest momentary drop \[Pa\].
    #[serde(deserialize_with = "json::number")]
    pub min_pa: f64,
    /// Largest momentary drop \[Pa\].
    #[serde(deserialize_with = "json::number")]
    pub max_pa: f64,
    /// Mean distal over mean proximal pressure \[-\] (Pijls et al. 1996); absent where the latter is not positive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fractional_flow_reserve: Option<f64>,
}

/// Where the energy went that entered through the openings.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct EnergySummary {
    /// What entered less what left, by the work of the pressure and as kinetic energy \[J\].
    #[serde(deserialize_with = "json::number")]
    pub inflow_j: f64,
    /// What entered or left, counted positive \[J\].
    #[serde(deserialize_with = "json::number")]
    pub throughput_j: f64,
    /// What became heat by friction \[J\].
    #[serde(deserialize_with = "json::number")]
    pub dissipated_j: f64,
    /// Kinetic energy at the end less that at the start \[J\].
    #[serde(deserialize_with = "json::number")]
    pub kinetic_change_j: f64,
    /// What entered and went into neither: numerical dissipation, compression, and errors of the estimates \[J\].
    #[serde(deserialize_with = "json::number")]
    pub residual_j: f64,
    /// Residual over throughput \[-\]; absent where nothing went through.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative_residual: Option<f64>,
    /// What the damping of backflow took \[J\]; absent where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damped_backflow_j: Option<f64>,
}
