//! Surfaces made from a few numbers, for tests and cases: always closed, outward, and the same every time.

mod pipe;
mod rings;

pub use pipe::{bent_pipe, pipe};
