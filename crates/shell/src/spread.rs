//! The strain of the area, its rate, and loads that work on it.
//!
//! What acts on material beside the mid-surface, along the normal, works not only on the displacement of the mid-surface: where its area
//! grows the wall thins, and the material comes nearer. As a force that is an isotropic tension of the mid-surface, negative where the
//! load would widen it; it is given by the work it does on an area strain of one, and leaves no resultant.

use crate::error::ShellError;
use crate::forces::Forces;
use crate::law::{DISPLACEMENT_UNIT, Divergence, Gradient};
use crate::reference::Base;
use crate::section::Present;
use crate::shell::Shell;
use crate::state::ShellState;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, FIELDS, Real, sweep_links};
use vaso_particles::WallLoad;

/// Present over reference area between the base vectors `g`, and its derivatives with respect to them.
fn stretch(base: &Base, g: &[DVec3; 2]) -> (f64, [DVec3; 2]) {
    let scale = 1.0 / base.g[0].cross(base.g[1]).length();
    let cross = g[0].cross(g[1]);
    let normal = cross.normalize_or_zero();
    (scale * cross.length(), [scale * g[1].cross(normal), scale * normal.cross(g[0])])
}

impl<R: Real> Forces<R> {
    fn stretch(&self, state: &ShellState, i: usize) -> (f64, [DVec3; 2]) {
        let base = &self.reference.base[i];
        stretch(base, &Present::new(base, &self.motion[i], state.director[i]).g)
    }

    /// Writes the rates of the area strain \[1/s\]. Velocities are taken over the time `dt` \[s\], as displacements.
    fn strain_rates(&mut self, state: &ShellState, dt: f64, rate: &mut [f64]) {
        let support = self.reference.frame.support();
        let in_supports = dt / support;
        self.kinematic.as_mut_slice().par_iter_mut().zip(&state.velocity[..]).with_min_len(1024).for_each(
            |(record, v)| {
                let u = (*v * in_supports).to_array();
                *record = [R::coordinate(0, 0.0); FIELDS];
                for k in 0..3 {
                    record[k] = R::coordinate((u[k] * (1.0 / DISPLACEMENT_UNIT)) as i64 as i32, u[k]);
                }
            },
        );
        let this = &*self;
        let reference = &this.reference;
        rate.par_chunks_mut(CHUNK).zip(reference.rows.chunks()).enumerate().for_each(|(c, (rate, row))| {
            let mut sums = [[0.0; 12]; CHUNK];
            let stored = &reference.forward.chunks()[c];
            sweep_links(this.isa, &Gradient, (&this.kinematic, None), (row, c * CHUNK), stored, &mut sums);
            for (k, rate) in rate.iter_mut().enumerate() {
                let s = &sums[k];
                let (_, by_base) = this.stretch(state, c * CHUNK + k);
                // The sums are of own minus neighbour.
                let along = |a: usize| -support / dt * DVec3::new(s[a], s[2 + a], s[4 + a]);
                *rate = by_base[0].dot(along(0)) + by_base[1].dot(along(1));
            }
        });
    }

    /// Adds to `force` \[N\] those of loads whose work on an area strain of one is `spread` \[J\].
    fn spread(&mut self, state: &ShellState, spread: &[f64], force: &mut [DVec3]) {
        let tension: Vec<[DVec3; 2]> = (0..spread.len())
            .into_par_iter()
            .with_min_len(1024)
            .map(|i| self.stretch(state, i).1.map(|by_base| -spread[i] / state.area[i] * by_base))
            .collect();
        let packed = |t: &[DVec3; 2]| [t[0].x, t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, 0.0, 0.0].map(R::pack);
        self.force.fill(|i| packed(&tension[i]));
        self.moment.fill(|_| [R::pack(0.0); FIELDS]);
        let this = &*self;
        let reference = &this.reference;
        let records = (&this.force, Some(&this.moment));
        force.par_chunks_mut(CHUNK).zip(reference.rows.chunks()).enumerate().for_each(|(c, (force, row))| {
            let mut sums = [[0.0; 6]; CHUNK];
            let stored = &reference.backward.chunks()[c];
            sweep_links(this.isa, &Divergence, records, (row, c * CHUNK), stored, &mut sums);
            for (k, force) in force.iter_mut().enumerate() {
                let i = c * CHUNK + k;
                let ([w0, w1], [t0, t1], s) = (reference.own[i], tension[i], &sums[k]);
                *force += state.area[i] * (w0 * t0 + w1 * t1 + DVec3::new(s[0], s[1], s[2]));
            }
        });
    }
}

impl<R: Real> Shell<R> {
    /// Strain of the area at particle `i`: present over reference area, less one.
    pub fn area_strain(&self, i: usize) -> f64 {
        self.forces.stretch(&self.state, i).0 - 1.0
    }

    /// Writes the rates of the area strains \[1/s\]. `dt` \[s\] is a time in which particles move by little of their distance.
    ///
    /// # Panics
    /// Unless there is a place for each particle.
    pub fn area_strain_rates(&mut self, dt: f64, rate: &mut [f64]) {
        assert!(rate.len() == self.state.len(), "a place a particle");
        self.forces.strain_rates(&self.state, dt, rate);
    }

    /// As [`Self::set_load`], with loads beside the mid-surface: `spread` \[J\] is the work that those on a particle would do if its area
    /// doubled, with the mid-surface where it is.
    ///
    /// # Errors
    /// [`ShellError::Count`] unless there is one entry a particle.
    pub fn set_load_with_spread(&mut self, load: &WallLoad, spread: &[f64]) -> Result<(), ShellError> {
        let expected = self.state.len();
        if spread.len() != expected {
            return Err(ShellError::Count { what: "spread", given: spread.len(), expected });
        }
        let mut force = load.pressure_force.to_vec();
        if force.len() == expected {
            self.forces.spread(&self.state, spread, &mut force);
        }
        self.set_load(&WallLoad { pressure_force: &force, ..*load })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_area() {
        let base = Base {
            tangent: [DVec3::X, DVec3::Y],
            director: DVec3::Z,
            g: [DVec3::new(1.0, 0.1, 0.0), DVec3::new(0.0, 0.9, 0.2)],
            n: [DVec3::ZERO; 2],
            dual: [DVec3::ZERO; 3],
        };
        let g = [DVec3::new(1.2, 0.1, -0.1), DVec3::new(0.1, 0.8, 0.3)];
        let (_, by_base) = stretch(&base, &g);
        for (a, by_base) in by_base.into_iter().enumerate() {
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let at = |e: f64| {
                    let mut moved = g;
                    moved[a] += e * axis;
                    stretch(&base, &moved).0
                };
                let numeric = (at(1e-6) - at(-1e-6)) / 2e-6;
                assert!((numeric - by_base.dot(axis)).abs() < 1e-9, "{numeric} {by_base}");
            }
        }
    }
}
