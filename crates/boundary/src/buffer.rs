//! Bidirectional buffers: fluid enters and leaves through a slab of four spacings behind each cap.
//!
//! After Zhang, Fan, Wu, Zhang, Hu (2024): a particle owned by a buffer that moves out of it into
//! the vessel leaves a copy behind and is itself set back by the length of the buffer; one that
//! crosses the cap is removed. Both happen at every opening, so flow may reverse.

use crate::profile::Profile;
use crate::waveform::Signal;
use glam::DVec3;
use rayon::prelude::*;
use vaso_fluid::{CapZone, Fluid, FluidState, Numbers, Real};
use vaso_geometry::Opening;
use vaso_particles::visit;

/// Length of a buffer, in spacings.
pub const BUFFER_LENGTH: f64 = 4.0;
/// Distance beyond the buffer, in spacings, over which its particles stay its own: without it a
/// particle moving to and fro would be copied at every turn, and none at all while the label is
/// taken away at the edge.
const FRINGE: f64 = 0.5;
/// Bounds of the factor that makes the injected flow the asked one.
const FLOW_FACTOR: (f64, f64) = (0.8, 1.25);

/// What is imposed at an opening.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// Mean velocity into the vessel \[m/s\] with a shape over the section.
    Velocity {
        /// Shape over the section.
        profile: Profile,
        /// Section mean, positive into the vessel \[m/s\].
        mean: Signal,
    },
    /// Pressure at the cap \[Pa\].
    Pressure {
        /// Pressure over time \[Pa\].
        value: Signal,
    },
}

/// What went through an opening since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counters {
    /// Particles put in.
    pub injected: u64,
    /// Particles taken out.
    pub deleted: u64,
    /// Of those, particles the buffer did not own.
    pub strays: u64,
    /// Volume that left the vessel, at rest density \[m^3\].
    pub outflow_volume: f64,
}

/// One opening of a run.
#[derive(Clone, Debug)]
pub struct Port {
    /// Cap of the vessel.
    pub opening: Opening,
    /// What is imposed there.
    pub condition: Condition,
    /// What went through.
    pub counters: Counters,
    /// Factor on the imposed velocity of this step.
    flow_factor: f64,
}

/// What the pressure of the fluid is relative to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reference {
    /// The same at all times \[Pa\].
    Fixed(f64),
    /// The pressure imposed at an opening.
    Opening(usize),
}

/// All openings of a run.
#[derive(Clone, Debug)]
pub struct Openings {
    ports: Vec<Port>,
    numbers: Numbers,
    spacing: f64,
    next_id: u64,
    reference: Reference,
    zones: Vec<CapZone>,
    /// Unit-mean profile value at each zone entry.
    shape: Vec<f64>,
}

impl Openings {
    /// Openings with their conditions, for a fluid of given numbers.
    ///
    /// Without a fixed `reference_pressure` \[Pa\] that of the first pressure opening is followed: it
    /// does no work on a rigid lumen, so the equation of state need not carry it.
    pub fn new(ports: Vec<(Opening, Condition)>, numbers: &Numbers, reference_pressure: Option<f64>) -> Self {
        let ports: Vec<Port> = ports
            .into_iter()
            .map(|(opening, condition)| Port {
                opening,
                condition,
                counters: Counters::default(),
                flow_factor: 1.0,
            })
            .collect();
        let outlet = || ports.iter().position(|p| matches!(p.condition, Condition::Pressure { .. }));
        let reference = match reference_pressure {
            Some(pressure) => Reference::Fixed(pressure),
            None => outlet().map_or(Reference::Fixed(0.0), Reference::Opening),
        };
        Self {
            ports,
            numbers: *numbers,
            spacing: numbers.spacing,
            next_id: 0,
            reference,
            zones: Vec::new(),
            shape: Vec::new(),
        }
    }

    /// The openings.
    pub fn ports(&self) -> &[Port] {
        &self.ports
    }

    /// Identity the next new particle will get.
    pub fn next_id(&self) -> u64 {
        self.next_id
    }

    /// Particles near caps, as [`Self::locate`] found them.
    pub fn zones(&self) -> &[CapZone] {
        &self.zones
    }

