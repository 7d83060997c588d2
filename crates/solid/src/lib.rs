#![doc = include_str!("../README.md")]

mod energy;
pub mod error;
mod face;
mod formulation;
mod lanes;
pub mod law;
mod load;
mod lumen;
mod mat3;
pub mod material;
mod numbers;
mod output;
mod points;
mod reference;
mod settle;
mod solid;
mod state;
mod step;
mod total;
mod updated;

pub use energy::Energies;
pub use error::SolidError;
pub use face::Face;
pub use material::{HolzapfelGasserOgden, HypoElastic, Material, NeoHookean, SaintVenantKirchhoff};
pub use numbers::Numbers;
pub use solid::{Particles, Solid};
pub use state::SolidState;
pub use vaso_kernels::{Isa, Real};
