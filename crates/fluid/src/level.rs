//! Blends the density towards the kernel sum, and its mean towards the number of particles.

use crate::cap::CapZone;
use crate::fluid::{Fluid, first_of};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real};

/// Sums over particles that give the means of a vessel.
#[derive(Clone, Copy, Default)]
struct Sums {
    /// Mass outside the buffers \[kg\].
    mass: f64,
    /// The same times what the kernel sum exceeds the density by \[kg^2/m^3\].
    surplus: f64,
    /// Mass, in the buffers by its share \[kg\].
    held: f64,
    /// The same times the density change \[kg^2/m^3\].
    change: f64,
}

impl Sums {
    fn plus(self, other: Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            surplus: self.surplus + other.surplus,
            held: self.held + other.held,
            change: self.change + other.change,
        }
    }
}

impl<R: Real> Fluid<R> {
    /// `rho += omega (rho_sum - rho)` away from buffers, where `rho_sum` has the mean of the mass in the vessel if that is held.
    ///
    /// The kernel sum of an uneven set is larger than that of an even one of the same number, and how even a set is changes with the
    /// beat: taken at its word, the vessel would swallow and give back blood.
    pub(crate) fn blend(&mut self, zones: &[CapZone]) {
        let omega = self.numbers.density_blend;
        let level = if self.numbers.hold_mass && self.moving.is_none() { self.level(zones) } else { 0.0 };
        let (zone_of, surplus) = (&self.zone_of, &self.surplus);
        self.state.density_change.par_iter_mut().enumerate().with_min_len(4096).for_each(|(i, change)| {
            if !in_buffer(zones, zone_of[i]) {
                *change += omega * (surplus[i] + level);
            }
        });
    }

    /// What the kernel sums lack in the mean \[kg/m^3\].
    fn level(&mut self, zones: &[CapZone]) -> f64 {
        let n = self.state.len();
        let state = &self.state;
        // In chunks of fixed size and in their order: the same bits for any number of threads.
        let chunks: Vec<Sums> = (0..n.div_ceil(CHUNK))
            .into_par_iter()
            .with_min_len(16)
            .map(|c| {
                let mut sums = Sums::default();
                for i in first_of(c)..n.min(first_of(c + 1)) {
                    let zone = self.zone_of[i];
                    let share = if zone == 0 { 1.0 } else { zones[zone as usize - 1].share };
                    let mass = state.mass[i];
                    sums.held += share * mass;
                    sums.change += share * mass * state.density_change[i];
                    if !in_buffer(zones, zone) {
                        sums.mass += mass;
                        sums.surplus += mass * self.surplus[i];
                    }
                }
                sums
            })
            .collect();
        let sums = chunks.into_iter().fold(Sums::default(), Sums::plus);
        if sums.mass <= 0.0 || sums.held <= 0.0 {
            return 0.0;
        }
        let mean = sums.change / sums.held;
        let rho0 = self.numbers.rest_density;
        let capacity = *self.capacity.get_or_insert(sums.held / (rho0 + mean));
        let lacking = sums.held / capacity - rho0 - mean;
        lacking - sums.surplus / sums.mass
    }
}

/// Whether a particle with this entry in the list of zones is in a buffer.
fn in_buffer(zones: &[CapZone], zone: u32) -> bool {
    zone != 0 && zones[zone as usize - 1].in_buffer
}
