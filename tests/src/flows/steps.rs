//! Steps may end anywhere and particles stand unevenly: neither may make anything grow.

use crate::pipe::Pipe;
use glam::DVec3;
use vaso_coupling::ShellWall;
use vaso_driver::{Breakdown, Flow, Stage, world};

/// A short tube that is filled at a pressure, with a shell for a wall.
fn tube() -> Pipe {
    let end = "condition = \"pressure\"\nvalue = \"500 Pa\"\nramp = \"2 ms\"".to_owned();
    Pipe {
        diameter: 8e-3,
        length: 16e-3,
        density: 1000.0,
        inlet: end.clone(),
        outlet: end,
        end_time: 1.0,
        more:
            "[numerics]\nsound_speed = \"20 m/s\"\n[wall]\nmodel = \"shell\"\nyoung_modulus = \"300 kPa\"\n\
             poisson_ratio = 0.45\nthickness = \"1 mm\"\ndensity = \"1000 kg/m^3\"\n"
                .into(),
        ..Pipe::published(8.0)
    }
}

/// Largest density deviation of a tube whose every step is asked to end a little behind where its acoustic steps would, by that share of
/// one of them.
fn largest_deviation(share: f64) -> f64 {
    let (mut flow, _, _) = tube().flow_in::<f32, ShellWall<f32>>();
    for step in 0..30 {
        let acoustic = flow.fluid.numbers().acoustic_step(flow.fluid.top_speed());
        let until = flow.time + (2.0 + share) * acoustic;
        while flow.time < until {
            flow.step(until).unwrap_or_else(|e| panic!("step {step}: {e}"));
        }
    }
    flow.watch.max_density_error
}

/// Damping takes the rate of the strain from its change in a sub-step. In one that is ten million times too short the change is a rounding
/// error, and the shell burst in a single step: that of an aorta did after 4000 acoustic ones.
#[test]
fn what_is_left_of_a_step_does_not_shake_a_shell() {
    let [even, odd] = [0.0, 1e-7].map(largest_deviation);
    println!("density off by {even:.2e}, and {odd:.2e} with something left over");
    assert!((odd / even - 1.0).abs() < 0.2, "{even} {odd}");
}

/// Particles that are as good as random have a density of noise, which is what sums of kernels find. Diffusion takes it away at the highest
/// frequency there is, and must not turn it over to grow, as it did where an outlet was crowded by 7 %.
#[test]
fn noise_of_the_density_dies_out_where_particles_stand_unevenly() {
    let still = "condition = \"pressure\"\nvalue = \"0 Pa\"".to_owned();
    let pipe = Pipe {
        inlet: still.clone(),
        outlet: still,
        more: "[numerics]\nsound_speed = \"20 m/s\"\n".into(),
        ..Pipe::published(10.0)
    };
    let (case, mut plan) = pipe.plan();
    // One advective step is to hold many acoustic ones.
    plan.numbers.reference_speed = 0.05;
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow: Flow<f32> = world::build_flow(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let (spacing, mut seed) = (pipe.spacing(), 1_u64);
    let mut next = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    for x in flow.fluid.state.position.iter_mut() {
        let across = DVec3::new(x.x, x.y, 0.0).length();
        if across < pipe.radius() - 1.5 * spacing {
            *x += spacing * DVec3::new(next(), next(), next());
        }
    }
    let noise = |flow: &Flow<f32>| flow.fluid.top_density_error();
    let acoustic = flow.fluid.numbers().acoustic_step(0.0);
    let mut found = Vec::new();
    for steps in [3.0, 30.0, 60.0] {
        let until = flow.time + steps * acoustic;
        while flow.time < until {
            flow.step(until).unwrap_or_else(|e| panic!("{e}"));
        }
        found.push(noise(&flow));
    }
    println!("density off by {:.2e} at first, {:.2e} then, {:.2e} in the end", found[0], found[1], found[2]);
    assert!(found[0] > 1e-4, "there is noise: {}", found[0]);
    // It is fed by what is mixed in of the sums; with all of the diffusion it grew tenfold.
    assert!(found[2] < 2.0 * found[0], "{found:?}");
}

/// A run that has to stop says in which stage a value broke, and where: values are broken by hand, one before each step.
#[test]
fn what_breaks_is_told_with_its_stage_and_place() {
    let pipe = Pipe {
        diameter: 6e-3,
        length: 18e-3,
        inlet: "condition = \"velocity\"\nvalue = \"0.1 m/s\"".into(),
        outlet: "condition = \"pressure\"\nvalue = \"0 Pa\"".into(),
        ..Pipe::published(8.0)
    };
    let particle = 100;
    let broken = |spoil: &dyn Fn(&mut Flow<f32>)| {
        let (mut flow, _, _) = pipe.flow::<f32>();
        flow.step(1.0).unwrap_or_else(|e| panic!("{e}"));
        spoil(&mut flow);
        let diverged = flow.step(1.0).expect_err("it cannot go on");
        println!("{diverged}; {}", diverged.advice());
        assert_eq!((diverged.step, flow.watch.non_finite), (2, 1));
        assert!(diverged.time > 0.0 && !diverged.advice().is_empty());
        let Breakdown::NonFinite { column, position, .. } = diverged.breakdown else { panic!("{diverged}") };
        (diverged.stage, column, position.is_finite())
    };
    let density = broken(&|flow| flow.fluid.state.density_change[particle] = f64::NAN);
    assert_eq!(density, (Stage::Summation, "velocity", true));
    let rate = broken(&|flow| flow.fluid.state.density_rate[particle] = f64::INFINITY);
    assert_eq!(rate, (Stage::Summation, "velocity", true));
    // A velocity of before has moved the particle nowhere by the time that it is found.
    let velocity = broken(&|flow| flow.fluid.state.velocity[particle].x = f64::NAN);
    assert_eq!(velocity, (Stage::Viscosity, "position", false));
}
