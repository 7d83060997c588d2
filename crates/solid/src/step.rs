//! Time: kick, drift, kick, in as many sub-steps as the waves in the solid call for.

use crate::error::SolidError;
use crate::solid::{Solid, held};
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real, run_on, sum_in_order};
use vaso_particles::{WallMotion, WallView};

impl<R: Real> Solid<R> {
    /// Speed of the fastest wave \[m/s\], in lengths of the reference configuration, where the body stands.
    pub fn wave_speed(&self) -> f64 {
        let rest = self.material.wave_speed(self.numbers.density);
        rest.max((self.body.modulus() / self.numbers.density).sqrt())
    }

    /// Largest stable step \[s\] where the body stands.
    pub fn stable_step(&self) -> f64 {
        let external = &self.loads.acceleration;
        let top = (0..self.state.len())
            .into_par_iter()
            .with_min_len(4096)
            .map(|i| {
                let a = self.state.acceleration[i] + external.get(i).copied().unwrap_or_default();
                a.length_squared()
            })
            .reduce(|| 0.0, f64::max);
        let step = self.numbers.stable_step(self.wave_speed(), top.sqrt());
        // A spring adds to the square of the highest frequency, which is about 2 / (1.25 step).
        let spring = 0.625 * step * self.loads.largest_rate(&self.state).sqrt();
        step / (1.0 + spring * spring).sqrt()
    }

    /// Computes strain, stress and accelerations after a change of the state by hand.
    ///
    /// # Errors
    /// [`SolidError::Inverted`].
    pub fn refresh(&mut self) -> Result<(), SolidError> {
        self.drift(0.0);
        self.accelerate(0.0)?;
        self.ready = true;
        if let Some(shown) = &mut self.shown {
            shown.mean_velocity.fill(DVec3::ZERO);
            shown.acceleration.fill(DVec3::ZERO);
            for (i, x) in shown.position.iter_mut().enumerate() {
                *x = self.state.position(i);
            }
        }
        Ok(())
    }

    /// Goes on from columns that were written between two steps, and now have been read: to the same bits.
    ///
    /// # Errors
    /// [`SolidError::Inverted`].
    pub fn resume(&mut self) -> Result<(), SolidError> {
        // Damping saw the velocity of half a step earlier, which is not known any more; the acceleration is.
        let acceleration = self.state.acceleration.to_vec();
        self.refresh()?;
        self.state.acceleration.copy_from_slice(&acceleration);
        Ok(())
    }

    /// Advances the body by `dt` \[s\] under a constant load of the fluid, in equal stable sub-steps; returns their number.
    ///
    /// # Errors
    /// [`SolidError::Inverted`] where the material is turned inside out; [`SolidError::TooStiff`] where the number of sub-steps
    /// is out of all proportion.
    pub fn advance(&mut self, dt: f64) -> Result<usize, SolidError> {
        if !self.ready {
            self.refresh()?;
        }
        let stable = self.stable_step();
        let needed = (dt / stable).ceil().max(1.0) as usize;
        if needed > self.numbers.max_substeps {
            let (allowed, wave_speed) = (self.numbers.max_substeps, self.wave_speed());
            return Err(SolidError::TooStiff { step: dt, stable, needed, allowed, wave_speed });
        }
        self.advance_in(dt, needed)?;
        Ok(needed)
    }

    /// Advances the body by `dt` \[s\] in `n` equal sub-steps, which the caller has found to be stable.
    ///
    /// # Errors
    /// [`SolidError::Inverted`] where the material is turned inside out.
    pub fn advance_in(&mut self, dt: f64, n: usize) -> Result<(), SolidError> {
        if !self.ready {
            self.refresh()?;
        }
        self.note_start();
        let step = dt / n as f64;
        self.kick(0.5 * step);
        for k in 1..=n {
            self.drift(step);
            self.accelerate(step)?;
            // The end of one sub-step and the beginning of the next see the same accelerations.
            self.kick(if k < n { step } else { 0.5 * step });
            self.loads.resist(&mut self.state, step);
        }
        self.note_end(dt);
        Ok(())
    }

