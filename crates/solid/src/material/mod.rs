//! Materials: energy and stress of the deformation gradient, one file each.

mod holzapfel;
mod hypo_elastic;
mod neo_hookean;
mod saint_venant;

pub use holzapfel::HolzapfelGasserOgden;
pub use hypo_elastic::HypoElastic;
pub use neo_hookean::NeoHookean;
pub use saint_venant::SaintVenantKirchhoff;

use crate::error::{SolidError, within};
use glam::{DMat3, DVec3};
use vaso_kernels::Lanes;

/// Unit directions of the two families of fibres in the reference configuration; zero where there are none.
pub type Fibres = [DVec3; 2];

/// A material whose stress is the derivative of an energy.
pub trait Elastic: Copy + Send + Sync + 'static {
    /// Energy by reference volume \[J/m^3\] at the deformation gradient `f`, whose determinant is positive.
    fn energy(&self, f: &DMat3, fibres: &Fibres) -> f64;
    /// First Piola-Kirchhoff stress \[Pa\], force in the present by area in the reference, at the deformation gradient `f`,
    /// whose determinant is positive.
    fn stress(&self, f: &DMat3, fibres: &Fibres) -> DMat3;
    /// Whether [`Self::stress_in_lanes`] can be asked.
    const IN_LANES: bool = false;
    /// [`Self::stress`] of several particles, one a lane, by `f`, its transposed inverse times the determinant `j`, and `j` itself, which is
    /// from 0.6 to 1.7; matrices row by row.
    #[inline(always)]
    fn stress_in_lanes<L: Lanes<Elem = f64>>(&self, f: &[L; 9], cofactor: &[L; 9], j: L) -> [L; 9] {
        let _ = (cofactor, j);
        *f
    }
    /// Bound of the P-wave modulus in reference lengths \[Pa\] at `f`: `density * speed^2` of the fastest wave.
    fn modulus(&self, f: &DMat3, fibres: &Fibres) -> f64;
    /// Bulk modulus at rest \[Pa\].
    fn bulk_modulus(&self) -> f64;
    /// Shear modulus at rest, without fibres \[Pa\].
    fn shear_modulus(&self) -> f64;
}

/// Young's modulus \[Pa\] of a bulk and a shear modulus.
pub(crate) fn young(bulk: f64, shear: f64) -> f64 {
    9.0 * bulk * shear / (3.0 * bulk + shear)
}

/// Bulk and shear modulus \[Pa\] of Young's modulus \[Pa\] and Poisson's ratio.
pub(crate) fn moduli(young: f64, poisson: f64) -> Result<(f64, f64), SolidError> {
    within("young", young, young > 0.0, "above 0 Pa")?;
    let allowed = -1.0 < poisson && poisson < 0.5;
    within("poisson", poisson, allowed, "above -1 and below 0.5; tissue is well served by 0.45 to 0.49")?;
    Ok((young / (3.0 * (1.0 - 2.0 * poisson)), young / (2.0 * (1.0 + poisson))))
}

/// Material of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Material {
    /// Linear between second Piola-Kirchhoff stress and Green strain.
    SaintVenantKirchhoff(SaintVenantKirchhoff),
    /// Nearly incompressible neo-Hookean.
    NeoHookean(NeoHookean),
    /// Two families of fibres in a neo-Hookean matrix.
    HolzapfelGasserOgden(HolzapfelGasserOgden),
    /// Rate form in the present configuration, for comparison.
    HypoElastic(HypoElastic),
}

impl Material {
    /// Speed of P-waves at rest \[m/s\], fibres included, for a density \[kg/m^3\].
    pub fn wave_speed(&self, density: f64) -> f64 {
        let fibres = [DVec3::X; 2];
        let modulus = match self {
            Self::SaintVenantKirchhoff(m) => m.modulus(&DMat3::IDENTITY, &fibres),
            Self::NeoHookean(m) => m.modulus(&DMat3::IDENTITY, &fibres),
            Self::HolzapfelGasserOgden(m) => m.modulus(&DMat3::IDENTITY, &fibres),
            Self::HypoElastic(m) => m.bulk + 4.0 / 3.0 * m.shear,
        };
        (modulus / density).sqrt()
    }

    /// Strain across a wall per strain of its area, with the other sign, where no stress acts across it: `nu / (1 - nu)` at small
    /// strain, fibres left out.
    pub fn thinning(&self) -> f64 {
        let (bulk, shear) = match self {
            Self::SaintVenantKirchhoff(m) => (m.bulk_modulus(), m.shear_modulus()),
            Self::NeoHookean(m) => (m.bulk_modulus(), m.shear_modulus()),
            Self::HolzapfelGasserOgden(m) => (m.bulk_modulus(), m.shear_modulus()),
            Self::HypoElastic(m) => (m.bulk, m.shear),
        };
        (bulk - 2.0 / 3.0 * shear) / (bulk + 4.0 / 3.0 * shear)
    }
}

/// Transposed inverse times the determinant.
pub(crate) fn cofactor(f: &DMat3) -> DMat3 {
    DMat3::from_cols(f.y_axis.cross(f.z_axis), f.z_axis.cross(f.x_axis), f.x_axis.cross(f.y_axis))
}

/// `j^(-2/3)`, for `j > 0`.
#[inline(always)]
pub(crate) fn inverse_two_thirds(j: f64) -> f64 {
    // The library root is correctly rounded and costs as much as the rest of the stress.
    if !(0.6..1.7).contains(&j) {
        let root = j.cbrt();
        return 1.0 / (root * root);
    }
    let t = j * j;
    // Pade approximation of t^(-1/3) about 1, then its fourth-order iteration, twice.
    let mut y = (2.0 + t) / (1.0 + 2.0 * t);
    for _ in 0..2 {
        let e = 1.0 - t * y * y * y;
        y += y * e * (1.0 / 3.0 + e * (2.0 / 9.0 + e * (14.0 / 81.0)));
    }
    y
}

