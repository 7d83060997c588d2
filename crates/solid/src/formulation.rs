//! What a body asks of the way its forces come about.

use crate::error::SolidError;
use crate::numbers::Numbers;
use crate::state::SolidState;
use glam::DMat3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, sum_in_order};
use vaso_particles::Visitor;

/// Strain, stress and forces of a body. Each call covers all particles; what runs per pair is known to the compiler.
pub(crate) trait Formulation: Send + Sync {
    /// Moves the body by its velocity over `dt` \[s\].
    fn drift(&mut self, state: &mut SolidState, dt: f64);

    /// Writes the acceleration of all particles, and returns the energy \[J\] that damping and viscosity took over the step
    /// `dt` \[s\] that led here, 0 for none.
    fn accelerate(&mut self, state: &mut SolidState, numbers: &Numbers, dt: f64) -> Result<f64, SolidError>;

    /// Largest P-wave modulus in reference lengths \[Pa\].
    fn modulus(&self) -> f64;

    /// Deformation gradient of particle `i`.
    fn deformation(&self, i: usize) -> DMat3;

    /// Cauchy stress of the material at particle `i` \[Pa\].
    fn cauchy_stress(&self, i: usize) -> DMat3;

    /// Energies of the material and of the hourglass control \[J\].
    fn energies(&mut self, state: &SolidState, numbers: &Numbers) -> [f64; 2];

    /// Neighbour pairs, each direction counted.
    fn n_pairs(&self) -> usize;

    /// Bytes held, without the columns it shows to visitors.
    fn bytes(&self) -> usize;

    /// Shows columns that belong to the state of the body.
    fn visit(&mut self, visitor: &mut dyn Visitor);
}

/// Sum over particles in an order that does not depend on threads.
pub(crate) fn total(n: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    let of_chunk = |c: usize| (c * CHUNK..n.min((c + 1) * CHUNK)).map(&term).sum::<f64>();
    sum_in_order((0..n.div_ceil(CHUNK)).into_par_iter().map(of_chunk))
}
