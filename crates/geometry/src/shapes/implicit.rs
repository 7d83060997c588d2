//! Walls that are the zero of a function.

use glam::DVec3;

/// Bound on the steps of [`Implicit::project`]; two or three are enough off the creases.
const MAX_NEWTON_STEPS: usize = 6;

/// A wall as the zero of a function of slope about one, negative inside.
pub(super) trait Implicit: Sync {
    /// The function.
    fn field(&self, x: DVec3) -> f64;

    /// A length far below which the wall has no features.
    fn scale(&self) -> f64;

    /// The wall point nearest to a point close to the wall, by Newton steps along the gradient.
    fn project(&self, mut x: DVec3) -> DVec3 {
        let step = 1e-5 * self.scale();
        for _ in 0..MAX_NEWTON_STEPS {
            let value = self.field(x);
            if value.abs() < 1e-9 * self.scale() {
                break;
            }
            let slope =
                DVec3::AXES.map(|e| (self.field(x + step * e) - self.field(x - step * e)) / (2.0 * step));
            let gradient = DVec3::from(slope);
            x -= value / gradient.length_squared().max(0.25) * gradient;
        }
        x
    }
}

/// Minimum of two distances (with their gradients), rounded off where they are closer than the blend.
///
/// The blend shrinks with the angle between the walls: side by side, where two tubes run into each other,
/// rounding would only swell the surface.
pub(super) fn union(blend: f64, (a, outward_a): (f64, DVec3), (b, outward_b): (f64, DVec3)) -> f64 {
    let blend = 0.5 * (1.0 - outward_a.dot(outward_b)) * blend;
    let overlap = if blend > 0.0 { (1.0 - (a - b).abs() / blend).max(0.0) } else { 0.0 };
    a.min(b) - 0.25 * blend * overlap * overlap
}
