//! Hypo-elasticity: the stress follows the rate of deformation.

use super::moduli;
use crate::error::SolidError;
use glam::DMat3;

/// `sigma = -p I + S`, `p = K (rho / rho_0 - 1)`, and a deviatoric stress that follows the Jaumann rate
/// `dS/dt = 2 G dev D + W S - S W`, `D` and `W` the symmetric and the skew part of the velocity gradient.
///
/// Equations 7 to 11 of the multiblock paper print `G` for `2 G`, which is right for engineering shear only, and a spin whose
/// sign has to be paired with the order of the products; here they are paired so that stress turns with the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HypoElastic {
    /// Bulk modulus \[Pa\].
    pub bulk: f64,
    /// Shear modulus \[Pa\].
    pub shear: f64,
}

impl HypoElastic {
    /// Material of Young's modulus \[Pa\] and Poisson's ratio at rest.
    ///
    /// # Errors
    /// [`SolidError::OutOfRange`] unless `young > 0` and `-1 < poisson < 0.5`.
    pub fn new(young: f64, poisson: f64) -> Result<Self, SolidError> {
        let (bulk, shear) = moduli(young, poisson)?;
        Ok(Self { bulk, shear })
    }

    /// Pressure \[Pa\] at the relative density change `rho / rho_0 - 1`.
    pub fn pressure(&self, density_change: f64) -> f64 {
        self.bulk * density_change
    }

    /// Deviatoric stress \[Pa\] after `dt` \[s\] of the velocity gradient `l` \[1/s\] (`l` rows: components, columns: directions).
    ///
    /// The spin is applied as a rotation (Hughes and Winget 1980), so that a turning body neither gains nor loses stress
    /// however large the step is; an explicit step of the rate would let it grow by the square of the angle.
    pub fn advance(&self, stress: &DMat3, l: &DMat3, dt: f64) -> DMat3 {
        let rate = 0.5 * (*l + l.transpose());
        let trace = rate.x_axis.x + rate.y_axis.y + rate.z_axis.z;
        let deviatoric = rate - DMat3::from_diagonal(glam::DVec3::splat(trace / 3.0));
        let half_spin = 0.25 * dt * (*l - l.transpose());
        let turn = (DMat3::IDENTITY - half_spin).inverse() * (DMat3::IDENTITY + half_spin);
        turn * *stress * turn.transpose() + (2.0 * self.shear * dt) * deviatoric
    }

    /// Elastic energy by reference volume \[J/m^3\] of a deviatoric stress \[Pa\] and a relative density change.
    pub fn energy(&self, stress: &DMat3, density_change: f64) -> f64 {
        let eta = 1.0 + density_change;
        super::norm_squared(stress) / (4.0 * self.shear * eta) + self.bulk * (eta.ln() + 1.0 / eta - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// After a quarter turn in few steps the stress has turned with the body, and its energy is what it was.
    #[test]
    fn stress_turns_with_the_body() {
        let material = HypoElastic::new(1e6, 0.4).expect("in range");
        let start = DMat3::from_cols(
            DVec3::new(3e3, 1e3, -2e3),
            DVec3::new(1e3, -5e3, 4e3),
            DVec3::new(-2e3, 4e3, 2e3),
        );
        let axis = DVec3::new(1.0, -2.0, 0.5).normalize();
        let (n, quarter) = (400, std::f64::consts::FRAC_PI_2);
        let spin = DMat3::from_cols(axis.cross(DVec3::X), axis.cross(DVec3::Y), axis.cross(DVec3::Z));
        let mut stress = start;
        for _ in 0..n {
            stress = material.advance(&stress, &(quarter * spin), 1.0 / f64::from(n));
        }
        let turn = DMat3::from_axis_angle(axis, quarter);
        let difference = stress - turn * start * turn.transpose();
        let scale = super::super::norm_squared(&start).sqrt();
        // A step turns by 2 atan(angle / 2n), short of the angle by a twelfth of its cube; the stress sees it twice.
        let bound = 2.0 * f64::from(n) * (quarter / f64::from(n)).powi(3) / 12.0;
        assert!(super::super::norm_squared(&difference).sqrt() < 1.1 * bound * scale);
        let energy = material.energy(&stress, 0.0) / material.energy(&start, 0.0);
        assert!((energy - 1.0).abs() < 1e-12, "{energy}");
    }

    /// Simple shear at the rate `g`: `S_xy = G sin(g t)`, the known answer of the Jaumann rate (Dienes 1979).
    #[test]
    fn simple_shear_follows_the_sine_of_the_jaumann_rate() {
        let material = HypoElastic::new(1e6, 0.4).expect("in range");
        let l = DMat3::from_cols(DVec3::ZERO, DVec3::X, DVec3::ZERO);
        let mut stress = DMat3::ZERO;
        let n = 2000;
        for k in 1..=n {
            stress = material.advance(&stress, &l, 1e-3);
            let t = 1e-3 * f64::from(k);
            assert!((stress.y_axis.x - material.shear * t.sin()).abs() < 2e-3 * material.shear);
        }
    }
}
