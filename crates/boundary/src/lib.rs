#![doc = include_str!("../README.md")]

mod buffer;
pub mod error;
mod impose;
pub mod openings;
pub mod outlet;
pub mod port;
pub mod profile;
mod room;
mod section;
pub mod tune;
pub mod waveform;

pub use error::BoundaryError;
pub use openings::{BUFFER_LENGTH, Openings};
pub use outlet::{Coupling, Cycle, Integration, OutletState, Windkessel, mean_split};
pub use port::{Condition, Counters, Port, Reading};
pub use profile::{Inlet, Profile, Section};
pub use tune::{Split, Target, Tuned, tune};
pub use waveform::{Fourier, Interpolation, Signal, Source, Waveform, WaveformError};
