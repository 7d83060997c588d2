//! Where a surface cuts itself.

use glam::DVec3;
use parry3d_f64::{
    bounding_volume::Aabb,
    partitioning::{Bvh, BvhBuildStrategy},
};
use rayon::prelude::*;

use crate::{sets::Sets, surface::Surface};

/// Height over a plane, as part of the diagonal of the surface, that is rounding error.
const ON_PLANE: f64 = 1e-12;

/// Most other triangles that [`cut_triangles`] looks at for one.
const MAX_LOOKS: usize = 1000;

/// A connected part of the lines along which a surface cuts itself.
#[derive(Debug, Clone, PartialEq)]
pub struct IntersectionPlace {
    /// Mean of the points at which a side of one triangle pierces another.
    pub center: DVec3,
    /// Largest distance of such a point from the mean.
    pub radius: f64,
    /// Pairs of triangles that cut each other here.
    pub pairs: usize,
}

/// Pairs of triangles of `surface` that cut each other, sorted, the lower number first.
///
/// Neighbours across an edge cannot cut each other but fold onto each other; that, and triangles that overlap
/// in one plane, is not reported.
pub fn self_intersections(surface: &Surface) -> Vec<[u32; 2]> {
    let (boxes, tree) = boxes(surface);
    let on_plane = ON_PLANE * surface.diagonal();
    let cuts = |t: u32| -> Vec<[u32; 2]> {
        let mut found: Vec<[u32; 2]> = tree
            .intersect_aabb(&boxes[t as usize])
            .filter(|&other| other > t && cut(surface, t, other, on_plane).is_some())
            .map(|other| [t, other])
            .collect();
        found.sort_unstable();
        found
    };
    (0..boxes.len() as u32).into_par_iter().flat_map_iter(cuts).collect()
}

/// For each triangle that cuts another the pair with the first such other, as [`self_intersections`] has pairs. Where that would find every pair of a heap of
/// triangles, this looks at [`MAX_LOOKS`] others a triangle; a cut is missed where both are surrounded by more.
pub(crate) fn cut_triangles(surface: &Surface) -> Vec<[u32; 2]> {
    let (boxes, tree) = boxes(surface);
    let on_plane = ON_PLANE * surface.diagonal();
    let first = |t: u32| {
        tree.intersect_aabb(&boxes[t as usize])
            .take(MAX_LOOKS)
            .find(|&other| other != t && cut(surface, t, other, on_plane).is_some())
            .map(|other| [t.min(other), t.max(other)])
    };
    let mut found: Vec<[u32; 2]> = (0..boxes.len() as u32).into_par_iter().filter_map(first).collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Boxes of the triangles and a tree over them.
fn boxes(surface: &Surface) -> (Vec<Aabb>, Bvh) {
    let boxes: Vec<Aabb> = (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.triangle(t);
            Aabb::new(a.min(b).min(c), a.max(b).max(c))
        })
        .collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    (boxes, tree)
}

/// The connected places at which the given pairs of triangles lie, those with most pairs first.
pub(crate) fn places(surface: &Surface, pairs: &[[u32; 2]]) -> Vec<IntersectionPlace> {
    let mut sets = Sets::new(pairs.len());
    // Pairs belong together when they have a vertex in common.
    let mut owner: Vec<Option<usize>> = vec![None; surface.vertices.len()];
    for (k, pair) in pairs.iter().enumerate() {
        for &v in pair.iter().flat_map(|&t| &surface.triangles[t as usize]) {
            match owner[v as usize] {
                None => owner[v as usize] = Some(k),
                Some(other) => sets.join(k, other),
            }
        }
    }
    let on_plane = ON_PLANE * surface.diagonal();
    let point = |[s, t]: &[u32; 2]| cut(surface, *s, *t, on_plane).expect("pairs cut each other");
    let mut by_root: Vec<(usize, DVec3)> =
        (0..pairs.len()).map(|k| (sets.lowest(k), point(&pairs[k]))).collect();
    by_root.sort_by_key(|(root, _)| *root);
    let mut places: Vec<IntersectionPlace> = by_root
        .chunk_by(|a, b| a.0 == b.0)
        .map(|group| {
            let mean = group.iter().map(|(_, x)| *x).sum::<DVec3>() / group.len() as f64;
            let radius = group.iter().map(|(_, x)| x.distance(mean)).fold(0.0, f64::max);
            IntersectionPlace { center: mean, radius, pairs: group.len() }
        })
        .collect();
    places.sort_by_key(|place| std::cmp::Reverse(place.pairs));
    places
}

