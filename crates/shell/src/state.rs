//! What every shell particle carries from step to step.

use glam::DVec3;
use vaso_particles::{Column, Columns, ScalarColumn, VectorColumn, Visitor};

/// Columns of a shell, in the cell order of the reference configuration.
#[derive(Clone, Debug)]
pub struct ShellState {
    /// Position of the mid-surface in the reference configuration \[m\].
    pub reference_position: VectorColumn,
    /// Position minus reference position \[m\]: the difference keeps the digits the strain needs.
    pub displacement: VectorColumn,
    /// Velocity \[m/s\].
    pub velocity: VectorColumn,
    /// Acceleration by stress, hourglass control and damping, without loads \[m/s^2\].
    pub acceleration: VectorColumn,
    /// Unit director in the reference configuration, away from the lumen.
    pub reference_director: VectorColumn,
    /// Unit director.
    pub director: VectorColumn,
    /// Rate of the director, across it \[1/s\].
    pub director_velocity: VectorColumn,
    /// Acceleration of the director by moments and shear forces, without couples and without its part along the director
    /// \[1/s^2\].
    pub director_acceleration: VectorColumn,
    /// Area in the reference configuration \[m^2\].
    pub area: ScalarColumn,
    /// Thickness in the reference configuration \[m\].
    pub thickness: ScalarColumn,
    /// Mass \[kg\].
    pub mass: ScalarColumn,
    /// Rotary inertia, scaled for thin shells \[kg m^2\].
    pub rotary_inertia: ScalarColumn,
    /// Number of the particle as it was given.
    pub id: Column<u64>,
    /// What holds it: [`ShellState::FREE`], or the number of a [`crate::Support`] of the shell.
    pub support: Column<i32>,
}

impl ShellState {
    /// Support of a particle that nothing holds.
    pub const FREE: i32 = -1;

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.area.len()
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

impl Columns for ShellState {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        let Self {
            reference_position,
            displacement,
            velocity,
            acceleration,
            reference_director,
            director,
            director_velocity,
            director_acceleration,
            area,
            thickness,
            mass,
            rotary_inertia,
            id,
            support,
        } = self;
        visitor.vector(reference_position);
        visitor.vector(displacement);
        visitor.vector(velocity);
        visitor.vector(acceleration);
        visitor.vector(reference_director);
        visitor.vector(director);
        visitor.vector(director_velocity);
        visitor.vector(director_acceleration);
        visitor.scalar(area);
        visitor.scalar(thickness);
        visitor.scalar(mass);
        visitor.scalar(rotary_inertia);
        visitor.integer(id);
        visitor.label(support);
    }
}
