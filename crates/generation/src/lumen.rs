//! The fluid region: the lumen up to its caps.

use crate::extended::ExtendedLumen;
use crate::faces::Faces;
use crate::region::Region;
use glam::DVec3;
use vaso_geometry::Vessel;

/// The lumen of a vessel, its wall and each cap a face of its own.
pub(crate) struct Lumen<'a> {
    vessel: &'a Vessel,
    wall: ExtendedLumen,
    spacing: f64,
    /// Smoothing length \[m\].
    h: f64,
    bounds: (DVec3, DVec3),
}

impl<'a> Lumen<'a> {
    /// Lumen for particles of `spacing` \[m\] and smoothing length `h` \[m\].
    pub(crate) fn new(vessel: &'a Vessel, spacing: f64, h: f64) -> Self {
        // Drawn out by a support, the wall is smooth where it meets a cap, and its end is felt nowhere.
        let wall = ExtendedLumen::new(vessel, 2.0 * h, spacing, spacing);
        let (low, high) = vessel.surface.bounds();
        Self { vessel, wall, spacing, h, bounds: (low - spacing, high + spacing) }
    }

    /// Depth below each cap that `x` is at most `reach` \[m\] away from, and its normal.
    ///
    /// A cap is a face only for what lies before it: a limb that runs past beside it does not feel it.
    /// The cone of 45 degrees leaves room for caps that cut the vessel at a slant.
    fn caps(&self, x: DVec3, reach: f64) -> impl Iterator<Item = (f64, DVec3)> + '_ {
        let openings = self.vessel.openings.iter().zip(&self.wall.length);
        openings.filter_map(move |(opening, length)| {
            let depth = opening.depth(x);
            let near = depth < reach && depth > -length && opening.lateral(x) <= self.spacing + depth.abs();
            near.then_some((depth, opening.normal))
        })
    }

    fn level_at(&self, x: DVec3, wall: f64) -> f64 {
        self.caps(x, f64::INFINITY).fold(wall, |level, (depth, _)| level.max(-depth))
    }

    fn faces_at(&self, x: DVec3, (wall, outward): (f64, DVec3)) -> Faces {
        let mut faces = Faces::new();
        faces.push_shaped(x, (-wall, outward), self.h, |y| self.wall.sample(y).0);
        for (depth, normal) in self.caps(x, 4.0 * self.spacing) {
            faces.push(depth, normal);
        }
        faces
    }
}

impl Region for Lumen<'_> {
    fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }

    fn level(&self, x: DVec3) -> f64 {
        self.level_at(x, self.wall.sample(x).0)
    }

    fn exact_level(&self, x: DVec3) -> f64 {
        self.level_at(x, self.wall.query(x).0)
    }

    fn faces(&self, x: DVec3) -> Faces {
        self.faces_at(x, self.wall.sample(x))
    }

    fn exact_faces(&self, x: DVec3) -> Faces {
        self.faces_at(x, self.wall.query(x))
    }
}
