//! What the fuzz targets do with their input. The fuzzer calls these functions with what it makes up, the test
//! `corpus` with the committed files and with mutations of them.
//!
//! A function here returns for every input whatsoever: it panics only where the project broke a promise.

mod case;
mod geometry;

pub use case::case;
pub use geometry::{prepare, stl, vtp};

/// What is done with an input.
pub type Target = fn(&[u8]);

/// The targets by the names of their folders in `corpus`.
pub const TARGETS: [(&str, Target); 4] = [("stl", stl), ("vtp", vtp), ("case", case), ("prepare", prepare)];
