//! Flow and pressure of openings: means, ratios, periodicity and balances.

mod balance;
mod cycles;
mod periodicity;
mod statistics;

pub use balance::{EnergyBalance, EnergySample, dissipation, kinetic_power};
pub use cycles::{BINS, OpeningCycles, OpeningSample};
pub use periodicity::{Change, Criterion, Verdict};
pub use statistics::{OPENING_DEFINITIONS, OpeningCycle, Range, Waveform};
