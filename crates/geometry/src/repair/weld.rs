//! Vertices at the same place become one.

use std::collections::BTreeMap;

use glam::DVec3;

use super::edges::Edges;
use crate::surface::Surface;

/// Gap between vertices taken as one, as part of the diagonal of the bounding box.
const RELATIVE_TOLERANCE: f64 = 1e-5;
/// The same as part of the short edges (5th percentile), whichever is smaller: welding must not eat edges.
const EDGE_TOLERANCE: f64 = 0.1;

/// Joins vertices at exactly the same place; returns how many went.
///
/// Files that repeat a vertex for each triangle, as STL does, become a connected surface by this.
pub(crate) fn weld_exact(surface: &mut Surface) -> usize {
    merge(surface, exact_representatives)
}

/// What [`weld_border`] did.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Welded {
    /// Vertices joined to others.
    pub(crate) count: usize,
    /// Largest distance over which they were joined, in the unit of the surface.
    pub(crate) tolerance: f64,
}

/// Joins vertices of the border that are close to each other.
///
/// Only where exact welding leaves a border can a gap be meant to be closed. So vertices inside a sheet keep
/// their place, and a clean surface comes out as it went in. Degenerate and duplicate triangles have to be
/// gone before: they hide a border.
pub(crate) fn weld_border(surface: &mut Surface) -> Welded {
    let tolerance = tolerance(surface);
    let mut at_border = vec![false; surface.vertices.len()];
    for v in Edges::new(&surface.triangles).border().into_iter().flatten() {
        at_border[v as usize] = true;
    }
    // A tolerance below the rounding of the coordinates themselves joins nothing; cell numbers would overflow.
    let count = if tolerance > f64::EPSILON * surface.diagonal() {
        merge(surface, |vertices| close_representatives(vertices, &at_border, tolerance))
    } else {
        0
    };
    Welded { count, tolerance }
}

/// Replaces vertices by their representatives; returns how many went.
fn merge(surface: &mut Surface, representatives: impl Fn(&[DVec3]) -> Vec<u32>) -> usize {
    let of = representatives(&surface.vertices);
    let before = surface.vertices.len();
    for v in surface.triangles.iter_mut().flatten() {
        *v = of[*v as usize];
    }
    surface.drop_unused_vertices();
    before - surface.vertices.len()
}

/// For each vertex the first one at exactly the same place.
fn exact_representatives(vertices: &[DVec3]) -> Vec<u32> {
    // Adding zero turns -0 into +0, which are the same place.
    let key = |v: u32| (vertices[v as usize] + DVec3::ZERO).to_array().map(f64::to_bits);
    let mut order: Vec<u32> = (0..vertices.len() as u32).collect();
    order.sort_by_key(|&v| key(v));
    let mut of = vec![0; vertices.len()];
    for same in order.chunk_by(|&a, &b| key(a) == key(b)) {
        for &v in same {
            of[v as usize] = same[0];
        }
    }
    of
}

/// For each marked vertex the first marked one kept within `tolerance`, else itself.
fn close_representatives(vertices: &[DVec3], marked: &[bool], tolerance: f64) -> Vec<u32> {
    let mut of: Vec<u32> = (0..vertices.len() as u32).collect();
    let low = vertices.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    // In cells of twice the tolerance all that is within the tolerance lies in at most eight of them.
    let cell = |v: DVec3| ((v - low) / (2.0 * tolerance)).floor().to_array().map(|c| c as i64);
    let mut kept: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    for v in (0..vertices.len()).filter(|&v| marked[v]) {
        let place = vertices[v];
        let [from, to] = [cell(place - tolerance), cell(place + tolerance)];
        let found = (from[0]..=to[0])
            .flat_map(|x| (from[1]..=to[1]).flat_map(move |y| (from[2]..=to[2]).map(move |z| [x, y, z])))
            .filter_map(|near| kept.get(&near))
            .flatten()
            .filter(|&&k| vertices[k as usize].distance(place) <= tolerance)
            .min();
        match found {
            Some(&representative) => of[v] = representative,
            None => kept.entry(cell(place)).or_default().push(v as u32),
        }
    }
    of
}

/// The largest gap taken for a rounding error.
fn tolerance(surface: &Surface) -> f64 {
    let mut lengths: Vec<f64> = (0..surface.triangles.len())
        .flat_map(|t| {
            let [a, b, c] = surface.triangle(t);
            [a.distance(b), b.distance(c), c.distance(a)]
        })
        .collect();
    if lengths.is_empty() {
        return 0.0;
    }
    let fifth_percentile = lengths.len() / 20;
    let (_, short, _) = lengths.select_nth_unstable_by(fifth_percentile, f64::total_cmp);
    (RELATIVE_TOLERANCE * surface.diagonal()).min(EDGE_TOLERANCE * *short)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles of a unit square, unconnected, the second moved by `gap`.
    fn loose_square(gap: f64) -> Surface {
        let e = DVec3::splat(gap);
        Surface {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, e, DVec3::X + DVec3::Y + e, DVec3::Y],
            triangles: vec![[0, 1, 2], [3, 4, 5]],
        }
    }

    #[test]
    fn equal_places_join() {
        let mut s = loose_square(0.0);
        assert_eq!(weld_exact(&mut s), 2);
        assert_eq!(s.triangles, vec![[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn close_places_join_and_distant_ones_do_not() {
        let mut s = loose_square(1e-6);
        assert_eq!(weld_exact(&mut s), 0);
        assert_eq!(weld_border(&mut s).count, 2);
        let mut apart = loose_square(1e-4);
        assert_eq!(weld_border(&mut apart).count, 0);
        assert_eq!(apart.vertices.len(), 6);
    }

    #[test]
    fn minus_zero_is_zero() {
        let mut s = loose_square(0.0);
        s.vertices[3] = -s.vertices[0];
        assert_eq!(weld_exact(&mut s), 2);
    }
}
