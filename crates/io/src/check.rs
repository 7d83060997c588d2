//! What `vaso check --json` prints, and what `summary.json` and `particles.json` repeat of it.

use crate::json;
use crate::summary::ParticleCounts;
use serde::{Deserialize, Serialize};

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

/// The geometry audit.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SurfaceReport {
    /// Triangles after repair.
    pub triangles: u64,
    /// Enclosed volume with the openings capped \[m^3\].
    #[serde(deserialize_with = "json::number")]
    pub volume_m3: f64,
    /// Area with the openings capped \[m^2\].
    #[serde(deserialize_with = "json::number")]
    pub area_m2: f64,
    /// Closed once the openings are capped.
    pub watertight: bool,
    /// Connected pieces kept.
    pub components: u64,
    /// Connected places at which the surface cuts itself; absent in files of earlier versions.
    #[serde(default)]
    pub self_intersections: u64,
    /// What was mended, in words.
    pub repairs: Vec<String>,
    /// Unit of the coordinates in the file.
    pub unit: String,
}

/// An opening as the geometry gives it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct OpeningEntry {
    /// Name from the case, or one made from the rank by area.
    pub name: String,
    /// Centroid \[m\].
    #[serde(deserialize_with = "json::vector")]
    pub center_m: [f64; 3],
    /// Unit normal out of the domain \[-\].
    #[serde(deserialize_with = "json::vector")]
    pub normal: [f64; 3],
    /// Area \[m^2\].
    #[serde(deserialize_with = "json::number")]
    pub area_m2: f64,
    /// Radius of the circle of equal area \[m\].
    #[serde(deserialize_with = "json::number")]
    pub radius_m: f64,
}

/// Dimensionless (and two dimensional) numbers of the scene; `None` where the scene does not define one.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Numbers {
    /// Peak speed times diameter over kinematic viscosity \[-\].
    pub reynolds_peak: Option<f64>,
    /// Radius times square root of angular frequency over kinematic viscosity \[-\].
    pub womersley: Option<f64>,
    /// Expected radial strain of the wall \[-\].
    pub radial_strain: Option<f64>,
    /// Artificial sound speed \[m/s\].
    pub sound_speed_m_s: Option<f64>,
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
    /// Wall time spent in it \[s\]; absent before a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
    /// Memory held by it \[bytes\]; absent before a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<u64>,
}

/// What a run is expected to need.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Predicted {
    /// Particles of each body.
    pub particles: ParticleCounts,
    /// Memory \[bytes\].
    pub memory_bytes: u64,
    /// Wall time \[s\].
    #[serde(deserialize_with = "json::number")]
    pub wall_clock_s: f64,
}

json::file!(CheckReport);
