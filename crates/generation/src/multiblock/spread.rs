//! Pushes apart the few cell centres that came too close where limbs meet.

use crate::lumen::Lumen;
use crate::neighbors::{CHUNK, Neighbors};
use crate::region::Region;
use glam::DVec3;
use rayon::prelude::*;

/// Distance below which two particles push each other apart, in spacings.
const CLOSE: f64 = 0.75;
/// Distance particles so pushed keep from every face, in spacings.
const GAP: f64 = 0.4;
/// Share of what two particles lack in distance that a step makes up; both move.
const SHARE: f64 = 0.3;
/// Most steps.
const STEPS: usize = 40;

/// Moves particles closer than [`CLOSE`] apart and leaves all others where they are; positions and volumes come
/// back in the order of the search grid. Returns how many particles were moved.
pub(super) fn spread(
    region: &Lumen<'_>,
    spacing: f64,
    position: &mut Vec<DVec3>,
    volume: &mut Vec<f64>,
) -> usize {
    let mut neighbors = Neighbors::new(region.bounds(), 2.0 * CLOSE * spacing);
    let order = neighbors.rebuild(position).to_vec();
    *volume = order.iter().map(|&k| volume[k as usize]).collect();
    let start = position.clone();
    for _ in 0..STEPS {
        // The lists reach twice as far as the pushes, which move nobody farther than that.
        let moved: Vec<(usize, DVec3)> = neighbors
            .chunks()
            .par_iter()
            .enumerate()
            .flat_map_iter(|(c, chunk)| chunk.rows().enumerate().map(move |(k, row)| (c * CHUNK + k, row)))
            .filter_map(|(i, row)| pushed(position, i, row, spacing).map(|x| (i, bound(region, spacing, x))))
            .collect();
        if moved.is_empty() {
            break;
        }
        for (i, x) in moved {
            position[i] = x;
        }
    }
    position.iter().zip(&start).filter(|(a, b)| a != b).count()
}

/// Where the neighbours in `row` push particle `i`; `None` when none is close.
fn pushed(position: &[DVec3], i: usize, row: &[u32], spacing: f64) -> Option<DVec3> {
    let close = CLOSE * spacing;
    let push: DVec3 = row
        .iter()
        .map(|&j| position[i] - position[j as usize])
        .filter(|d| d.length_squared() < close * close)
        .map(|d| SHARE * (close - d.length()) * d.normalize_or(DVec3::X))
        .sum();
    (push != DVec3::ZERO).then(|| position[i] + push)
}

fn bound(region: &Lumen<'_>, spacing: f64, x: DVec3) -> DVec3 {
    let faces = region.exact_faces(x);
    if faces.clearance() < GAP * spacing { faces.push_inside(x, GAP * spacing) } else { x }
}
