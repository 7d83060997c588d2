//! An opening of the vessel: the plane cap through which blood enters or leaves.

use glam::DVec3;

use crate::polygon;

/// A plane cap of the lumen, with the frame in which inflow and outflow are described.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// Centre of area \[m\].
    pub center: DVec3,
    /// Unit normal, out of the domain.
    pub normal: DVec3,
    /// Area A \[m^2\].
    pub area: f64,
    /// Radius of the circle of equal area, sqrt(A/pi) \[m\].
    pub radius: f64,
    /// Border in the plane of the cap \[m\], about the centre along [`axes`](Self::axes), counter-clockwise
    /// seen against the normal.
    pub polygon: Vec<[f64; 2]>,
    /// Unit axes in the plane: the longer principal axis of the area, and `normal` x that.
    pub axes: [DVec3; 2],
    /// Unit vector along the vessel behind the cap, out of the domain: what its wall runs along. The normal, where the vessel is cut squarely.
    pub axis: DVec3,
}

impl Opening {
    /// The opening bounded by a closed loop of points, counter-clockwise about the outward normal.
    ///
    /// `None` when the loop spans no area.
    pub(crate) fn from_loop(points: &[DVec3]) -> Option<Opening> {
        let normal = loop_area_vector(points).try_normalize()?;
        let first = normal.any_orthonormal_vector();
        let second = normal.cross(first);
        let flat = project_all(points, points[0], [first, second]);
        let area = polygon::area(&flat);
        let [u, v] = polygon::centroid(&flat);
        // The plane passes through the mean height of the border, weighted by its length.
        let (mut length, mut height) = (0.0, 0.0);
        for (a, b) in edges(points) {
            let l = a.distance(b);
            length += l;
            height += 0.5 * l * ((a - points[0]) + (b - points[0])).dot(normal);
        }
        let center = points[0] + u * first + v * second + height / length * normal;
        let angle = polygon::principal_angle(&project_all(points, center, [first, second]));
        let long = angle.cos() * first + angle.sin() * second;
        let axes = [long, normal.cross(long)];
        Some(Opening {
            center,
            normal,
            area,
            radius: (area / std::f64::consts::PI).sqrt(),
            polygon: project_all(points, center, axes),
            axes,
            axis: normal,
        })
    }

    /// Distance from the cap plane into the vessel, s = -(x - center).normal \[m\]; negative outside.
    pub fn depth(&self, x: DVec3) -> f64 {
        -(x - self.center).dot(self.normal)
    }

    /// In-plane coordinates of `x` about the centre along the two axes \[m\].
    pub fn project(&self, x: DVec3) -> [f64; 2] {
        let from_center = x - self.center;
        [from_center.dot(self.axes[0]), from_center.dot(self.axes[1])]
    }

    /// In-plane distance from `x` to the border of the cap \[m\]; negative over the cap.
    pub fn lateral(&self, x: DVec3) -> f64 {
        polygon::signed_distance(&self.polygon, self.project(x))
    }

    /// Way along the vessel that leads a unit length out of the cap plane.
    pub fn stride(&self) -> DVec3 {
        self.axis / self.axis.dot(self.normal)
    }

    /// Point of the cap plane that `x` comes to along the vessel; from outside straight along the normal.
    pub fn foot(&self, x: DVec3) -> DVec3 {
        let depth = self.depth(x);
        x + depth * if depth > 0.0 { self.stride() } else { self.normal }
    }

    /// [`Self::lateral`] of the [`Self::foot`] of `x`: how far it is beside the vessel behind the cap \[m\].
    pub fn beside(&self, x: DVec3) -> f64 {
        self.lateral(self.foot(x))
    }

    /// Distance from `x` to the cap itself \[m\], never negative.
    pub fn distance(&self, x: DVec3) -> f64 {
        self.depth(x).hypot(self.lateral(x).max(0.0))
    }
}

fn edges(points: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
    let n = points.len();
    (0..n).map(move |i| (points[i], points[(i + 1) % n]))
}

/// Area times normal spanned by a closed loop; the same for every surface that fills the loop.
pub(crate) fn loop_area_vector(points: &[DVec3]) -> DVec3 {
    let Some(&origin) = points.first() else { return DVec3::ZERO };
    edges(points).map(|(a, b)| 0.5 * (a - origin).cross(b - origin)).sum()
}

/// Coordinates of points about `origin` along two axes.
pub(crate) fn project_all(points: &[DVec3], origin: DVec3, axes: [DVec3; 2]) -> Vec<[f64; 2]> {
    points.iter().map(|&p| axes.map(|axis| (p - origin).dot(axis))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ellipse with half axes 3 and 2, centre (1, 2, 3), normal +x, long axis along z.
    fn ellipse() -> Opening {
        let points: Vec<DVec3> = (0..720)
            .map(|i| {
                let angle = f64::from(i).to_radians() / 2.0;
                DVec3::new(1.0, 2.0 + 2.0 * angle.cos(), 3.0 + 3.0 * angle.sin())
            })
            .collect();
        Opening::from_loop(&points).expect("an ellipse spans an area")
    }

    #[test]
    fn frame_of_an_ellipse() {
        let o = ellipse();
        assert!((o.center - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-12);
        assert!((o.normal - DVec3::X).length() < 1e-12);
        assert!((o.radius - 6f64.sqrt()).abs() < 1e-4);
        assert!(o.axes[0].dot(DVec3::Z).abs() > 1.0 - 1e-12);
        assert!((o.axes[0].cross(o.axes[1]) - o.normal).length() < 1e-12);
    }

    #[test]
    fn depth_lateral_and_distance() {
        let o = ellipse();
        let inside = DVec3::new(-4.0, 2.0, 3.0);
        assert!((o.depth(inside) - 5.0).abs() < 1e-12);
        assert!((o.lateral(inside) + 2.0).abs() < 1e-4);
        assert!((o.distance(inside) - 5.0).abs() < 1e-12);
        let beside = DVec3::new(4.0, 2.0, 3.0 + 3.0 + 4.0);
        assert!((o.lateral(beside) - 4.0).abs() < 1e-4);
        assert!((o.distance(beside) - 5.0).abs() < 1e-3);
    }

    #[test]
    fn a_line_is_no_opening() {
        assert_eq!(Opening::from_loop(&[DVec3::ZERO, DVec3::X, 2.0 * DVec3::X]), None);
        assert_eq!(Opening::from_loop(&[]), None);
    }
}
