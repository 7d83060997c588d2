//! Outlet models behind a pipe with a given inflow.

use std::f64::consts::TAU;

use vaso_boundary::{Integration, OutletState, Windkessel};

use super::measure::{Flown, Series, fly};
use super::{Case, Outcome, Tolerance, Unit};
use crate::data;
use crate::pipe::Pipe;

/// A resistance.
pub const RESISTANCE: Case = Case {
    name: "resistance",
    title: "Pipe with a resistance",
    setup: "Pipe of 6.35 mm, five diameters long (two and a half in the quick run), 1000 kg/m^3, 4 mPa s, R = 2.05e8 Pa s/m^3, \
            the published pulse of 0.14 to 0.47 m/s as a parabola; 0.6 s after a ramp, D/12 (D/10).",
    reference: "p = R Q with the flow that is let in (the published cases of the scheme, case 02).",
    remark: "Nothing is shifted in time. Means over 20 ms, the averaging window of the published scheme, leave out the sound \
             that runs to and fro in the pipe: with the level of the pressure out of the equation of state the outlet does not \
             damp it.",
    quick: Some(|| resistance(10.0, 2.5, 0.3)),
    full: || resistance(12.0, 5.0, 0.7),
};

/// The published Windkessel.
pub const WINDKESSEL: Case = Case {
    name: "windkessel-pipe",
    title: "Pipe with a Windkessel",
    setup: "The same pipe with a plug, R_p 3.05e8, C 9.79e-10, R_d 1.37e9 (published case 03), one cycle of 1 s from the \
            periodic start after a ramp of 0.1 s, sound speed 10 m/s as published, D/12 (0.4 s, two and a half diameters and D/10 in the quick run).",
    reference: "The periodic cycle of the Windkessel alone under the inflow, exact; the published pulse is 10 756 to 14 528 Pa.",
    remark: "The vessel is rigid and its fluid hardly compressible, so that what flows in flows out at once. About means over \
             20 ms see the case before.",
    quick: Some(|| windkessel(10.0, 2.5, 0.4)),
    full: || windkessel(12.0, 5.0, 1.0),
};

/// The pipe of svFSI.
pub const SVFSI: Case = Case {
    name: "svfsi-pipe",
    title: "Wide pipe with a Windkessel, against finite elements",
    setup: "Radius 20 mm, 300 mm long, Q = 62.83 (1 - cos 2 pi t) ml/s as a parabola from rest, empty store, R_p 1.21e7, \
            C 1.5e-9, R_d 1.212e8, D/10, two cycles (one in the quick run), sound speed 40 m/s.",
    reference: "svFSI-Tests, 04-fluid/01-pipe3D_RCR, RCR.dat; exact integral.",
    remark: "With the pressure level in the equation of state 154 m/s would be needed for 1 %. Sound takes L/c from end to end, which \
             makes the outflow 1/cos(w L/c) of the inflow, 1.001 here. The pipe holds six strokes, so that a thousandth of its \
             volume, filled and emptied within a tenth of the cycle, is 3 % of the peak flow: the flow shows what the density \
             does, the pressure what comes of it. At D/10 and 20 m/s they were off by 7.5 and 10.6 % while pairs had the sum of their pressures. \
             With two switches that were made for this case alone, of which one is gone, the pressure was within 0.7 %. What is left is not explained; it \
             is not the factor of the inlet, which no longer jumps with what the buffer happens to hold. With item 31 of decision 10 the pressure of the quick run went from \
             2.1 to 3.9 % and the flow from 4.9 to 4.6 %. A finer \
             spacing has not been run in this form.",
    quick: Some(|| svfsi(10.0, 1.0)),
    full: || svfsi(10.0, 2.0),
};

/// A resistance far above what sound sees.
pub const STIFF: Case = Case {
    name: "stiff-outlet",
    title: "Resistance of five acoustic impedances",
    setup: "Pipe of 6.35 mm, two and a half diameters long, constant parabola at Reynolds number 100 after a ramp of 0.1 s, \
            R = 5 rho c / A, D/10, 0.8 s; means of the last half.",
    reference: "p = R Q; a steady flow.",
    remark: "A pressure computed from the last flow blows up within a tenth of this time.",
    quick: Some(stiff),
    full: stiff,
};

/// A pipe of the published outlets.
fn published(across: f64, diameters: f64, end: f64) -> Pipe {
    let mut pipe = Pipe { density: 1000.0, viscosity: 4e-3, ..Pipe::published(across) };
    pipe.length = diameters * pipe.diameter;
    pipe.end_time = end;
    pipe
}

/// The published inflow velocity: time and value, one period of 1 s.
fn pulse() -> Option<Vec<[f64; 2]>> {
    let file = data()?.join("waveforms/cylinder_inlet_velocity_sphinxsys.csv");
    let text = std::fs::read_to_string(file).expect("the data hold the waveform");
    let row = |line: &str| {
        let (t, u) = line.split_once(',').expect("two columns");
        [t, u].map(|v| v.trim().parse::<f64>().expect("a number"))
    };
    Some(text.lines().skip(1).map(row).collect())
}

