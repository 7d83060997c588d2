//! What a generator must know about the space it fills.

use crate::faces::Faces;
use glam::DVec3;

/// A part of space to be filled with particles.
///
/// Each question comes twice: from a table for the many relaxation steps, and exact for the sites
/// near the border and the last bounding.
pub(crate) trait Region: Sync {
    /// Lower and upper corner of a box around the region \[m\].
    fn bounds(&self) -> (DVec3, DVec3);

    /// Signed distance to the border \[m\], negative inside; true near the border, clamped to
    /// [`Self::band`] away from it.
    fn level(&self, x: DVec3) -> f64;

    /// As [`Self::level`] without interpolation.
    fn exact_level(&self, x: DVec3) -> f64;

    /// Distance up to which [`Self::level`] is told \[m\].
    fn band(&self) -> f64;

    /// The faces within reach of a kernel at `x`, from the table.
    fn faces(&self, x: DVec3) -> Faces;

    /// As [`Self::faces`] without interpolation.
    fn exact_faces(&self, x: DVec3) -> Faces;
}
