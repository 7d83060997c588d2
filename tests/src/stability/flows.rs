//! The runs of the hard cases in pipes.

use std::f64::consts::TAU;

use vaso_coupling::ShellWall;
use vaso_driver::Flow;
use vaso_geometry::SignedDistance;

use super::ride::{Ride, ride, voids};
use crate::pipe::Pipe;
use crate::validation::measure::Series;
use crate::validation::{Outcome, Tolerance, Unit};

/// Rides a pipe to its end.
fn ride_pipe(pipe: &Pipe, see: impl FnMut(&Flow<f32>)) -> Ride {
    let (mut flow, _, plan) = pipe.flow::<f32>();
    ride(&mut flow, plan.end_time, see).unwrap_or_else(|e| panic!("{e}"))
}

/// Rows of a waveform.
fn table(end: f64, rows: u32, value: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    (0..=rows)
        .map(|k| {
            let t = end * f64::from(k) / f64::from(rows);
            [t, value(t)]
        })
        .collect()
}

/// Index of the opening of a name.
pub(super) fn port(plan: &vaso_driver::Plan, name: &str) -> usize {
    plan.openings
        .iter()
        .position(|o| o.name == name)
        .unwrap_or_else(|| panic!("there is an opening `{name}`"))
}

pub(super) fn backflow() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let (period, diameter) = (0.4, 0.02);
    let mut pipe = Pipe {
        diameter,
        length: 2.0 * diameter,
        density: 1060.0,
        // A Reynolds number of 6100 at the peak of the mean velocity.
        viscosity: 3.5e-3,
        end_time: 1.5 * period,
        ..Pipe::published(8.0)
    };
    pipe.inflow = table(1.5 * period, 150, |t| 0.35 + 0.65 * (TAU * t / period).cos());
    pipe.inlet =
        "condition = \"velocity\"\nprofile = \"plug\"\nwaveform = \"inflow.csv\"\nramp = \"20 ms\"".into();
    pipe.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
    let mut fastest: f64 = 0.0;
    // Particles that have come in and gone out, half a beat after the start and at the end: a whole beat lies between.
    let mut passed = [[0_u64; 2]; 2];
    let shown = ride_pipe(&pipe, |flow| {
        let ports = flow.openings.ports();
        let counted =
            [ports.iter().map(|p| p.counters.injected).sum(), ports.iter().map(|p| p.counters.deleted).sum()];
        if flow.time < 0.5 * period {
            passed[0] = counted;
        }
        passed[1] = counted;
        let mean = pipe.inflow_at(flow.time);
        if mean >= 0.0 {
            return;
        }
        for (x, v) in flow.fluid.state.position.iter().zip(flow.fluid.state.velocity.iter()) {
            if pipe.place(*x).0 > pipe.length - 4.0 * pipe.spacing() {
                fastest = fastest.max(v.length());
            }
        }
    });
    shown.invariants("", 0.05, &mut outcome);
    outcome.figure(
        "largest speed near the outlet while blood comes in there, over the largest imposed",
        fastest,
        Unit::Number,
        Tolerance::Asked(1.2),
    );
    let [came, went] = [0, 1].map(|k| (passed[1][k] - passed[0][k]) as f64);
    outcome.figure(
        "particles that came in less those that went out in a beat, of those that came in",
        1.0 - went / came,
        Unit::Part,
        Tolerance::Asked(0.01),
    );
    let change = shown.particles.1 as f64 / shown.particles.0 as f64 - 1.0;
    outcome.figure("change of the number of particles", change, Unit::Part, Tolerance::Held(0.08));
    Some(outcome)
}

