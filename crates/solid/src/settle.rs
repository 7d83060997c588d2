//! Rest: the way to a static state under loads that do not change.

use crate::error::SolidError;
use crate::solid::{Solid, held};
use glam::DVec3;
use vaso_kernels::Real;

/// Steps between two looks at the residual.
const LOOK: usize = 50;

impl<R: Real> Solid<R> {
    /// Moves the body to rest under its present loads by kinetic damping: velocities are zeroed whenever the kinetic energy has
    /// passed a peak (Cundall 1976; Barnes 1999). No time passes for what is outside.
    ///
    /// It ends when the forces left over are `tolerance` of the loads, both summed over the particles that are free, or after
    /// `max_steps`; returns the number of steps and that share.
    ///
    /// # Errors
    /// [`SolidError::Inverted`] where the material is turned inside out.
    pub fn settle(&mut self, tolerance: f64, max_steps: usize) -> Result<(usize, f64), SolidError> {
        self.state.velocity.fill(DVec3::ZERO);
        self.refresh()?;
        let (mut before, mut share) = (0.0, self.residual());
        for step in 1..=max_steps {
            if step % LOOK == 1 && share <= tolerance {
                return Ok((step - 1, share));
            }
            self.advance_in(self.stable_step(), 1)?;
            let kinetic: f64 = self.state.velocity.iter().map(|v| v.length_squared()).sum();
            before = if kinetic < before {
                self.state.velocity.fill(DVec3::ZERO);
                0.0
            } else {
                kinetic
            };
            if step % LOOK == 0 {
                share = self.residual();
            }
        }
        Ok((max_steps, share))
    }

    /// Sum of the forces left over on particles by that of the loads.
    fn residual(&self) -> f64 {
        let state = &self.state;
        let (mut rest, mut loads) = (0.0, 0.0);
        for (i, external) in self.loads.acceleration.iter().enumerate() {
            let (support, planes) = (state.support[i], &self.planes);
            rest += state.mass[i] * held(state.acceleration[i] + *external, support, planes).length();
            loads += state.mass[i] * held(*external, support, planes).length();
        }
        if loads > 0.0 { rest / loads } else { 0.0 }
    }
}
