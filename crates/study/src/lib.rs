#![doc = include_str!("../README.md")]

mod convergence;
mod front;
mod power;
mod price;

pub use convergence::{Convergence, Trend, convergence};
pub use front::pareto;
pub use power::PowerLaw;
pub use price::{Price, Trade};
