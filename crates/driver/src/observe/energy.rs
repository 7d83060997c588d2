//! Energy balance of the blood between the openings.

use crate::flow::Flow;
use crate::plan::Plan;
use vaso_boundary::Condition;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_metrics::{EnergyBalance, EnergySample};
use vaso_particles::Memory;

/// Follows the energy of the blood.
///
/// The buffers of inlets do not count, where velocities are imposed and pressures mean nothing: what flows in is taken just
/// inside of them. Pressures are relative to the reference pressure, which does no work on a rigid lumen, and is taken out of that
/// on a wall that deforms as well. What such a wall gets is no longer in the blood.
pub struct EnergyObserver {
    /// What entered and where it went so far.
    pub balance: EnergyBalance,
    /// Whether a velocity is imposed at each opening.
    is_inlet: Vec<bool>,
    /// Work on the wall up to a time.
    wall: (f64, f64),
}

impl EnergyObserver {
    pub(super) fn new(plan: &Plan) -> Self {
        let is_inlet = |c: &Condition| matches!(c, Condition::Velocity { .. });
        Self {
            balance: EnergyBalance::default(),
            wall: (0.0, 0.0),
            is_inlet: plan.openings.iter().map(|o| is_inlet(&o.condition)).collect(),
        }
    }

    pub(super) fn add<R: Real, W: MovingWall>(&mut self, flow: &Flow<R, W>) {
        let reference = flow.openings.reference_pressure(flow.time);
        let outflow = |r: &vaso_boundary::Reading| (r.pressure - reference) * r.flow + r.kinetic_power;
        let opening = &flow.fluid.state.opening;
        let counts = |i: usize| usize::try_from(opening[i]).map_or(true, |k| !self.is_inlet[k]);
        let energy = flow.fluid.energy(counts);
        let wall_power = flow.wall.as_ref().map_or(0.0, |wall| {
            let (work, time) = self.wall;
            self.wall = (wall.work, flow.time);
            (wall.work - work) / (flow.time - time)
        });
        let sample = EnergySample {
            inflow_power: -flow.readings.iter().map(outflow).sum::<f64>() - wall_power,
            dissipation: energy.friction,
            kinetic_energy: energy.kinetic,
        };
        self.balance.add(flow.time, sample);
    }

    pub(super) fn remember(&mut self, memory: &mut dyn Memory) {
        let Self { balance, is_inlet: _, wall: (work, time) } = self;
        balance.remember("energy.balance", memory);
        memory.fields("energy.wall", &mut [work, time]);
    }

    /// Energy that nothing supplied, over what went through; zero where some is missing instead, `None` where none went
    /// through.
    pub fn growth(&self) -> Option<f64> {
        self.balance.relative_residual().map(|residual| (-residual).max(0.0))
    }
}
