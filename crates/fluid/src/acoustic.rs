//! The acoustic step: position Verlet with the configuration frozen (drift, kick, drift).

use crate::fluid::{Fluid, maximum, numbered};
use crate::frozen::{ChunkKind, ForContinuity, ForMomentum, pack};
use crate::law::wall_pressure::WallPressure;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, sweep};

impl<R: Real> Fluid<R> {
    /// Advective step \[s\] the fluid asks for now.
    pub fn advective_step(&self) -> f64 {
        let n = self.state.len();
        let speed = self.top_speed();
        let acceleration = maximum(n, |i| self.columns.acceleration(i).length_squared()).sqrt();
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
        let moves = self.moving.is_some();
        self.for_momentum.resize(frozen.len(), ForMomentum::default());
        self.for_continuity.resize(frozen.len(), ForContinuity::default());
        let columns = (
            &mut self.for_momentum,
            &mut self.for_continuity,
            self.second.as_mut_slice(),
            frozen,
            &self.columns.acceleration,
        );
        columns.into_par_iter().with_min_len(1024).for_each(
            |(momentum, continuity, second, frozen, acceleration)| {
                *momentum = ForMomentum::new(frozen, *acceleration, moves);
                *continuity = ForContinuity::new(frozen);
                let ([x, y, z], zero) = (pack(frozen.wall_normal()), R::default());
                *second = [x, y, z, R::pack(f64::from(frozen.is_near_cap())), zero, zero, zero, zero];
            },
        );
        self.kinds.clear();
        self.kinds.par_extend(frozen.par_chunks(CHUNK).map(ChunkKind::of));
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
}
