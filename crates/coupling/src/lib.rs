#![doc = include_str!("../README.md")]

mod columns;
mod coupling;
mod no_wall;
mod ownership;
mod prescribed;
mod shell_wall;
mod wall;

pub use columns::{Foot, GhostColumns};
pub use coupling::Coupling;
pub use no_wall::NoWall;
pub use prescribed::Prescribed;
pub use shell_wall::ShellWall;
pub use wall::{CouplingError, Facet, MovingWall, NO_FACET};
