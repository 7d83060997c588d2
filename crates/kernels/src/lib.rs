#![doc = include_str!("../README.md")]
// The one crate that talks to vector units; every block says what makes it sound.
#![allow(unsafe_code)]

pub mod frame;
pub mod grid;
pub mod in_order;
pub mod isa;
pub mod lanes;
pub mod links;
pub mod pairs;
pub mod points;
pub mod records;
pub mod rows;
pub mod sym3;
pub mod wendland;

pub use frame::Frame;
pub use grid::CellGrid;
pub use in_order::{reduce_in_order, sum_in_order};
pub use isa::{Isa, run_on};
pub use lanes::{FIELDS, Lanes, Real};
pub use links::{LinkLaw, LinkStore, sweep_links};
pub use pairs::{Gather, Own, Pair, PairLaw, PairStore, Store, Stored, sweep, sweep_some};
pub use points::{BLOCK, BlockColumn, PointLaw, Points, sweep_points};
pub use records::Records;
pub use rows::{CHUNK, RowChunk, Rows, SearchSet};
pub use sym3::Sym3;
pub use wendland::Wendland;
