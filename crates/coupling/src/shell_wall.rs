//! A shell as a wall of the fluid: its ghost columns follow positions and directors, and their forces go to its particles.

use crate::columns::{Foot, GhostColumns};
use crate::wall::{CouplingError, Facet, MovingWall, NAME};
use glam::DVec3;
use rayon::prelude::*;
use vaso_particles::{Memory, WallLoad, WallView};
use vaso_shell::{Real, Shell, ShellError};

/// Shell with the ghost columns that the fluid sees of it.
///
/// A column stands on the face of the lumen, half a thickness from the mid-surface, and goes along the director of its particle. The
/// forces on its ghosts add up to that on the particle, which so gets all the momentum that the fluid loses; what they do beside that as
/// the wall thins is a tension of the mid-surface, which leaves no resultant. Their moment about the particle is left out: it comes from
/// drag, as pressure acts along the director.
pub struct ShellWall<R> {
    /// The shell.
    pub shell: Shell<R>,
    columns: GhostColumns,
    pressure_force: Vec<DVec3>,
    viscous_force: Vec<DVec3>,
    /// Work of the forces of each column on an area strain of one \[J\].
    spread: Vec<f64>,
    /// Rate of the area strain \[1/s\].
    strain_rate: Vec<f64>,
}

impl<R: Real> ShellWall<R> {
    /// `shell` at rest where it stands, for a fluid of a `spacing` \[m\] whose kernel reaches as far as `support` \[m\].
    ///
    /// # Errors
    /// When the shell cannot stand there.
    pub fn new(mut shell: Shell<R>, spacing: f64, support: f64) -> Result<Self, ShellError> {
        let n = shell.state.len();
        shell.refresh()?;
        let feet = (0..n).map(|i| foot(&shell, i, 0.0)).collect();
        Ok(Self {
            columns: GhostColumns::new(feet, spacing, support),
            pressure_force: vec![DVec3::ZERO; n],
            viscous_force: vec![DVec3::ZERO; n],
            spread: vec![0.0; n],
            strain_rate: vec![0.0; n],
            shell,
        })
    }

    /// Moves the columns to where the shell is.
    fn follow(&mut self) {
        let (shell, rate) = (&self.shell, &self.strain_rate);
        self.columns.follow(|i| foot(shell, i, rate[i]));
    }

    /// The ghost columns.
    pub fn columns(&self) -> &GhostColumns {
        &self.columns
    }

    /// Bytes held, the shell included.
    pub fn bytes(&mut self) -> usize {
        let vectors = self.pressure_force.capacity() + self.viscous_force.capacity();
        let numbers = self.spread.capacity() + self.strain_rate.capacity();
        self.shell.bytes() + self.columns.bytes() + size_of::<DVec3>() * vectors + 8 * numbers
    }
}

/// Thinning by area strain of a shell without stress across it.
fn thinning<R: Real>(shell: &Shell<R>) -> f64 {
    let poisson = shell.material().poisson();
    poisson / (1.0 - poisson)
}

/// The lumen face in front of particle `i`, whose area strain changes at a `rate` \[1/s\]. Areas and curvatures are those of a parallel
/// surface (Steiner's formula); the face follows the thinning of the wall.
fn foot<R: Real>(shell: &Shell<R>, i: usize, rate: f64) -> Foot {
    let state = &shell.state;
    let half = 0.5 * state.thickness[i];
    let (strain, thinning) = (shell.area_strain(i), half * thinning(shell));
    let distance = half - thinning * strain;
    let curvature = shell.curvatures(i);
    let stretch = curvature.map(|k| 1.0 - distance * k);
    let (normal, turning) = (state.director[i], state.director_velocity[i]);
    Foot {
        position: state.position(i) - distance * normal,
        velocity: state.velocity[i] - distance * turning + thinning * rate * normal,
        normal,
        turning,
        area: state.area[i] * (1.0 + strain) * stretch[0] * stretch[1],
        area_strain: strain,
        area_strain_rate: rate,
        curvature: [curvature[0] / stretch[0], curvature[1] / stretch[1]],
    }
}

impl<R: Real> MovingWall for ShellWall<R> {
    fn thinning(&self) -> f64 {
        // Ghosts move by half of what a wall of constant volume would thin.
        0.5
    }

    fn view(&self) -> WallView<'_> {
        self.columns.view()
    }

    fn facet_of(&self) -> Vec<u32> {
        self.columns.column().to_vec()
    }

    fn facet(&self, number: usize) -> Facet {
        let foot = &self.columns.feet()[number];
        Facet { area: foot.area * foot.normal, velocity: foot.velocity }
    }

    fn load(&mut self, load: &WallLoad) -> Result<(), CouplingError> {
        self.columns.gather(load, &mut self.pressure_force, &mut self.viscous_force, &mut self.spread);
        let (state, thinning) = (&self.shell.state, thinning(&self.shell));
        (
            &mut self.pressure_force,
            &mut self.spread,
            &self.viscous_force,
            load.face_pressure,
            self.columns.feet(),
        )
            .into_par_iter()
            .enumerate()
            .with_min_len(1024)
            .for_each(|(i, (force, spread, viscous, pressure, foot))| {
                *force += *pressure * foot.area * foot.normal;
                let across = state.director[i].dot(*force + *viscous);
                *spread += 0.5 * state.thickness[i] * thinning * across;
            });
        let (pressure_force, viscous_force) = (&self.pressure_force[..], &self.viscous_force[..]);
        let load = WallLoad { pressure_force, viscous_force, face_pressure: &[] };
        Ok(self.shell.set_load_with_spread(&load, &self.spread)?)
    }

    fn advance(&mut self, dt: f64) -> Result<usize, CouplingError> {
        let substeps = self.shell.advance(dt)?;
        self.shell.area_strain_rates(dt, &mut self.strain_rate);
        self.follow();
        Ok(substeps)
    }

    fn remember(&mut self, memory: &mut dyn Memory) {
        let Self { shell, columns: _, pressure_force: _, viscous_force: _, spread: _, strain_rate } = self;
        shell.remember(NAME, memory);
        // Taken over the step that has passed, whose length is not known any more.
        memory.fixed_numbers("wall.strain_rate", strain_rate);
    }

    fn resume(&mut self) -> Result<(), CouplingError> {
        self.shell.resume()?;
        self.follow();
        Ok(())
    }
}
