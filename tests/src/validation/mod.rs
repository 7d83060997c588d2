//! Flows against formulas, other programs and measurements.

pub mod ends;
