//! The region of a rigid wall: the layer around the lumen, open at the ends.

use crate::extended::ExtendedLumen;
use crate::faces::Faces;
use crate::region::Region;
use glam::DVec3;
use vaso_geometry::{Opening, SignedDistance, Vessel};

/// By how much the lumen is drawn out beyond the end of the collars, in spacings.
const MARGIN: f64 = 2.0;
/// Error of the distance, in spacings: of the table near the border of a cap, and exact.
const TABLE_TOLERANCE: f64 = 0.5;
const EXACT_TOLERANCE: f64 = 0.01;

/// The layer `0 < phi < thickness` around the lumen, with a collar beyond each cap.
///
/// Being defined by a distance it needs no offset surface, cannot intersect itself, and where two limbs
/// come close their walls merge.
pub(crate) struct WallLayer<'a> {
    vessel: &'a Vessel,
    lumen: ExtendedLumen,
    closed: SignedDistance,
    thickness: f64,
    /// Length of the collar beyond each cap \[m\].
    collar: Vec<f64>,
    spacing: f64,
}

/// What a point of the layer has about it.
struct Place {
    /// Distance from the lumen \[m\] and its gradient.
    depth: f64,
    outward: DVec3,
    /// Distance to the end of the wall \[m\], positive before it, and the normal of that face.
    end: Option<(f64, DVec3)>,
}

impl<'a> WallLayer<'a> {
    /// Layer of `thickness` \[m\] with collars of length `collar` \[m\] for particles of `spacing` \[m\].
    pub(crate) fn new(vessel: &'a Vessel, thickness: f64, collar: f64, spacing: f64) -> Self {
        let lumen = ExtendedLumen::new(vessel, collar + MARGIN * spacing, thickness + spacing, spacing);
        // Where the opening cannot be drawn out in full, the collar ends with it.
        let collar = lumen.length.iter().map(|length| collar.min(*length)).collect();
        Self { vessel, lumen, closed: SignedDistance::closed(vessel), thickness, collar, spacing }
    }

    /// Depth in the wall at `x` \[m\], and the unit normal away from the lumen.
    pub(crate) fn depth(&self, x: DVec3) -> (f64, DVec3) {
        let place = self.place(x, self.lumen.query(x), EXACT_TOLERANCE * self.spacing);
        (place.depth, place.outward)
    }

    /// The place of `x`, whose distance from the drawn-out lumen is known to `tolerance` \[m\].
    fn place(&self, x: DVec3, (depth, outward): (f64, DVec3), tolerance: f64) -> Place {
        let at_opening =
            (0..self.collar.len()).find_map(|k| self.beyond_cap(k, x, depth, outward, tolerance));
        at_opening.unwrap_or(Place { depth, outward, end: None })
    }

    /// The place of `x` if it lies beyond the cap of opening `k` and beside the drawn-out border.
    ///
    /// Another limb may pass there. Up to the end of the collar its wall and the collar merge; beyond, its
    /// wall goes on as far as it is nearer than the cap, and ends at the bisector.
    fn beyond_cap(&self, k: usize, x: DVec3, depth: f64, outward: DVec3, tolerance: f64) -> Option<Place> {
        let opening = &self.vessel.openings[k];
        let (beyond, collar) = (-opening.depth(x), self.collar[k]);
        let reach = self.thickness + self.spacing;
        if beyond <= 0.0 || beyond > self.lumen.length[k] + reach || is_far(opening, x, reach) {
            return None;
        }
        let lateral = opening.lateral(x);
        if lateral > reach {
            return None;
        }
        let own_end = Some((collar - beyond, opening.normal));
        if beyond <= collar {
            let is_own = depth >= lateral - tolerance;
            return is_own.then_some(Place { depth, outward, end: own_end });
        }
        let nearest = self.closed.query(x);
        let cap = opening.distance(x);
        if nearest.distance >= cap - EXACT_TOLERANCE * self.spacing {
            return Some(Place { depth, outward, end: own_end });
        }
        let in_plane = (x - opening.center) - beyond * opening.normal;
        let from_cap = beyond * opening.normal + lateral.max(0.0) * in_plane.normalize_or_zero();
        let end = (0.5 * (cap - nearest.distance), (nearest.normal - from_cap / cap).normalize_or_zero());
        Some(Place { depth: nearest.distance, outward: nearest.normal, end: Some(end) })
    }

    fn level_at(&self, x: DVec3, distance: (f64, DVec3), tolerance: f64) -> f64 {
        let layer = |depth: f64| (-depth).max(depth - self.thickness);
        if layer(distance.0) > 2.0 * self.spacing {
            return layer(distance.0);
        }
        let place = self.place(x, distance, tolerance);
        place.end.map_or(f64::NEG_INFINITY, |(before, _)| -before).max(layer(place.depth))
    }

    fn faces_at(&self, x: DVec3, distance: (f64, DVec3), tolerance: f64) -> Faces {
        let Place { depth, outward, end } = self.place(x, distance, tolerance);
        let mut faces = Faces::new();
        faces.push(depth, -outward);
        faces.push(self.thickness - depth, outward);
        if let Some((before, normal)) = end {
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

impl Region for WallLayer<'_> {
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
