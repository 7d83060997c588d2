#![doc = include_str!("../README.md")]

pub mod buffer;
pub mod error;
pub mod outlet;
pub mod profile;
pub mod waveform;

pub use buffer::{BUFFER_LENGTH, Condition, Counters, Openings, Port, Reading};
pub use error::BoundaryError;
pub use outlet::{CoupledState, Coupling, Cycle, Integration, OutletState, Windkessel, mean_split};
pub use profile::Profile;
pub use waveform::{Fourier, Interpolation, Signal, Source, Waveform, WaveformError};
