//! What can be wrong with a shell, and how it fails.

use glam::DVec3;

/// Why a shell cannot be made or cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShellError {
    /// A number outside of what has a meaning.
    #[error("`{key}` is {value}, allowed is {allowed}")]
    OutOfRange {
        /// The number's name.
        key: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// Lists that belong together differ in length.
    #[error("{given} entries in `{what}` for {expected} particles; give one for each")]
    Count {
        /// Name of the list.
        what: &'static str,
        /// Its length.
        given: usize,
        /// Length it should have.
        expected: usize,
    },
    /// A list names a particle that does not exist.
    #[error("`{what}` names particle {particle} of {len}; particles are counted from zero")]
    NoSuchParticle {
        /// Name of the list.
        what: &'static str,
        /// The number found.
        particle: usize,
        /// Number of particles.
        len: usize,
    },
    /// The neighbours of a particle do not span a surface.
    #[error(
        "shell particle {particle} at {position} m has {neighbours} neighbours whose normals agree with its own, and they \
         do not span a surface (smallest eigenvalue of the moment matrix {eigenvalue:.3}, needed 0.05); check the \
         orientation of the surface, or choose a smaller spacing"
    )]
    Lonely {
        /// Number of the particle as it was given.
        particle: u64,
        /// Its position \[m\].
        position: DVec3,
        /// Number of neighbours on its side.
        neighbours: usize,
        /// Smallest eigenvalue of the moment matrix in the tangent plane, 1 in the bulk.
        eigenvalue: f64,
    },
    /// The faces of the wall overlap in the reference configuration.
    #[error(
        "shell particle {particle} at {position} m is bent so much that a wall of {thickness:.2e} m folds onto itself (volume of a \
         layer at its face over that at its middle {volume:.3}); make the wall thinner there"
    )]
    Folded {
        /// Number of the particle as it was given.
        particle: u64,
        /// Its position \[m\].
        position: DVec3,
        /// Its thickness \[m\].
        thickness: f64,
        /// Volume of a layer at the worse of its faces over that at its middle, not above zero.
        volume: f64,
    },
    /// The shell is turned inside out.
    #[error(
        "shell particle {particle} at {position} m is turned inside out (determinant of its deformation gradient \
         {determinant:.3}); halve the step, add damping, or lower the load"
    )]
    Inverted {
        /// Number of the particle as it was given.
        particle: u64,
        /// Its position \[m\].
        position: DVec3,
        /// Determinant of the deformation gradient, not above zero, or not a number.
        determinant: f64,
    },
    /// More sub-steps than a step of the fluid should need.
    #[error(
        "a step of {step:.2e} s needs {needed} shell steps of {stable:.2e} s, more than {allowed}; the wall is too stiff \
         for its spacing"
    )]
    TooStiff {
        /// Step asked for \[s\].
        step: f64,
        /// Largest stable step \[s\].
        stable: f64,
        /// Number of steps it takes.
        needed: usize,
        /// Number of steps allowed.
        allowed: usize,
    },
}

/// Checks that a number lies within what is allowed.
pub(crate) fn within(
    key: &'static str,
    value: f64,
    is_allowed: bool,
    allowed: &'static str,
) -> Result<(), ShellError> {
    if is_allowed && value.is_finite() { Ok(()) } else { Err(ShellError::OutOfRange { key, value, allowed }) }
}
