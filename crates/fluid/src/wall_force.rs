//! Forces on a wall that moves: those on the fluid, pair by pair, with the other sign.

use crate::fluid::{Fluid, numbered};
use crate::law::moving::{BendOnWall, DragOnWall, LeanOnWall};
use crate::moving::{Moving, OUT_OF_REACH};
use crate::rheology::shear_rate;
use crate::viscosity::scaled_strain;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, PairLaw, Real, Records, Store, sweep};

/// What the pressure of the fluid does to one particle of a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Force of the pairs \[N\]: that on the fluid with the other sign. The fluid has the differences of its pressures, so the level of the
    /// pressure is not in it.
    pub force: DVec3,
    /// Half of the area it stands for among the fluid, by the kernel sum and the factors of [`Fluid::release_wall`], away from the lumen
    /// \[m^2\].
    pub area: DVec3,
    /// The same of the pressure \[N\]: along the normal, over [`Self::area`], the pressure at the face, and twice this the force that
    /// [`Self::force`] lacks, as the kernel sums have it.
    pub level: DVec3,
}

impl<R: Real> Fluid<R> {
    /// Keeps what the forces on the wall need from the viscous sweep; `bend` stands in the velocity gradient until that is found.
    pub(crate) fn note_for_wall(&mut self) {
        let Some(moving) = &mut self.moving else { return };
        moving.bend.clear();
        moving.bend.extend(self.slope.iter().map(|s| s.x_axis));
        moving.correction.resize(self.state.len());
        let second = self.second.as_slice();
        moving.correction.fill(|i| second[i]);
    }

    /// Shows the wall the pressure of the fluid, and that of its dissipation at the wall.
    pub(crate) fn show_pressure(&self, moving: &mut Moving<R>) {
        let numbers = &self.numbers;
        let (state, frozen, current) = (&self.state, &self.for_momentum, self.current.as_slice());
        let Moving { seen, velocity: near, .. } = moving;
        seen.resize(state.len());
        seen.fill(|i| {
            let change = state.density_change[i];
            let volume = state.mass[i] / (numbers.rest_density + change);
            let closing = frozen[i].closing_pressure(state.velocity[i] - near[i], numbers);
            let ([x, y, z, ..], zero) = (current[i], R::default());
            [x, y, z, R::pack(volume), R::pack(closing), zero, zero, R::pack(numbers.pressure(change))]
        });
    }

    /// Writes what the pressure and its dissipation do to each particle of the wall, in the order of its view, with the forces of the last
    /// [`Self::kick`]: they were found with [`Self::wall_pressure`] before it.
    pub fn pressure_on_wall(&mut self, contact: &mut [Contact]) {
        let Some(moving) = &self.moving else { return };
        let gradient = self.kernel.gradient_scale();
        let records = self.wall.dynamic.as_slice();
        (contact, &moving.place, &moving.lever).into_par_iter().with_min_len(1024).for_each(
            |(contact, &place, lever)| {
                *contact = Contact::default();
                if place != OUT_OF_REACH {
                    let (record, sum) = (&records[place as usize], &moving.contact[place as usize]);
                    let scale = gradient * record[3].widen();
                    let of = |k: usize| scale * DVec3::new(sum[k], sum[k + 1], sum[k + 2]);
                    let near = sum[0];
                    let (area, beyond) = (of(5), of(8));
                    let force = (record[7].widen() - near) * area - beyond + of(11);
                    *contact = Contact { force, area: *lever * area, level: *lever * (near * area + beyond) };
                }
            },
        );
    }

    /// Writes the viscous force on each particle of the wall \[N\], in the order of its view: that of [`Self::viscosity`] on the
    /// fluid, pair by pair, with the other sign. It holds for all acoustic steps of the advective step.
    pub fn viscous_force_on_wall(&mut self, force: &mut [DVec3]) {
        let Some(mut moving) = self.moving.take() else { return };
        let support = self.kernel.support();
        let (state, columns, current) = (&self.state, &self.columns, self.current.as_slice());
        let (numbers, slope, zone_of) = (&self.numbers, &self.slope, &self.zone_of);
        let viscous_volume = |i: usize| {
            let mu = numbers
                .rheology
                .map_or(numbers.viscosity, |law| law.viscosity(shear_rate(&scaled_strain(&slope[i], 1.0))));
            mu * state.mass[i] / (numbers.rest_density + state.density_change[i])
        };
        let own = &self.wall.kinematic;
        moving.seen.resize(state.len());
        moving.seen.fill(|i| {
            let mut record = current[i];
            record[3] = R::pack(viscous_volume(i));
            record[7] = columns.inverse_distance[i];
            record
        });
        let (mut drag, mut part) = (std::mem::take(&mut moving.drag), std::mem::take(&mut moving.part));
        self.gather_on_wall(&DragOnWall, own, &moving, &mut drag);
        let bend = &moving.bend;
        show(&mut moving.seen, |i| (bend[i], columns.wall_distance(i)));
        self.gather_on_wall(&BendOnWall, own, &moving, &mut part);
        for (drag, bent) in drag.iter_mut().zip(&part) {
            (0..3).for_each(|axis| drag[axis] -= bent[axis]);
        }
        for axis in 0..3 {
            // Near caps what a linear velocity adds is left in, see `viscosity`.
            let column = |i: usize| if zone_of[i] == 0 { slope[i].col(axis) } else { DVec3::ZERO };
            show(&mut moving.seen, |i| (column(i), 0.0));
            self.gather_on_wall(&LeanOnWall, own, &moving, &mut part);
            drag.iter_mut().zip(&part).for_each(|(drag, lean)| drag[axis] += support * lean[0]);
        }
        let scale = self.kernel.gradient_scale() / support;
        force.fill(DVec3::ZERO);
        for ((&a, record), drag) in moving.source().iter().zip(own.as_slice()).zip(&drag) {
            force[a as usize] = scale * record[3].widen() * DVec3::from_array(*drag);
        }
        (moving.drag, moving.part) = (drag, part);
        self.moving = Some(moving);
    }

    /// Writes the sums of a law over the rows of the wall, among the fluid as it is seen.
    pub(crate) fn gather_on_wall<const N: usize>(
        &self,
        law: &impl PairLaw<R, N>,
        own: &Records<R>,
        moving: &Moving<R>,
        result: &mut Vec<[f64; N]>,
    ) {
        result.resize(self.wall.len(), [0.0; N]);
        let isa = self.isa;
        let gather = Gather {
            frame: &self.frame,
            own,
            other: &moving.seen,
            own_second: None,
            other_second: Some(&moving.correction),
        };
        result.par_chunks_mut(CHUNK).zip(self.wall.wall_rows.chunks()).enumerate().for_each(
            |(c, (result, row))| {
                if row.has_no_pairs() {
                    return result.fill([0.0; N]);
                }
                let mut sums = [[0.0; N]; CHUNK];
                sweep(isa, law, &gather, numbered(row, c), Store::None, &mut sums);
                result.copy_from_slice(&sums[..result.len()]);
            },
        );
    }
}

/// Lets the wall see other vectors and scalars of the fluid.
fn show<R: Real>(seen: &mut Records<R>, of: impl Fn(usize) -> (DVec3, f64) + Sync) {
    seen.as_mut_slice().par_iter_mut().enumerate().with_min_len(1024).for_each(|(i, record)| {
        let (vector, scalar) = of(i);
        (record[4], record[5], record[6]) = (R::pack(vector.x), R::pack(vector.y), R::pack(vector.z));
        record[7] = R::pack(scalar);
    });
}
