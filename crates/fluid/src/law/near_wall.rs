//! How the velocity goes near the wall: a parabola in the distance, through the velocity of the wall.

use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Number of sums.
pub const SUMS: usize = 10;

/// Normal equations of `v - v_w ~ a s + b s^2` over the neighbours that lie near the wall.
///
/// The record's scalar is the distance `s` from the wall in supports, zero for particles away from it, which then do not count.
/// With `w = V u^4 (5 - 4u)` the sums are `w s`, `w s^2`, `w s^3`, `w s^4`, and of `v` times `w s` in `[4..7]` and times `w s^2` in
/// `[7..10]`.
pub struct NearWall;

impl<R: Real> PairLaw<R, SUMS> for NearWall {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _own: &Own<L>, p: &Pair<L>, sums: &mut [L; SUMS]) {
        let u2 = p.u * p.u;
        let weight = u2 * u2 * p.u.fnma(L::constant(4.0), L::constant(5.0)) * p.volume;
        let first = weight * p.scalar;
        let second = first * p.scalar;
        sums[0] = sums[0] + first;
        sums[1] = sums[1] + second;
        sums[2] = second.fma(p.scalar, sums[2]);
        sums[3] = (second * p.scalar).fma(p.scalar, sums[3]);
        super::add_scaled(sums, 4, first, p.velocity);
        super::add_scaled(sums, 7, second, p.velocity);
    }
}

/// Adds the particle itself, which its row leaves out: at distance `s` \[supports\], of volume `volume` and velocity `v`.
pub fn add_own(sums: &mut [f64; SUMS], s: f64, volume: f64, v: [f64; 3]) {
    // u = 1, so u^4 (5 - 4u) = 1.
    let weight = volume;
    let powers = [s, s * s, s * s * s, s * s * s * s];
    for (sum, power) in sums.iter_mut().zip(powers) {
        *sum += weight * power;
    }
    for k in 0..3 {
        sums[4 + k] += weight * powers[0] * v[k];
        sums[7 + k] += weight * powers[1] * v[k];
    }
}

/// The coefficient `b` of [`NearWall`] by its sums, for a wall of velocity `wall`; velocity over squared supports. Zero where all
/// neighbours are about equally far from the wall, which tells nothing of a parabola.
pub fn curvature(sums: &[f64; SUMS], wall: [f64; 3]) -> [f64; 3] {
    let [s1, s2, s3, s4, ..] = *sums;
    let determinant = s2 * s4 - s3 * s3;
    if determinant <= LEAST_SPREAD * s2 * s4 {
        return [0.0; 3];
    }
    std::array::from_fn(|k| {
        let (first, second) = (sums[4 + k] - wall[k] * s1, sums[7 + k] - wall[k] * s2);
        (s2 * second - s3 * first) / determinant
    })
}

/// Determinant of the normal equations, over the product of their diagonal, below which `b` is not told: that of distances
/// spread by about a tenth of their mean. Particles of a first and a second layer give 0.2.
const LEAST_SPREAD: f64 = 0.01;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_found_along_a_wall_that_moves() {
        let wall = [0.3, -0.1, 0.0];
        let mut sums = [0.0; SUMS];
        for (k, s) in [0.2, 0.25, 0.6, 0.9].into_iter().enumerate() {
            let v = std::array::from_fn(|q| wall[q] + 2.0 * s - (q as f64 + 1.0) * s * s);
            add_own(&mut sums, s, 1.0 + 0.1 * k as f64, v);
        }
        let b = curvature(&sums, wall);
        for (q, b) in b.into_iter().enumerate() {
            assert!((b + q as f64 + 1.0).abs() < 1e-12, "{b}");
        }
    }

    #[test]
    fn the_particle_itself_weighs_its_volume() {
        let mut sums = [0.0; SUMS];
        add_own(&mut sums, 0.5, 2.0, [1.0, 0.0, 0.0]);
        assert_eq!(sums[..4], [1.0, 0.5, 0.25, 0.125]);
        assert_eq!((sums[4], sums[7]), (1.0, 0.5));
    }

    #[test]
    fn one_layer_tells_no_parabola() {
        let mut sums = [0.0; SUMS];
        add_own(&mut sums, 0.2, 1.0, [1.0; 3]);
        add_own(&mut sums, 0.201, 1.0, [1.1; 3]);
        assert_eq!(curvature(&sums, [0.0; 3]), [0.0; 3]);
    }
}
