//! Imposes the conditions on the particles in the buffers, and reads what comes of it.

use crate::openings::Openings;
use crate::port::{Condition, Reading};
use vaso_fluid::{Fluid, FluidState, Real};

/// Length of the section inside a velocity buffer over which the pressure is averaged, in
/// spacings. The buffer itself carries no meaningful pressure.
const SECTION: f64 = 4.0;

impl Openings {
    /// Imposes the conditions on the buffers after the kick of an acoustic step of `dt` \[s\] that
    /// ends at `t` \[s\], and lets the outlet models follow. Returns the top speed in the buffers \[m/s\].
    ///
    /// A pressure enters through the missing kernel support; along the cap the velocity is removed,
    /// since nothing outside could drive it.
    pub fn apply<R: Real>(&mut self, fluid: &mut Fluid<R>, t: f64, dt: f64) -> f64 {
        let reference = self.reference_pressure(t);
        let (rest_density, length) = (self.numbers.rest_density, self.buffer_length());
        let imposed: Vec<f64> = (0..self.ports.len())
            .map(|k| match (&self.ports[k].condition, self.pressure_value(k, t)) {
                (Condition::Velocity { mean, .. }, _) => mean.at(t) * self.ports[k].flow_factor,
                (_, pressure) => pressure.unwrap_or(0.0) - reference,
            })
            .collect();
        let mut seen = vec![Seen::default(); self.ports.len()];
        let mut top: f64 = 0.0;
        for (zone, shape) in self.zones.iter().zip(&self.shape) {
            let (i, k) = (zone.particle as usize, zone.opening as usize);
            let port = &self.ports[k];
            let owned = fluid.state.opening[i] == k as i32;
            let velocity = match port.condition {
                // Whatever the buffer owns moves as asked, the fringe too: that makes the flow exact.
                Condition::Velocity { .. } if owned => -zone.normal * (imposed[k] * shape),
                Condition::Velocity { .. } => continue,
                _ if !zone.in_buffer => continue,
                _ => {
                    let rho = rest_density + fluid.state.density_change[i];
                    let pushed = fluid.state.velocity[i] + dt * imposed[k] / rho * fluid.missing_support(i);
                    let mut outward = pushed.dot(zone.normal);
                    if port.outlet.is_some() {
                        let mass = fluid.state.mass[i];
                        if outward < 0.0 {
                            // The traction beta rho |v| v / 2 on the cap, spread over the buffer, taken implicitly.
                            let damping = 0.5 * self.backflow_damping * outward.abs() * dt / length;
                            let slower = outward / (1.0 + damping);
                            seen[k].damped += 0.5 * mass * (outward * outward - slower * slower);
                            outward = slower;
                        }
                        if owned {
                            seen[k].volume += mass / rest_density;
                            seen[k].moment += mass / rest_density * outward;
                        }
                    }
                    outward * zone.normal
                }
            };
            fluid.set_velocity(i, velocity, dt);
            top = top.max(velocity.length());
        }
        for (port, seen) in self.ports.iter_mut().zip(&seen) {
            port.counters.damped_energy += seen.damped;
            if let (Some(outlet), true) = (&mut port.outlet, seen.volume > 0.0) {
                outlet.follow(seen.moment / seen.volume, seen.volume / length, length, dt);
            }
        }
        top
    }

    /// Mean state of the openings at `t` \[s\]; needs [`Self::locate`] before it.
    pub fn measure(&self, state: &FluidState, t: f64) -> Vec<Reading> {
        let (near, far) = (self.buffer_length(), self.buffer_length() + SECTION * self.spacing);
        let reference = self.reference_pressure(t);
        let mut readings: Vec<Reading> = vec![Reading::default(); self.ports.len()];
        for zone in &self.zones {
            let (i, k) = (zone.particle as usize, zone.opening as usize);
            if state.opening[i] != k as i32 {
                continue;
            }
            let volume = state.mass[i] / self.numbers.rest_density;
            readings[k].flow += volume * state.velocity[i].dot(zone.normal) / near;
        }
        for (k, port) in self.ports.iter().enumerate() {
            readings[k].outlet = port.outlet.as_ref().map(|o| o.state.outlet);
            readings[k].pressure = match self.pressure_value(k, t) {
                Some(pressure) => pressure,
                None => {
                    let (sum, n) = (0..state.len())
                        .filter(|&i| {
                            let x = state.position[i];
                            (near..far).contains(&port.opening.depth(x))
                                && port.opening.lateral(x) < port.opening.radius
                        })
                        .fold((0.0, 0), |(sum, n), i| {
                            (sum + self.numbers.pressure(state.density_change[i]), n + 1)
                        });
                    reference + sum / f64::from(n.max(1))
                }
            };
        }
        readings
    }
}

/// What the particles of a buffer show in a step.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// Volume of those that belong to it \[m^3\].
    volume: f64,
    /// Their volume times velocity out of the vessel \[m^4/s\].
    moment: f64,
    /// Energy taken from those that come in \[J\].
    damped: f64,
}
