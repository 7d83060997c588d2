//! Triangles without area and triangles given more than once.

use std::ops::AddAssign;

use super::{
    edges::{Edges, NONE},
    flip::Flips,
    keep_triangles,
};
use crate::surface::Surface;

/// A triangle below this part of the squared diagonal has no area to speak of. Relative, because an
/// absolute limit would take all triangles of a file in metres.
const NO_AREA: f64 = 1e-12;
/// A triangle lower than this part of the diagonal has its corners in a line, up to the rounding of
/// single-precision coordinates.
const NO_HEIGHT: f64 = 1e-6;
/// Bound on the rounds of [`flip_slivers`]; one is enough unless slivers lie side by side.
const MAX_FLIP_ROUNDS: usize = 8;

/// How many triangles went, and why.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Cleaned {
    /// Triangles with two equal corners, or three in a line that belong to no closed sheet.
    pub(crate) degenerate: usize,
    /// Triangles given more than once, or folded flat onto each other.
    pub(crate) duplicate: usize,
}

impl AddAssign for Cleaned {
    fn add_assign(&mut self, other: Cleaned) {
        self.degenerate += other.degenerate;
        self.duplicate += other.duplicate;
    }
}

/// Drops triangles with two equal corners and duplicate ones.
pub(crate) fn clean(surface: &mut Surface) -> Cleaned {
    let before = surface.triangles.len();
    surface.triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
    let distinct = surface.triangles.len();
    drop_duplicates(surface);
    surface.drop_unused_vertices();
    Cleaned { degenerate: before - distinct, duplicate: distinct - surface.triangles.len() }
}

/// Of triangles with the same three corners keeps one, or none where the surface closes without.
///
/// A triangle stored twice leaves three sides at each of its edges, and one copy has to stay. Two
/// triangles folded onto each other (by welding a thin one) leave four, and both have to go.
fn drop_duplicates(surface: &mut Surface) {
    let triangles = &surface.triangles;
    let mut by_corners: Vec<([u32; 3], usize)> = triangles.iter().copied().zip(0..).collect();
    by_corners.iter_mut().for_each(|(corners, _)| corners.sort_unstable());
    by_corners.sort_unstable();
    let same_corners = || by_corners.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1);
    if same_corners().next().is_none() {
        return;
    }
    let edges_of = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [a, c]];
    let mut edges: Vec<[u32; 2]> = by_corners.iter().flat_map(|&(corners, _)| edges_of(corners)).collect();
    edges.sort_unstable();
    let sides_at =
        |edge: [u32; 2]| edges.partition_point(|&e| e <= edge) - edges.partition_point(|&e| e < edge);
    let mut keep = vec![true; triangles.len()];
    for same in same_corners() {
        let open = |&edge: &[u32; 2]| (sides_at(edge) - same.len()) % 2 == 1;
        let wanted = edges_of(same[0].0).iter().filter(|e| open(e)).count() >= 2
            || same.iter().all(|&(_, t)| same_sense(triangles[same[0].1], triangles[t]));
        for &(_, t) in &same[usize::from(wanted)..] {
            keep[t] = false;
        }
    }
    keep_triangles(surface, &keep);
}

/// Whether two triangles with the same corners run around them the same way.
fn same_sense([a, b, c]: [u32; 3], other: [u32; 3]) -> bool {
    [[a, b, c], [b, c, a], [c, a, b]].contains(&other)
}

/// Whether triangle `t` spans no area, given the squared diagonal of the surface.
fn has_no_area(surface: &Surface, t: usize, diagonal_squared: f64) -> bool {
    surface.triangle_area(t) < NO_AREA * diagonal_squared
}

/// Drops triangles with their corners in a line that lie loosely on the surface; returns how many.
///
/// One whose three edges all have exactly two sides is a stitch of a closed sheet: without it the sheet
/// would have a slit. Those stay, and [`flip_slivers`] gives them a shape.
pub(crate) fn drop_loose_slivers(surface: &mut Surface) -> usize {
    let min_height = NO_HEIGHT * surface.diagonal();
    let across = Edges::new(&surface.triangles).neighbours(surface.triangles.len());
    let is_line = |t: usize| {
        let [a, b, c] = surface.triangle(t);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        2.0 * surface.triangle_area(t) < min_height * longest
    };
    let keep: Vec<bool> =
        (0..surface.triangles.len()).map(|t| !across[t].contains(&NONE) || !is_line(t)).collect();
    keep_triangles(surface, &keep)
}

