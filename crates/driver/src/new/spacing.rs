//! A spacing that resolves the narrowest opening as far as minutes allow.

use crate::error::DriverError;
use crate::plan::Plan;
use crate::print::{duration, length};

/// Computing time a first run may take \[core s\]: five minutes on two cores.
const BUDGET: f64 = 600.0;
/// Particles across the narrowest opening that are never undercut: fewer are hardly a flow.
const FEWEST: f64 = 3.0;
/// Particles across it that no first run needs to exceed: wall shear stress is right from there on.
const ENOUGH: f64 = 20.0;

/// A spacing and what it buys.
pub(super) struct Chosen {
    /// Distance between particles \[mm\], of two digits.
    pub(super) millimetres: f64,
    /// Particles across the narrowest opening.
    pub(super) across: f64,
    /// Why not less, in words.
    pub(super) reason: String,
}

/// Chooses for a narrowest opening of `radius` \[m\]; `plan` plans the case for a spacing in millimetres.
///
/// # Errors
/// Those of `plan`.
pub(super) fn choose(
    radius: f64,
    plan: impl Fn(f64) -> Result<Plan, DriverError>,
) -> Result<Chosen, DriverError> {
    let width = 2e3 * radius;
    let tried = width / 8.0;
    let core_seconds = cost(&plan(tried)?);
    // Particles go with the third power of the spacing, steps with the first.
    let affordable = tried * (core_seconds / BUDGET).powf(0.25);
    let [fine, coarse] = [ENOUGH, FEWEST].map(|count| width / count);
    let millimetres = two_digits(affordable.clamp(fine, coarse));
    let across = width / millimetres;
    let reason = if affordable <= fine {
        "enough for the wall shear stress at the narrowest opening".to_owned()
    } else if affordable < coarse {
        format!("what about {} on two cores allow", duration(0.5 * BUDGET))
    } else {
        format!(
            "the coarsest that still fits {FEWEST} particles into {}; closing the narrowest openings makes the run shorter",
            length(2.0 * radius)
        )
    };
    Ok(Chosen { millimetres, across, reason })
}

/// Predicted time of a run on one core \[s\].
fn cost(plan: &Plan) -> f64 {
    plan.predicted.wall_clock_s * rayon::current_num_threads() as f64
}

/// The number of two digits next to a positive one, downwards so that no bound is overstepped.
fn two_digits(value: f64) -> f64 {
    let exponent = value.log10().floor() as i32 - 1;
    // Through text, as powers of ten below one are no doubles.
    let digits = (value / 10f64.powi(exponent) * (1.0 + 1e-9)).floor();
    format!("{digits}e{exponent}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::two_digits;

    #[test]
    fn spacings_have_two_digits() {
        assert_eq!(two_digits(0.4567), 0.45);
        assert_eq!(two_digits(0.45), 0.45);
        assert_eq!(two_digits(12.99), 12.0);
        assert_eq!(two_digits(0.00999), 0.0099);
    }
}
