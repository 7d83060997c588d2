//! The Windkessel alone, without particles.

use std::f64::consts::TAU;
use std::time::Instant;

use vaso_boundary::{Integration, OutletState, Windkessel};

use super::{Case, Outcome, Tolerance, Unit};
use crate::data;

/// The case of the page.
pub const CASE: Case = Case {
    name: "windkessel",
    title: "Windkessel alone",
    setup: "The outlet model without a flow, driven by a sinusoidal flow in 4000 steps over two periods, for time constants \
            R_d C of 1 ms to 50 s and in the limits; and by the tabulated flow of the svFSI pipe.",
    reference: "Closed solution for a sine; exact integral of the table (svFSI-Tests, 04-fluid/01-pipe3D_RCR).",
    remark: "The step is exact for a flow that is linear in it, whatever its length. What is left for a sine is the straight \
             line between two values of the flow.",
    quick: Some(run),
    full: run,
};

const PERIOD: f64 = 0.8;
const MEAN: f64 = 6e-6;
const SWING: f64 = 9e-6;
const R_P: f64 = 3e8;
const R_D: f64 = 1.4e9;
const STEPS: i32 = 4000;

fn sine(t: f64) -> f64 {
    MEAN + SWING * (TAU * t / PERIOD).sin()
}

/// Largest difference from `exact(t)` over the largest pressure.
fn error(model: &Windkessel, integration: Integration, exact: impl Fn(f64) -> f64) -> f64 {
    let dt = 2.0 * PERIOD / f64::from(STEPS);
    let mut state = OutletState { pressure: R_P * sine(0.0), stored_pressure: 0.0, flow: sine(0.0) };
    let (mut error, mut peak): (f64, f64) = (0.0, 0.0);
    for k in 1..=STEPS {
        let t = dt * f64::from(k);
        state = model.advance(&state, sine(t), dt, integration);
        error = error.max((state.pressure - exact(t)).abs());
        peak = peak.max(exact(t).abs());
    }
    error / peak
}

/// Pressure at the cap under [`sine`] from an empty store.
fn exact(tau: f64, t: f64) -> f64 {
    let w = TAU / PERIOD;
    let left = (-t / tau).exp();
    let steady = R_D * MEAN * (1.0 - left);
    let wave = R_D * SWING / (1.0 + (w * tau).powi(2));
    steady + wave * ((w * t).sin() - w * tau * ((w * t).cos() - left)) + R_P * sine(t)
}

fn run() -> Option<Outcome> {
    let started = Instant::now();
    let mut outcome = Outcome::new();
    let of = |compliance| Windkessel {
        proximal_resistance: R_P,
        compliance,
        distal_resistance: R_D,
        distal_pressure: 0.0,
    };
    let part = |outcome: &mut Outcome, what: &str, error: f64, asked: f64| {
        outcome.figure(what, error, Unit::Part, Tolerance::Asked(asked));
    };
    let taus = [1e-3, 0.01, 0.1, 0.7, 5.0, 50.0];
    let worst = taus.map(|tau| error(&of(tau / R_D), Integration::Exponential, |t| exact(tau, t)));
    part(
        &mut outcome,
        "pressure, of its peak, R_d C from 1 ms to 50 s",
        worst.into_iter().fold(0.0, f64::max),
        1e-6,
    );
    let empty = error(&of(0.0), Integration::Exponential, |t| (R_P + R_D) * sine(t));
    part(&mut outcome, "the same, C = 0: a resistance R_p + R_d", empty, 1e-6);
    let full = error(&of(f64::INFINITY), Integration::Exponential, |t| R_P * sine(t));
    part(&mut outcome, "the same, C infinite: R_p before a constant pressure", full, 1e-6);
    let euler =
        [0.1, 0.7, 5.0].map(|tau| error(&of(tau / R_D), Integration::ModifiedEuler, |t| exact(tau, t)));
    let euler = euler.into_iter().fold(0.0, f64::max);
    outcome.figure(
        "the same by the modified Euler as published, R_d C from 0.1 s",
        euler,
        Unit::Part,
        Tolerance::Held(1e-4),
    );
    if let Some(error) = svfsi() {
        part(
            &mut outcome,
            "outlet pressure of the svFSI pipe over eight cycles from empty, of its peak",
            error,
            1e-6,
        );
    }
    outcome.seconds = started.elapsed().as_secs_f64();
    Some(outcome)
}

/// Largest error of the outlet of the svFSI pipe under its flow, over the peak.
fn svfsi() -> Option<f64> {
    let file = data()?.join("reference/analytic/rcr_exact_svfsi_pipe.csv");
    let text = std::fs::read_to_string(file).expect("the data hold the table");
    let model = Windkessel {
        proximal_resistance: 121.0,
        compliance: 1.5e-4,
        distal_resistance: 1212.0,
        distal_pressure: 0.0,
    };
    let flow = |t: f64| 62.831_853_07 * (1.0 - (TAU * t).cos());
    let (mut state, mut t) = (OutletState::default(), 0.0);
    let (mut error, mut peak): (f64, f64) = (0.0, 0.0);
    for line in text.lines().skip(2) {
        let row: Vec<f64> = line.split(',').map(|v| v.parse().expect("a number")).collect();
        let dt = (row[0] - t) / 10.0;
        for k in 1..=10 {
            state = model.advance(&state, flow(t + dt * f64::from(k)), dt, Integration::Exponential);
        }
        t = row[0];
        error = error.max((state.pressure - row[1]).abs());
        peak = peak.max(row[1]);
    }
    Some(error / peak)
}
