//! Matrices as the pair loops sum them, and as the materials take them.

use glam::{DMat3, DVec3};
use vaso_kernels::{FIELDS, Real, Sym3};

/// Matrix of sums taken row by row, times `scale`.
#[inline(always)]
pub(crate) fn from_rows(m: &[f64], scale: f64) -> DMat3 {
    scale
        * DMat3::from_cols(
            DVec3::new(m[0], m[3], m[6]),
            DVec3::new(m[1], m[4], m[7]),
            DVec3::new(m[2], m[5], m[8]),
        )
}

/// A symmetric matrix in full.
#[inline(always)]
pub(crate) fn full(m: &Sym3) -> DMat3 {
    let [xx, yy, zz, xy, xz, yz] = m.0;
    DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz))
}

/// Splits a matrix into the first eight entries, row by row, and the last.
#[inline(always)]
pub(crate) fn pack<R: Real>(m: &DMat3) -> ([R; FIELDS], R) {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    ([x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z].map(R::pack), R::pack(z.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_survive_packing() {
        let rows = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let m = from_rows(&rows, 2.0);
        assert_eq!(m * DVec3::X, DVec3::new(2.0, 8.0, 14.0));
        let (first, last) = pack::<f64>(&m);
        assert!(first.iter().zip(rows).all(|(a, b)| *a == 2.0 * b) && last == 18.0);
    }
}
