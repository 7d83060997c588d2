//! The same pipe turned, moved, and given in another unit.

use glam::DVec3;
use vaso_driver::world;
use vaso_fluid::Numbers;

use super::measure::{Flown, Line, fly_on};
use super::{Case, Outcome, Tolerance, Unit};
use crate::pipe::Pipe;

/// The case of the page.
pub const CASE: Case = Case {
    name: "frames",
    title: "The same pipe turned, moved, and in another unit",
    setup: "Pipe at Reynolds number 20, two and a half diameters long, 1.5 s from rest at D/16 (D/10 in the quick run); along z \
            from the origin in mm, along (0.3, -0.8, 0.5), a metre away from the origin, and in cm. Velocity in five rings of \
            equal area, flow and pressure gradient, means of the last two thirds.",
    reference: "The first of the four, whose sound speed and steps the others are given.",
    remark: "Particles belong to the vessel, so all four start from the same ones up to rounding, that of the surface file \
             included, which a metre from the origin is 6e-8 m, or 2e-4 spacings. It grows in any flow of particles until single \
             ones have nothing in common; means then differ by what is left of the particle noise, one or two tenths of a per \
             cent. The change of the unit alone leaves them within 0.02 %.",
    quick: Some(|| run(10.0)),
    full: || run(16.0),
};

const RINGS: usize = 5;

/// Time at which single particles are compared \[s\].
const EARLY: f64 = 0.05;

/// What is compared.
struct Means {
    /// Velocities at [`EARLY`] by the identities of the particles, turned back.
    early: Vec<(u64, DVec3)>,
    rings: Vec<f64>,
    slope: f64,
    /// Numbers the planner chose.
    planned: Numbers,
    flown: Flown,
}

fn run(across: f64) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let mut first = Pipe { length: 2.5 * 6.35e-3, end_time: 1.5, ..Pipe::published(across) };
    let mean = 20.0 * first.viscosity / (first.density * first.diameter);
    first.inlet = format!(
        "condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"{mean} m/s\"\nramp = \"100 ms\""
    );
    first.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
    let turned = Pipe { axis: DVec3::new(0.3, -0.8, 0.5), ..first.clone() };
    let moved = Pipe { origin: DVec3::new(0.6, -0.7, 0.4), ..first.clone() };
    let unit = Pipe { unit: ("cm", 1e-2), ..first.clone() };
    let base = means(&first, None);
    outcome.cost(&base.flown);
    let top = base.early.iter().map(|p| p.1.length()).fold(0.0, f64::max);
    let held = if across >= 16.0 { 0.003 } else { 0.01 };
    let means_within = Tolerance::Missed { asked: 1e-3, held };
    for (name, pipe) in [("turned", turned), ("moved by a metre", moved), ("in cm", unit)] {
        let other = means(&pipe, Some(base.planned));
        outcome.cost(&other.flown);
        let mut part = |what: &str, error: f64, tolerance: Tolerance| {
            outcome.figure(format!("{name}: {what}"), error, Unit::Part, tolerance);
        };
        let pairs = || other.early.iter().zip(&base.early);
        assert!(pairs().all(|(a, b)| a.0 == b.0), "other particles");
        let squares: f64 = pairs().map(|(a, b)| a.1.distance_squared(b.1)).sum();
        part(
            "velocity of single particles after 50 ms, rms of the difference, of the largest velocity",
            (squares / base.early.len() as f64).sqrt() / top,
            Tolerance::Missed { asked: 1e-3, held: if across >= 16.0 { 0.2 } else { 2e-3 } },
        );
        let rings = || other.rings.iter().zip(&base.rings);
        let worst = rings().map(|(a, b)| (a - b).abs() / base.rings[0]).fold(0.0, f64::max);
        part("velocity, largest difference of a ring, of the innermost", worst, means_within);
        let flow = rings().map(|(a, b)| a - b).sum::<f64>() / base.rings.iter().sum::<f64>();
        part("mean velocity", flow, means_within);
        part("pressure gradient", other.slope / base.slope - 1.0, Tolerance::Held(0.02));
        let chosen = other.planned.sound_speed / base.planned.sound_speed - 1.0;
        part("sound speed the planner would choose", chosen, Tolerance::Asked(1e-3));
    }
    Some(outcome)
}

/// Runs `pipe`, with `numbers` instead of those of the planner where they are given.
fn means(pipe: &Pipe, numbers: Option<Numbers>) -> Means {
    let (case, mut plan) = pipe.plan();
    let planned = plan.numbers;
    plan.numbers = numbers.unwrap_or(planned);
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow = world::build_flow::<f32>(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let n_start = flow.fluid.state.len() as u64;
    let axis = pipe.axis.normalize();
    let back = pipe.turn().inverse();
    let mut rings = [(0.0, 0.0_f64); RINGS];
    let mut line = Line::default();
    let mut early = Vec::new();
    let flown = fly_on(&mut flow, plan.end_time, |flow| {
        let state = &flow.fluid.state;
        if early.is_empty() && flow.time >= EARLY {
            let velocities = state.id.iter().zip(state.velocity.iter());
            // Later particles get their identities in the order of cells, which lie along the axes of space.
            let first = velocities.filter(|(id, _)| **id < n_start);
            early = first.map(|(&id, v)| (id, back * *v)).collect();
            early.sort_unstable_by_key(|p| p.0);
        }
        if flow.time < plan.end_time / 3.0 {
            return;
        }
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
    let rings = rings.iter().map(|s| s.0 / s.1).collect();
    Means { early, rings, slope: line.slope(), planned, flown }
}
