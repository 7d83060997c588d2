//! Viscous acceleration, and the sums with corrected gradients that read the same neighbours.

use crate::fluid::{Fluid, numbered};
use crate::frozen::{Frozen, distance_of, pack, widen};
use crate::law::near_wall::{self, NearWall};
use crate::law::offset::Offset;
use crate::law::thinning::{self, ThinningViscosity};
use crate::law::viscosity::{FLUID_SUMS, FluidViscosity, WALL_SUMS, WallViscosity};
use crate::rheology::shear_rate;
use crate::summation::pack_sym;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, Sym3, run_on, sweep, sweep_some};

impl<R: Real> Fluid<R> {
    /// Finds the viscous acceleration, the own-pressure and support sums, and the velocity gradient; needs
    /// [`Self::summation`] before it. With [`Numbers::rheology`](crate::Numbers::rheology)
    /// [`Self::shear_thinning`] has to follow, in any case [`Self::offsets`].
    pub fn viscosity(&mut self) {
        self.near_wall();
        self.note_for_wall();
        // The wall law wants the inverse distance where the other laws want the pressure.
        self.current
            .as_mut_slice()
            .par_iter_mut()
            .zip(&self.columns.inverse_distance)
            .with_min_len(1024)
            .for_each(|(record, inverse)| record[7] = *inverse);

        let gradient = self.kernel.gradient_scale();
        let support = self.kernel.support();
        let (mu, rho0, rheology) = (self.numbers.viscosity, self.numbers.rest_density, self.numbers.rheology);
        let (density_change, zone_of) = (&self.state.density_change, &self.zone_of);
        let (isa, frame) = (self.isa, &self.frame);
        let (current, second, wall) = (&self.current, &self.second, &self.wall);
        let fluid_gather = Gather {
            frame,
            own: current,
            other: current,
            own_second: Some(second),
            other_second: Some(second),
        };
        let wall_gather = Gather {
            frame,
            own: current,
            other: &wall.kinematic,
            own_second: Some(second),
            other_second: None,
        };
        let columns = &mut self.columns;
        (
            self.frozen.par_chunks_mut(CHUNK),
            columns.acceleration.par_chunks_mut(CHUNK),
            columns.support.par_chunks_mut(CHUNK),
            columns.inverse_distance.par_chunks(CHUNK),
            self.slope.par_chunks_mut(CHUNK),
            self.rows.chunks(),
            wall.fluid_rows.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (frozen, acceleration, supports, inverse, slopes, row, wall_row))| {
                let mut fluid = [[0.0; FLUID_SUMS]; CHUNK];
                let mut walls = [[0.0; WALL_SUMS]; CHUNK];
                sweep(isa, &FluidViscosity, &fluid_gather, numbered(row, c), Store::None, &mut fluid);
                if !wall_row.has_no_pairs() {
                    sweep(isa, &WallViscosity, &wall_gather, numbered(wall_row, c), Store::None, &mut walls);
                }
                run_on(
                    isa,
                    #[inline(always)]
                    || {
                        for k in 0..frozen.len() {
                            let (f, w, frozen) = (&fluid[k], &walls[k], &mut frozen[k]);
                            let rho = rho0 + density_change[c * CHUNK + k];
                            let depths = w[12] * distance_of(inverse[k]) + w[13];
                            let bend = slopes[k].x_axis;
                            let wall = DVec3::new(w[0], w[1], w[2]) - depths * bend;
                            let raw: [f64; 9] = std::array::from_fn(|q| gradient * (f[6 + q] + w[3 + q]));
                            let slope = velocity_gradient(&raw, frozen);
                            // Unevenly spaced neighbours would take a velocity that changes linearly for one that bends. Near caps
                            // it is the drag of the neighbours left that keeps particles together.
                            let lean = support * DVec3::new(f[15] + w[14], f[16] + w[15], f[17] + w[16]);
                            let is_inner = zone_of[c * CHUNK + k] == 0;
                            let wall = if is_inner { wall - slope.transpose() * lean } else { wall };
                            // With a law of the shear rate, what fluid pairs add is found anew once it is known.
                            acceleration[k] = pack(match rheology {
                                None => {
                                    -gradient * mu / (support * rho) * (DVec3::new(f[3], f[4], f[5]) + wall)
                                }
                                Some(_) => -gradient / (support * rho) * wall,
                            });
                            let neighbours = -gradient * DVec3::new(f[0], f[1], f[2]);
                            supports[k] = pack(frozen.set_own_pressure(neighbours));
                            slopes[k] = slope;
                            if is_inner {
                                frozen.set_false_convergence(false_convergence(&slope, frozen));
                            }
                        }
                    },
                );
            });
    }

    /// Finds how the velocity bends near the wall, the `b` of [`NearWall`] \[1/(m s)\]. It stands in the first column of the
    /// velocity gradient until that is found.
    fn near_wall(&mut self) {
        let support = self.kernel.support();
        self.slope.clear();
        self.slope.resize(self.state.len(), DMat3::ZERO);
        let columns = &self.columns;
        self.current
            .as_mut_slice()
            .par_iter_mut()
            .enumerate()
            .with_min_len(1024)
            .for_each(|(i, record)| record[7] = R::pack(columns.wall_distance(i) / support));
        let (isa, current, velocity) = (self.isa, &self.current, &self.state.velocity);
        let of_wall = self.moving.as_ref().map(|m| m.velocity.as_slice());
        let gather =
            Gather { frame: &self.frame, own: current, other: current, own_second: None, other_second: None };
        (self.slope.par_chunks_mut(CHUNK), self.rows.chunks(), self.wall.fluid_rows.chunks())
            .into_par_iter()
            .enumerate()
            .filter(|(_, (_, _, wall_row))| !wall_row.has_no_pairs())
            .for_each(|(c, (bend, row, wall_row))| {
                let mut sums = [[0.0; near_wall::SUMS]; CHUNK];
                let near = |k| !wall_row.is_row_empty(k);
                sweep_some(isa, &NearWall, &gather, numbered(row, c), Store::None, near, &mut sums);
                for k in (0..bend.len()).filter(|&k| !wall_row.is_row_empty(k)) {
                    let i = c * CHUNK + k;
                    let s = columns.wall_distance(i) / support;
                    let volume = current.as_slice()[i][3].widen();
                    near_wall::add_own(&mut sums[k], s, volume, velocity[i].to_array());
                    let wall = of_wall.map_or([0.0; 3], |v| v[i].to_array());
                    let b = near_wall::curvature(&sums[k], wall);
                    bend[k].x_axis = DVec3::from_array(b) / (support * support);
                }
            });
    }

    /// Finds the velocity offsets of all pairs from the velocity gradient of [`Self::viscosity`].
    pub fn offsets(&mut self) {
        let isa = self.isa;
        let (slope, half) = (&self.slope, 0.5 * self.kernel.support());
        self.second.fill(|i| pack_sym(&scaled_strain(&slope[i], half)));
        self.offsets.resize_for(self.rows.chunks());
        let gather = Gather {
            frame: &self.frame,
            own: &self.current,
            other: &self.current,
            own_second: Some(&self.second),
            other_second: Some(&self.second),
        };
        self.offsets.chunks_mut().par_iter_mut().zip(self.rows.chunks()).enumerate().for_each(
            |(c, (store, row))| {
                sweep(isa, &Offset, &gather, numbered(row, c), Store::Write(store), &mut [[]; CHUNK]);
            },
        );
    }
}

