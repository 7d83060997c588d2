//! The state an outlet comes to after many equal cycles, from the model alone.

use super::{Integration, OutletState, Windkessel};
use crate::error::BoundaryError;
use crate::waveform::{Signal, Waveform};

/// A periodic cycle of an outlet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// State at time zero.
    pub start: OutletState,
    /// Lowest pressure at the cap \[Pa\].
    pub diastolic: f64,
    /// Highest pressure at the cap \[Pa\].
    pub systolic: f64,
    /// Mean pressure at the cap \[Pa\].
    pub mean: f64,
}

/// Steps of a cycle. A smooth inflow is off by (2 pi k)^2 / 12 over their square in its harmonic k.
const STEPS: usize = 4096;

impl Windkessel {
    /// The periodic cycle under an outflow `flow` \[m^3/s\] that repeats.
    ///
    /// The store forgets a constant share of what it held each cycle, so the periodic state follows from one
    /// cycle that starts empty; nothing is iterated, however slow the outlet is.
    ///
    /// # Errors
    /// When the model has no meaning, the flow no period, or the pressure would rise for ever.
    pub fn periodic(&self, flow: &Waveform) -> Result<Cycle, BoundaryError> {
        self.validate()?;
        let period = flow.period().ok_or(BoundaryError::NoPeriod)?;
        let mean_flow = flow.mean();
        let blocked = self.distal_resistance.is_infinite() && self.compliance.is_finite();
        if blocked && mean_flow != 0.0 {
            return Err(BoundaryError::NeverPeriodic { mean_flow });
        }
        let times = times_of_cycle(flow, period);
        let at = |stored_pressure: f64| {
            let flow = flow.at(0.0);
            let pressure = stored_pressure + self.proximal_resistance * flow;
            OutletState { pressure, stored_pressure, flow }
        };
        let run = |start: OutletState, seen: &mut dyn FnMut(f64, &OutletState)| {
            times.windows(2).fold(start, |state, t| {
                let end = if t[1] < period { flow.at(t[1]) } else { start.flow };
                let next = self.advance(&state, end, t[1] - t[0], Integration::Exponential);
                seen(t[1] - t[0], &next);
                next
            })
        };
        let filled = run(at(self.distal_pressure), &mut |_, _| {}).stored_pressure - self.distal_pressure;
        let forgotten = -(-period / self.time_constant()).exp_m1();
        let above = if self.distal_resistance.is_infinite() {
            0.0
        } else if forgotten > 0.0 {
            filled / forgotten
        } else {
            self.distal_resistance * mean_flow
        };
        let start = at(self.distal_pressure + above);
        let mut cycle = Cycle { start, diastolic: start.pressure, systolic: start.pressure, mean: 0.0 };
        let mut before = start.pressure;
        run(start, &mut |duration, state| {
            cycle.diastolic = cycle.diastolic.min(state.pressure);
            cycle.systolic = cycle.systolic.max(state.pressure);
            cycle.mean += 0.5 * (before + state.pressure) * duration / period;
            before = state.pressure;
        });
        Ok(cycle)
    }
}

impl Windkessel {
    /// How much more the store has to hold at the start for the outlet to be on its cycle under `flow` \[m^3/s\] once an inflow has
    /// risen as `signal` does \[Pa\]: what the rise keeps back is missing for as long as the store remembers.
    ///
    /// Nothing for an outlet that forgets within the rise.
    pub fn head_start(&self, flow: &Waveform, signal: &Signal) -> f64 {
        let (rise, memory) = (signal.ramp, self.time_constant());
        if rise <= 0.0 || memory < rise || self.compliance.is_infinite() {
            return 0.0;
        }
        let step = rise / STEPS as f64;
        let kept_back = |k: usize| {
            let t = (k as f64 + 0.5) * step;
            (1.0 - signal.risen(t)) * flow.at(t) * (t / memory).exp()
        };
        (0..STEPS).map(kept_back).sum::<f64>() * step / self.compliance
    }
}

/// Times from zero to the period \[s\]: even ones, and the rows of the table, where its slope may jump.
fn times_of_cycle(flow: &Waveform, period: f64) -> Vec<f64> {
    let even = (0..=STEPS).map(|k| period * k as f64 / STEPS as f64);
    let rows = flow.times().iter().map(|t| t.rem_euclid(period));
    let mut times: Vec<f64> = even.chain(rows).collect();
    times.sort_unstable_by(f64::total_cmp);
    // Rows that are even times up to rounding would make steps too short to mean anything.
    times.dedup_by(|b, a| *b - *a < 1e-9 * period);
    if let Some(last) = times.last_mut() {
        *last = period;
    }
    times
}

/// How a mean inflow \[m^3/s\] parts among outlets that share one mean pressure: that pressure \[Pa\], and the share
/// of each outlet.
///
/// # Errors
/// When an outlet has no meaning, or none of them lets anything out.
pub fn mean_split(outlets: &[Windkessel], inflow: f64) -> Result<(f64, Vec<f64>), BoundaryError> {
    for outlet in outlets {
        outlet.validate()?;
    }
    let conductance: Vec<f64> = outlets.iter().map(|o| 1.0 / o.total_resistance()).collect();
    let total: f64 = conductance.iter().sum();
    if total <= 0.0 {
        return Err(BoundaryError::NeverPeriodic { mean_flow: inflow });
    }
    if let Some(value) = conductance.iter().find(|g| g.is_infinite()) {
        return Err(BoundaryError::OutOfRange {
            key: "total resistance",
            value: 1.0 / value,
            allowed: "more than zero, in Pa s/m^3",
        });
    }
    let from_distal: f64 = outlets.iter().zip(&conductance).map(|(o, g)| g * o.distal_pressure).sum();
    let pressure = (inflow + from_distal) / total;
    let share = |(o, g): (&Windkessel, &f64)| g * (pressure - o.distal_pressure) / inflow;
    let shares = if inflow == 0.0 {
        conductance.iter().map(|g| g / total).collect()
    } else {
        outlets.iter().zip(&conductance).map(share).collect()
    };
    Ok((pressure, shares))
}
