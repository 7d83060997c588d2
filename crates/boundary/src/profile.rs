//! Velocity across a cap, with unit mean.

/// Shape of the velocity over the section of an inlet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// The same everywhere.
    Plug,
    /// `2 (1 - s^2)`, where `s` is the distance from the centre as a part of the way to the rim in
    /// that direction: the Poiseuille profile on a disc, of unit mean on any star-shaped cap.
    Parabolic,
}

impl Profile {
    /// Unit-mean velocity at the in-plane point `at`, relative to the cap centre, of the cap with
    /// the closed rim `polygon` (same axes and unit).
    pub fn at(self, at: [f64; 2], polygon: &[[f64; 2]]) -> f64 {
        match self {
            Self::Plug => 1.0,
            Self::Parabolic => {
                let s = radial_fraction(at, polygon);
                2.0 * (1.0 - s * s).max(0.0)
            }
        }
    }

    /// Largest velocity over the mean.
    pub fn peak(self) -> f64 {
        match self {
            Self::Plug => 1.0,
            Self::Parabolic => 2.0,
        }
    }
}

/// Distance of `at` from the origin over that of the rim in the same direction.
///
/// The farthest crossing counts, should a ray cross the rim more than once.
fn radial_fraction(at: [f64; 2], polygon: &[[f64; 2]]) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let mut rim: f64 = 0.0;
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let edge = [b[0] - a[0], b[1] - a[1]];
        let denominator = cross(at, edge);
        if denominator == 0.0 {
            continue;
        }
        // at * t = a + edge * u
        let (t, u) = (cross(a, edge) / denominator, cross(a, at) / denominator);
        if t > 0.0 && (-1e-12..=1.0 + 1e-12).contains(&u) {
            rim = rim.max(t);
        }
    }
    if rim > 0.0 { 1.0 / rim } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ellipse(n: usize) -> Vec<[f64; 2]> {
        (0..n)
            .map(|k| {
                let phi = std::f64::consts::TAU * k as f64 / n as f64;
                [3.0 * phi.cos(), 2.0 * phi.sin()]
            })
            .collect()
    }

    #[test]
    fn a_disc_gives_the_parabola() {
        let disc: Vec<[f64; 2]> = ellipse(2000).iter().map(|p| [p[0] / 3.0, p[1] / 2.0]).collect();
        for r in [0.0, 0.3, 0.7, 0.99] {
            let value = Profile::Parabolic.at([0.6 * r, 0.8 * r], &disc);
            assert!((value - 2.0 * (1.0 - r * r)).abs() < 1e-5, "{value} at {r}");
        }
        assert_eq!(Profile::Parabolic.at([2.0, 0.0], &disc), 0.0);
    }

    #[test]
    fn the_mean_over_an_ellipse_is_one() {
        let rim = ellipse(400);
        let (mut sum, mut inside) = (0.0, 0.0);
        let n = 300;
        for i in 0..n {
            for j in 0..n {
                let at = [
                    -3.0 + 6.0 * (f64::from(i) + 0.5) / f64::from(n),
                    -2.0 + 4.0 * (f64::from(j) + 0.5) / f64::from(n),
                ];
                if (at[0] / 3.0).powi(2) + (at[1] / 2.0).powi(2) < 1.0 {
                    sum += Profile::Parabolic.at(at, &rim);
                    inside += 1.0;
                }
            }
        }
        assert!((sum / inside - 1.0).abs() < 1e-3, "{}", sum / inside);
    }
}
