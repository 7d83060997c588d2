//! Columns of particle data and the contracts between physics crates.
