//! Kelvin-Voigt damping of a section.

use crate::material::{Material, SHEAR_CORRECTION};
use crate::numbers::Numbers;

/// Kelvin-Voigt damping of membrane and bending by `beta rho c h / 2`, of shear by `beta / 2` of its critical damping.
pub(crate) struct Damper {
    beta: f64,
    density: f64,
    shear: f64,
    viscosity: f64,
}

impl Damper {
    pub(crate) fn new(material: &Material, numbers: &Numbers) -> Self {
        let (beta, density) = (numbers.damping, numbers.density);
        let speed = (material.plate() / density).sqrt();
        let viscosity = 0.5 * beta * density * speed * numbers.smoothing_length;
        Self { beta, density, shear: material.shear(), viscosity }
    }

    /// What strain rates of membrane, bending and shear are multiplied by \[N s/m, N m s, N s/m\].
    pub(crate) fn factors(&self, thickness: f64, rotary: f64) -> [f64; 3] {
        let membrane = self.viscosity * thickness;
        let bending = membrane * thickness * thickness / 12.0;
        let stiffness = SHEAR_CORRECTION * self.shear * thickness;
        let shear = 0.5 * self.beta * (self.density * rotary * stiffness).sqrt();
        [membrane, bending, shear]
    }
}
