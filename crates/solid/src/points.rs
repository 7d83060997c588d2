//! What is done at each particle between the two sums over its pairs: strain, stress, and what the force reads of both.

use crate::lanes::{self, Stress};
use crate::mat3::{from_rows, full, pack};
use crate::material::{Elastic, Fibres};
use glam::{DMat3, DVec3};
use std::ops::Range;
use vaso_kernels::{BLOCK, FIELDS, Isa, Real, Sym3, sweep_points};

/// Determinants for which the stress can be found in lanes.
const PLAIN: Range<f64> = 0.6..1.7;

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
    pub(crate) fn pass<const K: usize>(mut self, isa: Isa, sums: &[[f64; K]]) -> Result<f64, usize> {
        let n = self.gradient.len();
        let in_lanes = E::IN_LANES && self.constants.viscosity == 0.0;
        let mut power = 0.0;
        for first in (0..n).step_by(BLOCK) {
            let block = first..n.min(first + BLOCK);
            if !(in_lanes && self.block(isa, block.clone(), sums)) {
                for k in block {
                    power += self.strain(k, &sums[k]).ok_or(k)?;
                }
            }
        }
        for ((damping, sums), (mass, v)) in
            self.damping.iter_mut().zip(sums).zip(self.mass.iter().zip(self.velocity))
        {
            *damping = self.constants.damping_scale * DVec3::new(sums[9], sums[10], sums[11]);
            power -= mass * damping.dot(*v);
        }
        Ok(power)
    }

    /// [`Self::strain`] of a block at once; `false`, with nothing done, where one is strained so much that it needs care.
    fn block<const K: usize>(&mut self, isa: Isa, block: Range<usize>, sums: &[[f64; K]]) -> bool {
        let (mut own, mut out) = (lanes::blank(), lanes::blank());
        let law = Stress { material: self.material, constants: self.constants };
        let mut plain = true;
        for (k, i) in block.clone().enumerate() {
            lanes::show(&mut own, k, &sums[i], &self.correction[i].0);
        }
        sweep_points(isa, &law, block.len(), &[], &own, &mut out);
        for k in 0..block.len() {
            plain &= PLAIN.contains(&out[lanes::DETERMINANT][k]);
        }
        if plain {
            for (k, i) in block.enumerate() {
                let (gradient, q) = lanes::found(&out, k);
                self.gradient[i] = gradient;
                self.take(i, &q);
            }
        }
        plain
    }

    #[inline(always)]
    fn take(&mut self, i: usize, q: &DMat3) {
        let dynamic = &mut self.dynamic[i];
        *dynamic = self.kinematic[i];
        (self.matrix[i], dynamic[7]) = pack(q);
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
        self.take(k, &q);
        Some(power)
    }
}

/// Sum of the products of all entries.
#[inline(always)]
fn contraction(a: &DMat3, b: &DMat3) -> f64 {
    a.x_axis.dot(b.x_axis) + a.y_axis.dot(b.y_axis) + a.z_axis.dot(b.z_axis)
}
