//! Quantities of one particle, for files and pictures.

use crate::material::norm_squared;
use crate::solid::Solid;
use glam::{DMat3, DVec3};
use nalgebra::{Matrix3, SymmetricEigen};
use vaso_kernels::Real;

impl<R: Real> Solid<R> {
    /// Deformation gradient of particle `i` of the columns.
    pub fn deformation_gradient(&self, i: usize) -> DMat3 {
        self.body.deformation(i)
    }

    /// Cauchy stress of the material \[Pa\] at particle `i`, without damping and hourglass control.
    pub fn cauchy_stress(&self, i: usize) -> DMat3 {
        self.body.cauchy_stress(i)
    }

    /// Von Mises stress \[Pa\] at particle `i`: what shears the material, as the tension of a pulled bar that shears as much.
    pub fn von_mises(&self, i: usize) -> f64 {
        let stress = self.cauchy_stress(i);
        let mean = (stress.x_axis.x + stress.y_axis.y + stress.z_axis.z) / 3.0;
        let deviatoric = stress - DMat3::from_diagonal(DVec3::splat(mean));
        (1.5 * norm_squared(&deviatoric)).sqrt()
    }

    /// Principal stretches of particle `i`, largest first.
    pub fn principal_stretches(&self, i: usize) -> [f64; 3] {
        let f = self.body.deformation(i);
        let c = f.transpose() * f;
        let [x, y, z] = [c.x_axis, c.y_axis, c.z_axis];
        let matrix = Matrix3::new(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z);
        let eigenvalues = SymmetricEigen::new(matrix).eigenvalues;
        let mut stretches = [0, 1, 2].map(|k| eigenvalues[k].max(0.0).sqrt());
        stretches.sort_by(|a, b| b.total_cmp(a));
        stretches
    }
}