/// Gives triangles without area a shape by exchanging their longest side for the other diagonal of the
/// quadrilateral with the neighbour there. The surface must be oriented. Returns the number of exchanges.
pub(crate) fn flip_slivers(surface: &mut Surface) -> usize {
    let limit = surface.diagonal().powi(2);
    let mut flipped = 0;
    // An exchange may hand the missing area on to the neighbour, so a chain of slivers takes some rounds.
    for _ in 0..MAX_FLIP_ROUNDS {
        let slivers: Vec<usize> =
            (0..surface.triangles.len()).filter(|&t| has_no_area(surface, t, limit)).collect();
        if slivers.is_empty() {
            break;
        }
        let mut flips = Flips::new(&surface.triangles);
        let before = flipped;
        for t in slivers {
            let longest = longest_side(surface, t);
            flipped += usize::from(flips.flip(&mut surface.triangles, t, longest));
        }
        if flipped == before {
            break;
        }
    }
    flipped
}

/// The corner of a triangle at which its longest side starts.
fn longest_side(surface: &Surface, t: usize) -> usize {
    let place = surface.triangle(t);
    let length = |k: usize| place[k].distance(place[(k + 1) % 3]);
    (0..3).max_by(|&i, &j| length(i).total_cmp(&length(j))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::repair::edges::Edges;

    /// An octahedron, closed and outward.
    fn octahedron() -> Surface {
        Surface {
            vertices: vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z],
            triangles: vec![
                [0, 1, 2],
                [1, 3, 2],
                [3, 4, 2],
                [4, 0, 2],
                [1, 0, 5],
                [3, 1, 5],
                [4, 3, 5],
                [0, 4, 5],
            ],
        }
    }

    #[test]
    fn copies_go_whatever_their_sense() {
        let clean_one = octahedron();
        let mut s = octahedron();
        s.triangles.extend([[0, 1, 2], [2, 3, 1], [5, 3, 4]]);
        assert_eq!(clean(&mut s), Cleaned { degenerate: 0, duplicate: 3 });
        assert_eq!(s, clean_one);
    }

    #[test]
    fn a_folded_pair_goes_altogether() {
        let mut s = octahedron();
        s.vertices.push(DVec3::new(1.0, 1.0, 1.0));
        s.triangles.extend([[0, 1, 6], [1, 0, 6]]);
        assert_eq!(clean(&mut s).duplicate, 2);
        assert_eq!(s, octahedron());
    }

    #[test]
    fn a_loose_sliver_goes() {
        let mut s = octahedron();
        s.vertices.push(0.5 * (DVec3::X + DVec3::Y));
        s.triangles.extend([[0, 6, 1], [3, 3, 1]]);
        assert_eq!(clean(&mut s), Cleaned { degenerate: 1, duplicate: 0 });
        assert_eq!(drop_loose_slivers(&mut s), 1);
        assert_eq!(s, octahedron());
    }

    #[test]
    fn a_stitched_sliver_is_given_a_shape() {
        let mut s = octahedron();
        // Vertex 6 amid edge 0-1: triangle 0 is split there, triangle 4 is not; a sliver stitches them.
        s.vertices.push(0.5 * (DVec3::X + DVec3::Y));
        s.triangles[0] = [0, 6, 2];
        s.triangles.extend([[6, 1, 2], [0, 1, 6]]);
        assert!(Edges::new(&s.triangles).is_closed_and_oriented());
        let volume = s.volume();
        assert_eq!(clean(&mut s), Cleaned::default());
        assert_eq!(drop_loose_slivers(&mut s), 0);
        assert_eq!(flip_slivers(&mut s), 1);
        assert!(Edges::new(&s.triangles).is_closed_and_oriented());
        assert!((s.volume() - volume).abs() < 1e-15);
        assert!((0..s.triangles.len()).all(|t| s.triangle_area(t) > 0.1));
    }
}
