//! Signed distance to the surface: the nearest point, and which side of it one is on.

use glam::DVec3;
use parry3d_f64::{
    bounding_volume::Aabb,
    partitioning::{Bvh, BvhBuildStrategy, BvhNode},
    query::PointQueryWithLocation,
    shape::{Triangle, TrianglePointLocation},
};

use crate::{pseudo_normal::PseudoNormals, surface::Surface, vessel::Vessel, winding::WindingTree};

/// Largest cosine between the normals on two sides of a gap.
const AGAINST: f64 = -0.3;

/// The nearest point of the surface to a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Signed distance phi \[m\], negative inside.
    pub distance: f64,
    /// Nearest point on the surface.
    pub point: DVec3,
    /// Gradient of phi: unit, towards the outside.
    pub normal: DVec3,
    /// The triangle the nearest point lies on, by its number in the surface of the vessel.
    pub triangle: u32,
}

/// Exact signed distance to a set of triangles, by a tree of bounding boxes.
///
/// Queries take `&self` and may run on any number of threads.
pub struct SignedDistance {
    pub(crate) corners: Vec<[DVec3; 3]>,
    vertices: Vec<[u32; 3]>,
    ids: Vec<u32>,
    normals: PseudoNormals,
    pub(crate) tree: Bvh,
    /// Decides the side where normals cannot: surfaces that are not closed or not orientable.
    winding: Option<WindingTree>,
    is_continuous: bool,
    /// Distance below which the direction to the nearest point is rounding error \[m\].
    on_surface: f64,
}

/// Feature of a triangle a nearest point lies on.
enum Feature {
    Face,
    Edge(usize),
    Vertex(usize),
}

impl SignedDistance {
    /// Distance to the whole closed surface, wall and caps: negative in the fluid.
    pub fn closed(vessel: &Vessel) -> SignedDistance {
        let trusted = vessel.audit.watertight && vessel.audit.orientable;
        SignedDistance { is_continuous: trusted, ..SignedDistance::new(&vessel.surface, |_| true, !trusted) }
    }

    /// Distance to the wall only, caps left out: negative in the lumen.
    ///
    /// Beyond a cap the side is that of the wall continued along its tangent, so a point straight in
    /// front of an opening counts as inside. Triangle numbers are those of `vessel.surface`. Should
    /// every triangle belong to a cap, all distances are infinite.
    pub fn wall(vessel: &Vessel) -> SignedDistance {
        SignedDistance::new(&vessel.surface, |t| vessel.face_opening[t].is_none(), !vessel.audit.orientable)
    }

    /// Distance to a surface that is closed and points outwards, as one made by a program is.
    pub fn of(surface: &Surface) -> SignedDistance {
        SignedDistance { is_continuous: true, ..SignedDistance::new(surface, |_| true, false) }
    }

    /// Distance to an oriented surface with a border, as the wall of a vessel without its caps is: on the side its normals point away
    /// from it is negative. Beyond the border the side is that of the surface continued along its tangent.
    pub fn sheet(surface: &Surface) -> SignedDistance {
        SignedDistance::new(surface, |_| true, false)
    }

    /// Distance to the triangles `keep` says yes to.
    pub(crate) fn new(surface: &Surface, keep: impl Fn(usize) -> bool, by_winding: bool) -> SignedDistance {
        let ids: Vec<u32> = (0..surface.triangles.len()).filter(|&t| keep(t)).map(|t| t as u32).collect();
        let vertices: Vec<[u32; 3]> = ids.iter().map(|&t| surface.triangles[t as usize]).collect();
        let corners: Vec<[DVec3; 3]> = ids.iter().map(|&t| surface.triangle(t as usize)).collect();
        let boxes: Vec<Aabb> =
            corners.iter().map(|[a, b, c]| Aabb::new(a.min(*b).min(*c), a.max(*b).max(*c))).collect();
        SignedDistance {
            normals: PseudoNormals::new(surface, &vertices),
            tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
            is_continuous: false,
            winding: by_winding.then(|| WindingTree::new(&corners)),
            on_surface: 1e-9 * surface.diagonal(),
            corners,
            vertices,
            ids,
        }
    }