/// Where two triangles cut each other: the first point found at which a side of one pierces the other.
fn cut(surface: &Surface, s: u32, t: u32, on_plane: f64) -> Option<DVec3> {
    let [first, second] = [s, t].map(|k| surface.triangles[k as usize]);
    let common: Vec<u32> = first.into_iter().filter(|v| second.contains(v)).collect();
    if common.len() >= 2 {
        return None;
    }
    let place = |v: u32| surface.vertices[v as usize];
    // Of two triangles with a common vertex only the sides opposite to it can pierce the other.
    let pierced = |sides: [u32; 3], triangle: [u32; 3]| {
        (0..3).find_map(|k| {
            let (p, q) = (sides[k], sides[(k + 1) % 3]);
            let is_free = !common.contains(&p) && !common.contains(&q);
            is_free.then(|| pierced_at(place(p), place(q), triangle.map(place), on_plane))?
        })
    };
    pierced(first, second).or_else(|| pierced(second, first))
}

/// Where the segment from `p` to `q` passes through a triangle, its border included.
///
/// The signs of five tetrahedra tell (Segura and Feito, "Algorithms to test ray-triangle intersection",
/// WSCG 2001).
fn pierced_at(p: DVec3, q: DVec3, [a, b, c]: [DVec3; 3], on_plane: f64) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let limit = on_plane * normal.length();
    let (above, below) = (normal.dot(p - a), normal.dot(q - a));
    if !(above > limit && below < -limit || above < -limit && below > limit) {
        return None;
    }
    let side = |u: DVec3, v: DVec3| (u - p).cross(v - p).dot(q - p);
    let sides = [side(a, b), side(b, c), side(c, a)];
    let is_inside = sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0);
    is_inside.then(|| p.lerp(q, above / (above - below)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    fn pair(first: [DVec3; 3], second: [DVec3; 3]) -> Surface {
        Surface { vertices: first.into_iter().chain(second).collect(), triangles: vec![[0, 1, 2], [3, 4, 5]] }
    }

    const FLAT: [DVec3; 3] = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 4.0, 0.0)];

    #[test]
    fn triangles_that_cut_and_miss() {
        let upright = |x: f64, y: f64, z: f64| {
            [DVec3::new(x, y, z - 1.0), DVec3::new(x, y, z + 1.0), DVec3::new(x + 0.1, y + 9.0, z)]
        };
        // The edge goes through the face; only the third corner's side does; beside; above; before the corner.
        for (x, y, z, cuts) in [
            (1.0, 1.0, 0.0, true),
            (1.0, -1.0, 0.0, true),
            (3.0, 2.0, 0.0, false),
            (1.0, 1.0, 1.5, false),
            (-0.5, 1.0, 0.0, false),
        ] {
            let found = self_intersections(&pair(FLAT, upright(x, y, z)));
            assert_eq!(!found.is_empty(), cuts, "at {x} {y} {z}");
        }
    }

    #[test]
    fn neighbours_do_not_cut() {
        for surface in
            [shapes::pipe(2.0, 9.0, DVec3::new(0.3, -0.8, 0.5), 40), shapes::bent_pipe(2.0, 3.0, 2.0, 32)]
        {
            assert_eq!(self_intersections(&surface), Vec::<[u32; 2]>::new());
        }
    }

    /// A corner that is pushed through the far side of its own fan.
    #[test]
    fn triangles_with_one_common_vertex_can_cut() {
        let mut surface = pair(FLAT, [DVec3::ZERO, DVec3::new(1.0, 1.0, -1.0), DVec3::new(1.0, 1.0, 1.0)]);
        surface.triangles[1][0] = 0;
        assert_eq!(self_intersections(&surface), vec![[0, 1]]);
    }

    /// Two pipes through each other at right angles, off their axes: the lines of entry are two closed curves,
    /// or one where the smaller pipe is not smaller.
    #[test]
    fn crossing_pipes_cut_at_two_places() {
        let mut surface = shapes::pipe(2.0, 10.0, DVec3::Z, 60);
        let other = shapes::pipe(1.0, 10.0, DVec3::X, 60).map(|x| x + DVec3::new(-5.0, 0.3, 5.0));
        let first = surface.vertices.len() as u32;
        surface.vertices.extend(other.vertices);
        surface.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
        let pairs = self_intersections(&surface);
        assert!(pairs.iter().all(|[a, b]| a < b) && pairs.is_sorted());
        let places = places(&surface, &pairs);
        assert_eq!(places.len(), 2, "{places:?}");
        for place in &places {
            assert!(
                (place.center.x.abs() - 1.9).abs() < 0.15 && (place.center.z - 5.0).abs() < 0.1,
                "{place:?}"
            );
            assert!((place.radius - 1.0).abs() < 0.2 && place.pairs >= 60, "{place:?}");
        }
    }
}
