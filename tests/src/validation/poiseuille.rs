//! Steady flow in a round pipe behind a velocity inlet.

use super::ends::mean_velocity;
use super::measure::{Flown, Line, Shear, fly};
use super::{Case, Outcome, Tolerance, Unit};
use crate::pipe::Pipe;

/// The ladder of spacings.
pub const CASE: Case = Case {
    name: "poiseuille",
    title: "Poiseuille flow, driven by a velocity",
    setup: "Pipe of 6.35 mm, five diameters long, Reynolds number 100: parabolic inlet, pressure outlet, 1.2 s (two ways \
            through) from rest, mean of the last quarter over the middle fifth. Wall shear stress on 288 points of its wall.",
    reference: "Hagen and Poiseuille: u = 2 U (1 - r^2/R^2), stress 4 mu U / R, gradient 8 mu U / R^2.",
    remark: "The inlet imposes the exact parabola, and over two and a half diameters the flow keeps part of it: the profile \
             of the scheme itself shows in the long pipe below. The velocity error is that of single particles at single moments, \
             noise included; that of the profile is of means over rings of half a spacing and over time.",
    quick: Some(|| run(&[10.0, 20.0])),
    full: || run(&[10.0, 16.0, 20.0, 30.0]),
};

/// The long pipe.
pub const LONG: Case = Case {
    name: "poiseuille-long",
    title: "Poiseuille flow in a long pipe",
    setup: "The same pipe, fifteen diameters long at D/10, 3 s from rest, mean of the last quarter over the part between \
            twelve and thirteen and a half diameters from the inlet.",
    reference: "Hagen and Poiseuille.",
    remark: "Twice the length in which a flow at this Reynolds number develops: what the inlet imposed is forgotten. Nothing \
             is asked of the profile at D/10; the run has to be stable.",
    quick: None,
    full: long,
};

/// Sums over the particles between two radii, half a spacing apart.
#[derive(Clone, Copy, Default)]
struct Ring {
    error: f64,
    n: f64,
}

impl Ring {
    /// The square of their mean error, as often as there are particles.
    fn square(&self) -> f64 {
        if self.n > 0.0 { self.error * self.error / self.n } else { 0.0 }
    }
}

/// Errors of a run.
struct Errors {
    velocity: f64,
    profile: f64,
    flow: f64,
    gradient: f64,
    shear_mean: f64,
    shear_rms: f64,
    balance: f64,
    flown: Flown,
}

fn run(ladder: &[f64]) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let mut velocity = Vec::new();
    for &across in ladder {
        let e = errors(across, 5.0, 1.2, [0.4, 0.6]);
        outcome.cost(&e.flown);
        velocity.push([e.velocity, e.profile]);
        let fine = across >= 20.0;
        let mut part = |what: &str, error: f64, asked: f64, coarse: f64| {
            let tolerance = if fine { Tolerance::Asked(asked) } else { Tolerance::Held(coarse) };
            outcome.figure(format!("D/{across}: {what}"), error, Unit::Part, tolerance);
        };
        part("velocity, rms, of the peak", e.velocity, 0.008, 0.022);
        part("velocity profile, rms, of the peak", e.profile, 0.008, 0.022);
        part("wall shear stress, mean", e.shear_mean, 0.03, 0.1);
        part("wall shear stress, rms over the wall", e.shear_rms, 0.03, 0.1);
        part("inflow less outflow", e.balance, 0.002, 0.01);
        outcome.figure(format!("D/{across}: flow"), e.flow, Unit::Part, Tolerance::Held(0.01));
        outcome.figure(
            format!("D/{across}: pressure gradient, one diameter from the ends"),
            e.gradient,
            Unit::Part,
            Tolerance::Held(if fine { 0.03 } else { 0.06 }),
        );
        outcome.figure(
            format!("D/{across}: particles lost"),
            e.flown.escaped as f64,
            Unit::Number,
            Tolerance::Asked(0.0),
        );
    }
    let (first, last) = (0, ladder.len() - 1);
    let order =
        |k: usize| (velocity[first][k] / velocity[last][k]).ln() / (ladder[last] / ladder[first]).ln();
    let held = Tolerance::TooLow { asked: 1.5, held: 1.2 };
    outcome.figure("order of the velocity error", order(0), Unit::Number, held);
    outcome.figure("order of the error of the profile", order(1), Unit::Number, held);
    Some(outcome)
}

