//! The region of a rigid wall: the layer around the lumen, open at the ends.

use crate::extended::ExtendedLumen;
use crate::faces::Faces;
use crate::region::Region;
use glam::DVec3;
use vaso_geometry::{Opening, Vessel};

/// By how much the wall is drawn out beyond the end of its collar, in spacings.
const MARGIN: f64 = 2.0;

/// The layer `0 < phi < thickness` around the lumen, with a collar beyond each cap.
///
/// Being defined by a distance it needs no offset surface, cannot intersect itself, and where two limbs
/// come close their walls merge.
pub(crate) struct WallLayer<'a> {
    vessel: &'a Vessel,
    lumen: ExtendedLumen,
    thickness: f64,
    /// Length of the collar beyond each cap \[m\].
    collar: Vec<f64>,
    spacing: f64,
}

impl<'a> WallLayer<'a> {
    /// Layer of `thickness` \[m\] with collars of length `collar` \[m\] for particles of `spacing` \[m\].
    pub(crate) fn new(vessel: &'a Vessel, thickness: f64, collar: f64, spacing: f64) -> Self {
        let lumen = ExtendedLumen::new(vessel, collar + MARGIN * spacing, thickness + spacing, spacing);
        // Where the opening cannot be drawn out in full, the collar ends with it.
        let collar = lumen.length.iter().map(|length| collar.min(*length)).collect();
        Self { vessel, lumen, thickness, collar, spacing }
    }

    /// Depth in the wall at `x` \[m\], and the unit normal away from the lumen.
    pub(crate) fn depth(&self, x: DVec3) -> (f64, DVec3) {
        self.lumen.query(x)
    }

    /// Distance to the end plane of each collar that `x` belongs to, positive before the end, and the
    /// normal of the plane.
    ///
    /// `depth` is that of `x`. A point belongs to a collar when the drawn-out border of the opening is
    /// what it is nearest to, within `tolerance` \[m\]: the wall of another limb is not cut.
    fn ends(&self, x: DVec3, depth: f64, tolerance: f64) -> impl Iterator<Item = (f64, DVec3)> + '_ {
        let openings = self.vessel.openings.iter().zip(&self.collar).zip(&self.lumen.length);
        openings.filter_map(move |((opening, &collar), &length)| {
            let beyond = -opening.depth(x);
            let last = length + self.thickness + self.spacing;
            if beyond < -self.spacing || beyond > last || self.is_far(opening, x) {
                return None;
            }
            let lateral = opening.lateral(x);
            let own = lateral.hypot((beyond - length).max(0.0));
            (lateral < 0.0 || depth >= own - tolerance).then_some((collar - beyond, opening.normal))
        })
    }

    /// Whether `x` is too far from the axis of an opening for its collar; cheaper than the border.
    fn is_far(&self, opening: &Opening, x: DVec3) -> bool {
        let [u, v] = opening.project(x);
        let reach = 3.0 * opening.radius + self.thickness + self.spacing;
        u * u + v * v > reach * reach
    }

    fn level_at(&self, x: DVec3, depth: f64, tolerance: f64) -> f64 {
        let layer = (-depth).max(depth - self.thickness);
        if layer >= self.band() {
            return layer;
        }
        self.ends(x, depth, tolerance).fold(layer, |level, (before, _)| level.max(-before))
    }

    fn faces_at(&self, x: DVec3, (depth, outward): (f64, DVec3), tolerance: f64) -> Faces {
        let mut faces = Faces::new();
        faces.push(depth, -outward);
        faces.push(self.thickness - depth, outward);
        for (before, normal) in self.ends(x, depth, tolerance) {
            faces.push(before, normal);
        }
        faces
    }
}

/// Error of the table near the border of a cap, and of the exact distance, in spacings.
const TABLE_TOLERANCE: f64 = 0.5;
const EXACT_TOLERANCE: f64 = 0.01;

impl Region for WallLayer<'_> {
    fn bounds(&self) -> (DVec3, DVec3) {
        self.lumen.bounds
    }

    fn band(&self) -> f64 {
        // The level is told up to where the distance is clamped beyond the outer face.
        self.lumen.band - self.thickness
    }

    fn level(&self, x: DVec3) -> f64 {
        self.level_at(x, self.lumen.sample(x).0, TABLE_TOLERANCE * self.spacing)
    }

    fn exact_level(&self, x: DVec3) -> f64 {
        self.level_at(x, self.lumen.query(x).0, EXACT_TOLERANCE * self.spacing)
    }

    fn faces(&self, x: DVec3) -> Faces {
        self.faces_at(x, self.lumen.sample(x), TABLE_TOLERANCE * self.spacing)
    }

    fn exact_faces(&self, x: DVec3) -> Faces {
        self.faces_at(x, self.lumen.query(x), EXACT_TOLERANCE * self.spacing)
    }
}
