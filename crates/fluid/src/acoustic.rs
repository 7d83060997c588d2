//! The acoustic step: position Verlet with the configuration frozen (drift, kick, drift).

use crate::fluid::{FAR, Fluid, maximum, numbered, propagating_max};
use crate::law::density::{CapDivergence, Divergence, DivergenceBesideWall, PARTS};
use crate::law::pressure::{self, FluidPressure, WallPressureForce};
use crate::law::wall_pressure::WallPressure;
use crate::moving::{AtRest, Wall};
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, sweep};

/// Share of the pressure jump of the Riemann state that density diffuses by.
///
/// All of it takes away the highest frequency of the density by 1.9 times what there is in a step, on a lattice and at a
/// Courant number of 0.6: it rings, and where particles are crowded by a few per cent it grows, above 2. With half of it, at
/// 100 m/s, particles at the rim of a cap that is cut obliquely reach 0.5 m/s instead of 0.3.
const DIFFUSION: f64 = 0.75;

impl<R: Real> Fluid<R> {
    /// Advective step \[s\] the fluid asks for now.
    pub fn advective_step(&self) -> f64 {
        let n = self.state.len();
        let speed = self.top_speed();
        let acceleration = maximum(n, |i| self.frozen[i].acceleration.length_squared()).sqrt();
        self.numbers.advective_step(speed, acceleration)
    }

    /// Largest speed of a particle \[m/s\]; NaN if any is.
    pub fn top_speed(&self) -> f64 {
        maximum(self.state.len(), |i| self.state.velocity[i].length_squared()).sqrt()
    }

    /// Largest deviation of the density from rest, relative; NaN if any is.
    pub fn top_density_error(&self) -> f64 {
        maximum(self.state.len(), |i| self.state.density_change[i].abs()) / self.numbers.rest_density
    }

    /// First half of an acoustic step `dt` \[s\]: density and position to the middle, pressure from the density.
    pub fn begin_acoustic(&mut self, dt: f64) {
        self.elapsed = 0.0;
        let frozen = &self.frozen;
        self.second.fill(|i| {
            let [x, y, z] = frozen[i].wall_normal.to_array().map(R::pack);
            let (zero, near_cap) = (R::pack(0.0), R::pack(f64::from(frozen[i].cap_depth < FAR)));
            [x, y, z, near_cap, zero, zero, zero, zero]
        });
        let numbers = self.numbers;
        let state = &mut self.state;
        (
            self.current.as_mut_slice().par_iter_mut(),
            state.position.par_iter_mut(),
            state.density_change.par_iter_mut(),
            state.velocity.par_iter(),
            state.density_rate.par_iter(),
        )
            .into_par_iter()
            .with_min_len(1024)
            .for_each(|(record, position, density_change, velocity, rate)| {
                *density_change += 0.5 * dt * rate;
                *position += 0.5 * dt * *velocity;
                record[7] = R::pack(numbers.pressure(*density_change));
            });
    }

    /// Gives every wall particle the kernel mean of the fluid pressure around it.
    pub fn wall_pressure(&mut self) {
        if self.moving.is_some() {
            return self.moving_wall_pressure();
        }
        let (isa, frame) = (self.isa, &self.frame);
        let wall = &mut self.wall;
        let (current, kinematic) = (&self.current, &wall.kinematic);
        let gather = Gather { frame, own: kinematic, other: current, own_second: None, other_second: None };
        wall.dynamic
            .as_mut_slice()
            .par_chunks_mut(CHUNK)
            .zip(wall.wall_rows.chunks())
            .enumerate()
            .filter(|(_, (_, row))| !row.has_no_pairs())
            .for_each(|(c, (records, row))| {
                let mut sums = [[0.0; 2]; CHUNK];
                sweep(isa, &WallPressure, &gather, numbered(row, c), Store::None, &mut sums);
                for (record, [weighted, weight]) in records.iter_mut().zip(sums) {
                    record[7] = R::pack(if weight > 0.0 { weighted / weight } else { 0.0 });
                }
            });
    }

