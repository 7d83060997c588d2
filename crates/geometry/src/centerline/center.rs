//! Moves a way through the lumen to the centres of its sections.

use super::curve::Curve;
use crate::distance::SignedDistance;
use glam::DVec3;
use rayon::prelude::*;

/// Rays of a section.
const RAYS: usize = 48;
/// How far a section reaches, in distances from the wall: farther, and it would enter other branches.
const REACH: f64 = 3.0;
/// Rounds of moving and smoothing.
const ROUNDS: usize = 4;
/// Passes of smoothing in each.
const PASSES: usize = 6;

/// `curve` with its points, about `step` \[m\] apart, moved into the centroids of the sections across it.
///
/// The ends stay. Where a section is not closed within reach, as in a junction, its points follow their
/// neighbours.
pub(super) fn centered(curve: &Curve, wall: &SignedDistance, step: f64) -> Curve {
    let mut curve = curve.resampled(step);
    for _ in 0..ROUNDS {
        let n = curve.points().len();
        let frames = curve.frames(DVec3::Y);
        let moved: Vec<DVec3> = frames
            .par_iter()
            .enumerate()
            .map(|(k, f)| if k == 0 || k + 1 == n { f.origin } else { centroid(f.origin, [f.x, f.y], wall) })
            .collect();
        curve = Curve::new(moved).smoothed(PASSES).resampled(step);
    }
    curve
}

/// Centroid of the section through `origin` along two axes; the origin where the section is not closed.
fn centroid(origin: DVec3, [x, y]: [DVec3; 2], wall: &SignedDistance) -> DVec3 {
    let reach = REACH * wall.query(origin).distance.abs();
    let (mut area, mut moment) = (0.0, DVec3::ZERO);
    for k in 0..RAYS {
        let angle = std::f64::consts::TAU * k as f64 / RAYS as f64;
        let direction = angle.cos() * x + angle.sin() * y;
        let Some(r) = wall.cast(origin, direction, reach) else { return origin };
        area += r * r / 2.0;
        moment += r * r * r / 3.0 * direction;
    }
    origin + moment / area
}
