//! Volume and centroid of a cell with eight corners.

use glam::DVec3;

/// Corners of each face, counter-clockwise seen from outside; corner `c` lies at the index whose bits are `c`.
const FACES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Volume \[m^3\] and centroid \[m\] of a cell, and the volume of the least of its six pyramids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    /// Volume \[m^3\].
    pub(super) volume: f64,
    /// Centroid \[m\].
    pub(super) centroid: DVec3,
    /// Volume of the smallest pyramid over a face with its tip in the middle \[m^3\]; a cell with one that is not
    /// positive is inverted.
    pub(super) least: f64,
}

/// A cell by its corners, corner `c` at the index whose bits are `c`, and for faces that are known not to be
/// flat a point in their middle, in the order lower and upper face of each direction.
///
/// Each face is a fan about its middle, so that neighbours that share a face share its volume exactly.
pub(super) fn cell(corner: &[DVec3; 8], middle: &[Option<DVec3>; 6]) -> Cell {
    let tip = corner.iter().sum::<DVec3>() / 8.0;
    let (mut volume, mut moment, mut least) = (0.0, DVec3::ZERO, f64::INFINITY);
    for (face, given) in FACES.iter().zip(middle) {
        let corners = face.map(|c| corner[c]);
        let middle = given.unwrap_or_else(|| corners.iter().sum::<DVec3>() / 4.0);
        let mut pyramid = 0.0;
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % 4];
            let part = (a - tip).dot((b - tip).cross(middle - tip)) / 6.0;
            pyramid += part;
            moment += part * (a + b + middle - 3.0 * tip) / 4.0;
        }
        volume += pyramid;
        least = least.min(pyramid);
    }
    Cell { volume, centroid: tip + moment / volume, least }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(c: usize) -> DVec3 {
        DVec3::new((c & 1) as f64, (c >> 1 & 1) as f64, (c >> 2 & 1) as f64)
    }

    #[test]
    fn a_parallelepiped_has_its_triple_product() {
        let (a, b, c) = (DVec3::new(2.0, 0.1, 0.0), DVec3::new(0.3, 1.0, 0.2), DVec3::new(-0.2, 0.1, 3.0));
        let corner = std::array::from_fn(|k| unit(k).x * a + unit(k).y * b + unit(k).z * c);
        let found = cell(&corner, &[None; 6]);
        assert!((found.volume - a.cross(b).dot(c)).abs() < 1e-14);
        assert!(found.centroid.distance(0.5 * (a + b + c)) < 1e-14);
        assert!((found.least - found.volume / 6.0).abs() < 1e-14);
    }

    /// The frustum with square ends of edge 2 and 1 and height 1: 7/3, its centroid 11/28 above the base.
    #[test]
    fn a_frustum_has_its_volume_and_centroid() {
        let corner = std::array::from_fn(|k| {
            let p = unit(k);
            let edge = 2.0 - p.z;
            DVec3::new(edge * (p.x - 0.5), edge * (p.y - 0.5), p.z)
        });
        let found = cell(&corner, &[None; 6]);
        assert!((found.volume - 7.0 / 3.0).abs() < 1e-14);
        assert!(found.centroid.distance(DVec3::new(0.0, 0.0, 11.0 / 28.0)) < 1e-14);
    }

    #[test]
    fn a_cell_with_a_corner_through_a_face_is_inverted() {
        let corner = std::array::from_fn(|k| if k == 7 { DVec3::splat(-2.0) } else { unit(k) });
        assert!(cell(&corner, &[None; 6]).least < 0.0);
        let bulged = cell(
            &std::array::from_fn(unit),
            &[None, Some(DVec3::new(1.3, 0.5, 0.5)), None, None, None, None],
        );
        assert!((bulged.volume - 1.1).abs() < 1e-14);
    }
}