/// Linear interpolation in a table that repeats after a second.
fn at(table: &[[f64; 2]], t: f64) -> f64 {
    let t = t.rem_euclid(1.0);
    let next = table.partition_point(|row| row[0] <= t).clamp(1, table.len() - 1);
    let ([t0, y0], [t1, y1]) = (table[next - 1], table[next]);
    y0 + (y1 - y0) * (t - t0) / (t1 - t0)
}

/// Outlet pressure and flow in time.
fn outlet(pipe: &Pipe) -> (Series, Series, Flown) {
    let (mut pressure, mut flow_out) = (Series::default(), Series::default());
    let flown = fly(pipe, |flow, plan| {
        let k = plan.openings.iter().position(|o| o.name == "outlet").expect("there is an outlet");
        let reading = flow.readings[k];
        pressure.add(flow.time, reading.pressure);
        flow_out.add(flow.time, reading.flow);
    });
    (pressure, flow_out, flown)
}

/// Time in which the inflow rises, in the runs with the published pulse \[s\].
const RAMP: f64 = 0.1;

/// Time over which values are averaged before they are compared \[s\].
const WINDOW: f64 = 5e-3;

fn resistance(across: f64, diameters: f64, end: f64) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let table = pulse()?;
    let mut pipe = published(across, diameters, end);
    let resistance = 2.05e8;
    pipe.inlet = format!(
        "condition = \"velocity\"\nprofile = \"parabolic\"\nwaveform = \"inflow.csv\"\nramp = \"{RAMP} s\""
    );
    pipe.outlet = format!("condition = \"resistance\"\nresistance = \"{resistance} Pa s/m^3\"");
    pipe.more = "period = \"1 s\"".into();
    pipe.inflow.clone_from(&table);
    let (pressure, _, flown) = outlet(&pipe);
    outcome.cost(&flown);
    let exact = |t: f64| resistance * pipe.area() * at(&table, t);
    let late = pressure.from(RAMP + 0.02);
    let peak = late.points.iter().map(|p| exact(p.0)).fold(0.0, f64::max);
    differences(
        &mut outcome,
        "the peak",
        &late,
        exact,
        peak,
        [Tolerance::Asked(0.01), Tolerance::Held(0.03)],
    );
    lost(&mut outcome, &flown);
    Some(outcome)
}

fn windkessel(across: f64, diameters: f64, end: f64) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let table = pulse()?;
    let mut pipe = published(across, diameters, end);
    let model = Windkessel {
        proximal_resistance: 3.05e8,
        compliance: 9.79e-10,
        distal_resistance: 1.37e9,
        distal_pressure: 0.0,
    };
    pipe.inlet = format!(
        "condition = \"velocity\"\nprofile = \"plug\"\nwaveform = \"inflow.csv\"\nramp = \"{RAMP} s\""
    );
    pipe.outlet = windkessel_keys(&model, "periodic_start = true");
    pipe.more = "period = \"1 s\"\n[numerics]\nsound_speed = \"10 m/s\"".into();
    pipe.inflow.clone_from(&table);
    let (pressure, _, flown) = outlet(&pipe);
    outcome.cost(&flown);
    // Many cycles of the model alone: whatever it started from is forgotten. Then the cycle from there: the run starts as far ahead of it as the ramp sets it back.
    let flow = |t: f64| pipe.area() * at(&table, t);
    let advance = |state: &OutletState, flow: f64, duration: f64| {
        model.advance(state, flow, duration, Integration::Exponential)
    };
    let steps = 2000;
    let dt = 1.0 / f64::from(steps);
    let settled = (1..=25 * steps)
        .fold(OutletState::default(), |state, k| advance(&state, flow(f64::from(k) * dt), dt));
    let mut state = OutletState::at_rest(settled.stored_pressure);
    let mut curve = vec![[0.0, state.pressure]];
    for k in 1..=steps {
        let t = f64::from(k) * dt;
        state = advance(&state, flow(t), dt);
        curve.push([t, state.pressure]);
    }
    let late = pressure.from(RAMP + 0.02);
    differences(
        &mut outcome,
        "the published pulse",
        &late,
        |t| at(&curve, t),
        14_528.0 - 10_756.0,
        // Half as long and at D/10 the sound in the pipe weighs more; what is asked for is asked of the published length.
        if end < 1.0 {
            [Tolerance::Held(0.015), Tolerance::Held(0.1)]
        } else {
            [Tolerance::Missed { asked: 0.01, held: 0.015 }, Tolerance::Held(0.1)]
        },
    );
    lost(&mut outcome, &flown);
    Some(outcome)
}

/// Tells how far the outlet pressure is from the exact one, of a `scale` \[Pa\], as means over 20 and over 5 ms.
fn differences(
    outcome: &mut Outcome,
    of: &str,
    pressure: &Series,
    exact: impl Fn(f64) -> f64,
    scale: f64,
    [slow, fast]: [Tolerance; 2],
) {
    let difference = pressure.minus(exact);
    outcome.figure(
        format!("outlet pressure, largest difference of means over 20 ms, of {of}"),
        difference.smoothed(0.02).largest_difference(|_| 0.0) / scale,
        Unit::Part,
        slow,
    );
    outcome.figure(
        "the same over 5 ms",
        difference.smoothed(WINDOW).largest_difference(|_| 0.0) / scale,
        Unit::Part,
        fast,
    );
}