    /// Reference pressure at `t` \[s\], which the fluid's pressure is relative to \[Pa\].
    pub fn reference_pressure(&self, t: f64) -> f64 {
        match self.reference {
            Reference::Fixed(pressure) => pressure,
            Reference::Opening(k) => self.pressure_value(k, t).unwrap_or(0.0),
        }
    }

    /// Pressure imposed at opening `k` at `t` \[s\], if it imposes one \[Pa\].
    pub fn pressure_value(&self, k: usize, t: f64) -> Option<f64> {
        match &self.ports[k].condition {
            Condition::Pressure { value } => Some(value.at(t)),
            Condition::Velocity { .. } => None,
        }
    }

    fn buffer_length(&self) -> f64 {
        BUFFER_LENGTH * self.spacing
    }

    /// Labels the particles in the buffers at the start of a run.
    pub fn start(&mut self, state: &mut FluidState) {
        self.next_id = state.id.iter().max().map_or(0, |id| id + 1);
        self.label(state);
    }

    /// Copies particles that leave a buffer inwards, removes those that leave the vessel, and labels
    /// the buffers anew. `t` \[s\] is the time of the state. The order of particles changes.
    pub fn exchange(&mut self, state: &mut FluidState, t: f64) {
        let Numbers { sound_speed, rest_density, .. } = self.numbers;
        let length = self.buffer_length();
        let fringe = FRINGE * self.spacing;
        let reference = self.reference_pressure(t);
        for i in 0..state.len() {
            let Ok(k) = usize::try_from(state.opening[i]) else { continue };
            let imposed = self.pressure_value(k, t);
            let port = &mut self.ports[k];
            if port.opening.depth(state.position[i]) <= length + fringe {
                continue;
            }
            visit::append_copy(state, i);
            let copy = state.len() - 1;
            state.opening[copy] = FluidState::NO_OPENING;
            state.id[copy] = state.id[i];
            state.id[i] = self.next_id;
            self.next_id += 1;
            state.position[i] += length * port.opening.normal;
            if let Some(pressure) = imposed {
                state.density_change[i] = (pressure - reference) / (sound_speed * sound_speed);
            }
            port.counters.injected += 1;
            port.counters.outflow_volume -= state.mass[i] / rest_density;
        }
        let mut leaving: Vec<(usize, usize)> = {
            let this = &*self;
            state
                .position
                .par_iter()
                .enumerate()
                .with_min_len(4096)
                .filter_map(|(i, &x)| this.left_through(x).map(|k| (i, k)))
                .collect()
        };
        leaving.sort_unstable_by_key(|l| std::cmp::Reverse(l.0));
        for (i, k) in leaving {
            let counters = &mut self.ports[k].counters;
            counters.deleted += 1;
            counters.strays += u64::from(state.opening[i] != k as i32);
            counters.outflow_volume += state.mass[i] / rest_density;
            visit::swap_remove(state, i);
        }
        self.label(state);
    }

    /// Opening through which a particle at `x` has left, if any.
    fn left_through(&self, x: DVec3) -> Option<usize> {
        self.ports.iter().position(|port| {
            let s = port.opening.depth(x);
            s < 0.0 && s > -self.buffer_length() && port.opening.lateral(x) < self.spacing
        })
    }

    fn label(&self, state: &mut FluidState) {
        let (length, fringe) = (self.buffer_length(), FRINGE * self.spacing);
        (state.opening.par_iter_mut(), state.position.par_iter())
            .into_par_iter()
            .with_min_len(4096)
            .for_each(|(label, &x)| {
                let before = *label;
                *label = FluidState::NO_OPENING;
                let mut nearest = self.spacing;
                for (k, port) in self.ports.iter().enumerate() {
                    let s = port.opening.depth(x);
                    let reach = if before == k as i32 { length + fringe } else { length };
                    if (0.0..=reach).contains(&s) {
                        let lateral = port.opening.lateral(x);
                        if lateral < nearest {
                            nearest = lateral;
                            *label = k as i32;
                        }
                    }
                }
            });
    }

