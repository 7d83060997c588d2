//! Boundary loops closed: ends of the vessel become openings, other holes become wall.

use glam::DVec3;

use crate::{
    corner::Corner,
    ears,
    opening::{Opening, loop_area_vector, project_all},
    polygon,
    repair::{edges::Edges, loops},
    surface::Surface,
};

/// Largest distance of an end loop from its plane, as part of its radius.
const MAX_WARP: f64 = 0.25;
/// An end smaller than this part of the area of the whole surface is a hole.
pub(crate) const MIN_CAP_AREA: f64 = 1e-4;

/// One closed loop.
pub(crate) struct Closed {
    /// The opening, or `None` for a hole in the wall.
    pub(crate) opening: Option<Opening>,
    /// Triangles added for it.
    pub(crate) triangles: std::ops::Range<usize>,
    /// Radius of the circle of equal area.
    pub(crate) radius: f64,
    /// Where it was.
    pub(crate) center: DVec3,
}

/// Closes every boundary loop of an oriented surface by triangles between its vertices.
///
/// A loop is an end of the vessel when it is plane, does not cross itself, and the wall meets its plane at an
/// angle. A hole in the wall has its plane along the wall around it.
pub(crate) fn close_loops(surface: &mut Surface) -> Vec<Closed> {
    let edges = Edges::new(&surface.triangles);
    let border = edges.border();
    let wall_normals = BorderNormals::new(surface, &edges);
    let min_area = MIN_CAP_AREA * surface.area();
    let mut closed = Vec::new();
    for mut corners in loops::chain(&border) {
        let mut wall = Vec::new();
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            let length = surface.vertices[a as usize].distance(surface.vertices[b as usize]);
            wall.push((length, wall_normals.of([a, b])));
        }
        // The cap has to run against the wall along their common border.
        corners.reverse();
        let points: Vec<DVec3> = corners.iter().map(|&v| surface.vertices[v as usize]).collect();
        let first = surface.triangles.len();
        let opening = Opening::from_loop(&points);
        let flat = flatten(&points);
        let new = ears::triangulate(&flat).into_iter().map(|t| t.map(|k| corners[k]));
        surface.triangles.extend(new);
        let center = points.iter().sum::<DVec3>() / points.len() as f64;
        let radius = (loop_area_vector(&points).length() / std::f64::consts::PI).sqrt();
        let is_end = |o: &Opening| {
            let warp = points.iter().map(|&p| o.depth(p).abs()).fold(0.0, f64::max);
            let corner = Corner::between(o.normal, &wall);
            o.area > min_area && warp < MAX_WARP * o.radius && corner.is_rim() && polygon::is_simple(&flat)
        };
        closed.push(Closed {
            opening: opening.filter(is_end),
            triangles: first..surface.triangles.len(),
            radius,
            center,
        });
    }
    closed
}

/// A loop seen against its area vector; as it is along some plane when it spans no area.
fn flatten(points: &[DVec3]) -> Vec<[f64; 2]> {
    let normal = loop_area_vector(points).try_normalize().unwrap_or(DVec3::Z);
    let first = normal.any_orthonormal_vector();
    project_all(points, points[0], [first, normal.cross(first)])
}

/// Normals of the triangles along the border, by directed edge.
struct BorderNormals(Vec<([u32; 2], DVec3)>);

impl BorderNormals {
    fn new(surface: &Surface, edges: &Edges) -> BorderNormals {
        let mut normals: Vec<([u32; 2], DVec3)> = edges
            .groups()
            .filter(|g| g.len() == 1)
            .map(|g| (g[0].directed(), surface.triangle_normal(g[0].triangle as usize)))
            .collect();
        normals.sort_unstable_by_key(|&(edge, _)| edge);
        BorderNormals(normals)
    }

    /// Normal of the triangle at a border edge; zero for an edge that is none.
    fn of(&self, edge: [u32; 2]) -> DVec3 {
        match self.0.binary_search_by_key(&edge, |&(e, _)| e) {
            Ok(at) => self.0[at].1,
            Err(_) => DVec3::ZERO,
        }
    }
}
