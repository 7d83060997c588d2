//! What each effect cost: time, calls and bytes.

use std::time::{Duration, Instant};
use vaso_particles::Memory;

/// Parts of a run that are timed on their own; effects are made of one or several of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Particles through openings, labels, cell order.
    Exchange,
    /// Neighbour rows and wall distance.
    Rows,
    /// Density summation and correction matrices.
    Summation,
    /// Viscosity and velocity gradients.
    Viscosity,
    /// Viscosity by the shear rate.
    ShearThinning,
    /// Pressure of the wall particles.
    WallPressure,
    /// What wall and blood tell each other, where the wall moves.
    Coupling,
    /// Motion of the wall.
    Wall,
    /// Momentum half of the acoustic step.
    Momentum,
    /// Conditions at the openings.
    Openings,
    /// Continuity half of the acoustic step.
    Continuity,
    /// Transport-velocity shift and wall guard.
    Transport,
    /// Checks and measurements.
    Guard,
    /// Wall shear stress on the surface.
    WallShear,
    /// Files.
    Output,
}

impl Stage {
    /// All stages in the order of a step.
    pub const ALL: [Self; 15] = [
        Self::Exchange,
        Self::Rows,
        Self::Summation,
        Self::Viscosity,
        Self::ShearThinning,
        Self::WallPressure,
        Self::Coupling,
        Self::Wall,
        Self::Momentum,
        Self::Openings,
        Self::Continuity,
        Self::Transport,
        Self::Guard,
        Self::WallShear,
        Self::Output,
    ];

    /// Name as the plan and the summary print it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exchange => "openings.exchange",
            Self::Rows => "blood.rows",
            Self::Summation => "blood.summation",
            Self::Viscosity => "blood.viscosity",
            Self::ShearThinning => "blood.shear_thinning",
            Self::WallPressure => "wall.pressure",
            Self::Coupling => "wall.coupling",
            Self::Wall => "wall.motion",
            Self::Momentum => "blood.momentum",
            Self::Openings => "openings.impose",
            Self::Continuity => "blood.continuity",
            Self::Transport => "blood.transport",
            Self::Guard => "guard",
            Self::WallShear => "metrics.wall_shear",
            Self::Output => "output",
        }
    }
}

/// Time spent per stage.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    spent: [Duration; Stage::ALL.len()],
}

impl Ledger {
    /// Runs `work` and books its time to `stage`.
    pub fn time<T>(&mut self, stage: Stage, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.spent[stage as usize] += start.elapsed();
        result
    }

    /// Books time to `stage`.
    pub fn add(&mut self, stage: Stage, spent: Duration) {
        self.spent[stage as usize] += spent;
    }

    /// Shows the time of all stages, so that a run that goes on adds to it.
    pub(crate) fn remember(&mut self, memory: &mut dyn Memory) {
        let mut seconds: Vec<f64> = self.spent.iter().map(Duration::as_secs_f64).collect();
        memory.fixed_numbers("ledger.seconds", &mut seconds);
        for (spent, seconds) in self.spent.iter_mut().zip(seconds) {
            *spent = Duration::try_from_secs_f64(seconds).unwrap_or_default();
        }
    }

    /// Time booked to a stage \[s\].
    pub fn seconds(&self, stage: Stage) -> f64 {
        self.spent[stage as usize].as_secs_f64()
    }

    /// Time booked in all \[s\].
    pub fn total(&self) -> f64 {
        self.spent.iter().map(Duration::as_secs_f64).sum()
    }
}
