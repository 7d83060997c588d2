//! Supports, loads, the contract with a fluid, precision and threads.

use crate::support;

use glam::DVec3;
use std::f64::consts::TAU;
use support::{Body, Rows, plate, tube};
use vaso_particles::WallLoad;
use vaso_shell::{Height, Hold, Isa, Material, Model, Numbers, Particles, Real, Shell, ShellError, Support};

const SPACING: f64 = 1e-3;
const THICKNESS: f64 = 0.5e-3;

fn numbers() -> Numbers {
    Numbers::new(1000.0, SPACING)
}

fn shell<R: Real>(body: &Body, isa: Isa) -> Shell<R> {
    let material = Material::new(1e6, 0.3, Model::Resultant).expect("in range");
    Shell::new(&body.particles(), material, numbers(), isa).expect("a sound body")
}

fn square() -> Body {
    plate([10e-3, 10e-3], THICKNESS, [Rows::Inside(10); 2])
}

fn small_tube() -> Body {
    tube((30.0 * SPACING / TAU, 12.0 * SPACING, THICKNESS), 30, 12, 0.05)
}

/// A free plate falls as a stone does, and its ledger counts the weight.
#[test]
fn a_free_plate_falls() {
    let mut shell = shell::<f64>(&square(), Isa::detect());
    shell.set_gravity(-9.81 * DVec3::Z);
    shell.advance(1e-2).expect("a free fall");
    let (u, v) = (shell.state.displacement[17], shell.state.velocity[17]);
    assert!((u.z + 0.5 * 9.81 * 1e-4).abs() < 1e-12 && (v.z + 9.81e-2).abs() < 1e-12, "{u} {v}");
    let energies = shell.energies();
    assert!(energies.balance().abs() < 1e-10 * energies.kinetic && energies.strain() < 1e-20);
}

/// What supports bear at rest is the weight; forces of a fluid and dead forces act alike.
#[test]
fn supports_bear_the_load() {
    let body = square();
    let edge = body.select(|x| x.x < SPACING || x.x > 9.0 * SPACING);
    let force = -2e-7 * DVec3::Z;
    let settled = |with: &dyn Fn(&mut Shell<f64>)| {
        let mut shell = shell::<f64>(&body, Isa::detect());
        shell.hold(&edge, Support::SIMPLE).expect("particles exist");
        with(&mut shell);
        let (_, rest) = shell.settle(1e-6, 50_000).expect("a gentle load");
        assert!(rest <= 1e-6);
        shell
    };
    let dead = settled(&|shell| shell.add_forces(&body.all(), &vec![force; body.len()]).expect("one each"));
    let weight = body.len() as f64 * force;
    assert!((dead.reaction() + weight).length() < 1e-5 * weight.length());
    let by_fluid = settled(&|shell| {
        let (pressure, viscous) = (vec![0.5 * force; body.len()], vec![0.5 * force; body.len()]);
        let load = WallLoad { pressure_force: &pressure, viscous_force: &viscous, face_pressure: &[] };
        shell.set_load(&load).expect("one each");
    });
    let middle = dead.place(body.nearest(DVec3::new(5e-3, 5e-3, 0.0)));
    let (a, b) = (dead.state.displacement[middle], by_fluid.state.displacement[middle]);
    assert!(a.z < 0.0 && (a - b).length() < 1e-5 * a.length(), "{a} {b}");
}

