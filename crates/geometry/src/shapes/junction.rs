//! Tubes that run into each other, as an implicit surface.

use glam::DVec3;

use super::implicit::{Implicit, union};

/// A branch: a tube about a straight axis from the crossing outwards.
pub(super) struct Branch {
    /// Unit vector along the axis.
    pub(super) along: DVec3,
    pub(super) length: f64,
    /// Radius at distances along the axis, ascending.
    pub(super) radii: Vec<(f64, f64)>,
}

impl Branch {
    /// Radius at distance `s` along the axis: smooth between the given places, constant outside.
    pub(super) fn radius(&self, s: f64) -> f64 {
        let after = self.radii.partition_point(|&(place, _)| place <= s);
        if after == 0 {
            return self.radii[0].1;
        }
        let (from, start) = self.radii[after - 1];
        let Some(&(to, end)) = self.radii.get(after) else { return start };
        let part = (s - from) / (to - from);
        start + (end - start) * part * part * (3.0 - 2.0 * part)
    }

    /// About the distance to the wall of the endless tube, negative inside and round behind the crossing, and
    /// the direction away from the axis.
    pub(super) fn distance(&self, x: DVec3) -> (f64, DVec3) {
        let s = x.dot(self.along);
        let from_axis = x - s.max(0.0) * self.along;
        (from_axis.length() - self.radius(s), from_axis.normalize_or_zero())
    }

    /// Two axes across the tube, the first for all branches the same; the first cross the second is `along`.
    pub(super) fn across(&self) -> [DVec3; 2] {
        [DVec3::Y, self.along.cross(DVec3::Y)]
    }
}

/// The three branches and their union.
pub(super) struct Junction {
    pub(super) branches: [Branch; 3],
    pub(super) blend: f64,
}

impl Implicit for Junction {
    fn field(&self, x: DVec3) -> f64 {
        let [a, b, c] = [0, 1, 2].map(|k| self.branches[k].distance(x));
        let pair = |a, b| union(self.blend, a, b);
        pair(a, b).min(pair(b, c)).min(pair(c, a))
    }

    fn scale(&self) -> f64 {
        self.blend
    }
}

impl Junction {
    /// The wall point on the ray from a point inside.
    pub(super) fn hit(&self, origin: DVec3, direction: DVec3) -> DVec3 {
        // The field has slope about one, so going by its value never jumps across a wall.
        let (mut low, mut high) = (0.0, 0.0);
        let reach = self.branches.iter().map(|b| b.length).fold(0.0, f64::max);
        while high < reach {
            let value = self.field(origin + high * direction);
            if value >= 0.0 {
                break;
            }
            low = high;
            high += (-0.5 * value).max(1e-3 * self.blend);
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.field(origin + middle * direction) < 0.0 { low = middle } else { high = middle }
        }
        origin + 0.5 * (low + high) * direction
    }
}
