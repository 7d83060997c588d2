//! Elasticity of a shell: what stands behind its resultants.

use crate::error::{ShellError, within};

/// How stress follows from strain through the thickness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// Saint Venant-Kirchhoff in plane stress, integrated over the thickness by hand: the cheapest, for strains below 5 %.
    #[default]
    Resultant,
    /// Compressible neo-Hookean in plane stress at points through the thickness, for large strains.
    NeoHookean {
        /// Gauss points: 1 is a membrane, 3 the usual, 5 for thick walls.
        points: usize,
    },
}

/// Isotropic material of a shell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    young: f64,
    poisson: f64,
    model: Model,
}

/// Shear correction of a homogeneous section (Reissner 1945).
pub(crate) const SHEAR_CORRECTION: f64 = 5.0 / 6.0;

impl Material {
    /// Material of Young's modulus \[Pa\] and Poisson's ratio at rest.
    ///
    /// # Errors
    /// [`ShellError::OutOfRange`] unless `young > 0`, `-1 < poisson < 0.5` and there are 1, 3 or 5 points.
    pub fn new(young: f64, poisson: f64, model: Model) -> Result<Self, ShellError> {
        within("young", young, young > 0.0, "above 0 Pa")?;
        let allowed = -1.0 < poisson && poisson < 0.5;
        within("poisson", poisson, allowed, "above -1 and below 0.5; tissue is well served by 0.45 to 0.49")?;
        if let Model::NeoHookean { points } = model {
            within("points", points as f64, matches!(points, 1 | 3 | 5), "1, 3 or 5")?;
        }
        Ok(Self { young, poisson, model })
    }

    /// Young's modulus at rest \[Pa\].
    pub fn young(&self) -> f64 {
        self.young
    }

    /// Poisson's ratio at rest.
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// How stress follows from strain.
    pub fn model(&self) -> Model {
        self.model
    }

    /// Shear modulus \[Pa\].
    pub fn shear(&self) -> f64 {
        0.5 * self.young / (1.0 + self.poisson)
    }

    /// Lame's first parameter \[Pa\].
    pub fn lame(&self) -> f64 {
        self.young * self.poisson / ((1.0 + self.poisson) * (1.0 - 2.0 * self.poisson))
    }

    /// Modulus of a plate held across, `E / (1 - nu^2)` \[Pa\].
    pub fn plate(&self) -> f64 {
        self.young / (1.0 - self.poisson * self.poisson)
    }
}

/// In-plane and transverse second Piola-Kirchhoff stresses 11 22 12 13 23 \[Pa\] of the neo-Hookean material at the Cauchy-Green
/// components `c` (11 22 12 13 23), the stress across the shell being zero.
///
/// `psi = G/2 (tr C - 3 - ln det C) + lambda/4 (det C - 1 - ln det C)` (Ciarlet 1988), with transverse shear beside it.
#[inline(always)]
pub(crate) fn neo_hookean_stress(shear: f64, lame: f64, c: &[f64; 5]) -> [f64; 5] {
    let [c11, c22, c12, c13, c23] = *c;
    let j2 = c11 * c22 - c12 * c12;
    let c33 = across(shear, lame, j2);
    let b = (0.5 * lame * (j2 * c33 - 1.0) - shear) / j2;
    let transverse = SHEAR_CORRECTION * shear;
    [shear + b * c22, shear + b * c11, -b * c12, transverse * c13, transverse * c23]
}

/// Energies by reference volume \[J/m^3\] of the same, in the plane and by transverse shear.
pub(crate) fn neo_hookean_energy(shear: f64, lame: f64, c: &[f64; 5]) -> [f64; 2] {
    let [c11, c22, c12, c13, c23] = *c;
    let j2 = c11 * c22 - c12 * c12;
    let c33 = across(shear, lame, j2);
    let j = j2 * c33;
    let plane = 0.5 * shear * (c11 + c22 + c33 - 3.0 - j.ln()) + 0.25 * lame * (j - 1.0 - j.ln());
    [plane, 0.5 * SHEAR_CORRECTION * shear * (c13 * c13 + c23 * c23)]
}

/// Squared stretch across the shell at which the stress there is zero, for the determinant of the in-plane part.
#[inline(always)]
pub(crate) fn across(shear: f64, lame: f64, j2: f64) -> f64 {
    (shear + 0.5 * lame) / (shear + 0.5 * lame * j2)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHEAR: f64 = 3.0;
    const LAME: f64 = 20.0;

    #[test]
    fn the_stress_is_the_derivative_of_the_energy() {
        let c = [1.3, 0.8, 0.15, 0.05, -0.1];
        let stress = neo_hookean_stress(SHEAR, LAME, &c);
        for k in 0..5 {
            let e = 1e-6;
            let energy = |shift: f64| {
                let mut c = c;
                c[k] += shift;
                neo_hookean_energy(SHEAR, LAME, &c).iter().sum::<f64>()
            };
            // S = 2 d psi / dC; entries off the diagonal stand for two.
            let factor = if k < 2 { 2.0 } else { 1.0 };
            let numeric = factor * (energy(e) - energy(-e)) / (2.0 * e);
            assert!((numeric - stress[k]).abs() < 1e-7 * SHEAR, "{k}: {numeric} {}", stress[k]);
        }
    }

    #[test]
    fn small_strains_follow_plane_stress_elasticity() {
        let poisson = LAME / (2.0 * (LAME + SHEAR));
        let young = 2.0 * SHEAR * (1.0 + poisson);
        let e = 1e-6;
        let stress = neo_hookean_stress(SHEAR, LAME, &[1.0 + 2.0 * e, 1.0, 0.0, 0.0, 0.0]);
        let plate = young / (1.0 - poisson * poisson);
        assert!((stress[0] / (plate * e) - 1.0).abs() < 1e-4);
        assert!((stress[1] / (poisson * plate * e) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_material_without_sense_is_refused() {
        assert!(Material::new(1e6, 0.5, Model::Resultant).is_err());
        assert!(Material::new(0.0, 0.3, Model::Resultant).is_err());
        assert!(Material::new(1e6, 0.3, Model::NeoHookean { points: 2 }).is_err());
    }
}
