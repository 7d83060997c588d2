//! Moves a way through the lumen to the centres of its sections.

use super::curve::Curve;
use crate::distance::SignedDistance;
use glam::DVec3;
use rayon::prelude::*;

/// Rays of a section.
const RAYS: usize = 48;
/// How far a section reaches, in distances from the wall: farther, and it would enter other branches.
const REACH: f64 = 3.0;
/// Most by which the border may be farther on one ray than on the next: beyond, it is another branch.
const JUMP: f64 = 1.5;
/// Rounds of moving and smoothing.
const ROUNDS: usize = 8;
/// Most by which a point moves in a round, and width of the smoothing, in distances from the wall.
const MOVE: f64 = 0.3;
const WIDTH: f64 = 0.4;

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
        let width = |x: DVec3| WIDTH * wall.query(x).distance.abs().max(2.0 * step);
        curve = Curve::new(moved).smoothed(width).resampled(step);
    }
    curve
}

/// Centroid of the section through `origin` along two axes; the origin where the section is not closed.
fn centroid(origin: DVec3, [x, y]: [DVec3; 2], wall: &SignedDistance) -> DVec3 {
    let clearance = wall.query(origin).distance.abs();
    let ray = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / RAYS as f64;
        let direction = angle.cos() * x + angle.sin() * y;
        Some((wall.cast(origin, direction, REACH * clearance)?, direction))
    };
    let Some(rays) = (0..RAYS).map(ray).collect::<Option<Vec<_>>>() else { return origin };
    let (mut area, mut moment) = (0.0, DVec3::ZERO);
    for (k, &(r, direction)) in rays.iter().enumerate() {
        let next = rays[(k + 1) % RAYS].0;
        if (next / r).max(r / next) > JUMP {
            return origin;
        }
        area += r * r / 2.0;
        moment += r * r * r / 3.0 * direction;
    }
    origin + (moment / area).clamp_length_max(MOVE * clearance)
}
