//! Rest: the way to a static state under loads that do not change.

use crate::error::ShellError;
use crate::forces::across;
use crate::load::turning;
use crate::shell::Shell;
use crate::support::numbered;
use glam::DVec3;
use vaso_kernels::Real;

/// Steps between two looks at the residual.
const LOOK: usize = 50;

impl<R: Real> Shell<R> {
    /// Moves the shell to rest under its present loads by kinetic damping: velocities are zeroed whenever the kinetic energy has
    /// passed a peak (Cundall 1976; Barnes 1999). No time passes for what is outside.
    ///
    /// It ends when the forces left over are `tolerance` of the loads, both summed over the particles, or after `max_steps`;
    /// returns the number of steps and that share. Moments count as forces at a smoothing length. In thin shells bending is
    /// slow: the number of steps grows as the ratio of the highest to the lowest frequency.
    ///
    /// # Errors
    /// [`ShellError::Inverted`] where the shell is turned inside out.
    pub fn settle(&mut self, tolerance: f64, max_steps: usize) -> Result<(usize, f64), ShellError> {
        self.stop();
        self.refresh()?;
        let (mut before, mut share) = (0.0, self.residual());
        let mut step = self.stable_step();
        for count in 1..=max_steps {
            if count % LOOK == 1 {
                if share <= tolerance {
                    return Ok((count - 1, share));
                }
                step = self.stable_step();
            }
            self.advance_in(step, 1)?;
            let kinetic = self.kinetic().iter().sum();
            before = if kinetic < before {
                self.stop();
                0.0
            } else {
                kinetic
            };
            if count % LOOK == 0 {
                share = self.residual();
            }
        }
        Ok((max_steps, share))
    }

    fn stop(&mut self) {
        self.state.velocity.fill(DVec3::ZERO);
        self.state.director_velocity.fill(DVec3::ZERO);
    }

    /// Sum of the forces left over on particles by that of the loads.
    fn residual(&self) -> f64 {
        let state = &self.state;
        let (mut rest, mut loads) = (0.0, 0.0);
        for i in 0..state.len() {
            let held = numbered(state.support[i], &self.supports);
            let (director, arm) =
                (state.director[i], state.rotary_inertia[i] / self.numbers.smoothing_length);
            let (external, couple) = (self.loads.on(i), across(self.loads.on_director(i), director));
            let turn = turning(state.director_acceleration[i] + couple, held.director, director);
            rest += state.mass[i] * held.displacement.of(state.acceleration[i] + external).length();
            rest += arm * turn.length();
            loads += state.mass[i] * held.displacement.of(external).length();
            loads += arm * turning(couple, held.director, director).length();
        }
        if loads > 0.0 { rest / loads } else { 0.0 }
    }
}
