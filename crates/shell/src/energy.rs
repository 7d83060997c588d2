//! Where the energy of a shell is.

use crate::shell::Shell;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real};

/// Sums over time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ledger {
    pub dissipation: f64,
    pub load_work: f64,
}

/// Energies of a shell \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Of the motion of the mid-surface.
    pub kinetic: f64,
    /// Of the turning directors, with their scaled inertia.
    pub rotary: f64,
    /// Of the strain of the mid-surface.
    pub membrane: f64,
    /// Of bending.
    pub bending: f64,
    /// Of transverse shear.
    pub shear: f64,
    /// Of the hourglass control.
    pub hourglass: f64,
    /// Taken since the start by damping and the dashpots of the tissue.
    pub dissipated: f64,
    /// Brought in since the start by the fluid, pressures, forces, moments, gravity and, negative while they are strained, the
    /// springs of the tissue.
    pub load_work: f64,
}

impl Energies {
    /// Energy of the material \[J\].
    pub fn strain(&self) -> f64 {
        self.membrane + self.bending + self.shear
    }

    /// What is stored, plus what went, minus what came \[J\]: constant but for the error of the time step.
    pub fn balance(&self) -> f64 {
        self.kinetic + self.rotary + self.strain() + self.hourglass + self.dissipated - self.load_work
    }
}

impl<R: Real> Shell<R> {
    /// Energies of the shell where it stands.
    pub fn energies(&self) -> Energies {
        let [kinetic, rotary] = self.kinetic();
        let [membrane, bending, shear, hourglass] = self.forces.energies(&self.state, &self.numbers);
        let (dissipated, load_work) = (self.ledger.dissipation, self.ledger.load_work);
        Energies { kinetic, rotary, membrane, bending, shear, hourglass, dissipated, load_work }
    }

    /// Kinetic energies of mid-surface and directors \[J\], added up in an order that does not depend on threads.
    pub(crate) fn kinetic(&self) -> [f64; 2] {
        let (state, n) = (&self.state, self.state.len());
        let chunks: Vec<[f64; 2]> = (0..n.div_ceil(CHUNK))
            .into_par_iter()
            .map(|c| {
                let mut sum = [0.0; 2];
                for i in c * CHUNK..n.min((c + 1) * CHUNK) {
                    sum[0] += 0.5 * state.mass[i] * state.velocity[i].length_squared();
                    sum[1] += 0.5 * state.rotary_inertia[i] * state.director_velocity[i].length_squared();
                }
                sum
            })
            .collect();
        chunks.iter().fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
    }
}
