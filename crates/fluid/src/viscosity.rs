//! Viscous acceleration, and the sums with corrected gradients that read the same neighbours.

use crate::fluid::{Fluid, Frozen, numbered};
use crate::law::near_wall::{self, NearWall};
use crate::law::offset::Offset;
use crate::law::thinning::{self, ThinningViscosity};
use crate::law::viscosity::{FLUID_SUMS, FluidViscosity, WALL_SUMS, WallViscosity};
use crate::rheology::shear_rate;
use crate::summation::pack_sym;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, sweep};

impl<R: Real> Fluid<R> {
    /// Finds the viscous acceleration, the own-pressure and support sums, and the velocity gradient; needs
    /// [`Self::summation`] before it. With [`Numbers::rheology`](crate::Numbers::rheology)
    /// [`Self::shear_thinning`] has to follow, in any case [`Self::offsets`].
    pub fn viscosity(&mut self) {
        self.near_wall();
        self.note_for_wall();
        // The wall law wants the inverse distance where the other laws want the pressure.
        let frozen = &self.frozen;
        self.current
            .as_mut_slice()
            .par_iter_mut()
            .zip(frozen)
            .with_min_len(1024)
            .for_each(|(record, frozen)| record[7] = R::pack(frozen.inverse_distance));

        let gradient = self.kernel.gradient_scale();
        let support = self.kernel.support();
        let (mu, rho0, rheology) = (self.numbers.viscosity, self.numbers.rest_density, self.numbers.rheology);
        let density_change = &self.state.density_change;
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
        (
            self.frozen.par_chunks_mut(CHUNK),
            self.strain.par_chunks_mut(CHUNK),
            self.rows.chunks(),
            wall.fluid_rows.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (frozen, strain, row, wall_row))| {
                let mut fluid = [[0.0; FLUID_SUMS]; CHUNK];
                let mut walls = [[0.0; WALL_SUMS]; CHUNK];
                sweep(isa, &FluidViscosity, &fluid_gather, numbered(row, c), Store::None, &mut fluid);
                if !wall_row.has_no_pairs() {
                    sweep(isa, &WallViscosity, &wall_gather, numbered(wall_row, c), Store::None, &mut walls);
                }
                for k in 0..frozen.len() {
                    let (f, w, frozen) = (&fluid[k], &walls[k], &mut frozen[k]);
                    let rho = rho0 + density_change[c * CHUNK + k];
                    let depths = w[12] * frozen.wall_distance() + w[13];
                    let [bx, by, bz, ..] = strain[k];
                    let wall = DVec3::new(w[0], w[1], w[2]) - depths * DVec3::new(bx, by, bz);
                    let drag = DVec3::new(f[3], f[4], f[5]) + wall;
                    // With a law of the shear rate, what fluid pairs add is found anew once it is known.
                    frozen.acceleration = match rheology {
                        None => -gradient * mu / (support * rho) * drag,
                        Some(_) => -gradient / (support * rho) * wall,
                    };
                    let neighbours = -gradient * DVec3::new(f[0], f[1], f[2]);
                    set_gradient_sums(frozen, neighbours);
                    let raw: [f64; 9] = std::array::from_fn(|q| gradient * (f[6 + q] + w[3 + q]));
                    strain[k] = scaled_strain(&raw, frozen, 0.5 * support);
                }
            });
    }

    /// Finds how the velocity bends near the wall, the `b` of [`NearWall`] \[1/(m s)\]. It stands in the first three places of the
    /// strain until that is found.
    fn near_wall(&mut self) {
        let support = self.kernel.support();
        self.strain.clear();
        self.strain.resize(self.state.len(), [0.0; 6]);
        let frozen = &self.frozen;
        self.current
            .as_mut_slice()
            .par_iter_mut()
            .zip(frozen)
            .with_min_len(1024)
            .for_each(|(record, frozen)| record[7] = R::pack(frozen.wall_distance() / support));
        let (isa, current, velocity) = (self.isa, &self.current, &self.state.velocity);
        let of_wall = self.moving.as_ref().map(|m| m.velocity.as_slice());
        let gather =
            Gather { frame: &self.frame, own: current, other: current, own_second: None, other_second: None };
        (self.strain.par_chunks_mut(CHUNK), self.rows.chunks(), self.wall.fluid_rows.chunks())
            .into_par_iter()
            .enumerate()
            .filter(|(_, (_, _, wall_row))| !wall_row.has_no_pairs())
            .for_each(|(c, (bend, row, wall_row))| {
                let mut sums = [[0.0; near_wall::SUMS]; CHUNK];
                sweep(isa, &NearWall, &gather, numbered(row, c), Store::None, &mut sums);
                for k in (0..bend.len()).filter(|&k| !wall_row.is_row_empty(k)) {
                    let i = c * CHUNK + k;
                    let s = frozen[i].wall_distance() / support;
                    let volume = current.as_slice()[i][3].widen();
                    near_wall::add_own(&mut sums[k], s, volume, velocity[i].to_array());
                    let wall = of_wall.map_or([0.0; 3], |v| v[i].to_array());
                    let b = near_wall::curvature(&sums[k], wall);
                    bend[k][..3].copy_from_slice(&b.map(|b| b / (support * support)));
                }
            });
    }

    /// Finds the velocity offsets of all pairs from the velocity gradient of [`Self::viscosity`].
    pub fn offsets(&mut self) {
        let isa = self.isa;
        let strain = &self.strain;
        self.second.fill(|i| pack_sym(&strain[i]));
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
        // The strain is kept in units of half a support.
        let per_scale = 2.0 / support;
        self.current.as_mut_slice().par_iter_mut().zip(&self.strain).with_min_len(1024).for_each(
            |(record, strain)| {
                let eta = rheology.viscosity(per_scale * shear_rate(strain));
                record[7] = R::pack(1.0 / eta);
            },
        );
        let density_change = &self.state.density_change;
        let (isa, current, strain) = (self.isa, &self.current, &self.strain);
        let gather = Gather {
            frame: &self.frame,
            own: current,
            other: current,
            own_second: Some(&self.second),
            other_second: Some(&self.second),
        };
        (self.frozen.par_chunks_mut(CHUNK), self.rows.chunks()).into_par_iter().enumerate().for_each(
            |(c, (frozen, row))| {
                let mut sums = [[0.0; thinning::SUMS]; CHUNK];
                sweep(isa, &ThinningViscosity, &gather, numbered(row, c), Store::None, &mut sums);
                for (k, frozen) in frozen.iter_mut().enumerate() {
                    let i = c * CHUNK + k;
                    let eta = rheology.viscosity(per_scale * shear_rate(&strain[i]));
                    let rho = rho0 + density_change[i];
                    let drag = -gradient / (support * rho) * DVec3::from_array(sums[k]);
                    frozen.acceleration = eta * frozen.acceleration + drag;
                }
            },
        );
    }
}

/// `K' = sum V B_j grad W + B_i g_wall` and `k = K' + B_i (g_fluid + g_wall)`.
fn set_gradient_sums(frozen: &mut Frozen, neighbours: DVec3) {
    let b = frozen.correction;
    frozen.own_pressure = neighbours + b.mul(frozen.wall_gradient);
    frozen.support = frozen.own_pressure + b.mul(frozen.fluid_gradient + frozen.wall_gradient);
}

/// Symmetric part of the corrected velocity gradient, times `scale`; `raw` is `sum V (v_j - v_i) (x) grad W`.
fn scaled_strain(raw: &[f64; 9], frozen: &Frozen, scale: f64) -> [f64; 6] {
    let row = |r: usize| frozen.correction.mul(DVec3::new(raw[3 * r], raw[3 * r + 1], raw[3 * r + 2]));
    let g = DMat3::from_cols(row(0), row(1), row(2));
    let sym = |a: usize, b: usize| 0.5 * scale * (g.col(a)[b] + g.col(b)[a]);
    [sym(0, 0), sym(1, 1), sym(2, 2), sym(0, 1), sym(0, 2), sym(1, 2)]
}
