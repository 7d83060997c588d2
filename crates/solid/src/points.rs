//! What is done at each particle between the two sums over its pairs: strain, stress, and what the force reads of both.

use crate::mat3::{from_rows, full, pack};
use crate::material::{Elastic, Fibres};
use glam::{DMat3, DVec3};
use vaso_kernels::{FIELDS, Real, Sym3};

/// Constants of a pass.
pub(crate) struct Constants {
    /// From the sums to the gradient before its correction.
    pub(crate) gradient_scale: f64,
    /// From the sums to the acceleration by damping.
    pub(crate) damping_scale: f64,
    /// From the change of the gradient to its rate \[1/s\]; 0 where nothing led here.
    pub(crate) rate: f64,
    /// Viscosity of the material \[Pa s\].
    pub(crate) viscosity: f64,
    /// Hourglass modulus `k E` \[Pa\].
    pub(crate) hourglass: f64,
}

/// Columns of the particles of a chunk.
pub(crate) struct Points<'a, R, E> {
    pub(crate) material: E,
    pub(crate) constants: &'a Constants,
    /// Directions of the fibres, empty where the material has none.
    pub(crate) fibres: &'a [Fibres],
    pub(crate) correction: &'a [Sym3],
    pub(crate) kinematic: &'a [[R; FIELDS]],
    pub(crate) mass: &'a [f64],
    pub(crate) volume: &'a [f64],
    pub(crate) velocity: &'a [DVec3],
    /// Displacement gradient, that of the step before until it is written.
    pub(crate) gradient: &'a mut [DMat3],
    pub(crate) dynamic: &'a mut [[R; FIELDS]],
    pub(crate) matrix: &'a mut [[R; FIELDS]],
    /// Acceleration by damping between pairs, empty without.
    pub(crate) damping: &'a mut [DVec3],
}

impl<R: Real, E: Elastic> Points<'_, R, E> {
    /// Does all of it by the `sums` of the pairs; with damping the last three of each are its own. Returns the power taken \[W\], or the
    /// place in the chunk of a particle that is turned inside out.
    pub(crate) fn pass<const K: usize>(mut self, sums: &[[f64; K]]) -> Result<f64, usize> {
        let mut power = 0.0;
        for (k, sums) in sums.iter().enumerate().take(self.gradient.len()) {
            power += self.strain(k, sums).ok_or(k)?;
            if let Some(damping) = self.damping.get_mut(k) {
                *damping = self.constants.damping_scale * DVec3::new(sums[9], sums[10], sums[11]);
                power -= self.mass[k] * damping.dot(self.velocity[k]);
            }
        }
        Ok(power)
    }

    /// Strain and stress of particle `k` by the `sums` of its pairs, packed with the hourglass control as `Q = P B - k G / 2`;
    /// returns the power that viscosity takes \[W\], nothing where the body is turned inside out.
    #[inline(always)]
    fn strain(&mut self, k: usize, sums: &[f64]) -> Option<f64> {
        let constants = self.constants;
        let correction = full(&self.correction[k]);
        let gradient = from_rows(sums, constants.gradient_scale) * correction;
        let before = std::mem::replace(&mut self.gradient[k], gradient);
        let f = DMat3::IDENTITY + gradient;
        let determinant = f.determinant();
        if determinant <= 0.0 || determinant.is_nan() {
            return None;
        }
        let mut power = 0.0;
        let mut first_piola = self.material.stress(&f, &self.fibres.get(k).copied().unwrap_or_default());
        if constants.viscosity > 0.0 {
            let rate = constants.rate * (gradient - before);
            let product = f.transpose() * rate;
            let viscous = f * ((0.5 * constants.viscosity) * (product + product.transpose()));
            first_piola += viscous;
            power = self.volume[k] * contraction(&viscous, &rate);
        }
        let q = first_piola * correction - (0.5 * constants.hourglass) * gradient;
        let dynamic = &mut self.dynamic[k];
        *dynamic = self.kinematic[k];
        (self.matrix[k], dynamic[7]) = pack(&q);
        Some(power)
    }
}

/// Sum of the products of all entries.
#[inline(always)]
fn contraction(a: &DMat3, b: &DMat3) -> f64 {
    a.x_axis.dot(b.x_axis) + a.y_axis.dot(b.y_axis) + a.z_axis.dot(b.z_axis)
}
