//! `vaso tune`: Windkessel parameters from what a clinic measures, ready to paste.

use crate::case::Case;
use crate::error::{DriverError, problem};
use crate::plan::Plan;
use crate::start;
use std::fmt::Write;
use vaso_boundary::{Split, Target, Tuned};

/// Pascals of a millimetre of mercury.
pub(crate) const MMHG: f64 = 133.322_387_415;

/// What the outlets of a case are to give.
pub struct TuneRequest {
    /// Highest pressure of the cycle \[Pa\].
    pub systolic: f64,
    /// Lowest pressure of the cycle \[Pa\].
    pub diastolic: f64,
    /// Pressure behind the outlets \[Pa\].
    pub distal_pressure: f64,
    /// Speed of pulse waves in the vessels behind \[m/s\].
    pub wave_speed: f64,
    /// How the flow parts.
    pub split: Split,
}

/// Blocks of `case.toml` for the openings of `case` that are no inlets: Windkessels that reach the pressures asked for under
/// the case's inflow. Each is run to its periodic cycle without a vessel, and what that gives stands beside it.
///
/// # Errors
/// When the case is wrong, its inflow does not pulse periodically, or the pressures cannot be reached.
pub fn tune(case: &Case, request: &TuneRequest) -> Result<String, DriverError> {
    let file = case.scene.file.display();
    let plan = Plan::new(case)?;
    let inflow = start::inflow(&plan.openings).ok_or_else(|| {
        DriverError::input(problem(
            &case.scene,
            "run.period",
            "tuning needs one inlet whose `waveform` repeats: the pulse is what sets the compliance",
            "one inlet with condition \"velocity\" or \"flow\" and a `waveform`",
            "give the inlet a waveform, and `run.period` with it",
        ))
    })?;
    let outlets: Vec<_> = plan.openings.iter().filter(|o| o.condition.sets_pressure()).collect();
    let areas: Vec<f64> = outlets.iter().map(|o| o.opening.area).collect();
    let target = Target {
        systolic: request.systolic,
        diastolic: request.diastolic,
        distal_pressure: request.distal_pressure,
        split: request.split.clone(),
        wave_speed: request.wave_speed,
        density: plan.numbers.rest_density,
    };
    let tuned = vaso_boundary::tune(&inflow, &areas, &target)
        .map_err(|e| DriverError::input(format!("{file}: {e}")))?;
    let mut text = format!("# mean inflow {:.4e} m^3/s\n", inflow.mean());
    for (outlet, Tuned { fraction, model, cycle }) in outlets.iter().zip(&tuned) {
        let near = case.scene.openings.iter().find(|o| o.name == outlet.name).map_or([0.0; 3], |o| o.near);
        let [systolic, diastolic, mean] = [cycle.systolic, cycle.diastolic, cycle.mean].map(|p| p / MMHG);
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n# {:.1} % of the flow, {systolic:.1}/{diastolic:.1} mmHg, mean {mean:.1} mmHg\n\
             [[opening]]\n\
             name = \"{}\"\n\
             near = {near:?}\n\
             condition = \"windkessel\"\n\
             proximal_resistance = \"{:.6e} Pa s/m^3\"\n\
             distal_resistance = \"{:.6e} Pa s/m^3\"\n\
             compliance = \"{:.6e} m^3/Pa\"\n\
             distal_pressure = \"{} Pa\"\n\
             periodic_start = true\n",
            100.0 * fraction,
            outlet.name,
            model.proximal_resistance,
            model.distal_resistance,
            model.compliance,
            model.distal_pressure,
        );
    }
    Ok(text)
}