pub(super) fn thin_wall() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let pipe = Pipe {
        diameter: 6e-3,
        length: 18e-3,
        end_time: 25e-3,
        inlet: "condition = \"velocity\"\nvalue = \"0.1 m/s\"\nramp = \"10 ms\"".into(),
        outlet: "condition = \"pressure\"\nvalue = \"0 Pa\"".into(),
        more: "\n[wall]\nmodel = \"shell\"\nyoung_modulus = \"1 MPa\"\nthickness = \"0.3 mm\"\n".into(),
        ..Pipe::published(10.0)
    };
    let (mut flow, _, plan) = pipe.flow_in::<f32, ShellWall<f32>>();
    let shown = ride(&mut flow, plan.end_time, |_| {}).unwrap_or_else(|e| panic!("{e}"));
    shown.invariants("", 0.05, &mut outcome);
    // Outside of the surface of the lumen by more than half a spacing, for a wall that has moved by far less.
    let outside = flow.fluid.state.position.iter().filter(|x| {
        let (z, r) = pipe.place(**x);
        (0.0..pipe.length).contains(&z) && r > pipe.radius() + 0.5 * pipe.spacing()
    });
    outcome.figure("particles within the wall", outside.count() as f64, Unit::Number, Tolerance::Asked(0.0));
    Some(outcome)
}

pub(super) fn sudden_stop() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let mut pipe = Pipe { end_time: 0.08, ..Pipe::published(10.0) };
    let stop = 0.04;
    pipe.inflow =
        table(pipe.end_time, 160, |t| if t <= stop { 0.2 } else { 0.2 * (1.0 - (t - stop) / 2e-3).max(0.0) });
    pipe.inlet =
        "condition = \"velocity\"\nprofile = \"plug\"\nwaveform = \"inflow.csv\"\nramp = \"10 ms\"".into();
    pipe.outlet = "condition = \"pressure\"\nvalue = \"-2 kPa\"".into();
    let (mut flow, case, plan) = pipe.flow::<f32>();
    let wall = SignedDistance::closed(&case.vessel);
    let (mut largest_void, mut next, mut before) = (0.0f64, stop, None);
    let spacing = plan.numbers.spacing;
    let shown = ride(&mut flow, plan.end_time, |flow| {
        if flow.time >= next {
            let now = voids(&wall, &flow.fluid.state.position, spacing);
            before.get_or_insert(now);
            largest_void = largest_void.max(now);
            next += 4e-3;
        }
    })
    .unwrap_or_else(|e| panic!("{e}"));
    shown.invariants("", 0.02, &mut outcome);
    let opened = largest_void - before.unwrap_or(0.0);
    outcome.figure("places that lose their blood by the stop", opened, Unit::Part, Tolerance::Asked(0.005));
    outcome.figure(
        "smallest distance between particles at the end, in spacings",
        shown.least_distance,
        Unit::Number,
        Tolerance::TooLow { asked: 0.5, held: 0.4 },
    );
    Some(outcome)
}

pub(super) fn abrupt_onset() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let speed = 0.1;
    let pipe = Pipe {
        end_time: 0.6,
        inlet: format!(
            "condition = \"velocity\"\nprofile = \"plug\"\nvalue = \"{speed} m/s\"\nramp = \"0 s\""
        ),
        outlet: "condition = \"pressure\"\nvalue = \"0 Pa\"".into(),
        ..Pipe::published(10.0)
    };
    let (mut flow, _, plan) = pipe.flow::<f32>();
    let hammer = plan.numbers.rest_density * plan.numbers.sound_speed * speed;
    let inlet = port(&plan, "inlet");
    let mut pressure = Series::default();
    let shown = ride(&mut flow, plan.end_time, |flow| pressure.add(flow.time, flow.readings[inlet].pressure))
        .unwrap_or_else(|e| panic!("{e}"));
    let peak = pressure.points.iter().map(|p| p.1).fold(0.0, f64::max);
    // The hammer itself is a density deviation of u/c.
    shown.invariants("", 0.06, &mut outcome);
    outcome.figure(
        "largest pressure at the inlet over rho c u",
        peak / hammer,
        Unit::Number,
        Tolerance::Asked(1.2),
    );
    // Closed at one end and open at the other, the pipe rings at a quarter of the wave length; friction alone ends it.
    let period = 4.0 * pipe.length / plan.numbers.sound_speed;
    let swing = |from: f64| {
        let within: Vec<f64> =
            pressure.points.iter().filter(|p| (from..from + period).contains(&p.0)).map(|p| p.1).collect();
        let low = within.iter().copied().fold(f64::INFINITY, f64::min);
        within.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low
    };
    outcome.figure(
        format!(
            "swing of that pressure in the last of {:.0} periods of the pipe, of that in the first",
            pipe.end_time / period
        ),
        swing(pipe.end_time - period) / swing(0.0),
        Unit::Part,
        Tolerance::Asked(0.5),
    );
    Some(outcome)
}

