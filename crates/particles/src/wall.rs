//! What a wall shows the fluid: the contract between physics crates that do not know each other.

use glam::DVec3;

/// Particles of a wall as the fluid sees them; a rigid, solid or shell wall differs only in who fills it.
#[derive(Clone, Copy, Debug)]
pub struct WallView<'a> {
    /// Positions \[m\].
    pub position: &'a [DVec3],
    /// Velocity averaged over the fluid step \[m/s\].
    pub velocity: &'a [DVec3],
    /// Distance behind the lumen surface \[m\], positive.
    pub depth: &'a [f64],
    /// Volume \[m^3\].
    pub volume: &'a [f64],
}

/// How the wall moved over the last step of the fluid, beside what [`WallView`] shows of it.
#[derive(Clone, Copy, Debug)]
pub struct WallMotion<'a> {
    /// Velocity at the end of the step \[m/s\].
    pub end_velocity: &'a [DVec3],
    /// Displacement over the step, divided by its length \[m/s\].
    pub mean_velocity: &'a [DVec3],
    /// Change of the end velocity over the step, divided by its length \[m/s^2\].
    pub acceleration: &'a [DVec3],
}

/// What the fluid hands back: forces on the particles of the wall, in the order of its [`WallView`].
///
/// They hold until the next load; a wall keeps the pressure between acoustic steps, the viscous force between
/// advective ones.
#[derive(Clone, Copy, Debug)]
pub struct WallLoad<'a> {
    /// Force by differences of pressure and its dissipation \[N\].
    pub pressure_force: &'a [DVec3],
    /// Pressure on the faces of the wall \[Pa\], in their order; none on a wall without faces of its own.
    pub face_pressure: &'a [f64],
    /// Force by viscosity \[N\].
    pub viscous_force: &'a [DVec3],
}

/// Signed distance to the wall surface of the lumen, continued beyond the openings.
pub trait WallDistance: Send + Sync {
    /// Distance \[m\], negative in the lumen, and its unit gradient; may be clamped far from the wall.
    fn sample(&self, x: DVec3) -> (f64, DVec3);
}
