//! Nearly incompressible neo-Hookean.

use super::{Elastic, Fibres, cofactor, inverse_two_thirds, largest_eigenvalue, moduli, norm_squared};
use crate::error::SolidError;
use crate::lanes;
use glam::DMat3;
use vaso_kernels::Lanes;

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

/// Transposed inverse and determinant.
#[inline(always)]
pub(super) fn inverse_transposed(f: &DMat3) -> (DMat3, f64) {
    let cofactor = cofactor(f);
    let j = f.x_axis.dot(cofactor.x_axis);
    ((1.0 / j) * cofactor, j)
}

/// Isochoric part `G J^(-2/3) (F - I1/3 F^-T)` of the stress.
#[inline(always)]
pub(super) fn isochoric(shear: f64, f: &DMat3, inverse_transposed: &DMat3, j: f64) -> DMat3 {
    let g = shear * inverse_two_thirds(j);
    g * *f - (g / 3.0 * norm_squared(f)) * *inverse_transposed
}

/// Bound of the modulus of the isochoric part, by its shear modulus, and of `|F^-T N|^2`, by which volumetric stiffness grows.
///
/// With `m = F^-T N`, `n = F N` the acoustic tensor is `g [I - 2/3 (m n^T + n m^T) + 5/9 I1 m m^T]`. As `m.n = 1`, `n` is
/// `m/|m|^2` and a part across `m` of length `sqrt(n^2 - 1/m^2)`, which adds at most half of their product.
pub(super) fn isochoric_modulus(f: &DMat3) -> (f64, f64) {
    let (inverse, j) = inverse_transposed(f);
    // |C|^2 = I1^2 - 2 I2 and I2 = J^2 tr C^-1, for C and for its inverse.
    let (i1, inverse_trace, j2) = (norm_squared(f), norm_squared(&inverse), j * j);
    let n2 = largest_eigenvalue(i1, i1 * i1 - 2.0 * j2 * inverse_trace);
    let m2 = largest_eigenvalue(inverse_trace, inverse_trace * inverse_trace - 2.0 * i1 / j2);
    let along = (5.0 / 9.0 * i1 * m2 - 4.0 / 3.0).max(0.0);
    let across = 2.0 / 3.0 * (m2 * n2 - 1.0).max(0.0).sqrt();
    (inverse_two_thirds(j) * (1.0 + along + across), m2)
}

impl Elastic for NeoHookean {
    fn energy(&self, f: &DMat3, _: &Fibres) -> f64 {
        let j = f.determinant();
        0.5 * self.shear * (norm_squared(f) * inverse_two_thirds(j) - 3.0)
            + 0.25 * self.bulk * (j * j - 1.0 - 2.0 * j.ln())
    }

    #[inline(always)]
    fn stress(&self, f: &DMat3, _: &Fibres) -> DMat3 {
        let (inverse, j) = inverse_transposed(f);
        isochoric(self.shear, f, &inverse, j) + (0.5 * self.bulk * (j * j - 1.0)) * inverse
    }

    const IN_LANES: bool = true;

    #[inline(always)]
    fn stress_in_lanes<L: Lanes<Elem = f64>>(&self, f: &[L; 9], cofactor: &[L; 9], j: L) -> [L; 9] {
        let g = L::constant(self.shear) * lanes::inverse_two_thirds(j);
        let one = L::constant(1.0);
        let pressure = L::constant(0.5 * self.bulk) * (j * j - one);
        // A third of three is one: a body at rest has no stress, not even that of rounding.
        let mean = L::constant(1.0 / 3.0) * lanes::norm_squared(f);
        let across = (pressure - g * mean) * lanes::inverse(j);
        std::array::from_fn(|k| g.fma(f[k], across * cofactor[k]))
    }

    fn modulus(&self, f: &DMat3, _: &Fibres) -> f64 {
        let (isochoric, compression) = isochoric_modulus(f);
        let j = f.determinant();
        self.shear * isochoric + 0.5 * self.bulk * (j * j + 1.0) * compression
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
