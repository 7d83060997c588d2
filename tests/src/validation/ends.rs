//! Pressure near the caps of a pipe.

use super::measure::{Flown, Line, fly};
use super::{Case, Outcome, Tolerance, Unit};
use crate::pipe::Pipe;

/// The case of the page.
pub const CASE: Case = Case {
    name: "ends",
    title: "Pressure near the caps",
    setup: "The pipe at Reynolds number 100, four diameters long: velocity inlet with a parabola, pressure outlet, 0.9 s from \
            rest, mean of the last quarter over sections a spacing long. A straight line is fitted between one diameter from \
            each end.",
    reference: "The line itself: in developed flow the pressure falls evenly up to the caps.",
    remark: "A prototype of the same scheme was 0.4 to 0.6 rho U^2 off in the inlet buffer, and the pressure fell by \
             0.03 rho U^2 too much before the outlet; half of either is asked for. Two causes were found, see \
             docs/theory/openings.md, near a cap.",
    quick: Some(|| run(&[10.0], Tolerance::Held(0.025))),
    full: || run(&[10.0, 16.0], Tolerance::Asked(0.015)),
};

/// Mean velocity at Reynolds number 100 \[m/s\].
pub(super) fn mean_velocity(pipe: &Pipe) -> f64 {
    100.0 * pipe.viscosity / (pipe.density * pipe.diameter)
}

fn run(ladder: &[f64], outlet: Tolerance) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    for (k, &across) in ladder.iter().enumerate() {
        let mut pipe = Pipe::published(across);
        pipe.length = 4.0 * pipe.diameter;
        pipe.end_time = 0.9;
        let mean = mean_velocity(&pipe);
        pipe.inlet = format!(
            "condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"{mean} m/s\"\nramp = \"100 ms\""
        );
        pipe.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
        let (along, flown) = pressure_along(&pipe);
        outcome.cost(&flown);
        let scale = pipe.density * (2.0 * mean).powi(2);
        let mut line = Line::default();
        let inner = pipe.diameter..pipe.length - pipe.diameter;
        along.iter().filter(|p| inner.contains(&p.0)).for_each(|&(z, p)| line.add(z, p));
        let buffer = along.iter().take_while(|p| p.0 < 4.0 * pipe.spacing());
        let largest = buffer.map(|&(z, p)| ((p - line.at(z)) / scale).abs()).fold(0.0, f64::max);
        let number = |outcome: &mut Outcome, what: &str, error, tolerance| {
            outcome.figure(format!("D/{across}: {what}"), error, Unit::Number, tolerance);
        };
        number(
            &mut outcome,
            "largest difference from the line in the inlet buffer, over rho U^2",
            largest,
            Tolerance::Asked(0.2),
        );
        let last = k + 1 == ladder.len();
        number(
            &mut outcome,
            "the line at the outlet cap less the pressure there, over rho U^2",
            line.at(pipe.length) / scale,
            if last { outlet } else { Tolerance::Held(0.025) },
        );
    }
    Some(outcome)
}

/// Mean pressure \[Pa\] over the last quarter of the run at distances from the inlet \[m\].
fn pressure_along(pipe: &Pipe) -> (Vec<(f64, f64)>, Flown) {
    let n = (pipe.length / pipe.spacing()).round() as usize;
    let mut sums = vec![(0.0, 0.0_f64); n];
    let flown = fly(pipe, |flow, plan| {
        if flow.time < 0.75 * plan.end_time {
            return;
        }
        for (i, &x) in flow.fluid.state.position.iter().enumerate() {
            let (z, _) = pipe.place(x);
            if let Some(sum) = sums.get_mut((z / pipe.length * n as f64) as usize) {
                *sum = (sum.0 + flow.fluid.pressure(i), sum.1 + 1.0);
            }
        }
    });
    let place = |k: usize| (k as f64 + 0.5) * pipe.length / n as f64;
    (sums.iter().enumerate().map(|(k, s)| (place(k), s.0 / s.1)).collect(), flown)
}
