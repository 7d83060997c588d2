//! How loads are put on a shell.

use crate::error::{ShellError, within};
use crate::load::Pressure;
use crate::shell::Shell;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::Real;
use vaso_particles::WallLoad;

impl<R: Real> Shell<R> {
    /// Ties particles to the tissue around: a traction `-stiffness u - damping v` (Moireau et al. 2012; 1e6 to 1e7 Pa/m and 1e3
    /// to 1e5 Pa s/m are usual).
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::OutOfRange`] for numbers below zero.
    pub fn add_tissue(&mut self, particles: &[u32], stiffness: f64, damping: f64) -> Result<(), ShellError> {
        within("stiffness", stiffness, stiffness >= 0.0, "0 Pa/m or more")?;
        within("damping", damping, damping >= 0.0, "0 Pa s/m or more")?;
        let at = self.places("tissue", particles)?;
        let (area, tissue) = (&self.state.area, &mut self.loads.tissue);
        tissue.stiffness.resize(area.len(), 0.0);
        // Springs alone have no dashpots to ask every sub-step.
        if damping > 0.0 {
            tissue.damping.resize(area.len(), 0.0);
        }
        for i in at.into_iter().map(|at| at as usize) {
            tissue.stiffness[i] += stiffness * area[i];
            if damping > 0.0 {
                tissue.damping[i] += damping * area[i];
            }
        }
        self.ready = false;
        Ok(())
    }

    /// Puts a pressure \[Pa\] on particles, towards the side of their directors, which follows their area; returns the number to
    /// change it by. `areas` \[m^2\] are those that are loaded: of the lumen, which is narrower than the mid-surface: `1 - t / 2R`
    /// times its area on a tube. A negative pressure takes away the one at which the reference configuration is unloaded.
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::Count`] unless there is one area a particle; [`ShellError::OutOfRange`] for a
    /// pressure that is not finite.
    pub fn add_pressure(
        &mut self,
        particles: &[u32],
        areas: &[f64],
        pressure: f64,
    ) -> Result<usize, ShellError> {
        within("pressure", pressure, true, "any finite number")?;
        let at = self.places("pressure", particles)?;
        if areas.len() != at.len() {
            return Err(ShellError::Count { what: "areas", given: areas.len(), expected: at.len() });
        }
        let mut area = vec![0.0; self.state.len()];
        at.iter().zip(areas).for_each(|(&at, loaded)| area[at as usize] += loaded);
        self.loads.pressures.push(Pressure { area, value: pressure });
        self.ready = false;
        Ok(self.loads.pressures.len() - 1)
    }

    /// Changes the pressure \[Pa\] that [`Self::add_pressure`] gave `number`.
    ///
    /// # Panics
    /// If there is no such pressure.
    pub fn set_pressure(&mut self, number: usize, pressure: f64) {
        self.loads.pressures[number].value = pressure;
        self.ready = false;
    }

    /// Adds dead forces \[N\], one a particle.
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::Count`] unless there is one force a particle.
    pub fn add_forces(&mut self, particles: &[u32], forces: &[DVec3]) -> Result<(), ShellError> {
        let at = self.places("forces", particles)?;
        if forces.len() != at.len() {
            return Err(ShellError::Count { what: "forces", given: forces.len(), expected: at.len() });
        }
        self.loads.forces.extend(at.into_iter().zip(forces.iter().copied()));
        self.ready = false;
        Ok(())
    }

    /// Adds dead moments \[N m\] about axes fixed in space, one a particle.
    ///
    /// # Errors
    /// As [`Self::add_forces`].
    pub fn add_moments(&mut self, particles: &[u32], moments: &[DVec3]) -> Result<(), ShellError> {
        let at = self.places("moments", particles)?;
        if moments.len() != at.len() {
            return Err(ShellError::Count { what: "moments", given: moments.len(), expected: at.len() });
        }
        self.loads.moments.extend(at.into_iter().zip(moments.iter().copied()));
        self.ready = false;
        Ok(())
    }

    /// Lets particles answer the fluid before it implicitly: for walls so thin that the force of a step of the fluid would turn
    /// their velocity around, `thickness < 0.6` spacings of the fluid.
    ///
    /// `impedance` \[Pa s/m\] is density times sound speed of the fluid, `share` (0.5 to 1) how much of it is taken implicitly. It
    /// acts like a mass `share * impedance * dt` by area in one step, and dissipates nothing.
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::OutOfRange`] for numbers without a meaning.
    pub fn add_impedance(&mut self, particles: &[u32], impedance: f64, share: f64) -> Result<(), ShellError> {
        within("impedance", impedance, impedance >= 0.0, "0 Pa s/m or more")?;
        within("share", share, (0.5..=1.0).contains(&share), "0.5 to 1")?;
        let at = self.places("impedance", particles)?;
        let (area, coefficient) = (&self.state.area, &mut self.loads.impedance.coefficient);
        coefficient.resize(area.len(), 0.0);
        at.into_iter().for_each(|at| coefficient[at as usize] += share * impedance * area[at as usize]);
        Ok(())
    }

    /// Acceleration of all particles \[m/s^2\].
    pub fn set_gravity(&mut self, gravity: DVec3) {
        self.loads.gravity = gravity;
        self.ready = false;
    }

    /// Takes the forces of the fluid, which hold until the next ones.
    ///
    /// # Errors
    /// [`ShellError::Count`] unless there is one force a particle.
    pub fn set_load(&mut self, load: &WallLoad) -> Result<(), ShellError> {
        self.take_load(load)?;
        self.loads.update(&self.state, &self.forces);
        Ok(())
    }

    /// Takes the forces of the fluid; accelerations do not follow yet.
    pub(crate) fn take_load(&mut self, load: &WallLoad) -> Result<(), ShellError> {
        let expected = self.state.len();
        for (what, given) in
            [("pressure_force", load.pressure_force.len()), ("viscous_force", load.viscous_force.len())]
        {
            if given != expected {
                return Err(ShellError::Count { what, given, expected });
            }
        }
        self.loads.fluid.resize(expected, DVec3::ZERO);
        (&mut self.loads.fluid, load.pressure_force, load.viscous_force)
            .into_par_iter()
            .with_min_len(1024)
            .for_each(|(force, p, v)| *force = *p + *v);
        Ok(())
    }
}
