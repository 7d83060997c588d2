#![doc = include_str!("../README.md")]

mod coupling;
mod prescribed;
mod wall;

pub use coupling::Coupling;
pub use prescribed::Prescribed;
pub use wall::{CouplingError, MovingWall};
