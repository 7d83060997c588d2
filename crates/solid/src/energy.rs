//! Where the energy of a solid is.

use crate::formulation::total;
use crate::solid::Solid;
use vaso_kernels::Real;

/// Sums over time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ledger {
    pub dissipation: f64,
    pub load_work: f64,
}

/// Energies of a body \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Of motion.
    pub kinetic: f64,
    /// Of the material.
    pub strain: f64,
    /// Of the hourglass control.
    pub hourglass: f64,
    /// Taken since the start by damping between pairs, viscosity and the dashpots of the tissue.
    pub dissipated: f64,
    /// Brought in since the start by the fluid, pressures, gravity and, negative while they are strained, the springs of the
    /// tissue.
    pub load_work: f64,
}

impl Energies {
    /// What is stored, plus what went, minus what came \[J\]: constant but for the error of the time step.
    pub fn balance(&self) -> f64 {
        self.kinetic + self.strain + self.hourglass + self.dissipated - self.load_work
    }
}

impl<R: Real> Solid<R> {
    /// Energies of the body where it stands.
    pub fn energies(&mut self) -> Energies {
        let state = &self.state;
        let kinetic = total(state.len(), |i| 0.5 * state.mass[i] * state.velocity[i].length_squared());
        let [strain, hourglass] = self.body.energies(state, &self.numbers);
        let (dissipated, load_work) = (self.ledger.dissipation, self.ledger.load_work);
        Energies { kinetic, strain, hourglass, dissipated, load_work }
    }
}
