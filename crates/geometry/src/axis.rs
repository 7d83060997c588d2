//! Along which way a vessel runs behind its caps.

use std::collections::VecDeque;

use glam::DVec3;
use nalgebra::{Matrix3, SymmetricEigen};

use crate::vessel::Vessel;

/// Length of the piece behind a cap that is looked at, in radii of the cap.
const LENGTH: f64 = 1.0;
/// Largest share of the wall's normals along the vessel, squared: a cone of twice 35 degrees has that much.
const TUBULAR: f64 = 0.33;
/// Angle between vessel and normal that is none \[degrees\]: that of a triangulation.
const SQUARE: f64 = 0.5;
/// Largest angle that is taken for the way of the vessel \[degrees\].
const OBLIQUE: f64 = 40.0;

impl Vessel {
    /// Finds the axis of each opening: the direction that the normals of the wall behind it are most nearly square to, over a radius of depth.
    pub(crate) fn find_axes(&mut self) {
        let at_vertex = self.triangles_at_vertices();
        for k in 0..self.openings.len() {
            if let Some(axis) = self.axis_behind(k, &at_vertex) {
                self.openings[k].axis = axis;
            }
        }
    }

    fn triangles_at_vertices(&self) -> Vec<Vec<u32>> {
        let mut at_vertex = vec![Vec::new(); self.surface.vertices.len()];
        for (t, corners) in self.surface.triangles.iter().enumerate() {
            corners.iter().for_each(|&v| at_vertex[v as usize].push(t as u32));
        }
        at_vertex
    }

    /// `None` where the vessel is cut squarely, or no tube begins.
    fn axis_behind(&self, k: usize, at_vertex: &[Vec<u32>]) -> Option<DVec3> {
        let opening = &self.openings[k];
        let length = LENGTH * opening.radius;
        let mut seen = vec![false; self.surface.triangles.len()];
        let cap = (0..seen.len()).filter(|&t| self.face_opening[t] == Some(k as u32));
        let mut front: VecDeque<usize> = cap.collect();
        front.iter().for_each(|&t| seen[t] = true);
        let mut moment = Matrix3::zeros();
        while let Some(t) = front.pop_front() {
            for &v in &self.surface.triangles[t] {
                for &next in &at_vertex[v as usize] {
                    let next = next as usize;
                    let place = self.surface.triangle(next).iter().sum::<DVec3>() / 3.0;
                    if seen[next] || self.face_opening[next].is_some() || opening.depth(place) > length {
                        continue;
                    }
                    seen[next] = true;
                    front.push_back(next);
                    let n = nalgebra::Vector3::from(self.surface.triangle_normal(next).to_array());
                    moment += self.surface.triangle_area(next) * n * n.transpose();
                }
            }
        }
        let eigen = SymmetricEigen::new(moment);
        let least = (0..3).min_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]))?;
        let [x, y, z]: [f64; 3] = eigen.eigenvectors.column(least).into_owned().into();
        let axis = DVec3::new(x, y, z).try_normalize()?;
        let axis = axis * axis.dot(opening.normal).signum();
        let angle = axis.dot(opening.normal).clamp(-1.0, 1.0).acos().to_degrees();
        let is_tube = eigen.eigenvalues[least] < TUBULAR * eigen.eigenvalues.sum();
        (is_tube && (SQUARE..OBLIQUE).contains(&angle)).then_some(axis)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LengthUnit, prepare, shapes};

    /// A pipe along z whose outlet is cut by `degrees`, and narrows by `taper` of its radius over its length.
    fn vessel(degrees: f64, taper: f64) -> Vessel {
        let length = 16e-3;
        let surface = shapes::pipe(2e-3, length, DVec3::Z, 64).map(|v| {
            let narrow = 1.0 - taper * v.z / length;
            let x = narrow * v.x;
            DVec3::new(x, narrow * v.y, v.z + degrees.to_radians().tan() * x * v.z / length)
        });
        prepare(surface, Some(LengthUnit::Metre)).expect("sound")
    }

    #[test]
    fn the_axis_is_that_of_the_pipe_however_it_is_cut() {
        for degrees in [0.0, 5.0, 15.0, 30.0] {
            let vessel = vessel(degrees, 0.0);
            let outlet = vessel.openings.iter().find(|o| o.center.z > 10e-3).expect("an outlet");
            let angle = outlet.normal.dot(DVec3::Z).min(1.0).acos().to_degrees();
            assert!((angle - degrees).abs() < 0.1, "cut by {angle} degrees");
            assert!(outlet.axis.distance(DVec3::Z) < 0.01, "{} at {degrees} degrees", outlet.axis);
            let foot = outlet.foot(outlet.center - 1e-3 * DVec3::Z);
            assert!(foot.distance(outlet.center) < 2e-5, "{foot} {}", outlet.center);
        }
    }

    #[test]
    fn a_cone_has_the_axis_of_its_normal() {
        let vessel = vessel(0.0, 0.6);
        assert!(vessel.openings.iter().all(|o| o.axis == o.normal), "{:?}", vessel.openings);
    }

    #[test]
    fn a_bend_that_begins_at_the_cap_has_nearly_its_normal() {
        let vessel =
            prepare(shapes::bent_pipe(2e-3, 10e-3, 1.5, 64), Some(LengthUnit::Metre)).expect("sound");
        for opening in &vessel.openings {
            let angle = opening.axis.dot(opening.normal).min(1.0).acos().to_degrees();
            // Half of what it turns within a radius.
            assert!(angle < 7.0, "{angle}");
        }
    }
}
