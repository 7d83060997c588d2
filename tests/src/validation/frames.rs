//! The same pipe turned, moved, and given in another unit.

use glam::DVec3;

use super::measure::{Flown, Line, fly};
use super::{Case, Outcome, Tolerance, Unit};
use crate::pipe::Pipe;

/// The case of the page.
pub const CASE: Case = Case {
    name: "frames",
    title: "The same pipe turned, moved, and in another unit",
    setup: "Pipe at Reynolds number 20, two and a half diameters long, 1.5 s from rest at D/16 (D/10 in the quick run); along z \
            from the origin in mm, along (0.3, -0.8, 0.5), a metre away from the origin, and in cm. Velocity in five rings of \
            equal area, flow and pressure gradient, means of the last two thirds.",
    reference: "The first of the four.",
    remark: "Particles belong to the vessel, so all four start from the same ones up to rounding, that of the surface file \
             included. It grows in any flow of particles until single ones have nothing in common. Means then differ by what \
             is left of the particle noise, about 0.2 % at D/16 and 0.5 % at D/10: more than the 0.1 % asked for, which the \
             change of the unit alone, the same to the last bits, is far below.",
    quick: Some(|| run(10.0)),
    full: || run(16.0),
};

const RINGS: usize = 5;

/// Time at which single particles are compared \[s\].
const EARLY: f64 = 0.1;

/// What is compared.
struct Means {
    /// Velocities at [`EARLY`] by the identities of the particles, turned back.
    early: Vec<(u64, DVec3)>,
    rings: Vec<f64>,
    slope: f64,
    flown: Flown,
}

fn run(across: f64) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let first = Pipe { length: 2.5 * 6.35e-3, end_time: 1.5, ..Pipe::published(across) };
    let turned = Pipe { axis: DVec3::new(0.3, -0.8, 0.5), ..first.clone() };
    let moved = Pipe { origin: DVec3::new(0.6, -0.7, 0.4), ..first.clone() };
    let unit = Pipe { unit: ("cm", 1e-2), ..first.clone() };
    let base = means(first);
    outcome.cost(&base.flown);
    let top = base.early.iter().map(|p| p.1.length()).fold(0.0, f64::max);
    let means_within = if across >= 16.0 {
        Tolerance::Missed { asked: 1e-3, held: 3e-3 }
    } else {
        Tolerance::Missed { asked: 1e-3, held: 6e-3 }
    };
    for (name, pipe) in [("turned", turned), ("moved by a metre", moved), ("in cm", unit)] {
        let other = means(pipe);
        outcome.cost(&other.flown);
        let pairs = other.early.iter().zip(&base.early);
        assert!(pairs.clone().all(|(a, b)| a.0 == b.0), "other particles");
        outcome.figure(
            format!("{name}: velocity of single particles after {EARLY} s, largest difference, of the largest velocity"),
            pairs.map(|(a, b)| a.1.distance(b.1) / top).fold(0.0, f64::max),
            Unit::Part,
            Tolerance::Asked(1e-3),
        );
        let peak = base.rings[0];
        let rings = other.rings.iter().zip(&base.rings);
        let worst = rings.clone().map(|(a, b)| (a - b).abs() / peak).fold(0.0, f64::max);
        let flow = rings.map(|(a, b)| a - b).sum::<f64>() / base.rings.iter().sum::<f64>();
        outcome.figure(
            format!("{name}: velocity, largest difference of a ring, of the peak"),
            worst,
            Unit::Part,
            means_within,
        );
        outcome.figure(format!("{name}: mean velocity"), flow, Unit::Part, means_within);
        outcome.figure(
            format!("{name}: pressure gradient"),
            other.slope / base.slope - 1.0,
            Unit::Part,
            Tolerance::Held(0.02),
        );
    }
    Some(outcome)
}

fn means(mut pipe: Pipe) -> Means {
    let mean = 20.0 * pipe.viscosity / (pipe.density * pipe.diameter);
    pipe.inlet = format!(
        "condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"{mean} m/s\"\nramp = \"100 ms\""
    );
    pipe.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
    let axis = pipe.axis.normalize();
    let mut rings = [(0.0, 0.0_f64); RINGS];
    let mut line = Line::default();
    let mut early = Vec::new();
    let back = pipe.turn().inverse();
    let flown = fly(&pipe, |flow, plan| {
        if early.is_empty() && flow.time >= EARLY {
            let state = &flow.fluid.state;
            early = state.id.iter().zip(state.velocity.iter()).map(|(&id, v)| (id, back * *v)).collect();
            early.sort_unstable_by_key(|p| p.0);
        }
        if flow.time < plan.end_time / 3.0 {
            return;
        }
        let state = &flow.fluid.state;
        for (i, (&x, v)) in state.position.iter().zip(state.velocity.iter()).enumerate() {
            let (z, r) = pipe.place(x);
            if (0.25..0.75).contains(&(z / pipe.length)) {
                line.add(z, flow.fluid.pressure(i));
                let ring = (r / pipe.radius()).powi(2) * RINGS as f64;
                let sum = &mut rings[(ring as usize).min(RINGS - 1)];
                *sum = (sum.0 + v.dot(axis), sum.1 + 1.0);
            }
        }
    });
    Means { early, rings: rings.iter().map(|s| s.0 / s.1).collect(), slope: line.slope(), flown }
}
