//! Flow that a pressure difference sets going.

use super::measure::{Line, Series, Shear, flow_within, fly, pressure_slope};
use super::{Case, Outcome, Tolerance, Unit};
use crate::pipe::Pipe;

/// The case of the page.
pub const CASE: Case = Case {
    name: "start-up",
    title: "Start-up and Poiseuille flow, driven by a pressure",
    setup: "Pipe of 6.35 mm, five diameters long, between two pressure openings whose difference, for a final Reynolds \
            number of 20, is there from the first moment on. Flow in the middle three fifths, from nu t/R^2 = 0.05 to 1.2.",
    reference: "Szymanski 1932: Q/Q_end = 1 - 32 sum exp(-l^2 nu t/R^2) / l^4 over the zeros l of J0; Hagen and Poiseuille.",
    remark: "A body force in a periodic pipe would be easier, and would not show an error of the pressure force at the wall; \
             the program has neither. Two flows are told: against the imposed difference over the length of the pipe, and \
             against the gradient measured one diameter from each end. Between them lies what the ends do.",
    quick: Some(|| run(10.0)),
    full: || run(20.0),
};

/// First zeros of J0 (Abramowitz and Stegun 1964, table 9.5).
const ZEROS: [f64; 10] = [
    2.404_825_557_7,
    5.520_078_110_3,
    8.653_727_912_9,
    11.791_534_439_1,
    14.930_917_708_6,
    18.071_063_967_9,
    21.211_636_629_9,
    24.352_471_530_7,
    27.493_479_132_0,
    30.634_606_468_4,
];

/// Flow over the final flow at nu t / R^2.
fn share(tau: f64) -> f64 {
    1.0 - 32.0 * ZEROS.iter().map(|l| (-l * l * tau).exp() / l.powi(4)).sum::<f64>()
}

/// What the largest differences in time of the quick run are held to: one came out as 4.8 % on a machine and as 5.1 % on another, so the
/// noise of so few particles has to fit under the bound. Means are held at 5 %.
const COARSE: f64 = 0.07;

fn run(across: f64) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let mut pipe = Pipe::published(across);
    let mean = 20.0 * pipe.viscosity / (pipe.density * pipe.diameter);
    let gradient = 8.0 * pipe.viscosity * mean / pipe.radius().powi(2);
    let unit = pipe.radius().powi(2) * pipe.density / pipe.viscosity;
    pipe.end_time = 1.2 * unit;
    pipe.inlet = format!("condition = \"pressure\"\nvalue = \"{} Pa\"", gradient * pipe.length);
    pipe.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
    let slab = [0.2, 0.8];
    let mut shear = Shear::new(&pipe, [0.4, 0.6]);
    let (mut flows, mut slopes) = (Series::default(), Series::default());
    let mut profile = Line::default();
    let (mut squares, mut n) = (0.0, 0.0);
    let flown = fly(&pipe, |flow, _| {
        let (t, state) = (flow.time, &flow.fluid.state);
        flows.add(t, flow_within(&pipe, state, pipe.density, slab));
        slopes.add(t, pressure_slope(&pipe, flow, slab));
        if t > 1.0 * unit {
            shear.take(state);
            for (&x, v) in state.position.iter().zip(state.velocity.iter()) {
                let (z, r) = pipe.place(x);
                if (0.4..0.6).contains(&(z / pipe.length)) {
                    let exact = 2.0 * mean * (1.0 - (r / pipe.radius()).powi(2));
                    squares += (v.dot(pipe.axis) - exact).powi(2);
                    n += 1.0;
                    profile.add(exact, v.dot(pipe.axis));
                }
            }
        }
    });
    outcome.cost(&flown);
    let end = mean * pipe.area();
    let settled = flows.from(unit).mean() / (end * share(1.1));
    let measured = -slopes.from(unit).mean() / gradient;
    let early = flows.from(0.05 * unit);
    let fine = across >= 20.0;
    let held = |asked: f64, coarse: f64| if fine { Tolerance::Asked(asked) } else { Tolerance::Held(coarse) };
    outcome.figure(
        format!("D/{across}: flow in time, largest difference from the series, of the final flow"),
        early.largest_difference(|t| end * share(t / unit)) / end,
        Unit::Part,
        held(0.02, COARSE),
    );
    outcome.figure(
        format!("D/{across}: the same with the series for the measured gradient"),
        early.largest_difference(|t| measured * end * share(t / unit)) / end,
        Unit::Part,
        held(0.02, COARSE),
    );
    outcome.figure(
        format!("D/{across}: final flow for the imposed difference"),
        settled - 1.0,
        Unit::Part,
        held(0.02, 0.05),
    );
    outcome.figure(
        format!("D/{across}: final flow for the measured gradient"),
        settled / measured - 1.0,
        Unit::Part,
        held(0.02, 0.05),
    );
    outcome.figure(
        format!("D/{across}: velocity profile, rms, of the peak"),
        f64::sqrt(squares / n) / (2.0 * mean),
        Unit::Part,
        held(0.02, 0.05),
    );
    let stress = shear.means();
    let stress = stress.iter().sum::<f64>() / stress.len() as f64;
    outcome.figure(
        format!("D/{across}: wall shear stress, against R/2 times the measured gradient"),
        stress / (0.5 * pipe.radius() * measured * gradient) - 1.0,
        Unit::Part,
        held(0.03, 0.06),
    );
    outcome.figure("particles lost", flown.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
    Some(outcome)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_starts_at_nothing_and_ends_at_one() {
        // The zeros beyond the tenth lie pi apart: what they leave out is 32 / (3 pi^4 10.25^3).
        assert!((share(0.0) - 1.02e-4).abs() < 1e-6, "{}", share(0.0));
        assert!((share(3.0) - 1.0).abs() < 1e-7);
        // All of the fluid accelerates alike at first: Q/Q_end = 8 tau less the layer at the wall.
        let (tau, layer) = (1e-3_f64, 4.0 * (1e-3_f64 / std::f64::consts::PI).sqrt());
        let early = 8.0 * tau * (1.0 - 2.0 / 3.0 * layer);
        assert!((share(tau) / early - 1.0).abs() < 0.03, "{} and {early}", share(tau));
    }
}