/// One face of a bent plate is pulled, the other pushed, the middle free of stress.
#[test]
fn faces_of_a_bent_plate_are_stressed_oppositely() {
    let body = square();
    let mut shell = shell::<f64>(&body, Isa::detect());
    let radius = 1.0;
    for i in 0..shell.state.len() {
        let x = shell.state.reference_position[i];
        let (sine, cosine) = (x.x / radius).sin_cos();
        let bent = DVec3::new(radius * sine, x.y, radius * (cosine - 1.0));
        shell.state.displacement[i] = bent - x;
        shell.state.director[i] = DVec3::new(sine, 0.0, cosine);
    }
    shell.refresh().expect("a gentle bend");
    let i = shell.place(body.nearest(DVec3::new(5e-3, 5e-3, 0.0)));
    let expected = 1e6 / (1.0 - 0.09) * 0.5 * THICKNESS / radius;
    let [outer, other] = shell.principal_stresses(i, Height::Outer);
    assert!((outer / expected - 1.0).abs() < 2e-3 && (other / (0.3 * expected) - 1.0).abs() < 2e-3);
    assert!((shell.principal_stresses(i, Height::Inner)[1] / expected + 1.0).abs() < 2e-3);
    assert!(shell.principal_stresses(i, Height::Middle)[0].abs() < 1e-3 * expected);
    let mises = expected * (1.0_f64 - 0.3 + 0.09).sqrt();
    assert!((shell.von_mises(i, Height::Outer) / mises - 1.0).abs() < 2e-3);
    assert!((shell.thickness(i) / THICKNESS - 1.0).abs() < 1e-4);
}

/// A follower pressure on a free closed ring of wall acts along its present normals.
#[test]
fn pressure_follows_the_normal() {
    let body = small_tube();
    let mut shell = shell::<f64>(&body, Isa::detect());
    let number = shell.add_pressure(&body.all(), &body.area, 0.0).expect("one area each");
    let turn = glam::DMat3::from_rotation_x(1.0);
    for i in 0..shell.state.len() {
        shell.state.displacement[i] =
            turn * shell.state.reference_position[i] - shell.state.reference_position[i];
        shell.state.director[i] = turn * shell.state.reference_director[i];
    }
    shell.set_pressure(number, 100.0);
    shell.refresh().expect("a rotation");
    for i in 0..shell.state.len() {
        assert!((shell.normal(i) - shell.state.director[i]).length() < 1e-9);
        assert!((shell.area_stretch(i) - 1.0).abs() < 1e-9);
    }
}

/// The tissue takes over the load that the stiffness leaves it, and its dashpot is stable however strong.
#[test]
fn tissue_holds_a_free_plate() {
    let body = square();
    let mut shell = shell::<f64>(&body, Isa::detect());
    let (stiffness, pressure) = (1e6, 100.0);
    shell.add_tissue(&body.all(), stiffness, 1e5).expect("particles exist");
    shell.add_pressure(&body.all(), &body.area, pressure).expect("one area each");
    for _ in 0..100 {
        shell.advance(1e-2).expect("stable");
    }
    for u in shell.state.displacement.iter() {
        assert!((u.z / (pressure / stiffness) - 1.0).abs() < 1e-3, "{u}");
    }
    let energies = shell.energies();
    assert!(energies.balance().abs() < 1e-2 * energies.dissipated, "{energies:?}");
}

/// An impedance adds mass along the normal, and across it as much.
#[test]
fn an_impedance_slows_the_answer() {
    let body = square();
    let answer = |impedance: f64, force: DVec3| {
        let mut shell = shell::<f64>(&body, Isa::detect());
        shell.add_impedance(&body.all(), impedance, 0.5).expect("particles exist");
        shell.add_forces(&body.all(), &vec![force; body.len()]).expect("one each");
        shell.advance_in(1e-6, 1).expect("a short step");
        shell.state.velocity[0].length()
    };
    let mass = 1000.0 * THICKNESS;
    let impedance = 4.0 * mass / 1e-6;
    for axis in [DVec3::Z, DVec3::X] {
        let ratio = answer(impedance, 1e-6 * axis) / answer(0.0, 1e-6 * axis);
        assert!((ratio - 1.0 / 3.0).abs() < 1e-6, "{axis}: {ratio}");
    }
}

