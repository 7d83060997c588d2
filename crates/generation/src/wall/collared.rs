//! The region of a wall with collars: the layer around the lumen, going on straight beyond its openings.

use crate::extended::ExtendedLumen;
use crate::faces::Faces;
use crate::region::Region;
use glam::DVec3;
use vaso_geometry::{Opening, Vessel};

/// By how much the lumen is drawn out beyond the collars, in spacings: in front of an opening a point is
/// then deep in the lumen, not on the border of anything, until past the end of the wall.
const MARGIN: f64 = 2.0;
/// Error of the distance, in spacings: of the table near the border of a cap, and exact.
const TABLE_TOLERANCE: f64 = 0.5;
const EXACT_TOLERANCE: f64 = 0.01;

/// The layer `0 < phi < thickness` around the lumen, with a collar beyond each cap.
///
/// Being defined by a distance it needs no offset surface, cannot intersect itself, and where two limbs
/// come close their walls merge.
pub(crate) struct CollaredLayer<'a> {
    vessel: &'a Vessel,
    /// The lumen, drawn out past the ends of the collars.
    lumen: ExtendedLumen,
    thickness: f64,
    spacing: f64,
    smoothing_length: f64,
}

impl<'a> CollaredLayer<'a> {
    /// Layer of `thickness` \[m\] with collars of length `collar` \[m\] for particles of `spacing` and smoothing
    /// length `h` \[m\].
    pub(crate) fn new(vessel: &'a Vessel, thickness: f64, collar: f64, spacing: f64, h: f64) -> Self {
        let lumen = ExtendedLumen::new(vessel, collar + MARGIN * spacing, thickness + spacing, spacing);
        Self { vessel, lumen, thickness, spacing, smoothing_length: h }
    }

    /// Depth in the wall at `x` \[m\], and the unit normal away from the lumen.
    pub(crate) fn depth(&self, x: DVec3) -> (f64, DVec3) {
        self.lumen.query(x)
    }

    /// For each opening near `x`, the distance to the end of the wall there \[m\], positive before it, and
    /// the normal of the end.
    ///
    /// `depth` and `outward` are those of `x`, known to `tolerance` \[m\].
    fn ends(
        &self,
        x: DVec3,
        (depth, outward): (f64, DVec3),
        tolerance: f64,
    ) -> impl Iterator<Item = (f64, DVec3)> + '_ {
        let openings = self.vessel.openings.iter().zip(&self.lumen.length);
        openings.filter_map(move |(opening, length)| {
            // Where the lumen cannot be drawn out in full, the collar is shorter too.
            let collar = (length - MARGIN * self.spacing).max(0.0);
            let beyond = -opening.depth(x);
            let reach = self.thickness + self.spacing;
            if beyond <= 0.0 || beyond > length + reach || is_far(opening, x, reach) {
                return None;
            }
            let lateral = opening.lateral(x).max(0.0);
            let plane = (collar - beyond, opening.normal);
            let past = (beyond - length).max(0.0);
            let border_distance = lateral.hypot(past);
            if lateral > reach || depth >= border_distance - tolerance {
                return (lateral <= reach).then_some(plane);
            }
            // Another limb is nearer than the drawn-out border: its wall goes on past the end of the collar,
            // up to the bisector between the two.
            let before = 0.5 * (border_distance - depth);
            if before <= plane.0 {
                return Some(plane);
            }
            let in_plane = (x - opening.center) - beyond * opening.normal;
            let from_border = lateral * in_plane.normalize_or_zero() + past * opening.normal;
            Some((before, (outward - from_border.normalize_or_zero()).normalize_or_zero()))
        })
    }

    fn level_at(&self, x: DVec3, distance: (f64, DVec3), tolerance: f64) -> f64 {
        let layer = (-distance.0).max(distance.0 - self.thickness);
        if layer > 2.0 * self.spacing {
            return layer;
        }
        self.ends(x, distance, tolerance).fold(layer, |level, (before, _)| level.max(-before))
    }

    fn faces_at(&self, x: DVec3, distance: (f64, DVec3), tolerance: f64) -> Faces {
        let (depth, outward) = distance;
        let mut faces = Faces::new();
        let (h, thickness) = (self.smoothing_length, self.thickness);
        faces.push_shaped(x, (depth, -outward), h, |y| -self.lumen.sample(y).0);
        faces.push_shaped(x, (thickness - depth, outward), h, |y| self.lumen.sample(y).0 - thickness);
        for (before, normal) in self.ends(x, distance, tolerance) {
            faces.push(before, normal);
        }
        faces
    }
}

/// Whether `x` is farther from the border of an opening than `reach` \[m\] by a look at the axis, cheaper
/// than at the border; no opening is so long and narrow that its border lies beyond three radii.
fn is_far(opening: &Opening, x: DVec3, reach: f64) -> bool {
    let [u, v] = opening.project(x);
    u.hypot(v) > 3.0 * opening.radius + reach
}

impl Region for CollaredLayer<'_> {
    fn bounds(&self) -> (DVec3, DVec3) {
        self.lumen.bounds
    }

    fn level(&self, x: DVec3) -> f64 {
        self.level_at(x, self.lumen.sample(x), TABLE_TOLERANCE * self.spacing)
    }

    fn exact_level(&self, x: DVec3) -> f64 {
        self.level_at(x, self.lumen.query(x), EXACT_TOLERANCE * self.spacing)
    }

    fn faces(&self, x: DVec3) -> Faces {
        self.faces_at(x, self.lumen.sample(x), TABLE_TOLERANCE * self.spacing)
    }

    fn exact_faces(&self, x: DVec3) -> Faces {
        self.faces_at(x, self.lumen.query(x), EXACT_TOLERANCE * self.spacing)
    }
}
