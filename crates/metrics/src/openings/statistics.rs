//! Numbers of one cycle of the openings.

use crate::definition::Definition;
use crate::error::MetricsError;
use crate::openings::cycles::BINS;
use vaso_particles::Memory;

/// Flow and pressure over a cycle, or their integrals, one entry a bin.
#[derive(Clone, Debug, PartialEq)]
pub struct Waveform {
    /// Flow out of the vessel \[m^3/s\].
    pub flow: Vec<f64>,
    /// Pressure \[Pa\].
    pub pressure: Vec<f64>,
}

impl Waveform {
    pub(super) fn zero() -> Self {
        Self { flow: vec![0.0; BINS], pressure: vec![0.0; BINS] }
    }

    pub(super) fn over(self, duration: &[f64]) -> Self {
        let mean = |sums: Vec<f64>| sums.iter().zip(duration).map(|(sum, time)| sum / time).collect();
        Self { flow: mean(self.flow), pressure: mean(self.pressure) }
    }
}

/// Mean and extremes over a cycle; the extremes are those of means over a hundredth of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Mean over the cycle.
    pub mean: f64,
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
}

impl Range {
    pub(super) fn of(bins: &[f64]) -> Self {
        Self {
            mean: bins.iter().sum::<f64>() / bins.len() as f64,
            min: bins.iter().copied().fold(f64::INFINITY, f64::min),
            max: bins.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// Largest minus smallest value.
    pub fn peak_to_peak(&self) -> f64 {
        self.max - self.min
    }

    /// The same quantity counted the other way, as an inlet counts its flow.
    pub fn reversed(&self) -> Self {
        Self { mean: -self.mean, min: -self.max, max: -self.min }
    }

    /// Pulsatility index (max - min) / mean (Gosling and King 1974) of a flow counted along its mean; `None` where that is
    /// zero.
    pub fn pulsatility_index(&self) -> Option<f64> {
        (self.mean != 0.0).then(|| self.peak_to_peak() / self.mean.abs())
    }

    /// Resistive index (max - min) / max (Pourcelot 1974) of a flow counted along its mean; `None` where that is zero.
    ///
    /// Above one where the flow reverses.
    pub fn resistive_index(&self) -> Option<f64> {
        let along = if self.mean < 0.0 { self.reversed() } else { *self };
        (along.max > 0.0).then(|| along.peak_to_peak() / along.max)
    }
}

/// One cycle of all openings.
#[derive(Clone, Debug, PartialEq)]
pub struct OpeningCycle {
    /// Number of the cycle, from 0.
    pub number: u64,
    /// Its length \[s\].
    pub period: f64,
    /// Names of the openings.
    pub names: Vec<String>,
    /// Flow and pressure of each opening.
    pub waveform: Vec<Waveform>,
    /// Work of the pressure on what left through each opening, int p Q dt \[J\].
    pub pressure_work: Vec<f64>,
    /// Kinetic energy that left through each opening \[J\].
    pub kinetic_energy: Vec<f64>,
}

/// Definitions of what [`OpeningCycle`] tells.
pub const OPENING_DEFINITIONS: [Definition; 6] = [
    Definition {
        name: "pressure_drop",
        unit: "Pa",
        formula: "mean over a cycle of p_proximal - p_distal",
        source: "",
    },
    Definition {
        name: "ffr",
        unit: "",
        formula: "mean over a cycle of p_distal / mean of p_proximal, against the atmosphere",
        source: "Pijls et al. 1996",
    },
    Definition {
        name: "flow_split",
        unit: "",
        formula: "mean outflow of an opening / sum of all mean outflows",
        source: "",
    },
    Definition {
        name: "pulsatility_index",
        unit: "",
        formula: "(Qmax - Qmin) / |Qmean|, of means over T/100",
        source: "Gosling, King 1974",
    },
    Definition {
        name: "resistive_index",
        unit: "",
        formula: "(Qmax - Qmin) / Qmax, Q along its mean, of means over T/100",
        source: "Pourcelot 1974",
    },
    Definition {
        name: "mass_balance_error",
        unit: "",
        formula: "|sum of mean outflows| / sum of mean inflows",
        source: "",
    },
];

impl OpeningCycle {
    /// A cycle of the openings `names` without values, to be filled by [`Self::remember`].
    pub fn empty(names: &[String]) -> Self {
        let n = names.len();
        Self {
            number: 0,
            period: 0.0,
            names: names.to_vec(),
            waveform: vec![Waveform::zero(); n],
            pressure_work: vec![0.0; n],
            kinetic_energy: vec![0.0; n],
        }
    }

    /// Shows all of it, under `name`.
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { number, period, names: _, waveform, pressure_work, kinetic_energy } = self;
        memory.counts(&format!("{name}.number"), &mut [number]);
        let mut fields = vec![period];
        for Waveform { flow, pressure } in waveform {
            fields.extend(flow.iter_mut().chain(pressure));
        }
        fields.extend(pressure_work.iter_mut().chain(kinetic_energy));
        memory.fields(name, &mut fields);
    }

    /// Number of the opening of this name.
    ///
    /// # Errors
    /// When there is none.
    pub fn opening(&self, name: &str) -> Result<usize, MetricsError> {
        self.names.iter().position(|other| other == name).ok_or_else(|| MetricsError::UnknownOpening {
            name: name.to_owned(),
            known: self.names.join("\", \""),
        })
    }

    /// Flow out of the vessel through an opening \[m^3/s\].
    pub fn flow(&self, opening: usize) -> Range {
        Range::of(&self.waveform[opening].flow)
    }

    /// Pressure at an opening \[Pa\].
    pub fn pressure(&self, opening: usize) -> Range {
        Range::of(&self.waveform[opening].pressure)
    }

    /// Difference of pressure from the opening `proximal` to `distal` \[Pa\]: mean, and extremes of the momentary one.
    pub fn pressure_drop(&self, proximal: usize, distal: usize) -> Range {
        let [proximal, distal] = [proximal, distal].map(|k| &self.waveform[k].pressure);
        let difference: Vec<f64> = proximal.iter().zip(distal).map(|(p, d)| p - d).collect();
        Range::of(&difference)
    }

    /// Fractional flow reserve: mean pressure at the opening `distal` over that at `proximal` (Pijls et al. 1996).
    ///
    /// It means something only where pressures are those against the atmosphere, as under a physiological outlet, and the
    /// flow is that of hyperaemia. `None` where the proximal pressure is not positive.
    pub fn fractional_flow_reserve(&self, proximal: usize, distal: usize) -> Option<f64> {
        let proximal = self.pressure(proximal).mean;
        (proximal > 0.0).then(|| self.pressure(distal).mean / proximal)
    }

    /// Part of the mean outflow that leaves through each opening; `None` for those where blood enters on the mean.
    pub fn flow_split(&self) -> Vec<Option<f64>> {
        let mean: Vec<f64> = (0..self.names.len()).map(|k| self.flow(k).mean).collect();
        let total: f64 = mean.iter().filter(|flow| **flow > 0.0).sum();
        mean.into_iter().map(|flow| (flow > 0.0).then(|| flow / total)).collect()
    }

    /// What leaves less what enters, over what enters; `None` where nothing does.
    ///
    /// For rigid walls; the volume of elastic ones changes within a cycle, but not over a periodic one.
    pub fn mass_balance_error(&self) -> Option<f64> {
        let mean: Vec<f64> = (0..self.names.len()).map(|k| self.flow(k).mean).collect();
        let inflow = -mean.iter().filter(|flow| **flow < 0.0).sum::<f64>();
        (inflow > 0.0).then(|| mean.iter().sum::<f64>().abs() / inflow)
    }
}
