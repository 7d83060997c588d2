//! The `vaso` binary.
fn main() {}
