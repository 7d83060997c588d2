//! Integrals over a straight piece between two samples, exact.

use glam::DVec3;

/// Mean magnitude of a vector that goes from `a` to `b` in a straight line, evenly in time.
///
/// The magnitude is the square root of a parabola: with the part of the way `u` measured from the point nearest to zero, at
/// distance `k`, its integral is `(u sqrt(u^2 + k^2) + k^2 asinh(u/k)) / 2`.
pub(super) fn mean_magnitude(a: DVec3, b: DVec3) -> f64 {
    let way = b - a;
    let length = way.length();
    let largest = a.length().max(b.length());
    // Where the way is short the closed form would subtract almost equal numbers; Simpson's rule is exact to its fourth power.
    if length <= 1e-3 * largest {
        return (a.length() + 4.0 * (0.5 * (a + b)).length() + b.length()) / 6.0;
    }
    let along = way / length;
    let (first, last) = (a.dot(along), b.dot(along));
    let nearest = (a - first * along).length();
    let antiderivative = |u: f64| {
        let log = if nearest > 1e-12 * largest { nearest * nearest * (u / nearest).asinh() } else { 0.0 };
        0.5 * (u * u.hypot(nearest) + log)
    };
    (antiderivative(last) - antiderivative(first)) / length
}

/// Mean of `|a + (b - a) u|` over `u` from 0 to 1.
pub(super) fn mean_absolute(a: f64, b: f64) -> f64 {
    if a * b >= 0.0 { 0.5 * (a + b).abs() } else { 0.5 * (a * a + b * b) / (a.abs() + b.abs()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_match_fine_sums() {
        let n = 200_000;
        let pairs = [
            (DVec3::new(1.0, 0.0, 0.0), DVec3::new(-2.0, 0.0, 0.0)),
            (DVec3::new(1.0, 2.0, -0.5), DVec3::new(-0.3, 0.2, 0.7)),
            (DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 2.0, 3.0)),
            (DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0005, 2.0, 2.999)),
            (DVec3::ZERO, DVec3::new(0.0, 3.0, 4.0)),
        ];
        for (a, b) in pairs {
            let sum: f64 =
                (0..n).map(|k| a.lerp(b, (f64::from(k) + 0.5) / f64::from(n)).length()).sum::<f64>();
            let exact = sum / f64::from(n);
            assert!((mean_magnitude(a, b) - exact).abs() < 1e-9, "{a} to {b}");
        }
        assert_eq!(mean_absolute(1.0, -1.0), 0.5);
        assert_eq!(mean_absolute(-1.0, -3.0), 2.0);
        assert!((mean_absolute(2.0, -1.0) - 2.5 / 3.0).abs() < 1e-15);
    }
}
