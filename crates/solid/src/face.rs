//! Faces of a solid: the particles that a pressure or the tissue around acts on.

use crate::error::SolidError;
use glam::DVec3;

/// Particles of one layer with the area each of them stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Numbers of the particles as they were given.
    pub particles: Vec<u32>,
    /// Area of each in the reference configuration, along its normal out of the solid \[m^2\].
    pub area: Vec<DVec3>,
}

impl Face {
    /// Face of `particles` with unit normals out of the solid and areas \[m^2\].
    ///
    /// The areas are those of the surface that is loaded: half a spacing from the particles, where a tube is narrower or
    /// wider than at their centres.
    ///
    /// # Errors
    /// [`SolidError::Count`] where lists differ in length, [`SolidError::OutOfRange`] for an area below zero.
    pub fn new(particles: Vec<u32>, normals: &[DVec3], areas: &[f64]) -> Result<Self, SolidError> {
        let expected = particles.len();
        for (what, given) in [("normals", normals.len()), ("areas", areas.len())] {
            if given != expected {
                return Err(SolidError::Count { what, given, expected });
            }
        }
        for &area in areas {
            crate::error::within("area", area, area >= 0.0, "0 m^2 or more")?;
        }
        let area = normals.iter().zip(areas).map(|(n, a)| *a * n.normalize_or_zero()).collect();
        Ok(Self { particles, area })
    }

    /// Face of `particles` that each stand for the area `V^(2/3)` of their volume \[m^3\].
    ///
    /// # Errors
    /// As [`Face::new`].
    pub fn by_volume(particles: Vec<u32>, normals: &[DVec3], volumes: &[f64]) -> Result<Self, SolidError> {
        let areas: Vec<f64> = volumes.iter().map(|v| v.cbrt() * v.cbrt()).collect();
        Self::new(particles, normals, &areas)
    }

    /// The same face with all areas scaled so that they add up to `total` \[m^2\], where that is known.
    pub fn with_total(mut self, total: f64) -> Self {
        let sum: f64 = self.area.iter().map(|a| a.length()).sum();
        if sum > 0.0 {
            self.area.iter_mut().for_each(|a| *a *= total / sum);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_follow_volumes_up_to_the_total() {
        let normals = [DVec3::X, 2.0 * DVec3::Y];
        let face = Face::by_volume(vec![3, 5], &normals, &[1e-9, 8e-9]).expect("one normal each");
        assert!((face.area[1] - 4e-6 * DVec3::Y).length() < 1e-18);
        let face = face.with_total(1e-5);
        assert!((face.area[0].x - 2e-6).abs() < 1e-18 && (face.area[1].y - 8e-6).abs() < 1e-18);
        assert!(matches!(Face::new(vec![1], &normals, &[1.0]), Err(SolidError::Count { given: 2, .. })));
    }
}
