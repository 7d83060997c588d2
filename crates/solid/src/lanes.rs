//! Strain and stress of many particles at once, one a lane: what `points.rs` says of one.

use crate::material::Elastic;
use crate::points::Constants;
use glam::{DMat3, DVec3};
use vaso_kernels::{BLOCK, BlockColumn, Lanes, PointLaw, Points};

/// Matrix, row by row.
pub(crate) type Matrix<L> = [L; 9];

/// Columns that are read: the sums of the pairs, row by row, then the correction `xx yy zz xy xz yz`.
const CORRECTION: usize = 9;
pub(crate) const OWN: usize = 15;
/// Columns that are written: the displacement gradient, what the force reads, both row by row, and the determinant.
const FORCE: usize = 9;
pub(crate) const DETERMINANT: usize = 18;
pub(crate) const OUT: usize = 19;

/// From the sums of the pairs to what the force reads.
pub(crate) struct Stress<'a, E> {
    pub(crate) material: E,
    pub(crate) constants: &'a Constants,
}

impl<E: Elastic> PointLaw for Stress<'_, E> {
    #[inline(always)]
    fn point<L: Lanes<Elem = f64>>(&self, points: &mut Points<'_, L>) {
        let one = L::constant(1.0);
        let scale = L::constant(self.constants.gradient_scale);
        let sums: Matrix<L> = std::array::from_fn(|k| scale * points.own(k));
        let [xx, yy, zz, xy, xz, yz] = std::array::from_fn(|k| points.own(CORRECTION + k));
        let correction = [xx, xy, xz, xy, yy, yz, xz, yz, zz];
        let gradient = product(&sums, &correction);
        let mut f = gradient;
        for k in [0, 4, 8] {
            f[k] = f[k] + one;
        }
        let cofactor = cofactor(&f);
        let determinant = f[0].fma(cofactor[0], f[1].fma(cofactor[1], f[2] * cofactor[2]));
        let first_piola = self.material.stress_in_lanes(&f, &cofactor, determinant);
        let stress = product(&first_piola, &correction);
        let hourglass = L::constant(0.5 * self.constants.hourglass);
        for k in 0..9 {
            points.put(k, gradient[k]);
            points.put(FORCE + k, hourglass.fnma(gradient[k], stress[k]));
        }
        points.put(DETERMINANT, determinant);
    }
}

/// `a b`.
#[inline(always)]
pub(crate) fn product<L: Lanes>(a: &Matrix<L>, b: &Matrix<L>) -> Matrix<L> {
    std::array::from_fn(|k| {
        let (r, c) = (3 * (k / 3), k % 3);
        a[r].fma(b[c], a[r + 1].fma(b[3 + c], a[r + 2] * b[6 + c]))
    })
}

/// Sum of the squares of all entries.
#[inline(always)]
pub(crate) fn norm_squared<L: Lanes>(m: &Matrix<L>) -> L {
    m.iter().fold(L::zero(), |sum, x| x.fma(*x, sum))
}

/// Transposed inverse times the determinant.
#[inline(always)]
fn cofactor<L: Lanes>(f: &Matrix<L>) -> Matrix<L> {
    let minor = |a: usize, b: usize, c: usize, d: usize| f[b].fnma(f[c], f[a] * f[d]);
    [
        minor(4, 5, 7, 8),
        minor(5, 3, 8, 6),
        minor(3, 4, 6, 7),
        minor(7, 8, 1, 2),
        minor(8, 6, 2, 0),
        minor(6, 7, 0, 1),
        minor(1, 2, 4, 5),
        minor(2, 0, 5, 3),
        minor(0, 1, 3, 4),
    ]
}

/// `1 / x`, for `x > 0`.
#[inline(always)]
pub(crate) fn inverse<L: Lanes>(x: L) -> L {
    let root = x.rsqrt();
    root * root
}

/// `j^(-2/3)`, for `j` from 0.6 to 1.7: as the function for one particle.
#[inline(always)]
pub(crate) fn inverse_two_thirds<L: Lanes>(j: L) -> L {
    let of = |x: f64| L::constant(x);
    let t = j * j;
    let mut y = (of(2.0) + t) * inverse(t.fma(of(2.0), of(1.0)));
    for _ in 0..2 {
        let e = (t * y).fnma(y * y, of(1.0));
        y = (y * e).fma(e.fma(e.fma(of(14.0 / 81.0), of(2.0 / 9.0)), of(1.0 / 3.0)), y);
    }
    y
}

/// Writes the sums and the correction of particle `k` of a block.
#[inline(always)]
pub(crate) fn show(own: &mut [BlockColumn; OWN], k: usize, sums: &[f64], correction: &[f64; 6]) {
    for (column, x) in own.iter_mut().zip(sums[..CORRECTION].iter().chain(correction)) {
        column[k] = *x;
    }
}

/// Displacement gradient, and what the force reads, of particle `k` of a block.
#[inline(always)]
pub(crate) fn found(out: &[BlockColumn; OUT], k: usize) -> (DMat3, DMat3) {
    let matrix = |first: usize| {
        let column = |c: usize| DVec3::new(out[first + c][k], out[first + 3 + c][k], out[first + 6 + c][k]);
        DMat3::from_cols(column(0), column(1), column(2))
    };
    (matrix(0), matrix(FORCE))
}

/// Columns of one block, as if all its particles were in the reference configuration.
pub(crate) fn blank<const K: usize>() -> [BlockColumn; K] {
    [[0.0; BLOCK]; K]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mat3::{from_rows, full};
    use crate::material::{NeoHookean, SaintVenantKirchhoff};
    use vaso_kernels::{Isa, Sym3, sweep_points};

    fn agrees(material: impl Elastic) {
        let constants =
            Constants { gradient_scale: 0.7, damping_scale: 0.0, rate: 0.0, viscosity: 0.0, hourglass: 3.0 };
        let law = Stress { material, constants: &constants };
        let sums = [0.1, -0.05, 0.02, 0.04, -0.12, 0.03, 0.01, 0.06, 0.2];
        let b = Sym3([1.1, 0.95, 1.02, 0.03, -0.02, 0.05]);
        let mut own = blank();
        (0..BLOCK).for_each(|k| show(&mut own, k, &sums, &b.0));
        let gradient = from_rows(&sums, 0.7) * full(&b);
        let f = DMat3::IDENTITY + gradient;
        let expected = material.stress(&f, &Default::default()) * full(&b) - 1.5 * gradient;
        for isa in Isa::available() {
            let mut out = blank();
            sweep_points(isa, &law, BLOCK, &[], &own, &mut out);
            for k in 0..BLOCK {
                let (g, q) = found(&out, k);
                assert!(g.abs_diff_eq(gradient, 1e-15), "{} {g}", isa.name());
                assert!(
                    q.abs_diff_eq(expected, 1e-13 * material.bulk_modulus()),
                    "{} {q} {expected}",
                    isa.name()
                );
                assert!((out[DETERMINANT][k] - f.determinant()).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn lanes_find_what_one_particle_does() {
        agrees(NeoHookean::new(7.0, 0.45).expect("in range"));
        agrees(SaintVenantKirchhoff::new(7.0, 0.3).expect("in range"));
    }
}
