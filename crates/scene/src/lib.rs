#![doc = include_str!("../README.md")]

mod build;
mod check;
mod contents;
mod document;
mod drive;
mod error;
mod expect;
mod files;
mod json_schema;
mod kind;
pub mod material;
pub mod opening;
mod overrides;
mod plain;
mod reader;
mod reference;
mod scene;
mod schema;
mod section;
mod table;
mod waveform;
mod words;

pub use error::{Excerpt, Problem, SceneError};
pub use expect::{Expectation, Measured, Statistic};
pub use json_schema::case_schema;
pub use material::{Blood, OpenEnds, Wall, WallBody};
pub use opening::{Condition, Coupling, Drive, Opening, Profile};
pub use reference::case_reference;
pub use scene::{
    Field, Generator, Geometry, Lattice, Numerics, Output, Particles, Precision, Probe, Run, Scene, Topology,
};
pub use waveform::{Interpolation, Waveform};
pub use words::Word;
