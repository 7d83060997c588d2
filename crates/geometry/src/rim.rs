//! Where the wall of a vessel ends: the edges it shares with its caps.

use glam::DVec3;
use parry3d_f64::{
    bounding_volume::Aabb,
    partitioning::{Bvh, BvhBuildStrategy, BvhNode},
};

use crate::{
    repair::edges::{Edges, Side},
    vessel::Vessel,
};

/// Least cosine between the normal at a place on the wall and that of the wall at an edge of the rim for the
/// two to belong to one sheet.
const SAME_SHEET: f64 = 0.3;

/// One edge between a wall triangle and a cap triangle.
struct RimEdge {
    ends: [DVec3; 2],
    /// Unit vector in the wall triangle, across the edge and off the wall.
    off: DVec3,
    /// Normal of the wall triangle.
    wall_normal: DVec3,
    opening: u32,
}

/// The nearest point of a rim to a place on the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestRim {
    /// Distance \[m\], never negative.
    pub distance: f64,
    /// Nearest point on the rim \[m\].
    pub point: DVec3,
    /// Unit vector in the wall, across the rim and off the wall.
    pub off: DVec3,
    /// The opening the rim belongs to.
    pub opening: u32,
}

/// The rims of all openings of a vessel.
pub struct Rim {
    edges: Vec<RimEdge>,
    tree: Bvh,
}

impl Rim {
    /// The edges of `vessel` at which a wall triangle meets a cap triangle.
    pub fn new(vessel: &Vessel) -> Self {
        let mut edges = Vec::new();
        for group in Edges::new(&vessel.surface.triangles).groups() {
            let [a, b] = group else { continue };
            let opening = |side: &Side| vessel.face_opening[side.triangle as usize];
            let (wall, opening) = match (opening(a), opening(b)) {
                (None, Some(opening)) => (a, opening),
                (Some(opening), None) => (b, opening),
                _ => continue,
            };
            let ends = wall.directed().map(|v| vessel.surface.vertices[v as usize]);
            let wall_normal = vessel.surface.triangle_normal(wall.triangle as usize);
            // Counter-clockwise about its normal, a triangle lies to the left of its sides.
            let off = (ends[1] - ends[0]).cross(wall_normal).normalize_or_zero();
            edges.push(RimEdge { ends, off, wall_normal, opening });
        }
        let boxes: Vec<Aabb> =
            edges.iter().map(|e| Aabb::new(e.ends[0].min(e.ends[1]), e.ends[0].max(e.ends[1]))).collect();
        Self { tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes), edges }
    }

    /// Whether the vessel has no rim: no openings.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// The nearest point of a rim within `reach` \[m\] of a place `x` \[m\] on the wall, where the wall has
    /// the unit normal `normal`.
    ///
    /// Rims of walls that look another way are passed over: across a thin gap they are near, but not on the
    /// same sheet.
    pub fn query(&self, x: DVec3, normal: DVec3, reach: f64) -> Option<NearestRim> {
        let cost = |leaf: u32| {
            let edge = &self.edges[leaf as usize];
            (edge.wall_normal.dot(normal) > SAME_SHEET).then(|| x.distance_squared(edge.nearest(x)))
        };
        let (leaf, _) = self.tree.find_best(
            reach * reach,
            |node: &BvhNode, _| (x - x.clamp(node.mins(), node.maxs())).length_squared(),
            |leaf, _| cost(leaf),
        )?;
        let edge = &self.edges[leaf as usize];
        let point = edge.nearest(x);
        Some(NearestRim { distance: x.distance(point), point, off: edge.off, opening: edge.opening })
    }
}

impl RimEdge {
    fn nearest(&self, x: DVec3) -> DVec3 {
        let [a, b] = self.ends;
        let along = b - a;
        let place = (x - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        a + place.clamp(0.0, 1.0) * along
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{prepare, shapes, unit::LengthUnit};

    #[test]
    fn rims_of_a_pipe() {
        let vessel = prepare(shapes::pipe(2.0, 8.0, DVec3::Z, 96), Some(LengthUnit::Metre)).expect("a pipe");
        let rim = Rim::new(&vessel);
        assert_eq!(rim.edges.len(), 2 * 96);
        let x = DVec3::new(2.0, 0.0, 7.3);
        let nearest = rim.query(x, DVec3::X, 1.0).expect("the rim is 0.7 m away");
        assert!((nearest.distance - 0.7).abs() < 2e-3, "{nearest:?}");
        assert!((nearest.off - DVec3::Z).length() < 1e-9, "{nearest:?}");
        assert!(vessel.openings[nearest.opening as usize].normal.z > 0.99);
        assert_eq!(rim.query(x, DVec3::X, 0.5), None);
        assert_eq!(rim.query(x, -DVec3::X, 1.0), None, "the wall there looks the other way");
    }
}
