//! A wall with what lies between it and the fluid, and the stages of a flow that belong to both.

use crate::wall::{CouplingError, MovingWall};
use glam::DVec3;
use vaso_fluid::{Fluid, Real};
use vaso_particles::{Memory, WallLoad, WallView};

/// A wall that moves, with the forces of the fluid on it.
///
/// An advective step calls [`Self::show`] before the search and [`Self::take_drag`] after the viscosity; each acoustic step
/// [`Self::take_pressure`], [`Self::advance`] and [`Self::show_velocity`] between the conditions at the openings and the
/// continuity.
pub struct Coupling<W> {
    /// The wall.
    pub wall: W,
    /// Sub-steps the wall has taken.
    pub substeps: u64,
    /// Acoustic steps it has been taken along for.
    pub steps: u64,
    /// Work that the fluid has done on it \[J\].
    pub work: f64,
    pressure_force: Vec<DVec3>,
    viscous_force: Vec<DVec3>,
    /// Acceleration \[m/s^2\], without what rings.
    acceleration: Vec<DVec3>,
    /// Velocity before an acoustic step \[m/s\].
    before: Vec<DVec3>,
}

/// Time of the filter of the acceleration, in acoustic steps. The pressure behind the lumen surface answers the acceleration, and
/// acts back on it one step later: unfiltered that rings. A filter of first order is passive at every frequency, which the mean over
/// an advective step is not.
const FILTER: f64 = 3.0;

impl<W: MovingWall> Coupling<W> {
    /// Lets the wall of `fluid` move, as `wall` does; it has to be where it was when the distance of the fluid was measured.
    pub fn new<R: Real>(wall: W, fluid: &mut Fluid<R>) -> Self {
        let view = wall.view();
        fluid.release_wall(&view, wall.thinning());
        let n = view.position.len();
        let zero = || vec![DVec3::ZERO; n];
        Self {
            pressure_force: zero(),
            viscous_force: zero(),
            acceleration: zero(),
            substeps: 0,
            steps: 0,
            work: 0.0,
            before: Vec::new(),
            wall,
        }
    }

    /// Shows the fluid where the wall is, before the search of an advective step.
    pub fn show<R: Real>(&mut self, fluid: &mut Fluid<R>) {
        fluid.take_wall(&self.wall.view(), &self.acceleration);
    }

    /// Takes the viscous force, which holds for the advective step; after the viscosity of the fluid.
    pub fn take_drag<R: Real>(&mut self, fluid: &mut Fluid<R>) {
        fluid.viscous_force_on_wall(&mut self.viscous_force);
    }

    /// Takes the pressure of the kick.
    pub fn take_pressure<R: Real>(&mut self, fluid: &mut Fluid<R>) {
        fluid.pressure_on_wall(&mut self.pressure_force);
    }

    /// Moves the wall by an acoustic step `dt` \[s\] under what has been taken.
    ///
    /// # Errors
    /// When the wall breaks down.
    pub fn advance(&mut self, dt: f64) -> Result<(), CouplingError> {
        let load = WallLoad { pressure_force: &self.pressure_force, viscous_force: &self.viscous_force };
        self.wall.load(&load)?;
        self.before.clear();
        self.before.extend_from_slice(self.wall.view().velocity);
        self.substeps += self.wall.advance(dt)? as u64;
        self.steps += 1;
        // Forces are constant over the step, velocities about linear.
        let velocity = self.before.iter().zip(self.wall.view().velocity).map(|(old, new)| *old + *new);
        let forces = self.pressure_force.iter().zip(&self.viscous_force).map(|(p, v)| *p + *v);
        let share = 1.0 / (1.0 + FILTER);
        let velocities = self.before.iter().zip(self.wall.view().velocity);
        for (a, (old, new)) in self.acceleration.iter_mut().zip(velocities) {
            *a += share * ((*new - *old) / dt - *a);
        }
        self.work += 0.5 * dt * velocity.zip(forces).map(|(v, force)| v.dot(force)).sum::<f64>();
        Ok(())
    }

    /// Shows the fluid the velocity of the wall at the end of an acoustic step `dt` \[s\].
    pub fn show_velocity<R: Real>(&self, fluid: &mut Fluid<R>, dt: f64) {
        fluid.set_wall_velocity(self.wall.view().velocity, &self.acceleration, dt);
    }

    /// Shows all that lies between wall and fluid from one advective step to the next, the wall itself included. What has been read takes
    /// effect with [`MovingWall::resume`] of the wall.
    pub fn remember(&mut self, memory: &mut dyn Memory) {
        // Forces are taken anew before they act, and the velocity before a step is noted in each.
        let Self {
            wall,
            substeps,
            steps,
            work,
            pressure_force: _,
            viscous_force: _,
            acceleration,
            before: _,
        } = self;
        wall.remember(memory);
        memory.counts("coupling.steps", &mut [substeps, steps]);
        memory.fields("coupling.work_j", &mut [work]);
        memory.fixed_vectors("coupling.acceleration", acceleration);
    }

    /// Forces of the fluid on the particles of the wall \[N\] in the last step: by pressure, and by viscosity.
    pub fn load(&self) -> WallLoad<'_> {
        WallLoad { pressure_force: &self.pressure_force, viscous_force: &self.viscous_force }
    }

    /// Particles of the wall.
    pub fn view(&self) -> WallView<'_> {
        self.wall.view()
    }

    /// Bytes held beside the wall itself.
    pub fn bytes(&self) -> usize {
        let vectors = self.pressure_force.capacity()
            + self.viscous_force.capacity()
            + self.acceleration.capacity()
            + self.before.capacity();
        size_of::<DVec3>() * vectors
    }
}
