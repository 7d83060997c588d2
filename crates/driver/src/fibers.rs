//! The fibres of a wall of Holzapfel, Gasser and Ogden: how they lie, and how stiff they make it under its pressure.

use crate::case::Case;
use crate::error::DriverError;
use glam::DVec3;
use vaso_generation::Body;
use vaso_geometry::Centerlines;
use vaso_scene::material::Fibers;

/// Points of the centrelines on the smallest radius.
const POINTS_A_RADIUS: f64 = 10.0;
/// Largest stretch that is looked at: an artery under its pressure has 1.1 to 1.5.
const LARGEST_STRETCH: f64 = 3.0;
/// Bisections: as many as there are digits.
const BISECTIONS: usize = 60;
/// Step of the stretch in derivatives.
const STEP: f64 = 1e-5;

/// Circumferential and axial direction at each particle of a wall.
///
/// # Errors
/// When the vessel has no centrelines.
pub(crate) fn directions(case: &Case, body: &Body) -> Result<Vec<[DVec3; 2]>, DriverError> {
    let Some(lines) = Centerlines::trace(&case.vessel) else {
        return Err(DriverError::input(crate::error::problem(
            &case.scene,
            "wall.material",
            "its fibres lie along the centreline between two openings, and none was found",
            "a vessel whose openings are connected",
            "look at the openings with `vaso check`, or take a material without fibres",
        )));
    };
    let radius = case.vessel.openings.iter().map(|o| o.radius).fold(f64::INFINITY, f64::min);
    let axial = lines.axial_directions(&body.position, &body.normal, radius / POINTS_A_RADIUS);
    Ok(axial.into_iter().zip(&body.normal).map(|(axial, normal)| [normal.cross(axial), axial]).collect())
}

/// What a thin incompressible tube has in place of `E / (1 - nu^2)` \[Pa\] in the law of Moens and Korteweg while it carries a `pressure` \[Pa\]
/// at the load-free `radius` and `thickness` \[m\], its length held: `l d/dl (W'(l) / l)` at the stretch `l` of its circumference.
///
/// As the fibres stiffen, the pulse wave is faster under pressure than at rest.
pub(crate) fn plane_modulus(fibers: &Fibers, pressure: f64, radius: f64, thickness: f64) -> f64 {
    let &Fibers { matrix_modulus, fiber_modulus, fiber_exponent, fiber_dispersion: d, fiber_angle, .. } =
        fibers;
    let along = fiber_angle.cos().powi(2);
    // Pressure times radius over thickness, by the law of Laplace for a volume that stays.
    let load = |l: f64| {
        let (i1, i4) = (l * l + 1.0 + 1.0 / (l * l), l * l * along + 1.0 - along);
        let strain = (d * i1 + (1.0 - 3.0 * d) * i4 - 1.0).max(0.0);
        let rate_i1 = 2.0 * (l - l.powi(-3));
        let fiber = fiber_modulus * strain * (fiber_exponent * strain * strain).exp();
        (0.5 * matrix_modulus * rate_i1 + 2.0 * fiber * (d * rate_i1 + (1.0 - 3.0 * d) * 2.0 * l * along)) / l
    };
    let wanted = pressure.max(0.0) * radius / thickness;
    let (mut low, mut high) = (1.0, LARGEST_STRETCH);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if load(middle) < wanted { low = middle } else { high = middle }
    }
    // Forwards, as fibres are slack below a stretch of one.
    low * (load(low + STEP) - load(low)) / STEP
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tube(fiber_modulus: f64, fiber_angle: f64) -> Fibers {
        Fibers {
            matrix_modulus: 30e3,
            fiber_modulus,
            fiber_exponent: 10.0,
            fiber_dispersion: 0.0,
            fiber_angle,
            poisson_ratio: 0.49,
        }
    }

    /// Without fibres an incompressible neo-Hookean tube has `4 c` at rest, which is `E / (1 - nu^2)`; fibres around it add `8 k1`, and
    /// at 45 degrees a quarter of that.
    #[test]
    fn at_rest_it_is_that_of_linear_theory() {
        let at_rest = |fibers: &Fibers| plane_modulus(fibers, 0.0, 5e-3, 1e-3);
        for (angle, share) in [(0.0_f64, 1.0), (45.0, 0.25), (90.0, 0.0)] {
            let found = at_rest(&tube(20e3, angle.to_radians()));
            let expected = 4.0 * 30e3 + 8.0 * 20e3 * share;
            assert!((found / expected - 1.0).abs() < 1e-3, "{angle}: {found} {expected}");
        }
    }

    #[test]
    fn pressure_stiffens_it_through_the_fibres_only() {
        let ratio = |k1: f64| {
            let under = |p: f64| plane_modulus(&tube(k1, 0.5), p, 5e-3, 1e-3);
            under(10e3) / under(0.0)
        };
        assert!(ratio(0.0) < 1.0 && ratio(20e3) > 2.0, "{} {}", ratio(0.0), ratio(20e3));
    }
}
