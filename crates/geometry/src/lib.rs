#![doc = include_str!("../README.md")]

mod audit;
mod caps;
mod close;
mod corner;
mod distance;
mod distance_grid;
mod ears;
mod error;
mod opening;
mod polygon;
mod pseudo_normal;
mod read;
mod repair;
mod section;
pub mod shapes;
mod surface;
mod unit;
mod vessel;
mod winding;
mod write;

pub use audit::{Audit, EdgeLengths, FlatRegion, Rejection};
pub use distance::{Nearest, SignedDistance};
pub use distance_grid::DistanceGrid;
pub use error::GeometryError;
pub use opening::Opening;
pub use read::{parse_surface, read_surface};
pub use surface::Surface;
pub use unit::{LengthUnit, UnknownUnit};
pub use vessel::{Vessel, prepare};
pub use write::write_stl;
