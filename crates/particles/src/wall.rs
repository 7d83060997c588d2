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

/// Signed distance to the wall surface of the lumen, continued beyond the openings.
pub trait WallDistance: Sync {
    /// Distance \[m\], negative in the lumen, and its unit gradient; may be clamped far from the wall.
    fn sample(&self, x: DVec3) -> (f64, DVec3);
}