pub(super) fn wrong_start() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let windkessel = |name: &str, initial: &str| {
        [
            (format!("opening.{name}.condition"), "windkessel".to_owned()),
            (format!("opening.{name}.proximal_resistance"), "2e8 Pa s/m^3".to_owned()),
            (format!("opening.{name}.distal_resistance"), "1e9 Pa s/m^3".to_owned()),
            (format!("opening.{name}.compliance"), "2e-9 m^3/Pa".to_owned()),
            (format!("opening.{name}.initial_pressure"), initial.to_owned()),
        ]
    };
    let mut set = vec![
        ("particles.spacing".to_owned(), "0.9 mm".to_owned()),
        ("run.end_time".to_owned(), "0.4 s".to_owned()),
    ];
    set.extend(windkessel("ica", "80 mmHg"));
    set.extend(windkessel("eca", "78 mmHg"));
    let set: Vec<(&str, &str)> = set.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
    let case = crate::case("carotid", &set);
    let (mut flow, plan) = crate::flow::<f32>(&case);
    let (ica, eca) = (port(&plan, "ica"), port(&plan, "eca"));
    let mut series = [const { Series { points: Vec::new() } }; 3];
    let shown = ride(&mut flow, plan.end_time, |flow| {
        let [a, b] = [ica, eca].map(|k| flow.readings[k].pressure);
        series[0].add(flow.time, a - b);
        series[1].add(flow.time, flow.readings[ica].flow);
        series[2].add(flow.time, flow.readings[eca].flow);
    })
    .unwrap_or_else(|e| panic!("{e}"));
    shown.invariants("", 0.05, &mut outcome);
    let [difference, internal, external] = series.map(|s| s.from(0.3).mean());
    // Both stores empty into each other through both proximal resistances, at a time constant of R_p C = 0.4 s.
    outcome.figure(
        "difference of the pressures at the outlets after 0.3 s, of that at the start",
        difference / (2.0 * 133.322),
        Unit::Part,
        Tolerance::Asked((-0.3f64 / 0.4).exp()),
    );
    outcome.figure("flows out of both alike", internal / external - 1.0, Unit::Part, Tolerance::Asked(0.2));
    Some(outcome)
}

pub(super) fn closed_outlet() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let model = |name: &str, key: &str, value: &str| (format!("opening.{name}.{key}"), value.to_owned());
    let set = [
        ("particles.spacing".to_owned(), "0.8 mm".to_owned()),
        ("run.end_time".to_owned(), "0.2 s".to_owned()),
        model("ica", "condition", "resistance"),
        model("ica", "resistance", "1e8 Pa s/m^3"),
        model("eca", "condition", "resistance"),
        model("eca", "resistance", "1e13 Pa s/m^3"),
    ];
    let set: Vec<(&str, &str)> = set.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
    let case = crate::case("carotid", &set);
    let (mut flow, plan) = crate::flow::<f32>(&case);
    let (closed, inlet) = (port(&plan, "eca"), port(&plan, "cca"));
    let (mut through, mut inflow) = (Series::default(), Series::default());
    let shown = ride(&mut flow, plan.end_time, |flow| {
        if flow.time > 0.15 {
            through.add(flow.time, flow.readings[closed].flow);
            inflow.add(flow.time, flow.readings[inlet].flow);
        }
    })
    .unwrap_or_else(|e| panic!("{e}"));
    shown.invariants("", 0.03, &mut outcome);
    outcome.figure(
        "flow through it, of the inflow",
        through.mean() / inflow.mean(),
        Unit::Part,
        Tolerance::Asked(0.001),
    );
    let cap = &plan.openings[closed].opening;
    let spacing = plan.numbers.spacing;
    let near = flow.fluid.state.position.iter().filter(|x| {
        let depth = (cap.center - **x).dot(cap.normal);
        (0.0..4.0 * spacing).contains(&depth) && x.distance(cap.center) < 2.0 * cap.radius
    });
    let expected = cap.area * 4.0 / spacing.powi(2);
    outcome.figure(
        "particles within four spacings of it, of those that fill the space",
        near.count() as f64 / expected - 1.0,
        Unit::Part,
        Tolerance::Asked(0.1),
    );
    Some(outcome)
}

