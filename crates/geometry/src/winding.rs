//! Generalised winding number: an inside test that forgives holes and overlaps.
//!
//! The number is the solid angle all triangles take at a point over 4 pi: 1 inside a closed outward
//! surface, 0 outside, in between near holes (Jacobson, Kavan and Sorkine-Hornung, ACM Trans. Graph. 32
//! (2013) 33). Clusters of triangles far away act as a dipole and its first moment (Barill, Dickson, Schmidt, Levin and
//! Jacobson, "Fast winding numbers for soups and clouds", ACM Trans. Graph. 37 (2018) 43).

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

/// Triangles in a leaf of the tree.
const LEAF: usize = 8;
/// A cluster is far when its distance is this many times its radius. Two terms of the expansion then err by
/// less than 0.01 in the number, small against the 0.5 that decides.
const FAR: f64 = 3.0;

/// Solid angles of many triangles, in a binary tree.
pub(crate) struct WindingTree {
    triangles: Vec<[DVec3; 3]>,
    nodes: Vec<Node>,
}

struct Node {
    /// Area-weighted centre.
    center: DVec3,
    /// Radius about the centre that holds all corners.
    radius: f64,
    /// Sum of the area vectors.
    dipole: DVec3,
    /// Sum of the outer products of (centroid - centre) and area vector.
    moment: DMat3,
    /// Triangles of this node, as a range.
    start: usize,
    end: usize,
    /// Right child; the left one follows directly. Zero for a leaf.
    right: usize,
}

impl WindingTree {
    pub(crate) fn new(triangles: &[[DVec3; 3]]) -> WindingTree {
        let mut tree = WindingTree { triangles: triangles.to_vec(), nodes: Vec::new() };
        if !triangles.is_empty() {
            tree.build(0, triangles.len());
        }
        tree
    }

    /// Adds the node of a range of triangles and all below it; returns its number.
    fn build(&mut self, start: usize, end: usize) -> usize {
        let part = &mut self.triangles[start..end];
        let (mut dipole, mut weight, mut moment) = (DVec3::ZERO, 0.0, DVec3::ZERO);
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for t in part.iter() {
            let area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
            dipole += area;
            weight += area.length();
            moment += area.length() * centroid(t);
            low = low.min(centroid(t));
            high = high.max(centroid(t));
        }
        let center = if weight > 0.0 { moment / weight } else { centroid(&part[0]) };
        let outer = |d: DVec3, a: DVec3| DMat3::from_cols(a.x * d, a.y * d, a.z * d);
        let dipole_moment = part.iter().fold(DMat3::ZERO, |sum, t| {
            sum + outer(centroid(t) - center, 0.5 * (t[1] - t[0]).cross(t[2] - t[0]))
        });
        let radius = part.iter().flatten().map(|p| p.distance(center)).fold(0.0, f64::max);
        let number = self.nodes.len();
        self.nodes.push(Node { center, radius, dipole, moment: dipole_moment, start, end, right: 0 });
        if end - start > LEAF {
            let axis = (high - low).max_position();
            let middle = (end - start) / 2;
            part.select_nth_unstable_by(middle, |a, b| centroid(a)[axis].total_cmp(&centroid(b)[axis]));
            self.build(start, start + middle);
            self.nodes[number].right = self.build(start + middle, end);
        }
        number
    }

    /// Winding number at `x`.
    pub(crate) fn number(&self, x: DVec3) -> f64 {
        let mut solid_angle = 0.0;
        let mut stack = if self.nodes.is_empty() { vec![] } else { vec![0] };
        while let Some(number) = stack.pop() {
            let node = &self.nodes[number];
            let towards = node.center - x;
            let distance = towards.length();
            if distance > FAR * node.radius && distance > 0.0 {
                // Taylor series of r/r^3 about the centre: r/r^3, then (I - 3 r r^T/r^2)/r^3.
                let m = node.moment;
                let trace = m.x_axis.x + m.y_axis.y + m.z_axis.z;
                let unit = towards / distance;
                let second = (trace - 3.0 * unit.dot(m * unit)) / distance.powi(3);
                solid_angle += node.dipole.dot(unit) / (distance * distance) + second;
            } else if node.right == 0 {
                solid_angle +=
                    self.triangles[node.start..node.end].iter().map(|t| angle_of(t, x)).sum::<f64>();
            } else {
                stack.extend([node.right, number + 1]);
            }
        }
        solid_angle / (4.0 * PI)
    }

    /// Whether `x` is inside. The sense of the surface does not matter.
    pub(crate) fn contains(&self, x: DVec3) -> bool {
        self.number(x).abs() > 0.5
    }
}

fn centroid([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (a + b + c) / 3.0
}

/// Signed solid angle of a triangle seen from `x` (van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30
/// (1983) 125-126): positive when seen from behind its normal.
fn angle_of(triangle: &[DVec3; 3], x: DVec3) -> f64 {
    let [a, b, c] = triangle.map(|p| p - x);
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let numerator = a.dot(b.cross(c));
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * numerator.atan2(denominator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn one_inside_zero_outside_and_the_tree_agrees_with_the_sum() {
        let s = shapes::pipe(1.0, 6.0, DVec3::Z, 48);
        let triangles: Vec<_> = (0..s.triangles.len()).map(|t| s.triangle(t)).collect();
        let tree = WindingTree::new(&triangles);
        let mut worst: f64 = 0.0;
        for i in 0..2000 {
            let part = |k: f64| (f64::from(i) * k).fract();
            let x = DVec3::new(4.0 * part(0.618) - 2.0, 4.0 * part(0.414) - 2.0, 10.0 * part(0.732) - 2.0);
            let exact = triangles.iter().map(|t| angle_of(t, x)).sum::<f64>() / (4.0 * PI);
            worst = worst.max((tree.number(x) - exact).abs());
            let inside = x.truncate().length() < 0.99 && x.z > 0.0 && x.z < 6.0;
            let outside = x.truncate().length() > 1.0 || x.z < 0.0 || x.z > 6.0;
            assert!(!inside || (exact - 1.0).abs() < 1e-9);
            assert!(!outside || exact.abs() < 1e-9);
        }
        assert!(worst < 0.01, "worst error of the tree {worst}");
    }
}
