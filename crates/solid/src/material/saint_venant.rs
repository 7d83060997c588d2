//! Saint Venant-Kirchhoff.

use super::{Elastic, Fibres, largest_eigenvalue, moduli, norm_squared};
use crate::error::SolidError;
use crate::lanes;
use glam::{DMat3, DVec3};
use vaso_kernels::Lanes;

/// `S = lambda tr(E) I + 2 G E` with the Green strain `E`: for stretches of 0.8 to 1.3, as it stiffens in tension and gives
/// way in compression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SaintVenantKirchhoff {
    lambda: f64,
    shear: f64,
}

impl SaintVenantKirchhoff {
    /// Material of Young's modulus \[Pa\] and Poisson's ratio at rest.
    ///
    /// # Errors
    /// [`SolidError::OutOfRange`] unless `young > 0` and `-1 < poisson < 0.5`.
    pub fn new(young: f64, poisson: f64) -> Result<Self, SolidError> {
        let (bulk, shear) = moduli(young, poisson)?;
        Ok(Self { lambda: bulk - 2.0 / 3.0 * shear, shear })
    }
}

impl Elastic for SaintVenantKirchhoff {
    fn energy(&self, f: &DMat3, _: &Fibres) -> f64 {
        let e = 0.5 * (f.transpose() * *f - DMat3::IDENTITY);
        let trace = e.x_axis.x + e.y_axis.y + e.z_axis.z;
        0.5 * self.lambda * trace * trace + self.shear * norm_squared(&e)
    }

    #[inline(always)]
    fn stress(&self, f: &DMat3, _: &Fibres) -> DMat3 {
        let e = 0.5 * (f.transpose() * *f - DMat3::IDENTITY);
        let trace = e.x_axis.x + e.y_axis.y + e.z_axis.z;
        *f * (2.0 * self.shear * e + DMat3::from_diagonal(DVec3::splat(self.lambda * trace)))
    }

    const IN_LANES: bool = true;

    #[inline(always)]
    fn stress_in_lanes<L: Lanes<Elem = f64>>(&self, f: &[L; 9], _: &[L; 9], _: L) -> [L; 9] {
        let transposed = std::array::from_fn(|k| f[3 * (k % 3) + k / 3]);
        let mut second = lanes::product(&transposed, f);
        let (one, shear) = (L::constant(1.0), L::constant(self.shear));
        let diagonal = [0, 4, 8];
        diagonal.iter().for_each(|&k| second[k] = second[k] - one);
        let trace = second[0] + second[4] + second[8];
        second = second.map(|e| shear * e);
        diagonal.iter().for_each(|&k| second[k] = L::constant(0.5 * self.lambda).fma(trace, second[k]));
        lanes::product(f, &second)
    }

    /// `N.S N` for tension along the wave and `F C F^T` of the elasticity.
    fn modulus(&self, f: &DMat3, _: &Fibres) -> f64 {
        let c = f.transpose() * *f;
        let trace = c.x_axis.x + c.y_axis.y + c.z_axis.z;
        let stretch = largest_eigenvalue(trace, norm_squared(&c));
        let tension = 0.5 * self.lambda * (trace - 3.0) + self.shear * (stretch - 1.0);
        (self.lambda + 2.0 * self.shear) * stretch + tension.max(0.0)
    }

    fn bulk_modulus(&self) -> f64 {
        self.lambda + 2.0 / 3.0 * self.shear
    }

    fn shear_modulus(&self) -> f64 {
        self.shear
    }
}

#[cfg(test)]
mod tests {
    use super::super::checks;
    use super::*;

    #[test]
    fn stress_energy_and_modulus_agree() {
        let material = SaintVenantKirchhoff::new(1e6, 0.4).expect("in range");
        checks::stress_is_derivative(&material, 1e6);
        checks::is_objective(&material, 1e6);
        checks::modulus_is_bound(&material);
    }
}
