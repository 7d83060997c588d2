//! Time: kick, drift, kick, in as many sub-steps as the waves in the shell call for.

use crate::error::ShellError;
use crate::forces::across;
use crate::load::turning;
use crate::shell::Shell;
use crate::support::numbered;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real, run_on, sum_in_order};
use vaso_particles::{WallMotion, WallView};

/// `sin(x) / x` and `cos(x)` of the square of `x`. Directors turn by little a step, where series are exact and cheap.
#[inline(always)]
fn sinc_cos(square: f64) -> (f64, f64) {
    if square < 0.01 {
        let s = square;
        let sinc = 1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0)));
        let cosine =
            1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0))));
        return (sinc, cosine);
    }
    let (sine, cosine) = square.sqrt().sin_cos();
    (sine / square.sqrt(), cosine)
}

impl<R: Real> Shell<R> {
    /// Largest stable step \[s\] where the shell stands.
    pub fn stable_step(&self) -> f64 {
        let top = (0..self.state.len())
            .into_par_iter()
            .with_min_len(4096)
            .map(|i| (self.state.acceleration[i] + self.loads.on(i)).length_squared())
            .reduce(|| 0.0, f64::max);
        let waves = self.wave_step();
        let step = waves.min(self.numbers.courant * (self.numbers.smoothing_length / top.sqrt()).sqrt());
        // A spring adds to the square of the highest frequency, which is about 2 / (1.25 step).
        let spring = 0.625 * step * self.loads.largest_rate(&self.state).sqrt();
        step / (1.0 + spring * spring).sqrt()
    }

    /// Largest step \[s\] for the waves of the shell where it stands.
    ///
    /// The highest frequency at rest is measured when the shell is made, and grows with the stiffness. Damping, which is
    /// proportional to the stiffness, shortens the step by `sqrt(1 + z^2) - z`, z being its share of critical damping.
    fn wave_step(&self) -> f64 {
        let frequency = self.frequency * self.forces.stiffening().sqrt();
        let z = 0.25 * self.numbers.damping * frequency * self.damping_time;
        self.numbers.courant * ((1.0 + z * z).sqrt() - z) * 2.0 / frequency
    }

    /// Computes strain, stress and accelerations after a change of the state by hand.
    ///
    /// # Errors
    /// [`ShellError::Inverted`].
    pub fn refresh(&mut self) -> Result<(), ShellError> {
        self.accelerate(0.0)?;
        self.loads.update(&self.state, &self.forces);
        self.ready = true;
        self.shown.mean_velocity.fill(DVec3::ZERO);
        self.shown.acceleration.fill(DVec3::ZERO);
        for (i, x) in self.shown.position.iter_mut().enumerate() {
            *x = self.state.position(i);
        }
        Ok(())
    }

    /// Goes on from columns that were written between two steps, and now have been read: to the same bits.
    ///
    /// # Errors
    /// [`ShellError::Inverted`].
    pub fn resume(&mut self) -> Result<(), ShellError> {
        // Damping saw the strain half a step earlier, which is not known any more; the accelerations are.
        let acceleration = self.state.acceleration.to_vec();
        let turning = self.state.director_acceleration.to_vec();
        self.refresh()?;
        self.state.acceleration.copy_from_slice(&acceleration);
        self.state.director_acceleration.copy_from_slice(&turning);
        Ok(())
    }

    /// Advances the shell by `dt` \[s\] under a constant load of the fluid, in equal stable sub-steps; returns their number.
    ///
    /// # Errors
    /// [`ShellError::Inverted`] where the shell is turned inside out; [`ShellError::TooStiff`] where the number of sub-steps is
    /// out of all proportion.
    pub fn advance(&mut self, dt: f64) -> Result<usize, ShellError> {
        if !self.ready {
            self.refresh()?;
        }
        let stable = self.stable_step();
        let needed = (dt / stable).ceil().max(1.0) as usize;
        if needed > self.numbers.max_substeps {
            let allowed = self.numbers.max_substeps;
            return Err(ShellError::TooStiff { step: dt, stable, needed, allowed });
        }
        self.advance_in(dt, needed)?;
        Ok(needed)
    }

