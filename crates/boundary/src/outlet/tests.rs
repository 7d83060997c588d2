//! The models against closed forms.

use super::*;
use crate::waveform::{Signal, Source, Waveform};
use std::f64::consts::TAU;

const PERIOD: f64 = 0.8;
const MEAN: f64 = 6e-6;
const SWING: f64 = 9e-6;
const R_P: f64 = 3e8;
const R_D: f64 = 1.4e9;
const P_D: f64 = 400.0;

fn windkessel(time_constant: f64) -> Windkessel {
    Windkessel {
        proximal_resistance: R_P,
        compliance: time_constant / R_D,
        distal_resistance: R_D,
        distal_pressure: P_D,
    }
}

fn sine(t: f64) -> f64 {
    MEAN + SWING * (TAU * t / PERIOD).sin()
}

/// Pressure at the cap under [`sine`], stored pressure `p_d` at time zero.
fn exact_for_sine(tau: f64, t: f64) -> f64 {
    let w = TAU / PERIOD;
    let left = (-t / tau).exp();
    let steady = -R_D * MEAN * (-t / tau).exp_m1();
    let wave =
        R_D * SWING / (1.0 + w * w * tau * tau) * ((w * t).sin() - w * tau * (w * t).cos() + w * tau * left);
    P_D + steady + wave + R_P * sine(t)
}

/// Largest error over the largest pressure, for steps of two periods.
fn error_for_sine(tau: f64, steps: i32, integration: Integration) -> f64 {
    let model = windkessel(tau);
    let dt = 2.0 * PERIOD / f64::from(steps);
    let pressure = P_D + R_P * sine(0.0);
    let mut state = OutletState { pressure, stored_pressure: P_D, flow: sine(0.0) };
    let (mut error, mut peak): (f64, f64) = (0.0, 0.0);
    for k in 1..=steps {
        let t = dt * f64::from(k);
        state = model.advance(&state, sine(t), dt, integration);
        let exact = exact_for_sine(tau, t);
        error = error.max((state.pressure - exact).abs());
        peak = peak.max(exact.abs());
    }
    error / peak
}

#[test]
fn a_sinusoidal_flow_meets_the_exact_pressure() {
    for tau in [1e-3, 0.01, 0.1, 0.7, 5.0, 50.0] {
        // What is left is the straight line between two flows, (w dt)^2 / 12 of the swing.
        let [coarse, fine] = [2000, 4000].map(|n| error_for_sine(tau, n, Integration::Exponential));
        assert!(fine < 1e-6, "tau {tau} s: {fine:.2e}");
        let order = (coarse / fine).log2();
        assert!((order - 2.0).abs() < 0.05, "tau {tau} s: order {order}");
    }
}

#[test]
fn a_piecewise_linear_flow_is_exact_at_any_step() {
    // Rows of a saw tooth, and the textbook solution between them, in another form than the code has.
    let rows = [(0.0, 2e-6), (0.1, 1.5e-5), (0.3, 4e-6), (0.8, 2e-6), (0.9, -3e-6), (1.6, 2e-6)];
    for tau in [1e-3, 0.01, 0.3, 5.0, 50.0] {
        for parts in [1, 2, 17, 400] {
            let model = windkessel(tau);
            let mut state = OutletState { pressure: 0.0, stored_pressure: 9000.0, flow: rows[0].1 };
            let mut y0 = 9000.0 - P_D;
            let (mut error, mut peak): (f64, f64) = (0.0, 0.0);
            for pair in rows.windows(2) {
                let [(t0, q0), (t1, q1)] = [pair[0], pair[1]];
                let slope = (q1 - q0) / (t1 - t0);
                let particular = |s: f64| R_D * (q0 + slope * (s - tau));
                let exact = |s: f64| particular(s) + (y0 - particular(0.0)) * (-s / tau).exp();
                let dt = (t1 - t0) / f64::from(parts);
                for k in 1..=parts {
                    let s = dt * f64::from(k);
                    let flow = q0 + slope * s;
                    state = model.advance(&state, flow, dt, Integration::Exponential);
                    let p = P_D + exact(s) + R_P * flow;
                    error = error.max((state.pressure - p).abs());
                    peak = peak.max(p.abs());
                }
                y0 = exact(t1 - t0);
            }
            assert!(error < 1e-10 * peak, "tau {tau} s in {parts}: {:.2e}", error / peak);
        }
    }
}

#[test]
fn the_modified_euler_is_of_second_order() {
    for tau in [0.1, 0.7, 5.0] {
        let errors = [100, 200, 400].map(|n| error_for_sine(tau, n, Integration::ModifiedEuler));
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - 2.0).abs() < 0.15, "tau {tau} s: {errors:?}");
        }
    }
    // Beyond its stable step it grows, where the exponential stays.
    let steps = 200;
    let dt = 2.0 * PERIOD / f64::from(steps);
    let stiff = dt / 2.5;
    assert!(windkessel(stiff).stable_step() < dt);
    assert!(error_for_sine(stiff, steps, Integration::ModifiedEuler) > 1e3);
    assert!(error_for_sine(stiff, steps, Integration::Exponential) < 1e-3);
}

