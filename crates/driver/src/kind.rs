//! The kinds of flow: what a case says of its wall and its precision, as types.

use crate::Case;
use crate::deforming::Deforming;
use crate::diverged::Diverged;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::plan::Plan;
use crate::world::{Bodies, build_flow_in};
use vaso_coupling::{NoWall, ShellWall};
use vaso_fluid::Real;
use vaso_scene::{Precision, Wall};
use vaso_solid::Solid;

/// What is done with a flow, whatever its kind.
pub(crate) trait OfKind {
    /// What comes of it.
    type Done;

    /// Does it with pairs of precision `R` and walls of kind `W`.
    fn of<R: Real, W: Deforming + Send + 'static>(self) -> Self::Done;
}

/// Does `what` with the kind of flow that a case calls for.
pub(crate) fn with_kind<T: OfKind>(case: &Case, plan: &Plan, what: T) -> T::Done {
    match (plan.precision, &case.scene.wall) {
        (Precision::Mixed, Wall::Rigid | Wall::RigidShell) => what.of::<f32, NoWall>(),
        (Precision::Double, Wall::Rigid | Wall::RigidShell) => what.of::<f64, NoWall>(),
        (Precision::Mixed, Wall::Solid(_)) => what.of::<f32, Solid<f32>>(),
        (Precision::Double, Wall::Solid(_)) => what.of::<f64, Solid<f64>>(),
        (Precision::Mixed, Wall::Shell(_)) => what.of::<f32, ShellWall<f32>>(),
        (Precision::Double, Wall::Shell(_)) => what.of::<f64, ShellWall<f64>>(),
    }
}

/// Where a flow stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// Simulated time \[s\].
    pub time: f64,
    /// Particles of the blood.
    pub particles: usize,
    /// Advective steps taken.
    pub advective_steps: u64,
    /// Acoustic steps taken.
    pub acoustic_steps: u64,
    /// Sum over acoustic steps of the number of fluid particles.
    pub particle_substeps: u64,
}

/// A flow of any kind, for those that need not know which: [`any_flow`] makes it.
pub trait AnyFlow: Send {
    /// Takes one advective step, no further than to `until` \[s\].
    ///
    /// # Errors
    /// As [`Flow::step`].
    fn step(&mut self, until: f64) -> Result<(), Diverged>;

    /// Where it stands.
    fn standing(&self) -> Standing;

    /// Bytes held by its bodies.
    fn bytes(&mut self) -> usize;
}

impl<R: Real, W: Deforming + Send> AnyFlow for Flow<R, W> {
    fn step(&mut self, until: f64) -> Result<(), Diverged> {
        Self::step(self, until)
    }

    fn standing(&self) -> Standing {
        Standing {
            time: self.time,
            particles: self.fluid.state.len(),
            advective_steps: self.advective_steps,
            acoustic_steps: self.acoustic_steps,
            particle_substeps: self.particle_substeps,
        }
    }

    fn bytes(&mut self) -> usize {
        self.fluid.bytes() + self.wall.as_mut().map_or(0, |w| w.wall.bytes() + w.bytes())
    }
}

/// [`build_flow_in`] the kind of wall that the case has, at the precision that is planned.
///
/// # Errors
/// As there.
pub fn any_flow(case: &Case, plan: &Plan, bodies: Bodies) -> Result<Box<dyn AnyFlow>, DriverError> {
    struct Build<'a>(&'a Case, &'a Plan, Bodies);
    impl OfKind for Build<'_> {
        type Done = Result<Box<dyn AnyFlow>, DriverError>;

        fn of<R: Real, W: Deforming + Send + 'static>(self) -> Self::Done {
            let Self(case, plan, bodies) = self;
            Ok(Box::new(build_flow_in::<R, W>(case, plan, bodies)?))
        }
    }
    with_kind(case, plan, Build(case, plan, bodies))
}
