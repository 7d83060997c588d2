//! Constants of a shell.

use crate::error::{ShellError, within};
use crate::material::{Material, SHEAR_CORRECTION};

/// What a shell is computed with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Particle spacing \[m\].
    pub spacing: f64,
    /// Smoothing length \[m\]: 1.15 spacings.
    pub smoothing_length: f64,
    /// Density in the reference configuration \[kg/m^3\].
    pub density: f64,
    /// Factor of the Kelvin-Voigt damping: 0.05 in motion, 0.25 to 1 to come to rest quickly, 0 for none.
    pub damping: f64,
    /// Factor of the hourglass control: 0 switches it off, 0.02 to 0.5 is sensible.
    pub hourglass: f64,
    /// Rotary inertia is at least this share of `t h^2 / 12`: 0.5 keeps the shear of thin shells from dictating the step and
    /// changes only modes that the spacing does not resolve; 0 for none.
    pub rotary_scaling: f64,
    /// Step as a share of the largest stable one.
    pub courant: f64,
    /// Most sub-steps that a step of the fluid may take.
    pub max_substeps: usize,
}

impl Numbers {
    /// Usual numbers for a shell of `density` \[kg/m^3\] in particles of `spacing` \[m\].
    pub fn new(density: f64, spacing: f64) -> Self {
        Self {
            spacing,
            smoothing_length: 1.15 * spacing,
            density,
            damping: 0.05,
            hourglass: 0.1,
            rotary_scaling: 0.5,
            courant: 0.7,
            max_substeps: 1000,
        }
    }

    /// Rotary inertia by area and density \[m^3\] of a shell of `thickness` \[m\].
    pub fn rotary(&self, thickness: f64) -> f64 {
        let least = self.rotary_scaling * thickness * self.smoothing_length * self.smoothing_length / 12.0;
        least.max(thickness.powi(3) / 12.0)
    }

    /// Step \[s\] to expect of a shell of `thickness` \[m\] at rest: `courant` times what membrane and shear waves allow.
    ///
    /// It holds to a fifth for regular particles; a shell measures its own ([`crate::Shell::stable_step`]).
    pub fn expected_step(&self, material: &Material, thickness: f64) -> f64 {
        let membrane = material.plate() / (self.density * self.smoothing_length * self.smoothing_length);
        let shear =
            SHEAR_CORRECTION * material.shear() * thickness / (4.0 * self.density * self.rotary(thickness));
        let z = 0.46 * self.damping;
        self.courant * ((1.0 + z * z).sqrt() - z) / (membrane + shear).sqrt()
    }

    /// Time \[s\] by which damping shortens the step of a shell of `thickness` \[m\]: viscosity over stiffness is half of it
    /// times the factor of the damping, in membrane and bending or in shear.
    pub(crate) fn damping_time(&self, material: &Material, thickness: f64) -> f64 {
        let membrane = self.smoothing_length * (self.density / material.plate()).sqrt();
        let stiffness = SHEAR_CORRECTION * material.shear() * thickness;
        membrane.max((self.density * self.rotary(thickness) / stiffness).sqrt())
    }

    pub(crate) fn check(&self) -> Result<(), ShellError> {
        let ratio = self.smoothing_length / self.spacing;
        within("spacing", self.spacing, self.spacing > 0.0, "above 0 m")?;
        within(
            "smoothing_length",
            self.smoothing_length,
            (0.8..=2.0).contains(&ratio),
            "0.8 to 2 times the spacing",
        )?;
        within("density", self.density, self.density > 0.0, "above 0 kg/m^3")?;
        within("damping", self.damping, (0.0..=1.0).contains(&self.damping), "0 to 1")?;
        within("hourglass", self.hourglass, (0.0..=1.0).contains(&self.hourglass), "0 to 1")?;
        let s = self.rotary_scaling;
        within("rotary_scaling", s, (0.0..=1.0).contains(&s), "0 to 1")?;
        within("courant", self.courant, 0.0 < self.courant && self.courant <= 0.9, "above 0, up to 0.9")
    }
}
