//! Second half of an acoustic step: the density follows the divergence of the velocity.

use crate::fluid::{Fluid, numbered};
use crate::frozen::pack;
use crate::law::density::{CapDivergence, Divergence, DivergenceBesideWall, PARTS};
use crate::moving::{AtRest, Wall};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, run_on, sweep, sweep_some};

impl<R: Real> Fluid<R> {
    /// Second half of an acoustic step `dt` \[s\]: positions drift to its end and the density follows the divergence of the new
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
        let (half, half_next) = (0.5 * dt, dt_next.map(|dt| 0.5 * dt));
        let gradient = self.kernel.gradient_scale();
        let (isa, frame) = (self.isa, &self.frame);
        let sharpness = self.kernel.support() / numbers.spacing;
        let next = &self.next;
        let gather =
            Gather { frame, own: next, other: next, own_second: Some(&self.second), other_second: None };
        let state = &mut self.state;
        (
            state.density_change.par_chunks_mut(CHUNK),
            state.density_rate.par_chunks_mut(CHUNK),
            state.position.par_chunks_mut(CHUNK),
            self.current.as_mut_slice().par_chunks_mut(CHUNK),
            state.velocity.par_chunks(CHUNK),
            self.for_continuity.par_chunks(CHUNK),
            self.rows.chunks(),
            &self.kinds,
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (change, rate, position, current, velocity, frozen, row, kind))| {
                let mut parts = [[0.0; PARTS]; CHUNK];
                let row = numbered(row, c);
                if kind.near_cap {
                    let law = CapDivergence { sharpness };
                    sweep(isa, &law, &gather, row, Store::None, &mut parts);
                } else {
                    let mut sums = [[0.0; 1]; CHUNK];
                    if kind.beside_wall {
                        let near = |k: usize| frozen[k].is_beside_wall();
                        sweep_some(isa, &DivergenceBesideWall, &gather, row, Store::None, near, &mut parts);
                        let far = |k: usize| !frozen[k].is_beside_wall();
                        sweep_some(isa, &Divergence, &gather, row, Store::None, far, &mut sums);
                    } else {
                        sweep(isa, &Divergence, &gather, row, Store::None, &mut sums);
                    }
                    parts.iter_mut().zip(sums).for_each(|(parts, [sum])| parts[0] += sum);
                }
                let columns =
                    change.iter_mut().zip(rate).zip(position).zip(current).zip(velocity).zip(frozen);
                run_on(
                    isa,
                    #[inline(always)]
                    || {
                        for (k, (columns, [all, normal])) in columns.zip(parts).enumerate() {
                            let (((((change, rate), position), record), v), frozen) = columns;
                            let rho = numbers.rest_density + *change;
                            let to_wall = frozen.convergence(*v) + 2.0 * along.flux(c * CHUNK + k);
                            let among = frozen.along_wall() * (all - normal) + normal;
                            *rate += rho * (to_wall - gradient * among);
                            *change += half * *rate;
                            // No sum of an acoustic step asks where a particle has gone to.
                            *position += half * *v;
                            if let Some(half) = half_next {
                                *change += half * *rate;
                                *position += half * *v;
                                let [x, y, z, volume, ..] = *record;
                                let ([u, v, w], p) = (pack(*v), R::pack(numbers.pressure(*change)));
                                *record = [x, y, z, volume, u, v, w, p];
                            }
                        }
                    },
                );
            });
    }
}
