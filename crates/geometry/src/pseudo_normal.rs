//! Angle-weighted pseudo-normals: the normals whose side decides inside from outside.
//!
//! Where the nearest point is on an edge or a vertex, the normal of one adjacent face can give the wrong
//! side. The sum of face normals weighted by the angle each face takes at that point never does on a closed
//! surface (Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal",
//! IEEE Trans. Vis. Comput. Graph. 11 (2005) 243-253).

use glam::DVec3;

use crate::{
    repair::edges::Edges,
    surface::{Surface, unit_normal},
};

/// Pseudo-normals of every feature of a set of triangles.
pub(crate) struct PseudoNormals {
    /// Unit normal of each triangle.
    face: Vec<DVec3>,
    /// For each triangle the edges from corner k to the next; not normalised.
    edge: Vec<[DVec3; 3]>,
    /// For each vertex of the surface; not normalised.
    vertex: Vec<DVec3>,
}

impl PseudoNormals {
    /// Pseudo-normals that know of the given triangles only.
    pub(crate) fn new(surface: &Surface, triangles: &[[u32; 3]]) -> PseudoNormals {
        let corners = |t: &[u32; 3]| t.map(|v| surface.vertices[v as usize]);
        let face: Vec<DVec3> = triangles.iter().map(|t| unit_normal(corners(t))).collect();
        let mut vertex = vec![DVec3::ZERO; surface.vertices.len()];
        for (t, normal) in triangles.iter().zip(&face) {
            let p = corners(t);
            for k in 0..3 {
                let (u, v) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                // The arc tangent stays exact for the tiny angles of slivers, where an arc cosine fails.
                vertex[t[k] as usize] += u.cross(v).length().atan2(u.dot(v)) * normal;
            }
        }
        let mut edge = vec![[DVec3::ZERO; 3]; triangles.len()];
        for group in Edges::new(triangles).groups() {
            let sum: DVec3 = group.iter().map(|side| face[side.triangle as usize]).sum();
            for side in group {
                edge[side.triangle as usize][side.corner as usize] = sum;
            }
        }
        PseudoNormals { face, edge, vertex }
    }

    /// Normal of triangle `t`; for one without area, that of its surroundings.
    pub(crate) fn face(&self, t: usize) -> DVec3 {
        if self.face[t] == DVec3::ZERO { self.edge[t].iter().sum() } else { self.face[t] }
    }

    /// Normal at the edge of triangle `t` from corner `k` to the next.
    pub(crate) fn edge(&self, t: usize, k: usize) -> DVec3 {
        self.edge[t][k]
    }

    /// Normal at vertex `v` of the surface.
    pub(crate) fn vertex(&self, v: u32) -> DVec3 {
        self.vertex[v as usize]
    }
}
