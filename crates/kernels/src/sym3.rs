//! Symmetric 3x3 matrices, and the correction matrix of the kernel gradient.

use glam::DVec3;

/// Symmetric matrix as `[xx, yy, zz, xy, xz, yz]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sym3(pub [f64; 6]);

impl Sym3 {
    /// The unit matrix.
    pub const IDENTITY: Self = Self([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);

    /// Product with a vector.
    #[inline]
    pub fn mul(&self, v: DVec3) -> DVec3 {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        DVec3::new(
            xx * v.x + xy * v.y + xz * v.z,
            xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z,
        )
    }

    /// Determinant.
    #[inline]
    pub fn determinant(&self) -> f64 {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    }

    /// Inverse; `None` where the determinant is not above `1e-12`.
    #[inline]
    pub fn inverse(&self) -> Option<Self> {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        let det = self.determinant();
        (det > 1e-12).then(|| {
            let s = 1.0 / det;
            Self([
                (yy * zz - yz * yz) * s,
                (xx * zz - xz * xz) * s,
                (xx * yy - xy * xy) * s,
                (xz * yz - xy * zz) * s,
                (xy * yz - xz * yy) * s,
                (xy * xz - xx * yz) * s,
            ])
        })
    }

    /// Correction matrix `B` of the kernel gradient from the moment matrix `M`
    /// (Bonet & Lok 1999), blended towards the unit matrix where `M` is near singular:
    /// `B = (1 - w) I + w M^-1`, `w = clamp((det M - 0.05) / 0.2, 0, 1)`.
    #[inline]
    pub fn correction(moment: &Self) -> Self {
        let w = ((moment.determinant() - 0.05) / 0.2).clamp(0.0, 1.0);
        match moment.inverse() {
            Some(inverse) if w > 0.0 => {
                Self(std::array::from_fn(|k| (1.0 - w) * Self::IDENTITY.0[k] + w * inverse.0[k]))
            }
            _ => Self::IDENTITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_times_matrix_is_one() {
        let m = Sym3([2.0, 1.5, 1.2, 0.3, -0.2, 0.1]);
        let inverse = m.inverse().expect("well conditioned");
        for v in [DVec3::X, DVec3::Y, DVec3::Z] {
            assert!((inverse.mul(m.mul(v)) - v).length() < 1e-14);
        }
    }

    #[test]
    fn correction_of_a_poor_support_is_the_unit_matrix() {
        let flat = Sym3([0.9, 0.9, 1e-4, 0.0, 0.0, 0.0]);
        assert_eq!(Sym3::correction(&flat), Sym3::IDENTITY);
    }
}
