//! What blocks leave over: a region filled by the relaxed lattice.

use crate::faces::Faces;
use crate::lumen::Lumen;
use crate::region::Region;
use glam::DVec3;
use vaso_geometry::{SignedDistance, Surface};

/// The lumen less the stretches filled by blocks.
pub(super) struct Zone<'a> {
    pub(super) lumen: &'a Lumen<'a>,
    /// Distance to the blocks, negative in them; `None` where there are none.
    pub(super) blocks: Option<SignedDistance>,
}

impl Zone<'_> {
    /// Distance outside the blocks \[m\], negative in them.
    pub(super) fn outside_blocks(&self, x: DVec3) -> f64 {
        self.blocks.as_ref().map_or(f64::INFINITY, |b| b.query(x).distance)
    }
}

impl Region for Zone<'_> {
    fn bounds(&self) -> (DVec3, DVec3) {
        self.lumen.bounds()
    }

    fn level(&self, x: DVec3) -> f64 {
        let level = self.lumen.level(x);
        // Far outside the lumen nobody asks how far the blocks are.
        if level > 0.0 { level } else { level.max(-self.outside_blocks(x)) }
    }

    fn exact_level(&self, x: DVec3) -> f64 {
        let level = self.lumen.exact_level(x);
        if level > 0.0 { level } else { level.max(-self.outside_blocks(x)) }
    }

    /// Faces of the lumen only: at the blocks their particles hold the place.
    fn faces(&self, x: DVec3) -> Faces {
        self.lumen.faces(x)
    }

    fn exact_faces(&self, x: DVec3) -> Faces {
        self.lumen.exact_faces(x)
    }
}

/// A closed tube through rings of equally many points, counter-clockwise about its direction, with the middle
/// of each end.
pub(super) fn add_tube(surface: &mut Surface, rings: &[Vec<DVec3>], ends: [DVec3; 2]) {
    let first = surface.vertices.len() as u32;
    let n = rings[0].len() as u32;
    surface.vertices.extend(rings.iter().flatten());
    let index = |ring: u32, k: u32| first + ring * n + k % n;
    let last = rings.len() as u32 - 1;
    for ring in 0..last {
        for k in 0..n {
            let [a, b, c, d] =
                [index(ring, k), index(ring, k + 1), index(ring + 1, k), index(ring + 1, k + 1)];
            surface.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    let middle = surface.vertices.len() as u32;
    surface.vertices.extend(ends);
    for k in 0..n {
        surface.triangles.push([middle, index(0, k + 1), index(0, k)]);
        surface.triangles.push([middle + 1, index(last, k), index(last, k + 1)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tube_is_closed_and_points_outwards() {
        let ring = |z: f64| -> Vec<DVec3> {
            (0..4).map(|k| DVec3::new([1.0, 0.0, -1.0, 0.0][k], [0.0, 1.0, 0.0, -1.0][k], z)).collect()
        };
        let mut surface = Surface { vertices: Vec::new(), triangles: Vec::new() };
        add_tube(&mut surface, &[ring(0.0), ring(1.0), ring(3.0)], [DVec3::ZERO, 3.0 * DVec3::Z]);
        add_tube(&mut surface, &[ring(5.0), ring(6.0)], [5.0 * DVec3::Z, 6.0 * DVec3::Z]);
        assert!((surface.volume() - 2.0 * 4.0).abs() < 1e-12);
        let distance = SignedDistance::of(&surface);
        assert!((distance.query(DVec3::new(0.0, 0.0, 4.0)).distance - 1.0).abs() < 1e-12);
        assert!(distance.query(DVec3::new(0.1, 0.1, 1.5)).distance < 0.0);
    }
}
