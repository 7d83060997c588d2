//! What openings must not do: let the level of the pressure into the flow, feed sound, or lose what flows in.

use crate::pipe::Pipe;
use crate::stability::vessels;
use glam::DVec3;
use vaso_coupling::ShellWall;
use vaso_driver::{Flow, world};
use vaso_geometry::shapes;

/// Readings of the inlet's pressure \[Pa\] over time \[s\].
fn inlet_pressure(pipe: &Pipe) -> Vec<(f64, f64)> {
    let (mut flow, _, plan) = pipe.flow::<f32>();
    let inlet = plan.openings.iter().position(|o| o.name == "inlet").expect("there is an inlet");
    let mut series = Vec::new();
    while flow.time < pipe.end_time {
        flow.step(pipe.end_time).unwrap_or_else(|e| panic!("{e}"));
        series.push((flow.time, flow.readings[inlet].pressure));
    }
    assert_eq!(flow.watch.escaped, 0);
    series
}

/// Mean and standard deviation between two times \[s\].
fn mean_and_swing(series: &[(f64, f64)], from: f64, to: f64) -> [f64; 2] {
    let within: Vec<f64> = series.iter().filter(|s| s.0 >= from && s.0 < to).map(|s| s.1).collect();
    let n = within.len() as f64;
    let mean = within.iter().sum::<f64>() / n;
    [mean, (within.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / n).sqrt()]
}

/// A rigid pipe whose pressure lies 10.7 kPa above a reference that is given, a per cent of its density.
#[test]
fn a_level_far_from_the_reference_leaves_no_trace() {
    let level = 10665.0;
    let pipe = Pipe {
        inlet: "condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"50 mm/s\"\nramp = \"5 ms\""
            .into(),
        outlet: format!("condition = \"pressure\"\nvalue = \"{level} Pa\"\nramp = \"20 ms\""),
        end_time: 60e-3,
        more: "[numerics]\nsound_speed = \"32 m/s\"\nreference_pressure = \"0 Pa\"".into(),
        ..Pipe::published(10.0)
    };
    let [mean, swing] = mean_and_swing(&inlet_pressure(&pipe), 40e-3, 60e-3);
    println!("inlet {mean:.1} Pa, swinging by {swing:.1} Pa");
    // The drop along the pipe is 4 Pa.
    assert!((mean - level).abs() < 20.0 && swing < 20.0, "{mean} {swing}");
}

/// Sound that runs between an imposed velocity and an imposed pressure, set off by the start of the flow, gets nothing from either.
#[test]
fn sound_between_a_velocity_and_a_pressure_dies_down() {
    let pipe = Pipe {
        inlet: "condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"50 mm/s\"\nramp = \"5 ms\""
            .into(),
        outlet: "condition = \"pressure\"\nvalue = \"0 Pa\"".into(),
        end_time: 1.0,
        more: "[numerics]\nsound_speed = \"2 m/s\"\nreference_pressure = \"0 Pa\"".into(),
        ..Pipe::published(10.0)
    };
    let series = inlet_pressure(&pipe);
    let [[_, early], [_, late]] =
        [(0.0, 0.1), (0.9, 1.0)].map(|(from, to)| mean_and_swing(&series, from, to));
    println!("swing {early:.1} Pa at first, {late:.2} Pa after a second");
    assert!(late < 0.05 * early, "{early} {late}");
}

