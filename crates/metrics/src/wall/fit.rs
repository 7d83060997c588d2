//! The velocity gradient at one point of the wall, by constrained moving least squares.

use crate::wall::near::NearParticle;
use glam::DVec3;

/// Functions of the fit: s, s^2, s xi, s eta.
pub(super) const TERMS: usize = 4;
/// Weight of the curvature and of the tangential terms in the sum that is made smallest: small enough not to be felt where
/// particles determine them, large enough to make them zero where none do.
const RIDGE: f64 = 1e-6;
/// Fewest particles for a value.
pub(crate) const FEWEST: usize = 8;
/// Smallest cosine between the normals under a particle and at the point for both to be of one sheet of the wall.
const SAME_SHEET: f64 = 0.5;
/// Depth \[spacings\] by which the nearest particle must be found: beyond it the gradient would be extrapolated.
const SHALLOWEST: f64 = 1.5;
/// Largest bound of the error of the gradient \[1/spacing\] for independent errors of one in the velocities. Measured in a pipe,
/// the bound is 2.2 among relaxed particles and up to 4 among disordered ones, the error itself 1.3 and 1.5.
const MAX_NOISE: f64 = 5.0;

/// A point of the wall, with what the fit needs of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FitPoint {
    /// Position \[m\].
    pub(crate) position: DVec3,
    /// Unit normal out of the lumen.
    pub(crate) normal: DVec3,
    /// Spacing of the particles \[m\].
    pub(crate) spacing: f64,
}

/// Sums over the particles about a point of the wall.
///
/// Fitted is `v = a s + b s^2 + s (c xi + d eta)`, so that v is zero on the wall: s is the distance from the wall and xi, eta
/// the tangential coordinates of the nearest point of the wall. A curved wall then looks flat, and the parabola of a pipe
/// flow is met exactly.
pub(crate) struct Fit {
    point: FitPoint,
    tangent: [DVec3; 2],
    matrix: [[f64; TERMS]; TERMS],
    /// Sums of weight, function and velocity, for each component of the latter.
    velocity: [[f64; TERMS]; 3],
    n: usize,
    shallowest: f64,
}

impl Fit {
    pub(crate) fn new(point: FitPoint) -> Self {
        let first = point.normal.any_orthonormal_vector();
        Self {
            point,
            tangent: [first, point.normal.cross(first)],
            matrix: [[0.0; TERMS]; TERMS],
            velocity: [[0.0; TERMS]; 3],
            n: 0,
            shallowest: f64::INFINITY,
        }
    }

    /// Adds a particle at a squared distance \[m^2\] below that of the `support` \[m\]; `carried` is the velocity \[m/s\] the wall
    /// would give the fluid there. Gives the weight and the depth \[spacings\] it counts with, if it does.
    #[inline]
    pub(crate) fn add(
        &mut self,
        particle: &NearParticle,
        squared: f64,
        support: f64,
        carried: DVec3,
    ) -> Option<(f64, f64)> {
        let aligned = particle.normal.dot(self.point.normal);
        if aligned < SAME_SHEET {
            return None;
        }
        let u = 1.0 - squared.sqrt() / support;
        let (scale, square) = (self.point.spacing.recip(), u * u);
        let weight = square * square * (5.0 - 4.0 * u);
        // Foot of the particle: without it a wall seen slantwise would be mistaken for a deeper one.
        let foot = particle.position + particle.depth * particle.normal - self.point.position;
        let s = scale * particle.depth;
        let f = [s, s * s, s * scale * foot.dot(self.tangent[0]), s * scale * foot.dot(self.tangent[1])];
        // Turned with the normal, so that a flow that follows the bend of the wall counts as straight. What is left of the
        // normal component lies along the normal and is taken away at the end.
        let relative = particle.velocity - carried;
        let both = particle.normal + self.point.normal;
        let turned = relative - both.dot(relative) / (1.0 + aligned) * both;
        let weighted = f.map(|f| weight * f);
        for (row, w) in self.matrix.iter_mut().zip(weighted) {
            for (sum, f) in row.iter_mut().zip(f) {
                *sum += w * f;
            }
        }
        for (row, v) in self.velocity.iter_mut().zip(turned.to_array()) {
            for (sum, w) in row.iter_mut().zip(weighted) {
                *sum += w * v;
            }
        }
        self.n += 1;
        self.shallowest = self.shallowest.min(s);
        Some((weight, s))
    }

