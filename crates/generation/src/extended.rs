//! The lumen with its openings drawn out straight, so that the wall has a distance beyond the caps.
//!
//! Inside the vessel the distance to the drawn-out wall is the distance to the wall. Beyond a cap it is
//! the in-plane distance to the border of the cap: there the collar of the wall ends, and in front of an
//! opening one is inside the drawn-out lumen, where no wall belongs.

use glam::DVec3;
use std::collections::BTreeMap;
use vaso_geometry::{DistanceGrid, SignedDistance, Surface, Vessel};

/// Distance to the wall of a vessel whose openings are drawn out.
pub(crate) struct ExtendedLumen {
    exact: SignedDistance,
    table: DistanceGrid,
    /// Box of the drawn-out surface, widened by the reach \[m\].
    pub(crate) bounds: (DVec3, DVec3),
    /// By how much each opening is drawn out \[m\].
    pub(crate) length: Vec<f64>,
}

impl ExtendedLumen {
    /// Draws each opening out by `length` \[m\], less where another part of the vessel is in the way.
    ///
    /// `reach` \[m\] is how far outside the wall the distance will be asked for.
    pub(crate) fn new(vessel: &Vessel, length: f64, reach: f64, spacing: f64) -> Self {
        let length = free_lengths(vessel, length, spacing);
        let extended = draw_out(vessel, &length);
        let (low, high) = extended.surface.bounds();
        let bounds = (low - reach, high + reach);
        // As wide as the reach and what a region has to tell beyond it, and not less than a kernel feels.
        let band = (reach + 1.5 * spacing).max(6.5 * spacing);
        let exact = SignedDistance::closed(&extended);
        let table =
            DistanceGrid::build(&exact, (low - reach - spacing, high + reach + spacing), spacing, band);
        Self { exact, table, bounds, length }
    }

    /// Distance \[m\], negative inside, and its gradient, from the table.
    #[inline]
    pub(crate) fn sample(&self, x: DVec3) -> (f64, DVec3) {
        self.table.sample(x)
    }

    /// Distance \[m\], negative inside, and its gradient.
    pub(crate) fn query(&self, x: DVec3) -> (f64, DVec3) {
        let nearest = self.exact.query(x);
        (nearest.distance, nearest.normal)
    }
}

/// The vessel with each opening drawn out by `length` \[m\], less where another part is in the way; the
/// frames of the openings stay where they are.
pub(crate) fn with_collars(vessel: &Vessel, length: f64, spacing: f64) -> Vessel {
    draw_out(vessel, &free_lengths(vessel, length, spacing))
}

/// How far each opening can be drawn out, at most `length` \[m\].
fn free_lengths(vessel: &Vessel, length: f64, spacing: f64) -> Vec<f64> {
    let closed = SignedDistance::closed(vessel);
    let free = |opening| free_length(vessel, &closed, opening, length, spacing);
    (0..vessel.openings.len()).map(free).collect()
}

/// How far the border of an opening can be moved out before another part of the vessel is nearer than
/// the opening itself \[m\].
fn free_length(vessel: &Vessel, closed: &SignedDistance, opening: usize, length: f64, spacing: f64) -> f64 {
    let o = &vessel.openings[opening];
    let step = 0.5 * spacing;
    let is_free = |l: f64| {
        o.polygon.iter().all(|&[u, v]| {
            let x = o.center + u * o.axes[0] + v * o.axes[1] + l * o.normal;
            closed.query(x).distance >= 0.95 * l
        })
    };
    let steps = (length / step).ceil() as usize;
    let free = (1..=steps).take_while(|&k| is_free(k as f64 * step)).count();
    (free.max(1) as f64 * step).min(length)
}

