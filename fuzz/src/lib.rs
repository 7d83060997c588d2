//! What the fuzz targets do with their input. The fuzzer calls these functions with what it makes up, the test
//! `corpus` with the committed files and with mutations of them.
//!
//! A function here returns for every input whatsoever: it panics only where the project broke a promise.

mod case;
mod geometry;

pub use case::case;
pub use geometry::{prepare, stl, vtp};

/// A target of the fuzzer, by the name of its folder in `corpus`.
pub const TARGETS: [(&str, fn(&[u8])); 4] =
    [("stl", stl), ("vtp", vtp), ("case", case), ("prepare", prepare)];
