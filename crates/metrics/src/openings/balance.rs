//! Where the energy goes that enters through the openings.

use glam::DMat3;
use rayon::prelude::*;
use vaso_particles::Memory;

/// Particles a chunk of a sum: fixed, so that the order of summation does not depend on threads.
const CHUNK: usize = 4096;

/// Kinetic energy that leaves with a flow a second, `alpha rho/2 (Q/A)^2 Q` \[W\], for the density \[kg/m^3\], the flow \[m^3/s\] and
/// the area \[m^2\].
///
/// The coefficient `alpha` is 1 for a plug and 2 for a parabola: the mean of `(u/U)^3` over the section.
pub fn kinetic_power(density: f64, flow: f64, area: f64, coefficient: f64) -> f64 {
    0.5 * coefficient * density * (flow / area).powi(2) * flow
}

/// Heat that `n` particles make a second by friction, `sum V 2 mu D:D` \[W\].
///
/// `particle` gives the volume \[m^3\], the velocity gradient \[1/s\] and the viscosity \[Pa s\] of each.
pub fn dissipation(n: usize, particle: impl Fn(usize) -> (f64, DMat3, f64) + Sync) -> f64 {
    let chunks: Vec<f64> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|c| {
            (c * CHUNK..((c + 1) * CHUNK).min(n))
                .map(|i| {
                    let (volume, gradient, viscosity) = particle(i);
                    let twice = gradient + gradient.transpose();
                    let squares = [twice.x_axis, twice.y_axis, twice.z_axis].map(|c| c.length_squared());
                    0.5 * volume * viscosity * squares.iter().sum::<f64>()
                })
                .sum::<f64>()
        })
        .collect();
    chunks.iter().sum()
}

/// What the energy balance needs to know of one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergySample {
    /// Power that enters through all openings, `- sum (p Q + kinetic power)` with Q outwards \[W\].
    pub inflow_power: f64,
    /// Heat made by friction \[W\].
    pub dissipation: f64,
    /// Kinetic energy of the blood in the vessel \[J\].
    pub kinetic_energy: f64,
}

/// Energy balance of the blood in rigid walls, from the first sample on: what entered went into heat or motion.
///
/// Power is taken to go in a straight line between samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyBalance {
    /// Time and state of the last sample.
    pub last: Option<(f64, EnergySample)>,
    /// Kinetic energy at the first sample \[J\].
    pub initial_kinetic_energy: f64,
    /// Energy that entered \[J\].
    pub inflow: f64,
    /// Energy that entered or left, counted positive: what a residual is to be compared with \[J\].
    pub throughput: f64,
    /// Energy that became heat \[J\].
    pub dissipated: f64,
}

impl EnergyBalance {
    /// Takes the state at `time` \[s\]; one no later than the last changes nothing.
    pub fn add(&mut self, time: f64, now: EnergySample) {
        match self.last {
            None => self.initial_kinetic_energy = now.kinetic_energy,
            Some((last, _)) if time <= last => return,
            Some((last, before)) => {
                let half = 0.5 * (time - last);
                self.inflow += half * (before.inflow_power + now.inflow_power);
                self.throughput += half * (before.inflow_power.abs() + now.inflow_power.abs());
                self.dissipated += half * (before.dissipation + now.dissipation);
            }
        }
        self.last = Some((time, now));
    }

    /// Shows all of it, under `name`.
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { last, initial_kinetic_energy, inflow, throughput, dissipated } = self;
        memory.fields(name, &mut [initial_kinetic_energy, inflow, throughput, dissipated]);
        let (mut time, mut now) =
            last.map_or((None, EnergySample::default()), |(time, now)| (Some(time), now));
        memory.optional(&format!("{name}.last_s"), &mut time);
        let EnergySample { inflow_power, dissipation, kinetic_energy } = &mut now;
        memory.fields(&format!("{name}.last"), &mut [inflow_power, dissipation, kinetic_energy]);
        *last = time.map(|time| (time, now));
    }

    /// What entered and went into neither heat nor motion \[J\]: numerical dissipation, and what the estimates miss.
    pub fn residual(&self) -> f64 {
        let stored = self.last.map_or(0.0, |(_, now)| now.kinetic_energy - self.initial_kinetic_energy);
        self.inflow - self.dissipated - stored
    }

    /// Residual over throughput; `None` where nothing went through.
    pub fn relative_residual(&self) -> Option<f64> {
        (self.throughput > 0.0).then(|| self.residual() / self.throughput)
    }
}
