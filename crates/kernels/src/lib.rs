#![doc = include_str!("../README.md")]

pub mod grid;
pub mod wendland;

pub use grid::CellGrid;
pub use wendland::Wendland;