#[test]
fn limits_are_the_simpler_models() {
    let (from, to, dt) = (4e-6, 7e-6, 0.02);
    let start = OutletState { pressure: 0.0, stored_pressure: 5000.0, flow: from };
    let step = |model: Windkessel| model.advance(&start, to, dt, Integration::Exponential).pressure;
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * b.abs(), "{a} is not {b}");

    let resistances = P_D + (R_P + R_D) * to;
    near(step(Windkessel { compliance: 0.0, ..windkessel(1.0) }), resistances);
    near(step(windkessel(1e-14)), resistances);

    let held = 5000.0 + R_P * to;
    near(step(Windkessel { compliance: f64::INFINITY, ..windkessel(1.0) }), held);
    near(step(windkessel(1e12)), held);

    let c = 1e-9;
    let filled = 5000.0 + 0.5 * (from + to) * dt / c + R_P * to;
    let closed = |distal_resistance| Windkessel { compliance: c, distal_resistance, ..windkessel(1.0) };
    near(step(closed(f64::INFINITY)), filled);
    near(step(closed(1e25)), filled);

    let bare = Windkessel { proximal_resistance: 0.0, ..windkessel(0.5) };
    near(step(bare), step(windkessel(0.5)) - R_P * to);

    let state = OutletState::at_rest(P_D);
    let resistance = Windkessel::resistance(R_P, P_D);
    near(resistance.advance(&state, to, dt, Integration::Exponential).pressure, P_D + R_P * to);
    near(resistance.total_resistance(), R_P);
}

#[test]
fn the_periodic_start_returns_after_a_cycle() {
    let time: Vec<f64> = (0..40).map(|k| PERIOD * f64::from(k) / 40.0).collect();
    let value = time.iter().map(|&t| sine(t)).collect();
    let flow = Waveform::new(time, value, Some(PERIOD)).expect("valid");
    for tau in [0.0, 1e-3, 0.3, 2.3, 50.0, 1e9, f64::INFINITY] {
        let model = windkessel(tau);
        let cycle = model.periodic(&flow).expect("periodic");
        assert!(
            (cycle.mean - P_D - (R_P + R_D) * flow.mean()).abs() < 1e-5 * cycle.mean,
            "tau {tau} s: {cycle:?}"
        );
        let n = 800;
        let end = (1..=n).fold(cycle.start, |state, k| {
            let t = PERIOD * f64::from(k) / f64::from(n);
            model.advance(&state, flow.at(t), PERIOD / f64::from(n), Integration::Exponential)
        });
        assert!((end.pressure - cycle.start.pressure).abs() < 1e-9 * cycle.mean, "tau {tau} s");
    }
}

#[test]
fn a_head_start_makes_up_for_a_slow_start() {
    let time: Vec<f64> = (0..40).map(|k| PERIOD * f64::from(k) / 40.0).collect();
    let value = time.iter().map(|&t| sine(t)).collect();
    let flow = Waveform::new(time, value, Some(PERIOD)).expect("valid");
    let signal = Signal { source: Source::Waveform(flow.clone()), ramp: 0.1 * PERIOD };
    let n = 4000;
    let run = |model: &Windkessel, start: f64, flow: &dyn Fn(f64) -> f64| {
        (1..=n).fold(OutletState { flow: flow(0.0), ..OutletState::at_rest(start) }, |state, k| {
            let t = PERIOD * f64::from(k) / f64::from(n);
            model.advance(&state, flow(t), PERIOD / f64::from(n), Integration::Exponential)
        })
    };
    for tau in [0.3, 2.3, 50.0] {
        let model = windkessel(tau);
        let start = model.periodic(&flow).expect("periodic").start.stored_pressure;
        let ahead = model.head_start(&flow, &signal);
        let [cycle, risen] =
            [run(&model, start, &|t| flow.at(t)), run(&model, start + ahead, &|t| signal.at(t))];
        let missing = run(&model, start, &|t| signal.at(t)).stored_pressure - cycle.stored_pressure;
        let left = risen.stored_pressure - cycle.stored_pressure;
        assert!(left.abs() <= 1e-3 * missing.abs(), "tau {tau} s: {left} Pa of {missing}");
    }
    // One that forgets within the rise has nothing to make up for.
    assert_eq!(windkessel(0.01 * PERIOD).head_start(&flow, &signal), 0.0);
}

#[test]
fn a_mean_inflow_parts_by_resistance() {
    let outlet =
        |r: f64| Windkessel { proximal_resistance: 0.2 * r, distal_resistance: 0.8 * r, ..windkessel(1.0) };
    let (pressure, shares) = mean_split(&[outlet(1e9), outlet(3e9)], 8e-6).expect("valid");
    assert!((shares[0] - 0.75).abs() < 1e-12 && (shares[1] - 0.25).abs() < 1e-12, "{shares:?}");
    assert!((pressure - (P_D + 8e-6 * 0.75e9)).abs() < 1e-9);
}

#[test]
fn numbers_without_meaning_are_named() {
    let bad = Windkessel { distal_resistance: 0.0, ..windkessel(1.0) };
    assert!(matches!(bad.validate(), Err(BoundaryError::OutOfRange { key: "distal_resistance", .. })));
    let blocked = Windkessel { compliance: 0.0, distal_resistance: f64::INFINITY, ..bad };
    assert_eq!(blocked.validate(), Err(BoundaryError::Blocked));
    let balloon = Windkessel { compliance: 1e-9, distal_resistance: f64::INFINITY, ..bad };
    let flow = Waveform::new(vec![0.0, 0.4], vec![1e-6, 2e-6], Some(PERIOD)).expect("valid");
    assert!(matches!(balloon.periodic(&flow), Err(BoundaryError::NeverPeriodic { .. })));
    assert!(matches!(mean_split(&[balloon], 1e-6), Err(BoundaryError::NeverPeriodic { .. })));
}
