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

    /// Signed distance to the border \[m\], negative inside; told within two spacings of the border.
    fn level(&self, x: DVec3) -> f64;

    /// As [`Self::level`] without interpolation, and everywhere.
    fn exact_level(&self, x: DVec3) -> f64;

    /// The faces within reach of a kernel at `x`, from the table.
    fn faces(&self, x: DVec3) -> Faces;

    /// As [`Self::faces`] without interpolation.
    fn exact_faces(&self, x: DVec3) -> Faces;
}
