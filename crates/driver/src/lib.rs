#![doc = include_str!("../README.md")]

pub mod case;
pub mod check;
pub mod checkpoint;
pub mod error;
pub mod estimate;
pub mod flow;
pub mod ledger;
pub mod particles;
pub mod plan;
pub mod print;
pub mod progress;
pub mod results;
pub mod run;
mod supported;
pub mod world;

pub use case::Case;
pub use error::DriverError;
pub use flow::{Diverged, Flow, Watch};
pub use ledger::{Ledger, Stage};
pub use plan::Plan;
