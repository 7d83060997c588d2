#![doc = include_str!("../README.md")]

mod acoustic;
pub mod cap;
mod continuity;
pub mod energy;
pub mod fluid;
mod frozen;
mod kick;
pub mod law;
mod level;
mod moving;
pub mod numbers;
mod rheology;
pub mod state;
mod summation;
pub mod transport;
mod viscosity;
pub mod wall;
mod wall_force;

pub use cap::CapZone;
pub use energy::Energy;
pub use fluid::Fluid;
pub use numbers::Numbers;
pub use rheology::Rheology;
pub use state::FluidState;
pub use transport::Guarded;
pub use vaso_kernels::{Isa, Real};
pub use wall_force::Contact;
