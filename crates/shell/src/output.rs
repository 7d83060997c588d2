//! Quantities of one particle, for files and pictures.

use crate::material::{Model, SHEAR_CORRECTION, across, neo_hookean_stress};
use crate::section::{Present, cauchy_green, first_piola};
use crate::shell::Shell;
use glam::{DMat3, DVec3};
use vaso_kernels::Real;

/// Where through the thickness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Height {
    /// The face against the director: that of the lumen.
    Inner,
    /// The mid-surface.
    Middle,
    /// The face on the side of the director.
    Outer,
}

impl<R: Real> Shell<R> {
    /// Cauchy stress of the material \[Pa\] at particle `i` of the columns, without damping and hourglass control.
    pub fn cauchy_stress(&self, i: usize, height: Height) -> DMat3 {
        let half = 0.5 * self.state.thickness[i];
        let zeta = match height {
            Height::Inner => -half,
            Height::Middle => 0.0,
            Height::Outer => half,
        };
        let f = self.forces.deformation_at(i, zeta, self.state.director[i]);
        let c = cauchy_green(&f);
        let material = self.material();
        let [c11, c22, c12, c13, c23] = c;
        let (shear, stretch) = (material.shear(), self.stretch_across(&c));
        let stress = match material.model() {
            Model::Resultant => {
                let (plate, nu) = (material.plate(), material.poisson());
                let (e11, e22) = (0.5 * (c11 - 1.0), 0.5 * (c22 - 1.0));
                let transverse = SHEAR_CORRECTION * shear;
                [
                    plate * (e11 + nu * e22),
                    plate * (e22 + nu * e11),
                    shear * c12,
                    transverse * c13,
                    transverse * c23,
                ]
            }
            Model::NeoHookean { .. } => neo_hookean_stress(shear, material.lame(), &c),
        };
        let j = (c11 * c22 - c12 * c12).sqrt() * stretch;
        (1.0 / j) * (first_piola(&f, &stress) * f.transpose())
    }

    /// Von Mises stress \[Pa\] at particle `i`.
    pub fn von_mises(&self, i: usize, height: Height) -> f64 {
        let s = self.cauchy_stress(i, height);
        let mean = (s.x_axis.x + s.y_axis.y + s.z_axis.z) / 3.0;
        let d = s - DMat3::from_diagonal(DVec3::splat(mean));
        (1.5 * (d.x_axis.length_squared() + d.y_axis.length_squared() + d.z_axis.length_squared())).sqrt()
    }

    /// Principal stresses in the surface \[Pa\] at particle `i`, the larger first.
    pub fn principal_stresses(&self, i: usize, height: Height) -> [f64; 2] {
        let s = self.cauchy_stress(i, height);
        let n = self.normal(i);
        let t1 = self.forces.deformation(i) * self.forces.reference.base[i].tangent[0];
        let t1 = (t1 - t1.dot(n) * n).normalize_or_zero();
        let t2 = n.cross(t1);
        let (a, b, c) = (t1.dot(s * t1), t2.dot(s * t2), t1.dot(s * t2));
        let (mean, radius) = (0.5 * (a + b), (0.5 * (a - b)).hypot(c));
        [mean + radius, mean - radius]
    }

    /// Unit normal of the present mid-surface at particle `i`; it differs from the director by transverse shear.
    pub fn normal(&self, i: usize) -> DVec3 {
        self.forces.area_vector(i).normalize_or_zero()
    }

    /// Present principal curvatures of the mid-surface \[1/m\] at particle `i`, the larger first: positive where directors spread,
    /// `1/R` and zero on a tube seen from inside. They are those of the shape operator `g_a.g_b` to `g_a.n_,b`.
    pub fn curvatures(&self, i: usize) -> [f64; 2] {
        let base = &self.forces.reference.base[i];
        let Present { g, n, .. } = Present::new(base, &self.forces.motion[i], self.state.director[i]);
        let [a11, a22, a12] = [g[0].dot(g[0]), g[1].dot(g[1]), g[0].dot(g[1])];
        let [b11, b22, b12] = [g[0].dot(n[0]), g[1].dot(n[1]), 0.5 * (g[0].dot(n[1]) + g[1].dot(n[0]))];
        let determinant = a11 * a22 - a12 * a12;
        let mean = 0.5 * (a22 * b11 - 2.0 * a12 * b12 + a11 * b22) / determinant;
        let spread = (mean * mean - (b11 * b22 - b12 * b12) / determinant).max(0.0).sqrt();
        [mean + spread, mean - spread]
    }

    /// Present over reference area at particle `i`.
    pub fn area_stretch(&self, i: usize) -> f64 {
        self.forces.area_vector(i).length()
    }

    /// Present thickness \[m\] at particle `i`: that at which there is no stress across the shell.
    pub fn thickness(&self, i: usize) -> f64 {
        let f = self.forces.deformation_at(i, 0.0, self.state.director[i]);
        self.state.thickness[i] * self.stretch_across(&cauchy_green(&f))
    }

    /// Stretch across the shell at the Cauchy-Green components `c`; not a number where the linear law has none.
    fn stretch_across(&self, c: &[f64; 5]) -> f64 {
        let [c11, c22, c12, ..] = *c;
        let material = self.material();
        let square = match material.model() {
            Model::Resultant => {
                let nu = material.poisson();
                1.0 - nu / (1.0 - nu) * (c11 + c22 - 2.0)
            }
            Model::NeoHookean { .. } => across(material.shear(), material.lame(), c11 * c22 - c12 * c12),
        };
        square.sqrt()
    }
}
