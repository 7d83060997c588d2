//! Shear-thinning blood in a pipe.

use vaso_fluid::Rheology;

use super::measure::fly;
use super::{Case, Outcome, Tolerance, Unit};
use crate::pipe::Pipe;
use crate::shear_thinning::Developed;

/// The case of the page.
pub const CASE: Case = Case {
    name: "shear-thinning",
    title: "Carreau-Yasuda and Casson blood",
    setup: "Pipe of 6.35 mm, five diameters long, mean velocity 20 mm/s, at which the viscosity varies fourfold over the \
            section; parabolic inlet, pressure outlet, D/12, 1.2 s from rest. Velocity between three and four diameters from \
            the inlet, mean of the last fifth.",
    reference: "Developed flow of each law, integrated over the radius (constants of Cho and Kensey 1991; Casson with a yield \
                stress of 5 mPa).",
    remark: "The parabola of the inlet is 4.6 % (Carreau-Yasuda) and 2.2 % (Casson) from the law, and has to be forgotten on the \
             way. At D/12 a Newtonian flow is 1.4 % from its own parabola: too much, at this speed, to tell Casson blood from \
             it by half as much again, as the test wants.",
    quick: None,
    full: run,
};

/// Mean velocity \[m/s\].
const MEAN: f64 = 0.02;

fn run() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    for model in ["carreau-yasuda", "casson"] {
        let mut pipe = Pipe::published(12.0);
        pipe.inlet = format!(
            "condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"{MEAN} m/s\"\nramp = \"100 ms\""
        );
        pipe.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
        pipe.law = Some(model);
        let law: Rheology = pipe.plan().1.numbers.rheology.expect("the viscosity is a law");
        let exact = Developed::new(&law, pipe.radius(), MEAN);
        let (mut squares, mut parabola, mut n) = (0.0, 0.0, 0.0);
        let flown = fly(&pipe, |flow, plan| {
            if flow.time < 0.8 * plan.end_time {
                return;
            }
            let state = &flow.fluid.state;
            for (&x, v) in state.position.iter().zip(state.velocity.iter()) {
                let (z, r) = pipe.place(x);
                if (0.6..0.8).contains(&(z / pipe.length)) {
                    squares += (v.dot(pipe.axis) - exact.velocity(r)).powi(2);
                    let newtonian = 2.0 * MEAN * (1.0 - (r / pipe.radius()).powi(2));
                    parabola += (newtonian - exact.velocity(r)).powi(2);
                    n += 1.0;
                }
            }
        });
        outcome.cost(&flown);
        let [error, off] = [squares, parabola].map(|s| f64::sqrt(s / n) / exact.peak());
        outcome.figure(
            format!("{model}: velocity, rms, of the peak"),
            error,
            Unit::Part,
            Tolerance::Asked(0.02),
        );
        let ratio = off / error;
        outcome.figure(
            format!("{model}: how many times farther a parabola is"),
            ratio,
            Unit::Number,
            Tolerance::AtLeast(1.5),
        );
    }
    Some(outcome)
}
