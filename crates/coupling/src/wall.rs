//! What a wall that moves has to be able to do, and the solid that can.

use glam::DVec3;
use vaso_particles::{Memory, WallLoad, WallView};
use vaso_shell::ShellError;
use vaso_solid::{Real, Solid, SolidError};

/// A wall that cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CouplingError {
    /// The solid of the wall says why.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// The shell of the wall says why.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

/// A part of the face towards the lumen, which bears the level of the pressure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facet {
    /// Present area, along the normal away from the lumen \[m^2\].
    pub area: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
}

/// Stands for no facet in [`MovingWall::facet_of`].
pub const NO_FACET: u32 = u32::MAX;

/// A wall that moves, under forces of the fluid or of itself.
pub trait MovingWall: Sync {
    /// Particles as the fluid sees them, with their velocities at the end of the last step; always as many, in the same order.
    fn view(&self) -> WallView<'_>;

    /// Strain across the wall per strain of its area, with the other sign, as the particles of the view show it: 1 where they keep their
    /// volume.
    fn thinning(&self) -> f64;

    /// The facet in front of each particle of the view, or [`NO_FACET`]: the fluid in front of the particles is that on the facet.
    fn facet_of(&self) -> Vec<u32>;

    /// Facet of this number, of those that [`Self::facet_of`] names.
    fn facet(&self, number: usize) -> Facet;

    /// Takes the forces of the fluid, which hold until the next ones.
    ///
    /// # Errors
    /// When they do not fit the wall.
    fn load(&mut self, load: &WallLoad) -> Result<(), CouplingError>;

    /// Goes on by a step of the fluid `dt` \[s\], under forces that stay the same; returns the number of sub-steps it took.
    ///
    /// # Errors
    /// When the wall breaks down.
    fn advance(&mut self, dt: f64) -> Result<usize, CouplingError>;

    /// Shows all that the wall carries from step to step.
    fn remember(&mut self, memory: &mut dyn Memory);

    /// Goes on from what [`Self::remember`] has read: to the same bits.
    ///
    /// # Errors
    /// When what has been read is no state of the wall.
    fn resume(&mut self) -> Result<(), CouplingError>;
}

/// What the state of a wall goes by.
pub(crate) const NAME: &str = "wall";

impl<R: Real> MovingWall for Solid<R> {
    fn thinning(&self) -> f64 {
        self.material().thinning()
    }

    fn view(&self) -> WallView<'_> {
        self.wall_view()
    }

    fn facet_of(&self) -> Vec<u32> {
        // NO_FACET is what the solid has for none.
        self.behind()
    }

    fn facet(&self, number: usize) -> Facet {
        let (out, velocity) = self.borne(number);
        Facet { area: -out, velocity }
    }

    fn load(&mut self, load: &WallLoad) -> Result<(), CouplingError> {
        Ok(self.set_load(load)?)
    }

    fn advance(&mut self, dt: f64) -> Result<usize, CouplingError> {
        Ok(Solid::advance(self, dt)?)
    }

    fn remember(&mut self, memory: &mut dyn Memory) {
        Solid::remember(self, NAME, memory);
    }

    fn resume(&mut self) -> Result<(), CouplingError> {
        Ok(Solid::resume(self)?)
    }
}
