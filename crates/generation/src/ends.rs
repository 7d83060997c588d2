//! What happens to a wall or shell at the openings.

use glam::DVec3;
use rayon::prelude::*;
use vaso_geometry::{Opening, Vessel};

/// Length of the ring held at each opening, in spacings: that of the buffer in which inflow and outflow are
/// imposed, which then lies between walls at rest.
const RING: f64 = 4.0;

/// Length of the ring held at each opening \[m\], never less than one kernel support.
pub(crate) fn ring(spacing: f64, smoothing: f64) -> f64 {
    RING.max(2.0 * smoothing) * spacing
}

/// Whether each particle belongs to the ring held at an opening: within `ring` \[m\] of the plane of a cap,
/// on either side, and not more than `lateral` \[m\] beyond its border.
pub(crate) fn clamped(
    vessel: &Vessel,
    position: &[DVec3],
    normal: &[DVec3],
    ring: f64,
    lateral: f64,
) -> Vec<bool> {
    let is_held = |(&x, &normal): (&DVec3, &DVec3)| {
        vessel.openings.iter().any(|opening| {
            opening.depth(x).abs() < ring && opening.lateral(x) < lateral && faces_away(opening, x, normal)
        })
    };
    position.par_iter().zip(normal).map(is_held).collect()
}

/// Whether the wall at `x` turns its back to the axis of `opening`; that of a limb passing by does not.
fn faces_away(opening: &Opening, x: DVec3, normal: DVec3) -> bool {
    let away = (x - opening.center).reject_from_normalized(opening.normal);
    away.dot(normal) > 0.0
}
