//! The layer around the whole closed surface, caps and all, to be opened afterwards.

use crate::faces::Faces;
use crate::region::Region;
use glam::DVec3;
use vaso_geometry::{DistanceGrid, SignedDistance, Vessel};

/// How far beyond the layer its distance is in the table, in spacings: what a region has to tell.
const MARGIN: f64 = 2.5;

/// The layer `0 < phi < thickness` around the closed surface.
pub(super) struct ClosedLayer {
    pub(super) exact: SignedDistance,
    table: DistanceGrid,
    bounds: (DVec3, DVec3),
    thickness: f64,
    smoothing_length: f64,
}

impl ClosedLayer {
    /// Layer of `thickness` \[m\] for particles of `spacing` and smoothing length `h` \[m\].
    pub(super) fn new(vessel: &Vessel, thickness: f64, spacing: f64, h: f64) -> Self {
        let (low, high) = vessel.surface.bounds();
        let bounds = (low - thickness - spacing, high + thickness + spacing);
        let exact = SignedDistance::closed(vessel);
        let table = DistanceGrid::build(
            &exact,
            (bounds.0 - spacing, bounds.1 + spacing),
            spacing,
            thickness + MARGIN * spacing,
        );
        Self { exact, table, bounds, thickness, smoothing_length: h }
    }

    fn level_at(&self, depth: f64) -> f64 {
        (-depth).max(depth - self.thickness)
    }

    fn faces_at(&self, x: DVec3, (depth, outward): (f64, DVec3)) -> Faces {
        let mut faces = Faces::new();
        let (h, thickness) = (self.smoothing_length, self.thickness);
        faces.push_shaped(x, (depth, -outward), h, |y| -self.table.sample(y).0);
        faces.push_shaped(x, (thickness - depth, outward), h, |y| self.table.sample(y).0 - thickness);
        faces
    }

    fn query(&self, x: DVec3) -> (f64, DVec3) {
        let nearest = self.exact.query(x);
        (nearest.distance, nearest.normal)
    }
}

impl Region for ClosedLayer {
    fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }

    fn level(&self, x: DVec3) -> f64 {
        self.level_at(self.table.sample(x).0)
    }

    fn exact_level(&self, x: DVec3) -> f64 {
        self.level_at(self.exact.query(x).distance)
    }

    fn faces(&self, x: DVec3) -> Faces {
        self.faces_at(x, self.table.sample(x))
    }

    fn exact_faces(&self, x: DVec3) -> Faces {
        self.faces_at(x, self.query(x))
    }
}