    /// Kicks all velocities by pressure and viscosity over `dt` \[s\] and drifts positions to the
    /// end of the step. Returns the top speed \[m/s\].
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
        let share = dt / self.elapsed;
        let numbers = self.numbers;
        let rho0 = numbers.rest_density;
        let impedance = rho0 * numbers.sound_speed;
        let gradient = self.kernel.gradient_scale();
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
        let density_change = &state.density_change;
        let next_records = self.next.as_mut_slice();
        let top = (
            state.velocity.par_chunks_mut(CHUNK),
            state.position.par_chunks_mut(CHUNK),
            state.density_rate.par_chunks_mut(CHUNK),
            state.pressure.par_chunks_mut(CHUNK),
            next_records.par_chunks_mut(CHUNK),
            self.frozen.par_chunks(CHUNK),
            self.rows.chunks(),
            wall.fluid_rows.chunks(),
            self.offsets.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .map(|(c, (velocity, position, rate, mean, next, frozen, row, wall_row, offsets))| {
                let mut fluid = [[0.0; pressure::FLUID_SUMS]; CHUNK];
                let mut walls = [[0.0; pressure::WALL_SUMS]; CHUNK];
                let (numbered_row, stored) = (numbered(row, c), Store::Read(offsets));
                if frozen.iter().any(|f| f.cap_depth < FAR) {
                    sweep(isa, &beside_cap, &fluid_gather, numbered_row, stored, &mut fluid);
                } else {
                    sweep(isa, &law, &fluid_gather, numbered_row, stored, &mut fluid);
                }
                if !wall_row.has_no_pairs() {
                    sweep(
                        isa,
                        &WallPressureForce,
                        &wall_gather,
                        numbered(wall_row, c),
                        Store::None,
                        &mut walls,
                    );
                }
                let mut top = 0.0;
                for k in 0..velocity.len() {
                    let i = c * CHUNK + k;
                    let (f, w, frozen) = (&fluid[k], &walls[k], &frozen[k]);
                    let change = density_change[i];
                    let rho = rho0 + change;
                    let neighbours = DVec3::new(f[0] + w[0], f[1] + w[1], f[2] + w[2]);
                    let pressure = numbers.pressure(change);
                    mean[k] += share * (pressure - mean[k]);
                    let pressure_force =
                        gradient * frozen.correction.mul(neighbours) - pressure * frozen.own_pressure;
                    let dissipation = gradient * DVec3::new(f[3], f[4], f[5]);
                    let wall_force = along.dissipation(i, velocity[k], frozen, &numbers);
                    let acceleration =
                        (pressure_force + dissipation + wall_force) / rho + frozen.acceleration;
                    let v = velocity[k] + dt * acceleration;
                    velocity[k] = v;
                    position[k] += 0.5 * dt * v;
                    rate[k] = -DIFFUSION * gradient * rho / impedance * f[6];
                    next[k] = current.as_slice()[i];
                    next[k][4] = R::pack(v.x);
                    next[k][5] = R::pack(v.y);
                    next[k][6] = R::pack(v.z);
                    next[k][7] = R::pack(frozen.cap_depth);
                    top = propagating_max(top, v.length_squared());
                }
                top
            })
            .reduce(|| 0.0, propagating_max);
        top.sqrt()
    }

    /// Second half of an acoustic step `dt` \[s\]: the density follows the divergence of the new
    /// velocity. Where another step of `dt_next` follows, its first half is taken along.
    pub fn continuity(&mut self, dt: f64, dt_next: Option<f64>) {
        match self.moving.take() {
            None => self.continuity_along(&AtRest, dt, dt_next),
            Some(moving) => {
                self.continuity_along(&*moving, dt, dt_next);
                self.moving = Some(moving);
            }
        }
    }

    fn continuity_along(&mut self, along: &impl Wall, dt: f64, dt_next: Option<f64>) {
        let numbers = self.numbers;
        let gradient = self.kernel.gradient_scale();
        let (isa, frame) = (self.isa, &self.frame);
        let sharpness = self.kernel.support() / numbers.spacing;
        let next = &self.next;
        let gather =
            Gather { frame, own: next, other: next, own_second: Some(&self.second), other_second: None };
        let state = &mut self.state;
        let velocity = &state.velocity;
        (
            state.density_change.par_chunks_mut(CHUNK),
            state.density_rate.par_chunks_mut(CHUNK),
            state.position.par_chunks_mut(CHUNK),
            self.current.as_mut_slice().par_chunks_mut(CHUNK),
            self.frozen.par_chunks(CHUNK),
            self.rows.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (density_change, rate, position, current, frozen, row))| {
                let mut parts = [[0.0; PARTS]; CHUNK];
                let row = numbered(row, c);
                if frozen.iter().any(|f| f.cap_depth < FAR) {
                    let law = CapDivergence { sharpness };
                    sweep(isa, &law, &gather, row, Store::None, &mut parts);
                } else if frozen.iter().any(|f| f.along_wall > 1.0) {
                    sweep(isa, &DivergenceBesideWall, &gather, row, Store::None, &mut parts);
                } else {
                    let mut sums = [[0.0; 1]; CHUNK];
                    sweep(isa, &Divergence, &gather, row, Store::None, &mut sums);
                    parts.iter_mut().zip(sums).for_each(|(parts, [sum])| parts[0] = sum);
                }
                for k in 0..density_change.len() {
                    let i = c * CHUNK + k;
                    let v = velocity[i];
                    let rho = numbers.rest_density + density_change[k];
                    let to_wall = along.convergence(i, v, &frozen[k]);
                    let [all, normal] = parts[k];
                    let among = frozen[k].along_wall * (all - normal) + normal;
                    let convergence = to_wall - gradient * among - frozen[k].false_convergence;
                    rate[k] += rho * convergence;
                    density_change[k] += 0.5 * dt * rate[k];
                    if let Some(dt) = dt_next {
                        density_change[k] += 0.5 * dt * rate[k];
                        position[k] += 0.5 * dt * v;
                        let record = &mut current[k];
                        record[4] = R::pack(v.x);
                        record[5] = R::pack(v.y);
                        record[6] = R::pack(v.z);
                        record[7] = R::pack(numbers.pressure(density_change[k]));
                    }
                }
            });
    }
}
