//! What every fluid particle carries from step to step.

use glam::DVec3;
use vaso_particles::{Column, Columns, ScalarColumn, VectorColumn, Visitor};

/// Columns of the fluid.
#[derive(Clone, Debug)]
pub struct FluidState {
    /// Position \[m\].
    pub position: VectorColumn,
    /// Velocity \[m/s\].
    pub velocity: VectorColumn,
    /// Density minus rest density \[kg/m^3\]: the difference keeps the digits the pressure needs.
    pub density_change: ScalarColumn,
    /// Pressure, the mean over the acoustic steps of the last advective step, relative to the reference pressure \[Pa\].
    ///
    /// That is what moved the fluid. The pressure at the end of an advective step differs from it throughout the vessel:
    /// the density has just been let go after it was moved towards the kernel sum at the start of the step.
    pub pressure: ScalarColumn,
    /// Rate of change of the density, of the last acoustic step \[kg/(m^3 s)\].
    pub density_rate: ScalarColumn,
    /// Mass \[kg\].
    pub mass: ScalarColumn,
    /// Identity, never used again after the particle has left.
    pub id: Column<u64>,
    /// Opening whose buffer owns the particle, or [`FluidState::NO_OPENING`].
    pub opening: Column<i32>,
}

impl FluidState {
    /// Label of a particle that no buffer owns.
    pub const NO_OPENING: i32 = -1;

    /// Fluid at rest and at rest density, of the volumes \[m^3\] given.
    pub fn at_rest(position: Vec<DVec3>, volume: &[f64], rest_density: f64) -> Self {
        let n = position.len();
        Self {
            position: Column::with("position", "m", position),
            velocity: Column::with("velocity", "m/s", vec![DVec3::ZERO; n]),
            density_change: Column::with("density_change", "kg/m^3", vec![0.0; n]),
            pressure: Column::with("pressure", "Pa", vec![0.0; n]),
            density_rate: Column::with("density_rate", "kg/(m^3 s)", vec![0.0; n]),
            mass: Column::with("mass", "kg", volume.iter().map(|v| rest_density * v).collect()),
            id: Column::with("id", "", (0..n as u64).collect()),
            opening: Column::with("opening", "", vec![Self::NO_OPENING; n]),
        }
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are no particles.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Columns for FluidState {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        let Self { position, velocity, density_change, pressure, density_rate, mass, id, opening } = self;
        visitor.vector(position);
        visitor.vector(velocity);
        visitor.scalar(density_change);
        visitor.scalar(pressure);
        visitor.scalar(density_rate);
        visitor.scalar(mass);
        visitor.integer(id);
        visitor.label(opening);
    }
}