pub(super) fn many_cycles() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let (period, cycles) = (0.4, 20.0);
    let mut pipe = Pipe { length: 3.0 * 6.35e-3, end_time: cycles * period, ..Pipe::published(6.0) };
    pipe.inflow = table(period, 100, |t| 0.05 * (1.0 - (TAU * t / period).cos()));
    pipe.inlet = "condition = \"velocity\"\nwaveform = \"inflow.csv\"".into();
    pipe.outlet = "condition = \"windkessel\"\nproximal_resistance = \"1e8 Pa s/m^3\"\ndistal_resistance = \"1e9 Pa s/m^3\"\n\
                   compliance = \"4e-10 m^3/Pa\"\nperiodic_start = true"
        .into();
    pipe.more = format!("period = \"{period} s\"");
    let (mut flow, _, plan) = pipe.flow::<f32>();
    let outlet = port(&plan, "outlet");
    let (mut pressure, mut particles) = (Series::default(), Series::default());
    let shown = ride(&mut flow, plan.end_time, |flow| {
        pressure.add(flow.time, flow.readings[outlet].pressure);
        particles.add(flow.time, flow.fluid.state.len() as f64);
    })
    .unwrap_or_else(|e| panic!("{e}"));
    shown.invariants("", 0.05, &mut outcome);
    let cycle = |series: &Series, k: f64| {
        let within = series.points.iter().filter(|p| (k * period..(k + 1.0) * period).contains(&p.0));
        let (sum, n) = within.fold((0.0, 0.0), |(s, n), p| (s + p.1, n + 1.0));
        sum / n
    };
    let drift = |series: &Series| cycle(series, cycles - 1.0) / cycle(series, 9.0) - 1.0;
    outcome.figure(
        "mean pressure of the last cycle against the tenth",
        drift(&pressure),
        Unit::Part,
        Tolerance::Asked(0.005),
    );
    outcome.figure(
        "mean number of particles, the same",
        drift(&particles),
        Unit::Part,
        Tolerance::Asked(0.005),
    );
    Some(outcome)
}

pub(super) fn viscosities() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    for (name, viscosity, speed, end_time) in
        [("Reynolds number 0.01", 10.0, 15e-3, 2e-3), ("Reynolds number 5000", 1e-4, 0.075, 0.25)]
    {
        let pipe = Pipe {
            viscosity,
            end_time,
            length: 3.0 * 6.35e-3,
            inlet: format!(
                "condition = \"velocity\"\nvalue = \"{speed} m/s\"\nramp = \"{} s\"",
                0.2 * end_time
            ),
            outlet: "condition = \"pressure\"\nvalue = \"0 Pa\"".into(),
            ..Pipe::published(8.0)
        };
        let shown = ride_pipe(&pipe, |_| {});
        shown.invariants(name, 0.05, &mut outcome);
        outcome.figure(
            format!("{name}: largest speed of a particle over that of the axis"),
            shown.top_speed / (2.0 * speed),
            Unit::Number,
            Tolerance::Asked(1.3),
        );
    }
    Some(outcome)
}
