//! The vaso binary: composition of all crates.
