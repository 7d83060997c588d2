#![doc = include_str!("../README.md")]

mod clock;
mod definition;
mod error;
pub mod wall;

pub use clock::CycleClock;
pub use definition::Definition;
pub use error::MetricsError;
pub use wall::{
    LARGEST_INVERSE, NearWallDistance, PointIndices, SHEAR_DEFINITIONS, ShearCycle, ShearCycles, ShearSample,
    Viscosity, WallMesh, WallMotion, WallShear,
};
