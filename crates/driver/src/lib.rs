#![doc = include_str!("../README.md")]

pub mod bodies;
pub mod case;
pub mod check;
pub mod checkpoint;
pub mod compare;
mod conditions;
pub mod deforming;
pub mod error;
pub mod estimate;
pub mod extrusion;
pub mod flow;
mod kept;
pub mod ledger;
pub mod new;
pub mod observe;
pub mod particles;
pub mod plan;
pub mod print;
pub mod progress;
pub mod quality;
pub mod results;
pub mod resume;
pub mod run;
pub mod shell;
mod start;
pub mod structure;
mod supported;
mod timing;
pub mod tune;
pub mod world;

pub use case::Case;
pub use error::DriverError;
pub use flow::{Diverged, Flow, Watch};
pub use ledger::{Ledger, Stage};
pub use plan::Plan;
