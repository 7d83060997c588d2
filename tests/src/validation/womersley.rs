//! Flow that an oscillating pressure difference drives.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use super::measure::{Series, Shear, flow_within, fly, pressure_slope};
use super::{Case, Outcome, Tolerance, Unit};
use crate::pipe::Pipe;

/// The case of the page.
pub const CASE: Case = Case {
    name: "womersley",
    title: "Oscillating flow, Womersley numbers 4 and 8",
    setup: "Pipe of 6.35 mm, three diameters long, between two pressure openings whose difference oscillates for a mean \
            velocity of 20 mm/s, from rest at the moment of least flow. Flow, pressure gradient and wall shear stress of the \
            middle third as waves, over the last two periods of four (three at Womersley number 4).",
    reference: "Womersley 1955: u = Re[G/(i rho w) (1 - J0(i^(3/2) a r/R) / J0(i^(3/2) a)) e^(iwt)].",
    remark: "A velocity inlet with this profile would impose the answer, so pressures drive the flow. It is compared with the \
             wave that belongs to the gradient measured inside; what the imposed pressures would give is told beside it. The \
             wall shear stress lags because its fit looks 2.6 spacings deep into the layer at the wall, see \
             docs/theory/metrics.md.",
    quick: Some(|| run(&[(4.0, 10.0)])),
    full: || run(&[(4.0, 16.0), (8.0, 20.0)]),
};

/// Mean velocity \[m/s\].
const SPEED: f64 = 0.02;

/// Waves of a pressure gradient `Re(G e^(iwt))`.
struct Wave {
    /// Mean velocity over `G / (rho w)`.
    mean: Complex64,
    /// Wall shear stress over `G R`.
    shear: Complex64,
}

impl Wave {
    fn new(alpha: f64) -> Self {
        let lambda = Complex64::from_polar(alpha, 0.75 * PI);
        let [j0, j1] = [0, 1].map(|n| bessel(n, lambda));
        let mean = (Complex64::ONE - 2.0 * j1 / (lambda * j0)) / Complex64::I;
        // rho dU/dt = G - 2 tau / R over the section.
        Self { mean, shear: 0.5 * (Complex64::ONE - Complex64::I * mean) }
    }
}

/// `J_n(z)` for n = 0 or 1 by its power series (Abramowitz and Stegun 1964, 9.1.10), good to ten digits up to |z| = 10.
fn bessel(n: i32, z: Complex64) -> Complex64 {
    let mut term = if n == 0 { Complex64::ONE } else { 0.5 * z };
    let mut sum = term;
    for k in 1..60 {
        term *= -0.25 * z * z / f64::from(k * (k + n));
        sum += term;
    }
    sum
}

fn run(ladder: &[(f64, f64)]) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    for &(alpha, across) in ladder {
        one(alpha, across, &mut outcome);
    }
    Some(outcome)
}

fn one(alpha: f64, across: f64, outcome: &mut Outcome) {
    let mut pipe = Pipe::published(across);
    pipe.length = 3.0 * pipe.diameter;
    let nu = pipe.viscosity / pipe.density;
    let omega = nu * (alpha / pipe.radius()).powi(2);
    let period = TAU / omega;
    let exact = Wave::new(alpha);
    let gradient = SPEED * pipe.density * omega / exact.mean.norm();
    // The flow is Re(|m| e^(i (w t + phase + arg m))): nothing at the start.
    let phase = -0.5 * PI - exact.mean.arg();
    let periods = if alpha < 6.0 { 3.0 } else { 4.0 };
    pipe.end_time = periods * period;
    let rows = 400 * periods as usize;
    pipe.inflow = (0..=rows)
        .map(|k| {
            let t = pipe.end_time * k as f64 / rows as f64;
            [t, gradient * pipe.length * (omega * t + phase).cos()]
        })
        .collect();
    pipe.inlet = "condition = \"pressure\"\nwaveform = \"inflow.csv\"".into();
    pipe.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
    let slab = [1.0 / 3.0, 2.0 / 3.0];
    let mut wall = Shear::new(&pipe, slab);
    let [mut flows, mut slopes, mut stresses] = [const { Series { points: Vec::new() } }; 3];
    let mut step = 0;
    let flown = fly(&pipe, |flow, _| {
        step += 1;
        let t = flow.time;
        if t < (periods - 2.0) * period {
            return;
        }
        flows.add(t, flow_within(&pipe, &flow.fluid.state, pipe.density, slab));
        slopes.add(t, -pressure_slope(&pipe, flow, slab));
        if step % 4 == 0 {
            stresses.add(t, wall.take(&flow.fluid.state));
        }
    });
    outcome.cost(&flown);
    let measured = slopes.wave(period);
    let imposed = Complex64::from_polar(gradient, phase);
    let velocity = flows.wave(period) / pipe.area();
    let of = |g: Complex64| exact.mean * g / (pipe.density * omega);
    let shear = stresses.wave(period) / (exact.shear * measured * pipe.radius());
    let fine = across >= 16.0;
    let held = |asked: f64, coarse: f64| if fine { Tolerance::Asked(asked) } else { Tolerance::Held(coarse) };
    let mut figure = |what: &str, error: f64, unit: Unit, tolerance: Tolerance| {
        outcome.figure(format!("alpha {alpha}, D/{across}: {what}"), error, unit, tolerance);
    };
    let ratio = velocity / of(measured);
    figure("flow, amplitude", ratio.norm() - 1.0, Unit::Part, held(0.02, 0.05));
    figure("flow, phase", ratio.arg().to_degrees(), Unit::Degree, held(2.0, 4.0));
    let ratio = velocity / of(imposed);
    figure(
        "flow for the imposed pressures, amplitude",
        ratio.norm() - 1.0,
        Unit::Part,
        Tolerance::Held(0.08),
    );
    figure(
        "flow for the imposed pressures, phase",
        ratio.arg().to_degrees(),
        Unit::Degree,
        Tolerance::Held(4.0),
    );
    figure("wall shear stress, amplitude", shear.norm() - 1.0, Unit::Part, held(0.07, 0.12));
    figure("wall shear stress, amplitude and phase", (shear - 1.0).norm(), Unit::Part, held(0.07, 0.15));
    figure("particles lost", flown.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitudes and phases of the closed form by mpmath.
    #[test]
    fn waves_are_those_of_the_table() {
        for (alpha, mean, lag, shear, shear_lag) in [
            (2.0, 0.4125, 33.3, 0.4236, 24.0),
            (4.0, 0.7062, 65.6, 0.2306, 39.3),
            (8.0, 0.8384, 78.9, 0.1196, 42.2),
        ] {
            let wave = Wave::new(alpha);
            assert!((wave.mean.norm() - mean).abs() < 1e-4, "{alpha}: {}", wave.mean);
            assert!((wave.mean.arg().to_degrees() + lag).abs() < 0.06, "{alpha}: {}", wave.mean);
            assert!((wave.shear.norm() - shear).abs() < 1e-4, "{alpha}: {}", wave.shear);
            assert!((wave.shear.arg().to_degrees() + shear_lag).abs() < 0.06, "{alpha}: {}", wave.shear);
        }
    }
}
