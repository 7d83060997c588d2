//! Elliptic smoothing of a face: the coordinates of the block become harmonic on the face.

use super::tfi::Grid;
use glam::DVec2;

/// Moves the inner nodes of a face towards the solution of Winslow's equations (Thompson, Warsi and Mastin
/// 1985), `sweeps` times over; the border stays.
///
/// ```text
/// alpha x_uu - 2 beta x_uv + gamma x_vv = 0,   alpha = |x_v|^2, beta = x_u . x_v, gamma = |x_u|^2
/// ```
pub(super) fn smooth(face: &mut Grid<DVec2>, sweeps: usize) {
    let [ni, nj, _] = face.cells();
    for _ in 0..sweeps {
        for j in 1..nj {
            for i in 1..ni {
                let at =
                    |di: isize, dj: isize| face.at(i.wrapping_add_signed(di), j.wrapping_add_signed(dj), 0);
                let along_u = 0.5 * (at(1, 0) - at(-1, 0));
                let along_v = 0.5 * (at(0, 1) - at(0, -1));
                let mixed = 0.25 * (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1));
                let (alpha, gamma) = (along_v.length_squared(), along_u.length_squared());
                let beta = along_u.dot(along_v);
                let sum = alpha * (at(1, 0) + at(-1, 0)) + gamma * (at(0, 1) + at(0, -1));
                let weight = 2.0 * (alpha + gamma);
                if weight > 0.0 {
                    face.set(i, j, 0, (sum - 2.0 * beta * mixed) / weight);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coordinates of a conformal map, here the square of a complex number, are harmonic: its nodes solve
    /// the equations up to the error of the differences, of second order.
    #[test]
    fn a_conformal_block_comes_back_to_second_order() {
        let map = |u: f64, v: f64| DVec2::new(u * u - v * v, 2.0 * u * v);
        let error = |n: usize| {
            let exact = |i: usize, j: usize| map(1.0 + i as f64 / n as f64, j as f64 / n as f64);
            let mut face = Grid::new([n, n, 0], |i, j, _| {
                let is_border = i == 0 || j == 0 || i == n || j == n;
                exact(i, j) + if is_border { DVec2::ZERO } else { DVec2::splat(0.3 / n as f64) }
            });
            smooth(&mut face, 40 * n);
            let all = (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j)));
            all.map(|(i, j)| face.at(i, j, 0).distance(exact(i, j))).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(8), error(16));
        // Second differences of a quadratic map are exact, so only the iteration is left.
        assert!(coarse < 1e-6 && fine < 1e-6, "{coarse} {fine}");
    }
}
