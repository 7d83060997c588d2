//! Cuts the time between samples at the ends of cycles.

use crate::error::MetricsError;
use vaso_particles::Memory;

/// Part of a period within which a sample counts as taken at the end of a cycle.
const ROUNDING: f64 = 1e-9;

/// Where in its cycles a series of samples is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CycleClock {
    start: f64,
    period: f64,
    last: Option<f64>,
    cycle: u64,
}

/// A part of the time between two samples that lies in one cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Number of the cycle, from 0.
    pub(crate) cycle: u64,
    /// Begin and end, as parts of the time between the samples.
    pub(crate) span: (f64, f64),
    /// Length \[s\].
    pub(crate) duration: f64,
    /// Whether the cycle ends with it.
    pub(crate) completes: bool,
}

impl CycleClock {
    /// Cycles of `period` \[s\], the first of which begins at `start` \[s\].
    ///
    /// # Errors
    /// When the period is not positive.
    pub fn new(start: f64, period: f64) -> Result<Self, MetricsError> {
        Ok(Self { start, period: MetricsError::positive("period of a cycle", period)?, last: None, cycle: 0 })
    }

    /// Length of a cycle \[s\].
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Number of the cycle that is going on, from 0.
    pub fn cycle(&self) -> u64 {
        self.cycle
    }

    /// Time of the last sample \[s\].
    pub fn last(&self) -> Option<f64> {
        self.last
    }

    /// Shows all that changes, under `name`.
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { start: _, period: _, last, cycle } = self;
        memory.optional(&format!("{name}.last_s"), last);
        memory.counts(&format!("{name}.cycle"), &mut [cycle]);
    }

    /// Parts of the time since the last sample, for one at `time` \[s\]. None for the first sample, for one that is no later
    /// than the last, and for what lies before the first cycle.
    pub(crate) fn advance(&mut self, time: f64) -> Vec<Piece> {
        let Some(last) = self.last else {
            self.last = Some(time);
            // Sampling may begin in any cycle.
            self.cycle = ((time - self.start) / self.period + ROUNDING).max(0.0) as u64;
            return Vec::new();
        };
        if time <= last {
            return Vec::new();
        }
        self.last = Some(time);
        let part = |t: f64| ((t - last) / (time - last)).clamp(0.0, 1.0);
        let mut pieces = Vec::new();
        let mut begin = last.max(self.start);
        while begin < time {
            let end = self.start + (self.cycle + 1) as f64 * self.period;
            let completes = time >= end - ROUNDING * self.period;
            let until = if completes { end.min(time) } else { time };
            pieces.push(Piece {
                cycle: self.cycle,
                span: (part(begin), part(until)),
                duration: until - begin,
                completes,
            });
            if completes {
                self.cycle += 1;
            }
            begin = until;
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_cut_where_cycles_end() {
        let mut clock = CycleClock::new(1.0, 0.5).expect("valid");
        assert!(clock.advance(0.8).is_empty(), "the first sample ends nothing");
        let pieces = clock.advance(2.3);
        let cycles: Vec<(u64, bool)> = pieces.iter().map(|p| (p.cycle, p.completes)).collect();
        assert_eq!(cycles, [(0, true), (1, true), (2, false)]);
        let total: f64 = pieces.iter().map(|p| p.duration).sum();
        assert!((total - 1.3).abs() < 1e-12, "what lies before the start does not count: {total}");
        assert!((pieces[0].span.0 - 0.2 / 1.5).abs() < 1e-12 && pieces[2].span.1 == 1.0);
        assert!(clock.advance(2.3).is_empty());
    }

    /// A hundred steps of a hundredth do not add up to one in floating point, but to a cycle.
    #[test]
    fn rounding_neither_adds_nor_swallows_a_cycle() {
        let mut clock = CycleClock::new(0.0, 1.0).expect("valid");
        let (mut time, mut completed) = (0.0, 0);
        clock.advance(time);
        for _ in 0..1000 {
            time += 0.01;
            completed += clock.advance(time).iter().filter(|p| p.completes).count();
        }
        assert_eq!((completed, clock.cycle()), (10, 10));
    }

    #[test]
    fn sampling_may_begin_late() {
        let mut clock = CycleClock::new(0.0, 1.0).expect("valid");
        clock.advance(3.25);
        assert_eq!(clock.advance(3.5)[0].cycle, 3);
        assert!(matches!(CycleClock::new(0.0, 0.0), Err(MetricsError::NotPositive { .. })));
    }
}
