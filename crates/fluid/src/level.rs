//! Holds the mean density at what the mass in the vessel says.

use crate::cap::CapZone;
use crate::fluid::{Fluid, first_of};
use rayon::prelude::*;
use std::ops::Add;
use vaso_kernels::{CHUNK, Real, sum_in_order};

/// Sums over particles that give the means of a vessel.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sums {
    /// Mass outside the buffers \[kg\].
    mass: f64,
    /// The same times the density change \[kg^2/m^3\].
    change: f64,
    /// Mass, in the buffers by its share \[kg\].
    held: f64,
    /// The same times the density change \[kg^2/m^3\].
    held_change: f64,
}

impl Add for Sums {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            change: self.change + other.change,
            held: self.held + other.held,
            held_change: self.held_change + other.held_change,
        }
    }
}

impl<R: Real> Fluid<R> {
    /// Sums over all particles, where the mean density is held.
    pub(crate) fn sums_to_hold(&self, zones: &[CapZone]) -> Option<Sums> {
        (self.numbers.hold_mass && self.moving.is_none()).then(|| self.sums(zones))
    }

    /// Takes the mean of what the kernel sums brought since `before` back, and blends the mean density towards the mass in the vessel
    /// instead.
    ///
    /// The kernel sum of an uneven set is larger than that of an even one of the same number, and how even a set is changes with the
    /// beat: taken at its word, the vessel would swallow and give back blood.
    pub(crate) fn hold_mean(&mut self, before: Sums, zones: &[CapZone]) {
        if before.mass <= 0.0 || before.held <= 0.0 {
            return;
        }
        let after = self.sums(zones);
        let mean = before.held_change / before.held;
        let rho0 = self.numbers.rest_density;
        let capacity = *self.capacity.get_or_insert(before.held / (rho0 + mean));
        let lacking = before.held / capacity - rho0 - mean;
        let brought = (after.change - before.change) / before.mass;
        let rise = self.part * self.numbers.density_blend * lacking - brought;
        let zone_of = &self.zone_of;
        self.state.density_change.par_iter_mut().enumerate().with_min_len(4096).for_each(|(i, change)| {
            if !in_buffer(zones, zone_of[i]) {
                *change += rise;
            }
        });
    }

    fn sums(&self, zones: &[CapZone]) -> Sums {
        let n = self.state.len();
        let state = &self.state;
        sum_in_order((0..n.div_ceil(CHUNK)).into_par_iter().map(|c| {
            let mut sums = Sums::default();
            for i in first_of(c)..n.min(first_of(c + 1)) {
                let zone = self.zone_of[i];
                let share = if zone == 0 { 1.0 } else { zones[zone as usize - 1].share };
                let (mass, change) = (state.mass[i], state.density_change[i]);
                sums.held += share * mass;
                sums.held_change += share * mass * change;
                if !in_buffer(zones, zone) {
                    sums.mass += mass;
                    sums.change += mass * change;
                }
            }
            sums
        }))
    }
}

/// Whether a particle with this entry in the list of zones is in a buffer.
pub(crate) fn in_buffer(zones: &[CapZone], zone: u32) -> bool {
    zone != 0 && zones[zone as usize - 1].in_buffer
}
