//! Inflow that turns round in every beat.

use super::measure::{Series, fly};
use super::{Case, Outcome, Tolerance, Unit};
use crate::data;
use crate::pipe::Pipe;

/// The case of the page.
pub const CASE: Case = Case {
    name: "backflow",
    title: "Backflow through both ends",
    setup: "Pipe of 17.2 mm, two diameters long: the flow above the aortic bifurcation (-24 to 87 ml/s, 1.1 s) as a parabola \
            into a Windkessel of R_p 3.4e7, C 7.3e-10, R_d 1.55e9 (both iliac arteries in parallel) from its periodic start, \
            D/10, three cycles (D/8 and one in the quick run).",
    reference: "The inflow; waveform and outlets of Boileau et al. 2015, iliac bifurcation.",
    remark: "The peak Reynolds number is 1900. Over the first beat the number of particles settles, by 4 % in so short a pipe \
             at D/8; the quick run holds that. From moment to moment it swings by 1 %.",
    quick: Some(|| run(8.0, 1.0)),
    full: || run(10.0, 3.0),
};

const PERIOD: f64 = 1.1;

fn run(across: f64, cycles: f64) -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let file = data()?.join("waveforms/aortic_bifurcation_boileau2015.csv");
    let text = std::fs::read_to_string(file).expect("the data hold the waveform");
    let mut pipe = Pipe {
        diameter: 0.0172,
        length: 2.0 * 0.0172,
        density: 1060.0,
        viscosity: 4e-3,
        ..Pipe::published(across)
    };
    pipe.inflow = text
        .lines()
        .skip(1)
        .map(|line| {
            let (t, q) = line.split_once(',').expect("two columns");
            [t, q].map(|v| v.trim().parse().expect("a number"))
        })
        .collect();
    pipe.end_time = cycles * PERIOD;
    pipe.inlet =
        "condition = \"flow\"\nprofile = \"parabolic\"\nwaveform = \"inflow.csv\"\nramp = \"0 s\"".into();
    pipe.outlet = "condition = \"windkessel\"\nproximal_resistance = \"3.4e7 Pa s/m^3\"\n\
                   distal_resistance = \"1.55e9 Pa s/m^3\"\ncompliance = \"7.3e-10 m^3/Pa\"\nperiodic_start = true"
        .into();
    pipe.more = format!("period = \"{PERIOD} s\"");
    let mut difference = Series::default();
    let (mut first, mut last) = (None, Vec::new());
    let mut particles = Series::default();
    let mut peak: f64 = 0.0;
    let flown = fly(&pipe, |flow, plan| {
        let ports = flow.openings.ports();
        last = ports.iter().map(|p| p.counters.outflow_volume).collect::<Vec<_>>();
        particles.add(flow.time, flow.fluid.state.len() as f64);
        if flow.time >= (cycles - 1.0) * PERIOD && first.is_none() {
            first = Some(last.clone());
        }
        let inlet = plan.openings.iter().position(|o| o.name == "inlet").expect("there is an inlet");
        let [inflow, outflow] = [flow.readings[inlet].flow, flow.readings[1 - inlet].flow];
        peak = peak.max(inflow.abs());
        difference.add(flow.time, inflow + outflow);
    });
    outcome.cost(&flown);
    let change: Vec<f64> = last.iter().zip(first.iter().flatten()).map(|(b, a)| b - a).collect();
    let through = 7.985e-6 * PERIOD;
    let late = difference.from((cycles - 1.0) * PERIOD).smoothed(0.01 * PERIOD);
    let rms = (late.points.iter().map(|p| p.1 * p.1).sum::<f64>() / late.points.len() as f64).sqrt();
    outcome.figure("particles lost", flown.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
    let full = cycles > 1.5;
    let held = |asked, coarse| if full { Tolerance::Asked(asked) } else { Tolerance::Held(coarse) };
    outcome.figure(
        "volume in less volume out over the last cycle, of what goes through",
        -change.iter().sum::<f64>() / through,
        Unit::Part,
        held(0.01, 0.06),
    );
    // Without the cycle in which it settles, where there is more than that: two whole cycles then.
    let settled = if full { PERIOD } else { 0.0 };
    let middle = 0.5 * (settled + pipe.end_time);
    let later = particles.from(middle).mean();
    let mut before = particles.from(settled);
    before.points.retain(|p| p.0 < middle);
    outcome.figure(
        "particles, mean of the second half of what counts against that of the first",
        later / before.mean() - 1.0,
        Unit::Part,
        held(0.01, 0.06),
    );
    outcome.figure(
        "outflow less inflow, rms over means of a hundredth of the cycle, of the peak",
        rms / peak,
        Unit::Part,
        Tolerance::Held(0.05),
    );
    outcome.figure("largest density deviation", flown.density, Unit::Part, Tolerance::Held(0.05));
    Some(outcome)
}
