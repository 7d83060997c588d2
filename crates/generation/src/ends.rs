//! What happens to a wall or shell at the openings.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use vaso_geometry::{Nearest, Opening, Vessel};

/// How a wall ends at the openings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Ends {
    /// In the plane of the cap: the wall is relaxed around the closed surface, then what is nearest to a cap,
    /// or stands beyond its plane and turns its back to the opening, is removed. A limb that passes an opening
    /// keeps its wall.
    #[default]
    ClosestCap,
    /// In the plane of the cap: the wall is relaxed around the closed surface, then what stands in a box on each
    /// cap, four spacings high and wider than the vessel, is removed (Wu et al. 2025), whatever limb it belongs
    /// to.
    Boxes,
    /// Beyond the cap: the wall goes on straight, less far where another limb is in the way, and is relaxed
    /// with its end.
    Collar {
        /// How far it goes on \[m\].
        length: f64,
    },
}

/// Height of the boxes of [`Ends::Boxes`], in spacings; the thickness where that is more.
pub(crate) const BOX_HEIGHT: f64 = 4.0;
/// How far beyond the outer face of the wall something counts as belonging to an opening, in spacings.
pub(crate) const LATERAL: f64 = 2.0;
/// Length of the ring held at each opening, in spacings: that of the buffer in which inflow and outflow are
/// imposed, which then lies between walls at rest.
const RING: f64 = 4.0;

/// Whether a particle at `x`, with its nearest point on the closed surface, stands in front of an opening or
/// beyond the end of its wall, at most `lateral` \[m\] beside it.
pub(crate) fn beyond_cap(vessel: &Vessel, x: DVec3, nearest: &Nearest, lateral: f64) -> bool {
    let is_beyond = |opening: &Opening| {
        opening.depth(x) < 0.0 && opening.lateral(x) < lateral && faces_away(opening, x, nearest.normal)
    };
    vessel.face_opening[nearest.triangle as usize].is_some() || vessel.openings.iter().any(is_beyond)
}

/// Whether `x` stands in the box on a cap: `height` \[m\] high, and `lateral` \[m\] wider on each side than the
/// cap.
pub(crate) fn in_box(vessel: &Vessel, x: DVec3, height: f64, lateral: f64) -> bool {
    vessel.openings.iter().any(|opening| {
        let beyond = -opening.depth(x);
        let place = opening.project(x);
        let is_over = |axis: usize| {
            let border = opening.polygon.iter().map(|p| p[axis]);
            let low = border.clone().fold(f64::INFINITY, f64::min);
            let high = border.fold(f64::NEG_INFINITY, f64::max);
            (low - lateral..=high + lateral).contains(&place[axis])
        };
        (0.0..=height).contains(&beyond) && is_over(0) && is_over(1)
    })
}

/// Length of the ring held at each opening \[m\], never less than one kernel support.
pub(crate) fn ring(spacing: f64, smoothing: f64) -> f64 {
    RING.max(2.0 * smoothing) * spacing
}

/// Whether each particle belongs to the ring held at an opening: within `ring` \[m\] of the plane of a cap,
/// on either side, not more than `lateral` \[m\] beyond its border, and its normal off the axis.
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
