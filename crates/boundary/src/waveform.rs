//! Values in time: constants and tables, with a smooth start.

use std::f64::consts::PI;

/// Table of a quantity over time, linear in between.
#[derive(Clone, Debug, PartialEq)]
pub struct Waveform {
    time: Vec<f64>,
    value: Vec<f64>,
    period: Option<f64>,
}

/// Why a table cannot be a waveform.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WaveformError {
    /// No rows, or columns of different length.
    #[error(
        "a waveform needs at least one row with a time and a value, got {times} times and {values} values"
    )]
    Empty {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// Times do not rise.
    #[error("times must rise: row {row} has {time} s after {before} s")]
    Unsorted {
        /// First row (from 1) that is not later than the one before.
        row: usize,
        /// Its time \[s\].
        time: f64,
        /// The time before \[s\].
        before: f64,
    },
    /// The period ends before the table does.
    #[error("the table spans {span} s, longer than the period of {period} s")]
    LongerThanPeriod {
        /// Time from first to last row \[s\].
        span: f64,
        /// Period asked for \[s\].
        period: f64,
    },
}

impl Waveform {
    /// Waveform through `time` \[s\] and `value`; with a `period` \[s\] it repeats, else it stays at
    /// its ends. A table that ends before the period is closed by a straight line to its start.
    ///
    /// # Errors
    /// See [`WaveformError`].
    pub fn new(time: Vec<f64>, value: Vec<f64>, period: Option<f64>) -> Result<Self, WaveformError> {
        if time.is_empty() || time.len() != value.len() {
            return Err(WaveformError::Empty { times: time.len(), values: value.len() });
        }
        if let Some(k) = (1..time.len()).find(|&k| time[k] <= time[k - 1] || !time[k].is_finite()) {
            return Err(WaveformError::Unsorted { row: k + 1, time: time[k], before: time[k - 1] });
        }
        let span = time[time.len() - 1] - time[0];
        if let Some(period) = period
            && span > period * (1.0 + 1e-9)
        {
            return Err(WaveformError::LongerThanPeriod { span, period });
        }
        Ok(Self { time, value, period })
    }

    /// Value at `t` \[s\].
    pub fn at(&self, t: f64) -> f64 {
        let (first, last) = (self.time[0], self.time[self.time.len() - 1]);
        let t = match self.period {
            Some(period) => first + (t - first).rem_euclid(period),
            None => t.clamp(first, last),
        };
        let next = self.time.partition_point(|&x| x <= t);
        if next == 0 {
            return self.value[0];
        }
        let (t0, v0) = (self.time[next - 1], self.value[next - 1]);
        let (t1, v1) = if next < self.time.len() {
            (self.time[next], self.value[next])
        } else {
            match self.period {
                Some(period) if first + period > t0 => (first + period, self.value[0]),
                _ => return v0,
            }
        };
        v0 + (v1 - v0) * (t - t0) / (t1 - t0)
    }

    /// Largest magnitude it takes.
    pub fn peak(&self) -> f64 {
        self.value.iter().fold(0.0, |a, v| a.max(v.abs()))
    }

    /// Smallest and largest value it takes.
    pub fn range(&self) -> (f64, f64) {
        self.value.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)))
    }
}

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
        if t < self.ramp { full * 0.5 * (1.0 - (PI * t / self.ramp).cos()) } else { full }
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
    fn an_open_period_is_closed_to_its_start() {
        let wave = Waveform::new(vec![0.0, 0.5], vec![1.0, 3.0], Some(1.0)).expect("valid");
        for (t, expected) in [(0.0, 1.0), (0.25, 2.0), (0.5, 3.0), (0.75, 2.0), (1.25, 2.0), (7.5, 3.0)] {
            assert!((wave.at(t) - expected).abs() < 1e-12, "at {t}: {}", wave.at(t));
        }
    }

    #[test]
    fn without_a_period_the_ends_hold() {
        let wave = Waveform::new(vec![0.1, 0.2], vec![1.0, 2.0], None).expect("valid");
        assert_eq!((wave.at(0.0), wave.at(5.0)), (1.0, 2.0));
    }

    #[test]
    fn bad_tables_are_named() {
        assert!(matches!(Waveform::new(vec![], vec![], None), Err(WaveformError::Empty { .. })));
        assert!(matches!(
            Waveform::new(vec![0.0, 1.0, 1.0], vec![0.0; 3], None),
            Err(WaveformError::Unsorted { row: 3, .. })
        ));
        assert!(matches!(
            Waveform::new(vec![0.0, 2.0], vec![0.0; 2], Some(1.0)),
            Err(WaveformError::LongerThanPeriod { .. })
        ));
    }

    #[test]
    fn the_ramp_is_half_a_cosine() {
        let signal = Signal { source: Source::Constant(2.0), ramp: 0.1 };
        assert!((signal.at(0.05) - 1.0).abs() < 1e-12);
        assert_eq!((signal.at(0.0), signal.at(0.1)), (0.0, 2.0));
    }
}
