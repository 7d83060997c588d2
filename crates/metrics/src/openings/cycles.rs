//! Flow and pressure of openings, summed over a cycle while it runs.

use crate::clock::CycleClock;
use crate::error::MetricsError;
use crate::openings::statistics::{OpeningCycle, Waveform};
use vaso_particles::Memory;

/// Parts a cycle is divided into: fine enough for any pulse, coarse enough to be free of sound and of single particles.
pub const BINS: usize = 100;

/// What an opening does at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OpeningSample {
    /// Flow out of the vessel \[m^3/s\].
    pub flow: f64,
    /// Pressure, reference pressure of the run included \[Pa\].
    pub pressure: f64,
    /// Kinetic energy that leaves through it a second \[W\]; see [`kinetic_power`](crate::kinetic_power).
    pub kinetic_power: f64,
}

/// Sums over the cycle that is going on, for every opening.
///
/// Between samples flow and pressure are taken to go in a straight line; sums are exact for that.
#[derive(Clone, Debug, PartialEq)]
pub struct OpeningCycles {
    names: Vec<String>,
    /// Clock of the bins, not of the cycles.
    clock: CycleClock,
    last: Vec<OpeningSample>,
    /// Time in each bin of the cycle that is going on \[s\].
    covered: Vec<f64>,
    /// For each opening the integrals of flow \[m^3\] and pressure \[Pa s\] over each bin.
    sums: Vec<Waveform>,
    /// For each opening the work of the pressure and the kinetic energy that left \[J\].
    energy: Vec<[f64; 2]>,
}

impl OpeningCycles {
    /// Sums for the openings of these names, over cycles of `period` \[s\] from `start` \[s\] on.
    ///
    /// # Errors
    /// When the period is not positive.
    pub fn new(names: Vec<String>, start: f64, period: f64) -> Result<Self, MetricsError> {
        MetricsError::positive("period of a cycle", period)?;
        let n = names.len();
        Ok(Self {
            names,
            clock: CycleClock::new(start, period / BINS as f64)?,
            last: vec![OpeningSample::default(); n],
            covered: vec![0.0; BINS],
            sums: vec![Waveform::zero(); n],
            energy: vec![[0.0; 2]; n],
        })
    }

    /// Takes all openings at `time` \[s\]; gives the cycle that ended since the last sample, of several the last. A cycle that
    /// sampling began in is not given.
    ///
    /// # Errors
    /// When there is not one sample an opening.
    pub fn add(
        &mut self,
        time: f64,
        samples: &[OpeningSample],
    ) -> Result<Option<OpeningCycle>, MetricsError> {
        MetricsError::length("samples of openings", samples.len(), self.names.len())?;
        let mut ended = None;
        for piece in self.clock.advance(time) {
            let bin = (piece.cycle % BINS as u64) as usize;
            self.covered[bin] += piece.duration;
            for (k, (a, b)) in self.last.iter().zip(samples).enumerate() {
                let at = |part: f64| blend(a, b, part);
                let (a, b) = (at(piece.span.0), at(piece.span.1));
                let middle = blend(&a, &b, 0.5);
                self.sums[k].flow[bin] += piece.duration * middle.flow;
                self.sums[k].pressure[bin] += piece.duration * middle.pressure;
                // Simpson's rule: exact for the product of two straight lines.
                let power = |s: &OpeningSample| s.pressure * s.flow;
                self.energy[k][0] += piece.duration / 6.0 * (power(&a) + 4.0 * power(&middle) + power(&b));
                self.energy[k][1] += piece.duration * middle.kinetic_power;
            }
            if piece.completes && bin == BINS - 1 {
                ended = self.close(piece.cycle / BINS as u64).or(ended);
            }
        }
        if self.clock.last() == Some(time) {
            self.last.copy_from_slice(samples);
        }
        Ok(ended)
    }

    /// The cycle that ends, if it was sampled throughout, and sums of zero for the next.
    fn close(&mut self, number: u64) -> Option<OpeningCycle> {
        let n = self.names.len();
        let covered = std::mem::replace(&mut self.covered, vec![0.0; BINS]);
        let sums = std::mem::replace(&mut self.sums, vec![Waveform::zero(); n]);
        let energy = std::mem::replace(&mut self.energy, vec![[0.0; 2]; n]);
        let width = self.clock.period();
        let whole = covered.iter().all(|time| (time - width).abs() < 1e-6 * width);
        whole.then(|| OpeningCycle {
            number,
            period: width * BINS as f64,
            names: self.names.clone(),
            waveform: sums.into_iter().map(|sum| sum.over(&covered)).collect(),
            pressure_work: energy.iter().map(|e| e[0]).collect(),
            kinetic_energy: energy.iter().map(|e| e[1]).collect(),
        })
    }

    /// Shows all that changes, under `name`.
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { names: _, clock, last, covered, sums, energy } = self;
        clock.remember(&format!("{name}.clock"), memory);
        memory.fixed_numbers(&format!("{name}.covered_s"), covered);
        for (k, ((last, sums), energy)) in last.iter_mut().zip(sums).zip(energy).enumerate() {
            let OpeningSample { flow, pressure, kinetic_power } = last;
            let [work, kinetic_energy] = energy;
            let own = &mut [flow, pressure, kinetic_power, work, kinetic_energy];
            memory.fields(&format!("{name}.{k}.last"), own);
            memory.fixed_numbers(&format!("{name}.{k}.flow"), &mut sums.flow);
            memory.fixed_numbers(&format!("{name}.{k}.pressure"), &mut sums.pressure);
        }
    }
}

/// The sample at a part of the way from one to another.
fn blend(a: &OpeningSample, b: &OpeningSample, part: f64) -> OpeningSample {
    let mix = |a: f64, b: f64| a + part * (b - a);
    OpeningSample {
        flow: mix(a.flow, b.flow),
        pressure: mix(a.pressure, b.pressure),
        kinetic_power: mix(a.kinetic_power, b.kinetic_power),
    }
}
