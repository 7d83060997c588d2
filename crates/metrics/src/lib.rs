#![doc = include_str!("../README.md")]

mod error;
pub mod wall;

pub use error::MetricsError;
pub use wall::{NearWallDistance, ShearSample, Viscosity, WallMesh, WallMotion, WallShear};
