//! What is read off a flow while it runs: wall shear stress, cycles of the openings, whether it has settled, its energy.
//!
//! Each part exists only where the case asks for it.

mod energy;
mod openings;
mod settling;
mod wall;

pub use energy::EnergyObserver;
pub use openings::OpeningObserver;
pub use settling::Settling;
pub use wall::WallObserver;

use crate::case::Case;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::ledger::Stage;
use crate::plan::Plan;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_io::EndReason;
use vaso_metrics::Verdict;
use vaso_particles::{Memory, WallView};

/// All that watches a flow.
pub struct Observers {
    /// Cycles of the openings; `None` where the case has no period.
    pub openings: Option<OpeningObserver>,
    /// Wall shear stress; `None` where no field of it is asked for.
    pub wall: Option<WallObserver>,
    /// Whether a steady flow has settled; `None` unless the case asks to end then.
    pub settling: Option<Settling>,
    /// Energy that went in and what became of it.
    pub energy: EnergyObserver,
}

impl Observers {
    /// What `case` asks for; `rest` is a wall that deforms where it was when the particles were made.
    ///
    /// # Errors
    /// When the period of the case is none.
    pub fn new(case: &Case, plan: &Plan, rest: Option<&WallView>) -> Result<Self, DriverError> {
        let steady = case.scene.run.steady;
        let names = || plan.openings.iter().map(|o| o.name.clone()).collect();
        let alike = case.scene.run.periodicity.or(steady);
        let openings = plan.period.map(|period| OpeningObserver::new(names(), period, alike)).transpose()?;
        let settling =
            steady.filter(|_| plan.period.is_none()).map(|share| Settling::new(share, plan.settling_time));
        let wall = plan.wall_metrics.then(|| WallObserver::new(case, plan, rest)).transpose()?;
        Ok(Self { openings, wall, settling, energy: EnergyObserver::new(plan) })
    }

    /// Shows all that has been summed so far.
    pub fn remember(&mut self, memory: &mut dyn Memory) {
        let Self { openings, wall, settling, energy } = self;
        if let Some(openings) = openings {
            openings.remember(memory);
        }
        if let Some(wall) = wall {
            wall.remember(memory);
        }
        if let Some(settling) = settling {
            settling.remember(memory);
        }
        energy.remember(memory);
    }

    /// Takes the state after a step; tells why the run may end, if it may, also in words.
    ///
    /// # Errors
    /// When the columns of the flow do not belong together.
    pub fn after_step<R: Real, W: MovingWall>(
        &mut self,
        flow: &mut Flow<R, W>,
    ) -> Result<Option<(EndReason, String)>, DriverError> {
        let start = std::time::Instant::now();
        self.energy.add(flow);
        let settled = self.settling.as_mut().and_then(|settling| settling.add(flow));
        let settled = settled.map(|words| (EndReason::Steady, words));
        if let Some(openings) = &mut self.openings {
            openings.add(flow)?;
        }
        flow.ledger.add(Stage::Guard, start.elapsed());
        let start = std::time::Instant::now();
        let mut shear = None;
        if let Some(wall) = &mut self.wall {
            shear = wall.add(flow)?;
            flow.ledger.add(Stage::WallShear, start.elapsed());
        }
        let watches_wall = self.wall.as_ref().is_some_and(WallObserver::has_cycles);
        let periodic =
            self.openings.as_mut().and_then(|openings| match openings.judge(watches_wall, shear) {
                Some(Verdict::Periodic) => Some((
                    EndReason::Periodic,
                    format!(
                        "the last two cycles are alike: flows and pressures changed by {:.2} %",
                        100.0 * openings.last_change().unwrap_or(0.0)
                    ),
                )),
                _ => None,
            });
        Ok(settled.or(periodic))
    }

    /// Takes the end of the run, which is where the last cycle ends.
    ///
    /// # Errors
    /// As [`Self::after_step`].
    pub fn finish<R: Real, W: MovingWall>(&mut self, flow: &Flow<R, W>) -> Result<(), DriverError> {
        if let Some(wall) = &mut self.wall {
            let shear = wall.finish(flow.time)?;
            // The run ends here anyhow; what counts is that the change is noted.
            let _verdict = self.openings.as_mut().and_then(|openings| openings.judge(true, shear));
        }
        Ok(())
    }
}