    /// Advances the shell by `dt` \[s\] in `n` equal sub-steps, which the caller has found to be stable.
    ///
    /// # Errors
    /// [`ShellError::Inverted`] where the shell is turned inside out.
    pub fn advance_in(&mut self, dt: f64, n: usize) -> Result<(), ShellError> {
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

    /// Moves positions along velocities, and directors along great circles.
    fn drift(&mut self, dt: f64) {
        let (isa, state) = (self.forces.isa, &mut self.state);
        let columns = (
            state.displacement.par_chunks_mut(CHUNK),
            state.velocity.par_chunks(CHUNK),
            state.director.par_chunks_mut(CHUNK),
            state.director_velocity.par_chunks_mut(CHUNK),
        );
        columns.into_par_iter().for_each(|(displacement, velocity, director, turn)| {
            let columns = displacement.iter_mut().zip(velocity).zip(director).zip(turn);
            run_on(
                isa,
                #[inline(always)]
                || {
                    for (((u, v), n), w) in columns {
                        *u += dt * *v;
                        let (sinc, cosine) = sinc_cos(w.length_squared() * dt * dt);
                        let (before, rate) = (*n, *w);
                        *n = (cosine * before + (sinc * dt) * rate).normalize();
                        *w = cosine * rate - (sinc * dt * rate.length_squared()) * before;
                    }
                },
            );
        });
    }

    fn accelerate(&mut self, dt: f64) -> Result<(), ShellError> {
        self.ledger.dissipation += dt * self.forces.accelerate(&mut self.state, &self.numbers, dt)?;
        if self.loads.follow() {
            self.loads.update(&self.state, &self.forces);
        }
        Ok(())
    }

    fn kick(&mut self, dt: f64) {
        let (isa, loads, supports) = (self.forces.isa, &self.loads, &self.supports);
        let state = &mut self.state;
        let (acceleration, angular) = (&state.acceleration, &state.director_acceleration);
        let (support, director) = (&state.support, &state.director);
        let (mass, inertia) = (&state.mass, &state.rotary_inertia);
        let work = state
            .velocity
            .par_chunks_mut(CHUNK)
            .zip(state.director_velocity.par_chunks_mut(CHUNK))
            .enumerate()
            .map(|(c, (velocity, turn))| {
                let mut work = 0.0;
                run_on(
                    isa,
                    #[inline(always)]
                    || {
                        for (k, (v, w)) in velocity.iter_mut().zip(turn).enumerate() {
                            let i = c * CHUNK + k;
                            let held = numbered(support[i], supports);
                            let (external, couple) = (loads.on(i), loads.on_director(i));
                            let new = held.displacement.of(*v + dt * (acceleration[i] + external));
                            let next = *w + dt * (angular[i] + across(couple, director[i]));
                            let next = turning(next, held.director, director[i]);
                            work += mass[i] * external.dot(*v + new) + inertia[i] * couple.dot(*w + next);
                            (*v, *w) = (new, next);
                        }
                    },
                );
                0.5 * dt * work
            });
        self.ledger.load_work += sum_in_order(work);
        self.ledger.dissipation += self.loads.damp(state, dt);
    }

    fn note_start(&mut self) {
        self.loads.note_start(&self.state);
        self.shown.mean_velocity.copy_from_slice(&self.state.displacement);
        self.shown.acceleration.copy_from_slice(&self.state.velocity);
    }

    fn note_end(&mut self, dt: f64) {
        let (state, shown) = (&self.state, &mut self.shown);
        let columns = (&mut shown.position, &mut shown.mean_velocity, &mut shown.acceleration);
        columns.into_par_iter().enumerate().with_min_len(1024).for_each(|(i, (x, mean, a))| {
            *x = state.position(i);
            *mean = (state.displacement[i] - *mean) / dt;
            *a = (state.velocity[i] - *a) / dt;
        });
    }

    /// What the fluid sees: positions of the mid-surface, half a thickness behind the lumen, and the velocity at the end of the
    /// last step, of which any lag is negative damping (`docs/theory/shells.md`).
    pub fn wall_view(&self) -> WallView<'_> {
        WallView {
            position: &self.shown.position,
            velocity: &self.state.velocity,
            depth: &self.shown.depth,
            volume: &self.shown.volume,
        }
    }

    /// Velocities and acceleration of the last step, in the order of [`Self::wall_view`].
    pub fn wall_motion(&self) -> WallMotion<'_> {
        WallMotion {
            end_velocity: &self.state.velocity,
            mean_velocity: &self.shown.mean_velocity,
            acceleration: &self.shown.acceleration,
        }
    }

    /// Force \[N\] that all supports together exert on the shell.
    pub fn reaction(&self) -> DVec3 {
        let of = |i: usize| {
            let a = self.state.acceleration[i] + self.loads.on(i);
            let held = numbered(self.state.support[i], &self.supports);
            self.state.mass[i] * (held.displacement.of(a) - a)
        };
        (0..self.state.len()).map(of).sum()
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_series_meet_the_functions() {
        for k in 0..300 {
            let x = 1e-3 * f64::from(k) + 1e-9;
            let (sinc, cosine) = super::sinc_cos(x * x);
            assert!((sinc - x.sin() / x).abs() < 3e-16 && (cosine - x.cos()).abs() < 3e-16, "{x}");
        }
    }
}
