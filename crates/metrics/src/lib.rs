#![doc = include_str!("../README.md")]

mod clock;
mod definition;
mod error;
pub mod openings;
pub mod wall;

pub use clock::CycleClock;
pub use definition::Definition;
pub use error::MetricsError;
pub use openings::{
    BINS, Change, Criterion, EnergyBalance, EnergySample, OPENING_DEFINITIONS, OpeningCycle, OpeningCycles,
    OpeningSample, Range, Verdict, Waveform, dissipation, kinetic_power,
};
pub use wall::{
    CarriedWall, LARGEST_INVERSE, NearWallDistance, PointIndices, SHEAR_DEFINITIONS, STRESS_DEFINITION,
    ShearCycle, ShearCycles, ShearSample, ShearWindow, Viscosity, WallMesh, WallMotion, WallPose, WallShear,
};
