//! Holzapfel, Gasser, Ogden: two families of fibres in a neo-Hookean matrix.

use super::neo_hookean::{inverse_transposed, isochoric, isochoric_modulus};
use super::{Elastic, Fibres, inverse_two_thirds, norm_squared, outer};
use crate::error::{SolidError, within};
use glam::{DMat3, DVec3};

/// Exponents beyond this are continued by a spring of constant stiffness, so that a wild state cannot overflow.
const LARGEST_EXPONENT: f64 = 30.0;

/// `psi = c/2 (I1* - 3) + k1/(2 k2) sum (exp(k2 <E_i>^2) - 1) + K/2 (J - 1)^2` with
/// `E_i = d I1* + (1 - 3 d) I_i - 1` (Holzapfel, Gasser, Ogden 2000; dispersion: Gasser, Ogden, Holzapfel 2006).
///
/// `I1* = J^(-2/3) tr C`; `I_i` is the squared stretch of the fibres of family `i`, volume change included, since with its
/// isochoric part fibres would lose tension in dilation (Nolan et al. 2014). Fibres bear tension only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HolzapfelGasserOgden {
    matrix: f64,
    fibre_stiffness: f64,
    fibre_exponent: f64,
    dispersion: f64,
    angle: f64,
    bulk: f64,
}

impl HolzapfelGasserOgden {
    /// Material of the shear modulus `matrix` \[Pa\] (c, 3 to 30 kPa in arteries), `fibre_stiffness` \[Pa\] (k1, 1 to 1000 kPa),
    /// `fibre_exponent` (k2, 0.5 to 100), `dispersion` of the fibres (d, 0 aligned to 1/3 random), their `angle` to the
    /// circumference \[rad\], and the bulk modulus \[Pa\].
    ///
    /// # Errors
    /// [`SolidError::OutOfRange`] for the first number outside of what has a meaning.
    pub fn new(
        matrix: f64,
        fibre_stiffness: f64,
        fibre_exponent: f64,
        dispersion: f64,
        angle: f64,
        bulk: f64,
    ) -> Result<Self, SolidError> {
        within("matrix", matrix, matrix > 0.0, "above 0 Pa")?;
        within("fibre_stiffness", fibre_stiffness, fibre_stiffness >= 0.0, "0 Pa or more")?;
        within("fibre_exponent", fibre_exponent, fibre_exponent > 0.0, "above 0")?;
        within("dispersion", dispersion, (0.0..=1.0 / 3.0).contains(&dispersion), "0 to 1/3")?;
        within("angle", angle, angle.abs() <= std::f64::consts::FRAC_PI_2, "-pi/2 to pi/2 rad")?;
        within("bulk", bulk, bulk > 2.0 / 3.0 * matrix, "above 2/3 of `matrix`")?;
        Ok(Self { matrix, fibre_stiffness, fibre_exponent, dispersion, angle, bulk })
    }

    /// Directions of both families from the circumferential and the axial direction of the wall, which must not be parallel;
    /// the axial direction is taken at right angles to the other.
    pub fn fibres(&self, circumferential: DVec3, axial: DVec3) -> Fibres {
        let c = circumferential.normalize_or_zero();
        let a = (axial - axial.dot(c) * c).normalize_or_zero();
        let (sin, cos) = self.angle.sin_cos();
        [cos * c + sin * a, cos * c - sin * a]
    }

    /// Strain `E` of a family, of the isochoric first invariant and its squared stretch.
    #[inline(always)]
    fn strain(&self, i1: f64, i4: f64) -> f64 {
        self.dispersion * i1 + (1.0 - 3.0 * self.dispersion) * i4 - 1.0
    }

    /// Energy of one family, its derivative by the strain `E`, and the derivative of that.
    #[inline(always)]
    fn family(&self, strain: f64) -> [f64; 3] {
        // A wave may tighten slack fibres, so their stiffness counts although they bear nothing.
        let strain = strain.max(0.0);
        let (k1, k2) = (self.fibre_stiffness, self.fibre_exponent);
        let exponent = k2 * strain * strain;
        if exponent > LARGEST_EXPONENT {
            let e = LARGEST_EXPONENT.exp();
            let linear = 0.5 * k1 * e * (strain * strain - LARGEST_EXPONENT / k2);
            return [0.5 * k1 / k2 * (e - 1.0) + linear, k1 * strain * e, k1 * e];
        }
        let e = exponent.exp();
        [0.5 * k1 / k2 * exponent.exp_m1(), k1 * strain * e, k1 * e * (1.0 + 2.0 * exponent)]
    }
}

