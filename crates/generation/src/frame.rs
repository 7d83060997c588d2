//! A frame of the vessel's own, so that a vessel turned or moved gets the same particles, turned or moved.

use crate::Body;
use glam::{DMat3, DVec3};
use vaso_geometry::{Opening, Surface, Vessel};

/// Share of the largest distance up to which vertices count as equally far: more than the rounding of any
/// file, so that among the equal ones of a symmetric vessel the first is taken and not one by chance.
const EQUALLY_FAR: f64 = 0.999;

/// Origin and axes given by the shape of a vessel alone.
///
/// The origin is the centre of the surface, the first axis points to the vertex farthest from it, the second
/// to the one farthest from the first axis. Principal axes would not do: those of a round pipe are arbitrary.
pub(crate) struct Frame {
    origin: DVec3,
    /// From the frame to space.
    axes: DMat3,
}

impl Frame {
    pub(crate) fn of(vessel: &Vessel) -> Self {
        let surface = &vessel.surface;
        let origin = centroid(surface);
        let arms = || surface.vertices.iter().map(|v| *v - origin);
        let first = farthest(arms()).normalize_or(DVec3::X);
        let across = farthest(arms().map(|arm| arm - arm.dot(first) * first));
        // Rounding leaves a little of the first axis in what is left across it.
        let second = (across - across.dot(first) * first).normalize_or(first.any_orthonormal_vector());
        Self { origin, axes: DMat3::from_cols(first, second, first.cross(second)) }
    }

    /// The vessel in coordinates of the frame.
    pub(crate) fn localize(&self, vessel: &Vessel) -> Vessel {
        let back = self.axes.transpose();
        let mut local = vessel.clone();
        local.surface = vessel.surface.map(|v| back * (v - self.origin));
        for opening in &mut local.openings {
            let Opening { center, normal, axes, .. } = opening;
            *center = back * (*center - self.origin);
            *normal = back * *normal;
            *axes = axes.map(|axis| back * axis);
        }
        local
    }

    /// Where a point of the frame lies in space \[m\].
    pub(crate) fn place(&self, x: DVec3) -> DVec3 {
        self.axes * x + self.origin
    }

    /// Moves particles made in the frame to where the vessel is.
    pub(crate) fn restore(&self, body: &mut Body) {
        self.restore_points(&mut body.position, &mut body.normal);
    }

    /// As [`Self::restore`], for positions and normals.
    pub(crate) fn restore_points(&self, position: &mut [DVec3], normal: &mut [DVec3]) {
        for x in position {
            *x = self.place(*x);
        }
        for normal in normal {
            *normal = self.axes * *normal;
        }
    }
}

/// Centre of area \[m\].
fn centroid(surface: &Surface) -> DVec3 {
    let (low, high) = surface.bounds();
    let near = 0.5 * (low + high);
    let (mut area, mut moment) = (0.0, DVec3::ZERO);
    for t in 0..surface.triangles.len() {
        let [a, b, c] = surface.triangle(t).map(|v| v - near);
        let part = surface.triangle_area(t);
        area += part;
        moment += part / 3.0 * (a + b + c);
    }
    near + moment / area
}

/// The first of the longest arms.
fn farthest(arms: impl Iterator<Item = DVec3> + Clone) -> DVec3 {
    let longest = arms.clone().map(|arm| arm.length_squared()).fold(0.0, f64::max);
    let limit = EQUALLY_FAR * EQUALLY_FAR * longest;
    arms.clone().find(|arm| arm.length_squared() >= limit).unwrap_or(DVec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use vaso_geometry::{LengthUnit, SignedDistance, prepare, shapes};

    /// A pipe has infinitely many frames of equal right; the coordinates must not depend on the turn.
    #[test]
    fn coordinates_do_not_depend_on_where_the_vessel_is() {
        let pipe = shapes::pipe(2.0, 9.0, DVec3::Z, 48);
        let vessel =
            |s: Surface| prepare(s, Some(LengthUnit::Millimetre)).expect("a closed pipe is a vessel");
        let local = |s: Surface| {
            let vessel = vessel(s);
            Frame::of(&vessel).localize(&vessel)
        };
        let here = local(pipe.clone());
        let turn = DQuat::from_axis_angle(DVec3::new(2.0, -1.0, 0.5).normalize(), 2.2);
        let there = local(pipe.map(|v| turn * v + DVec3::new(30.0, -5.0, 12.0)));
        for (a, b) in here.surface.vertices.iter().zip(&there.surface.vertices) {
            assert!(a.distance(*b) < 1e-15, "{a} and {b}");
        }
        for (a, b) in here.openings.iter().zip(&there.openings) {
            assert!(a.center.distance(b.center) < 1e-15 && a.normal.distance(b.normal) < 1e-12);
        }
    }

    #[test]
    fn what_is_restored_lies_where_it_was() {
        let turn = DQuat::from_axis_angle(DVec3::new(0.2, 0.4, -1.0).normalize(), 0.8);
        let bend = shapes::bent_pipe(2.0, 6.0, 2.0, 48).map(|v| turn * v + DVec3::splat(40.0));
        let vessel = prepare(bend, Some(LengthUnit::Millimetre)).expect("a closed bend is a vessel");
        let frame = Frame::of(&vessel);
        let local = frame.localize(&vessel);
        assert!((frame.axes.determinant() - 1.0).abs() < 1e-12);
        assert!(local.openings.iter().zip(&vessel.openings).all(|(a, b)| a.polygon == b.polygon));
        let (inner, outer) = (SignedDistance::closed(&local), SignedDistance::closed(&vessel));
        let position: Vec<DVec3> = (0..50).map(|i| 5e-3 * crate::random::unit_box(1, i)).collect();
        for &x in &position {
            let at = frame.axes * x + frame.origin;
            assert!((inner.query(x).distance - outer.query(at).distance).abs() < 1e-12);
        }
    }
}
