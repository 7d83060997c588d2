//! The kick of an acoustic step: pressure, its dissipation and viscosity change the velocity.

use crate::fluid::{Fluid, numbered, propagating_max};
use crate::frozen::pack;
use crate::law::pressure::{FLUID_SUMS, FluidPressure, WALL_SUMS, WallPressureForce};
use crate::moving::{AtRest, Wall};
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, run_on, sweep};

/// Share of the pressure jump of the Riemann state that density diffuses by.
///
/// All of it takes away the highest frequency of the density by 1.9 times what there is in a step, on a lattice and at a
/// Courant number of 0.6: it rings, and where particles are crowded by a few per cent it grows, above 2. With half of it, at
/// 100 m/s, particles at the rim of a cap that is cut obliquely reach 0.5 m/s instead of 0.3.
const DIFFUSION: f64 = 0.75;

impl<R: Real> Fluid<R> {
    /// Kicks all velocities by pressure and viscosity over `dt` \[s\]. Returns the top speed \[m/s\].
    pub fn kick(&mut self, dt: f64) -> f64 {
        match self.moving.take() {
            None => self.kick_along(&AtRest, dt),
            Some(moving) => {
                let top = self.kick_along(&*moving, dt);
                self.moving = Some(moving);
                top
            }
        }
    }

    fn kick_along(&mut self, along: &impl Wall, dt: f64) -> f64 {
        self.elapsed += dt;
        let numbers = self.numbers;
        let (share, rho0) = (dt / self.elapsed, numbers.rest_density);
        let gradient = self.kernel.gradient_scale();
        let diffusion = -DIFFUSION * gradient / (rho0 * numbers.sound_speed);
        let (limiter, sound_speed) = (numbers.dissipation_limiter, numbers.sound_speed);
        let law = FluidPressure::<false> { limiter, sound_speed, rest_density: rho0 };
        let beside_cap = FluidPressure::<true> { limiter, sound_speed, rest_density: rho0 };
        let (isa, frame) = (self.isa, &self.frame);
        let (current, wall) = (&self.current, &self.wall);
        let second = Some(&self.second);
        let fluid_gather =
            Gather { frame, own: current, other: current, own_second: second, other_second: second };
        let wall_gather =
            Gather { frame, own: current, other: &wall.dynamic, own_second: None, other_second: None };
        let state = &mut self.state;
        let top = (
            state.velocity.par_chunks_mut(CHUNK),
            state.density_rate.par_chunks_mut(CHUNK),
            state.pressure.par_chunks_mut(CHUNK),
            self.next.as_mut_slice().par_chunks_mut(CHUNK),
            state.density_change.par_chunks(CHUNK),
            current.as_slice().par_chunks(CHUNK),
            self.for_momentum.par_chunks(CHUNK),
            self.rows.chunks(),
            wall.fluid_rows.chunks(),
            self.offsets.chunks(),
            &self.kinds,
        )
            .into_par_iter()
            .enumerate()
            .map(|(c, (velocity, rate, mean, next, change, record, frozen, row, wall_row, offsets, kind))| {
                let mut fluid = [[0.0; FLUID_SUMS]; CHUNK];
                let mut walls = [[0.0; WALL_SUMS]; CHUNK];
                let (row, stored) = (numbered(row, c), Store::Read(offsets));
                if kind.near_cap {
                    sweep(isa, &beside_cap, &fluid_gather, row, stored, &mut fluid);
                } else {
                    sweep(isa, &law, &fluid_gather, row, stored, &mut fluid);
                }
                if !wall_row.has_no_pairs() {
                    let row = numbered(wall_row, c);
                    sweep(isa, &WallPressureForce, &wall_gather, row, Store::None, &mut walls);
                }
                let mut top = 0.0;
                let columns =
                    velocity.iter_mut().zip(rate).zip(mean).zip(next).zip(change).zip(record).zip(frozen);
                run_on(
                    isa,
                    #[inline(always)]
                    || {
                        for (k, (columns, (f, w))) in columns.zip(fluid.iter().zip(&walls)).enumerate() {
                            let ((((((velocity, rate), mean), next), change), record), frozen) = columns;
                            let rho = rho0 + change;
                            let pressure = numbers.pressure(*change);
                            *mean += share * (pressure - *mean);
                            let neighbours = DVec3::new(f[0] + w[0], f[1] + w[1], f[2] + w[2]);
                            let pressure_force =
                                gradient * frozen.correct(neighbours) - pressure * frozen.own_pressure();
                            let dissipation = gradient * DVec3::new(f[3], f[4], f[5]);
                            let relative = *velocity - along.velocity(c * CHUNK + k);
                            let wall_force = frozen.dissipation(relative, &numbers);
                            let force = pressure_force + dissipation + wall_force;
                            let v = *velocity + (dt / rho) * force + dt * frozen.acceleration();
                            *velocity = v;
                            *rate = diffusion * rho * f[6];
                            let [x, y, z, volume, ..] = *record;
                            let [u, v, w] = pack(v);
                            *next = [x, y, z, volume, u, v, w, frozen.cap_depth];
                            top = propagating_max(top, velocity.length_squared());
                        }
                    },
                );
                top
            })
            .reduce(|| 0.0, propagating_max);
        top.sqrt()
    }
}
