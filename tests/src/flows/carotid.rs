//! The carotid of a person, from surface to flow; needs outside data.

use crate::data;
use std::path::Path;
use vaso_coupling::ShellWall;
use vaso_driver::{Case, Flow, Plan, world};

const CASE: &str = r#"
[geometry]
surface = "SURFACE"
unit = "mm"
[particles]
spacing = "SPACING mm"
[blood]
density = "1060 kg/m^3"
viscosity = "3.5 mPa s"
[[opening]]
name = "cca"
near = [1.53, 5.86, -31.85]
condition = "velocity"
profile = "plug"
value = "0.2 m/s"
ramp = "100 ms"
[[opening]]
name = "ica"
near = [-2.96, -0.45, 22.22]
condition = "pressure"
[[opening]]
name = "eca"
near = [8.99, 0.94, 19.12]
condition = "pressure"
[run]
end_time = "0.5 s"
"#;

/// Outcome of a run.
#[derive(Debug)]
struct Outcome {
    /// Share of the internal carotid in the outflow over the last tenth of a second.
    share: f64,
    /// The same over the tenth before.
    share_before: f64,
    /// Inflow minus outflow by volumes over the last two tenths, of the inflow.
    balance: f64,
    density: f64,
    escaped: u64,
}

fn run(data: &Path, spacing: f64, generator: &str) -> Outcome {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    let surface = data.join("geometry/carotid_bifurcation/carotid_lumen.stl");
    let text = CASE.replace("SURFACE", &surface.to_string_lossy()).replace("SPACING", &spacing.to_string());
    let file = folder.path().join("case.toml");
    std::fs::write(&file, text).expect("a temporary file can be written");
    let set = [("particles.generator".to_owned(), generator.to_owned())];
    let case = Case::load(&file, &set).unwrap_or_else(|e| panic!("{e}"));
    let plan = Plan::new(&case).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow: Flow<f32> = world::build_flow(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let mut marks = Vec::new();
    for end in [0.3, 0.4, 0.5] {
        while flow.time < end {
            flow.step(end).unwrap_or_else(|e| panic!("{e}"));
        }
        marks.push(flow.openings.ports().iter().map(|p| p.counters.outflow_volume).collect::<Vec<_>>());
    }
    // Openings are in order of area: common, internal, external.
    let share = |a: &[f64], b: &[f64]| (b[1] - a[1]) / ((b[1] - a[1]) + (b[2] - a[2]));
    let late: Vec<f64> = marks[2].iter().zip(&marks[0]).map(|(b, a)| b - a).collect();
    Outcome {
        share: share(&marks[1], &marks[2]),
        share_before: share(&marks[0], &marks[1]),
        balance: late.iter().sum::<f64>() / -late[0],
        density: flow.watch.max_density_error,
        escaped: flow.watch.escaped,
    }
}

fn check(o: &Outcome) {
    assert_eq!(o.escaped, 0, "{o:?}");
    assert!(o.density < 0.02, "{o:?}");
    assert!(o.balance.abs() < 0.01, "{o:?}");
    assert!((o.share - o.share_before).abs() < 0.02, "the split still moves: {o:?}");
}

#[test]
fn blood_flows_through_a_real_carotid() {
    let Some(data) = data() else { return };
    let lattice = run(&data, 0.6, "relaxed-lattice");
    println!("0.6 mm: {lattice:?}");
    check(&lattice);
}

#[test]
#[ignore = "two minutes on two cores; `just validate-long` runs it"]
fn both_generators_lead_to_one_flow_through_a_real_carotid() {
    let Some(data) = data() else { return };
    let [lattice, blocks] = ["relaxed-lattice", "multiblock"].map(|generator| run(&data, 0.6, generator));
    println!("0.6 mm: {lattice:?}\nby blocks: {blocks:?}");
    check(&blocks);
    assert!((lattice.share - blocks.share).abs() < 0.02, "{lattice:?} {blocks:?}");
}

#[test]
#[ignore = "ten minutes on two cores; `just validate-long` runs it"]
fn the_split_of_a_real_carotid_converges() {
    let Some(data) = data() else { return };
    let (coarse, fine) = (run(&data, 0.4, "relaxed-lattice"), run(&data, 0.3, "relaxed-lattice"));
    println!("0.4 mm: {coarse:?}\n0.3 mm: {fine:?}");
    check(&coarse);
    check(&fine);
    assert!((coarse.share - fine.share).abs() < 0.02, "{coarse:?} {fine:?}");
}

/// Its wall as a shell: 0.6 mm, 1.106 MPa, 0.49, unloaded at 10 kPa, between a plug that rises and two Windkessels. Sound
/// goes at 115 m/s, seven times the pulse wave of its narrowest branch, and what is wrong at an opening shows within milliseconds: the largest speed was 9 m/s, of the inflow 0.06, as long as the wall
/// that leans into an outlet was taken as it is.
#[test]
fn an_elastic_wall_lets_a_real_carotid_start_quietly() {
    let Some(data) = data() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    let surface = data.join("geometry/carotid_bifurcation/carotid_lumen.stl");
    let outlet = "condition = \"windkessel\"\nproximal_resistance = \"5e8 Pa s/m^3\"\ndistal_resistance = \"3.1e9 Pa s/m^3\"\n\
                  compliance = \"1.4e-10 m^3/Pa\"\ninitial_pressure = \"10 kPa\"";
    let wall = "[wall]\nmodel = \"shell\"\nyoung_modulus = \"1.106 MPa\"\npoisson_ratio = 0.49\nthickness = \"0.6 mm\"\n\
                density = \"1060 kg/m^3\"\nunloaded_pressure = \"10 kPa\"\n";
    let text = CASE
        .replace("SURFACE", &surface.to_string_lossy())
        .replace("SPACING", "0.6")
        .replace("condition = \"pressure\"", outlet)
        .replace("value = \"0.2 m/s\"", "value = \"0.3 m/s\"")
        .replace("ramp = \"100 ms\"", "ramp = \"50 ms\"")
        + wall;
    let file = folder.path().join("case.toml");
    std::fs::write(&file, text).expect("a temporary file can be written");
    let case = Case::load(&file, &[("numerics.sound_speed".into(), "115 m/s".into())])
        .unwrap_or_else(|e| panic!("{e}"));
    let plan = Plan::new(&case).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow: Flow<f32, ShellWall<f32>> =
        world::build_flow_in(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let end = 10e-3;
    while flow.time < end {
        flow.step(end).unwrap_or_else(|e| panic!("{e}"));
    }
    let speed = flow.watch.max_mach * plan.numbers.sound_speed;
    let shell = &flow.wall.as_ref().expect("the wall deforms").wall.shell;
    let wall_speed = shell.state.velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
    println!(
        "blood up to {speed:.3} m/s, wall {wall_speed:.4} m/s, density off by {:.5}",
        flow.watch.max_density_error
    );
    assert_eq!(flow.watch.escaped, 0);
    assert!(speed < 0.2, "{speed}");
    assert!(wall_speed < 0.02, "{wall_speed}");
    assert!(flow.watch.max_density_error < 2e-4, "{}", flow.watch.max_density_error);
}