    fn drift(&mut self, dt: f64) {
        self.body.drift(&mut self.state, dt);
    }

    fn accelerate(&mut self, dt: f64) -> Result<(), SolidError> {
        self.ledger.dissipation += self.body.accelerate(&mut self.state, &self.numbers, dt)?;
        if self.loads.follow() || !self.ready {
            self.loads.update(&self.state, &*self.body);
        }
        Ok(())
    }

    fn kick(&mut self, dt: f64) {
        let (isa, external, planes) = (self.isa, &self.loads.acceleration, &self.planes);
        let state = &mut self.state;
        let (support, mass) = (&state.support, &state.mass);
        let work =
            state.velocity.par_chunks_mut(CHUNK).zip(state.acceleration.par_chunks(CHUNK)).enumerate().map(
                |(c, (velocity, acceleration))| {
                    let mut work = 0.0;
                    run_on(
                        isa,
                        #[inline(always)]
                        || {
                            for (k, (v, a)) in velocity.iter_mut().zip(acceleration).enumerate() {
                                let i = c * CHUNK + k;
                                let external = external.get(i).copied().unwrap_or_default();
                                let new = held(*v + dt * (*a + external), support[i], planes);
                                work += mass[i] * external.dot(*v + new);
                                *v = new;
                            }
                        },
                    );
                    0.5 * dt * work
                },
            );
        self.ledger.load_work += sum_in_order(work);
        self.ledger.dissipation += self.loads.damp(state, dt);
    }

    fn note_start(&mut self) {
        self.loads.note_start(&self.state);
        if let Some(shown) = &mut self.shown {
            shown.mean_velocity.copy_from_slice(&self.state.displacement);
            shown.acceleration.copy_from_slice(&self.state.velocity);
        }
    }

    fn note_end(&mut self, dt: f64) {
        let state = &self.state;
        if let Some(shown) = &mut self.shown {
            let columns = (&mut shown.position, &mut shown.mean_velocity, &mut shown.acceleration);
            columns.into_par_iter().enumerate().with_min_len(1024).for_each(|(i, (x, mean, a))| {
                *x = state.position(i);
                *mean = (state.displacement[i] - *mean) / dt;
                *a = (state.velocity[i] - *a) / dt;
            });
        }
    }

    /// What the fluid sees: positions, and the velocity at the end of the last step.
    ///
    /// The end velocity is what the second half of the density step needs; any lag is negative damping (`docs/theory/solids.md`).
    /// A body made without depths shows nothing.
    pub fn wall_view(&self) -> WallView<'_> {
        match &self.shown {
            Some(shown) => WallView {
                position: &shown.position,
                velocity: &self.state.velocity,
                depth: &shown.depth,
                volume: &self.state.volume,
            },
            None => WallView { position: &[], velocity: &[], depth: &[], volume: &[] },
        }
    }

    /// Velocities and acceleration of the last step, in the order of [`Self::wall_view`].
    pub fn wall_motion(&self) -> WallMotion<'_> {
        match &self.shown {
            Some(shown) => WallMotion {
                end_velocity: &self.state.velocity,
                mean_velocity: &shown.mean_velocity,
                acceleration: &shown.acceleration,
            },
            None => WallMotion { end_velocity: &[], mean_velocity: &[], acceleration: &[] },
        }
    }

    /// Force \[N\] that all supports together exert on the body.
    pub fn reaction(&self) -> DVec3 {
        let external = &self.loads.acceleration;
        let state = &self.state;
        (0..state.len())
            .map(|i| {
                let a = state.acceleration[i] + external.get(i).copied().unwrap_or_default();
                state.mass[i] * (held(a, state.support[i], &self.planes) - a)
            })
            .sum()
    }
}