    /// Derivative of the tangential velocity with the distance from the wall, at the wall \[1/s\]; `None` where the
    /// particles do not determine it.
    pub(crate) fn shear(&self) -> Option<DVec3> {
        if self.n < FEWEST || self.shallowest > SHALLOWEST {
            return None;
        }
        let mut matrix = self.matrix;
        for k in 1..TERMS {
            matrix[k][k] += RIDGE * self.matrix[0][0];
        }
        let row = first_row_of_inverse(matrix)?;
        // With weights below one this bounds the sum of squares of the factors of all velocities.
        if row[0] > MAX_NOISE * MAX_NOISE {
            return None;
        }
        let gradient = DVec3::from_array(
            self.velocity.map(|sums| row.iter().zip(sums).map(|(share, sum)| share * sum).sum()),
        );
        let normal = self.point.normal;
        Some((gradient - gradient.dot(normal) * normal) / self.point.spacing)
    }
}

/// A number of the particles as a straight line over their depth.
pub(crate) struct Line {
    sums: [f64; 5],
    range: (f64, f64),
}

impl Line {
    pub(crate) fn new() -> Self {
        Self { sums: [0.0; 5], range: (f64::INFINITY, f64::NEG_INFINITY) }
    }

    /// Adds the value of a particle of the given weight and depth.
    pub(crate) fn add(&mut self, (weight, s): (f64, f64), value: f64) {
        for (sum, term) in self.sums.iter_mut().zip([1.0, s, s * s, value, s * value]) {
            *sum += weight * term;
        }
        self.range = (self.range.0.min(value), self.range.1.max(value));
    }

    /// The value at the wall, within the range it has among the particles; there must be one.
    pub(crate) fn at_wall(&self) -> f64 {
        let [w, s, ss, v, sv] = self.sums;
        let determinant = w * ss - s * s;
        let value = if determinant > 1e-6 * w * ss { (ss * v - s * sv) / determinant } else { v / w };
        value.clamp(self.range.0, self.range.1)
    }
}

/// First row of the inverse of a symmetric matrix given by its lower half, by Cholesky; `None` where it has none.
pub(super) fn first_row_of_inverse(matrix: [[f64; TERMS]; TERMS]) -> Option<[f64; TERMS]> {
    let mut l = [[0.0; TERMS]; TERMS];
    for i in 0..TERMS {
        for j in 0..=i {
            let rest = matrix[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
            if i == j {
                if rest <= 1e-12 * matrix[i][i] || rest <= 0.0 {
                    return None;
                }
                l[i][i] = rest.sqrt();
            } else {
                l[i][j] = rest / l[j][j];
            }
        }
    }
    let mut row = [0.0; TERMS];
    for i in 0..TERMS {
        let unit = if i == 0 { 1.0 } else { 0.0 };
        row[i] = (unit - (0..i).map(|k| l[i][k] * row[k]).sum::<f64>()) / l[i][i];
    }
    for i in (0..TERMS).rev() {
        row[i] = (row[i] - (i + 1..TERMS).map(|k| l[k][i] * row[k]).sum::<f64>()) / l[i][i];
    }
    Some(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_row_solves_the_system() {
        let matrix =
            [[4.0, 0.0, 0.0, 0.0], [1.0, 3.0, 0.0, 0.0], [0.5, -0.2, 2.0, 0.0], [0.1, 0.3, -0.4, 1.5]];
        let row = first_row_of_inverse(matrix).expect("diagonally dominant");
        for i in 0..TERMS {
            let full = |j: usize| if j <= i { matrix[i][j] } else { matrix[j][i] };
            let product: f64 = (0..TERMS).map(|j| full(j) * row[j]).sum();
            assert!((product - if i == 0 { 1.0 } else { 0.0 }).abs() < 1e-14);
        }
        assert_eq!(first_row_of_inverse([[1.0; TERMS]; TERMS]), None);
    }
}
