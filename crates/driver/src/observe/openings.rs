//! Cycles of the openings, and whether they have become alike.

use crate::error::DriverError;
use crate::flow::Flow;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_metrics::{Change, Criterion, OpeningCycle, OpeningCycles, OpeningSample, Verdict};
use vaso_particles::Memory;

/// How much more the wall shear stress of a cycle may differ than the openings: it is a small difference of large sums.
const SHEAR_LENIENCE: f64 = 2.0;

/// Follows flow and pressure of the openings over cycles.
pub struct OpeningObserver {
    names: Vec<String>,
    cycles: OpeningCycles,
    criterion: Option<Criterion>,
    /// Whole cycles so far.
    pub completed: Vec<OpeningCycle>,
    /// How much each but the first differs from the one before.
    pub changes: Vec<Change>,
    /// Change of the time-averaged wall shear stress of each but the first, where it is known.
    pub shear_changes: Vec<Option<f64>>,
    judged: usize,
    has_begun: bool,
}

impl OpeningObserver {
    /// Cycles of `period` \[s\] from the start; with `alike` the run may end once they differ by less than that share.
    ///
    /// # Errors
    /// When the period is not positive.
    pub(super) fn new(names: Vec<String>, period: f64, alike: Option<f64>) -> Result<Self, DriverError> {
        let criterion = alike.map(|share| Criterion {
            openings: share,
            shear: SHEAR_LENIENCE * share,
            // The case says after how many cycles to end in any event.
            most_cycles: u64::MAX,
        });
        Ok(Self {
            cycles: OpeningCycles::new(names.clone(), 0.0, period)?,
            names,
            criterion,
            completed: Vec::new(),
            changes: Vec::new(),
            shear_changes: Vec::new(),
            judged: 0,
            has_begun: false,
        })
    }

    pub(super) fn remember(&mut self, memory: &mut dyn Memory) {
        let Self { names, cycles, criterion: _, completed, changes, shear_changes, judged, has_begun } = self;
        cycles.remember("cycles", memory);
        let [mut n_completed, mut n_changes, mut n_judged, mut begun] =
            [completed.len(), changes.len(), *judged, usize::from(*has_begun)].map(|n| n as u64);
        memory.counts("cycles.counts", &mut [&mut n_completed, &mut n_changes, &mut n_judged, &mut begun]);
        completed.resize_with(n_completed as usize, || OpeningCycle::empty(names));
        for (k, cycle) in completed.iter_mut().enumerate() {
            cycle.remember(&format!("cycles.{k}"), memory);
        }
        changes.resize_with(n_changes as usize, || Change::none(names.len()));
        for (k, change) in changes.iter_mut().enumerate() {
            change.remember(&format!("cycles.{k}.change"), memory);
        }
        // Not a number where the wall is not watched.
        let mut shear: Vec<f64> = shear_changes.iter().map(|change| change.unwrap_or(f64::NAN)).collect();
        memory.numbers("cycles.shear_changes", &mut shear);
        *shear_changes = shear.into_iter().map(|change| Some(change).filter(|c| !c.is_nan())).collect();
        (*judged, *has_begun) = (n_judged as usize, begun != 0);
    }

    pub(super) fn add<R: Real, W: MovingWall>(&mut self, flow: &Flow<R, W>) -> Result<(), DriverError> {
        let sample = |r: &vaso_boundary::Reading| OpeningSample {
            flow: r.flow,
            pressure: r.pressure,
            kinetic_power: r.kinetic_power,
        };
        let samples: Vec<OpeningSample> = flow.readings.iter().map(sample).collect();
        if !self.has_begun {
            // Nothing has been measured at the start, and the first step is short.
            self.cycles.add(0.0, &samples)?;
            self.has_begun = true;
        }
        if let Some(cycle) = self.cycles.add(flow.time, &samples)? {
            if let Some(before) = self.completed.last() {
                self.changes.push(Change::between(before, &cycle));
                self.shear_changes.push(None);
            }
            self.completed.push(cycle);
        }
        Ok(())
    }

    /// Verdict on a cycle that ended. Where the wall is watched it comes with the change of its stress, which is known a
    /// little later.
    pub(super) fn judge(&mut self, watches_wall: bool, shear: Option<f64>) -> Option<Verdict> {
        if shear.is_some()
            && let Some(last) = self.shear_changes.last_mut()
        {
            *last = shear;
        }
        let is_due = self.changes.len() > self.judged && (!watches_wall || shear.is_some());
        if !is_due {
            return None;
        }
        self.judged = self.changes.len();
        let criterion = self.criterion?;
        Some(criterion.judge(self.completed.len() as u64, self.changes.last(), shear))
    }

    /// Largest change of a flow or pressure between the last two cycles, relative.
    pub fn last_change(&self) -> Option<f64> {
        self.changes.last().map(Change::largest)
    }
}
