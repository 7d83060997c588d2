//! What an opening tells the fluid about the particles near its cap.

use glam::DVec3;

/// A fluid particle near a cap, where the kernel support is not complete.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CapZone {
    /// Index of the particle, valid until the next sort.
    pub particle: u32,
    /// Number of the opening.
    pub opening: u32,
    /// Outward normal of the cap.
    pub normal: DVec3,
    /// Depth behind the cap \[m\].
    pub depth: f64,
    /// Whether the particle is in the buffer, where density follows continuity alone.
    pub in_buffer: bool,
}