fn windkessel_keys(model: &Windkessel, start: &str) -> String {
    format!(
        "condition = \"windkessel\"\nproximal_resistance = \"{} Pa s/m^3\"\ndistal_resistance = \"{} Pa s/m^3\"\n\
         compliance = \"{} m^3/Pa\"\n{start}",
        model.proximal_resistance, model.distal_resistance, model.compliance
    )
}

fn svfsi(across: f64, cycles: f64) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let file = data()?.join("reference/svfsi_pipe_rcr_rigid/RCR.dat");
    let text = std::fs::read_to_string(file).expect("the data hold the table");
    // cgs: t, stored pressure, outlet pressure, outlet flow.
    let rows: Vec<Vec<f64>> = text
        .lines()
        .map(|line| line.split_whitespace().map(|v| v.parse().expect("a number")).collect())
        .collect();
    let mut pipe =
        Pipe { diameter: 0.04, length: 0.3, density: 1060.0, viscosity: 4e-3, ..Pipe::published(across) };
    pipe.end_time = cycles;
    let inflow = |t: f64| 62.831_853_07e-6 * (1.0 - (TAU * t).cos());
    pipe.inflow = (0..=400).map(|k| f64::from(k) / 400.0).map(|t| [t, inflow(t)]).collect();
    let model = Windkessel {
        proximal_resistance: 1.21e7,
        compliance: 1.5e-9,
        distal_resistance: 1.212e8,
        distal_pressure: 0.0,
    };
    pipe.inlet =
        "condition = \"flow\"\nprofile = \"parabolic\"\nwaveform = \"inflow.csv\"\nramp = \"0 s\"".into();
    pipe.outlet = windkessel_keys(&model, "initial_pressure = \"0 Pa\"");
    pipe.more = "period = \"1 s\"\n[numerics]\nsound_speed = \"40 m/s\"".into();
    let (pressure, flow_out, flown) = outlet(&pipe);
    outcome.cost(&flown);
    let column = |k: usize, scale: f64| {
        let table: Vec<[f64; 2]> = rows.iter().map(|r| [r[0], scale * r[k]]).collect();
        move |t: f64| {
            let next = table.partition_point(|row| row[0] <= t).clamp(1, table.len() - 1);
            let ([t0, y0], [t1, y1]) = (table[next - 1], table[next]);
            y0 + (y1 - y0) * (t - t0) / (t1 - t0)
        }
    };
    let peak = rows.iter().map(|r| 0.1 * r[2]).fold(0.0, f64::max);
    let smooth = |series: &Series, exact: &dyn Fn(f64) -> f64| {
        series.from(0.02).minus(exact).smoothed(0.02).largest_difference(|_| 0.0)
    };
    outcome.figure(
        "outlet pressure, largest difference of means over 20 ms from the finite elements, of the peak",
        smooth(&pressure, &column(2, 0.1)) / peak,
        Unit::Part,
        Tolerance::Missed { asked: 0.01, held: 0.045 },
    );
    outcome.figure(
        "outlet flow, the same",
        smooth(&flow_out, &column(3, 1e-6)) / (2.0 * 62.831_853_07e-6),
        Unit::Part,
        Tolerance::Missed { asked: 0.01, held: 0.07 },
    );
    lost(&mut outcome, &flown);
    Some(outcome)
}

fn stiff() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let mut pipe = Pipe::published(10.0);
    pipe.length = 2.5 * pipe.diameter;
    pipe.end_time = 0.8;
    let mean = super::ends::mean_velocity(&pipe);
    let resistance = 5.0 * pipe.density * 20.0 * mean / pipe.area();
    pipe.inlet = format!(
        "condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"{mean} m/s\"\nramp = \"100 ms\""
    );
    pipe.outlet = format!("condition = \"resistance\"\nresistance = \"{resistance} Pa s/m^3\"");
    let (pressure, flow_out, flown) = outlet(&pipe);
    outcome.cost(&flown);
    let exact = resistance * mean * pipe.area();
    let (late, flow) = (pressure.from(0.4), flow_out.from(0.4));
    let noise = (flow.points.iter().map(|p| (p.1 - flow.mean()).powi(2)).sum::<f64>()
        / flow.points.len() as f64)
        .sqrt();
    outcome.figure("outlet pressure", late.mean() / exact - 1.0, Unit::Part, Tolerance::Asked(0.01));
    outcome.figure("outlet flow, rms about its mean", noise / flow.mean(), Unit::Part, Tolerance::Held(0.03));
    outcome.figure("largest density deviation", flown.density, Unit::Part, Tolerance::Asked(0.02));
    lost(&mut outcome, &flown);
    Some(outcome)
}

fn lost(outcome: &mut Outcome, flown: &Flown) {
    outcome.figure("particles lost", flown.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
}
