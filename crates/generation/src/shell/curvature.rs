//! Normals smoothed over the particles of a sheet, and the curvature they tell.

use crate::shell::{
    plane_kernel::PlaneKernel,
    relax::Listed,
    sheet::{Foot, same_sheet},
};
use glam::{DMat2, DVec2, DVec3};

/// Passes of smoothing.
const PASSES: usize = 3;
/// Determinant of the moments of the neighbours over the square of half their trace below which they lie on a
/// line: one is a circle, zero a line.
const ON_A_LINE: f64 = 1e-3;

/// Replaces the normals by smoothed ones and returns the principal curvatures, the larger first \[1/m\]:
/// positive where the normals spread, as on a tube seen from inside.
pub(crate) fn smooth(particles: &mut [Foot], listed: &Listed, kernel: &PlaneKernel) -> Vec<[f64; 2]> {
    for _ in 0..PASSES {
        let fitted = listed.map(|i, row| fit(i, row, particles, kernel).0);
        for (foot, normal) in particles.iter_mut().zip(fitted) {
            foot.normal = normal;
        }
    }
    listed.map(|i, row| fit(i, row, particles, kernel).1)
}

/// Least curvature \[1/m\] from each particle towards one that is closer than `reach` \[m\]: how much the normals spread along the way.
pub(crate) fn sharpest(particles: &[Foot], listed: &Listed, reach: f64) -> Vec<f64> {
    listed.map(|i, row| {
        let own = &particles[i];
        let others = row.iter().map(|&j| &particles[j as usize]).filter_map(|other| {
            let away = other.point - own.point;
            let square = away.length_squared();
            (square > 0.0 && square < reach * reach && same_sheet(own.normal, other.normal))
                .then(|| (other.normal - own.normal).dot(away) / square)
        });
        others.fold(0.0, f64::min)
    })
}

/// Normal and principal curvatures at particle `i` by a linear fit of the normals of those it sees.
///
/// A fit, not a mean: by a rim a mean leans towards the side where the neighbours are. On a sphere or a
/// cylinder the normal is a linear function of the place, so both are exact there.
fn fit(i: usize, row: &[u32], particles: &[Foot], kernel: &PlaneKernel) -> (DVec3, [f64; 2]) {
    let own = &particles[i];
    let first = own.normal.any_orthonormal_vector();
    let axes = [first, own.normal.cross(first)];
    let seen = || {
        row.iter().copied().chain([i as u32]).filter_map(|j| {
            let other = &particles[j as usize];
            let away = other.point - own.point;
            let weight = kernel.value(away.length());
            (weight > 0.0 && same_sheet(own.normal, other.normal))
                .then(|| (weight, DVec2::new(away.dot(axes[0]), away.dot(axes[1])), other.normal))
        })
    };
    let total: f64 = seen().map(|(w, ..)| w).sum();
    let place = seen().map(|(w, x, _)| w * x).sum::<DVec2>() / total;
    let mean = seen().map(|(w, _, n)| w * n).sum::<DVec3>() / total;
    // Moments of the places, and of normals with places.
    let mut moments = DMat2::ZERO;
    let mut slope = [DVec3::ZERO; 2];
    for (w, x, n) in seen() {
        let x = x - place;
        moments += w * DMat2::from_cols(x.x * x, x.y * x);
        slope[0] += w * x.x * n;
        slope[1] += w * x.y * n;
    }
    let half_trace = 0.5 * (moments.x_axis.x + moments.y_axis.y);
    if moments.determinant() <= ON_A_LINE * half_trace * half_trace {
        return (mean.normalize_or(own.normal), [0.0; 2]);
    }
    let inverse = moments.inverse();
    let slope = [inverse.x_axis, inverse.y_axis].map(|column| column.x * slope[0] + column.y * slope[1]);
    let normal = (mean - place.x * slope[0] - place.y * slope[1]).normalize_or(own.normal);
    (normal, principal(slope.map(|s| DVec2::new(s.dot(axes[0]), s.dot(axes[1])))))
}

/// Eigenvalues of the symmetric part of a gradient given by its columns, the larger first.
fn principal([a, b]: [DVec2; 2]) -> [f64; 2] {
    let mean = 0.5 * (a.x + b.y);
    let spread = (0.5 * (a.x - b.y)).hypot(0.5 * (a.y + b.x));
    [mean + spread, mean - spread]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_values_of_a_turned_saddle() {
        // diag(3, -1) turned by half a radian.
        let turn = DMat2::from_angle(0.5);
        let m = turn * DMat2::from_diagonal(DVec2::new(3.0, -1.0)) * turn.transpose();
        let [large, small] = principal([m.x_axis, m.y_axis]);
        assert!((large - 3.0).abs() < 1e-14 && (small + 1.0).abs() < 1e-14);
    }
}