impl<R: Real> Fluid<R> {
    /// Completes the viscous acceleration where the viscosity follows the shear rate: adds that between fluid
    /// particles, and weighs that of the wall with the particle's own. Does nothing for Newtonian blood.
    pub fn shear_thinning(&mut self) {
        let Some(rheology) = self.numbers.rheology else { return };
        let support = self.kernel.support();
        let (gradient, rho0) = (self.kernel.gradient_scale(), self.numbers.rest_density);
        let viscosity = |slope: &DMat3| rheology.viscosity(shear_rate(&scaled_strain(slope, 1.0)));
        self.current.as_mut_slice().par_iter_mut().zip(&self.slope).with_min_len(1024).for_each(
            |(record, slope)| {
                let eta = viscosity(slope);
                record[7] = R::pack(1.0 / eta);
            },
        );
        let density_change = &self.state.density_change;
        let (isa, current, slope) = (self.isa, &self.current, &self.slope);
        let gather = Gather {
            frame: &self.frame,
            own: current,
            other: current,
            own_second: Some(&self.second),
            other_second: Some(&self.second),
        };
        (self.columns.acceleration.par_chunks_mut(CHUNK), self.rows.chunks())
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (acceleration, row))| {
                let mut sums = [[0.0; thinning::SUMS]; CHUNK];
                sweep(isa, &ThinningViscosity, &gather, numbered(row, c), Store::None, &mut sums);
                for (k, acceleration) in acceleration.iter_mut().enumerate() {
                    let i = c * CHUNK + k;
                    let eta = viscosity(&slope[i]);
                    let rho = rho0 + density_change[i];
                    let drag = -gradient / (support * rho) * DVec3::from_array(sums[k]);
                    *acceleration = pack(eta * widen(*acceleration) + drag);
                }
            });
    }
}

/// Corrected velocity gradient \[1/s\], column by column those of the components; `raw` is `sum V (v_j - v_i) (x) grad W`.
#[inline(always)]
fn velocity_gradient<R: Real>(raw: &[f64; 9], frozen: &Frozen<R>) -> DMat3 {
    let correction = frozen.correction();
    let row = |r: usize| correction.mul(DVec3::new(raw[3 * r], raw[3 * r + 1], raw[3 * r + 2]));
    DMat3::from_cols(row(0), row(1), row(2))
}

/// Symmetric part of a velocity gradient, times `scale`.
pub(crate) fn scaled_strain(g: &DMat3, scale: f64) -> [f64; 6] {
    let sym = |a: usize, b: usize| 0.5 * scale * (g.col(a)[b] + g.col(b)[a]);
    [sym(0, 0), sym(1, 1), sym(2, 2), sym(0, 1), sym(0, 2), sym(1, 2)]
}

/// Convergence \[1/s\] that the uncorrected sum over fluid neighbours finds in the part of a velocity gradient that changes no volume.
///
/// Within reach of the wall, that is what shears along it and in its plane: a flow towards the wall converges among the fluid,
/// and the sum over the wall takes it back.
#[inline(always)]
fn false_convergence<R: Real>(g: &DMat3, frozen: &Frozen<R>) -> f64 {
    let Sym3(m) = &frozen.fluid_moment();
    let mut d = Sym3(scaled_strain(g, 1.0));
    let trace = d.0[0] + d.0[1] + d.0[2];
    let (mut isotropic, n) = (trace / 3.0, frozen.wall_normal());
    if n != DVec3::ZERO {
        let to_wall = n.dot(d.mul(n));
        isotropic = 0.5 * (trace - to_wall);
        let along_normal = to_wall - isotropic;
        let squares = [n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.x * n.z, n.y * n.z];
        d.0.iter_mut().zip(squares).for_each(|(d, square)| *d -= along_normal * square);
    }
    let normal: f64 = (0..3).map(|q| (d.0[q] - isotropic) * m[q]).sum();
    let shear: f64 = (3..6).map(|q| d.0[q] * m[q]).sum();
    -(normal + 2.0 * shear)
}
