//! Where the energy of a solid is.

use crate::material::{Elastic, Material, young};
use crate::solid::{Formulation, Solid};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real};

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
        let kinetic = chunked(state.len(), |i| 0.5 * state.mass[i] * state.velocity[i].length_squared());
        let (strain, hourglass) = match &mut self.formulation {
            Formulation::Total(body) => {
                let energy = |i: usize| {
                    let (f, fibres) = (body.deformation(i), body.fibres(i));
                    let density = match &self.material {
                        Material::SaintVenantKirchhoff(m) => m.energy(&f, &fibres),
                        Material::NeoHookean(m) => m.energy(&f, &fibres),
                        Material::HolzapfelGasserOgden(m) => m.energy(&f, &fibres),
                        Material::HypoElastic(_) => {
                            unreachable!("a hypo-elastic body is not total-Lagrangian")
                        }
                    };
                    state.volume[i] * density
                };
                let strain = chunked(state.len(), energy);
                let (bulk, shear) = self.material.moduli();
                let modulus = self.numbers.hourglass.stiffness * young(bulk, shear);
                let hourglass =
                    if modulus > 0.0 { body.hourglass_energy(&state.volume, modulus) } else { 0.0 };
                (strain, hourglass)
            }
        };
        let (dissipated, load_work) = (self.ledger.dissipation, self.ledger.load_work);
        Energies { kinetic, strain, hourglass, dissipated, load_work }
    }
}

/// Sum over particles in an order that does not depend on threads.
fn chunked(n: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    let chunks: Vec<f64> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|c| (c * CHUNK..n.min((c + 1) * CHUNK)).map(&term).sum())
        .collect();
    chunks.iter().sum()
}
