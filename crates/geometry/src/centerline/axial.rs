//! The axial direction of a wall by the centrelines near it, which fibres are laid along.

use super::Centerlines;
use glam::DVec3;
use rayon::prelude::*;

/// Stretches that the shortest branch is cut into at least, and points on a length of its distance from the wall.
const PIECES: usize = 8;

impl Centerlines {
    /// Unit axial direction \[-\] in the plane across `normal`, a unit vector, at each of `points` \[m\]; its sign has no meaning, as that of a
    /// fibre has none.
    ///
    /// It is the line in that plane that the tangents of the centrelines lie nearest to, each point of them weighted by the inverse fourth power
    /// of its distance: on a tube that of its own section, between two branches half way from one to the other. At a carina the tangents of both
    /// daughters leave the same line in the plane of the wall, so that nothing jumps there. Where they leave none, as on the top of a dome, any
    /// direction across the normal is given.
    ///
    /// `spacing` \[m\] is the distance between points of the centrelines; a tenth of the smallest radius is enough.
    ///
    /// # Panics
    /// If the lists differ in length.
    pub fn axial_directions(&self, points: &[DVec3], normals: &[DVec3], spacing: f64) -> Vec<DVec3> {
        assert!(points.len() == normals.len(), "a normal a point");
        let mut samples = Vec::new();
        for branch in &self.branches {
            let length = branch.curve.length();
            let n = PIECES.max((length / spacing).ceil() as usize);
            let step = length / n as f64;
            samples.extend((0..n).map(|k| {
                let arc = (k as f64 + 0.5) * step;
                (branch.curve.at(arc), step.sqrt() * branch.curve.tangent(arc))
            }));
        }
        let direction = |(&x, &normal): (&DVec3, &DVec3)| {
            let (a, b) = normal.any_orthonormal_pair();
            let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
            for (at, tangent) in &samples {
                let weight = at.distance_squared(x).powi(-2);
                let (p, q) = (tangent.dot(a), tangent.dot(b));
                aa += weight * p * p;
                bb += weight * q * q;
                ab += weight * p * q;
            }
            let angle = 0.5 * (2.0 * ab).atan2(aa - bb);
            angle.cos() * a + angle.sin() * b
        };
        points.par_iter().zip(normals).with_min_len(256).map(direction).collect()
    }
}
