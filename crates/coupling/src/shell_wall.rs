//! A shell as a wall of the fluid: its ghost columns follow positions and directors, and their forces go to its particles.

use crate::columns::{Foot, GhostColumns};
use crate::wall::{CouplingError, MovingWall};
use glam::DVec3;
use vaso_particles::{Columns, Visitor, WallLoad, WallView};
use vaso_shell::{Real, Shell};

/// Shell with the ghost columns that the fluid sees of it.
///
/// A column stands on the face of the lumen, half a thickness from the mid-surface, and goes along the director of its particle. The
/// forces on its ghosts add up to that on the particle, which so gets all the momentum that the fluid loses. Their moment about the
/// particle is left out: it comes from drag alone, as pressure acts along the director.
pub struct ShellWall<R> {
    /// The shell.
    pub shell: Shell<R>,
    columns: GhostColumns,
    pressure_force: Vec<DVec3>,
    viscous_force: Vec<DVec3>,
}

impl<R: Real> ShellWall<R> {
    /// `shell` where it stands, for a fluid of a `spacing` \[m\] whose kernel reaches as far as `support` \[m\].
    pub fn new(shell: Shell<R>, spacing: f64, support: f64) -> Self {
        let n = shell.state.len();
        let feet = (0..n).map(|i| foot(&shell, i)).collect();
        Self {
            columns: GhostColumns::new(feet, spacing, support),
            pressure_force: vec![DVec3::ZERO; n],
            viscous_force: vec![DVec3::ZERO; n],
            shell,
        }
    }

    /// The ghost columns.
    pub fn columns(&self) -> &GhostColumns {
        &self.columns
    }

    /// Bytes held, the shell included.
    pub fn bytes(&mut self) -> usize {
        let vectors = self.pressure_force.capacity() + self.viscous_force.capacity();
        self.shell.bytes() + self.columns.bytes() + size_of::<DVec3>() * vectors
    }
}

/// The lumen face in front of particle `i`, by Steiner's formula for areas and curvatures of a parallel surface.
fn foot<R: Real>(shell: &Shell<R>, i: usize) -> Foot {
    let state = &shell.state;
    let half = 0.5 * state.thickness[i];
    let curvature = shell.curvatures(i);
    let stretch = curvature.map(|k| 1.0 - half * k);
    let (normal, turning) = (state.director[i], state.director_velocity[i]);
    Foot {
        position: state.position(i) - half * normal,
        velocity: state.velocity[i] - half * turning,
        normal,
        turning,
        area: state.area[i] * shell.area_stretch(i) * stretch[0] * stretch[1],
        curvature: [curvature[0] / stretch[0], curvature[1] / stretch[1]],
    }
}

impl<R: Real> MovingWall for ShellWall<R> {
    fn view(&self) -> WallView<'_> {
        self.columns.view()
    }

    fn load(&mut self, load: &WallLoad) -> Result<(), CouplingError> {
        self.columns.gather(load, &mut self.pressure_force, &mut self.viscous_force);
        let load = WallLoad { pressure_force: &self.pressure_force, viscous_force: &self.viscous_force };
        Ok(self.shell.set_load(&load)?)
    }

    fn advance(&mut self, dt: f64) -> Result<usize, CouplingError> {
        let substeps = self.shell.advance(dt)?;
        let shell = &self.shell;
        self.columns.follow(|i| foot(shell, i));
        Ok(substeps)
    }
}

/// What the shell has to remember; its columns follow from it.
impl<R: Real> Columns for ShellWall<R> {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        self.shell.visit(visitor);
    }
}
