//! A run that cannot go on, and what is said of it.

use crate::ledger::Stage;
use glam::DVec3;
use vaso_coupling::CouplingError;

/// What a run broke down by, and where in it that was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{breakdown}; found in stage `{}` of step {step}, at {time:.6e} s", stage.name())]
pub struct Diverged {
    /// What went wrong.
    pub breakdown: Breakdown,
    /// Stage in which it came about, as far as the state tells.
    pub stage: Stage,
    /// Advective step, counted from one.
    pub step: u64,
    /// Simulated time \[s\].
    pub time: f64,
}

/// What can go wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Breakdown {
    /// A value is no longer a number.
    #[error(
        "{column} [{unit}] of particle {id} at ({:.6}, {:.6}, {:.6}) m is not finite",
        position.x, position.y, position.z
    )]
    NonFinite {
        /// Column of the value.
        column: &'static str,
        /// Its unit.
        unit: &'static str,
        /// Identity of the particle.
        id: u64,
        /// Its position \[m\].
        position: DVec3,
    },
    /// The flow is too fast for the sound speed.
    #[error(
        "particle {id} at ({:.6}, {:.6}, {:.6}) m moves at {speed:.3} m/s, more than a fifth of the sound speed of \
         {sound_speed:.3} m/s",
        position.x, position.y, position.z
    )]
    TooFast {
        /// Identity of the particle.
        id: u64,
        /// Its position \[m\].
        position: DVec3,
        /// Its speed \[m/s\].
        speed: f64,
        /// Sound speed \[m/s\].
        sound_speed: f64,
    },
    /// The wall has broken down.
    #[error("the wall: {0}")]
    Wall(CouplingError),
    /// All fluid is gone.
    #[error("no fluid particle is left")]
    Empty,
}

impl Diverged {
    /// What to change.
    pub fn advice(&self) -> &'static str {
        match (&self.breakdown, self.stage) {
            (Breakdown::TooFast { .. }, _) => {
                "raise `numerics.sound_speed` or `numerics.sound_speed_factor`, lengthen the `ramp` of what sets in suddenly, or let it pass by \
                 `numerics.allow_mach = true`"
            }
            (Breakdown::Wall(_), _) => {
                "lengthen the `ramp` of the inflow, give `wall.unloaded_pressure`, `wall.damping` or `wall.support`, or a finer `wall.spacing`"
            }
            (Breakdown::Empty, _) => {
                "look at the conditions of the openings: what goes out has to come in somewhere"
            }
            (Breakdown::NonFinite { .. }, Stage::Openings) => {
                "look at the condition of the opening near by: its value, its `ramp`, and whether a model behind it has the right unit"
            }
            (Breakdown::NonFinite { .. }, _) => {
                "look at the place in the post-mortem file: an opening near by wants a longer `ramp`, a narrow place a smaller \
                 `particles.spacing`, a sudden flow a larger `numerics.sound_speed`"
            }
        }
    }
}