/// The vessel with the caps moved out by `length` and a strip of triangles in between.
fn draw_out(vessel: &Vessel, length: &[f64]) -> Vessel {
    let Surface { mut vertices, mut triangles } = vessel.surface.clone();
    let mut face_opening = vessel.face_opening.clone();
    for (k, opening) in vessel.openings.iter().enumerate() {
        let cap: Vec<usize> = (0..vessel.surface.triangles.len())
            .filter(|&t| vessel.face_opening[t] == Some(k as u32))
            .collect();
        let border = border(cap.iter().map(|&t| vessel.surface.triangles[t]));
        let mut moved = BTreeMap::new();
        let mut copy = |v: u32| {
            *moved.entry(v).or_insert_with(|| {
                vertices.push(vertices[v as usize] + length[k] * opening.normal);
                vertices.len() as u32 - 1
            })
        };
        for &t in &cap {
            triangles[t] = triangles[t].map(&mut copy);
        }
        for (a, b) in border {
            let (a_out, b_out) = (copy(a), copy(b));
            triangles.extend([[a, b, b_out], [a, b_out, a_out]]);
            face_opening.extend([None, None]);
        }
    }
    let mut extended = vessel.clone();
    extended.surface = Surface { vertices, triangles };
    extended.face_opening = face_opening;
    extended
}

/// Directed edges of a patch of triangles that have no neighbour in the patch.
fn border(patch: impl Iterator<Item = [u32; 3]>) -> Vec<(u32, u32)> {
    let mut edges: Vec<(u32, u32)> = patch.flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
    edges.sort_unstable();
    let inner = |&(a, b): &(u32, u32)| edges.binary_search(&(b, a)).is_ok();
    edges.iter().filter(|e| !inner(e)).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_geometry::{LengthUnit, prepare, shapes};

    fn vessel(surface: Surface) -> Vessel {
        prepare(surface, Some(LengthUnit::Millimetre)).expect("a closed shape is a vessel")
    }

    #[test]
    fn a_pipe_drawn_out_is_a_longer_pipe() {
        let pipe = vessel(shapes::pipe(2.0, 10.0, DVec3::Z, 24));
        let longer = vessel(shapes::pipe(2.0, 13.0, DVec3::Z, 24));
        let extended = draw_out(&pipe, &[1e-3, 2e-3]);
        assert!((extended.surface.volume() / longer.surface.volume() - 1.0).abs() < 1e-12);
        assert!((extended.surface.area() / longer.surface.area() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn beyond_a_cap_the_distance_is_that_to_the_border() {
        let dp = 0.4e-3;
        let lumen = ExtendedLumen::new(&vessel(shapes::pipe(2.0, 10.0, DVec3::Z, 96)), 3.0 * dp, dp, dp);
        for (r, z) in [(1.8e-3, -0.8e-3), (2.7e-3, -0.8e-3), (2.7e-3, 10.8e-3), (1.8e-3, 5e-3)] {
            let (distance, outward) = lumen.query(DVec3::new(r, 0.0, z));
            assert!((distance - (r - 2e-3)).abs() < 2e-6, "{distance} at r {r}, z {z}");
            assert!(outward.dot(DVec3::X) > 0.99, "{outward}");
        }
    }

    /// The caps of a U-bend look the same way: drawn out, each passes the other at a distance. A wall
    /// across the way of one of them stops it.
    #[test]
    fn an_opening_is_drawn_out_as_far_as_the_way_is_free() {
        let bend = vessel(shapes::bent_pipe(2.0, 5.0, std::f64::consts::PI, 48));
        let lumen = ExtendedLumen::new(&bend, 3e-3, 1e-3, 0.4e-3);
        assert!(lumen.length.iter().all(|l| (l - 3e-3).abs() < 1e-12), "{:?}", lumen.length);
        let hook = vessel(shapes::bent_pipe(2.0, 5.0, 1.6 * std::f64::consts::PI, 48));
        let lumen = ExtendedLumen::new(&hook, 3e-3, 1e-3, 0.4e-3);
        assert!(lumen.length.iter().any(|l| *l < 2.9e-3), "{:?}", lumen.length);
    }
}
