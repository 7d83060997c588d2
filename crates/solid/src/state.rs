//! What every solid particle carries from step to step.

use glam::DVec3;
use vaso_particles::{Column, Columns, ScalarColumn, VectorColumn, Visitor};

/// Columns of a solid, in the cell order of the reference configuration.
#[derive(Clone, Debug)]
pub struct SolidState {
    /// Position in the reference configuration \[m\].
    pub reference_position: VectorColumn,
    /// Position minus reference position \[m\]: the difference keeps the digits the strain needs.
    pub displacement: VectorColumn,
    /// Velocity \[m/s\].
    pub velocity: VectorColumn,
    /// Acceleration by stress, hourglass control and damping, without loads \[m/s^2\].
    pub acceleration: VectorColumn,
    /// Volume in the reference configuration \[m^3\].
    pub volume: ScalarColumn,
    /// Mass \[kg\].
    pub mass: ScalarColumn,
    /// Number of the particle as it was given.
    pub id: Column<u64>,
    /// What holds it: [`SolidState::FREE`], [`SolidState::CLAMPED`], or the number of a plane it slides on.
    pub support: Column<i32>,
}

impl SolidState {
    /// Support of a particle that nothing holds.
    pub const FREE: i32 = -1;
    /// Support of a particle that does not move.
    pub const CLAMPED: i32 = -2;

    /// Solid at rest in its reference configuration, of the volumes \[m^3\] given.
    pub fn at_rest(position: &[DVec3], volume: &[f64], density: f64) -> Self {
        let n = position.len();
        let zero = || vec![DVec3::ZERO; n];
        Self {
            reference_position: Column::with("reference_position", "m", position.to_vec()),
            displacement: Column::with("displacement", "m", zero()),
            velocity: Column::with("velocity", "m/s", zero()),
            acceleration: Column::with("acceleration", "m/s^2", zero()),
            volume: Column::with("volume", "m^3", volume.to_vec()),
            mass: Column::with("mass", "kg", volume.iter().map(|v| density * v).collect()),
            id: Column::with("id", "", (0..n as u64).collect()),
            support: Column::with("support", "", vec![Self::FREE; n]),
        }
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.volume.len()
    }

    /// Whether there are no particles.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position of particle `i` \[m\].
    pub fn position(&self, i: usize) -> DVec3 {
        self.reference_position[i] + self.displacement[i]
    }
}

impl Columns for SolidState {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        let Self { reference_position, displacement, velocity, acceleration, volume, mass, id, support } =
            self;
        visitor.vector(reference_position);
        visitor.vector(displacement);
        visitor.vector(velocity);
        visitor.vector(acceleration);
        visitor.scalar(volume);
        visitor.scalar(mass);
        visitor.integer(id);
        visitor.label(support);
    }
}
