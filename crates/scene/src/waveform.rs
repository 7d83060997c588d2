//! Tables of a value over time.

use std::path::PathBuf;

/// A value over time, as read from a file of two columns. How to interpolate is up to who uses it.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    /// The file it came from.
    pub file: PathBuf,
    /// Times, strictly increasing \[s\].
    pub time: Vec<f64>,
    /// Values at these times, in the SI unit of what the waveform prescribes.
    pub value: Vec<f64>,
    /// Time after which the waveform repeats \[s\], `run.period`; `None` for one that does not repeat, which then
    /// covers the whole run. A repeated first sample at the end of the period has been taken off, so the last interval
    /// runs from the last sample to the first one of the next period.
    pub period: Option<f64>,
}
