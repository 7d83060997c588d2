//! Whether a flow without a period has settled.

use crate::flow::Flow;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_particles::Memory;

/// Compares the mean flows of successive intervals.
///
/// A flow that settles like `exp(-t/T)` changes over an interval of T by 1.7 times what is left to change, so the interval has to be
/// that of the slowest process, and a small change over a short time says nothing.
pub struct Settling {
    share: f64,
    interval: f64,
    end: f64,
    time: f64,
    volume: Vec<f64>,
    before: Option<Vec<f64>>,
    last_time: f64,
}

impl Settling {
    /// Settled once no flow changes by more than `share` of the largest over an `interval` \[s\].
    pub(super) fn new(share: f64, interval: f64) -> Self {
        Self { share, interval, end: interval, time: 0.0, volume: Vec::new(), before: None, last_time: 0.0 }
    }

    pub(super) fn remember(&mut self, memory: &mut dyn Memory) {
        let Self { share: _, interval: _, end, time, volume, before, last_time } = self;
        memory.fields("settling.clock", &mut [end, time, last_time]);
        memory.numbers("settling.volume", volume);
        // Empty before the first interval has ended.
        let mut means = before.take().unwrap_or_default();
        memory.numbers("settling.before", &mut means);
        *before = Some(means).filter(|means| !means.is_empty());
    }

    /// Takes the state after a step; tells when it has settled.
    pub(super) fn add<R: Real, W: MovingWall>(&mut self, flow: &Flow<R, W>) -> Option<String> {
        let dt = flow.time - self.last_time;
        self.last_time = flow.time;
        self.time += dt;
        self.volume.resize(flow.readings.len(), 0.0);
        for (volume, reading) in self.volume.iter_mut().zip(&flow.readings) {
            *volume += dt * reading.flow;
        }
        if flow.time < self.end {
            return None;
        }
        self.end += self.interval;
        let now: Vec<f64> = self.volume.iter().map(|volume| volume / self.time).collect();
        self.time = 0.0;
        self.volume.fill(0.0);
        let change = self.before.as_ref().map(|before| largest_change(before, &now));
        self.before = Some(now);
        change.filter(|change| *change <= self.share).map(|change| {
            format!(
                "the flow has settled: its means over {:.3} s changed by {:.2} %",
                self.interval,
                100.0 * change
            )
        })
    }
}

/// Largest change of a flow over the largest flow.
fn largest_change(before: &[f64], now: &[f64]) -> f64 {
    let largest = now.iter().fold(0.0, |top: f64, q| top.max(q.abs()));
    let change = before.iter().zip(now).fold(0.0, |top: f64, (a, b)| top.max((a - b).abs()));
    if change == 0.0 { 0.0 } else { change / largest }
}

#[cfg(test)]
mod tests {
    use super::largest_change;

    #[test]
    fn changes_are_relative_to_the_largest_flow() {
        assert!((largest_change(&[-4.0, 1.0, 3.0], &[-4.0, 1.2, 2.8]) - 0.05).abs() < 1e-15);
        assert_eq!(largest_change(&[0.0], &[0.0]), 0.0);
    }
}
