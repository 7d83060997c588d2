//! Weakly compressible SPH blood flow.
