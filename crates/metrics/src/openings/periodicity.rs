//! Whether cycles have become alike.

use crate::openings::statistics::{OpeningCycle, Range};
use vaso_particles::Memory;

/// Range over mean below which a waveform counts as steady, and is compared with its mean.
const STEADY: f64 = 1e-3;

/// How much the openings of one cycle differ from those of another.
///
/// For each opening `sqrt(1/T int (q - q')^2 dt)` over the peak-to-peak value of `q`, or over its mean where it is steady; zero where
/// both are.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Change of the flow of each opening, relative.
    pub flow: Vec<f64>,
    /// Change of the pressure of each opening, relative.
    pub pressure: Vec<f64>,
}

impl Change {
    /// No change of `n` openings, to be filled by [`Self::remember`].
    pub fn none(n: usize) -> Self {
        Self { flow: vec![0.0; n], pressure: vec![0.0; n] }
    }

    /// Shows all of it, under `name`.
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { flow, pressure } = self;
        memory.fields(name, &mut flow.iter_mut().chain(pressure).collect::<Vec<_>>());
    }

    /// Change from the cycle `before` to `now`.
    ///
    /// # Panics
    /// When they are not cycles of the same openings.
    pub fn between(before: &OpeningCycle, now: &OpeningCycle) -> Self {
        assert_eq!(before.names, now.names, "cycles of the same openings");
        let pairs = || before.waveform.iter().zip(&now.waveform);
        Self {
            flow: pairs().map(|(a, b)| relative(&a.flow, &b.flow)).collect(),
            pressure: pairs().map(|(a, b)| relative(&a.pressure, &b.pressure)).collect(),
        }
    }

    /// The largest of all.
    pub fn largest(&self) -> f64 {
        self.flow.iter().chain(&self.pressure).copied().fold(0.0, f64::max)
    }
}

fn relative(before: &[f64], now: &[f64]) -> f64 {
    let squares: f64 = before.iter().zip(now).map(|(a, b)| (a - b).powi(2)).sum();
    let difference = (squares / now.len() as f64).sqrt();
    let range = Range::of(now);
    let steady = range.peak_to_peak() <= STEADY * range.mean.abs();
    let scale = if steady { range.mean.abs() } else { range.peak_to_peak() };
    if difference == 0.0 { 0.0 } else { difference / scale }
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criterion {
    /// Largest [`Change`] of cycles that count as alike.
    pub openings: f64,
    /// Largest change of the time-averaged wall shear stress ([`ShearCycle::change_from`](crate::ShearCycle::change_from)).
    pub shear: f64,
    /// Cycles after which to give up.
    pub most_cycles: u64,
}

impl Default for Criterion {
    fn default() -> Self {
        Self { openings: 0.01, shear: 0.02, most_cycles: 20 }
    }
}

/// What a [`Criterion`] says at the end of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Cycles still change.
    GoOn,
    /// The last two cycles are alike.
    Periodic,
    /// They never became alike.
    GaveUp,
}

impl Criterion {
    /// Verdict after `completed` cycles, from the change of the openings and, where it is known, that of the wall.
    ///
    /// After the first cycle there is no change yet.
    pub fn judge(&self, completed: u64, openings: Option<&Change>, shear: Option<f64>) -> Verdict {
        let alike = openings.is_some_and(|change| change.largest() <= self.openings)
            && shear.is_none_or(|change| change <= self.shear);
        match alike {
            true => Verdict::Periodic,
            false if completed >= self.most_cycles => Verdict::GaveUp,
            false => Verdict::GoOn,
        }
    }
}
