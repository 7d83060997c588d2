//! What is read off the forces of a shell: energies, deformation, stiffness.

use crate::forces::Forces;
use crate::law::HourglassEnergy;
use crate::material::Model;
use crate::numbers::Numbers;
use crate::section::{Layer, Present, energy};
use crate::state::ShellState;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real, Store, sweep};

impl<R: Real> Forces<R> {
    /// Energies of membrane, bending, shear and hourglass control \[J\].
    pub(crate) fn energies(&self, state: &ShellState, numbers: &Numbers) -> [f64; 4] {
        let modulus = numbers.hourglass * self.material.young();
        let gather = self.gather();
        let rows = self.reference.rows.chunks();
        let chunks: Vec<[f64; 4]> = (0..rows.len())
            .into_par_iter()
            .map(|c| {
                let mut sums = [[0.0; 1]; CHUNK];
                let stored = Store::Read(&self.reference.hourglass.chunks()[c]);
                sweep(self.isa, &HourglassEnergy, &gather, (&rows[c], c * CHUNK), stored, &mut sums);
                let mut total = [0.0; 4];
                for k in 0..rows[c].len() {
                    let i = c * CHUNK + k;
                    let (base, motion) = (&self.reference.base[i], &self.motion[i]);
                    let (thickness, director) = (state.thickness[i], state.director[i]);
                    let layers = self.layers(i, thickness);
                    let parts = energy(&self.material, thickness, base, motion, director, &layers);
                    for (total, part) in total.iter_mut().zip(parts) {
                        *total += state.area[i] * part;
                    }
                    total[3] += 0.25 * modulus * state.area[i] * sums[k][0];
                }
                total
            })
            .collect();
        chunks.iter().fold([0.0; 4], |sum, part| std::array::from_fn(|k| sum[k] + part[k]))
    }

    /// Largest growth of the stiffness since the reference configuration: 1 at rest.
    pub(crate) fn stiffening(&self) -> f64 {
        let of = |i: usize| {
            let f = DMat3::IDENTITY + self.gradient[i];
            let [x, y] = self.reference.base[i].tangent.map(|t| f * t);
            let (mean, half) = (0.5 * (x.dot(x) + y.dot(y)), 0.5 * (x.dot(x) - y.dot(y)));
            // Not `hypot`, which guards against overflow at a price.
            let radius = (half * half + x.dot(y) * x.dot(y)).sqrt();
            match self.material.model() {
                // d^2 psi / d lambda^2 of E'/8 (lambda^2 - 1)^2, with the strain across taken as equal.
                Model::Resultant => 1.0 + 3.0 * (mean + radius - 1.0).max(0.0),
                // That of an incompressible sheet held across, G (1 + 3 lambda^-4).
                Model::NeoHookean { .. } => {
                    let least = mean - radius;
                    0.25 * (1.0 + 3.0 / (least * least)).max(4.0)
                }
            }
        };
        (0..self.gradient.len()).into_par_iter().with_min_len(1024).map(of).reduce(|| 1.0, f64::max)
    }

    /// Deformation gradient of the mid-surface with the director as the image of the reference one.
    pub(crate) fn deformation(&self, i: usize) -> DMat3 {
        DMat3::IDENTITY + self.gradient[i]
    }

    /// Area vector by reference area, along the present normal on the side of the director.
    pub(crate) fn area_vector(&self, i: usize) -> DVec3 {
        let f = self.deformation(i);
        let [x, y] = self.reference.base[i].tangent.map(|t| f * t);
        x.cross(y)
    }

    /// Deformation gradient along tangents and director at the height `zeta` \[m\].
    pub(crate) fn deformation_at(&self, i: usize, zeta: f64, director: DVec3) -> DMat3 {
        let base = &self.reference.base[i];
        Layer::at(base, zeta).deformation(&Present::new(base, &self.motion[i], director))
    }
}
