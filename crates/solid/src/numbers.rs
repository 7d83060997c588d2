//! Constants of a solid.

use crate::error::{SolidError, within};

/// What a solid is computed with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Particle spacing \[m\].
    pub spacing: f64,
    /// Smoothing length \[m\]: 1.15 spacings for vessel walls; 0.75 to 1.0 on a lattice bends less softly.
    pub smoothing_length: f64,
    /// Density in the reference configuration \[kg/m^3\].
    pub density: f64,
    /// Factor of the damping between pairs: 0.05 in motion, 0.25 to 1 to come to rest quickly, 0 for none.
    pub damping: f64,
    /// Viscosity of the material, which adds `eta dE/dt` to its second Piola-Kirchhoff stress \[Pa s\].
    pub viscosity: f64,
    /// Factor `k` of the hourglass control, a spring against what neighbours do beside the deformation gradient; its energy is
    /// `1/4 sum_ab V_a V_b k E (|W'|/r) |u_ab - G_a X_ab|^2` with the displacement gradient `G` and Young's modulus `E`.
    ///
    /// 0 switches it off, 0.01 to 0.1 is sensible; 0.03 is as stiff on a lattice as 0.1 is with the weight `W/r^2`
    /// (Ganzenmueller 2015). With `1 / (1 + nu)` the isotropic part of the shear acts between pairs, which carries bodies
    /// through violent motion and stiffens coarse ones.
    pub hourglass: f64,
    /// Step as a share of the time a P-wave takes through a smoothing length.
    pub courant: f64,
    /// Most sub-steps that a step of the fluid may take.
    pub max_substeps: usize,
}

impl Numbers {
    /// Usual numbers for a wall of `density` \[kg/m^3\] in particles of `spacing` \[m\].
    pub fn new(density: f64, spacing: f64) -> Self {
        Self {
            spacing,
            smoothing_length: 1.15 * spacing,
            density,
            damping: 0.05,
            viscosity: 0.0,
            hourglass: 0.02,
            courant: 0.6,
            max_substeps: 1000,
        }
    }

    /// Largest step \[s\] at the wave speed \[m/s\] and the largest acceleration \[m/s^2\].
    ///
    /// With `courant = 0.6` it is safe for disordered particles, any Poisson ratio and pair damping up to 2. A viscosity adds
    /// to the damping of the fastest mode, `2 speed / (0.75 h)`, for which an explicit step shrinks by `sqrt(1 + z^2) - z`.
    pub fn stable_step(&self, wave_speed: f64, acceleration: f64) -> f64 {
        let h = self.smoothing_length;
        let z = self.viscosity / (0.75 * h * self.density * wave_speed);
        let viscous = (1.0 + z * z).sqrt() - z;
        self.courant * (viscous * h / wave_speed).min((h / acceleration).sqrt())
    }

    pub(crate) fn check(&self) -> Result<(), SolidError> {
        let ratio = self.smoothing_length / self.spacing;
        within("spacing", self.spacing, self.spacing > 0.0, "above 0 m")?;
        within(
            "smoothing_length",
            self.smoothing_length,
            (0.7..=2.0).contains(&ratio),
            "0.7 to 2 times the spacing",
        )?;
        within("density", self.density, self.density > 0.0, "above 0 kg/m^3")?;
        within("damping", self.damping, (0.0..=2.0).contains(&self.damping), "0 to 2")?;
        within("viscosity", self.viscosity, self.viscosity >= 0.0, "0 Pa s or more")?;
        let k = self.hourglass;
        within("hourglass", k, (0.0..=1.0).contains(&k), "0 to 1")?;
        within("courant", self.courant, 0.0 < self.courant && self.courant <= 0.8, "above 0, up to 0.8")
    }
}
