//! Normals that turn evenly across a faceted surface.

use glam::DVec3;

use crate::{pseudo_normal::PseudoNormals, surface::Surface};

/// Unit normals interpolated between angle-weighted vertex normals (Phong, Commun. ACM 18, 1975).
///
/// The normal of a facet jumps at its edges; this one is continuous over the whole sheet, and exact at the
/// vertices of a surface whose facets lie symmetrically about them.
pub struct SmoothNormals<'a> {
    surface: &'a Surface,
    vertex: Vec<DVec3>,
}

impl<'a> SmoothNormals<'a> {
    /// Normals of the triangles `keep` says yes to; the others have no say at shared vertices.
    pub fn new(surface: &'a Surface, keep: impl Fn(usize) -> bool) -> Self {
        let kept: Vec<[u32; 3]> =
            (0..surface.triangles.len()).filter(|&t| keep(t)).map(|t| surface.triangles[t]).collect();
        let normals = PseudoNormals::new(surface, &kept);
        let vertex =
            (0..surface.vertices.len()).map(|v| normals.vertex(v as u32).normalize_or_zero()).collect();
        Self { surface, vertex }
    }

    /// Unit normal at `point` \[m\] of triangle `t`.
    ///
    /// # Panics
    /// When `t` is out of range.
    pub fn at(&self, t: usize, point: DVec3) -> DVec3 {
        let [a, b, c] = self.surface.triangle(t);
        let area = (b - a).cross(c - a);
        // Shares of the corners: areas of the triangles opposite to them, all of one sign within.
        let shares = [(b, c), (c, a), (a, b)].map(|(p, q)| (p - point).cross(q - point).dot(area).max(0.0));
        let corners = self.surface.triangles[t].map(|v| self.vertex[v as usize]);
        let sum: DVec3 = shares.iter().zip(corners).map(|(share, normal)| *share * normal).sum();
        // A sliver whose corners cancel, or one without area: any of its corners will do.
        sum.try_normalize().unwrap_or_else(|| corners.into_iter().sum::<DVec3>().normalize_or(DVec3::Z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    /// Within a facet of a polygonal pipe the facet normal is off by up to half the angle between facets,
    /// 3.75 degrees; the interpolated one by the sagitta of linear interpolation, its eighth part squared.
    #[test]
    fn normals_of_a_pipe_are_radial() {
        let segments = 48;
        let pipe = shapes::pipe(2.0, 8.0, DVec3::Z, segments);
        let is_wall = |t: usize| pipe.triangle_normal(t).z.abs() < 0.5;
        let normals = SmoothNormals::new(&pipe, is_wall);
        for t in (0..pipe.triangles.len()).filter(|&t| is_wall(t)) {
            let [a, b, c] = pipe.triangle(t);
            for [u, v] in [[0.2, 0.3], [0.6, 0.1], [0.0, 0.5], [1.0, 0.0]] {
                let x = a + u * (b - a) + v * (c - a);
                let radial = DVec3::new(x.x, x.y, 0.0).normalize();
                assert!((normals.at(t, x) - radial).length() < 1e-4, "at {x}");
            }
        }
    }

    #[test]
    fn a_triangle_without_area_still_has_a_normal() {
        let surface =
            Surface { vertices: vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], triangles: vec![[0, 1, 2]] };
        let normal = SmoothNormals::new(&surface, |_| true).at(0, DVec3::X);
        assert!((normal.length() - 1.0).abs() < 1e-12);
    }
}
