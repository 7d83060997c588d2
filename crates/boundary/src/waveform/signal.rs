//! A boundary value in time, with a smooth start.

use super::Waveform;
use std::f64::consts::PI;

/// A boundary value in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// What it follows.
    pub source: Source,
    /// Time over which it rises from zero, as half a cosine \[s\].
    pub ramp: f64,
}

/// Source of a [`Signal`].
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// The same at all times.
    Constant(f64),
    /// A table.
    Waveform(Waveform),
}

impl Signal {
    /// Constant from the start.
    pub fn constant(value: f64) -> Self {
        Self { source: Source::Constant(value), ramp: 0.0 }
    }

    /// Value at `t` \[s\].
    pub fn at(&self, t: f64) -> f64 {
        let full = match &self.source {
            Source::Constant(value) => *value,
            Source::Waveform(waveform) => waveform.at(t),
        };
        full * self.risen(t)
    }

    /// How much of it has risen at `t` \[s\]: from 0 to 1 over the ramp.
    pub fn risen(&self, t: f64) -> f64 {
        if t < self.ramp { 0.5 * (1.0 - (PI * t / self.ramp).cos()) } else { 1.0 }
    }

    /// Largest magnitude it takes.
    pub fn peak(&self) -> f64 {
        match &self.source {
            Source::Constant(value) => value.abs(),
            Source::Waveform(waveform) => waveform.peak(),
        }
    }

    /// Smallest and largest value it takes after the ramp.
    pub fn range(&self) -> (f64, f64) {
        match &self.source {
            Source::Constant(value) => (*value, *value),
            Source::Waveform(waveform) => waveform.range(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_is_half_a_cosine() {
        let signal = Signal { source: Source::Constant(2.0), ramp: 0.1 };
        assert!((signal.at(0.05) - 1.0).abs() < 1e-12);
        assert_eq!((signal.at(0.0), signal.at(0.1)), (0.0, 2.0));
    }
}
