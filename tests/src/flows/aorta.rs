//! A real thoracic aorta with five outlets and a shell, where its branches meet.

use crate::data;
use vaso_coupling::ShellWall;
use vaso_driver::{Case, Flow, Plan, world};

/// Its wall of 2.5 mm, 0.75 MPa at 1.2 mm. Between the branches of the arch such a wall reaches beyond the centre of curvature; it broke
/// within 0.12 ms there, where layers of it had a volume below zero. Now it is as thick as there is room.
#[test]
fn a_thick_shell_finds_room_between_the_branches_of_an_aorta() {
    let Some(data) = data() else { return };
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    let surface = data.join("geometry/aorta_arch_vmr0024/aorta_lumen.stl");
    let mut text = format!(
        "[geometry]\nsurface = {surface:?}\nunit = \"cm\"\n[particles]\nspacing = \"1.2 mm\"\n\
         [blood]\ndensity = \"1060 kg/m^3\"\nviscosity = \"3.5 mPa s\"\n\
         [wall]\nmodel = \"shell\"\nyoung_modulus = \"0.75 MPa\"\npoisson_ratio = 0.49\nthickness = \"2.5 mm\"\n\
         density = \"1060 kg/m^3\"\nunloaded_pressure = \"10 kPa\"\n\
         [run]\nend_time = \"3 ms\"\n\
         [[opening]]\nname = \"inlet\"\nnear = [-0.991, 4.555, 2.863]\ncondition = \"velocity\"\nprofile = \"plug\"\n\
         value = \"0.3 m/s\"\nramp = \"50 ms\"\n"
    );
    let outlets = [
        [-1.015, 4.275, 10.01],
        [-2.644, 3.053, 10.812],
        [-2.919, 1.801, 9.911],
        [-1.077, 1.082, 9.589],
        [-1.613, -0.821, 0.396],
    ];
    for (k, near) in outlets.into_iter().enumerate() {
        text += &format!(
            "[[opening]]\nname = \"outlet-{k}\"\nnear = {near:?}\ncondition = \"pressure\"\nvalue = \"10.6 kPa\"\n"
        );
    }
    let file = folder.path().join("case.toml");
    std::fs::write(&file, text).expect("a temporary file can be written");
    let case = Case::load(&file, &[]).unwrap_or_else(|e| panic!("{e}"));
    let plan = Plan::new(&case).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow: Flow<f32, ShellWall<f32>> =
        world::build_flow_in(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let end = 3e-3;
    while flow.time < end {
        flow.step(end).unwrap_or_else(|e| panic!("{e}"));
    }
    let state = &flow.wall.as_ref().expect("the wall deforms").wall.shell.state;
    let thinned = state.thickness.iter().filter(|t| **t < 2.5e-3).count();
    let speed = state.velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
    println!("{thinned} of {} particles are thinner, wall up to {speed:.3} m/s", state.len());
    assert_eq!(flow.watch.escaped, 0);
    assert!((1..state.len() / 10).contains(&thinned), "{thinned}");
    assert!(speed < 0.2, "{speed}");
}
