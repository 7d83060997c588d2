//! Imposes the conditions on the particles in the buffers, and reads what comes of it.

use crate::openings::Openings;
use crate::outlet::Seen;
use crate::port::{Condition, Passed, Reading};
use crate::profile::Amplitudes;
use num_complex::Complex64;
use vaso_fluid::{Fluid, FluidState, Real};

/// Length of the section inside a velocity buffer over which the pressure is averaged, in spacings.
const SECTION: f64 = 4.0;

impl Openings {
    /// Imposes the conditions on the buffers after the kick of an acoustic step of `dt` \[s\] that
    /// ends at `t` \[s\], and lets the outlet models follow. Returns the top speed in the buffers \[m/s\].
    ///
    /// A pressure enters through the missing kernel support; along the cap the velocity is removed, since nothing outside could
    /// drive it.
    pub fn apply<R: Real>(&mut self, fluid: &mut Fluid<R>, t: f64, dt: f64) -> f64 {
        let reference = self.reference_pressure(t);
        let (rest_density, length) = (self.numbers.rest_density, self.buffer_length());
        let mut all = std::mem::take(&mut self.now);
        for (k, now) in all.iter_mut().enumerate() {
            now.imposed = self.pressure_value(k, t).unwrap_or(0.0) - reference;
            now.density_behind = self.density_behind(k, &fluid.state);
            now.sums = Sums::default();
            self.ports[k].set_amplitudes(t, &mut now.inflow);
        }
        let mut waves = self.waves.as_slice();
        let mut top: f64 = 0.0;
        for (zone, shape) in self.zones.iter().zip(&self.shape) {
            let (i, k) = (zone.particle as usize, zone.opening as usize);
            let (port, now) = (&self.ports[k], &mut all[k]);
            let owned = fluid.state.opening[i] == k as i32;
            let (own_waves, rest) = waves.split_at(now.inflow.waves.len());
            waves = rest;
            let velocity = match port.condition {
                // Whatever the buffer owns moves as asked, the fringe too: that makes the flow exact.
                Condition::Velocity { .. } if owned => {
                    let pulse: Complex64 = own_waves.iter().zip(&now.inflow.waves).map(|(w, a)| w * a).sum();
                    Some(-port.stride() * (now.inflow.steady * shape + pulse.re))
                }
                Condition::Velocity { .. } => None,
                _ if !zone.in_buffer => None,
                _ => {
                    let rho = rest_density + fluid.state.density_change[i];
                    let pushed = fluid.state.velocity[i] + dt * now.imposed / rho * fluid.missing_support(i);
                    let mut outward = pushed.dot(zone.normal);
                    if port.outlet.is_some() && outward < 0.0 {
                        // The traction beta rho |v| v / 2 on the cap, spread over the buffer, taken implicitly.
                        let slower =
                            outward / (1.0 + 0.5 * port.backflow_damping * outward.abs() * dt / length);
                        let loss = outward * outward - slower * slower;
                        now.sums.damped += 0.5 * fluid.state.mass[i] * loss;
                        outward = slower;
                    }
                    Some(outward * zone.normal)
                }
            };
            if let (true, Some(density_change)) = (zone.is_imposed, now.density_behind) {
                fluid.state.density_change[i] = density_change;
                fluid.state.density_rate[i] = 0.0;
            }
            if let Some(velocity) = velocity {
                fluid.set_velocity(i, velocity);
                let speed = velocity.length();
                // A speed that is no number stays, so that a broken run shows.
                top = if speed > top || speed.is_nan() { speed } else { top };
            }
            // The fringe counts: flow that comes in keeps the particles of the buffer half a spacing further in.
            if owned {
                let (mass, velocity) = (fluid.state.mass[i], fluid.state.velocity[i]);
                let (volume, outward) = (mass / rest_density, velocity.dot(zone.normal));
                now.sums.volume += volume;
                now.sums.moment += volume * outward;
                now.sums.kinetic += 0.5 * mass * velocity.length_squared() * outward;
                if port.outlet.is_some() {
                    now.sums.pressure += volume * fluid.acoustic_pressure(i);
                }
            }
        }
        for (port, Now { sums: sum, imposed, .. }) in self.ports.iter_mut().zip(&all) {
            port.counters.damped_energy += sum.damped;
            port.passed.time += dt;
            port.passed.volume += dt * sum.moment / length;
            port.passed.kinetic_energy += dt * sum.kinetic / length;
            if let (Some(outlet), true) = (&mut port.outlet, sum.volume > 0.0) {
                let buffer = Seen {
                    velocity: sum.moment / sum.volume,
                    section: sum.volume / length,
                    pressure: reference + sum.pressure / sum.volume,
                    imposed: reference + imposed,
                };
                outlet.follow(buffer, length, dt);
            }
        }
        self.now = all;
        top
    }

    /// Mean state of the openings at `t` \[s\]; needs [`Self::locate`] before it.
    pub fn measure(&self, state: &FluidState, t: f64) -> Vec<Reading> {
        let mut readings = Vec::new();
        self.measure_into(state, t, &mut readings);
        readings
    }

    /// The same into a list that is used again.
    pub fn measure_into(&self, state: &FluidState, t: f64, readings: &mut Vec<Reading>) {
        let (near, far) = (self.buffer_length(), self.buffer_length() + SECTION * self.spacing);
        let reference = self.reference_pressure(t);
        readings.clear();
        readings.resize(self.ports.len(), Reading::default());
        for (k, port) in self.ports.iter().enumerate() {
            let Passed { time, volume, kinetic_energy } = port.passed;
            if time > 0.0 {
                readings[k].flow = volume / time;
                readings[k].kinetic_power = kinetic_energy / time;
            }
            readings[k].outlet = port.outlet.as_ref().map(|o| o.state.outlet);
            readings[k].pressure = match self.pressure_value(k, t) {
                Some(pressure) => pressure,
                None => {
                    let (sum, n) = (0..state.len())
                        .filter(|&i| {
                            let x = state.position[i];
                            (near..far).contains(&port.opening.depth(x))
                                && port.lateral(x) < port.opening.radius
                        })
                        .fold((0.0, 0), |(sum, n), i| (sum + state.pressure[i], n + 1));
                    reference + sum / f64::from(n.max(1))
                }
            };
        }
    }
}

/// What holds at an opening in an acoustic step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Now {
    /// Pressure imposed, relative to the reference \[Pa\].
    imposed: f64,
    /// How much of each shape of its profile flows in \[m/s\].
    inflow: Amplitudes,
    /// See [`Openings::density_behind`].
    density_behind: Option<f64>,
    sums: Sums,
}

/// What is added up over the particles of a buffer in a step.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    /// Volume of those that belong to it \[m^3\].
    volume: f64,
    /// Their volume times velocity out of the vessel \[m^4/s\].
    moment: f64,
    /// Their volume times pressure, relative to the reference \[Pa m^3\].
    pressure: f64,
    /// Their kinetic energy times velocity out of the vessel \[J m/s\].
    kinetic: f64,
    /// Energy taken from those that come in \[J\].
    damped: f64,
}