/// Sum of the squares of all entries.
pub(crate) fn norm_squared(f: &DMat3) -> f64 {
    f.x_axis.length_squared() + f.y_axis.length_squared() + f.z_axis.length_squared()
}

/// `a (x) b`.
pub(crate) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// Bound of the largest eigenvalue of a symmetric positive matrix near the unit matrix times `mean`, its mean eigenvalue:
/// the mean and what the rest, which has no trace, can add (its largest eigenvalue is at most sqrt(2/3) of its norm).
pub(crate) fn largest_eigenvalue(trace: f64, norm_squared: f64) -> f64 {
    let mean = trace / 3.0;
    let deviation = (norm_squared - 3.0 * mean * mean).max(0.0);
    mean + (2.0 / 3.0 * deviation).sqrt()
}

#[cfg(test)]
pub(crate) mod checks {
    use super::*;

    /// Deformation gradients of all kinds with positive determinants.
    pub(crate) fn deformations() -> Vec<DMat3> {
        let spread = |a: f64| {
            DMat3::from_cols(
                DVec3::new(1.0 + 0.9 * a, 0.3 * a, -0.2 * a),
                DVec3::new(-0.5 * a, 1.0 - 0.4 * a, 0.15 * a),
                DVec3::new(0.25 * a, -0.35 * a, 1.0 + 0.1 * a),
            )
        };
        let turned = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 1.3);
        vec![DMat3::IDENTITY, spread(0.05), spread(0.3), turned * spread(0.2), turned * spread(-0.3)]
    }

    /// Fibres that some of the deformations stretch and some shorten.
    pub(crate) fn fibres() -> Fibres {
        [DVec3::new(0.8, 0.6, 0.0), DVec3::new(0.8, -0.6, 0.0)]
    }

    /// The stress is the derivative of the energy, by central differences.
    pub(crate) fn stress_is_derivative(material: &impl Elastic, scale: f64) {
        let fibres = fibres();
        // Not at rest, where fibres begin to bear and the energy has no second derivative.
        for f in deformations().into_iter().skip(1) {
            let p = material.stress(&f, &fibres);
            let e = 1e-5;
            for c in 0..3 {
                for r in 0..3 {
                    let mut d = DMat3::ZERO;
                    d.col_mut(c)[r] = e;
                    let numeric =
                        (material.energy(&(f + d), &fibres) - material.energy(&(f - d), &fibres)) / (2.0 * e);
                    let error = (numeric - p.col(c)[r]).abs();
                    assert!(error < 1e-7 * scale, "({r}, {c}): {numeric} {}", p.col(c)[r]);
                }
            }
        }
    }

    /// A rotation changes neither energy nor the stress seen by the material, and balances moments: P F^T is symmetric.
    pub(crate) fn is_objective(material: &impl Elastic, scale: f64) {
        let fibres = fibres();
        let q = DMat3::from_axis_angle(DVec3::new(-0.3, 1.0, 0.5).normalize(), 2.1);
        for f in deformations() {
            let (p, turned) = (material.stress(&f, &fibres), material.stress(&(q * f), &fibres));
            let difference = turned - q * p;
            assert!(norm_squared(&difference).sqrt() < 1e-12 * scale);
            let energy = material.energy(&f, &fibres);
            assert!((material.energy(&(q * f), &fibres) - energy).abs() < 1e-12 * scale);
            let kirchhoff = p * f.transpose();
            assert!(norm_squared(&(kirchhoff - kirchhoff.transpose())).sqrt() < 1e-12 * scale);
        }
        let rest = material.stress(&DMat3::IDENTITY, &fibres);
        assert!(norm_squared(&rest).sqrt() < 1e-12 * scale, "stress at rest");
    }

    /// The bound of the modulus holds for waves in many directions, and is the P-wave modulus at rest.
    pub(crate) fn modulus_is_bound(material: &impl Elastic) {
        let fibres = fibres();
        for f in deformations() {
            let bound = material.modulus(&f, &fibres);
            let e = 1e-6;
            let mut top = 0.0_f64;
            for k in 0..40 {
                let angle = f64::from(k) * 2.4;
                let z = 1.0 - (f64::from(k) + 0.5) / 20.0;
                let n = DVec3::new(angle.cos() * (1.0 - z * z).sqrt(), angle.sin() * (1.0 - z * z).sqrt(), z);
                // Largest eigenvalue of the acoustic tensor, by its columns.
                let acoustic = |a: DVec3| {
                    let d = e * outer(a, n);
                    let plus = material.stress(&(f + d), &fibres);
                    let minus = material.stress(&(f - d), &fibres);
                    (plus - minus) * n / (2.0 * e)
                };
                let mut a = DVec3::new(0.5, 0.6, 0.7);
                for _ in 0..50 {
                    a = acoustic(a.normalize());
                }
                top = top.max(a.length());
            }
            assert!(bound > 0.999 * top, "{bound} < {top}");
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_root_is_exact_to_rounding() {
        for k in 1..400 {
            let j = 0.01 * f64::from(k);
            let error = super::inverse_two_thirds(j) * j.powf(2.0 / 3.0) - 1.0;
            assert!(error.abs() < 4e-15, "{j}: {error:e}");
        }
    }
}