    /// Signed distance, nearest point and gradient at `x`.
    ///
    /// Where several points are equally near, one of them is taken, always the same. At a place that is
    /// not finite the distance is infinite and the normal zero.
    pub fn query(&self, x: DVec3) -> Nearest {
        self.query_within(x, f64::INFINITY)
    }

    /// As [`query`](Self::query), given that some triangle is known to be nearer than `bound`.
    fn query_within(&self, x: DVec3, bound: f64) -> Nearest {
        let best = self.tree.find_best(
            bound * bound,
            |node: &BvhNode, _| (x - x.clamp(node.mins(), node.maxs())).length_squared(),
            |leaf, _| Some(x.distance_squared(self.project(leaf, x).0)),
        );
        let Some((leaf, _)) = best else {
            let nowhere =
                Nearest { distance: f64::INFINITY, point: x, normal: DVec3::ZERO, triangle: u32::MAX };
            return if bound.is_finite() { self.query(x) } else { nowhere };
        };
        let (point, feature) = self.project(leaf, x);
        self.signed(x, leaf, point, &feature)
    }

    /// As [`query`](Self::query), faster when triangle `guess` (of an earlier answer nearby) is near.
    ///
    /// Any number may be guessed, also one of no triangle.
    pub fn query_from(&self, x: DVec3, guess: u32) -> Nearest {
        match self.ids.binary_search(&guess) {
            // A little more than the distance of the guess, so that the guess itself can be found.
            Ok(leaf) => {
                let reach = x.distance(self.project(leaf as u32, x).0) * (1.0 + 1e-9) + self.on_surface;
                self.query_within(x, reach)
            }
            Err(_) => self.query(x),
        }
    }

    /// Distance \[m\] to the nearest triangle within `reach` \[m\] whose outer side looks at `x` against
    /// `normal`, the unit normal of the surface nearest to `x`: the far side of a gap.
    ///
    /// Against means at a cosine below -0.3.
    pub fn facing(&self, x: DVec3, normal: DVec3, reach: f64) -> Option<f64> {
        let looks_at = |leaf: u32| {
            let face = self.normals.face(leaf as usize);
            face.dot(normal) < AGAINST * face.length() && (x - self.corners[leaf as usize][0]).dot(face) > 0.0
        };
        let (_, squared) = self.tree.find_best(
            reach * reach,
            |node: &BvhNode, _| (x - x.clamp(node.mins(), node.maxs())).length_squared(),
            |leaf, _| looks_at(leaf).then(|| x.distance_squared(self.project(leaf, x).0)),
        )?;
        Some(squared.sqrt())
    }

    /// Whether the signed distance changes by no more than the way gone: that of a closed surface does, while
    /// that of a wall alone changes its sign in front of an opening.
    pub(crate) fn is_continuous(&self) -> bool {
        self.is_continuous
    }

    /// Nearest point of one triangle and the feature it lies on.
    fn project(&self, leaf: u32, x: DVec3) -> (DVec3, Feature) {
        let [a, b, c] = self.corners[leaf as usize];
        let (projection, location) = Triangle::new(a, b, c).project_local_point_and_get_location(x, false);
        let feature = match location {
            TrianglePointLocation::OnVertex(k) => Feature::Vertex(k as usize),
            TrianglePointLocation::OnEdge(k, _) => Feature::Edge(k as usize),
            TrianglePointLocation::OnFace(..) | TrianglePointLocation::OnSolid => Feature::Face,
        };
        (projection.point, feature)
    }

    fn signed(&self, x: DVec3, leaf: u32, point: DVec3, feature: &Feature) -> Nearest {
        let t = leaf as usize;
        let pseudo_normal = match *feature {
            Feature::Face => self.normals.face(t),
            Feature::Edge(k) => self.normals.edge(t, k),
            Feature::Vertex(k) => self.normals.vertex(self.vertices[t][k]),
        };
        let away = x - point;
        let outside = match &self.winding {
            None => away.dot(pseudo_normal) >= 0.0,
            Some(tree) => !tree.contains(x),
        };
        let distance = away.length();
        let sign = if outside { 1.0 } else { -1.0 };
        let normal = if distance > self.on_surface {
            sign / distance * away
        } else {
            pseudo_normal.normalize_or_zero()
        };
        Nearest { distance: sign * distance, point, normal, triangle: self.ids[t] }
    }
}