    /// Finds the particles near caps, after the fluid has been sorted.
    pub fn locate(&mut self, state: &FluidState) {
        let length = self.buffer_length();
        // Particles in the fringe still carry the label of the buffer, and its flow.
        let reach = (length + FRINGE * self.spacing).max(2.0 * self.numbers.smoothing_length);
        let ports = &self.ports;
        let spacing = self.spacing;
        self.zones.clear();
        self.zones.par_extend(state.position.par_iter().enumerate().with_min_len(4096).filter_map(
            |(i, &x)| {
                let near = ports.iter().enumerate().filter_map(|(k, port)| {
                    let s = port.opening.depth(x);
                    if !(-length..reach).contains(&s) {
                        return None;
                    }
                    let lateral = port.opening.lateral(x);
                    (lateral < spacing).then_some((lateral, k, s))
                });
                let (_, k, s) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
                Some(CapZone {
                    particle: i as u32,
                    opening: k as u32,
                    normal: ports[k].opening.normal,
                    in_buffer: s <= length,
                })
            },
        ));
        self.shape.clear();
        let zones = &self.zones;
        self.shape.par_extend(zones.par_iter().with_min_len(256).map(|zone| {
            let port = &ports[zone.opening as usize];
            match &port.condition {
                Condition::Velocity { profile, .. } => profile
                    .at(port.opening.project(state.position[zone.particle as usize]), &port.opening.polygon),
                Condition::Pressure { .. } => 0.0,
            }
        }));
        self.scale_flow(state);
    }

    /// The flow that is injected is that of the labelled particles, `sum u V / L_b`; scale it to the asked one.
    fn scale_flow(&mut self, state: &FluidState) {
        let (length, rest_density) = (self.buffer_length(), self.numbers.rest_density);
        for (k, port) in self.ports.iter_mut().enumerate() {
            let Condition::Velocity { .. } = port.condition else { continue };
            let carried: f64 = self
                .zones
                .iter()
                .zip(&self.shape)
                .filter(|(zone, _)| state.opening[zone.particle as usize] == k as i32)
                .map(|(zone, shape)| shape * state.mass[zone.particle as usize] / rest_density)
                .sum();
            let factor = if carried > 0.0 { port.opening.area * length / carried } else { 1.0 };
            port.flow_factor = factor.clamp(FLOW_FACTOR.0, FLOW_FACTOR.1);
        }
    }

    /// Imposes the conditions on the buffers after the kick of an acoustic step of `dt` \[s\] that
    /// ends at `t` \[s\]. Returns the top speed in the buffers \[m/s\].
    ///
    /// A pressure enters through the missing kernel support; along the cap the velocity is removed,
    /// since nothing outside could drive it.
    pub fn apply<R: Real>(&self, fluid: &mut Fluid<R>, t: f64, dt: f64) -> f64 {
        let reference = self.reference_pressure(t);
        let rest_density = self.numbers.rest_density;
        let imposed: Vec<f64> = self
            .ports
            .iter()
            .map(|port| match &port.condition {
                Condition::Velocity { mean, .. } => mean.at(t) * port.flow_factor,
                Condition::Pressure { value } => value.at(t) - reference,
            })
            .collect();
        let mut top: f64 = 0.0;
        for (zone, shape) in self.zones.iter().zip(&self.shape) {
            let (i, k) = (zone.particle as usize, zone.opening as usize);
            let velocity = match self.ports[k].condition {
                // Whatever the buffer owns moves as asked, the fringe too: that makes the flow exact.
                Condition::Velocity { .. } if fluid.state.opening[i] == k as i32 => {
                    -zone.normal * (imposed[k] * shape)
                }
                Condition::Velocity { .. } => continue,
                Condition::Pressure { .. } if !zone.in_buffer => continue,
                Condition::Pressure { .. } => {
                    let rho = rest_density + fluid.state.density_change[i];
                    let pushed = fluid.state.velocity[i] + dt * imposed[k] / rho * fluid.missing_support(i);
                    pushed.dot(zone.normal) * zone.normal
                }
            };
            fluid.set_velocity(i, velocity, dt);
            top = top.max(velocity.length());
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

/// Length of the section inside a velocity buffer over which the pressure is averaged, in
/// spacings. The buffer itself carries no meaningful pressure.
const SECTION: f64 = 4.0;

/// Mean state of an opening.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Flow out of the vessel at rest density, averaged over the particles the buffer owns \[m^3/s\].
    pub flow: f64,
    /// The imposed pressure, or else the mean over a section just inside the buffer \[Pa\].
    pub pressure: f64,
}
