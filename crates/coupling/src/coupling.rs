//! A wall with what lies between it and the fluid, and the stages of a flow that belong to both.

use crate::wall::{CouplingError, MovingWall};
use glam::DVec3;
use vaso_fluid::{Fluid, Real};
use vaso_particles::{WallLoad, WallView};

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
    /// Velocity at the start of the advective step, then mean acceleration over it.
    start: Vec<DVec3>,
    elapsed: f64,
    /// Velocity before an acoustic step \[m/s\].
    before: Vec<DVec3>,
}

impl<W: MovingWall> Coupling<W> {
    /// Lets the wall of `fluid` move, as `wall` does; it has to be where it was when the distance of the fluid was measured.
    pub fn new<R: Real>(wall: W, fluid: &mut Fluid<R>) -> Self {
        let view = wall.view();
        fluid.release_wall(&view);
        let n = view.position.len();
        let zero = || vec![DVec3::ZERO; n];
        Self {
            pressure_force: zero(),
            viscous_force: zero(),
            start: view.velocity.to_vec(),
            elapsed: 0.0,
            substeps: 0,
            steps: 0,
            work: 0.0,
            before: Vec::new(),
            wall,
        }
    }

    /// Shows the fluid where the wall is, before the search of an advective step.
    ///
    /// The pressure behind the lumen surface wants the acceleration. That of an acoustic step rings with the waves in the wall, so
    /// the mean over the last advective step is taken; being late, it damps what is slower than that.
    pub fn show<R: Real>(&mut self, fluid: &mut Fluid<R>) {
        let view = self.wall.view();
        let per_time = if self.elapsed > 0.0 { 1.0 / self.elapsed } else { 0.0 };
        for (start, v) in self.start.iter_mut().zip(view.velocity) {
            *start = per_time * (*v - *start);
        }
        fluid.take_wall(&view, &self.start);
        self.start.copy_from_slice(view.velocity);
        self.elapsed = 0.0;
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
        self.elapsed += dt;
        // Forces are constant over the step, velocities about linear.
        let velocity = self.before.iter().zip(self.wall.view().velocity).map(|(old, new)| *old + *new);
        let forces = self.pressure_force.iter().zip(&self.viscous_force).map(|(p, v)| *p + *v);
        self.work += 0.5 * dt * velocity.zip(forces).map(|(v, force)| v.dot(force)).sum::<f64>();
        Ok(())
    }

    /// Shows the fluid the velocity of the wall at the end of an acoustic step `dt` \[s\].
    pub fn show_velocity<R: Real>(&self, fluid: &mut Fluid<R>, dt: f64) {
        fluid.set_wall_velocity(self.wall.view().velocity, dt);
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
            + self.start.capacity()
            + self.before.capacity();
        size_of::<DVec3>() * vectors
    }
}