fn long() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let e = errors(10.0, 15.0, 3.0, [0.8, 0.9]);
    outcome.cost(&e.flown);
    for (what, error, held) in [
        ("velocity, rms, of the peak", e.velocity, 0.035),
        ("flow", e.flow, 0.01),
        ("wall shear stress, mean", e.shear_mean, 0.1),
        ("pressure gradient, one diameter from the ends", e.gradient, 0.06),
        ("inflow less outflow", e.balance, 0.01),
    ] {
        outcome.figure(what, error, Unit::Part, Tolerance::Held(held));
    }
    outcome.figure("particles lost", e.flown.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
    Some(outcome)
}

fn errors(across: f64, diameters: f64, end: f64, slab: [f64; 2]) -> Errors {
    let mut pipe = Pipe::published(across);
    pipe.length = diameters * pipe.diameter;
    pipe.end_time = end;
    let mean = mean_velocity(&pipe);
    pipe.inlet = format!(
        "condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"{mean} m/s\"\nramp = \"100 ms\""
    );
    pipe.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
    let (radius, axis) = (pipe.radius(), pipe.axis);
    let mut shear = Shear::new(&pipe, slab);
    let (mut squares, mut n, mut carried, mut steps) = (0.0, 0.0, 0.0, 0.0);
    let mut rings: Vec<Ring> = vec![Ring::default(); (2.0 * across).ceil() as usize];
    let mut line = Line::default();
    let mut before: Option<Vec<f64>> = None;
    let mut volumes = Vec::new();
    let flown = fly(&pipe, |flow, plan| {
        if flow.time < 0.75 * plan.end_time {
            return;
        }
        let state = &flow.fluid.state;
        volumes = flow.openings.ports().iter().map(|p| p.counters.outflow_volume).collect();
        before.get_or_insert_with(|| volumes.clone());
        steps += 1.0;
        for (i, (&x, v)) in state.position.iter().zip(state.velocity.iter()).enumerate() {
            let (z, r) = pipe.place(x);
            if (pipe.diameter..pipe.length - pipe.diameter).contains(&z) {
                line.add(z, flow.fluid.pressure(i));
            }
            if (slab[0]..slab[1]).contains(&(z / pipe.length)) {
                let u = v.dot(axis);
                let error = u - 2.0 * mean * (1.0 - (r / radius).powi(2));
                squares += error.powi(2);
                let last = rings.len() - 1;
                let ring = &mut rings[((r / radius * across) as usize).min(last)];
                ring.error += error;
                ring.n += 1.0;
                n += 1.0;
                carried += u * state.mass[i] / pipe.density;
            }
        }
        if (steps as u64).is_multiple_of(4) {
            shear.take(state);
        }
    });
    let exact = 4.0 * pipe.viscosity * mean / radius;
    let stress: Vec<f64> = shear.means().iter().map(|s| s / exact - 1.0).collect();
    let change: Vec<f64> =
        volumes.iter().zip(before.iter().flatten()).map(|(now, then)| now - then).collect();
    Errors {
        velocity: f64::sqrt(squares / n) / (2.0 * mean),
        profile: f64::sqrt(rings.iter().map(Ring::square).sum::<f64>() / n) / (2.0 * mean),
        flow: carried / steps / ((slab[1] - slab[0]) * pipe.length * mean * pipe.area()) - 1.0,
        gradient: line.slope() / (-8.0 * pipe.viscosity * mean / (radius * radius)) - 1.0,
        shear_mean: stress.iter().sum::<f64>() / stress.len() as f64,
        shear_rms: (stress.iter().map(|s| s * s).sum::<f64>() / stress.len() as f64).sqrt(),
        balance: change.iter().sum::<f64>() / change.iter().map(|c| (-c).max(0.0)).sum::<f64>(),
        flown,
    }
}
