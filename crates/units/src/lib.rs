#![doc = include_str!("../README.md")]

pub mod dimension;
mod error;
mod parse;
mod pretty;
mod table;

pub use dimension::Dimension;
pub use error::UnitError;
pub use parse::{Quantity, parse, parse_as, parse_unit};
pub use pretty::{pretty, significant};
pub use table::nearest;