/// Volume that an elastic tube takes up, closed at its far end, over the volume that has flowed in, less what the fluid stores.
fn taken_up(model: &str) -> f64 {
    let (inner, thickness) = (5e-3, 1e-3);
    let pipe = Pipe {
        diameter: 2.0 * inner,
        length: 60e-3,
        density: 1000.0,
        viscosity: 1e-2,
        inlet: "condition = \"velocity\"\nprofile = \"plug\"\nvalue = \"20 mm/s\"\nramp = \"5 ms\"".into(),
        outlet: "condition = \"resistance\"\nresistance = \"1e13 Pa s/m^3\"".into(),
        end_time: 30e-3,
        more: format!(
            "[numerics]\nsound_speed = \"30 m/s\"\n[wall]\nmodel = \"{model}\"\nmaterial = \"saint-venant-kirchhoff\"\n\
             young_modulus = \"300 kPa\"\npoisson_ratio = 0.0\nthickness = \"{thickness} m\"\ndensity = \"1000 kg/m^3\"\n"
        ),
        ..Pipe::published(10.0)
    };
    let stored = |state: &vaso_fluid::FluidState| {
        let mean = state.density_change.iter().sum::<f64>() / state.len() as f64;
        mean / pipe.density * pipe.area() * pipe.length
    };
    // Of a thick wall that does not contract sideways, held along the axis: from where it is measured to the face.
    let to_face = |r: f64| {
        let outer = inner + thickness;
        let lame = |r: f64| r + outer * outer / r;
        lame(inner) / lame(r)
    };
    let mut came_in = 0.0;
    if model == "shell" {
        let (mut flow, _, _) = pipe.flow_in::<f32, ShellWall<f32>>();
        while flow.time < pipe.end_time {
            let before = flow.time;
            flow.step(pipe.end_time).unwrap_or_else(|e| panic!("{e}"));
            came_in -= (flow.time - before) * flow.readings.iter().map(|r| r.flow).sum::<f64>();
        }
        let state = &flow.wall.as_ref().expect("the wall deforms").wall.shell.state;
        let middle = inner + 0.5 * thickness;
        let area = inner / middle;
        let widened = (0..state.len())
            .map(|i| {
                let x = state.reference_position[i].with_z(0.0).normalize();
                state.displacement[i].dot(x) * to_face(middle) * state.area[i] * area
            })
            .sum::<f64>();
        return (widened + stored(&flow.fluid.state)) / came_in;
    }
    let (mut flow, _, _) = pipe.flow::<f32>();
    while flow.time < pipe.end_time {
        let before = flow.time;
        flow.step(pipe.end_time).unwrap_or_else(|e| panic!("{e}"));
        came_in -= (flow.time - before) * flow.readings.iter().map(|r| r.flow).sum::<f64>();
    }
    let solid = &flow.wall.as_ref().expect("the wall deforms").wall;
    let spacing = solid.numbers().spacing;
    // By slices of the innermost layer, as many as particles stand in it along the tube.
    let (mut sum, mut n) = (0.0, 0.0);
    for i in 0..solid.state.len() {
        let x = solid.state.reference_position[i];
        let r = x.x.hypot(x.y);
        if r < inner + spacing && (0.0..pipe.length).contains(&x.z) {
            sum += solid.state.displacement[i].dot(x.with_z(0.0) / r) * to_face(r);
            n += 1.0;
        }
    }
    let widened = sum / n * std::f64::consts::TAU * inner * pipe.length;
    (widened + stored(&flow.fluid.state)) / came_in
}

/// The wall takes up what flows in: what is seen of the divergence beside a wall is all of it.
#[test]
fn an_elastic_tube_takes_up_what_flows_in() {
    takes_up_all("shell");
}

#[test]
#[ignore = "two minutes on two cores; `just validate-walls` runs it"]
fn a_solid_tube_takes_up_what_flows_in() {
    takes_up_all("solid");
}

fn takes_up_all(model: &str) {
    let share = taken_up(model);
    println!("{model}: {share:.4} of what flowed in");
    assert!((share - 1.0).abs() < 0.02, "{model}: {share}");
}

/// A slow flow through a pipe that is cut 15 degrees off its section at both ends. Sound is as fast as beside a stiff wall that deforms: what
/// drives a particle at the rim of the outlet grows a hundred times while it passes, and a velocity along the normal of the inlet would
/// go through its wall.
#[test]
fn a_pipe_that_is_cut_obliquely_drives_nothing_out() {
    let (radius, length, spacing) = (2e-3, 16e-3, 0.5e-3);
    let surface = shapes::pipe(radius, length, DVec3::Z, 64)
        .map(|v| DVec3::new(v.x, v.y, v.z + 15_f64.to_radians().tan() * v.x));
    let text = format!(
        "[particles]\nspacing = \"{spacing} m\"\n[blood]\ndensity = \"1060 kg/m^3\"\nviscosity = \"3.5 mPa s\"\n\
         [[opening]]\nname = \"inlet\"\nnear = [0, 0, 0]\ncondition = \"velocity\"\nprofile = \"plug\"\nvalue = \"0.1 m/s\"\n\
         ramp = \"5 ms\"\n[[opening]]\nname = \"outlet\"\nnear = [0, 0, {}]\ncondition = \"pressure\"\n\
         [numerics]\nsound_speed = \"100 m/s\"\nreference_pressure = \"0 Pa\"\n[run]\nend_time = \"20 ms\"\n",
        1e3 * length
    );
    let (case, plan) = vessels::case(&surface, &text);
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow: Flow<f32> = world::build_flow(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    while flow.time < 20e-3 {
        flow.step(20e-3).unwrap_or_else(|e| panic!("{e}"));
    }
    let (speed, density) = (flow.watch.max_mach * 100.0, flow.watch.max_density_error);
    println!("up to {speed:.3} m/s, density off by up to {:.4} %", 100.0 * density);
    assert_eq!(flow.watch.escaped, 0);
    // On the axis it goes at twice the mean.
    assert!(speed < 0.4, "{speed}");
    assert!(density < 5e-4, "{density}");
}
