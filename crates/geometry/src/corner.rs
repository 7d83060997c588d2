//! The corner between a cap and the wall around it.

use glam::DVec3;

/// Mean angle between the normals of a cap and of the wall around it \[degrees\].
const MEAN_DEGREES: std::ops::RangeInclusive<f64> = 45.0..=135.0;
/// The same for each piece of the border; a few may differ, where a facet of the cap itself is tilted.
const PIECE_DEGREES: std::ops::RangeInclusive<f64> = 30.0..=150.0;
const MIN_PIECES: f64 = 0.85;

/// Angles along the border of a flat region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    /// Mean over the length of the border \[rad\].
    pub(crate) mean: f64,
    /// Part of the length where the angle is that of a corner, not of a smooth surface.
    sharp: f64,
}

impl Corner {
    /// Measures the corner from the length of each piece of the border and the normal of the triangle there.
    pub(crate) fn between(normal: DVec3, border: &[(f64, DVec3)]) -> Corner {
        let (mut length, mut mean, mut sharp) = (0.0, 0.0, 0.0);
        for &(piece, wall) in border {
            let angle = wall.angle_between(normal);
            length += piece;
            mean += piece * angle;
            if PIECE_DEGREES.contains(&angle.to_degrees()) {
                sharp += piece;
            }
        }
        if length > 0.0 {
            Corner { mean: mean / length, sharp: sharp / length }
        } else {
            Corner { mean, sharp }
        }
    }

    /// Whether the wall stands up from the region all around, as it does at the end of a tube.
    pub(crate) fn is_rim(&self) -> bool {
        MEAN_DEGREES.contains(&self.mean.to_degrees()) && self.sharp >= MIN_PIECES
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rim_is_sharp_all_around() {
        let upright = (1.0, DVec3::X);
        let smooth = (1.0, DVec3::new(0.1, 0.0, 1.0));
        assert!(Corner::between(DVec3::Z, &[upright; 10]).is_rim());
        assert!(!Corner::between(DVec3::Z, &[smooth; 10]).is_rim());
        // Half of the border flat: the mean alone would pass.
        let half = Corner::between(DVec3::Z, &[upright, smooth, upright, (0.9, DVec3::Z), (0.5, DVec3::X)]);
        assert!(half.mean.to_degrees() > 45.0 && !half.is_rim());
        // One tilted facet of a cap does no harm.
        let mut nearly = [upright; 20];
        nearly[3] = smooth;
        assert!(Corner::between(DVec3::Z, &nearly).is_rim());
    }

    #[test]
    fn no_border_is_no_rim() {
        assert!(!Corner::between(DVec3::Z, &[]).is_rim());
    }
}
