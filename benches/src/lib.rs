//! vaso benches.
