#![doc = include_str!("../README.md")]

mod check;
mod error;
pub mod material;
pub mod opening;
mod scene;
mod waveform;
mod words;

pub use error::{Problem, SceneError};
pub use material::{Blood, Wall};
pub use opening::{Condition, Drive, Opening, Profile};
pub use scene::{
    Field, Generator, Geometry, Lattice, Numerics, Output, Particles, Precision, Probe, Run, Scene, Topology,
};
pub use waveform::Waveform;
