#![doc = include_str!("../README.md")]

mod damping;
mod energy;
pub mod error;
mod forces;
mod frequency;
mod lanes;
pub mod law;
mod load;
mod loading;
mod material;
mod measures;
mod numbers;
mod output;
mod reference;
mod section;
mod settle;
mod shell;
mod spread;
mod state;
mod step;
mod support;
mod weights;

pub use energy::Energies;
pub use error::ShellError;
pub use material::{Material, Model};
pub use numbers::Numbers;
pub use output::Height;
pub use shell::{Particles, Shell};
pub use state::ShellState;
pub use support::{Hold, Support};
pub use vaso_kernels::{Isa, Real};
