//! The strain of the area, its rate, and loads that work on it.
//!
//! What acts on material beside the mid-surface, along the normal, works not only on the displacement of the mid-surface: where its area
//! grows the wall thins, and the material comes nearer. As a force that is an isotropic tension of the mid-surface, negative where the
//! load would widen it; it is given by the work it does on an area strain of one, and leaves no resultant.

use crate::error::ShellError;
use crate::forces::Forces;
use crate::law::{DISPLACEMENT_UNIT, Slope, Tension};
use crate::reference::{Base, Reference};
use crate::section::{Motion, Present};
use crate::shell::Shell;
use crate::state::ShellState;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real, sweep_links};
use vaso_particles::WallLoad;

/// Area of a particle.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stretch {
    /// Present over reference area.
    ratio: f64,
    /// Its derivatives by the base vectors.
    by_base: [DVec3; 2],
}

impl Stretch {
    fn new(base: &Base, g: &[DVec3; 2]) -> Self {
        let scale = 1.0 / base.g[0].cross(base.g[1]).length();
        let cross = g[0].cross(g[1]);
        let normal = cross.normalize_or_zero();
        let by_base = [scale * g[1].cross(normal), scale * normal.cross(g[0])];
        Self { ratio: scale * cross.length(), by_base }
    }
}

/// Area of particle `i`, from those that are `known` or anew.
fn stretch<R>(
    known: &[Stretch],
    reference: &Reference<R>,
    motion: &[Motion],
    state: &ShellState,
    i: usize,
) -> Stretch {
    if let Some(known) = known.get(i) {
        return *known;
    }
    let base = &reference.base[i];
    Stretch::new(base, &Present::new(base, &motion[i], state.director[i]).g)
}

impl<R: Real> Forces<R> {
    fn stretch(&self, state: &ShellState, i: usize) -> Stretch {
        stretch(&self.stretch, &self.reference, &self.motion, state, i)
    }

    /// Writes the rates of the area strain \[1/s\], and keeps the areas until the shell moves on. Velocities are taken over the time `dt`
    /// \[s\], as displacements.
    fn strain_rates(&mut self, state: &ShellState, dt: f64, rate: &mut [f64]) {
        let support = self.reference.frame.support();
        let in_supports = dt / support;
        self.kinematic.as_mut_slice().par_iter_mut().zip(&state.velocity[..]).with_min_len(1024).for_each(
            |(record, v)| {
                let u = (*v * in_supports).to_array();
                for k in 0..3 {
                    record[k] = R::coordinate((u[k] * (1.0 / DISPLACEMENT_UNIT)) as i64 as i32, u[k]);
                }
            },
        );
        let mut stretches = std::mem::take(&mut self.stretch);
        stretches.clear();
        stretches.resize(rate.len(), Stretch::default());
        let this = &*self;
        let reference = &this.reference;
        (rate.par_chunks_mut(CHUNK), stretches.par_chunks_mut(CHUNK), reference.rows.chunks())
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (rate, stretches, row))| {
                let mut sums = [[0.0; 6]; CHUNK];
                let stored = &reference.forward.chunks()[c];
                sweep_links(this.isa, &Slope, (&this.kinematic, None), (row, c * CHUNK), stored, &mut sums);
                for (k, (rate, stretch)) in rate.iter_mut().zip(stretches).enumerate() {
                    let s = &sums[k];
                    *stretch = this.stretch(state, c * CHUNK + k);
                    // The sums are of own minus neighbour.
                    let along = |a: usize| -support / dt * DVec3::new(s[a], s[2 + a], s[4 + a]);
                    *rate = stretch.by_base[0].dot(along(0)) + stretch.by_base[1].dot(along(1));
                }
            });
        self.stretch = stretches;
    }

    /// Adds to `force` \[N\] those of loads whose work on an area strain of one is `spread` \[J\].
    fn spread(&mut self, state: &ShellState, spread: &[f64], force: &mut [DVec3]) {
        let Self { own: tension, force: records, stretch: known, reference, motion, isa, .. } = self;
        (&mut *tension, records.as_mut_slice()).into_par_iter().enumerate().with_min_len(1024).for_each(
            |(i, (tension, record))| {
                let by_area = -spread[i] / state.area[i];
                let Stretch { by_base: [a, b], .. } = stretch(known, reference, motion, state, i);
                *tension = [by_area * a, by_area * b];
                let [a, b] = *tension;
                *record = [a.x, a.y, a.z, b.x, b.y, b.z, 0.0, 0.0].map(R::pack);
            },
        );
        let (isa, records) = (*isa, &*records);
        force.par_chunks_mut(CHUNK).zip(reference.rows.chunks()).enumerate().for_each(|(c, (force, row))| {
            let mut sums = [[0.0; 3]; CHUNK];
            let stored = &reference.backward.chunks()[c];
            sweep_links(isa, &Tension, (records, None), (row, c * CHUNK), stored, &mut sums);
            for (k, force) in force.iter_mut().enumerate() {
                let i = c * CHUNK + k;
                let ([w0, w1], [t0, t1]) = (reference.own[i], tension[i]);
                *force += state.area[i] * (w0 * t0 + w1 * t1 + DVec3::from_array(sums[k]));
            }
        });
    }
}

impl<R: Real> Shell<R> {
    /// Strain of the area at particle `i`: present over reference area, less one.
    pub fn area_strain(&self, i: usize) -> f64 {
        self.forces.stretch(&self.state, i).ratio - 1.0
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
        self.take_load(load)?;
        self.forces.spread(&self.state, spread, &mut self.loads.fluid);
        self.loads.update(&self.state, &self.forces);
        Ok(())
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
        let by_base = Stretch::new(&base, &g).by_base;
        for (a, by_base) in by_base.into_iter().enumerate() {
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let at = |e: f64| {
                    let mut moved = g;
                    moved[a] += e * axis;
                    Stretch::new(&base, &moved).ratio
                };
                let numeric = (at(1e-6) - at(-1e-6)) / 2e-6;
                assert!((numeric - by_base.dot(axis)).abs() < 1e-9, "{numeric} {by_base}");
            }
        }
    }
}
