//! Nearly incompressible neo-Hookean.

use super::{Elastic, Fibres, Stress, cofactor, largest_eigenvalue, moduli, norm_squared};
use crate::error::SolidError;
use glam::DMat3;

/// `psi = G/2 (J^(-2/3) tr C - 3) + K/4 (J^2 - 1 - 2 ln J)`: the usual matrix of soft tissue.
///
/// The volumetric part is that of Simo and Taylor (1982); it resists both collapse and extension without bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    bulk: f64,
    shear: f64,
}

impl NeoHookean {
    /// Material of Young's modulus \[Pa\] and Poisson's ratio at rest.
    ///
    /// # Errors
    /// [`SolidError::OutOfRange`] unless `young > 0` and `-1 < poisson < 0.5`.
    pub fn new(young: f64, poisson: f64) -> Result<Self, SolidError> {
        let (bulk, shear) = moduli(young, poisson)?;
        Ok(Self { bulk, shear })
    }
}

/// Inverse, determinant and what waves need of a deformation gradient.
pub(super) struct Inverse {
    /// `F^-T`.
    pub(super) transposed: DMat3,
    /// `det F`.
    pub(super) j: f64,
    /// `tr C`, `C = F^T F`.
    pub(super) i1: f64,
    /// Bound of the largest eigenvalue of `C`.
    pub(super) stretch: f64,
    /// Bound of the largest eigenvalue of the inverse of `C`.
    pub(super) compression: f64,
}

impl Inverse {
    #[inline(always)]
    pub(super) fn new(f: &DMat3) -> Self {
        let cofactor = cofactor(f);
        let j = f.x_axis.dot(cofactor.x_axis);
        let transposed = (1.0 / j) * cofactor;
        // |C|^2 = I1^2 - 2 I2 and I2 = J^2 tr C^-1, for C and for its inverse.
        let (i1, inverse_trace, j2) = (norm_squared(f), norm_squared(&transposed), j * j);
        let stretch = largest_eigenvalue(i1, i1 * i1 - 2.0 * j2 * inverse_trace);
        let compression = largest_eigenvalue(inverse_trace, inverse_trace * inverse_trace - 2.0 * i1 / j2);
        Self { transposed, j, i1, stretch, compression }
    }
}

/// Isochoric part `G J^(-2/3) (F - I1/3 F^-T)` and a bound of its modulus.
///
/// With `m = F^-T N`, `n = F N` its acoustic tensor is `g [I - 2/3 (m n^T + n m^T) + 5/9 I1 m m^T]`. As `m.n = 1`, `n` is
/// `m/|m|^2` and a part across `m` of length `sqrt(n^2 - 1/m^2)`, which adds at most half of their product.
#[inline(always)]
pub(super) fn isochoric(shear: f64, f: &DMat3, inverse: &Inverse) -> (DMat3, f64) {
    let root = inverse.j.cbrt();
    let g = shear / (root * root);
    let first_piola = g * (*f - (inverse.i1 / 3.0) * inverse.transposed);
    let (m2, n2) = (inverse.compression, inverse.stretch);
    let along = (5.0 / 9.0 * inverse.i1 * m2 - 4.0 / 3.0).max(0.0);
    let across = 2.0 / 3.0 * (m2 * n2 - 1.0).max(0.0).sqrt();
    (first_piola, g * (1.0 + along + across))
}

impl Elastic for NeoHookean {
    fn energy(&self, f: &DMat3, _: &Fibres) -> f64 {
        let j = f.determinant();
        let root = j.cbrt();
        0.5 * self.shear * (norm_squared(f) / (root * root) - 3.0)
            + 0.25 * self.bulk * (j * j - 1.0 - 2.0 * j.ln())
    }

    #[inline(always)]
    fn stress(&self, f: &DMat3, _: &Fibres) -> Stress {
        let inverse = Inverse::new(f);
        let j2 = inverse.j * inverse.j;
        let (isochoric, modulus) = isochoric(self.shear, f, &inverse);
        Stress {
            first_piola: isochoric + (0.5 * self.bulk * (j2 - 1.0)) * inverse.transposed,
            modulus: modulus + 0.5 * self.bulk * (j2 + 1.0) * inverse.compression,
        }
    }

    fn bulk_modulus(&self) -> f64 {
        self.bulk
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
        let material = NeoHookean::new(1e6, 0.45).expect("in range");
        checks::stress_is_derivative(&material, 4e6);
        checks::is_objective(&material, 4e6);
        checks::modulus_is_bound(&material);
    }
}
