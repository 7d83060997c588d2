//! The wall of a vessel as a surface to put particles on.

use glam::DVec3;
use rayon::prelude::*;
use vaso_geometry::{NearestRim, Rim, SignedDistance, SmoothNormals, Vessel};

/// Least cosine between the normals of two particles that see each other.
///
/// Walls on both sides of a thin gap look at each other and must not push each other about, however near they
/// are; their cosine is near -1. It lies just below zero so that both sides of a crease at right angles are
/// one sheet: with 0.3 a duct of square section has pairs at 0.57 spacings and a variation of 0.09 along its
/// edges, with -0.1 it is 0.77 and 0.05.
const SAME_SHEET: f64 = -0.1;
/// Cosine between the normals before and after a step below which the step went through the lumen or a gap,
/// onto another part of the wall.
const OTHER_SHEET: f64 = -0.5;

/// Whether particles with these unit normals belong to one sheet.
pub(crate) fn same_sheet(a: DVec3, b: DVec3) -> bool {
    a.dot(b) > SAME_SHEET
}

/// A point of the wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    pub(crate) point: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) triangle: u32,
}

/// The wall faces of a vessel with their rims.
pub(crate) struct Sheet<'a> {
    vessel: &'a Vessel,
    distance: SignedDistance,
    normals: SmoothNormals<'a>,
    rim: Rim,
}

impl<'a> Sheet<'a> {
    pub(crate) fn new(vessel: &'a Vessel) -> Self {
        let is_wall = |t: usize| vessel.face_opening[t].is_none();
        Self {
            vessel,
            distance: SignedDistance::wall(vessel),
            normals: SmoothNormals::new(&vessel.surface, is_wall),
            rim: Rim::new(vessel),
        }
    }

    /// Lower and upper corner of a box around the sheet \[m\].
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        self.vessel.surface.bounds()
    }

    /// The point of the sheet nearest to `x`; found faster from the number of a triangle nearby.
    pub(crate) fn foot(&self, x: DVec3, guess: u32) -> Foot {
        let nearest = self.distance.query_from(x, guess);
        let normal = self.normals.at(nearest.triangle as usize, nearest.point);
        Foot { point: nearest.point, normal, triangle: nearest.triangle }
    }

    /// The sheet where a step from `from` to `to` ends; `from` where it would end on another sheet.
    pub(crate) fn step(&self, from: Foot, to: DVec3) -> Foot {
        let foot = self.foot(to, from.triangle);
        if foot.normal.dot(from.normal) < OTHER_SHEET { from } else { foot }
    }

    /// The rim of this sheet within `reach` \[m\] of a point of it.
    pub(crate) fn rim(&self, foot: &Foot, reach: f64) -> Option<NearestRim> {
        self.rim.query(foot.point, foot.normal, reach)
    }

    /// Largest distance of `points` from the sheet \[m\].
    pub(crate) fn largest_distance(&self, points: &[DVec3]) -> f64 {
        let distance = |x: &DVec3| self.distance.query(*x).distance.abs();
        points.par_iter().map(distance).reduce(|| 0.0, f64::max)
    }
}
