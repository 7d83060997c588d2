//! Surfaces made from a few numbers, for tests and cases: always closed, outward, and the same every time.

mod bifurcation;
mod even;
mod junction;
mod pipe;
mod rings;

pub use bifurcation::{BifurcationSpec, bifurcation};
pub use pipe::{bent_pipe, pipe};