/// A plate cut at its plane of symmetry bends as the whole one.
#[test]
fn a_sliding_edge_stands_for_the_other_half() {
    let sag = |half: bool| {
        let (length, rows) = if half { (10e-3, 11) } else { (20e-3, 21) };
        let body = plate([length, 10e-3], THICKNESS, [Rows::OnEnds(rows), Rows::Inside(10)]);
        let mut shell = shell::<f64>(&body, Isa::detect());
        let end = |x: f64| x.abs() < 1e-9 || (!half && (x - length).abs() < 1e-9);
        shell.hold(&body.select(|x| end(x.x)), Support::CLAMPED).expect("particles exist");
        if half {
            let cut = body.select(|x| x.x > length - 1e-9);
            shell.hold(&cut, Support::sliding(2.0 * DVec3::X)).expect("particles exist");
        }
        shell.add_pressure(&body.all(), &body.area, 0.1).expect("one area each");
        shell.settle(1e-5, 100_000).expect("a gentle load");
        shell.state.displacement[shell.place(body.nearest(DVec3::new(10e-3, 5e-3, 0.0)))].z
    };
    let (half, whole) = (sag(true), sag(false));
    assert!((half / whole - 1.0).abs() < 0.02, "{half} {whole}");
}

/// Velocities after some steps under a sudden pressure.
fn moved<R: Real>(isa: Isa) -> Vec<DVec3> {
    let body = small_tube();
    let mut shell = shell::<R>(&body, isa);
    shell.add_pressure(&body.all(), &body.area, 300.0).expect("one area each");
    for _ in 0..5 {
        shell.advance(1e-4).expect("a gentle motion");
    }
    (0..body.len()).map(|i| shell.state.velocity[shell.place(i)]).collect()
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| moved::<f32>(Isa::detect()))
    };
    assert!(on(1) == on(3));
}

#[test]
fn precisions_and_instruction_sets_agree() {
    let reference = moved::<f64>(Isa::scalar());
    let scale = reference.iter().map(|v| v.length()).fold(0.0, f64::max);
    for isa in Isa::available() {
        let apart =
            |v: Vec<DVec3>| v.iter().zip(&reference).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / scale;
        let (double, mixed) = (apart(moved::<f64>(isa)), apart(moved::<f32>(isa)));
        assert!(double < 1e-9 && mixed < 1e-4, "{}: {double:e} {mixed:e}", isa.name());
    }
}

#[test]
fn a_shell_goes_on_where_it_was() {
    let make = || {
        let body = small_tube();
        let mut shell = shell::<f32>(&body, Isa::detect());
        shell.add_pressure(&body.all(), &body.area, 300.0).expect("one area each");
        shell
    };
    let mut straight = make();
    straight.advance(2e-4).expect("a gentle motion");
    let mut second = make();
    second.state = straight.state.clone();
    second.resume().expect("a sound state");
    let undamped = |shell: &mut Shell<f32>| {
        shell.advance_in(1e-6, 1).expect("a gentle motion");
        shell.state.displacement.to_vec()
    };
    assert!(undamped(&mut straight) == undamped(&mut second));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let body = square();
    let material = Material::new(1e6, 0.3, Model::Resultant).expect("in range");
    let refusal = |particles: &Particles, numbers: Numbers| {
        Shell::<f64>::new(particles, material, numbers, Isa::detect()).err().expect("refused")
    };
    let short = Particles { area: &body.area[1..], ..body.particles() };
    assert!(matches!(refusal(&short, numbers()), ShellError::Count { what: "area", given: 99, .. }));
    let damped = Numbers { damping: 3.0, ..numbers() };
    assert!(matches!(refusal(&body.particles(), damped), ShellError::OutOfRange { key: "damping", .. }));
    let line = plate([10e-3, 1e-3], THICKNESS, [Rows::Inside(10), Rows::Inside(1)]);
    let error = refusal(&line.particles(), numbers());
    assert!(matches!(error, ShellError::Lonely { .. }), "{error}");
    let mut sound = shell::<f64>(&body, Isa::detect());
    let nobody = sound.hold(&[100], Support::CLAMPED).expect_err("there are 100 particles");
    assert!(matches!(nobody, ShellError::NoSuchParticle { particle: 100, len: 100, .. }));
    let nowhere = Support { displacement: Hold::Along(DVec3::ZERO), director: Hold::Free };
    assert!(sound.hold(&[0], nowhere).is_err());
    let hurried = sound.advance(10.0).expect_err("millions of steps");
    assert!(matches!(hurried, ShellError::TooStiff { .. }), "{hurried}");
}