impl Elastic for HolzapfelGasserOgden {
    fn energy(&self, f: &DMat3, fibres: &Fibres) -> f64 {
        let j = f.determinant();
        let i1 = norm_squared(f) * inverse_two_thirds(j);
        let families = fibres.iter().map(|a| self.family(self.strain(i1, (*f * *a).length_squared()))[0]);
        0.5 * self.matrix * (i1 - 3.0) + families.sum::<f64>() + 0.5 * self.bulk * (j - 1.0) * (j - 1.0)
    }

    #[inline(always)]
    fn stress(&self, f: &DMat3, fibres: &Fibres) -> DMat3 {
        let (inverse, j) = inverse_transposed(f);
        // Half the derivative of I1*, which the matrix and the dispersed part of the fibres share.
        let unit = isochoric(1.0, f, &inverse, j);
        let i1 = norm_squared(f) * inverse_two_thirds(j);
        let d = self.dispersion;
        let mut shared = self.matrix;
        let mut first_piola = (self.bulk * (j - 1.0) * j) * inverse;
        for a in fibres {
            let fa = *f * *a;
            let [_, first, _] = self.family(self.strain(i1, fa.length_squared()));
            shared += 2.0 * first * d;
            first_piola += outer((2.0 * first * (1.0 - 3.0 * d)) * fa, *a);
        }
        first_piola + shared * unit
    }

    fn modulus(&self, f: &DMat3, fibres: &Fibres) -> f64 {
        let (inverse, j) = inverse_transposed(f);
        let (unit_modulus, compression) = isochoric_modulus(f);
        let unit = norm_squared(&isochoric(1.0, f, &inverse, j)).sqrt();
        let i1 = norm_squared(f) * inverse_two_thirds(j);
        let (d, aligned) = (self.dispersion, 1.0 - 3.0 * self.dispersion);
        let families = fibres.iter().map(|a| {
            let i4 = (*f * *a).length_squared();
            let [_, first, second] = self.family(self.strain(i1, i4));
            // dE = 2 (d unit + aligned Fa (x) a) : dF, and the length of that gradient for dF = w (x) N.
            let gradient = 2.0 * (d * unit + aligned * i4.sqrt());
            second * gradient * gradient + 2.0 * first * (d * unit_modulus + aligned)
        });
        self.matrix * unit_modulus
            + self.bulk * (j * j + j * (j - 1.0).abs()) * compression
            + families.sum::<f64>()
    }

    fn bulk_modulus(&self) -> f64 {
        self.bulk
    }

    fn shear_modulus(&self) -> f64 {
        self.matrix
    }
}

#[cfg(test)]
mod tests {
    use super::super::checks;
    use super::*;

    #[test]
    fn stress_energy_and_modulus_agree() {
        for dispersion in [0.0, 0.226] {
            let material = HolzapfelGasserOgden::new(1e5, 5e4, 1.2, dispersion, 0.7, 1e6).expect("in range");
            checks::stress_is_derivative(&material, 3e6);
            checks::is_objective(&material, 3e6);
            checks::modulus_is_bound(&material);
        }
    }

    /// Simple tension along aligned fibres at constant volume: `P = c (l - l^-2) + 4 k1 e exp(k2 e^2) l`, `e = l^2 - 1`, both
    /// families along the load.
    #[test]
    fn aligned_fibres_stiffen_as_the_formula_says() {
        let (c, k1, k2) = (1e4, 2e4, 3.0);
        let material = HolzapfelGasserOgden::new(c, k1, k2, 0.0, 0.0, 1e6).expect("in range");
        let fibres = material.fibres(DVec3::X, DVec3::Z);
        for stretch in [0.9, 1.1, 1.2] {
            let across = 1.0 / f64::sqrt(stretch);
            let f = DMat3::from_diagonal(DVec3::new(stretch, across, across));
            let p = material.stress(&f, &fibres);
            // The pressure that keeps the sides free, taken off.
            let axial = p.x_axis.x - p.y_axis.y * across / stretch;
            let e: f64 = stretch * stretch - 1.0;
            let fibre = if e > 0.0 { 4.0 * k1 * e * (k2 * e * e).exp() * stretch } else { 0.0 };
            let expected = c * (stretch - stretch.powi(-2)) + fibre;
            assert!((axial - expected).abs() < 1e-9 * c, "{axial} {expected}");
        }
    }

    #[test]
    fn fibres_lie_at_the_angle_to_the_circumference() {
        let material = HolzapfelGasserOgden::new(1e4, 1e4, 1.0, 0.0, 0.6, 1e6).expect("in range");
        let [a, b] = material.fibres(DVec3::Y, DVec3::new(0.0, 0.4, 2.0));
        assert!((a.dot(DVec3::Y) - 0.6_f64.cos()).abs() < 1e-15 && (a.z - 0.6_f64.sin()).abs() < 1e-15);
        assert!((a + b - 2.0 * 0.6_f64.cos() * DVec3::Y).length() < 1e-15);
    }
}
