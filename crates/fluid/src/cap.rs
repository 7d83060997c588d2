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
    /// Whether the velocity of the particle is imposed.
    pub is_imposed: bool,
    /// Whether the particle is in the buffer, where density follows continuity alone.
    pub in_buffer: bool,
    /// Whether the pressure of the opening enters at the particle, by what its support lacks.
    pub takes_pressure: bool,
    /// Part by which the particle counts in the number that the vessel holds: its depth over the length of the buffer, at most 1. The
    /// number then changes smoothly while layers cross the cap.
    pub share: f64,
}

impl CapZone {
    /// Depth \[m\] up to which the fluid behind the cap is free; an imposed flow has no divergence, so nothing counts.
    pub(crate) fn open_depth(&self) -> f64 {
        if self.is_imposed { IMPOSED } else { self.depth.max(0.0) }
    }

    /// The `normal` of the wall near the particle as its continuity has to see it, for a kernel that reaches as far as `reach` \[m\].
    ///
    /// The flow there goes along the cap's normal, and into a wall that leans inwards; what that narrows, the flow gains across the cap. As
    /// continuity sees less of the latter the nearer the cap is, it may see no more of the former: otherwise the pressure of the particle
    /// rises as it goes outwards and drives it on, which grows at a fraction of `c/dp`.
    pub(crate) fn upright(&self, normal: DVec3, reach: f64) -> DVec3 {
        if !self.takes_pressure {
            return normal;
        }
        let unseen = (1.0 - self.depth / reach).clamp(0.0, 1.0);
        (normal - unseen * normal.dot(self.normal) * self.normal).normalize_or(normal)
    }
}

/// Below any depth, by more than a support.
const IMPOSED: f64 = -1e3;
