#![doc = include_str!("../README.md")]

pub mod column;
pub mod memory;
pub mod selection;
pub mod visit;
pub mod wall;

pub use column::{Column, ScalarColumn, VectorColumn};
pub use memory::Memory;
pub use selection::Selection;
pub use visit::{Columns, NonFinite, Visitor};
pub use wall::{WallDistance, WallLoad, WallMotion, WallView};
