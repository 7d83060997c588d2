//! Bidirectional buffers: fluid enters and leaves through a slab of four spacings behind each cap.
//!
//! After Zhang, Fan, Wu, Zhang, Hu (2024): a particle owned by a buffer that moves out of it into
//! the vessel leaves a copy behind and is itself set back by the length of the buffer; one that
//! crosses the cap is removed. Both happen at every opening, so flow may reverse.

use crate::openings::Openings;
use crate::port::Passed;
use crate::profile::{Amplitudes, Inlet};
use crate::room::Room;
use glam::DVec3;
use num_complex::Complex64;
use rayon::prelude::*;
use vaso_fluid::{CapZone, FluidState, Numbers};
use vaso_particles::visit;

/// Distance beyond the buffer, in spacings, over which its particles stay its own: without it a
/// particle moving to and fro would be copied at every turn, and none at all while the label is
/// taken away at the edge.
pub(crate) const FRINGE: f64 = 0.5;

impl Openings {
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
        self.rooms.iter_mut().for_each(Room::forget);
        for i in 0..state.len() {
            let Ok(k) = usize::try_from(state.opening[i]) else { continue };
            let imposed = self.pressure_value(k, t);
            let port = &mut self.ports[k];
            if port.opening.depth(state.position[i]) <= length + fringe {
                continue;
            }
            let normal = port.opening.normal;
            let (mut place, mut velocity) = (state.position[i] + length * port.stride(), state.velocity[i]);
            if port.condition.sets_pressure() {
                let room = self.rooms[k].see(&port.opening, k as i32, state);
                let Some((free, outward)) = room.take(place, velocity.dot(normal)) else {
                    // A crowd is one particle less.
                    state.opening[i] = FluidState::NO_OPENING;
                    continue;
                };
                place = free;
                velocity = outward * normal;
            }
            visit::append_copy(state, i);
            let copy = state.len() - 1;
            state.opening[copy] = FluidState::NO_OPENING;
            state.id[copy] = state.id[i];
            state.id[i] = self.next_id;
            self.next_id += 1;
            state.position[i] = place;
            state.velocity[i] = velocity;
            if let Some(pressure) = imposed {
                state.density_change[i] = (pressure - reference) / (sound_speed * sound_speed);
            }
            port.counters.injected += 1;
            port.counters.outflow_volume -= state.mass[i] / rest_density;
        }
        let mut leaving = std::mem::take(&mut self.found);
        leaving.find(state.len(), |i| self.left_through(state.position[i]).is_some());
        // From the end, so that what takes the place of one that leaves is none of them.
        for i in leaving.chosen().iter().rev().map(|&i| i as usize) {
            let Some(k) = self.left_through(state.position[i]) else { continue };
            let counters = &mut self.ports[k].counters;
            counters.deleted += 1;
            counters.strays += u64::from(state.opening[i] != k as i32);
            counters.outflow_volume += state.mass[i] / rest_density;
            visit::swap_remove(state, i);
        }
        self.found = leaving;
        self.label(state);
    }

    /// Opening through which a particle at `x` has left, if any.
    fn left_through(&self, x: DVec3) -> Option<usize> {
        self.ports.iter().position(|port| {
            let s = port.opening.depth(x);
            s < 0.0 && s > -self.buffer_length() && port.lateral(x) < self.spacing
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
                        let lateral = port.lateral(x);
                        if lateral < nearest {
                            nearest = lateral;
                            *label = k as i32;
                        }
                    }
                }
            });
    }

    /// Finds the particles near caps, after the fluid has been sorted; an advective step begins. `part` is that of a full one which
    /// the last one was.
    pub fn locate(&mut self, state: &FluidState, part: f64) {
        self.find_sections(state);
        let length = self.buffer_length();
        // Particles in the fringe still carry the label of the buffer, and its flow.
        let reach = (length + FRINGE * self.spacing).max(2.0 * self.numbers.smoothing_length);
        let ports = &self.ports;
        let spacing = self.spacing;
        let near = |i: usize| {
            let x = state.position[i];
            let near = ports.iter().enumerate().filter_map(|(k, port)| {
                let s = port.opening.depth(x);
                if !(-length..reach).contains(&s) {
                    return None;
                }
                let lateral = port.lateral(x);
                (lateral < spacing).then_some((lateral, k, s))
            });
            near.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let zone = |i: usize| {
            let (_, k, s) = near(i)?;
            // Where a particle comes in and counts for nothing yet, while its copy counts in full.
            let first = if ports[k].condition.sets_pressure() { 0.0 } else { FRINGE * spacing };
            Some(CapZone {
                particle: i as u32,
                opening: k as u32,
                normal: ports[k].opening.normal,
                depth: s,
                // Whatever the buffer owns moves as asked, see `apply`.
                is_imposed: state.opening[i] == k as i32 && !ports[k].condition.sets_pressure(),
                in_buffer: s <= length,
                takes_pressure: s <= length && ports[k].condition.sets_pressure(),
                share: ((s - first) / length).clamp(0.0, 1.0),
            })
        };
        self.zones.clear();
        let found = self.found.find(state.len(), |i| near(i).is_some());
        self.zones.extend(found.iter().filter_map(|&i| zone(i as usize)));
        self.shape_flow(state, part);
        self.ports.iter_mut().for_each(|port| port.passed = Passed::default());
    }

    /// Takes the profiles at the particles, and scales them: the flow that is injected is that of the labelled particles,
    /// `sum u V / L_b`, over the time in which they pass.
    fn shape_flow(&mut self, state: &FluidState, part: f64) {
        let (ports, zones) = (&self.ports, &self.zones);
        let place = |zone: &CapZone| {
            let port = &ports[zone.opening as usize];
            let x = state.position[zone.particle as usize];
            let at = port.opening.project(x + port.opening.depth(x) * port.stride());
            port.inlet.as_ref().map(|inlet| (inlet, at))
        };
        self.shape.clear();
        self.shape.par_extend(
            zones.par_iter().with_min_len(256).map(|z| place(z).map_or(0.0, |(inlet, at)| inlet.steady(at))),
        );
        self.waves.clear();
        for (inlet, at) in zones.iter().filter_map(place) {
            self.waves.extend(inlet.waves(at));
        }
        let (length, rest_density) = (self.buffer_length(), self.numbers.rest_density);
        for (carried, port) in self.carried.iter_mut().zip(&self.ports) {
            carried.steady = 0.0;
            carried.waves.clear();
            carried.waves.resize(port.inlet.as_ref().map_or(0, Inlet::n_waves), Complex64::ZERO);
        }
        let mut waves = self.waves.as_slice();
        for (zone, shape) in self.zones.iter().zip(&self.shape) {
            let Amplitudes { steady, waves: sums } = &mut self.carried[zone.opening as usize];
            let (own, rest) = waves.split_at(sums.len());
            waves = rest;
            let i = zone.particle as usize;
            if state.opening[i] == zone.opening as i32 {
                let volume = state.mass[i] / rest_density;
                *steady += shape * volume;
                sums.iter_mut().zip(own).for_each(|(sum, wave)| *sum += wave * volume);
            }
        }
        for (port, Amplitudes { steady, waves }) in self.ports.iter_mut().zip(&self.carried) {
            if let Some(inlet) = &mut port.inlet {
                inlet.scale(*steady, waves, port.opening.area * length, part);
            }
        }
    }
}
