#![doc = include_str!("../README.md")]

pub mod flow;
pub mod ledger;

pub use flow::{Diverged, Flow, Watch};
pub use ledger::{Ledger, Stage};
