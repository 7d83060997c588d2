//! The pipe of `cases/pipe` against Poiseuille's formula.

use crate::{case, flow};
use vaso_boundary::Condition;
use vaso_fluid::Real;

/// Diameter of the pipe \[m\].
const DIAMETER: f64 = 6.35e-3;
/// Length of the pipe \[m\].
const LENGTH: f64 = 31.75e-3;

/// Deviations from Poiseuille flow over the last quarter of a run.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// Particles across the diameter.
    pub across: f64,
    /// Root mean square of `u - u_exact` over the middle fifth, of the peak velocity.
    pub velocity: f64,
    /// Root mean square of the velocity across the axis there, of the peak velocity.
    pub transverse: f64,
    /// Relative error of the flow there.
    pub flow: f64,
    /// Relative error of the pressure gradient, fitted between one diameter from each end.
    pub gradient: f64,
    /// Inflow minus outflow by the volumes that crossed the caps, of the inflow.
    pub balance: f64,
    /// Particles that left through the wall.
    pub escaped: u64,
    /// Largest density deviation, start included.
    pub density: f64,
    /// Fluid particles at the end.
    pub particles: usize,
    /// Acoustic steps taken.
    pub steps: u64,
    /// Wall time of the loop \[s\], generation left out.
    pub seconds: f64,
}

/// Runs the pipe with `across` particles over the diameter for 1.2 s, about two flow-throughs.
///
/// # Panics
/// When the run breaks down.
pub fn run<R: Real>(across: f64) -> Errors {
    run_with::<R>(across, &[])
}

/// As [`run`], with overrides of the case.
///
/// # Panics
/// When the run breaks down or an override is wrong.
pub fn run_with<R: Real>(across: f64, overrides: &[(&str, &str)]) -> Errors {
    let spacing = format!("{} mm", 1e3 * DIAMETER / across);
    let case = case("pipe", &[&[("particles.spacing", spacing.as_str())], overrides].concat());
    let (mut flow, plan) = flow::<R>(&case);
    let inlet = plan.openings.iter().find_map(|o| match &o.condition {
        Condition::Velocity { mean, .. } => Some((mean.peak(), o.opening.area)),
        _ => None,
    });
    let (mean, area) = inlet.expect("the pipe has a velocity inlet");
    let radius = 0.5 * DIAMETER;
    let (peak, end) = (2.0 * mean, plan.end_time);
    let numbers = plan.numbers;
    let (mut deviation, mut transverse, mut n) = (0.0, 0.0, 0.0_f64);
    let (mut carried, mut steps) = (0.0, 0.0_f64);
    let bins = (LENGTH / numbers.spacing) as usize;
    let mut pressure = vec![(0.0, 0.0_f64); bins];
    let mut before = None;
    let volumes = |flow: &vaso_driver::Flow<R>| {
        flow.openings.ports().iter().map(|p| p.counters.outflow_volume).collect::<Vec<_>>()
    };
    while flow.time < end {
        flow.step(end).unwrap_or_else(|e| panic!("{e}"));
        if flow.time < 0.75 * end {
            continue;
        }
        before.get_or_insert_with(|| volumes(&flow));
        let state = &flow.fluid.state;
        for i in 0..state.len() {
            let (x, v) = (state.position[i], state.velocity[i]);
            let bin = (x.z / LENGTH * bins as f64) as usize;
            if let Some(bin) = pressure.get_mut(bin) {
                bin.0 += flow.fluid.pressure(i);
                bin.1 += 1.0;
            }
            if (0.4..0.6).contains(&(x.z / LENGTH)) {
                let exact = peak * (1.0 - (x.x * x.x + x.y * x.y) / (radius * radius));
                deviation += (v.z - exact).powi(2);
                transverse += v.x * v.x + v.y * v.y;
                n += 1.0;
                carried += v.z * state.mass[i] / numbers.rest_density / (0.2 * LENGTH);
            }
        }
        steps += 1.0;
    }
    let change: Vec<f64> =
        volumes(&flow).iter().zip(before.iter().flatten()).map(|(now, then)| now - then).collect();
    let inflow: f64 = change.iter().map(|c| (-c).max(0.0)).sum();
    Errors {
        across,
        velocity: (deviation / n).sqrt() / peak,
        transverse: (transverse / n).sqrt() / peak,
        flow: carried / steps / (mean * area) - 1.0,
        gradient: slope(&pressure) / (-8.0 * numbers.viscosity * mean / (radius * radius)) - 1.0,
        balance: change.iter().sum::<f64>() / inflow,
        escaped: flow.watch.escaped,
        density: flow.watch.max_density_error,
        particles: flow.fluid.state.len(),
        steps: flow.acoustic_steps,
        seconds: flow.ledger.total(),
    }
}

/// Least-squares slope of the mean of the bins over the axis, one diameter from each end left out \[Pa/m\].
fn slope(bins: &[(f64, f64)]) -> f64 {
    let (mut sx, mut sy, mut sxx, mut sxy, mut n) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (k, &(sum, count)) in bins.iter().enumerate() {
        let x = (k as f64 + 0.5) * LENGTH / bins.len() as f64;
        if (DIAMETER..LENGTH - DIAMETER).contains(&x) && count > 0.0 {
            let y = sum / count;
            sx += x;
            sy += y;
            sxx += x * x;
            sxy += x * y;
            n += 1.0;
        }
    }
    (n * sxy - sx * sy) / (n * sxx - sx * sx)
}
