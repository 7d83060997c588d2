//! The numbers a fluid run is made with.

use crate::rheology::Rheology;

/// Constants of the blood and of its discretisation, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Rest density rho0 \[kg/m^3\].
    pub rest_density: f64,
    /// Dynamic viscosity mu \[Pa s\]; with a law of the shear rate the largest it gives, which bounds the step.
    pub viscosity: f64,
    /// Law for the viscosity; without, it is the same everywhere.
    pub rheology: Option<Rheology>,
    /// Numerical sound speed c \[m/s\].
    pub sound_speed: f64,
    /// Velocity the sound speed was chosen for \[m/s\]; bounds the advective step from above.
    pub reference_speed: f64,
    /// Particle spacing \[m\].
    pub spacing: f64,
    /// Smoothing length \[m\].
    pub smoothing_length: f64,
    /// Part of the density that is taken from the kernel sum each advective step, in 0..=1.
    ///
    /// The full reset (1) is the main source of noise; 0 lets the density drift.
    pub density_blend: f64,
    /// Kernel gradients are multiplied by the inverse of their moments (Bonet and Lok 1999), by which they are exact for what is linear.
    pub gradient_correction: bool,
    /// Particles are shifted against their kernel-gradient residual (Adami, Hu and Adams 2013).
    pub transport_velocity: bool,
    /// Where walls are at rest, the mean density follows the mass in the vessel instead of the kernel sum.
    pub hold_mass: bool,
    /// Limiter of the velocity-jump dissipation (Zhang, Hu and Adams 2017) between fluid particles away from caps. Walls and caps have in
    /// effect the full acoustic jump, as sound comes back from them.
    pub dissipation_limiter: f64,
    /// Strength of the transport-velocity shift a step.
    pub shift_strength: f64,
    /// Largest shift a step, in spacings.
    pub shift_limit: f64,
}

/// Courant number of the acoustic step.
const ACOUSTIC: f64 = 0.6;
/// Courant number of the advective step.
const ADVECTIVE: f64 = 0.25;
/// Viscous number of the advective step. The linear wall extrapolation is noisy from 0.25 on.
const VISCOUS: f64 = 0.125;

impl Numbers {
    /// Defaults for blood of given density, viscosity and top speed at a spacing: c = 10 times the
    /// speed, h = 1.3 dp, density blend 0.03, limiter 4, shift 0.2 within 0.05 dp.
    pub fn new(rest_density: f64, viscosity: f64, reference_speed: f64, spacing: f64) -> Self {
        Self {
            rest_density,
            viscosity,
            rheology: None,
            sound_speed: 10.0 * reference_speed,
            reference_speed,
            spacing,
            smoothing_length: 1.3 * spacing,
            density_blend: 0.03,
            gradient_correction: true,
            transport_velocity: true,
            hold_mass: false,
            dissipation_limiter: 4.0,
            shift_strength: 0.2,
            shift_limit: 0.05,
        }
    }

    /// Pressure of the equation of state `p = c^2 (rho - rho0)` \[Pa\], relative to the reference pressure.
    pub fn pressure(&self, density_change: f64) -> f64 {
        self.sound_speed * self.sound_speed * density_change
    }

    /// Advective step \[s\] at top speed \[m/s\] and top viscous acceleration \[m/s^2\]
    /// (Zhang, Rezavand, Hu 2020).
    pub fn advective_step(&self, speed: f64, acceleration: f64) -> f64 {
        let h = self.smoothing_length;
        let fastest = self.reference_speed.max(speed).max((4.0 * h * acceleration).sqrt());
        (self.reach() / fastest).min(VISCOUS * h * h * self.rest_density / self.viscosity)
    }

    /// Way \[m\] that no particle may go with the neighbours of one search: an advective step ends there.
    pub fn reach(&self) -> f64 {
        ADVECTIVE * self.smoothing_length
    }

    /// Acoustic step \[s\] at top speed \[m/s\].
    pub fn acoustic_step(&self, speed: f64) -> f64 {
        ACOUSTIC * self.smoothing_length / (self.sound_speed + speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_flows_are_bound_by_viscosity() {
        let numbers = Numbers::new(1000.0, 1.0, 1e-6, 1e-3);
        let expected = 0.125 * 1.3e-3 * 1.3e-3 / 1e-3;
        assert!((numbers.advective_step(0.0, 0.0) / expected - 1.0).abs() < 1e-12);
    }
}
