//! The triangle surface: vertices, triangles and the integrals over them.

use glam::DVec3;

/// A triangle surface: shared vertices and counter-clockwise triangles.
///
/// As read from a file the coordinates are in the unit of that file; after [`prepare`](crate::prepare)
/// they are in metres. The formulas below are the same for both: lengths come out in the unit of the
/// coordinates.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surface {
    /// Positions of the vertices.
    pub vertices: Vec<DVec3>,
    /// Vertex numbers of each triangle, counter-clockwise seen from the side its normal points to.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// The three corners of triangle `t`.
    ///
    /// # Panics
    /// When `t`, or a vertex number of that triangle, is out of range.
    pub fn triangle(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.vertices[v as usize])
    }

    /// Area times unit normal of triangle `t`.
    pub fn area_vector(&self, t: usize) -> DVec3 {
        let [a, b, c] = self.triangle(t);
        0.5 * (b - a).cross(c - a)
    }

    /// Unit normal of triangle `t`; the zero vector when its area is zero.
    pub fn triangle_normal(&self, t: usize) -> DVec3 {
        unit_normal(self.triangle(t))
    }

    /// Area of triangle `t`.
    pub fn triangle_area(&self, t: usize) -> f64 {
        self.area_vector(t).length()
    }

    /// Sum of all triangle areas.
    pub fn area(&self) -> f64 {
        (0..self.triangles.len()).map(|t| self.triangle_area(t)).sum()
    }

    /// Signed enclosed volume: positive when the normals point outwards.
    ///
    /// It is the sum of signed tetrahedra, so it means a volume only where the surface is closed.
    pub fn volume(&self) -> f64 {
        // An apex amid the surface keeps the tetrahedra small: no cancellation far from the origin.
        let (low, high) = self.bounds();
        let apex = 0.5 * (low + high);
        (0..self.triangles.len()).map(|t| tetrahedron(apex, self.triangle(t))).sum()
    }

    /// Corners of the axis-aligned bounding box of the vertices; both zero when there are none.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let mut vertices = self.vertices.iter();
        let Some(&first) = vertices.next() else { return (DVec3::ZERO, DVec3::ZERO) };
        vertices.fold((first, first), |(low, high), v| (low.min(*v), high.max(*v)))
    }

    /// Length of the diagonal of the bounding box.
    pub fn diagonal(&self) -> f64 {
        let (low, high) = self.bounds();
        low.distance(high)
    }

    /// The surface with every position mapped by `f`; triangles as they are.
    ///
    /// A map that mirrors turns the surface inside out.
    pub fn map(&self, f: impl Fn(DVec3) -> DVec3) -> Surface {
        Surface { vertices: self.vertices.iter().map(|&v| f(v)).collect(), triangles: self.triangles.clone() }
    }

    /// Drops the vertices no triangle uses, keeping the order of the others.
    pub(crate) fn drop_unused_vertices(&mut self) {
        let mut new_number = vec![u32::MAX; self.vertices.len()];
        for &v in self.triangles.iter().flatten() {
            new_number[v as usize] = 0;
        }
        let mut kept = Vec::with_capacity(self.vertices.len());
        for (number, &vertex) in new_number.iter_mut().zip(&self.vertices) {
            if *number == 0 {
                *number = kept.len() as u32;
                kept.push(vertex);
            }
        }
        for v in self.triangles.iter_mut().flatten() {
            *v = new_number[*v as usize];
        }
        self.vertices = kept;
    }
}

/// Unit normal of a triangle given by its corners; zero for one without area.
pub(crate) fn unit_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    // Products of two edges underflow only below 1e-160, so no scaling is needed for metres.
    (b - a).cross(c - a).normalize_or_zero()
}

/// Signed volume of the tetrahedron from `apex` to a triangle.
pub(crate) fn tetrahedron(apex: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    (a - apex).dot((b - apex).cross(c - apex)) / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Unit right-angled tetrahedron: volume 1/6, area 3/2 + sqrt(3)/2.
    fn tetrahedron_surface() -> Surface {
        Surface {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        }
    }

    #[test]
    fn integrals_of_a_tetrahedron() {
        let s = tetrahedron_surface();
        assert!((s.volume() - 1.0 / 6.0).abs() < 1e-15);
        assert!((s.area() - (1.5 + 3f64.sqrt() / 2.0)).abs() < 1e-15);
        assert_eq!(s.bounds(), (DVec3::ZERO, DVec3::ONE));
        assert!((s.triangle_normal(3) - DVec3::ONE / 3f64.sqrt()).length() < 1e-15);
    }

    #[test]
    fn volume_far_from_the_origin_keeps_its_digits() {
        let far = tetrahedron_surface().map(|v| v * 1e-3 + DVec3::splat(1.0));
        assert!((far.volume() * 1e9 - 1.0 / 6.0).abs() < 1e-9);
    }

    #[test]
    fn unused_vertices_go() {
        let mut s = tetrahedron_surface();
        s.triangles.remove(0);
        s.triangles.remove(0);
        s.triangles.remove(0);
        s.drop_unused_vertices();
        assert_eq!(s.vertices, vec![DVec3::X, DVec3::Y, DVec3::Z]);
        assert_eq!(s.triangles, vec![[0, 1, 2]]);
    }
}
